//! A fire's part of a frame: where its flames stand, what moves and colours them.

use glam::{UVec4, Vec3};

use super::Plan;
use super::blackbody::blackbody;
use super::lights;
use super::meshes::MeshTables;
use super::system::{name_key, pose_of};
use crate::exact::{normalize_exact, snap};
use crate::layout::{self, AgeLook, FLAME_STEPS, FireFrame};
use crate::noise::PERIOD;
use crate::rng::pcg4d;
use crate::scene::{Fire, FlameForm, Profile, RampStop, Roots, Scene};
use crate::transcendental::sin_turns;

/// Marks hashes that make fires' keys.
const FIRE_TAG: u32 = 0x6669_7265;

/// Marks the hash that makes the key of the noise that all flames bend in.
const NOISE_TAG: u32 = 0x666c_6d65;

/// Steps from the root to the tip.
const STEPS_UP: f32 = (FLAME_STEPS - 1) as f32;

/// How wide a line along a flame is, as a share of the flame's width.
const LINE_WIDTH: f32 = 0.12;

/// The coolest that glows.
const LEAST_KELVIN: f32 = 1000.0;

/// All that is known of the fires in one frame: the fires, the flames told one by one, and looks by
/// age, [`FLAME_STEPS`] for each fire.
type Fires = (Vec<FireFrame>, Vec<layout::ListedFlame>, Vec<AgeLook>);

/// The fires of a frame; `now` and `earlier` are the scene as it is then, and as it was a frame ago.
pub(super) fn fires_of(now: &Scene, earlier: &Scene, meshes: &MeshTables, frame: i32) -> Fires {
    let mut fires = Vec::new();
    let mut listed = Vec::new();
    let mut looks = Vec::new();
    let (mut first, mut first_light) = (0, 0);
    for (fire, before) in now.fires.iter().zip(&earlier.fires) {
        let members = [
            first,
            fire.count(),
            listed.len() as u32,
            fire.listed.len() as u32,
        ];
        let mut of_fire: Vec<AgeLook> = (0..FLAME_STEPS).map(|age| look_at(fire, age)).collect();
        let lights = lights::ages_of(fire, first_light);
        first_light += lights[1];
        let light = lights::light_of(fire, &of_fire, meshes);
        if fire.form == FlameForm::Line {
            // Surfaces are lit as by the flames that lines stand for.
            for look in &mut of_fire {
                look.scale[0] = snap(LINE_WIDTH);
            }
        }
        fires.push(FireFrame {
            members,
            lights,
            light: light.color,
            light_scale: light.scale,
            ..fire_frame(fire, before, meshes, now.seed, frame)
        });
        first += fire.count();
        listed.extend(fire.listed.iter().map(listed_flame));
        looks.extend(of_fire);
    }
    (fires, listed, looks)
}

