//! The stages of fires that spread. Insertion and its books are plain Rust.

pub mod arrive;
pub mod block;
pub mod catch;
pub mod drop;
pub mod front;
pub mod gaps;
pub mod insert;
mod unfold;
pub mod walk;

use std::sync::Arc;

use rayon::prelude::*;

use crate::cpu::draw::{front_lines, marks, smoke};
use crate::cpu::drops::rest_of;
use crate::exact::bits_of;
use crate::layout::{
    Cover, DroppedFlame, FLAME_STEPS, GAP_CAME_TO_REST, GAP_DROPS_SHIFT, GAP_INSERTS, GAP_MOVES,
    Ignition, POINT_MOVES, SpreadCounts, SpreadPiece, SpreadPoint, Walker,
};
use crate::plan::{FrameInputs, Plan, SpreadTables};

/// Points that a task takes at a time, at least.
const GRAIN: usize = 256;

/// All control points of a run.
#[derive(Debug)]
pub(super) struct Spreads {
    tables: Arc<SpreadTables>,
    /// In the order of rings, and along them.
    pub(super) points: Vec<SpreadPoint>,
    /// The same after their steps.
    pub(super) moved: Vec<SpreadPoint>,
    /// What walked for them.
    walkers: Vec<Walker>,
    /// First and last point of each ring.
    pub(super) ring_spans: Vec<[u32; 2]>,
    pub(super) counts: SpreadCounts,
    /// Of each piece, whether a flame has met it in this frame, and where.
    pub(super) catches: Vec<[u32; 4]>,
    /// Flame k in place k modulo their number.
    pub(super) dropped: Vec<DroppedFlame>,
    capacity: u32,
    flame_room: u32,
    has_marks: bool,
    has_lines: bool,
    has_smoke: bool,
}

impl Spreads {
    pub(super) fn new(plan: &Plan) -> Self {
        Self {
            tables: Arc::clone(&plan.spreads),
            points: Vec::new(),
            moved: Vec::new(),
            walkers: Vec::new(),
            ring_spans: vec![[0; 2]; plan.ring_count as usize],
            counts: SpreadCounts::default(),
            catches: vec![[0; 4]; plan.ignitions.piece_count() as usize],
            dropped: vec![DroppedFlame::default(); plan.dropped_places as usize],
            flame_room: plan.dropped_capacity,
            has_marks: plan.uses.marks,
            has_lines: plan.uses.front_lines,
            has_smoke: plan.uses.smokes,
            capacity: plan.point_capacity,
        }
    }

    /// Puts the words of a front in place of it: counts, spans of rings, points.
    pub(super) fn put(&mut self, front: &[u32]) {
        if front.is_empty() {
            return;
        }
        let (counts, rest) = front.split_at(size_of::<SpreadCounts>() / 4);
        let (spans, rest) = rest.split_at(2 * self.ring_spans.len());
        let flames = self.dropped.len() * (size_of::<DroppedFlame>() / 4);
        let (flames, rest) = rest.split_at(flames);
        let (catches, points) = rest.split_at(4 * self.catches.len());
        bytemuck::cast_slice_mut(&mut self.catches).copy_from_slice(catches);
        bytemuck::cast_slice_mut(&mut self.dropped).copy_from_slice(flames);
        bytemuck::cast_slice_mut(std::slice::from_mut(&mut self.counts)).copy_from_slice(counts);
        bytemuck::cast_slice_mut(&mut self.ring_spans).copy_from_slice(spans);
        self.points = bytemuck::cast_slice(points).to_vec();
    }

    fn span(&self, ring: u32) -> [u32; 2] {
        self.ring_spans[ring as usize]
    }

    /// Control points advance over the surface.
    pub(super) fn front(&mut self, inputs: &FrameInputs) {
        let (tables, points) = (&self.tables, &self.points);
        let step = |at: usize| {
            let walker = front::front(inputs, tables, points, &self.ring_spans, at as u32);
            walk::walk(&walker, &tables.edges)
        };
        let all = (0..points.len()).into_par_iter().with_min_len(GRAIN);
        all.map(step).collect_into_vec(&mut self.walkers);
        self.arrive();
    }

    fn arrive(&mut self) {
        let (tables, points) = (&self.tables, &self.points);
        let arrived = |(point, walker)| arrive::arrive(point, walker, &tables.faces);
        let all = points.par_iter().zip(&self.walkers).with_min_len(GRAIN);
        all.map(arrived).collect_into_vec(&mut self.moved);
    }

