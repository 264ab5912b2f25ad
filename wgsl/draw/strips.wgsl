// strips: strips along flames add their light to the pixels they touch.
//
// Perry 1994, 4.2 and Fig 4-1. Each piece of a strip, between two joints, is drawn by itself: many
// invocations share it, each taking every so manieth pixel of those that the piece may touch. A pixel is of
// one piece or none, nearly always; what a piece adds to it is rounded before it is added.
// Reads: frame, fires, age_looks, flames, strip_joints, surface_nearness. Writes, by atomic adds:
// light_low, light_high.
// Invariant: between two pieces there is no gap, and nothing is of both, but where a strip turns back on
// itself within a step, as it is seen: there it is open. The image does not depend on the order of flames,
// nor on how their pieces are shared out.

#import motes::dispatch::linear_index
#import motes::exact::{f32_of_u32, less, max_exact, reciprocal, to_i32, to_u32}
#import motes::layout::{AgeLook, FLAME_STEPS, FireFrame, Flame, Frame, StripJoint}
#import motes::light::steps_of
#import motes::veil::{front_of, open_share}
#import motes::strip::{PIECES, along, beside, color_age, end_share, middle_share, piece_reach, turbulence}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};
// Whether noise changes any strip.
const TEXTURES: bool = #{TEXTURES};

struct Work {
    // One past the last flame of the page that is drawn.
    end: u32,
    // Invocations a piece of a strip.
    shares: u32,
    // The page's first flame among all, and the first of the page that is drawn.
    first: u32,
    start: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> age_looks: array<AgeLook>;
@group(0) @binding(3) var<storage, read> flames: array<Flame>;
@group(0) @binding(4) var<storage, read> strip_joints: array<StripJoint>;
@group(0) @binding(5) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read> surface_nearness: array<vec4<u32>>;

fn add_to_limbs(at: u32, steps: u32) {
    let before = atomicAdd(&light_low[at], steps);
    if before > 0xffffffffu - steps {
        atomicAdd(&light_high[at], 1u);
    }
}

// The light of the strip at an age and so many half-widths from its middle.
fn texel(fire: FireFrame, slot: u32, index: u32, age: f32, across: f32, opacity: f32) -> vec3<f32> {
    var turbulent = 0.0f;
    if TEXTURES {
        turbulent = turbulence(fire, index, age, across);
    }
    let share = middle_share(fire, age, across, turbulent);
    let moved = color_age(fire, age, turbulent);
    let low = min(to_u32(moved), FLAME_STEPS - 2u);
    let part = moved - f32_of_u32(low);
    let here = age_looks[slot * FLAME_STEPS + low];
    let next = age_looks[slot * FLAME_STEPS + low + 1u];
    let center = here.center + (next.center - here.center) * part;
    let rim = here.rim + (next.rim - here.rim) * part;
    let alpha = center.w * share * (opacity * end_share(age));
    return (rim.xyz + (center.xyz - rim.xyz) * share) * alpha;
}

// What surfaces leave of a place of the strip in the pixel.
fn open_at(at: u32, depth: f32, half_width: f32) -> f32 {
    if !SURFACES {
        return 1.0f;
    }
    return open_share(surface_nearness[at], front_of(frame, depth, half_width));
}

// A piece of a strip, from one joint to the next.
struct Piece {
    // Its age at the first.
    age: u32,
    // The joints' places, and the ways on from there.
    here: vec4<f32>,
    there: vec4<f32>,
    // Their half-widths, opacities and depths.
    from_here: vec3<f32>,
    to_there: vec3<f32>,
}

fn extent_of(joint: StripJoint) -> vec3<f32> {
    return bitcast<vec3<f32>>(vec3<u32>(joint.extent.xy, joint.extent.w));
}

// What a piece adds to the pixel `at` of the picture.
fn piece_light(piece: Piece, fire: FireFrame, slot: u32, index: u32, pixel: vec2<f32>, at: u32) -> vec3<f32> {
    let off = pixel - piece.here.xy;
    let off_next = pixel - piece.there.xy;
    let ahead = along(off, piece.here.zw);
    let ahead_next = along(off_next, piece.there.zw);
    if less(ahead, 0.0f) || !less(ahead_next, 0.0f) {
        return vec3<f32>(0.0f);
    }
    let part = ahead * reciprocal(ahead - ahead_next);
    let extent = piece.from_here + (piece.to_there - piece.from_here) * part;
    let aside = beside(off, piece.here.zw);
    let far = aside + (beside(off_next, piece.there.zw) - aside) * part;
    let across = far * reciprocal(extent.x);
    if !less(abs(across), 1.0f) {
        return vec3<f32>(0.0f);
    }
    let own_age = f32_of_u32(piece.age) + part;
    return texel(fire, slot, index, own_age, across, extent.y) * open_at(at, extent.z, extent.x);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn strips(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    let nth = at / work.shares;
    let flame = work.start + nth / PIECES;
    if flame >= work.end {
        return;
    }
    let age = nth % PIECES;
    let from_here = strip_joints[flame * FLAME_STEPS + age];
    let to_there = strip_joints[flame * FLAME_STEPS + age + 1u];
    let piece = Piece(
        age,
        bitcast<vec4<f32>>(from_here.place),
        bitcast<vec4<f32>>(to_there.place),
        extent_of(from_here),
        extent_of(to_there),
    );
    let are_seen = from_here.extent.z == 1u && to_there.extent.z == 1u;
    // Between lines that look away from each other there is no end to a piece.
    if !are_seen || !less(0.0f, along(piece.there.zw, piece.here.zw)) {
        return;
    }
    let reach = piece_reach(piece.here, piece.there, max_exact(piece.from_here.x, piece.to_there.x));
    let size = vec2<i32>(i32(frame.width), i32(frame.height));
    let low = clamp(
        vec2<i32>(to_i32(piece.here.x - reach.x), to_i32(piece.here.y - reach.y)), vec2<i32>(0), size,
    );
    let high = clamp(
        vec2<i32>(to_i32(piece.here.x + reach.x) + 1, to_i32(piece.here.y + reach.y) + 1), vec2<i32>(0), size,
    );
    if low.x >= high.x {
        return;
    }
    let first = vec2<u32>(low);
    let end = vec2<u32>(high);
    let columns = end.x - first.x;
    let slot = flames[work.first + flame].root_and_fire.w;
    let index = flames[work.first + flame].motion_and_index.w;
    let fire = fires[slot];
    let share = at % work.shares;
    let across = work.shares % columns;
    let down = work.shares / columns;
    var x = first.x + share % columns;
    var y = first.y + share / columns;
    while y < end.y {
        let middle = vec2<f32>(f32_of_u32(x) + 0.5f, f32_of_u32(y) + 0.5f);
        let pixel = y * frame.width + x;
        let light = piece_light(piece, fire, slot, index, middle, pixel);
        if less(0.0f, light.x + light.y + light.z) {
            let channel = pixel * 3u;
            add_to_limbs(channel, steps_of(light.x));
            add_to_limbs(channel + 1u, steps_of(light.y));
            add_to_limbs(channel + 2u, steps_of(light.z));
        }
        x += across;
        y += down;
        if x >= end.x {
            x -= columns;
            y += 1u;
        }
    }
}
