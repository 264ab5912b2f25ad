//! The frame, stage by stage. Reading the table is reading the frame.

use super::FrameInputs;
use crate::layout::{FIRE_STRIP, FireFrame, SPREAD_BLOCKS, SpreadFrame};

/// A stage of a frame. Backends expand each into their own passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Systems that others bear: births, deaths, places, parameters.
    Tree,
    /// Control points of fires that spread go over their surfaces.
    Front,
    /// Control points stop where it has burnt.
    Block,
    /// Control points come between others, and rings begin.
    Insert,
    /// How many particles each system bears, and where they go.
    Births,
    /// Attributes of the newborn.
    Emit,
    /// Who dies.
    Cull,
    /// Survivors move, and take their compacted places.
    Advance,
    /// Boids where they are at first.
    Hatch,
    /// Boids sorted by grid cell.
    Cells,
    /// Boids look around, steer and move.
    Steer,
    /// Where flames stand in this frame, and how large they are.
    Kindle,
    /// The trajectories of flames through the wind.
    Trace,
    /// Where flames meet what does not burn yet.
    Catch,
    /// Flames give light to the points that stand for them.
    Lights,
    /// Particles give theirs.
    Clusters,
    /// The ground, in that light.
    Ground,
    /// Triangles, lit.
    Surface,
    /// How much of the light comes to the parts of clouds.
    Shade,
    /// What covers, as it is seen.
    Shapes,
    /// What covers, from near to far, in every pixel.
    Cover,
    /// The planet, and on it what shows of the particles behind it.
    Planet,
    /// Particles add their light.
    Splat,
    /// Particles along flames, as they are seen.
    FlameDiscs,
    /// Flames add their light.
    Glow,
    /// Strips along flames add theirs.
    Strips,
    /// Light becomes pixels.
    Resolve,
}

/// A line of [`STAGES`].
#[derive(Clone, Copy, Debug)]
pub struct StageInfo {
    /// Which stage.
    pub stage: Stage,
    /// Its basename, the same in `wgsl/` and `src/cpu/`.
    pub name: &'static str,
    /// Buffers that it reads, by name.
    pub reads: &'static [&'static str],
    /// Buffers that it leaves changed, by name; the state among them is what backends are compared by.
    pub writes: &'static [&'static str],
    /// Whether it belongs to drawing, not to the simulation.
    pub draws: bool,
}

