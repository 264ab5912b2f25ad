//! splat: one particle adds its light to the pixels that it covers (Reeves 1983, 2.5 and 3).
//! Twin of `wgsl/draw/splat.wgsl`, line by line.

use glam::Vec3;

use crate::cpu::light::{LightSums, steps_of};
use crate::cpu::particle::{appearance_of, identity_of, row_index};
use crate::exact::{
    clamp_exact, f32_of_i32, inverse_square_root, less, max_exact, min_exact, reciprocal,
    square_root, to_i32,
};
use crate::layout::{
    Frame, PARTICLE_RECTANGLE, PARTICLE_STREAK, Particle, STREAK_CONSTANT, SystemFrame, SystemRow,
};
use crate::plan::FrameInputs;

const PI: f32 = std::f32::consts::PI;
const MOST_RADIUS_PX: f32 = 256.0;
const GUARD_PX: i32 = 1024;
const LARGE_RADIUS_PX: f32 = 4.0;
const SMALL_REACH_PX: f32 = 1.5;

/// A point in pixels, its depth along the view axis, and the pixels a world unit spans there.
#[derive(Clone, Copy)]
struct Projected {
    x: f32,
    y: f32,
    depth: f32,
    scale: f32,
}

#[inline]
fn transform(x_row: [f32; 4], y_row: [f32; 4], z_row: [f32; 4], p: Vec3) -> Vec3 {
    Vec3::new(
        x_row[0] * p.x + x_row[1] * p.y + x_row[2] * p.z + x_row[3],
        y_row[0] * p.x + y_row[1] * p.y + y_row[2] * p.z + y_row[3],
        z_row[0] * p.x + z_row[1] * p.y + z_row[2] * p.z + z_row[3],
    )
}

/// A point of the system's space in world space.
#[inline]
pub fn world_of(system: &SystemFrame, in_system: Vec3) -> Vec3 {
    transform(
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
        in_system,
    )
}

#[inline]
fn project(frame: &Frame, system: &SystemFrame, in_system: Vec3) -> Projected {
    let world = world_of(system, in_system);
    let view = transform(
        frame.view_from_world_x,
        frame.view_from_world_y,
        frame.view_from_world_z,
        world,
    );
    let scale = frame.focal_px * reciprocal(max_exact(view.z, frame.near));
    Projected {
        x: frame.center_x_px + view.x * scale,
        y: frame.center_y_px - view.y * scale,
        depth: view.z,
        scale,
    }
}

#[inline]
fn add_light(light: &LightSums, x: i32, y: i32, color: Vec3, weight: f32) {
    let at = (y as usize * light.width as usize + x as usize) * 3;
    light.add(at, steps_of(color.x * weight));
    light.add(at + 1, steps_of(color.y * weight));
    light.add(at + 2, steps_of(color.z * weight));
}

/// A disc swept along a segment; `major` is the axis on which the segment is longer.
struct Capsule {
    start_major: f32,
    start_minor: f32,
    along_major: f32,
    along_minor: f32,
    inverse_length_squared: f32,
    reach: f32,
    minor_reach: f32,
    slope: f32,
}

impl Capsule {
    /// How much of the pixel at (major, minor) the capsule covers, 0 to 1.
    #[inline]
    fn weight_at(&self, major: i32, minor: i32) -> f32 {
        let dx = f32_of_i32(major) + 0.5 - self.start_major;
        let dy = f32_of_i32(minor) + 0.5 - self.start_minor;
        let along = (dx * self.along_major + dy * self.along_minor) * self.inverse_length_squared;
        let t = clamp_exact(along, 0.0, 1.0);
        let ex = dx - t * self.along_major;
        let ey = dy - t * self.along_minor;
        let distance = square_root(ex * ex + ey * ey);
        clamp_exact(self.reach - distance, 0.0, 1.0)
    }

