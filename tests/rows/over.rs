//! Particles that cover what is behind them and reflect light (Reeves 1983, sections 2.5 and 5).

use crate::support::{Run, on_every_backend, scene};

/// A ball or pane, opaque unless it says otherwise.
const OVER: &str = "blend = \"over\"\n size = 6\n end_frame = 1\n";

/// The picture of these systems' only frame, in bytes, and its linear light.
fn picture(on: &str, image: &str, systems: &[&str]) -> (Vec<u8>, Vec<f32>) {
    let named: Vec<String> = systems
        .iter()
        .enumerate()
        .map(|(at, lines)| format!("name = \"s{at}\"\n {lines}"))
        .collect();
    let named: Vec<&str> = named.iter().map(String::as_str).collect();
    let mut run = Run::new(on, &scene(image, &named), 1);
    run.step_to(0);
    let image = run.image();
    let linear = run.simulation.radiance().expect("the light can be read");
    (image, linear)
}

/// Red, green, blue of the pixel at column `x`, row `y` of 64.
fn at(image: &[u8], x: usize, y: usize) -> [u8; 3] {
    let first = (y * 64 + x) * 4;
    [image[first], image[first + 1], image[first + 2]]
}

fn byte(v: f64) -> u8 {
    (v.clamp(0.0, 1.0) * 255.0 + 0.5).floor() as u8
}

#[test]
fn r84_the_nearer_covers_the_farther_whatever_the_order_of_systems() {
    let near = format!("{OVER} position = [0, 0, 4]\n color = [1, 0, 0]");
    let far = format!("{OVER} position = [6, 0, -4]\n color = [0, 1, 0]");
    on_every_backend(|on| {
        let (first, _) = picture(on, "", &[&near, &far]);
        let (second, _) = picture(on, "", &[&far, &near]);
        assert_eq!(first, second, "{on}");
        assert_eq!(at(&first, 33, 31), [255, 0, 0]);
        // Where only the far one is.
        assert_eq!(at(&first, 40, 31), [0, 255, 0]);
        assert_eq!(at(&first, 2, 2), [0, 0, 0]);
    });
}

#[test]
fn r84_what_is_half_clear_shows_half_of_what_is_behind() {
    let near = format!("{OVER} position = [0, 0, 4]\n color = [1, 0, 0]\n transparency = 0.5");
    let middle = format!("{OVER} position = [0, 0, 0]\n color = [0, 1, 0]\n transparency = 0.25");
    let image = "image.background = [0, 0.2, 0.8]";
    on_every_backend(|on| {
        let (got, linear) = picture(on, image, &[&middle, &near]);
        let shown = 0.5 * 0.25;
        let expected = [0.5, 0.5 * 0.75 + 0.2 * shown, 0.8 * shown];
        assert_eq!(at(&got, 31, 31), expected.map(byte), "{on}");
        assert_eq!(at(&got, 1, 1), [0, 51, 204]);
        // The same in linear light.
        for (channel, expected) in expected.into_iter().enumerate() {
            let light = f64::from(linear[(31 * 64 + 31) * 3 + channel]);
            let wanted = f64::from(motes::simulation::linear_of(expected as f32));
            assert!((light - wanted).abs() < 1e-5, "{light} instead of {wanted}");
        }
    });
}

#[test]
fn r84_light_is_added_to_what_covers_and_exposure_is_of_both() {
    let ball = format!("{OVER} color = [0.2, 0.1, 0]\n position = [0, 0, 8]");
    let glow = "size = 6\n end_frame = 1\n color = [0.1, 0, 0.2]\n position = [0, 0, -8]";
    let image = "image.background = [0, 0, 0.9]\n image.exposure = 2";
    on_every_backend(|on| {
        let (got, _) = picture(on, image, &[&ball, glow]);
        // Behind the ball, and its light is seen: nothing hides light.
        let expected = [2.0 * 0.3, 2.0 * 0.1, 2.0 * 0.2];
        let off = at(&got, 31, 31)
            .into_iter()
            .zip(expected.map(byte))
            .map(|(got, expected)| got.abs_diff(expected))
            .max();
        assert!(off <= Some(1), "{on}: {:?}", at(&got, 31, 31));
    });
}

