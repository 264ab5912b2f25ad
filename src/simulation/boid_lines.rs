//! Boids as line segments, for vector displays: triangles or cones along their headings, and the
//! trails behind them.

use glam::{Vec2, Vec3};

use super::lines::Line;
use crate::cpu::projection::{Projected, project};
use crate::exact::cross3;
use crate::layout::{BOID_CONE, BOID_POINT, Boid, FlockFrame};
use crate::plan::{FrameInputs, Population};
use crate::transcendental::{cos_turns, sin_turns};

/// Sides of the round base of a cone, as far as it is seen: of the half that is always seen, and of all.
const HALF_SIDES: u32 = 6;
const ALL_SIDES: u32 = 16;

/// All lines of a boid, its mirror image's included; none of one that is not drawn. `trails` are the
/// places of all flocks. A boid that has no outline that shows where it heads, a disc, is a triangle.
pub(super) fn lines_of_boid(boid: &Boid, trails: &[[u32; 4]], inputs: &FrameInputs) -> Vec<Line> {
    let flock = &inputs.flocks[boid.flock() as usize];
    let faces = flock.drawn[1];
    if faces == 0 {
        return Vec::new();
    }
    let mut lines = trail(flock, boid, trails, inputs);
    let outline = match flock.ties[3] {
        BOID_CONE => cone(flock, boid, inputs),
        _ => triangle(flock, boid, inputs),
    };
    let sides = outline.windows(2);
    lines.extend(sides.map(|ends| line(flock, boid, [ends[0], ends[1]], 1.0)));
    if faces == 2 {
        let width = inputs.frame.width as f32;
        let across = |[x, y]: [f32; 2]| [width - x, y];
        let images: Vec<Line> = lines
            .iter()
            .map(|line| Line {
                from_px: across(line.from_px),
                to_px: across(line.to_px),
                ..*line
            })
            .collect();
        lines.extend(images);
    }
    lines
}

/// A line in the boid's colour, with a part of its opacity.
fn line(flock: &FlockFrame, boid: &Boid, ends: [Vec2; 2], part: f32) -> Line {
    let [red, green, blue, opacity] = flock.color;
    Line {
        from_px: ends[0].to_array(),
        to_px: ends[1].to_array(),
        color: [red, green, blue].map(|channel| channel * opacity * part),
        population: Population::Boids,
        slot: boid.flock(),
    }
}

/// Where these places are seen; nothing if one of them is nearer than the camera sees.
fn seen<const N: usize>(inputs: &FrameInputs, places: [Vec3; N]) -> Option<[Projected; N]> {
    let seen = places.map(|place| project(&inputs.frame, place));
    let near = inputs.frame.near;
    seen.iter().all(|it| it.depth >= near).then_some(seen)
}

fn on_picture(place: Projected) -> Vec2 {
    Vec2::new(place.x, place.y)
}

fn forward_of(boid: &Boid) -> Vec3 {
    let velocity = Vec3::from(boid.velocity());
    velocity.try_normalize().unwrap_or(Vec3::X)
}

/// The corners of its triangle, the first once more at the end.
fn triangle(flock: &FlockFrame, boid: &Boid, inputs: &FrameInputs) -> Vec<Vec2> {
    let position = Vec3::from(boid.position());
    let forward = forward_of(boid);
    let [x, y, z, _] = inputs.frame.view_from_world_z;
    let side = cross3(forward, Vec3::new(x, y, z)).normalize_or_zero();
    let in_pixels = flock.ties[3] == BOID_POINT;
    let scale = project(&inputs.frame, position).scale;
    let size = flock.cells_per_unit[3] / if in_pixels { scale } else { 1.0 };
    let tip = position + side * (0.5 * size) + forward * (1.2 * size);
    let corners = [position, position + side * size, tip];
    let Some([a, b, c]) = seen(inputs, corners) else {
        return Vec::new();
    };
    [a, b, c, a].map(on_picture).to_vec()
}

/// The outline of its cone, from its apex and back to it; of one that points at the viewer or away, that of
/// its base.
fn cone(flock: &FlockFrame, boid: &Boid, inputs: &FrameInputs) -> Vec<Vec2> {
    let position = Vec3::from(boid.position());
    let (forward, size) = (forward_of(boid), flock.cells_per_unit[3]);
    let ends = [
        position - forward * (0.75 * size),
        position + forward * (1.25 * size),
    ];
    let Some([base, apex]) = seen(inputs, ends) else {
        return Vec::new();
    };
    let radius = 0.5 * size * base.scale;
    let [base, apex] = [base, apex].map(on_picture);
    // A place of the base's circle, from the way to the apex on.
    let ahead = (apex - base).try_normalize().unwrap_or(Vec2::X);
    let on_circle = |cos: f32, sin: f32| base + (ahead * cos + ahead.perp() * sin) * radius;
    let turned = |at: u32, sides: u32, first: f32| {
        let turns = first + at as f32 / sides as f32 * (1.0 - 2.0 * first);
        on_circle(cos_turns(turns), sin_turns(turns))
    };
    let length = base.distance(apex);
    if length <= radius {
        return (0..=ALL_SIDES)
            .map(|at| turned(at, ALL_SIDES, 0.0))
            .collect();
    }
    // Where the tangents from the apex touch the circle.
    let cos = radius / length;
    let sin = (1.0 - cos * cos).sqrt();
    let back = (0..=HALF_SIDES).map(|at| turned(at, HALF_SIDES, 0.25));
    let mut outline = vec![apex, on_circle(cos, sin)];
    outline.extend(back);
    outline.extend([on_circle(cos, -sin), apex]);
    outline
}

/// The steps of its trail, from the oldest to the newest; a jump across the world is none.
fn trail(flock: &FlockFrame, boid: &Boid, trails: &[[u32; 4]], inputs: &FrameInputs) -> Vec<Line> {
    let [first, mask, count, _] = flock.trail;
    let [fainter, _, farthest, _] = flock.trail_look;
    let ring = first + boid.index() * (mask + 1);
    let mut newer = Vec3::from(boid.position());
    let mut steps = Vec::new();
    for age in 0..count {
        let at = ring + (inputs.frame.frame.wrapping_sub(age) & mask);
        let [x, y, z, _] = trails[at as usize].map(f32::from_bits);
        let older = Vec3::new(x, y, z);
        let squared = newer.distance_squared(older);
        if squared > 0.0
            && squared < farthest
            && let Some(ends) = seen(inputs, [older, newer])
        {
            let part = 1.0 - (age + 1) as f32 * fainter;
            steps.push(line(flock, boid, ends.map(on_picture), part));
        }
        newer = older;
    }
    steps.reverse();
    steps
}
