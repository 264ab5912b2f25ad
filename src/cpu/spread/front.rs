//! front: how far a control point goes in a frame, and which way (Perry 1994, 3.3.1, equation 3.4).
//! Twin of `wgsl/spread/front.wgsl`.

use glam::{Vec2, Vec3};

use super::walk::vec2;
use crate::cpu::emission::turned;
use crate::cpu::grain::grain_at;
use crate::cpu::walk::{dot2, flattened, normalized2};
use crate::cpu::wind;
use crate::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, inverse_square_root, less, max_exact,
    shared_constants, square_root,
};
use crate::layout::{
    FireFrame, POINT_MOVES, SPREAD_FLAT, SPREAD_LITERAL, SPREAD_NORMAL, SPREAD_SPILL, SPREAD_STAIN,
    SpreadFace, SpreadFeature, SpreadFrame, SpreadPoint, Walker,
};
use crate::plan::{FrameInputs, SpreadTables};

shared_constants! {
    const FLAT_ANGLE: f32 = std::f32::consts::PI;
    const LEAST_ANGLE: f32 = 0.15707964;
    const LEAST_WIND_SQUARED: f32 = 1e-12;
    const LEAST_DRIFT: f32 = 0.001;
}

fn exposed(
    spread: &SpreadFrame,
    face: &SpreadFace,
    features: &[SpreadFeature],
    place: Vec2,
) -> f32 {
    let flags = spread.kinds[1];
    let is_literal = flags & SPREAD_LITERAL != 0;
    let mut angle = if is_literal { 0.0 } else { FLAT_ANGLE };
    if flags & SPREAD_FLAT != 0 {
        return angle;
    }
    let [first, count, ..] = face.features.map(|word| word as usize);
    for feature in &features[first..first + count] {
        let [x, y, along_x, along_y] = feature.line;
        let [dihedral, inverse_square, ..] = feature.bend;
        let along = Vec2::new(along_x, along_y);
        let from = place - Vec2::new(x, y);
        let share = clamp_unit(dot2(from, along) * inverse_square);
        let away = from - along * share;
        let ramp = at_least_zero(1.0 - square_root(dot2(away, away)) * spread.rates[3]);
        angle += dihedral * ramp;
    }
    if is_literal {
        angle
    } else {
        max_exact(angle, LEAST_ANGLE)
    }
}

fn wind_at(inputs: &FrameInputs, fire: &FireFrame, position: Vec3) -> Vec3 {
    let now = [
        fire.world_from_fire_x,
        fire.world_from_fire_y,
        fire.world_from_fire_z,
    ];
    let earlier = [
        fire.earlier_world_from_fire_x,
        fire.earlier_world_from_fire_y,
        fire.earlier_world_from_fire_z,
    ];
    let placed = |rows: [[f32; 4]; 3]| turned(rows, position) + Vec3::from(rows.map(|row| row[3]));
    let place = placed(now);
    let flow = wind::wind_at(&inputs.winds, place) - (place - placed(earlier));
    Vec3::from_slice(&fire.rise) * fire.rise[3] + flow * fire.motion[1]
}

fn downhill(fire: &FireFrame, face: &SpreadFace, heading: Vec2) -> f32 {
    let [x, y, z, _] = fire.rise;
    let in_fire = Vec3::from_slice(&fire.world_from_fire_x) * x
        + Vec3::from_slice(&fire.world_from_fire_y) * y
        + Vec3::from_slice(&fire.world_from_fire_z) * z;
    at_least_zero(-dot2(heading, flattened(face, in_fire)))
}

fn normal_at(at: u32, points: &[SpreadPoint], [first, last]: [u32; 2], face: &SpreadFace) -> Vec2 {
    let before = if at == first { last } else { at - 1 };
    let after = if at == last { first } else { at + 1 };
    let [before, here, after] =
        [before, at, after].map(|at| Vec3::from(points[at as usize].position()));
    let arrives = normalized2(flattened(face, here - before));
    let along = normalized2(arrives + normalized2(flattened(face, after - here)));
    Vec2::new(along.y, -along.x)
}

/// What the point `at` is to walk.
pub fn front(
    inputs: &FrameInputs,
    tables: &SpreadTables,
    points: &[SpreadPoint],
    ring_spans: &[[u32; 2]],
    at: u32,
) -> Walker {
    let point = &points[at as usize];
    let spread = &inputs.spreads[point.position[3] as usize];
    let [x, y, face_at, ring] = point.place;
    let face = &tables.faces[face_at as usize];
    let mut heading = vec2(point.course[0], point.course[1]);
    let mut way = heading;
    let mut step = 0.0;
    if point.course[3] == POINT_MOVES {
        let fire = &inputs.fires[spread.kinds[0] as usize];
        let wind = wind_at(inputs, fire, Vec3::from(point.position()));
        let in_fire = Vec3::from_slice(&fire.world_from_fire_x) * wind.x
            + Vec3::from_slice(&fire.world_from_fire_y) * wind.y
            + Vec3::from_slice(&fire.world_from_fire_z) * wind.z;
        let along = flattened(face, in_fire);
        let squared = dot2(along, along);
        let least = LEAST_WIND_SQUARED * max_exact(dot3(wind, wind), 1.0);
        let inverse = if less(squared, least) {
            0.0
        } else {
            inverse_square_root(squared)
        };
        let downwind = along * inverse;
        let is_normal = spread.kinds[1] & SPREAD_NORMAL != 0;
        if is_normal {
            let normal = normal_at(at, points, ring_spans[ring as usize], face);
            if !less(dot2(normal, normal), 0.5) {
                heading = normal;
            }
        }
        let concurrent = at_least_zero(dot2(heading, downwind));
        let [opposed_flux, concurrent_flux, factor, _] = spread.rates;
        let [opposed_share, concurrent_share, ..] = face.material.map(f32::from_bits);
        let opposed_flux = opposed_flux * opposed_share;
        let concurrent_flux = concurrent_flux * concurrent_share;
        let mut flux = opposed_flux + concurrent_flux * concurrent;
        let is_spill = spread.kinds[1] & SPREAD_SPILL != 0;
        let is_stain = spread.kinds[1] & SPREAD_STAIN != 0;
        if is_spill {
            flux = concurrent_flux * downhill(fire, face, heading);
        }
        way = heading;
        if is_normal && !is_spill && !is_stain {
            let drift = if less(LEAST_DRIFT, concurrent) {
                concurrent_flux
            } else {
                0.0
            };
            let velocity = heading * opposed_flux + downwind * drift;
            flux = square_root(dot2(velocity, velocity));
            way = normalized2(velocity);
        }
        let [_, _, kind, key] = spread.kinds;
        let position = Vec3::from(point.position());
        let dense = grain_at([kind, key], &spread.grain, &spread.grain_shape, position);
        let share = factor * (1.0 - dense * spread.grain_shape[0]);
        if is_stain {
            flux = opposed_flux;
        }
        step = exposed(spread, face, &tables.features, vec2(x, y)) * flux * share;
        if is_stain {
            let far = f32::from_bits(point.path[1]);
            step = square_root(far * far + step * step) - far;
        }
    }
    let [heading_x, heading_y] = [heading.x, heading.y].map(bits_of);
    let [way_x, way_y] = [way.x, way.y].map(bits_of);
    Walker {
        place: [x, y, face_at, point.course[3]],
        way: [way_x, way_y, heading_x, heading_y],
        left: [bits_of(step), bits_of(step), way_x, way_y],
    }
}
