//! Whether two backends make the same bits of a scene, and if not, where they part.
//!
//! [`compare`] runs a plan on both in lockstep and compares each frame's statistics and digests,
//! which are cheap. Where they differ, both are started anew, and the frame is run stage by stage
//! (`locate`): the first buffer that differs after a stage tells which stage is wrong, for
//! everything before it was the same. [`save`] writes what a driver's writers need to see it.

mod element;
mod locate;
mod report;
mod save;
mod shrink;

use crate::backend::{Backend, BackendError, StageRecord};
use crate::layout::FrameStats;
use crate::plan::Plan;

pub use element::Element;
pub use save::{SavedFor, save};
pub use shrink::{default_frames, shrunk};

/// Begins an empty run of the plan; called again when a difference is to be located.
pub type Start<'a> = dyn FnMut() -> Result<Box<dyn Backend>, BackendError> + 'a;

/// What comparing a scene has shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Frames that were run, the one that differs included.
    pub frames: u32,
    /// Most particles alive after any of them, on the expected side, all boids and flames
    /// that burn.
    pub most_particles: u32,
    /// Births that were dropped for want of room, on the expected side.
    pub dropped: u64,
    /// Digest of the last state, on the expected side.
    pub state_digest: u64,
    /// Digest of the last image, on the expected side.
    pub image_digest: u64,
    /// Where they part; `None` where all frames are the same.
    pub difference: Option<Difference>,
}

impl Outcome {
    /// Whether all frames are the same, bit for bit.
    pub fn is_equal(&self) -> bool {
        self.difference.is_none()
    }
}

/// A frame that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The first frame that differs.
    pub frame: u32,
    /// How it was seen.
    pub sign: Sign,
    /// Where it begins; `None` where it did not happen again when the frame was run stage by
    /// stage, so that it depends on timing or on chance.
    pub place: Option<Place>,
    /// The stage at `place` as the device ran it, if it was asked for and a device ran it.
    pub record: Option<StageRecord>,
}

/// What differs at the end of a frame. Values are (expected, got).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sign {
    /// The frame's statistics.
    Statistics(Vec<FrameStats>, Vec<FrameStats>),
    /// The digest of the living.
    StateDigest(u64, u64),
    /// The digest of the image.
    ImageDigest(u64, u64),
}

/// Where a frame begins to differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name of the stage; `digest` where all state is the same and only its digest differs.
    pub stage: &'static str,
    /// Name of the first buffer that differs after it.
    pub buffer: &'static str,
    /// Its first element that differs.
    pub element: Element,
    /// How many of its words differ; those that only one side has, included.
    pub differing_words: usize,
    /// Other buffers that differ after the stage.
    pub other_buffers: Vec<&'static str>,
    /// The buffer's live words as expected.
    pub expected: Vec<u32>,
    /// The buffer's live words as they were got.
    pub got: Vec<u32>,
}

/// How to compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CompareOptions {
    /// Frames to run, from 0.
    pub frames: u32,
    /// Whether to record the stage that differs, for [`save`].
    pub record: bool,
}

/// Runs the frames on both sides until they differ. `progress` hears of each frame that is done.
///
/// # Errors
/// A machine fails.
pub fn compare(
    plan: &Plan,
    expected: &mut Start,
    got: &mut Start,
    options: &CompareOptions,
    progress: &mut dyn FnMut(u32),
) -> Result<Outcome, BackendError> {
    let mut outcome = Outcome {
        frames: 0,
        most_particles: 0,
        dropped: 0,
        state_digest: 0,
        image_digest: 0,
        difference: None,
    };
    let (mut a, mut b) = (expected()?, got()?);
    let mut sign = None;
    // What is before frame 0 is compared with it.
    for frame in plan.restart_frame(0)..0 {
        let inputs = plan.inputs(frame.cast_unsigned());
        for side in [&mut b, &mut a] {
            side.step(&inputs)?;
        }
    }
    for frame in 0..options.frames {
        let inputs = plan.inputs(frame);
        // The device first: it works while the processor does.
        for side in [&mut b, &mut a] {
            side.step(&inputs)?;
            side.draw(&inputs)?;
        }
        let statistics = (a.take_statistics()?, b.take_statistics()?);
        let states = (a.state_digest()?, b.state_digest()?);
        let images = (a.image_digest()?, b.image_digest()?);
        outcome.frames = frame + 1;
        (outcome.state_digest, outcome.image_digest) = (states.0, images.0);
        for line in &statistics.0 {
            let [_, _, burning] = plan.flames_at(line.frame.cast_signed());
            let lives = line.live + plan.boid_count + burning + line.points_live + line.flames_live;
            outcome.most_particles = outcome.most_particles.max(lives);
            outcome.dropped += u64::from(line.dropped);
            outcome.dropped += u64::from(line.points_requested - line.points_born);
            outcome.dropped += u64::from(line.flames_requested - line.flames_born);
        }
        progress(frame);
        if statistics.0 != statistics.1 {
            sign = Some(Sign::Statistics(statistics.0, statistics.1));
        } else if states.0 != states.1 {
            sign = Some(Sign::StateDigest(states.0, states.1));
        } else if images.0 != images.1 {
            sign = Some(Sign::ImageDigest(images.0, images.1));
        }
        if sign.is_some() {
            break;
        }
    }
    // Their memory is needed again.
    drop((a, b));
    if let Some(sign) = sign {
        let frame = outcome.frames - 1;
        let located = locate::locate(plan, expected()?, got()?, frame, options.record)?;
        let (place, record) = located.map_or((None, None), |(place, record)| (Some(place), record));
        outcome.difference = Some(Difference {
            frame,
            sign,
            place,
            record,
        });
    }
    Ok(outcome)
}
