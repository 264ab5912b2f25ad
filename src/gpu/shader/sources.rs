//! The page that lists every WGSL file: the libraries under `wgsl/lib/` and the kernels.
//!
//! A kernel is one file with one compute entry point; its name is its path under `wgsl/` without
//! the ending, and its basename is that of its twin on the processor. One that is run twice, with other
//! switches, has a second name. A file in `wgsl/` that is
//! not listed here fails a test.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// One WGSL file, embedded in the program or standing in for one that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source<'a> {
    /// Path under `wgsl/` without its ending, e.g. `particles/advance` or `lib/exact`.
    pub name: &'static str,
    /// Path from the repository's root, as errors show it, e.g. `wgsl/particles/advance.wgsl`.
    pub file: &'static str,
    /// The file's text.
    pub text: &'a str,
}

macro_rules! source {
    ($name:literal) => {
        source!($name, $name)
    };
    ($name:literal, $file:literal) => {
        Source {
            name: $name,
            file: concat!("wgsl/", $file, ".wgsl"),
            text: include_str!(concat!("../../../wgsl/", $file, ".wgsl")),
        }
    };
}

/// Files by their names; `"again" => "first"` is a kernel that has another's file.
macro_rules! sources {
    ($($name:literal $(=> $file:literal)?),* $(,)?) => {
        &[$(source!($name $(, $file)?)),*]
    };
}

/// Files that kernels import from; each stands after those that it imports itself.
pub static LIBRARIES: &[Source] = sources![
    "lib/layout",
    "lib/dispatch",
    "lib/exact",
    "lib/transcendental",
    "lib/rng",
    "lib/noise",
    "lib/wind",
    "lib/area",
    "lib/light",
    "lib/packed",
    "lib/particle",
    "lib/emission",
    "lib/births",
    "lib/tree",
    "lib/inherit",
    "lib/projection",
    "lib/reach",
    "lib/disc",
    "lib/footprint",
    "lib/sprite",
    "lib/cluster",
    "lib/flame",
    "lib/detail",
    "lib/raster",
    "lib/stroke",
    "lib/shade",
    "lib/veil",
    "lib/pillar",
    "lib/fan",
    "lib/grid",
    "lib/boid",
    "lib/steering",
    "lib/strip",
    "lib/urge",
    "lib/solid",
    "lib/cover",
    "lib/behind",
    "lib/shape",
    "lib/sort",
    "lib/tile",
    "lib/flame_tile",
    "lib/walk",
    "lib/meet",
    "lib/grain",
    "lib/drops",
];

/// Kernels, in the order of the frame.
pub static KERNELS: &[Source] = sources![
    "tree/bear",
    "tree/settle",
    "tree/found",
    "tree/pose",
    "spread/front",
    "spread/walk",
    "spread/arrive",
    "spread/enlist",
    "spread/block",
    "spread/gaps",
    "spread/sum_gaps",
    "spread/book",
    "spread/burning",
    "spread/drop",
    "spread/insert",
    "spread/ignite",
    "systems/births",
    "systems/offsets",
    "particles/emit",
    "particles/cull",
    "scan/count_bits",
    "scan/sum_runs",
    "scan/survivors",
    "scan/spread_runs",
    "scan/spread_bits",
    "scan/pages",
    "particles/advance",
    "flock/hatch",
    "flock/count_cells",
    "flock/sum_cells",
    "flock/cell_offsets",
    "flock/spread_cells",
    "flock/cell_members",
    "flock/cells",
    "flock/steer",
    "flock/steer_again" => "flock/steer",
    "flames/kindle",
    "flames/dropped",
    "flames/trace",
    "spread/catch",
    "spread/caught",
    "flames/shine",
    "flames/gather",
    "particles/span",
    "particles/shed",
    "particles/cluster",
    "draw/ground",
    "draw/surface_raster",
    "draw/surface_work",
    "draw/surface",
    "draw/deposit",
    "draw/shade",
    "draw/shapes",
    "draw/boid_shapes",
    "draw/boid_trails",
    "draw/marks",
    "draw/front_lines",
    "draw/smoke",
    "draw/strokes",
    "draw/cover_work",
    "draw/cover_keys",
    "sort/count_digits",
    "sort/sum_digits",
    "sort/start_digits",
    "sort/place_digits",
    "draw/clear_tiles",
    "draw/bin",
    "draw/cover",
    "draw/dim",
    "draw/planet",
    "draw/splat",
    "draw/large_work",
    "draw/splat_large",
    "draw/hide",
    "draw/flame_discs",
    "draw/clear_flame_tiles",
    "draw/bin_flames",
    "draw/glow_work",
    "draw/glow",
    "draw/glow_small",
    "draw/strip_joints",
    "draw/strips",
    "draw/resolve",
    "draw/unpack",
    "digest/digest",
];

