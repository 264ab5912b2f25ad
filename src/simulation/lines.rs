//! The living as line segments, for vector displays: particles as their ways (Reeves 1983, 4.2),
//! flames as the trajectories of theirs (Perry 1994, 3.2). Boids are in `boid_lines`.

use glam::Vec3;

use crate::cpu::particle::row_index;
use crate::cpu::projection::{Projected, project, project_closing};
use crate::cpu::sprite::sprite_of;
use crate::layout::{FLAME_STEPS, Flame, Frame, Particle, SystemRow};
use crate::plan::{FrameInputs, Population};

/// A line segment as it is seen: a particle's way while the shutter is open, a step of a flame's
/// particle, a side of a boid or a step of its trail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Where it begins: pixels from the left and from the top.
    pub from_px: [f32; 2],
    /// Where it ends.
    pub to_px: [f32; 2],
    /// Light of a covered pixel in red, green, blue, before exposure.
    pub color: [f32; 3],
    /// What it is a line of.
    pub population: Population,
    /// Index in the scene of its system, fire or flock.
    pub slot: u32,
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
    let line = Line {
        from_px: [0.0; 2],
        to_px: [0.0; 2],
        color: sprite.color.into(),
        population: Population::Particles,
        slot: particle.slot(),
    };
    between(view, line, start, end)
}

/// The line from one seen place to another; `None` where either is nearer than the camera sees.
fn between(view: &Frame, line: Line, start: Projected, end: Projected) -> Option<Line> {
    (start.depth >= view.near && end.depth >= view.near).then_some(Line {
        from_px: [start.x, start.y],
        to_px: [end.x, end.y],
        ..line
    })
}

/// Lines along the steps of a burning flame's particle, coloured by age.
pub(super) fn lines_of_flame<'a>(
    flame: &Flame,
    steps: &'a [[u32; 4]],
    inputs: &'a FrameInputs,
) -> impl Iterator<Item = Line> + 'a {
    let view = &inputs.frame;
    let slot = flame.fire();
    let looks = &inputs.age_looks[(slot * FLAME_STEPS) as usize..];
    let brightness = f32::from_bits(flame.look[2]);
    let seen = move |[x, y, z, _]: &[u32; 4]| {
        let place = [x, y, z].map(|bits| f32::from_bits(*bits));
        project(view, place.into())
    };
    steps.windows(2).zip(looks).filter_map(move |(ends, look)| {
        let [red, green, blue, opacity] = look.center;
        let line = Line {
            from_px: [0.0; 2],
            to_px: [0.0; 2],
            color: [red, green, blue].map(|channel| channel * opacity * brightness),
            population: Population::Flames,
            slot,
        };
        between(view, line, seen(&ends[0]), seen(&ends[1]))
    })
}
