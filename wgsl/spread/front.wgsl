// front: how far each control point goes in this frame, and which way.
//
// Perry 1994, 3.3.1, equation 3.4: v_s = Theta (A_o q_o + A_c q_c) / K, where Theta is the angle of
// exposed air, pi where it is flat, which edges nearer than d_t open or close; A_o is 1, and A_c the
// cosine between the heading and the wind along the face, at least 0. Spills and stains have other laws
// (3.3.3), and grain makes all of them slower (4.4). One invocation a control point.
// Reads: frame, fires, winds, spreads, spread_counts, spread_faces, spread_features, ring_spans,
// control_points. Writes: walkers.
// Invariant: points look at the boundary of the frame before, so their order does not matter.

#import motes::dispatch::linear_index
#import motes::emission::turned
#import motes::exact::{at_least_zero, bits_of, clamp_unit, dot3, inverse_square_root, less, max_exact, reciprocal, square_root}
#import motes::grain::grain_at
#import motes::layout::{
    FireFrame, Frame, POINT_MOVES, SPREAD_FLAT, SPREAD_LITERAL, SPREAD_NORMAL, SPREAD_SPILL,
    SPREAD_STAIN, SpreadCounts, SpreadFace,
    SpreadFeature, SpreadFrame, SpreadPoint, Walker, Wind,
}
#import motes::walk::{dot2, flattened, normalized2}
#import motes::wind::{Kinds, wind_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
const MANY_WINDS: bool = #{MANY_WINDS};
const FLOWS: bool = #{FLOWS};
const NOISES: bool = #{NOISES};
const OCTAVES: bool = #{OCTAVES};
const FOLDS: bool = #{FOLDS};
const CURLS: bool = #{CURLS};
const GRAINS: bool = #{GRAINS};

// The angle of exposed air on a flat face, and the least there is.
const FLAT_ANGLE: f32 = 3.1415927f;
const LEAST_ANGLE: f32 = 0.15707964f;
// The least share of the wind, squared, that has a direction along the face.
const LEAST_WIND_SQUARED: f32 = 1e-12f;
// The least cosine between a front's normal and the wind with which the wind carries its points along.
const LEAST_DRIFT: f32 = 0.001f;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> winds: array<Wind>;
@group(0) @binding(3) var<storage, read> spreads: array<SpreadFrame>;
@group(0) @binding(4) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(5) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(6) var<storage, read> spread_features: array<SpreadFeature>;
@group(0) @binding(7) var<storage, read> ring_spans: array<vec2<u32>>;
@group(0) @binding(8) var<storage, read> control_points: array<SpreadPoint>;
@group(0) @binding(9) var<storage, read_write> walkers: array<Walker>;

// The angle of exposed air.
fn exposed(spread: SpreadFrame, face: SpreadFace, place: vec2<f32>) -> f32 {
    let flags = spread.kinds.y;
    let is_literal = (flags & SPREAD_LITERAL) != 0u;
    var angle = select(FLAT_ANGLE, 0.0f, is_literal);
    if (flags & SPREAD_FLAT) != 0u {
        return angle;
    }
    for (var at = 0u; at < face.features.y; at += 1u) {
        let feature = spread_features[face.features.x + at];
        let origin = place - feature.line.xy;
        let share = clamp_unit(dot2(origin, feature.line.zw) * feature.bend.y);
        let away = origin - feature.line.zw * share;
        let ramp = at_least_zero(1.0f - square_root(dot2(away, away)) * spread.rates.w);
        angle += feature.bend.x * ramp;
    }
    return select(max_exact(angle, LEAST_ANGLE), angle, is_literal);
}

// w_L and what gravity makes of the air, at a point's place in world space.
fn wind_at(fire: FireFrame, position: vec3<f32>) -> vec3<f32> {
    let x_row = fire.world_from_fire_x;
    let y_row = fire.world_from_fire_y;
    let z_row = fire.world_from_fire_z;
    let x_before = fire.earlier_world_from_fire_x;
    let y_before = fire.earlier_world_from_fire_y;
    let z_before = fire.earlier_world_from_fire_z;
    let place = turned(x_row, y_row, z_row, position) + vec3<f32>(x_row.w, y_row.w, z_row.w);
    let before = turned(x_before, y_before, z_before, position)
        + vec3<f32>(x_before.w, y_before.w, z_before.w);
    var flow = vec3<f32>(0.0f);
    let has = Kinds(FLOWS, NOISES, OCTAVES, FOLDS, CURLS);
    if MANY_WINDS {
        for (var at = 0u; at < frame.wind_count; at += 1u) {
            flow += wind_of(winds[at], place, has);
        }
    } else if frame.wind_count == 1u {
        flow = wind_of(winds[0], place, has);
    }
    return fire.rise.xyz * fire.rise.w + (flow - (place - before)) * fire.motion.y;
}

