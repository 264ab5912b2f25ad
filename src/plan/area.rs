//! The screen area of a particle system (Reeves 1983, 2.1).

use crate::layout::{Frame, SystemFrame};

/// Rows of pixels that the covered area is summed over.
const SLABS: u32 = 256;

/// Pixels of the viewport that the system's bounding sphere covers: the projected sphere as a disc
/// of radius focal · radius / depth, clipped to the picture; 0 when its centre is behind `near`.
///
/// `bounding_radius` is in world units, about the system's origin. The width and height are those
/// of the principal point doubled.
pub fn screen_area_px(frame: &Frame, system: SystemFrame, bounding_radius: f32) -> f32 {
    let origin = [
        system.world_from_system_x[3],
        system.world_from_system_y[3],
        system.world_from_system_z[3],
    ];
    let view =
        |row: [f32; 4]| row[0] * origin[0] + row[1] * origin[1] + row[2] * origin[2] + row[3];
    let depth = view(frame.view_from_world_z);
    if depth < frame.near {
        return 0.0;
    }
    let scale = frame.focal_px / depth;
    let x = frame.center_x_px + view(frame.view_from_world_x) * scale;
    let y = frame.center_y_px - view(frame.view_from_world_y) * scale;
    let radius = bounding_radius * scale;
    let (width, height) = (2.0 * frame.center_x_px, 2.0 * frame.center_y_px);

    let top = (y - radius).clamp(0.0, height);
    let bottom = (y + radius).clamp(0.0, height);
    let slab = (bottom - top) / SLABS as f32;
    let mut area = 0.0;
    for at in 0..SLABS {
        let dy = top + (at as f32 + 0.5) * slab - y;
        let half = (radius * radius - dy * dy).max(0.0).sqrt();
        let left = (x - half).clamp(0.0, width);
        let right = (x + half).clamp(0.0, width);
        area += (right - left) * slab;
    }
    area
}
