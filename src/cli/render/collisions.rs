//! No file is written twice: what is told before a run, and not found out after it.

use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::cli::CliError;
use crate::output::OutputTarget;

/// Refuses outputs of which one would overwrite another, or would need its file as a folder.
pub(super) fn refuse(
    target: &OutputTarget,
    frames: &Range<u32>,
    layers: &[String],
    stats: Option<&Path>,
    dumps: &[PathBuf],
) -> Result<(), CliError> {
    // No picture ends in .ply as dumps do, so that only statistics can be among them.
    let pictures = match stats {
        Some(stats) => picture_like(target, frames, stats),
        None => target.frame_path(frames.start),
    };
    let mut files = vec![("the pictures (-o)", pictures)];
    files.extend(stats.map(|stats| ("the statistics (--stats)", stats.to_owned())));
    if let Some(stats) = stats {
        let beside = layers.iter().filter_map(|layer| {
            let paths = frames.clone().map(|frame| target.layer_path(frame, layer));
            paths.flatten().find(|path| place(path) == place(stats))
        });
        files.extend(beside.map(|path| ("a layer (--layers)", path)));
    }
    let first_dump = files.len();
    for path in dumps {
        files.push(("a dump (--dump)", path.clone()));
    }
    let places: Vec<PathBuf> = files.iter().map(|(_, path)| place(path)).collect();
    for one in 0..first_dump {
        for other in one + 1..files.len() {
            if places[one].starts_with(&places[other]) || places[other].starts_with(&places[one]) {
                let ((what, path), (other_what, other_path)) = (&files[one], &files[other]);
                return Err(CliError::usage(
                    format!(
                        "{what} and {other_what} would be written to the same place: {} and {}",
                        path.display(),
                        other_path.display()
                    ),
                    "give each output a path of its own",
                ));
            }
        }
    }
    Ok(())
}

/// Refuses an output that would be written over what is read.
pub(super) fn refuse_inputs(
    outputs: &[Option<&Path>],
    inputs: &[(&str, Option<&Path>)],
) -> Result<(), CliError> {
    for output in outputs.iter().flatten() {
        for (what, input) in inputs {
            if input.is_some_and(|input| input.is_file() && place(input) == place(output)) {
                return Err(CliError::usage(
                    format!("{} is {what}, and would be written over", output.display()),
                    "give the output a path of its own",
                ));
            }
        }
    }
    Ok(())
}

/// The file of the pictures that is also `stats`; that of the first frame if none is.
fn picture_like(target: &OutputTarget, frames: &Range<u32>, stats: &Path) -> PathBuf {
    let stats_place = place(stats);
    frames
        .clone()
        .map(|frame| target.frame_path(frame))
        // Names first: looking up a place asks the file system.
        .find(|path| path.file_name() == stats.file_name() && place(path) == stats_place)
        .unwrap_or_else(|| target.frame_path(frames.start))
}

/// The path from the root, without links and dots in as much of it as there is already.
fn place(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let resolved = whole.ancestors().find_map(|folder| {
        let real = folder.canonicalize().ok()?;
        Some(real.join(whole.strip_prefix(folder).ok()?))
    });
    resolved.unwrap_or(whole)
}
