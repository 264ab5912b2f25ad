//! Smaller particles beside the way of a flame (Perry 1994, 4.1), and colours of what is hot.

use motes::layout::FlameDisc;
use motes::scene::Scene;

use crate::support::*;

const DETAILS: &str = "details = 3\ndetail_alpha = 1\ndetail_spread = 0.6\n";

fn upright(more: &str) -> Scene {
    flame(&format!("height = 0.9\nwidth = 0.3\n{more}"))
}

#[test]
fn p82_details_that_are_clear_change_nothing() {
    let plain = drawn(&upright(""), 3).image;
    let clear = "details = 4\ndetail_alpha = 0\n";
    assert_eq!(drawn(&upright(clear), 3).image, plain);
    assert_ne!(drawn(&upright(DETAILS), 3).image, plain);
}

#[test]
fn p82_particles_of_each_octave_are_half_as_large_and_off_the_way() {
    let half_width = |disc: &FlameDisc| 1.0 / f64::from(f32::from_bits(disc.place[2]));
    let middle = |disc: &FlameDisc| f64::from(f32::from_bits(disc.place[0]));
    let plain = drawn(&upright(""), 3).discs;
    for (details, factor) in [(1, 2.0), (2, 4.0)] {
        // What is there in the end is the last pass of the finest octave.
        let more = format!("details = {details}\ndetail_spread = 0.6\n");
        let discs = drawn(&upright(&more), 3).discs;
        let mut off = 0;
        for age in 1..24 {
            let wanted = half_width(&plain[age]) / factor;
            // Nearer to the viewer or farther, by what it strays.
            let got = half_width(&discs[age]);
            assert!((got / wanted - 1.0).abs() < 0.25, "{got}, not {wanted}");
            off += u32::from((middle(&discs[age]) - middle(&plain[age])).abs() > 1.0);
        }
        assert!(off > 8, "{off} of 23");
        // Between the last place and the one before there are such, after it none.
        assert_eq!(discs[24].center[3], 0);
    }
}

#[test]
fn p82_a_straight_flame_with_details_is_no_mirror_image() {
    let image = drawn(&upright(DETAILS), 0).image;
    let differs = |line: &[u32], x: usize| (line[x] & 255).abs_diff(line[159 - x] & 255) > 8;
    let lines = image.chunks(160);
    let count: usize = lines
        .map(|line| (0..80).filter(|x| differs(line, *x)).count())
        .sum();
    assert!(count > 100, "{count}");
}

#[test]
fn p82_from_four_times_as_near_it_is_as_bright() {
    let far = upright(DETAILS);
    let mut near = far.clone();
    let half = (22.5f64.to_radians().tan() / 4.0).atan();
    near.camera.vertical_fov_degrees = (2.0 * half).to_degrees() as f32;
    let (far, near) = (drawn(&far, 5).light, drawn(&near, 5).light);
    let most = far.iter().map(|pixel| pixel[0]).fold(0.0, f64::max);
    let mut seen = 0;
    // The near picture is the middle quarter of the far one.
    for y in 0..30 {
        for x in 0..40 {
            let block = (0..16).map(|at| near[(4 * y + at / 4) * 160 + 4 * x + at % 4][0]);
            let mean = block.sum::<f64>() / 16.0;
            let wanted = far[(45 + y) * 160 + 60 + x][0];
            assert!(
                (mean - wanted).abs() < 0.1 * most,
                "{mean}, not {wanted} at {x} {y}"
            );
            seen += u32::from(wanted > 0.3 * most);
        }
    }
    assert!(seen > 100, "{seen}");
}

#[test]
fn p82_what_is_seen_from_near_has_details_that_are_not_seen_from_afar() {
    // How much neighbouring pixels differ beside what a plane through their neighbours has, as a share of the
    // light.
    let grain = |more: &str, nearer: f64| {
        let mut scene = upright(more);
        let half = (22.5f64.to_radians().tan() / nearer).atan();
        scene.camera.vertical_fov_degrees = (2.0 * half).to_degrees() as f32;
        let light = drawn(&scene, 5).light;
        let at = |x: usize, y: usize| light[y * 160 + x][0];
        let (mut sum, mut whole) = (0.0, 0.0);
        for y in 1..119 {
            for x in 1..159 {
                let around = at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1);
                sum += (4.0 * at(x, y) - around).abs();
                whole += at(x, y);
            }
        }
        sum / whole
    };
    let more = |nearer: f64| grain(DETAILS, nearer) / grain("", nearer);
    assert!(more(4.0) > 1.5, "{}", more(4.0));
}

