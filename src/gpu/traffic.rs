//! What each kernel of a frame works on, and the bytes that it must move at least: the measure of
//! its time. A kernel without a line here is timed, but held against nothing.
//!
//! Bytes are those that any program would have to move that does the kernel's work, from what the
//! kernel reads and writes: each record once, each way. What a cache or a register can hold (rows of
//! parameters, a frame's inputs, counts) is not counted.

use super::commands::STAGE_KERNELS;
use super::sort;
use crate::layout::{
    Boid, CLUSTER_LIGHTS, Cover, Dispatch, DroppedFlame, FLAME_LIGHTS, FLAME_STEPS, Flame,
    FlameDisc, FlameLight, Node, Particle, Pose, SpreadPoint, StripJoint, SystemFrame, SystemRow,
    Walker,
};
use crate::plan::{Stage, Uses};

/// How much there is to do in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Load {
    /// Particles alive after the frame's step.
    pub live: u64,
    /// Particles present in it: those alive before, and the newborn.
    pub total: u64,
    /// Births.
    pub born: u64,
    /// Pixels of the picture.
    pub pixels: u64,
    /// Pixels that some particle's light fell on.
    pub lit_pixels: u64,
    /// Particles left to the kernel for all but small discs.
    pub large: u64,
    /// Particle systems.
    pub systems: u64,
    /// Pages of a pool.
    pub pages: u64,
    /// Boids of all flocks.
    pub boids: u64,
    /// Cells of their grids.
    pub cells: u64,
    /// Flames of all fires.
    pub flames: u64,
    /// Those of them that control points may have dropped.
    pub dropped: u64,
    /// Records of places of dropped flames.
    pub marks: u64,
    /// Control points of fires that spread.
    pub points: u64,
    /// Records of what covers, those of nothing included.
    pub covers: u64,
    /// Those of them that are of boids, without their trails.
    pub boid_covers: u64,
    /// Those of them that are of boids' trails.
    pub trail_segments: u64,
    /// Those of them that are of strokes.
    pub stroke_covers: u64,
    /// Those of them that are in sight.
    pub seen_covers: u64,
    /// Cells in which clouds throw shadows on themselves.
    pub shade_cells: u64,
    /// Triangles of surfaces.
    pub faces: u64,
    /// Pixels with some triangle in them.
    pub surface_pixels: u64,
    /// What the plan makes use of.
    pub uses: Uses,
}

/// What a pass works on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Particles, words, pixels: whatever it takes one by one.
    pub items: u64,
    /// Bytes that it must move at least.
    pub bytes: u64,
}

/// Bytes a particle.
const PARTICLE: u64 = size_of::<Particle>() as u64;

/// Bytes a boid.
const BOID: u64 = size_of::<Boid>() as u64;

/// Bytes a flame, those of the places of its particle, and of them as they are seen.
const FLAME: u64 = size_of::<Flame>() as u64;
const DROPPED: u64 = size_of::<DroppedFlame>() as u64;
const FLAME_PLACES: u64 = FLAME_STEPS as u64 * 16;
const FLAME_DISCS: u64 = FLAME_STEPS as u64 * size_of::<FlameDisc>() as u64;

/// Bytes of the joints of a strip along a flame.
const STRIP_JOINTS: u64 = FLAME_STEPS as u64 * size_of::<StripJoint>() as u64;

/// Bytes a control point, and what walks for it.
const POINT: u64 = size_of::<SpreadPoint>() as u64;
const WALKER: u64 = size_of::<Walker>() as u64;

/// Bytes a record of what covers.
const COVER: u64 = size_of::<Cover>() as u64;

/// Passes of the sort, and values of a digit.
const PASSES: u64 = sort::PASSES as u64;
const DIGITS: u64 = sort::DIGITS as u64;

/// Bytes of a word.
const WORD: u64 = 4;

/// Bytes of what particles give to the point lights that stand for them.
const CLUSTER_SUMS: u64 = CLUSTER_LIGHTS as u64 * 16 * WORD;

