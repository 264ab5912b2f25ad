//! The plan's stages as dispatches: which kernels, in which order, on which buffers, and how much.

use std::collections::HashMap;

use super::GpuBackend;
use super::device::GpuDevice;
use super::dispatch::dispatch_for;
use super::flame_tiling::SMALL_SHARES;
use super::kernel::Kernel;
use super::sort;
use super::strip_shares::{PIECES, strip_runs, strip_shares_of};
use crate::backend::BackendError;
use crate::layout::{CLUSTER_LIGHTS, FLAME_LIGHTS, FLAME_STEPS};
use crate::plan::{DetailPass, Plan, Population, Stage};

/// How a stage uses a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelUse {
    /// The stage.
    pub stage: Stage,
    /// The kernel.
    pub kernel: &'static str,
    work: Work,
}

/// How much work a kernel has, and whether it is dispatched page by page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Work {
    /// One invocation in all.
    Once,
    /// One a system.
    Systems,
    /// At every step of the tree: one a slot, one in all, one a slot that others bear.
    TreeSlots,
    /// As above.
    TreeOnce,
    /// As above.
    TreeBorne,
    /// One for every four pixels.
    Pixels,
    /// As the dispatch at that place says.
    Listed(u32),
    /// Page by page, as emit's dispatches say.
    NewbornPages,
    /// Page by page, as the cull's dispatches say.
    PresentPages,
    /// For each page that survivors leave and each that they may go to.
    PagePairs,
    /// Page by page, as the splat's dispatches say.
    LivePages,
    /// The same, told whether of particles behind the planet (1) or of the others.
    SplatPages(u32),
    /// One a pixel.
    EachPixel,
    /// One invocation a page.
    OncePages,
    /// Page by page, as the dispatches for all but small discs say.
    LargePages,
    /// Flock by flock, one a boid.
    Boids,
    /// The same, if they may have been too many for the first time.
    BoidsAgain,
    /// The same, of flocks with trails.
    TrailedBoids,
    /// Fire by fire, one a flame.
    Fires,
    /// One a flame that control points may have dropped.
    Dropped,
    /// Page by page, one a flame of any fire, told which is the first.
    Flames,
    /// The same, told that it is of no details.
    FlameDiscs,
    /// One a control point that there may be.
    Points,
    /// The same, told of the lists that they are in.
    Crowd,
    /// One for every 32 of them.
    PointRuns,
    /// The same, told how many flames there may be.
    Dropping,
    /// One for each place of a dropped flame, told how many, if they leave marks.
    Marks,
    /// The same, if smoke rises there.
    Smoke,
    /// One a control point, if fronts are drawn as lines.
    FrontLines,
    /// Page by page, as the splat's dispatches say, told how many records each has, if there are strokes.
    Strokes,
    /// One a column of the cells in which clouds throw shadows.
    ShadeColumns,
    /// One for every 32 flames that control points may have dropped, told how many those are.
    FlameRuns,
    /// One invocation, told how many points, flames and pieces there may be.
    Book,
    /// One a point of the rings that begin in one frame, at most, told how many pieces there are.
    Ignited,
    /// One a step of each flame, told how many of these and of pieces.
    FlameSteps,
    /// One a piece that flames may light, told how many.
    Pieces,
    /// Page by page, as many for each piece of a strip as share it.
    StripShares,
    /// In each slice of flames: one a tile, one a flame, one in all, as many as that says.
    FlameTiles,
    /// As above.
    SlicedFlames,
    /// As above.
    OnceSliced,
    /// As above.
    GlowBlocks,
    /// In each pass of details, one a flame, page by page; then the same as of flames, slice by slice.
    DetailFlames,
    /// As above.
    DetailTiles,
    /// As above.
    SlicedDetails,
    /// As above.
    OnceDetails,
    /// As above.
    DetailBlocks,
    /// One for each point light that there may be, told how many fires there are.
    FlameLights,
    /// One for each point light of particles that there may be.
    Clusters,
    /// One a pixel, if there are surfaces or pillars.
    CoveredSurfaces,
    /// One a triangle of all surfaces, told whether nearness is known (1).
    SurfaceFaces(u32),
    /// As many for each of those that are listed as share it, told the same.
    SurfaceShares(u32),
    /// One invocation, told how many share one.
    OnceShared,
    /// One for every 64 cells of the flocks' grids.
    CellRuns,
    /// One invocation, told of the tiles.
    OnceTiled,
    /// One a record of what may cover.
    Covers,
    /// In every pass of the sort: one a run of pairs, one a digit, one in all.
    SortRuns,
    /// As above.
    SortDigits,
    /// As above.
    SortOnce,
    /// In every round of what covers: as that of its three dispatches says.
    Round(u32),
}

