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
use super::session::{Session, Source};
use super::stage::Stage;
use crate::gpu::GpuDevice;
use crate::scene::Loader;

/// How often the scene's files are looked at.
const WATCH_EVERY: Duration = Duration::from_millis(300);

/// What to open; the adapter's name contains `adapter`, whatever the case.
struct Wish {
    scene: String,
    sets: Vec<String>,
    loader: Loader,
    adapter: String,
    size_px: [u32; 2],
}

/// Opens a window of that size and plays the scene in it until it is closed.
///
/// # Errors
/// [`WindowError`].
pub fn open(
    scene: &str,
    sets: &[String],
    loader: Loader,
    adapter: &str,
    size_px: [u32; 2],
) -> Result<(), WindowError> {
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
        wish: Wish {
            scene: scene.to_owned(),
            sets: sets.to_vec(),
            loader,
            adapter: adapter.to_owned(),
            size_px,
        },
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
    fn new(files: Vec<PathBuf>) -> Self {
        let of = |path: PathBuf| {
            let written = written_at(&path);
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
            WindowEvent::RedrawRequested => shown.redraw(),
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
        surface.configure(&device, &config);
        let is_timed = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let source = Source::new((&wish.scene, &wish.sets, wish.loader), (ours, is_timed));
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
        Ok(Self {
            stage: Stage::new(device, queue, config.format),
            window,
            surface,
            config,
            ctx,
            events,
            watch: Watch::new(session.files()),
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

    fn redraw(&mut self) {
        let passed = self.last.elapsed();
        self.last = Instant::now();
        if self.watch.has_changed() {
            match self.app.session.reload() {
                Ok(()) => {
                    self.watch = Watch::new(self.app.session.files());
                    self.app.message = Some(("read the scene again".to_owned(), false));
                }
                Err(told) => self.app.message = Some((told, true)),
            }
            self.app.is_stale = true;
        }
        self.app.pass(passed);
        let size = self.window.inner_size();
        if size.width == 0 || size.height == 0 {
            return;
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
            Current::Outdated | Current::Lost => {
                self.surface.configure(&self.stage.device, &self.config);
                return;
            }
            Current::Timeout | Current::Occluded | Current::Validation => return,
        };
        let view = frame.texture.create_view(&Default::default());
        let size_px = [self.config.width, self.config.height];
        self.stage.paint(&self.ctx, output, &view, size_px);
        self.stage.queue.present(frame);
    }
}
