//! How a fire spreads over a mesh (Perry 1994, 3.3): its front's control points, and their speed.

use std::sync::Arc;

use crate::mesh::{Mesh, Surface};

/// A front that burns its way over a surface, in its fire's space.
#[derive(Clone, Debug, PartialEq)]
pub struct FireSpread {
    /// The mesh as it was read.
    pub mesh: Arc<Mesh>,
    /// The same, scaled and ready to be walked on.
    pub surface: Arc<Surface>,
    /// Where and when it begins, at least one, at most 256.
    pub ignitions: Vec<Ignition>,
    /// How many control points a piece begins with that flames light, 3 ..= 256; `None`: they do not.
    pub catch_points: Option<u32>,
    /// K of Table 3.1: factor of all speeds, 0 ..= 1,000. Default 0.04.
    pub time_scale: f32,
    /// q_o, heat that the opposed mechanism conveys, 0 ..= 10^9. Default 0.09.
    pub opposed_flux: f32,
    /// q_c, heat that the concurrent mechanism conveys along the wind, 0 ..= 10^9. Default 0.13.
    pub concurrent_flux: f32,
    /// rho dh, heat that a unit of volume takes to burn, 0.000001 ..= 10^12. Default 0.5; a `formula` has
    /// its own.
    pub ignition_heat: f32,
    /// What q_o, q_c and rho dh are computed from instead, if they are.
    pub formula: Option<FluxFormula>,
    /// d_d, world units between flames that a control point drops, 0.000001 ..= 10,000.
    pub drop_distance: f32,
    /// d_s, world units between neighbours from which on a point comes between, 0.000001 ..= 10,000.
    pub separation: f32,
    /// d_t, world units from an edge within which it counts, 0.000001 ..= 10,000.
    pub curvature_distance: f32,
    /// What moves it.
    pub law: SpreadLaw,
    /// How parts of the mesh burn that burn otherwise than the rest, at most 64.
    pub materials: Vec<Material>,
    /// What makes it slower here and there, if anything does.
    pub grain: Option<Grain>,
    /// What edges do.
    pub curvature: Curvature,
    /// Where control points head.
    pub heading: FrontHeading,
    /// Where points come between.
    pub insertion: Insertion,
    /// Whether control points stop where it has burnt. Default yes.
    pub prevents_double_burning: bool,
    /// Whether what a point has come beyond d_d counts for the next flame. Default no.
    pub carries_rest: bool,
    /// Flames that burn at once at most, 1 ..= 60,000. Default 2,000.
    pub max_flames: u32,
    /// The marks that its flames leave, if they do.
    pub char: Option<Char>,
    /// The smoke that rises from them, if any does.
    pub smoke: Option<Smoke>,
    /// The front as a line, if it is drawn.
    pub line: Option<FrontLine>,
    /// Control points at most, 8 ..= 1,000,000. Default 20,000.
    pub max_points: u32,
}

/// Marks where flames have gone out (Perry 1994, 3.4.1 and 4.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Char {
    /// How wide, world units, 0.000001 ..= 10,000; `None`: as a flame.
    pub size: Option<f32>,
    /// How much its middle hides, 0 ..= 1. Default 0.5.
    pub opacity: f32,
    /// Share of the radius that its edge takes, 0 ..= 1. Default 1.
    pub edge_softness: f32,
    /// Red, green, blue at first, each 0 ..= 1,000. Default a dark orange.
    pub glow: [f32; 3],
    /// Frames until it is black, 1 ..= 1,000,000. Default 60.
    pub glow_frames: f32,
    /// Frames until it is as opaque as it will be, 1 ..= 1,000,000. Default 6.
    pub appear_frames: f32,
    /// Marks at most, 1 ..= 200,000. Default 10,000.
    pub max_marks: u32,
}

/// Smoke where flames have gone out (Perry 1994, 4.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoke {
    /// World units a frame where u is 1, 0 ..= 10,000. Default 0.02.
    pub speed: f32,
    /// Frames until it has vanished, 1 ..= 1,000,000. Default 60.
    pub frames: f32,
    /// World units at first, 0.000001 ..= 10,000. Default 0.1.
    pub size: f32,
    /// How many times as wide in the end, 0 ..= 1,000. Default 4.
    pub growth: f32,
    /// Red, green, blue, each 0 ..= 1,000. Default dark grey.
    pub color: [f32; 3],
    /// 0 ..= 1. Default 0.15.
    pub opacity: f32,
    /// Puffs at most, 1 ..= 200,000. Default 10,000.
    pub max_puffs: u32,
}

/// A front as a line (Perry 1994, 4.7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontLine {
    /// World units, 0 ..= 10,000.
    pub width: f32,
    /// Red, green, blue, each 0 ..= 1,000. Default orange.
    pub color: [f32; 3],
    /// 0 ..= 1. Default 1.
    pub opacity: f32,
}

/// How a part of a mesh burns (Perry 1994, 3.3.1 and 4.7).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// A group or a material of the mesh.
    pub part: String,
    /// Factor of its speed, 0 ..= 1,000. Default 1.
    pub speed: f32,
    /// L, metres, 0.000001 ..= 1,000, instead of the formula's.
    pub thickness: Option<f32>,
    /// lambda, W/(m K), 0 ..= 10,000, instead of the formula's.
    pub conductivity: Option<f32>,
    /// Frames that flames burn which are dropped there, 1 ..= 1,000,000, instead of the fire's.
    pub lifetime: Option<u32>,
}

