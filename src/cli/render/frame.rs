//! What is written of one frame: its rows of statistics, its dumps, its picture.

use std::path::Path;

use crate::cli::CliError;
use crate::layout::FrameStats;
use crate::output::{
    BoidCounts, FlameCounts, LinearImage, MarkCounts, Measured, ParticleCounts, Picture, Pixels,
    PointCounts, Rgba8Image, StatsRow, SystemCounts, dump_path, write_boids, write_flames,
    write_particles, write_points,
};
use crate::plan::Population;
use crate::scene::Scene;
use crate::simulation::Simulation;

/// The rows of a frame, whose line of statistics is given: its populations', its flocks' and its
/// picture's.
pub(super) fn rows_of(
    simulation: &mut Simulation,
    line: &FrameStats,
) -> Result<Vec<String>, CliError> {
    let counts = ParticleCounts {
        requested: line.requested.into(),
        born: line.born.into(),
        died: line.died.into(),
        live: line.live.into(),
        dropped: line.dropped.into(),
        died_of_intensity: line.died_of_intensity.into(),
        died_of_bounds: line.died_of_bounds.into(),
    };
    let systems = SystemCounts {
        requested: line.systems_requested.into(),
        born: line.systems_born.into(),
        died: line.systems_died.into(),
        live: line.systems_live.into(),
    };
    let plan = simulation.plan();
    let begins = line.frame == plan.first_frame.cast_unsigned();
    let boids = BoidCounts {
        born: if begins { plan.boid_count.into() } else { 0 },
        live: plan.boid_count.into(),
    };
    let [born, died, live] = plan.flames_at(line.frame.cast_signed()).map(u64::from);
    let flames = FlameCounts {
        requested: born + u64::from(line.flames_requested),
        born: born + u64::from(line.flames_born),
        died: died + u64::from(line.flames_died),
        live: live + u64::from(line.flames_live),
    };
    let points = PointCounts {
        requested: line.points_requested.into(),
        born: line.points_born.into(),
        died: line.points_died.into(),
        live: line.points_live.into(),
    };
    let has_marks = plan.uses.marks;
    let populations: Vec<Population> = plan.populations().collect();
    let mut rows = Vec::new();
    let mut row = |population, measured, digest| {
        let row = StatsRow {
            frame: line.frame,
            population,
            measured,
            digest,
        };
        rows.push(row.to_line());
    };
    for population in populations {
        let measured = match population {
            Population::Systems => Measured::Systems(systems),
            Population::Boids => Measured::Boids(boids),
            Population::Flames => Measured::Flames(flames),
            Population::Points => Measured::Points(points),
            _ => Measured::Particles(counts),
        };
        let digest = simulation.population_digest(population)?;
        row(population.name(), measured, Some(digest));
    }
    let metrics = simulation.flock_metrics()?;
    let image_digest = simulation.image_digest()?;
    for (name, metrics) in simulation.plan().flock_names().zip(metrics) {
        let born = if begins { metrics.count.into() } else { 0 };
        row(name, Measured::Flock { born, metrics }, None);
    }
    if has_marks {
        let marks = MarkCounts {
            born: line.flames_died.into(),
            died: line.marks_died.into(),
            live: line.marks_live.into(),
        };
        row("char", Measured::Marks(marks), None);
    }
    row("image", Measured::Image, Some(image_digest));
    Ok(rows)
}

/// Dumps these populations of the scene.
pub(super) fn dump(
    simulation: &mut Simulation,
    populations: &[Population],
    dir: &Path,
    frame: u32,
) -> Result<(), CliError> {
    for population in populations {
        let path = dump_path(dir, population.name(), frame);
        match population {
            Population::Boids => write_boids(&path, &simulation.boids()?)?,
            Population::Flames => write_flames(&path, &simulation.flames()?)?,
            Population::Points => write_points(&path, &simulation.control_points()?)?,
            Population::Particles => write_particles(&path, &simulation.particles()?)?,
            // No file has their records, and nobody asks for it.
            Population::Systems => {}
        }
    }
    Ok(())
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
