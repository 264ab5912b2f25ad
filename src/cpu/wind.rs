//! The wind field, u = -k_g g + w_L + w_S (Perry 1994, 3.2.3). Twin of `wgsl/lib/wind.wgsl`.

use glam::Vec3;

use crate::exact::{cross3, dot3, inverse_square_root, less, shared_constants};
use crate::layout::{WIND_ATTRACTOR, WIND_CURL, WIND_NOISE, WIND_SOURCE, WIND_VORTEX, Wind};
use crate::noise::noise;

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
        let sample = noise(at, key);
        let folded = wind.kinds[3] == 1 && less(sample.w, 0.0);
        sum += sample.truncate() * if folded { -weight } else { weight };
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
