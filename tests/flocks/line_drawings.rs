//! Boids in line drawings.

use motes::simulation::Line;
use motes::{AdapterChoice, Options, Simulation};

use crate::common::adapters;
use crate::looks::{boids, pixels};

/// The lines and the boids after that frame, of 200 by 100 pixels of a world unit each.
fn drawn(
    flocks: &[String],
    frame: u32,
    on: &str,
) -> (Vec<Line>, Vec<motes::simulation::BoidState>) {
    let options = Options {
        adapter: AdapterChoice::parse(on),
        ..Options::default()
    };
    let scene = pixels(flocks, "[0, 0, 0]");
    let mut simulation = Simulation::new(&scene, &options).expect("it begins");
    simulation.seek(frame).expect("it steps");
    let lines = simulation.lines().expect("they can be read");
    (lines, simulation.boids().expect("they can be read"))
}

fn on_all(test: impl Fn(&str)) {
    for name in adapters().into_iter().chain(["cpu".to_owned()]) {
        test(&name);
    }
}

fn less(a: [f32; 2], b: [f32; 2]) -> [f64; 2] {
    [0, 1].map(|axis| f64::from(a[axis]) - f64::from(b[axis]))
}

fn length(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

/// Whether each line begins where the one before ends.
fn is_chain(lines: &[Line]) -> bool {
    lines.windows(2).all(|two| two[0].to_px == two[1].from_px)
}

const AROUND: &str = "region = { min = [60, 30, -30], max = [140, 70, 30] }";

fn cones(count: u32, lines: &str) -> String {
    let lines = format!("shape = \"cone\"\nsize = 12\ndimensions = 3\n{lines}");
    let region = "region = { min = [0, 0, 0], max = [1, 1, 0] }";
    boids(count, &lines).replace(region, AROUND)
}

/// Outlines of hulls of a circle and a point; of nothing but the circle, where the point is in it.
#[test]
fn cones_are_drawn_as_their_outlines() {
    on_all(|on| {
        let (lines, boids) = drawn(&[cones(60, "")], 3, on);
        let (mut pointed, mut round, mut rest) = (0, 0, lines.as_slice());
        for boid in boids {
            let speed = boid
                .velocity
                .map(f64::from)
                .iter()
                .map(|x| x * x)
                .sum::<f64>();
            let along = |sizes: f64| {
                let at = |axis: usize| {
                    let way = f64::from(boid.velocity[axis]) / speed.sqrt();
                    (f64::from(boid.position[axis]) + 12.0 * sizes * way) as f32
                };
                [at(0), at(1)]
            };
            let (base, apex) = (along(-0.75), along(1.25));
            let is_round = length(less(apex, base)) <= 6.0;
            let (outline, others) = rest.split_at(if is_round { 16 } else { 10 });
            rest = others;
            assert!(is_chain(outline), "{outline:?}");
            let last = outline[outline.len() - 1].to_px;
            let closed = length(less(outline[0].from_px, last));
            assert!(closed < 1e-3, "{closed}");
            let corners: Vec<[f32; 2]> = outline.iter().map(|line| line.from_px).collect();
            let on_circle = if is_round {
                &corners[..]
            } else {
                &corners[1..]
            };
            for corner in on_circle {
                let off = length(less(*corner, base)) - 6.0;
                assert!(off.abs() < 2e-3, "{off}");
            }
            let doubled: f64 = outline
                .iter()
                .map(|line| {
                    let (a, b) = (less(line.from_px, base), less(line.to_px, base));
                    a[0] * b[1] - a[1] * b[0]
                })
                .sum();
            // A circle, or what of it is behind the tangents and the two triangles before them.
            let far = length(less(apex, base));
            let area = if is_round {
                round += 1;
                std::f64::consts::PI * 36.0
            } else {
                pointed += 1;
                assert!(length(less(corners[0], apex)) < 1e-3);
                let tangent = (far * far - 36.0).sqrt();
                6.0 * tangent + 36.0 * (std::f64::consts::PI - (6.0 / far).acos())
            };
            let part = doubled.abs() / 2.0 / area;
            assert!((0.95..1.0).contains(&part), "{part} of {area}");
        }
        assert!(
            rest.is_empty() && pointed > 40 && round > 1,
            "{pointed}, {round}"
        );
    });
}

#[test]
fn trails_are_steps_from_the_oldest_to_the_boid() {
    on_all(|on| {
        let lines = "trail_frames = 5\nsize = 2\ncolor = [0.5, 1, 0.25]";
        let region = "region = { min = [0, 0, 0], max = [1, 1, 0] }";
        let flock = boids(7, lines).replace(region, AROUND);
        let (lines, boids) = drawn(&[flock], 11, on);
        assert_eq!(lines.len(), 7 * (5 + 3), "{on}");
        for (lines, boid) in lines.chunks(8).zip(boids) {
            let (steps, sides) = lines.split_at(5);
            assert!(is_chain(steps));
            assert_eq!(steps[4].to_px, sides[0].from_px);
            let [vx, vy, _] = boid.velocity;
            for (at, step) in steps.iter().enumerate() {
                let off = length([
                    less(step.to_px, step.from_px)[0] - f64::from(vx),
                    less(step.to_px, step.from_px)[1] - f64::from(vy),
                ]);
                assert!(off < 1e-3, "{off}");
                let part = (at + 1) as f32 / 6.0;
                let off = (0..3).map(|at| (step.color[at] - part * sides[0].color[at]).abs());
                assert!(off.fold(0.0, f32::max) < 1e-6, "{:?}", step.color);
            }
            assert_eq!(sides[0].color, [0.5, 1.0, 0.25]);
        }
    });
    // Over the edge of the world, from 199 to 1 and back, nobody draws a line.
    let lines = "trail_frames = 9\nmax_speed = 30\nstart_speed = 30\n\
                 edges = { kind = \"torus\", min = [0, 0, 0], max = [200, 100, 0] }";
    let (lines, _) = drawn(&[boids(40, lines)], 12, "cpu");
    let longest = lines
        .iter()
        .map(|line| length(less(line.to_px, line.from_px)));
    assert!(longest.fold(0.0, f64::max) < 31.0);
    assert!(
        lines.len() < 40 * 12 && lines.len() > 40 * 8,
        "{}",
        lines.len()
    );
}

#[test]
fn line_drawings_have_the_mirror_images_and_nobody_unseen() {
    on_all(|on| {
        let seen = boids(5, "mirrored = true\ntrail_frames = 2");
        let unseen = boids(9, "opacity = 0\ntrail_frames = 3\nmirrored = true");
        let (lines, _) = drawn(&[seen, unseen], 6, on);
        assert_eq!(lines.len(), 5 * 2 * (2 + 3), "{on}");
        for both in lines.chunks(10) {
            let (own, images) = both.split_at(5);
            for (line, image) in own.iter().zip(images) {
                assert_eq!(image.from_px, [200.0 - line.from_px[0], line.from_px[1]]);
                assert_eq!(image.to_px, [200.0 - line.to_px[0], line.to_px[1]]);
                assert_eq!((image.color, image.slot), (line.color, 0));
            }
        }
    });
}
