//! strokes: whole trajectories of particles, as pieces that cover, and their shadows on the ground
//! (Reeves 1983, 4.3). Twin of `wgsl/draw/strokes.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::particle::{Identity, appearance_of, identity_of, lifetime_of, row_index};
use crate::cpu::projection::{Projected, project};
use crate::cpu::reach::{MOST_RADIUS_PX, is_visible};
use crate::cpu::shape::{Look, stroke_of};
use crate::cpu::stroke::{
    Way, as_light_has_it, cut_of, lit_along, motion_at, pieces_of, place_at, shadow_of, way_of,
};
use crate::exact::{
    at_least_zero, dot3, f32_of_u32, inverse_square_root, less, min_exact, normalize_exact,
    reciprocal, shared_constants, to_i32,
};
use crate::layout::{
    Cover, FRAME_ORTHOGRAPHIC, PARTICLE_STROKE, Particle, STROKE_PIECES_MASK, STROKE_SHADOW_SHIFT,
    STROKE_SHARE_MASK, STROKE_TAPER_SHIFT, STROKE_UNCUT, SystemRow,
};
use crate::plan::FrameInputs;

shared_constants! {
    /// A 4,095th.
    const SHARE_STEP: f32 = 0.000_244_200_26;
}

/// A particle as a stroke: for how many frames it goes on, and what of its row says how it is drawn.
struct Stroke<'a> {
    inputs: &'a FrameInputs,
    who: Identity,
    row: &'a SystemRow,
    frames: f32,
    taper: f32,
    shadow: f32,
}

/// Where the stroke is seen at a moment, and half how wide it is there.
#[derive(Clone, Copy)]
struct Joint {
    seen: Projected,
    at: Vec2,
    half_px: f32,
}

impl Stroke<'_> {
    fn joint_at(&self, way: &Way, part: f32) -> Joint {
        let frames = self.frames * part;
        let seen = project(&self.inputs.frame, place_at(way, frames));
        let look = appearance_of(self.who, self.row, to_i32(frames) as u32);
        let half_px = look.size * seen.scale * (1.0 - self.taper * part * part);
        Joint {
            seen,
            at: Vec2::new(seen.x, seen.y),
            half_px: min_exact(half_px, MOST_RADIUS_PX),
        }
    }

    /// What falls on a piece there that goes along there.
    fn light_on(&self, place: Vec3, motion: Vec3) -> Vec3 {
        let frame = &self.inputs.frame;
        let along = as_light_has_it(frame, normalize_exact(motion));
        let (x, y, z) = (
            frame.view_from_world_x,
            frame.view_from_world_y,
            frame.view_from_world_z,
        );
        let of = |row: [f32; 4]| dot3(Vec3::from_slice(&row), place) + row[3];
        let from_eye = Vec3::new(of(x), of(y), -of(z));
        let to_eye = if frame.flags & FRAME_ORTHOGRAPHIC != 0 {
            Vec3::Z
        } else {
            -normalize_exact(from_eye)
        };
        let light = &self.inputs.stroke_lights[0];
        let far = lit_along(along, Vec3::from_slice(&frame.light_from), to_eye);
        let mut sum =
            Vec3::from_slice(&frame.ambient_color) + Vec3::from_slice(&frame.light_color) * far;
        for lamp in &self.inputs.lamps[..light.kinds[0] as usize] {
            let lamp_at = Vec3::from_slice(&lamp.place) + Vec3::from_slice(&light.lamps_from);
            let away = as_light_has_it(frame, lamp_at - place);
            let near = inverse_square_root(dot3(away, away));
            let falls = lamp.place[3] * near * near * lit_along(along, away * near, to_eye);
            sum += Vec3::from_slice(&lamp.color) * falls;
        }
        sum
    }

    /// The colour and opacity of a piece at that moment.
    fn look_at(&self, way: &Way, frames: f32, is_shadow: bool) -> Vec4 {
        let own = appearance_of(self.who, self.row, to_i32(frames) as u32);
        let place = place_at(way, frames);
        if !is_shadow {
            let color = own.color * self.light_on(place, motion_at(way, frames));
            return color.extend(1.0 - own.transparency);
        }
        let light = &self.inputs.stroke_lights[0];
        let away = place - Vec3::from_slice(&light.middle);
        let near = at_least_zero(1.0 - dot3(away, away) * light.middle[3]);
        let opacity = self.shadow * (1.0 - own.transparency) * near * near;
        Vec3::from_slice(&light.shade_color).extend(opacity)
    }

    /// The pieces of a stroke or of its shadow.
    fn pieces(&self, own: &Way, pieces: u32, is_shadow: bool) -> Vec<Cover> {
        let (inputs, frame) = (self.inputs, &self.inputs.frame);
        let light = &inputs.stroke_lights[0];
        let way = if is_shadow {
            shadow_of(own, light)
        } else {
            *own
        };
        let most = pieces.min(self.row.kinds[2] & STROKE_PIECES_MASK);
        let count = pieces_of(frame, &way, self.frames, most);
        let step = reciprocal(f32_of_u32(count));
        let mut begin = self.joint_at(&way, 0.0);
        let mut end = self.joint_at(&way, step);
        let mut cut = STROKE_UNCUT;
        let mut records = vec![Cover::default(); pieces as usize];
        for (record, at) in records.iter_mut().zip(0..count) {
            let next = self.joint_at(&way, f32_of_u32(at + 2) * step);
            let next_cut = if at + 1 == count {
                STROKE_UNCUT
            } else {
                cut_between(begin.at, end.at, next.at)
            };
            let frames = self.frames * ((f32_of_u32(at) + 0.5) * step);
            let color = self.look_at(&way, frames, is_shadow);
            let here = frame.layer == 0
                || layer_of(&inputs.layer_planes, place_at(&way, frames)) == frame.layer;
            let halves = [begin.half_px, end.half_px];
            let height = dot3(Vec3::from_slice(&light.ground), place_at(own, frames));
            let is_high = light.kinds[2] == 0 || less(light.ground[3], height);
            if here
                && less(0.0, color.w)
                && less(0.0, halves[0] + halves[1])
                && is_high
                && is_visible(frame, begin.seen, end.seen, begin.half_px + end.half_px)
            {
                let look = Look {
                    depth: 0.5 * (begin.seen.depth + end.seen.depth),
                    color,
                    lit: Vec3::ZERO,
                };
                *record = stroke_of(begin.at, end.at, halves, [cut, next_cut], &look);
            }
            begin = end;
            end = next;
            cut = next_cut;
        }
        records
    }
}

