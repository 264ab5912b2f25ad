//! Which adapter a simulation runs on.

use super::{Options, SimulationError};
use crate::backend::Backend;
use crate::cpu::CpuBackend;
use crate::gpu::{self, GpuBackend, GpuDevice};
use crate::plan::Plan;

/// Which adapter to run on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum AdapterChoice {
    /// Hardware, else software Vulkan, else the processor.
    #[default]
    Auto,
    /// The processor, without any driver.
    Cpu,
    /// The first adapter whose name or driver contains this, whatever the case.
    Named(String),
    /// A device that is open: the caller's own ([`GpuDevice::from_wgpu`]), or one that several
    /// simulations share.
    Device(GpuDevice),
}

impl AdapterChoice {
    /// The choice that the variable `MOTES_ADAPTER` names, as `motes --adapter` understands it;
    /// [`AdapterChoice::Auto`] where it is not set.
    pub fn from_env() -> Self {
        Self::parse(&std::env::var("MOTES_ADAPTER").unwrap_or_default())
    }

    /// As people write it: `auto`, `cpu`, or part of an adapter's name.
    pub fn parse(text: &str) -> Self {
        match text.trim().to_lowercase().as_str() {
            "" | "auto" => Self::Auto,
            "cpu" => Self::Cpu,
            name => Self::Named(name.to_owned()),
        }
    }
}

/// The names of all adapters that a choice can name.
pub fn adapter_names() -> Vec<String> {
    let mut names: Vec<_> = gpu::adapters()
        .into_iter()
        .map(|adapter| adapter.name)
        .collect();
    names.push("cpu".into());
    names
}

/// An empty run of the plan where the options say.
pub(super) fn backend(plan: &Plan, options: &Options) -> Result<Box<dyn Backend>, SimulationError> {
    let on_cpu = || -> Result<Box<dyn Backend>, SimulationError> {
        Ok(Box::new(CpuBackend::new(plan, options.threads)?))
    };
    let on = |device: &GpuDevice| -> Result<Box<dyn Backend>, SimulationError> {
        let begun = match &options.kernels {
            Some(texts) => GpuBackend::with_kernels(device, plan, &options.gpu, texts),
            None => GpuBackend::new(device, plan, &options.gpu),
        };
        Ok(Box::new(begun?))
    };
    match &options.adapter {
        AdapterChoice::Cpu => on_cpu(),
        AdapterChoice::Device(device) => on(device),
        AdapterChoice::Named(name) => match gpu::open(name)? {
            Some(device) => on(&device),
            None => Err(SimulationError::NoAdapter {
                wanted: name.clone(),
                available: adapter_names(),
            }),
        },
        // An adapter that does not open, or has no room, is passed over.
        AdapterChoice::Auto => gpu::adapters()
            .iter()
            .filter_map(|adapter| gpu::open(&adapter.name).ok().flatten())
            .find_map(|device| on(&device).ok())
            .map_or_else(on_cpu, Ok),
    }
}
