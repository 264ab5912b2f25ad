//! boid_trails: where boids have been in the last frames, as segments that fade and narrow. Twin of
//! `wgsl/draw/boid_trails.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::projection::project;
use crate::cpu::reach::is_visible;
use crate::cpu::shape::{Look, mirrored, segment_of};
use crate::exact::{dot3, f32_of_u32, less, max_exact};
use crate::layout::{BOID_POINT, Boid, Cover, FlockFrame};
use crate::plan::FrameInputs;

/// What is drawn between two places, `newer` after `older`, with that part of the boid's opacity and of
/// the trail's width.
fn segment(flock: &FlockFrame, newer: Vec3, older: Vec3, part: f32, inputs: &FrameInputs) -> Cover {
    let frame = &inputs.frame;
    let way = newer - older;
    let squared = dot3(way, way);
    let start = project(frame, newer);
    let end = project(frame, older);
    let size = flock.cells_per_unit[3];
    let size_px = if flock.ties[3] == BOID_POINT {
        size
    } else {
        size * start.scale
    };
    let [_, width, farthest, _] = flock.trail_look;
    let width_px = size_px * width * part;
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, newer) == frame.layer;
    let stays = !less(0.0, squared) || !less(squared, farthest);
    if !here || stays || !is_visible(frame, start, end, width_px) {
        return Cover::default();
    }
    let [red, green, blue, opacity] = flock.color;
    let look = Look {
        depth: max_exact(start.depth, end.depth),
        color: Vec4::new(red, green, blue, opacity * part),
        lit: Vec3::ZERO,
    };
    let (from, to) = (Vec2::new(start.x, start.y), Vec2::new(end.x, end.y));
    segment_of(from, to, 0.5 * width_px, &look)
}

/// The records of the boid's trail, from the oldest segment to the newest; `trails` are the places of
/// all flocks.
pub fn boid_trails(
    flock: &FlockFrame,
    boid: &Boid,
    trails: &[[u32; 4]],
    inputs: &FrameInputs,
) -> Vec<Cover> {
    let frame = &inputs.frame;
    let [first, mask, count, _] = flock.trail;
    let ring = first + boid.index() * (mask + 1);
    let mut newer = Vec3::from(boid.position());
    let mut segments = Vec::new();
    for age in 0..count {
        let at = ring + (frame.frame.wrapping_sub(age) & mask);
        let [x, y, z, _] = trails[at as usize].map(f32::from_bits);
        let older = Vec3::new(x, y, z);
        let part = 1.0 - f32_of_u32(age + 1) * flock.trail_look[0];
        segments.push(segment(flock, newer, older, part, inputs));
        newer = older;
    }
    let faces = flock.drawn[1] as usize;
    let records = segments.into_iter().rev().flat_map(|cover| {
        let both = if faces == 2 {
            mirrored(cover, frame)
        } else {
            [cover; 2]
        };
        both.into_iter().take(faces)
    });
    records.collect()
}
