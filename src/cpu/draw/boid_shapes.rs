//! boid_shapes: what boids look like: triangles along their headings, or discs. Twin of
//! `wgsl/draw/boid_shapes.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::projection::project;
use crate::cpu::reach::is_visible;
use crate::cpu::shape::{Look, disc_of, triangle_of};
use crate::exact::{bits_of, cross3, less, normalize_exact};
use crate::layout::{BOID_POINT, BOID_TRIANGLE, Boid, Cover, FlockFrame, Frame};
use crate::plan::FrameInputs;

/// The triangle of a boid; of nothing if a corner is too near.
fn triangle(frame: &Frame, size: f32, position: Vec3, velocity: Vec3, look: &Look) -> Cover {
    let heading = normalize_exact(velocity);
    // Who does not move heads along x.
    let stands = bits_of(heading.x) | bits_of(heading.y) | bits_of(heading.z);
    let forward = if stands == 0 { Vec3::X } else { heading };
    let side = normalize_exact(cross3(forward, Vec3::from_slice(&frame.view_from_world_z)));
    let a = project(frame, position);
    let b = project(frame, position + side * Vec3::splat(size));
    let tip = position + side * Vec3::splat(0.5 * size) + forward * Vec3::splat(1.2 * size);
    let c = project(frame, tip);
    if less(b.depth, frame.near) || less(c.depth, frame.near) {
        return Cover::default();
    }
    triangle_of(
        Vec2::new(a.x, a.y),
        Vec2::new(b.x, b.y),
        Vec2::new(c.x, c.y),
        look,
    )
}

/// A record of `boid`: that of its place, or of the mirrored one; of nothing where it is out of
/// sight.
pub fn boid_shapes(flock: &FlockFrame, boid: &Boid, face: u32, inputs: &FrameInputs) -> Cover {
    let frame = &inputs.frame;
    let across = if face == 1 { -1.0 } else { 1.0 };
    let mirror = Vec3::new(across, 1.0, 1.0);
    let position = Vec3::from(boid.position()) * mirror;
    let velocity = Vec3::from(boid.velocity()) * mirror;
    let seen = project(frame, position);
    let (size, shape) = (flock.cells_per_unit[3], flock.ties[3]);
    let size_px = if shape == BOID_POINT {
        size
    } else {
        size * seen.scale
    };
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, position) == frame.layer;
    if !here || !is_visible(frame, seen, seen, 2.0 * size_px) {
        return Cover::default();
    }
    let look = Look {
        depth: seen.depth,
        color: Vec4::from(flock.color),
        lit: Vec3::ZERO,
    };
    if shape == BOID_TRIANGLE {
        triangle(frame, size, position, velocity, &look)
    } else {
        disc_of(seen.x, seen.y, 0.5 * size_px, 0.0, &look)
    }
}