/// Bytes of one pixel's light in one of its two limbs.
const LIMB: u64 = 3 * WORD;

impl Load {
    /// Deaths.
    fn died(&self) -> u64 {
        self.total.saturating_sub(self.live)
    }

    /// Words of the bits of those present.
    fn words(&self) -> u64 {
        self.total.div_ceil(32)
    }

    /// Sums of 64 words each, and of 64 such sums each.
    fn sums(&self) -> (u64, u64) {
        let sums = self.words().div_ceil(64);
        (sums, sums.div_ceil(64))
    }

    /// Runs of 64 cells.
    fn cell_runs(&self) -> u64 {
        self.cells.div_ceil(64)
    }

    /// Cells with boids, at most.
    fn full_cells(&self) -> u64 {
        self.cells.min(self.boids)
    }

    /// Counts of digits in all passes of the sort.
    fn digit_counts(&self) -> u64 {
        PASSES * self.covers.div_ceil(sort::RUN.into()) * DIGITS
    }

    /// Words of bits, one a record in sight: each touches one tile at least.
    fn tile_words(&self) -> u64 {
        self.seen_covers.div_ceil(32)
    }

    /// The same of flames.
    fn flame_tile_words(&self) -> u64 {
        self.flames.div_ceil(32)
    }

    /// Bytes of what covers, read or written once in every pixel.
    fn covered(&self) -> u64 {
        if self.uses.covers {
            self.pixels * 4 * WORD
        } else {
            0
        }
    }

    /// Bytes that splatted light takes: one limb is read and written where light falls.
    fn light(&self) -> u64 {
        self.lit_pixels * 2 * LIMB
    }
}

