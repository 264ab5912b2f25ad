//! What the arguments ask for, checked as far as that goes before anything is opened.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::args::RenderArgs;
use super::journal::Finished;
use super::series;
use crate::cli::collisions::Output;
use crate::cli::{CliError, refuse_folder};
use crate::output::{OutputTarget, dump_path, is_special};
use crate::plan::{Population, Turn};
use crate::recording::Recording;
use crate::scene::{Scene, Set};

/// A recording is shorter.
const MOST_BYTES: u64 = 16 << 20;

/// What is to be rendered, and where to: the arguments, checked.
pub(super) struct Request {
    pub(super) scene: Scene,
    pub(super) frames: Range<u32>,
    pub(super) target: OutputTarget,
    /// Names of the layers that are written beside the frames; none unless they are asked for.
    pub(super) layers: Vec<String>,
    /// Frames whose populations are dumped.
    pub(super) dumps: Vec<u32>,
    pub(super) dump_dir: PathBuf,
    /// Who is dumped.
    pub(super) populations: Vec<Population>,
    pub(super) recording: Recording,
    /// The changes, each with the scene that holds from it on.
    pub(super) turns: Vec<Turn>,
}

/// Checks all that can be known before anything is opened.
pub(super) fn request(args: &RenderArgs) -> Result<Request, CliError> {
    let sets = sets(args);
    let mut draft = args.loader().draft(&args.scene, &sets)?;
    let scene = draft.scene()?;
    let frames = match (args.frame, &args.frames) {
        (Some(frame), _) => frame..frame + 1,
        (None, Some(frames)) => frames.clone(),
        (None, None) => 0..scene.frames,
    };
    let folder = Path::new("out").join(&scene.name);
    let dump_dir = args.dump_dir.clone().unwrap_or_else(|| folder.clone());
    if let Some(frame) = args.dump.iter().find(|frame| !frames.contains(frame)) {
        return Err(CliError::usage(
            format!("frame {frame} is to be dumped but is not rendered"),
            format!(
                "frames are {}..{}; say others with --frames",
                frames.start, frames.end
            ),
        ));
    }
    let target = match &args.output {
        Some(out) => OutputTarget::parse(out)?,
        None => OutputTarget::in_folder(&folder.display().to_string())?,
    };
    refuse_many(&target, frames.len())?;
    let layers = if args.layers {
        scene.layer_names()
    } else {
        Vec::new()
    };
    let stats = args.stats.as_deref();
    if let Some(stats) = stats {
        refuse_folder("--stats", stats)?;
    }
    let populations = Population::dumped_of(&scene);
    let dumps = args.dump.iter();
    let dumps: Vec<PathBuf> = dumps
        .flat_map(|frame| dump_paths(&dump_dir, &populations, *frame))
        .collect();
    let (recording, turns) = match &args.inputs {
        Some(path) => {
            let (text, file) = (text_of(path)?, path.display().to_string());
            let recording = Recording::parse(&text, &file)?;
            let turns = recording.turns_on(&mut draft, (&text, &file));
            let turns = turns.map_err(|refused| CliError {
                message: refused.message,
                code: 2,
            })?;
            (recording, turns)
        }
        None => (Recording::default(), Vec::new()),
    };
    // All files are known that the scene and its changes name.
    let mut inputs = draft.files();
    let recorded = args.inputs.clone();
    inputs.extend(recorded.map(|path| ("the recording (--inputs)", path)));
    let dumps = dumps
        .iter()
        .map(|path| Output::file("a dump (--dump)", path));
    let stats = stats.map(|path| Output::file("the statistics (--stats)", path));
    let others: Vec<Output> = stats.into_iter().chain(dumps).collect();
    series::refuse(&target, &frames, &layers, &others, &inputs)?;
    if args.layers && target.layer_path(0, "").is_none() {
        return Err(CliError::usage(
            "--layers writes files beside those of the frames, and this output has none",
            "a folder, name-%04d.png or name.png, or .exr instead of .png, after -o",
        ));
    }
    Ok(Request {
        scene,
        frames,
        target,
        layers,
        dumps: args.dump.clone(),
        dump_dir,
        populations,
        recording,
        turns,
    })
}

