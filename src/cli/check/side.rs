//! The two things that are compared: adapters, or the processor.

use super::CliError;
use crate::backend::{Backend, BackendError};
use crate::cpu::CpuBackend;
use crate::gpu::{self, GpuBackend, GpuDevice, GpuOptions};
use crate::plan::Plan;
use crate::simulation::{AdapterChoice, SimulationError, adapter_names};

/// What a run can stand on; opened once for all scenes.
pub(super) enum Side {
    /// The processor.
    Cpu,
    /// A device.
    Gpu(GpuDevice),
    /// A processor that is wrong on purpose.
    #[cfg(test)]
    Wrong(super::tests::Defect),
}

/// Opens the adapter under test and what it is compared with.
///
/// # Errors
/// No such adapter, one that promises no bits, or nothing to compare.
pub(super) fn both(tested: &str, against: &str) -> Result<(Side, Side), CliError> {
    let sides = (Side::open(tested)?, Side::open(against)?);
    let asked_for_cpu = |choice| AdapterChoice::parse(choice) == AdapterChoice::Cpu;
    if let (Side::Cpu, Side::Cpu) = sides
        && !(asked_for_cpu(tested) && asked_for_cpu(against))
    {
        return Err(CliError::machine(
            "no Vulkan driver is here to be checked",
            "install one: lavapipe needs no graphics card (Debian: apt-get install \
             mesa-vulkan-drivers)",
        ));
    }
    if let (Side::Cpu, Side::Cpu) = sides {
        return Err(CliError::usage(
            "the processor would be compared with itself",
            format!(
                "name another adapter with --adapter; adapters here: {}",
                adapter_names().join(", ")
            ),
        ));
    }
    if let (Side::Gpu(one), Side::Gpu(other)) = &sides
        && (&one.description.name, &one.description.driver)
            == (&other.description.name, &other.description.driver)
    {
        return Err(CliError::usage(
            format!("{} would be compared with itself", sides.0.name()),
            "name two adapters, or leave out --against to compare with the processor",
        ));
    }
    for side in [&sides.0, &sides.1] {
        if !side.is_exact() {
            return Err(CliError::usage(
                format!(
                    "{} takes no SPIR-V, so its driver is free to round as it likes",
                    side.name()
                ),
                "check an adapter that `motes adapters` calls exact",
            ));
        }
    }
    Ok(sides)
}

impl Side {
    fn open(choice: &str) -> Result<Self, CliError> {
        let name = match AdapterChoice::parse(choice) {
            AdapterChoice::Cpu => return Ok(Self::Cpu),
            AdapterChoice::Auto => String::new(),
            AdapterChoice::Named(name) => name,
            AdapterChoice::Device(device) => return Ok(Self::Gpu(device)),
        };
        match gpu::open(&name)? {
            Some(device) => Ok(Self::Gpu(device)),
            None if name.is_empty() => Ok(Self::Cpu),
            None => Err(SimulationError::NoAdapter {
                wanted: name,
                available: adapter_names(),
            }
            .into()),
        }
    }

    /// An empty run of the plan.
    pub(super) fn start(&self, plan: &Plan) -> Result<Box<dyn Backend>, BackendError> {
        Ok(match self {
            Self::Cpu => Box::new(CpuBackend::new(plan, None)?),
            Self::Gpu(device) => Box::new(GpuBackend::new(device, plan, &GpuOptions::default())?),
            #[cfg(test)]
            Self::Wrong(defect) => defect.start(plan)?,
        })
    }

    fn is_exact(&self) -> bool {
        match self {
            Self::Cpu => true,
            Self::Gpu(device) => device.description.exact,
            #[cfg(test)]
            Self::Wrong(_) => true,
        }
    }

    /// The adapter's name.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Cpu => "cpu",
            Self::Gpu(device) => &device.description.name,
            #[cfg(test)]
            Self::Wrong(_) => "Wrong \"<&'\u{1}>\" adapter",
        }
    }

    /// Driver and its version.
    pub(super) fn driver(&self) -> String {
        match self {
            Self::Cpu => format!("motes {} with rayon", env!("CARGO_PKG_VERSION")),
            Self::Gpu(device) => device.description.driver.clone(),
            #[cfg(test)]
            Self::Wrong(_) => "test".into(),
        }
    }

    /// Name and driver.
    pub(super) fn description(&self) -> String {
        format!("{} ({})", self.name(), self.driver())
    }
}
