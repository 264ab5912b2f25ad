//! `motes bench`: what each pass of a frame costs, as a share of what the adapter's memory can do.

use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::collisions::{self, Input, Output};
use super::interrupt::Interrupt;
use super::names::SceneName;
use super::{CliError, note, print};
use crate::bench::{self, BenchError, Budget, Progress, Record, Request, Target};
use crate::output::{probe, write_whole};
use crate::scene::{Loader, Scene, Set};
use crate::simulation::AdapterChoice;

/// What is measured where nobody says what.
const DEFAULT_SCENE: &str = "million";

/// How often progress is told, at most.
const TOLD_EVERY: Duration = Duration::from_millis(100);

/// Arguments of `motes bench`.
#[derive(Debug, clap::Args)]
pub(super) struct BenchArgs {
    /// TOML files, or names of built-in scenes [default: million; none with --micro]
    #[arg(value_name = "SCENE", value_parser = SceneName, hide_possible_values = true)]
    scenes: Vec<String>,
    /// Measure kernels alone: copies, reads, atomics, noise, scan, splats, flames, the rasteriser
    #[arg(long)]
    micro: bool,
    /// How many particles live, e.g. 1e5,1e6: scenes with `steady_particles` are scaled to them, and
    /// scenes of flocks alone to as many boids, of fires alone to as many flames
    #[arg(long, value_name = "N,N,…", value_delimiter = ',', value_parser = parse_particles, allow_hyphen_values = true)]
    particles: Vec<u32>,
    /// Frames to measure [default: until the noise is low enough]
    #[arg(long, value_name = "N", value_parser = parse_frames, allow_hyphen_values = true)]
    frames: Option<u32>,
    /// How uncertain the median of a frame may be, percent
    #[arg(long, value_name = "PERCENT", value_parser = parse_noise, default_value = "1", allow_hyphen_values = true, conflicts_with = "frames")]
    noise: f64,
    /// Seconds after which a scene is measured no longer
    #[arg(long, value_name = "S", value_parser = parse_seconds, default_value = "10", allow_hyphen_values = true, conflicts_with = "frames")]
    seconds: f64,
    /// auto, cpu, or part of an adapter's name; several in turn, separated by commas
    #[arg(
        long,
        value_name = "A,A,…",
        env = "MOTES_ADAPTER",
        default_value = "auto"
    )]
    adapter: String,
    /// Change a key of all scenes, e.g. image.width=640
    #[arg(long, value_name = "path.to.key=value")]
    set: Vec<String>,
    /// Let scenes read files outside of their folders
    #[arg(long)]
    allow_outside: bool,
    /// Write the record as JSON; an array of them for several adapters
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write one line a measurement
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a page with plots
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
}

fn parse_particles(text: &str) -> Result<u32, String> {
    let count = text.trim().parse::<f64>().ok();
    let count = count.filter(|count| count.fract() == 0.0 && (1.0..=1e9).contains(count));
    count
        .map(|count| count as u32)
        .ok_or_else(|| "particles are a whole number from 1 to 1e9, e.g. 1e6".to_owned())
}

fn parse_frames(text: &str) -> Result<u32, String> {
    let frames = text.trim().parse().ok();
    frames
        .filter(|frames| (1..=1000).contains(frames))
        .ok_or_else(|| "frames are a whole number from 1 to 1000, e.g. 31".to_owned())
}

fn parse_noise(text: &str) -> Result<f64, String> {
    let percent = text.trim().trim_end_matches('%').parse::<f64>().ok();
    percent
        .filter(|percent| (0.01..=100.0).contains(percent))
        .ok_or_else(|| "noise is a number of percent from 0.01 to 100, e.g. 1".to_owned())
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    let seconds = text.trim().parse::<f64>().ok();
    seconds
        .filter(|seconds| (0.1..=86_400.0).contains(seconds))
        .ok_or_else(|| "seconds are a number from 0.1 to 86400, e.g. 10".to_owned())
}