/// Refuses more frames than one where the output holds no more.
fn refuse_many(target: &OutputTarget, count: usize) -> Result<(), CliError> {
    let (what, help) = match target {
        _ if count < 2 => return Ok(()),
        OutputTarget::Svg(_) => ("line drawing", "pick one with --frame"),
        OutputTarget::Png(_) => (
            "PNG",
            "use name-%04d.png, .gif or .mp4, or pick one with --frame",
        ),
        OutputTarget::Exr(_) => ("EXR", "use name-%04d.exr, or pick one with --frame"),
        _ => return Ok(()),
    };
    let path = target.path();
    Err(CliError::usage(
        format!(
            "{}: one {what} holds one frame, and there are {count}",
            path.display()
        ),
        help,
    ))
}

impl Request {
    /// The files that a frame has to itself; the frames of an animation share one.
    pub(super) fn files_of(&self, frame: u32) -> Vec<PathBuf> {
        let layers = self.layers.iter();
        let layers = layers.filter_map(|layer| self.target.layer_path(frame, layer));
        let mut files: Vec<PathBuf> = layers.collect();
        if !self.target.is_animation() {
            files.push(self.target.frame_path(frame));
        }
        if self.dumps.contains(&frame) {
            files.extend(self.dumps_of(frame));
        }
        files
    }

    /// The dumps of a frame.
    pub(super) fn dumps_of(&self, frame: u32) -> Vec<PathBuf> {
        dump_paths(&self.dump_dir, &self.populations, frame)
    }
}

fn dump_paths(dir: &Path, populations: &[Population], frame: u32) -> Vec<PathBuf> {
    let all = populations.iter();
    all.map(|it| dump_path(dir, it.name(), frame)).collect()
}

/// Refuses to write over files that are there and that this run has not `finished` before.
pub(super) fn refuse_to_replace(
    args: &RenderArgs,
    request: &Request,
    finished: &Finished,
) -> Result<(), CliError> {
    let target = &request.target;
    let shared = target.is_animation().then(|| target.path());
    let frames = request.frames.clone();
    // A run that was killed may have put a frame in its place, and not have come to note it.
    let next = frames.clone().find(|frame| !finished.has(*frame));
    let is_own =
        |frame: &u32| finished.has(*frame) || finished.is_resumed() && next == Some(*frame);
    let new = frames.filter(|frame| !is_own(frame));
    let new = new.flat_map(|frame| request.files_of(frame));
    // Those of all frames come last.
    let common = shared.into_iter().chain(args.stats.clone());
    let common = common.filter(|_| next.is_some());
    let mut files = common.chain(new).filter(|file| !is_special(file));
    match files.find(|file| file.is_file()) {
        None => Ok(()),
        Some(file) => Err(CliError::usage(
            format!("{} is there already", file.display()),
            "name another place, or leave out --no-clobber to write over it",
        )),
    }
}

/// The changes that arguments ask for, each as it was typed.
pub(super) fn sets(args: &RenderArgs) -> Vec<Set> {
    let mut sets: Vec<Set> = args.set.iter().map(|set| Set::argument(set)).collect();
    if let Some((width, height)) = args.size {
        let typed = format!("--size {width}x{height}");
        let cut = typed.len() - height.to_string().len();
        sets.push(Set::implied(
            "image.width",
            &typed,
            "--size ".len()..cut - 1,
        ));
        sets.push(Set::implied("image.height", &typed, cut..typed.len()));
    }
    if let Some(seed) = args.seed {
        let typed = format!("--seed {seed}");
        sets.push(Set::implied("seed", &typed, "--seed ".len()..typed.len()));
    }
    sets
}

/// The text of a recording.
fn text_of(path: &Path) -> Result<String, CliError> {
    let file = path.display();
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(MOST_BYTES).read_to_end(&mut bytes));
    match read {
        Ok(read) if read as u64 == MOST_BYTES => Err(CliError::usage(
            format!("{file} is too long for a recording (--inputs)"),
            format!("a recording has less than {MOST_BYTES} bytes"),
        )),
        Ok(_) => String::from_utf8(bytes).map_err(|error| {
            let end = error.utf8_error().valid_up_to();
            let before = error.as_bytes()[..end].iter();
            let line = before.filter(|&&byte| byte == b'\n').count() + 1;
            CliError::usage(
                format!("{file}:{line}: the recording is not UTF-8 from byte {end} on"),
                "save the file as UTF-8",
            )
        }),
        Err(e) => Err(CliError::usage(
            format!("{file} cannot be read: {e}"),
            "--inputs takes a text file with lines of `FRAME path.to.key=value`",
        )),
    }
}
