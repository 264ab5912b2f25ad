//! What the tests of backends share: adapters, scenes, and a comparison of two backends stage by
//! stage. Each test binary uses a part of it.
#![allow(dead_code, unused_imports)]

mod adversarial;
mod arguments;
mod edges;
mod fires;
mod flocks;
mod probes;
mod scenes;
pub(crate) mod statistics;
mod strokes;
mod surfaces;
mod trees;
mod windy;
mod work;

use std::sync::{Mutex, PoisonError};

use motes::backend::Backend;
use motes::cpu::CpuBackend;
use motes::gpu::{self, GpuBackend, GpuDevice, GpuOptions};
use motes::plan::{BUFFERS, BufferRole, FrameInputs, Plan, STAGES, Stage};

pub(crate) use adversarial::*;
pub(crate) use arguments::*;
pub(crate) use edges::*;
pub(crate) use fires::*;
pub(crate) use flocks::*;
pub(crate) use probes::*;
pub(crate) use scenes::*;
pub(crate) use strokes::*;
pub(crate) use surfaces::*;
pub(crate) use trees::*;
pub(crate) use windy::*;
pub(crate) use work::*;

/// Adapters that tests run on: llvmpipe and SwiftShader, or those that the variable
/// `MOTES_TEST_ADAPTERS` names, separated by commas. Never none.
pub(crate) fn adapters() -> Vec<String> {
    let wanted = std::env::var("MOTES_TEST_ADAPTERS").unwrap_or_default();
    let named: Vec<String> = wanted
        .split(',')
        .map(|name| name.trim().to_owned())
        .filter(|name| !name.is_empty())
        .collect();
    if named.is_empty() {
        vec!["llvmpipe".into(), "swiftshader".into()]
    } else {
        named
    }
}

/// Whether everything is to be tested that a test can test, however long it takes:
/// `MOTES_FULL=1`.
pub(crate) fn full() -> bool {
    std::env::var("MOTES_FULL").is_ok_and(|value| !value.is_empty() && value != "0")
}

/// A device on the adapter of that name, opened once a process.
///
/// # Panics
/// Fails the test when there is no such adapter: a GPU test is never skipped.
pub(crate) fn open(name: &str) -> GpuDevice {
    static OPEN: Mutex<Vec<(String, GpuDevice)>> = Mutex::new(Vec::new());
    let mut open = OPEN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, device)) = open.iter().find(|(of, _)| of == name) {
        return device.clone();
    }
    let device = open_anew(name);
    open.push((name.to_owned(), device.clone()));
    device
}

/// A device of its own on the adapter of that name, for what may leave it in a bad state.
///
/// # Panics
/// As [`open`].
pub(crate) fn open_anew(name: &str) -> GpuDevice {
    gpu::open(name).expect("the driver opens its device").unwrap_or_else(|| {
        let there: Vec<_> = gpu::adapters().into_iter().map(|adapter| adapter.name).collect();
        panic!(
            "no adapter `{name}` among {there:?}: point VK_DRIVER_FILES at the ICDs of lavapipe \
             and SwiftShader, or name the adapters to test on in MOTES_TEST_ADAPTERS"
        )
    })
}

/// Runs `test` on a device of each adapter that is to be tested.
pub(crate) fn on_each_adapter(test: impl Fn(&str, &GpuDevice)) {
    for name in adapters() {
        test(&name, &open(&name));
    }
}

/// An empty run of `plan` on the processor.
pub(crate) fn on_cpu(plan: &Plan) -> CpuBackend {
    CpuBackend::new(plan, None).expect("the plan fits the processor")
}

/// An empty run of `plan` on a device.
pub(crate) fn on_gpu(device: &GpuDevice, plan: &Plan, options: &GpuOptions) -> GpuBackend {
    GpuBackend::new(device, plan, options).expect("the plan fits the device")
}

