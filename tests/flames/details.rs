//! Smaller particles beside the way of a flame (Perry 1994, 4.1), and colours of what is hot.

use motes::cpu::draw::flame_discs::flame_discs;
use motes::layout::{Flame, FlameDisc};
use motes::plan::{DetailPass, FrameInputs};
use motes::scene::Scene;

use crate::shipped::shipped;
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

/// The scene as it is seen from so many times as near.
fn nearer(scene: &Scene, times: f64) -> Scene {
    let mut scene = scene.clone();
    let half = (22.5f64.to_radians().tan() / times).atan();
    scene.camera.vertical_fov_degrees = (2.0 * half).to_degrees() as f32;
    scene
}

#[test]
fn p82_particles_of_each_octave_are_half_as_large_and_off_the_way() {
    let half_width = |disc: &FlameDisc| 1.0 / f64::from(f32::from_bits(disc.place[2]));
    let middle = |disc: &FlameDisc| f64::from(f32::from_bits(disc.place[0]));
    let near = |more: &str| nearer(&upright(more), 4.0);
    let plain = drawn(&near(""), 3).discs;
    for (details, factor) in [(1, 2.0), (2, 4.0)] {
        // What is there in the end is the last pass of the finest octave.
        let more = format!("details = {details}\ndetail_spread = 0.6\n");
        let discs = drawn(&near(&more), 3).discs;
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
fn p82_nothing_changes_where_details_are_too_small_to_be_told_apart() {
    // Half a width is 8.7 pixels at 1; half an octave's begins to be seen at 0.75.
    let image = |more: &str, times: f64| drawn(&nearer(&upright(more), times), 5).image;
    for times in [0.05, 0.1, 0.17] {
        assert_eq!(image(DETAILS, times), image("", times), "at {times}");
    }
    assert_ne!(image(DETAILS, 0.18), image("", 0.18));
    // Nor does an octave that has not come in beside one that has.
    let coarse = "details = 1\ndetail_alpha = 1\ndetail_spread = 0.6\n";
    assert_eq!(image(DETAILS, 0.33), image(coarse, 0.33));
    assert_ne!(image(DETAILS, 0.37), image(coarse, 0.37));
}

#[test]
fn p82_details_come_in_little_by_little_and_no_light_is_won_or_lost() {
    // The opacity of a particle of the finest octave, beside what it has from very near, and the light of the
    // whole picture, ever nearer.
    let light = |more: &str, times: f64| {
        let drawn = drawn(&nearer(&upright(more), times), 5);
        let opacity = f64::from(f32::from_bits(drawn.discs[12].center[3]));
        (
            opacity,
            drawn.light.iter().map(|pixel| pixel[0]).sum::<f64>(),
        )
    };
    for details in 1..=3 {
        let more = format!("details = {details}\ndetail_alpha = 1\ndetail_spread = 0.2\n");
        let seen_from = f64::from(1 << details) * 0.75 / 8.69;
        let (whole, _) = light(&more, 4.0 * seen_from);
        let (far, _) = light(&more, 0.9 * seen_from);
        assert!(far == 0.0 && whole > 0.0, "{far} {whole}");
        let mut before = 0.0;
        for step in 0..=16 {
            let times = seen_from * (0.9 + 1.3 * f64::from(step) / 16.0);
            let (opacity, all) = light(&more, times);
            let (_, plain) = light("", times);
            let share = opacity / whole;
            assert!(share >= before, "{share} after {before}, at {times}");
            assert!(share - before < 0.12, "{share} after {before}, at {times}");
            assert!(
                (all / plain - 1.0).abs() < 0.04,
                "{all}, not {plain}, at {times}"
            );
            before = share;
        }
        // From there on it is the picture's pixels alone that make it fainter.
        let (nearer_still, _) = light(&more, 5.0 * seen_from);
        assert!(
            (nearer_still / whole - 1.0).abs() < 1e-6,
            "{nearer_still}, not {whole}"
        );
        assert!(before > 0.7, "{before}");
    }
}

/// Places in the picture, and half-widths there, of the particles of an octave of a flame, from its root on:
/// those of the octave's passes in turn.
fn octave_places(inputs: &FrameInputs, flame: &Flame, way: &[Place], octave: u32) -> Vec<[f64; 3]> {
    let steps: Vec<[u32; 4]> = way
        .iter()
        .map(|p| [0, 1, 2, 3].map(|i| p.get(i).map_or(0, |x| (*x as f32).to_bits())))
        .collect();
    let mut discs = vec![[FlameDisc::default(); 25]; 1 << octave];
    for (copy, discs) in (0..).zip(&mut discs) {
        let pass = DetailPass { octave, copy };
        flame_discs(inputs, flame, pass, &steps, discs, &mut []);
    }
    let at_age = |age: usize| discs.iter().map(move |discs| discs[age].place);
    (0..24)
        .flat_map(at_age)
        .map(|place| {
            let [x, y, across, _] = place.map(f32::from_bits);
            [f64::from(x), f64::from(y), 1.0 / f64::from(across)]
        })
        .collect()
}

#[test]
fn p48_no_shipped_flame_has_details_that_are_strings_of_beads() {
    // From each place of an octave to the next it is at most half of a particle's width, as along the flame's own
    // way.
    let mut looked_at = 0;
    for scene in shipped() {
        for frame in [0, 20, 90, 150, 239] {
            let inputs = plan(&scene).inputs(frame);
            if inputs.fires.iter().all(|fire| fire.details[0] < 1.0) {
                continue;
            }
            for (flame, way) in flames(&scene, frame).iter().zip(ways(&scene, frame)) {
                let octaves = inputs.fires[flame.fire() as usize].details[0] as u32;
                for octave in (1..=octaves).filter(|_| flame.burns()) {
                    let places = octave_places(&inputs, flame, &way, octave);
                    for (nth, two) in places.windows(2).enumerate() {
                        let [[x, y, half], [to_x, to_y, _]] = [two[0], two[1]];
                        let apart = (to_x - x).hypot(to_y - y);
                        assert!(
                            apart <= half,
                            "{}: {apart} of {half} at {nth} of octave {octave}, frame {frame}",
                            scene.name
                        );
                        looked_at += 1;
                    }
                }
            }
        }
    }
    assert!(looked_at >= 5 * (47 + 95), "{looked_at}");
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
    // Of the finest octave nothing is drawn that is less than three pixels wide, however small it is: only squares of
    // pixels are as bright then.
    for (details, square) in [(1, 1), (2, 1), (3, 2)] {
        let far = upright(&format!(
            "details = {details}\ndetail_alpha = 1\ndetail_spread = 0.6\n"
        ));
        let near = nearer(&far, 4.0);
        let (far, near) = (drawn(&far, 5).light, drawn(&near, 5).light);
        let most = far.iter().map(|pixel| pixel[0]).fold(0.0, f64::max);
        let mean = |light: &[[f64; 3]], [x, y]: [usize; 2], size: usize| {
            let pixels = (0..size * size).map(|at| light[(y + at / size) * 160 + x + at % size][0]);
            pixels.sum::<f64>() / (size * size) as f64
        };
        let mut seen = 0;
        // The near picture is the middle quarter of the far one.
        for y in (0..30).step_by(square) {
            for x in (0..40).step_by(square) {
                let got = mean(&near, [4 * x, 4 * y], 4 * square);
                let wanted = mean(&far, [60 + x, 45 + y], square);
                assert!(
                    (got - wanted).abs() < 0.05 * most,
                    "{got}, not {wanted} at {x} {y} of {details}"
                );
                seen += u32::from(wanted > 0.3 * most);
            }
        }
        assert!(seen as usize * square * square > 100, "{seen}");
    }
}

#[test]
fn p82_what_is_seen_from_near_has_details_that_are_not_seen_from_afar() {
    // How much neighbouring pixels differ beside what a plane through their neighbours has, as a share of the
    // light.
    let grain = |more: &str, times: f64| {
        let light = drawn(&nearer(&upright(more), times), 5).light;
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
    let more = |times: f64| grain(DETAILS, times) / grain("", times);
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
