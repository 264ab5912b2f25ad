// Where in its generation shape a particle is born, and which way it leaves.
//
// Reeves 1983, 2.2: sphere, circle and rectangle; beyond them ring, box, cone and line. The way is
// within the ejection angle of an axis: outward from the origin, around the local z axis, or up it.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/emission.rs.
#define_import_path motes::emission

#import motes::exact::{at_least_zero, cross3, dot3, less, normalize_exact, reciprocal, square_root}
#import motes::layout::{
    ROW_ANGLE_UNIFORM, ROW_AROUND, ROW_OUTWARD, SHAPE_CIRCLE, SHAPE_CONE, SHAPE_RING, SHAPE_SPHERE,
    SystemRow,
}
#import motes::rng::{signed_float, unit_float}
#import motes::transcendental::{cos_turns, cube_root, sin_turns}

// A place to be born at, and what is outward there (on a curve, onward).
struct Birthplace {
    position: vec3<f32>,
    axis: vec3<f32>,
}

// The unit vector at height z on the sphere, `turns` around the z axis.
fn on_sphere(z: f32, turns: f32) -> vec3<f32> {
    let ring = square_root(at_least_zero(1.0f - z * z));
    return vec3<f32>(ring * cos_turns(turns), ring * sin_turns(turns), z);
}

// A place in the generation shape, uniform; not on a curve, for those are stored.
fn in_shape(row: SystemRow, place: vec4<u32>) -> Birthplace {
    let kind = row.kinds.x;
    let shape = row.shape;
    let u = unit_float(place.x);
    if kind == SHAPE_SPHERE {
        let outward = on_sphere(signed_float(place.x), unit_float(place.y));
        return Birthplace(outward * (cube_root(unit_float(place.z)) * shape.x), outward);
    }
    var position = vec3<f32>(
        signed_float(place.x) * shape.x,
        signed_float(place.y) * shape.y,
        signed_float(place.z) * shape.z,
    );
    if kind == SHAPE_CIRCLE || kind == SHAPE_RING || kind == SHAPE_CONE {
        // A cone is discs that grow with the height.
        let height = cube_root(unit_float(place.z)) * shape.z;
        let inner = shape.w * shape.w;
        let ring = square_root(inner + u * (shape.x * shape.x - inner));
        let distance = select(ring, square_root(u) * shape.w * height, kind == SHAPE_CONE);
        let turns = unit_float(place.y);
        position = vec3<f32>(distance * cos_turns(turns), distance * sin_turns(turns), height);
    }
    return Birthplace(position, normalize_exact(position));
}

// The place `part` of the way from one stored point of a curve to the next.
fn on_curve(here: vec3<f32>, next: vec3<f32>, part: f32, scale: f32) -> Birthplace {
    let step = next - here;
    return Birthplace((here + step * part) * scale, normalize_exact(step));
}

// A place in a triangle, uniform: a corner and the edges from it, with the normal in their w.
fn on_triangle(
    corner: vec4<f32>,
    to_next: vec4<f32>,
    to_last: vec4<f32>,
    place: vec4<u32>,
    scale: f32,
) -> Birthplace {
    let u = unit_float(place.y);
    let v = unit_float(place.z);
    // The other half of the parallelogram is turned onto this one.
    let is_beyond = less(1.0f, u + v);
    let along = select(u, 1.0f - u, is_beyond);
    let across = select(v, 1.0f - v, is_beyond);
    return Birthplace(
        (corner.xyz + to_next.xyz * along + to_last.xyz * across) * scale,
        vec3<f32>(corner.w, to_next.w, to_last.w),
    );
}

// Two directions across a unit vector and each other.
struct Basis {
    across: vec3<f32>,
    upward: vec3<f32>,
}

// Duff and others, "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
fn basis_of(axis: vec3<f32>) -> Basis {
    let side = select(1.0f, -1.0f, less(axis.z, 0.0f));
    let a = -reciprocal(side + axis.z);
    let b = axis.x * axis.y * a;
    return Basis(
        vec3<f32>(1.0f + side * axis.x * axis.x * a, side * b, -side * axis.x),
        vec3<f32>(b, side + axis.y * axis.y * a, -axis.y),
    );
}

// A unit vector within the ejection angle of the unit vector `axis`.
fn ejected(row: SystemRow, axis: vec3<f32>, motion: vec4<u32>) -> vec3<f32> {
    let limits = row.ejection_and_light;
    let u = unit_float(motion.x);
    let by_angle = (row.kinds.w & ROW_ANGLE_UNIFORM) != 0u;
    let cosine = select(1.0f - u * (1.0f - limits.x), cos_turns(u * limits.y), by_angle);
    let local = on_sphere(cosine, unit_float(motion.y));
    let basis = basis_of(axis);
    return basis.across * local.x + basis.upward * local.y + axis * local.z;
}

// The axis that ejection angles are counted from; up where there is no outward or around.
fn axis_of(row: SystemRow, born: Birthplace) -> vec3<f32> {
    let up = vec3<f32>(0.0f, 0.0f, 1.0f);
    let flags = row.kinds.w;
    var axis = up;
    axis = select(axis, born.axis, (flags & ROW_OUTWARD) != 0u);
    axis = select(axis, normalize_exact(cross3(up, born.axis)), (flags & ROW_AROUND) != 0u);
    return select(up, axis, less(0.0f, dot3(axis, axis)));
}

// A vector turned as the rows of a transform turn.
fn turned(x_row: vec4<f32>, y_row: vec4<f32>, z_row: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        x_row.x * v.x + x_row.y * v.y + x_row.z * v.z,
        y_row.x * v.x + y_row.y * v.y + y_row.z * v.z,
        z_row.x * v.x + z_row.y * v.y + z_row.z * v.z,
    );
}

fn mixed(now: vec4<f32>, earlier: vec4<f32>, share: f32) -> vec4<f32> {
    return now + (earlier - now) * share;
}