pub(super) fn run(args: &BenchArgs) -> Result<u8, CliError> {
    let request = request(args)?;
    let targets = targets(&args.adapter)?;
    for path in [&args.json, &args.csv, &args.html].into_iter().flatten() {
        probe(path)?;
    }
    let interrupt = Interrupt::listen()?;
    let names: Vec<_> = targets.iter().map(Target::name).collect();
    note!("motes: measuring on {}", names.join(", "));
    let line = Line::new();
    let mut watch = |progress: &Progress| {
        line.tell(progress);
        interrupt.exit_code().is_none()
    };
    let measured = bench::measure(&targets, &request, &mut watch);
    line.bar.finish_and_clear();
    let records = match measured {
        Ok(records) => records,
        Err(BenchError::Stopped) => {
            note!("motes: stopped; nothing was written");
            return Ok(interrupt.exit_code().unwrap_or(1));
        }
        Err(error) => return Err(error.into()),
    };
    // First of all what cannot fail for want of room: it took long to measure.
    let texts: Vec<String> = records.iter().map(bench::table).collect();
    let printed = print(&texts.join("\n"));
    if let Some(path) = &args.json {
        bench::write_records(path, &records)?;
        wrote(path, &many(records.len(), "record"));
    }
    let files = match &args.json {
        Some(path) => vec![path.display().to_string(); records.len()],
        None => Vec::new(),
    };
    reports(&records, &files, args.html.as_deref(), args.csv.as_deref())?;
    printed?;
    Ok(0)
}

/// Writes the reports that were asked for, and says so. `files` are those that the records are from.
pub(super) fn reports(
    records: &[Record],
    files: &[String],
    html: Option<&Path>,
    csv: Option<&Path>,
) -> Result<(), CliError> {
    if let Some(path) = html {
        write_whole(path, bench::html(records, files).as_bytes())?;
        wrote(
            path,
            &format!("a page of {}", many(records.len(), "record")),
        );
    }
    if let Some(path) = csv {
        let text = bench::csv(records);
        write_whole(path, text.as_bytes())?;
        let lines = text.lines().count().saturating_sub(1);
        wrote(path, &many(lines, "measurement"));
    }
    Ok(())
}

fn wrote(path: &Path, what: &str) {
    note!("motes: wrote {}: {what}", path.display());
}

/// E.g. `1 record`, `3 records`.
fn many(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}

/// Refuses reports that cannot stand where they shall, before hours are spent on them.
fn places(args: &BenchArgs, inputs: &[Input]) -> Result<(), CliError> {
    let outputs = Output::given([
        ("--json", &args.json),
        ("--csv", &args.csv),
        ("--html", &args.html),
    ]);
    for output in &outputs {
        super::refuse_folder(output.what(), output.path())?;
    }
    collisions::refuse(&outputs, inputs)
}

