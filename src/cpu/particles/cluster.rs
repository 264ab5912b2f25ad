//! cluster: the point lights that stand for particles (Reeves 1983, section 3). Twin of
//! `wgsl/particles/span.wgsl`, `wgsl/particles/shed.wgsl` and `wgsl/particles/cluster.wgsl`.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use crate::cpu::cluster::{Span, WIDENING, brightest, corner_for, ordered, sent_by, span_of};
use crate::cpu::particle::{Identity, appearance_of, identity_of, row_index};
use crate::cpu::projection::world_of;
use crate::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, f32_of_u32, reciprocal, shared_constants, to_u32,
};
use crate::layout::{
    CLUSTER_LIGHTS, CLUSTERS_ACROSS, FlameLight, LIGHT_WEIGHT_STEPS, Particle, SystemRow,
};
use crate::plan::FrameInputs;

shared_constants! {
    /// 1 / 3.
    const OF_THREE: f32 = 0.333_333_34;
}

/// What is gathered in a frame.
#[derive(Clone, Debug, Default)]
pub struct Clusters {
    /// The greatest of x, y and z as ordered words, of their complements, of what is sent, as bits; one
    /// unused.
    pub span: [u32; 8],
    /// Two limbs each: red, green, blue, their mean, how far from its corner that comes from along x,
    /// y and z, and the squared distance; of each corner.
    pub sums: Vec<u32>,
    /// How many there are, in `place[0]` of the first; then those; then dark ones.
    pub lights: Vec<FlameLight>,
}

/// Who a particle is, where it is and what it sends out, if it throws light on surfaces.
fn source(
    particle: &Particle,
    inputs: &FrameInputs,
    rows: &[SystemRow],
) -> Option<(Identity, Vec3, Vec3)> {
    let (who, age) = identity_of(particle, inputs);
    let row = &rows[row_index(particle.slot(), who.birth_frame, inputs.frame.row_mask)];
    let sent = sent_by(appearance_of(who, row, age + 1), row);
    if bits_of(brightest(sent)) == 0 {
        return None;
    }
    let system = &inputs.systems[particle.slot() as usize];
    Some((who, world_of(system, Vec3::from(particle.position())), sent))
}

/// The cube around all particles that throw light.
pub fn span(particles: &[Particle], inputs: &FrameInputs, rows: &[SystemRow]) -> [u32; 8] {
    let greatest = |mut a: [u32; 8], b: [u32; 8]| {
        for (a, b) in a.iter_mut().zip(b) {
            *a = b.max(*a);
        }
        a
    };
    let of_one = |particle| {
        source(particle, inputs, rows).map_or([0; 8], |(_, place, sent)| {
            let [x, y, z] = place.to_array().map(|part| ordered(bits_of(part)));
            [x, y, z, !x, !y, !z, bits_of(brightest(sent)), 0]
        })
    };
    let words = particles.par_iter().with_min_len(1024).map(of_one);
    words.reduce(|| [0; 8], greatest)
}

/// What corners get, each in two limbs.
pub fn shed(
    particles: &[Particle],
    inputs: &FrameInputs,
    rows: &[SystemRow],
    span: [u32; 8],
) -> Vec<u32> {
    let cube = span_of(span);
    let share = reciprocal(cube.most);
    let sums: Vec<AtomicU64> = (0..8 * CLUSTER_LIGHTS).map(|_| AtomicU64::new(0)).collect();
    let particles = particles.par_iter().with_min_len(1024);
    particles.for_each(|particle| {
        let Some((who, place, sent)) = source(particle, inputs, rows) else {
            return;
        };
        let cells = (place - cube.corner) * cube.scale;
        let corner = corner_for(who, cells);
        let away = cells - Vec3::from(corner.to_array().map(f32_of_u32));
        let [red, green, blue] = sent
            .to_array()
            .map(|part| clamp_unit(part * share) * LIGHT_WEIGHT_STEPS);
        let weight = (red + green + blue) * OF_THREE;
        let [x, y, z] = away
            .to_array()
            .map(|part| clamp_unit(part * 0.5 + 0.5) * weight);
        let squared = clamp_unit(dot3(away, away) * OF_THREE) * weight;
        let at = (corner.z * CLUSTERS_ACROSS + corner.y) * CLUSTERS_ACROSS + corner.x;
        let own = &sums[8 * at as usize..];
        for (sum, steps) in own.iter().zip([red, green, blue, weight, x, y, z, squared]) {
            sum.fetch_add(to_u32(steps).into(), Ordering::Relaxed);
        }
    });
    let sums = sums.into_iter().map(AtomicU64::into_inner);
    sums.flat_map(|sum| [sum as u32, (sum >> 32) as u32])
        .collect()
}

/// A sum in whole weights: two limbs, in steps of 2^-30.
fn weight_of([low, high]: [u32; 2]) -> f32 {
    let high = f32_of_u32(high) * 4.0;
    high + (f32_of_u32(low >> 8) * 2.384_185_8e-7 + f32_of_u32(low & 0xff) * 9.313_226e-10)
}

fn light_at(corner: u32, sums: &[[u32; 2]; 8], cube: Span) -> FlameLight {
    let [red, green, blue, weight, x, y, z, squared] = sums.map(weight_of);
    let share = reciprocal(weight);
    let away = Vec3::new(x, y, z) * share * 2.0 - 1.0;
    let squared = squared * share * 3.0;
    let spread = at_least_zero(squared - dot3(away, away)) * WIDENING * cube.width * cube.width;
    let cell = Vec3::new(
        f32_of_u32(corner % CLUSTERS_ACROSS),
        f32_of_u32(corner / CLUSTERS_ACROSS % CLUSTERS_ACROSS),
        f32_of_u32(corner / (CLUSTERS_ACROSS * CLUSTERS_ACROSS)),
    );
    let place = cube.corner + (cell + away) * cube.width;
    let color = Vec3::new(red, green, blue) * cube.most;
    let with = |v: Vec3, w: f32| [v.x, v.y, v.z, w].map(bits_of);
    FlameLight {
        place: with(place, spread),
        color: with(color, 0.0),
    }
}

/// The lights, those of corners that get none left out.
pub fn cluster(span: [u32; 8], sums: &[u32]) -> Vec<FlameLight> {
    let cube = span_of(span);
    let (limbs, _) = sums.as_chunks::<2>();
    let (corners, _) = limbs.as_chunks::<8>();
    let lit = (0..).zip(corners).filter(|(_, sums)| sums[3] != [0; 2]);
    let mut lights = vec![FlameLight::default()];
    lights.extend(lit.map(|(corner, sums)| light_at(corner, sums, cube)));
    lights[0].place[0] = lights.len() as u32 - 1;
    lights.resize(1 + CLUSTER_LIGHTS as usize, FlameLight::default());
    lights
}
