//! Systems that bear systems (Reeves 1983, 2.6): what is known of them before any is born.

use std::f32::consts::TAU;

use super::PlanError;
use super::bounds::first_frame;
use super::system::{Moments, own_bounding_sphere, pose};
use crate::exact::{reciprocal, snap};
use crate::layout::{self, Brood, NO_SLOT, Pose, SystemRow};
use crate::scene::{BirthUnit, ChildUp, GenerationShape, ParticleSpace, Scene, System};

/// Systems that others bear, at most: those of a scene's own besides, slots are 16 bits of a particle.
const MOST_BORNE: u64 = 16_384;

/// Frames that a system without a lifetime bears: longer than any run.
const UNLIMITED_FRAMES: u32 = 65_500;

/// Index of the system's parent.
fn parent_of(systems: &[System], system: &System) -> Option<usize> {
    let name = system.parent.as_ref()?;
    systems.iter().position(|other| other.name == *name)
}

/// Index of what stands for the systems that this one bears.
fn child_of(systems: &[System], system: &System) -> Option<usize> {
    let is_child = |other: &System| other.parent.as_deref() == Some(&system.name);
    systems.iter().position(is_child)
}

/// Whether what the system bears are systems.
pub(super) fn bears_systems(systems: &[System], system: &System) -> bool {
    child_of(systems, system).is_some()
}

/// Steps from the system's root down to it.
fn level_of(systems: &[System], system: &System) -> u32 {
    parent_of(systems, system).map_or(0, |parent| 1 + level_of(systems, &systems[parent]))
}

/// Steps from roots down to the farthest systems; 0 if none bears systems.
pub(super) fn levels(scene: &Scene) -> u32 {
    let systems = &scene.systems;
    let levels = systems.iter().map(|system| level_of(systems, system));
    levels.max().unwrap_or(0)
}

/// Frames that a system born by this one bears, at most.
fn bearing_frames(systems: &[System], system: &System) -> u32 {
    let Some(parent) = parent_of(systems, system) else {
        return UNLIMITED_FRAMES;
    };
    let parent = &systems[parent];
    let life = parent.lifetime.map_or(UNLIMITED_FRAMES, |life| {
        let own = parent.inherit.lifetime;
        let most = life.mean + life.var + own.mean + own.var;
        (f64::from(most) + 0.51).floor() as u32
    });
    let end = system.end_frame.map_or(u32::MAX, |end| end.max(0) as u32);
    life.min(end).min(UNLIMITED_FRAMES)
}

/// Frames that a slot is needed after its system's last birth: as long as what it has borne can
/// live, and what that has.
fn linger_frames(systems: &[System], system: &System, lifetime_bound: u32) -> u32 {
    match child_of(systems, system) {
        None => lifetime_bound.saturating_add(1),
        Some(child) => {
            let child = &systems[child];
            let below = linger_frames(systems, child, lifetime_bound);
            bearing_frames(systems, child).saturating_add(below)
        }
    }
}

/// One a system of the scene.
pub(super) fn broods(scene: &Scene, lifetime_bound: u32) -> Vec<Brood> {
    let systems = &scene.systems;
    let brood = |system: &System| {
        let births = &system.births;
        let slot = |index: Option<usize>| index.map_or(NO_SLOT, |index| index as u32);
        let flag = |set: bool, flag: u32| if set { flag } else { 0 };
        let (ring_frames, rings) = match system.generation_shape {
            GenerationShape::Rings {
                radius,
                wall_speed,
                ring_frames,
                density,
            } => (
                ring_frames,
                [radius, wall_speed, density, reciprocal(TAU * radius)],
            ),
            _ => (0, [0.0; 4]),
        };
        let burst = system.bursts.first();
        let parent = parent_of(systems, system);
        let is_curved = |index: usize| {
            matches!(
                systems[index].generation_shape,
                GenerationShape::Rings { .. } | GenerationShape::Mesh { .. }
            )
        };
        let shrinks = [
            births.delta_mean_parts,
            births.quadratic_mean_parts,
            births.cubic_mean_parts,
        ];
        let [a0, a1, a2] = system.acceleration;
        Brood {
            ties: [
                slot(parent),
                level_of(systems, system),
                flag(
                    system.child_up == ChildUp::Outward || parent.is_some_and(is_curved),
                    layout::BROOD_OUTWARD,
                ) | flag(
                    system.particle_space == ParticleSpace::World,
                    layout::BROOD_WORLD_SPACE,
                ) | flag(
                    system.acceleration_space == ParticleSpace::System,
                    layout::BROOD_OWN_ACCELERATION,
                ) | flag(
                    shrinks.iter().any(|change| *change != 0.0),
                    layout::BROOD_SHRINKS,
                ) | flag(burst.is_some(), layout::BROOD_BURSTS),
                slot(child_of(systems, system)),
            ],
            spans: [
                system.first_frame.cast_unsigned(),
                system.end_frame.map_or(NO_SLOT, i32::cast_unsigned),
                linger_frames(systems, system, lifetime_bound),
                ring_frames,
            ],
            mean_parts: [
                births.initial_mean_parts,
                births.delta_mean_parts,
                births.quadratic_mean_parts,
                births.cubic_mean_parts,
            ]
            .map(snap),
            var_parts: [
                births.var_parts,
                births.delta_var_parts,
                births.quadratic_var_parts,
                births.cubic_var_parts,
            ]
            .map(snap),
            burst: burst.map_or([0.0; 4], |burst| {
                [burst.parts.mean, burst.parts.var, burst.frame as f32, 0.0].map(snap)
            }),
            spread: [
                system.inherit.mean_parts,
                system.inherit.var_parts,
                system.inherit.generation_scale,
                0.0,
            ]
            .map(snap),
            bounding_sphere: own_bounding_sphere(system),
            acceleration: [a0, a1, a2, system.drag].map(snap),
            rings: rings.map(snap),
        }
    };
    systems.iter().map(brood).collect()
}