/// Neighbours in [`STAGE_KERNELS`] that take turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turns {
    /// At each step from the roots of systems that bear systems.
    Tree,
    /// In each pass of the sort by 32-bit keys.
    Sort,
    /// In each round of what covers.
    Rounds,
    /// In each slice of flames.
    Slices,
    /// In each pass of flames' details, and slice of these.
    Details,
}

impl Work {
    fn turns(self) -> Option<Turns> {
        match self {
            Self::SortRuns | Self::SortDigits | Self::SortOnce => Some(Turns::Sort),
            Self::TreeSlots | Self::TreeOnce | Self::TreeBorne => Some(Turns::Tree),
            Self::Round(_) => Some(Turns::Rounds),
            Self::FlameTiles | Self::SlicedFlames | Self::OnceSliced | Self::GlowBlocks => {
                Some(Turns::Slices)
            }
            Self::DetailFlames
            | Self::DetailTiles
            | Self::SlicedDetails
            | Self::OnceDetails
            | Self::DetailBlocks => Some(Turns::Details),
            _ => None,
        }
    }
}

/// The kernels that take turns with this one, itself included.
pub(super) fn turning_with(kernel: &KernelUse) -> Vec<&'static KernelUse> {
    let turns = kernel.work.turns();
    let is_one =
        |other: &&KernelUse| *other == kernel || (turns.is_some() && other.work.turns() == turns);
    let all = STAGE_KERNELS.iter();
    all.filter(|other| other.stage == kernel.stage)
        .filter(is_one)
        .collect()
}

