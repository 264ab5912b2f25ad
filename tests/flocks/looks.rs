//! What boids look like.

use motes::backend::Backend;
use motes::plan::{Plan, STAGES};
use motes::scene::Scene;

use crate::common;
use crate::support::*;

/// World units are pixels, x to the right and y down from the picture's corner.
pub(crate) fn pixels(flocks: &[String], background: &str) -> Scene {
    let text: String = flocks
        .iter()
        .map(|lines| format!("[[flock]]\n{lines}\n"))
        .collect();
    common::scene_of(&format!(
        "image = {{ width = 200, height = 100, background = {background} }}
         camera = {{ position = [100, 50, -400], target = [100, 50, 0], up = [0, -1, 0], \
         projection = \"orthographic\", view_height = 100 }}
         {text}"
    ))
}

/// Red, green and blue of every pixel, as bytes, of boids in these states; nobody moves.
pub(crate) fn picture(plan: &Plan, states: &[State]) -> Vec<[u8; 3]> {
    let mut cpu = common::on_cpu(plan);
    place(&mut cpu, plan, states);
    for info in STAGES.iter().filter(|info| info.draws) {
        cpu.run_stage(info.stage, &plan.inputs(1))
            .expect("it draws");
    }
    let words = cpu.read("image").expect("it can be read");
    words
        .into_iter()
        .map(|word| [word as u8, (word >> 8) as u8, (word >> 16) as u8])
        .collect()
}

pub(crate) fn boids(count: u32, lines: &str) -> String {
    format!(
        "name = \"b{count}\"\ncount = {count}\nregion = {{ min = [0, 0, 0], max = [1, 1, 0] }}\n{lines}"
    )
}

/// Sum and centre of the red of a picture, in whole pixels and in pixels from its corner.
fn mass(picture: &[[u8; 3]]) -> (f64, [f64; 2]) {
    let (mut sum, mut centre) = (0.0, [0.0; 2]);
    for (at, [red, ..]) in picture.iter().enumerate() {
        let red = f64::from(*red) / 255.0;
        sum += red;
        centre[0] += red * ((at % 200) as f64 + 0.5);
        centre[1] += red * ((at / 200) as f64 + 0.5);
    }
    (sum, centre.map(|moment| moment / sum))
}

#[test]
fn f5_a_particle_is_a_disc_of_its_size() {
    let plan = plan(&pixels(
        &[boids(1, "shape = \"disc\"\nsize = 5")],
        "[0, 0, 0]",
    ));
    for place in [[60.0, 40.0, 0.0], [60.25, 40.5, 0.0], [33.3, 70.7, 0.0]] {
        let (sum, [x, y]) = mass(&picture(&plan, &[(place, [1.0, 0.0, 0.0])]));
        assert!((sum / 19.635 - 1.0).abs() < 0.02, "{sum}");
        assert!((x - f64::from(place[0])).abs() < 0.05 && (y - f64::from(place[1])).abs() < 0.05);
    }
}

#[test]
fn f15_triangles_point_where_boids_fly_and_turn_about_a_corner() {
    let plan = plan(&pixels(&[boids(1, "size = 30")], "[0, 0, 0]"));
    for step in 0..16 {
        let angle = f64::from(step) * std::f64::consts::TAU / 16.0 + 0.1;
        let (sin, cos) = angle.sin_cos();
        let velocity = [1.5 * cos as f32, 1.5 * sin as f32, 0.0];
        let (sum, centre) = mass(&picture(&plan, &[([100.0, 50.0, 0.0], velocity)]));
        assert!((sum / (0.5 * 30.0 * 36.0) - 1.0).abs() < 0.01, "{sum}");
        // The article's corners (0,0), (s,0), (s/2, 1.2 s), turned by the heading less 90 degrees.
        let turned = |x: f64, y: f64| [x * sin + y * cos, -x * cos + y * sin];
        let third = |axis: usize| (turned(30.0, 0.0)[axis] + turned(15.0, 36.0)[axis]) / 3.0;
        let off = (centre[0] - 100.0 - third(0)).hypot(centre[1] - 50.0 - third(1));
        // A degree moves it by 0.33 px.
        assert!(off < 0.1, "{off} px off at {angle}");
    }
}

#[test]
fn f26_predators_are_red_and_as_much_larger() {
    let flocks = [
        boids(1, "size = 3"),
        boids(2, "size = 10\ncolor = [1, 0, 0]").replace("count = 2", "count = 1"),
    ];
    let plan = plan(&pixels(&flocks, "[0, 0, 0]"));
    let up = [0.0, -1.0, 0.0];
    let picture = picture(&plan, &[([50.0, 50.0, 0.0], up), ([150.0, 50.0, 0.0], up)]);
    let area = |red: bool| {
        let of = |at: usize| (at % 200 >= 100) == red;
        let sum: f64 = (0..picture.len())
            .filter(|at| of(*at))
            .map(|at| f64::from(picture[at][0]))
            .sum();
        sum / 255.0
    };
    assert!((area(true) / area(false) - 100.0 / 9.0).abs() < 0.2);
    assert!(picture.contains(&[255, 0, 0]));
}

#[test]
fn f40_of_those_who_overlap_the_later_is_in_front() {
    let flocks = [
        boids(2, "shape = \"disc\"\nsize = 20\ncolor = [0, 1, 0]"),
        boids(1, "shape = \"disc\"\nsize = 10\ncolor = [0, 0, 1]"),
    ];
    let plan = plan(&pixels(&flocks, "[0, 0, 0]"));
    let still = |x: f32| ([x, 50.0, 0.0], [0.0; 3]);
    let picture = picture(&plan, &[still(50.0), still(150.0), still(50.0)]);
    let at = |x: usize, y: usize| picture[y * 200 + x];
    assert_eq!(at(50, 50), [0, 0, 255]);
    assert_eq!(at(57, 50), [0, 255, 0]);
    assert_eq!(at(150, 50), [0, 255, 0]);
    assert_eq!(at(100, 50), [0, 0, 0]);
}

/// A built-in scene, small, after some frames, on the processor.
fn built_in(name: &str, frame: u32) -> (Vec<u8>, u32) {
    let sets = ["image.width=320".to_owned(), "image.height=180".to_owned()];
    let scene = motes::scene::load_with(name, &sets).expect("it is built in");
    let options = motes::Options {
        adapter: motes::AdapterChoice::Cpu,
        ..motes::Options::default()
    };
    let mut simulation = motes::Simulation::new(&scene, &options).expect("it begins");
    simulation.seek(frame).expect("it steps");
    simulation.draw().expect("it draws");
    (
        simulation.image().expect("it can be read"),
        simulation.plan().boid_count,
    )
}

/// The greatest difference of a picture and its mirror image, in bytes.
fn asymmetry(image: &[u8]) -> u8 {
    let row = 320 * 4;
    let mut worst = 0;
    for line in image.chunks(row) {
        for (at, byte) in line.iter().enumerate() {
            let mirrored = line[row - 4 - at / 4 * 4 + at % 4];
            worst = worst.max(byte.abs_diff(mirrored));
        }
    }
    worst
}

#[test]
fn f36_ink_blots_are_their_own_mirror_images() {
    let (image, boids) = built_in("rorschach", 40);
    assert_eq!(boids, 1004);
    assert_eq!(asymmetry(&image), 0);
    assert!(image.iter().any(|byte| *byte < 128) && image.contains(&255));
}

/// Two points a boid, as thick as the sketch's strokes and as faint.
#[test]
fn f36_a_boid_is_two_faint_points() {
    let mut scene = shipped("rorschach");
    scene.flocks[0].count = 1;
    // A pixel is a third of a unit, so that the middle is between two.
    (scene.image.width, scene.image.height) = (400, 390);
    let plan = plan(&scene);
    assert_eq!(plan.boid_cover_count, 2, "attractors are not seen");
    let still = |x: f32, y: f32| ([x, y, 0.0], [0.0; 3]);
    let states: Vec<_> = [still(20.0, -10.0)]
        .into_iter()
        .chain([still(0.0, 30.0); 4])
        .collect();
    let picture = picture(&plan, &states);
    let ink = 1.0 - (55.0 / 255.0 * 30.0 + 255.0 - 30.0) / 255.0;
    for side in [-1.0, 1.0] {
        let (mut sum, mut moment) = (0.0, [0.0; 2]);
        for (at, [red, ..]) in picture.iter().enumerate() {
            let x = ((at % 400) as f64 + 0.5 - 200.0) / 3.0;
            let y = ((at / 400) as f64 + 0.5 - 195.0) / 3.0;
            if x * side > 0.0 {
                let here = (1.0 - f64::from(*red) / 255.0) / ink / 9.0;
                sum += here;
                moment = [moment[0] + here * x, moment[1] + here * y];
            }
        }
        let area = std::f64::consts::PI * 9.0;
        // Bytes of so faint a point are whole steps of 24.
        assert!((sum / area - 1.0).abs() < 0.04, "{sum}, not {area}");
        let [x, y] = moment.map(|moment| moment / sum);
        assert!(
            (x - 20.0 * side).abs() < 0.05 && (y + 10.0).abs() < 0.05,
            "{x}, {y}"
        );
    }
}

#[test]
fn f38_inverted_ink_blots_are_what_is_left_to_white() {
    for frame in [0, 40, 400] {
        let (image, _) = built_in("rorschach", frame);
        let (inverted, _) = built_in("rorschach-inverted", frame);
        let colors = |bytes: &[u8]| -> Vec<u8> {
            let (pixels, _) = bytes.as_chunks::<4>();
            pixels
                .iter()
                .flat_map(|[r, g, b, _]| [*r, *g, *b])
                .collect()
        };
        let both = colors(&image).into_iter().zip(colors(&inverted));
        let off = both.filter(|(a, b)| 255 - a != *b).count();
        assert_eq!(off, 0, "frame {frame}");
    }
    // Nobody sees the attractors, and all else is as it was.
    let (mut sketch, inverted) = (shipped("rorschach"), shipped("rorschach-inverted"));
    assert!(inverted.flocks[1].opacity == 0.0);
    sketch.flocks[0].color = inverted.flocks[0].color;
    assert_eq!(sketch.flocks, inverted.flocks);
}

/// The article's first reason for particles: the more there are, the denser is what they make.
#[test]
fn f1_more_particles_are_denser() {
    let ink = |count: u32| {
        let mut scene = shipped("boids-free");
        scene.flocks[0].count = count;
        (scene.image.width, scene.image.height) = (500, 300);
        let plan = plan(&scene);
        let mut cpu = common::on_cpu(&plan);
        for info in STAGES {
            cpu.run_stage(info.stage, &plan.inputs(0)).expect("it runs");
        }
        let words = cpu.read("image").expect("it can be read");
        let light = |word: &u32| f64::from(word & 0xff) - 55.0;
        let sum: f64 = words.iter().map(light).sum();
        sum / 200.0
    };
    // Each is a white triangle of 5.4 px; few of 200 overlap.
    let few = ink(200);
    assert!((few / (200.0 * 5.4) - 1.0).abs() < 0.05, "{few}");
    let counts = [100, 200, 400, 800, 1600];
    let all = counts.map(ink);
    assert!(all.is_sorted_by(|a, b| 1.8 * a < *b), "{all:?}");
}

#[test]
fn f39_three_inks_are_symmetric_too() {
    let (image, boids) = built_in("rorschach-three", 25);
    assert!(boids > 1000);
    let (pixels, _) = image.as_chunks::<4>();
    let pixels: Vec<[u32; 4]> = pixels.iter().map(|pixel| pixel.map(u32::from)).collect();
    let has = |is: fn(&[u32; 4]) -> bool| pixels.iter().any(is);
    assert!(has(|p| p[0] > 2 * p[1].max(p[2]) && p[0] > 20));
    assert!(has(|p| p[2] > 2 * p[0] && p[2] > 20));
    assert_eq!(asymmetry(&image), 0);
}
