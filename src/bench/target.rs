//! What is measured: adapters, or the processor.

use crate::backend::BackendError;
use crate::gpu::{self, GpuDevice};
use crate::simulation::{AdapterChoice, SimulationError, adapter_names};

/// An open adapter, or the processor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// The processor, with as many threads as it has.
    Cpu,
    /// A device.
    Gpu(GpuDevice),
}

impl Target {
    /// Opens what `choice` names, as `motes --adapter` understands it.
    ///
    /// # Errors
    /// No such adapter, or its driver refuses to open it.
    pub fn open(choice: &AdapterChoice) -> Result<Self, SimulationError> {
        let name = match choice {
            AdapterChoice::Cpu => return Ok(Self::Cpu),
            AdapterChoice::Device(device) => return Ok(Self::Gpu(device.clone())),
            AdapterChoice::Auto => "",
            AdapterChoice::Named(name) => name,
        };
        match gpu::open(name).map_err(|e: BackendError| SimulationError::from(e))? {
            Some(device) => Ok(Self::Gpu(device)),
            None if name.is_empty() => Ok(Self::Cpu),
            None => Err(SimulationError::NoAdapter {
                wanted: name.to_owned(),
                available: adapter_names(),
            }),
        }
    }

    /// The driver's name for the adapter, or `cpu`.
    pub fn name(&self) -> &str {
        match self {
            Self::Cpu => "cpu",
            Self::Gpu(device) => &device.description.name,
        }
    }
}