/// Every kernel of a frame in order; reading it is reading the frame on a device.
pub static STAGE_KERNELS: &[KernelUse] = &[
    KernelUse {
        stage: Stage::Tree,
        kernel: "tree/bear",
        work: Work::TreeSlots,
    },
    KernelUse {
        stage: Stage::Tree,
        kernel: "tree/settle",
        work: Work::TreeOnce,
    },
    KernelUse {
        stage: Stage::Tree,
        kernel: "tree/found",
        work: Work::TreeBorne,
    },
    KernelUse {
        stage: Stage::Tree,
        kernel: "tree/pose",
        work: Work::TreeBorne,
    },
    KernelUse {
        stage: Stage::Front,
        kernel: "spread/front",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Front,
        kernel: "spread/walk",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Front,
        kernel: "spread/arrive",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Block,
        kernel: "spread/enlist",
        work: Work::Crowd,
    },
    KernelUse {
        stage: Stage::Block,
        kernel: "spread/block",
        work: Work::Crowd,
    },
    KernelUse {
        stage: Stage::Block,
        kernel: "spread/walk",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Block,
        kernel: "spread/arrive",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/gaps",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/walk",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/sum_gaps",
        work: Work::PointRuns,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/burning",
        work: Work::FlameRuns,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/book",
        work: Work::Book,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/drop",
        work: Work::Dropping,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/insert",
        work: Work::Points,
    },
    KernelUse {
        stage: Stage::Insert,
        kernel: "spread/ignite",
        work: Work::Ignited,
    },
    KernelUse {
        stage: Stage::Births,
        kernel: "systems/births",
        work: Work::Systems,
    },
    KernelUse {
        stage: Stage::Births,
        kernel: "systems/offsets",
        work: Work::Once,
    },
    KernelUse {
        stage: Stage::Emit,
        kernel: "particles/emit",
        work: Work::NewbornPages,
    },
    KernelUse {
        stage: Stage::Cull,
        kernel: "particles/cull",
        work: Work::PresentPages,
    },
    KernelUse {
        stage: Stage::Advance,
        kernel: "scan/count_bits",
        work: Work::Listed(0),
    },
    KernelUse {
        stage: Stage::Advance,
        kernel: "scan/sum_runs",
        work: Work::Listed(1),
    },
    KernelUse {
        stage: Stage::Advance,
        kernel: "scan/survivors",
        work: Work::Once,
    },
    KernelUse {
        stage: Stage::Advance,
        kernel: "scan/spread_runs",
        work: Work::Listed(1),
    },
    KernelUse {
        stage: Stage::Advance,
        kernel: "scan/spread_bits",
        work: Work::Listed(0),
    },
    KernelUse {
        stage: Stage::Advance,
        kernel: "scan/pages",
        work: Work::Once,
    },
    KernelUse {
        stage: Stage::Advance,
        kernel: "particles/advance",
        work: Work::PagePairs,
    },
    KernelUse {
        stage: Stage::Hatch,
        kernel: "flock/hatch",
        work: Work::Boids,
    },
    KernelUse {
        stage: Stage::Cells,
        kernel: "flock/count_cells",
        work: Work::Boids,
    },
    KernelUse {
        stage: Stage::Cells,
        kernel: "flock/sum_cells",
        work: Work::CellRuns,
    },
    KernelUse {
        stage: Stage::Cells,
        kernel: "flock/cell_offsets",
        work: Work::Once,
    },
    KernelUse {
        stage: Stage::Cells,
        kernel: "flock/spread_cells",
        work: Work::CellRuns,
    },
    KernelUse {
        stage: Stage::Cells,
        kernel: "flock/cell_members",
        work: Work::Boids,
    },
    KernelUse {
        stage: Stage::Cells,
        kernel: "flock/cells",
        work: Work::Boids,
    },
    KernelUse {
        stage: Stage::Steer,
        kernel: "flock/steer",
        work: Work::Boids,
    },
    KernelUse {
        stage: Stage::Steer,
        kernel: "flock/steer_again",
        work: Work::BoidsAgain,
    },
    KernelUse {
        stage: Stage::Kindle,
        kernel: "flames/kindle",
        work: Work::Fires,
    },
    KernelUse {
        stage: Stage::Kindle,
        kernel: "flames/dropped",
        work: Work::Dropped,
    },
    KernelUse {
        stage: Stage::Trace,
        kernel: "flames/trace",
        work: Work::Flames,
    },
    KernelUse {
        stage: Stage::Catch,
        kernel: "spread/catch",
        work: Work::FlameSteps,
    },
    KernelUse {
        stage: Stage::Catch,
        kernel: "spread/caught",
        work: Work::Pieces,
    },
    KernelUse {
        stage: Stage::Lights,
        kernel: "flames/shine",
        work: Work::Flames,
    },
    KernelUse {
        stage: Stage::Lights,
        kernel: "flames/gather",
        work: Work::FlameLights,
    },
    KernelUse {
        stage: Stage::Clusters,
        kernel: "particles/span",
        work: Work::LivePages,
    },
    KernelUse {
        stage: Stage::Clusters,
        kernel: "particles/shed",
        work: Work::LivePages,
    },
    KernelUse {
        stage: Stage::Clusters,
        kernel: "particles/cluster",
        work: Work::Clusters,
    },
    KernelUse {
        stage: Stage::Ground,
        kernel: "draw/ground",
        work: Work::EachPixel,
    },
    KernelUse {
        stage: Stage::Surface,
        kernel: "draw/surface_raster",
        work: Work::SurfaceFaces(0),
    },
    KernelUse {
        stage: Stage::Surface,
        kernel: "draw/surface_work",
        work: Work::OnceShared,
    },
    KernelUse {
        stage: Stage::Surface,
        kernel: "draw/surface_raster",
        work: Work::SurfaceShares(0),
    },
    KernelUse {
        stage: Stage::Surface,
        kernel: "draw/surface_raster",
        work: Work::SurfaceFaces(1),
    },
    KernelUse {
        stage: Stage::Surface,
        kernel: "draw/surface_raster",
        work: Work::SurfaceShares(1),
    },
    KernelUse {
        stage: Stage::Surface,
        kernel: "draw/surface",
        work: Work::EachPixel,
    },
    KernelUse {
        stage: Stage::Shade,
        kernel: "draw/deposit",
        work: Work::LivePages,
    },
    KernelUse {
        stage: Stage::Shade,
        kernel: "draw/shade",
        work: Work::ShadeColumns,
    },
    KernelUse {
        stage: Stage::Shapes,
        kernel: "draw/shapes",
        work: Work::LivePages,
    },
    KernelUse {
        stage: Stage::Shapes,
        kernel: "draw/boid_shapes",
        work: Work::Boids,
    },
    KernelUse {
        stage: Stage::Shapes,
        kernel: "draw/boid_trails",
        work: Work::TrailedBoids,
    },
    KernelUse {
        stage: Stage::Shapes,
        kernel: "draw/marks",
        work: Work::Marks,
    },
    KernelUse {
        stage: Stage::Shapes,
        kernel: "draw/front_lines",
        work: Work::FrontLines,
    },
    KernelUse {
        stage: Stage::Shapes,
        kernel: "draw/smoke",
        work: Work::Smoke,
    },
    KernelUse {
        stage: Stage::Shapes,
        kernel: "draw/strokes",
        work: Work::Strokes,
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "draw/cover_work",
        work: Work::OnceTiled,
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "draw/cover_keys",
        work: Work::Covers,
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "sort/count_digits",
        work: Work::SortRuns,
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "sort/sum_digits",
        work: Work::SortDigits,
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "sort/start_digits",
        work: Work::SortOnce,
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "sort/place_digits",
        work: Work::SortRuns,
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "draw/clear_tiles",
        work: Work::Round(0),
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "draw/bin",
        work: Work::Round(1),
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "draw/cover",
        work: Work::Round(2),
    },
    KernelUse {
        stage: Stage::Cover,
        kernel: "draw/dim",
        work: Work::CoveredSurfaces,
    },
    KernelUse {
        stage: Stage::Planet,
        kernel: "draw/planet",
        work: Work::Pixels,
    },
    KernelUse {
        stage: Stage::Planet,
        kernel: "draw/splat",
        work: Work::SplatPages(1),
    },
    KernelUse {
        stage: Stage::Planet,
        kernel: "draw/large_work",
        work: Work::OncePages,
    },
    KernelUse {
        stage: Stage::Planet,
        kernel: "draw/splat_large",
        work: Work::LargePages,
    },
    KernelUse {
        stage: Stage::Planet,
        kernel: "draw/hide",
        work: Work::EachPixel,
    },
    KernelUse {
        stage: Stage::Splat,
        kernel: "draw/splat",
        work: Work::SplatPages(0),
    },
    KernelUse {
        stage: Stage::Splat,
        kernel: "draw/large_work",
        work: Work::OncePages,
    },
    KernelUse {
        stage: Stage::Splat,
        kernel: "draw/splat_large",
        work: Work::LargePages,
    },
    KernelUse {
        stage: Stage::FlameDiscs,
        kernel: "draw/flame_discs",
        work: Work::FlameDiscs,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/clear_flame_tiles",
        work: Work::FlameTiles,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/bin_flames",
        work: Work::SlicedFlames,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/glow_work",
        work: Work::OnceSliced,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/glow",
        work: Work::GlowBlocks,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/glow_small",
        work: Work::FlameDiscs,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/flame_discs",
        work: Work::DetailFlames,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/glow_small",
        work: Work::DetailFlames,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/clear_flame_tiles",
        work: Work::DetailTiles,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/bin_flames",
        work: Work::SlicedDetails,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/glow_work",
        work: Work::OnceDetails,
    },
    KernelUse {
        stage: Stage::Glow,
        kernel: "draw/glow",
        work: Work::DetailBlocks,
    },
    KernelUse {
        stage: Stage::Strips,
        kernel: "draw/strip_joints",
        work: Work::Flames,
    },
    KernelUse {
        stage: Stage::Strips,
        kernel: "draw/strips",
        work: Work::StripShares,
    },
    KernelUse {
        stage: Stage::Resolve,
        kernel: "draw/resolve",
        work: Work::Pixels,
    },
];

