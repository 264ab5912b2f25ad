//! `motes view`: a scene in a window, to play with.

use std::path::{Path, PathBuf};

use super::names::SceneName;
use super::render::parse_size;
use super::{CliError, note};
use crate::gpu::GpuDevice;
use crate::scene::Loader;
use crate::simulation::AdapterChoice;
use crate::view::{self, App, Script, Session, Source, WindowError, Wish};

/// Arguments of `motes view`.
#[derive(Debug, clap::Args)]
// Said outright: else errors about what is missing list what the environment gives.
#[command(override_usage = "motes view [OPTIONS] <SCENE>")]
pub(super) struct ViewArgs {
    /// A TOML file, or the name of a built-in scene (`motes scenes` lists them)
    #[arg(value_parser = SceneName, hide_possible_values = true)]
    scene: String,
    /// Size of the picture in pixels: the window shows it larger or smaller as it has room
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    size: Option<(u32, u32)>,
    /// Size of the window in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true, default_value = "1280x800")]
    window: (u32, u32),
    /// auto, or part of an adapter's name
    #[arg(long, value_name = "A", env = "MOTES_ADAPTER", default_value = "auto")]
    adapter: String,
    /// Change a key of the scene, e.g. camera.vertical_fov_degrees=30
    #[arg(long, value_name = "path.to.key=value")]
    set: Vec<String>,
    /// Let the scene read files outside of its folder
    #[arg(long)]
    allow_outside: bool,
    /// Play this script in a window that nobody sees: lines of `PASS ACTION`, actions being turn
    /// PATH=VALUE, move X Y, press, release, press right, release right, wheel NOTCHES, key NAME,
    /// detail 0..4 [lines], undo, frame N, shot FILE.png, save FILE.toml and end
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,
    /// Run kernels from this folder in place of those of the same name that the program has, and read
    /// them again whenever they are written: for who works on them
    #[arg(long, value_name = "DIR")]
    kernels: Option<PathBuf>,
}

pub(super) fn run(args: &ViewArgs) -> Result<u8, CliError> {
    let mut sets = args.set.clone();
    if let Some((width, height)) = args.size {
        sets.push(format!("image.width={width}"));
        sets.push(format!("image.height={height}"));
    }
    let loader = Loader {
        allow_outside: args.allow_outside,
    };
    if AdapterChoice::parse(&args.adapter) == AdapterChoice::Cpu {
        return Err(CliError::usage(
            "a window is drawn by an adapter, and `cpu` is none",
            "--adapter auto, or part of a name that `motes adapters` lists, e.g. llvmpipe; \
             `motes render` draws on the processor",
        ));
    }
    let path = Path::new(&args.scene);
    if path
        .metadata()
        .is_ok_and(|it| !it.is_file() && !it.is_dir())
    {
        return Err(CliError::usage(
            format!("{} is a pipe or a device", args.scene),
            "a window reads its scene again when it is written: give it a file",
        ));
    }
    // What is wrong with the scene is told before any window opens.
    loader.load_with(&args.scene, &sets)?;
    let size_px = [args.window.0, args.window.1];
    if size_px.iter().any(|side| !(200..=8192).contains(side)) {
        return Err(CliError::usage(
            format!("a window of {}x{} pixels", size_px[0], size_px[1]),
            "--window takes sides of 200 to 8192 pixels",
        ));
    }
    match &args.script {
        Some(path) => play(args, path, &sets, loader, size_px),
        None => {
            let wish = Wish {
                scene: args.scene.clone(),
                sets,
                loader,
                kernels: args.kernels.clone(),
                adapter: args.adapter.clone(),
                size_px,
            };
            view::open(wish).map_err(CliError::from).map(|()| 0)
        }
    }
}

fn play(
    args: &ViewArgs,
    path: &std::path::Path,
    sets: &[String],
    loader: Loader,
    size_px: [u32; 2],
) -> Result<u8, CliError> {
    let file = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| {
        CliError::usage(format!("{file}: {error}"), "--script takes a text file")
    })?;
    let script = Script::parse(&text, &file).map_err(|error| CliError {
        message: error.to_string(),
        code: 2,
    })?;
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let machine = |told: String| CliError::from(WindowError::Machine(told));
    let (_, device, queue) =
        view::device_of(&instance, &args.adapter, |_| true).map_err(machine)?;
    let ours = GpuDevice::from_wgpu(&device, &queue).map_err(|e| machine(e.to_string()))?;
    let is_timed = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
    let source = Source::new((&args.scene, sets, loader), (ours, is_timed))
        .with_kernels(args.kernels.clone());
    let session = Session::new(source).map_err(|told| CliError::from(WindowError::Scene(told)))?;
    let mut app = App::new(session);
    view::play(&mut app, &script, (device, queue), size_px)?;
    let changes = app.session.recording().changes.len();
    note!("motes: frame {}, {changes} changes", app.session.frame());
    Ok(0)
}

impl From<WindowError> for CliError {
    fn from(error: WindowError) -> Self {
        match error {
            WindowError::Scene(message) => Self { message, code: 2 },
            WindowError::Output(error) => error.into(),
            WindowError::Machine(told) => Self::machine(
                told,
                "a window needs a display (X11 or Wayland) and a Vulkan driver that shows on it; \
                 `motes render` needs no display",
            ),
        }
    }
}
