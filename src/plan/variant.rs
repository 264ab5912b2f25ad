//! One state of a scene's parameters, in the form that frames take them.

use glam::{UVec4, Vec3};

use super::area::screen_area_px;
use crate::exact::{cross3, dot3, normalize_exact, snap};
use crate::layout::{self, Frame, SystemFrame, SystemRow};
use crate::rng::pcg4d;
use crate::scene::{
    BirthRounding, BirthUnit, Births, Camera, GenerationShape, Image, ParticleShape, Scene,
    StreakLight, System,
};
use crate::transcendental::{cos_turns, sin_turns};

/// Marks hashes that make system keys, so that no particle draw equals one by construction.
const KEY_TAG: u32 = 0x6b65_7973;

/// The scene's parameters from `first_frame` on.
#[derive(Clone, Debug)]
pub(super) struct Variant {
    pub(super) first_frame: u32,
    pub(super) frame: Frame,
    pub(super) systems: Vec<PlannedSystem>,
}

/// One system's parameters.
#[derive(Clone, Debug)]
pub(super) struct PlannedSystem {
    pub(super) row: SystemRow,
    /// All but the births.
    pub(super) frame_values: SystemFrame,
    pub(super) births: Births,
    pub(super) first_frame: u32,
    pub(super) end_frame: Option<u32>,
    /// What `births` are multiplied by: 1, or the system's screen area in pixels.
    pub(super) births_scale: f32,
}

impl PlannedSystem {
    /// MeanParts and VarParts at `frame` (Reeves 1983, 2.1); both 0 when no births are due.
    pub(super) fn births_at(&self, frame: u32) -> (f32, f32) {
        if frame < self.first_frame || self.end_frame.is_some_and(|end| frame >= end) {
            return (0.0, 0.0);
        }
        let elapsed = (frame - self.first_frame) as f32;
        let mean = self.births.initial_mean_parts + self.births.delta_mean_parts * elapsed;
        // A mean that has shrunk to nothing stays there: its half-width alone makes no births.
        if self.births.delta_mean_parts < 0.0 && mean <= 0.0 {
            return (0.0, 0.0);
        }
        (mean, self.births.var_parts)
    }
}

impl Variant {
    pub(super) fn new(first_frame: u32, scene: &Scene) -> Self {
        let frame = camera_frame(&scene.camera, &scene.image);
        Self {
            first_frame,
            frame,
            systems: scene
                .systems
                .iter()
                .map(|system| planned_system(system, scene.seed, &frame))
                .collect(),
        }
    }
}

fn camera_frame(camera: &Camera, image: &Image) -> Frame {
    let position = Vec3::from(camera.position);
    let forward = normalize_exact(Vec3::from(camera.target) - position);
    let right = normalize_exact(cross3(forward, normalize_exact(Vec3::from(camera.up))));
    let up = cross3(right, forward);
    let row = |axis: Vec3| [axis.x, axis.y, axis.z, -dot3(axis, position)].map(snap);
    let half_turns = camera.vertical_fov_degrees / 720.0;
    let cotangent = cos_turns(half_turns) / sin_turns(half_turns);
    let [red, green, blue] = image.background;
    Frame {
        view_from_world_x: row(right),
        view_from_world_y: row(up),
        view_from_world_z: row(forward),
        background: [red, green, blue, 0.0].map(snap),
        focal_px: 0.5 * image.height as f32 * cotangent,
        center_x_px: 0.5 * image.width as f32,
        center_y_px: 0.5 * image.height as f32,
        near: camera.near,
        shutter: snap(image.shutter),
        ..Frame::default()
    }
}

/// The columns of the rotation about x by the first angle, then about y by the second.
fn rotation_columns(degrees: [f32; 2]) -> [[f32; 3]; 3] {
    let [about_x, about_y] = degrees.map(|angle| angle / 360.0);
    let (sx, cx) = (sin_turns(about_x), cos_turns(about_x));
    let (sy, cy) = (sin_turns(about_y), cos_turns(about_y));
    [
        [cy, 0.0, -sy],
        [sy * sx, cx, cy * sx],
        [sy * cx, -sx, cy * cx],
    ]
}

