//! A particle system's part of a frame: its births, its place, the row of its newborn.

use glam::{UVec4, Vec3};

use super::curves::{CURVE_LEN, first_point};
use super::meshes::MeshTables;
use super::stroke::{is_stroke, word_of};
use super::wind::wander;
use crate::exact::{dot3, normalize_exact, snap};
use crate::layout::{self, Bound, SystemFrame, SystemRow};
use crate::rng::pcg4d;
use crate::scene::{
    BirthMoment, BirthRounding, BirthUnit, Blend, EjectionAxis, EjectionSpread, Extinction,
    GenerationShape, Integration, Intensity, Owner, ParticleShape, ParticleSpace, Scene, Shading,
    Side, StreakLight, System,
};
use crate::transcendental::{cos_turns, sin_turns};

/// Marks hashes that make system keys, so that no particle draw equals one by construction.
const KEY_TAG: u32 = 0x6b65_7973;

/// Frames that a particle without a lifetime lives: longer than any run.
const UNLIMITED_FRAMES: f32 = 65_500.0;

/// The rows of the 3 x 4 identity.
pub(super) const IDENTITY: [[f32; 4]; 3] = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
];

/// What a system asks for in a frame: a mean and a half-width of its births, which may be for each
/// pixel of its screen area, and of its bursts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct BirthsDue {
    pub(super) births: (f32, f32),
    pub(super) bursts: (f32, f32),
}

/// MeanParts and VarParts of the system at `frame` (Reeves 1983, 2.1); all 0 when no births are
/// due. `system` is the system as it is then.
pub(super) fn births_at(system: &System, key: u32, frame: i32) -> BirthsDue {
    let trigger = match system.trigger_frames.as_slice() {
        [] => 0,
        triggers => match triggers.iter().rev().find(|trigger| **trigger <= frame) {
            Some(trigger) => *trigger,
            None => return BirthsDue::default(),
        },
    };
    let frame_now = frame - trigger;
    let due = system
        .bursts
        .iter()
        .filter(|burst| burst.frame == frame_now);
    BirthsDue {
        births: steady_births(system, key, frame, frame_now),
        bursts: due.fold((0.0, 0.0), |(mean, var), burst| {
            (mean + burst.parts.mean, var + burst.parts.var)
        }),
    }
}

fn steady_births(system: &System, key: u32, frame: i32, frame_now: i32) -> (f32, f32) {
    let births = &system.births;
    if frame_now < system.first_frame || system.end_frame.is_some_and(|end| frame_now >= end) {
        return (0.0, 0.0);
    }
    let elapsed = (frame_now - system.first_frame) as f32;
    let polynomial = |c: [f32; 4]| c[0] + elapsed * (c[1] + elapsed * (c[2] + elapsed * c[3]));
    let changes = [
        births.delta_mean_parts,
        births.quadratic_mean_parts,
        births.cubic_mean_parts,
    ];
    let [linear, quadratic, cubic] = changes;
    let mut mean = polynomial([births.initial_mean_parts, linear, quadratic, cubic]);
    // A mean that has shrunk to nothing makes no births by its half-width alone.
    if changes.iter().any(|change| *change != 0.0) && mean <= 0.0 {
        return (0.0, 0.0);
    }
    if births.mean_parts_wander > 0.0 {
        let frames = f64::from(births.mean_parts_wander_frames);
        mean *= 1.0 + births.mean_parts_wander * wander(key, f64::from(frame), frames);
    }
    let var = polynomial([
        births.var_parts,
        births.delta_var_parts,
        births.quadratic_var_parts,
        births.cubic_var_parts,
    ]);
    (mean, var.max(0.0))
}

/// The rows of a system's transform to world space: the rotation about x by the first angle, then
/// about y by the second, then to its position.
pub(super) fn pose(system: &System) -> [[f32; 4]; 3] {
    pose_of(system.position, system.rotation_degrees)
}

/// The same of any place and angles.
pub(super) fn pose_of([x, y, z]: [f32; 3], rotation_degrees: [f32; 2]) -> [[f32; 4]; 3] {
    let [about_x, about_y] = rotation_degrees.map(|angle| angle / 360.0);
    let (sx, cx) = (sin_turns(about_x), cos_turns(about_x));
    let (sy, cy) = (sin_turns(about_y), cos_turns(about_y));
    [
        [cy, sy * sx, sy * cx, x].map(snap),
        [0.0, cx, -sx, y].map(snap),
        [-sy, cy * sx, cy * cx, z].map(snap),
    ]
}

