//! From the space of a system's particles to the world, and from there to the picture
//! (Reeves 1983, 2.5 and 3). Twin of `wgsl/lib/projection.wgsl`.

use glam::Vec3;

use crate::exact::{max_exact, reciprocal};
use crate::layout::{FRAME_ORTHOGRAPHIC, Frame, SystemFrame};

/// A point in pixels, its depth along the view axis, its squared distance from the eye, and the
/// pixels that a world unit spans there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projected {
    pub(crate) x: f32,
    pub(crate) y: f32,
    pub(crate) depth: f32,
    pub(crate) distance_squared: f32,
    pub(crate) scale: f32,
}

#[inline]
fn transform(x_row: [f32; 4], y_row: [f32; 4], z_row: [f32; 4], p: Vec3) -> Vec3 {
    Vec3::new(
        x_row[0] * p.x + x_row[1] * p.y + x_row[2] * p.z + x_row[3],
        y_row[0] * p.x + y_row[1] * p.y + y_row[2] * p.z + y_row[3],
        z_row[0] * p.x + z_row[1] * p.y + z_row[2] * p.z + z_row[3],
    )
}

/// A point of the system's space in world space.
#[inline]
pub fn world_of(system: &SystemFrame, in_system: Vec3) -> Vec3 {
    transform(
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
        in_system,
    )
}

#[inline(always)]
fn seen_at(view: &Frame, seen: Vec3, focal_px: f32) -> Projected {
    let scale = if view.flags & FRAME_ORTHOGRAPHIC != 0 {
        focal_px
    } else {
        focal_px * reciprocal(max_exact(seen.z, view.near))
    };
    Projected {
        x: view.center_x_px + seen.x * scale,
        y: view.center_y_px - seen.y * scale,
        depth: seen.z,
        distance_squared: seen.x * seen.x + seen.y * seen.y + seen.z * seen.z,
        scale,
    }
}

/// Where a world place is seen when the frame begins.
#[inline(always)]
pub(crate) fn project(view: &Frame, world: Vec3) -> Projected {
    let seen = transform(
        view.view_from_world_x,
        view.view_from_world_y,
        view.view_from_world_z,
        world,
    );
    seen_at(view, seen, view.focal_px)
}

/// Where a place of the system is seen when the shutter closes: by then system and camera may
/// have moved.
#[inline]
pub(crate) fn project_closing(view: &Frame, system: &SystemFrame, in_system: Vec3) -> Projected {
    let world = transform(
        system.closing_world_from_system_x,
        system.closing_world_from_system_y,
        system.closing_world_from_system_z,
        in_system,
    );
    let seen = transform(
        view.closing_view_from_world_x,
        view.closing_view_from_world_y,
        view.closing_view_from_world_z,
        world,
    );
    seen_at(view, seen, view.closing_focal_px)
}
