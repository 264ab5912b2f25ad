//! boid_shapes: what boids look like: triangles or cones along their headings, or discs. Twin of
//! `wgsl/draw/boid_shapes.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::projection::project;
use crate::cpu::reach::is_visible;
use crate::cpu::shape::{Look, cone_of, disc_of, mirrored, triangle_of};
use crate::exact::{bits_of, cross3, dot3, less, normalize_exact, shared_constants};
use crate::layout::{BOID_CONE, BOID_POINT, BOID_TRIANGLE, Boid, Cover, FlockFrame, Frame};
use crate::plan::FrameInputs;

shared_constants! {
    /// How far a cone's base is behind its middle, in sizes: with a radius of half a size, as its angle
    /// has it.
    const BASE_BEHIND: f32 = 0.75;
    /// How far its apex is ahead.
    const APEX_AHEAD: f32 = 1.25;
}

/// Where a boid heads; who does not move, along x.
fn forward_of(velocity: Vec3) -> Vec3 {
    let heading = normalize_exact(velocity);
    let stands = bits_of(heading.x) | bits_of(heading.y) | bits_of(heading.z);
    if stands == 0 { Vec3::X } else { heading }
}

/// The cone of a boid; of nothing if an end is too near.
fn cone(frame: &Frame, size: f32, position: Vec3, velocity: Vec3, look: &Look) -> Cover {
    let forward = forward_of(velocity);
    let base = project(frame, position - forward * Vec3::splat(BASE_BEHIND * size));
    let apex = project(frame, position + forward * Vec3::splat(APEX_AHEAD * size));
    if less(base.depth, frame.near) || less(apex.depth, frame.near) {
        return Cover::default();
    }
    let ahead = -dot3(Vec3::from_slice(&frame.view_from_world_z), forward);
    let surface = look.color.truncate();
    let lit = Look {
        depth: look.depth,
        color: (surface * Vec3::from_slice(&frame.ambient_color)).extend(look.color.w),
        lit: surface * Vec3::from_slice(&frame.light_color),
    };
    let radius_px = 0.5 * size * base.scale;
    let [base, apex] = [base, apex].map(|it| Vec2::new(it.x, it.y));
    cone_of(base, apex, radius_px, ahead, &lit)
}

/// The triangle of a boid; of nothing if a corner is too near.
fn triangle(frame: &Frame, size: f32, position: Vec3, velocity: Vec3, look: &Look) -> Cover {
    let forward = forward_of(velocity);
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

/// A record of `boid`; of nothing where it is out of sight.
fn cover_of(flock: &FlockFrame, boid: &Boid, inputs: &FrameInputs) -> Cover {
    let frame = &inputs.frame;
    let position = Vec3::from(boid.position());
    let velocity = Vec3::from(boid.velocity());
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
    match shape {
        BOID_TRIANGLE => triangle(frame, size, position, velocity, &look),
        BOID_CONE => cone(frame, size, position, velocity, &look),
        _ => disc_of(seen.x, seen.y, 0.5 * size_px, 0.0, &look),
    }
}

/// The records of `boid`, as many as the flock has for each, at most 2.
pub fn boid_shapes(
    flock: &FlockFrame,
    boid: &Boid,
    inputs: &FrameInputs,
) -> impl Iterator<Item = Cover> + use<> {
    let faces = flock.drawn[1] as usize;
    let cover = if faces == 0 {
        Cover::default()
    } else {
        cover_of(flock, boid, inputs)
    };
    let both = if faces == 2 {
        mirrored(cover, &inputs.frame)
    } else {
        [cover, Cover::default()]
    };
    both.into_iter().take(faces)
}
