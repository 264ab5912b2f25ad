//! Dumps of a population: binary little-endian PLY, one vertex a record, readable by any point cloud viewer.

use std::io::Write;
use std::path::{Path, PathBuf};

use bytemuck::Pod;

use super::OutputError;
use super::atomic::AtomicFile;
use crate::simulation::{BoidState, FlameState, ParticleState, PointState};

/// What a file says of the units of its properties.
const PARTICLE_UNITS: &str = "world space; velocity per frame; age and lifetime in frames";

/// PLY's type and name of each property, in the order of the fields of [`ParticleState`].
const PARTICLE_PROPERTIES: &[&str] = &[
    "float x",
    "float y",
    "float z",
    "float vx",
    "float vy",
    "float vz",
    "uint age",
    "uint lifetime",
    "uint system",
    "uint id",
];

/// See [`PARTICLE_UNITS`].
const BOID_UNITS: &str = "world space; velocity per frame";

/// PLY's type and name of each property, in the order of the fields of [`BoidState`].
const BOID_PROPERTIES: &[&str] = &[
    "float x",
    "float y",
    "float z",
    "float vx",
    "float vy",
    "float vz",
    "uint flock",
    "uint id",
];

/// See [`PARTICLE_UNITS`].
const FLAME_UNITS: &str = "world space; age and lifetime in frames, a lifetime of 0 without end";

/// PLY's type and name of each property, in the order of the fields of [`FlameState`].
const FLAME_PROPERTIES: &[&str] = &[
    "float x",
    "float y",
    "float z",
    "float nx",
    "float ny",
    "float nz",
    "uint age",
    "uint lifetime",
    "uint fire",
];

/// See [`PARTICLE_UNITS`].
const POINT_UNITS: &str = "world space, front by front; travelled in world units; inert 0 moves, 1 at a border, 2 where it has burnt, 3 lost";

/// PLY's type and name of each property, in the order of the fields of [`PointState`].
const POINT_PROPERTIES: &[&str] = &[
    "float x",
    "float y",
    "float z",
    "float hx",
    "float hy",
    "float hz",
    "uint face",
    "uint fire",
    "uint ring",
    "float travelled",
    "uint inert",
];

/// Records turned to bytes at a time, so that a dump costs no second copy of itself.
const RECORDS_A_WRITE: usize = 4096;

/// Where the dump of a population at a frame goes: `DIR/POPULATION-FRAME.ply`, the frame with at least 4 digits.
pub fn dump_path(dir: &Path, population: &str, frame_number: u32) -> PathBuf {
    dir.join(format!("{population}-{frame_number:04}.ply"))
}

/// Writes particles as a PLY, whole or not at all; folders that are missing above it are created.
///
/// # Errors
/// The user's fault: a path that cannot be a file. The machine's: it cannot be written.
pub fn write_particles(path: &Path, records: &[ParticleState]) -> Result<(), OutputError> {
    write(path, PARTICLE_UNITS, PARTICLE_PROPERTIES, records)
}

/// Writes boids as [`write_particles`] does particles.
///
/// # Errors
/// As [`write_particles`].
pub fn write_boids(path: &Path, records: &[BoidState]) -> Result<(), OutputError> {
    write(path, BOID_UNITS, BOID_PROPERTIES, records)
}

/// Writes flames as [`write_particles`] does particles.
///
/// # Errors
/// As [`write_particles`].
pub fn write_flames(path: &Path, records: &[FlameState]) -> Result<(), OutputError> {
    write(path, FLAME_UNITS, FLAME_PROPERTIES, records)
}

/// Writes control points as [`write_particles`] does particles.
///
/// # Errors
/// As [`write_particles`].
pub fn write_points(path: &Path, records: &[PointState]) -> Result<(), OutputError> {
    write(path, POINT_UNITS, POINT_PROPERTIES, records)
}

fn write(
    path: &Path,
    units: &str,
    properties: &[&str],
    records: &[impl Pod],
) -> Result<(), OutputError> {
    let mut file = AtomicFile::create(path)?;
    let mut write = || {
        file.write_all(header(units, properties, records.len()).as_bytes())?;
        for chunk in records.chunks(RECORDS_A_WRITE) {
            if cfg!(target_endian = "little") {
                file.write_all(bytemuck::cast_slice(chunk))?;
            } else {
                let words: &[u32] = bytemuck::cast_slice(chunk);
                let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
                file.write_all(&bytes)?;
            }
        }
        Ok(())
    };
    let written = write();
    written.map_err(|error| file.error(error))?;
    file.commit()
}

fn header(units: &str, properties: &[&str], record_count: usize) -> String {
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment {units}\n\
         element vertex {record_count}\n"
    );
    for property in properties {
        header.push_str("property ");
        header.push_str(property);
        header.push('\n');
    }
    header.push_str("end_header\n");
    header
}
