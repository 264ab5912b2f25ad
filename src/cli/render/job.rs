//! What is written while frames go by.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::frame::{dump, picture_of, rows_of};
use super::journal::{Finished, Journal};
use super::request::Request;
use super::summary::Summary;
use crate::backend::BackendError;
use crate::cli::interrupt::Interrupt;
use crate::cli::{CliError, note, progress_bar};
use crate::output::{Drawing, FrameSink, Picture, StatsWriter, Written, write_svg};
use crate::simulation::{Simulation, SimulationError};

/// Steps between two looks at the statistics: less than half of their ring, so that none are lost
/// and the device is seldom waited for.
const STATISTICS_STEPS: i32 = 100;

/// A snapshot is due when this many times what the last one took have passed, at least.
const SNAPSHOT_SHARE: u32 = 20;

/// Where the pictures go.
pub(super) enum Pictures {
    /// Frames of pixels.
    Frames(FrameSink),
    /// One frame of lines, in a file.
    Lines(PathBuf),
    /// Nowhere any more.
    Done,
}

/// What is written while frames go by.
pub(super) struct Job<'a> {
    pub(super) pictures: Pictures,
    /// What is asked for.
    pub(super) request: &'a Request,
    pub(super) stats: Option<StatsWriter>,
    pub(super) journal: Option<Journal>,
    /// Time between two snapshots in the journal.
    pub(super) snapshot_every: Duration,
    /// Whether snapshots are kept: until one does not fit on the disk.
    pub(super) keeps_states: bool,
    pub(super) interrupt: &'a Interrupt,
}