#[test]
fn p79_a_flame_can_have_the_colours_of_what_is_hot() {
    let hot = drawn(&upright("blackbody = [2400, 1200]\n"), 0).discs;
    let of = |colors: [u32; 4]| colors.map(|bits| f64::from(f32::from_bits(bits)));
    let plain = drawn(&upright(""), 0).discs;
    for (age, (disc, plain)) in hot.iter().zip(&plain).enumerate() {
        let [center, rim] = [of(disc.center), of(disc.rim)];
        for [red, green, blue, _] in [center, rim] {
            assert!(
                (red - 1.0).abs() < 1e-6 && red > green && green > blue,
                "at age {age}"
            );
        }
        assert!(center[1] > rim[1], "the rim is cooler");
        assert_eq!(
            [disc.center[3], disc.rim[3]],
            [plain.center[3], plain.rim[3]]
        );
    }
    let green = |age: usize| of(hot[age].center)[1];
    assert!(
        (1..25).all(|age| green(age) < green(age - 1)),
        "it cools down"
    );
}

#[test]
fn p23_scales_can_be_told_by_age() {
    let stop = |age: f64, width: f64, height: f64| {
        format!("[[fire.profile]]\nage = {age}\nwidth = {width}\nheight = {height}\n")
    };
    // A neck between two bulbs, which no sine makes.
    let profile = [
        stop(0.25, 1.5, 0.5),
        stop(0.5, 0.25, 1.25),
        stop(0.75, 1.0, 0.75),
    ];
    let scene = flame(&format!("height = 0.9\nwidth = 0.3\n{}", profile.concat()));
    let wanted = |age: usize| {
        let x = [0.25, 0.5, 0.75];
        let share = (age as f64 / 24.0).clamp(0.25, 0.75);
        let at = if share < 0.5 { 0 } else { 1 };
        let part = (share - x[at]) / 0.25;
        let mix = |table: [f64; 3]| table[at] * (1.0 - part) + table[at + 1] * part;
        [mix([1.5, 0.25, 1.0]), mix([0.5, 1.25, 0.75])]
    };
    let looks = plan(&scene).inputs(0).age_looks;
    let discs = drawn(&scene, 0).discs;
    let extents = |age: usize| {
        let [_, _, across, along] = discs[age].place.map(f32::from_bits);
        [1.0 / f64::from(across), 1.0 / f64::from(along)]
    };
    let unit = extents(0)[0] / 1.5;
    assert_eq!(looks.len(), 25);
    for (age, look) in looks.iter().enumerate() {
        let got = [look.scale[0], look.scale[1]].map(f64::from);
        for axis in 0..2 {
            let wanted = wanted(age)[axis];
            assert!((got[axis] - wanted).abs() < 1e-6, "{got:?} at {age}");
            // It comes to the picture: all are as far from the viewer.
            let drawn = extents(age)[axis] / unit;
            assert!(
                (drawn - wanted).abs() < 2e-3,
                "{drawn}, not {wanted} at {age}"
            );
        }
    }
}

#[test]
fn p23_scales_and_colours_are_tables_by_age() {
    let stop = |age: f64, center: &str, alpha: f64| {
        format!(
            "[[fire.ramp]]\nage = {age}\ncenter = {center}\nrim = [0.5, 0.25, 0]\nalpha = {alpha}\n"
        )
    };
    let ramp = [stop(0.25, "[0, 1, 0]", 0.2), stop(0.75, "[1, 0, 2]", 0.6)].concat();
    let text =
        format!("base_width = 1\nswell = 0.5\nbase_height = 0.2\nheight_growth = 0.1\n{ramp}");
    let scene = flame(&text);
    let looks = plan(&scene).inputs(0).age_looks;
    for (age, look) in looks.iter().enumerate() {
        // Squashed at first, stretched in the end.
        let share = age as f64 / 24.0;
        let width = 1.0 + 0.5 * (std::f64::consts::PI * share).sin();
        let height = 0.2 + 0.1 * age as f64;
        let part = ((share - 0.25) / 0.5).clamp(0.0, 1.0);
        let wanted = [
            part,
            1.0 - part,
            2.0 * part,
            0.2 + 0.4 * part,
            width,
            height,
        ];
        let [red, green, blue, alpha] = look.center;
        let got = [red, green, blue, alpha, look.scale[0], look.scale[1]];
        for (got, wanted) in got.into_iter().zip(wanted) {
            assert!(
                (f64::from(got) - wanted).abs() < 1e-6,
                "{got}, not {wanted} at {age}"
            );
        }
    }
}
