//! Dumps of a population: binary little-endian PLY, one vertex a record, readable by any point cloud viewer.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::OutputError;
use super::atomic::AtomicFile;
use crate::simulation::ParticleState;

/// PLY's type and name of each property, in the order of the fields of [`ParticleState`].
const PROPERTIES: [&str; 10] = [
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
    let mut file = AtomicFile::create(path)?;
    let mut write = || {
        file.write_all(header(records.len()).as_bytes())?;
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

fn header(record_count: usize) -> String {
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\n\
         comment world space; velocity per frame; age and lifetime in frames\n\
         element vertex {record_count}\n"
    );
    for property in PROPERTIES {
        header.push_str("property ");
        header.push_str(property);
        header.push('\n');
    }
    header.push_str("end_header\n");
    header
}
