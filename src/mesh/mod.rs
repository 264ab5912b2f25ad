//! Surfaces of triangles: read from OBJ, PLY, glTF and GLB files, or made from numbers.
//!
//! A mesh knows no scene. Its coordinates are those of its file; whoever uses it scales and places
//! it. What can be mended is, with a note ([`Mesh::notes`]); all else is refused with the line of
//! the file, where the format has lines. Nothing in a file is believed before memory is taken for
//! it: counts are held against the bytes that are there, and against [`MOST_TRIANGLES`].

mod build;
mod error;
mod gltf;
mod gltf_data;
mod letters;
mod obj;
mod ply;
mod ply_header;
mod shapes;
pub mod surface;

use std::path::Path;

pub use error::MeshError;
pub use letters::{MOST_LETTERS, letters};
pub use shapes::{BUILTIN, builtin, cube, cylinder, plane, sphere, torus};
pub use surface::Surface;

/// Bytes of a mesh file at most, of all buffers of a glTF together, and of all files that a scene
/// names together.
pub const MOST_BYTES: u64 = 256 << 20;

/// Triangles of a mesh at most, and of all meshes of a scene together: as many as one binding of
/// 128 MiB holds at 48 bytes each, which every adapter has.
pub const MOST_TRIANGLES: usize = (128 << 20) / 48;

/// Vertices of a mesh at most: as many as that many triangles can have.
pub const MOST_VERTICES: usize = 3 * MOST_TRIANGLES;

/// No coordinate is farther from 0.
pub const MOST_COORDINATE: f32 = 1e6;

/// Endings of files that can be read, in lower case.
pub const ENDINGS: [&str; 4] = ["obj", "ply", "gltf", "glb"];

/// Faces that have a group and a material in common.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Part {
    /// Name of the group, object or node that they are in; empty if it has none.
    pub group: String,
    /// Name of their material; empty if they have none.
    pub material: String,
}

/// Triangles in space, at least one, each with an area above 0 and its front where its corners run
/// counterclockwise.
#[derive(Clone, PartialEq)]
pub struct Mesh {
    name: String,
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    parts: Vec<Part>,
    face_parts: Vec<u32>,
    notes: Vec<String>,
    sphere: ([f32; 3], f32),
    digest: u64,
}

/// What a byte of a file takes in memory while it is read, at most.
const BYTES_A_BYTE: usize = 2;

/// Fetches a file that a glTF names, by the path that it is named by.
pub type Fetch<'a> = dyn FnMut(&str) -> Result<Vec<u8>, MeshError> + 'a;

impl Mesh {
    /// Reads a mesh from the bytes of a file; the ending of `name` says of which format. Polygons
    /// become fans of triangles around their first corner, so they must be convex.
    ///
    /// # Errors
    /// Another ending, a file that breaks its format, no faces, vertices that are not there,
    /// coordinates that are not finite or beyond [`MOST_COORDINATE`], more triangles than
    /// [`MOST_TRIANGLES`], and those of `fetch`.
    pub fn read(name: &str, bytes: &[u8], fetch: &mut Fetch) -> Result<Self, MeshError> {
        if bytes.len() as u64 > MOST_BYTES {
            return Err(MeshError::too_long());
        }
        let ending = Path::new(name).extension().unwrap_or_default();
        let ending = ending.to_string_lossy().to_lowercase();
        // Some programs begin texts with a byte order mark; no binary format begins so.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        MeshError::room_for(
            bytes.len(),
            BYTES_A_BYTE,
            "bytes of the file, once they are read",
        )?;
        let mut notes = Vec::new();
        let built = match ending.as_str() {
            "obj" => obj::read(bytes)?,
            "ply" => ply::read(bytes)?,
            "gltf" => gltf::read(bytes, None, fetch, &mut notes)?,
            "glb" => gltf::read_binary(bytes, fetch, &mut notes)?,
            _ => return Err(MeshError::unknown_ending()),
        };
        let mut mesh = built.finish(name)?;
        mesh.notes.extend(notes);
        Ok(mesh)
    }

    /// The file, or the built-in mesh.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Places of the vertices. Some may be of no triangle.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Corners of the triangles: indices of positions.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// What triangles belong to, in the order of the file.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The index among [`Mesh::parts`] of each triangle's part.
    pub fn face_parts(&self) -> &[u32] {
        &self.face_parts
    }

    /// What was mended or left out, a line each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Centre and radius of a sphere around all triangles: its centre is that of the box around
    /// them, so it is not always the smallest.
    pub fn bounding_sphere(&self) -> ([f32; 3], f32) {
        self.sphere
    }

    /// Tells meshes of other positions, triangles or parts from this one; the same on every machine.
    pub fn digest(&self) -> u64 {
        self.digest
    }

    /// The corners of a triangle; `face` is below the number of triangles.
    pub fn corners(&self, face: usize) -> [[f32; 3]; 3] {
        self.triangles[face].map(|at| self.positions[at as usize])
    }

    /// Twice the area of a triangle times its outward unit normal; `face` as in [`Mesh::corners`].
    pub fn doubled_area(&self, face: usize) -> [f64; 3] {
        build::doubled_area(self.corners(face))
    }

    /// Bytes of memory that it takes.
    pub(crate) fn memory_bytes(&self) -> u64 {
        let names = self.parts.iter();
        let names = names.map(|part| size_of::<Part>() + part.group.len() + part.material.len());
        let places = self.positions.len() * 12 + self.triangles.len() * 16;
        (places + names.sum::<usize>()) as u64
    }

    /// The area of all triangles together.
    pub fn area(&self) -> f64 {
        let of = |face| 0.5 * build::length(self.doubled_area(face));
        (0..self.triangles.len()).map(of).sum()
    }
}

// Whatever prints a scene is not to print millions of numbers; the digest stands for them.
impl std::fmt::Debug for Mesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Mesh")
            .field("name", &self.name)
            .field("vertices", &self.positions.len())
            .field("triangles", &self.triangles.len())
            .field("digest", &format_args!("{:016x}", self.digest))
            .finish()
    }
}
