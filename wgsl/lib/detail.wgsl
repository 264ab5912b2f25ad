// Smaller particles beside the way of a flame, so that it looks alike from near and far.
//
// Perry 1994, 4.1 (further work): particles of many scales off the main trajectory. Those of each
// octave are half as large as those of the one before and twice as many, so that they overlap alike, and
// stray half as far from these, the farther the older they are: outlines are no mirror images any more. What an
// octave shines, the one before shines less; of neither anything changes where particles are too small to be
// told apart, and nothing at once as they come nearer.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/detail.rs.
#define_import_path motes::detail

#import motes::exact::{clamp_exact, f32_of_u32, less, reciprocal}
#import motes::layout::FireFrame
#import motes::noise::noise

// Noise cells a particle's width.
const CELLS_A_WIDTH: f32 = 0.4f;
// The inverse of the greatest age.
const AGE_SHARE: f32 = 0.041666668f;
// Half-widths in pixels at which octaves begin to be seen, as the inverse; at twice as many they wholly are.
const COME_IN_PACE: f32 = 1.3333334f;
// Tells the noises of details from the one that bends flames.
const DETAIL_TAG: u32 = 0x64657461u;

// The size of particles of an octave, as a factor.
fn scale_of(octave: u32) -> f32 {
    return reciprocal(f32_of_u32(1u << octave));
}

// Where a particle is that would be at `p` at that age, of a flame so wide: each octave strays from the way
// of the one before. The noise rises as fast in all.
fn strayed(fire: FireFrame, octave: u32, p: vec3<f32>, age: f32, width: f32) -> vec3<f32> {
    let cells = CELLS_A_WIDTH * reciprocal(width);
    let farthest = width * fire.details.y * age * AGE_SHARE;
    var place = p;
    // No loop asks uniforms alone, see motes::sprite::next_layer.
    for (var at = 1u; (at <= octave) & !less(fire.details.x, f32_of_u32(at)); at += 1u) {
        let scale = scale_of(at);
        let noisy = (place * cells + fire.noise.xyz) * f32_of_u32(1u << at);
        place += noise(noisy, fire.kinds.z ^ (DETAIL_TAG + at)).xyz * (farthest * scale);
    }
    return place;
}

// How far an octave has come in whose particles have that half-width in pixels.
fn come_in(half_width_px: f32) -> f32 {
    return clamp_exact(half_width_px * COME_IN_PACE - 1.0f, 0.0f, 1.0f);
}

// The opacity of an octave's particles as a factor, where those of the flame's own way have that half-width in
// pixels: as many as there are have half the light of the octave before where they are as opaque.
fn octave_opacity(fire: FireFrame, octave: u32, half_width_px: f32) -> f32 {
    var opacity = 1.0f;
    for (var at = 1u; (at <= octave) & !less(fire.details.x, f32_of_u32(at)); at += 1u) {
        opacity *= fire.details.z * come_in(half_width_px * scale_of(at));
    }
    let finer = fire.details.z * come_in(half_width_px * scale_of(octave + 1u));
    let is_last = !less(f32_of_u32(octave), fire.details.x);
    return opacity * (1.0f - select(0.5f * finer, 0.0f, is_last));
}
