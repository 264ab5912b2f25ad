//! Turns knobs of a scene while it runs, and replays what was done, bit for bit.
//!
//!     cargo run --example edit_while_running
//!
//! What is born keeps its colour, size and lifetime; who is born from then on has the new ones.
//! `MOTES_ADAPTER` says where: `cpu`, or part of an adapter's name.

use motes::recording::{Change, Recording};
use motes::{AdapterChoice, Options, Simulation, scene};

const SCENE: &str = "sparks-in-wind";
const FRAMES: u32 = 24;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A smaller scene. Its births may be turned up later: the capacity has to cover that.
    let mut sets = vec![
        "image.width=160".to_owned(),
        "image.height=90".to_owned(),
        "capacity=100000".to_owned(),
    ];
    let base = scene::load_with(SCENE, &sets)?;
    let mut options = Options {
        adapter: AdapterChoice::from_env(),
        editable: true,
        ..Options::default()
    };

    // What somebody at the knobs does, and when.
    let knobs = [
        (6, "system.dust.initial_mean_parts=900"),
        (12, "system.dust.color=[0.9,0.1,0.1]"),
        (18, "system.dust.drag=0"),
    ];
    let mut recording = Recording::default();
    let mut simulation = Simulation::new(&base, &options)?;
    println!("{SCENE} on {}", simulation.adapter_name());
    simulation.seek_from(simulation.plan().first_frame, 0)?;
    for frame in 1..FRAMES {
        for (_, set) in knobs.iter().filter(|(at, _)| *at == frame) {
            sets.push((*set).to_owned());
            simulation.turn(scene::load_with(SCENE, &sets)?)?;
            println!("frame {frame}: {set}");
            recording.changes.push(Change {
                frame,
                set: (*set).to_owned(),
                line: 0,
            });
        }
        simulation.step()?;
        if frame % 6 == 5 {
            println!("frame {frame}: {} particles", simulation.particles()?.len());
        }
    }
    let live = simulation.state_digest()?;

    // The same again, with the changes known beforehand. They also are a text to keep in a file,
    // for `motes render --inputs`.
    print!("the recording:\n{}", recording.to_text());
    options.editable = false;
    options.turns = recording.turns(SCENE, &sets[..3])?;
    let mut replay = Simulation::new(&base, &options)?;
    replay.seek(FRAMES - 1)?;
    let replayed = replay.state_digest()?;
    let verdict = if live == replayed {
        "equal"
    } else {
        "different"
    };
    println!("live {live:016x}, replayed {replayed:016x}: {verdict}");
    Ok(())
}
