//! What is written of one frame: its rows of statistics, its picture.

use crate::cli::CliError;
use crate::layout::FrameStats;
use crate::output::{LinearImage, Measured, ParticleCounts, Picture, Pixels, Rgba8Image, StatsRow};
use crate::scene::Scene;
use crate::simulation::Simulation;

/// The rows of a frame: its state's and its picture's.
pub(super) fn rows_of(line: &FrameStats, (state, image): (u64, u64)) -> Vec<String> {
    let counts = ParticleCounts {
        requested: line.requested.into(),
        born: line.born.into(),
        died: line.died.into(),
        live: line.live.into(),
        dropped: line.dropped.into(),
        died_of_intensity: line.died_of_intensity.into(),
        died_of_bounds: line.died_of_bounds.into(),
    };
    [
        ("particles", Measured::Particles(counts), state),
        ("image", Measured::Image, image),
    ]
    .map(|(population, measured, digest)| {
        let row = StatsRow {
            frame: line.frame,
            population,
            measured,
            digest: Some(digest),
        };
        row.to_line()
    })
    .into()
}

/// The image drawn last, in the form that its file takes; `what` of the scene it shows.
pub(super) fn picture_of(
    simulation: &mut Simulation,
    scene: &Scene,
    pixels: Pixels,
    what: &str,
) -> Result<Picture, CliError> {
    let (width, height) = (scene.image.width, scene.image.height);
    Ok(match pixels {
        Pixels::Bytes => Picture::Bytes(Rgba8Image {
            width,
            height,
            pixels: simulation.image()?,
        }),
        Pixels::Linear => Picture::Linear(LinearImage {
            width,
            height,
            pixels: simulation.radiance()?,
            is_layer: false,
            hidden: Vec::new(),
            comment: format!("{}, seed {}, {what}", scene.name, scene.seed),
        }),
    })
}
