//! Shows after figures 9 to 11 and section 4.2 of Reeves (1983): the built-in scenes have what the
//! captions say.

use std::collections::BTreeSet;

use motes::scene::{self, Scene};
use motes::simulation::{AdapterChoice, Options, ParticleState, Simulation};

/// The living of a built-in scene after a frame, and the scene.
fn living(name: &str, frame: u32) -> (Scene, Vec<ParticleState>) {
    let scene = scene::load(name).expect("it is built in");
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("it starts");
    simulation.seek(frame).expect("the backend steps");
    let particles = simulation.particles().expect("the backend reads");
    (scene, particles)
}

/// The living of the systems whose names begin so.
fn of(scene: &Scene, all: &[ParticleState], name: &str) -> Vec<ParticleState> {
    let is_meant = |p: &&ParticleState| scene.systems[p.system as usize].name.starts_with(name);
    all.iter().filter(is_meant).copied().collect()
}

/// Height over width of a cloud, without its outermost fiftieths.
fn height_over_width(cloud: &[ParticleState]) -> f32 {
    let extent = |axis: usize| {
        let mut at: Vec<f32> = cloud.iter().map(|p| p.position[axis]).collect();
        at.sort_by(f32::total_cmp);
        let part = at.len() / 50;
        at[at.len() - 1 - part] - at[part]
    };
    extent(1) / extent(0)
}

/// Least and greatest share of their lives that particles have behind them.
fn shares_of_life(cloud: &[ParticleState]) -> (f32, f32) {
    let share = |p: &ParticleState| p.age as f32 / p.lifetime as f32;
    let shares = cloud.iter().map(share);
    shares.fold((f32::MAX, 0.0), |(low, high), share| {
        (low.min(share), high.max(share))
    })
}

#[test]
fn r76_one_red_shell_is_tall_thin_and_late_the_other_short_fat_and_early() {
    let (scene, all) = living("fireworks-red", 40);
    let named = |name: &str| -> Vec<ParticleState> {
        let is_meant = |p: &&ParticleState| scene.systems[p.system as usize].name == name;
        all.iter().filter(is_meant).copied().collect()
    };
    let (tall, fat) = (named("tall"), named("fat"));
    assert!(tall.len() > 1000 && fat.len() > 1000);
    assert!(
        height_over_width(&tall) > 2.0,
        "{}",
        height_over_width(&tall)
    );
    assert!(height_over_width(&fat) < 1.0, "{}", height_over_width(&fat));
    let mean_share = tall
        .iter()
        .map(|p| p.age as f32 / p.lifetime as f32)
        .sum::<f32>();
    assert!(mean_share / tall.len() as f32 > 0.8);
    assert!(shares_of_life(&fat).1 < 0.3, "{:?}", shares_of_life(&fat));
    // Streaking predominates.
    let is_streak = |p: &&ParticleState| {
        scene.systems[p.system as usize].particle_shape == scene::ParticleShape::Streak
    };
    assert!(all.iter().filter(is_streak).count() * 10 > all.len() * 9);
}

#[test]
fn r77_green_ones_die_off_while_a_blue_one_starts() {
    let counts = |frame: u32| {
        let (scene, all) = living("fireworks-green-blue", frame);
        (
            of(&scene, &all, "green").len(),
            of(&scene, &all, "blue").len(),
        )
    };
    let series: Vec<_> = (46..=56).step_by(2).map(counts).collect();
    for pair in series.windows(2) {
        assert!(pair[1].0 < pair[0].0, "green: {series:?}");
        assert!(pair[1].1 > pair[0].1, "blue: {series:?}");
    }
    assert!(
        series[5].0 > 500,
        "they die off, and are not gone: {series:?}"
    );
}

#[test]
fn r78_multicolored_shells_have_shapes_and_angles_of_their_own() {
    for name in ["fireworks-multicolored", "fireworks"] {
        let (scene, _) = living(name, 0);
        let shape = |system: &scene::System| std::mem::discriminant(&system.generation_shape);
        let streaks: Vec<_> = scene
            .systems
            .iter()
            .filter(|system| system.particle_shape == scene::ParticleShape::Streak)
            .collect();
        let mut shapes = Vec::new();
        for system in &streaks {
            if !shapes.contains(&shape(system)) {
                shapes.push(shape(system));
            }
        }
        assert!(shapes.len() >= 3, "{name}: {} shapes", shapes.len());
        let angle = |system: &&scene::System| system.ejection_angle_degrees.to_bits();
        let angles: BTreeSet<_> = streaks.iter().map(angle).collect();
        assert!(angles.len() >= 3, "{name}: {} angles", angles.len());
    }
}

