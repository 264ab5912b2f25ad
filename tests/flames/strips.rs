//! Strips along flames (Perry 1994, 4.2), and particles with a matrix (3.2.1): against places,
//! distances and colours that are worked out here in f64.

use motes::layout::FLAME_STEPS;
use motes::scene::Scene;

use crate::support::*;

/// A strip of one colour and opacity, whose texture does nothing.
const PLAIN: &str = "form = \"strip\"\nstrip_contrast = 0\nheight = 0.9\nwidth = 0.3\n";
const ONE_COLOR: &str =
    "[[fire.ramp]]\nage = 0\ncenter = [1, 0.5, 0.25]\nrim = [1, 0.5, 0.25]\nalpha = 0.2\n";

fn plain(more: &str) -> Scene {
    flame(&format!("{PLAIN}{more}{ONE_COLOR}"))
}

/// Pixels of the picture that a world place is at, of the camera of [`scene_with`].
fn seen([x, y, z]: Place) -> [f64; 2] {
    let focal = 60.0 / 22.5f64.to_radians().tan();
    let depth = 2.5 - z;
    [80.0 + focal * x / depth, 60.0 - focal * (y - 0.5) / depth]
}

/// Pixels a world unit at the flame's depth.
fn scale() -> f64 {
    60.0 / 22.5f64.to_radians().tan() / 2.5
}

/// Half of the strip's width at an age, in pixels.
fn half_width(age: f64) -> f64 {
    let scales = |age: f64| 0.67 + 0.4 * (std::f64::consts::PI * age / 24.0).sin();
    let (low, part) = (age.floor(), age.fract());
    // Linear between the 25 ages.
    let share = scales(low) * (1.0 - part) + scales(low + 1.0) * part;
    0.15 * share * scale()
}

#[test]
fn p80_a_straight_strip_is_as_bright_as_its_particles_and_clear_at_its_edges() {
    let light = drawn(&plain("noisiness = 0\n"), 3).light;
    let (mut inside, mut outside) = (0, 0);
    for (at, pixel) in light.iter().enumerate() {
        let [x, y] = [(at % 160) as f64 + 0.5, (at / 160) as f64 + 0.5];
        let age = (0.5 - (y - 60.0) / scale()) / 0.9 * 24.0;
        let across = (x - 80.0).abs() / half_width(age.clamp(0.0, 23.999));
        if !(0.0..=24.0).contains(&age) || across >= 1.0 {
            assert_eq!(*pixel, [0.0; 3], "light beside it, at {x} {y}");
            outside += 1;
            continue;
        }
        // As many particles overlap as half of one's height has steps.
        let part = age.fract();
        let high = |age: f64| 0.15 * (0.3 + 0.032 * age) / (0.9 / 24.0);
        let overlap = high(age.floor()) * (1.0 - part) + high(age.floor() + 1.0) * part;
        let ends = age.min(24.0 - age).min(1.0);
        let wanted = 0.2 * (1.0 - across) * overlap * ends;
        for (got, color) in pixel.iter().zip([1.0, 0.5, 0.25]) {
            let error = (got - wanted * color).abs();
            assert!(error < 2e-3 * overlap, "{got}, not {wanted} at {x} {y}");
        }
        inside += 1;
    }
    assert!(inside > 600 && outside > 10_000, "{inside} and {outside}");
}

#[test]
fn p80_a_bent_strip_has_neither_gaps_nor_doubles() {
    // One overlap and one width everywhere, so that its light says how far a place is from the middle.
    let shape = "base_width = 1\nswell = 0\nbase_height = 1\nheight_growth = 0\nnoisiness = 0.06\ninverse_cohesion = 2\n";
    let scene = plain(shape);
    let middle: Vec<[f64; 2]> = way(&scene, 40).into_iter().map(seen).collect();
    let light = drawn(&scene, 40).light;
    let bend = middle
        .windows(3)
        .map(|at| {
            let turn = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]).atan2(b[0] - a[0]);
            (turn(at[1], at[2]) - turn(at[0], at[1])).abs()
        })
        .sum::<f64>();
    assert!(bend > 0.5, "it is not bent: {bend}");
    let half_width = 0.15 * scale();
    let peak = 0.2 * 0.15 / (0.9 / 24.0);
    let mut seen = 0;
    for (at, pixel) in light.iter().enumerate() {
        let place = [(at % 160) as f64 + 0.5, (at / 160) as f64 + 0.5];
        // The nearest place of its middle line, both ends left out.
        let nearest = middle.windows(2).zip(0..).map(|(ends, age)| {
            let [a, b] = [ends[0], ends[1]];
            let way = [b[0] - a[0], b[1] - a[1]];
            let off = [place[0] - a[0], place[1] - a[1]];
            let part = (way[0] * off[0] + way[1] * off[1]) / (way[0] * way[0] + way[1] * way[1]);
            let part = part.clamp(0.0, 1.0);
            let away = [off[0] - part * way[0], off[1] - part * way[1]];
            (away[0].hypot(away[1]), f64::from(age) + part)
        });
        let (distance, age) = nearest.min_by(|a, b| a.0.total_cmp(&b.0)).expect("a way");
        if !(2.0..22.0).contains(&age) {
            continue;
        }
        let share = distance / half_width;
        if share < 0.7 {
            // Lines across it are not quite at right angles to it where it bends.
            let wanted = peak * (1.0 - share);
            assert!(
                (pixel[0] - wanted).abs() < 0.2 * peak,
                "{}, not {wanted} at {place:?}",
                pixel[0]
            );
            seen += 1;
        } else if share > 1.3 {
            assert_eq!(pixel[0], 0.0, "light beside it, at {place:?}");
        }
    }
    assert!(seen > 400, "{seen}");
}

