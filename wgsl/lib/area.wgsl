// The screen area of a particle system, which sets its level of detail.
//
// Reeves 1983, 2.1: the pixels that the bounding sphere of the generation shape covers, projected
// as a disc and clipped to the picture; none when its centre is nearer than the camera sees.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/area.rs.
#define_import_path motes::area

#import motes::exact::{at_least_zero, clamp_exact, f32_of_u32, less, reciprocal, square_root}
#import motes::layout::{FRAME_ORTHOGRAPHIC, Frame}

// Rows of pixels that the covered area is summed over.
const SLABS: u32 = 256u;
// 1 / SLABS.
const SLAB_SHARE: f32 = 0.00390625f;

fn in_view(row: vec4<f32>, world: vec3<f32>) -> f32 {
    return row.x * world.x + row.y * world.y + row.z * world.z + row.w;
}

// Pixels that the sphere (centre in world space, radius) covers.
fn screen_area_px(view: Frame, sphere: vec4<f32>) -> f32 {
    let depth = in_view(view.view_from_world_z, sphere.xyz);
    if less(depth, view.near) {
        return 0.0f;
    }
    let orthographic = (view.flags & FRAME_ORTHOGRAPHIC) != 0u;
    let scale = select(view.focal_px * reciprocal(depth), view.focal_px, orthographic);
    let x = view.center_x_px + in_view(view.view_from_world_x, sphere.xyz) * scale;
    let y = view.center_y_px - in_view(view.view_from_world_y, sphere.xyz) * scale;
    let radius = sphere.w * scale;
    let width = 2.0f * view.center_x_px;
    let height = 2.0f * view.center_y_px;
    let top = clamp_exact(y - radius, 0.0f, height);
    let bottom = clamp_exact(y + radius, 0.0f, height);
    let slab = (bottom - top) * SLAB_SHARE;
    var area = 0.0f;
    for (var at = 0u; at < SLABS; at += 1u) {
        let dy = top + (f32_of_u32(at) + 0.5f) * slab - y;
        let half = square_root(at_least_zero(radius * radius - dy * dy));
        let left = clamp_exact(x - half, 0.0f, width);
        let right = clamp_exact(x + half, 0.0f, width);
        area += (right - left) * slab;
    }
    return area;
}
