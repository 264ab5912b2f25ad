//! Runs a scene on a wgpu device of the caller's own and draws into a texture of the caller's, as
//! an application that draws other things with that device would. The texture is read back and
//! written as a PNG.
//!
//!     cargo run --example own_device [fountain.png]
//!
//! `MOTES_ADAPTER` may name part of the adapter's name.

use std::path::Path;

use motes::gpu::{self, GpuDevice};
use motes::output::{Rgba8Image, write_png};
use motes::{AdapterChoice, Options, Simulation, wgpu};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 180;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The application's own adapter, device and queue: the descriptor has all that Motes needs,
    // and may be given more features and limits.
    let adapter = choose_adapter().ok_or("there is no such Vulkan, Metal or DX12 adapter")?;
    let request = adapter.request_device(&gpu::device_descriptor(&adapter));
    let (device, queue) = pollster::block_on(request)?;

    let ours = GpuDevice::from_wgpu(&device, &queue)?;
    println!(
        "on {}, exact: {}",
        ours.description.name,
        if ours.is_exact() { "yes" } else { "no" }
    );
    let sets = [
        format!("image.width={WIDTH}"),
        format!("image.height={HEIGHT}"),
    ];
    let scene = motes::scene::load_with("fountain", &sets)?;
    let options = Options {
        adapter: AdapterChoice::Device(ours),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options)?;
    simulation.seek(60)?;

    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("the fountain"),
        size: size(),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::COPY_DST
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    simulation.draw_into(&texture)?;

    let pixels = read_texture(&device, &queue, &texture)?;
    let lit = pixels.chunks(4).filter(|pixel| pixel[0] > 100).count();
    println!("{lit} of {} pixels are bright", WIDTH * HEIGHT);
    let path = std::env::args().nth(1).unwrap_or("fountain.png".into());
    let image = Rgba8Image {
        width: WIDTH,
        height: HEIGHT,
        pixels,
    };
    write_png(Path::new(&path), &image)?;
    println!("wrote {path}");
    Ok(())
}

fn choose_adapter() -> Option<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let wanted = std::env::var("MOTES_ADAPTER").unwrap_or_default();
    let wanted = wanted.to_lowercase().replace("auto", "");
    let all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    all.into_iter()
        .find(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted))
}

fn size() -> wgpu::Extent3d {
    wgpu::Extent3d {
        width: WIDTH,
        height: HEIGHT,
        depth_or_array_layers: 1,
    }
}

/// The texture's bytes: 320 pixels of 4 bytes are whole rows of 256, as copies ask for.
fn read_texture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("to be read"),
        size: u64::from(WIDTH * HEIGHT * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let target = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout: wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(WIDTH * 4),
            rows_per_image: None,
        },
    };
    let mut encoder = device.create_command_encoder(&Default::default());
    encoder.copy_texture_to_buffer(texture.as_image_copy(), target, size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    device.poll(wgpu::PollType::wait_indefinitely())?;
    Ok(buffer.slice(..).get_mapped_range()?.to_vec())
}
