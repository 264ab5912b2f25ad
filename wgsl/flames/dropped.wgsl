// dropped: the flames that control points have dropped, as they are in this frame.
//
// Perry 1994, 3.4: a control point drops a flame on its way, which leaves along the face's outward normal
// and burns as long as it was given then. One invocation a flame that there may be at once, from the
// first that burns on.
// Reads: frame, fires, spread_counts, dropped_flames. Writes: flames.
// Invariant: a flame is a hash of who dropped it; those that nobody has dropped yet do not burn.

#import motes::dispatch::linear_index
#import motes::emission::turned
#import motes::exact::{bits_of, normalize_exact}
#import motes::flame::{burns_at, extents_of, growth_of}
#import motes::layout::{DroppedFlame, FireFrame, Flame, Frame, SpreadCounts}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    // The first of these flames among all, how many there may be at once, and the places for them.
    first: u32,
    count: u32,
    places: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(3) var<storage, read> dropped_flames: array<DroppedFlame>;
@group(0) @binding(4) var<storage, read_write> flames: array<Flame>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn dropped(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= work.count {
        return;
    }
    let number = spread_counts.flames_first + at;
    if number >= spread_counts.flames_total {
        flames[work.first + at] = Flame(vec4<u32>(0u), vec4<u32>(0u), vec4<u32>(0u), vec4<u32>(0u));
        return;
    }
    let own = dropped_flames[number % work.places];
    let slot = own.root_and_fire.w;
    var fire = fires[slot];
    fire.times.z = own.identity.z;
    let place = bitcast<vec3<f32>>(own.root_and_fire.xyz);
    let x_row = fire.world_from_fire_x;
    let y_row = fire.world_from_fire_y;
    let z_row = fire.world_from_fire_z;
    let x_before = fire.earlier_world_from_fire_x;
    let y_before = fire.earlier_world_from_fire_y;
    let z_before = fire.earlier_world_from_fire_z;
    let root = turned(x_row, y_row, z_row, place) + vec3<f32>(x_row.w, y_row.w, z_row.w);
    let before = turned(x_before, y_before, z_before, place)
        + vec3<f32>(x_before.w, y_before.w, z_before.w);
    let motion = root - before;
    let outward = bitcast<vec3<f32>>(own.normal_and_birth.xyz);
    let normal = normalize_exact(turned(x_row, y_row, z_row, outward));
    let birth = own.normal_and_birth.w;
    let age = bitcast<i32>(frame.frame - birth);
    let burns = burns_at(fire, age);
    let growth = growth_of(fire, select(0, age, burns));
    let key = own.identity.x;
    let extents = extents_of(fire, key);
    flames[work.first + at] = Flame(
        vec4<u32>(bits_of(root.x), bits_of(root.y), bits_of(root.z), slot),
        vec4<u32>(bits_of(normal.x), bits_of(normal.y), bits_of(normal.z), birth),
        vec4<u32>(bits_of(motion.x), bits_of(motion.y), bits_of(motion.z), key),
        vec4<u32>(
            bits_of(extents.x * growth),
            bits_of(extents.y * growth),
            bits_of(fire.look.x),
            select(0u, 1u, burns),
        ),
    );
}