/// The stages that the kernel is dispatched in, in frame order; none if it is at hand for reading
/// back or for clearing alone.
pub fn stages_of(kernel: &str) -> impl Iterator<Item = Stage> + Clone {
    let uses = STAGE_KERNELS.iter().filter(move |one| one.kernel == kernel);
    uses.map(|one| one.stage)
}

/// Whether a run of the plan ever dispatches the kernel; those of no stage are always at hand.
pub(super) fn is_used(kernel: &str, plan: &Plan, gpu: &GpuDevice) -> bool {
    if kernel == "flock/steer_again" && !(plan.uses.throngs && gpu.ends_loops()) {
        return false;
    }
    let mut stages = stages_of(kernel);
    stages.clone().next().is_none() || stages.any(|stage| plan.has(stage))
}

/// Invocations that share a triangle of many pixels: so many that none turns its loops more often
/// than drivers let it, even where the triangle is cut into six and each fills the picture.
fn surface_shares_of(plan: &Plan) -> u32 {
    const MOST_TURNS: u32 = 48_000;
    // One for each of its pixels, of its rows, and its own.
    const TURNS_A_BLOCK: u32 = 64 + 8 + 1;
    let blocks = (plan.width.div_ceil(8) + 1) * (plan.height.div_ceil(8) + 1);
    let needed = (6 * blocks).div_ceil(MOST_TURNS / TURNS_A_BLOCK);
    needed.max(16).next_power_of_two()
}

/// Records that an invocation of the digest takes.
const DIGEST_RUN: u32 = 64;

/// One dispatch, ready to encode.
#[derive(Debug)]
pub(super) struct Command {
    pub(super) kernel: &'static str,
    /// What it is a part of, where it is of a stage: a kernel may have several uses in one.
    of: Option<KernelUse>,
    group: wgpu::BindGroup,
    /// The source and the target page, where it works page by page.
    pub(super) pages: [usize; 2],
    /// Whether `sort_pairs` and `sorted_pairs` have changed places.
    pub(super) swaps: bool,
    pub(super) immediates: Vec<u32>,
    pub(super) size: Size,
}

