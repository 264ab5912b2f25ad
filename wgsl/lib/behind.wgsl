// What covers, and surfaces: a pixel on the way from near to far, some samples of which end on one.
//
// Of a pixel, what is open and what ends on a surface is told apart: a record covers all of the open
// part, and those samples of the other whose surface is behind it (motes::veil has four a pixel).
// Reads and writes no buffers. Invariant: exact on every driver; where there is no surface, as
// motes::cover has it; twin of src/cpu/behind.rs.
#define_import_path motes::behind

#import motes::cover::{HIDDEN, Kinds, Layered, Spot, part_at}
#import motes::exact::{bits_of, f32_of_u32, less, reciprocal, snap, snap3}
#import motes::layout::Cover
#import motes::veil::open_samples

// A pixel: its open part as if there were no other, and how much shows through of what its surface
// sends.
struct Parted {
    open: Layered,
    front: f32,
}

// Samples of a pixel that end on a surface.
fn ended_samples(nearness: vec4<u32>) -> u32 {
    return 4u - open_samples(nearness, 1u);
}

// Whether nothing that comes behind is seen.
fn is_closed_pixel(pixel: Parted, nearness: vec4<u32>) -> bool {
    let ended = ended_samples(nearness);
    return (ended == 4u || less(pixel.open.clear, HIDDEN)) && (ended == 0u || less(pixel.front, HIDDEN));
}

// The pixel with `cover` behind what it has so far.
fn behind_parted(
    above: Parted, cover: Cover, kinds: Kinds, light_from: vec3<f32>, spot: Spot, nearness: vec4<u32>,
) -> Parted {
    let ended = ended_samples(nearness);
    let part = part_at(cover, kinds, light_from, spot);
    let nearer = bits_of(reciprocal(bitcast<f32>(cover.shape.w)));
    let before = open_samples(nearness, nearer) - (4u - ended);
    let closed = is_closed_pixel(above, nearness);
    let open_part = f32_of_u32(4u - ended) * 0.25f;
    let front_part = f32_of_u32(before) * 0.25f;
    let shows = above.open.clear * open_part + above.front * front_part;
    let seen = select(shows * part.alpha, 0.0f, closed);
    let color = bitcast<vec4<f32>>(cover.color);
    let lit = bitcast<vec3<f32>>(cover.lit.xyz);
    let look = color.xyz + lit * part.light;
    let clear = above.open.clear * (1.0f - part.alpha);
    let of_ended = f32_of_u32(before) * reciprocal(f32_of_u32(ended));
    let front = above.front * (1.0f - part.alpha * of_ended);
    return Parted(
        Layered(snap3(above.open.color + look * seen), snap(select(clear, above.open.clear, closed))),
        snap(select(front, above.front, closed)),
    );
}
