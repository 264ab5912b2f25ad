//! What the arguments ask for, checked as far as that goes before anything is opened.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::args::{MOST_FRAMES, RenderArgs};
use super::collisions;
use super::journal::Finished;
use crate::cli::CliError;
use crate::output::{OutputTarget, dump_path};
use crate::plan::Turn;
use crate::recording::{Recording, RefusedChange};
use crate::scene::{self, Scene};

/// A recording is shorter.
const MOST_BYTES: u64 = 16 << 20;

/// What is to be rendered, and where to: the arguments, checked.
pub(super) struct Request {
    pub(super) scene: Scene,
    pub(super) frames: Range<u32>,
    pub(super) target: OutputTarget,
    pub(super) dump_dir: PathBuf,
    pub(super) recording: Recording,
    /// The changes, each with the scene that holds from it on.
    pub(super) turns: Vec<Turn>,
}

/// Checks all that can be known before anything is opened.
pub(super) fn request(args: &RenderArgs) -> Result<Request, CliError> {
    let mut sets = args.set.clone();
    if let Some((width, height)) = args.size {
        sets.push(format!("image.width={width}"));
        sets.push(format!("image.height={height}"));
    }
    if let Some(seed) = args.seed {
        sets.push(format!("seed={seed}"));
    }
    let scene = scene::load_with(&args.scene, &sets)?;
    let frames = match (args.frame, &args.frames) {
        (Some(frame), _) if frame >= MOST_FRAMES => {
            return Err(CliError::usage(
                format!("frame {frame} is too late"),
                format!("frames are below {MOST_FRAMES}"),
            ));
        }
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
        None => OutputTarget::Folder(folder),
    };
    let layers = if args.layers {
        scene.layer_names()
    } else {
        Vec::new()
    };
    let stats = args.stats.as_deref();
    collisions::refuse(&target, &frames, &layers, stats, &args.dump, &dump_dir)?;
    if args.layers && target.layer_path(0, "").is_none() {
        return Err(CliError::usage(
            "--layers writes files beside those of the frames, and this output has none",
            "a folder, name-%04d.png or name.png, or .exr instead of .png, after -o",
        ));
    }
    if matches!(target, OutputTarget::Svg(_)) && frames.len() > 1 {
        return Err(CliError::usage(
            format!(
                "a line drawing holds one frame, and there are {}",
                frames.len()
            ),
            "pick one with --frame",
        ));
    }
    let (recording, turns) = match &args.inputs {
        Some(path) => {
            let recording = recording_of(path)?;
            let turns = recording.turns(&args.scene, &sets);
            let turns = turns.map_err(|e| refused_change(&e, path))?;
            (recording, turns)
        }
        None => (Recording::default(), Vec::new()),
    };
    Ok(Request {
        scene,
        frames,
        target,
        dump_dir,
        recording,
        turns,
    })
}

/// Refuses to write over files that are there and that this run has not `finished` before.
pub(super) fn refuse_to_replace(
    args: &RenderArgs,
    request: &Request,
    finished: &Finished,
) -> Result<(), CliError> {
    let target = &request.target;
    let layers = if args.layers {
        request.scene.layer_names()
    } else {
        Vec::new()
    };
    let of_frame = |frame: u32| {
        let layers = layers.iter();
        let layers = layers.filter_map(move |layer| target.layer_path(frame, layer));
        layers.chain([target.frame_path(frame)])
    };
    let dump = |frame: &u32| dump_path(&request.dump_dir, "particles", *frame);
    let is_new = |frame: &u32| target.is_animation() || !finished.has(*frame);
    let frames = request.frames.clone().filter(is_new);
    let dumps = args.dump.iter().filter(|frame| !finished.has(**frame));
    let mut files = frames
        .flat_map(of_frame)
        .chain(dumps.map(dump))
        .chain(args.stats.clone());
    match files.find(|file| file.is_file()) {
        None => Ok(()),
        Some(file) => Err(CliError::usage(
            format!("{} is there already", file.display()),
            "name another place, or leave out --no-clobber to write over it",
        )),
    }
}

fn recording_of(path: &Path) -> Result<Recording, CliError> {
    let mut text = String::new();
    let read = File::open(path).and_then(|file| file.take(MOST_BYTES).read_to_string(&mut text));
    match read {
        Ok(bytes) if bytes as u64 == MOST_BYTES => {
            return Err(CliError::usage(
                format!("{} is too long", path.display()),
                format!("a recording has less than {MOST_BYTES} bytes"),
            ));
        }
        Ok(_) => {}
        Err(e) => {
            return Err(CliError::usage(
                format!("{} cannot be read: {e}", path.display()),
                "name a text file",
            ));
        }
    }
    Ok(Recording::parse(&text, &path.display().to_string())?)
}

/// A change that the scene refuses: where it stands, and below that what the scene says.
fn refused_change(refused: &RefusedChange, path: &Path) -> CliError {
    let (file, line) = (path.display(), refused.change.line);
    let why = refused.message.trim_start_matches("error: ");
    CliError {
        message: format!("error: {file}:{line}: the scene refuses this change\n{why}"),
        code: 2,
    }
}
