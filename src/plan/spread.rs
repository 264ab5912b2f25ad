//! What fires spread over, and how fast: stored faces with their edges, and the part of a frame.

use glam::Vec3;
use rayon::prelude::*;

use super::PlanError;
use super::fire::noise_key;
use crate::exact::{normalize_exact, snap};
use crate::layout::{
    self, FLAME_LIGHTS, GRAIN_NONE, GRAIN_RINGS, GRAIN_STRIPES, SPREAD_BLOCKS, SPREAD_CARRIES,
    SPREAD_FLAT, SPREAD_LITERAL, SPREAD_MIDPOINT, SPREAD_NORMAL, SPREAD_SPILL, SPREAD_STAIN,
    SpreadEdge, SpreadFace, SpreadFeature, SpreadFrame,
};
use crate::mesh::Part;
use crate::mesh::surface::{FeatureNear, HalfEdge, NO_EDGE, SurfaceFace};
use crate::scene::{
    Curvature, FireSpread, FrontHeading, Grain, GrainPattern, Insertion, Scene, SpreadLaw,
};
use crate::transcendental::{cos_turns, sin_turns};

/// The angle of exposed air that steps are taken to have at most, radians: that of a cube's corner.
const MOST_AIR: f32 = 2.0 * std::f32::consts::PI;

/// Faces of all surfaces that fires spread over at most: what a binding of 128 MiB holds of their
/// half-edges.
const MOST_FACES: usize = (128 << 20) / (3 * size_of::<SpreadEdge>());

/// Faces whose neighbourhoods are searched before their edges are counted.
const FACES_AT_A_TIME: usize = 256;

/// Edges near faces at most: what such a binding holds of them.
const MOST_FEATURES: usize = (128 << 20) / size_of::<SpreadFeature>();

/// Every face that a fire spreads over. Where there are none, one face that is nobody's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpreadTables {
    /// Spread by spread.
    pub faces: Vec<SpreadFace>,
    /// Three a face.
    pub edges: Vec<SpreadEdge>,
    /// Face by face.
    pub features: Vec<SpreadFeature>,
    /// Places far from each other on each spread's surface, in its fire's space.
    light_places: Vec<Vec<[f32; 3]>>,
    /// Digest of the surface, how far edges are looked for, and the first face, of each spread.
    stored: Vec<(u64, f32, u32)>,
    /// What the faces of each part have in [`SpreadFace::material`], of each spread.
    factors: Vec<Vec<[u32; 4]>>,
}

impl SpreadTables {
    /// The tables of all fires that spread, in any of these scenes: those of a run differ in numbers
    /// alone.
    pub(super) fn new(scenes: &[&Scene]) -> Result<Self, PlanError> {
        Self::reaching(scenes, |_| 0.0)
    }

    /// As [`SpreadTables::new`], with edges that are so far from a face of a spread, at least.
    pub(super) fn reaching(
        scenes: &[&Scene],
        least: impl Fn(&FireSpread) -> f32,
    ) -> Result<Self, PlanError> {
        let mut tables = Self::default();
        let Some(first) = scenes.first() else {
            return Ok(tables);
        };
        for (slot, (at, spread)) in spreads_of(first).enumerate() {
            let name = &first.fires[at].name;
            tables
                .add(spread, reach_of(scenes, slot).max(least(spread)))
                .map_err(|error| {
                    let at_fault = error.key.clone().unwrap_or_default();
                    error.of_key(format!("fire.{name}.spread.{at_fault}"))
                })?;
        }
        if tables.faces.is_empty() {
            tables.faces = vec![SpreadFace::default()];
            tables.edges = vec![SpreadEdge::default(); 3];
        }
        if tables.features.is_empty() {
            tables.features = vec![SpreadFeature::default()];
        }
        Ok(tables)
    }

    /// Whether a run with these tables can go on as these scenes say.
    pub(super) fn serve(&self, scenes: &[&Scene]) -> bool {
        scenes
            .iter()
            .all(|scene| spreads_of(scene).count() == self.stored.len())
            && self
                .stored
                .iter()
                .enumerate()
                .all(|(slot, (digest, reach, _))| {
                    let has = |scene: &&Scene| {
                        let mut own = spreads_of(scene);
                        own.nth(slot).is_some_and(|(_, spread)| {
                            spread.surface.digest() == *digest
                                && factors_of(spread) == self.factors[slot]
                        })
                    };
                    *reach >= reach_of(scenes, slot) && scenes.iter().all(has)
                })
    }