/// Half-widths of what differs among the systems that this one stands for, field by field.
pub(super) fn row_spread(system: &System) -> SystemRow {
    let own = &system.inherit;
    let (color, clear, size) = (own.color, own.transparency, own.size);
    let with = |[red, green, blue]: [f32; 3], clear: f32| [red, green, blue, clear].map(snap);
    SystemRow {
        ejection_and_light: [0.0, own.ejection_angle_degrees / 360.0, 0.0, size.rate_var].map(snap),
        speed_and_lifetime: [
            own.speed.mean,
            own.speed.var,
            own.lifetime.mean,
            own.lifetime.var,
        ]
        .map(snap),
        size_and_threshold: [size.initial.mean, size.initial.var, size.rate, 0.0].map(snap),
        color_mean: with(color.initial.mean, clear.initial.mean),
        color_var: with(color.initial.var, clear.initial.var),
        color_rate: with(color.rate, clear.rate),
        color_rate_var: with(color.rate_var, clear.rate_var),
        ..SystemRow::default()
    }
}

/// Where a system of the scene is.
pub(super) fn pose_of(moments: &Moments) -> Pose {
    let [now_x, now_y, now_z] = pose(moments.now);
    let [earlier_x, earlier_y, earlier_z] = pose(moments.earlier);
    let [closing_x, closing_y, closing_z] = pose(moments.closing);
    Pose {
        now_x,
        now_y,
        now_z,
        earlier_x,
        earlier_y,
        earlier_z,
        closing_x,
        closing_y,
        closing_z,
    }
}

/// The most systems of each kind that are there at once, those that linger included.
pub(super) fn most_of_kinds(scenes: &[&Scene], lifetime_bound: u32, frame_end: u32) -> Vec<u64> {
    let mut most = vec![0; scenes[0].systems.len()];
    let frames = (i64::from(frame_end) - i64::from(first_frame(scenes))).max(1) as u64;
    for scene in scenes {
        let greatest = scene.greatest();
        let systems = &greatest.systems;
        for (at, system) in systems.iter().enumerate() {
            let parents = parents_at_once(systems, system, lifetime_bound, frames);
            most[at] = most[at].max(parents);
        }
    }
    most
}

/// The most systems like this one at once; 1 if it has no parent.
fn parents_at_once(systems: &[System], system: &System, lifetime_bound: u32, frames: u64) -> u64 {
    let Some(parent) = parent_of(systems, system) else {
        return 1;
    };
    let parent = &systems[parent];
    let of_parent = parents_at_once(systems, parent, lifetime_bound, frames);
    let stay = u64::from(bearing_frames(systems, system))
        + u64::from(linger_frames(systems, system, lifetime_bound));
    let bearing = match parent.end_frame {
        Some(end) => u64::from((end - parent.first_frame).max(0).cast_unsigned()),
        None => frames,
    };
    let bearing = bearing
        .min(u64::from(bearing_frames(systems, parent)))
        .min(frames);
    let births = &parent.births;
    let own = &parent.inherit;
    let coefficients = [
        births.initial_mean_parts + births.var_parts + own.mean_parts + own.var_parts,
        births.delta_mean_parts.max(0.0) + births.delta_var_parts.max(0.0),
        births.quadratic_mean_parts.max(0.0) + births.quadratic_var_parts.max(0.0),
        births.cubic_mean_parts.max(0.0) + births.cubic_var_parts.max(0.0),
    ]
    .map(f64::from);
    let last = bearing.saturating_sub(1) as f64;
    let [c0, c1, c2, c3] = coefficients;
    let mut a_frame = c0 + last * (c1 + last * (c2 + last * c3));
    a_frame *= 1.0 + f64::from(births.mean_parts_wander);
    if births.per == BirthUnit::ScreenArea {
        // No picture is larger.
        a_frame *= 8_847_360.0;
    }
    let steady = if a_frame > 0.0 {
        a_frame.ceil() + 1.0
    } else {
        0.0
    };
    let triggers = parent.trigger_frames.len().max(1) as f64;
    let bursts: f64 = parent
        .bursts
        .iter()
        .map(|burst| f64::from(burst.parts.mean + burst.parts.var).ceil() + 1.0)
        .sum();
    let rings = match parent.generation_shape {
        GenerationShape::Rings {
            radius,
            wall_speed,
            ring_frames,
            density,
        } => {
            let [radius, speed, density] = [radius, wall_speed, density].map(f64::from);
            let circumference = |frame: u64| {
                let angle = frame as f64 * speed / radius;
                if angle > std::f64::consts::PI + 0.01 {
                    return 0.0;
                }
                (density * std::f64::consts::TAU * radius * angle.sin().max(0.0) + 1.0).floor()
            };
            let all = (0..bearing)
                .step_by(ring_frames as usize)
                .map(circumference);
            let all: Vec<f64> = all.collect();
            let window = (stay / u64::from(ring_frames) + 1) as usize;
            let window = window.min(all.len()).max(1);
            let sums = all.windows(window).map(|window| window.iter().sum::<f64>());
            sums.fold(0.0, f64::max)
        }
        _ => 0.0,
    };
    let stay_frames = bearing.min(stay) as f64;
    let each = steady * stay_frames + bursts * triggers + rings;
    of_parent.saturating_mul(each.min(1e15) as u64)
}

