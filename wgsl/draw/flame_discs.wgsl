// flame_discs: the particles along a flame as they are seen, and which pixels they touch.
//
// Perry 1994, 3.2.1 and 3.2.2: each of the 25 steps is a particle that faces the viewer, scaled in x
// and y by its age. Its colour is that of its age, or of one that noise moves (4.2, after Perlin's
// corona). One invocation a flame.
// Reads: frame, fires, age_looks, flames, flame_steps, layer_planes. Writes: flame_discs, flame_skews,
// flame_bounds (first column, and one past the last in the upper 16 bits; the same of lines; x and y of FireFrame.inner
// as bits; columns and lines are 0 for none).
// Invariant: what is not drawn has no light.

#import motes::detail::{octave_opacity, scale_of, strayed}
#import motes::fan::LEAST_HALF_AXIS_PX
#import motes::dispatch::linear_index
#import motes::exact::{
    bits_of, clamp_exact, dot3, f32_of_u32, less, max_exact, reciprocal, to_i32, to_u32,
}
#import motes::layout::{AgeLook, FIRE_STRIP, FLAME_STEPS, FireFrame, Flame, FlameDisc, Frame}
#import motes::noise::noise
#import motes::projection::project
#import motes::sprite::next_layer

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};
// Half-axes in pixels, at most.
const MOST_HALF_AXIS_PX: f32 = 16384.0f;

// Whether some flames have details.
const DETAILS: bool = #{DETAILS};
// Whether some particles have a matrix.
const SKEWS: bool = #{SKEWS};
// Whether noise moves the colours of some flames.
const COLOR_NOISES: bool = #{COLOR_NOISES};
// Tells the noise of matrices from the one that bends flames.
const MATRIX_TAG: u32 = 0x6d617472u;
// Particles whose matrix shrinks areas more than to this are not drawn.
const LEAST_MATRIX_AREA: f32 = 0.000001f;
// Nor are those of which any place is divided by less than this, of 1.
const LEAST_MATRIX_DIVISOR: f32 = 0.0625f;

