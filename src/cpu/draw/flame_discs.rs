//! flame_discs: the particles along a flame as they are seen. Twin of `wgsl/draw/flame_discs.wgsl`.

use glam::{IVec2, Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::detail::{scale_of, strayed};
use crate::cpu::fan::LEAST_HALF_AXIS_PX;
use crate::cpu::projection::project;
use crate::exact::{
    bits_of, clamp_exact, f32_of_u32, less, max_exact, reciprocal, shared_constants, to_i32, to_u32,
};
use crate::layout::{AgeLook, FIRE_STRIP, FLAME_STEPS, FireFrame, Flame, FlameDisc};
use crate::noise::noise;
use crate::plan::{DetailPass, FrameInputs};

shared_constants! {
    /// Half-axes in pixels, at most.
    pub const MOST_HALF_AXIS_PX: f32 = 16_384.0;
    /// Tells the noise of matrices from the one that bends flames.
    pub const MATRIX_TAG: u32 = 0x6d61_7472;
    /// Particles whose matrix shrinks areas more than to this are not drawn.
    pub const LEAST_MATRIX_AREA: f32 = 0.000_001;
}

/// A half-axis that is drawn, and how much fainter it is for that.
#[inline]
fn half_axis(pixels: f32) -> (f32, f32) {
    let drawn = max_exact(pixels, LEAST_HALF_AXIS_PX);
    (drawn, pixels * reciprocal(drawn))
}

/// The colours of centre and rim of a particle of that age at a place; `looks` are the fire's.
#[inline]
fn colors_of(fire: &FireFrame, looks: &[AgeLook], age: f32, p: Vec3) -> [Vec4; 2] {
    let mut moved = age;
    // Noise that moves nothing is worth no time.
    if less(0.0, fire.look[1]) {
        let at = p * fire.look[2] + Vec3::from_slice(&fire.noise);
        moved += noise(at, fire.kinds[2]).w * fire.look[1];
    }
    let last = f32_of_u32(FLAME_STEPS - 1);
    let index = clamp_exact(moved, 0.0, last);
    let low = to_u32(index).min(FLAME_STEPS - 2);
    let part = index - f32_of_u32(low);
    let [here, next] = [looks[low as usize], looks[low as usize + 1]];
    let mixed = |here: [f32; 4], next: [f32; 4]| {
        Vec4::from(here) + (Vec4::from(next) - Vec4::from(here)) * part
    };
    [mixed(here.center, next.center), mixed(here.rim, next.rim)]
}

/// The rows of the matrix of a particle at `p`.
#[inline]
fn matrix_of(fire: &FireFrame, p: Vec3) -> Vec4 {
    let m = Vec4::from(fire.matrix);
    let at = p * fire.look[2] + Vec3::from_slice(&fire.noise);
    let n = noise(at, fire.kinds[2] ^ MATRIX_TAG) * fire.strip[3];
    Vec4::new(
        m.x + (m.x * n.x + m.y * n.z),
        m.y + (m.x * n.y + m.y * n.w),
        m.z + (m.z * n.x + m.w * n.z),
        m.w + (m.z * n.y + m.w * n.w),
    )
}

/// A polygon as its matrix has it: half of its extent across and along the picture, and what leads
/// from places back into it.
struct Outline {
    reach: Vec2,
    scale: Vec2,
    skew: Vec2,
    is_flat: bool,
}

/// Without a matrix, of one that changes nothing.
#[inline]
fn outline_of(fire: &FireFrame, has_matrix: bool, p: Vec3, across: f32, along: f32) -> Outline {
    if !has_matrix {
        return Outline {
            reach: Vec2::new(across, along),
            scale: Vec2::new(reciprocal(across), reciprocal(along)),
            skew: Vec2::ZERO,
            is_flat: false,
        };
    }
    let m = matrix_of(fire, p);
    let area = m.x * m.w - m.y * m.z;
    let is_flat = less(area.abs(), LEAST_MATRIX_AREA);
    let inverse = reciprocal(if is_flat { 1.0 } else { area });
    let to_across = inverse * reciprocal(across);
    let to_along = inverse * reciprocal(along);
    Outline {
        reach: Vec2::new(
            m.x.abs() * across + m.y.abs() * along,
            m.z.abs() * across + m.w.abs() * along,
        ),
        scale: Vec2::new(m.w * to_across, m.x * to_along),
        // y is up in the matrix, and down in the picture.
        skew: Vec2::new(m.y * to_across, m.z * to_along),
        is_flat,
    }
}

/// Where a particle is and how old, in steps: on the flame's way, or, of details, beside it.
#[inline]
fn placed(
    fire: &FireFrame,
    pass: DetailPass,
    steps: &[[u32; 4]],
    age: usize,
    width: f32,
) -> (Vec3, f32) {
    let place = |age: usize| {
        let [x, y, z, _] = steps[age].map(f32::from_bits);
        Vec3::new(x, y, z)
    };
    let (here, own_age) = (place(age), f32_of_u32(age as u32));
    if pass.octave == 0 {
        return (here, own_age);
    }
    let part = (f32_of_u32(pass.copy) + 0.5) * scale_of(pass.octave);
    let next = place((age + 1).min(steps.len() - 1));
    let own_age = own_age + part;
    let between = here + (next - here) * part;
    (strayed(fire, pass, between, own_age, width), own_age)
}

/// The discs of a flame in a pass whose particle is at these places, from age 0 on, and what is
/// known of all of them: first column, and one past the last in the upper 16 bits; the same of lines,
/// both 0 for none; x and y of [`FireFrame::inner`] as bits. `skews` are empty where no particle has a
/// matrix.
pub fn flame_discs(
    inputs: &FrameInputs,
    flame: &Flame,
    pass: DetailPass,
    steps: &[[u32; 4]],
    discs: &mut [FlameDisc],
    skews: &mut [[u32; 2]],
) -> [u32; 4] {
    let frame = &inputs.frame;
    let [_, width, brightness, burns] = flame.look;
    let half_width = 0.5 * f32::from_bits(width);
    let root = Vec3::from(flame.root());
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, root) == frame.layer;
    let fire = &inputs.fires[flame.fire() as usize];
    let burns = here && burns == 1 && fire.kinds[3] & FIRE_STRIP == 0;
    let has_matrix = !skews.is_empty();
    let size = IVec2::new(frame.width as i32, frame.height as i32);
    let (mut low, mut high) = (size, IVec2::ZERO);
    let first_look = (flame.fire() * FLAME_STEPS) as usize;
    let looks = &inputs.age_looks[first_look..];
    let is_detail = pass.octave > 0;
    let (scale, alpha) = if is_detail {
        (scale_of(pass.octave), fire.details[2])
    } else {
        (1.0, 1.0)
    };
    let brightness = f32::from_bits(brightness) * alpha;
    let has_pass = !is_detail || !less(fire.details[0], f32_of_u32(pass.octave));
    for (age, (look, disc)) in looks.iter().zip(discs).enumerate() {
        let (place, own_age) = placed(fire, pass, steps, age, 2.0 * half_width);
        let is_there = burns && has_pass && (!is_detail || age + 1 < steps.len());
        let seen = project(frame, place);
        let [center, rim] = colors_of(fire, looks, own_age, place);
        let (across, fainter) = half_axis(half_width * scale * look.scale[0] * seen.scale);
        let (along, fainter_still) = half_axis(half_width * scale * look.scale[1] * seen.scale);
        let outline = outline_of(fire, has_matrix, place, across, along);
        let reach = outline.reach;
        let is_near = less(MOST_HALF_AXIS_PX, reach.x) || less(MOST_HALF_AXIS_PX, reach.y);
        let is_seen = is_there && !is_near && !outline.is_flat && !less(seen.depth, frame.near);
        let opacity = if is_seen {
            brightness * fainter * fainter_still
        } else {
            0.0
        };
        let with = |color: Vec4| {
            let [red, green, blue, alpha] = color.to_array();
            [red, green, blue, alpha * opacity].map(bits_of)
        };
        *disc = FlameDisc {
            place: [seen.x, seen.y, outline.scale.x, outline.scale.y].map(bits_of),
            center: with(center),
            rim: with(rim),
        };
        if let Some(skew) = skews.get_mut(age) {
            *skew = outline.skew.to_array().map(bits_of);
        }
        if is_seen {
            let first = IVec2::new(to_i32(seen.x - reach.x), to_i32(seen.y - reach.y));
            let last = IVec2::new(to_i32(seen.x + reach.x) + 1, to_i32(seen.y + reach.y) + 1);
            low = low.min(first);
            high = high.max(last);
        }
    }
    low = low.max(IVec2::ZERO);
    high = high.min(size);
    let bounds = if low.x < high.x && low.y < high.y {
        [low.x | (high.x << 16), low.y | (high.y << 16)]
    } else {
        [0; 2]
    };
    let [across, down] = bounds.map(i32::cast_unsigned);
    [across, down, bits_of(fire.inner[0]), bits_of(fire.inner[1])]
}