/// Whether some system carries its particles along while it has keys.
pub(super) fn may_move(scene: &Scene) -> bool {
    let carries = |at: usize| scene.systems[at].particle_space == ParticleSpace::System;
    let mut tracks = scene.tracks.iter();
    tracks.any(|track| matches!(track.owner, Owner::System(at) if carries(at)))
}

/// A world vector in the space whose rows lead to the world: a rotation's inverse is its transpose.
fn turned_back(rows: [[f32; 4]; 3], v: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| snap(rows[0][i] * v[0] + rows[1][i] * v[1] + rows[2][i] * v[2]))
}

/// A vector of the system's in the space that the rows lead to.
fn turned_by(rows: [[f32; 4]; 3], v: [f32; 3]) -> [f32; 3] {
    rows.map(|row| snap(row[0] * v[0] + row[1] * v[1] + row[2] * v[2]))
}

/// One system at three times: now, a frame ago, and when the shutter closes.
pub(super) struct Moments<'a> {
    pub(super) now: &'a System,
    pub(super) earlier: &'a System,
    pub(super) closing: &'a System,
}

/// Everything of the system's frame but where its bounds stand.
pub(super) fn system_frame(moments: &Moments, seed: u64, frame: i32) -> SystemFrame {
    let system = moments.now;
    let key = system_key(seed, &system.name);
    let here = pose(system);
    let stays = system.particle_space == ParticleSpace::World;
    let world_from_system = if stays { IDENTITY } else { here };
    let closing = if stays {
        IDENTITY
    } else {
        pose(moments.closing)
    };
    let (system_from_birth, earlier) = if stays {
        (here, pose(moments.earlier))
    } else {
        (IDENTITY, IDENTITY)
    };
    // One that stands for others bears nobody itself.
    let due = match &system.parent {
        None => births_at(system, key, frame),
        Some(_) => BirthsDue::default(),
    };
    let [a0, a1, a2] = match system.acceleration_space {
        ParticleSpace::World => turned_back(world_from_system, system.acceleration),
        ParticleSpace::System => turned_by(system_from_birth, system.acceleration),
    };
    let flag = |set: bool, flag: u32| if set { flag } else { 0 };
    SystemFrame {
        world_from_system_x: world_from_system[0],
        world_from_system_y: world_from_system[1],
        world_from_system_z: world_from_system[2],
        closing_world_from_system_x: closing[0],
        closing_world_from_system_y: closing[1],
        closing_world_from_system_z: closing[2],
        earlier_system_from_birth_x: earlier[0],
        earlier_system_from_birth_y: earlier[1],
        earlier_system_from_birth_z: earlier[2],
        system_from_birth_x: system_from_birth[0],
        system_from_birth_y: system_from_birth[1],
        system_from_birth_z: system_from_birth[2],
        acceleration: [a0, a1, a2, snap(system.drag)],
        mean_parts: snap(due.births.0),
        var_parts: snap(due.births.1),
        burst_parts: snap(due.bursts.0),
        burst_var: snap(due.bursts.1),
        key,
        flags: flag(
            system.birth_rounding == BirthRounding::Stochastic,
            layout::SYSTEM_STOCHASTIC,
        ) | flag(
            system.births.per == BirthUnit::ScreenArea,
            layout::SYSTEM_PER_AREA,
        ) | flag(
            system.integration == Integration::Parabola,
            layout::SYSTEM_PARABOLIC,
        ) | flag(is_stroke(system), layout::SYSTEM_STILL),
        bounding_sphere: bounding_sphere(system),
        ..SystemFrame::default()
    }
}

/// The sphere around the system's generation shape, in world space.
pub(super) fn bounding_sphere(system: &System) -> [f32; 4] {
    let [x, y, z, radius] = own_bounding_sphere(system);
    let center = pose(system).map(|row| row[3] + row[0] * x + row[1] * y + row[2] * z);
    [center[0], center[1], center[2], radius].map(snap)
}

