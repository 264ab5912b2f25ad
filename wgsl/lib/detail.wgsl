// Smaller particles beside the way of a flame, so that it looks alike from near and far.
//
// Perry 1994, 4.1 (further work): particles of many scales off the main trajectory. Those of each
// octave are half as large as those of the one before and twice as many; noise carries them off, the
// farther the older they are, so that outlines are no mirror images any more.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/detail.rs.
#define_import_path motes::detail

#import motes::exact::{f32_of_u32, reciprocal}
#import motes::layout::FireFrame
#import motes::noise::noise

// Noise cells a particle's width.
const CELLS_A_WIDTH: f32 = 0.4f;
// The inverse of the greatest age.
const AGE_SHARE: f32 = 0.041666668f;
// Tells the noises of details from the one that bends flames.
const DETAIL_TAG: u32 = 0x64657461u;

// The size of particles of an octave, as a factor.
fn scale_of(octave: u32) -> f32 {
    return reciprocal(f32_of_u32(1u << octave));
}

// Where a particle is that would be at `p` at that age, of a flame so wide.
fn strayed(fire: FireFrame, octave: u32, copy: u32, p: vec3<f32>, age: f32, width: f32) -> vec3<f32> {
    let cells = CELLS_A_WIDTH * reciprocal(width * scale_of(octave));
    let off = noise(p * cells + fire.noise.xyz, fire.kinds.z ^ (DETAIL_TAG + (1u << octave) + copy)).xyz;
    return p + off * (width * fire.details.y * age * AGE_SHARE);
}
