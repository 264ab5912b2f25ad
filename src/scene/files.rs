//! The files that a scene names: found beside it, and nowhere else unless that is allowed; each
//! noted, so that nobody writes over it, and all together of bounded size.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::hash::{DefaultHasher, Hasher as _};
use std::io::{ErrorKind, Read as _};
use std::path::{Component, Path, PathBuf};

use super::builtin::BUILTIN_FILES;
use super::error::did_you_mean;
use super::meshes::Meshes;
use crate::mesh::{self, ENDINGS, MOST_BYTES, MeshError};

/// Names of a folder that are looked through for one like another, at most.
const MOST_NAMES: usize = 10_000;

/// What a path in a scene is relative to.
enum Home {
    /// A folder; empty for the current one.
    Folder(PathBuf),
    /// The files that the program carries.
    Program,
}

/// A file of a scene, found but not yet read.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Found {
    /// One that the program carries, by its place in [`BUILTIN_FILES`].
    Carried(usize),
    /// One of the disk, by its path without links and dots.
    OnDisk(PathBuf),
}

/// The files of one scene.
pub(super) struct Files {
    home: Home,
    allow_outside: bool,
    /// Those that were opened, with what they are to the scene.
    opened: RefCell<Vec<(&'static str, PathBuf)>>,
    /// Those of the program that were read, by their places in [`BUILTIN_FILES`].
    carried: RefCell<BTreeSet<usize>>,
    /// Of those of the disk, digests of what was read.
    digests: RefCell<BTreeMap<PathBuf, u64>>,
    /// Those that the scene names by a path from the root.
    absolute: RefCell<BTreeSet<PathBuf>>,
    /// Bytes that may still be read.
    left: Cell<u64>,
    pub(super) meshes: RefCell<Meshes>,
}

impl Files {
    /// Those beside a scene's file, by its path.
    pub(super) fn beside(file: &str, allow_outside: bool) -> Self {
        let files = Self::of(Home::Folder(folder_of(file)), allow_outside);
        files.opened.borrow_mut().push(("the scene", file.into()));
        files
    }

    /// Those of a built-in scene.
    pub(super) fn carried(allow_outside: bool) -> Self {
        Self::of(Home::Program, allow_outside)
    }

    fn of(home: Home, allow_outside: bool) -> Self {
        Self {
            home,
            allow_outside,
            opened: RefCell::default(),
            carried: RefCell::default(),
            digests: RefCell::default(),
            absolute: RefCell::default(),
            left: Cell::new(MOST_BYTES),
            meshes: RefCell::default(),
        }
    }

    /// Every file that was opened up to now, with what it is to the scene: its own, its meshes and
    /// their buffers.
    pub(super) fn opened(&self) -> Vec<(&'static str, PathBuf)> {
        self.opened.borrow().clone()
    }

    /// Files that the scene's text needs beside it wherever it is written to, by their places relative
    /// to it, with their bytes: those that the program carries, and those in the scene's own folder.
    ///
    /// # Errors
    /// One of them is not what was read any more, or lies elsewhere; which.
    #[cfg(feature = "view")]
    pub(super) fn companions(&self) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        let carried = self.carried.borrow();
        let carried = carried.iter().map(|at| {
            let (name, bytes) = BUILTIN_FILES[*at];
            (PathBuf::from(name), bytes.to_vec())
        });
        let mut companions: Vec<_> = carried.collect();
        let home = match self.folder() {
            folder if folder.as_os_str().is_empty() => Path::new("."),
            folder => folder,
        };
        let home = home.canonicalize().unwrap_or_default();
        for (place, digest) in self.digests.borrow().iter() {
            let told = |what: &str| format!("{}: {what}", place.display());
            if self.absolute.borrow().contains(place) {
                continue;
            }
            let name = place.strip_prefix(&home).map_err(|_| {
                told("it lies outside of the scene's folder, and only the scene there finds it")
            })?;
            let bytes = std::fs::read(place).map_err(|error| told(&error.to_string()))?;
            if digest_of(&bytes) != *digest {
                return Err(told("it has been written since the scene was read"));
            }
            companions.push((name.to_owned(), bytes));
        }
        Ok(companions)
    }

