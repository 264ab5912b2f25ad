//! Holds an adapter against the processor, bit for bit, frame by frame, as `motes check` does.
//!
//!     cargo run --example compare_backends
//!
//! `MOTES_ADAPTER` may name part of the adapter's name; with `cpu`, one thread is held against all.

use motes::AdapterChoice;
use motes::backend::Backend;
use motes::check::{CompareOptions, compare, shrunk};
use motes::cpu::CpuBackend;
use motes::gpu::{self, GpuBackend, GpuOptions};
use motes::plan::Plan;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = CompareOptions {
        frames: 16,
        record: false,
    };
    // Some 20,000 particles at most, and a small picture.
    let scene = shrunk(&motes::scene::load("sparks-in-wind")?, options.frames)?;
    let plan = Plan::new(&scene, options.frames)?;

    let device = match AdapterChoice::from_env() {
        AdapterChoice::Cpu => None,
        AdapterChoice::Named(name) => Some(gpu::open(&name)?.ok_or("there is no such adapter")?),
        _ => gpu::open("")?,
    };
    let name = device.as_ref().map_or("cpu", |on| &on.description.name);
    println!("{name}, against the processor on one thread");

    // Both are begun again when they differ, to find out where.
    let outcome = compare(
        &plan,
        &mut || Ok(Box::new(CpuBackend::new(&plan, Some(1))?)),
        &mut || -> Result<Box<dyn Backend>, _> {
            Ok(match &device {
                Some(device) => Box::new(GpuBackend::new(device, &plan, &GpuOptions::default())?),
                None => Box::new(CpuBackend::new(&plan, None)?),
            })
        },
        &options,
        &mut |_| {},
    )?;
    match &outcome.difference {
        Some(difference) => println!("different\n{difference}"),
        None => println!(
            "{} frames, up to {} particles, state {:016x}, image {:016x}: equal",
            outcome.frames, outcome.most_particles, outcome.state_digest, outcome.image_digest
        ),
    }
    Ok(())
}
