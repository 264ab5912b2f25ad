//! The stages of flames.

pub mod kindle;
pub mod trace;

use std::sync::Arc;

use rayon::prelude::*;

use crate::backend::{BackendError, try_zeroed};
use crate::cpu::draw::flame_discs::flame_discs;
use crate::cpu::draw::glow::glow;
use crate::cpu::light::LightSums;
use crate::layout::{FLAME_STEPS, Flame, FlameDisc};
use crate::plan::{FrameInputs, MeshTables, Plan};

/// Steps of a flame.
const STEPS: usize = FLAME_STEPS as usize;

/// All fires of a run.
#[derive(Debug)]
pub(super) struct Flames {
    meshes: Arc<MeshTables>,
    /// In the order of fires and of indices.
    pub(super) flames: Vec<Flame>,
    /// The places of their particles.
    pub(super) steps: Vec<[u32; 4]>,
    /// The same as they are seen.
    pub(super) discs: Vec<FlameDisc>,
    /// Which pixels each flame touches, and its inner layer.
    pub(super) bounds: Vec<[u32; 4]>,
}

impl Flames {
    pub(super) fn new(plan: &Plan) -> Result<Self, BackendError> {
        let flames = plan.flame_count as usize;
        Ok(Self {
            meshes: Arc::clone(&plan.meshes),
            flames: try_zeroed(flames, "flames")?,
            steps: try_zeroed(flames * STEPS, "steps of flames")?,
            discs: try_zeroed(flames * STEPS, "particles of flames")?,
            bounds: try_zeroed(flames, "flames")?,
        })
    }

    pub(super) fn kindle(&mut self, inputs: &FrameInputs) {
        for (slot, fire) in (0..).zip(&inputs.fires) {
            let [first, count, ..] = fire.members.map(|word| word as usize);
            let meshes = &self.meshes;
            self.flames[first..first + count]
                .par_iter_mut()
                .with_min_len(256)
                .enumerate()
                .for_each(|(at, flame)| {
                    *flame = kindle::kindle(inputs, meshes, slot, at as u32);
                });
        }
    }

    pub(super) fn trace(&mut self, inputs: &FrameInputs) {
        self.steps
            .par_chunks_mut(STEPS)
            .zip(&self.flames)
            .with_min_len(64)
            .for_each(|(steps, flame)| trace::trace(inputs, flame, steps));
    }

    pub(super) fn discs(&mut self, inputs: &FrameInputs) {
        self.discs
            .par_chunks_mut(STEPS)
            .zip(self.steps.par_chunks(STEPS))
            .zip(&self.flames)
            .zip(&mut self.bounds)
            .with_min_len(64)
            .for_each(|(((discs, steps), flame), bounds)| {
                *bounds = flame_discs(inputs, flame, steps, discs);
            });
    }

    pub(super) fn glow(&self, light: &LightSums) {
        let discs = self.discs.par_chunks(STEPS);
        discs
            .zip(&self.bounds)
            .for_each(|(discs, bounds)| glow(discs, *bounds, light));
    }
}
