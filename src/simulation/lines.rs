//! The living as line segments, for vector displays (Reeves 1983, 4.2).

use glam::Vec3;

use crate::cpu::particle::row_index;
use crate::cpu::projection::{Projected, project_closing};
use crate::cpu::sprite::sprite_of;
use crate::layout::{Particle, SystemRow};
use crate::plan::FrameInputs;

/// A particle's way while the shutter is open, as it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Where it begins: pixels from the left and from the top.
    pub from_px: [f32; 2],
    /// Where it ends.
    pub to_px: [f32; 2],
    /// Light of a covered pixel in red, green, blue, before exposure.
    pub color: [f32; 3],
    /// Index of its system in the scene.
    pub system: u32,
}

/// The particle's line; `None` where an end of it is nearer than the camera sees.
pub(super) fn line_of(
    particle: &Particle,
    inputs: &FrameInputs,
    rows: &[SystemRow],
) -> Option<Line> {
    let view = &inputs.frame;
    let system = &inputs.systems[particle.slot() as usize];
    let row = &rows[row_index(particle.slot(), 0, 0)];
    let sprite = sprite_of(inputs, row, particle);
    let position = Vec3::from(particle.position());
    let shift = Vec3::from(particle.velocity()) * view.shutter;
    let start = sprite.start;
    let end = project_closing(view, system, position + shift);
    let is_seen = |point: &Projected| point.depth >= view.near;
    if !is_seen(&start) || !is_seen(&end) {
        return None;
    }
    Some(Line {
        from_px: [start.x, start.y],
        to_px: [end.x, end.y],
        color: sprite.color.into(),
        system: particle.slot(),
    })
}
