// The noise of motes::noise, sample by sample, to be measured beside the one that was not taken.
//
// One invocation a sample. Reads: source. Writes: destination.
// Invariant: as much is read and written as by bench/copy, and the same samples are taken as by
// bench/noise_lattice.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, f32_of_u32}
#import motes::layout::Particle
#import motes::noise::noise

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> source: array<Particle>;
@group(0) @binding(1) var<storage, read_write> destination: array<Particle>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn noise_simplex(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    let from_words = source[at].position_and_index;
    // Random words below 2^20, in steps of 2^-10: places all over the noise.
    let place = vec3<f32>(
        f32_of_u32(from_words.x >> 12u),
        f32_of_u32(from_words.y >> 12u),
        f32_of_u32(from_words.z >> 12u),
    ) * 0.0009765625f;
    let sum = noise(place, 1u);
    let words = vec4<u32>(bits_of(sum.x), bits_of(sum.y), bits_of(sum.z), bits_of(sum.w));
    destination[at] = Particle(words, source[at].velocity_and_birth);
}
