// Shadows that clouds throw on themselves: a box of cells along the light.
//
// A particle is a disc that takes as much of the light as it is opaque; what a cell takes is the sum of
// what its discs take of its cross-section. Reads and writes no buffers. Invariant: exact on every driver;
// twin of src/cpu/shade.rs.
#define_import_path motes::shade

#import motes::exact::{clamp_exact, dot3, f32_of_u32, f32_of_i32, min_exact, to_i32}
#import motes::layout::ShadeBox
#import motes::reach::PI

// A 65,535th.
const EDGE_STEP: f32 = 0.000015259022f;
// One particle takes no more of a cell.
const MOST_DEPTH: f32 = 64.0f;

// The first of the eight cells whose middles are around a place, and how far it is from there to the last.
struct Around {
    cell: vec3<i32>,
    part: vec3<f32>,
}

fn around(box: ShadeBox, world: vec3<f32>) -> Around {
    let x = dot3(box.across.xyz, world) + box.across.w - 0.5f;
    let y = dot3(box.aside.xyz, world) + box.aside.w - 0.5f;
    let z = dot3(box.along.xyz, world) + box.along.w - 0.5f;
    let cell = vec3<i32>(to_i32(x), to_i32(y), to_i32(z));
    let part = vec3<f32>(x - f32_of_i32(cell.x), y - f32_of_i32(cell.y), z - f32_of_i32(cell.z));
    return Around(cell, part);
}

fn is_cell(box: ShadeBox, cell: vec3<i32>) -> bool {
    let cells = i32(box.kinds.x);
    return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < cells && cell.y < cells && cell.z < cells;
}

// The share of one of the eight.
fn corner_share(part: vec3<f32>, corner: u32) -> f32 {
    let x = select(1.0f - part.x, part.x, (corner & 1u) != 0u);
    let y = select(1.0f - part.y, part.y, (corner & 2u) != 0u);
    let z = select(1.0f - part.z, part.z, (corner & 4u) != 0u);
    return x * y * z;
}

// What a disc of that radius and opacity, with an edge of so many 65,535ths of its radius, takes of a cell's
// cross-section. The mean of a smooth edge s wide is 1 - s + 0.3 s^2.
fn depth_of(size: f32, opacity: f32, edge: u32, box: ShadeBox) -> f32 {
    let soft = f32_of_u32(edge) * EDGE_STEP;
    let mean = 1.0f - soft + 0.3f * soft * soft;
    return min_exact(PI * size * size * opacity * mean * box.look.x, MOST_DEPTH);
}
