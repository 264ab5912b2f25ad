//! Whether inputs of the caller's making fit the plan.

use crate::layout::{SHAPE_CURVE, SHAPE_MESH, SystemFrame, SystemRow};
use crate::plan::{FrameInputs, Plan, PlanError};

/// Whether lists of the caller's making are as long as the plan's, or as they can be.
pub(super) fn check_sizes(plan: &Plan, inputs: &FrameInputs) -> Result<(), PlanError> {
    let refuse = |message: String, help: String| Err(PlanError { message, help });
    let slots = plan.system_count as usize;
    if inputs.systems.len() != slots || inputs.rows.len() != slots {
        return refuse(
            format!(
                "inputs for {} systems and {} rows",
                inputs.systems.len(),
                inputs.rows.len()
            ),
            format!("this plan has {slots} of each"),
        );
    }
    for (what, count, most) in [
        ("bounds", inputs.bounds.len(), Plan::MOST_BOUNDS),
        ("winds", inputs.winds.len(), Plan::MOST_WINDS),
        ("layer planes", inputs.layer_planes.len(), Plan::MOST_LAYERS),
    ] {
        if count > most as usize {
            return refuse(format!("{count} {what}"), format!("at most {most}"));
        }
    }
    let end = |system: &SystemFrame| u64::from(system.first_bound) + u64::from(system.bound_count);
    let last = inputs.systems.iter().map(end).max().unwrap_or(0);
    if last > inputs.bounds.len() as u64 {
        return refuse(
            format!("a system's bounds end at {last}"),
            format!("there are {}", inputs.bounds.len()),
        );
    }
    let is_stored = |row: &SystemRow| {
        let [_, first, len, _] = row.shape;
        let stored = plan.curve_points.len() as f32;
        row.kinds[0] != SHAPE_CURVE || (first >= 0.0 && len >= 1.0 && first + len < stored)
    };
    if !inputs.rows.iter().all(is_stored) {
        return refuse(
            "a row names points of curves that the plan has not".into(),
            "give the plan a system that is born on that curve".into(),
        );
    }
    let has_faces = |row: &SystemRow| {
        let [_, first, count, _] = row.shape;
        let stored = plan.meshes.choices.len() as f32;
        row.kinds[0] != SHAPE_MESH || (first >= 0.0 && count >= 1.0 && first + count <= stored)
    };
    if !inputs.rows.iter().all(has_faces) {
        return refuse(
            "a row names faces of meshes that the plan has not".into(),
            "give the plan a system that is born on that mesh".into(),
        );
    }
    Ok(())
}
