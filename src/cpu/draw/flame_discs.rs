//! flame_discs: the particles along a flame as they are seen. Twin of `wgsl/draw/flame_discs.wgsl`.

use glam::{IVec2, Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::detail::{octave_opacity, scale_of, strayed};
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
    /// Nor are those of which any place is divided by less than this, of 1.
    pub const LEAST_MATRIX_DIVISOR: f32 = 0.0625;
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

/// What the matrix of a particle at `p` makes of x, of y and of the centre.
#[inline]
fn matrix_of(fire: &FireFrame, p: Vec3) -> [Vec4; 3] {
    let [x, y] = [fire.matrix_x, fire.matrix_y].map(Vec4::from);
    let at = p * fire.look[2] + Vec3::from_slice(&fire.noise);
    let n = noise(at, fire.kinds[2] ^ MATRIX_TAG) * fire.strip[3];
    [
        x + (x * n.x + y * n.z),
        y + (x * n.y + y * n.w),
        Vec4::from(fire.matrix_center),
    ]
}

/// A polygon as its matrix has it: how far from its place its centre is seen, half of its extent across and
/// along the picture, what leads from places back into it, and how what it is divided by there grows.
struct Outline {
    center: Vec2,
    reach: Vec2,
    scale: Vec2,
    skew: Vec2,
    tilt: Vec2,
    is_flat: bool,
}

/// Of a polygon with these half-axes in pixels, which are `scale` half-widths of its flame, and of a
/// matrix; without one, of one that changes nothing.
#[inline]
fn outline_of(
    fire: &FireFrame,
    focal_px: Option<f32>,
    p: Vec3,
    [across, along]: [f32; 2],
    scale: [f32; 2],
    half_width: f32,
) -> Outline {
    let Some(focal_px) = focal_px else {
        return Outline {
            center: Vec2::ZERO,
            reach: Vec2::new(across, along),
            scale: Vec2::new(reciprocal(across), reciprocal(along)),
            skew: Vec2::ZERO,
            tilt: Vec2::ZERO,
            is_flat: false,
        };
    };
    let [of_x, of_y, of_center] = matrix_of(fire, p);
    // What is nearer the viewer is larger. All is divided by what the centre is divided by.
    let nearer = reciprocal(focal_px);
    let far = of_center.w - of_center.z * half_width * nearer;
    let is_behind = less(far, LEAST_MATRIX_DIVISOR);
    let share = reciprocal(if is_behind { 1.0 } else { far });
    let seen = |v: Vec4| Vec2::new(v.x, v.y);
    let (x, y) = (seen(of_x) * share, seen(of_y) * share);
    let divisor = Vec2::new(
        (of_x.w * scale[0] * reciprocal(across) - of_x.z * nearer) * share,
        (of_y.w * scale[1] * reciprocal(along) - of_y.z * nearer) * share,
    );
    let center = seen(of_center) * half_width * share;
    // The least that any corner is divided by, of 1 at the centre.
    let least = 1.0 - (divisor.x.abs() * across + divisor.y.abs() * along);
    let x_there = x - center * divisor.x;
    let y_there = y - center * divisor.y;
    let area = x_there.x * y_there.y - y_there.x * x_there.y;
    let is_flat =
        is_behind || less(area.abs(), LEAST_MATRIX_AREA) || less(least, LEAST_MATRIX_DIVISOR);
    let inverse = reciprocal(if is_flat { 1.0 } else { area });
    let to_across = inverse * reciprocal(across);
    let to_along = inverse * reciprocal(along);
    let stretch = reciprocal(if is_flat { 1.0 } else { least });
    Outline {
        center: Vec2::new(center.x, 0.0 - center.y),
        reach: Vec2::new(
            (x_there.x.abs() * across + y_there.x.abs() * along) * stretch,
            (x_there.y.abs() * across + y_there.y.abs() * along) * stretch,
        ),
        scale: Vec2::new(y_there.y * to_across, x_there.x * to_along),
        // y is up in the matrix, and down in the picture.
        skew: Vec2::new(y_there.x * to_across, x_there.y * to_along),
        tilt: Vec2::new(
            (x.y * divisor.y - y.y * divisor.x) * inverse,
            (x.x * divisor.y - y.x * divisor.x) * inverse,
        ),
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
    (strayed(fire, pass.octave, between, own_age, width), own_age)
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
    skews: &mut [[u32; 4]],
) -> [u32; 4] {
    let frame = &inputs.frame;
    let [_, width, brightness, burns] = flame.look;
    let half_width = 0.5 * f32::from_bits(width);
    let root = Vec3::from(flame.root());
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, root) == frame.layer;
    let fire = &inputs.fires[flame.fire() as usize];
    let burns = here && burns == 1 && fire.kinds[3] & FIRE_STRIP == 0;
    let focal_px = (!skews.is_empty()).then_some(frame.focal_px);
    let size = IVec2::new(frame.width as i32, frame.height as i32);
    let (mut low, mut high) = (size, IVec2::ZERO);
    let first_look = (flame.fire() * FLAME_STEPS) as usize;
    let looks = &inputs.age_looks[first_look..];
    let is_detail = pass.octave > 0;
    let scale = if is_detail {
        scale_of(pass.octave)
    } else {
        1.0
    };
    let brightness = f32::from_bits(brightness);
    let has_pass = !is_detail || !less(fire.details[0], f32_of_u32(pass.octave));
    for (age, (look, disc)) in looks.iter().zip(discs).enumerate() {
        let (place, own_age) = placed(fire, pass, steps, age, 2.0 * half_width);
        let is_there = burns && has_pass && (!is_detail || age + 1 < steps.len());
        let seen = project(frame, place);
        let [center, rim] = colors_of(fire, looks, own_age, place);
        let (across, fainter) = half_axis(half_width * scale * look.scale[0] * seen.scale);
        let (along, fainter_still) = half_axis(half_width * scale * look.scale[1] * seen.scale);
        let drawn_half_width = half_width * scale * seen.scale;
        let axes = [look.scale[0], look.scale[1]];
        let outline = outline_of(
            fire,
            focal_px,
            place,
            [across, along],
            axes,
            drawn_half_width,
        );
        let reach = outline.reach;
        let middle = Vec2::new(seen.x, seen.y) + outline.center;
        let is_near = less(MOST_HALF_AXIS_PX, reach.x) || less(MOST_HALF_AXIS_PX, reach.y);
        let of_octave = octave_opacity(fire, pass.octave, half_width * seen.scale);
        let is_clear = is_detail && !less(0.0, of_octave);
        let is_seen =
            is_there && !is_near && !is_clear && !outline.is_flat && !less(seen.depth, frame.near);
        let opacity = if is_seen {
            brightness * of_octave * fainter * fainter_still
        } else {
            0.0
        };
        let with = |color: Vec4| {
            let [red, green, blue, alpha] = color.to_array();
            [red, green, blue, alpha * opacity].map(bits_of)
        };
        *disc = FlameDisc {
            place: [middle.x, middle.y, outline.scale.x, outline.scale.y].map(bits_of),
            center: with(center),
            rim: with(rim),
        };
        if let Some(skew) = skews.get_mut(age) {
            let [skew_x, skew_y] = outline.skew.to_array();
            let [tilt_x, tilt_y] = outline.tilt.to_array();
            *skew = [skew_x, skew_y, tilt_x, tilt_y].map(bits_of);
        }
        if is_seen {
            let first = IVec2::new(to_i32(middle.x - reach.x), to_i32(middle.y - reach.y));
            let last = IVec2::new(
                to_i32(middle.x + reach.x) + 1,
                to_i32(middle.y + reach.y) + 1,
            );
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
