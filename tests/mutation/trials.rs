//! Runs whose outcome the processor has told beforehand, kernel by kernel.

use std::sync::OnceLock;

use motes::backend::Backend;
use motes::gpu::shader::{self, Access, CompileOptions};
use motes::gpu::{GpuBackend, GpuDevice, GpuOptions, STAGE_KERNELS, stages_of};
use motes::layout::Counts;
use motes::plan::{FrameInputs, Plan, STAGES};
use motes::scene::Scene;

use crate::common::*;

/// What a run leaves behind after each stage that has any, in order: stage, buffer, words.
type Outcome = Vec<(&'static str, &'static str, Vec<u32>)>;

/// A run and its outcome.
pub(crate) struct Trial {
    pub(crate) name: &'static str,
    cut: Cut,
    page_bytes: u64,
    draws: bool,
    plan: Plan,
    frames: Vec<Told>,
}

/// A frame and what comes of it.
struct Told {
    inputs: FrameInputs,
    outcome: Outcome,
    after_offsets: Vec<u32>,
    after_pages: Vec<u32>,
    digests: (u64, u64),
    statistics: String,
}

impl Trial {
    fn new(
        name: &'static str,
        (plan, frames): (Plan, Vec<FrameInputs>),
        workgroup_size: u32,
        page_bytes: u64,
    ) -> Self {
        let cut = Cut::new(workgroup_size, page_bytes, plan.capacity);
        let mut cpu = on_cpu(&plan);
        let frames = frames
            .into_iter()
            .map(|inputs| told(&mut cpu, inputs, &cut))
            .collect();
        Self {
            name,
            cut,
            page_bytes,
            draws: true,
            plan,
            frames,
        }
    }

    /// A trial of the simulation alone.
    fn undrawn(
        name: &'static str,
        run: (Plan, Vec<FrameInputs>),
        workgroup_size: u32,
        page_bytes: u64,
    ) -> Self {
        Self {
            draws: false,
            ..Self::new(name, run, workgroup_size, page_bytes)
        }
    }

    /// An unchanged run on the device, that [`Trial::difference`] starts from.
    pub(crate) fn backend(&self, device: &GpuDevice) -> GpuBackend {
        let options = GpuOptions {
            workgroup_size: self.cut.workgroup_size,
            page_bytes: self.page_bytes,
            // More rounds than one.
            cover_slice: 2048,
            // Whatever a changed kernel leaves behind, the others stay within their buffers.
            checked: true,
            ..GpuOptions::default()
        };
        on_gpu(device, &self.plan, &options)
    }

    /// Switches that the kernels of this run are compiled without, and one more.
    pub(crate) fn off(&self, also: Option<&str>) -> Vec<&'static str> {
        let switches = self.plan.uses.switches().into_iter();
        switches
            .filter_map(|(switch, on)| (!on || also == Some(switch)).then_some(switch))
            // Of flock/steer_again alone, which has work where loops have been ended.
            .chain(["SIXTEENS"])
            .collect()
    }

    /// Whether its plan has any use for the kernel.
    pub(crate) fn runs(&self, kernel: &str) -> bool {
        let mut stages = stages_of(kernel);
        stages.clone().next().is_none() || stages.any(|stage| self.plan.has(stage))
    }

    /// Invocations a workgroup.
    pub(crate) fn workgroup_size(&self) -> u32 {
        self.cut.workgroup_size
    }

    /// Runs a run that stands at its beginning, until something is not as told; `None` where all
    /// is.
    pub(crate) fn difference(&self, backend: &mut GpuBackend) -> Option<String> {
        self.frames.iter().find_map(|told| {
            let frame = told.inputs.frame.frame;
            match frame_difference(backend, told, self.draws) {
                Ok(None) => None,
                Ok(Some(difference)) => Some(format!("frame {frame}, {difference}")),
                Err(e) => Some(format!("frame {frame}: {e}")),
            }
        })
    }
}

/// Steps and draws one frame on the processor.
fn told(cpu: &mut dyn Backend, inputs: FrameInputs, cut: &Cut) -> Told {
    let mut outcome = Vec::new();
    let mut after_offsets = Vec::new();
    let mut alive = Vec::new();
    for info in STAGES {
        cpu.run_stage(info.stage, &inputs)
            .expect("the processor runs every stage");
        let mut read = |buffer| cpu.read(buffer).expect("a state buffer");
        for buffer in compared_after(info.stage) {
            outcome.push((info.name, buffer, read(buffer)));
        }
        let counts: Counts = bytemuck::pod_read_unaligned(bytemuck::cast_slice(&read("counts")));
        match info.name {
            "births" => after_offsets = cut.after_offsets(&counts),
            "cull" => {
                let bits = read("alive_bits");
                let bit = |at: u32| bits[at as usize / 32] >> (at % 32) & 1 == 1;
                alive = (0..counts.total).map(bit).collect();
            }
            _ => {}
        }
    }
    Told {
        outcome,
        after_offsets,
        after_pages: cut.after_pages(&alive),
        digests: (
            cpu.state_digest().expect("a digest"),
            cpu.image_digest().expect("a digest"),
        ),
        statistics: format!("{:?}", cpu.take_statistics().expect("statistics")),
        inputs,
    }
}

