//! The picture: drawn, read, and put into a texture of the caller's.

use std::any::Any;

use super::{Simulation, SimulationError};
use crate::gpu::{GpuBackend, ParticleBuffers, TextureError};
use crate::layout::Frame;
use crate::plan::FrameInputs;
use crate::scene::Camera;

impl Simulation {
    /// Draws the last frame stepped.
    ///
    /// # Errors
    /// The machine fails.
    pub fn draw(&mut self) -> Result<(), SimulationError> {
        if let Some(inputs) = &self.inputs {
            self.backend.draw(inputs)?;
            self.drawn = Some(inputs.frame);
        }
        Ok(())
    }

    /// Draws the last frame stepped as another camera sees it. The run does not change by it, even
    /// where births go by the area that they are seen on.
    ///
    /// # Errors
    /// The machine fails.
    pub fn draw_seen_by(&mut self, camera: &Camera) -> Result<(), SimulationError> {
        if let Some(frame) = self.frame() {
            let inputs = self.plan.inputs_seen_by(frame, camera);
            self.backend.draw(&inputs)?;
            self.drawn = Some(inputs.frame);
        }
        Ok(())
    }

    /// Waits until the device has done all that it was given; the processor always has.
    ///
    /// # Errors
    /// The machine fails.
    pub fn wait(&mut self) -> Result<(), SimulationError> {
        match self.device_run() {
            Some(run) => Ok(run.wait()?),
            None => Ok(()),
        }
    }

    /// Milliseconds that each kernel took since the last call, in order; none unless the run is on a
    /// device and timed ([`crate::gpu::GpuOptions::timed`]).
    ///
    /// # Errors
    /// The machine fails.
    pub fn take_kernel_times(&mut self) -> Result<Vec<(&'static str, f64)>, SimulationError> {
        let Some(run) = self.device_run() else {
            return Ok(Vec::new());
        };
        Ok(run.take_times()?.into_iter().flatten().collect())
    }

    /// Draws the last frame stepped into level 0 of the caller's texture: the bytes of
    /// [`Simulation::image`].
    ///
    /// The texture is one of the device that the simulation runs on, of format `Rgba8Unorm` or
    /// `Rgba8UnormSrgb` (the picture is display-referred: sampling the latter makes linear light of
    /// it), of the picture's size, with [`wgpu::TextureUsages::COPY_DST`]. The work goes to the
    /// device's queue before this returns, and nothing is waited for: what the caller submits
    /// afterwards sees the picture.
    ///
    /// # Errors
    /// [`SimulationError::Texture`] for a texture that cannot take it, or on the processor, before
    /// anything is drawn; or the machine fails.
    pub fn draw_into(&mut self, texture: &wgpu::Texture) -> Result<(), SimulationError> {
        self.fit(texture)?;
        self.draw()?;
        self.image_into(texture)
    }

    /// Copies the picture drawn last, perhaps that of a layer, into the caller's texture, as
    /// [`Simulation::draw_into`] does.
    ///
    /// # Errors
    /// As [`Simulation::draw_into`].
    pub fn image_into(&mut self, texture: &wgpu::Texture) -> Result<(), SimulationError> {
        Ok(self.fit(texture)?.copy_image_to(texture)?)
    }

    /// The living on the device, for callers who draw them themselves; `None` on the processor.
    /// They are to be read, not written to, and to be asked for anew after each step.
    pub fn particle_buffers(&mut self) -> Option<ParticleBuffers> {
        self.device_run()?.particle_buffers().ok()
    }

    /// The run on the device, whose picture the texture can take.
    fn fit(&mut self, texture: &wgpu::Texture) -> Result<&mut GpuBackend, TextureError> {
        let run = self.device_run().ok_or(TextureError::Processor)?;
        run.check_texture(texture)?;
        Ok(run)
    }

    fn device_run(&mut self) -> Option<&mut GpuBackend> {
        let backend: &mut dyn Any = self.backend.as_mut();
        backend.downcast_mut()
    }

    /// Names of the picture's layers: those of the scene and `rest`, or `particles` alone if the scene has
    /// none; before them `surfaces`, if there are any (planet, ground, pillars and meshes).
    pub fn layer_names(&self) -> Vec<String> {
        self.plan.layer_names()
    }

