//! The device's own rasteriser, to hold the splat and the glow of flames against: particles as points or as
//! quads, and those of flames as fans, added up by blending.

use super::device::GpuDevice;
use super::shader::sources::RASTERS;
use super::yardstick::Yardstick;
use crate::backend::BackendError;

/// How the rasteriser draws a particle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RasterShape {
    /// A point primitive: one pixel, no antialiasing.
    Points,
    /// Two triangles around an antialiased disc of this many thousandths of a pixel in radius.
    Quads {
        /// Thousandths of a pixel.
        radius_millipixels: u32,
    },
    /// 20 triangles around the centre of each of the 25 particles along upright flames (Perry 1994, 3.2.1),
    /// of which half the width and the height are so many pixels.
    Fans {
        /// Half the width, before what its ages scale it by.
        half_width_px: u32,
        /// From the root to the tip.
        height_px: u32,
    },
}

/// What it adds up in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RasterTarget {
    /// 16-bit floats: light is rounded to 11 bits, and the sum depends on the order.
    Half,
    /// 32-bit floats: the sum depends on the order.
    Single,
}

/// A render pass, ready to encode.
#[derive(Debug)]
pub(super) struct Raster {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    target: wgpu::TextureView,
    vertices: u32,
    instances: u32,
}

impl GpuDevice {
    /// `particles` at random places of a picture of `size_px`, drawn by the device's rasteriser;
    /// `None` where it cannot blend in such a target.
    ///
    /// # Errors
    /// Out of memory, or the device fails.
    pub fn raster(
        &self,
        name: &'static str,
        shape: RasterShape,
        target: RasterTarget,
        particles: u32,
        size_px: [u32; 2],
    ) -> Result<Option<Yardstick>, BackendError> {
        let features = self.device.features();
        let format = match target {
            RasterTarget::Half => wgpu::TextureFormat::Rgba16Float,
            RasterTarget::Single if features.contains(wgpu::Features::FLOAT32_BLENDABLE) => {
                wgpu::TextureFormat::Rgba32Float
            }
            RasterTarget::Single => return Ok(None),
        };
        self.watched(|| {
            let raster = Raster::new(self, shape, format, particles, size_px);
            Ok(Some(Yardstick::raster(self, name, raster)))
        })
    }
}

impl Raster {
    fn new(
        gpu: &GpuDevice,
        shape: RasterShape,
        format: wgpu::TextureFormat,
        particles: u32,
        size_px: [u32; 2],
    ) -> Self {
        let device = &gpu.device;
        let (radius, rise) = match shape {
            RasterShape::Points => (0.0, 0.0),
            RasterShape::Quads { radius_millipixels } => (radius_millipixels as f32 * 1e-3, 0.0),
            RasterShape::Fans {
                half_width_px,
                height_px,
            } => (half_width_px as f32, height_px as f32),
        };
        let [width, height] = size_px;
        let parameters = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("raster"),
            size: 16,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let values = [width as f32, height as f32, radius, rise];
        gpu.queue
            .write_buffer(&parameters, 0, bytemuck::cast_slice(&values));
        // Points use nothing of it; the layout is the same for both.
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("raster"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let pipeline = pipeline(device, &layout, shape, format);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("raster"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: parameters.as_entire_binding(),
            }],
        });
        let target = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("raster"),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let (vertices, instances) = match shape {
            RasterShape::Points => (particles, 1),
            RasterShape::Quads { .. } => (6, particles),
            RasterShape::Fans { .. } => (60, particles),
        };
        Self {
            pipeline,
            group,
            target: target.create_view(&Default::default()),
            vertices,
            instances,
        }
    }

    /// The pass, between two timestamps if there is room for them.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stamps: Option<(&wgpu::QuerySet, u32)>,
    ) {
        let timestamp_writes = stamps.map(|(query_set, first)| wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("raster"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            timestamp_writes,
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..self.vertices, 0..self.instances);
    }
}

fn pipeline(
    device: &wgpu::Device,
    group: &wgpu::BindGroupLayout,
    shape: RasterShape,
    format: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    let source = &RASTERS[0];
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(source.name),
        source: wgpu::ShaderSource::Wgsl(source.text.into()),
    });
    let (vertex, fragment, topology) = match shape {
        RasterShape::Points => (
            "point_vertex",
            "point_light",
            wgpu::PrimitiveTopology::PointList,
        ),
        RasterShape::Quads { .. } => (
            "quad_vertex",
            "quad_light",
            wgpu::PrimitiveTopology::TriangleList,
        ),
        RasterShape::Fans { .. } => (
            "fan_vertex",
            "fan_light",
            wgpu::PrimitiveTopology::TriangleList,
        ),
    };
    let add = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(source.name),
        bind_group_layouts: &[Some(group)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(source.name),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            topology,
            ..Default::default()
        },
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(wgpu::BlendState {
                    color: add,
                    alpha: add,
                }),
                write_mask: wgpu::ColorWrites::COLOR,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
