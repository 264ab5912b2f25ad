// How far what is drawn reaches in the picture, and whether it is in there at all.
//
// Reeves 1983, 2.5: a sphere is a disc of radius size focal / depth. Discs and streaks have an edge
// one pixel wide. Twin of src/cpu/reach.rs.
#define_import_path motes::reach

#import motes::exact::{
    at_least_zero, clamp_unit, f32_of_i32, less, max_exact, min_exact, square_root,
}
#import motes::layout::Frame
#import motes::projection::Projected

const PI: f32 = 3.14159265f;
// Radii are at most this many pixels: four times the largest picture.
const MOST_RADIUS_PX: f32 = 16384.0f;
// What moves less than the root of this while the shutter is open is at rest, square pixels.
const LEAST_WAY_SQUARED: f32 = 0.0001f;

// Whether any of it may fall into the picture.
fn is_visible(view: Frame, start: Projected, end: Projected, radius_px: f32) -> bool {
    let reach = radius_px + 2.0f;
    let width = f32_of_i32(i32(view.width));
    let height = f32_of_i32(i32(view.height));
    return !(less(start.depth, view.near)
        || less(end.depth, view.near)
        || less(max_exact(start.x, end.x) + reach, 0.0f)
        || less(max_exact(start.y, end.y) + reach, 0.0f)
        || less(width, min_exact(start.x, end.x) - reach)
        || less(height, min_exact(start.y, end.y) - reach));
}

// Whether it is seen to move while the shutter is open.
fn moves(start: Projected, end: Projected) -> bool {
    let dx = end.x - start.x;
    let dy = end.y - start.y;
    return less(LEAST_WAY_SQUARED, dx * dx + dy * dy);
}

// The radius whose edge, one pixel wide, gives the area of a disc of `radius_px`: such an edge adds
// 1/12 to the square of the radius. At least half a pixel.
fn edged_radius(radius_px: f32) -> f32 {
    return max_exact(square_root(at_least_zero(radius_px * radius_px - 0.0833333333f)), 0.5f);
}

// The centre of a pixel, along one axis.
fn center_of(pixel: i32) -> f32 {
    return f32_of_i32(pixel) + 0.5f;
}

// How much of the pixel around `center` lies within [low, high], along one axis.
fn overlap(center: f32, low: f32, high: f32) -> f32 {
    let left = center - 0.5f;
    return clamp_unit(min_exact(left + 1.0f, high) - max_exact(left, low));
}
