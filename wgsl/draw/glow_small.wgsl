// glow_small: flames of a few pixels add their light to these.
//
// Perry 1994, 3.2.2: the same sums as in glow.wgsl, without its tiles: so many invocations share a flame,
// each taking every so manieth run of 8 pixels in a line. What the 25 particles of a flame add to a pixel is
// summed before it is rounded.
// Reads: frame, flame_discs, flame_skews, flame_bounds, flame_steps, surface_nearness. Writes, by atomic
// adds: light_low, light_high.
// Invariant: of flames that are small all is drawn, of others nothing; the image does not depend on the
// order of flames, nor on how they are shared out.

#import motes::fan::{Fan, Lit, with_fan}
#import motes::dispatch::linear_index
#import motes::exact::{f32_of_u32, less, reciprocal}
#import motes::flame_tile::{SMALL_RUN, SMALL_SHARES, is_small}
#import motes::layout::{FLAME_STEPS, FlameDisc, Frame}
#import motes::light::steps_of
#import motes::veil::{front_of, open_share}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether some particles have a matrix.
const SKEWS: bool = #{SKEWS};
// Whether some have a second layer.
const INNERS: bool = #{INNERS};
// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};

struct Work {
    // Flames of a page, the first of them among all, and what flame_discs is told of details.
    flame_count: u32,
    first: u32,
    octave: u32,
    copy: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> flame_discs: array<FlameDisc>;
@group(0) @binding(2) var<storage, read> flame_bounds: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read> flame_skews: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read> surface_nearness: array<vec4<u32>>;

fn add_to_limbs(at: u32, steps: u32) {
    let before = atomicAdd(&light_low[at], steps);
    if before > 0xffffffffu - steps {
        atomicAdd(&light_high[at], 1u);
    }
}

fn add_light(x: u32, y: u32, end: vec2<u32>, light: vec3<f32>) {
    if x >= end.x || y >= end.y || !less(0.0f, light.x + light.y + light.z) {
        return;
    }
    let first = (y * frame.width + x) * 3u;
    add_to_limbs(first, steps_of(light.x));
    add_to_limbs(first + 1u, steps_of(light.y));
    add_to_limbs(first + 2u, steps_of(light.z));
}

fn add_four(x: u32, y: u32, end: vec2<u32>, lit: Lit) {
    add_light(x, y, end, vec3<f32>(lit.red.x, lit.green.x, lit.blue.x));
    add_light(x + 1u, y, end, vec3<f32>(lit.red.y, lit.green.y, lit.blue.y));
    add_light(x + 2u, y, end, vec3<f32>(lit.red.z, lit.green.z, lit.blue.z));
    add_light(x + 3u, y, end, vec3<f32>(lit.red.w, lit.green.w, lit.blue.w));
}

fn no_light() -> Lit {
    return Lit(vec4<f32>(0.0f), vec4<f32>(0.0f), vec4<f32>(0.0f));
}

fn open_at(x: u32, y: u32, end: vec2<u32>, front: u32) -> f32 {
    return open_share(surface_nearness[min(y, end.y - 1u) * frame.width + min(x, end.x - 1u)], front);
}

// The sum with the light of a particle on the four pixels from column `x` of line `y` on.
fn with_four(sum: Lit, fan: Fan, x: u32, y: u32, end: vec2<u32>) -> Lit {
    let columns = f32_of_u32(x) + 0.5f + vec4<f32>(0.0f, 1.0f, 2.0f, 3.0f);
    let down = f32_of_u32(y) + 0.5f - fan.place.y;
    if SURFACES {
        let more = with_fan(no_light(), fan, columns, down, SKEWS, INNERS);
        let open = vec4<f32>(
            open_at(x, y, end, fan.front), open_at(x + 1u, y, end, fan.front),
            open_at(x + 2u, y, end, fan.front), open_at(x + 3u, y, end, fan.front),
        );
        return Lit(sum.red + more.red * open, sum.green + more.green * open, sum.blue + more.blue * open);
    }
    return with_fan(sum, fan, columns, down, SKEWS, INNERS);
}

fn fan_at(at: u32, inner: vec2<f32>) -> Fan {
    let disc = flame_discs[at];
    var skew = vec4<f32>(0.0f);
    if SKEWS {
        skew = bitcast<vec4<f32>>(flame_skews[at]);
    }
    let place = bitcast<vec4<f32>>(disc.place);
    var front = 0u;
    if SURFACES {
        let world = bitcast<vec3<f32>>(flame_steps[at].xyz);
        let row = frame.view_from_world_z;
        let depth = row.x * world.x + row.y * world.y + row.z * world.z + row.w;
        front = front_of(frame, depth, reciprocal(abs(place.z) + abs(skew.x)));
    }
    return Fan(place, skew, inner, bitcast<vec4<f32>>(disc.center), bitcast<vec4<f32>>(disc.rim), front);
}

// What a flame adds to a run of pixels from column `x` of line `y` on.
fn glow_run(flame: u32, inner: vec2<f32>, x: u32, y: u32, end: vec2<u32>) {
    var near = no_light();
    var far = no_light();
    let line = f32_of_u32(y) + 0.5f;
    for (var age = 0u; age < FLAME_STEPS; age += 1u) {
        let at = flame * FLAME_STEPS + age;
        let place = bitcast<vec2<f32>>(flame_discs[at].place.yw);
        if SKEWS || less(abs((line - place.x) * place.y), 1.0f) {
            let fan = fan_at(at, inner);
            near = with_four(near, fan, x, y, end);
            far = with_four(far, fan, x + 4u, y, end);
        }
    }
    add_four(x, y, end, near);
    add_four(x + 4u, y, end, far);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn glow_small(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let index = linear_index(global_id, WORKGROUP_SIZE);
    let flame = index / SMALL_SHARES;
    if flame >= work.flame_count {
        return;
    }
    let bounds = flame_bounds[flame];
    let first = bounds.xy & vec2<u32>(0xffffu);
    let end = bounds.xy >> vec2<u32>(16u);
    if !is_small(end - first) {
        return;
    }
    let inner = bitcast<vec2<f32>>(bounds.zw);
    let runs_across = (end.x - first.x + SMALL_RUN - 1u) / SMALL_RUN;
    let runs = runs_across * (end.y - first.y);
    for (var run = index % SMALL_SHARES; run < runs; run += SMALL_SHARES) {
        let x = first.x + (run % runs_across) * SMALL_RUN;
        glow_run(flame, inner, x, first.y + run / runs_across, end);
    }
}
