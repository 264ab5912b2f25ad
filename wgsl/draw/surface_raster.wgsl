// surface_raster: which triangle is seen in every sample, and how near it is.
//
// Two passes: the greatest nearness of each sample, and then, of the triangles that have it there, the
// last. One invocation a triangle; what may touch more than some blocks of pixels is listed in the
// first pass, and drawn in passes of its own by many invocations, which take turns with its blocks.
// Reads: frame, surfaces, surface_corners, large_faces. Writes, by atomics: surface_nearness,
// surface_faces (the triangle's number among all, and 1), large_faces (their count; then of each the
// triangle and its blocks).
// Invariant: neither the order of triangles nor how they are shared out is seen.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, f32_of_i32}
#import motes::layout::{Frame, SurfaceFrame}
#import motes::raster::{
    BLOCKS_FOR_ONE, BLOCK_PX, Edges, Nearness, Polygon, blocks_of, corner_seen, edges_of, misses, nearness_at,
    nearness_of, polygon_of, samples_down, samples_in, samples_right, triangle_of,
}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    faces: u32,
    surfaces: u32,
    // 1 if nearness is known, and triangles are looked for.
    names: u32,
    // Invocations a listed triangle; 0 if all are looked at.
    shares: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> surfaces: array<SurfaceFrame>;
@group(0) @binding(2) var<storage, read> surface_corners: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> large_faces: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> surface_nearness: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> surface_faces: array<atomic<u32>>;

// The surface that a triangle is of.
fn surface_of(face: u32) -> u32 {
    var surface = 0u;
    while surface + 1u < work.surfaces && surfaces[surface + 1u].faces.z <= face {
        surface += 1u;
    }
    return surface;
}

fn touch(sample: u32, nearness: f32, face: u32) {
    let bits = bits_of(nearness);
    if work.names == 0u {
        atomicMax(&surface_nearness[sample], bits);
    } else if atomicLoad(&surface_nearness[sample]) == bits {
        atomicMax(&surface_faces[sample], face + 1u);
    }
}

// One pixel, so many to the right and down of where the edges are told.
fn draw_pixel(edges: Edges, near: Nearness, at: vec2<i32>, right: i32, down: i32, face: u32) {
    let inside = samples_in(edges, right, down);
    if !(inside.x || inside.y || inside.z || inside.w) {
        return;
    }
    let x = at.x + right;
    let y = at.y + down;
    let rights = f32_of_i32(x) - frame.center_x_px + samples_right();
    let ups = frame.center_y_px - f32_of_i32(y) - samples_down();
    let first = (u32(y) * frame.width + u32(x)) * 4u;
    if inside.x {
        touch(first, nearness_at(near, rights.x, ups.x), face);
    }
    if inside.y {
        touch(first + 1u, nearness_at(near, rights.y, ups.y), face);
    }
    if inside.z {
        touch(first + 2u, nearness_at(near, rights.z, ups.z), face);
    }
    if inside.w {
        touch(first + 3u, nearness_at(near, rights.w, ups.w), face);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn surface_raster(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let index = linear_index(global_id, WORKGROUP_SIZE);
    let is_shared = work.shares > 0u;
    let shares = max(work.shares, 1u);
    var face = index;
    if is_shared {
        let entry = 1u + 2u * (index / shares);
        let is_listed = index / shares < atomicLoad(&large_faces[0]);
        if !is_listed || index % shares >= atomicLoad(&large_faces[entry + 1u]) {
            return;
        }
        face = atomicLoad(&large_faces[entry]);
    }
    if face >= work.faces {
        return;
    }
    let surface = surfaces[surface_of(face)];
    let corner = (surface.faces.x + face - surface.faces.z) * 3u;
    let a = corner_seen(frame, surface, bitcast<vec3<f32>>(surface_corners[corner].xyz));
    let b = corner_seen(frame, surface, bitcast<vec3<f32>>(surface_corners[corner + 1u].xyz));
    let c = corner_seen(frame, surface, bitcast<vec3<f32>>(surface_corners[corner + 2u].xyz));
    let polygon = polygon_of(frame, a, b, c);
    let blocks = blocks_of(polygon);
    let count = u32(blocks.x * blocks.y);
    if count > BLOCKS_FOR_ONE && !is_shared {
        if work.names == 0u {
            let entry = 1u + 2u * atomicAdd(&large_faces[0], 1u);
            atomicStore(&large_faces[entry], face);
            atomicStore(&large_faces[entry + 1u], count);
        }
        return;
    }
    let near = nearness_of(frame, a, b, c);
    for (var at = 1u; at + 1u < polygon.count; at += 1u) {
        let triangle = triangle_of(polygon, at);
        for (var block = index % shares; block < count; block += shares) {
            let place = vec2<i32>(i32(block) % blocks.x, i32(block) / blocks.x) * BLOCK_PX;
            let pixel = polygon.first + place;
            let size = min(polygon.end - pixel, vec2<i32>(BLOCK_PX));
            let edges = edges_of(triangle, pixel);
            let down_end = select(size.y, 0i, misses(edges, size));
            for (var down = 0i; down < down_end; down += 1i) {
                for (var right = 0i; right < size.x; right += 1i) {
                    draw_pixel(edges, near, pixel, right, down, face);
                }
            }
        }
    }
}