    /// A file of the scene by its path, which must be one that may be read.
    pub(super) fn find(&self, path: &str) -> Result<Found, MeshError> {
        if !self.allow_outside {
            lexically_inside(Path::new(path))?;
        }
        if let Home::Program = self.home {
            let plain = normalised(Path::new(path));
            let mut carried = BUILTIN_FILES.iter();
            if let Some(at) = carried.position(|(name, _)| Path::new(name) == plain) {
                return Ok(Found::Carried(at));
            }
            if !self.allow_outside {
                let names = BUILTIN_FILES.iter().map(|(name, _)| *name);
                return Err(MeshError::new(
                    "the program carries no such file",
                    format!(
                        "{}{}, or --allow-outside for files in the current folder",
                        did_you_mean(path, names),
                        self.expected()
                    ),
                ));
            }
        }
        let found = self.folder().join(path);
        let cannot = |error| self.cannot_read(path, &error);
        let about = found.metadata().map_err(cannot)?;
        if !about.is_file() {
            // A pipe would be waited for, a device read without end.
            let what = match about.is_dir() {
                true => "it is a folder",
                false => "it is a device or a pipe, not a file",
            };
            return Err(MeshError::new(what, self.expected()));
        }
        let place = found.canonicalize().map_err(cannot)?;
        if !self.allow_outside && !self.is_inside(&place) {
            return Err(outside("a link leads out of the scene's folder"));
        }
        if Path::new(path).is_absolute() {
            self.absolute.borrow_mut().insert(place.clone());
        }
        Ok(Found::OnDisk(place))
    }

    /// The bytes of a file, which is `what` to the scene.
    pub(super) fn read(&self, found: &Found, what: &'static str) -> Result<Vec<u8>, MeshError> {
        let place = match found {
            Found::Carried(at) => {
                self.carried.borrow_mut().insert(*at);
                return Ok(BUILTIN_FILES[*at].1.to_vec());
            }
            Found::OnDisk(place) => place,
        };
        self.opened.borrow_mut().push((what, place.clone()));
        let cannot = |error| self.cannot_read("", &error);
        let file = File::open(place).map_err(cannot)?;
        let about = file.metadata().map_err(cannot)?;
        if about.len() > MOST_BYTES {
            return Err(MeshError::too_long());
        }
        let mut bytes = Vec::new();
        let reserved = bytes.try_reserve_exact(about.len().min(self.left.get()) as usize + 1);
        reserved.map_err(|_| MeshError::no_memory(about.len(), "bytes of the file"))?;
        // It may grow meanwhile.
        let mut limited = file.take(self.left.get() + 1);
        limited.read_to_end(&mut bytes).map_err(cannot)?;
        let left = self.left.get().checked_sub(bytes.len() as u64);
        self.left.set(left.ok_or_else(|| {
            let most = MOST_BYTES >> 20;
            let what =
                format!("the files that the scene names are larger than {most} MiB together");
            MeshError::new(what, "fewer or smaller meshes")
        })?);
        let mut digests = self.digests.borrow_mut();
        digests.insert(place.clone(), digest_of(&bytes));
        Ok(bytes)
    }

    /// The path as errors show it.
    pub(super) fn shown(&self, path: &str) -> String {
        self.folder().join(path).display().to_string()
    }

    /// What would be right.
    pub(super) fn expected(&self) -> String {
        let names = mesh::BUILTIN.join(", ");
        let files = match &self.home {
            Home::Folder(_) => "a path relative to the scene's folder, which ends in .obj, .ply, \
                                .gltf or .glb"
                .to_owned(),
            Home::Program => {
                let carried: Vec<&str> = BUILTIN_FILES.iter().map(|(name, _)| *name).collect();
                carried.join(", ")
            }
        };
        format!("{files}, or one of {names}, or letters:TEXT")
    }

