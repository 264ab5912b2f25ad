//! The stages of fires that spread. Insertion and its books are plain Rust.

pub mod arrive;
pub mod block;
pub mod front;
pub mod gaps;
pub mod insert;
pub mod walk;

use std::sync::Arc;

use rayon::prelude::*;

use crate::layout::{
    GAP_CAME_TO_REST, GAP_INSERTS, GAP_MOVES, POINT_MOVES, SpreadCounts, SpreadPoint, Walker,
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
    capacity: u32,
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
            capacity: plan.point_capacity,
        }
    }

    /// Puts the words of a front in place of it: counts, spans of rings, points.
    pub(super) fn put(&mut self, front: &[u32]) {
        if front.is_empty() {
            return;
        }
        let (counts, rest) = front.split_at(size_of::<SpreadCounts>() / 4);
        let (spans, points) = rest.split_at(2 * self.ring_spans.len());
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
        self.points.clear();
        let mut left = inserted;
        for (point, (flags, walker)) in self.moved.iter().zip(&gaps) {
            self.points.push(*point);
            if flags & GAP_INSERTS != 0 && left > 0 {
                left -= 1;
                let after = &self.moved[walker.left[2] as usize];
                let faces = &tables.faces;
                self.points
                    .push(insert::insert(frame, walker, point, after, faces));
            }
        }
        let ignited_from = self.points.len() as u32;
        let due: u32 = inputs.due_ignitions.iter().map(|one| one.kinds[1]).sum();
        let ignited = if due <= self.capacity - ignited_from {
            for ignition in &inputs.due_ignitions {
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
        };
    }
}
