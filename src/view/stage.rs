//! What the window is drawn with: egui's renderer and the picture's texture, on the device that the
//! scene runs on.

use std::sync::{Arc, Mutex};

use super::app::App;
use super::error::WindowError;

/// Errors of a device that nobody has asked for, which would end the program.
#[derive(Clone, Default)]
pub(super) struct Faults(Arc<Mutex<Option<String>>>);

impl Faults {
    /// Keeps the first one of the device from now on.
    pub(super) fn of(device: &wgpu::Device) -> Self {
        let faults = Self::default();
        let kept = faults.clone();
        device.on_uncaptured_error(Arc::new(move |error| {
            if let Ok(mut first) = kept.0.lock() {
                first.get_or_insert_with(|| error.to_string());
            }
        }));
        faults
    }

    /// # Errors
    /// There was one.
    pub(super) fn check(&self) -> Result<(), WindowError> {
        let first = self.0.lock().ok().and_then(|first| first.clone());
        first.map_or(Ok(()), |told| Err(WindowError::Machine(told)))
    }
}

/// egui's renderer and the picture.
pub(super) struct Stage {
    pub(super) faults: Faults,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    renderer: egui_wgpu::Renderer,
    picture: Option<(wgpu::Texture, egui::TextureId)>,
}

impl Stage {
    /// A stage for targets of that format.
    pub(super) fn new(
        device: wgpu::Device,
        queue: wgpu::Queue,
        format: wgpu::TextureFormat,
    ) -> Self {
        let options = egui_wgpu::RendererOptions {
            // Bytes of the picture stay what they are.
            dithering: false,
            ..Default::default()
        };
        Self {
            faults: Faults::of(&device),
            renderer: egui_wgpu::Renderer::new(&device, format, options),
            device,
            queue,
            picture: None,
        }
    }

    /// Brings the picture up to date, if it is not.
    pub(super) fn refresh(&mut self, app: &mut App) {
        if !std::mem::take(&mut app.is_stale) {
            return;
        }
        let image = &app.session.scene().image;
        let size = wgpu::Extent3d {
            width: image.width,
            height: image.height,
            depth_or_array_layers: 1,
        };
        if self
            .picture
            .as_ref()
            .is_none_or(|(texture, _)| texture.size() != size)
        {
            let texture = self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("picture"),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba8Unorm,
                usage: wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            let view = texture.create_view(&Default::default());
            let filter = wgpu::FilterMode::Linear;
            let id = self
                .renderer
                .register_native_texture(&self.device, &view, filter);
            if let Some((_, old)) = self.picture.replace((texture, id)) {
                self.renderer.free_texture(&old);
            }
        }
        if let Some((texture, id)) = &self.picture {
            match app.session.draw_into(texture) {
                Ok(()) => app.picture = Some(*id),
                Err(told) => app.message = Some((told, true)),
            }
        }
    }

    /// Takes in what egui has drawn glyphs on; whether or not the pass is painted.
    pub(super) fn take_textures(&mut self, output: &mut egui::FullOutput) {
        let news = output.textures_delta.set.drain();
        for (id, deltas) in news {
            for delta in deltas {
                self.renderer
                    .update_texture(&self.device, &self.queue, id, &delta);
            }
        }
        for id in output.textures_delta.free.drain() {
            self.renderer.free_texture(&id);
        }
    }

    /// Draws a pass of the window, whose textures have been taken.
    pub(super) fn paint(
        &mut self,
        ctx: &egui::Context,
        output: egui::FullOutput,
        target: &wgpu::TextureView,
        size_px: [u32; 2],
    ) {
        let pixels_per_point = output.pixels_per_point;
        let jobs = ctx.tessellate(output.shapes, pixels_per_point);
        let screen = egui_wgpu::ScreenDescriptor {
            size_in_pixels: size_px,
            pixels_per_point,
        };
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut commands =
            self.renderer
                .update_buffers(&self.device, &self.queue, &mut encoder, &jobs, &screen);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("window"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        self.renderer
            .render(&mut pass.forget_lifetime(), &jobs, &screen);
        commands.push(encoder.finish());
        self.queue.submit(commands);
    }
}