    /// The folder that paths are relative to; empty for the current one.
    fn folder(&self) -> &Path {
        match &self.home {
            Home::Folder(folder) => folder,
            Home::Program => Path::new(""),
        }
    }

    /// Whether a place without links and dots is in the scene's folder.
    fn is_inside(&self, place: &Path) -> bool {
        let home = match self.folder() {
            folder if folder.as_os_str().is_empty() => Path::new("."),
            folder => folder,
        };
        home.canonicalize()
            .is_ok_and(|home| place.starts_with(home))
    }

    fn cannot_read(&self, path: &str, error: &std::io::Error) -> MeshError {
        let (why, help) = match error.kind() {
            ErrorKind::NotFound => (
                "there is no such file".to_owned(),
                self.like(path) + &self.expected(),
            ),
            ErrorKind::PermissionDenied => (
                format!("the file cannot be read: {error}"),
                "a file that you may read".to_owned(),
            ),
            _ => (format!("the file cannot be read: {error}"), self.expected()),
        };
        MeshError::new(why, help)
    }

    /// A question whether a file beside the one that is missing was meant; or nothing.
    fn like(&self, path: &str) -> String {
        let path = Path::new(path);
        let whole = self.folder().join(path);
        let folder = match whole.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let place = folder.canonicalize().ok();
        let may_look = place.is_some_and(|place| self.allow_outside || self.is_inside(&place));
        let (Some(name), true) = (path.file_name(), may_look) else {
            return String::new();
        };
        let entries = folder.read_dir().into_iter().flatten().take(MOST_NAMES);
        let names = entries.flatten().map(|entry| entry.file_name());
        let is_like = |name: &PathBuf| {
            let ending = name.extension().unwrap_or_default().to_string_lossy();
            let is_mesh = ENDINGS.contains(&ending.to_lowercase().as_str());
            is_mesh || name.extension() == path.extension()
        };
        let names = names.map(PathBuf::from).filter(is_like);
        let names: Vec<String> = names.map(|it| it.to_string_lossy().into_owned()).collect();
        let close =
            super::error::nearest(&name.to_string_lossy(), names.iter().map(String::as_str));
        let meant = close.first().map(|name| path.with_file_name(name));
        meant.map_or(String::new(), |path| {
            format!("did you mean `{}`? ", path.display())
        })
    }
}

fn digest_of(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write(bytes);
    hasher.finish()
}

/// The folder of a scene's file; empty for the current one.
fn folder_of(file: &str) -> PathBuf {
    let folder = Path::new(file).parent().unwrap_or(Path::new(""));
    let place = folder.canonicalize().unwrap_or_default();
    // What comes in through a pipe has no folder of its own.
    let is_descriptors = place.starts_with("/dev/fd")
        || (place.starts_with("/proc") && place.file_name().is_some_and(|name| name == "fd"));
    if place == Path::new("/dev") || is_descriptors {
        return PathBuf::new();
    }
    folder.to_owned()
}

fn outside(what: &str) -> MeshError {
    MeshError::new(
        what,
        "a file in the scene's folder or below it; --allow-outside lets a scene that you trust \
         read others",
    )
}

/// Refuses a path that by its words alone leaves the folder that it is relative to.
fn lexically_inside(path: &Path) -> Result<(), MeshError> {
    let mut depth = 0;
    // Another system's paths are refused here, too.
    let is_rooted = path.to_string_lossy().starts_with(['/', '\\']);
    for part in path.components() {
        match part {
            Component::Normal(_) => depth += 1,
            Component::CurDir => {}
            Component::ParentDir => depth -= 1,
            Component::Prefix(_) | Component::RootDir => {
                return Err(outside("the path is absolute"));
            }
        }
        if depth < 0 {
            return Err(outside("the path leaves the scene's folder"));
        }
    }
    match is_rooted {
        true => Err(outside("the path is absolute")),
        false => Ok(()),
    }
}

/// The path without `.` and `..`, as far as that goes.
fn normalised(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.pop() => {}
            part => plain.push(part),
        }
    }
    plain
}
