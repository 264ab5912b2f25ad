//! `motes render`: a scene becomes pictures, an animation, statistics and dumps.

mod collisions;
mod job;

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::CliError;
use crate::output::{FrameSink, OutputTarget, StatsWriter};
use crate::recording::{Recording, RefusedChange};
use crate::scene;
use crate::simulation::{self, AdapterChoice, Options, Simulation};
use job::{Job, Pictures};

/// Arguments of `motes render`.
#[derive(Debug, clap::Args)]
pub(super) struct RenderArgs {
    /// A TOML file, or the name of a built-in scene (`motes scenes` lists them)
    scene: String,
    /// Where to: a folder (a PNG a frame), name-%04d.png or name-%04d.exr (a file a frame), .png or
    /// .exr (one frame), .gif, .mp4 (through ffmpeg), .svg (one frame as lines). EXR is linear and
    /// not clamped [default: PNGs under out/SCENE/]
    #[arg(short, long, value_name = "OUT")]
    output: Option<String>,
    /// Frames to draw, from A to before B [default: the whole scene]
    #[arg(long, value_name = "A..B", value_parser = parse_frames, conflicts_with = "frame")]
    frames: Option<Range<u32>>,
    /// Draw this frame alone; the simulation starts as late as particles' lifetimes allow
    #[arg(long, value_name = "N")]
    frame: Option<u32>,
    /// Write each layer of the picture beside it, with alpha: name-LAYER.png, or .exr where that
    /// is the output. Layers sum to the picture in light, before it is made linear for an EXR;
    /// PNGs round that to bytes
    #[arg(long)]
    layers: bool,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<(u32, u32)>,
    /// Seed of every random decision [default: the scene's]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// auto, cpu, or part of an adapter's name
    #[arg(long, value_name = "A", env = "MOTES_ADAPTER", default_value = "auto")]
    adapter: String,
    /// Write what happened in each frame: births, deaths, digests
    #[arg(long, value_name = "FILE.csv")]
    stats: Option<PathBuf>,
    /// Write the particles of these frames as PLY files
    #[arg(long, value_name = "N,N,…", value_delimiter = ',')]
    dump: Vec<u32>,
    /// Where dumps go [default: out/SCENE/]
    #[arg(long, value_name = "DIR")]
    dump_dir: Option<PathBuf>,
    /// Change a key of the scene, e.g. camera.vertical_fov_degrees=30
    #[arg(long, value_name = "path.to.key=value")]
    set: Vec<String>,
    /// Replay changes: lines of `FRAME path.to.key=value`
    #[arg(long, value_name = "FILE")]
    inputs: Option<PathBuf>,
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

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let expected = "a size is WxH in pixels, e.g. 1280x720";
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or(expected)?;
    let side = |text: &str| text.trim().parse().map_err(|_| expected.to_owned());
    Ok((side(width)?, side(height)?))
}

/// As long as a scene can be.
const MOST_FRAMES: u32 = 1_000_000;