#[test]
fn p80_the_texture_is_the_same_from_another_side() {
    let textured =
        "form = \"strip\"\nheight = 0.9\nwidth = 0.3\ncolor_noise = 0.3\nstrip_contrast = 1\n";
    let front = flame(textured);
    let mut side = front.clone();
    side.camera.position = [1.5, 0.5, 2.0];
    let (front, side) = (drawn(&front, 5).light, drawn(&side, 5).light);
    let mut differing = 0.0f64;
    let mut most = 0.0f64;
    for (front, side) in front.iter().zip(&side) {
        differing = differing.max((front[0] - side[0]).abs());
        most = most.max(front[0]);
    }
    assert!(most > 0.2, "{most}");
    assert!(differing < 0.01 * most, "{differing} of {most}");
    // It is no plain strip, and it moves.
    let uneven = |light: &[[f64; 3]]| {
        let mirrored = |at: usize| at / 160 * 160 + 159 - at % 160;
        let all = (0..light.len()).map(|at| (light[at][0] - light[mirrored(at)][0]).abs());
        all.fold(0.0, f64::max)
    };
    assert!(uneven(&front) > 0.1 * most);
    let later = drawn(&flame(textured), 25).light;
    let moved = later.iter().zip(&front).map(|(a, b)| (a[0] - b[0]).abs());
    assert!(moved.fold(0.0, f64::max) > 0.1 * most);
}

#[test]
fn p80_no_texture_leaves_an_edge_that_is_not_clear() {
    let mut scene = flame(
        "form = \"strip\"\nheight = 0.9\nwidth = 0.3\nnoisiness = 0.04\ncolor_noise = 0.5\nstrip_contrast = 0.3\nsampling = 0.7\n",
    );
    [scene.image.width, scene.image.height] = [640, 480];
    for frame in [0, 7, 31] {
        let light = drawn(&scene, frame).light;
        let brightest = light.iter().map(|pixel| pixel[0]).fold(0.0, f64::max);
        for at in 0..light.len() - 640 {
            // Next to where it is dark, there is little light.
            for neighbour in [at + 1, at + 640] {
                let [a, b] = [light[at][0], light[neighbour][0]];
                if a.min(b) == 0.0 {
                    assert!(a.max(b) < 0.2 * brightest, "{} at {at}", a.max(b));
                }
            }
        }
    }
}

#[test]
fn p14_colours_are_a_ramp_of_the_distance_and_turbulence() {
    // Perlin's corona: near it is yellow, farther red, and black in the end; turbulence moves that.
    let ramp = "[[fire.ramp]]\nage = 0\ncenter = [1, 1, 0]\nrim = [1, 1, 0]\nalpha = 0.2\n\
                [[fire.ramp]]\nage = 0.5\ncenter = [1, 0, 0]\nrim = [1, 0, 0]\nalpha = 0.2\n\
                [[fire.ramp]]\nage = 1\ncenter = [0, 0, 0]\nrim = [0, 0, 0]\nalpha = 0.2\n";
    let corona = |turbulence: &str| {
        let scene = flame(&format!("{PLAIN}noisiness = 0\n{turbulence}{ramp}"));
        drawn(&scene, 3).light
    };
    let still = corona("");
    let middle = |light: &[[f64; 3]], age: f64| {
        let y = 60.0 + (0.5 - age / 24.0 * 0.9) * scale();
        light[y as usize * 160 + 80]
    };
    let [near, between, far] = [3.0, 8.0, 14.0].map(|age| middle(&still, age));
    assert!(near[1] > 0.6 * near[0] && near[2] == 0.0, "{near:?}");
    assert!(
        between[1] < 0.5 * between[0] && between[1] > 0.0,
        "{between:?}"
    );
    assert!(far[1] == 0.0 && far[0] > 0.0, "{far:?}");
    // Folded noise is nowhere below zero, so the colours are those of farther places.
    let turbulent = corona("color_noise = 0.4\n");
    let (mut nearer, mut farther) = (0, 0);
    for (still, turbulent) in still.iter().zip(&turbulent) {
        if still[0] > 0.01 && still[1] > 0.0 {
            let redness = |pixel: &[f64; 3]| pixel[1] / pixel[0].max(1e-9);
            nearer += u32::from(redness(turbulent) > redness(still) + 1e-3);
            farther += u32::from(redness(turbulent) < redness(still) - 1e-3);
        }
    }
    assert!(nearer == 0 && farther > 150, "{nearer} and {farther}");
}