impl Job<'_> {
    /// Renders the frames that are not `finished` yet.
    pub(super) fn render(
        &mut self,
        simulation: &mut Simulation,
        finished: &Finished,
    ) -> Result<Summary, CliError> {
        let frames = &self.request.frames;
        let mut summary = Summary {
            most_live: simulation
                .plan()
                .boid_count
                .max(simulation.plan().flame_count),
            ..Summary::default()
        };
        let next = self.take_over(finished, &mut summary)?;
        if next == frames.end || summary.stopped.is_some() {
            return Ok(summary);
        }
        let first = self.enter(simulation, next, &mut summary)?;
        let end = frames.end as i32;
        // What is stepped on the way goes by much quicker than what is drawn.
        let on_the_way = (i64::from(next) - i64::from(first)).max(0) as u64;
        let mut progress = progress_bar(on_the_way, "steps on the way");
        let mut snapshot_due = Instant::now() + self.snapshot_every;
        for frame in first..end {
            if let Some(code) = self.interrupt.exit_code() {
                progress.finish_and_clear();
                summary.stopped = Some((frame.max(next as i32).cast_unsigned(), code));
                return Ok(summary);
            }
            simulation.step()?;
            if frame == next as i32 {
                progress.finish_and_clear();
                progress = progress_bar(u64::from(frames.end - next), "frames");
            }
            let drawn = frame >= next as i32;
            if drawn {
                self.frame(simulation, frame.cast_unsigned(), &mut summary)?;
            } else if frame % STATISTICS_STEPS == 0 {
                summary.count(&simulation.take_statistics()?);
            }
            // Elsewhere a lifetime of frames, stepped anew, tells the state.
            let plan = simulation.plan();
            let is_long = plan.restart_frame(frame.max(0).cast_unsigned()) == plan.first_frame;
            if is_long && snapshot_due <= Instant::now() {
                let begun = Instant::now();
                self.keep_state(simulation, &mut summary)?;
                let rest = begun.elapsed() * SNAPSHOT_SHARE;
                snapshot_due = Instant::now() + self.snapshot_every.max(rest);
            }
            progress.inc(1);
        }
        progress.finish_and_clear();
        summary.count(&simulation.take_statistics()?);
        Ok(summary)
    }

    /// Puts the state into the journal, if there is one, and room for it.
    fn keep_state(
        &mut self,
        simulation: &mut Simulation,
        summary: &mut Summary,
    ) -> Result<(), CliError> {
        let Some(journal) = self.journal.as_mut().filter(|_| self.keeps_states) else {
            return Ok(());
        };
        let snapshot = match simulation.snapshot() {
            // A precaution that does not fit is left out.
            Err(SimulationError::Backend(BackendError::OutOfMemory(_))) => return Ok(()),
            snapshot => snapshot?,
        };
        summary.count(&simulation.take_statistics()?);
        if let Some(snapshot) = snapshot
            && let Err(error) = journal.keep_state(&snapshot, summary.roomless[0])
        {
            self.keeps_states = false;
            let why = error.message.trim_start_matches("error: ");
            note!("motes: no more snapshots of the state are kept: {why}");
        }
        Ok(())
    }

    /// Takes over what a stopped run had finished; the first frame that is left to do.
    fn take_over(&mut self, finished: &Finished, summary: &mut Summary) -> Result<u32, CliError> {
        let frames = &self.request.frames;
        for frame in frames.clone() {
            if let Some(code) = self.interrupt.exit_code() {
                summary.stopped = Some((frame, code));
                return Ok(frame);
            }
            let journal = self.journal.as_ref();
            let rows =
                journal.and_then(|journal| finished.rows(frame, &self.files_of(journal, frame)));
            let Some(rows) = rows else {
                return Ok(frame);
            };
            if let (Pictures::Frames(sink), Some(journal)) = (&mut self.pictures, &self.journal)
                && self.request.target.is_animation()
            {
                let Some(image) = journal.kept(frame) else {
                    return Ok(frame);
                };
                sink.write_frame(frame, &image)?;
            }
            // Whoever made it has seen to that.
            summary.lit = true;
            if let Some(stats) = &mut self.stats {
                for row in rows {
                    stats.line(row)?;
                }
            }
        }
        Ok(frames.end)
    }

    /// The files that a frame has to itself, with the one in the journal if all frames share one.
    fn files_of(&self, journal: &Journal, frame: u32) -> Vec<PathBuf> {
        let mut files = self.request.files_of(frame);
        if self.request.target.is_animation() {
            files.push(journal.kept_frame(frame));
        }
        files
    }

    /// Gets the simulation to where frame `next` can be reached from; the first frame to step.
    fn enter(
        &self,
        simulation: &mut Simulation,
        next: u32,
        summary: &mut Summary,
    ) -> Result<i32, CliError> {
        let first = simulation.plan().restart_frame(next);
        let kept = self.journal.as_ref().and_then(Journal::state);
        let useful = kept.filter(|(state, _)| (first..next as i32).contains(&state.frame()));
        // One that does not fit says nothing: the journal is of this run, so it is only damaged.
        if let Some((state, dropped)) = useful
            && simulation.restore(&state).is_ok()
        {
            summary.roomless[0] = dropped;
            let frame = state.frame();
            note!("motes: going on from the state after frame {frame}");
            return Ok(frame + 1);
        }
        simulation.begin_at(first);
        Ok(first)
    }

    fn frame(
        &mut self,
        simulation: &mut Simulation,
        frame: u32,
        summary: &mut Summary,
    ) -> Result<(), CliError> {
        let Request {
            scene,
            target,
            layers,
            dumps,
            dump_dir,
            populations,
            ..
        } = self.request;
        for (index, name) in layers.iter().enumerate() {
            simulation.draw_layer(index)?;
            let what = format!("frame {frame}, layer {name}");
            let pixels = target.pixels();
            let hidden = simulation.hidden()?;
            let layer = picture_of(simulation, scene, pixels, &what)?.into_layer_hiding(hidden);
            if let Some(path) = target.layer_path(frame, name) {
                layer.write(&path)?;
            }
        }
        simulation.draw()?;
        match &mut self.pictures {
            Pictures::Frames(sink) => {
                let what = format!("frame {frame}");
                let picture = picture_of(simulation, scene, sink.pixels(), &what)?;
                summary.look_at(&picture);
                sink.write_frame(frame, &picture)?;
                let kept = self.journal.as_ref().filter(|_| target.is_animation());
                if let (Some(journal), Picture::Bytes(image)) = (kept, &picture) {
                    journal.keep_frame(frame, image)?;
                }
            }
            Pictures::Lines(path) => {
                let lines = simulation.lines()?;
                summary.lit |= !lines.is_empty();
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
            Pictures::Done => {}
        }
        if dumps.contains(&frame) {
            dump(simulation, populations, dump_dir, frame)?;
        }
        let mut rows = Vec::new();
        if let Some(stats) = &mut self.stats {
            let lines = simulation.take_statistics()?;
            summary.count(&lines);
            if let Some(line) = lines.iter().rfind(|line| line.frame == frame) {
                rows = rows_of(simulation, line)?;
            }
            for row in &rows {
                stats.line(row)?;
            }
        } else if frame.cast_signed() % STATISTICS_STEPS == 0 {
            summary.count(&simulation.take_statistics()?);
        }
        let files = self.journal.as_ref();
        let files = files.map(|journal| self.files_of(journal, frame));
        match (&mut self.journal, files) {
            (Some(journal), Some(files)) => journal.frame_done(frame, &files, &rows),
            _ => Ok(()),
        }
    }

    /// Whether a run that ends here can go on.
    pub(super) fn can_go_on(&self) -> bool {
        let journal = self.journal.as_ref();
        journal.is_some_and(|journal| !journal.is_empty())
    }

    /// The error, and how to go on after it.
    pub(super) fn told(&self, mut error: CliError) -> CliError {
        if self.can_go_on() {
            error.message += "\n  = help: finished frames stay; the same command with --resume \
                              goes on after them";
        }
        error
    }

    /// Puts all files in their places.
    pub(super) fn finish(mut self) -> Result<Written, CliError> {
        let pictures = std::mem::replace(&mut self.pictures, Pictures::Done);
        let written = match pictures {
            Pictures::Frames(sink) => sink.finish(),
            Pictures::Lines(_) | Pictures::Done => Ok(Written::default()),
        };
        let stats = self.stats.take();
        let finished = written.and_then(|written| {
            stats.map_or(Ok(()), StatsWriter::finish)?;
            Ok(written)
        });
        let written = finished.map_err(|error| self.told(error.into()))?;
        if let Some(journal) = self.journal {
            journal.remove();
        }
        Ok(written)
    }
}
