//! What `motes bench` measures: that every pass is there with the work that it had, that counts are
//! reached, that kernels alone do theirs, and how the program answers. No time is held to a bound.

#[path = "../common/mod.rs"]
mod common;

mod alone;
mod passes;
mod program;
mod sweeps;

use motes::bench::{Budget, Target};
use motes::scene::Scene;

/// A small scene whose births are scaled to any count: 40 frames of 25 births each.
pub(crate) const SMALL: &str = r#"title = "Small"
frames = 60
seed = 3
steady_particles = 1000
[image]
width = 64
height = 36
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "cloud"
initial_mean_parts = 25
generation_shape = { kind = "sphere", radius = 1 }
speed = 0.01
lifetime = 40
color = [0.1, 0.2, 0.3]
size = 0.05
"#;

pub(crate) fn small() -> Scene {
    motes::scene::parse(SMALL, "small.toml", "small").expect("a good scene")
}

/// So many samples, no more and no fewer.
pub(crate) fn counted(frames: u32) -> Budget {
    Budget {
        frames: Some(frames),
        ..Budget::default()
    }
}

/// Every adapter under test, and the processor.
pub(crate) fn targets() -> Vec<Target> {
    let devices = common::adapters().into_iter();
    let devices = devices.map(|name| Target::Gpu(common::open(&name)));
    devices.chain([Target::Cpu]).collect()
}