pub(super) fn run(args: RenderArgs) -> Result<u8, CliError> {
    let mut sets = args.set.clone();
    if let Some((width, height)) = args.size {
        sets.push(format!("image.width={width}"));
        sets.push(format!("image.height={height}"));
    }
    if let Some(seed) = args.seed {
        sets.push(format!("seed={seed}"));
    }
    let scene = scene::load_with(&args.scene, &sets)?;
    let frames = match (args.frame, &args.frames) {
        (Some(frame), _) if frame >= MOST_FRAMES => {
            return Err(CliError::usage(
                format!("frame {frame} is too late"),
                format!("frames are below {MOST_FRAMES}"),
            ));
        }
        (Some(frame), _) => frame..frame + 1,
        (None, Some(frames)) => frames.clone(),
        (None, None) => 0..scene.frames,
    };
    let folder = Path::new("out").join(&scene.name);
    let dump_dir = args.dump_dir.clone().unwrap_or_else(|| folder.clone());
    if let Some(frame) = args.dump.iter().find(|frame| !frames.contains(frame)) {
        return Err(CliError::usage(
            format!("frame {frame} is to be dumped but is not rendered"),
            format!(
                "frames are {}..{}; say others with --frames",
                frames.start, frames.end
            ),
        ));
    }
    let target = match &args.output {
        Some(out) => OutputTarget::parse(out)?,
        None => OutputTarget::Folder(folder),
    };
    collisions::refuse(
        &target,
        &frames,
        &if args.layers {
            scene.layer_names()
        } else {
            Vec::new()
        },
        args.stats.as_deref(),
        &args.dump,
        &dump_dir,
    )?;
    if args.layers && target.layer_path(0, "").is_none() {
        return Err(CliError::usage(
            "--layers writes files beside those of the frames, and this output has none",
            "a folder, name-%04d.png or name.png, or .exr instead of .png, after -o",
        ));
    }
    if matches!(target, OutputTarget::Svg(_)) && frames.len() > 1 {
        return Err(CliError::usage(
            format!(
                "a line drawing holds one frame, and there are {}",
                frames.len()
            ),
            "pick one with --frame",
        ));
    }
    let turns = match &args.inputs {
        Some(path) => {
            let turns = recording_of(path)?.turns(&args.scene, &sets);
            turns.map_err(|e| refused_change(&e, path))?
        }
        None => Vec::new(),
    };
    let mut simulation = Simulation::new(
        &scene,
        &Options {
            adapter: AdapterChoice::parse(&args.adapter),
            frame_end: frames.end,
            turns,
            ..Options::default()
        },
    )?;
    let adapter = simulation.adapter_name();
    if AdapterChoice::parse(&args.adapter) == AdapterChoice::Auto && adapter.starts_with("cpu") {
        let why = if simulation::adapters().is_empty() {
            "there is no graphics adapter here"
        } else {
            "no graphics adapter here has room for this scene"
        };
        eprintln!("motes: {why}; the processor makes the same bits");
    }
    eprintln!("motes: {} on {adapter}", scene.name);
    let pictures = match &target {
        OutputTarget::Svg(path) => Pictures::Lines(path.clone()),
        target => Pictures::Frames(FrameSink::open(
            target,
            scene.image.width,
            scene.image.height,
            f64::from(scene.frame_rate),
            frames.len() as u32,
        )?),
    };
    let mut job = Job {
        pictures,
        layers_beside: args.layers.then_some(&target),
        stats: args.stats.as_deref().map(StatsWriter::create).transpose()?,
        dumps: &args.dump,
        dump_dir: &dump_dir,
        image_digests: BTreeMap::new(),
        state_digests: BTreeMap::new(),
    };
    let dropped = job.run(&mut simulation, &scene, &frames)?;
    let written = job.finish()?;
    if written.left_out > 0 {
        eprintln!(
            "motes: {} frames were left out to keep the animation's speed: a GIF shows at most 50 a second",
            written.left_out
        );
    }
    if dropped > 0 {
        eprintln!(
            "motes: {dropped} births were dropped for want of room; raise the scene's `capacity` ({})",
            simulation.plan().capacity
        );
    }
    // As it was asked for: a pattern's own path would be that of frame 0, drawn or not.
    let place = args
        .output
        .unwrap_or_else(|| target.path().display().to_string());
    eprintln!("motes: wrote {place}");
    Ok(0)
}

fn recording_of(path: &Path) -> Result<Recording, CliError> {
    let text = std::fs::read_to_string(path).map_err(|e| {
        CliError::usage(
            format!("{} cannot be read: {e}", path.display()),
            "name a text file",
        )
    })?;
    Ok(Recording::parse(&text, &path.display().to_string())?)
}

/// A change that the scene refuses: where it stands, and below that what the scene says.
fn refused_change(refused: &RefusedChange, path: &Path) -> CliError {
    let (file, line) = (path.display(), refused.change.line);
    let why = refused.message.trim_start_matches("error: ");
    CliError {
        message: format!("error: {file}:{line}: the scene refuses this change\n{why}"),
        code: 2,
    }
}
