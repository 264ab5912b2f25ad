//! The statistics of a run: one row a population a frame, and one a drawn frame for its picture.

use std::borrow::Cow;
use std::io::Write;
use std::path::Path;

use super::OutputError;
use super::atomic::AtomicFile;
use crate::simulation::FlockMetrics;

/// The first line of the file. Scripts depend on it.
const HEADER: &str = "frame,population,kind,requested,born,died,live,dropped,digest,\
                      died_of_age,died_of_intensity,died_of_bounds,\
                      polarisation,mean_speed,median_nearest_distance,mean_neighbours";

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

/// What happened to the systems that others bear in one frame: `live` is that of the frame before,
/// plus `born`, minus `died`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SystemCounts {
    /// Systems that were to be born.
    pub requested: u64,
    /// Systems that were born; for the rest there was no slot.
    pub born: u64,
    /// Systems whose lifetime was over.
    pub died: u64,
    /// Systems that live.
    pub live: u64,
}

/// What happened to a population of boids in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BoidCounts {
    /// Those who began: all of them in the run's first frame, then none.
    pub born: u64,
    /// All of them.
    pub live: u64,
}

/// What happened to a population of flames in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FlameCounts {
    /// Those that were to be kindled.
    pub requested: u64,
    /// Those that were; in a run's first frame, all that burn. For the rest there was no room.
    pub born: u64,
    /// Those that went out.
    pub died: u64,
    /// Those that burn.
    pub live: u64,
}

/// What happened to the control points of fires that spread in one frame: `live` is that of the frame
/// before, plus `born`, minus `died`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PointCounts {
    /// Points that were to be ignited or inserted.
    pub requested: u64,
    /// Those that were; for the rest there was no room.
    pub born: u64,
    /// Points that came to rest, at a border or where it has burnt.
    pub died: u64,
    /// Points that move.
    pub live: u64,
}

/// What happened to the marks of flames that have gone out in one frame: `live` is that of the frame
/// before, plus `born`, minus `died`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MarkCounts {
    /// Flames that have gone out.
    pub born: u64,
    /// Marks that have lost their places to newer ones.
    pub died: u64,
    /// Marks that are there.
    pub live: u64,
}

/// What a row is about, with the numbers that such a row has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measured {
    /// A population of particles (`particles`).
    Particles(ParticleCounts),
    /// Systems that others bear (`systems`).
    Systems(SystemCounts),
    /// A population of boids (`boids`): nobody is left out and nobody dies.
    Boids(BoidCounts),
    /// One flock of them (`flock`), of which `born` began in this frame; its digest stays empty.
    Flock {
        /// As of [`BoidCounts`].
        born: u64,
        /// What the flock has come to, with 32 bits of precision.
        metrics: FlockMetrics,
    },
    /// A population of flames (`flames`).
    Flames(FlameCounts),
    /// Control points of fires that spread (`spread`).
    Points(PointCounts),
    /// Marks of flames that have gone out (`char`); its digest stays empty.
    Marks(MarkCounts),
    /// A drawn frame (`image`); its counts stay empty, and its digest is that of its RGBA8 pixels.
    Image,
}

/// One row of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
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
            file: AtomicFile::begin(path)?,
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
        let (measured, causes, metrics) = match measured {
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
                    None,
                )
            }
            Measured::Systems(counts) => {
                let SystemCounts {
                    requested,
                    born,
                    died,
                    live,
                } = counts;
                let dropped = requested.saturating_sub(born);
                let counts = format!("systems,{requested},{born},{died},{live},{dropped}");
                (counts, format!("{died},,"), None)
            }
            Measured::Boids(BoidCounts { born, live }) => {
                let counts = format!("boids,{born},{born},0,{live},0");
                (counts, ",,".to_owned(), None)
            }
            Measured::Flock { born, metrics } => {
                let counts = format!("flock,{born},{born},0,{},0", metrics.count);
                (counts, ",,".to_owned(), Some(metrics))
            }
            Measured::Flames(counts) => {
                let FlameCounts {
                    requested,
                    born,
                    died,
                    live,
                } = counts;
                let dropped = requested.saturating_sub(born);
                let counts = format!("flames,{requested},{born},{died},{live},{dropped}");
                (counts, ",,".to_owned(), None)
            }
            Measured::Points(counts) => {
                let PointCounts {
                    requested,
                    born,
                    died,
                    live,
                } = counts;
                let dropped = requested.saturating_sub(born);
                let counts = format!("spread,{requested},{born},{died},{live},{dropped}");
                (counts, ",,".to_owned(), None)
            }
            Measured::Marks(MarkCounts { born, died, live }) => {
                let counts = format!("char,{born},{born},{died},{live},0");
                (counts, ",,".to_owned(), None)
            }
            Measured::Image => ("image,,,,,".to_owned(), ",,".to_owned(), None),
        };
        let metrics = metrics.map_or(",,,".to_owned(), metrics_fields);
        let digest = digest.map_or(String::new(), |digest| format!("{digest:016x}"));
        format!("{frame},{population},{measured},{digest},{causes},{metrics}")
    }
}

fn metrics_fields(metrics: FlockMetrics) -> String {
    let FlockMetrics {
        polarisation,
        mean_speed,
        median_nearest_distance,
        mean_neighbours,
        ..
    } = metrics;
    let distance = median_nearest_distance.map_or(String::new(), text_of);
    let [polarisation, speed, neighbours] =
        [polarisation, mean_speed, mean_neighbours].map(text_of);
    format!("{polarisation},{speed},{distance},{neighbours}")
}

/// The shortest text that means the nearest number of 32 bits.
fn text_of(number: f64) -> String {
    (number as f32).to_string()
}

/// A field as RFC 4180 has it: quoted where it holds a comma, a quote or a line break, quotes doubled.
pub(crate) fn quoted_field(field: &str) -> Cow<'_, str> {
    if field.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", field.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(field)
    }
}
