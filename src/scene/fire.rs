//! Fires (Perry 1994, chapter 3.2): roots that flames stand on, and what their flames are.

use std::sync::Arc;

use super::{FireSpread, Spread};
use crate::mesh::Mesh;

/// Flames of one kind, each the whole trajectory of one particle, as a long exposure has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fire {
    /// Unique name among fires; its hash is part of every flame's identity. As that of a
    /// [`System`](super::System).
    pub name: String,
    /// Origin, world space, each -1,000,000 ..= 1,000,000. Default 0.
    pub position: [f32; 3],
    /// Two angles of rotation: first about x, then about y. Each -36,000 ..= 36,000. Default 0.
    pub rotation_degrees: [f32; 2],
    /// Where its flames stand, besides those listed.
    pub roots: Roots,
    /// Flames that are told one by one, at most 1,024.
    pub listed: Vec<ListedFlame>,
    /// How high a flame is in still air, 0.000001 ..= 10,000 world units. Default 1.
    pub height: Spread<f32>,
    /// How wide its particle's disc of scale 1 is, 0.000001 ..= 10,000 world units. Default 0.25.
    pub width: Spread<f32>,
    /// How discs are scaled by age.
    pub profile: Profile,
    /// Speed at first, along the normal, in steps, 0 ..= 10,000. Default 1.
    pub start_speed: f32,
    /// Whether velocities are brought to length 1 in each step. Default yes.
    pub normalised: bool,
    /// k_g, what gravity makes of the air of a flame, -10,000 ..= 10,000. Default 1.
    pub buoyancy: f32,
    /// The way gravity pulls; not zero. Default down.
    pub gravity: [f32; 3],
    /// C, how far noise bends a flame, 0 ..= 1,000. Default 0.04.
    pub noisiness: f32,
    /// k_s, noise cells a frame that disturbances rise, -1,000 ..= 1,000. Default 0.05.
    pub sampling: f32,
    /// k_p, noise cells a world unit, 0 ..= 10,000. Default 1.
    pub inverse_cohesion: f32,
    /// What the scene's wind counts against `buoyancy`, a world unit a frame, 0 ..= 10,000.
    /// Default 1.
    pub wind_factor: f32,
    /// Factor of all its light, 0 ..= 1,000. Default 1.
    pub brightness: f32,
    /// C_noise, how far noise moves a particle along the colours, as a share of them, 0 ..= 10.
    /// Default 0.
    pub color_noise: f32,
    /// Cells of that noise a world unit, 0 ..= 10,000. Default 4.
    pub color_noise_scale: f32,
    /// Radius of a second layer of triangles, as a share of the first's, 0.01 ..= 1. Default 0.5.
    pub inner_radius: f32,
    /// Opacity of that layer's centre, as a factor of the first's, 0 ..= 100. Default 0.
    pub inner_alpha: f32,
    /// Octaves of smaller particles beside its flames, 0 ..= 4. Default 0.
    pub details: u32,
    /// How far noise carries them off, as a share of the width, 0 ..= 100. Default 1.
    pub detail_spread: f32,
    /// Their opacity as a factor, 0 ..= 100. Default 0.5.
    pub detail_alpha: f32,
    /// What is drawn along each flame. Default its particles.
    pub form: FlameForm,
    /// Noise cells over a strip's width and along it, each 0 ..= 1,000. Default 2 and 5.
    pub strip_cells: [f32; 2],
    /// How much of a strip noise takes away, 0 ..= 10. Default 0.6.
    pub strip_contrast: f32,
    /// Rows of the matrix that each particle is multiplied by after it faces the viewer, each
    /// -100 ..= 100; not singular. Default that which changes nothing.
    pub particle_matrix: [f32; 16],
    /// How far noise at a particle changes its matrix, 0 ..= 10. Default 0.
    pub matrix_noise: f32,
    /// What it throws on surfaces.
    pub lights: FireLights,
    /// Colours by age, in ascending order of ages, 1 to 16.
    pub ramp: Vec<RampStop>,
    /// Temperatures at root and tip in kelvin, 1,000 ..= 20,000 each, whose colours stand for those of
    /// the ramp.
    pub blackbody: Option<[f32; 2]>,
    /// The temperature of a particle's rim, as a share, 0.1 ..= 1. Default 0.8.
    pub blackbody_rim: f32,
    /// When its flames burn.
    pub burning: Burning,
    /// How it spreads over a mesh, if it does.
    pub spread: Option<FireSpread>,
}

/// What is drawn along a flame (Perry 1994, 3.2.2 and 4.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlameForm {
    /// The particle at each of its 25 places.
    Particles,
    /// A strip through them, textured by a slice through noise.
    Strip,
    /// A line through them: a narrow strip with no texture (4.7).
    Line,
}

/// The light of a fire's flames on surfaces (Perry 1994, 3.2.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FireLights {
    /// Factor of it, 0 ..= 1,000,000. Default 1: what the flames send to the picture.
    pub gain: f32,
    /// Point lights that stand for all flames, 0 ..= 64. Default 1.
    pub count: u32,
    /// Where a flame's light is. Default the mean of its places.
    pub from: LightFrom,
}