/// Reads and checks everything before the first frame.
fn request(args: &BenchArgs) -> Result<Request, CliError> {
    let asked = if args.scenes.is_empty() && !args.micro {
        vec![DEFAULT_SCENE.to_owned()]
    } else {
        args.scenes.clone()
    };
    let loader = Loader {
        allow_outside: args.allow_outside,
    };
    let (mut scenes, mut inputs): (Vec<Scene>, _) = (Vec::new(), Vec::new());
    let sets: Vec<Set> = args.set.iter().map(|set| Set::argument(set)).collect();
    if asked.is_empty() && !sets.is_empty() {
        return Err(CliError::usage(
            "--set changes scenes, and none is measured".to_owned(),
            "name a scene, e.g. motes bench million --micro --set image.width=640",
        ));
    }
    for name in &asked {
        let draft = loader.draft(name, &sets)?;
        let scene = draft.scene()?;
        inputs.extend(draft.files());
        if scenes.iter().any(|other| other.name == scene.name) {
            return Err(CliError::usage(
                format!("two scenes are called `{}`", scene.name),
                "name each once; files are called by their names without .toml",
            ));
        }
        scenes.push(scene);
    }
    // What was changed is another scene: its records are held against none that is as it was written.
    let mut changes = args.set.clone();
    changes.sort_by(|a, b| key_of(a).cmp(key_of(b)));
    for scene in &mut scenes {
        if !changes.is_empty() {
            scene.name += &format!(" with {}", changes.join(", "));
        }
    }
    places(args, &inputs)?;
    super::tell_notes(&scenes);
    let mut particles = args.particles.clone();
    particles.sort_unstable();
    particles.dedup();
    let names: Vec<String> = scenes.iter().map(|scene| scene.name.clone()).collect();
    let request = Request {
        scenes,
        particles,
        micro: args.micro,
        budget: Budget {
            frames: args.frames,
            noise: args.noise / 100.0,
            secs: args.seconds,
        },
    };
    match request.check() {
        Ok(()) => Ok(request),
        Err((scene, BenchError::Plan(error))) => {
            let at = names.iter().position(|name| *name == scene);
            let file = at.map_or(&scene, |at| &asked[at]);
            Err(CliError::of_plan(&error, loader, file, &sets))
        }
        Err((_, error)) => Err(error.into()),
    }
}

/// The key that `path.to.key=value` changes.
fn key_of(set: &str) -> &str {
    set.split('=').next().unwrap_or_default().trim()
}

/// Opens each adapter once.
fn targets(choices: &str) -> Result<Vec<Target>, CliError> {
    let mut targets: Vec<Target> = Vec::new();
    for choice in choices.split(',') {
        if choice.trim().is_empty() && choices.contains(',') {
            return Err(CliError::usage(
                format!("a name is missing beside a comma in `{choices}`"),
                "put a comma between two adapters and nowhere else, e.g. --adapter llvmpipe,cpu",
            ));
        }
        let target = Target::open(&AdapterChoice::parse(choice))?;
        if targets.iter().any(|other| other.name() == target.name()) {
            return Err(CliError::usage(
                format!("`{choices}` names {} twice", target.name()),
                "name each adapter once, e.g. --adapter llvmpipe,cpu",
            ));
        }
        targets.push(target);
    }
    Ok(targets)
}

impl From<BenchError> for CliError {
    fn from(error: BenchError) -> Self {
        Self {
            message: error.to_string(),
            code: if error.is_users_fault() { 2 } else { 3 },
        }
    }
}

/// Where the measurement is, on a terminal; nothing in a pipe.
struct Line {
    bar: ProgressBar,
    told: std::cell::Cell<Option<Instant>>,
}

impl Line {
    fn new() -> Self {
        let bar = if std::io::stderr().is_terminal() {
            ProgressBar::new_spinner()
        } else {
            ProgressBar::hidden()
        };
        let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed}");
        Self {
            bar: match style {
                Ok(style) => bar.with_style(style),
                Err(_) => bar,
            },
            told: std::cell::Cell::new(None),
        }
    }

    /// Seldom enough that the telling is not what is measured.
    fn tell(&self, progress: &Progress) {
        let is_soon = |told: Instant| told.elapsed() < TOLD_EVERY;
        if self.told.get().is_some_and(is_soon) {
            return;
        }
        self.told.set(Some(Instant::now()));
        let Progress {
            what,
            particles,
            is_warm_up,
            frames,
        } = progress;
        let count = particles.map_or(String::new(), |count| format!(" at {count} particles"));
        let (doing, unit) = match (is_warm_up, *what == "micro") {
            (true, _) => ("warming up", "frames"),
            (false, true) => ("measuring", "rounds"),
            (false, false) => ("measuring", "frames"),
        };
        self.bar
            .set_message(format!("{what}{count}: {doing}, {frames} {unit}"));
        self.bar.tick();
    }
}
