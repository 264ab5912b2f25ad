//! Files that leave Motes: pictures, dumps of particles, statistics.
//!
//! Every file appears whole or not at all: it is written beside its place under a hidden name and renamed when it is
//! complete ([`FrameSink`], [`StatsWriter`], [`write_png`], [`write_particles`]). The same input gives the same bytes
//! on any machine and with any number of threads.
//!
//! | file | reads | said by |
//! |---|---|---|
//! | `target.rs` | what the user wrote after `-o` | [`OutputTarget`] |
//! | `sink.rs` | frames, one after another | [`FrameSink`] |
//! | `png.rs` | one picture | [`write_png`] |
//! | `gif/` | an animation: palette, dithering, changes between frames | inside [`FrameSink`] |
//! | `folder.rs` | a folder of files | inside [`check::save`](crate::check::save) |
//! | `layer.rs` | light with alpha, one picture over another | [`Rgba8Image::into_layer`] |
//! | `svg.rs` | a line a particle | [`write_svg`] |
//! | `ply.rs` | a dump of one population | [`write_particles`] |
//! | `csv.rs` | one row a population a frame | [`StatsWriter`] |

mod atomic;
mod csv;
mod error;
mod folder;
mod gif;
mod layer;
mod ply;
mod png;
mod sink;
mod svg;
mod target;

pub(crate) use atomic::create_folder;
pub use csv::{Measured, ParticleCounts, StatsRow, StatsWriter};
pub use error::OutputError;
pub(crate) use folder::{AtomicFolder, write_whole};
pub use ply::{ParticleRecord, dump_path, write_particles};
pub(crate) use png::read_png;
pub use png::write_png;
pub use sink::{FrameSink, Written};
pub use svg::{Drawing, write_svg};
pub use target::{FramePattern, OutputTarget};

/// A finished picture, 8 bits a channel, display-referred.
///
/// Alpha is straight (not premultiplied), as PNG has it; 255 everywhere for an ordinary frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgba8Image {
    /// Pixels a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Red, green, blue, alpha of every pixel, row by row, the top row first: `4 * width * height` bytes.
    pub pixels: Vec<u8>,
}

impl Rgba8Image {
    /// Whether the size is at least 1×1 and `pixels` is as long as the size says.
    pub fn is_consistent(&self) -> bool {
        let pixel_count = u64::from(self.width) * u64::from(self.height);
        pixel_count > 0 && pixel_count.checked_mul(4) == Some(self.pixels.len() as u64)
    }
}
