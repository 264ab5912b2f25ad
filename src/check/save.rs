//! The folder that goes to a driver's writers: a stage with its kernels, what it reads, what it
//! should have made and what it made.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::{Difference, Place};
use crate::backend::{BufferRecord, Groups, StageRecord};
use crate::output::{AtomicFolder, OutputError};

/// What a saved difference was found in, for its README.
#[derive(Clone, Copy, Debug)]
pub struct SavedFor<'a> {
    /// Name of the scene; a part of the folder's name.
    pub scene: &'a str,
    /// Adapter under test, with its driver.
    pub tested: &'a str,
    /// What it was compared with.
    pub against: &'a str,
    /// The command that finds the difference again.
    pub command: &'a str,
}

/// Saves a difference in a new folder `SCENE-frame-NNNN-STAGE` in `folder`; its path. A stage that
/// no device ran is saved without kernels and inputs, a difference that did not happen again with
/// a README alone.
///
/// # Errors
/// The folder cannot be written. Then nothing of it is left.
pub fn save(
    folder: &Path,
    difference: &Difference,
    context: &SavedFor,
) -> Result<PathBuf, OutputError> {
    let stage = difference
        .place
        .as_ref()
        .map_or("unlocated", |place| place.stage);
    let scene: String = context
        .scene
        .chars()
        .map(|c| {
            if c.is_alphanumeric() || "-_".contains(c) {
                c
            } else {
                '-'
            }
        })
        .take(64)
        .collect();
    let name = format!("{scene}-frame-{:04}-{stage}", difference.frame);
    let saved = AtomicFolder::create(folder, &name)?;
    saved.write("README.txt", readme(difference, context).as_bytes())?;
    if let Some(place) = &difference.place {
        for (side, words) in [("expected", &place.expected), ("got", &place.got)] {
            saved.write(&format!("{side}/{}.bin", place.buffer), &bytes(words))?;
        }
    }
    if let Some(record) = &difference.record {
        save_record(&saved, record)?;
    }
    saved.commit()
}

fn save_record(saved: &AtomicFolder, record: &StageRecord) -> Result<(), OutputError> {
    for kernel in &record.kernels {
        let name = file_name(&kernel.name);
        saved.write(&format!("kernels/{name}.spv"), &bytes(&kernel.spirv))?;
        saved.write(&format!("kernels/{name}.wgsl"), kernel.wgsl.as_bytes())?;
    }
    for buffer in &record.buffers {
        saved.write(
            &format!("inputs/{}.bin", buffer.name),
            &bytes(&buffer.words),
        )?;
    }
    saved.write("dispatches.txt", dispatches(record).as_bytes())
}

/// `particles/advance` as the name of a file.
fn file_name(kernel: &str) -> String {
    kernel.replace('/', "-")
}

/// Little-endian, whatever the machine.
fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn readme(difference: &Difference, context: &SavedFor) -> String {
    let SavedFor {
        scene,
        tested,
        against,
        command,
    } = context;
    let mut text = format!(
        "The same scene, run twice, came out differently.\n\n\
         Adapter under test: {tested}\n\
         Compared with:      {against}\n\
         Scene:              {scene}\n\
         Program:            motes {}, {} {}\n\
         Found again with:   {command}\n\n{difference}\n",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::OS,
        std::env::consts::ARCH,
    );
    if let Some(place) = &difference.place {
        text += &files(place, difference.record.as_ref());
    }
    text
}

fn files(place: &Place, record: Option<&StageRecord>) -> String {
    let buffer = place.buffer;
    let mut text = format!(
        "\nFiles (binary ones are little-endian 32-bit words):\n\
         expected/{buffer}.bin  the buffer's live records after the stage, {} words\n\
         got/{buffer}.bin       the same, as the adapter under test has them, {} words\n",
        place.expected.len(),
        place.got.len()
    );
    if let Some(record) = record {
        text += &format!(
            "kernels/*.spv           what {} ran, {}: SPIR-V 1.3, float arithmetic decorated NoContraction\n\
             kernels/*.wgsl          the same as WGSL\n\
             inputs/*.bin            every bound buffer, whole, before the stage\n\
             dispatches.txt          what the stage dispatches, in order\n",
            record.adapter, record.driver
        );
    }
    text
}

fn dispatches(record: &StageRecord) -> String {
    let mut text = String::from(
        "# Dispatches of the stage, in order; each sees what those before it wrote.\n\
         # Compute, all buffers in descriptor set 0, immediates are push constants from byte 0.\n\
         # inputs/dispatches.bin is as the stage leaves it: indirect sizes are those that ran.\n",
    );
    for (at, dispatch) in record.dispatches.iter().enumerate() {
        let name = &dispatch.kernel;
        let kernel = record.kernels.iter().find(|kernel| kernel.name == *name);
        let (entry, size) = kernel.map_or(("", [0; 3]), |kernel| {
            (kernel.entry_point.as_str(), kernel.workgroup_size)
        });
        let (groups, source) = match dispatch.groups {
            Groups::Direct(groups) => (groups, "direct".to_owned()),
            Groups::Listed(index) => (
                listed(record.buffer("dispatches"), index),
                format!("indirect, dispatches[{index}]"),
            ),
        };
        let immediates: Vec<String> = dispatch
            .immediates
            .iter()
            .map(|word| format!("{word:#010x}"))
            .collect();
        // Writing to a String cannot fail.
        let _ = write!(
            text,
            "\ndispatch {at}\n  kernel {}.spv\n  entry_point {entry}\n  workgroup_size {} {} {}\n  \
             workgroups {} {} {} ({source})\n  immediates {}\n",
            file_name(name),
            size[0],
            size[1],
            size[2],
            groups[0],
            groups[1],
            groups[2],
            if immediates.is_empty() {
                "none".to_owned()
            } else {
                immediates.join(" ")
            },
        );
        for binding in &dispatch.bindings {
            let _ = writeln!(
                text,
                "  binding {} {} {} inputs/{}.bin",
                binding.binding, binding.variable, binding.access, binding.buffer
            );
        }
    }
    text
}

/// The workgroups that stand at `index` of the list.
fn listed(list: Option<&BufferRecord>, index: u32) -> [u32; 3] {
    let first = index as usize * 3;
    list.and_then(|list| list.words.get(first..first + 3))
        .map_or([0; 3], |groups| [groups[0], groups[1], groups[2]])
}
