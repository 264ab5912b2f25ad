//! Playing with a scene in a window: `motes view` (Perry 1994, 1.2 and chapter 5: knobs that turn
//! while the fire burns).
//!
//! [`Session`] is the scene under way and all that can be done to it; [`App`] shows it; the window
//! and the script that stands in for one drive it. Whatever is done at the knobs is recorded, and
//! replays bit for bit.

mod app;
mod knobs;
mod orbit;
mod script;
mod session;
mod stage;
mod window;

pub use app::App;
pub use orbit::Orbit;
pub use script::{Script, ScriptError, play};
pub use session::{Session, Source, Told};
pub use window::{WindowError, open};

use crate::gpu;

/// The first adapter whose name or driver contains `name`, whatever the case (any but other
/// processors' first for `auto`), and that will do; with a device that has what kernels need, and a
/// clock if the adapter has one.
///
/// # Errors
/// There is none, or it does not open.
pub fn device_of(
    instance: &wgpu::Instance,
    name: &str,
    will_do: impl Fn(&wgpu::Adapter) -> bool,
) -> Result<(wgpu::Adapter, wgpu::Device, wgpu::Queue), Told> {
    let wanted = name
        .to_lowercase()
        .replace("lavapipe", "llvmpipe")
        .replace("auto", "");
    let mut all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    let is_software =
        |adapter: &wgpu::Adapter| adapter.get_info().device_type == wgpu::DeviceType::Cpu;
    all.sort_by_key(is_software);
    let found = all.into_iter().find(|adapter| {
        let info = adapter.get_info();
        let named = format!("{} {}", info.name, info.driver).to_lowercase();
        named.contains(&wanted) && will_do(adapter)
    });
    let adapter = found.ok_or_else(|| format!("there is no adapter `{name}`"))?;
    let mut descriptor = gpu::device_descriptor(&adapter);
    descriptor.required_features |= adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
    let request = adapter.request_device(&descriptor);
    let (device, queue) = pollster::block_on(request).map_err(|error| error.to_string())?;
    Ok((adapter, device, queue))
}
