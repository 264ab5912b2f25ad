//! Rust and WGSL meet by name: structs, constants, bindings, kernels and stages are compared here.

use std::collections::BTreeSet;
use std::mem::offset_of;

use motes::cpu::particles::cull::Fate;
use motes::gpu::shader::sources::{KERNELS, LIBRARIES, YARDSTICKS};
use motes::gpu::shader::{self, Access, CompileOptions, CompiledKernel};
use motes::gpu::{STAGE_KERNELS, check_binding};
use motes::layout::{
    self, AgeLook, Boid, Bound, Brood, Counts, Cover, Dispatch, DroppedFlame, FireFrame, Flame,
    FlameDisc, FlameLight, FlockFrame, Frame, FrameStats, Ground, Ignition, Lamp, ListedFlame,
    Node, Obstacle, Particle, Pillar, Planet, Pose, Relation, ShadeBox, SpreadCounts, SpreadEdge,
    SpreadFace, SpreadFeature, SpreadFrame, SpreadPiece, SpreadPoint, StripJoint, StrokeLight,
    SurfaceFrame, SurfaceLight, SystemFrame, SystemRow, Walker, Wind,
};
use motes::plan::{BUFFERS, BufferRole, STAGES, Uses, buffer};

/// A field as Rust has it: name, offset, size.
type RustField = (&'static str, usize, usize);

/// Name, size and fields of a struct.
macro_rules! rust_layout {
    ($of:ident { $($field:ident),* $(,)? }) => {{
        fn size_of_field<T, F>(_: fn(&T) -> &F) -> usize {
            size_of::<F>()
        }
        // Names every field, so that one that is not listed does not compile.
        let $of { $($field: _),* } = $of::default();
        let fields: Vec<RustField> = vec![
            $((stringify!($field), offset_of!($of, $field), size_of_field(|it: &$of| &it.$field))),*
        ];
        (stringify!($of), size_of::<$of>(), fields)
    }};
}

fn rust_layouts() -> Vec<(&'static str, usize, Vec<RustField>)> {
    vec![
        rust_layout!(Particle {
            position_and_index,
            velocity_and_birth
        }),
        rust_layout!(SystemRow {
            shape,
            ejection_and_light,
            speed_and_lifetime,
            size_and_threshold,
            color_mean,
            color_var,
            color_rate,
            color_rate_var,
            kinds,
        }),
        rust_layout!(SystemFrame {
            world_from_system_x,
            world_from_system_y,
            world_from_system_z,
            closing_world_from_system_x,
            closing_world_from_system_y,
            closing_world_from_system_z,
            earlier_system_from_birth_x,
            earlier_system_from_birth_y,
            earlier_system_from_birth_z,
            system_from_birth_x,
            system_from_birth_y,
            system_from_birth_z,
            acceleration,
            mean_parts,
            var_parts,
            key,
            flags,
            bounding_sphere,
            first_bound,
            bound_count,
            burst_parts,
            burst_var,
        }),
        rust_layout!(Bound {
            place,
            extent,
            kinds,
        }),
        rust_layout!(Wind {
            kinds,
            place,
            aim,
            scale,
            offset,
        }),
        rust_layout!(Frame {
            view_from_world_x,
            view_from_world_y,
            view_from_world_z,
            closing_view_from_world_x,
            closing_view_from_world_y,
            closing_view_from_world_z,
            background,
            light_from,
            light_color,
            ambient_color,
            planet_outline,
            focal_px,
            closing_focal_px,
            center_x_px,
            center_y_px,
            near,
            shutter,
            exposure,
            frame,
            system_count,
            row_mask,
            capacity,
            page_len,
            page_count,
            width,
            height,
            flags,
            wind_count,
            layer_plane_count,
            layer,
            least_lifetime,
            cell_count,
            own_system_count,
            spare_b,
            spare_c,
        }),
        rust_layout!(Counts {
            live,
            requested,
            born,
            dropped,
            total,
            died,
            spare_a,
            spare_b
        }),
        rust_layout!(FrameStats {
            frame,
            requested,
            born,
            died,
            live,
            dropped,
            died_of_intensity,
            died_of_bounds,
            systems_requested,
            systems_born,
            systems_died,
            systems_live,
            points_requested,
            points_born,
            points_died,
            points_live,
            flames_requested,
            flames_born,
            flames_died,
            flames_live,
            marks_died,
            marks_live,
        }),
        rust_layout!(Cover {
            points,
            shape,
            color,
            lit
        }),
        rust_layout!(Pose {
            now_x,
            now_y,
            now_z,
            earlier_x,
            earlier_y,
            earlier_z,
            closing_x,
            closing_y,
            closing_z,
        }),
        rust_layout!(Brood {
            ties,
            spans,
            mean_parts,
            var_parts,
            burst,
            spread,
            bounding_sphere,
            acceleration,
            rings,
        }),
        rust_layout!(Node {
            who,
            spans,
            velocity,
            acceleration,
            place_x,
            place_y,
            place_z,
        }),
        rust_layout!(Planet {
            place,
            eye,
            color,
            ground,
            light_from,
            light_color,
            ambient,
            kinds,
        }),
        rust_layout!(Lamp { place, color }),
        rust_layout!(Ground {
            plane,
            eye,
            middle,
            color,
            light_from,
            light_color,
            ambient,
            lamps_from,
            kinds,
            counts,
        }),
        rust_layout!(Pillar {
            place,
            extent,
            color,
        }),
        rust_layout!(SurfaceFrame {
            world_from_mesh_x,
            world_from_mesh_y,
            world_from_mesh_z,
            color,
            faces,
            grain,
            grain_shape,
            grain_kind,
        }),
        rust_layout!(SurfaceLight {
            eye,
            light_from,
            light_color,
            ambient,
            lamps_from,
            planet,
            plane,
            middle,
            kinds,
            counts,
        }),
        rust_layout!(ShadeBox {
            across,
            aside,
            along,
            look,
            kinds,
        }),
        rust_layout!(StrokeLight {
            lamps_from,
            ground,
            shade_from,
            shade_color,
            middle,
            kinds,
        }),
        rust_layout!(FlameLight { place, color }),
        rust_layout!(Dispatch { x, y, z }),
        rust_layout!(Boid {
            position_and_flock,
            velocity_and_index
        }),
        rust_layout!(FlockFrame {
            region_min,
            region_extent,
            acceleration,
            edges_min,
            edges_max,
            torus,
            torus_inverse,
            grid_min,
            cells_per_unit,
            cell_extent,
            color,
            goal,
            goal_rule,
            grid,
            members,
            ties,
            trail,
            trail_look,
            drawn,
        }),
        rust_layout!(Flame {
            root_and_fire,
            normal_and_birth,
            motion_and_index,
            look,
        }),
        rust_layout!(FireFrame {
            world_from_fire_x,
            world_from_fire_y,
            world_from_fire_z,
            earlier_world_from_fire_x,
            earlier_world_from_fire_y,
            earlier_world_from_fire_z,
            roots,
            extents,
            rise,
            noise,
            motion,
            look,
            inner,
            details,
            matrix_x,
            matrix_y,
            matrix_center,
            strip,
            char_look,
            char_shape,
            smoke_look,
            smoke_shape,
            light,
            light_scale,
            kinds,
            members,
            faces,
            times,
            lights,
        }),
        rust_layout!(ListedFlame {
            position,
            normal,
            look,
            kinds,
        }),
        rust_layout!(AgeLook { center, rim, scale }),
        rust_layout!(SpreadPoint {
            place,
            course,
            path,
            position,
        }),
        rust_layout!(Walker { place, way, left }),
        rust_layout!(SpreadFace {
            fire_from_face_x,
            fire_from_face_y,
            fire_from_face_z,
            features,
            material,
        }),
        rust_layout!(SpreadEdge {
            line,
            corner,
            turn,
            ties,
        }),
        rust_layout!(SpreadFeature { line, bend }),
        rust_layout!(SpreadFrame {
            rates,
            distances,
            kinds,
            line_look,
            line_shape,
            grain,
            grain_shape,
        }),
        rust_layout!(SpreadPiece {
            world_from_fire_x,
            world_from_fire_y,
            world_from_fire_z,
            ball,
            faces,
            ring,
        }),
        rust_layout!(Ignition {
            place,
            kinds,
            order,
        }),
        rust_layout!(SpreadCounts {
            total,
            live,
            requested,
            born,
            died,
            before,
            inserted,
            ignited_from,
            flames_total,
            flames_first,
            flames_requested,
            flames_born,
            flames_died,
            flames_live,
            marks_first,
            marks_died,
        }),
        rust_layout!(DroppedFlame {
            root_and_fire,
            normal_and_birth,
            identity,
        }),
        rust_layout!(FlameDisc { place, center, rim }),
        rust_layout!(StripJoint { place, extent }),
        rust_layout!(Relation {
            kinds,
            reach,
            separation,
            alignment,
            cohesion,
            sight,
        }),
        rust_layout!(Obstacle {
            kinds,
            place,
            extent,
            push,
        }),
    ]
}

#[test]
fn structs_agree_field_by_field() {
    let mut names = BTreeSet::new();
    for (name, size, fields) in rust_layouts() {
        let shape = shader::struct_layout("lib/layout", name)
            .expect("the file compiles")
            .unwrap_or_else(|| panic!("lib/layout has no struct {name}"));
        assert_eq!(shape.stride as usize, size, "{name}");
        let in_wgsl: Vec<_> = shape
            .fields
            .iter()
            .map(|field| {
                (
                    field.name.as_str(),
                    field.offset as usize,
                    field.size as usize,
                )
            })
            .collect();
        assert_eq!(in_wgsl, fields, "{name}");
        names.insert(name.to_owned());
    }
    let in_wgsl = shader::struct_names("lib/layout").expect("the file compiles");
    assert_eq!(in_wgsl.into_iter().collect::<BTreeSet<_>>(), names);
}

/// Words are words and floats are floats: sizes alone would not tell.
#[test]
fn scalar_fields_agree_in_kind() {
    let mut frame = Frame::default();
    (frame.focal_px, frame.center_x_px, frame.center_y_px) = (1.0, 1.0, 1.0);
    (frame.near, frame.shutter, frame.exposure) = (1.0, 1.0, 1.0);
    frame.closing_focal_px = 1.0;
    let system = SystemFrame {
        mean_parts: 1.0,
        var_parts: 1.0,
        burst_parts: 1.0,
        burst_var: 1.0,
        ..SystemFrame::default()
    };
    let floats = |bytes: &[u8], name: &str| {
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(bytes);
        let shape = shader::struct_layout("lib/layout", name)
            .expect("it compiles")
            .expect(name);
        for field in shape.fields.iter().filter(|field| field.size == 4) {
            let is_one = words[field.offset as usize / 4] == 1.0f32.to_bits();
            assert_eq!(field.type_name == "f32", is_one, "{name}.{}", field.name);
        }
    };
    floats(bytemuck::bytes_of(&frame), "Frame");
    floats(bytemuck::bytes_of(&system), "SystemFrame");
}

/// Every named constant of the sources' files, and its twin in Rust. The size of a workgroup and
/// the switches stand for what is given when a kernel is compiled.
#[test]
fn constants_agree_bit_for_bit() {
    let shared: Vec<(&str, u32)> = [
        motes::exact::CONSTANTS,
        motes::transcendental::CONSTANTS,
        motes::rng::CONSTANTS,
        motes::cpu::light::CONSTANTS,
        motes::cpu::particle::CONSTANTS,
        motes::cpu::systems::births::CONSTANTS,
        motes::cpu::reach::CONSTANTS,
        motes::cpu::disc::CONSTANTS,
        motes::cpu::footprint::CONSTANTS,
        motes::cpu::wind::CONSTANTS,
        motes::area::CONSTANTS,
        motes::noise::CONSTANTS,
        motes::cpu::cover::CONSTANTS,
        motes::cpu::draw::shapes::CONSTANTS,
        motes::cpu::draw::boid_shapes::CONSTANTS,
        motes::gpu::sort::CONSTANTS,
        layout::CONSTANTS,
        layout::flock::CONSTANTS,
        layout::tree::CONSTANTS,
        motes::cpu::tree::CONSTANTS,
        layout::flame::CONSTANTS,
        layout::ground::CONSTANTS,
        motes::cpu::draw::ground::CONSTANTS,
        motes::cpu::pillar::CONSTANTS,
        motes::cpu::raster::CONSTANTS,
        motes::cpu::draw::surface::CONSTANTS,
        motes::cpu::flame::CONSTANTS,
        layout::spread::CONSTANTS,
        motes::cpu::walk::CONSTANTS,
        motes::cpu::spread::front::CONSTANTS,
        motes::cpu::spread::block::CONSTANTS,
        motes::cpu::spread::gaps::CONSTANTS,
        motes::cpu::spread::insert::CONSTANTS,
        motes::cpu::spread::drop::CONSTANTS,
        motes::cpu::drops::CONSTANTS,
        motes::cpu::draw::marks::CONSTANTS,
        motes::cpu::draw::smoke::CONSTANTS,
        motes::cpu::meet::CONSTANTS,
        motes::cpu::fan::CONSTANTS,
        motes::cpu::detail::CONSTANTS,
        motes::cpu::draw::flame_discs::CONSTANTS,
        motes::cpu::draw::strip_joints::CONSTANTS,
        motes::cpu::strip::CONSTANTS,
        motes::cpu::cluster::CONSTANTS,
        motes::cpu::particles::cluster::CONSTANTS,
        motes::cpu::draw::planet::CONSTANTS,
        motes::cpu::shade::CONSTANTS,
        motes::cpu::draw::shade::CONSTANTS,
        motes::cpu::stroke::CONSTANTS,
        motes::cpu::draw::strokes::CONSTANTS,
        motes::cpu::boid::CONSTANTS,
        motes::cpu::grid::CONSTANTS,
        motes::cpu::steering::CONSTANTS,
        motes::cpu::solid::CONSTANTS,
        motes::gpu::FLAME_TILE_CONSTANTS,
    ]
    .concat()
    .into_iter()
    .chain([
        ("LIVES", Fate::Lives as u32),
        ("DIES_OF_AGE", Fate::DiesOfAge as u32),
        ("DIES_OF_INTENSITY", Fate::DiesOfIntensity as u32),
        ("DIES_OF_BOUNDS", Fate::DiesOfBounds as u32),
        ("DISPATCH_WIDTH", motes::gpu::dispatch::DISPATCH_WIDTH),
        ("FAMILIES_END", buffer_len("cover_counts")),
        ("STATISTICS_LEN", buffer_len("statistics")),
        // Fields of 21, 21 and 22 bits fill a word of 64: devices alone pack light so.
        ("GREEN_AT", 21),
        ("BLUE_AT", 42),
        ("FIELD_LEN", 1 << 21),
        ("BLUE_LEN", 1 << (64 - 42)),
        ("UNFIT", 1 << 3),
        // So many lights do devices alone load ahead.
        ("HELD", 32),
    ])
    .collect();
    let mut given = vec!["WORKGROUP_SIZE", "SIXTEENS"];
    given.extend(Uses::default().switches().iter().map(|(name, _)| name));
    let mut seen = BTreeSet::new();
    for source in LIBRARIES.iter().chain(KERNELS) {
        for constant in shader::constants(source.name).expect("the file compiles") {
            if given.contains(&constant.name.as_str()) {
                continue;
            }
            let twins: Vec<_> = shared
                .iter()
                .filter(|(name, _)| *name == constant.name)
                .collect();
            let [(_, bits)] = twins[..] else {
                panic!(
                    "{}: `{}` has {} twins in Rust",
                    source.file,
                    constant.name,
                    twins.len()
                )
            };
            assert_eq!(
                constant.bits, *bits,
                "{}: `{}` is {:#010x}, and {bits:#010x} in Rust",
                source.file, constant.name, constant.bits
            );
            seen.insert(constant.name);
        }
    }
    let unseen: Vec<_> = shared
        .iter()
        .filter(|(name, _)| !seen.contains(*name))
        .collect();
    assert!(
        unseen.is_empty(),
        "constants that no WGSL file declares: {unseen:?}"
    );
}

fn buffer_len(name: &str) -> u32 {
    match buffer(name).map(|declared| declared.count) {
        Some(motes::plan::Count::Fixed(count)) => count,
        other => panic!("`{name}` is {other:?}"),
    }
}

fn compiled(kernel: &str) -> CompiledKernel {
    match shader::compile(kernel, &CompileOptions::default()) {
        Ok(kernel) => kernel,
        Err(e) => panic!("{e}"),
    }
}

#[test]
fn every_binding_is_a_declared_buffer() {
    let mut bound = BTreeSet::new();
    for source in KERNELS {
        for binding in compiled(source.name).bindings {
            if let Err(e) = check_binding(&binding) {
                panic!("{e}");
            }
            let is_input = buffer(&binding.name).is_some_and(|it| it.role == BufferRole::Input);
            assert!(
                !is_input || binding.access != Access::ReadWrite,
                "{}: `{}` is written, and it is the processor's",
                source.file,
                binding.name
            );
            bound.insert(binding.name);
        }
    }
    let idle: Vec<_> = BUFFERS
        .iter()
        .filter(|it| !bound.contains(it.name))
        .collect();
    assert!(idle.is_empty(), "buffers that no kernel binds: {idle:?}");
}

/// A stage's kernels read and write what its line says, and scratch. `survivors` are the particles
/// that the advance writes: the pools change places.
#[test]
fn kernels_keep_to_their_stage() {
    let is_scratch = |name: &str| buffer(name).is_some_and(|it| it.role == BufferRole::Scratch);
    for info in STAGES {
        let mut written = BTreeSet::new();
        let mut read = BTreeSet::new();
        for one in STAGE_KERNELS.iter().filter(|one| one.stage == info.stage) {
            for binding in compiled(one.kernel).bindings {
                let name = match binding.name.as_str() {
                    "survivors" => "particles".to_owned(),
                    _ => binding.name,
                };
                if binding.access == Access::ReadWrite {
                    written.insert(name);
                } else {
                    read.insert(name);
                }
            }
        }
        for name in &written {
            let is_said = info.writes.contains(&name.as_str());
            assert!(is_said || is_scratch(name), "{} writes `{name}`", info.name);
        }
        for name in &read {
            // What a stage writes itself, it may read.
            let is_said = [info.reads, info.writes].concat().contains(&name.as_str());
            assert!(is_said || is_scratch(name), "{} reads `{name}`", info.name);
        }
        for name in info.writes {
            assert!(
                written.contains(*name),
                "{} does not write `{name}`",
                info.name
            );
        }
        for name in info.reads {
            let is_used = read.contains(*name) || written.contains(*name);
            assert!(is_used, "{} does not read `{name}`", info.name);
        }
    }
}

#[test]
fn no_kernel_is_an_orphan_and_stages_stand_in_order() {
    let listed: BTreeSet<_> = KERNELS
        .iter()
        .chain(YARDSTICKS)
        .map(|source| source.name)
        .collect();
    let mut used: BTreeSet<_> = STAGE_KERNELS.iter().map(|one| one.kernel).collect();
    // Those that no stage has: what tells whether two runs are the same, and the yardstick.
    used.extend(WITHOUT_A_STAGE);
    assert_eq!(listed, used);
    let mut order: Vec<_> = STAGE_KERNELS.iter().map(|one| one.stage).collect();
    order.dedup();
    assert_eq!(
        order,
        STAGES.iter().map(|info| info.stage).collect::<Vec<_>>()
    );
    for info in STAGES {
        let kernels = STAGE_KERNELS.iter().filter(|one| one.stage == info.stage);
        let has_its_name = |kernel: &str| kernel.rsplit('/').next() == Some(info.name);
        assert!(
            kernels.into_iter().any(|one| has_its_name(one.kernel)),
            "no kernel of {} has its name",
            info.name
        );
    }
}

/// Kernels that are dispatched by name and not by stage.
const WITHOUT_A_STAGE: &[&str] = &[
    "digest/digest",
    "draw/unpack",
    "bench/atomic_contended",
    "bench/atomic_spread",
    "bench/copy",
    "bench/copy_runs",
    "bench/copy_strides",
    "bench/copy_vec4",
    "bench/copy_wide",
    "bench/noise_lattice",
    "bench/noise_simplex",
    "bench/read_only",
    "bench/write_only",
];
