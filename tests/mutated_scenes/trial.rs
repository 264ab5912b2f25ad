//! One mutant: read, planned, and stepped where it can be.

use std::time::Instant;

use motes::plan::Plan;
use motes::scene::{Fire, Scene, parse};
use motes::simulation::{AdapterChoice, Options, Simulation, SimulationError};

/// Systems of a scene that is stepped, at most, so that a frame takes milliseconds.
const MOST_SYSTEMS: usize = 256;

/// How far a mutant came.
#[derive(Clone, Copy)]
pub(crate) enum Outcome {
    /// It is no scene.
    Refused,
    /// It is a scene that cannot be planned as it is; with its own capacity it may be.
    Unplanned,
    /// It is a scene, planned and stepped.
    Stepped,
}

impl Outcome {
    pub(crate) const ALL: [Self; 2] = [Self::Refused, Self::Stepped];

    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Refused => "refused",
            Self::Unplanned => "unplanned",
            Self::Stepped => "stepped",
        }
    }
}

pub(crate) struct Done {
    pub(crate) outcome: Outcome,
    pub(crate) ms: u64,
    /// The most memory that the process had meanwhile; 0 where the system does not say.
    pub(crate) peak_kib: u64,
}

/// Tries one mutant.
pub(crate) fn run(text: &str, number: u64) -> Done {
    // Resets the peak, where there is one.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let begun = Instant::now();
    let outcome = outcome(text, number);
    Done {
        outcome,
        ms: begun.elapsed().as_millis() as u64,
        peak_kib: peak_kib(),
    }
}

fn outcome(text: &str, number: u64) -> Outcome {
    let scene = match parse(text, "scenes/mutant.toml", "mutant") {
        Ok(scene) => scene,
        Err(error) => {
            let shown = error.to_string();
            assert!(shown.len() < 5000 && !error.help().is_empty(), "{shown}");
            return Outcome::Refused;
        }
    };
    let planned = Plan::new(&scene, scene.frames);
    if let Err(error) = &planned {
        assert!(!error.message.is_empty() && !error.help.is_empty());
    }
    if scene.systems.len() <= MOST_SYSTEMS {
        let first = number % u64::from(scene.frames.min(200));
        step(scene, first as u32);
    }
    match planned {
        Ok(_) => Outcome::Stepped,
        Err(_) => Outcome::Unplanned,
    }
}

/// Two frames from the first on, and two from `first` on, of a small picture and few particles,
/// boids and flames.
fn step(mut scene: Scene, first: u32) {
    (scene.image.width, scene.image.height) = (48, 27);
    scene.capacity = Some(scene.capacity.unwrap_or(4000).min(4000));
    let boids: u32 = scene.flocks.iter().map(|flock| flock.count).sum();
    for flock in &mut scene.flocks {
        flock.count =
            ((f64::from(flock.count) * 4000.0 / f64::from(boids.max(4000))) as u32).max(1);
    }
    let flames: u32 = scene.fires.iter().map(Fire::count).sum();
    for fire in &mut scene.fires {
        fire.roots.scale(400.0 / f64::from(flames.max(400)));
    }
    let options = Options {
        adapter: AdapterChoice::Cpu,
        frame_end: first + 2,
        ..Options::default()
    };
    for from in [None, Some(first.cast_signed())] {
        let mut simulation = match Simulation::new(&scene, &options) {
            Ok(simulation) => simulation,
            Err(error) => {
                // No lifetime and too long a run, or rows of parameters beyond the memory.
                assert!(!error.to_string().is_empty());
                return;
            }
        };
        simulation.begin_at(from.unwrap_or(simulation.plan().first_frame));
        two_frames(&mut simulation).unwrap_or_else(|error| panic!("{error}"));
    }
}

fn two_frames(simulation: &mut Simulation) -> Result<(), SimulationError> {
    let capacity = simulation.plan().capacity;
    for _ in 0..2 {
        simulation.step()?;
        simulation.draw()?;
        for line in simulation.take_statistics()? {
            assert_eq!(line.requested, line.born + line.dropped, "{line:?}");
            assert!(line.live <= capacity, "{line:?}");
        }
    }
    for particle in simulation.particles()? {
        let values = particle.position.into_iter().chain(particle.velocity);
        assert!(!values.into_iter().any(f32::is_nan), "{particle:?}");
    }
    let pixels = simulation.image()?;
    assert_eq!(pixels.len(), 48 * 27 * 4);
    Ok(())
}

fn peak_kib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let number = line.and_then(|line| line.split_whitespace().next());
    number.and_then(|number| number.parse().ok()).unwrap_or(0)
}