/// The sphere around the system's generation shape, in the system's space.
pub(super) fn own_bounding_sphere(system: &System) -> [f32; 4] {
    // Half of a cone's height up its axis, and a mesh's own; all other shapes are centred.
    let up = |height: f32| [0.0, 0.0, height];
    let (local, radius) = match system.generation_shape {
        GenerationShape::Sphere { radius }
        | GenerationShape::Circle { radius }
        | GenerationShape::Attractor { radius, .. } => (up(0.0), radius),
        GenerationShape::Ring { outer_radius, .. } => (up(0.0), outer_radius),
        GenerationShape::Rectangle { length, width } => {
            (up(0.0), half_diagonal([length, width, 0.0]))
        }
        GenerationShape::Box {
            length,
            width,
            height,
        } => (up(0.0), half_diagonal([length, width, height])),
        GenerationShape::Line { length } => (up(0.0), 0.5 * length),
        GenerationShape::Rings { radius, .. } => (up(-radius), radius),
        GenerationShape::Cone {
            height,
            angle_degrees,
        } => {
            let base = height * slope(angle_degrees);
            (up(0.5 * height), half_diagonal([2.0 * base, 0.0, height]))
        }
        GenerationShape::Mesh { ref mesh, scale } => {
            let (center, radius) = mesh.bounding_sphere();
            (center.map(|x| x * scale), radius * scale)
        }
    };
    let [x, y, z] = local;
    [x, y, z, radius].map(snap)
}

fn half_diagonal([x, y, z]: [f32; 3]) -> f32 {
    0.5 * (x * x + y * y + z * z).sqrt()
}

/// The tangent of an angle of at most 89 degrees.
fn slope(angle_degrees: f32) -> f32 {
    let turns = angle_degrees / 360.0;
    sin_turns(turns) / cos_turns(turns)
}

/// Where the system's particles may not be, in world space (2.4).
pub(super) fn bounds_of(system: &System) -> impl Iterator<Item = Bound> + '_ {
    let here = pose(system);
    system
        .extinctions
        .iter()
        .map(move |extinction| bound_of(extinction, here))
}

fn bound_of(extinction: &Extinction, pose: [[f32; 4]; 3]) -> Bound {
    // What is farther along `normal` than that dies.
    let beyond = |normal: Vec3, distance: f32| Bound {
        place: [normal.x, normal.y, normal.z, distance].map(snap),
        kinds: [layout::BOUND_PLANE, 1, 0, 0],
        ..Bound::default()
    };
    let side = |kills| u32::from(kills == Side::Outside);
    match *extinction {
        Extinction::Distance {
            direction,
            distance,
        } => {
            let local = normalize_exact(Vec3::from(direction));
            let world = pose.map(|row| dot3(Vec3::from_slice(&row), local));
            let normal = Vec3::from(world);
            let origin = Vec3::from(pose.map(|row| row[3]));
            beyond(normal, distance + dot3(normal, origin))
        }
        Extinction::Plane { point, normal } => {
            let back = -normalize_exact(Vec3::from(normal));
            beyond(back, dot3(back, Vec3::from(point)))
        }
        Extinction::Sphere {
            center: [x, y, z],
            radius,
            kills,
        } => Bound {
            place: [x, y, z, radius * radius].map(snap),
            kinds: [layout::BOUND_SPHERE, side(kills), 0, 0],
            ..Bound::default()
        },
        Extinction::Box { min, max, kills } => Bound {
            place: [min[0], min[1], min[2], 0.0].map(snap),
            extent: [max[0], max[1], max[2], 0.0].map(snap),
            kinds: [layout::BOUND_BOX, side(kills), 0, 0],
        },
    }
}

/// The row that newborns of the system keep for life; `system` is the system as it is then.
pub(super) fn system_row(system: &System, meshes: &MeshTables) -> SystemRow {
    let (shape, extents) = shape_of(&system.generation_shape, meshes);
    let particle = match system.particle_shape {
        ParticleShape::Sphere => layout::PARTICLE_SPHERE,
        ParticleShape::Rectangle => layout::PARTICLE_RECTANGLE,
        ParticleShape::Streak => layout::PARTICLE_STREAK,
        ParticleShape::Stroke => layout::PARTICLE_STROKE,
    };
    let streak = match system.streak_light {
        _ if is_stroke(system) => word_of(system),
        StreakLight::Conserved => layout::STREAK_CONSERVED | thrown_by(system),
        StreakLight::Constant => layout::STREAK_CONSTANT | thrown_by(system),
    };
    let with_transparency = |[red, green, blue]: [f32; 3], transparency: f32| {
        [red, green, blue, transparency].map(snap)
    };
    let (color, clear, size) = (system.color, system.transparency, system.size);
    let ejection_turns = system.ejection_angle_degrees / 360.0;
    let (lifetime_mean, lifetime_var) = match system.lifetime {
        Some(lifetime) => (lifetime.mean, lifetime.var),
        None => (UNLIMITED_FRAMES, 0.0),
    };
    SystemRow {
        shape: extents.map(snap),
        ejection_and_light: [
            cos_turns(ejection_turns),
            ejection_turns,
            system.light_distance.unwrap_or(0.0),
            size.rate_var,
        ]
        .map(snap),
        speed_and_lifetime: [
            system.speed.mean,
            system.speed.var,
            lifetime_mean,
            lifetime_var,
        ]
        .map(snap),
        size_and_threshold: [
            size.initial.mean,
            size.initial.var,
            size.rate,
            system.intensity_threshold.unwrap_or(-1.0),
        ]
        .map(snap),
        color_mean: with_transparency(color.initial.mean, clear.initial.mean),
        color_var: with_transparency(color.initial.var, clear.initial.var),
        color_rate: with_transparency(color.rate, clear.rate),
        color_rate_var: with_transparency(color.rate_var, clear.rate_var),
        kinds: [shape, particle, streak, row_flags(system)],
    }
}