/// The direction that pieces are cut off across where one goes on as another.
fn cut_between(a: Vec2, b: Vec2, c: Vec2) -> f32 {
    let before = b - a;
    let behind = c - b;
    let turns = before.x * behind.x + before.y * behind.y;
    let share = inverse_square_root(before.x * before.x + before.y * before.y);
    let other = inverse_square_root(behind.x * behind.x + behind.y * behind.y);
    if less(0.0, turns) {
        cut_of(before * share + behind * other)
    } else {
        STROKE_UNCUT
    }
}

/// The records of a particle, `pieces` of its shadow, if there are any, and as many of itself.
pub fn strokes(
    particle: &Particle,
    inputs: &FrameInputs,
    rows: &[SystemRow],
    (pieces, records): (u32, u32),
) -> Vec<Cover> {
    let frame = &inputs.frame;
    let (who, _) = identity_of(particle, inputs);
    let row = &rows[row_index(particle.slot(), who.birth_frame, frame.row_mask)];
    if row.kinds[1] != PARTICLE_STROKE {
        return vec![Cover::default(); records as usize];
    }
    let share = |bits: u32| f32_of_u32(bits & STROKE_SHARE_MASK) * SHARE_STEP;
    let stroke = Stroke {
        inputs,
        who,
        row,
        frames: f32_of_u32(lifetime_of(who, row.speed_and_lifetime)),
        taper: share(row.kinds[2] >> STROKE_TAPER_SHIFT),
        shadow: if inputs.stroke_lights[0].kinds[1] != 0 {
            share(row.kinds[2] >> STROKE_SHADOW_SHIFT)
        } else {
            0.0
        },
    };
    let system = &inputs.systems[particle.slot() as usize];
    let way = way_of(system, particle);
    let mut all = if records > pieces {
        stroke.pieces(&way, pieces, true)
    } else {
        Vec::new()
    };
    all.extend(stroke.pieces(&way, pieces, false));
    all
}
