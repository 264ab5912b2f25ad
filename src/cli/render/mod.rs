//! `motes render`: a scene becomes pictures, an animation, statistics and dumps.

mod args;
mod frame;

mod job;
mod journal;
mod request;
mod series;
mod summary;
#[cfg(test)]
mod tests;

use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};

use super::interrupt::Interrupt;
use super::{CliError, note};
use crate::gpu::shader::sources;
use crate::output::{FrameSink, OutputTarget, StatsWriter, probe};
use crate::scene::Scene;
use crate::simulation::{self, AdapterChoice, Options, Simulation, SimulationError};
use job::{Job, Pictures};
use journal::{Finished, Journal};
use request::Request;
use summary::Summary;

pub(super) use args::RenderArgs;
#[cfg(feature = "view")]
pub(super) use args::parse_size;

/// Renders; the exit code: that of a shell for what was stopped, if it was asked to stop.
pub(super) fn run(args: RenderArgs) -> Result<u8, CliError> {
    let begun = Instant::now();
    let request = request::request(&args)?;
    let Request {
        scene,
        frames,
        target,
        ..
    } = &request;
    let interrupt = Interrupt::listen()?;
    let mut simulation = Simulation::new(
        scene,
        &Options {
            adapter: AdapterChoice::parse(&args.adapter),
            frame_end: frames.end,
            turns: request.turns.clone(),
            ..Options::default()
        },
    )
    .map_err(|error| match error {
        SimulationError::Plan(error) => CliError::of_plan(&error, &args.scene),
        error => error.into(),
    })?;
    let turned = request.turns.iter().map(|turn| &turn.scene);
    super::tell_notes(std::iter::once(scene).chain(turned));
    say_where(&args, &simulation, scene);
    say_what_is_beyond(&request);
    // First of all outputs, so that it knows who began what is left of them.
    let has_files = !target.is_animation() && frames.len() > 1;
    let kept = if args.resume || has_files {
        journal(&args, &request, &simulation)?
    } else {
        None
    };
    let (journal, finished) = kept.map_or((None, Finished::default()), |(journal, finished)| {
        (Some(journal), finished)
    });
    if args.no_clobber {
        request::refuse_to_replace(&args, &request, &finished)?;
    }
    for frame in &request.dumps {
        for path in request.dumps_of(*frame) {
            probe(&path)?;
        }
    }
    let pictures = match target {
        OutputTarget::Svg(path) => {
            probe(path)?;
            Pictures::Lines(path.clone())
        }
        target => Pictures::Frames(FrameSink::open(
            target,
            scene.image.width,
            scene.image.height,
            f64::from(scene.frame_rate),
            frames.len() as u32,
        )?),
    };
    let mut job = Job {
        pictures,
        request: &request,
        stats: args.stats.as_deref().map(StatsWriter::create).transpose()?,
        journal,
        snapshot_every: Duration::from_secs_f64(args.snapshot_every),
        keeps_states: true,
        interrupt: &interrupt,
    };
    let summary = job.render(&mut simulation, &finished);
    let summary = summary.map_err(|error| job.told(error))?;
    if let Some((next, code)) = summary.stopped {
        let Range { start, end } = frames;
        note!("motes: stopped before frame {next} of {start}..{end}");
        if job.can_go_on() {
            note!("motes: the same command with --resume goes on from there");
        } else {
            let how = match job.journal {
                Some(_) => "no frame was finished",
                None => "with --resume from the beginning, frames are kept to go on from",
            };
            note!("motes: nothing is kept of it: {how}");
        }
        return Ok(code);
    }
    let written = job.finish()?;
    if written.left_out > 0 {
        note!(
            "motes: {} frames were left out to keep the animation's speed: a GIF shows at most 50 a second",
            written.left_out
        );
    }
    say_what_went_wrong(&summary, &simulation);
    // As it was asked for: a pattern's own path would be that of frame 0, drawn or not.
    let place = args
        .output
        .unwrap_or_else(|| target.path().display().to_string());
    let count = match frames.len() {
        1 => format!("frame {}", frames.start),
        count => format!("{count} frames"),
    };
    let secs = begun.elapsed().as_secs_f64();
    note!(
        "motes: wrote {place}: {count} of {}x{} pixels in {secs:.1} s",
        scene.image.width,
        scene.image.height
    );
    Ok(0)
}

