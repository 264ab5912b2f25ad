//! The screen area of a particle system (Reeves 1983, 2.1), the twin of `wgsl/lib/area.wgsl`.

use crate::exact::{
    at_least_zero, clamp_exact, f32_of_u32, less, reciprocal, shared_constants, square_root,
};
use crate::layout::{FRAME_ORTHOGRAPHIC, Frame};

shared_constants! {
    /// Rows of pixels that the covered area is summed over.
    const SLABS: u32 = 256;
    const SLAB_SHARE: f32 = 0.003_906_25;
}

fn in_view(row: [f32; 4], world: [f32; 4]) -> f32 {
    row[0] * world[0] + row[1] * world[1] + row[2] * world[2] + row[3]
}

/// Pixels of the viewport that `sphere` (centre in world space, radius) covers: projected as a
/// disc, clipped to the picture; 0 when its centre is nearer than the camera sees.
pub fn screen_area_px(view: &Frame, sphere: [f32; 4]) -> f32 {
    let depth = in_view(view.view_from_world_z, sphere);
    if less(depth, view.near) {
        return 0.0;
    }
    let scale = if view.flags & FRAME_ORTHOGRAPHIC != 0 {
        view.focal_px
    } else {
        view.focal_px * reciprocal(depth)
    };
    let x = view.center_x_px + in_view(view.view_from_world_x, sphere) * scale;
    let y = view.center_y_px - in_view(view.view_from_world_y, sphere) * scale;
    let radius = sphere[3] * scale;
    let width = 2.0 * view.center_x_px;
    let height = 2.0 * view.center_y_px;
    let top = clamp_exact(y - radius, 0.0, height);
    let bottom = clamp_exact(y + radius, 0.0, height);
    let slab = (bottom - top) * SLAB_SHARE;
    let mut area = 0.0;
    for at in 0..SLABS {
        let dy = top + (f32_of_u32(at) + 0.5) * slab - y;
        let half = square_root(at_least_zero(radius * radius - dy * dy));
        let left = clamp_exact(x - half, 0.0, width);
        let right = clamp_exact(x + half, 0.0, width);
        area += (right - left) * slab;
    }
    area
}