/// Kernels that only devices with 64-bit integers run.
pub static WIDE_KERNELS: &[&str] = &["draw/unpack", "bench/copy_wide", "flock/steer_again"];

/// Kernels of no frame: what others are measured against.
pub static YARDSTICKS: &[Source] = sources![
    "bench/copy",
    "bench/copy_vec4",
    "bench/copy_wide",
    "bench/copy_runs",
    "bench/copy_strides",
    "bench/read_only",
    "bench/write_only",
    "bench/atomic_spread",
    "bench/atomic_contended",
    "bench/noise_simplex",
    "bench/noise_lattice",
];

/// Shaders of the device's own rasteriser, plain WGSL: its light is not exact.
pub static RASTERS: &[Source] = sources!["bench/raster"];

/// WGSL files that stand in for those of the program while somebody works on them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KernelTexts {
    /// Names, and texts that differ from the program's.
    texts: Vec<(&'static str, String)>,
}

impl KernelTexts {
    /// Reads those files below `folder` that are called as those below `wgsl/`; the program has its own
    /// where there is none.
    ///
    /// # Errors
    /// A file is there and cannot be read, or none is there; which.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let mut texts = Vec::new();
        let mut count = 0;
        for (source, path) in Self::sources().zip(Self::files(folder)) {
            match std::fs::read_to_string(&path) {
                Ok(text) => {
                    count += 1;
                    if text != source.text {
                        texts.push((source.name, text));
                    }
                }
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                Err(error) => return Err(format!("{}: {error}", path.display())),
            }
        }
        if count == 0 {
            let shown = folder.display();
            return Err(format!(
                "{shown}: there is no kernel in it, as particles/advance.wgsl is one"
            ));
        }
        Ok(Self { texts })
    }

    /// Where they would be below `folder`.
    pub fn files(folder: &Path) -> impl Iterator<Item = PathBuf> {
        Self::sources().map(move |source| {
            let file = source.file.strip_prefix("wgsl/");
            folder.join(file.unwrap_or(source.file))
        })
    }

    fn sources() -> impl Iterator<Item = &'static Source<'static>> {
        LIBRARIES.iter().chain(KERNELS)
    }

    /// The file with the text that stands in for its own.
    pub(super) fn of<'a>(&'a self, source: &Source<'a>) -> Source<'a> {
        let own = self.texts.iter().find(|(name, _)| *name == source.name);
        own.map_or(*source, |(_, text)| Source { text, ..*source })
    }

    /// The libraries, if any is another than the program's.
    pub(super) fn libraries(&self) -> Option<Vec<Source<'_>>> {
        let mut names = self.texts.iter().map(|(name, _)| name);
        names
            .any(|name| name.starts_with("lib/"))
            .then(|| LIBRARIES.iter().map(|it| self.of(it)).collect())
    }
}

/// The listed file of that name, kernel or library.
pub fn find(name: &str) -> Option<&'static Source<'static>> {
    KERNELS
        .iter()
        .chain(YARDSTICKS)
        .chain(LIBRARIES)
        .find(|s| s.name == name)
}