/// Every stage in frame order (Reeves 1983, section 2: generate, assign, extinguish, move, render;
/// flocks are all there from the first frame on, and look before they move; Perry 1994, 3.2: flames
/// are traced anew in every frame).
pub static STAGES: &[StageInfo] = &[
    StageInfo {
        stage: Stage::Tree,
        name: "pose",
        reads: &[
            "frame",
            "system_frames",
            "rows",
            "broods",
            "row_spreads",
            "poses",
            "nodes",
            "mesh_faces",
            "mesh_choices",
        ],
        writes: &["nodes", "tree_counts", "poses", "system_frames", "rows"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Front,
        name: "front",
        reads: &[
            "frame",
            "fires",
            "winds",
            "spreads",
            "spread_faces",
            "spread_edges",
            "spread_features",
            "spread_counts",
            "ring_spans",
            "control_points",
        ],
        writes: &["moved_points"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Block,
        name: "block",
        reads: &[
            "spreads",
            "spread_faces",
            "spread_edges",
            "spread_counts",
            "ring_spans",
            "control_points",
            "moved_points",
        ],
        writes: &["moved_points"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Insert,
        name: "insert",
        reads: &[
            "frame",
            "spreads",
            "due_ignitions",
            "spread_faces",
            "spread_edges",
            "spread_counts",
            "ring_spans",
            "control_points",
            "moved_points",
            "fires",
            "dropped_flames",
            "spread_pieces",
            "catches",
        ],
        writes: &[
            "control_points",
            "ring_spans",
            "spread_counts",
            "dropped_flames",
        ],
        draws: false,
    },
    StageInfo {
        stage: Stage::Births,
        name: "births",
        reads: &["frame", "system_frames", "counts"],
        writes: &["birth_counts", "birth_offsets", "counts", "deaths"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Emit,
        name: "emit",
        reads: &[
            "frame",
            "system_frames",
            "rows",
            "birth_offsets",
            "counts",
            "curve_points",
            "mesh_faces",
            "mesh_choices",
        ],
        writes: &["particles"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Cull,
        name: "cull",
        reads: &[
            "frame",
            "system_frames",
            "rows",
            "counts",
            "particles",
            "bounds",
        ],
        writes: &["alive_bits", "deaths"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Advance,
        name: "advance",
        reads: &[
            "frame",
            "system_frames",
            "alive_bits",
            "deaths",
            "tree_counts",
            "spread_counts",
            "particles",
            "winds",
        ],
        writes: &["particles", "counts", "statistics"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Hatch,
        name: "hatch",
        reads: &["flocks"],
        writes: &["boids", "boid_trails"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Cells,
        name: "cells",
        reads: &["frame", "flocks", "boids"],
        writes: &["boid_cells", "cell_starts", "sorted_boids"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Steer,
        name: "steer",
        reads: &[
            "frame",
            "flocks",
            "relations",
            "obstacles",
            "solid_faces",
            "winds",
            "cell_starts",
            "sorted_boids",
        ],
        writes: &["boids", "boid_trails"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Kindle,
        name: "kindle",
        reads: &[
            "frame",
            "fires",
            "listed_flames",
            "mesh_faces",
            "mesh_choices",
            "spread_counts",
            "dropped_flames",
        ],
        writes: &["flames"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Trace,
        name: "trace",
        reads: &["frame", "fires", "flames", "winds"],
        writes: &["flame_steps"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Catch,
        name: "catch",
        reads: &[
            "flames",
            "flame_steps",
            "ring_spans",
            "spread_pieces",
            "spread_faces",
            "spread_edges",
        ],
        writes: &["catches"],
        draws: false,
    },
    StageInfo {
        stage: Stage::Lights,
        name: "gather",
        reads: &["fires", "flames", "flame_steps", "light_roots"],
        writes: &["flame_sums", "flame_lights"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Clusters,
        name: "cluster",
        reads: &["frame", "system_frames", "rows", "counts", "particles"],
        writes: &["cluster_span", "cluster_sums", "cluster_lights"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Ground,
        name: "ground",
        reads: &[
            "frame",
            "grounds",
            "pillars",
            "lamps",
            "flame_lights",
            "cluster_lights",
        ],
        writes: &["ground_pixels"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Surface,
        name: "surface",
        reads: &[
            "frame",
            "surfaces",
            "surface_corners",
            "surface_light",
            "lamps",
            "flame_lights",
            "cluster_lights",
            "pillars",
        ],
        writes: &["surface_nearness", "surface_faces", "surface_pixels"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Shade,
        name: "shade",
        reads: &[
            "frame",
            "shade_box",
            "system_frames",
            "rows",
            "counts",
            "particles",
        ],
        writes: &["shade_sums", "shade_light"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Shapes,
        name: "shapes",
        reads: &[
            "frame",
            "system_frames",
            "rows",
            "counts",
            "particles",
            "flocks",
            "boids",
            "boid_trails",
            "fires",
            "spreads",
            "spread_faces",
            "spread_counts",
            "ring_spans",
            "control_points",
            "dropped_flames",
            "winds",
            "layer_planes",
            "stroke_light",
            "shade_box",
            "shade_light",
            "lamps",
        ],
        writes: &["covers", "cover_counts"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Cover,
        name: "cover",
        reads: &["frame", "covers", "cover_counts", "surface_nearness"],
        writes: &["cover_rg", "cover_bt", "cover_front", "surface_pixels"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Planet,
        name: "planet",
        reads: &[
            "frame",
            "planets",
            "lamps",
            "cluster_lights",
            "system_frames",
            "rows",
            "counts",
            "particles",
            "layer_planes",
            "surface_nearness",
        ],
        writes: &["planet_pixels", "light_low", "light_high"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Splat,
        name: "splat",
        reads: &[
            "frame",
            "system_frames",
            "rows",
            "counts",
            "particles",
            "layer_planes",
            "surface_nearness",
        ],
        writes: &["light_low", "light_high"],
        draws: true,
    },
    StageInfo {
        stage: Stage::FlameDiscs,
        name: "flame_discs",
        reads: &[
            "frame",
            "fires",
            "age_looks",
            "flames",
            "flame_steps",
            "layer_planes",
        ],
        writes: &["flame_discs", "flame_skews", "flame_bounds"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Glow,
        name: "glow",
        reads: &[
            "frame",
            "fires",
            "age_looks",
            "flames",
            "flame_steps",
            "layer_planes",
            "surface_nearness",
            "flame_discs",
            "flame_skews",
            "flame_bounds",
        ],
        writes: &[
            "light_low",
            "light_high",
            "flame_discs",
            "flame_skews",
            "flame_bounds",
        ],
        draws: true,
    },
    StageInfo {
        stage: Stage::Strips,
        name: "strips",
        reads: &[
            "frame",
            "fires",
            "age_looks",
            "flames",
            "flame_steps",
            "layer_planes",
            "surface_nearness",
        ],
        writes: &["strip_joints", "light_low", "light_high"],
        draws: true,
    },
    StageInfo {
        stage: Stage::Resolve,
        name: "resolve",
        reads: &[
            "frame",
            "light_low",
            "light_high",
            "ground_pixels",
            "planet_pixels",
            "surface_pixels",
            "cover_rg",
            "cover_bt",
        ],
        writes: &["image"],
        draws: true,
    },
];

impl Stage {
    /// Whether the stage has anything to do in that frame.
    pub(crate) fn is_due(self, inputs: &FrameInputs) -> bool {
        match self {
            Self::Tree => !inputs.broods.is_empty(),
            Self::Planet => !inputs.planets.is_empty(),
            Self::Ground => !inputs.grounds.is_empty(),
            Self::Surface => !inputs.surface_lights.is_empty(),
            Self::Shade => !inputs.shade_boxes.is_empty(),
            Self::Lights => {
                let is_lit = !inputs.grounds.is_empty() || !inputs.surface_lights.is_empty();
                is_lit && !inputs.fires.is_empty()
            }
            Self::Clusters => {
                !inputs.planets.is_empty()
                    || !inputs.grounds.is_empty()
                    || !inputs.surfaces.is_empty()
            }
            Self::Front | Self::Insert => !inputs.spreads.is_empty(),
            Self::Block => {
                let blocks = |spread: &SpreadFrame| spread.kinds[1] & SPREAD_BLOCKS != 0;
                inputs.spreads.iter().any(blocks)
            }
            Self::Catch => !inputs.spread_pieces.is_empty(),
            Self::Hatch => inputs.hatches && !inputs.flocks.is_empty(),
            Self::Cells | Self::Steer => !inputs.flocks.is_empty(),
            Self::Kindle | Self::Trace | Self::FlameDiscs | Self::Glow => !inputs.fires.is_empty(),
            Self::Strips => {
                let is_strip = |fire: &FireFrame| fire.kinds[3] & FIRE_STRIP != 0;
                inputs.fires.iter().any(is_strip)
            }
            _ => true,
        }
    }

    /// The stage's line in [`STAGES`].
    pub fn info(self) -> &'static StageInfo {
        STAGES
            .iter()
            .find(|info| info.stage == self)
            .expect("the table has a line for every stage")
    }
}
