//! The meshes of a scene: each file is read once, however it is spelled, and all together are of
//! bounded size.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use super::SceneError;
use super::error::{did_you_mean, shortened};
use super::files::{Files, Found};
use super::read::Spot;
use super::values::text;
use crate::mesh::{self, MOST_TRIANGLES, Mesh, MeshError, Surface};

/// Bytes of memory that all meshes of a scene may take.
const MOST_MEMORY: u64 = 512 << 20;

/// Bytes of an offending line that are shown at most; what is longer is no text for people.
const MOST_LINE: usize = 1 << 16;

/// What a triangle takes in the tables of births and of surfaces, and while they are made.
const BYTES_A_TRIANGLE: usize = 300;

/// Meshes that a scene has named up to now.
#[derive(Default)]
pub(super) struct Meshes {
    by_name: HashMap<String, Arc<Mesh>>,
    by_file: HashMap<Found, Arc<Mesh>>,
    /// By digest of the mesh and bits of the scale.
    surfaces: HashMap<(u64, u32), Arc<Surface>>,
    triangles: usize,
    memory_bytes: u64,
}

impl Meshes {
    /// Keeps a mesh, if there is room for it.
    fn add(&mut self, name: &str, mesh: Mesh) -> Result<Arc<Mesh>, MeshError> {
        let count = mesh.triangles().len();
        MeshError::room_for(count, BYTES_A_TRIANGLE, "triangles")?;
        self.triangles += count;
        self.memory_bytes += mesh.memory_bytes();
        if self.triangles > MOST_TRIANGLES {
            let others = self.triangles - count;
            let what = format!("it has {count} triangles, and the scene's other meshes {others}");
            let help = format!("at most {MOST_TRIANGLES} in all meshes of a scene together");
            return Err(MeshError::new(what, help));
        }
        if self.memory_bytes > MOST_MEMORY {
            let most = MOST_MEMORY >> 20;
            let what = format!("the scene's meshes take more than {most} MiB of memory together");
            return Err(MeshError::new(what, "meshes with fewer vertices"));
        }
        let mesh = Arc::new(mesh);
        self.by_name.insert(name.to_owned(), Arc::clone(&mesh));
        Ok(mesh)
    }
}

impl Files {
    /// The mesh that a value names: a built-in one, or a file.
    pub(super) fn mesh(&self, spot: &Spot<'_>) -> Result<Arc<Mesh>, SceneError> {
        let name = text(spot)?;
        if let Some(mesh) = self.meshes.borrow().by_name.get(&name) {
            return Ok(Arc::clone(mesh));
        }
        let refuse = |error| self.refuse(spot, &name, error, &[]);
        if let Some(made) = mesh::builtin(&name) {
            let added = made.and_then(|mesh| self.meshes.borrow_mut().add(&name, mesh));
            return added.map_err(refuse);
        }
        if !name.contains(['.', '/', '\\']) {
            let what = format!("`{}` cannot be \"{}\"", spot.path, shortened(&name));
            let guess = did_you_mean(&name, mesh::BUILTIN);
            let help = format!("{guess}{}", self.expected());
            return Err(spot.node.at.error(what, help));
        }
        let found = self.find(&name).map_err(refuse)?;
        let known = self.meshes.borrow().by_file.get(&found).map(Arc::clone);
        if let Some(mesh) = known {
            let mut meshes = self.meshes.borrow_mut();
            meshes.by_name.insert(name, Arc::clone(&mesh));
            return Ok(mesh);
        }
        let bytes = self.read(&found, "a mesh of the scene").map_err(refuse)?;
        let mesh = self.mesh_of(&name, &bytes);
        let mesh = mesh.map_err(|error| self.refuse(spot, &name, error, &bytes))?;
        let mut meshes = self.meshes.borrow_mut();
        let mesh = meshes.add(&name, mesh).map_err(refuse)?;
        meshes.by_file.insert(found, Arc::clone(&mesh));
        Ok(mesh)
    }

    /// The surface of a mesh that a value names, scaled, to be walked on.
    pub(super) fn surface(
        &self,
        spot: &Spot<'_>,
        mesh: &Mesh,
        scale: f32,
    ) -> Result<Arc<Surface>, SceneError> {
        let key = (mesh.digest(), scale.to_bits());
        if let Some(known) = self.meshes.borrow().surfaces.get(&key) {
            return Ok(Arc::clone(known));
        }
        let made = Surface::new(mesh, scale);
        let made = made.map_err(|error| self.refuse(spot, mesh.name(), error, &[]))?;
        let surface = Arc::new(made);
        let mut meshes = self.meshes.borrow_mut();
        meshes.surfaces.insert(key, Arc::clone(&surface));
        Ok(surface)
    }

    fn mesh_of(&self, name: &str, bytes: &[u8]) -> Result<Mesh, MeshError> {
        Mesh::read(name, bytes, &mut |part: &str| {
            // Named relative to the file that names it.
            let path = match Path::new(name).parent() {
                Some(folder) => folder.join(part).to_string_lossy().into_owned(),
                None => part.to_owned(),
            };
            let found = self.find(&path);
            let read = found.and_then(|found| self.read(&found, "a buffer of a mesh"));
            read.map_err(|error| MeshError {
                what: format!("its buffer {}: {}", shortened(part), error.what),
                ..error
            })
        })
    }

    /// The error of a value that names a mesh: at the line of the mesh's file that is wrong, if
    /// there is one in these bytes of it; else at the value.
    fn refuse(&self, spot: &Spot<'_>, name: &str, error: MeshError, bytes: &[u8]) -> SceneError {
        let MeshError {
            what,
            line,
            column,
            within,
            help,
            is_out_of_memory,
        } = error;
        let text = line.and_then(|line| bytes.split(|byte| *byte == b'\n').nth(line - 1));
        let text = text.filter(|text| text.len() <= MOST_LINE);
        let (Some(line), Some(mut text)) = (line, text) else {
            let line = line.map_or(String::new(), |line| format!(":{line}"));
            let within = within.map_or(String::new(), |place| format!("{place}: "));
            let name = shortened(name);
            let what = format!("`{}`: {name}{line}: {within}{what}", spot.path);
            let error = spot.node.at.error(what, help);
            return match is_out_of_memory {
                true => error.of_the_machine(),
                false => error,
            };
        };
        if line == 1 {
            text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        }
        let word = match column {
            Some(column) => {
                let rest = text.get(column - 1..).unwrap_or_default();
                let end = rest.iter().position(u8::is_ascii_whitespace);
                column - 1..column - 1 + end.unwrap_or(rest.len())
            }
            None => {
                let start = text.len() - text.trim_ascii_start().len();
                start..start + text.trim_ascii().len()
            }
        };
        // What is no text is shown as such, with as many letters before the word as may be.
        let before = String::from_utf8_lossy(&text[..word.start.min(text.len())]).len();
        let marked = text.get(word).unwrap_or_default();
        let marked = before..before + String::from_utf8_lossy(marked).len();
        let text = String::from_utf8_lossy(text);
        let file = self.shown(name);
        let what = format!("`{}`: {what}", spot.path);
        let error = SceneError::located(what, (&file, &text, Some(line)), marked, help);
        error.noted(match spot.node.at.shown().as_str() {
            "command line" => "the command line names this mesh".to_owned(),
            place => format!("{place} names this mesh"),
        })
    }
}
