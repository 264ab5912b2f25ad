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
use std::path::{Path, PathBuf};
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
        SimulationError::Plan(error) => {
            CliError::of_plan(&error, args.loader(), &args.scene, &request::sets(&args))
        }
        error => error.into(),
    })?;
    let turned = request.turns.iter().map(|turn| &turn.scene);
    super::tell_notes(std::iter::once(scene).chain(turned));
    say_where(&args, &simulation, scene);
    say_what_is_beyond(&request);
    let mut kept = resumed(&args, &request, &simulation)?;
    if args.no_clobber {
        let none = Finished::default();
        let finished = kept.as_ref().map_or(&none, |(_, finished)| finished);
        request::refuse_to_replace(&args, &request, finished)?;
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
    let stats = args.stats.as_deref().map(StatsWriter::create).transpose()?;
    // When nothing is in its way any more: what a stopped run had noted is lost by it.
    let has_files = !target.is_animation() && frames.len() > 1;
    if kept.is_none() && (args.resume || has_files) {
        let journal = new_journal(&args, &request, &simulation)?;
        kept = journal.map(|journal| (journal, Finished::default()));
    }
    // Who begins anew will not go on.
    let kept_none = kept.is_none();
    let (journal, finished) = kept.map_or((None, Finished::default()), |(journal, finished)| {
        (Some(journal), finished)
    });
    if kept_none && let Some(folder) = journal::place(target, frames) {
        Journal::forget(&folder);
    }
    let mut job = Job {
        pictures,
        request: &request,
        stats,
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

/// Where the outputs of a run are.
fn folders(args: &RenderArgs, request: &Request) -> Vec<PathBuf> {
    let (pictures, _) = request.target.folder_and_name();
    let stats = args.stats.as_deref().and_then(Path::parent);
    let stats = stats.map(Path::to_owned);
    let always = [pictures, request.dump_dir.clone()];
    always.into_iter().chain(stats).collect()
}

/// The journal of a stopped run to go on from, and what it says; `None` where there is none, or is
/// not to be.
fn resumed(
    args: &RenderArgs,
    request: &Request,
    simulation: &Simulation,
) -> Result<Option<(Journal, Finished)>, CliError> {
    if !args.resume {
        return Ok(None);
    }
    let Some(folder) = journal::place(&request.target, &request.frames) else {
        let path = request.target.path();
        return Err(CliError::usage(
            format!("{} is no file to go on with", path.display()),
            "leave out --resume, or give a file after -o",
        ));
    };
    let identity = identity(args, request, simulation);
    let found = Journal::resume(&folder, identity, &folders(args, request))?;
    match &found {
        Some((_, finished)) => {
            let count = finished.count();
            note!("motes: going on after {count} finished frames");
        }
        None => note!("motes: no stopped run of this is here; beginning with its first frame"),
    }
    Ok(found)
}

/// A new journal, in place of any that there is; `None` where the output is no file.
fn new_journal(
    args: &RenderArgs,
    request: &Request,
    simulation: &Simulation,
) -> Result<Option<Journal>, CliError> {
    let Some(folder) = journal::place(&request.target, &request.frames) else {
        return Ok(None);
    };
    let identity = identity(args, request, simulation);
    Journal::begin(&folder, identity, &folders(args, request)).map(Some)
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
    let plan = simulation.plan();
    let [births, systems, points, flames] = summary.roomless;
    if births > 0 {
        note!(
            "motes: {births} births were dropped for want of room; raise the scene's `capacity` ({})",
            plan.capacity
        );
    }
    if systems > 0 {
        note!(
            "motes: {systems} systems found no room, and bore nothing; raise the scene's `max_systems` ({})",
            plan.system_count - plan.own_system_count
        );
    }
    if points > 0 {
        note!(
            "motes: {points} control points found no room; raise `max_points` of the fires that spread"
        );
    }
    // Fires that spread without flames ask for no room.
    if flames > 0 && plan.dropped_capacity > 0 {
        note!(
            "motes: {flames} flames found no room; raise `max_flames` of the fires that spread, or their \
             `drop_distance`"
        );
    }
    if !summary.lit {
        let why = match summary.most_live {
            0 => "nothing was alive in them: look at births and frames".to_owned(),
            live => {
                let who = match (plan.boid_count, plan.flame_count) {
                    (count, _) if count == live => "boids",
                    (_, count) if count == live => "flames",
                    _ if summary.most_points == live => "control points",
                    _ => "particles",
                };
                format!(
                    "up to {live} {who} were alive, but dark, too small or out of the camera's sight"
                )
            }
        };
        note!("motes: there is nothing to see in these pictures: {why}");
    }
}