/// Slots for systems that others bear.
pub(super) fn capacity(scene: &Scene, most_of_kinds: &[u64]) -> Result<u32, PlanError> {
    if levels(scene) == 0 {
        return Ok(0);
    }
    if let Some(most) = scene.max_systems {
        return Ok(most);
    }
    let kinds = scene.systems.iter().zip(most_of_kinds);
    let borne = kinds.filter(|(system, _)| system.parent.is_some());
    let most = borne.fold(0u64, |sum, (_, most)| sum.saturating_add(*most));
    if most > MOST_BORNE {
        return Err(PlanError {
            message: format!(
                "this scene's systems can bear {most} systems that are there at once, more than \
                 {MOST_BORNE}"
            ),
            help:
                "give the scene `max_systems = N`, the most at once; births beyond it are left out \
                   and counted as dropped"
                    .into(),
            key: None,
        });
    }
    Ok((most as u32).max(1))
}

/// The most particles that all systems of a kind can ask for in a frame: what a borne system asks
/// for at most, times how many there can be.
pub(super) fn births_bound(scene: &Scene, most_of_kinds: &[u64]) -> u64 {
    let systems = &scene.systems;
    let pixels = f64::from(scene.image.width) * f64::from(scene.image.height);
    let of_kind = |(system, most): (&System, &u64)| {
        if system.parent.is_none() || bears_systems(systems, system) {
            return 0u64;
        }
        let births = &system.births;
        let last = f64::from(bearing_frames(systems, system));
        let up = |a: f32, b: f32| f64::from(a.max(0.0)) + f64::from(b.max(0.0));
        let mean = up(births.initial_mean_parts, births.var_parts)
            + f64::from(system.inherit.mean_parts)
            + f64::from(system.inherit.var_parts)
            + last
                * (up(births.delta_mean_parts, births.delta_var_parts)
                    + last
                        * (up(births.quadratic_mean_parts, births.quadratic_var_parts)
                            + last * up(births.cubic_mean_parts, births.cubic_var_parts)));
        let unit = match births.per {
            BirthUnit::Frame => 1.0,
            BirthUnit::ScreenArea => pixels,
        };
        let bursts: f64 = system
            .bursts
            .iter()
            .map(|burst| f64::from(burst.parts.mean + burst.parts.var))
            .sum();
        let wanted = mean * unit + bursts;
        if wanted <= 0.0 {
            return 0;
        }
        let each = (wanted.ceil() as u64).saturating_add(1).min(1 << 24);
        each.saturating_mul(*most)
    };
    let kinds = systems.iter().zip(most_of_kinds);
    kinds.map(of_kind).fold(0, u64::saturating_add)
}

/// Rings are of systems.
pub(super) fn check_rings(scene: &Scene) -> Result<(), PlanError> {
    let systems = &scene.systems;
    let is_bare = |system: &&System| {
        matches!(system.generation_shape, GenerationShape::Rings { .. })
            && !bears_systems(systems, system)
    };
    match systems.iter().find(is_bare) {
        None => Ok(()),
        Some(system) => Err(PlanError {
            message: format!(
                "`system.{}` is of rings, and no system has it as its parent",
                system.name
            ),
            help: "a system with it as its `parent`, or another `generation_shape`".into(),
            key: Some(format!("system.{}.generation_shape", system.name)),
        }),
    }
}