#[derive(Debug)]
pub(super) enum Size {
    Direct(u32, u32),
    /// Index into `dispatches`.
    Indirect(u32),
}

impl Command {
    /// Whether it is part of such a use.
    pub(super) fn is_of(&self, wanted: impl Fn(&KernelUse) -> bool) -> bool {
        self.of.as_ref().is_some_and(wanted)
    }

    pub(super) fn encode(
        &self,
        pass: &mut wgpu::ComputePass,
        kernels: &HashMap<&'static str, Kernel>,
        dispatches: &wgpu::Buffer,
    ) {
        pass.set_pipeline(&kernels[self.kernel].pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        if !self.immediates.is_empty() {
            pass.set_immediates(0, bytemuck::cast_slice(&self.immediates));
        }
        match self.size {
            Size::Direct(x, y) => pass.dispatch_workgroups(x, y, 1),
            Size::Indirect(at) => pass.dispatch_workgroups_indirect(dispatches, u64::from(at) * 12),
        }
    }
}

/// Where the page-bound names of one dispatch lead.
struct Pages<'a> {
    at: [usize; 2],
    particles: Option<&'a wgpu::Buffer>,
    survivors: Option<&'a wgpu::Buffer>,
    large: Option<&'a wgpu::Buffer>,
    words: Option<&'a wgpu::Buffer>,
    swaps: bool,
}

impl GpuBackend {
    /// The dispatches of `stage` when pool `current` holds the particles.
    pub(super) fn expand(
        &self,
        stage: Stage,
        current: usize,
        plan: &Plan,
        workgroup_size: u32,
    ) -> Result<Vec<Command>, BackendError> {
        let mut commands = Vec::new();
        if !plan.has(stage) {
            return Ok(commands);
        }
        let of_stage: Vec<&KernelUse> = STAGE_KERNELS
            .iter()
            .filter(|kernel_use| kernel_use.stage == stage)
            .collect();
        let take_turns = |a: &&KernelUse, b: &&KernelUse| {
            a.work.turns().is_some() && a.work.turns() == b.work.turns()
        };
        for group in of_stage.chunk_by(take_turns) {
            let turns = match group[0].work.turns() {
                Some(Turns::Tree) => plan.tree_levels,
                Some(Turns::Sort) => sort::PASSES,
                Some(Turns::Slices) => self.memory.flame_tiling.slices.len() as u32,
                Some(Turns::Details) => {
                    plan.detail_passes * self.memory.flame_tiling.slices.len() as u32
                }
                Some(Turns::Rounds) => self.memory.tiling.rounds,
                None => 1,
            };
            for turn in 0..turns {
                for kernel_use in group {
                    let turn_of = (*kernel_use, turn);
                    self.expand_kernel(turn_of, current, plan, workgroup_size, &mut commands)?;
                }
            }
        }
        Ok(commands)
    }