    /// Control points that would enter what has burnt stop there.
    pub(super) fn block(&mut self, inputs: &FrameInputs) {
        let crowd = &block::enlist(inputs, &self.points);
        let steps = block::Steps {
            tables: &self.tables,
            before: &self.points,
            after: &self.moved,
            ring_spans: &self.ring_spans,
        };
        let walkers = self.walkers.par_iter_mut().with_min_len(GRAIN);
        walkers.enumerate().for_each(|(at, walker)| {
            if let Some(anew) = block::block(inputs, steps, crowd, at as u32, walker) {
                *walker = walk::walk(&anew, &steps.tables.edges);
            }
        });
        self.arrive();
    }

    /// The flame that is so far behind the first that burns, if it has been dropped.
    pub(super) fn burning(&self, at: u32) -> Option<&DroppedFlame> {
        let number = self.counts.flames_first + at;
        (number < self.counts.flames_total).then(|| self.flame(number))
    }

    /// What covers: the places of dropped flames, the fronts, and smoke.
    pub(super) fn shapes(&self, inputs: &FrameInputs, covers: &mut Vec<Cover>) -> [usize; 3] {
        let before = covers.len();
        if self.has_marks {
            let numbers = self.counts.marks_first..self.counts.flames_total;
            let marks = numbers.into_par_iter().with_min_len(GRAIN);
            covers.par_extend(marks.map(|number| marks::marks(inputs, self.flame(number))));
        }
        let marks = covers.len() - before;
        if self.has_lines {
            let points = self.points.par_iter().with_min_len(GRAIN).enumerate();
            covers.par_extend(points.map(|(at, point)| {
                let [first, last] = self.span(point.ring()).map(|at| at as usize);
                let next = &self.points[if at == last { first } else { at + 1 }];
                front_lines::front_lines(inputs, &self.tables, point, next)
            }));
        }
        let lines = covers.len() - before - marks;
        if self.has_smoke {
            let numbers = self.counts.marks_first..self.counts.flames_total;
            let puffs = numbers.into_par_iter().with_min_len(GRAIN);
            covers.par_extend(puffs.map(|number| smoke::smoke(inputs, self.flame(number))));
        }
        [marks, lines, covers.len() - before - marks - lines]
    }

    fn flame(&self, number: u32) -> &DroppedFlame {
        &self.dropped[number as usize % self.dropped.len()]
    }

    /// Flames go out, and points drop others; the books of that.
    fn drop_flames(&mut self, inputs: &FrameInputs, gaps: &[(u32, Walker)]) -> SpreadCounts {
        let age = |flame: &DroppedFlame| inputs.frame.frame.wrapping_sub(flame.normal_and_birth[3]);
        let is_out = |flame: &DroppedFlame, since: u32| {
            let [_, _, lifetime, _] = flame.identity;
            lifetime > 0 && age(flame) >= lifetime + since
        };
        let total = self.counts.flames_total;
        let flames = || (self.counts.flames_first..total).map(|number| self.flame(number));
        let burning = flames().filter(|flame| !is_out(flame, 0)).count() as u32;
        let died = flames().filter(|flame| is_out(flame, 0) && !is_out(flame, 1));
        let died = died.count() as u32;
        let out = flames().take_while(|flame| is_out(flame, 0)).count() as u32;
        let first = self.counts.flames_first + out;
        let requested = gaps.iter().map(|(flags, _)| flags >> GAP_DROPS_SHIFT).sum();
        let born = self.flame_room - (total - first);
        let born = born.min(requested);
        let room = self.dropped.len() as u32;
        let marks = (total + born).saturating_sub(room);
        let marks = marks.max(self.counts.marks_first);
        let (tables, mut number) = (Arc::clone(&self.tables), total);
        for (point, (flags, _)) in self.moved.iter().zip(gaps) {
            let drops = (flags >> GAP_DROPS_SHIFT).min(total + born - number);
            for flame in drop::drop(inputs, &tables, point, number, drops) {
                let at = number as usize % self.dropped.len();
                self.dropped[at] = flame;
                number += 1;
            }
        }
        SpreadCounts {
            flames_total: number,
            flames_first: first,
            flames_requested: requested,
            flames_born: born,
            flames_died: died,
            flames_live: burning + born,
            marks_first: marks,
            marks_died: marks - self.counts.marks_first,
            ..SpreadCounts::default()
        }
    }

