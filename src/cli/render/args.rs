//! The arguments of `motes render`.

use std::ops::Range;
use std::path::PathBuf;

use crate::cli::names::SceneName;
use crate::scene::Loader;

/// Arguments of `motes render`.
#[derive(Debug, clap::Args)]
// Said outright: else errors about what is missing list what the environment gives.
#[command(override_usage = "motes render [OPTIONS] <SCENE>")]
pub(in crate::cli) struct RenderArgs {
    /// A TOML file, or the name of a built-in scene (`motes scenes` lists them)
    #[arg(value_parser = SceneName, hide_possible_values = true)]
    pub(super) scene: String,
    /// Where to: a folder (a PNG a frame), name-%04d.png or name-%04d.exr (a file a frame), .png or
    /// .exr (one frame), .gif, .mp4 (through ffmpeg), .svg (one frame as lines). EXR is linear and
    /// not clamped [default: PNGs under out/SCENE/]
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: Option<String>,
    /// Frames to draw, from A to before B [default: the whole scene]
    #[arg(long, value_name = "A..B", value_parser = parse_frames, conflicts_with = "frame", allow_hyphen_values = true)]
    pub(super) frames: Option<Range<u32>>,
    /// Draw this frame alone; the simulation starts as late as particles' lifetimes allow
    #[arg(long, value_name = "N", value_parser = parse_frame, allow_hyphen_values = true)]
    pub(super) frame: Option<u32>,
    /// Write each layer of the picture beside it, with alpha: name-LAYER.png, or .exr where that
    /// is the output; planet, ground and surfaces are the layer `surfaces`. Layers sum to the
    /// picture in light, before it is made linear for an EXR; PNGs round that to bytes
    #[arg(long)]
    pub(super) layers: bool,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(super) size: Option<(u32, u32)>,
    /// Seed of every random decision [default: the scene's]
    #[arg(long, value_name = "N", value_parser = parse_seed, allow_hyphen_values = true)]
    pub(super) seed: Option<u64>,
    /// auto, cpu, or part of an adapter's name
    #[arg(long, value_name = "A", env = "MOTES_ADAPTER", default_value = "auto")]
    pub(super) adapter: String,
    /// Write what happened in each frame: births, deaths, digests
    #[arg(long, value_name = "FILE.csv")]
    pub(super) stats: Option<PathBuf>,
    /// Write the particles of these frames as PLY files
    #[arg(long, value_name = "N,N,…", value_delimiter = ',', value_parser = parse_dump, allow_hyphen_values = true)]
    pub(super) dump: Vec<u32>,
    /// Where dumps go [default: out/SCENE/]
    #[arg(long, value_name = "DIR", requires = "dump")]
    pub(super) dump_dir: Option<PathBuf>,
    /// Change a key of the scene, e.g. camera.vertical_fov_degrees=30; `unset` leaves it out
    #[arg(long, value_name = "path.to.key=value")]
    pub(super) set: Vec<String>,
    /// Let the scene read files outside of its folder
    #[arg(long)]
    pub(super) allow_outside: bool,
    /// Replay changes: lines of `FRAME path.to.key=value`
    #[arg(long, value_name = "FILE")]
    pub(super) inputs: Option<PathBuf>,
    /// Go on where a run of the same command was stopped or killed, with the same bits. An
    /// animation can go on if it was begun with this, too: its frames are kept meanwhile
    #[arg(long)]
    pub(super) resume: bool,
    /// Refuse to write over files that are there [default: they are replaced]
    #[arg(short, long)]
    pub(super) no_clobber: bool,
    /// Time between two snapshots of the state, kept to resume from where particles live without
    /// limit or births are dropped
    #[arg(long, value_name = "SECS", default_value_t = 30.0, value_parser = parse_secs, allow_hyphen_values = true)]
    pub(super) snapshot_every: f64,
}

impl RenderArgs {
    /// How the scene is loaded.
    pub(super) fn loader(&self) -> Loader {
        Loader {
            allow_outside: self.allow_outside,
        }
    }
}

fn parse_secs(text: &str) -> Result<f64, String> {
    let secs = text.trim().parse().ok();
    secs.filter(|secs| (0.0..=1e6).contains(secs))
        .ok_or_else(|| "seconds are a number from 0 to 1000000, e.g. 30".to_owned())
}

fn parse_frame(text: &str) -> Result<u32, String> {
    let frame = text.trim().parse().ok();
    frame
        .filter(|frame| *frame < MOST_FRAMES)
        .ok_or_else(|| format!("a frame is a whole number below {MOST_FRAMES}, e.g. 24"))
}

fn parse_dump(text: &str) -> Result<u32, String> {
    parse_frame(text).map_err(|_| {
        format!("frames are whole numbers below {MOST_FRAMES} with commas between, e.g. 0,12,24")
    })
}

fn parse_seed(text: &str) -> Result<u64, String> {
    // As large as a scene file's.
    let most = i64::MAX.cast_unsigned();
    let seed = text.trim().parse().ok();
    seed.filter(|seed| *seed <= most)
        .ok_or_else(|| format!("a seed is a whole number from 0 to {most}, e.g. 7"))
}

fn parse_frames(text: &str) -> Result<Range<u32>, String> {
    let expected = "frames are A..B with A before B, e.g. 0..48";
    let (start, end) = text.split_once("..").ok_or(expected)?;
    let start: u32 = start.trim().parse().map_err(|_| expected)?;
    let end: u32 = end.trim().parse().map_err(|_| expected)?;
    if start >= end || end > MOST_FRAMES {
        return Err(format!("{expected}, at most {MOST_FRAMES}"));
    }
    Ok(start..end)
}

pub(in crate::cli) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let expected = "a size is WxH in pixels, e.g. 1280x720";
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or(expected)?;
    let side = |text: &str| text.trim().parse().map_err(|_| expected.to_owned());
    Ok((side(width)?, side(height)?))
}

/// As long as a scene can be.
pub(super) const MOST_FRAMES: u32 = 1_000_000;
