//! Systems that bear systems (Reeves 1983, 2.6): the kernels of `wgsl/tree/`, and what they share
//! (twin of `wgsl/lib/tree.wgsl`).

mod bear;
mod found;
mod inherit;
mod pose;
mod settle;

use glam::{UVec4, Vec4};

use crate::cpu::particles::emit::Stored;
use crate::exact::{f32_of_u32, shared_constants, snap};
use crate::layout::{Counts, Node, Pose, SystemFrame, SystemRow};
use crate::plan::{FrameInputs, Plan};
use crate::rng::{pcg4d, signed4};

shared_constants! {
    /// Stream of a system's key.
    pub const STREAM_SYSTEM: u32 = 0x7379_7374;
    /// Stream of what it has of its own.
    pub const STREAM_OWN: u32 = 0x6f77_6e00;
}

/// Rows of a 3 × 4 matrix.
type Rows = [[f32; 4]; 3];

/// Of the 3 × 4 identity.
const IDENTITY: Rows = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
];

/// First `inner`, then `outer`.
fn composed(outer: Rows, inner: Rows) -> Rows {
    let [x, y, z] = inner.map(Vec4::from);
    outer.map(|row| {
        let [a, b, c, d] = row;
        let turned = x * a + y * b + z * c;
        [turned.x, turned.y, turned.z, turned.w + d].map(snap)
    })
}

/// A place that has gone on for `frames` frames, on the parabola of its acceleration.
fn gone_on(place: Rows, velocity: [f32; 4], acceleration: [f32; 4], frames: f32) -> Rows {
    let mut rows = place;
    for i in 0..3 {
        rows[i][3] += velocity[i] * frames + acceleration[i] * (0.5 * frames * frames);
    }
    rows
}

/// Four numbers from -1 to 1 that the system of this key has for life.
fn own_numbers(key: u32, which: u32) -> Vec4 {
    signed4(pcg4d(UVec4::new(key, which, 0, STREAM_OWN)))
}

/// A polynomial of whole frames by its coefficients.
fn polynomial(c: [f32; 4], frames: u32) -> f32 {
    let n = f32_of_u32(frames);
    c[0] + n * (c[1] + n * (c[2] + n * c[3]))
}

/// The systems that others have borne.
#[derive(Debug, Default)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    /// By slot, the scene's own first.
    poses: Vec<Pose>,
    /// By slot from the first that is borne.
    pub(super) systems: Vec<SystemFrame>,
    pub(super) counts: Counts,
    levels: u32,
}

impl Tree {
    pub(super) fn new(plan: &Plan) -> Self {
        let borne = (plan.system_count - plan.own_system_count) as usize;
        Self {
            nodes: vec![Node::default(); borne],
            poses: vec![Pose::default(); plan.system_count as usize],
            systems: vec![SystemFrame::default(); borne],
            counts: Counts::default(),
            levels: plan.tree_levels,
        }
    }

    /// Takes all systems away that others have borne.
    pub(super) fn clear(&mut self) {
        self.nodes.fill(Node::default());
        self.counts = Counts::default();
    }

    /// Whether any system bears systems.
    pub(super) fn is_empty(&self) -> bool {
        self.levels == 0
    }

    /// The inputs with the systems that others have borne.
    pub(super) fn filled(&self, inputs: &FrameInputs) -> FrameInputs {
        let mut filled = inputs.clone();
        filled.systems.extend_from_slice(&self.systems);
        filled
    }

    /// Births, deaths and places of systems in the frame of `inputs`; `rows` is the ring of all.
    pub(super) fn step(
        &mut self,
        inputs: &FrameInputs,
        rows: &mut [SystemRow],
        stored: Stored<'_>,
    ) {
        let own = inputs.poses.len();
        self.poses[..own].copy_from_slice(&inputs.poses);
        for level in 0..self.levels {
            let births = bear::bear(inputs, &self.systems, &self.nodes, level);
            let newborn = settle::settle(
                &mut self.nodes,
                &mut self.counts,
                &births,
                inputs.frame.frame,
                level,
            );
            for born in newborn {
                self.nodes[born.at] =
                    found::found(inputs, stored, &self.systems, rows, &self.nodes, &born);
            }
            for at in 0..self.nodes.len() {
                pose::pose(self, at, inputs, rows, level);
            }
        }
    }
}
