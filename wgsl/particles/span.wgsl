// span: the cube around all particles that throw light on surfaces, and the most that one of them sends out.
//
// Reeves 1983, section 3: light from particles. One invocation a particle of one page.
// Reads: frame, system_frames, rows, counts, particles. Writes, by atomic maxima: cluster_span (of x, y and
// z as ordered words and of their complements, then of what is sent, as bits).
// Invariant: a greatest does not depend on the order of particles.

#import motes::cluster::{brightest, ordered, sent_by}
#import motes::dispatch::linear_index
#import motes::exact::bits_of
#import motes::layout::{Counts, Frame, Particle, SystemFrame, SystemRow}
#import motes::particle::{Identity, age_of, appearance_of, row_index, slot_of}
#import motes::projection::world_of

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
const RATE_SPREADS: bool = #{RATE_SPREADS};

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<uniform> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read_write> cluster_span: array<atomic<u32>>;

// Few words are greater than all before them: the others only look.
fn raise(at: u32, word: u32) {
    if atomicLoad(&cluster_span[at]) < word {
        atomicMax(&cluster_span[at], word);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn span(@builtin(global_invocation_id) global_id: vec3<u32>) {
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
    let most = bits_of(brightest(sent_by(appearance_of(who, row, age + 1u, RATE_SPREADS), row)));
    if most == 0u {
        return;
    }
    let place = world_of(system, bitcast<vec3<f32>>(particle.position_and_index.xyz));
    let x = ordered(bits_of(place.x));
    let y = ordered(bits_of(place.y));
    let z = ordered(bits_of(place.z));
    raise(0u, x);
    raise(1u, y);
    raise(2u, z);
    raise(3u, ~x);
    raise(4u, ~y);
    raise(5u, ~z);
    raise(6u, most);
}
