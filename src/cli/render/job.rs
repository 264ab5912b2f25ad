//! What is written while frames go by.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::cli::{CliError, progress_bar};
use crate::layout::FrameStats;
use crate::output::{
    Drawing, FrameSink, LinearImage, Measured, OutputTarget, ParticleCounts, ParticleRecord,
    Picture, Pixels, Rgba8Image, StatsRow, StatsWriter, Written, dump_path, write_particles,
    write_svg,
};
use crate::scene::Scene;
use crate::simulation::Simulation;

/// Where the pictures go.
pub(super) enum Pictures {
    /// Frames of pixels.
    Frames(FrameSink),
    /// One frame of lines, in a file.
    Lines(PathBuf),
}

/// What is written while frames go by.
pub(super) struct Job<'a> {
    pub(super) pictures: Pictures,
    /// The output, if its frames' layers are written beside them.
    pub(super) layers_beside: Option<&'a OutputTarget>,
    pub(super) stats: Option<StatsWriter>,
    pub(super) dumps: &'a [u32],
    pub(super) dump_dir: &'a Path,
    pub(super) image_digests: BTreeMap<u32, u64>,
    pub(super) state_digests: BTreeMap<u32, u64>,
}

impl Job<'_> {
    /// Renders the frames; how many births were dropped.
    pub(super) fn run(
        &mut self,
        simulation: &mut Simulation,
        scene: &Scene,
        frames: &Range<u32>,
    ) -> Result<u64, CliError> {
        let first = simulation.plan().restart_frame(frames.start);
        let steps = i64::from(frames.end) - i64::from(first);
        let progress = progress_bar(steps as u32);
        let mut dropped = 0;
        // What is before frame 0 is stepped on the way to it.
        for frame in first.max(0).cast_unsigned()..frames.end {
            simulation.seek_from(first, frame)?;
            if frames.contains(&frame) {
                self.frame(simulation, scene, frame)?;
            }
            // Half of the ring: statistics are never lost, and seldom waited for.
            if frame % 100 == 99 || frame + 1 == frames.end {
                let lines = simulation.take_statistics()?;
                dropped += lines
                    .iter()
                    .map(|line| u64::from(line.dropped))
                    .sum::<u64>();
                self.write_stats(&lines, frames)?;
            }
            progress.set_position((i64::from(frame) - i64::from(first) + 1) as u64);
        }
        progress.finish_and_clear();
        Ok(dropped)
    }

    fn frame(
        &mut self,
        simulation: &mut Simulation,
        scene: &Scene,
        frame: u32,
    ) -> Result<(), CliError> {
        if let Some(target) = self.layers_beside {
            for (index, name) in simulation.layer_names().iter().enumerate() {
                simulation.draw_layer(index)?;
                let what = format!("frame {frame}, layer {name}");
                let layer = picture_of(simulation, scene, target.pixels(), &what)?.into_layer();
                if let Some(path) = target.layer_path(frame, name) {
                    layer.write(&path)?;
                }
            }
        }
        simulation.draw()?;
        match &mut self.pictures {
            Pictures::Frames(sink) => {
                let what = format!("frame {frame}");
                let picture = picture_of(simulation, scene, sink.pixels(), &what)?;
                sink.write_frame(frame, &picture)?;
            }
            Pictures::Lines(path) => {
                let lines = simulation.lines()?;
                let seen = simulation.frame_inputs().map(|inputs| inputs.frame);
                let [red, green, blue, _] = seen.map_or([0.0; 4], |frame| frame.background);
                let drawing = Drawing {
                    width: scene.image.width,
                    height: scene.image.height,
                    background: [red, green, blue],
                    exposure: seen.map_or(1.0, |frame| frame.exposure),
                    lines: &lines,
                };
                write_svg(path, &drawing)?;
            }
        }
        if self.stats.is_some() {
            self.state_digests.insert(frame, simulation.state_digest()?);
            self.image_digests.insert(frame, simulation.image_digest()?);
        }
        if self.dumps.contains(&frame) {
            let records: Vec<ParticleRecord> = simulation
                .particles()?
                .into_iter()
                .map(|p| ParticleRecord {
                    position: p.position,
                    velocity: p.velocity,
                    age: p.age,
                    lifetime: p.lifetime,
                    system: p.system,
                    id: p.id,
                })
                .collect();
            write_particles(&dump_path(self.dump_dir, "particles", frame), &records)?;
        }
        Ok(())
    }

    fn write_stats(&mut self, lines: &[FrameStats], frames: &Range<u32>) -> Result<(), CliError> {
        let Some(stats) = &mut self.stats else {
            return Ok(());
        };
        for line in lines.iter().filter(|line| frames.contains(&line.frame)) {
            stats.row(&StatsRow {
                frame: line.frame,
                population: "particles",
                measured: Measured::Particles(ParticleCounts {
                    requested: line.requested.into(),
                    born: line.born.into(),
                    died: line.died.into(),
                    live: line.live.into(),
                    dropped: line.dropped.into(),
                    died_of_intensity: line.died_of_intensity.into(),
                    died_of_bounds: line.died_of_bounds.into(),
                }),
                digest: self.state_digests.remove(&line.frame),
            })?;
            stats.row(&StatsRow {
                frame: line.frame,
                population: "image",
                measured: Measured::Image,
                digest: self.image_digests.remove(&line.frame),
            })?;
        }
        Ok(())
    }

    pub(super) fn finish(self) -> Result<Written, CliError> {
        let written = match self.pictures {
            Pictures::Frames(sink) => sink.finish()?,
            Pictures::Lines(_) => Written::default(),
        };
        if let Some(stats) = self.stats {
            stats.finish()?;
        }
        Ok(written)
    }
}

/// The image drawn last, in the form that its file takes; `what` of the scene it shows.
fn picture_of(
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
            comment: format!("{}, seed {}, {what}", scene.name, scene.seed),
        }),
    })
}
