// Triangles in the picture: where their corners are, which samples they cover, and how near they are.
//
// Corners are projected to 256ths of a pixel, and edges are whole numbers of these (Pineda, "A parallel
// algorithm for polygon rasterization", 1988): a sample on an edge is of the triangle that has it at its
// top or left, so that two that share an edge share no sample of it and leave none out. Of four samples
// a pixel, no two are in a row or a column. What is nearer than `near` or far out of the picture is
// clipped; from both sides of an edge, a corner of the clipped is the same. Nearness is 1 over depth,
// which is linear in the picture; it is that of the plane of the whole triangle.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/raster.rs.
#define_import_path motes::raster

#import motes::exact::{
    clamp_exact, cross3, dot3, f32_of_u32, less, max_exact, min_exact, normalize_exact, reciprocal, to_i32,
}
#import motes::layout::{Frame, SurfaceFrame}

// Steps of a corner's place in a pixel.
const SUBPIXELS: f32 = 256.0f;
// Farther from the picture's middle, in pixels, is out of it.
const GUARD_PX: f32 = 8192.0f;
// No corner is farther from the picture's corner, in subpixels, rounded or not.
const FARTHEST_SUBPIXEL: i32 = 4000000i;
// Corners of a triangle that is clipped at five planes, at most.
const MOST_CORNERS: u32 = 8u;
// Sides of a block of pixels that is looked at at once.
const BLOCK_PX: i32 = 8i;
// A triangle that may touch more blocks is not left to one invocation.
const BLOCKS_FOR_ONE: u32 = 16u;
// An edge that is so far to one side of a block is on that side of all of it.
const ASIDE: i32 = 536870912i;
// 2 / 65,535.
const OCTAHEDRON_STEP: f32 = 0.000030518044f;

// Where a corner of a mesh is in view space.
fn corner_seen(frame: Frame, surface: SurfaceFrame, corner: vec3<f32>) -> vec3<f32> {
    let world = rows_times(
        surface.world_from_mesh_x, surface.world_from_mesh_y, surface.world_from_mesh_z, corner,
    );
    return rows_times(frame.view_from_world_x, frame.view_from_world_y, frame.view_from_world_z, world);
}

fn rows_times(x_row: vec4<f32>, y_row: vec4<f32>, z_row: vec4<f32>, p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        x_row.x * p.x + x_row.y * p.y + x_row.z * p.z + x_row.w,
        y_row.x * p.x + y_row.y * p.y + y_row.z * p.z + y_row.w,
        z_row.x * p.x + z_row.y * p.y + z_row.z * p.z + z_row.w,
    );
}

// How near a triangle is at a place of the picture, from its middle in pixels: a linear function,
// within what its corners have.
struct Nearness {
    right: f32,
    up: f32,
    middle: f32,
    least: f32,
    most: f32,
}