/// What tells this run from all that write other files.
fn identity(args: &RenderArgs, request: &Request, simulation: &Simulation) -> u64 {
    let Request {
        scene,
        frames,
        target,
        dump_dir,
        recording,
        ..
    } = request;
    // Whatever changes the bits of a picture changes its kernels.
    let kernels = sources::KERNELS.iter().chain(sources::LIBRARIES);
    let kernels: String = kernels.map(|source| source.text).collect();
    let kernels = journal::digest_of(kernels.as_bytes());
    let version = env!("CARGO_PKG_VERSION");
    let outputs = (
        frames,
        target,
        args.layers,
        &args.stats,
        &args.dump,
        dump_dir,
    );
    // All exact adapters make the same files.
    let adapter = (!simulation.is_exact()).then(|| simulation.adapter_name());
    let all = format!("{version} {kernels} {scene:?} {recording:?} {outputs:?} {adapter:?}");
    journal::digest_of(all.as_bytes())
}

/// The run's journal: a new one, or that of a stopped run to go on from. `None` where the output is
/// no file.
fn journal(
    args: &RenderArgs,
    request: &Request,
    simulation: &Simulation,
) -> Result<Option<(Journal, Finished)>, CliError> {
    let Some(folder) = journal::place(&request.target, &request.frames) else {
        if args.resume {
            return Err(CliError::usage(
                format!(
                    "{} is no file to go on with",
                    request.target.path().display()
                ),
                "leave out --resume, or give a file after -o",
            ));
        }
        return Ok(None);
    };
    let identity = identity(args, request, simulation);
    let (pictures_folder, _) = request.target.folder_and_name();
    let stats_folder = args.stats.as_deref().and_then(Path::parent);
    let mut outputs = vec![pictures_folder.as_path(), &request.dump_dir];
    outputs.extend(stats_folder);
    if args.resume
        && let Some((journal, finished)) = Journal::resume(&folder, identity, &outputs)?
    {
        let count = finished.count();
        note!("motes: going on after {count} finished frames");
        return Ok(Some((journal, finished)));
    }
    if args.resume {
        note!("motes: no stopped run of this is here; beginning with its first frame");
    }
    let journal = Journal::begin(&folder, identity, &outputs)?;
    Ok(Some((journal, Finished::default())))
}

fn say_where(args: &RenderArgs, simulation: &Simulation, scene: &Scene) {
    let adapter = simulation.adapter_name();
    if AdapterChoice::parse(&args.adapter) == AdapterChoice::Auto && adapter.starts_with("cpu") {
        let why = if simulation::adapters().is_empty() {
            "there is no graphics adapter here"
        } else {
            "no graphics adapter here has room for this scene"
        };
        note!("motes: {why}; the processor makes the same bits");
    }
    note!("motes: {} on {adapter}", scene.name);
}

/// What is asked for beyond an end, and is therefore not what it may seem.
fn say_what_is_beyond(request: &Request) {
    let (end, lasts) = (request.frames.end, request.scene.frames);
    if end > lasts {
        note!("motes: the scene lasts {lasts} frames; those after show how it goes on");
    }
    let late = request.recording.changes.iter().find(|it| it.frame >= end);
    if let Some(change) = late {
        note!(
            "motes: changes from frame {} on come too late for frames up to {end}",
            change.frame
        );
    }
}

fn say_what_went_wrong(summary: &Summary, simulation: &Simulation) {
    if summary.dropped > 0 {
        note!(
            "motes: {} births were dropped for want of room; raise the scene's `capacity` ({})",
            summary.dropped,
            simulation.plan().capacity
        );
    }
    if !summary.lit {
        let why = match summary.most_live {
            0 => "no particle was alive in them: look at births and frames".to_owned(),
            live => format!(
                "up to {live} particles were alive, but dark, too small or out of the camera's sight"
            ),
        };
        note!("motes: there is nothing to see in these pictures: {why}");
    }
}
