//! What the user wrote, checked: TOML → [`Scene`].
//!
//! A scene knows no plan and no backend. Every quantity here has passed its checks: finite, in
//! range, consistent. Lengths are in world units, times in frames, angles in degrees; the world
//! is right-handed with +y up.
//!
//! Each randomised parameter is a [`Spread`]: a mean and a *half-width* of a uniform interval
//! around it, which is what Reeves (1983, sections 2 and 2.1) calls mean and variance.

mod births;
mod builtin;
mod check;
mod error;
mod expect;
mod extinction;
mod files;
mod fire;
mod flock;
mod generation;
mod inherit;
mod knobs;
mod load;
mod meshes;
mod parse;
mod picture;
mod read;
mod scaled;
pub mod schema;
mod set;
mod spread;
mod surface;
mod system;
mod tracks;
mod tree;
mod values;
mod wind;

use std::sync::Arc;

use crate::mesh::Mesh;

pub use births::{BirthMoment, BirthRounding, BirthUnit, Births, Burst};
pub use builtin::{BUILTIN, BUILTIN_FILES, BuiltinScene};
pub use error::SceneError;
pub(crate) use error::shortened;
pub use extinction::{Extinction, Side};
pub use fire::{
    Burning, Fire, FireLights, FlameForm, LightFrom, ListedFlame, Profile, ProfileStop, RampStop,
    Roots,
};
pub use flock::{
    BoidShape, Corners, Dimensions, Edges, Flock, Goal, Obstacle, ObstacleShape, Relation,
    RelationKind, Rule,
};
pub use generation::{Attractor, EjectionAxis, EjectionSpread, GenerationShape};
pub use inherit::Inherit;
pub use knobs::{Knob, KnobValue};
pub use load::{Loader, knobs, load, load_with, parse};
pub(crate) use parse::Draft;
pub use picture::{
    Camera, Ground, Image, Lamp, Layer, Light, Pillar, Planet, Projection, ShutterWeighting,
};
pub(crate) use set::Set;
#[cfg(feature = "view")]
pub(crate) use set::UNSET;
pub use spread::{
    Char, Curvature, FireSpread, FluxFormula, FrontHeading, FrontLine, Grain, GrainPattern,
    Ignition, Insertion, Material, Smoke, SpreadLaw,
};
pub use surface::LitSurface;
pub use system::{
    Blend, ChildUp, Integration, Intensity, ParticleShape, ParticleSpace, Shading, StreakLight,
    System,
};
pub use tracks::{Interpolation, Key, Owner, Track};
pub use wind::{Turbulence, Wind};

/// A mean and a half-width: values are uniform in `[mean - var, mean + var]` (Reeves 1983, 2.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread<T> {
    /// Centre of the interval.
    pub mean: T,
    /// Half-width of the interval, not a statistical variance; at least 0.
    pub var: T,
}

/// A parameter with a spread at birth and a rate of change a frame (Reeves 1983, 2.2 and 2.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Changing<T> {
    /// Value at birth.
    pub initial: Spread<T>,
    /// Added once a frame; the same for all particles of a system but for `rate_var`.
    pub rate: T,
    /// Half-width of the rates of single particles around `rate` (Reeves 1983, 2.3, further work).
    pub rate_var: T,
}

/// A whole scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name of the scene: the built-in name, or the file's stem. Used in default output paths.
    pub name: String,
    /// One line for people, at most 200 characters. Default: the name.
    pub title: String,
    /// A few sentences for people, at most 10,000 characters; may be empty.
    pub description: String,
    /// Frames that the scene lasts when nobody says otherwise, 1 ..= 1,000,000. Default 120.
    pub frames: u32,
    /// Frames a second, for animated files, 1 ..= 240. Default 24 (Reeves 1983, section 3).
    pub frame_rate: u32,
    /// Seed of every stochastic decision. Default 1; a file's is below 2^63, as TOML's numbers are.
    pub seed: u64,
    /// Most particles alive at once, 1 ..= 1,000,000,000; `None` means a bound computed from births and lifetimes.
    pub capacity: Option<u32>,
    /// Most systems that others bear at once, 1 ..= 16,384; `None` means a bound computed from births
    /// and lifetimes.
    pub max_systems: Option<u32>,
    /// How many are alive once births and deaths balance, 1 ..= 1,000,000,000; `None` where they
    /// never do, or nobody has counted. Benchmarks scale births by it.
    pub steady_particles: Option<u32>,
    /// Image size, background and shutter.
    pub image: Image,
    /// The viewer.
    pub camera: Camera,
    /// What covering particles reflect.
    pub light: Light,
    /// The particle systems, in the order of the file, at most 1,024; names unique. A scene has at
    /// least one, or a flock, or a fire.
    pub systems: Vec<System>,
    /// The flocks, in the order of the file, at most 64; names unique.
    pub flocks: Vec<Flock>,
    /// A ball with a surface.
    pub planet: Option<Planet>,
    /// Lights near it and the ground, at most 16.
    pub lamps: Vec<Lamp>,
    /// A plane behind everything.
    pub ground: Option<Ground>,
    /// Cylinders before it, at most 16.
    pub pillars: Vec<Pillar>,
    /// Meshes that are seen, at most 64.
    pub surfaces: Vec<LitSurface>,
    /// The fires, in the order of the file, at most 64; names unique.
    pub fires: Vec<Fire>,
    /// The parts of the wind, at most 16; it is their sum.
    pub winds: Vec<Wind>,
    /// Planes that split the picture into layers, at most 8.
    pub layers: Vec<Layer>,
    /// Values that change with the frame; the fields above hold those of the first keys.
    pub tracks: Vec<Track>,
}

