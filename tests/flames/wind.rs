//! What bends flames: noise, the scene's wind, and the motion of what they stand on.

use motes::cpu::flame::small_wind;
use motes::layout::FireFrame;

use crate::common::hash;
use crate::support::*;

/// The fire's part of a frame.
fn fire_at(lines: &str, frame: u32) -> FireFrame {
    plan(&flame(lines)).inputs(frame).fires[0]
}

/// w_S at a place `height` above the root, for a flame 24 world units high.
fn wind_at(fire: &FireFrame, at: [f32; 3], height: f32) -> Place {
    let place = glam::Vec3::from(at);
    let root = place - glam::Vec3::new(0.0, height, 0.0);
    small_wind(fire, place, root, 1.0 / 24.0)
        .to_array()
        .map(f64::from)
}

fn anywhere(seed: u32) -> [f32; 3] {
    [0, 1, 2].map(|axis| (hash(3 * seed + axis) >> 16) as f32 / 1024.0)
}

#[test]
fn p36_a_vortex_bends_flames_around_its_axis_and_turbulence_perturbs_it() {
    let vortex = "[[wind]]\nkind = \"vortex\"\nposition = [0, 0, 0]\nspeed = 2\nradius = 1\n";
    let around = |noisiness: &str, frame| {
        let fire = lone(&format!(
            "noisiness = {noisiness}\nspeed = \"free\"\nstart_speed = 0\nbuoyancy = 0.3\n\
             [[fire.flame]]\nposition = [1, 0, 0]\nheight = 0.5"
        ));
        way(&scene_with(&[&fire], vortex), frame)
    };
    // What the first step adds is the wind at the root: up, and along the circle.
    let way = around("0", 0);
    let first = minus(way[2], way[1]);
    assert!(first[0].abs() < 1e-7, "{first:?}");
    assert!(
        (first[2].abs() / first[1] - 2.0 / 0.3).abs() < 1e-3,
        "{first:?}"
    );
    let tip = minus(way[24], way[0]);
    let frames = 300;
    let mut mean = [0.0; 3];
    for frame in 0..frames {
        let way = around("0.04", 3 * frame);
        let tip = minus(way[24], way[0]);
        mean = [0, 1, 2].map(|axis| mean[axis] + tip[axis] / f64::from(frames));
    }
    let off = length(minus(mean, tip)) / length(tip);
    assert!(off > 0.0 && off < 0.1, "{off}");
}

#[test]
fn p37_noise_bends_flames_in_proportion_to_the_height_above_the_root() {
    // Where k_p is 0, the noise is the same everywhere.
    let fire = fire_at("noisiness = 0.04\ninverse_cohesion = 0", 12);
    let base = wind_at(&fire, [1.0, 2.0, 3.0], 0.0);
    assert_eq!(base, [0.0; 3]);
    let low = wind_at(&fire, [1.0, 2.0, 3.0], 3.0);
    let high = wind_at(&fire, [4.0, 5.0, 6.0], 6.0);
    assert!(length(low) > 1e-3, "{low:?}");
    assert_near(high, low.map(|x| 2.0 * x), 1e-5 * length(high));
    // The factor is C, where the height is counted in steps.
    let noise = motes::noise::noise(
        glam::Vec3::new(fire.noise[0], fire.noise[1], fire.noise[2]),
        fire.kinds[2],
    );
    let wanted = noise
        .truncate()
        .to_array()
        .map(|n| 3.0 * 0.04 * f64::from(n));
    assert_near(low, wanted, 1e-6);
}

#[test]
fn p39_without_noise_flames_are_straight_in_every_frame() {
    let straight = flame("noisiness = 0\nheight = 2");
    let first = way(&straight, 0);
    for frame in [1, 17, 1000] {
        assert_eq!(way(&straight, frame), first);
    }
    assert!(first.iter().all(|place| place[0] == 0.0 && place[2] == 0.0));
    let text = "name = \"fire\"\n[[fire.flame]]\nposition = [0, 0, 0]";
    let bent = scene_with(&[text], "");
    assert_eq!(bent.fires[0].noisiness, 0.04, "the pleasing value");
    assert_ne!(way(&bent, 0), way(&bent, 1));
    // More of it bends more.
    let bend = |noisiness: f32| {
        let mut scene = bent.clone();
        scene.fires[0].noisiness = noisiness;
        let aside = |frame| {
            let tip = way(&scene, frame)[24];
            tip[0].hypot(tip[2])
        };
        (0..60).map(|at| aside(9 * at)).sum::<f64>() / 60.0
    };
    let (little, more) = (bend(0.01), bend(0.04));
    assert!(little > 0.0 && more > 2.0 * little, "{little} {more}");
}