    /// Where flames meet pieces that do not burn; `burns` says which flames do.
    pub(super) fn catch(
        &mut self,
        inputs: &FrameInputs,
        steps: &[[u32; 4]],
        burns: impl Fn(u32) -> bool + Sync,
    ) {
        const STEPS: u32 = FLAME_STEPS - 1;
        let (tables, spans) = (&self.tables, &self.ring_spans);
        let flames = steps.len() as u32 / FLAME_STEPS;
        let of = |piece: &SpreadPiece| {
            if piece.faces[1] == 0 || spans[piece.faces[3] as usize][1] > 0 {
                return [0; 4];
            }
            let first = (0..flames * STEPS)
                .into_par_iter()
                .with_min_len(GRAIN)
                .find_first(|at| burns(at / STEPS) && catch::meets(tables, piece, steps, *at));
            first.map_or([0; 4], |at| catch::caught(tables, piece, steps, at))
        };
        self.catches = inputs.spread_pieces.iter().map(of).collect();
    }

    /// The rings that begin: those that are due, then those of pieces that flames have met.
    fn beginning(&self, inputs: &FrameInputs) -> Vec<Ignition> {
        let of = |(piece, caught): (&SpreadPiece, &[u32; 4])| {
            let [met, face, x, y] = *caught;
            let [points, key, share, _] = piece.ring;
            (met > 0).then(|| Ignition {
                place: [x, y, share, 0].map(f32::from_bits),
                kinds: [face, points, piece.faces[2], key],
                order: [0, piece.faces[3], 0, 0],
            })
        };
        let caught = inputs
            .spread_pieces
            .iter()
            .zip(&self.catches)
            .filter_map(of);
        inputs.due_ignitions.iter().copied().chain(caught).collect()
    }

    /// Points come between neighbours that are too far apart, and rings begin.
    pub(super) fn insert(&mut self, inputs: &FrameInputs) {
        let frame = inputs.frame.frame;
        let tables = Arc::clone(&self.tables);
        let gap = |at: usize| -> (u32, Walker) {
            let span = self.span(self.moved[at].ring());
            let (flags, walker) =
                gaps::gaps(inputs, &tables, &self.points, &self.moved, span, at as u32);
            let walker = walk::walk(&walker, &tables.edges);
            let is_off = walker.place[3] != POINT_MOVES;
            (if is_off { flags & !GAP_INSERTS } else { flags }, walker)
        };
        let all = (0..self.moved.len()).into_par_iter().with_min_len(GRAIN);
        let gaps: Vec<(u32, Walker)> = all.map(gap).collect();
        let has = |flag: u32| gaps.iter().filter(|(flags, _)| flags & flag != 0).count() as u32;
        let before = self.moved.len() as u32;
        let wanted = has(GAP_INSERTS);
        let inserted = wanted.min(self.capacity - before);
        let flames = self.drop_flames(inputs, &gaps);
        let counted = |at: usize| {
            let mut point = self.moved[at];
            let spread = &inputs.spreads[point.position[3] as usize];
            let drops = gaps[at].0 >> GAP_DROPS_SHIFT;
            point.path[0] = bits_of(rest_of(spread, f32::from_bits(point.path[0]), drops));
            point
        };
        self.points.clear();
        let mut left = inserted;
        for (at, (flags, walker)) in gaps.iter().enumerate() {
            let point = counted(at);
            self.points.push(point);
            if flags & GAP_INSERTS != 0 && left > 0 {
                left -= 1;
                let after = counted(walker.left[2] as usize);
                let faces = &tables.faces;
                self.points
                    .push(insert::insert(frame, walker, &point, &after, faces));
            }
        }
        let ignited_from = self.points.len() as u32;
        let beginning = self.beginning(inputs);
        let due: u32 = beginning.iter().map(|one| one.kinds[1]).sum();
        let ignited = if due <= self.capacity - ignited_from {
            for ignition in &beginning {
                let ring = (0..ignition.kinds[1])
                    .map(|nth| insert::ignite(frame, ignition, nth, &tables.faces));
                self.points.extend(ring);
            }
            due
        } else {
            0
        };
        let mut at = 0;
        for ring in self.points.chunk_by(|a, b| a.ring() == b.ring()) {
            let end = at + ring.len() as u32;
            self.ring_spans[ring[0].ring() as usize] = [at, end - 1];
            at = end;
        }
        self.counts = SpreadCounts {
            total: ignited_from + ignited,
            live: has(GAP_MOVES) + inserted + ignited,
            requested: wanted + due,
            born: inserted + ignited,
            died: has(GAP_CAME_TO_REST),
            before,
            inserted,
            ignited_from,
            ..flames
        };
    }
}
