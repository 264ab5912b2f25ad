//! What fires spread over, and how fast: stored faces with their edges, and the part of a frame.

use glam::{UVec4, Vec3};
use rayon::prelude::*;

use super::PlanError;
use super::fire::noise_key;
use super::system::name_key;
use crate::exact::{normalize_exact, snap};
use crate::layout::{
    self, FLAME_LIGHTS, FireFrame, GRAIN_NONE, GRAIN_RINGS, GRAIN_STRIPES, SPREAD_BLOCKS,
    SPREAD_CARRIES, SPREAD_FLAT, SPREAD_LITERAL, SPREAD_MIDPOINT, SPREAD_NORMAL, SPREAD_SPILL,
    SPREAD_STAIN, SpreadEdge, SpreadFace, SpreadFeature, SpreadFrame, SpreadPiece,
};
use crate::mesh::surface::{FeatureNear, HalfEdge, NO_EDGE, SurfaceFace};
use crate::rng::pcg4d;
use crate::scene::{
    Curvature, FireSpread, FrontHeading, Grain, GrainPattern, Insertion, Scene, SpreadLaw,
};
use crate::transcendental::{cos_turns, sin_turns};

/// Marks hashes that make rings' keys.
const RING_TAG: u32 = 0x7269_6e67;

/// Marks hashes that make keys of rings that flames begin.
const CATCH_TAG: u32 = 0x6361_7463;

/// Pieces that flames may light at most, and faces of all of them: each step of a flame is held against
/// those that are near, and drivers end long loops.
const MOST_PIECES: usize = 256;
const MOST_CATCHING_FACES: u32 = 50_000;

/// The angle of exposed air that steps are taken to have at most, radians: that of a cube's corner.
const MOST_AIR: f32 = 2.0 * std::f32::consts::PI;

/// Faces of all surfaces that fires spread over at most: what a binding of 128 MiB holds of their
/// half-edges.
const MOST_FACES: usize = (128 << 20) / (3 * size_of::<SpreadEdge>());

/// Faces whose neighbourhoods are searched before their edges are counted.
const FACES_AT_A_TIME: usize = 256;

/// Edges near faces at most: what such a binding holds of them.
const MOST_FEATURES: usize = (128 << 20) / size_of::<SpreadFeature>();

/// Every face that a fire spreads over, and every ring that begins. Where there are none, one face
/// that is nobody's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpreadTables {
    /// Spread by spread.
    pub faces: Vec<SpreadFace>,
    /// Three a face.
    pub edges: Vec<SpreadEdge>,
    /// Face by face.
    pub features: Vec<SpreadFeature>,
    /// Every ignition with its frame, in the order of frames, then of fires; `order` is that of its
    /// frame.
    pub ignitions: Vec<(u32, layout::Ignition)>,
    /// Pieces that flames may light, with the slot of the fire of each and the frame from which on it
    /// burns without their doing; poses are a frame's.
    pieces: Vec<(usize, u32, SpreadPiece)>,
    /// Places far from each other on each spread's surface, in its fire's space.
    light_places: Vec<Vec<[f32; 3]>>,
    /// Digest of the surface, how far edges are looked for, and the first face, of each spread.
    stored: Vec<(u64, f32, u32)>,
}

impl SpreadTables {
    /// The tables of all fires that spread, in any of these scenes: those of a run differ in numbers
    /// alone.
    pub(super) fn new(scenes: &[&Scene]) -> Result<Self, PlanError> {
        let mut tables = Self::default();
        let Some(first) = scenes.first() else {
            return Ok(tables);
        };
        let reaches = |slot: usize| {
            let of = |scene: &&Scene| {
                let greatest = scene.greatest();
                spreads_of(&greatest)
                    .nth(slot)
                    .map_or(0.0, |(_, spread)| spread.curvature_distance)
            };
            scenes.iter().map(of).fold(0.0, f32::max)
        };
        let mut due = Vec::new();
        for (slot, (at, spread)) in spreads_of(first).enumerate() {
            let reach = match spread.curvature {
                Curvature::Ignored => 0.0,
                _ => reaches(slot),
            };
            let name = &first.fires[at].name;
            let first_face = tables.add(spread, reach).map_err(|error| {
                let at_fault = error.key.clone().unwrap_or_default();
                error.of_key(format!("fire.{name}.spread.{at_fault}"))
            })?;
            let fire_key = name_key(first.seed, &first.fires[at].name, RING_TAG);
            for (ring, ignition) in (0..).zip(&spread.ignitions) {
                let (face, place) = spread.surface.nearest(ignition.position.map(f64::from));
                let share = 1.0 / ignition.points as f32;
                let [x, y] = place.map(|x| x as f32);
                let key = pcg4d(UVec4::new(fire_key, ring, 0, RING_TAG)).x;
                let ignition_of = layout::Ignition {
                    place: [x, y, share, 0.0].map(snap),
                    kinds: [first_face + face, ignition.points, slot as u32, key],
                    order: [0; 4],
                };
                due.push((ignition.first_frame, ignition_of));
            }
        }
        tables.pieces = pieces_of(first, &tables, &due)?;
        due.sort_by_key(|(frame, _)| *frame);
        let mut ring = 0;
        for same in due.chunk_by_mut(|a, b| a.0 == b.0) {
            let all = same.iter().map(|(_, one)| one.kinds[1]).sum();
            let mut before = 0;
            for (_, one) in same {
                one.order = [before, ring, all, 0];
                before += one.kinds[1];
                ring += 1;
            }
        }
        tables.ignitions = due;
        if tables.faces.is_empty() {
            tables.faces = vec![SpreadFace::default()];
            tables.edges = vec![SpreadEdge::default(); 3];
        }
        if tables.features.is_empty() {
            tables.features = vec![SpreadFeature::default()];
        }
        Ok(tables)
    }

