//! No file is written twice, and none that is read: what is told before a run, and not found out
//! after it. Files are told apart by where they really are, whatever they are called.
//!
//! A hard link counts as a file of its own: files are replaced and not written into, so that its
//! other names keep what they have.

use std::path::{Component, Path, PathBuf};

use super::CliError;

/// What a command writes.
pub(super) struct Output {
    /// What it is to the user, e.g. `--json`.
    what: &'static str,
    path: PathBuf,
    /// Whether files may stand below it.
    is_folder: bool,
}

impl Output {
    /// A file.
    pub(super) fn file(what: &'static str, path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        Self {
            what,
            path,
            is_folder: false,
        }
    }

    /// A folder that new files are put into, none of which has another's name.
    pub(super) fn folder(what: &'static str, path: impl Into<PathBuf>) -> Self {
        Self {
            is_folder: true,
            ..Self::file(what, path)
        }
    }

    /// Those of these arguments that were given, each with its name.
    pub(super) fn given<'a>(
        arguments: impl IntoIterator<Item = (&'static str, &'a Option<PathBuf>)>,
    ) -> Vec<Self> {
        let given = arguments.into_iter();
        let given = given.filter_map(|(what, path)| Some((what, path.as_ref()?)));
        given.map(|(what, path)| Self::file(what, path)).collect()
    }

    /// What it is to the user.
    pub(super) fn what(&self) -> &'static str {
        self.what
    }

    /// Its path, as it was given.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}

/// What a command reads: what it is to the user, e.g. `the scene`, and where.
pub(super) type Input = (&'static str, PathBuf);

/// Refuses outputs of which one would overwrite another or an input, or would need another's file
/// as a folder.
pub(super) fn refuse(outputs: &[Output], inputs: &[Input]) -> Result<(), CliError> {
    let mut places: Vec<(PathBuf, &Output)> =
        outputs.iter().map(|it| (place(&it.path), it)).collect();
    for (input_place, what) in read(inputs) {
        if let Some((_, output)) = places.iter().find(|(place, _)| *place == input_place) {
            return Err(written_over(&output.path, what));
        }
    }
    // What stands below a file comes right behind it.
    places.sort_by(|a, b| (&a.0, a.1.what).cmp(&(&b.0, b.1.what)));
    places.dedup_by(|a, b| (&a.0, a.1.what) == (&b.0, b.1.what));
    for pair in places.windows(2) {
        let [(place, one), (below, other)] = pair else {
            continue;
        };
        // Folders may have anything below them, but are no files.
        let may_be_in = one.is_folder && (other.is_folder || below != place);
        if below.starts_with(place) && !may_be_in {
            return Err(collide((one.what, &one.path), (other.what, &other.path)));
        }
    }
    Ok(())
}

/// The error of an output that is an input, too.
pub(super) fn written_over(output: &Path, what: &str) -> CliError {
    CliError::usage(
        format!("{} is {what}, and would be written over", output.display()),
        "give the output a path of its own",
    )
}

/// The error of two outputs that need the same place.
pub(super) fn collide(one: (&str, &Path), other: (&str, &Path)) -> CliError {
    let ((what, path), (other_what, other_path)) = (one, other);
    let (path, other_path) = (path.display(), other_path.display());
    CliError::usage(
        format!(
            "{what} and {other_what} would be written to the same place: {path} and {other_path}"
        ),
        "give each output a path of its own",
    )
}

/// Where the inputs are that can be written over: files, and neither pipes nor what the program
/// carries.
pub(super) fn read(inputs: &[Input]) -> impl Iterator<Item = (PathBuf, &'static str)> {
    let files = inputs.iter().filter(|(_, path)| path.is_file());
    files.map(|(what, path)| (place(path), *what))
}

/// The path from the root, without links and dots: as the file system has it as far as there is
/// something, and by its words from there on.
pub(super) fn place(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let resolved = whole.ancestors().find_map(|folder| {
        let real = folder.canonicalize().ok()?;
        Some((real, whole.strip_prefix(folder).ok()?))
    });
    let Some((mut place, rest)) = resolved else {
        return whole;
    };
    for part in rest.components() {
        match part {
            Component::ParentDir => drop(place.pop()),
            Component::Normal(name) => place.push(name),
            _ => {}
        }
    }
    place
}
