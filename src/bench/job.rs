//! A scene at one count: what is to be measured.

use super::error::BenchError;
use crate::scene::Scene;

/// Most births a frame that a system may have, as scene files have it.
const MOST_BIRTHS: f32 = 16e6;

/// Most boids of a scene, as scene files have it.
const MOST_BOIDS: u32 = 32_000_000;

/// Most flames of a scene, as scene files have it.
const MOST_FLAMES: u32 = 1_000_000;

/// What is to be measured.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Particles alive, 1 ..= 10^9: births are scaled to reach them; where there are only flocks,
    /// boids, 1 ..= 3.2 x 10^7, and their world with them. `None` for the scene as it is.
    pub particles: Option<u32>,
}

impl Job<'_> {
    /// The scene as it will be run.
    ///
    /// # Errors
    /// The input's fault: nobody has said how the scene scales, or so many are too many.
    pub fn scaled(&self) -> Result<Scene, BenchError> {
        let scene = self.scene;
        match (self.particles, scene.steady_particles) {
            (None, _) => Ok(scene.clone()),
            (Some(particles), Some(steady)) => more_births(scene, particles, steady),
            (Some(flames), None) if scene.systems.is_empty() && scene.flocks.is_empty() => {
                more_flames(scene, flames)
            }
            (Some(boids), None) if scene.systems.is_empty() => more_boids(scene, boids),
            (Some(_), None) => Err(BenchError::input(
                format!(
                    "the scene `{}` does not say how its particles scale",
                    scene.name
                ),
                "give it `steady_particles`, the number alive once births and deaths balance, or \
                 leave --particles out",
            )),
        }
    }
}

fn more_births(scene: &Scene, particles: u32, steady: u32) -> Result<Scene, BenchError> {
    let scaled = scene.with_births(f64::from(particles) / f64::from(steady));
    let most = |scene: &Scene| {
        let births = scene.systems.iter().map(|system| {
            let bursts = system.bursts.iter().map(|burst| burst.parts.mean);
            bursts.fold(system.births.initial_mean_parts, f32::max)
        });
        births.fold(0.0, f32::max)
    };
    let births = most(&scaled);
    if births > MOST_BIRTHS {
        let possible = f64::from(particles) * f64::from(MOST_BIRTHS) / f64::from(births);
        return Err(BenchError::input(
            format!(
                "{particles} particles of `{}` take {births} births a frame in one system",
                scaled.name
            ),
            format!("at most {} particles", possible as u64),
        ));
    }
    Ok(scaled)
}

/// The flames that stand on roots grow alike in number; those that are listed stay as they are.
fn more_flames(scene: &Scene, flames: u32) -> Result<Scene, BenchError> {
    let mut scaled = scene.clone();
    let listed: u32 = scene
        .fires
        .iter()
        .map(|fire| fire.listed.len() as u32)
        .sum();
    let on_roots: u32 = scene.fires.iter().map(|fire| fire.roots.count()).sum();
    if flames > MOST_FLAMES {
        return Err(BenchError::input(
            format!("{flames} flames of `{}` are too many", scene.name),
            format!("at most {MOST_FLAMES} flames"),
        ));
    }
    if on_roots == 0 || flames <= listed {
        return Err(BenchError::input(
            format!(
                "{listed} flames of `{}` are listed, and {on_roots} others can be more or fewer",
                scene.name
            ),
            "a fire with `roots`, and more flames than are listed".to_owned(),
        ));
    }
    let mut left = flames - listed;
    let last = scene.fires.iter().rposition(|fire| fire.roots.count() > 0);
    for (at, fire) in scaled.fires.iter_mut().enumerate() {
        let own = u64::from(fire.roots.count());
        let share = own * u64::from(flames - listed) / u64::from(on_roots);
        let wanted = if Some(at) == last {
            left
        } else {
            (share as u32).min(left)
        };
        fire.roots.set_count(wanted);
        left -= if own > 0 { wanted } else { 0 };
    }
    Ok(scaled)
}

/// All flocks grow alike.
fn more_boids(scene: &Scene, boids: u32) -> Result<Scene, BenchError> {
    let all: u32 = scene.flocks.iter().map(|flock| flock.count).sum();
    if boids > MOST_BOIDS {
        return Err(BenchError::input(
            format!("{boids} boids of `{}` are too many", scene.name),
            format!("at most {MOST_BOIDS} boids"),
        ));
    }
    Ok(scene.with_boids(f64::from(boids) / f64::from(all.max(1))))
}