    /// Whether a run with these tables can go on with the others.
    pub(super) fn cover(&self, other: &Self) -> bool {
        let is_here = |(own, other): (&(u64, f32, u32), &(u64, f32, u32))| {
            (own.0, own.2) == (other.0, other.2) && own.1 >= other.1
        };
        self.ignitions == other.ignitions
            && self.pieces == other.pieces
            && self.stored.len() == other.stored.len()
            && self.stored.iter().zip(&other.stored).all(is_here)
    }

    /// The rings that begin in a frame; one without points where there are none.
    pub(super) fn due(&self, frame: i32) -> Vec<layout::Ignition> {
        let is_due = |(at, _): &&(u32, layout::Ignition)| i64::from(*at) == i64::from(frame);
        let due = self.ignitions.iter().filter(is_due);
        let mut due: Vec<layout::Ignition> = due.map(|(_, one)| *one).collect();
        if due.is_empty() && !self.ignitions.is_empty() {
            due.push(layout::Ignition::default());
        }
        due
    }

    /// Pieces that flames may light.
    pub(crate) fn piece_count(&self) -> u32 {
        self.pieces.len() as u32
    }

    /// First face and number of faces of each of them.
    pub(crate) fn piece_faces(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let faces = self.pieces.iter().map(|(_, _, piece)| piece.faces);
        faces.map(|[first, count, ..]| [first, count])
    }

    /// The same in a frame, where the fires are these.
    pub(super) fn pieces(&self, fires: &[FireFrame], frame: i32) -> Vec<SpreadPiece> {
        let of = |(fire, burns_from, piece): &(usize, u32, SpreadPiece)| {
            let fire = &fires[*fire];
            let mut piece = SpreadPiece {
                world_from_fire_x: fire.world_from_fire_x,
                world_from_fire_y: fire.world_from_fire_y,
                world_from_fire_z: fire.world_from_fire_z,
                ..*piece
            };
            if i64::from(frame) >= i64::from(*burns_from) {
                piece.faces[1] = 0;
            }
            piece
        };
        self.pieces.iter().map(of).collect()
    }

    /// The most points that begin in one frame.
    pub(crate) fn most_ignited(&self) -> u32 {
        let all = self.ignitions.iter().map(|(_, one)| one.order[2]);
        let of_pieces = self.pieces.iter().map(|(_, _, piece)| piece.ring[0]);
        all.max().unwrap_or(0) + of_pieces.sum::<u32>()
    }

    /// Places far from each other on each spread's surface, in its fire's space.
    pub(super) fn light_places(&self) -> impl Iterator<Item = &Vec<[f32; 3]>> {
        self.light_places.iter()
    }

    fn add(&mut self, spread: &FireSpread, reach: f32) -> Result<u32, PlanError> {
        let surface = &spread.surface;
        let first = self.faces.len() as u32;
        let stored = (surface.digest(), reach, first);
        self.stored.push(stored);
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
                self.faces.push(face_of(face, features));
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
        Ok(first)
    }
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

/// The pieces that flames may light, of all fires that spread so.
fn pieces_of(
    scene: &Scene,
    tables: &SpreadTables,
    due: &[(u32, layout::Ignition)],
) -> Result<Vec<(usize, u32, SpreadPiece)>, PlanError> {
    let mut pieces = Vec::new();
    let mut looked_at = 0;
    for (slot, (fire, spread)) in (0..).zip(spreads_of(scene)) {
        let Some(points) = spread.catch_points else {
            continue;
        };
        let (.., first_face) = tables.stored[slot as usize];
        let key = name_key(scene.seed, &scene.fires[fire].name, CATCH_TAG);
        for (nth, faces) in (0..).zip(spread.surface.pieces()) {
            let (first, count) = (first_face + faces.start, faces.len() as u32);
            looked_at += count;
            let within =
                |ignition: &layout::Ignition| (first..first + count).contains(&ignition.kinds[0]);
            let begins = due.iter().filter(|(_, ignition)| within(ignition));
            let ring = due.len() + pieces.len();
            let piece = SpreadPiece {
                ball: spread.surface.ball_around(faces).map(|x| snap(x as f32)),
                faces: [first, count, slot, ring as u32],
                ring: [
                    points,
                    pcg4d(UVec4::new(key, nth, 0, CATCH_TAG)).x,
                    (1.0 / points as f32).to_bits(),
                    0,
                ],
                ..SpreadPiece::default()
            };
            let burns_from = begins.map(|(frame, _)| *frame).min();
            pieces.push((fire, burns_from.unwrap_or(u32::MAX), piece));
        }
    }
    if pieces.len() > MOST_PIECES || looked_at > MOST_CATCHING_FACES {
        return Err(PlanError {
            message: format!(
                "flames may light {} pieces of {looked_at} faces in all",
                pieces.len()
            ),
            help: format!(
                "at most {MOST_PIECES} pieces of {MOST_CATCHING_FACES} faces, or no `catch_points`"
            ),
            key: None,
        });
    }
    Ok(pieces)
}

fn face_of(face: &SurfaceFace, features: [u32; 4]) -> SpreadFace {
    let row =
        |i: usize| [face.x[i], face.y[i], face.normal[i], face.origin[i]].map(|x| snap(x as f32));
    SpreadFace {
        fire_from_face_x: row(0),
        fire_from_face_y: row(1),
        fire_from_face_z: row(2),
        features,
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
            let longest_step = MOST_AIR * (opposed + concurrent) * factor;
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
