// The place of a triangle that is nearest to a place (Ericson 2005, Real-Time Collision Detection, 5.1.5),
// and on which side of a closed mesh a place is: that of the normal of what is nearest, which of an edge is
// the sum of its faces', and of a corner the sum of its faces' by their angles (Baerentzen and Aanaes
// 2005). Reads and writes no buffers. Twin of src/cpu/solid.rs.
// Invariant: faces that share what is nearest tell the same side.
#define_import_path motes::solid

#import motes::exact::{dot3, inverse_square_root, less, less_equal, normalize_exact, reciprocal, square_root}
#import motes::urge::{Surface, sign_of}

// What of a triangle is nearest: rows from its first one on to that of the normal.
const NEAR_FACE: u32 = 3u;
const NEAR_AB: u32 = 4u;
const NEAR_BC: u32 = 5u;
const NEAR_CA: u32 = 6u;
const NEAR_A: u32 = 7u;
const NEAR_B: u32 = 8u;
const NEAR_C: u32 = 9u;

// The way from the nearest place, its squared length, and what of the triangle it is.
struct Nearest {
    way: vec3<f32>,
    squared: f32,
    part: u32,
}

// From a triangle's place: v of the edge ab and w of ac from a.
fn from_place(away: vec3<f32>, ab: vec3<f32>, ac: vec3<f32>, v: f32, w: f32, part: u32) -> Nearest {
    let way = away - (ab * v + ac * w);
    return Nearest(way, dot3(way, way), part);
}

// From the triangle with the edges ab and ac to a place that is `away` from their corner a.
fn nearest_of(away: vec3<f32>, ab: vec3<f32>, ac: vec3<f32>) -> Nearest {
    let across = dot3(ab, ac);
    let ab_squared = dot3(ab, ab);
    let ac_squared = dot3(ac, ac);
    // Along both edges from a, from b and from c.
    let a1 = dot3(ab, away);
    let a2 = dot3(ac, away);
    let b1 = a1 - ab_squared;
    let b2 = a2 - across;
    let c1 = a1 - across;
    let c2 = a2 - ac_squared;
    if less_equal(a1, 0.0f) && less_equal(a2, 0.0f) {
        return from_place(away, ab, ac, 0.0f, 0.0f, NEAR_A);
    }
    if less_equal(0.0f, b1) && less_equal(b2, b1) {
        return from_place(away, ab, ac, 1.0f, 0.0f, NEAR_B);
    }
    if less_equal(0.0f, c2) && less_equal(c1, c2) {
        return from_place(away, ab, ac, 0.0f, 1.0f, NEAR_C);
    }
    // Areas of the triangles that the place's foot makes with two corners.
    let to_ab = a1 * b2 - b1 * a2;
    if less_equal(to_ab, 0.0f) && less_equal(0.0f, a1) && less_equal(b1, 0.0f) {
        return from_place(away, ab, ac, a1 * reciprocal(ab_squared), 0.0f, NEAR_AB);
    }
    let to_ca = c1 * a2 - a1 * c2;
    if less_equal(to_ca, 0.0f) && less_equal(0.0f, a2) && less_equal(c2, 0.0f) {
        return from_place(away, ab, ac, 0.0f, a2 * reciprocal(ac_squared), NEAR_CA);
    }
    let to_bc = b1 * c2 - c1 * b2;
    if less_equal(to_bc, 0.0f) {
        let w = (b2 - b1) * reciprocal((b2 - b1) + (c1 - c2));
        return from_place(away, ab, ac, 1.0f - w, w, NEAR_BC);
    }
    let inverse = reciprocal(to_ab + to_bc + to_ca);
    return from_place(away, ab, ac, to_ca * inverse, to_ab * inverse, NEAR_FACE);
}

// The surface of a mesh whose ball has that radius, from the nearest of its places, where that is its
// normal.
fn solid_surface(nearest: Nearest, normal: vec3<f32>, radius: f32) -> Surface {
    let side = sign_of(dot3(nearest.way, normal));
    let outward = nearest.way * (inverse_square_root(nearest.squared) * side);
    return Surface(
        select(normalize_exact(normal), outward, less(0.0f, nearest.squared)),
        square_root(nearest.squared) * side * radius,
    );
}
