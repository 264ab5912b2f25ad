//! strips: strips along flames add their light (Perry 1994, 4.2). Twin of `wgsl/draw/strips.wgsl`.

use glam::{IVec2, UVec2, Vec2, Vec3, Vec4};

use super::glow::Onto;
use crate::cpu::light::steps_of;
use crate::cpu::strip::{
    along, beside, color_age, end_share, middle_share, piece_reach, turbulence,
};
use crate::cpu::veil::{front_of, open_share};
use crate::exact::{f32_of_u32, less, max_exact, reciprocal, to_i32, to_u32};
use crate::layout::{AgeLook, FLAME_STEPS, FireFrame, Flame, Frame, StripJoint};
use crate::plan::FrameInputs;

/// The light of the strip at an age and so many half-widths from its middle; `looks` are the fire's.
#[inline]
fn texel(
    fire: &FireFrame,
    looks: &[AgeLook],
    index: u32,
    age: f32,
    across: f32,
    opacity: f32,
) -> Vec3 {
    let turbulent = turbulence(fire, index, age, across);
    let share = middle_share(fire, age, across, turbulent);
    let moved = color_age(fire, age, turbulent);
    let low = to_u32(moved).min(FLAME_STEPS - 2);
    let part = moved - f32_of_u32(low);
    let [here, next] = [looks[low as usize], looks[low as usize + 1]];
    let mixed = |here: [f32; 4], next: [f32; 4]| {
        Vec4::from(here) + (Vec4::from(next) - Vec4::from(here)) * part
    };
    let center = mixed(here.center, next.center);
    let rim = mixed(here.rim, next.rim);
    let alpha = center.w * share * (opacity * end_share(age));
    (rim.truncate() + (center.truncate() - rim.truncate()) * share) * alpha
}

/// A piece of a strip, from one joint to the next.
struct Piece {
    /// Its age at the first.
    age: u32,
    /// The joints' places, and the ways on from there.
    here: Vec4,
    there: Vec4,
    /// Their half-widths, opacities and depths.
    from_here: Vec3,
    to_there: Vec3,
}

/// The piece between two joints, if both are seen and its ends do not look away from each other.
fn piece_of(age: u32, [here, there]: [&StripJoint; 2]) -> Option<Piece> {
    let place = |joint: &StripJoint| Vec4::from(joint.place.map(f32::from_bits));
    let extent = |joint: &StripJoint| {
        let [half_width, opacity, _, depth] = joint.extent.map(f32::from_bits);
        Vec3::new(half_width, opacity, depth)
    };
    let piece = Piece {
        age,
        here: place(here),
        there: place(there),
        from_here: extent(here),
        to_there: extent(there),
    };
    let goes_on = less(0.0, along(way_of(piece.there), way_of(piece.here)));
    (here.extent[2] == 1 && there.extent[2] == 1 && goes_on).then_some(piece)
}

/// The way on from a joint.
fn way_of(place: Vec4) -> Vec2 {
    Vec2::new(place.z, place.w)
}

impl Piece {
    /// The pixels that it may touch: the first column and line, and one past the last of each.
    fn bounds(&self, frame: &Frame) -> [UVec2; 2] {
        let half_width = max_exact(self.from_here.x, self.to_there.x);
        let reach = piece_reach(self.here, self.there, half_width);
        let size = IVec2::new(frame.width as i32, frame.height as i32);
        let to_pixel = |at: Vec2| IVec2::new(to_i32(at.x), to_i32(at.y));
        let middle = self.here.truncate().truncate();
        [
            to_pixel(middle - reach),
            to_pixel(middle + reach) + IVec2::ONE,
        ]
        .map(|at| at.clamp(IVec2::ZERO, size).as_uvec2())
    }

    /// What it adds to a pixel; `open` is what surfaces leave of a place at a depth that is so wide.
    fn light(
        &self,
        fire: &FireFrame,
        looks: &[AgeLook],
        index: u32,
        pixel: Vec2,
        open: impl Fn(f32, f32) -> f32,
    ) -> Vec3 {
        let off = pixel - self.here.truncate().truncate();
        let off_next = pixel - self.there.truncate().truncate();
        let (way, way_next) = (way_of(self.here), way_of(self.there));
        let (ahead, ahead_next) = (along(off, way), along(off_next, way_next));
        if less(ahead, 0.0) || !less(ahead_next, 0.0) {
            return Vec3::ZERO;
        }
        let part = ahead * reciprocal(ahead - ahead_next);
        let extent = self.from_here + (self.to_there - self.from_here) * part;
        let aside = beside(off, way);
        let far = aside + (beside(off_next, way_next) - aside) * part;
        let across = far * reciprocal(extent.x);
        if !less(across.abs(), 1.0) {
            return Vec3::ZERO;
        }
        let own_age = f32_of_u32(self.age) + part;
        let light = texel(fire, looks, index, own_age, across, extent.y);
        light * open(extent.z, extent.x)
    }
}

/// Adds the light of the strip along a flame, piece by piece.
pub fn strips(inputs: &FrameInputs, flame: &Flame, joints: &[StripJoint], onto: Onto<'_>) {
    let light = onto.light;
    let fire = &inputs.fires[flame.fire() as usize];
    let looks = &inputs.age_looks[(flame.fire() * FLAME_STEPS) as usize..];
    let two_by_two = joints.iter().zip(&joints[1..]);
    let pieces = (0..)
        .zip(two_by_two)
        .filter_map(|(age, (here, there))| piece_of(age, [here, there]));
    for piece in pieces {
        let [first, end] = piece.bounds(onto.frame);
        for (y, x) in (first.y..end.y).flat_map(|y| (first.x..end.x).map(move |x| (y, x))) {
            let pixel = Vec2::new(f32_of_u32(x) + 0.5, f32_of_u32(y) + 0.5);
            let nearness = onto.nearness.get((y * light.width + x) as usize);
            let open = |depth, half_width| {
                let front = front_of(onto.frame, depth, half_width);
                nearness.map_or(1.0, |nearness| open_share(*nearness, front))
            };
            let lit = piece.light(fire, looks, flame.index(), pixel, open);
            if less(0.0, lit.x + lit.y + lit.z) {
                let first = (y * light.width + x) as usize * 3;
                for (channel, value) in lit.to_array().into_iter().enumerate() {
                    light.add(first + channel, steps_of(value));
                }
            }
        }
    }
}
