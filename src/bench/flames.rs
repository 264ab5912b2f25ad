//! Flames for their drawing alone: so many of one size, straight and all over a picture, and what the same
//! fans of triangles are to the device's own rasteriser.

use super::error::BenchError;
use super::lane::Lane;
use super::splats::SIZE_PX;
use super::target::Target;
use crate::layout::FLAME_STEPS;
use crate::plan::FrameInputs;

/// Pixels of the half-axes of the ellipse that flames stand in.
pub(super) const FIELD_PX: [f64; 2] = [500.0, 353.553];

/// Flames of a size.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlameSize {
    pub(super) name: &'static str,
    /// The same as the device's rasteriser draws it, blended into 16-bit and into 32-bit floats.
    pub(super) rasters: [&'static str; 2],
    /// How wide, before what its ages scale it by, pixels; it is three times as high.
    pub(super) width_px: u32,
    /// One particle along a flame of so many of the particles asked for.
    pub(super) share: u32,
}

pub(super) const FLAME_SIZES: &[FlameSize] = &[
    FlameSize {
        name: "flames_8_px",
        rasters: ["raster_fans_8_px_half", "raster_fans_8_px_single"],
        width_px: 8,
        share: 16,
    },
    FlameSize {
        name: "flames_32_px",
        rasters: ["raster_fans_32_px_half", "raster_fans_32_px_single"],
        width_px: 32,
        share: 64,
    },
    FlameSize {
        name: "flames_128_px",
        rasters: ["raster_fans_128_px_half", "raster_fans_128_px_single"],
        width_px: 128,
        share: 1024,
    },
];

impl FlameSize {
    /// Flames for so many particles asked for.
    pub(super) fn flames(&self, particles: u32) -> u32 {
        (particles / (self.share * FLAME_STEPS)).max(1)
    }

    /// Pixels from the root to the tip.
    pub(super) fn height_px(&self) -> f64 {
        3.0 * f64::from(self.width_px)
    }

    /// Pixels that the 25 fans of a flame cover, one by one.
    pub(super) fn covered_px(&self) -> f64 {
        // Of a regular polygon of 20 corners on the unit circle.
        let area = 10.0 * (std::f64::consts::TAU / 20.0).sin();
        let half = 0.5 * f64::from(self.width_px);
        let fan = |age: u32| {
            let age = f64::from(age);
            let across = 0.67 + 0.4 * (std::f64::consts::PI * age / 24.0).sin();
            area * half * across * half * (0.3 + 0.032 * age)
        };
        (0..FLAME_STEPS).map(fan).sum()
    }

    /// In words.
    pub(super) fn about(&self) -> String {
        format!(
            "{} px wide, {:.0} pixels each, fan by fan",
            self.width_px,
            self.covered_px()
        )
    }

    /// One pixel is one world unit; the eye looks down by 45 degrees, so that what is upright is seen
    /// 1 / sqrt(2) as high.
    fn scene(&self, particles: u32) -> String {
        let [width, height] = SIZE_PX;
        let [radius, _] = FIELD_PX;
        let upright = self.height_px() * std::f64::consts::SQRT_2;
        format!(
            "frames = 1
[image]
width = {width}
height = {height}
[camera]
position = [0, 2000, 2000]
target = [0, 0, 0]
projection = \"orthographic\"
view_height = {height}
[[fire]]
name = \"flames\"
roots = {{ kind = \"disc\", radius = {radius}, count = {} }}
height = {upright}
width = {}
noisiness = 0
lights = 0
brightness = 0.1
",
            self.flames(particles),
            self.width_px
        )
    }

    /// A run that has stepped once, and what to draw it with.
    pub(super) fn lane(
        &self,
        target: &Target,
        particles: u32,
    ) -> Result<(Lane, FrameInputs), BenchError> {
        Lane::stepped_once(target, &self.scene(particles), ("flames", self.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::FlameDisc;
    use crate::plan::Stage;

    #[test]
    fn flames_cover_as_many_pixels_as_they_say_and_stand_in_the_field() {
        for size in FLAME_SIZES {
            let flames = 40;
            let particles = flames * size.share * FLAME_STEPS;
            let (mut lane, inputs) = size.lane(&Target::Cpu, particles).expect("it runs");
            lane.stages_ms(&[Stage::FlameDiscs, Stage::Glow], &inputs)
                .expect("it draws");
            let words = lane
                .backend()
                .read("flame_discs")
                .expect("it has particles");
            let discs: Vec<FlameDisc> = bytemuck::pod_collect_to_vec(&words);
            assert_eq!(discs.len() as u32, flames * FLAME_STEPS, "{}", size.name);
            let place = |disc: &FlameDisc| disc.place.map(|bits| f64::from(f32::from_bits(bits)));
            let area = |disc: &FlameDisc| {
                let [_, _, across, along] = place(disc);
                3.0902 / (across * along)
            };
            let covered: f64 = discs.iter().map(area).sum::<f64>() / f64::from(flames);
            let share = covered / size.covered_px();
            // Nothing is drawn narrower than three pixels, as the lowest and highest would be.
            assert!((0.99..1.1).contains(&share), "{}: {share}", size.name);
            for flame in discs.chunks(FLAME_STEPS as usize) {
                let [x, y, ..] = place(&flame[0]);
                let (across, down) = ((x - 640.0) / FIELD_PX[0], (y - 360.0) / FIELD_PX[1]);
                assert!(across * across + down * down < 1.0001, "{x}, {y}");
                let [_, tip, ..] = place(&flame[24]);
                assert!(((y - tip) / size.height_px() - 1.0).abs() < 1e-3);
            }
        }
    }
}
