//! The files that a scene names: found beside it, and nowhere else unless that is allowed.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs::File;
use std::io::{ErrorKind, Read as _};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use super::SceneError;
use super::builtin::BUILTIN_FILES;
use super::error::{did_you_mean, shortened};
use super::read::Spot;
use super::values::text;
use crate::mesh::{self, MOST_BYTES, Mesh, MeshError};

/// What a path in a scene is relative to.
enum Home {
    /// A folder; empty for the current one.
    Folder(PathBuf),
    /// The files that the program carries.
    Program,
}

/// The files of one scene. Each is read once.
pub(super) struct Files {
    home: Home,
    allow_outside: bool,
    meshes: RefCell<HashMap<String, Arc<Mesh>>>,
}

impl Files {
    /// Those beside a scene's file, by its path.
    pub(super) fn beside(file: &str, allow_outside: bool) -> Self {
        // What comes in through a pipe has no folder of its own.
        let is_pipe = file.starts_with("/dev/") || file.starts_with("/proc/");
        let folder = Path::new(file).parent().filter(|_| !is_pipe);
        Self::of(
            Home::Folder(folder.unwrap_or(Path::new("")).to_owned()),
            allow_outside,
        )
    }

    /// Those of a built-in scene.
    pub(super) fn carried(allow_outside: bool) -> Self {
        Self::of(Home::Program, allow_outside)
    }

    fn of(home: Home, allow_outside: bool) -> Self {
        Self {
            home,
            allow_outside,
            meshes: RefCell::default(),
        }
    }

    /// The mesh that a value names: a built-in one, or a file.
    pub(super) fn mesh(&self, spot: &Spot<'_>) -> Result<Arc<Mesh>, SceneError> {
        let name = text(spot)?;
        if let Some(mesh) = self.meshes.borrow().get(&name) {
            return Ok(Arc::clone(mesh));
        }
        let loaded = match mesh::builtin(&name) {
            Some(mesh) => mesh,
            None if !name.contains(['.', '/', '\\']) => {
                let what = format!("`{}` cannot be \"{}\"", spot.path, shortened(&name));
                let guess = did_you_mean(&name, mesh::BUILTIN);
                let help = format!("{guess}{}", self.expected());
                return Err(spot.node.at.error(what, help));
            }
            None => self.read_mesh(&name),
        };
        let mesh = loaded.map_err(|error| {
            let MeshError { what, line, help } = error;
            let line = line.map_or(String::new(), |line| format!(":{line}"));
            let what = format!("`{}`: {}{line}: {what}", spot.path, shortened(&name));
            spot.node.at.error(what, help)
        })?;
        let mesh = Arc::new(mesh);
        self.meshes.borrow_mut().insert(name, Arc::clone(&mesh));
        Ok(mesh)
    }

    fn read_mesh(&self, name: &str) -> Result<Mesh, MeshError> {
        let bytes = self.read(name)?;
        Mesh::read(name, &bytes, &mut |part: &str| {
            // Named relative to the file that names it.
            let path = match Path::new(name).parent() {
                Some(folder) => folder.join(part).to_string_lossy().into_owned(),
                None => part.to_owned(),
            };
            self.read(&path).map_err(|error| MeshError {
                what: format!("its buffer {}: {}", shortened(part), error.what),
                ..error
            })
        })
    }

    /// The bytes of a file.
    fn read(&self, path: &str) -> Result<Vec<u8>, MeshError> {
        if !self.allow_outside {
            lexically_inside(Path::new(path))?;
        }
        let folder = match &self.home {
            Home::Folder(folder) => folder.as_path(),
            Home::Program => {
                let plain = normalised(Path::new(path));
                let mut carried = BUILTIN_FILES.iter();
                if let Some((_, bytes)) = carried.find(|(name, _)| Path::new(name) == plain) {
                    return Ok(bytes.to_vec());
                }
                if !self.allow_outside {
                    return Err(MeshError::new(
                        "the program carries no such file",
                        format!(
                            "{}, or --allow-outside for files in the current folder",
                            self.expected()
                        ),
                    ));
                }
                Path::new("")
            }
        };
        let found = folder.join(path);
        let cannot = |error: std::io::Error| {
            let why = match error.kind() {
                ErrorKind::NotFound => "there is no such file".to_owned(),
                _ => format!("the file cannot be read: {error}"),
            };
            MeshError::new(why, self.expected())
        };
        let about = found.metadata().map_err(cannot)?;
        if !about.is_file() {
            // A pipe would be waited for, a device read without end.
            let what = match about.is_dir() {
                true => "it is a folder",
                false => "it is a device or a pipe, not a file",
            };
            return Err(MeshError::new(what, self.expected()));
        }
        if !self.allow_outside {
            let home = match folder.as_os_str().is_empty() {
                true => Path::new("."),
                false => folder,
            };
            let home = home.canonicalize().map_err(cannot)?;
            if !found.canonicalize().map_err(cannot)?.starts_with(home) {
                return Err(outside("a link leads out of the scene's folder"));
            }
        }
        if about.len() > MOST_BYTES {
            return Err(MeshError::too_long());
        }
        let mut bytes = Vec::new();
        bytes
            .try_reserve_exact(about.len() as usize + 1)
            .map_err(|_| {
                let what = format!("there is no memory for its {} bytes", about.len());
                MeshError::new(what, "a smaller mesh")
            })?;
        // It may grow meanwhile.
        let file = File::open(&found).map_err(cannot)?;
        let mut limited = file.take(MOST_BYTES + 1);
        limited.read_to_end(&mut bytes).map_err(cannot)?;
        Ok(bytes)
    }

    /// What would be right.
    fn expected(&self) -> String {
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
        format!("{files}, or one of {names}")
    }
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