#[test]
fn r84_balls_reflect_the_light_as_lambert_has_it() {
    // A ball of 20 pixels, seen along -z by a flat camera: a pixel is a world unit.
    let image = "camera.projection = \"orthographic\"\n camera.view_height = 64
        light.direction = [3, 4, 12]\n light.color = [1, 0.5, 0.25]\n light.ambient = [0.1, 0.1, 0.2]";
    let ball = "blend = \"over\"\n shading = \"lit_sphere\"\n size = 20\n end_frame = 1
        color = [0.8, 0.6, 0.4]";
    let from = [3.0 / 13.0, 4.0 / 13.0, 12.0 / 13.0];
    on_every_backend(|on| {
        let (got, _) = picture(on, image, &[ball]);
        for y in 0..64 {
            for x in 0..64 {
                let (right, up) = (x as f64 + 0.5 - 32.0, 31.5 - y as f64);
                let aside = (right * right + up * up) / 400.0;
                if aside.sqrt() > 19.0 / 20.0 {
                    continue;
                }
                let normal = [right / 20.0, up / 20.0, (1.0 - aside).sqrt()];
                let straight: f64 = normal.iter().zip(from).map(|(n, l)| n * l).sum();
                let straight = straight.max(0.0);
                for (channel, (color, (light, ambient))) in [0.8, 0.6, 0.4]
                    .into_iter()
                    .zip([1.0, 0.5, 0.25].into_iter().zip([0.1, 0.1, 0.2]))
                    .enumerate()
                {
                    let expected = color * (ambient + light * straight) * 255.0;
                    let off = (f64::from(at(&got, x, y)[channel]) - expected).abs();
                    assert!(off <= 1.0, "{on}, pixel {x}, {y}, channel {channel}: {off}");
                }
            }
        }
    });
}

#[test]
fn r38_a_covering_disc_that_moves_by_eighths_of_a_pixel_keeps_its_light() {
    on_every_backend(|on| {
        let steps = if on == "cpu" { 16 } else { 2 };
        let totals: Vec<f64> = (0..steps)
            .map(|step| {
                let lines = format!(
                    "blend = \"over\"\n end_frame = 1\n position = [{}, 0.37, 0]\n size = 2.6
                    color = [0.5, 0.5, 0.5]",
                    f64::from(step) * 0.125
                );
                let (got, _) = picture(on, "", &[&lines]);
                got.iter().step_by(4).map(|byte| f64::from(*byte)).sum()
            })
            .collect();
        let mean = totals.iter().sum::<f64>() / totals.len() as f64;
        for total in &totals {
            assert!((total / mean - 1.0).abs() < 0.01, "{on}: {totals:?}");
        }
    });
}

#[test]
fn r84_what_is_behind_the_camera_covers_nothing() {
    on_every_backend(|on| {
        for z in [31.95, 32.0, 40.0, 1e6] {
            let lines = format!("{OVER} position = [0, 0, {z}]");
            let (got, _) = picture(on, "", &[&lines]);
            assert!(
                got.chunks(4).all(|pixel| pixel[..3] == [0; 3]),
                "{on}, at {z}"
            );
        }
        // Larger than the picture, it covers all of it.
        let (got, _) = picture(
            on,
            "",
            &["blend = \"over\"\n size = 4000\n end_frame = 1\n color = [1, 1, 1]"],
        );
        assert!(got.chunks(4).all(|pixel| pixel == [255; 4]), "{on}");
    });
}

