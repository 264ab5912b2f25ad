//! The wind's parts as kernels take them, at one frame.

use glam::{UVec4, Vec3};

use crate::exact::{normalize_exact, snap};
use crate::layout::{self, Wind};
use crate::noise::{PERIOD, noise};
use crate::rng::pcg4d;
use crate::scene::{self, Scene, Turbulence};
use crate::transcendental::exp2_exact;

/// Marks hashes that make keys of noises.
const NOISE_TAG: u32 = 0x6e6f_6973;

/// The parts of the wind at `frame`; `scene` is the scene as it is then.
pub(super) fn winds_of(scene: &Scene, frame: i32) -> Vec<Wind> {
    let kind = std::mem::discriminant::<scene::Wind>;
    let parts = scene.winds.iter().enumerate();
    parts
        .map(|(at, part)| {
            // Counted among its kind, so that a part keeps its noise when others come before it.
            let before = scene.winds[..at].iter();
            let ordinal = before.filter(|other| kind(other) == kind(part)).count();
            let key = noise_key(scene.seed, ordinal as u32, kind_number(part));
            wind_of(part, key, f64::from(frame))
        })
        .collect()
}

/// The key of the noise of the part at that place among its kind.
fn noise_key(seed: u64, ordinal: u32, kind: u32) -> u32 {
    let [low, high] = [seed as u32, (seed >> 32) as u32];
    pcg4d(UVec4::new(low, high, ordinal, NOISE_TAG ^ kind)).x
}

/// Tells apart the kinds that are made of noise.
fn kind_number(part: &scene::Wind) -> u32 {
    match part {
        scene::Wind::Gusts { .. } => 1,
        scene::Wind::Noise(_) => 2,
        scene::Wind::Curl(_) => 3,
        _ => 0,
    }
}

/// How far a slow random quantity is from its middle at a time, in `frames`: -1 to 1, smooth.
pub(super) fn wander(key: u32, frame: f64, frames: f64) -> f32 {
    let at = (frame / frames) % PERIOD;
    // Off the axis, where the noise would be 0 at its corners.
    let value = noise(Vec3::new(at as f32, 0.37, 0.71), key).w;
    (2.0 * value).clamp(-1.0, 1.0)
}

fn uniform(velocity: [f32; 3]) -> Wind {
    let [x, y, z] = velocity.map(snap);
    Wind {
        kinds: [layout::WIND_UNIFORM, 0, 0, 0],
        aim: [x, y, z, 0.0],
        ..Wind::default()
    }
}

fn with_place(kind: u32, position: [f32; 3], radius: f32, aim: [f32; 3], strength: f32) -> Wind {
    let [px, py, pz] = position;
    let [ax, ay, az] = aim;
    Wind {
        kinds: [kind, 0, 0, 0],
        place: [px, py, pz, radius].map(snap),
        aim: [ax, ay, az, strength].map(snap),
        ..Wind::default()
    }
}

fn turbulence(kind: u32, noise: &Turbulence, key: u32, frame: f64) -> Wind {
    let [sx, sy, sz] = noise.scale;
    // Where the pattern is, modulo its period: the same bits however long it has moved.
    let offset = noise.drift.map(|drift| {
        let moved = f64::from(drift) * frame;
        snap(-(moved % PERIOD) as f32)
    });
    // The power of octave o is 2^(-o (beta - 1)) of the first's; its gradient is 2^o as steep.
    let factor = exp2_exact(0.5 * (3.0 - noise.spectrum_exponent));
    Wind {
        kinds: [kind, noise.octaves, key, u32::from(noise.absolute)],
        aim: [0.0, 0.0, 0.0, snap(noise.strength)],
        scale: [sx, sy, sz, factor].map(snap),
        offset: [offset[0], offset[1], offset[2], 0.0],
        ..Wind::default()
    }
}

/// What makes the root mean square of the product of two gradients that of one, as measured.
const CURL_GAIN: f64 = 1.1982;

/// The weights of a curl's axes. With respect to the world, the gradients are longer by the scales
/// along each axis, and so is their product by those along the other two: only as much as that
/// does it neither begin nor end anywhere.
fn curl_weights([x, y, z]: [f32; 3]) -> [f32; 4] {
    let [x, y, z] = [x, y, z].map(f64::from);
    let products = [y * z, z * x, x * y];
    let mean_square = products.iter().map(|p| p * p).sum::<f64>() / 3.0;
    let gain = if mean_square > 0.0 {
        CURL_GAIN / mean_square.sqrt()
    } else {
        0.0
    };
    let [x, y, z] = products.map(|p| snap((p * gain) as f32));
    [x, y, z, 0.0]
}

fn wind_of(part: &scene::Wind, key: u32, frame: f64) -> Wind {
    match *part {
        scene::Wind::Uniform { velocity } => uniform(velocity),
        scene::Wind::Buoyancy { gravity, strength } => uniform(gravity.map(|g| -strength * g)),
        scene::Wind::Gusts {
            velocity,
            amplitude,
            frames,
        } => {
            let factor = 1.0 + amplitude * wander(key, frame, f64::from(frames));
            uniform(velocity.map(|v| v * factor))
        }
        scene::Wind::Vortex {
            position,
            axis,
            speed,
            radius,
        } => {
            let axis = normalize_exact(Vec3::from(axis));
            with_place(layout::WIND_VORTEX, position, radius, axis.into(), speed)
        }
        scene::Wind::Source {
            position,
            strength,
            radius,
        } => with_place(layout::WIND_SOURCE, position, radius, [0.0; 3], strength),
        scene::Wind::Attractor {
            position,
            speed,
            radius,
        } => with_place(layout::WIND_ATTRACTOR, position, radius, [0.0; 3], speed),
        scene::Wind::Noise(ref noise) => turbulence(layout::WIND_NOISE, noise, key, frame),
        scene::Wind::Curl(ref noise) => Wind {
            place: curl_weights(noise.scale),
            ..turbulence(layout::WIND_CURL, noise, key, frame)
        },
    }
}
