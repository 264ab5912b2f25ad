//! The Genesis sequence: the numbers of its figures (Reeves 1983, section 3).

use motes::scene::Scene;
use motes::simulation::Simulation;

use crate::common;
use crate::support::simulation;

fn scene(name: &str) -> Scene {
    motes::scene::load(name).expect("it is built in")
}

/// Systems and particles that live after a frame; nobody was dropped on the way.
fn live(simulation: &mut Simulation, frame: u32) -> (u32, u32) {
    simulation.seek(frame).expect("it steps");
    let lines = simulation.take_statistics().expect("they can be read");
    assert!(
        lines.iter().all(|line| line.dropped == 0),
        "no births are dropped"
    );
    assert!(
        lines
            .iter()
            .all(|line| line.systems_requested == line.systems_born)
    );
    let last = lines.last().expect("frames were stepped");
    (last.systems_live, last.live)
}

fn within(value: u32, wanted: u32, what: &str) {
    let off = f64::from(value) / f64::from(wanted) - 1.0;
    assert!(
        off.abs() <= 0.1,
        "{what}: {value}, and {wanted} +/- 10 % are wanted"
    );
}

fn counts(name: &str, frame: u32, systems: u32, particles: u32) -> Simulation {
    let mut run = simulation(&scene(name));
    let (live_systems, live_particles) = live(&mut run, frame);
    within(live_systems, systems, "systems");
    within(live_particles, particles, "particles");
    run
}

#[test]
fn r66_the_impact_is_of_21_systems_and_25_000_particles() {
    let mut run = simulation(&scene("genesis-impact"));
    let (systems, particles) = live(&mut run, 40);
    assert_eq!(systems, 21);
    within(particles, 25_000, "particles");
}

#[test]
fn r67_partway_there_are_200_systems_and_75_000_particles() {
    counts("genesis-rings", 60, 200, 75_000);
}

#[test]
fn r68_over_the_limb_there_are_200_explosions_before_and_behind_the_outline() {
    let mut run = counts("genesis-limb", 64, 200, 85_000);
    let inputs = run.frame_inputs().expect("it has begun").clone();
    let [x, y, z, distance] = inputs.frame.planet_outline;
    let particles = run.particles().expect("they can be read");
    let behind = particles
        .iter()
        .filter(|particle| {
            let [px, py, pz] = particle.position;
            x * px + y * py + z * pz < distance
        })
        .count();
    assert!(
        behind > 5000 && particles.len() - behind > 5000,
        "{behind} of {}",
        particles.len()
    );
}

/// A scene of more than 750,000 particles, as a picture of a sixteenth of the pixels, so that its
/// births by screen area are a sixteenth too; and that share.
fn large(name: &str) -> (Scene, f64) {
    let mut scene = scene(name);
    if common::full() {
        return (scene, 1.0);
    }
    scene.image.width /= 4;
    scene.image.height /= 4;
    (scene, 1.0 / 16.0)
}

#[test]
fn r69_before_the_camera_is_engulfed_there_are_400_systems_and_750_000_particles() {
    let (scene, share) = large("genesis-wall");
    let (systems, particles) = live(&mut simulation(&scene), 60);
    within(systems, 400, "systems");
    assert!(f64::from(particles) >= 750_000.0 * share, "{particles}");
}

#[test]
fn r70_the_camera_is_engulfed_by_400_systems_and_750_000_particles() {
    let (scene, share) = large("genesis-engulfed");
    let mut run = simulation(&scene);
    let (systems, particles) = live(&mut run, 78);
    within(systems, 400, "systems");
    assert!(f64::from(particles) >= 750_000.0 * share, "{particles}");
    run.draw().expect("it draws");
    let bytes = run.image().expect("it can be read");
    let lit = bytes
        .chunks(4)
        .filter(|pixel| pixel[..3].iter().any(|channel| *channel > 0));
    let lit = lit.count() as f64 / (bytes.len() / 4) as f64;
    assert!(lit >= 0.99, "{lit} of the pixels are lit");
}
