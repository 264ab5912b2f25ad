//! Explosions on a surface (Reeves 1983, section 3): how high they rise, and their colours.

use motes::scene::Scene;
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::common;

fn scene(particles: &str) -> Scene {
    common::scene_of(&format!(
        "frames = 90
         image = {{ width = 32, height = 32 }}
         camera = {{ position = [0, 0, 10], target = [0, 0, 0] }}
         [[system]]
         name = \"explosion\"
         birth_rounding = \"nearest\"
         end_frame = 1
         {particles}"
    ))
}

fn run(scene: &Scene) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("it begins")
}

#[test]
fn r52_gravity_pulls_particles_back_on_parabolas() {
    let gravity = 0.01f64;
    let scene = scene(
        "rotation_degrees = [-90, 0]
         initial_mean_parts = 200
         generation_shape = { kind = \"circle\", radius = 0.5 }
         ejection_angle_degrees = 30
         speed = { mean = 0.3, var = 0.1 }
         lifetime = 90
         color = [1, 1, 1]
         size = 0.1
         acceleration = [0, -0.01, 0]",
    );
    let mut run = run(&scene);
    let mut ways: Vec<Vec<[f64; 3]>> = vec![Vec::new(); 200];
    for frame in 0..80 {
        run.seek(frame).expect("it steps");
        for (way, particle) in ways
            .iter_mut()
            .zip(run.particles().expect("they can be read"))
        {
            way.push(particle.position.map(f64::from));
        }
    }
    for way in &ways {
        // What moved from the first frame to the second is the velocity less one pull.
        let first = [0, 1, 2].map(|i| way[1][i] - way[0][i]);
        let speed = first[1] + gravity;
        let start = way[0][1] - speed;
        let apex = way.iter().map(|place| place[1] - start).fold(0.0, f64::max);
        let wanted = speed * speed / (2.0 * gravity);
        assert!((apex - wanted).abs() <= speed, "{apex}, not {wanted}");
        // It comes down where the parabola says, as far away as it goes along in that time.
        let landing = way.iter().skip(1).position(|place| place[1] <= start);
        if let Some(frames) = landing {
            let frames = frames as f64 + 2.0;
            assert!((frames - 2.0 * speed / gravity).abs() <= 2.0, "{frames}");
            let place = way[frames as usize - 1];
            for axis in [0, 2] {
                let along = place[axis] - way[0][axis];
                let wanted = first[axis] * (frames - 1.0);
                assert!((along - wanted).abs() < 1e-3, "{along}, not {wanted}");
            }
        }
    }
    assert!(
        ways.iter()
            .filter(|way| way.last().is_some_and(|at| at[1] < 0.0))
            .count()
            > 100
    );
}

#[test]
fn r55_light_adds_up_to_red_orange_yellow_and_white() {
    for (count, wanted) in [
        (1, [0.40, 0.10, 0.02]),
        (3, [1.0, 0.30, 0.06]),
        (10, [1.0, 1.0, 0.20]),
        (50, [1.0, 1.0, 1.0]),
    ] {
        let scene = scene(&format!(
            "initial_mean_parts = {count}
             generation_shape = {{ kind = \"sphere\", radius = 0 }}
             speed = 0
             lifetime = 2
             color = [0.40, 0.10, 0.02]
             size = 9"
        ));
        let mut run = run(&scene);
        run.seek(0).expect("it steps");
        run.draw().expect("it draws");
        let image = run.image().expect("it can be read");
        let middle = &image[4 * (16 * 32 + 16)..][..3];
        for (byte, wanted) in middle.iter().zip(wanted) {
            let off = f64::from(*byte) / 255.0 - wanted;
            assert!(off.abs() < 0.5 / 255.0 + 1e-4, "{count}: {middle:?}");
        }
    }
}

#[test]
fn r56_explosions_cool_from_yellow_to_red() {
    // Those that ship, too: green and blue fall faster than red.
    for name in ["genesis-impact", "genesis-rings", "genesis-wall", "genesis"] {
        let scene = motes::scene::load(name).expect("it is built in");
        for system in scene
            .systems
            .iter()
            .filter(|system| system.parent.is_some())
        {
            let [red, green, blue] = system.color.rate;
            let [r, g, b] = system.color.initial.mean;
            assert!(
                red <= 0.0 && green < 0.0 && blue < 0.0,
                "{name}: {}",
                system.name
            );
            assert!(
                red / r > green / g && red / r > blue / b,
                "{name}: {}",
                system.name
            );
        }
    }
    let scene = scene(
        "initial_mean_parts = 30
         generation_shape = { kind = \"sphere\", radius = 0 }
         speed = 0
         lifetime = 30
         color = { mean = [0.03, 0.025, 0.012], rate = [-0.0004, -0.0008, -0.0006] }
         size = 9",
    );
    let mut run = run(&scene);
    let mut shares = Vec::new();
    for frame in 0..20 {
        run.seek(frame).expect("it steps");
        run.draw().expect("it draws");
        let image = run.image().expect("it can be read");
        let [r, g, b] = [0, 1, 2].map(|i| f64::from(image[4 * (16 * 32 + 16) + i]));
        shares.push([g / r, b / r]);
    }
    for two in shares.windows(2) {
        assert!(
            two[1][0] <= two[0][0] + 0.01 && two[1][1] <= two[0][1] + 0.01,
            "{two:?}"
        );
    }
    assert!(shares[19][0] < 0.7 * shares[0][0]);
}