/// A place where a fire begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ignition {
    /// In the fire's space; the nearest place of the surface is meant.
    pub position: [f32; 3],
    /// When, 0 ..= 1,000,000. Default 0.
    pub first_frame: u32,
    /// How many control points it begins with, 3 ..= 4,096. Default 16.
    pub points: u32,
}

/// What the heat fluxes come from (Perry 1994, 3.3.1), in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FluxFormula {
    /// T_f, kelvin, 1 ..= 10,000.
    pub flame_temperature: f32,
    /// T_i, kelvin, 0 ..= 10,000.
    pub fuel_temperature: f32,
    /// lambda_g of the gas, or lambda_s of a thick solid, W/(m K), 0 ..= 10,000.
    pub conductivity: f32,
    /// epsilon_f, 0 ..= 1.
    pub emissivity: f32,
    /// h_f, metres, 0 ..= 1,000.
    pub flame_length: f32,
    /// Theta_f, degrees, 0 ..= 180.
    pub flame_angle_degrees: f32,
    /// L, metres, 0.000001 ..= 1,000.
    pub thickness: f32,
    /// rho, kg/m^3, 0.001 ..= 1,000,000. Default 600.
    pub density: f32,
    /// dh, J/kg, 0.001 ..= 10^9. Default 500,000.
    pub enthalpy: f32,
}

/// What moves a front (Perry 1994, 3.3.1 and 3.3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpreadLaw {
    /// Heat: equation 3.4.
    Fire,
    /// Gravity along the surface.
    Spill,
    /// What soaks it up: as far as the root of the time.
    Stain,
}

/// A pattern as wood has it (Perry 1994, 4.4), in an object's space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Slabs or rings.
    pub pattern: GrainPattern,
    /// Across slabs, or the middle of rings; not zero.
    pub direction: [f32; 3],
    /// Periods a world unit, 0 ..= 10,000.
    pub scale: f32,
    /// What it takes away where it is densest, 0 ..= 1. Default 0.5.
    pub strength: f32,
    /// How far noise shifts it, periods, 0 ..= 1,000. Default 0.
    pub shift: f32,
    /// Cells of that noise a world unit, 0 ..= 10,000. Default 1.
    pub noise_scale: f32,
}

/// What a grain looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GrainPattern {
    /// Slabs, of which every other half of a period is dense.
    Stripes,
    /// Rings, which fade inward and outward.
    Rings,
}

/// How edges change the speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curvature {
    /// By the angle of air that is exposed: faster at outer edges, slower at inner ones.
    Exposed,
    /// As equation 3.4 is written: nothing moves where it is flat.
    Literal,
    /// Not at all.
    Ignored,
}

/// Where control points head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrontHeading {
    /// Each keeps its own heading, straight on over the surface.
    Ray,
    /// Along the front's normal.
    Normal,
}

/// Where a point comes between two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// On the arc that the two headings span.
    Arc,
    /// In the middle.
    Midpoint,
}

impl FluxFormula {
    /// Stefan and Boltzmann's constant, W m^-2 K^-4.
    pub const STEFAN_BOLTZMANN: f32 = 5.670_374e-8;

    /// q_o = lambda (T_f - T_i)/L (equation 3.3).
    pub fn opposed_flux(&self) -> f32 {
        self.conductivity * (self.flame_temperature - self.fuel_temperature) / self.thickness
    }

    /// q_c = epsilon sigma T_f^4 h_f sin(Theta_f)/L.
    pub fn concurrent_flux(&self) -> f32 {
        let square = self.flame_temperature * self.flame_temperature;
        let sine = crate::transcendental::sin_turns(self.flame_angle_degrees / 360.0);
        let radiated = self.emissivity * Self::STEFAN_BOLTZMANN * square * square;
        radiated * self.flame_length * sine / self.thickness
    }
}

impl FireSpread {
    /// rho dh, given or computed: a flux through it is a speed (equation 3.2).
    pub fn heat(&self) -> f32 {
        match &self.formula {
            Some(formula) => formula.density * formula.enthalpy,
            None => self.ignition_heat,
        }
    }

    /// What q_o and q_c are multiplied by where that is.
    pub fn factors_of(&self, material: &Material) -> [f32; 2] {
        let Some(formula) = self.formula else {
            return [material.speed; 2];
        };
        let own = FluxFormula {
            thickness: material.thickness.unwrap_or(formula.thickness),
            conductivity: material.conductivity.unwrap_or(formula.conductivity),
            ..formula
        };
        let share = |own: f32, general: f32| if general > 0.0 { own / general } else { 1.0 };
        [
            material.speed * share(own.opposed_flux(), formula.opposed_flux()),
            material.speed * share(own.concurrent_flux(), formula.concurrent_flux()),
        ]
    }

    /// q_o and q_c, given or computed.
    pub fn fluxes(&self) -> [f32; 2] {
        match &self.formula {
            Some(formula) => [formula.opposed_flux(), formula.concurrent_flux()],
            None => [self.opposed_flux, self.concurrent_flux],
        }
    }
}
