// strips: strips along flames add their light to the pixels they touch.
//
// Perry 1994, 4.2 and Fig 4-1. Many invocations share a flame, each taking every so manieth pixel of those
// that it may touch; a pixel is of the pieces of the strip that it lies in, nearly always one or none.
// Reads: frame, fires, age_looks, flames, strip_joints, flame_bounds, surface_nearness. Writes, by atomic
// adds: light_low, light_high.
// Invariant: between two pieces there is no gap, and nothing is of both, but where a strip turns back on
// itself within a step, as it is seen: there it is open. The image does not depend on the order of flames,
// nor on how they are shared out.

#import motes::dispatch::linear_index
#import motes::exact::{f32_of_u32, less, reciprocal, to_u32}
#import motes::layout::{AgeLook, FLAME_STEPS, FireFrame, Flame, Frame, StripJoint}
#import motes::light::steps_of
#import motes::veil::{front_of, open_share}
#import motes::strip::{along, beside, color_age, end_share, middle_share, turbulence}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};
// Whether noise changes any strip.
const TEXTURES: bool = #{TEXTURES};

struct Work {
    // Flames of a page.
    flame_count: u32,
    // Invocations a flame.
    shares: u32,
    // The first of them among all.
    first: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> age_looks: array<AgeLook>;
@group(0) @binding(3) var<storage, read> flames: array<Flame>;
@group(0) @binding(4) var<storage, read> strip_joints: array<StripJoint>;
@group(0) @binding(5) var<storage, read> flame_bounds: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(8) var<storage, read> surface_nearness: array<vec4<u32>>;

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

// What a flame adds to the pixel `at` of the picture.
fn strip_light(flame: u32, fire: FireFrame, slot: u32, index: u32, pixel: vec2<f32>, at: u32) -> vec3<f32> {
    var sum = vec3<f32>(0.0f);
    var from_here = strip_joints[flame * FLAME_STEPS];
    var place = bitcast<vec4<f32>>(from_here.place);
    var off = pixel - place.xy;
    var ahead = along(off, place.zw);
    for (var age = 1u; age < FLAME_STEPS; age += 1u) {
        let to_there = strip_joints[flame * FLAME_STEPS + age];
        let next = bitcast<vec4<f32>>(to_there.place);
        let off_next = pixel - next.xy;
        let ahead_next = along(off_next, next.zw);
        let are_seen = from_here.extent.z == 1u && to_there.extent.z == 1u;
        // Between lines that look away from each other there is no end to a piece.
        let goes_on = less(0.0f, along(next.zw, place.zw));
        if are_seen && goes_on && !less(ahead, 0.0f) && less(ahead_next, 0.0f) {
            let part = ahead * reciprocal(ahead - ahead_next);
            let here = bitcast<vec2<f32>>(from_here.extent.xy);
            let there = bitcast<vec2<f32>>(to_there.extent.xy);
            let between = here + (there - here) * part;
            let aside = beside(off, place.zw);
            let far = aside + (beside(off_next, next.zw) - aside) * part;
            let across = far * reciprocal(between.x);
            if less(abs(across), 1.0f) {
                let own_age = f32_of_u32(age - 1u) + part;
                let depths = vec2<f32>(bitcast<f32>(from_here.extent.w), bitcast<f32>(to_there.extent.w));
                let open = open_at(at, depths.x + (depths.y - depths.x) * part, between.x);
                sum += texel(fire, slot, index, own_age, across, between.y) * open;
            }
        }
        from_here = to_there;
        place = next;
        off = off_next;
        ahead = ahead_next;
    }
    return sum;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn strips(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    let flame = at / work.shares;
    if flame >= work.flame_count {
        return;
    }
    let bounds = flame_bounds[flame];
    let first = bounds.xy & vec2<u32>(0xffffu);
    let last = bounds.xy >> vec2<u32>(16u);
    let columns = last.x - first.x;
    let pixels = columns * (last.y - first.y);
    let slot = flames[work.first + flame].root_and_fire.w;
    let index = flames[work.first + flame].motion_and_index.w;
    let fire = fires[slot];
    for (var nth = at % work.shares; nth < pixels; nth += work.shares) {
        let x = first.x + nth % columns;
        let y = first.y + nth / columns;
        let middle = vec2<f32>(f32_of_u32(x) + 0.5f, f32_of_u32(y) + 0.5f);
        let pixel = y * frame.width + x;
        let light = strip_light(flame, fire, slot, index, middle, pixel);
        if less(0.0f, light.x + light.y + light.z) {
            let channel = pixel * 3u;
            add_to_limbs(channel, steps_of(light.x));
            add_to_limbs(channel + 1u, steps_of(light.y));
            add_to_limbs(channel + 2u, steps_of(light.z));
        }
    }
}
