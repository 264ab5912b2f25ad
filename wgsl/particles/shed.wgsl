// shed: particles give their light to the corners of cells around them.
//
// Reeves 1983, section 3: light from particles. What a corner gets is added up in whole steps: red, green
// and blue, then, weighted by their mean, how far from the corner it comes from along x, y and z, and the
// squared distance. One invocation a particle of one page.
// Reads: frame, system_frames, rows, counts, particles, cluster_span. Writes, by atomic adds: cluster_sums (two
// limbs of each).
// Invariant: sums do not depend on the order of particles.

#import motes::cluster::{brightest, corner_for, sent_by, span_of}
#import motes::dispatch::linear_index
#import motes::exact::{bits_of, clamp_unit, dot3, f32_of_u32, reciprocal, to_u32}
#import motes::layout::{CLUSTERS_ACROSS, Counts, Frame, LIGHT_WEIGHT_STEPS, Particle, SystemFrame, SystemRow}
#import motes::particle::{Identity, age_of, appearance_of, row_index, slot_of}
#import motes::projection::world_of

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
const RATE_SPREADS: bool = #{RATE_SPREADS};
// 1 / 3.
const OF_THREE: f32 = 0.33333334f;

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<uniform> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read> cluster_span: array<u32>;
@group(0) @binding(6) var<storage, read_write> cluster_sums: array<atomic<u32>>;

fn add_to_limbs(at: u32, steps: u32) {
    let before = atomicAdd(&cluster_sums[at], steps);
    if before > 0xffffffffu - steps {
        atomicAdd(&cluster_sums[at + 1u], 1u);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn shed(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = pages.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let age = age_of(birth, frame.frame);
    let row = rows[row_index(slot, frame.frame - age, frame.row_mask)];
    let system = system_frames[slot];
    let who = Identity(system.key, frame.frame - age, particle.position_and_index.w);
    let sent = sent_by(appearance_of(who, row, age + 1u, RATE_SPREADS), row);
    if bits_of(brightest(sent)) == 0u {
        return;
    }
    let high = vec3<u32>(cluster_span[0], cluster_span[1], cluster_span[2]);
    let low = vec3<u32>(cluster_span[3], cluster_span[4], cluster_span[5]);
    let cube = span_of(high, low, cluster_span[6]);
    let place = world_of(system, bitcast<vec3<f32>>(particle.position_and_index.xyz));
    let cells = (place - cube.corner) * cube.scale;
    let corner = corner_for(who, cells);
    let away = cells - vec3<f32>(f32_of_u32(corner.x), f32_of_u32(corner.y), f32_of_u32(corner.z));
    let share = reciprocal(cube.most);
    let red = clamp_unit(sent.x * share) * LIGHT_WEIGHT_STEPS;
    let green = clamp_unit(sent.y * share) * LIGHT_WEIGHT_STEPS;
    let blue = clamp_unit(sent.z * share) * LIGHT_WEIGHT_STEPS;
    let weight = (red + green + blue) * OF_THREE;
    let first = ((corner.z * CLUSTERS_ACROSS + corner.y) * CLUSTERS_ACROSS + corner.x) * 16u;
    add_to_limbs(first, to_u32(red));
    add_to_limbs(first + 2u, to_u32(green));
    add_to_limbs(first + 4u, to_u32(blue));
    add_to_limbs(first + 6u, to_u32(weight));
    add_to_limbs(first + 8u, to_u32(clamp_unit(away.x * 0.5f + 0.5f) * weight));
    add_to_limbs(first + 10u, to_u32(clamp_unit(away.y * 0.5f + 0.5f) * weight));
    add_to_limbs(first + 12u, to_u32(clamp_unit(away.z * 0.5f + 0.5f) * weight));
    add_to_limbs(first + 14u, to_u32(clamp_unit(dot3(away, away) * OF_THREE) * weight));
}
