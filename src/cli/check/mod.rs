//! `motes check`: whether an adapter makes the same bits as the processor, or as another adapter.

mod json;
mod junit;
mod side;
#[cfg(test)]
mod tests;

use std::path::PathBuf;
use std::time::Instant;

use super::collisions::{self, Input, Output};
use super::names::SceneName;
use super::{CliError, note, print, progress_bar};
use crate::check::{self, CompareOptions, Outcome, SavedFor, compare, default_frames, shrunk};
use crate::output::{probe, write_whole};
use crate::plan::{Plan, PlanError};
use crate::scene::{BUILTIN, Loader};
use side::Side;

/// Arguments of `motes check`.
#[derive(Debug, clap::Args)]
pub(super) struct CheckArgs {
    /// TOML files, or names of built-in scenes [default: every built-in scene]
    #[arg(value_name = "SCENE", value_parser = SceneName, hide_possible_values = true)]
    scenes: Vec<String>,
    /// Frames of each scene, from 0 [default: enough to see births and deaths; all with --full]
    #[arg(long, value_name = "N", value_parser = parse_frames, allow_hyphen_values = true)]
    frames: Option<u32>,
    /// The adapter under test: auto, cpu, or part of an adapter's name
    #[arg(long, value_name = "A", env = "MOTES_ADAPTER", default_value = "auto")]
    adapter: String,
    /// What it is compared with: cpu, or part of an adapter's name
    #[arg(long, value_name = "A", default_value = "cpu")]
    against: String,
    /// Scenes as they are; without it, at most 320x180 and about 20,000 particles
    #[arg(long)]
    full: bool,
    /// Let scenes read files outside of their folders
    #[arg(long)]
    allow_outside: bool,
    /// Save what differs in a folder here: kernels, inputs, expected and got
    #[arg(long, value_name = "DIR")]
    save: Option<PathBuf>,
    /// Write the results as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

fn parse_frames(text: &str) -> Result<u32, String> {
    let frames = text.trim().parse().ok();
    frames
        .filter(|frames| (1..=1_000_000).contains(frames))
        .ok_or_else(|| "frames are a whole number from 1 to 1000000, e.g. 24".to_owned())
}

/// A scene, ready to be run on any side.
struct Job {
    /// As the user called it.
    asked: String,
    name: String,
    plan: Plan,
    frames: u32,
}

/// What became of a scene.
struct Checked {
    scene: String,
    duration_secs: f64,
    /// The message of a machine that failed.
    outcome: Result<Outcome, String>,
    saved: Option<PathBuf>,
}

/// The whole run, for its reports.
struct Report {
    tested: Side,
    against: Side,
    scenes: Vec<Checked>,
    /// Letters of the longest name, or more.
    name_width: usize,
}

impl Report {
    fn is_equal(&self) -> bool {
        self.scenes
            .iter()
            .all(|checked| checked.outcome.as_ref().is_ok_and(Outcome::is_equal))
    }
}

pub(super) fn run(args: &CheckArgs) -> Result<u8, CliError> {
    let jobs = jobs(args)?;
    for path in [&args.json, &args.junit].into_iter().flatten() {
        probe(path)?;
    }
    let (tested, against) = side::both(&args.adapter, &args.against)?;
    check_all(args, &jobs, tested, against)
}

/// Refuses reports that cannot be written, before the scenes are run for nothing.
fn places(args: &CheckArgs, inputs: &[Input]) -> Result<(), CliError> {
    let mut outputs = Output::given([("--json", &args.json), ("--junit", &args.junit)]);
    for output in &outputs {
        super::refuse_folder(output.what(), output.path())?;
    }
    if let Some(file) = args.save.as_deref().filter(|path| path.is_file()) {
        return Err(CliError::usage(
            format!("--save needs a folder, and {} is a file", file.display()),
            "name a folder, which is made if it is not there",
        ));
    }
    let folder = args.save.iter();
    outputs.extend(folder.map(|folder| Output::folder("--save", folder)));
    collisions::refuse(&outputs, inputs)
}

/// Checks the scenes and writes the reports; the exit code.
fn check_all(args: &CheckArgs, jobs: &[Job], tested: Side, against: Side) -> Result<u8, CliError> {
    note!(
        "motes: checking {} against {}",
        tested.name(),
        against.name()
    );
    let mut report = Report {
        tested,
        against,
        scenes: Vec::new(),
        name_width: jobs
            .iter()
            .map(|job| job.name.chars().count())
            .max()
            .unwrap_or(0)
            .max(16),
    };
    let mut failure = None;
    for job in jobs {
        if let Err(error) = check_scene(args, job, &mut report) {
            failure = Some(error);
            break;
        }
    }
    // Whoever reads the reports is to see the failure, too.
    if let Some(path) = &args.json {
        write_whole(path, json::json(&report).as_bytes())?;
    }
    if let Some(path) = &args.junit {
        write_whole(path, junit::junit(&report).as_bytes())?;
    }
    match failure {
        Some(error) => Err(error),
        None => Ok(u8::from(!report.is_equal())),
    }
}

/// Reads and plans every scene before the first is run.
fn jobs(args: &CheckArgs) -> Result<Vec<Job>, CliError> {
    let asked = if args.scenes.is_empty() {
        BUILTIN.iter().map(|scene| scene.name.to_owned()).collect()
    } else {
        args.scenes.clone()
    };
    let loader = Loader {
        allow_outside: args.allow_outside,
    };
    let mut inputs = Vec::new();
    let mut scenes = Vec::new();
    for asked in asked {
        let draft = loader.draft(&asked, &[])?;
        scenes.push((asked, draft.scene()?));
        inputs.extend(draft.files());
    }
    places(args, &inputs)?;
    super::tell_notes(scenes.iter().map(|(_, scene)| scene));
    scenes
        .into_iter()
        .map(|(asked, mut scene)| {
            let all = if args.full {
                scene.frames
            } else {
                default_frames(&scene)
            };
            let frames = args.frames.unwrap_or(all);
            let refused = |error: PlanError| CliError::of_plan(&error, loader, &asked, &[]);
            if !args.full {
                scene = shrunk(&scene, frames).map_err(refused)?;
            }
            let plan = Plan::new(&scene, frames).map_err(refused)?;
            Ok(Job {
                asked,
                name: scene.name,
                plan,
                frames,
            })
        })
        .collect()
}

/// Checks one scene, tells about it and puts it into the report.
fn check_scene(args: &CheckArgs, job: &Job, report: &mut Report) -> Result<(), CliError> {
    let bar = progress_bar(job.frames.into(), "frames");
    let begun = Instant::now();
    let result = compare(
        &job.plan,
        &mut || report.against.start(&job.plan),
        &mut || report.tested.start(&job.plan),
        &CompareOptions {
            frames: job.frames,
            record: args.save.is_some(),
        },
        &mut |_| bar.inc(1),
    );
    bar.finish_and_clear();
    let duration_secs = begun.elapsed().as_secs_f64();
    let scene = job.name.clone();
    let outcome = match result {
        Ok(outcome) => outcome,
        Err(error) => {
            let outcome = Err(error.to_string());
            report.scenes.push(Checked {
                scene,
                duration_secs,
                outcome,
                saved: None,
            });
            return Err(error.into());
        }
    };
    let mut text = line(&scene, report.name_width, &outcome);
    let mut saved = Ok(None);
    if let Some(difference) = &outcome.difference {
        for line in difference.to_string().lines() {
            text += &format!("    {line}\n");
        }
        saved = args
            .save
            .as_deref()
            .map(|folder| {
                check::save(
                    folder,
                    difference,
                    &SavedFor {
                        scene: &scene,
                        tested: &report.tested.description(),
                        against: &report.against.description(),
                        command: &command(args, job),
                    },
                )
            })
            .transpose();
        if let Ok(Some(path)) = &saved {
            text += &format!("    saved:   {}\n", path.display());
        }
    }
    if outcome.most_particles == 0 {
        note!("motes: no particle of {scene} ever lived: take more --frames");
    }
    let checked = Checked {
        scene,
        duration_secs,
        outcome: Ok(outcome),
        saved: saved.as_ref().ok().cloned().flatten(),
    };
    report.scenes.push(checked);
    print(&text)?;
    saved.map(|_| ()).map_err(CliError::from)
}

/// The scene's line on standard output.
fn line(scene: &str, width: usize, outcome: &Outcome) -> String {
    let Outcome {
        frames,
        most_particles,
        state_digest,
        image_digest,
        dropped,
        ..
    } = outcome;
    let verdict = if outcome.is_equal() {
        "equal"
    } else {
        "DIFFERS"
    };
    let dropped = match dropped {
        0 => String::new(),
        births => format!("  ({births} births dropped)"),
    };
    format!(
        "{scene:<width$} {frames:>4} frames  {most_particles:>9} particles  state {state_digest:016x}  \
         image {image_digest:016x}  {verdict}{dropped}\n"
    )
}

/// The command that checks this scene again.
fn command(args: &CheckArgs, job: &Job) -> String {
    let full = if args.full { " --full" } else { "" };
    let outside = match args.allow_outside {
        true => " --allow-outside",
        false => "",
    };
    // As a shell reads it, where a quoted text ends at the first apostrophe.
    let quoted = |text: &str| format!("'{}'", text.replace('\'', "'\\''"));
    let (scene, frames) = (quoted(&job.asked), job.frames);
    let (adapter, against) = (quoted(&args.adapter), quoted(&args.against));
    format!(
        "motes check {scene} --frames {frames} --adapter {adapter} --against {against}{full}{outside}"
    )
}