impl Scene {
    /// Names of the picture's layers: those of the file and `rest`, or `particles` alone if it has none; before
    /// them `surfaces`, if there are any ([`Scene::has_surfaces`]).
    pub fn layer_names(&self) -> Vec<String> {
        let surfaces = self.has_surfaces().then(|| "surfaces".to_owned());
        let names = self.layers.iter().map(|layer| layer.name.clone());
        let last = if self.layers.is_empty() {
            "particles"
        } else {
            "rest"
        };
        surfaces
            .into_iter()
            .chain(names)
            .chain([last.to_owned()])
            .collect()
    }

    /// Whether there is a planet, a ground, a pillar or a surface: all that light falls on, and that hides what is
    /// behind it.
    pub fn has_surfaces(&self) -> bool {
        let planes = self.planet.is_some() || self.ground.is_some();
        planes || !self.pillars.is_empty() || !self.surfaces.is_empty()
    }

    /// Whether what the system of that name bears are systems.
    pub fn bears_systems(&self, name: &str) -> bool {
        let parents = self.systems.iter().filter_map(|one| one.parent.as_deref());
        parents.into_iter().any(|parent| parent == name)
    }

    /// The meshes that its systems are born on, that its flames stand on, that its fires spread over
    /// and that are its surfaces, each once.
    pub fn meshes(&self) -> Vec<&Arc<Mesh>> {
        let mut meshes = self.meshes_of_roots();
        for surface in &self.surfaces {
            if !meshes.iter().any(|known| Arc::ptr_eq(known, &surface.mesh)) {
                meshes.push(&surface.mesh);
            }
        }
        meshes
    }

    /// Those that something is born on or spreads over.
    pub(crate) fn meshes_of_roots(&self) -> Vec<&Arc<Mesh>> {
        let of_systems = self
            .systems
            .iter()
            .filter_map(|system| match &system.generation_shape {
                GenerationShape::Mesh { mesh, .. } => Some(mesh),
                _ => None,
            });
        let of_fires = self.fires.iter().filter_map(|fire| match &fire.roots {
            Roots::Mesh { mesh, .. } => Some(mesh),
            _ => None,
        });
        let burning = self.fires.iter().filter_map(|fire| fire.spread.as_ref());
        let of_spreads = burning.map(|spread| &spread.mesh);
        let mut meshes: Vec<&Arc<Mesh>> = Vec::new();
        for mesh in of_systems.chain(of_fires).chain(of_spreads) {
            if !meshes.iter().any(|known| Arc::ptr_eq(known, mesh)) {
                meshes.push(mesh);
            }
        }
        meshes
    }

    /// What was mended in its files, a line each with the file's name.
    pub fn notes(&self) -> Vec<String> {
        let of = |mesh: &&Arc<Mesh>| {
            let notes = mesh.notes().iter();
            notes
                .map(|note| format!("{}: {note}", mesh.name()))
                .collect::<Vec<_>>()
        };
        let burning = self.fires.iter().filter_map(|fire| fire.spread.as_ref());
        let of_spreads = burning.flat_map(|spread| {
            let notes = spread.surface.notes().iter();
            notes.map(|note| format!("{}: {note}", spread.mesh.name()))
        });
        let obstacles = self.flocks.iter().flat_map(|flock| &flock.obstacles);
        let of_obstacles = obstacles.flat_map(|obstacle| match &obstacle.shape {
            ObstacleShape::Mesh { mesh, surface, .. } => {
                let notes = mesh.notes().iter().chain(surface.notes());
                notes
                    .map(|note| format!("{}: {note}", mesh.name()))
                    .collect()
            }
            _ => Vec::new(),
        });
        let of_meshes = self.meshes();
        let of_meshes = of_meshes.iter().flat_map(of);
        of_meshes.chain(of_spreads).chain(of_obstacles).collect()
    }
}
