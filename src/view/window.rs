//! The window: winit's events to egui, egui's pictures to a surface.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::{Window, WindowId};

use super::app::App;
use super::device_of;
use super::error::WindowError;
use super::session::Session;
use super::source::Source;
use super::stage::Stage;
use crate::gpu::GpuDevice;
use crate::scene::Loader;

/// How often the scene's files are looked at.
const WATCH_EVERY: Duration = Duration::from_millis(300);

/// What to open a window on.
pub struct Wish {
    /// Name of a built-in scene, or path.
    pub scene: String,
    /// Changes made to it before it begins, as `--set` has them.
    pub sets: Vec<String>,
    /// How it is loaded.
    pub loader: Loader,
    /// A folder of kernels to run in place of the program's own.
    pub kernels: Option<PathBuf>,
    /// Part of the adapter's name, whatever the case; `auto` for any.
    pub adapter: String,
    /// Size of the window in pixels.
    pub size_px: [u32; 2],
}

/// Opens a window and plays the scene in it until it is closed.
///
/// # Errors
/// [`WindowError`].
pub fn open(wish: Wish) -> Result<(), WindowError> {
    let machine = |error: &dyn std::fmt::Display| WindowError::Machine(error.to_string());
    let events = EventLoop::new().map_err(|error| {
        // Its words begin with the place in the library that they come from.
        let told = error.to_string();
        let told = told.split_once(".rs:").map_or(told.as_str(), |(_, rest)| {
            rest.trim_start_matches(|letter: char| letter.is_ascii_digit() || letter == ':')
        });
        machine(&format!("there is no display: {}", told.trim()))
    })?;
    let mut player = Player {
        wish,
        shown: None,
        failed: None,
    };
    events
        .run_app(&mut player)
        .map_err(|error| machine(&error))?;
    player.failed.map_or(Ok(()), Err)
}

/// The event loop's side.
struct Player {
    wish: Wish,
    shown: Option<Shown>,
    failed: Option<WindowError>,
}

/// An open window.
struct Shown {
    window: Arc<Window>,
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    stage: Stage,
    ctx: egui::Context,
    events: egui_winit::State,
    app: App,
    last: Instant,
    watch: Watch,
}

/// The files that the scene was read from, and when they were written.
struct Watch {
    files: Vec<(PathBuf, Option<SystemTime>)>,
    looked: Instant,
}

impl Watch {
    /// Watches files that were read after `since`: what was written meanwhile may not have been read.
    fn new(files: Vec<PathBuf>, since: SystemTime) -> Self {
        let meanwhile = since..=SystemTime::now();
        let of = |path: PathBuf| {
            let written = written_at(&path).filter(|at| !meanwhile.contains(at));
            (path, written)
        };
        Self {
            files: files.into_iter().map(of).collect(),
            looked: Instant::now(),
        }
    }

    /// Whether one was written since the last time.
    fn has_changed(&mut self) -> bool {
        if self.looked.elapsed() < WATCH_EVERY {
            return false;
        }
        self.looked = Instant::now();
        let mut changed = false;
        for (path, known) in &mut self.files {
            // An editor may take a file away for a moment.
            let written = written_at(path);
            changed |= written.is_some() && written != *known;
            *known = written.or(*known);
        }
        changed
    }
}

fn written_at(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).ok()?.modified().ok()
}

impl ApplicationHandler for Player {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.shown.is_some() {
            return;
        }
        match Shown::new(&self.wish, event_loop) {
            Ok(shown) => self.shown = Some(shown),
            Err(error) => {
                self.failed = Some(error);
                event_loop.exit();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shown) = &mut self.shown else {
            return;
        };
        let used = shown.events.on_window_event(&shown.window, &event);
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => shown.resize(size.width, size.height),
            WindowEvent::RedrawRequested => {
                if let Err(error) = shown.redraw() {
                    self.failed = Some(error);
                    event_loop.exit();
                }
            }
            _ if used.repaint => shown.window.request_redraw(),
            _ => {}
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(shown) = &mut self.shown {
            shown.window.request_redraw();
            // As often as screens show anything new.
            event_loop.set_control_flow(ControlFlow::wait_duration(Duration::from_millis(8)));
        }
    }
}

