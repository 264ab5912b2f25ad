// Light in fixed point: each channel of a pixel is a 64-bit count of 2^-20 steps, held as two
// 32-bit limbs so that any adapter can add to it atomically. Integer sums do not depend on the
// order of the additions and do not wrap (Reeves 1983, 2.5: clamp, do not wrap).
// Twin of src/cpu/light.rs.
#define_import_path motes::light

#import motes::exact::{f32_of_u32, to_u32}

// Steps of light in 1.0.
const LIGHT_STEPS: f32 = 1048576.0f;

// A contribution in steps, to the nearest; what is more than 1,024 times white counts as that.
fn steps_of(light: f32) -> u32 {
    return to_u32(light * LIGHT_STEPS + 0.5f);
}

// The steps of a colour's channels where it counts so much.
fn steps_for(color: vec3<f32>, weight: f32) -> vec3<u32> {
    return vec3<u32>(
        steps_of(color.x * weight), steps_of(color.y * weight), steps_of(color.z * weight),
    );
}

// The light that the two limbs hold, rounded to single precision once or twice.
fn light_of(low: u32, high: u32) -> f32 {
    let fraction = f32_of_u32(low & 0xfffu) * 9.536743e-7f;
    let middle = f32_of_u32(low >> 12u) * 0.00390625f;
    return f32_of_u32(min(high, 0xffffffu)) * 4096.0f + (middle + fraction);
}