fn planned_system(system: &System, seed: u64, frame: &Frame) -> PlannedSystem {
    let columns = rotation_columns(system.rotation_degrees);
    let row = |i: usize| {
        [
            columns[0][i],
            columns[1][i],
            columns[2][i],
            system.position[i],
        ]
        .map(snap)
    };
    // The inverse of a rotation is its transpose: a column's product with the world vector.
    let [ax, ay, az] = system.acceleration;
    let [a0, a1, a2] = columns.map(|[x, y, z]| snap(x * ax + y * ay + z * az));
    let frame_values = SystemFrame {
        world_from_system_x: row(0),
        world_from_system_y: row(1),
        world_from_system_z: row(2),
        acceleration: [a0, a1, a2, 0.0],
        key: system_key(seed, &system.name),
        stochastic_rounding: u32::from(system.birth_rounding == BirthRounding::Stochastic),
        ..SystemFrame::default()
    };
    PlannedSystem {
        row: system_row(system),
        frame_values,
        births: system.births,
        first_frame: system.first_frame,
        end_frame: system.end_frame,
        // Neither camera nor system moves before the next variant.
        births_scale: match system.births.per {
            BirthUnit::Frame => 1.0,
            BirthUnit::ScreenArea => {
                let radius = bounding_radius(system.generation_shape);
                screen_area_px(frame, frame_values, radius)
            }
        },
    }
}

/// Radius of the generation shape about the system's origin, world units.
fn bounding_radius(shape: GenerationShape) -> f32 {
    match shape {
        GenerationShape::Sphere { radius } | GenerationShape::Circle { radius } => radius,
        GenerationShape::Rectangle { length, width } => {
            0.5 * (length * length + width * width).sqrt()
        }
    }
}

fn system_row(system: &System) -> SystemRow {
    let (shape, extents) = match system.generation_shape {
        GenerationShape::Sphere { radius } => (layout::SHAPE_SPHERE, [radius, 0.0, 0.0]),
        GenerationShape::Circle { radius } => (layout::SHAPE_CIRCLE, [radius, 0.0, 0.0]),
        GenerationShape::Rectangle { length, width } => {
            (layout::SHAPE_RECTANGLE, [0.5 * length, 0.5 * width, 0.0])
        }
    };
    let particle = match system.particle_shape {
        ParticleShape::Sphere => layout::PARTICLE_SPHERE,
        ParticleShape::Rectangle => layout::PARTICLE_RECTANGLE,
        ParticleShape::Streak => layout::PARTICLE_STREAK,
    };
    let streak = match system.streak_light {
        StreakLight::Conserved => layout::STREAK_CONSERVED,
        StreakLight::Constant => layout::STREAK_CONSTANT,
    };
    let with_transparency = |[red, green, blue]: [f32; 3], transparency: f32| {
        [red, green, blue, transparency].map(snap)
    };
    let (color, clear, size) = (system.color, system.transparency, system.size);
    SystemRow {
        shape: [
            extents[0],
            extents[1],
            extents[2],
            cos_turns(system.ejection_angle_degrees / 360.0),
        ]
        .map(snap),
        speed_and_lifetime: [
            system.speed.mean,
            system.speed.var,
            system.lifetime.mean,
            system.lifetime.var,
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
        kinds: [shape, particle, streak, 0],
    }
}

/// A system's key: every particle's identity begins with it.
fn system_key(seed: u64, name: &str) -> u32 {
    // FNV-1a of the name, so that a system keeps its particles when others come before it.
    let name_hash = name.bytes().fold(0x811c_9dc5u32, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    });
    pcg4d(UVec4::new(
        seed as u32,
        (seed >> 32) as u32,
        name_hash,
        KEY_TAG,
    ))
    .x
}