impl Shown {
    fn new(wish: &Wish, event_loop: &ActiveEventLoop) -> Result<Self, WindowError> {
        let machine = |error: &dyn std::fmt::Display| WindowError::Machine(error.to_string());
        let [width, height] = wish.size_px;
        let attributes = Window::default_attributes()
            .with_title(format!("Motes: {}", wish.scene))
            .with_inner_size(winit::dpi::PhysicalSize::new(width, height));
        let window = event_loop
            .create_window(attributes)
            .map_err(|e| machine(&e))?;
        let window = Arc::new(window);
        let handle = Box::new(event_loop.owned_display_handle());
        let instance =
            wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle(handle));
        let surface = instance
            .create_surface(window.clone())
            .map_err(|e| machine(&e))?;
        let shows = |adapter: &wgpu::Adapter| adapter.is_surface_supported(&surface);
        let (adapter, device, queue) = device_of(&instance, &wish.adapter, shows)
            .map_err(|told| machine(&format!("{told} that shows on this display")))?;
        let ours = GpuDevice::from_wgpu(&device, &queue).map_err(|e| machine(&e))?;
        let size = window.inner_size();
        let config = surface
            .get_default_config(&adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| machine(&"the adapter does not show on this display"))?;
        // What egui and the picture hold is meant for a screen already.
        let formats = surface.get_capabilities(&adapter).formats;
        let format = formats.into_iter().find(|format| !format.is_srgb());
        let config = wgpu::SurfaceConfiguration {
            format: format.unwrap_or(config.format),
            present_mode: wgpu::PresentMode::AutoVsync,
            ..config
        };
        let is_timed = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let since = SystemTime::now();
        let source = Source::new((&wish.scene, &wish.sets, wish.loader), (ours, is_timed))
            .with_kernels(wish.kernels.clone());
        let session = Session::new(source).map_err(WindowError::Scene)?;
        let ctx = egui::Context::default();
        let events = egui_winit::State::new(
            ctx.clone(),
            egui::ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            None,
            Some(device.limits().max_texture_dimension_2d as usize),
        );
        let stage = Stage::new(device, queue, config.format);
        surface.configure(&stage.device, &config);
        Ok(Self {
            stage,
            window,
            instance,
            surface,
            config,
            ctx,
            events,
            watch: Watch::new(session.files(), since),
            app: App::new(session),
            last: Instant::now(),
        })
    }

    /// A window of nothing is not drawn.
    fn resize(&mut self, width: u32, height: u32) {
        if width > 0 && height > 0 {
            (self.config.width, self.config.height) = (width, height);
            self.surface.configure(&self.stage.device, &self.config);
        }
    }

    fn redraw(&mut self) -> Result<(), WindowError> {
        let passed = self.last.elapsed();
        self.last = Instant::now();
        if self.watch.has_changed() {
            let since = SystemTime::now();
            self.app.reload();
            self.watch = Watch::new(self.app.session.files(), since);
        }
        self.app.pass(passed);
        let size = self.window.inner_size();
        if size.width == 0 || size.height == 0 {
            return Ok(());
        }
        self.stage.refresh(&mut self.app);
        let input = self.events.take_egui_input(&self.window);
        let mut output = self.ctx.run_ui(input, |ui| self.app.ui(ui));
        self.stage.take_textures(&mut output);
        self.events
            .handle_platform_output(&self.window, output.platform_output.clone());
        use wgpu::CurrentSurfaceTexture as Current;
        let frame = match self.surface.get_current_texture() {
            Current::Success(frame) | Current::Suboptimal(frame) => frame,
            Current::Outdated => {
                self.surface.configure(&self.stage.device, &self.config);
                return Ok(());
            }
            Current::Lost => return self.make_surface_anew(),
            Current::Timeout | Current::Occluded | Current::Validation => {
                return self.stage.faults.check();
            }
        };
        let view = frame.texture.create_view(&Default::default());
        let size_px = [self.config.width, self.config.height];
        self.stage.paint(&self.ctx, output, &view, size_px);
        self.stage.queue.present(frame);
        self.stage.faults.check()
    }

    /// A surface that was lost comes back as another one.
    fn make_surface_anew(&mut self) -> Result<(), WindowError> {
        let surface = self.instance.create_surface(self.window.clone());
        self.surface = surface.map_err(|error| {
            WindowError::Machine(format!("the window's surface was lost: {error}"))
        })?;
        self.surface.configure(&self.stage.device, &self.config);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_while_it_is_read_is_read_again() {
        let folder = std::env::temp_dir().join(format!("motes-watch-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let file = folder.join("scene.toml");
        let before = SystemTime::now() - Duration::from_secs(9);
        std::fs::write(&file, "1").expect("it is written");
        let is_new = |since: SystemTime| {
            let mut watch = Watch::new(vec![file.clone()], since);
            let long_ago = Instant::now().checked_sub(WATCH_EVERY);
            watch.looked = long_ago.expect("the machine has run for a while");
            watch.has_changed()
        };
        assert!(is_new(before), "it was written after it was read");
        let written = std::fs::File::options().write(true).open(&file);
        written
            .and_then(|file| file.set_modified(before - Duration::from_secs(9)))
            .expect("it is older now");
        assert!(!is_new(before), "it was written before");
        std::fs::remove_dir_all(&folder).expect("it goes");
    }
}
