//! Particles for the splat alone: so many of one shape and size, all over a picture.

use super::error::BenchError;
use super::lane::Lane;
use super::target::Target;
use crate::cpu::disc::reach_of;
use crate::cpu::reach::edged_radius;
use crate::plan::FrameInputs;

/// Pixels across and down, as the shapes' tables assume.
pub(super) const SIZE_PX: [u32; 2] = [1280, 720];

/// A shape of particles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    pub(super) name: &'static str,
    /// Radius, or half the width of a streak, pixels.
    pub(super) radius_px: f32,
    /// How far it moves while the shutter is open, pixels; 0 for a disc.
    pub(super) length_px: f32,
    /// One of so many of the particles asked for, so that about as many pixels are covered.
    pub(super) share: u32,
}

pub(super) const SHAPES: &[Shape] = &[
    Shape {
        name: "splat_points",
        radius_px: 0.05,
        length_px: 0.0,
        share: 1,
    },
    Shape {
        name: "splat_discs_small",
        radius_px: 1.0,
        length_px: 0.0,
        share: 1,
    },
    Shape {
        name: "splat_discs_large",
        radius_px: 12.0,
        length_px: 0.0,
        share: 64,
    },
    Shape {
        name: "splat_streaks",
        radius_px: 0.6,
        length_px: 12.0,
        share: 4,
    },
];

impl Shape {
    /// Pixels that one covers on average, wholly or in part: those whose centres are within half a
    /// pixel of it. Its edge of one pixel's width keeps its area, and it is at least a pixel wide.
    pub(super) fn covered_px(&self) -> f64 {
        let reach = f64::from(reach_of(self.radius_px));
        let length = f64::from(self.length_px);
        std::f64::consts::PI * reach * reach + 2.0 * reach * length
    }

    /// The radius whose edge of a pixel's width keeps the area.
    pub(super) fn edged_radius_px(&self) -> f64 {
        edged_radius(self.radius_px).into()
    }

    /// In words.
    pub(super) fn about(&self) -> String {
        let (radius, covered) = (self.radius_px, self.covered_px());
        match self.length_px {
            0.0 => format!("radius {radius} px, {covered:.1} pixels each"),
            length => format!("{length} px long, half-width {radius} px, {covered:.1} pixels each"),
        }
    }

    /// One pixel is one world unit. All are born in the first frame and stay.
    fn scene(&self, particles: u32) -> String {
        let [width, height] = SIZE_PX;
        let Self {
            radius_px,
            length_px,
            ..
        } = self;
        // Streaks go up by two for each three to the right.
        let (x, y) = (0.83205 * length_px, 0.5547 * length_px);
        let kind = match *length_px {
            0.0 => "sphere",
            _ => "streak",
        };
        // A streak's particles are seen after one step, with the velocity that it has given them.
        format!(
            "frames = 1
[image]
width = {width}
height = {height}
shutter = 1
[camera]
position = [0, 0, 10]
target = [0, 0, 0]
projection = \"orthographic\"
view_height = {height}
[[system]]
name = \"splats\"
burst = [{{ frame = 0, parts = {particles} }}]
generation_shape = {{ kind = \"rectangle\", length = {width}, width = {height} }}
speed = 0
color = [0.011, 0.007, 0.003]
size = {radius_px}
acceleration = [{x}, {y}, 0]
particle_shape = \"{kind}\"
"
        )
    }

    /// A run that has stepped once, and what to draw it with.
    pub(super) fn lane(
        &self,
        target: &Target,
        particles: u32,
    ) -> Result<(Lane, FrameInputs), BenchError> {
        Lane::stepped_once(target, &self.scene(particles), ("splats", self.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_cover_as_many_pixels_as_they_say() {
        // So few that they hardly meet, whose lit pixels are counted one by one.
        for shape in SHAPES {
            let particles = (20_000.0 / shape.covered_px()) as u32;
            let (mut lane, inputs) = shape.lane(&Target::Cpu, particles).expect("it runs");
            lane.splat_ms(&inputs).expect("it draws");
            let light = lane.backend().read("light_low").expect("it has light");
            let lit = light.chunks(3).filter(|pixel| pixel[0] > 0).count() as f64;
            let expected = shape.covered_px() * f64::from(particles);
            let share = lit / expected;
            // Some meet, and some hang over the edge.
            assert!((0.93..1.02).contains(&share), "{}: {share}", shape.name);
        }
    }
}
