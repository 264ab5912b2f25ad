//! The first stage, buffer and element of a frame that differ.

use super::Place;
use super::element;
use crate::backend::{Backend, BackendError, StageRecord};
use crate::plan::{BufferRole, FrameInputs, Plan, STAGES, StageInfo, buffer};

/// Runs fresh backends up to `frame` and through it stage by stage. `None` where nothing differs
/// this time.
pub(super) fn locate(
    plan: &Plan,
    mut expected: Box<dyn Backend>,
    mut got: Box<dyn Backend>,
    frame: u32,
    record: bool,
) -> Result<Option<(Place, Option<StageRecord>)>, BackendError> {
    for before in plan.restart_frame(0)..0 {
        let inputs = plan.inputs(before.cast_unsigned());
        got.step(&inputs)?;
        expected.step(&inputs)?;
    }
    for before in 0..frame {
        let inputs = plan.inputs(before);
        for side in [&mut got, &mut expected] {
            side.step(&inputs)?;
            // Drawn as in the run before: a stray write of a drawing kernel is to happen again.
            side.draw(&inputs)?;
        }
    }
    expected.take_statistics()?;
    got.take_statistics()?;
    let inputs = plan.inputs(frame);
    for info in STAGES {
        let record = if record {
            record_of(info, &inputs, expected.as_mut(), got.as_mut())?
        } else {
            None
        };
        got.run_stage(info.stage, &inputs)?;
        expected.run_stage(info.stage, &inputs)?;
        if let Some(place) = compare_stage(plan, info, expected.as_mut(), got.as_mut())? {
            let record = record
                .map(|(record, side)| with_dispatches(record, side.of(&mut expected, &mut got)));
            return Ok(Some((place, record.transpose()?)));
        }
    }
    Ok(compare_digests(plan, expected.as_mut(), got.as_mut())?.map(|place| (place, None)))
}

/// Which of the two.
#[derive(Clone, Copy)]
enum Side {
    Expected,
    Got,
}

impl Side {
    fn of<'a>(
        self,
        expected: &'a mut Box<dyn Backend>,
        got: &'a mut Box<dyn Backend>,
    ) -> &'a mut dyn Backend {
        match self {
            Self::Expected => expected.as_mut(),
            Self::Got => got.as_mut(),
        }
    }
}

/// The stage on the side under test, or on the other where the one under test has no kernels.
fn record_of(
    info: &StageInfo,
    inputs: &FrameInputs,
    expected: &mut dyn Backend,
    got: &mut dyn Backend,
) -> Result<Option<(StageRecord, Side)>, BackendError> {
    if let Some(record) = got.record_stage(info.stage, inputs)? {
        return Ok(Some((record, Side::Got)));
    }
    let record = expected.record_stage(info.stage, inputs)?;
    Ok(record.map(|record| (record, Side::Expected)))
}

/// The record with `dispatches` as the stage has left it: entries are written once a frame, before
/// they are used, some of them within the stage.
fn with_dispatches(
    mut record: StageRecord,
    side: &mut dyn Backend,
) -> Result<StageRecord, BackendError> {
    if let Some(dispatches) = record
        .buffers
        .iter_mut()
        .find(|buffer| buffer.name == "dispatches")
    {
        dispatches.words = side.read("dispatches")?;
    }
    Ok(record)
}

fn compare_stage(
    plan: &Plan,
    info: &StageInfo,
    expected: &mut dyn Backend,
    got: &mut dyn Backend,
) -> Result<Option<Place>, BackendError> {
    let mut first: Option<Place> = None;
    for &name in info.writes {
        if buffer(name).is_none_or(|declared| declared.role != BufferRole::State) {
            continue;
        }
        let (a, b) = (expected.read(name)?, got.read(name)?);
        match (&mut first, place(plan, info.name, name, a, b)) {
            (_, None) => {}
            (None, found) => first = found,
            (Some(first), Some(other)) => first.other_buffers.push(other.buffer),
        }
    }
    Ok(first)
}

/// Where two contents of a buffer differ first.
fn place(
    plan: &Plan,
    stage: &'static str,
    buffer: &'static str,
    expected: Vec<u32>,
    got: Vec<u32>,
) -> Option<Place> {
    let word = (0..expected.len().max(got.len())).find(|&at| expected.get(at) != got.get(at))?;
    let differing_words = expected.iter().zip(&got).filter(|(a, b)| a != b).count()
        + expected.len().abs_diff(got.len());
    let element = element::element(plan, buffer, word, &expected, &got);
    Some(Place {
        stage,
        buffer,
        element,
        differing_words,
        other_buffers: Vec::new(),
        expected,
        got,
    })
}

/// All state is the same: what is made of it differs, if anything still does.
fn compare_digests(
    plan: &Plan,
    expected: &mut dyn Backend,
    got: &mut dyn Backend,
) -> Result<Option<Place>, BackendError> {
    let lines = (expected.take_statistics()?, got.take_statistics()?);
    let words = |lines: Vec<_>| bytemuck::cast_slice(&lines).to_vec();
    let statistics = place(
        plan,
        "advance",
        "statistics",
        words(lines.0),
        words(lines.1),
    );
    let halves = |digest: u64| [digest as u32, (digest >> 32) as u32];
    let digests = |side: &mut dyn Backend| {
        let both = [halves(side.state_digest()?), halves(side.image_digest()?)];
        Ok::<_, BackendError>(both.concat())
    };
    let (a, b) = (digests(expected)?, digests(got)?);
    Ok(statistics.or_else(|| place(plan, "digest", "digest", a, b)))
}