/// Where a flame's light is (Perry 1994, 3.2.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightFrom {
    /// At the mean of its 25 places.
    Mean,
    /// At that of age 12.
    Middle,
    /// At the last.
    Tip,
}

/// Where flames stand, in the fire's space.
#[derive(Clone, Debug, PartialEq)]
pub enum Roots {
    /// Only where they are listed.
    Listed,
    /// Evenly along the x axis, its middle at the origin; normals are y.
    Line {
        /// World units.
        length: f32,
        /// How many.
        count: u32,
    },
    /// Evenly on a circle around the y axis; normals are y.
    Circle {
        /// World units.
        radius: f32,
        /// How many.
        count: u32,
    },
    /// Anywhere in a disc around the y axis, each place as likely; normals are y.
    Disc {
        /// World units.
        radius: f32,
        /// How many.
        count: u32,
    },
    /// Anywhere on the faces of a mesh, each place as likely; normals are those of faces.
    Mesh {
        /// The mesh.
        mesh: Arc<Mesh>,
        /// World units a unit of the mesh.
        scale: f32,
        /// How many.
        count: u32,
    },
}

impl Roots {
    /// How many flames stand there.
    pub fn count(&self) -> u32 {
        match *self {
            Self::Listed => 0,
            Self::Line { count, .. }
            | Self::Circle { count, .. }
            | Self::Disc { count, .. }
            | Self::Mesh { count, .. } => count,
        }
    }

    /// Makes them so many, if any stand there.
    pub fn set_count(&mut self, wanted: u32) {
        match self {
            Self::Listed => {}
            Self::Line { count, .. }
            | Self::Circle { count, .. }
            | Self::Disc { count, .. }
            | Self::Mesh { count, .. } => *count = wanted,
        }
    }

    /// Makes them so many times as many, at least one.
    pub fn scale(&mut self, share: f64) {
        self.set_count(((f64::from(self.count()) * share) as u32).max(1));
    }
}

/// A flame that is told by itself (Perry 1994, 1.2: control of single flames).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ListedFlame {
    /// Its root in the fire's space, world units.
    pub position: [f32; 3],
    /// The way it leaves, in the fire's space; not zero. Default y.
    pub normal: [f32; 3],
    /// As [`Fire::height`], of this flame.
    pub height: Option<f32>,
    /// As [`Fire::width`], of this flame.
    pub width: Option<f32>,
    /// Factor of its light besides the fire's. Default 1.
    pub brightness: f32,
    /// As [`Burning::first_frame`], of this flame.
    pub first_frame: Option<i32>,
}

/// How a flame's discs are scaled by age, 0 to 24 (Perry 1994, 3.2.2, footnote 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The width at both ends, 0 ..= 100. Default 0.67.
    pub base_width: f32,
    /// What a half sine adds to it, 0 ..= 100. Default 0.4.
    pub swell: f32,
    /// The height at age 0, 0.001 ..= 100. Default 0.3.
    pub base_height: f32,
    /// What each step adds to it, 0 ..= 10. Default 0.032.
    pub height_growth: f32,
    /// Scales by age that count instead, in ascending order of ages, at most 16. Default none.
    pub stops: Vec<ProfileStop>,
}

/// How a flame's disc is scaled at an age (Perry 1994, 3.2.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileStop {
    /// Share of the trajectory, 0 ..= 1.
    pub age: f32,
    /// The width, 0 ..= 100.
    pub width: f32,
    /// The height, 0.001 ..= 100.
    pub height: f32,
}

/// What a particle's disc looks like at an age.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RampStop {
    /// Share of the trajectory, 0 ..= 1.
    pub age: f32,
    /// Red, green, blue of the centre, each 0 ..= 1,000.
    pub center: [f32; 3],
    /// Red, green, blue of the rim, each 0 ..= 1,000.
    pub rim: [f32; 3],
    /// Opacity of the centre, 0 ..= 1.
    pub alpha: f32,
    /// Opacity of the rim, 0 ..= 1. Default 0.
    pub rim_alpha: f32,
}

/// When flames burn; in frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Burning {
    /// When the first of the fire's flames begin, -65,000 ..= 1,000,000. Default 0.
    pub first_frame: i32,
    /// From the first to the last that is kindled, 0 ..= 1,000,000. Default 0: all at once.
    pub kindling_frames: u32,
    /// How long each burns, 1 ..= 1,000,000; `None`: for ever.
    pub lifetime: Option<u32>,
    /// How long it takes to grow, and to shrink again, 0 ..= 1,000,000. Default 0.
    pub growth_frames: u32,
}

impl Fire {
    /// How many flames it has, listed and not.
    pub fn count(&self) -> u32 {
        self.listed.len() as u32 + self.roots.count()
    }

    /// The frame in which the flame of that index is kindled.
    pub fn birth_frame(&self, index: u32) -> i32 {
        let Burning {
            first_frame,
            kindling_frames,
            ..
        } = self.burning;
        let listed = self.listed.get(index as usize);
        if let Some(listed) = listed {
            return listed.first_frame.unwrap_or(first_frame);
        }
        let index = u64::from(index - self.listed.len() as u32);
        let count = u64::from(self.roots.count().max(1));
        first_frame + (index * u64::from(kindling_frames) / count) as i32
    }
}
