//! The files of a run's pictures, which may be very many: which of them is at some place.

use std::ffi::OsString;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::journal;
use crate::cli::CliError;
use crate::cli::collisions::{self, Input, Output, collide, place, written_over};
use crate::output::OutputTarget;

/// What errors call the pictures.
const PICTURES: &str = "the pictures (-o)";

/// The pictures of some frames, and their layers.
struct Series<'a> {
    target: &'a OutputTarget,
    frames: &'a Range<u32>,
    layers: &'a [String],
    /// Where its folder really is.
    folder: PathBuf,
    /// Links in its folder, and where they lead.
    links: Vec<(OsString, PathBuf)>,
}

/// Refuses outputs of which one would overwrite another, or what is read.
pub(super) fn refuse(
    target: &OutputTarget,
    frames: &Range<u32>,
    layers: &[String],
    others: &[Output],
    inputs: &[Input],
) -> Result<(), CliError> {
    collisions::refuse(others, inputs)?;
    let series = Series::new(target, frames, layers);
    let journal = journal::place(target, frames).map(|folder| place(&folder));
    for (input, what) in collisions::read(inputs) {
        if let Some((_, file)) = series.at(&input) {
            return Err(written_over(&file, what));
        }
        let is_folder = matches!(target, OutputTarget::Folder(_));
        if is_folder && series.folder == input {
            return Err(written_over(&target.path(), what));
        }
        if journal
            .as_ref()
            .is_some_and(|folder| input.starts_with(folder))
        {
            return Err(CliError::usage(
                format!(
                    "{what} is in the folder that --resume keeps its notes in, which are removed"
                ),
                "move it to another folder",
            ));
        }
    }
    for other in others {
        let path = other.path();
        let other_place = place(path);
        let found = other_place.ancestors().find_map(|it| series.at(it));
        if let Some((what, file)) = found {
            return Err(collide((what, &file), (other.what(), path)));
        }
        // Its file would have to be their folder.
        if series.folder.starts_with(&other_place) {
            let first = target.frame_path(frames.start);
            return Err(collide((PICTURES, &first), (other.what(), path)));
        }
    }
    Ok(())
}

impl<'a> Series<'a> {
    fn new(target: &'a OutputTarget, frames: &'a Range<u32>, layers: &'a [String]) -> Self {
        let first = target.frame_path(frames.start);
        let folder = first.parent().unwrap_or(Path::new(""));
        let folder = place(match folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => folder,
        });
        let entries = folder.read_dir().into_iter().flatten().flatten();
        let is_link = |entry: &std::fs::DirEntry| entry.file_type().is_ok_and(|it| it.is_symlink());
        let links = entries.filter(is_link);
        let links = links.filter_map(|it| Some((it.file_name(), it.path().canonicalize().ok()?)));
        let links = links.collect();
        Self {
            target,
            frames,
            layers,
            folder,
            links,
        }
    }

    /// The file of it that would be written at that place, and what it is.
    fn at(&self, place: &Path) -> Option<(&'static str, PathBuf)> {
        let linked = self.links.iter().filter(|(_, leads_to)| leads_to == place);
        let mut names: Vec<_> = linked.map(|(name, _)| name.as_os_str()).collect();
        if place.parent() == Some(&self.folder) {
            names.extend(place.file_name());
        }
        // All have one ending, and most of what is asked for has another.
        let first = self.target.frame_path(self.frames.start);
        names.retain(|name| Path::new(name).extension() == first.extension());
        if names.is_empty() {
            return None;
        }
        let is_one = |path: &PathBuf| path.file_name().is_some_and(|name| names.contains(&name));
        let is_shared = self.target.is_animation() || self.frames.len() == 1;
        let frames = match is_shared {
            true => self.frames.start..self.frames.start + 1,
            false => self.frames.clone(),
        };
        frames.into_iter().find_map(|frame| {
            let picture = self.target.frame_path(frame);
            if is_one(&picture) {
                return Some((PICTURES, picture));
            }
            let layers = self.layers.iter();
            let mut layers = layers.filter_map(|layer| self.target.layer_path(frame, layer));
            let layer = layers.find(is_one);
            layer.map(|path| ("a layer (--layers)", path))
        })
    }
}
