//! Everything that changes while a scene runs reaches a frame as one value.

use super::Plan;
use super::variant::Variant;
use crate::layout::{Frame, SystemFrame, SystemRow};

/// What the processor uploads for one frame. The list of them is a recording of the run, and a
/// recording replays exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameInputs {
    /// The frame's own values. `page_len` and `page_count` are the backend's to fill in.
    pub frame: Frame,
    /// One a system slot.
    pub systems: Vec<SystemFrame>,
    /// One a system slot: the row that this frame's newborns keep for life.
    pub rows: Vec<SystemRow>,
}

pub(super) fn frame_inputs(plan: &Plan, variant: &Variant, number: u32) -> FrameInputs {
    let frame = Frame {
        frame: number,
        ..plan.bounded(variant.frame)
    };
    let systems = variant
        .systems
        .iter()
        .map(|planned| {
            let (mean, var) = planned.births_at(number);
            let scale = planned.births_scale;
            SystemFrame {
                mean_parts: crate::exact::snap(mean * scale),
                var_parts: crate::exact::snap(var * scale),
                ..planned.frame_values
            }
        })
        .collect();
    FrameInputs {
        frame,
        systems,
        rows: variant.systems.iter().map(|planned| planned.row).collect(),
    }
}

impl Plan {
    /// `frame` with the sizes and counts that hold for the whole run.
    pub(crate) fn bounded(&self, frame: Frame) -> Frame {
        Frame {
            system_count: self.system_count,
            row_mask: self.row_count - 1,
            capacity: self.capacity,
            width: self.width,
            height: self.height,
            ..frame
        }
    }
}