#[test]
fn p25_a_matrix_that_changes_nothing_makes_the_same_picture() {
    let plain = flame("noisiness = 0.1\ndetails = 1\n");
    let same = flame(
        "noisiness = 0.1\ndetails = 1\nparticle_matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n",
    );
    assert_eq!(drawn(&plain, 4).image, drawn(&same, 4).image);
    // Also where another fire's particles have one, and kernels look at all.
    let fires = |matrix: &str| {
        let other = lone(&format!("height = 0.3\n{matrix}")).replace("\"fire\"", "\"other\"");
        let dark = other.replacen("name", "brightness = 0\nname", 1);
        scene_with(&[&lone("noisiness = 0.1\n"), &dark], "")
    };
    let [plain, skewed] = [
        "",
        "particle_matrix = [1, 2, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n",
    ]
    .map(|it| drawn(&fires(it), 4));
    assert_eq!(plain.image, skewed.image);
}

#[test]
fn p25_the_outline_is_that_of_the_matrix() {
    // One particle in view, large and of one opacity: the last ages are clear.
    let ramp = "[[fire.ramp]]\nage = 0\ncenter = [1, 1, 1]\nrim = [1, 1, 1]\nalpha = 0.5\nrim_alpha = 0.5\n\
                [[fire.ramp]]\nage = 0.02\ncenter = [1, 1, 1]\nrim = [1, 1, 1]\nalpha = 0\n";
    let shape = "height = 0.9\nwidth = 0.5\nbase_width = 1\nbase_height = 1\nheight_growth = 0\nswell = 0\n";
    let flat = |[a, b, c, d]: [f64; 4]| {
        [
            [a, b, 0.0, 0.0],
            [c, d, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]
    };
    for rows in [
        flat([1.0, 0.0, 0.0, 1.0]),
        flat([0.5, 0.75, -0.25, 1.0]),
        flat([0.0, -1.0, 1.0, 0.0]),
        flat([2.0, 0.5, 0.0, 0.25]),
        // Moved, and twice as small.
        [
            [1.0, 0.0, 0.0, 0.8],
            [0.0, 1.0, 0.0, -0.5],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 2.0],
        ],
        // Turned towards the viewer, and nearer: the near half is seen larger.
        [
            [0.5, 0.0, 0.0, 0.2],
            [0.0, 1.0, 0.0, 0.3],
            [1.5, -2.0, 1.0, 2.0],
            [0.0, 0.0, 0.0, 1.0],
        ],
        // Divided by more and more to one side.
        [
            [1.0, 0.25, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.5],
            [0.0, 0.0, 1.0, 0.0],
            [0.3, -0.4, 0.0, 1.0],
        ],
    ] {
        let matrix = rows.concat();
        let scene = flame(&format!("{shape}particle_matrix = {matrix:?}\n{ramp}"));
        let light = drawn(&scene, 0).light;
        let [x0, y0] = seen([0.0; 3]);
        let half = 0.25 * scale();
        let corner = |at: u32| {
            let angle = std::f64::consts::TAU * f64::from(at) / 20.0;
            let place = [angle.cos(), angle.sin(), 0.0, 1.0];
            let row = |row: usize| (0..4).map(|at| rows[row][at] * place[at]).sum::<f64>();
            let [x, y, z] = [0, 1, 2].map(|axis| row(axis) / row(3));
            // As it is seen from the camera, 2.5 away at the height of 0.5.
            let nearer = 1.0 / (1.0 - 0.25 * z / 2.5);
            [x0 + x * half * nearer, y0 - y * half * nearer]
        };
        let (mut inside, mut wrong) = (0, 0);
        for (at, pixel) in light.iter().enumerate() {
            let place = [(at % 160) as f64 + 0.5, (at / 160) as f64 + 0.5];
            // On which side of each edge of the 20-gon, and how far.
            let sides = (0..20).map(|at| {
                let [p, q] = [corner(at), corner(at + 1)];
                let way = [q[0] - p[0], q[1] - p[1]];
                let side = way[0] * (place[1] - p[1]) - way[1] * (place[0] - p[0]);
                side / way[0].hypot(way[1])
            });
            let sides: Vec<f64> = sides.collect();
            let least = |sign: f64| {
                sides
                    .iter()
                    .map(|side| sign * side)
                    .fold(f64::MAX, f64::min)
            };
            let depth = least(1.0).max(least(-1.0));
            if depth.abs() < 0.02 {
                continue;
            }
            inside += u32::from(depth > 0.0);
            wrong += u32::from((depth > 0.0) != (pixel[0] > 0.0));
        }
        assert!(
            inside > 50 && wrong == 0,
            "{wrong} of {inside} of {matrix:?}"
        );
    }
}

