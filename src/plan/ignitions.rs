//! Where and when fires that spread begin to burn: by themselves, and where flames light them.

use glam::UVec4;

use super::PlanError;
use super::spread::{SpreadTables, spreads_of};
use super::system::name_key;
use crate::exact::snap;
use crate::layout::{self, FireFrame, SpreadPiece};
use crate::rng::pcg4d;
use crate::scene::{Ignition, Scene};

/// Marks hashes that make rings' keys.
const RING_TAG: u32 = 0x7269_6e67;

/// Marks hashes that make keys of rings that flames begin.
const CATCH_TAG: u32 = 0x6361_7463;

/// Pieces that flames may light at most, and faces of all of them: each step of a flame is held against
/// those that are near, and drivers end long loops.
const MOST_PIECES: usize = 256;
const MOST_CATCHING_FACES: u32 = 50_000;

/// Every ring that begins in a run. Rings of pieces that flames may light have the first numbers, and
/// rings that begin by themselves the next ones in the order of their frames: a ring that begins later
/// than another changes nothing of that one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ignitions {
    /// Each with its frame, in the order of frames, then of fires; `order` is that of its frame.
    due: Vec<(u32, layout::Ignition)>,
    /// Pieces that flames may light, with the slot of the fire of each and the frame from which on it
    /// burns without their doing; poses are a frame's.
    pieces: Vec<(usize, u32, SpreadPiece)>,
}

impl Ignitions {
    /// Those of a scene, whose surfaces are in the tables.
    pub(super) fn new(scene: &Scene, tables: &SpreadTables) -> Result<Self, PlanError> {
        let mut due = Vec::new();
        for ((slot, (at, spread)), first_face) in
            (0..).zip(spreads_of(scene)).zip(tables.first_faces())
        {
            let fire_key = name_key(scene.seed, &scene.fires[at].name, RING_TAG);
            for (nth, ignition) in (0..).zip(&spread.ignitions) {
                let (face, place) = spread.surface.nearest(ignition.position.map(f64::from));
                let share = 1.0 / ignition.points as f32;
                let [x, y] = place.map(|x| x as f32);
                let key = pcg4d(UVec4::new(fire_key, nth, 0, RING_TAG)).x;
                let ignition_of = layout::Ignition {
                    place: [x, y, share, 0.0].map(snap),
                    kinds: [first_face + face, ignition.points, slot, key],
                    order: [0; 4],
                };
                due.push((ignition.first_frame, ignition_of));
            }
        }
        let pieces = pieces_of(scene, tables, &due)?;
        due.sort_by_key(|(frame, _)| *frame);
        let mut ring = pieces.len() as u32;
        for same in due.chunk_by_mut(|a, b| a.0 == b.0) {
            let all = same.iter().map(|(_, one)| one.kinds[1]).sum();
            let mut before = 0;
            for (_, one) in same {
                one.order = [before, ring, all, 0];
                before += one.kinds[1];
                ring += 1;
            }
        }
        Ok(Self { due, pieces })
    }

    /// Rings that there can be.
    pub(super) fn ring_count(&self) -> u32 {
        (self.pieces.len() + self.due.len()) as u32
    }

    /// The most points that begin in one frame.
    pub(super) fn most_points(&self) -> u32 {
        let all = self.due.iter().map(|(_, one)| one.order[2]);
        let of_pieces = self.pieces.iter().map(|(_, _, piece)| piece.ring[0]);
        all.max().unwrap_or(0) + of_pieces.sum::<u32>()
    }

    /// The rings that begin in a frame; one without points where there are none.
    pub(super) fn due(&self, frame: i32) -> Vec<layout::Ignition> {
        let is_due = |(at, _): &&(u32, layout::Ignition)| i64::from(*at) == i64::from(frame);
        let due = self.due.iter().filter(is_due);
        let mut due: Vec<layout::Ignition> = due.map(|(_, one)| *one).collect();
        if due.is_empty() && !self.due.is_empty() {
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
}

/// The pieces that flames may light, of all fires that spread so.
fn pieces_of(
    scene: &Scene,
    tables: &SpreadTables,
    due: &[(u32, layout::Ignition)],
) -> Result<Vec<(usize, u32, SpreadPiece)>, PlanError> {
    let mut pieces = Vec::new();
    let mut looked_at = 0;
    for ((slot, (fire, spread)), first_face) in
        (0..).zip(spreads_of(scene)).zip(tables.first_faces())
    {
        let Some(points) = spread.catch_points else {
            continue;
        };
        let key = name_key(scene.seed, &scene.fires[fire].name, CATCH_TAG);
        for (nth, faces) in (0..).zip(spread.surface.pieces()) {
            let (first, count) = (first_face + faces.start, faces.len() as u32);
            looked_at += count;
            let within =
                |ignition: &layout::Ignition| (first..first + count).contains(&ignition.kinds[0]);
            let begins = due.iter().filter(|(_, ignition)| within(ignition));
            let piece = SpreadPiece {
                ball: spread.surface.ball_around(faces).map(|x| snap(x as f32)),
                faces: [first, count, slot, pieces.len() as u32],
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

/// Whether the scene that holds from that frame on leaves alone what burns already of the one that holds
/// until then.
pub(crate) fn check_ignitions(
    before: &Scene,
    (from, scene): (u32, &Scene),
) -> Result<(), PlanError> {
    let begun = |scene: &Scene| -> Vec<Vec<(usize, Ignition)>> {
        let of_spread = |ignitions: &[Ignition]| {
            let all = ignitions.iter().copied().enumerate();
            all.filter(|(_, one)| one.first_frame < from).collect()
        };
        spreads_of(scene)
            .map(|(_, spread)| of_spread(&spread.ignitions))
            .collect()
    };
    let (then, now) = (begun(before), begun(scene));
    let Some(slot) = then.iter().zip(&now).position(|(then, now)| then != now) else {
        return Ok(());
    };
    let fire = spreads_of(before).nth(slot);
    let name = fire.map_or("", |(at, _)| before.fires[at].name.as_str());
    Err(PlanError {
        message: format!(
            "the change at frame {from} alters where `fire.{name}` has begun to burn before"
        ),
        help: format!(
            "those of `ignition` whose first_frame is below {from} stay as they are, and come first; others \
             may come and go"
        ),
        key: None,
    })
}