    /// Draws one layer of the last frame stepped, on black: the surfaces in their light, or the light of the
    /// particles in it that surfaces leave. Layers sum to the whole, step by step of light, where nothing
    /// covers; what does hides what is in layers behind ([`Simulation::hidden`]).
    ///
    /// # Errors
    /// The machine fails.
    pub fn draw_layer(&mut self, index: usize) -> Result<(), SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(());
        };
        let mut inputs = inputs.clone();
        inputs.frame.background = [0.0; 4];
        let has_surfaces = usize::from(self.plan.has_surfaces());
        inputs.frame.layer = if index < has_surfaces {
            layer_of_surfaces(&inputs.frame)
        } else {
            hide_surfaces(&mut inputs);
            if inputs.layer_planes.is_empty() {
                0
            } else {
                (index - has_surfaces) as u32 + 1
            }
        };
        self.backend.draw(&inputs)?;
        self.drawn = Some(inputs.frame);
        Ok(())
    }

    /// How much of what is behind each pixel of the image drawn last, rows from the top, is hidden, 0 to 1:
    /// by what covers it, from all that is behind that, surfaces too; by the surfaces, if the image is their
    /// layer. Empty where nothing of the scene covers. One number a pixel: along the outline of a surface
    /// before what covers, it does not tell which part of the pixel hides which.
    ///
    /// # Errors
    /// The machine fails.
    pub fn hidden(&mut self) -> Result<Vec<f32>, SimulationError> {
        let clear_of = |pixels: &[u32]| -> Vec<f32> {
            let (pixels, _) = pixels.as_chunks::<4>();
            let clear = pixels.iter().map(|[.., clear]| f32::from_bits(*clear));
            clear.collect()
        };
        let surfaces = clear_of(&self.backend.read("surface_pixels")?);
        let drawn = self.drawn.as_ref();
        if drawn.is_some_and(|frame| frame.layer == layer_of_surfaces(frame)) {
            let ground = clear_of(&self.backend.read("ground_pixels")?);
            let planet = clear_of(&self.backend.read("planet_pixels")?);
            let count = surfaces.len().max(ground.len()).max(planet.len());
            let clear = |at: usize| {
                let all = [&ground, &planet, &surfaces];
                let each = all.map(|clear| clear.get(at).copied().unwrap_or(1.0));
                each.iter().product::<f32>()
            };
            return Ok((0..count).map(|at| 1.0 - clear(at)).collect());
        }
        let covers = self.backend.read("cover_bt")?;
        let fronts = self.backend.read("cover_front")?;
        let (covers, _) = covers.as_chunks::<2>();
        let hidden = |(at, [_, clear]): (usize, &[u32; 2])| {
            let clear = f32::from_bits(*clear);
            // What covers behind a surface hides nothing of it.
            let on_surface = 1.0 - surfaces.get(at).copied().unwrap_or(1.0);
            let front = fronts.get(at).map_or(clear, |front| f32::from_bits(*front));
            1.0 - (clear + (front - clear) * on_surface)
        };
        Ok(covers.iter().enumerate().map(hidden).collect())
    }

    /// The image drawn last: RGBA, four bytes a pixel, rows from the top.
    ///
    /// # Errors
    /// The machine fails.
    pub fn image(&mut self) -> Result<Vec<u8>, SimulationError> {
        let pixels = self.backend.read("image")?;
        Ok(pixels.into_iter().flat_map(u32::to_le_bytes).collect())
    }

    /// Digest of the image drawn last.
    ///
    /// # Errors
    /// The machine fails.
    pub fn image_digest(&mut self) -> Result<u64, SimulationError> {
        Ok(self.backend.image_digest()?)
    }
}

/// The number of the layer that no particle is in: that of the surfaces.
fn layer_of_surfaces(frame: &Frame) -> u32 {
    frame.layer_plane_count + 2
}

/// Surfaces hide, and show nothing of themselves.
fn hide_surfaces(inputs: &mut FrameInputs) {
    for ground in &mut inputs.grounds {
        let [.., contrast] = ground.color;
        ground.color = [0.0, 0.0, 0.0, contrast];
    }
    for pillar in &mut inputs.pillars {
        pillar.color = [0.0; 4];
    }
    for surface in &mut inputs.surfaces {
        surface.color = [0.0; 4];
    }
    for planet in &mut inputs.planets {
        planet.color = [0.0; 4];
    }
}
