// What surfaces leave of what is behind them: by four samples a pixel, each with how near it is.
//
// Nearness is 1 over depth, as the bits of a float, whose order is that of unsigned integers; 0 where
// there is no surface. A particle is as near as its front, so that what is born on a surface is seen.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/veil.rs.
#define_import_path motes::veil

#import motes::exact::{bits_of, f32_of_u32, min_exact, reciprocal}
#import motes::layout::Frame

// How near the front of something round is, of which the radius is seen in pixels.
fn front_of(frame: Frame, depth: f32, radius_px: f32) -> u32 {
    let share = min_exact(radius_px * reciprocal(frame.focal_px), 0.5f);
    return bits_of(reciprocal(depth - depth * share));
}

// How many samples of a pixel have no surface before that.
fn open_samples(nearness: vec4<u32>, front: u32) -> u32 {
    let open = select(vec4<u32>(0u), vec4<u32>(1u), nearness < vec4<u32>(front));
    return open.x + open.y + open.z + open.w;
}

// The share of a pixel that has no surface before that.
fn open_share(nearness: vec4<u32>, front: u32) -> f32 {
    return f32_of_u32(open_samples(nearness, front)) * 0.25f;
}
