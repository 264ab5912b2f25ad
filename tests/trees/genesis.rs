//! The Genesis sequence: the numbers of its figures (Reeves 1983, section 3).

use std::f64::consts::TAU;

use motes::layout::NODE_LIVES;
use motes::scene::{GenerationShape, Scene};
use motes::simulation::Simulation;

use crate::common;
use crate::common::statistics::assert_uniform;
use crate::support::{Run, length, origin, simulation};

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
    // The background's blue is not quite black; fire is red before all.
    let lit = bytes.chunks(4).filter(|pixel| pixel[0] > 0);
    let lit = lit.count() as f64 / (bytes.len() / 4) as f64;
    // In a small picture particles are as many a pixel and as large in the world: thinner in pixels.
    let least = if common::full() { 0.99 } else { 0.95 };
    assert!(lit >= least, "{lit} of the pixels are lit");
}

/// The systems of a scene alone, none of which bears a particle.
fn barren(name: &str, seed: u64) -> Scene {
    let mut scene = scene(name);
    scene.seed = seed;
    scene.image.width = 64;
    scene.image.height = 36;
    let parents: Vec<String> = scene
        .systems
        .iter()
        .filter_map(|it| it.parent.clone())
        .collect();
    for system in &mut scene.systems {
        if !parents.contains(&system.name) {
            system.births.initial_mean_parts = 0.0;
            system.births.var_parts = 0.0;
            system.inherit.mean_parts = 0.0;
            system.inherit.var_parts = 0.0;
        }
    }
    scene
}

/// Radius of the planet, the speed of its rings, frames between them, their density.
fn rings_of(scene: &Scene) -> [f64; 4] {
    let shapes = scene.systems.iter().map(|system| &system.generation_shape);
    let mut rings = shapes.filter_map(|shape| match *shape {
        GenerationShape::Rings {
            radius,
            wall_speed,
            ring_frames,
            density,
        } => Some([radius, wall_speed, ring_frames as f32, density].map(f64::from)),
        _ => None,
    });
    rings.next_back().expect("it has rings")
}

#[test]
fn r48_all_systems_of_the_genesis_scenes_are_born_on_their_planet() {
    for name in [
        "genesis",
        "genesis-impact",
        "genesis-rings",
        "genesis-limb",
        "genesis-wall",
        "genesis-engulfed",
    ] {
        let scene = barren(name, 7);
        let planet = scene.planet.expect("it has a planet");
        let (center, radius) = (planet.center.map(f64::from), f64::from(planet.radius));
        // The top of the tree is at the point of impact, on the ground.
        let above = |place: [f64; 3]| length([0, 1, 2].map(|i| place[i] - center[i])) - radius;
        for system in scene.systems.iter().filter(|system| system.name != "stars") {
            let has_no_parent = system.parent.is_none();
            let off = above(system.position.map(f64::from));
            assert!(
                !has_no_parent || off.abs() < 1e-5 * radius,
                "{name}, {}: {off}",
                system.name
            );
        }
        let mut run = Run::new(&scene);
        let mut met = 0;
        for _ in 0..scene.frames {
            run.step();
            for (_, system, _) in run.newborn() {
                let off = above(origin(&system));
                assert!(off.abs() < 1e-5 * radius, "{name}: {off}");
                met += 1;
            }
        }
        println!("{name}: {met} systems");
        assert!(met > 20, "{name}: {met}");
    }
}

#[test]
fn r49_rings_of_the_genesis_scenes_are_as_dense_as_they_say() {
    for name in [
        "genesis-rings",
        "genesis-limb",
        "genesis-wall",
        "genesis-engulfed",
    ] {
        let scene = barren(name, 7);
        let [radius, speed, ring_frames, density] = rings_of(&scene);
        let mut run = Run::new(&scene);
        let mut around = Vec::new();
        let first = i64::from(scene.systems[1].first_frame);
        for _ in 0..scene.frames {
            let frame = i64::from(run.frame.cast_signed());
            run.step();
            let born = run.newborn();
            let since = (frame - first) as f64;
            let is_due = since >= 0.0 && since % ring_frames == 0.0;
            let is_over = scene.systems[1]
                .end_frame
                .is_some_and(|end| frame >= i64::from(end));
            let rho = if is_due && !is_over {
                since * speed
            } else {
                0.0
            };
            let wanted = (density * TAU * radius * (rho / radius).sin()).round() as usize;
            assert_eq!(born.len(), wanted, "{name}, frame {frame}");
            around.extend(born.iter().map(|(_, system, _)| {
                let [x, y, _] = origin(system);
                y.atan2(x).rem_euclid(TAU)
            }));
        }
        assert!(around.len() > 200, "{name}");
        assert_uniform(name, &around, 0.0, TAU);
    }
}

/// The share of directions from the point of impact in which some system that bears particles has its
/// circle on the ground: the wall is as wide as those rings are apart that bear at the same time.
#[test]
fn r49_the_wall_of_fire_has_no_gaps() {
    for (name, frame) in [("genesis-rings", 60), ("genesis-wall", 60)] {
        let mut sum = 0.0;
        for seed in 0..100 {
            let scene = barren(name, seed);
            let [radius, ..] = rings_of(&scene);
            let mut run = Run::new(&scene);
            while run.frame != frame + 1 {
                run.step();
            }
            const STEPS: usize = 3600;
            let mut covered = [false; STEPS];
            for (node, system, row) in run.borne() {
                if node.spans[0] != NODE_LIVES {
                    continue;
                }
                let [x, y, _] = origin(&system);
                let aside = f64::from(row.shape[0]) / x.hypot(y).max(1e-9);
                let half = if aside < 1.0 { aside.asin() } else { TAU / 2.0 };
                assert!(row.shape[0] > 0.1 && f64::from(row.shape[0]) < radius);
                let step = TAU / STEPS as f64;
                let first = ((y.atan2(x) - half) / step).ceil() as i64;
                let last = ((y.atan2(x) + half) / step).floor() as i64;
                for at in first..=last {
                    covered[at.rem_euclid(STEPS as i64) as usize] = true;
                }
            }
            let share = covered.iter().filter(|it| **it).count() as f64 / STEPS as f64;
            sum += share;
        }
        let mean = sum / 100.0;
        println!("{name}: {mean} of all directions");
        assert!(mean >= 0.99, "{name}: {mean}");
    }
}
