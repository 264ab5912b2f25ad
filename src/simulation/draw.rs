//! The picture: drawn, read, and put into a texture of the caller's.

use std::any::Any;

use super::{Simulation, SimulationError};
use crate::gpu::{GpuBackend, ParticleBuffers, TextureError};
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

    /// Names of the picture's layers: those of the scene and `rest`; `particles` alone if the scene
    /// has none.
    pub fn layer_names(&self) -> Vec<String> {
        self.plan.layer_names()
    }

    /// Draws one layer of the last frame stepped, on black: the light of the particles in it.
    /// Layers sum to the whole, step by step of light, where nothing covers; what does hides what is
    /// in layers behind ([`Simulation::hidden`]).
    ///
    /// # Errors
    /// The machine fails.
    pub fn draw_layer(&mut self, index: usize) -> Result<(), SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(());
        };
        let mut inputs = inputs.clone();
        inputs.frame.background = [0.0; 4];
        // The ground and the planet are of no layer: they hide, and show nothing of themselves.
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
        inputs.frame.layer = if inputs.layer_planes.is_empty() {
            0
        } else {
            index as u32 + 1
        };
        self.backend.draw(&inputs)?;
        self.drawn = Some(inputs.frame);
        Ok(())
    }

    /// How much of what is behind each pixel of the image drawn last, rows from the top, is hidden by
    /// what covers it, 0 to 1; empty where nothing of the scene covers.
    ///
    /// # Errors
    /// The machine fails.
    pub fn hidden(&mut self) -> Result<Vec<f32>, SimulationError> {
        let words = self.backend.read("cover_bt")?;
        let (pixels, _) = words.as_chunks::<2>();
        let hidden = |[_, clear]: &[u32; 2]| 1.0 - f32::from_bits(*clear);
        Ok(pixels.iter().map(hidden).collect())
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