fn fire_frame(
    fire: &Fire,
    earlier: &Fire,
    meshes: &MeshTables,
    seed: u64,
    frame: i32,
) -> FireFrame {
    let here = pose_of(fire.position, fire.rotation_degrees);
    let before = pose_of(earlier.position, earlier.rotation_degrees);
    let (kind, extent) = match fire.roots {
        Roots::Listed => (layout::ROOTS_LISTED, 0.0),
        Roots::Line { length, .. } => (layout::ROOTS_LINE, length),
        Roots::Circle { radius, .. } => (layout::ROOTS_CIRCLE, radius),
        Roots::Disc { radius, .. } => (layout::ROOTS_DISC, radius),
        Roots::Mesh { scale, .. } => (layout::ROOTS_MESH, scale),
    };
    let faces = match &fire.roots {
        Roots::Mesh { mesh, .. } => meshes.place_of(mesh).unwrap_or((0, 1)),
        _ => (0, 0),
    };
    let up = normalize_exact(-Vec3::from(fire.gravity));
    // Disturbances rise: the places looked at sink through the noise (3.2.3).
    let sunk = (f64::from(fire.sampling) * f64::from(frame)) % PERIOD;
    let offset = up * -(sunk as f32);
    let is_strip = fire.form != FlameForm::Particles;
    // A line has no texture.
    let texture = f32::from(u8::from(fire.form != FlameForm::Line));
    let flag = |is_set: bool, flag: u32| if is_set { flag } else { 0 };
    let flags = flag(fire.normalised, layout::FIRE_NORMALISED) | flag(is_strip, layout::FIRE_STRIP);
    let burning = fire.burning;
    let (char_look, char_shape) = char_of(fire);
    let (smoke_look, smoke_shape) = smoke_of(fire);
    FireFrame {
        world_from_fire_x: here[0],
        world_from_fire_y: here[1],
        world_from_fire_z: here[2],
        earlier_world_from_fire_x: before[0],
        earlier_world_from_fire_y: before[1],
        earlier_world_from_fire_z: before[2],
        roots: [extent, 1.0 / fire.roots.count().max(1) as f32, 0.0, 0.0].map(snap),
        extents: [
            fire.height.mean,
            fire.height.var,
            fire.width.mean,
            fire.width.var,
        ]
        .map(snap),
        rise: [up.x, up.y, up.z, fire.buoyancy].map(snap),
        noise: [offset.x, offset.y, offset.z, fire.inverse_cohesion].map(snap),
        motion: [
            fire.noisiness * STEPS_UP,
            fire.wind_factor,
            if fire.normalised {
                1.0
            } else {
                fire.start_speed
            },
            unit_step(fire),
        ]
        .map(snap),
        look: [
            fire.brightness,
            texture * fire.color_noise * STEPS_UP,
            fire.color_noise_scale,
            0.0,
        ]
        .map(snap),
        inner: [fire.inner_alpha, 1.0 / fire.inner_radius, 0.0, 0.0].map(snap),
        kinds: [
            kind,
            name_key(seed, &fire.name, FIRE_TAG),
            noise_key(seed),
            flags,
        ],
        members: [0; 4],
        faces: [faces.0, faces.1, u32::from(fire.spread.is_some()), 0],
        times: [
            burning.first_frame.cast_unsigned(),
            burning.kindling_frames,
            burning.lifetime.unwrap_or(0),
            burning.growth_frames,
        ],
        details: [
            fire.details as f32,
            fire.detail_spread,
            fire.detail_alpha,
            0.0,
        ]
        .map(snap),
        matrix_x: column(&fire.particle_matrix, 0),
        matrix_y: column(&fire.particle_matrix, 1),
        matrix_center: column(&fire.particle_matrix, 3),
        strip: [
            0.5 * fire.strip_cells[0],
            fire.strip_cells[1] / STEPS_UP,
            texture * fire.strip_contrast,
            fire.matrix_noise,
        ]
        .map(snap),
        char_look,
        char_shape,
        smoke_look,
        smoke_shape,
        light: [0.0; 4],
        light_scale: [0.0; 4],
        lights: [0; 4],
    }
}

/// A column of a matrix of four rows.
fn column(rows: &[f32; 16], at: usize) -> [f32; 4] {
    [0, 4, 8, 12].map(|row| snap(rows[row + at]))
}

/// [`FireFrame::char_look`] and [`FireFrame::char_shape`].
fn char_of(fire: &Fire) -> ([f32; 4], [f32; 4]) {
    let left = fire.spread.as_ref().and_then(|spread| spread.char);
    left.map_or(([0.0; 4], [0.0; 4]), |char| {
        let [red, green, blue] = char.glow;
        let shape = [
            char.size.unwrap_or(fire.width.mean),
            char.edge_softness,
            1.0 / char.glow_frames,
            1.0 / char.appear_frames,
        ];
        let look = [red, green, blue, char.opacity];
        (look.map(snap), shape.map(snap))
    })
}

/// [`FireFrame::smoke_look`] and [`FireFrame::smoke_shape`].
fn smoke_of(fire: &Fire) -> ([f32; 4], [f32; 4]) {
    let left = fire.spread.as_ref().and_then(|spread| spread.smoke);
    left.map_or(([0.0; 4], [0.0; 4]), |smoke| {
        let [red, green, blue] = smoke.color;
        let shape = [
            smoke.size,
            smoke.growth - 1.0,
            1.0 / smoke.frames,
            smoke.speed,
        ];
        let look = [red, green, blue, smoke.opacity];
        (look.map(snap), shape.map(snap))
    })
}

/// One noise for all fires, so that flames of several move together where they are near.
pub(super) fn noise_key(seed: u64) -> u32 {
    pcg4d(UVec4::new(seed as u32, (seed >> 32) as u32, 0, NOISE_TAG)).x
}

/// How far a speed of 1 goes in a step, as a share of the height: so far that a flame which starts
/// upward in still air is as high as it should be. In steps of one length that is a 24th.
fn unit_step(fire: &Fire) -> f32 {
    if fire.normalised {
        return 1.0 / STEPS_UP;
    }
    // The sum of the speeds s, s + k, s + 2 k and so on.
    let sum = STEPS_UP * fire.start_speed + 0.5 * STEPS_UP * (STEPS_UP - 1.0) * fire.buoyancy;
    if sum > 1.0 { 1.0 / sum } else { 1.0 / STEPS_UP }
}

fn listed_flame(flame: &crate::scene::ListedFlame) -> layout::ListedFlame {
    let with = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w].map(snap);
    let normal = normalize_exact(Vec3::from(flame.normal));
    let own = u32::from(flame.first_frame.is_some()) * layout::LISTED_FIRST_FRAME;
    layout::ListedFlame {
        position: with(flame.position, flame.height.unwrap_or(-1.0)),
        normal: with(normal.into(), flame.width.unwrap_or(-1.0)),
        look: [flame.brightness, 0.0, 0.0, 0.0].map(snap),
        kinds: [flame.first_frame.unwrap_or(0).cast_unsigned(), own, 0, 0],
    }
}