#[test]
fn r84_whether_particles_cover_holds_for_a_whole_run() {
    use motes::plan::{Plan, Turn};
    let with = |blend: &str| scene("", &[&format!("blend = \"{blend}\"")]);
    let turn = |blend: &str| Turn {
        frame: 3,
        scene: with(blend),
    };
    assert!(Plan::with_turns(&with("over"), &[turn("over")], 9).is_ok());
    let refused = Plan::with_turns(&with("add"), &[turn("over")], 9).expect_err("it is refused");
    assert!(refused.help.contains("`blend`"), "{refused}");
}

#[test]
fn r63_layers_that_cover_are_composed_to_the_whole() {
    use motes::output::Rgba8Image;
    let image = "layer = [{ name = \"behind\", point = [0, 0, 0], normal = [0, 0, 1] }]";
    let dark = |name: &str, z: f64, shade: f64| {
        format!(
            "name = \"{name}\"\n blend = \"over\"\n end_frame = 1\n position = [{z}, 1, {z}]
            size = 7\n transparency = 0.4\n edge_softness = 0.5\n color = [{shade}, {shade}, 0.05]"
        )
    };
    let systems = [dark("far", -3.0, 0.9), dark("near", 3.0, 0.02)];
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene(image, &[&systems[0], &systems[1]]), 1);
        run.step_to(0);
        let whole = run.image();
        let simulation = &mut run.simulation;
        let mut composed = Rgba8Image {
            width: 64,
            height: 64,
            pixels: [0, 0, 0, 255].repeat(64 * 64),
        };
        assert_eq!(simulation.layer_names(), ["behind", "rest"]);
        for index in 0..2 {
            simulation.draw_layer(index).expect("it draws");
            let hidden = simulation.hidden().expect("it is read");
            let layer = Rgba8Image {
                pixels: simulation.image().expect("it is read"),
                ..composed.clone()
            };
            composed = composed.under(&layer.into_layer_hiding(&hidden));
        }
        let off = whole.iter().zip(&composed.pixels);
        let worst = off.map(|(a, b)| a.abs_diff(*b)).max();
        assert!(worst <= Some(2), "{on}: {worst:?}");
        // The near one darkens the far one.
        let brightest = |image: &[u8]| image.iter().step_by(4).copied().max();
        assert!(whole[(31 * 64 + 32) * 4] < brightest(&whole).unwrap_or(0) / 2);
    });
}

/// Layers composed over black, those farther first, and their names.
fn composed_of(run: &mut Run) -> (Vec<u8>, Vec<String>) {
    use motes::output::Rgba8Image;
    let simulation = &mut run.simulation;
    let names = simulation.layer_names();
    let mut composed = Rgba8Image {
        width: 64,
        height: 64,
        pixels: [0, 0, 0, 255].repeat(64 * 64),
    };
    for index in 0..names.len() {
        simulation.draw_layer(index).expect("it draws");
        let hidden = simulation.hidden().expect("it is read");
        let layer = Rgba8Image {
            pixels: simulation.image().expect("it is read"),
            ..composed.clone()
        };
        composed = composed.under(&layer.into_layer_hiding(&hidden));
    }
    (composed.pixels, names)
}