    /// First and one past the last pixel whose centre is within the reach, on the minor axis.
    #[inline]
    fn minor_range(&self, major: i32) -> (i32, i32) {
        let middle = self.start_minor + (f32_of_i32(major) + 0.5 - self.start_major) * self.slope;
        (
            to_i32(middle - self.minor_reach),
            to_i32(middle + self.minor_reach) + 1,
        )
    }
}

/// The radius whose edge, one pixel wide, gives the area of a disc of `radius_px`.
#[inline]
fn edged_radius(radius_px: f32) -> f32 {
    max_exact(
        square_root(max_exact(radius_px * radius_px - 0.083_333_333, 0.0)),
        0.5,
    )
}

fn splat_capsule(
    light: &LightSums,
    start: Projected,
    end: Projected,
    radius_px: f32,
    reach: f32,
    color: Vec3,
    conserved: bool,
) {
    let dx = end.x - start.x;
    let dy = end.y - start.y;
    let steep = less(dx.abs(), dy.abs());
    let length_squared = dx * dx + dy * dy;
    let along_major = if steep { dy } else { dx };
    let along_minor = if steep { dx } else { dy };
    let inverse_length = inverse_square_root(length_squared);
    let moves = less(0.0001, length_squared);
    let slope = if moves {
        along_minor * reciprocal(along_major)
    } else {
        0.0
    };
    let capsule = Capsule {
        start_major: if steep { start.y } else { start.x },
        start_minor: if steep { start.x } else { start.y },
        along_major,
        along_minor,
        inverse_length_squared: if moves {
            inverse_length * inverse_length
        } else {
            0.0
        },
        reach,
        minor_reach: reach * square_root(1.0 + slope * slope),
        slope,
    };
    let end_major = capsule.start_major + if moves { along_major } else { 0.0 };
    let (width, height) = (light.width as i32, light.height as i32);
    let (major_size, minor_size) = if steep {
        (height, width)
    } else {
        (width, height)
    };
    let first = to_i32(min_exact(capsule.start_major, end_major) - reach);
    let last = to_i32(max_exact(capsule.start_major, end_major) + reach) + 1;

    let mut gain = 1.0;
    let conserves = conserved || !moves;
    let guarded = -GUARD_PX <= first && last <= major_size + GUARD_PX;
    if (moves && (conserved || guarded)) || (!moves && less(radius_px, LARGE_RADIUS_PX)) {
        let mut sum = 0.0;
        for major in first.max(-GUARD_PX)..last.min(major_size + GUARD_PX) {
            let (low, high) = capsule.minor_range(major);
            for minor in low..high {
                sum += capsule.weight_at(major, minor);
            }
        }
        let broad_px = if conserves {
            radius_px
        } else {
            max_exact(radius_px, 0.5)
        };
        let swept = if conserves {
            0.0
        } else {
            2.0 * broad_px * (length_squared * inverse_length)
        };
        let scaled = (PI * broad_px * broad_px + swept) * reciprocal(sum);
        let half = 0.5 * LARGE_RADIUS_PX;
        let share = clamp_exact((radius_px - half) * 0.5, 0.0, 1.0);
        gain = if moves {
            scaled
        } else {
            scaled + share * (1.0 - scaled)
        };
    }
    for major in first.max(0)..last.min(major_size) {
        let (low, high) = capsule.minor_range(major);
        for minor in low.max(0)..high.min(minor_size) {
            let weight = capsule.weight_at(major, minor) * gain;
            if less(0.0, weight) {
                let (x, y) = if steep {
                    (minor, major)
                } else {
                    (major, minor)
                };
                add_light(light, x, y, color, weight);
            }
        }
    }
}

