//! The stages of flames.

pub mod dropped;
pub mod gather;
pub mod kindle;
pub mod shine;
pub mod trace;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::backend::{BackendError, try_zeroed};
use crate::cpu::draw::flame_discs::flame_discs;
use crate::cpu::draw::glow::{Onto, glow};
use crate::cpu::draw::strip_joints::strip_joints;
use crate::cpu::draw::strips::strips;
use crate::cpu::light::LightSums;
use crate::cpu::spread::Spreads;
use crate::layout::{FLAME_LIGHTS, FLAME_STEPS, Flame, FlameDisc, FlameLight, StripJoint};
use crate::plan::{DetailPass, FrameInputs, MeshTables, Plan};

/// Steps of a flame.
const STEPS: usize = FLAME_STEPS as usize;

/// All fires of a run.
#[derive(Debug)]
pub(super) struct Flames {
    meshes: Arc<MeshTables>,
    detail_passes: u32,
    /// How many of them control points may have dropped: the last.
    dropped_count: usize,
    /// In the order of fires and of indices.
    pub(super) flames: Vec<Flame>,
    /// The places of their particles.
    pub(super) steps: Vec<[u32; 4]>,
    /// The same as they are seen.
    pub(super) discs: Vec<FlameDisc>,
    /// What else leads from places back into them; empty if no particle has a matrix.
    pub(super) skews: Vec<[u32; 4]>,
    /// Where the strips along flames bend; empty if there are none.
    pub(super) joints: Vec<StripJoint>,
    /// Which pixels each flame touches, and its inner layer.
    pub(super) bounds: Vec<[u32; 4]>,
    /// What their point lights are given: the two halves of a weight and of x, y and z of each.
    pub(super) sums: Vec<u32>,
    /// Their point lights.
    pub(super) lights: Vec<FlameLight>,
}

impl Flames {
    pub(super) fn new(plan: &Plan) -> Result<Self, BackendError> {
        let flames = plan.flame_count as usize;
        let of_each = |is_used: bool| if is_used { flames * STEPS } else { 0 };
        Ok(Self {
            meshes: Arc::clone(&plan.meshes),
            detail_passes: plan.detail_passes,
            dropped_count: plan.dropped_capacity as usize,
            flames: try_zeroed(flames, "flames")?,
            steps: try_zeroed(flames * STEPS, "steps of flames")?,
            discs: try_zeroed(flames * STEPS, "particles of flames")?,
            skews: try_zeroed(of_each(plan.uses.skews), "particles of flames")?,
            joints: try_zeroed(of_each(plan.uses.strips), "strips along flames")?,
            bounds: try_zeroed(flames, "flames")?,
            sums: vec![0; 8 * FLAME_LIGHTS as usize],
            lights: vec![FlameLight::default(); FLAME_LIGHTS as usize],
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

    /// Those that control points have dropped stand behind all others.
    pub(super) fn kindle_dropped(&mut self, inputs: &FrameInputs, spreads: &Spreads) {
        let first = self.flames.len() - self.dropped_count;
        let flames = self.flames[first..].par_iter_mut().with_min_len(256);
        flames.enumerate().for_each(|(at, flame)| {
            let own = spreads.burning(at as u32);
            *flame = own.map_or_else(Flame::default, |own| dropped::dropped(inputs, own));
        });
    }

    pub(super) fn trace(&mut self, inputs: &FrameInputs) {
        self.steps
            .par_chunks_mut(STEPS)
            .zip(&self.flames)
            .with_min_len(64)
            .for_each(|(steps, flame)| trace::trace(inputs, flame, steps));
    }

    pub(super) fn gather(&mut self, inputs: &FrameInputs) {
        let sums: Vec<AtomicU64> = (0..4 * FLAME_LIGHTS).map(|_| AtomicU64::new(0)).collect();
        let flames = &self.flames;
        let steps = self.steps.par_chunks(STEPS);
        steps
            .zip(flames)
            .with_min_len(64)
            .for_each(|(steps, flame)| {
                if let Some((light, given)) = shine::shine(inputs, flame, steps, flames) {
                    let of_light = &sums[4 * light as usize..];
                    for (sum, steps) in of_light.iter().zip(given) {
                        sum.fetch_add(steps.into(), Ordering::Relaxed);
                    }
                }
            });
        let sums: Vec<u64> = sums.into_iter().map(AtomicU64::into_inner).collect();
        self.sums = sums
            .iter()
            .flat_map(|sum| [*sum as u32, (*sum >> 32) as u32])
            .collect();
        let (lights, _) = sums.as_chunks::<4>();
        self.lights = (0..)
            .zip(lights)
            .map(|(at, sums)| gather::gather(inputs, flames, at, *sums))
            .collect();
    }

    pub(super) fn discs(&mut self, inputs: &FrameInputs, pass: DetailPass) {
        let mut skews: Vec<&mut [[u32; 4]]> = self.skews.chunks_mut(STEPS).collect();
        skews.resize_with(self.flames.len(), Default::default);
        self.discs
            .par_chunks_mut(STEPS)
            .zip(skews)
            .zip(self.steps.par_chunks(STEPS))
            .zip(&self.flames)
            .zip(&mut self.bounds)
            .with_min_len(64)
            .for_each(|((((discs, skews), steps), flame), bounds)| {
                *bounds = flame_discs(inputs, flame, pass, steps, discs, skews);
            });
    }

    /// The light of all passes, of which that of no details is at hand.
    pub(super) fn glow(&mut self, inputs: &FrameInputs, light: &LightSums, nearness: &[[u32; 4]]) {
        let onto = Onto {
            frame: &inputs.frame,
            light,
            nearness,
        };
        self.glow_of_pass(onto);
        for at in 0..self.detail_passes {
            self.discs(inputs, DetailPass::nth(at));
            self.glow_of_pass(onto);
        }
    }

    fn glow_of_pass(&self, onto: Onto<'_>) {
        let discs = self.discs.par_chunks(STEPS);
        discs
            .zip(self.steps.par_chunks(STEPS))
            .zip(&self.bounds)
            .enumerate()
            .for_each(|(at, ((discs, steps), bounds))| {
                let skews = self.skews.chunks(STEPS).nth(at).unwrap_or(&[]);
                glow(discs, steps, skews, *bounds, onto);
            });
    }

    /// The light of strips.
    pub(super) fn strips(
        &mut self,
        inputs: &FrameInputs,
        light: &LightSums,
        nearness: &[[u32; 4]],
    ) {
        let onto = Onto {
            frame: &inputs.frame,
            light,
            nearness,
        };
        self.joints
            .par_chunks_mut(STEPS)
            .zip(self.steps.par_chunks(STEPS))
            .zip(&self.flames)
            .for_each(|((joints, steps), flame)| {
                strip_joints(inputs, flame, steps, joints);
                strips(inputs, flame, joints, onto);
            });
    }
}