#[test]
fn r79_a_line_drawing_has_a_line_of_half_the_velocity_for_each_of_the_living() {
    // Seen along z without perspective, a world unit is 90 pixels everywhere.
    let scene = crate::common::scene_of(
        "[image]\nwidth = 720\nheight = 360\n[camera]\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\n\
         projection = \"orthographic\"\nview_height = 4\n[[system]]\nname = \"a\"\n\
         initial_mean_parts = 50\ngeneration_shape = { kind = \"sphere\", radius = 1 }\n\
         speed = { mean = 0.2, var = 0.1 }\nlifetime = 9\ncolor = [0.2, 0.4, 0.6]\nsize = 0.1\n\
         acceleration = [0, -0.01, 0]\n",
    );
    crate::support::on_every_backend(|on| {
        let options = Options {
            adapter: AdapterChoice::parse(on),
            ..Options::default()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("it starts");
        simulation.seek(12).expect("the backend steps");
        let lines = simulation.lines().expect("the backend reads");
        let particles = simulation.particles().expect("the backend reads");
        assert_eq!(lines.len(), particles.len());
        assert!(lines.len() > 400);
        for (line, particle) in lines.iter().zip(&particles) {
            let [x, y, _] = particle.position;
            let [vx, vy, _] = particle.velocity;
            let near = |got: f32, expected: f32| (got - expected).abs() < 1e-3;
            assert!(near(line.from_px[0], 360.0 + 90.0 * x));
            assert!(near(line.from_px[1], 180.0 - 90.0 * y));
            assert!(near(line.to_px[0] - line.from_px[0], 90.0 * 0.5 * vx));
            assert!(near(line.to_px[1] - line.from_px[1], -90.0 * 0.5 * vy));
            assert_eq!(line.color, [0.2, 0.4, 0.6]);
        }
    });
}

/// Seen along z without perspective, a world unit is 90 pixels everywhere.
const FLAT_VIEW: &str = "[image]\nwidth = 720\nheight = 360\n[camera]\nposition = [0, 0, 9]\n\
     target = [0, 0, 0]\nprojection = \"orthographic\"\nview_height = 4\n";

fn flat_px([x, y, _]: [f32; 3]) -> [f32; 2] {
    [360.0 + 90.0 * x, 180.0 - 90.0 * y]
}

fn near(got: [f32; 2], expected: [f32; 2]) -> bool {
    (0..2).all(|axis| (got[axis] - expected[axis]).abs() < 1e-3)
}

#[test]
fn a_line_drawing_follows_the_particle_of_each_flame() {
    let scene = crate::common::scene_of(&format!(
        "{FLAT_VIEW}[[fire]]\nname = \"a\"\n[[fire.flame]]\nposition = [-1, 0.5, 0]\n\
         [[fire.flame]]\nposition = [1, -0.5, 0]\n"
    ));
    crate::support::on_every_backend(|on| {
        let options = Options {
            adapter: AdapterChoice::parse(on),
            ..Options::default()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("it starts");
        simulation.seek(5).expect("the backend steps");
        let lines = simulation.lines().expect("the backend reads");
        let means = simulation.flame_lights().expect("the backend reads");
        // Of a particle with 25 places.
        assert_eq!((lines.len(), means.len()), (48, 2));
        for ((lines, mean), root) in lines.chunks(24).zip(means).zip([[-1.0, 0.5], [1.0, -0.5]]) {
            assert!(near(lines[0].from_px, flat_px([root[0], root[1], 0.0])));
            assert!(lines.windows(2).all(|two| two[0].to_px == two[1].from_px));
            let ends = lines.iter().map(|line| line.to_px);
            let sum = ends.fold(lines[0].from_px, |sum, end| {
                [sum[0] + end[0], sum[1] + end[1]]
            });
            assert!(near(sum.map(|sum| sum / 25.0), flat_px(mean)));
            assert!(lines[0].to_px[1] < lines[0].from_px[1], "it rises");
            assert!(lines[1].color[0] > lines[1].color[2], "it is warm");
        }
    });
}

#[test]
fn a_line_drawing_has_a_triangle_along_the_heading_of_each_boid() {
    let scene = crate::common::scene_of(&format!(
        "{FLAT_VIEW}[[flock]]\nname = \"a\"\ncount = 30\nsize = 0.2\n\
         region = {{ min = [-2, -1, 0], max = [2, 1, 0] }}\nstart_speed = 0.01\n"
    ));
    crate::support::on_every_backend(|on| {
        let options = Options {
            adapter: AdapterChoice::parse(on),
            ..Options::default()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("it starts");
        simulation.seek(3).expect("the backend steps");
        let lines = simulation.lines().expect("the backend reads");
        let boids = simulation.boids().expect("the backend reads");
        assert_eq!((lines.len(), boids.len()), (90, 30));
        for (sides, boid) in lines.chunks(3).zip(boids) {
            let [vx, vy, _] = boid.velocity;
            let speed = vx.hypot(vy);
            let place = flat_px(boid.position);
            assert!(near(sides[0].from_px, place) && near(sides[2].to_px, place));
            assert!((0..3).all(|at| sides[at].to_px == sides[(at + 1) % 3].from_px));
            // From the middle of its base, of a fifth of a unit, to its tip.
            let [x, y] = [0, 1].map(|axis| (sides[0].from_px[axis] + sides[0].to_px[axis]) / 2.0);
            let tip = sides[1].to_px;
            let ahead = 90.0 * 0.2 * 1.2 / speed;
            assert!(near(tip, [x + ahead * vx, y - ahead * vy]), "{sides:?}");
        }
    });
}