#[test]
fn r63_surfaces_are_a_layer_that_what_covers_goes_over() {
    let light =
        "light = { direction = [0, 0, 1], color = [0.5, 0.5, 0.5], ambient = [0.1, 0.1, 0.1] }";
    let cube = "surface = [{ mesh = \"cube\", scale = 9, color = [0.2, 0.9, 0.4] }]";
    let ball = "planet = { radius = 12, color = [0.2, 0.4, 0.9] }";
    let floor = "ground = { radius = 60, color = [0.9, 0.8, 0.3] }\ncamera.position = [0, 14, 32]";
    let pane = |name: &str, x: f64, z: f64| {
        format!(
            "name = \"{name}\"\n blend = \"over\"\n end_frame = 1\n position = [{x}, 1, {z}]
            size = 7\n transparency = 0.4\n color = [0.9, 0.1, 0.2]"
        )
    };
    // One behind the surface, in part beside its outline, and one before it.
    let panes = [pane("far", 12.0, -14.0), pane("near", -4.0, 16.0)];
    for surfaces in [cube, ball, floor] {
        on_every_backend(|on| {
            let picture = format!("{light}\n{surfaces}");
            let mut run = Run::new(on, &scene(&picture, &[&panes[0], &panes[1]]), 1);
            run.step_to(0);
            let whole = run.image();
            let (composed, names) = composed_of(&mut run);
            assert_eq!(names, ["surfaces", "particles"]);
            run.simulation.draw_layer(0).expect("it draws");
            let hidden = run.simulation.hidden().expect("it is read");
            // Within a pixel of an outline, one alpha does not tell which part of it is behind what.
            let is_whole = |at: usize| hidden[at / 4] <= 0.0 || hidden[at / 4] >= 1.0;
            let off = whole.iter().zip(&composed).map(|(a, b)| a.abs_diff(*b));
            let (inside, outlines): (Vec<_>, Vec<_>) =
                off.enumerate().partition(|(at, _)| is_whole(*at));
            let worst = inside.iter().map(|(_, by)| *by).max();
            let of_outlines = outlines.iter().filter(|(_, by)| *by > 3).count();
            println!("{on}, {surfaces}: {worst:?}, and {of_outlines} of outlines by more");
            assert!(worst <= Some(3), "{on}, {surfaces}: {worst:?}");
            assert!(of_outlines < 40, "{on}, {surfaces}: {of_outlines}");
            // The layer of surfaces has these alone, and none of the particles' red.
            run.simulation.draw_layer(0).expect("it draws");
            let alone = run.simulation.image().expect("it is read");
            let hidden = run.simulation.hidden().expect("it is read");
            let lit = alone
                .chunks(4)
                .zip(&hidden)
                .filter(|(pixel, _)| pixel[0] > 8);
            assert!(lit.clone().count() > 200);
            for (pixel, hidden) in lit {
                assert!(*hidden > 0.0 && u32::from(pixel[0]) < 2 * u32::from(pixel[1]));
            }
        });
    }
}

#[test]
fn r63_light_of_particles_and_surfaces_are_layers_that_sum_to_the_whole() {
    let picture = "planet = { radius = 12, color = [0.3, 0.3, 0.3] }
        light = { direction = [0, 0, 1], color = [0.5, 0.5, 0.5], ambient = [0.1, 0.1, 0.1] }
        layer = [{ name = \"left\", point = [0, 0, 0], normal = [1, 0, 0] }]";
    let swarm =
        "name = \"swarm\"\n initial_mean_parts = 300\n end_frame = 1\n color = [0.04, 0.02, 0.01]
        generation_shape = { kind = \"sphere\", radius = 20 }\n size = 3";
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene(picture, &[swarm]), 1);
        run.step_to(0);
        let whole = run.image();
        let simulation = &mut run.simulation;
        assert_eq!(simulation.layer_names(), ["surfaces", "left", "rest"]);
        let mut layers = Vec::new();
        for index in 0..3 {
            simulation.draw_layer(index).expect("it draws");
            layers.push(simulation.image().expect("it is read"));
        }
        let mut lit = [0; 3];
        for (at, byte) in whole.iter().enumerate().filter(|(at, _)| at % 4 != 3) {
            let bytes = [0, 1, 2].map(|layer| layers[layer][at]);
            let sum: u32 = bytes.iter().map(|byte| u32::from(*byte)).sum();
            // Each is rounded by itself.
            assert!(
                sum.min(255).abs_diff(u32::from(*byte)) <= 2,
                "{on}: {bytes:?} and {byte}"
            );
            for (count, byte) in lit.iter_mut().zip(bytes) {
                *count += u32::from(byte > 0);
            }
        }
        assert!(lit.iter().all(|count| *count > 300), "{on}: {lit:?}");
    });
}
