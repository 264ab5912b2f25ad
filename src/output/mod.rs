//! Files that leave Motes: pictures, dumps of particles, statistics.
//!
//! Every file appears whole or not at all: it is written beside its place under a hidden name and renamed when it is
//! complete ([`FrameSink`], [`StatsWriter`], [`write_png`], [`write_particles`]). The same input gives the same bytes
//! on any machine and with any number of threads; an MP4's are also those of the ffmpeg that wrote it.
//!
//! | file | reads | said by |
//! |---|---|---|
//! | `target.rs` | what the user wrote after `-o` | [`OutputTarget`] |
//! | `sink.rs` | frames, one after another | [`FrameSink`] |
//! | `pattern.rs` | file names with a frame number | [`FramePattern`] |
//! | `picture.rs` | bytes, or linear light | [`Picture`] |
//! | `png.rs` | one picture | [`write_png`] |
//! | `exr.rs` | one picture, linear and unclamped | [`write_exr`] |
//! | `gif/` | an animation: palette, dithering, changes between frames | inside [`FrameSink`] |
//! | `mp4/` | a film, through ffmpeg | inside [`FrameSink`] |
//! | `folder.rs` | a folder of files | inside [`check::save`](crate::check::save) |
//! | `layer.rs` | light with alpha, one picture over another | [`Rgba8Image::into_layer`] |
//! | `svg.rs` | a line a particle | [`write_svg`] |
//! | `ply.rs` | a dump of one population | [`write_particles`] |
//! | `csv.rs` | one row a population a frame | [`StatsWriter`] |

mod atomic;
mod csv;
mod error;
mod exr;
mod folder;
mod gif;
mod hidden;
mod layer;
pub(crate) mod made;
mod mp4;
mod pattern;
mod picture;
mod ply;
mod png;
mod sink;
mod special;
mod svg;
mod target;

pub(crate) use atomic::{AtomicFile, probe};
pub(crate) use csv::quoted_field;
pub use csv::{
    BoidCounts, FlameCounts, MarkCounts, Measured, ParticleCounts, PointCounts, StatsRow,
    StatsWriter, SystemCounts,
};
pub use error::OutputError;
pub use exr::write_exr;
pub(crate) use folder::{AtomicFolder, write_whole};
pub(crate) use hidden::{hidden_prefix, remove_own, token};
pub use pattern::FramePattern;
pub use picture::{LinearImage, Picture, PictureRef, Pixels, Rgba8Image};
pub use ply::{dump_path, write_boids, write_flames, write_particles, write_points};
pub(crate) use png::read_png;
pub use png::write_png;
pub use sink::{FrameSink, Written};
pub(crate) use special::is_special;
pub use svg::{Drawing, write_svg};
pub use target::OutputTarget;