/// The factor of what its particles throw on surfaces, in all bits but the lowest.
fn thrown_by(system: &System) -> u32 {
    snap(system.light).to_bits() & !layout::STREAK_CONSTANT
}

fn row_flags(system: &System) -> u32 {
    let axis = match system.ejection_axis {
        EjectionAxis::Up => 0,
        EjectionAxis::Outward => layout::ROW_OUTWARD,
        EjectionAxis::Around => layout::ROW_AROUND,
    };
    let flag = |set: bool, flag: u32| if set { flag } else { 0 };
    axis | flag(
        system.ejection_spread == EjectionSpread::Angle,
        layout::ROW_ANGLE_UNIFORM,
    ) | flag(
        system.intensity == Intensity::Luminance,
        layout::ROW_LUMINANCE,
    ) | flag(
        system.birth_moment == BirthMoment::WithinFrame,
        layout::ROW_WITHIN_FRAME,
    ) | flag(system.blend == Blend::Over, layout::ROW_OVER)
        | flag(system.shading == Shading::LitSphere, layout::ROW_LIT_SPHERE)
        | flag(system.shading == Shading::LitCloud, layout::ROW_LIT_CLOUD)
        | ((system.edge_softness * 65_535.0 + 0.5) as u32) << layout::ROW_SOFTNESS_SHIFT
}

/// The kind of a generation shape, and its extents as [`SystemRow::shape`] has them.
fn shape_of(shape: &GenerationShape, meshes: &MeshTables) -> (u32, [f32; 4]) {
    match *shape {
        GenerationShape::Sphere { radius } => (layout::SHAPE_SPHERE, [radius, 0.0, 0.0, 0.0]),
        GenerationShape::Circle { radius } => (layout::SHAPE_CIRCLE, [radius, 0.0, 0.0, 0.0]),
        GenerationShape::Rectangle { length, width } => (
            layout::SHAPE_RECTANGLE,
            [0.5 * length, 0.5 * width, 0.0, 0.0],
        ),
        GenerationShape::Ring {
            inner_radius,
            outer_radius,
        } => (layout::SHAPE_RING, [outer_radius, 0.0, 0.0, inner_radius]),
        GenerationShape::Box {
            length,
            width,
            height,
        } => (
            layout::SHAPE_BOX,
            [0.5 * length, 0.5 * width, 0.5 * height, 0.0],
        ),
        GenerationShape::Cone {
            height,
            angle_degrees,
        } => (layout::SHAPE_CONE, [0.0, 0.0, height, slope(angle_degrees)]),
        GenerationShape::Line { length } => (layout::SHAPE_LINE, [0.5 * length, 0.0, 0.0, 0.0]),
        GenerationShape::Attractor { attractor, radius } => (
            layout::SHAPE_CURVE,
            [radius, first_point(attractor) as f32, CURVE_LEN as f32, 0.0],
        ),
        GenerationShape::Rings { .. } => (layout::SHAPE_RINGS, [0.0; 4]),
        GenerationShape::Mesh { ref mesh, scale } => {
            // Every mesh of the run is stored, and its numbers are far below 2^24.
            let (first, count) = meshes.place_of(mesh).unwrap_or((0, 1));
            let extents = [scale, first as f32, count as f32, 0.0];
            (layout::SHAPE_MESH, extents)
        }
    }
}

/// A system's key: every particle's identity begins with it.
pub(super) fn system_key(seed: u64, name: &str) -> u32 {
    name_key(seed, name, KEY_TAG)
}

/// A hash of the seed and of a name; `tag` tells apart whose names they are.
pub(super) fn name_key(seed: u64, name: &str, tag: u32) -> u32 {
    // FNV-1a of the name, so that a system keeps its particles when others come before it.
    let name_hash = name.bytes().fold(0x811c_9dc5u32, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    });
    pcg4d(UVec4::new(seed as u32, (seed >> 32) as u32, name_hash, tag)).x
}
