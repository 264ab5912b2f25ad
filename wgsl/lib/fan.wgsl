// A flame's particle as it is seen: coplanar triangles around its centre, whose rim is a regular
// polygon of 20 corners, scaled along x and y.
//
// Perry 1994, 3.2.1: Gouraud shading makes red, green, blue and alpha linear from the centre to the
// rim in each triangle. The share of the centre is 1 less the distance from it, measured so that
// every side of the polygon is at 1: no triangle has to be looked for. Light is colour times alpha,
// for particles add up (3.2.2).
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/fan.rs.
#define_import_path motes::fan

#import motes::exact::{at_least_zero, is_positive, larger, reciprocal, smaller}

// Corners of the rim.
const CORNERS: u32 = 20u;
// Unit vectors to the middles of the sides at 9, 27 and 45 degrees, over the sides' distance
// cos(9 degrees) from the centre of the circle through the corners.
const SIDE_A_X: f32 = 1.0f;
const SIDE_A_Y: f32 = 0.15838444f;
const SIDE_B_X: f32 = 0.9021130f;
const SIDE_B_Y: f32 = 0.45964956f;
const SIDE_C: f32 = 0.7159210f;
// No place is divided by less.
const LEAST_DIVISOR: f32 = 0.25f;
// No half-axis is drawn shorter, in pixels: what is smaller is so much fainter.
const LEAST_HALF_AXIS_PX: f32 = 1.5f;

// Light of four pixels side by side.
struct Lit {
    red: vec4<f32>,
    green: vec4<f32>,
    blue: vec4<f32>,
}

// A particle.
struct Fan {
    // Its place in the picture, and one over its half-axes; what its matrix adds to these, and how what
    // places are divided by grows across and down.
    place: vec4<f32>,
    skew: vec4<f32>,
    // Its second layer, as `with_two_discs` has it.
    inner: vec2<f32>,
    center: vec4<f32>,
    rim: vec4<f32>,
    // How near it is.
    front: u32,
}

// The share of the centre in the colour at `x`, `y`, in half-axes from the centre; 0 outside.
fn center_share(x: f32, y: f32) -> f32 {
    // By symmetry, the sides of an eighth are enough.
    let a = abs(x);
    let b = abs(y);
    let major = larger(a, b);
    let minor = smaller(a, b);
    let side_a = major * SIDE_A_X + minor * SIDE_A_Y;
    let side_b = major * SIDE_B_X + minor * SIDE_B_Y;
    let side_c = (major + minor) * SIDE_C;
    return at_least_zero(1.0f - larger(side_a, larger(side_b, side_c)));
}

// The same at four places.
fn center_shares(x: vec4<f32>, y: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(
        center_share(x.x, y.x), center_share(x.y, y.y), center_share(x.z, y.z), center_share(x.w, y.w),
    );
}

// Which of the shares are of places inside.
fn are_inside(share: vec4<f32>) -> vec4<bool> {
    return vec4<bool>(is_positive(share.x), is_positive(share.y), is_positive(share.z), is_positive(share.w));
}

// The share that the centre of the inner layer has: the same distance, from another radius.
fn inner_share(share: f32, inverse_radius: f32) -> f32 {
    return at_least_zero(1.0f - (1.0f - share) * inverse_radius);
}

// The sum with the light of a particle of these colours and opacities, where its centre has those
// shares; none outside.
fn with_disc(sum: Lit, center: vec4<f32>, rim: vec4<f32>, share: vec4<f32>) -> Lit {
    return with_alpha(sum, center, rim, share, rim.w + (center.w - rim.w) * share);
}

// The same with a second layer (4.1) of `inner.x` times the opacity of the centre, and a radius of
// which `inner.y` is the inverse.
fn with_two_discs(sum: Lit, center: vec4<f32>, rim: vec4<f32>, inner: vec2<f32>, share: vec4<f32>) -> Lit {
    let inner_shares = vec4<f32>(
        inner_share(share.x, inner.y),
        inner_share(share.y, inner.y),
        inner_share(share.z, inner.y),
        inner_share(share.w, inner.y),
    );
    let outer = rim.w + (center.w - rim.w) * share;
    return with_alpha(sum, center, rim, share, outer + (center.w * inner.x) * inner_shares);
}

fn with_alpha(sum: Lit, center: vec4<f32>, rim: vec4<f32>, share: vec4<f32>, inside: vec4<f32>) -> Lit {
    let inward = center.xyz - rim.xyz;
    let alpha = select(vec4<f32>(0.0f), inside, are_inside(share));
    return Lit(
        sum.red + (rim.x + inward.x * share) * alpha,
        sum.green + (rim.y + inward.y * share) * alpha,
        sum.blue + (rim.z + inward.z * share) * alpha,
    );
}

// One over what a place is divided by, so far as it is in sight: in a particle, it is a half at least.
fn share_of(divisor: f32) -> f32 {
    return reciprocal(larger(divisor, LEAST_DIVISOR));
}

// The sum with the light of a particle on four pixels in these columns, `down` lines below its centre;
// whether any has a matrix, and a second layer.
fn with_fan(sum: Lit, fan: Fan, columns: vec4<f32>, down: f32, skews: bool, inners: bool) -> Lit {
    let off = columns - fan.place.x;
    var across = off * fan.place.z;
    var along = vec4<f32>(down * fan.place.w);
    if skews {
        let divisor = off * fan.skew.z + (1.0f + down * fan.skew.w);
        let share = vec4<f32>(
            share_of(divisor.x), share_of(divisor.y), share_of(divisor.z), share_of(divisor.w),
        );
        across = (across + vec4<f32>(down * fan.skew.x)) * share;
        along = (along + off * fan.skew.y) * share;
    }
    let shares = center_shares(across, along);
    if inners {
        return with_two_discs(sum, fan.center, fan.rim, fan.inner, shares);
    }
    return with_disc(sum, fan.center, fan.rim, shares);
}
