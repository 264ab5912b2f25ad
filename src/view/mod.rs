//! Playing with a scene in a window: `motes view` (Perry 1994, 1.2 and chapter 5: knobs that turn
//! while the fire burns).
//!
//! [`Session`] is the scene under way and all that can be done to it; [`App`] shows it; the window
//! and the script that stands in for one drive it. Whatever is done at the knobs is recorded, and
//! replays bit for bit.

mod app;
mod detail;
mod error;
mod knobs;
mod orbit;
mod pace;
mod script;
mod session;
mod source;
mod stage;
mod window;

pub use app::App;
pub use detail::Detail;
pub use error::WindowError;
pub use orbit::Orbit;
pub use pace::Pace;
pub use script::{Script, ScriptError, play};
pub use session::{Session, Told};
pub use source::Source;
pub use window::{Wish, open};

use crate::gpu;
use crate::simulation::AdapterChoice;

/// The best adapter whose name or driver contains `name`, whatever the case (any for `auto`), and that
/// will do; with a device that has what kernels need, and a clock if the adapter has one.
///
/// # Errors
/// There is none, or it does not open.
pub fn device_of(
    instance: &wgpu::Instance,
    name: &str,
    will_do: impl Fn(&wgpu::Adapter) -> bool,
) -> Result<(wgpu::Adapter, wgpu::Device, wgpu::Queue), Told> {
    let wanted = match AdapterChoice::parse(name) {
        AdapterChoice::Auto => "",
        _ => name,
    };
    let found = gpu::named(instance, wanted).find(|adapter| will_do(adapter));
    let adapter = found.ok_or_else(|| format!("there is no adapter `{name}`"))?;
    let mut descriptor = gpu::device_descriptor(&adapter);
    descriptor.required_features |= adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
    let request = adapter.request_device(&descriptor);
    let (device, queue) = pollster::block_on(request).map_err(|error| error.to_string())?;
    Ok((adapter, device, queue))
}