struct Work {
    // Flames of a page, and the first of them among all.
    flame_count: u32,
    first: u32,
    // Of details, 1 and more; of them, one of 2^octave.
    octave: u32,
    copy: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> age_looks: array<AgeLook>;
@group(0) @binding(3) var<storage, read> flames: array<Flame>;
@group(0) @binding(4) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> flame_discs: array<FlameDisc>;
@group(0) @binding(7) var<storage, read_write> flame_bounds: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read_write> flame_skews: array<vec4<u32>>;

// The layer, from 1, that a world place is in. No branch and no loop asks uniforms alone, see
// motes::sprite::next_layer.
fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; (at < frame.layer_plane_count) & (layer == 0u); at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

fn bits_of_four(v: vec4<f32>) -> vec4<u32> {
    return vec4<u32>(bits_of(v.x), bits_of(v.y), bits_of(v.z), bits_of(v.w));
}

// A half-axis that is drawn, and how much fainter it is for that.
fn half_axis(pixels: f32) -> vec2<f32> {
    let drawn = max_exact(pixels, LEAST_HALF_AXIS_PX);
    return vec2<f32>(drawn, pixels * reciprocal(drawn));
}

// The colours of a fire at an age between two: center and rim.
struct Colors {
    center: vec4<f32>,
    rim: vec4<f32>,
}

// The colours of a particle at that age and place.
fn colors_of(fire: FireFrame, slot: u32, age: f32, p: vec3<f32>) -> Colors {
    var moved = age;
    if COLOR_NOISES {
        moved += noise(p * fire.look.z + fire.noise.xyz, fire.kinds.z).w * fire.look.y;
    }
    let last = f32_of_u32(FLAME_STEPS - 1u);
    let index = clamp_exact(moved, 0.0f, last);
    let low = min(to_u32(index), FLAME_STEPS - 2u);
    let part = index - f32_of_u32(low);
    let here = age_looks[slot * FLAME_STEPS + low];
    let next = age_looks[slot * FLAME_STEPS + low + 1u];
    return Colors(
        here.center + (next.center - here.center) * part,
        here.rim + (next.rim - here.rim) * part,
    );
}

// What the matrix of a particle at `p` makes of x, of y and of the centre.
struct Matrix {
    x: vec4<f32>,
    y: vec4<f32>,
    center: vec4<f32>,
}

fn matrix_of(fire: FireFrame, p: vec3<f32>) -> Matrix {
    let x = fire.matrix_x;
    let y = fire.matrix_y;
    let n = noise(p * fire.look.z + fire.noise.xyz, fire.kinds.z ^ MATRIX_TAG) * fire.strip.w;
    return Matrix(x + (x * n.x + y * n.z), y + (x * n.y + y * n.w), fire.matrix_center);
}

// A polygon with these half-axes, as its matrix has it: how far from its place its centre is seen, half of
// its extent across and along the picture, what leads from places back into it, and how what it is divided
// by there grows.
struct Outline {
    center: vec2<f32>,
    reach: vec2<f32>,
    scale: vec2<f32>,
    skew: vec2<f32>,
    tilt: vec2<f32>,
    is_flat: bool,
}

// Places are in pixels from that of the particle, y up; the half-width is a flame's in so many, of which
// the half-axes are `scale`.
fn outline_of(fire: FireFrame, p: vec3<f32>, across: f32, along: f32, scale: vec2<f32>, half_width: f32) -> Outline {
    if !SKEWS {
        let into = vec2<f32>(reciprocal(across), reciprocal(along));
        let none = vec2<f32>(0.0f);
        return Outline(none, vec2<f32>(across, along), into, none, none, false);
    }
    let m = matrix_of(fire, p);
    // What is nearer the viewer is larger. All is divided by what the centre is divided by.
    let nearer = reciprocal(frame.focal_px);
    let far = m.center.w - m.center.z * half_width * nearer;
    let is_behind = less(far, LEAST_MATRIX_DIVISOR);
    let share = reciprocal(select(far, 1.0f, is_behind));
    let x = m.x.xy * share;
    let y = m.y.xy * share;
    let divisor = vec2<f32>(
        (m.x.w * scale.x * reciprocal(across) - m.x.z * nearer) * share,
        (m.y.w * scale.y * reciprocal(along) - m.y.z * nearer) * share,
    );
    let center = m.center.xy * half_width * share;
    // The least that any corner is divided by, of 1 at the centre.
    let least = 1.0f - (abs(divisor.x) * across + abs(divisor.y) * along);
    let x_there = x - center * divisor.x;
    let y_there = y - center * divisor.y;
    let area = x_there.x * y_there.y - y_there.x * x_there.y;
    let is_flat = is_behind || less(abs(area), LEAST_MATRIX_AREA) || less(least, LEAST_MATRIX_DIVISOR);
    let inverse = reciprocal(select(area, 1.0f, is_flat));
    let to_across = inverse * reciprocal(across);
    let to_along = inverse * reciprocal(along);
    let stretch = reciprocal(select(least, 1.0f, is_flat));
    return Outline(
        vec2<f32>(center.x, 0.0f - center.y),
        vec2<f32>(
            (abs(x_there.x) * across + abs(y_there.x) * along) * stretch,
            (abs(x_there.y) * across + abs(y_there.y) * along) * stretch,
        ),
        vec2<f32>(y_there.y * to_across, x_there.x * to_along),
        // y is up in the matrix, and down in the picture.
        vec2<f32>(y_there.x * to_across, x_there.y * to_along),
        vec2<f32>(
            (x.y * divisor.y - y.y * divisor.x) * inverse, (x.x * divisor.y - y.x * divisor.x) * inverse,
        ),
        is_flat,
    );
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn flame_discs_of(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= work.flame_count {
        return;
    }
    let flame = flames[work.first + at];
    let slot = flame.root_and_fire.w;
    let fire = fires[slot];
    let half_width = 0.5f * bitcast<f32>(flame.look.y);
    let is_detail = DETAILS && work.octave > 0u;
    let scale = select(1.0f, scale_of(work.octave), is_detail);
    let brightness = bitcast<f32>(flame.look.z);
    let here = !LAYERS || ((frame.layer == 0u)
        | (layer_of(bitcast<vec3<f32>>(flame.root_and_fire.xyz)) == frame.layer));
    let burns = here && flame.look.w == 1u && (fire.kinds.w & FIRE_STRIP) == 0u;
    let size = vec2<i32>(i32(frame.width), i32(frame.height));
    var low = size;
    var high = vec2<i32>(0, 0);
    for (var age = 0u; age < FLAME_STEPS; age += 1u) {
        let look = age_looks[slot * FLAME_STEPS + age];
        let step = flame_steps[at * FLAME_STEPS + age];
        var place = bitcast<vec3<f32>>(step.xyz);
        var own_age = f32_of_u32(age);
        var is_there = burns;
        if is_detail {
            let part = (f32_of_u32(work.copy) + 0.5f) * scale;
            let next = flame_steps[at * FLAME_STEPS + min(age + 1u, FLAME_STEPS - 1u)];
            own_age += part;
            let between = place + (bitcast<vec3<f32>>(next.xyz) - place) * part;
            place = strayed(fire, work.octave, between, own_age, 2.0f * half_width);
            is_there = burns && age + 1u < FLAME_STEPS && !less(fire.details.x, f32_of_u32(work.octave));
        }
        let seen = project(frame, place);
        let colors = colors_of(fire, slot, own_age, place);
        let across = half_axis(half_width * scale * look.scale.x * seen.scale);
        let along = half_axis(half_width * scale * look.scale.y * seen.scale);
        let outline = outline_of(
            fire, place, across.x, along.x, look.scale.xy, half_width * scale * seen.scale,
        );
        let reach = outline.reach;
        let middle = vec2<f32>(seen.x, seen.y) + outline.center;
        let is_near = less(MOST_HALF_AXIS_PX, reach.x) || less(MOST_HALF_AXIS_PX, reach.y);
        var of_octave = 1.0f;
        if DETAILS {
            of_octave = octave_opacity(fire, work.octave, half_width * seen.scale);
        }
        let is_clear = is_detail && !less(0.0f, of_octave);
        let is_seen = is_there && !is_near && !is_clear && !outline.is_flat && !less(seen.depth, frame.near);
        let opacity = select(0.0f, brightness * of_octave * across.y * along.y, is_seen);
        flame_discs[at * FLAME_STEPS + age] = FlameDisc(
            vec4<u32>(
                bits_of(middle.x), bits_of(middle.y), bits_of(outline.scale.x), bits_of(outline.scale.y),
            ),
            bits_of_four(vec4<f32>(colors.center.xyz, colors.center.w * opacity)),
            bits_of_four(vec4<f32>(colors.rim.xyz, colors.rim.w * opacity)),
        );
        if SKEWS {
            flame_skews[at * FLAME_STEPS + age] = vec4<u32>(
                bits_of(outline.skew.x), bits_of(outline.skew.y), bits_of(outline.tilt.x), bits_of(outline.tilt.y),
            );
        }
        if is_seen {
            let first = vec2<i32>(to_i32(middle.x - reach.x), to_i32(middle.y - reach.y));
            let last = vec2<i32>(to_i32(middle.x + reach.x) + 1, to_i32(middle.y + reach.y) + 1);
            low = min(low, first);
            high = max(high, last);
        }
    }
    low = max(low, vec2<i32>(0, 0));
    high = min(high, size);
    let is_some = low.x < high.x && low.y < high.y;
    let bounds = vec2<u32>(low) | (vec2<u32>(high) << vec2<u32>(16u));
    flame_bounds[at] = vec4<u32>(
        select(vec2<u32>(0u), bounds, is_some), bits_of(fire.inner.x), bits_of(fire.inner.y),
    );
}