/// Groups of a dispatch that no list of work in these runs comes near.
const MOST_GROUPS: u64 = 1 << 20;

/// Kernels that list work for those after them.
fn listing_kernels() -> &'static [&'static str] {
    static LISTING: OnceLock<Vec<&'static str>> = OnceLock::new();
    LISTING.get_or_init(|| {
        let lists = |kernel: &&str| {
            let compiled = shader::compile(kernel, &CompileOptions::default());
            let bindings = compiled
                .map(|compiled| compiled.bindings)
                .unwrap_or_default();
            bindings
                .iter()
                .any(|it| it.name == "dispatches" && it.access == Access::ReadWrite)
        };
        STAGE_KERNELS
            .iter()
            .map(|one| one.kernel)
            .filter(lists)
            .collect()
    })
}

/// Runs one frame kernel by kernel. The lists of work are looked at before anything is dispatched
/// by them: a wrong one could keep the device busy for hours.
fn frame_difference(
    gpu: &mut GpuBackend,
    told: &Told,
    draws: bool,
) -> Result<Option<String>, motes::backend::BackendError> {
    for (at, one) in STAGE_KERNELS.iter().enumerate() {
        if one.stage.info().draws && !draws {
            break;
        }
        gpu.run_kernel(one, &told.inputs)?;
        let lists = match one.kernel {
            "systems/offsets" => Some((0, &told.after_offsets)),
            "scan/pages" => Some((told.after_offsets.len(), &told.after_pages)),
            _ => None,
        };
        if listing_kernels().contains(&one.kernel) {
            let got = gpu.read("dispatches")?;
            let groups = |triple: &[u32]| triple.iter().map(|n| u64::from(*n)).product::<u64>();
            if let Some(triple) = got.chunks(3).find(|triple| groups(triple) > MOST_GROUPS) {
                return Ok(Some(format!("{}, a dispatch of {triple:?}", one.kernel)));
            }
        }
        if let Some((first, expected)) = lists {
            let got = gpu.read("dispatches")?;
            let got = &got[first..first + expected.len()];
            if let Some(difference) = first_difference(got, expected) {
                return Ok(Some(format!("{}, dispatches: {difference}", one.kernel)));
            }
        }
        let is_last = STAGE_KERNELS
            .get(at + 1)
            .is_none_or(|next| next.stage != one.stage);
        if !is_last {
            continue;
        }
        let stage = one.stage.info().name;
        for (_, buffer, expected) in told.outcome.iter().filter(|(of, ..)| *of == stage) {
            if let Some(difference) = first_difference(&gpu.read(buffer)?, expected) {
                return Ok(Some(format!("{stage}, `{buffer}`: {difference}")));
            }
        }
    }
    let mut digests = (gpu.state_digest()?, told.digests.1);
    if draws {
        digests.1 = gpu.image_digest()?;
    }
    if draws && digests == told.digests {
        // Whoever reads light has it unpacked first: drawn in one go, it is packed until the end.
        gpu.draw(&told.inputs)?;
        digests.1 = gpu.image_digest()?;
    }
    if digests != told.digests {
        return Ok(Some(format!(
            "digests {digests:x?} instead of {:x?}",
            told.digests
        )));
    }
    let statistics = format!("{:?}", gpu.take_statistics()?);
    Ok((statistics != told.statistics)
        .then(|| format!("statistics {statistics} instead of {}", told.statistics)))
}

/// The scene through a long lens: footprints of more than 256 rows, and streaks across the edges.
fn far_seen(mut scene: Scene) -> Scene {
    scene.camera.vertical_fov_degrees = 11.0;
    scene
}

/// The same run, its last frame of one layer.
fn layered((plan, mut frames): (Plan, Vec<FrameInputs>)) -> (Plan, Vec<FrameInputs>) {
    if let Some(last) = frames.last_mut() {
        last.frame.layer = 1;
    }
    (plan, frames)
}