/// A kernel's line: its items and its bytes.
type Line = (&'static str, fn(&Load) -> (u64, u64));

/// Every kernel of a frame, in order; `draw/clear_light` is a command between them.
static TABLE: &[Line] = &[
    ("tree/bear", |load| (load.systems, load.systems * WORD)),
    ("tree/settle", |load| (load.systems, load.systems * WORD)),
    ("tree/found", |load| (load.systems, load.systems * WORD)),
    ("tree/pose", |load| {
        let written = size_of::<Pose>() + size_of::<SystemFrame>() + size_of::<SystemRow>();
        let node = size_of::<Node>() + written;
        (load.systems, load.systems * node as u64)
    }),
    ("spread/front", |load| {
        (load.points, load.points * (POINT + WALKER))
    }),
    ("spread/walk", |load| {
        // Once for the front, once for what is inserted.
        (2 * load.points, 4 * load.points * WALKER)
    }),
    ("spread/arrive", |load| {
        (load.points, load.points * (2 * POINT + WALKER))
    }),
    ("spread/enlist", |load| {
        (load.points, load.points * (POINT / 4 + WORD))
    }),
    ("spread/block", |load| {
        (load.points, load.points * (2 * POINT + WALKER + WORD))
    }),
    ("spread/gaps", |load| {
        (load.points, load.points * (2 * POINT + WALKER + WORD))
    }),
    ("spread/sum_gaps", |load| {
        let runs = load.points.div_ceil(32);
        (load.points, load.points * WORD + runs * 4 * WORD)
    }),
    ("spread/burning", |load| {
        let runs = load.dropped.div_ceil(32);
        (load.dropped, load.dropped * DROPPED + runs * 2 * WORD)
    }),
    ("spread/book", |load| {
        let runs = load.points.div_ceil(32);
        (runs, runs * 8 * WORD)
    }),
    // Few points drop a flame in a frame.
    ("spread/drop", |load| (load.points, load.points * WORD)),
    ("spread/insert", |load| {
        let runs = load.points.div_ceil(32);
        (load.points, load.points * 2 * POINT + runs * 4 * WORD)
    }),
    // A ring in some frames.
    ("spread/ignite", |_| (1, POINT)),
    ("systems/births", |load| {
        let frame = size_of::<SystemFrame>() as u64;
        (load.systems, load.systems * (frame + WORD))
    }),
    ("systems/offsets", |load| {
        (load.systems, load.systems * 2 * WORD)
    }),
    ("particles/emit", |load| (load.born, load.born * PARTICLE)),
    ("particles/cull", |load| {
        // Who it is, in two words. They stand by age, so that of those who live on, the first of each
        // word of bits tells for all; unless it matters where each is.
        let read = if load.uses.bounds {
            load.total * PARTICLE
        } else {
            (load.died() + load.words()) * 2 * WORD
        };
        (load.total, read + load.words() * WORD)
    }),
    ("scan/count_bits", |load| {
        let (sums, _) = load.sums();
        (load.words(), (load.words() + sums) * WORD)
    }),
    ("scan/sum_runs", |load| {
        let (sums, of_sums) = load.sums();
        (sums, (sums + of_sums) * WORD)
    }),
    ("scan/survivors", |load| {
        let (_, of_sums) = load.sums();
        (of_sums, of_sums * 2 * WORD)
    }),
    ("scan/spread_runs", |load| {
        let (sums, of_sums) = load.sums();
        (sums, (2 * sums + of_sums) * WORD)
    }),
    ("scan/spread_bits", |load| {
        let (sums, _) = load.sums();
        (load.words(), (2 * load.words() + sums) * WORD)
    }),
    ("scan/pages", |load| {
        let pairs = load.pages * (load.pages + 1) / 2;
        let dispatches = (load.pages + pairs) * size_of::<Dispatch>() as u64;
        (pairs, dispatches + 2 * load.pages * WORD)
    }),
    ("particles/advance", |load| {
        // Only survivors are read; of all, the bits and where they go.
        let bits = load.words() * 2 * WORD;
        (load.total, load.live * 2 * PARTICLE + bits)
    }),
    ("flock/hatch", |load| (load.boids, load.boids * BOID)),
    ("flock/count_cells", |load| {
        let each = BOID / 2 + WORD;
        (load.boids, load.boids * each + load.full_cells() * 2 * WORD)
    }),
    ("flock/sum_cells", |load| {
        (load.cells, (load.cells + load.cell_runs()) * WORD)
    }),
    ("flock/cell_offsets", |load| {
        (load.cell_runs(), load.cell_runs() * 2 * WORD)
    }),
    ("flock/spread_cells", |load| {
        (load.cells, (2 * load.cells + load.cell_runs()) * WORD)
    }),
    ("flock/cell_members", |load| {
        let cells = load.full_cells() * 3 * WORD;
        (load.boids, load.boids * 2 * WORD + cells)
    }),
    ("flock/cells", |load| {
        let each = 2 * BOID + 2 * WORD;
        (load.boids, load.boids * each + load.full_cells() * WORD)
    }),
    ("flock/steer", |load| {
        (load.boids, load.boids * 2 * BOID + load.full_cells() * WORD)
    }),
    // But for crowds it does nothing.
    ("flock/steer_again", |_| (0, 0)),
    ("flames/kindle", |load| (load.flames, load.flames * FLAME)),
    ("flames/dropped", |load| {
        (load.dropped, load.dropped * (DROPPED + FLAME))
    }),
    ("flames/trace", |load| {
        // Wind is looked up at every place.
        let places = load.flames * u64::from(FLAME_STEPS);
        (places, load.flames * (FLAME + FLAME_PLACES))
    }),
    ("spread/catch", |load| {
        let steps = load.flames * u64::from(FLAME_STEPS - 1);
        (steps, load.flames * (FLAME + FLAME_PLACES))
    }),
    // A piece in some frames.
    ("spread/caught", |_| (1, 4 * WORD)),
    ("flames/shine", |load| {
        (load.flames, load.flames * (FLAME + FLAME_PLACES))
    }),
    ("flames/gather", |_| {
        let lights = u64::from(FLAME_LIGHTS);
        (lights, lights * (8 * WORD + size_of::<FlameLight>() as u64))
    }),
    ("particles/span", |load| {
        (load.live, load.live * PARTICLE + 7 * WORD)
    }),
    ("particles/shed", |load| {
        (load.live, load.live * PARTICLE + CLUSTER_SUMS)
    }),
    ("particles/cluster", |_| {
        let lights = u64::from(CLUSTER_LIGHTS) * size_of::<FlameLight>() as u64;
        (CLUSTER_LIGHTS.into(), CLUSTER_SUMS + lights)
    }),
    ("draw/ground", |load| (load.pixels, load.pixels * 4 * WORD)),
    ("draw/surface_raster", |load| {
        // Places of corners, and where triangles are seen, a sample's nearness and its name, once.
        let samples = load.surface_pixels * 4 * 2 * WORD;
        (load.faces, load.faces * 3 * 4 * WORD + samples)
    }),
    ("draw/surface_work", |_| {
        (1, WORD + size_of::<Dispatch>() as u64)
    }),
    ("draw/surface", |load| {
        (load.pixels, load.pixels * 12 * WORD)
    }),
    ("draw/deposit", |load| {
        (load.live, load.live * PARTICLE + load.shade_cells * WORD)
    }),
    ("draw/shade", |load| {
        (load.shade_cells, load.shade_cells * 2 * WORD)
    }),
    ("draw/shapes", |load| {
        (load.live, load.live * (PARTICLE + COVER))
    }),
    ("draw/boid_shapes", |load| {
        (load.boids, load.boids * BOID + load.boid_covers * COVER)
    }),
    ("draw/boid_trails", |load| {
        let records = load.trail_segments;
        (records, records * (4 * WORD + COVER))
    }),
    ("draw/marks", |load| {
        (load.marks, load.marks * (DROPPED + COVER))
    }),
    ("draw/front_lines", |load| {
        (load.points, load.points * (POINT + COVER))
    }),
    ("draw/smoke", |load| {
        (load.marks, load.marks * (DROPPED + COVER))
    }),
    ("draw/strokes", |load| {
        (load.live, load.live * PARTICLE + load.stroke_covers * COVER)
    }),
    ("draw/cover_work", |_| {
        // Counts of families, their sum, what the sort and one round are dispatched by.
        (1, 9 * WORD + 5 * size_of::<Dispatch>() as u64)
    }),
    ("draw/cover_keys", |load| {
        // What it is and its depth become a key and a value.
        (load.covers, load.covers * 4 * WORD)
    }),
    ("sort/count_digits", |load| {
        let keys = PASSES * load.covers;
        (keys, (keys + load.digit_counts()) * WORD)
    }),
    ("sort/sum_digits", |load| {
        let counts = load.digit_counts();
        (counts, (2 * counts + PASSES * DIGITS) * WORD)
    }),
    ("sort/start_digits", |_| {
        (PASSES * DIGITS, PASSES * DIGITS * 2 * WORD)
    }),
    ("sort/place_digits", |load| {
        let pairs = PASSES * load.covers;
        let starts = load.digit_counts() + PASSES * DIGITS;
        (pairs, (4 * pairs + starts) * WORD)
    }),
    ("draw/clear_tiles", |load| {
        (load.tile_words(), load.tile_words() * 2 * WORD)
    }),
    ("draw/bin", |load| {
        let each = 2 * WORD + 2 * COVER;
        let bits = load.tile_words() * 2 * WORD;
        (load.seen_covers, load.seen_covers * each + bits)
    }),
    ("draw/cover", |load| {
        let records = load.seen_covers * COVER + load.tile_words() * WORD;
        (load.pixels, load.covered() + records)
    }),
    ("draw/dim", |load| {
        let is_there = u64::from(load.uses.surfaces);
        (load.pixels * is_there, load.pixels * is_there * 9 * WORD)
    }),
    ("draw/planet", |load| (load.pixels, load.pixels * 4 * WORD)),
    ("draw/clear_light", |load| {
        (load.pixels, load.pixels * 2 * LIMB)
    }),
    ("draw/splat", |load| {
        (load.live, load.live * PARTICLE + load.light())
    }),
    ("draw/large_work", |load| {
        let dispatch = size_of::<Dispatch>() as u64;
        (load.pages, load.pages * (3 * WORD + dispatch))
    }),
    ("draw/splat_large", |load| {
        (load.large, load.large * (PARTICLE + WORD))
    }),
    ("draw/hide", |load| {
        (load.pixels, load.pixels * (WORD + 4 * LIMB))
    }),
    ("draw/flame_discs", |load| {
        let each = FLAME + FLAME_PLACES + FLAME_DISCS + 4 * WORD;
        (load.flames, load.flames * each)
    }),
    ("draw/clear_flame_tiles", |load| {
        (load.flame_tile_words(), load.flame_tile_words() * 2 * WORD)
    }),
    ("draw/bin_flames", |load| {
        let bits = load.flame_tile_words() * WORD;
        (load.flames, load.flames * 2 * WORD + bits)
    }),
    ("draw/glow_work", |_| {
        (1, WORD + size_of::<Dispatch>() as u64)
    }),
    ("draw/glow", |load| {
        (load.flames, load.flames * (FLAME_DISCS + 4 * WORD))
    }),
    ("draw/glow_small", |load| {
        (load.flames, load.flames * (FLAME_DISCS + 4 * WORD))
    }),
    ("draw/strip_joints", |load| {
        let each = FLAME + FLAME_PLACES + STRIP_JOINTS;
        (load.flames, load.flames * each)
    }),
    ("draw/strips", |load| {
        (load.flames, load.flames * STRIP_JOINTS)
    }),
    ("draw/resolve", |load| {
        let own = load.pixels * (2 * LIMB + WORD);
        (load.pixels, own + load.covered())
    }),
];

/// What `kernel` works on; `None` for one that nobody has counted.
pub fn traffic(kernel: &str, load: &Load) -> Option<Traffic> {
    let (_, of) = TABLE.iter().find(|(name, _)| *name == kernel)?;
    let (items, bytes) = of(load);
    Some(Traffic { items, bytes })
}

/// Bytes that the sort of so many pairs must move at least, all of its passes.
pub fn sort_bytes(pairs: u64) -> u64 {
    let load = Load {
        covers: pairs,
        ..Load::default()
    };
    let lines = TABLE.iter().filter(|(name, _)| name.starts_with("sort/"));
    lines.map(|(_, of)| of(&load).1).sum()
}

/// What a stage works on, whoever runs it: what its kernel of the same basename does; of a stage
/// that has none, all of its kernels together.
pub fn stage_traffic(stage: Stage, load: &Load) -> Option<Traffic> {
    let kernels = || {
        let of_stage = STAGE_KERNELS.iter().filter(move |of| of.stage == stage);
        of_stage.map(|of| of.kernel)
    };
    let basename = |kernel: &&str| kernel.rsplit('/').next() == Some(stage.info().name);
    if let Some(own) = kernels().find(basename) {
        return traffic(own, load);
    }
    let all: Vec<Traffic> = kernels()
        .filter_map(|kernel| traffic(kernel, load))
        .collect();
    let sum = |of: fn(&Traffic) -> u64| all.iter().map(of).sum();
    (!all.is_empty()).then(|| Traffic {
        items: all.iter().map(|of| of.items).max().unwrap_or(0),
        bytes: sum(|of| of.bytes),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kernel_of_a_frame_has_its_line_and_no_other_has() {
        let lines: Vec<_> = TABLE.iter().map(|(name, _)| *name).collect();
        let mut kernels: Vec<_> = STAGE_KERNELS.iter().map(|of| of.kernel).collect();
        let splat = kernels.iter().position(|name| *name == "draw/splat");
        kernels.insert(splat.expect("light is splatted"), "draw/clear_light");
        // Where there is a planet, particles behind it are splatted before those in front.
        let mut met = std::collections::HashSet::new();
        kernels.retain(|kernel| met.insert(*kernel));
        assert_eq!(lines, kernels);
    }
}