    /// First face of each spread.
    pub(super) fn first_faces(&self) -> impl Iterator<Item = u32> + '_ {
        self.stored.iter().map(|(.., first)| *first)
    }

    /// Places far from each other on each spread's surface, in its fire's space.
    pub(super) fn light_places(&self) -> impl Iterator<Item = &Vec<[f32; 3]>> {
        self.light_places.iter()
    }

    fn add(&mut self, spread: &FireSpread, reach: f32) -> Result<(), PlanError> {
        let surface = &spread.surface;
        let first = self.faces.len() as u32;
        let stored = (surface.digest(), reach, first);
        self.stored.push(stored);
        let factors = factors_of(spread);
        let places = surface.spaced_places(FLAME_LIGHTS as usize);
        let places = places.into_iter().map(|place| place.map(|x| x as f32));
        self.light_places.push(places.collect());
        if self.faces.len() + surface.faces().len() > MOST_FACES {
            return Err(PlanError {
                message: format!(
                    "fires spread over {} faces",
                    self.faces.len() + surface.faces().len()
                ),
                help: format!("at most {MOST_FACES} in all"),
                key: Some("mesh".into()),
            });
        }
        for (block, faces) in surface.faces().chunks(FACES_AT_A_TIME).enumerate() {
            let first = (block * FACES_AT_A_TIME) as u32;
            let near: Vec<Vec<FeatureNear>> = (first..first + faces.len() as u32)
                .into_par_iter()
                .map(|at| surface.features_near(at, f64::from(reach)))
                .collect();
            for (face, near) in faces.iter().zip(near) {
                let [begin, count] = [self.features.len(), near.len()].map(|at| at as u32);
                let features = [begin, count, face.source, 0];
                let part = spread.mesh.face_parts()[face.source as usize];
                self.faces
                    .push(face_of(face, features, factors[part as usize]));
                self.features.extend(near.iter().map(feature_of));
            }
            if self.features.len() > MOST_FEATURES {
                return Err(PlanError {
                    message: format!(
                        "`curvature_distance` {reach} reaches too many edges of {}",
                        spread.mesh.name()
                    ),
                    help: "a smaller one, or a mesh with larger faces".into(),
                    key: Some("curvature_distance".into()),
                });
            }
        }
        for (at, half) in surface.half_edges().iter().enumerate() {
            let corner = surface.faces()[at / 3].corners[at % 3];
            self.edges.push(edge_of(half, corner, 3 * first));
        }
        self.factors.push(factors);
        Ok(())
    }
}

/// How far from a face edges count, at most, on the surface of one of these scenes' spreads.
fn reach_of(scenes: &[&Scene], slot: usize) -> f32 {
    let of = |scene: &&Scene| {
        let greatest = scene.greatest();
        let spread = spreads_of(&greatest)
            .nth(slot)
            .map(|(_, spread)| match spread.curvature {
                Curvature::Ignored => 0.0,
                _ => spread.curvature_distance,
            });
        spread.unwrap_or(0.0)
    };
    scenes.iter().map(of).fold(0.0, f32::max)
}

fn feature_of(near: &FeatureNear) -> SpreadFeature {
    let [x, y] = near.from;
    let [along_x, along_y] = near.along;
    let square = along_x * along_x + along_y * along_y;
    SpreadFeature {
        line: [x, y, along_x, along_y].map(|x| snap(x as f32)),
        bend: [near.dihedral as f32, (1.0 / square) as f32, 0.0, 0.0].map(snap),
    }
}

/// [`SpreadFace::material`] of each part of a spread's mesh.
fn factors_of(spread: &FireSpread) -> Vec<[u32; 4]> {
    let word = |factor: f32| snap(factor).to_bits();
    let of = |part: &Part| {
        let own = spread.materials.iter().rev();
        let own = own.filter(|one| one.part == part.group || one.part == part.material);
        let Some(material) = own.into_iter().next() else {
            return [word(1.0), word(1.0), 0, 0];
        };
        let [opposed, concurrent] = spread.factors_of(material);
        let lifetime = material.lifetime.unwrap_or(0);
        [word(opposed), word(concurrent), lifetime, 0]
    };
    spread.mesh.parts().iter().map(of).collect()
}

fn face_of(face: &SurfaceFace, features: [u32; 4], material: [u32; 4]) -> SpreadFace {
    let row =
        |i: usize| [face.x[i], face.y[i], face.normal[i], face.origin[i]].map(|x| snap(x as f32));
    SpreadFace {
        fire_from_face_x: row(0),
        fire_from_face_y: row(1),
        fire_from_face_z: row(2),
        features,
        material,
    }
}