#[test]
fn p40_disturbances_rise_with_the_flame() {
    let lines = "noisiness = 0.04\nsampling = 0.25";
    let (earlier, later) = (fire_at(lines, 4), fire_at(lines, 12));
    for seed in 0..50 {
        let [x, y, z] = anywhere(seed);
        // N(p, T + 8) = N(p - 8 k_s j, T), and places are whole parts of 1,024.
        let now = wind_at(&later, [x, y, z], 2.0);
        let below = wind_at(&earlier, [x, y - 2.0, z], 2.0);
        assert_eq!(now, below);
        assert_ne!(now, wind_at(&earlier, [x, y, z], 2.0));
    }
    let still = "noisiness = 0.04\nsampling = 0";
    let place = [0.5, 1.5, 2.5];
    let [a, b] = [0, 99].map(|frame| wind_at(&fire_at(still, frame), place, 2.0));
    assert_eq!(a, b);
}

/// How alike the noise is at places that are so far apart.
fn correlation(inverse_cohesion: f64, apart: f32) -> f64 {
    let lines = format!("noisiness = 0.04\ninverse_cohesion = {inverse_cohesion:?}");
    let fire = fire_at(&lines, 0);
    let (mut both, mut first, mut second) = (0.0, 0.0, 0.0);
    for seed in 0..4000 {
        let [x, y, z] = anywhere(seed);
        let here = wind_at(&fire, [x, y, z], 1.0);
        let there = wind_at(&fire, [x + apart, y, z], 1.0);
        both += dot(here, there);
        first += dot(here, here);
        second += dot(there, there);
    }
    both / (first * second).sqrt()
}

#[test]
fn p41_flames_move_together_as_far_as_cohesion_reaches() {
    for (inverse_cohesion, apart) in [(1.0, 0.1), (10.0, 0.01), (0.1, 1.0)] {
        let alike = correlation(inverse_cohesion, apart);
        assert!(alike > 0.95, "{alike}");
    }
    for (inverse_cohesion, apart) in [(1.0, 2.0), (10.0, 0.5), (1.0, 9.0)] {
        let alike = correlation(inverse_cohesion, apart);
        assert!(alike.abs() < 0.15, "{alike}");
    }
    assert!((correlation(0.0, 50.0) - 1.0).abs() < 1e-12);
    let lines = "noisiness = 0.04\ninverse_cohesion = 0";
    let [a, b] = [0, 20].map(|frame| wind_at(&fire_at(lines, frame), [0.0; 3], 1.0));
    assert!(
        length(minus(a, b)) > 1e-3,
        "it varies with time: {a:?} {b:?}"
    );
}

#[test]
fn p76_no_flame_looks_at_another() {
    let alone = "name = \"fire\"\n[[fire.flame]]\nposition = [0.1, 0.2, 0.3]\n";
    let many = format!("roots = {{ kind = \"disc\", radius = 0.5, count = 500 }}\n{alone}");
    let (one, all) = (
        ways(&scene_with(&[alone], ""), 9),
        ways(&scene_with(&[&many], ""), 9),
    );
    assert_eq!((one.len(), all.len()), (1, 501));
    assert_eq!(one[0], all[0]);
    // Near each other they bend alike all the same.
    let near = |a: &Vec<Place>, b: &Vec<Place>| length(minus(a[0], b[0])) < 0.03;
    let bend = |way: &Vec<Place>| minus(way[24], way[0]);
    let first = &all[1];
    for other in all[2..].iter().filter(|other| near(first, other)) {
        assert_near(bend(other), bend(first), 0.15 * length(bend(first)));
    }
}

#[test]
fn p76_what_moves_has_the_wind_of_its_motion() {
    let moving = lone(
        "wind_factor = 5\nposition = { keys = [[0, [0, 0, 0]], [10, [1, 0, 0]]] }\nheight = 1",
    );
    let standing = lone("wind_factor = 5\nheight = 1");
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [-0.1, 0, 0]\n";
    let moved = way(&scene_with(&[&moving], ""), 4);
    let blown = way(&scene_with(&[&standing], wind), 4);
    assert!(moved[24][0] < 0.4 - 0.1, "it trails: {:?}", moved[24]);
    for (a, b) in moved.iter().zip(&blown) {
        assert_near(minus(*a, [0.4, 0.0, 0.0]), *b, 1e-5);
    }
    // In the first frame and when it has stopped there is none.
    for frame in [0, 12] {
        let way = way(&scene_with(&[&moving], ""), frame);
        assert!((way[24][0] - way[0][0]).abs() < 1e-6, "{way:?}");
    }
}
