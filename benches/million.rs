//! What each kernel of a frame costs with a million live particles, beside a copy of the same
//! bytes on the same adapter in the same run.
//!
//!     cargo bench --bench million -- [ADAPTER] [SCENE] [FRAMES]

use std::collections::BTreeMap;
use std::time::Instant;

use motes::backend::Backend;
use motes::cpu::CpuBackend;
use motes::gpu::{self, GpuBackend, GpuOptions};
use motes::plan::Plan;
use motes::scene;

fn main() {
    // Cargo hands `--bench` over as well.
    let mut words = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with("--"));
    let adapter = words.next().unwrap_or_else(|| "llvmpipe".into());
    let name = words.next().unwrap_or_else(|| "million".into());
    let frames: u32 = words
        .next()
        .and_then(|word| word.parse().ok())
        .unwrap_or(31);
    if let Err(e) = measure(&adapter, &name, frames) {
        eprintln!("{e}");
        std::process::exit(3);
    }
}

/// The tenth, the median and the ninetieth percentile.
fn spread(mut times: Vec<f64>) -> [f64; 3] {
    times.sort_by(f64::total_cmp);
    [0.1, 0.5, 0.9].map(|part| times[((times.len() - 1) as f64 * part).round() as usize])
}

fn line(name: &str, times: Vec<f64>, copy_ms: f64) {
    if times.is_empty() {
        return;
    }
    let [low, median, high] = spread(times);
    println!(
        "{name:<24} {median:8.2} {low:8.2} {high:8.2} {:8.2}",
        median / copy_ms
    );
}

fn measure(adapter: &str, name: &str, frames: u32) -> Result<(), Box<dyn std::error::Error>> {
    let scene = scene::load(name)?;
    let warm = 64;
    let plan = Plan::new(&scene, warm + frames)?;
    let device = gpu::open(adapter)?.ok_or("no such adapter")?;
    let options = GpuOptions {
        timed: true,
        ..GpuOptions::default()
    };
    let mut backend = GpuBackend::new(&device, &plan, &options)?;
    for frame in 0..warm {
        backend.step(&plan.inputs(frame))?;
    }
    backend.take_times()?;

    let mut walls = (Vec::new(), Vec::new());
    let mut kernels: BTreeMap<usize, (&str, Vec<f64>)> = BTreeMap::new();
    let mut copies = Vec::new();
    let mut steps = Vec::new();
    let mut live = 0;
    for frame in warm..warm + frames {
        let inputs = plan.inputs(frame);
        let start = Instant::now();
        backend.step(&inputs)?;
        live = backend
            .take_statistics()?
            .last()
            .map_or(0, |line| line.live);
        walls.0.push(start.elapsed().as_secs_f64() * 1e3);
        let start = Instant::now();
        backend.draw(&inputs)?;
        backend.take_statistics()?;
        walls.1.push(start.elapsed().as_secs_f64() * 1e3);
        let times = backend.take_times()?;
        let mut step = 0.0;
        for (at, (kernel, ms)) in times.iter().flatten().enumerate() {
            kernels
                .entry(at)
                .or_insert((kernel, Vec::new()))
                .1
                .push(*ms);
            if !kernel.starts_with("draw/") {
                step += ms;
            }
        }
        steps.push(step);
        copies.extend(device.yardstick_times("bench/copy", live, 256, 1)?);
    }
    let [_, copy_ms, _] = spread(copies.clone());
    println!(
        "{name} on {}: {live} live, {frames} frames",
        device.description.name
    );
    println!(
        "{:<24} {:>8} {:>8} {:>8} {:>8}",
        "ms", "median", "p10", "p90", "/ copy"
    );
    line("copy (64 bytes each)", copies, copy_ms);
    for (kernel, times) in kernels.into_values() {
        line(kernel, times, copy_ms);
    }
    line("step, kernels' sum", steps, copy_ms);
    line("step, wall clock", walls.0, copy_ms);
    line("draw, wall clock", walls.1, copy_ms);

    let mut cpu = CpuBackend::new(&plan, None)?;
    let mut on_cpu = (Vec::new(), Vec::new());
    for frame in 0..warm + frames {
        let inputs = plan.inputs(frame);
        let start = Instant::now();
        cpu.step(&inputs)?;
        let stepped = Instant::now();
        if frame >= warm {
            on_cpu.0.push((stepped - start).as_secs_f64() * 1e3);
            cpu.draw(&inputs)?;
            on_cpu.1.push(stepped.elapsed().as_secs_f64() * 1e3);
        }
    }
    line("cpu backend: step", on_cpu.0, copy_ms);
    line("cpu backend: draw", on_cpu.1, copy_ms);
    Ok(())
}