/// All trials, those that catch most at least cost first.
pub(crate) fn trials() -> Vec<Trial> {
    let turning = |scene: &Scene, count| {
        let plan = everything_turning(scene);
        let frames = frames_of(&plan, count);
        (plan, frames)
    };
    let unchanging = |scene: &Scene, count| {
        let plan = Plan::new(scene, scene.frames).expect("the scene can be planned");
        let frames = frames_of(&plan, count);
        (plan, frames)
    };
    // As if there were many times more boids than a loop turns.
    let flocks = |crowds| {
        let (mut plan, frames) = unchanging(&all_kinds_of_flocks(), 5);
        (plan.uses.crowds, plan.uses.throngs) = (crowds, crowds);
        (plan, frames)
    };
    let driven = || {
        let (mut plan, frames) = unchanging(&driven_flocks(), 6);
        plan.uses.crowds = true;
        (plan, frames)
    };
    // Pages as small as they can be, and one for all: llvmpipe keeps something of every dispatch
    // that draws on several pages, so those are few.
    const SMALL: u64 = 64 << 10;
    const LARGE: u64 = 1 << 30;
    vec![
        Trial::new("everything", turning(&everything(), 10), 64, LARGE),
        Trial::new("windy", windy_frames(false, 12), 64, LARGE),
        Trial::new("windy, flat", windy_frames(true, 12), 64, LARGE),
        Trial::new(
            "large shapes",
            turning(&far_seen(large_shapes(300, 80)), 4),
            64,
            LARGE,
        ),
        Trial::new("covering", layered(turning(&covering(), 4)), 64, LARGE),
        Trial::new("strokes", unchanging(&all_kinds_of_strokes(), 4), 64, LARGE),
        Trial::new("clouds", unchanging(&all_kinds_of_clouds(), 3), 64, LARGE),
        Trial::new("tree", unchanging(&rich_tree(), 14), 24, LARGE),
        Trial::new("dropped systems", unchanging(&crowded_tree(), 5), 64, LARGE),
        Trial::new("planet", unchanging(&lit_planet(), 7), 64, LARGE),
        Trial::new(
            "planet underfoot",
            unchanging(&planet_underfoot(), 1),
            64,
            LARGE,
        ),
        Trial::new("flocks", layered(flocks(false)), 24, LARGE),
        Trial::new("crowded flocks", flocks(true), 64, LARGE),
        Trial::new("driven flocks", driven(), 64, LARGE),
        Trial::new(
            "fires",
            layered(unchanging(&all_kinds_of_fires(), 6)),
            24,
            LARGE,
        ),
        Trial::new(
            "surfaces",
            layered(unchanging(&all_kinds_of_surfaces(), 4)),
            24,
            LARGE,
        ),
        Trial::new("glaring", unchanging(&glaring(), 6), 64, LARGE),
        Trial::new("cut corners", unchanging(&cut_corners(), 2), 64, LARGE),
        Trial::new(
            "large in a second page",
            unchanging(&large_shapes_in_a_second_page(), 2),
            64,
            SMALL,
        ),
        // Workgroups that no page is a multiple of, and words of bits without room to spare.
        Trial::new("dropped", turning(&everything_within(2560), 6), 24, SMALL),
        Trial::undrawn("meshes", unchanging(&born_on_meshes(), 2), 64, LARGE),
        Trial::new("extreme at 65,536", adversarial(1, 65_531, 8), 64, LARGE),
        Trial::new("extreme at 256", adversarial(2, 252, 8), 64, LARGE),
        Trial::new("one system", few_systems(1, 1), 64, LARGE),
        Trial::new("one system, turning", few_systems(1, 2), 64, LARGE),
        Trial::new("two systems", few_systems(2, 1), 64, LARGE),
        Trial::new("two systems, turning", few_systems(2, 2), 64, LARGE),
        Trial::undrawn("edges", counted(EDGES_CAPACITY, EDGES), 64, SMALL),
        Trial::undrawn(
            "edges, other groups",
            counted(EDGES_CAPACITY, EDGES),
            24,
            SMALL,
        ),
        Trial::undrawn("generations", generations(GENERATIONS), 64, SMALL),
        Trial::undrawn("beyond 32 bits", beyond_32_bits(), 64, LARGE),
        Trial::undrawn("crowd", counted(CROWD_CAPACITY, CROWD), 8, LARGE),
    ]
}

/// A planet from just above its ground, beside and behind the eye too.
fn planet_underfoot() -> Scene {
    let mut scene = lit_planet();
    scene.tracks.clear();
    scene.camera.position = [0.5, 0.0, 10.02];
    scene.camera.target = [0.5, 5.0, 10.5];
    scene.camera.vertical_fov_degrees = 120.0;
    scene
}
