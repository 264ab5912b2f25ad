//! Simulations on a wgpu device of the caller's own: what it must have, whose errors are whose, the
//! picture in a texture, the particles in buffers, and what happens when the device goes.

#[path = "../common/mod.rs"]
mod common;

mod errors;
mod lost;
mod needs;
mod particles;
mod textures;

use motes::backend::BackendError;
use motes::gpu::{self, GpuDevice};
use motes::scene::Scene;
use motes::{AdapterChoice, Options, Simulation, SimulationError};

/// What a caller has: an adapter of an instance with wgpu's default flags.
fn adapter_of(name: &str) -> wgpu::Adapter {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    let is_meant = |adapter: &wgpu::Adapter| {
        let info = adapter.get_info();
        info.name.to_lowercase().contains(&name.to_lowercase())
    };
    all.into_iter()
        .find(is_meant)
        .unwrap_or_else(|| panic!("no adapter `{name}`"))
}

/// A device of the caller's, changed from what is asked for.
fn opened(
    adapter: &wgpu::Adapter,
    change: impl FnOnce(&mut wgpu::DeviceDescriptor),
) -> (wgpu::Device, wgpu::Queue) {
    let mut descriptor = gpu::device_descriptor(adapter);
    change(&mut descriptor);
    pollster::block_on(adapter.request_device(&descriptor)).expect("the driver opens its device")
}

/// A caller with a simulation on its device.
struct Caller {
    adapter: wgpu::Adapter,
    device: wgpu::Device,
    queue: wgpu::Queue,
    simulation: Simulation,
}

impl Caller {
    fn new(name: &str, scene: &Scene, options: Options) -> Self {
        let adapter = adapter_of(name);
        let (device, queue) = opened(&adapter, |_| {});
        let ours = GpuDevice::from_wgpu(&device, &queue).expect("it was opened as asked for");
        let options = Options {
            adapter: AdapterChoice::Device(ours),
            ..options
        };
        let simulation = Simulation::new(scene, &options).expect("it has room");
        Self {
            adapter,
            device,
            queue,
            simulation,
        }
    }

    /// A texture that takes the picture, but for the change.
    fn texture(
        &self,
        scene: &Scene,
        change: impl FnOnce(&mut wgpu::TextureDescriptor),
    ) -> wgpu::Texture {
        let mut descriptor = texture_for(scene);
        change(&mut descriptor);
        self.device.create_texture(&descriptor)
    }

    /// The first `bytes` of a buffer.
    fn bytes_of(&self, buffer: &wgpu::Buffer, bytes: u64) -> Vec<u8> {
        let home = self.home(bytes);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &home, 0, bytes);
        self.fetch(encoder, &home)
    }

    /// The pixels of a texture, without what fills its rows up.
    fn pixels_of(&self, texture: &wgpu::Texture) -> Vec<u8> {
        let row = texture.width() * 4;
        let padded = row.next_multiple_of(256);
        let home = self.home(u64::from(padded) * u64::from(texture.height()));
        let target = wgpu::TexelCopyBufferInfo {
            buffer: &home,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded),
                rows_per_image: None,
            },
        };
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(texture.as_image_copy(), target, texture.size());
        let bytes = self.fetch(encoder, &home);
        let rows = bytes.chunks(padded as usize);
        rows.flat_map(|padded| &padded[..row as usize])
            .copied()
            .collect()
    }

    fn home(&self, size: u64) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("home"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        })
    }

    fn fetch(&self, encoder: wgpu::CommandEncoder, home: &wgpu::Buffer) -> Vec<u8> {
        self.queue.submit([encoder.finish()]);
        home.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("it maps"));
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device ends its work");
        let view = home.slice(..).get_mapped_range().expect("it is mapped");
        view.to_vec()
    }
}

fn texture_for(scene: &Scene) -> wgpu::TextureDescriptor<'static> {
    wgpu::TextureDescriptor {
        label: Some("the caller's"),
        size: wgpu::Extent3d {
            width: scene.image.width,
            height: scene.image.height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    }
}

/// The scene on the processor.
fn on_processor(scene: &Scene) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("the processor has room")
}

/// The machine's error; anything else fails the test.
fn failed<T>(done: Result<T, SimulationError>) -> BackendError {
    match done {
        Err(SimulationError::Backend(error)) => error,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("it was done"),
    }
}