// How steeply a heading leads down, as a sine, at least 0.
fn downhill(fire: FireFrame, face: SpreadFace, heading: vec2<f32>) -> f32 {
    let rise = fire.rise.xyz;
    let in_fire = fire.world_from_fire_x.xyz * rise.x
        + fire.world_from_fire_y.xyz * rise.y
        + fire.world_from_fire_z.xyz * rise.z;
    return at_least_zero(-dot2(heading, flattened(face, in_fire)));
}

// The front's normal, to the right of the mean way to the point from the one before and to the one after;
// 0 where these are in one place.
fn normal_at(at: u32, point: SpreadPoint, face: SpreadFace) -> vec2<f32> {
    let span = ring_spans[point.place.w];
    let before = select(at - 1u, span.y, at == span.x);
    let after = select(at + 1u, span.x, at == span.y);
    let here = bitcast<vec3<f32>>(point.position.xyz);
    let since = here - bitcast<vec3<f32>>(control_points[before].position.xyz);
    let until = bitcast<vec3<f32>>(control_points[after].position.xyz) - here;
    let arrives = normalized2(flattened(face, since));
    let along = normalized2(arrives + normalized2(flattened(face, until)));
    return vec2<f32>(along.y, -along.x);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn front(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total {
        return;
    }
    let point = control_points[at];
    let spread = spreads[point.position.w];
    let face = spread_faces[point.place.z];
    let place = bitcast<vec2<f32>>(point.place.xy);
    var heading = bitcast<vec2<f32>>(point.course.xy);
    var way = heading;
    var step = 0.0f;
    if point.course.w == POINT_MOVES {
        let fire = fires[spread.kinds.x];
        let wind = wind_at(fire, bitcast<vec3<f32>>(point.position.xyz));
        // A rotation's inverse is its transpose.
        let in_fire = fire.world_from_fire_x.xyz * wind.x
            + fire.world_from_fire_y.xyz * wind.y
            + fire.world_from_fire_z.xyz * wind.z;
        let along = flattened(face, in_fire);
        let squared = dot2(along, along);
        let least = LEAST_WIND_SQUARED * max_exact(dot3(wind, wind), 1.0f);
        let inverse = select(inverse_square_root(squared), 0.0f, less(squared, least));
        let downwind = along * inverse;
        let is_normal = (spread.kinds.y & SPREAD_NORMAL) != 0u;
        if is_normal {
            let normal = normal_at(at, point, face);
            heading = select(normal, heading, less(dot2(normal, normal), 0.5f));
        }
        let concurrent = at_least_zero(dot2(heading, downwind));
        let opposed_flux = spread.rates.x * bitcast<f32>(face.material.x);
        let concurrent_flux = spread.rates.y * bitcast<f32>(face.material.y);
        var flux = opposed_flux + concurrent_flux * concurrent;
        if (spread.kinds.y & SPREAD_SPILL) != 0u {
            flux = concurrent_flux * downhill(fire, face, heading);
        }
        way = heading;
        if is_normal && (spread.kinds.y & (SPREAD_SPILL | SPREAD_STAIN)) == 0u {
            // The same front, by points that keep their normals where nothing changes: each drifts along
            // its front, too.
            let drift = select(0.0f, concurrent_flux, less(LEAST_DRIFT, concurrent));
            let velocity = heading * opposed_flux + downwind * drift;
            flux = square_root(dot2(velocity, velocity));
            way = normalized2(velocity);
        }
        let position = bitcast<vec3<f32>>(point.position.xyz);
        var share = spread.rates.z;
        if GRAINS {
            let kind = spread.kinds;
            let dense = grain_at(kind.z, kind.w, spread.grain, spread.grain_shape, position);
            share *= 1.0f - dense * spread.grain_shape.x;
        }
        if (spread.kinds.y & SPREAD_STAIN) != 0u {
            flux = opposed_flux;
        }
        step = exposed(spread, face, place) * flux * share;
        if (spread.kinds.y & SPREAD_STAIN) != 0u {
            // What is soaked up has come as far as the root of the time (Washburn 1921).
            let far = bitcast<f32>(point.path.y);
            step = square_root(far * far + step * step) - far;
        }
    }
    let x = bits_of(way.x);
    let y = bits_of(way.y);
    walkers[at] = Walker(
        vec4<u32>(point.place.xyz, point.course.w),
        vec4<u32>(x, y, bits_of(heading.x), bits_of(heading.y)),
        vec4<u32>(bits_of(step), bits_of(step), x, y),
    );
}