/// The look at an age: xfac = 0.67 + 0.4 sin(pi age/24), the height linear (3.2.2, footnote 1).
fn look_at(fire: &Fire, age: u32) -> AgeLook {
    let share = age as f32 / STEPS_UP;
    let (width, height) = scale_at(&fire.profile, age);
    let mut stop = stop_at(&fire.ramp, share);
    if let Some([root, tip]) = fire.blackbody {
        let kelvin = root + (tip - root) * share;
        stop.center = blackbody(kelvin);
        stop.rim = blackbody((kelvin * fire.blackbody_rim).max(LEAST_KELVIN));
    }
    let with = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w].map(snap);
    AgeLook {
        center: with(stop.center, stop.alpha),
        rim: with(stop.rim, stop.rim_alpha),
        scale: [width, height, 0.0, 0.0].map(snap),
    }
}

/// How wide and how high a disc is at an age.
fn scale_at(profile: &Profile, age: u32) -> (f32, f32) {
    let share = age as f32 / STEPS_UP;
    let stops = &profile.stops;
    let after = stops.partition_point(|stop| stop.age <= share);
    let before = after.checked_sub(1).and_then(|at| stops.get(at));
    match (before, stops.get(after)) {
        (None, None) => (
            profile.base_width + profile.swell * sin_turns(0.5 * share),
            profile.base_height + profile.height_growth * age as f32,
        ),
        (Some(end), None) | (None, Some(end)) => (end.width, end.height),
        (Some(low), Some(high)) => {
            let part = (share - low.age) / (high.age - low.age);
            let mix = |a: f32, b: f32| a + (b - a) * part;
            (mix(low.width, high.width), mix(low.height, high.height))
        }
    }
}

/// The ramp at a share of the trajectory: linear between stops, and as at the ends beyond them.
fn stop_at(ramp: &[RampStop], age: f32) -> RampStop {
    let after = ramp.partition_point(|stop| stop.age <= age);
    let (Some(low), Some(high)) = (
        after.checked_sub(1).and_then(|at| ramp.get(at)),
        ramp.get(after),
    ) else {
        let end = if after == 0 {
            ramp.first()
        } else {
            ramp.last()
        };
        return *end.expect("a ramp has a stop");
    };
    let share = (age - low.age) / (high.age - low.age);
    let mix = |a: f32, b: f32| a + (b - a) * share;
    let mixed = |a: [f32; 3], b: [f32; 3]| [0, 1, 2].map(|i| mix(a[i], b[i]));
    RampStop {
        age,
        center: mixed(low.center, high.center),
        rim: mixed(low.rim, high.rim),
        alpha: mix(low.alpha, high.alpha),
        rim_alpha: mix(low.rim_alpha, high.rim_alpha),
    }
}

/// Passes of details: in each octave twice as many as in the one before.
pub(super) fn detail_passes(scene: &Scene) -> u32 {
    let octaves = scene.fires.iter().map(|fire| fire.details).max();
    (2 << octaves.unwrap_or(0)) - 2
}

/// A pass over all flames: octave 0 is that of the particles on their ways.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DetailPass {
    /// Which octave: particles are 2^octave times smaller.
    pub octave: u32,
    /// Which of its 2^octave passes.
    pub copy: u32,
}

impl DetailPass {
    /// The pass at that place among those of details.
    pub fn nth(at: u32) -> Self {
        let octave = (at + 2).ilog2();
        Self {
            octave,
            copy: at + 2 - (1 << octave),
        }
    }
}

impl Plan {
    /// How many flames each fire has.
    pub fn flame_counts(&self) -> impl Iterator<Item = u32> + '_ {
        let (_, scene) = &self.variants[0];
        scene.fires.iter().map(Fire::count)
    }

    /// How many flames begin in a frame, end in it, and burn in it. A run begins with those that
    /// burn in its first frame.
    pub fn flames_at(&self, frame: i32) -> [u32; 3] {
        let mut counts = [0; 3];
        for fire in &self.scene_at(frame).fires {
            for index in 0..fire.count() {
                let age = i64::from(frame) - i64::from(fire.birth_frame(index));
                let lifetime = fire.burning.lifetime.map_or(i64::MAX, i64::from);
                let begins = age == 0 || (frame == self.first_frame && age >= 0);
                counts[0] += u32::from(begins && age < lifetime);
                counts[1] += u32::from(age == lifetime && frame > self.first_frame);
                counts[2] += u32::from((0..lifetime).contains(&age));
            }
        }
        counts
    }
}