fn edge_of(half: &HalfEdge, corner: [f64; 2], first_half: u32) -> SpreadEdge {
    let [nx, ny] = half.inward;
    let quarter = (0.25 * half.around / std::f64::consts::TAU) as f32;
    let [x, y] = corner.map(|x| x as f32);
    let beyond = match half.twin {
        NO_EDGE => layout::NO_EDGE,
        twin => first_half + twin,
    };
    SpreadEdge {
        line: [nx, ny, half.offset, half.length].map(|x| snap(x as f32)),
        corner: [x, y, cos_turns(quarter), sin_turns(quarter)].map(snap),
        turn: half.turn.map(|x| snap(x as f32)),
        ties: [beyond, u32::from(half.around > 0.0), 0, 0],
    }
}

/// The fires that spread, with their slots among fires.
pub(super) fn spreads_of(scene: &Scene) -> impl Iterator<Item = (usize, &FireSpread)> {
    let fires = scene.fires.iter().enumerate();
    fires.filter_map(|(at, fire)| Some((at, fire.spread.as_ref()?)))
}

/// The spreads of a frame.
pub(super) fn spread_frames(now: &Scene) -> Vec<SpreadFrame> {
    spreads_of(now)
        .map(|(at, spread)| {
            let [opposed, concurrent] = spread.fluxes();
            // K = pi rho dh (equation 3.4).
            let divisor = std::f32::consts::PI * spread.heat();
            let factor = spread.time_scale / divisor;
            // Two pieces meet whose points are no farther apart than they are long and steps are.
            let most = spread.materials.iter().fold([1.0f32; 2], |most, material| {
                let own = spread.factors_of(material);
                [most[0].max(own[0]), most[1].max(own[1])]
            });
            let longest_step = MOST_AIR * (opposed * most[0] + concurrent * most[1]) * factor;
            // No farther than a few points, since drivers end long loops; steps that long leave gaps.
            let reach = 4.0 * spread.separation + 2.0 * longest_step;
            let reach = reach.min(8.0 * spread.separation).clamp(1e-6, 1e6);
            let (line_look, line_width) = spread.line.map_or(([0.0; 4], 0.0), |line| {
                let [red, green, blue] = line.color;
                ([red, green, blue, line.opacity], line.width)
            });
            let (kind, grain, grain_shape) = grain_of(spread.grain.as_ref());
            let rates = [opposed, concurrent, factor, 1.0 / spread.curvature_distance];
            SpreadFrame {
                rates: rates.map(snap),
                distances: [
                    spread.separation,
                    spread.drop_distance,
                    // Somewhat larger than what is looked at, so that rounding loses nobody.
                    1.0 / (1.01 * reach),
                    reach,
                ]
                .map(snap),
                kinds: [at as u32, flags_of(spread), kind, noise_key(now.seed)],
                line_look: line_look.map(snap),
                line_shape: [snap(line_width), 0.0, 0.0, 0.0],
                grain,
                grain_shape,
            }
        })
        .collect()
}

/// The kind of a grain, its direction and scale, and its shape.
pub(super) fn grain_of(grain: Option<&Grain>) -> (u32, [f32; 4], [f32; 4]) {
    let Some(grain) = grain else {
        return (GRAIN_NONE, [0.0; 4], [0.0; 4]);
    };
    let kind = match grain.pattern {
        GrainPattern::Stripes => GRAIN_STRIPES,
        GrainPattern::Rings => GRAIN_RINGS,
    };
    let [x, y, z] = normalize_exact(Vec3::from(grain.direction)).to_array();
    let shape = [grain.strength, grain.shift, grain.noise_scale, 0.0];
    (kind, [x, y, z, grain.scale].map(snap), shape.map(snap))
}

fn flags_of(spread: &FireSpread) -> u32 {
    let law = match spread.law {
        SpreadLaw::Fire => 0,
        SpreadLaw::Spill => SPREAD_SPILL,
        SpreadLaw::Stain => SPREAD_STAIN,
    };
    let heading = match spread.heading {
        FrontHeading::Ray => 0,
        FrontHeading::Normal => SPREAD_NORMAL,
    };
    let insertion = match spread.insertion {
        Insertion::Arc => 0,
        Insertion::Midpoint => SPREAD_MIDPOINT,
    };
    let curvature = match spread.curvature {
        Curvature::Exposed => 0,
        Curvature::Literal => SPREAD_LITERAL,
        Curvature::Ignored => SPREAD_FLAT,
    };
    let blocks = match spread.prevents_double_burning {
        true => SPREAD_BLOCKS,
        false => 0,
    };
    let carries = match spread.carries_rest {
        true => SPREAD_CARRIES,
        false => 0,
    };
    law | heading | insertion | curvature | blocks | carries
}
