//! What stays on the device for its owner: the picture in a texture, the particles in buffers.

use super::GpuBackend;
use crate::backend::BackendError;

/// Formats of textures that take the picture: four bytes a pixel, as [`crate::output`] writes them.
/// They are display-referred, so that reading a texture of the second kind makes linear light of
/// them.
pub(super) const FORMATS: [wgpu::TextureFormat; 2] = [
    wgpu::TextureFormat::Rgba8Unorm,
    wgpu::TextureFormat::Rgba8UnormSrgb,
];

/// Bytes that rows of a texture have to be a multiple of, to be copied in one.
const ROW_GRAIN: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// Why a texture cannot take the picture.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextureError {
    /// It has other pixels than the picture.
    Size {
        /// Width, height and layers, or depth, that it must have.
        needed: [u32; 3],
        /// Those that it has.
        got: [u32; 3],
    },
    /// It is not two-dimensional, or has several samples a pixel.
    Kind {
        /// Its dimension.
        dimension: wgpu::TextureDimension,
        /// Samples a pixel.
        samples: u32,
    },
    /// Its format is neither `Rgba8Unorm` nor `Rgba8UnormSrgb`.
    Format(wgpu::TextureFormat),
    /// It was made without [`wgpu::TextureUsages::COPY_DST`]; with these.
    Usage(wgpu::TextureUsages),
    /// The simulation runs on the processor, which has no textures. Its bytes are those of
    /// [`crate::simulation::Simulation::image`], for [`wgpu::Queue::write_texture`].
    Processor,
}

impl std::fmt::Display for TextureError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Size { needed, got } => write!(
                f,
                "error: the texture's size is {} x {} x {}\n  = help: the picture's is {} x {} x {}",
                got[0], got[1], got[2], needed[0], needed[1], needed[2]
            ),
            Self::Kind { dimension, samples } => write!(
                f,
                "error: the texture's dimension is {dimension:?}, with {samples} samples a pixel\n  \
                 = help: make it of dimension D2, with 1 sample"
            ),
            Self::Format(format) => write!(
                f,
                "error: the texture's format is {format:?}\n  = help: make it of {:?} or {:?}",
                FORMATS[0], FORMATS[1]
            ),
            Self::Usage(usage) => write!(
                f,
                "error: the texture's usage is {usage:?}\n  = help: make it with COPY_DST"
            ),
            Self::Processor => write!(
                f,
                "error: the simulation runs on the processor, which has no textures\n  = help: \
                 write the bytes of its image to the texture, or run it on an adapter"
            ),
        }
    }
}

impl std::error::Error for TextureError {}

/// The living on the device, for callers who draw them themselves: to be read, never written to.
///
/// Each particle is a [`crate::layout::Particle`] of 32 bytes, two vectors of four words: position
/// (three `f32`, in its system's space) and index among the births of its system and frame; then
/// velocity (three `f32`, units a frame, in its system's space) and, in one word, the slot of its
/// system (upper 16 bits) and its birth frame (lower 16 bits). Matrices from the systems' spaces to
/// the world are in [`crate::plan::FrameInputs::systems`]. Pages may be bound as storage (read
/// only) or vertex buffers, or copied from.
///
/// Every step moves the living into other pages: ask for them again after each. They hold the
/// state in the order of the queue, so work submitted after a step sees its result.
#[derive(Clone, Debug)]
pub struct ParticleBuffers {
    /// Particle `i` is record `i % page_len` of page `i / page_len`.
    pub pages: Vec<wgpu::Buffer>,
    /// Particles a page.
    pub page_len: u32,
    /// A [`crate::layout::Counts`]: its first word is the number of the living. What lies behind
    /// them in the pages is left over.
    pub counts: wgpu::Buffer,
}

impl GpuBackend {
    /// The living. After an emit and before the next advance, the newborn follow them.
    ///
    /// # Errors
    /// None, if the plan declares what it should.
    pub fn particle_buffers(&self) -> Result<ParticleBuffers, BackendError> {
        Ok(ParticleBuffers {
            pages: self.memory.pools[self.current].clone(),
            page_len: self.memory.paging.page_len,
            counts: self.memory.named("counts")?.clone(),
        })
    }

    /// Whether the texture can take the picture.
    ///
    /// # Errors
    /// What about it is wrong.
    pub fn check_texture(&self, texture: &wgpu::Texture) -> Result<(), TextureError> {
        let needed = [self.width, self.height, 1];
        let got = [
            texture.width(),
            texture.height(),
            texture.depth_or_array_layers(),
        ];
        let (dimension, samples) = (texture.dimension(), texture.sample_count());
        if dimension != wgpu::TextureDimension::D2 || samples != 1 {
            return Err(TextureError::Kind { dimension, samples });
        }
        if got != needed {
            return Err(TextureError::Size { needed, got });
        }
        if !FORMATS.contains(&texture.format()) {
            return Err(TextureError::Format(texture.format()));
        }
        if !texture.usage().contains(wgpu::TextureUsages::COPY_DST) {
            return Err(TextureError::Usage(texture.usage()));
        }
        Ok(())
    }

    /// Copies the picture drawn last into level 0 of a texture of this device that
    /// [`GpuBackend::check_texture`] finds fit.
    ///
    /// # Errors
    /// The device fails, or the texture is another device's.
    pub fn copy_image_to(&mut self, texture: &wgpu::Texture) -> Result<(), BackendError> {
        self.watched(|run| run.encode_copy(texture))
    }

    fn encode_copy(&self, texture: &wgpu::Texture) -> Result<(), BackendError> {
        let image = self.memory.named("image")?;
        let row_bytes = self.width * 4;
        // Rows of other lengths go one by one: of a single row no length is asked.
        let rows_at_once = if row_bytes.is_multiple_of(ROW_GRAIN) {
            self.height
        } else {
            1
        };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        for y in (0..self.height).step_by(rows_at_once as usize) {
            let source = wgpu::TexelCopyBufferInfo {
                buffer: image,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: u64::from(y) * u64::from(row_bytes),
                    bytes_per_row: (rows_at_once > 1).then_some(row_bytes),
                    rows_per_image: None,
                },
            };
            let target = wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: 0, y, z: 0 },
                aspect: wgpu::TextureAspect::All,
            };
            let size = wgpu::Extent3d {
                width: self.width,
                height: rows_at_once,
                depth_or_array_layers: 1,
            };
            encoder.copy_buffer_to_texture(source, target, size);
        }
        self.gpu.queue.submit([encoder.finish()]);
        match self.gpu.loss() {
            Some(lost) => Err(lost),
            None => Ok(()),
        }
    }
}
