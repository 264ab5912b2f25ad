// cull: who lives on, one bit a particle.
//
// Reeves 1983, 2.4: a particle dies when its lifetime is over, or when its intensity, from colour
// and transparency, falls below its system's threshold. Intensity is that which it would be drawn
// with in this frame, so nothing dimmer than the threshold is ever drawn.
// One invocation a word of 32 particles of one page. Reads: frame, system_frames, rows, counts,
// particles. Writes: alive_bits.
// Invariant: bits at and above counts.total are zero.

#import motes::dispatch::linear_index
#import motes::exact::less
#import motes::layout::{Counts, Frame, Particle, SystemFrame, SystemRow}
#import motes::particle::{
    Identity, age_of, appearance_of, intensity_of, lifetime_of, row_index, slot_of,
}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any system kills by intensity.
const THRESHOLDS: bool = #{THRESHOLDS};

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read_write> alive_bits: array<u32>;

// The system in that slot; a lone one is loaded once for all invocations.
fn system_at(slot: u32) -> SystemFrame {
    if frame.system_count == 1u {
        return system_frames[0];
    }
    return system_frames[slot];
}

// The parameter row there. A lone row is loaded once for all invocations, not once for each.
fn row_at(index: u32) -> SystemRow {
    if frame.system_count == 1u && frame.row_mask == 0u {
        return rows[0];
    }
    return rows[index];
}

fn survives(at: u32) -> bool {
    let index = particles[at].position_and_index.w;
    let birth = particles[at].velocity_and_birth.w;
    let slot = slot_of(birth);
    let age = age_of(birth, frame.frame);
    let birth_frame = frame.frame - age;
    let who = Identity(system_at(slot).key, birth_frame, index);
    let row = row_at(row_index(slot, birth_frame, frame.row_mask));
    if age >= lifetime_of(who, row.speed_and_lifetime) {
        return false;
    }
    let threshold = row.size_and_threshold.w;
    if !THRESHOLDS || less(threshold, 0.0f) {
        return true;
    }
    return !less(intensity_of(appearance_of(who, row, age + 1u)), threshold);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn cull(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = pages.page * frame.page_len;
    let first = linear_index(global_id, WORKGROUP_SIZE) * 32u;
    let page_end = min(counts.total - min(counts.total, page_start), frame.page_len);
    if first >= page_end {
        return;
    }
    let end = min(first + 32u, page_end);
    var bits = 0u;
    for (var at = first; at < end; at += 1u) {
        bits |= select(0u, 1u, survives(at)) << (at - first);
    }
    alive_bits[(page_start + first) / 32u] = bits;
}