#[test]
fn p25_noise_makes_matrices_that_depend_on_the_place() {
    let scene = |noise: &str| flame(&format!("height = 0.9\n{noise}"));
    let plain = drawn(&scene(""), 3).discs;
    let noisy = drawn(&scene("matrix_noise = 0.3\n"), 3).discs;
    let factors: Vec<f64> = plain
        .iter()
        .zip(&noisy)
        .map(|(plain, noisy)| {
            let [plain, noisy] =
                [plain, noisy].map(|disc| f64::from(f32::from_bits(disc.place[2])));
            noisy / plain
        })
        .collect();
    assert_eq!(factors.len(), FLAME_STEPS as usize);
    let (least, most) = (
        factors.iter().copied().fold(f64::MAX, f64::min),
        factors.iter().copied().fold(0.0, f64::max),
    );
    assert!(most / least > 1.1 && most < 10.0, "{least} to {most}");
    // Neighbours are in nearly the same noise.
    assert!(
        factors
            .windows(2)
            .all(|two| (two[1] / two[0] - 1.0).abs() < 0.5)
    );
}

#[test]
fn p43_a_strip_that_doubles_back_is_clear_at_its_edges_from_above() {
    let lines = "form = \"strip\"\nstrip_contrast = 0\nwidth = 0.2\nbuoyancy = 0.15\n\
                 [[fire.flame]]\nposition = [-0.3, 0.3, 0]\nnormal = [1, 0.02, 0]";
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [-0.13, 0, 0]\n";
    let mut scene = scene_with(&[&lone(lines)], wind);
    scene.camera.position = [0.0, 3.0, 0.0];
    scene.camera.target = [0.0, 0.5, 0.0];
    scene.camera.up = [0.0, 0.0, -1.0];
    let way = way(&scene, 0);
    let focal = 60.0 / 22.5f64.to_radians().tan();
    let seen: Vec<[f64; 2]> = way
        .iter()
        .map(|[x, y, z]| [80.0 + focal * x / (3.0 - y), 60.0 + focal * z / (3.0 - y)])
        .collect();
    let farthest = seen.iter().map(|at| at[0]).fold(f64::MIN, f64::max);
    assert!(farthest - seen[24][0] > 10.0, "it does not come back");
    // The nearest of its places to the eye, and the widest part of it.
    let nearest = way
        .iter()
        .map(|place| 3.0 - place[1])
        .fold(f64::MAX, f64::min);
    let most = 1.07 * 0.1 * focal / nearest;
    let mut lit = 0;
    for (at, pixel) in drawn(&scene, 0).light.iter().enumerate() {
        if pixel[0] == 0.0 {
            continue;
        }
        lit += 1;
        let place = [(at % 160) as f64 + 0.5, (at / 160) as f64 + 0.5];
        let off = seen.windows(2).map(|ends| {
            let [a, b] = [ends[0], ends[1]];
            let way = [b[0] - a[0], b[1] - a[1]];
            let off = [place[0] - a[0], place[1] - a[1]];
            let part = (way[0] * off[0] + way[1] * off[1]) / (way[0] * way[0] + way[1] * way[1]);
            let part = part.clamp(0.0, 1.0);
            (off[0] - part * way[0]).hypot(off[1] - part * way[1])
        });
        let distance = off.fold(f64::MAX, f64::min);
        assert!(
            distance < 1.05 * most,
            "light {distance} px beside it, at {place:?}"
        );
    }
    assert!(lit > 200, "{lit}");
}

#[test]
fn no_noise_carries_a_flame_beyond_all_numbers() {
    let lines = "speed = \"free\"\nstart_speed = 0\nbuoyancy = 0.004\nnoisiness = 1000\ninverse_cohesion = 0\nheight = 1000";
    let scene = flame(lines);
    for frame in [0, 3, 40] {
        let way = way(&scene, frame);
        assert!(way.iter().flatten().all(|x| x.is_finite()), "{way:?}");
        assert!(way.iter().flatten().any(|x| x.abs() > 1e6), "{way:?}");
    }
}
