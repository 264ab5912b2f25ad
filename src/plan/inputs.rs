//! Everything that changes while a scene runs reaches a frame as one value.

use super::Plan;
use super::camera::{camera_frame, layer_planes};
use super::flock::flocks_of;
use super::system::{Moments, bounds_of, system_frame, system_row};
use super::wind::winds_of;
use crate::layout::{Bound, FlockFrame, Frame, Relation, SystemFrame, SystemRow, Wind};
use crate::scene::Scene;

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
    /// Where particles may not be, system by system; at most [`Plan::MOST_BOUNDS`].
    pub bounds: Vec<Bound>,
    /// The parts of the wind, at most [`Plan::MOST_WINDS`].
    pub winds: Vec<Wind>,
    /// The planes between layers (unit normal, distance along it), at most [`Plan::MOST_LAYERS`].
    pub layer_planes: Vec<[f32; 4]>,
    /// One a flock.
    pub flocks: Vec<FlockFrame>,
    /// What flocks make of each other, flock by flock.
    pub relations: Vec<Relation>,
    /// Whether flocks begin in this frame: their boids are put where they are at first.
    pub hatches: bool,
}

/// The inputs of the frame `number`, with `scene` as it is from some frame on.
pub(super) fn frame_inputs(plan: &Plan, scene: &Scene, number: i32) -> FrameInputs {
    let time = f64::from(number);
    let now = scene.at(time);
    let earlier = scene.seen_from(time, time - 1.0);
    let closing = scene.seen_from(time, time + f64::from(now.image.shutter));
    let mut bounds = Vec::new();
    let systems = now
        .systems
        .iter()
        .zip(&earlier.systems)
        .zip(&closing.systems)
        .map(|((now, earlier), closing)| {
            let moments = Moments {
                now,
                earlier,
                closing,
            };
            let first_bound = bounds.len();
            bounds.extend(bounds_of(now));
            SystemFrame {
                first_bound: first_bound as u32,
                bound_count: (bounds.len() - first_bound) as u32,
                ..system_frame(&moments, scene.seed, number)
            }
        })
        .collect();
    let winds = winds_of(&now, number);
    let layer_planes = layer_planes(&now);
    let (flocks, relations) = flocks_of(&now, &earlier);
    let frame = Frame {
        frame: number.cast_unsigned(),
        wind_count: winds.len() as u32,
        layer_plane_count: layer_planes.len() as u32,
        ..plan.bounded(camera_frame(&now, &closing))
    };
    let rows = now.systems.iter();
    let rows = rows.map(|system| system_row(system, &plan.meshes));
    FrameInputs {
        frame,
        systems,
        rows: rows.collect(),
        bounds,
        winds,
        layer_planes,
        flocks,
        relations,
        hatches: number == plan.first_frame,
    }
}

impl Plan {
    /// `frame` with the sizes and counts that hold for the whole run.
    pub(crate) fn bounded(&self, frame: Frame) -> Frame {
        Frame {
            system_count: self.system_count,
            row_mask: self.row_count - 1,
            least_lifetime: self.least_lifetime,
            capacity: self.capacity,
            width: self.width,
            height: self.height,
            cell_count: self.cell_count,
            ..frame
        }
    }
}
