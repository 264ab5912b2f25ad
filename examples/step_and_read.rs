//! Steps a scene and reads it: statistics of every frame, and the particles themselves.
//!
//!     cargo run --example step_and_read
//!
//! `MOTES_ADAPTER` says where: `cpu`, or part of an adapter's name. The numbers are the same
//! anywhere.

use motes::{AdapterChoice, Options, Simulation};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Any key of a scene can be set; see `motes::scene::schema`.
    let sets = ["system.jet.initial_mean_parts=60".to_owned()];
    let scene = motes::scene::load_with("fountain", &sets)?;
    let options = Options {
        adapter: AdapterChoice::from_env(),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options)?;
    println!("fountain on {}", simulation.adapter_name());
    println!("frame  born  died   live  highest  fastest");
    for frame in 0..40 {
        simulation.step()?;
        if frame % 8 != 7 {
            continue;
        }
        let particles = simulation.particles()?;
        let most = |of: fn([f32; 3], [f32; 3]) -> f32| {
            let values = particles.iter().map(|p| of(p.position, p.velocity));
            values.fold(0.0, f32::max)
        };
        let highest = most(|[_, y, _], _| y);
        let fastest = most(|_, velocity| velocity.iter().map(|v| v * v).sum::<f32>().sqrt());
        // One line for each frame since they were last taken.
        let statistics = simulation.take_statistics()?;
        let sum =
            |of: fn(&motes::layout::FrameStats) -> u32| statistics.iter().map(of).sum::<u32>();
        println!(
            "{frame:5} {:5} {:5} {:6}  {highest:7.3}  {fastest:7.4}",
            sum(|line| line.born),
            sum(|line| line.died),
            particles.len(),
        );
    }
    Ok(())
}