    fn expand_kernel(
        &self,
        (kernel_use, turn): (&KernelUse, u32),
        current: usize,
        plan: &Plan,
        workgroup_size: u32,
        commands: &mut Vec<Command>,
    ) -> Result<(), BackendError> {
        let kernel = kernel_use.kernel;
        let paging = self.memory.paging;
        let tiling = self.memory.tiling;
        let flame_tiling = &self.memory.flame_tiling;
        let slice_count = flame_tiling.slices.len() as u32;
        let swaps = kernel_use.work.turns() == Some(Turns::Sort) && turn % 2 == 1;
        let (here, there) = (&self.memory.pools[current], &self.memory.pools[1 - current]);
        let mut push = |source: usize, target: usize, immediates: &[u32], size: Size| {
            let pages = Pages {
                at: [source, target],
                particles: here.get(source),
                survivors: there.get(target),
                large: self.memory.large.get(source),
                words: None,
                swaps,
            };
            let command = self.command(kernel, &pages, immediates, size)?;
            commands.push(Command {
                of: Some(*kernel_use),
                ..command
            });
            Ok::<(), BackendError>(())
        };
        let direct = |invocations: u32| {
            let (x, y) = dispatch_for(invocations, workgroup_size);
            Size::Direct(x, y)
        };
        match kernel_use.work {
            Work::Once => push(0, 0, &[], Size::Direct(1, 1)),
            Work::Systems => push(0, 0, &[], direct(plan.system_count)),
            Work::TreeSlots => push(0, 0, &[turn], direct(plan.system_count)),
            Work::TreeOnce => push(0, 0, &[turn], Size::Direct(1, 1)),
            Work::TreeBorne => {
                let step = [turn];
                let told: &[u32] = if kernel == "tree/found" { &[] } else { &step };
                push(
                    0,
                    0,
                    told,
                    direct(plan.system_count - plan.own_system_count),
                )
            }
            Work::Pixels => push(0, 0, &[], direct((plan.width * plan.height).div_ceil(4))),
            Work::CellRuns => push(0, 0, &[], direct(plan.cell_count.div_ceil(64))),
            Work::BoidsAgain if !self.kernels.contains_key(kernel) => Ok(()),
            Work::Boids | Work::BoidsAgain => plan
                .boid_counts()
                .zip(0..)
                .try_for_each(|(count, flock)| push(0, 0, &[flock], direct(count))),
            Work::TrailedBoids => plan
                .boid_counts()
                .zip(plan.trail_frames())
                .zip(0..)
                .filter(|((_, trail_frames), _)| *trail_frames > 0)
                .try_for_each(|((count, _), flock)| push(0, 0, &[flock], direct(count))),
            Work::Fires => plan
                .flame_counts()
                .zip(0..)
                .try_for_each(|(count, fire)| push(0, 0, &[fire], direct(count))),
            Work::Points => push(0, 0, &[], direct(plan.point_capacity)),
            Work::Crowd => {
                let mask = plan.crowd_lists() - 1;
                push(0, 0, &[mask], direct(plan.point_capacity))
            }
            Work::PointRuns => push(0, 0, &[], direct(plan.point_capacity.div_ceil(32))),
            Work::Book => {
                let room = [
                    plan.point_capacity,
                    plan.dropped_capacity,
                    plan.dropped_places,
                    plan.ignitions.piece_count(),
                ];
                push(0, 0, &room, Size::Direct(1, 1))
            }
            Work::Marks if plan.uses.marks => {
                push(0, 0, &[plan.dropped_places], direct(plan.dropped_places))
            }
            Work::FrontLines if plan.uses.front_lines => {
                push(0, 0, &[], direct(plan.point_capacity))
            }
            Work::Smoke if plan.uses.smokes => {
                push(0, 0, &[plan.dropped_places], direct(plan.dropped_places))
            }
            Work::Strokes if plan.uses.strokes => (0..paging.page_count).try_for_each(|page| {
                let [pieces, records] = plan.stroke_records;
                let size = Size::Indirect(paging.splat_dispatch(page));
                push(page as usize, 0, &[page, pieces, records], size)
            }),
            Work::ShadeColumns => push(0, 0, &[], direct(plan.shade_cells.pow(2))),
            Work::Marks | Work::FrontLines | Work::Smoke | Work::Strokes => Ok(()),
            Work::Dropping => push(0, 0, &[plan.dropped_places], direct(plan.point_capacity)),
            Work::FlameRuns => {
                let count = plan.dropped_capacity;
                push(0, 0, &[plan.dropped_places], direct(count.div_ceil(32)))
            }
            Work::Dropped => {
                let count = plan.dropped_capacity;
                let told = [plan.flame_count - count, count, plan.dropped_places];
                push(0, 0, &told, direct(count))
            }
            Work::Ignited => {
                let told = [plan.ignitions.piece_count()];
                push(0, 0, &told, direct(plan.ignited_count))
            }
            Work::FlameSteps => {
                let told = [plan.flame_count, plan.ignitions.piece_count()];
                push(0, 0, &told, direct(plan.flame_count * (FLAME_STEPS - 1)))
            }
            Work::Pieces => {
                let count = plan.ignitions.piece_count();
                push(0, 0, &[count], direct(count))
            }
            Work::Flames => (0..).zip(self.memory.flame_paging.pages()).try_for_each(
                |(page, (first, count))| push(page, 0, &[count, first], direct(count)),
            ),
            Work::FlameLights => push(0, 0, &[plan.fire_count], direct(FLAME_LIGHTS)),
            Work::Clusters => push(0, 0, &[], direct(CLUSTER_LIGHTS)),
            Work::DetailFlames if !turn.is_multiple_of(slice_count) => Ok(()),
            Work::FlameDiscs | Work::DetailFlames => {
                let DetailPass { octave, copy } = match kernel_use.work {
                    Work::DetailFlames => DetailPass::nth(turn / slice_count),
                    _ => DetailPass::default(),
                };
                (0..).zip(self.memory.flame_paging.pages()).try_for_each(
                    |(page, (first, count))| {
                        let shares = match kernel {
                            "draw/glow_small" => SMALL_SHARES,
                            _ => 1,
                        };
                        push(
                            page,
                            0,
                            &[count, first, octave, copy],
                            direct(count * shares),
                        )
                    },
                )
            }
            Work::FlameTiles
            | Work::DetailTiles
            | Work::SlicedFlames
            | Work::SlicedDetails
            | Work::OnceSliced
            | Work::OnceDetails
            | Work::GlowBlocks
            | Work::DetailBlocks => {
                let slice = flame_tiling.slices[(turn % slice_count) as usize];
                let place = paging.spare_dispatch(3 + 3 * tiling.rounds);
                let size = match kernel_use.work {
                    Work::FlameTiles | Work::DetailTiles => direct(flame_tiling.tiles()),
                    Work::SlicedFlames | Work::SlicedDetails => direct(slice.count),
                    Work::OnceSliced | Work::OnceDetails => Size::Direct(1, 1),
                    _ => Size::Indirect(place),
                };
                let told = flame_tiling.immediates(slice, place);
                push(slice.page, 0, &told, size)
            }
            Work::StripShares => {
                let shares = strip_shares_of(plan);
                (0..).zip(self.memory.flame_paging.pages()).try_for_each(
                    |(page, (first, count))| {
                        strip_runs(count, shares).try_for_each(|run| {
                            let size = direct((run.end - run.start) * PIECES * shares);
                            push(page, 0, &[run.end, shares, first, run.start], size)
                        })
                    },
                )
            }
            Work::SurfaceFaces(_) | Work::OnceShared | Work::SurfaceShares(_)
                if plan.surface_count == 0 =>
            {
                Ok(())
            }
            Work::SurfaceFaces(names) => {
                let faces = plan.surface_face_count;
                let told = [faces, plan.surface_count, names, 0];
                push(0, 0, &told, direct(faces))
            }
            Work::OnceShared => {
                let place = paging.spare_dispatch(2 + 3 * tiling.rounds);
                push(0, 0, &[surface_shares_of(plan), place], Size::Direct(1, 1))
            }
            Work::SurfaceShares(names) => {
                let place = paging.spare_dispatch(2 + 3 * tiling.rounds);
                let told = [
                    plan.surface_face_count,
                    plan.surface_count,
                    names,
                    surface_shares_of(plan),
                ];
                push(0, 0, &told, Size::Indirect(place))
            }
            Work::Listed(at) => push(0, 0, &[], Size::Indirect(at)),
            Work::OnceTiled => push(0, 0, &tiling.immediates(0), Size::Direct(1, 1)),
            Work::Covers => push(0, 0, &[], Size::Indirect(paging.spare_dispatch(1))),
            Work::SortRuns => {
                let size = Size::Indirect(paging.spare_dispatch(0));
                push(0, 0, &[turn * sort::DIGIT_BITS], size)
            }
            Work::SortDigits => push(0, 0, &[], direct(sort::DIGITS)),
            Work::SortOnce => push(0, 0, &[], Size::Direct(1, 1)),
            Work::Round(at) => {
                let size = Size::Indirect(paging.spare_dispatch(2 + 3 * turn + at));
                push(0, 0, &tiling.immediates(turn), size)
            }
            Work::NewbornPages => (0..paging.page_count).try_for_each(|page| {
                push(
                    page as usize,
                    0,
                    &[page],
                    Size::Indirect(paging.emit_dispatch(page)),
                )
            }),
            Work::PresentPages => (0..paging.page_count).try_for_each(|page| {
                push(
                    page as usize,
                    0,
                    &[page],
                    Size::Indirect(paging.cull_dispatch(page)),
                )
            }),
            Work::LivePages => (0..paging.page_count).try_for_each(|page| {
                push(
                    page as usize,
                    0,
                    &[page],
                    Size::Indirect(paging.splat_dispatch(page)),
                )
            }),
            Work::SplatPages(is_behind) => (0..paging.page_count).try_for_each(|page| {
                let size = Size::Indirect(paging.splat_dispatch(page));
                push(page as usize, 0, &[page, is_behind], size)
            }),
            Work::CoveredSurfaces if !plan.uses.surfaces => Ok(()),
            Work::EachPixel | Work::CoveredSurfaces => {
                push(0, 0, &[], direct(plan.width * plan.height))
            }
            Work::OncePages => (0..paging.page_count)
                .try_for_each(|page| push(page as usize, 0, &[page], Size::Direct(1, 1))),
            Work::LargePages => (0..paging.page_count).try_for_each(|page| {
                let size = Size::Indirect(paging.large_dispatch(page));
                push(page as usize, 0, &[], size)
            }),
            Work::PagePairs => (0..paging.page_count).try_for_each(|source| {
                (0..=source).try_for_each(|target| {
                    let size = Size::Indirect(paging.pair_dispatch(source, target));
                    push(source as usize, target as usize, &[source, target], size)
                })
            }),
        }
    }

