//! The statistics of a run: one row a population a frame, and one a drawn frame for its picture.

use std::borrow::Cow;
use std::io::Write;
use std::path::Path;

use super::OutputError;
use super::atomic::AtomicFile;

/// The first line of the file. Scripts depend on it.
const HEADER: &str = "frame,population,kind,requested,born,died,live,dropped,digest,\
                      died_of_age,died_of_intensity,died_of_bounds";

/// What happened to a population of particles in one frame.
///
/// `requested = born + dropped`, and `live` is that of the frame before, plus `born`, minus `died`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ParticleCounts {
    /// Births that the scene asked for.
    pub requested: u64,
    /// Births that took place.
    pub born: u64,
    /// Deaths, by any cause.
    pub died: u64,
    /// Records that live after the frame's step.
    pub live: u64,
    /// Births that did not fit.
    pub dropped: u64,
    /// Deaths for want of light.
    pub died_of_intensity: u64,
    /// Deaths out of bounds; the rest of `died` is of age.
    pub died_of_bounds: u64,
}

/// What happened to a population of boids in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BoidCounts {
    /// Those who began: all of them in the run's first frame, then none.
    pub born: u64,
    /// All of them.
    pub live: u64,
}

/// What happened to a population of flames in one frame: nobody is left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FlameCounts {
    /// Those that were kindled; in a run's first frame, all that burn.
    pub born: u64,
    /// Those that went out.
    pub died: u64,
    /// Those that burn.
    pub live: u64,
}

/// What a row is about, with the numbers that such a row has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// A population of particles (`particles`).
    Particles(ParticleCounts),
    /// A population of boids (`boids`): nobody is left out and nobody dies.
    Boids(BoidCounts),
    /// A population of flames (`flames`).
    Flames(FlameCounts),
    /// A drawn frame (`image`); its counts stay empty, and its digest is that of its RGBA8 pixels.
    Image,
}

/// One row of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatsRow<'a> {
    /// Number of the frame, from 0.
    pub frame: u32,
    /// Name of the population; any text, quoted where CSV needs it.
    pub population: &'a str,
    /// Kind and counts.
    pub measured: Measured,
    /// Digest of the state or the picture (16 hexadecimal digits); None where none was asked for (empty).
    pub digest: Option<u64>,
}

/// A statistics file being written; it appears when [`StatsWriter::finish`] is called, and not at all when dropped before.
///
/// Lines end with a line feed.
pub struct StatsWriter {
    file: AtomicFile,
}

impl StatsWriter {
    /// Starts the file with its header; folders that are missing above it are created.
    ///
    /// # Errors
    /// The user's fault: a path that cannot be a file. The machine's: it cannot be written.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let mut writer = Self {
            file: AtomicFile::create(path)?,
        };
        writer.line(HEADER)?;
        Ok(writer)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The machine's fault: it cannot be written.
    pub fn row(&mut self, row: &StatsRow<'_>) -> Result<(), OutputError> {
        self.line(&row.to_line())
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// The machine's fault: it cannot be written or renamed.
    pub fn finish(self) -> Result<(), OutputError> {
        self.file.commit()
    }

    /// Adds a line that [`StatsRow::to_line`] made.
    pub(crate) fn line(&mut self, line: &str) -> Result<(), OutputError> {
        writeln!(self.file, "{line}").map_err(|error| self.file.error(error))
    }
}

impl StatsRow<'_> {
    /// The row as it stands in the file, without a line feed.
    pub fn to_line(&self) -> String {
        let StatsRow {
            frame,
            population,
            measured,
            digest,
        } = *self;
        let population = quoted_field(population);
        let (measured, causes) = match measured {
            Measured::Particles(counts) => {
                let ParticleCounts {
                    requested,
                    born,
                    died,
                    live,
                    dropped,
                    died_of_intensity,
                    died_of_bounds,
                } = counts;
                let of_age = died.saturating_sub(died_of_intensity + died_of_bounds);
                (
                    format!("particles,{requested},{born},{died},{live},{dropped}"),
                    format!("{of_age},{died_of_intensity},{died_of_bounds}"),
                )
            }
            Measured::Boids(BoidCounts { born, live }) => {
                (format!("boids,{born},{born},0,{live},0"), ",,".to_owned())
            }
            Measured::Flames(FlameCounts { born, died, live }) => (
                format!("flames,{born},{born},{died},{live},0"),
                ",,".to_owned(),
            ),
            Measured::Image => ("image,,,,,".to_owned(), ",,".to_owned()),
        };
        let digest = digest.map_or(String::new(), |digest| format!("{digest:016x}"));
        format!("{frame},{population},{measured},{digest},{causes}")
    }
}

/// A field as RFC 4180 has it: quoted where it holds a comma, a quote or a line break, quotes doubled.
pub(crate) fn quoted_field(field: &str) -> Cow<'_, str> {
    if field.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", field.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(field)
    }
}