/// A disc at rest whose edge reaches at most 1.5 pixels covers nothing but the nine pixels around
/// its centre's.
fn splat_small_disc(light: &LightSums, center: Projected, radius_px: f32, reach: f32, color: Vec3) {
    let left = to_i32(center.x) - 1;
    let top = to_i32(center.y) - 1;
    let mut weights = [0.0; 9];
    let mut sum = 0.0;
    for at in 0..9 {
        let dx = f32_of_i32(left + at % 3) + 0.5 - center.x;
        let dy = f32_of_i32(top + at / 3) + 0.5 - center.y;
        let distance = square_root(dx * dx + dy * dy);
        let weight = clamp_exact(reach - distance, 0.0, 1.0);
        weights[at as usize] = weight;
        sum += weight;
    }
    let gain = PI * radius_px * radius_px * reciprocal(sum);
    for at in 0..9 {
        let x = left + at % 3;
        let y = top + at / 3;
        let weight = weights[at as usize] * gain;
        let inside = x >= 0 && y >= 0 && x < light.width as i32 && y < light.height as i32;
        if less(0.0, weight) && inside {
            add_light(light, x, y, color, weight);
        }
    }
}

/// How much of the unit interval from `pixel` lies within [low, high].
#[inline]
fn overlap(pixel: i32, low: f32, high: f32) -> f32 {
    let left = f32_of_i32(pixel);
    clamp_exact(min_exact(left + 1.0, high) - max_exact(left, low), 0.0, 1.0)
}

fn splat_rectangle(light: &LightSums, center: Projected, half_px: f32, color: Vec3) {
    let left = center.x - half_px;
    let right = center.x + half_px;
    let top = center.y - half_px;
    let bottom = center.y + half_px;
    let last_y = (to_i32(bottom) + 1).min(light.height as i32);
    let last_x = (to_i32(right) + 1).min(light.width as i32);
    for y in to_i32(top).max(0)..last_y {
        let tall = overlap(y, top, bottom);
        for x in to_i32(left).max(0)..last_x {
            add_light(light, x, y, color, tall * overlap(x, left, right));
        }
    }
}

/// Adds the light of `particle`, as of the frame of `inputs`.
pub fn splat(particle: &Particle, inputs: &FrameInputs, rows: &[SystemRow], light: &LightSums) {
    let frame = &inputs.frame;
    let system = &inputs.systems[particle.slot() as usize];
    let (who, age) = identity_of(particle, inputs);
    let row = &rows[row_index(particle.slot(), who.birth_frame, frame.row_mask)];
    let look = appearance_of(who, row, age + 1);
    let [_, particle_shape, streak_light, _] = row.kinds;

    let position = Vec3::from(particle.position());
    let start = project(frame, system, position);
    let mut end = start;
    if particle_shape == PARTICLE_STREAK {
        let velocity = Vec3::from(particle.velocity());
        end = project(frame, system, position + velocity * frame.shutter);
    }
    if less(start.depth, frame.near) || less(end.depth, frame.near) {
        return;
    }
    let radius_px = min_exact(look.size * start.scale, MOST_RADIUS_PX);
    let reach = radius_px + 2.0;
    let width = f32_of_i32(light.width as i32);
    let height = f32_of_i32(light.height as i32);
    if less(max_exact(start.x, end.x) + reach, 0.0)
        || less(max_exact(start.y, end.y) + reach, 0.0)
        || less(width, min_exact(start.x, end.x) - reach)
        || less(height, min_exact(start.y, end.y) - reach)
    {
        return;
    }
    let color = look.color * (1.0 - look.transparency);
    if particle_shape == PARTICLE_RECTANGLE {
        splat_rectangle(light, start, radius_px, color);
        return;
    }
    let conserved = particle_shape != PARTICLE_STREAK || streak_light != STREAK_CONSTANT;
    let broad_px = max_exact(radius_px, 0.5);
    let edge = (if conserved {
        edged_radius(radius_px)
    } else {
        broad_px
    }) + 0.5;
    if particle_shape != PARTICLE_STREAK && less(edge, SMALL_REACH_PX) {
        splat_small_disc(light, start, radius_px, edge, color);
    } else {
        splat_capsule(light, start, end, radius_px, edge, color, conserved);
    }
}