    fn command(
        &self,
        kernel_name: &'static str,
        pages: &Pages,
        immediates: &[u32],
        size: Size,
    ) -> Result<Command, BackendError> {
        let kernel = &self.kernels[kernel_name];
        let mut entries = Vec::new();
        for binding in &kernel.compiled.bindings {
            let page = match binding.name.as_str() {
                "particles" => pages.particles,
                "survivors" => pages.survivors,
                "large_particles" => pages.large,
                "words" => pages.words,
                "sort_pairs" if pages.swaps => Some(self.memory.named("sorted_pairs")?),
                "sorted_pairs" if pages.swaps => Some(self.memory.named("sort_pairs")?),
                name => match self.memory.flame_pages(name) {
                    Some(flame_pages) => flame_pages.get(pages.at[0]),
                    None => Some(self.memory.named(name)?),
                },
            };
            let buffer = page.ok_or_else(|| {
                BackendError::Internal(format!("{kernel_name}: no page for `{}`", binding.name))
            })?;
            entries.push(wgpu::BindGroupEntry {
                binding: binding.binding,
                resource: buffer.as_entire_binding(),
            });
        }
        let group = self
            .gpu
            .device
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(kernel_name),
                layout: &kernel.layout,
                entries: &entries,
            });
        Ok(Command {
            kernel: kernel_name,
            of: None,
            group,
            pages: pages.at,
            swaps: pages.swaps,
            immediates: immediates.to_vec(),
            size,
        })
    }

    /// The digest of a population; of particles, those in pool `current`.
    pub(super) fn population_commands(
        &self,
        population: Population,
        current: usize,
    ) -> Result<Vec<Command>, BackendError> {
        let first = population.first_index();
        match population {
            Population::Systems if self.node_count == 0 => Ok(Vec::new()),
            Population::Systems => {
                let nodes = self.memory.named("nodes")?;
                let command = self.digest_command(nodes, first, self.node_count, 7, false)?;
                Ok(vec![command])
            }
            Population::Particles => self.particle_digest(current),
            Population::Flames if self.flame_count == 0 => Ok(Vec::new()),
            Population::Flames => {
                let flames = self.memory.named("flames")?;
                let count = self.flame_count;
                Ok(vec![self.digest_command(flames, first, count, 4, false)?])
            }
            Population::Points if self.point_capacity == 0 => Ok(Vec::new()),
            Population::Points => {
                let points = self.memory.named("control_points")?;
                let count = self.spread_counts()?.total;
                Ok(vec![self.digest_command(points, first, count, 4, false)?])
            }
            Population::Boids if self.boid_count == 0 => Ok(Vec::new()),
            Population::Boids => {
                let boids = self.memory.named("boids")?;
                Ok(vec![self.digest_command(
                    boids,
                    first,
                    self.boid_count,
                    2,
                    false,
                )?])
            }
        }
    }

    fn particle_digest(&self, current: usize) -> Result<Vec<Command>, BackendError> {
        let page_len = self.memory.paging.page_len;
        self.memory.pools[current]
            .iter()
            .enumerate()
            .map(|(page, buffer)| {
                self.digest_command(buffer, page as u32 * page_len, page_len, 2, true)
            })
            .collect()
    }

    /// What the limbs of light lack, if some of it is packed.
    pub(super) fn unpack_command(&self) -> Result<Option<Command>, BackendError> {
        let kernel = "draw/unpack";
        if !self.kernels.contains_key(kernel) {
            return Ok(None);
        }
        let pages = Pages {
            at: [0, 0],
            particles: None,
            survivors: None,
            large: None,
            words: None,
            swaps: false,
        };
        let (x, y) = dispatch_for(self.width * self.height, self.workgroup_size);
        self.command(kernel, &pages, &[], Size::Direct(x, y))
            .map(Some)
    }

    /// The digest of the image, four pixels a record.
    pub(super) fn image_digest_commands(&self) -> Result<Vec<Command>, BackendError> {
        let image = self.memory.named("image")?;
        Ok(vec![self.digest_command(
            image,
            0,
            (self.width * self.height).div_ceil(4),
            1,
            false,
        )?])
    }

    fn digest_command(
        &self,
        words: &wgpu::Buffer,
        first: u32,
        records: u32,
        vectors_per_record: u32,
        live_only: bool,
    ) -> Result<Command, BackendError> {
        let pages = Pages {
            at: [0, 0],
            particles: None,
            survivors: None,
            large: None,
            words: Some(words),
            swaps: false,
        };
        let (x, y) = dispatch_for(records.div_ceil(DIGEST_RUN), self.workgroup_size);
        let immediates = [first, records, vectors_per_record, 0, u32::from(live_only)];
        self.command("digest/digest", &pages, &immediates, Size::Direct(x, y))
    }
}