fn nearness_of(frame: Frame, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Nearness {
    let normal = normalize_exact(cross3(normalize_exact(b - a), normalize_exact(c - a)));
    let inverse = reciprocal(dot3(normal, a));
    let a_pixel = inverse * reciprocal(frame.focal_px);
    let of_a = reciprocal(max_exact(a.z, frame.near));
    let of_b = reciprocal(max_exact(b.z, frame.near));
    let of_c = reciprocal(max_exact(c.z, frame.near));
    return Nearness(
        normal.x * a_pixel,
        normal.y * a_pixel,
        normal.z * inverse,
        min_exact(min_exact(of_a, of_b), of_c),
        max_exact(max_exact(of_a, of_b), of_c),
    );
}

fn nearness_at(near: Nearness, right: f32, up: f32) -> f32 {
    return clamp_exact(near.right * right + near.up * up + near.middle, near.least, near.most);
}

// How far inside one of the planes a place is that all is clipped at: below 0 is outside.
fn inside_by(frame: Frame, p: vec3<f32>, side: u32) -> f32 {
    let aside = select(p.x, p.y, side > 2u) * frame.focal_px;
    let guarded = GUARD_PX * p.z + select(aside, -aside, (side & 1u) == 0u);
    return select(guarded, p.z - frame.near, side == 0u);
}

// One bit a plane that a place is outside of.
fn sides_of(frame: Frame, p: vec3<f32>) -> u32 {
    var bits = 0u;
    for (var side = 0u; side < 5u; side += 1u) {
        bits |= select(0u, 1u << side, less(inside_by(frame, p, side), 0.0f));
    }
    return bits;
}

// Corners of what is left of a triangle, in subpixels; the whole pixels that it may touch, first and
// one past the last; none if there are fewer than three corners.
struct Polygon {
    count: u32,
    x: array<i32, 8>,
    y: array<i32, 8>,
    first: vec2<i32>,
    end: vec2<i32>,
}

fn subpixel(px: f32) -> i32 {
    return clamp(to_i32(px * SUBPIXELS + 0.5f), -FARTHEST_SUBPIXEL, FARTHEST_SUBPIXEL);
}

fn polygon_of(frame: Frame, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Polygon {
    var polygon: Polygon;
    let of_a = sides_of(frame, a);
    let of_b = sides_of(frame, b);
    let of_c = sides_of(frame, c);
    var places: array<vec3<f32>, 8>;
    places[0] = a;
    places[1] = b;
    places[2] = c;
    var count = select(3u, 0u, (of_a & of_b & of_c) != 0u);
    var sides = select(of_a | of_b | of_c, 0u, count == 0u);
    while sides != 0u {
        let side = firstTrailingBit(sides);
        sides &= sides - 1u;
        var kept: array<vec3<f32>, 8>;
        var kept_count = 0u;
        for (var at = 0u; at < count; at += 1u) {
            let here = places[at];
            let next = places[select(at + 1u, 0u, at + 1u == count)];
            let by_here = inside_by(frame, here, side);
            let by_next = inside_by(frame, next, side);
            let is_out = less(by_here, 0.0f);
            if !is_out && kept_count < MOST_CORNERS {
                kept[kept_count] = here;
                kept_count += 1u;
            }
            if is_out != less(by_next, 0.0f) && kept_count < MOST_CORNERS {
                // From the end that is inside, whichever triangle's edge it is.
                let inner = select(here, next, is_out);
                let outer = select(next, here, is_out);
                let by_inner = select(by_here, by_next, is_out);
                let by_outer = select(by_next, by_here, is_out);
                let part = by_inner * reciprocal(by_inner - by_outer);
                kept[kept_count] = inner + (outer - inner) * part;
                kept_count += 1u;
            }
        }
        places = kept;
        count = kept_count;
    }
    var low = vec2<i32>(FARTHEST_SUBPIXEL);
    var high = vec2<i32>(-FARTHEST_SUBPIXEL);
    for (var at = 0u; at < count; at += 1u) {
        let place = places[at];
        let scale = frame.focal_px * reciprocal(max_exact(place.z, frame.near));
        let x = subpixel(frame.center_x_px + place.x * scale);
        let y = subpixel(frame.center_y_px - place.y * scale);
        polygon.x[at] = x;
        polygon.y[at] = y;
        low = min(low, vec2<i32>(x, y));
        high = max(high, vec2<i32>(x, y));
    }
    polygon.count = count;
    polygon.first = max(low >> vec2<u32>(8u), vec2<i32>(0i));
    let size = vec2<i32>(i32(frame.width), i32(frame.height));
    polygon.end = min((high >> vec2<u32>(8u)) + 1i, size);
    return polygon;
}

// Blocks of pixels that a polygon may touch, across and down.
fn blocks_of(polygon: Polygon) -> vec2<i32> {
    let size = max(polygon.end - polygon.first, vec2<i32>(0i));
    let blocks = (size + BLOCK_PX - 1i) / BLOCK_PX;
    return select(blocks, vec2<i32>(0i), polygon.count < 3u || blocks.x == 0i || blocks.y == 0i);
}

// (a b - c d - bias) / 64, rounded down and clamped to ASIDE, for factors below 2^23: in digits of 12
// bits, as there are no longer integers.
fn wide(a: i32, b: i32, c: i32, d: i32, bias: i32) -> i32 {
    let ah = a >> 12u;
    let al = a & 4095i;
    let bh = b >> 12u;
    let bl = b & 4095i;
    let ch = c >> 12u;
    let cl = c & 4095i;
    let dh = d >> 12u;
    let dl = d & 4095i;
    let low = al * bl - cl * dl - bias;
    let middle = ah * bl + al * bh - ch * dl - cl * dh + (low >> 12u);
    let high = ah * bh - ch * dh + (middle >> 12u);
    let rest = (middle & 4095i) * 64i + ((low & 4095i) >> 6u);
    let whole = clamp(high, -2048i, 2047i) * 262144i + rest;
    return select(select(whole, ASIDE, high > 2047i), -ASIDE, high < -2048i);
}

// Three edges as they are at the first sample of a pixel: at least 0 inside; and how they change for
// a quarter of a pixel to the right and down.
struct Edges {
    start: vec3<i32>,
    right: vec3<i32>,
    down: vec3<i32>,
}

fn edge_at(place: vec2<i32>, start: vec2<i32>, end: vec2<i32>) -> i32 {
    let way = end - start;
    let is_top_left = way.y < 0i || (way.y == 0i && way.x > 0i);
    return wide(way.x, place.y - start.y, way.y, place.x - start.x, select(1i, 0i, is_top_left));
}

// A triangle in subpixels, its inside to the right of its edges.
struct Triangle {
    a: vec2<i32>,
    b: vec2<i32>,
    c: vec2<i32>,
}

// That of a polygon's first corner and of the corners `at` and `at` + 1.
fn triangle_of(polygon: Polygon, at: u32) -> Triangle {
    let a = vec2<i32>(polygon.x[0], polygon.y[0]);
    let b = vec2<i32>(polygon.x[at], polygon.y[at]);
    let c = vec2<i32>(polygon.x[at + 1u], polygon.y[at + 1u]);
    let is_back = wide(b.x - a.x, c.y - a.y, b.y - a.y, c.x - a.x, 0i) < 0i;
    return Triangle(a, select(b, c, is_back), select(c, b, is_back));
}

// Its edges at a pixel's first sample.
fn edges_of(triangle: Triangle, pixel: vec2<i32>) -> Edges {
    let a = triangle.a;
    let b = triangle.b;
    let c = triangle.c;
    let place = pixel * 256i + 32i;
    return Edges(
        vec3<i32>(edge_at(place, a, b), edge_at(place, b, c), edge_at(place, c, a)),
        vec3<i32>(a.y - b.y, b.y - c.y, c.y - a.y),
        vec3<i32>(b.x - a.x, c.x - b.x, a.x - c.x),
    );
}

// Whether no sample of so many pixels to the right and down can be inside.
fn misses(edges: Edges, size: vec2<i32>) -> bool {
    let zero = vec3<i32>(0i);
    let reach = size * 4i - 1i;
    let most = edges.start + max(edges.right, zero) * reach.x + max(edges.down, zero) * reach.y;
    return most.x < 0i || most.y < 0i || most.z < 0i;
}

// Which of the four samples of a pixel, so many to the right and down, are inside.
fn samples_in(edges: Edges, right: i32, down: i32) -> vec4<bool> {
    let here = edges.start + edges.right * (4i * right) + edges.down * (4i * down);
    let rights = vec4<i32>(1i, 3i, 0i, 2i);
    let downs = vec4<i32>(0i, 1i, 2i, 3i);
    let a = here.x + edges.right.x * rights + edges.down.x * downs;
    let b = here.y + edges.right.y * rights + edges.down.y * downs;
    let c = here.z + edges.right.z * rights + edges.down.z * downs;
    return (a >= vec4<i32>(0i)) & (b >= vec4<i32>(0i)) & (c >= vec4<i32>(0i));
}

// Where a pixel's samples are, from its left upper corner in pixels.
fn samples_right() -> vec4<f32> {
    return vec4<f32>(0.375f, 0.875f, 0.125f, 0.625f);
}

fn samples_down() -> vec4<f32> {
    return vec4<f32>(0.125f, 0.375f, 0.625f, 0.875f);
}

// A unit vector from its word: where it meets an octahedron, whose lower half is folded outward
// (Cigolle et al., "Survey of efficient representations for independent unit vectors", 2014), in 65,535ths.
fn normal_of(word: u32) -> vec3<f32> {
    let x = f32_of_u32(word & 0xffffu) * OCTAHEDRON_STEP - 1.0f;
    let y = f32_of_u32(word >> 16u) * OCTAHEDRON_STEP - 1.0f;
    let z = 1.0f - abs(x) - abs(y);
    let folded_x = select(1.0f - abs(y), abs(y) - 1.0f, less(x, 0.0f));
    let folded_y = select(1.0f - abs(x), abs(x) - 1.0f, less(y, 0.0f));
    let is_lower = less(z, 0.0f);
    return normalize_exact(vec3<f32>(select(x, folded_x, is_lower), select(y, folded_y, is_lower), z));
}
