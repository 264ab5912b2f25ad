// glow: flames add their light to the pixels they touch.
//
// Perry 1994, 3.2.2: the particles along a flame accumulate, whichever comes first. So many
// invocations share a flame, each taking every so manieth run of 8 pixels in a line: what the 25
// particles add to a pixel is summed before it is added, once, to the picture.
// A disc is as near as the place that it is around, and its front.
// Reads: frame, flame_discs, flame_skews, flame_bounds, flame_steps,
// surface_nearness. Writes, by atomic adds: light_low, light_high.
// Invariant: the image does not depend on the order of flames, nor on how they are shared out.

#import motes::fan::{Lit, center_shares, with_disc}
#import motes::dispatch::linear_index
#import motes::exact::{f32_of_u32, less, reciprocal}
#import motes::layout::{FLAME_STEPS, FlameDisc, Frame}
#import motes::light::steps_of
#import motes::veil::{front_of, open_share}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether some particles have a matrix.
const SKEWS: bool = #{SKEWS};
// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};
// Pixels that an invocation sums at a time.
const GLOW_RUN: u32 = 8u;

struct Work {
    // Flames of a page.
    flame_count: u32,
    // Invocations a flame.
    shares: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> flame_discs: array<FlameDisc>;
@group(0) @binding(2) var<storage, read> flame_bounds: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read> flame_skews: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read> surface_nearness: array<vec4<u32>>;

fn add_to_limbs(at: u32, steps: u32) {
    let before = atomicAdd(&light_low[at], steps);
    if before > 0xffffffffu - steps {
        atomicAdd(&light_high[at], 1u);
    }
}

fn add_light(x: u32, y: u32, end: u32, light: vec3<f32>) {
    if x >= end || !less(0.0f, light.x + light.y + light.z) {
        return;
    }
    let first = (y * frame.width + x) * 3u;
    add_to_limbs(first, steps_of(light.x));
    add_to_limbs(first + 1u, steps_of(light.y));
    add_to_limbs(first + 2u, steps_of(light.z));
}

// Adds to the sum what of `more` surfaces leave in four pixels, of which the first is told.
fn with_open(sum: Lit, more: Lit, front: u32, x: u32, y: u32, end: u32) -> Lit {
    let pixel = y * frame.width + x;
    let last = y * frame.width + end - 1u;
    let open = vec4<f32>(
        open_share(surface_nearness[min(pixel, last)], front),
        open_share(surface_nearness[min(pixel + 1u, last)], front),
        open_share(surface_nearness[min(pixel + 2u, last)], front),
        open_share(surface_nearness[min(pixel + 3u, last)], front),
    );
    return Lit(sum.red + more.red * open, sum.green + more.green * open, sum.blue + more.blue * open);
}

fn no_light() -> Lit {
    return Lit(vec4<f32>(0.0f), vec4<f32>(0.0f), vec4<f32>(0.0f));
}

// What a flame adds to a run of pixels from column `x` of line `y` on, up to column `end`.
fn glow_run(flame: u32, inner: vec2<f32>, x: u32, y: u32, end: u32) {
    var near = no_light();
    var far = no_light();
    let columns = f32_of_u32(x) + 0.5f + vec4<f32>(0.0f, 1.0f, 2.0f, 3.0f);
    let line = f32_of_u32(y) + 0.5f;
    let middle = f32_of_u32(x) + 4.0f;
    for (var age = 0u; age < FLAME_STEPS; age += 1u) {
        let at = flame * FLAME_STEPS + age;
        let place = bitcast<vec4<f32>>(flame_discs[at].place);
        let down = line - place.y;
        let is_beside = less(1.0f + 4.0f * place.z, abs(middle - place.x) * place.z);
        if SKEWS || (less(abs(down * place.w), 1.0f) && !is_beside) {
            let center = bitcast<vec4<f32>>(flame_discs[at].center);
            let rim = bitcast<vec4<f32>>(flame_discs[at].rim);
            var skew = vec2<f32>(0.0f);
            if SKEWS {
                skew = bitcast<vec2<f32>>(flame_skews[at]);
            }
            let off = columns - place.x;
            let off_far = columns + 4.0f - place.x;
            let across = off * place.z + down * skew.x;
            let across_far = off_far * place.z + down * skew.x;
            let along = off * skew.y + down * place.w;
            let along_far = off_far * skew.y + down * place.w;
            let shares = center_shares(across, along);
            let shares_far = center_shares(across_far, along_far);
            if SURFACES {
                let world = bitcast<vec3<f32>>(flame_steps[at].xyz);
                let row = frame.view_from_world_z;
                let depth = row.x * world.x + row.y * world.y + row.z * world.z + row.w;
                let front = front_of(frame, depth, reciprocal(abs(place.z) + abs(skew.x)));
                let of_near = with_disc(no_light(), center, rim, inner, shares);
                let of_far = with_disc(no_light(), center, rim, inner, shares_far);
                near = with_open(near, of_near, front, x, y, end);
                far = with_open(far, of_far, front, x + 4u, y, end);
            } else {
                near = with_disc(near, center, rim, inner, shares);
                far = with_disc(far, center, rim, inner, shares_far);
            }
        }
    }
    add_four(near, x, y, end);
    add_four(far, x + 4u, y, end);
}

fn add_four(lit: Lit, x: u32, y: u32, end: u32) {
    add_light(x, y, end, vec3<f32>(lit.red.x, lit.green.x, lit.blue.x));
    add_light(x + 1u, y, end, vec3<f32>(lit.red.y, lit.green.y, lit.blue.y));
    add_light(x + 2u, y, end, vec3<f32>(lit.red.z, lit.green.z, lit.blue.z));
    add_light(x + 3u, y, end, vec3<f32>(lit.red.w, lit.green.w, lit.blue.w));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn glow(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let index = linear_index(global_id, WORKGROUP_SIZE);
    let flame = index / work.shares;
    if flame >= work.flame_count {
        return;
    }
    let bounds = flame_bounds[flame];
    let first = bounds.xy & vec2<u32>(0xffffu);
    let last = bounds.xy >> vec2<u32>(16u);
    let inner = bitcast<vec2<f32>>(bounds.zw);
    let runs_across = (last.x - first.x + GLOW_RUN - 1u) / GLOW_RUN;
    let runs = runs_across * (last.y - first.y);
    for (var run = index % work.shares; run < runs; run += work.shares) {
        let x = first.x + (run % runs_across) * GLOW_RUN;
        glow_run(flame, inner, x, first.y + run / runs_across, last.x);
    }
}