/// Runs the frames on each adapter in lockstep with the processor.
pub(crate) fn assert_twins(plan: &Plan, frames: &[FrameInputs], options: &GpuOptions) {
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, plan, options);
        if let Err(difference) = compare_run(frames, &mut gpu, &mut on_cpu(plan)) {
            panic!("{name}: {difference}");
        }
    });
}

/// Names of the buffers that backends are compared by after `stage`.
pub(crate) fn compared_after(stage: Stage) -> impl Iterator<Item = &'static str> {
    let is_state = |name: &&str| {
        BUFFERS
            .iter()
            .any(|buffer| buffer.name == *name && buffer.role == BufferRole::State)
    };
    stage.info().writes.iter().copied().filter(is_state)
}

/// Where two lists of words differ first, or in length; `None` where they are the same.
pub(crate) fn first_difference(got: &[u32], expected: &[u32]) -> Option<String> {
    if let Some(at) = got
        .iter()
        .zip(expected)
        .position(|(got, expected)| got != expected)
    {
        let count = got
            .iter()
            .zip(expected)
            .filter(|(got, expected)| got != expected)
            .count();
        return Some(format!(
            "word {at}: got {:#010x} ({:e}), expected {:#010x} ({:e}); {count} of {} differ",
            got[at],
            f32::from_bits(got[at]),
            expected[at],
            f32::from_bits(expected[at]),
            expected.len(),
        ));
    }
    (got.len() != expected.len())
        .then(|| format!("{} words instead of {}", got.len(), expected.len()))
}

/// Runs one stage on both and compares every state buffer that it writes, word by word.
///
/// # Errors
/// The frame, the stage, the buffer and the first word that differs.
pub(crate) fn compare_stage(
    stage: Stage,
    inputs: &FrameInputs,
    got: &mut dyn Backend,
    expected: &mut dyn Backend,
) -> Result<(), String> {
    let name = stage.info().name;
    let frame = inputs.frame.frame;
    let failed = |e: motes::backend::BackendError| format!("frame {frame}, {name}: {e}");
    expected.run_stage(stage, inputs).map_err(failed)?;
    got.run_stage(stage, inputs).map_err(failed)?;
    for buffer in compared_after(stage) {
        let (got, expected) = (
            got.read(buffer).map_err(failed)?,
            expected.read(buffer).map_err(failed)?,
        );
        if let Some(difference) = first_difference(&got, &expected) {
            return Err(format!("frame {frame}, {name}, `{buffer}`: {difference}"));
        }
    }
    Ok(())
}

/// Runs every stage of the frames in lockstep on both, comparing after each; statistics and both
/// digests, too.
///
/// # Errors
/// As [`compare_stage`].
pub(crate) fn compare_run(
    frames: &[FrameInputs],
    got: &mut dyn Backend,
    expected: &mut dyn Backend,
) -> Result<(), String> {
    for inputs in frames {
        for info in STAGES {
            compare_stage(info.stage, inputs, got, expected)?;
        }
        let frame = inputs.frame.frame;
        let failed = |e: motes::backend::BackendError| format!("frame {frame}: {e}");
        let differs = |what: &str, got: String, expected: String| {
            if got == expected {
                return Ok(());
            }
            Err(format!(
                "frame {frame}, {what}: {got} instead of {expected}"
            ))
        };
        let digests = |backend: &mut dyn Backend| {
            let of = (backend.state_digest()?, backend.image_digest()?);
            Ok(format!("{of:016x?}"))
        };
        differs(
            "digests of state and image",
            digests(got).map_err(failed)?,
            digests(expected).map_err(failed)?,
        )?;
        let statistics = |backend: &mut dyn Backend| {
            backend
                .take_statistics()
                .map(|lines| format!("{lines:?}"))
                .map_err(failed)
        };
        differs("statistics", statistics(got)?, statistics(expected)?)?;
    }
    Ok(())
}

/// A random word by another generator than the one under test (splitmix of Steele et al. 2014).
pub(crate) fn hash(index: u32) -> u32 {
    let mut z = (u64::from(index) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 32) as u32
}
