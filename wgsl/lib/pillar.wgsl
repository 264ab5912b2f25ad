// Upright cylinders: where a line of sight meets one, and what one leaves of a light.
//
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/pillar.rs.
#define_import_path motes::pillar

#import motes::exact::{
    at_least_zero, clamp_unit, inverse_square_root, less, max_exact, min_exact, normalize_exact,
    reciprocal, square_root,
}
#import motes::layout::Pillar

// How wide its rounded rim is, as a share of the radius.
const RIM: f32 = 0.14f;

// Where a line of sight meets a pillar.
struct Meeting {
    // How far that is, in lengths of the way.
    far: f32,
    // How much of the pixel is covered.
    covered: f32,
    normal: vec3<f32>,
}

// Where the way from the eye meets the pillar; `pixel` is the width of a pixel a way's length away.
fn meeting(pillar: Pillar, eye: vec3<f32>, way: vec3<f32>, pixel: f32) -> Meeting {
    let from_axis = eye - pillar.place.xyz;
    let radius = pillar.place.w;
    let top = pillar.extent.x - eye.y;
    let across = way.x * way.x + way.z * way.z;
    let inverse = inverse_square_root(across);
    let beside = abs(from_axis.x * way.z - from_axis.z * way.x) * inverse;
    let middle = -(from_axis.x * way.x + from_axis.z * way.z) * inverse * inverse;
    let half = square_root(at_least_zero(radius * radius - beside * beside)) * inverse;
    var far = middle - half;
    var covered = clamp_unit(0.5f + (radius - beside) * reciprocal(middle * pixel));
    let height = way.y * far;
    let is_side = !less(top, height) && less(-from_axis.y, height);
    let place = from_axis + way * far;
    let outward = vec3<f32>(place.x, 0.0f, place.z) * pillar.extent.w;
    let rim = RIM * radius;
    let rim_share = reciprocal(rim);
    var normal = outward + vec3<f32>(0.0f, clamp_unit((rim - (top - height)) * rim_share), 0.0f);
    if !is_side {
        // The top, seen from above: its front edge is the side's.
        far = top * reciprocal(way.y);
        let on_top = from_axis + way * far;
        let squared = on_top.x * on_top.x + on_top.z * on_top.z;
        let inside = (radius - square_root(squared)) * abs(way.y) * reciprocal(far * pixel);
        let is_front = less(on_top.x * way.x + on_top.z * way.z, 0.0f);
        let edge = select(clamp_unit(0.5f + inside), select(0.0f, 1.0f, less(0.0f, inside)), is_front);
        covered = select(0.0f, min_exact(covered, edge), less(top, 0.0f) && less(way.y, 0.0f));
        let tilt = clamp_unit((rim - (radius - square_root(squared))) * rim_share);
        let slope = tilt * pillar.extent.w;
        normal = vec3<f32>(on_top.x * slope, 1.0f, on_top.z * slope);
    }
    let is_met = less(0.0f, far) && less(0.0f, across);
    return Meeting(far, select(0.0f, covered, is_met), normalize_exact(normal));
}

// What the pillar leaves of a light at `light` for a place: 0 in its shade, 1 outside, and between
// where the light passes near its edges.
fn passed(pillar: Pillar, place: vec3<f32>, light: vec3<f32>) -> f32 {
    let way = light - place;
    let from_axis = place - pillar.place.xyz;
    let radius = pillar.place.w;
    let across = way.x * way.x + way.z * way.z;
    let inverse = inverse_square_root(across);
    let beside = (from_axis.x * way.z - from_axis.z * way.x) * inverse;
    let middle = -(from_axis.x * way.x + from_axis.z * way.z) * inverse * inverse;
    let half = square_root(at_least_zero(radius * radius - beside * beside)) * inverse;
    let first = max_exact(middle - half, 0.0f);
    let last = min_exact(middle + half, 1.0f);
    let a = place.y + way.y * first;
    let b = place.y + way.y * last;
    let soft = 2.0f * pillar.extent.w;
    let below = clamp_unit((pillar.extent.x - min_exact(a, b)) * pillar.extent.w);
    let above = clamp_unit((max_exact(a, b) - pillar.place.y) * soft);
    let through = clamp_unit((last - first) * across * inverse * soft);
    return 1.0f - below * above * through;
}
