//! The wind field, u = -k_g g + w_L + w_S (Perry 1994, 3.2.3). Twin of `wgsl/lib/wind.wgsl`.

use glam::Vec3;

use crate::cpu::lanes::{LANES, VecLanes, lane_of, set_lane};
use crate::exact::{cross3, dot3, inverse_square_root, less, shared_constants};
use crate::layout::{WIND_ATTRACTOR, WIND_CURL, WIND_NOISE, WIND_SOURCE, WIND_VORTEX, Wind};
use crate::noise::gradient_and_value;

shared_constants! {
    const CURL_KEY: u32 = 0x9e37_79b9;
    const OCTAVE_KEY: u32 = 0x85eb_ca6b;
}

/// The gradient of `octaves` octaves of noise at the world place `p`.
#[inline]
fn turbulence(wind: &Wind, p: Vec3, octaves: u32, first_key: u32) -> Vec3 {
    let mut at = Vec3::new(
        p.x * wind.scale[0] + wind.offset[0],
        p.y * wind.scale[1] + wind.offset[1],
        p.z * wind.scale[2] + wind.offset[2],
    );
    let mut key = first_key;
    let mut weight = 1.0f32;
    let mut sum = Vec3::ZERO;
    for _ in 0..octaves {
        let (gradient, value) = gradient_and_value(at, key);
        let folded = wind.kinds[3] == 1 && less(value, 0.0);
        sum += gradient * if folded { -weight } else { weight };
        at *= 2.0;
        weight *= wind.scale[3];
        key = key.wrapping_add(OCTAVE_KEY);
    }
    sum
}

/// What one part adds to the wind at the world place `p`, units a frame.
#[inline]
pub fn wind_of(wind: &Wind, p: Vec3) -> Vec3 {
    let aim = Vec3::from_slice(&wind.aim);
    let [kind, octaves, key, _] = wind.kinds;
    let radius = wind.place[3];
    let strength = wind.aim[3];
    let away = p - Vec3::from_slice(&wind.place);
    match kind {
        WIND_VORTEX => {
            let around = cross3(aim, away);
            let inverse_swirl = inverse_square_root(dot3(around, around) + radius * radius);
            around * (2.0 * radius * strength * inverse_swirl * inverse_swirl)
        }
        WIND_SOURCE | WIND_ATTRACTOR => {
            let inverse_distance = inverse_square_root(dot3(away, away) + radius * radius);
            if kind == WIND_SOURCE {
                away * (strength * inverse_distance * inverse_distance * inverse_distance)
            } else {
                away * (-strength * inverse_distance)
            }
        }
        WIND_NOISE => turbulence(wind, p, octaves, key) * strength,
        WIND_CURL => {
            let first = turbulence(wind, p, octaves, key);
            let second = turbulence(wind, p, octaves, key ^ CURL_KEY);
            let curl = cross3(first, second);
            let [x, y, z, _] = wind.place;
            Vec3::new(curl.x * x, curl.y * y, curl.z * z) * strength
        }
        _ => aim,
    }
}

/// The wind at the world place `p`: the sum of its parts, in their order.
#[inline]
pub fn wind_at(winds: &[Wind], p: Vec3) -> Vec3 {
    winds
        .iter()
        .fold(Vec3::ZERO, |flow, wind| flow + wind_of(wind, p))
}

/// [`turbulence`] at several places.
fn turbulence_at_lanes(wind: &Wind, places: &VecLanes, octaves: u32, first_key: u32) -> VecLanes {
    let mut at = *places;
    for (axis, at) in at.iter_mut().enumerate() {
        for at in at {
            *at = *at * wind.scale[axis] + wind.offset[axis];
        }
    }
    let mut key = first_key;
    let mut weight = 1.0f32;
    let mut sum = VecLanes::default();
    let folds = wind.kinds[3] == 1;
    for _ in 0..octaves {
        let mut slope = VecLanes::default();
        let mut values = [0.0; LANES];
        for (lane, own) in values.iter_mut().enumerate() {
            let (gradient, value) = gradient_and_value(lane_of(&at, lane), key);
            set_lane(&mut slope, lane, gradient);
            *own = value;
        }
        for (axis, sum) in sum.iter_mut().enumerate() {
            for (lane, sum) in sum.iter_mut().enumerate() {
                let folded = folds & less(values[lane], 0.0);
                *sum += slope[axis][lane] * if folded { -weight } else { weight };
                at[axis][lane] *= 2.0;
            }
        }
        weight *= wind.scale[3];
        key = key.wrapping_add(OCTAVE_KEY);
    }
    sum
}

/// [`wind_at`] at several places.
pub(crate) fn wind_at_lanes(winds: &[Wind], places: &VecLanes) -> VecLanes {
    let mut flow = VecLanes::default();
    for wind in winds {
        let [kind, octaves, key, _] = wind.kinds;
        let strength = wind.aim[3];
        let part = if kind == WIND_NOISE {
            let mut part = turbulence_at_lanes(wind, places, octaves, key);
            part.as_flattened_mut()
                .iter_mut()
                .for_each(|x| *x *= strength);
            part
        } else {
            let mut part = VecLanes::default();
            for lane in 0..LANES {
                set_lane(&mut part, lane, wind_of(wind, lane_of(places, lane)));
            }
            part
        };
        for (flow, part) in flow.as_flattened_mut().iter_mut().zip(part.as_flattened()) {
            *flow += part;
        }
    }
    flow
}
