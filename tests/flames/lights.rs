//! The light of flames on surfaces (Perry 1994, 3.2.4).

use motes::backend::Backend;
use motes::layout::FlameLight;
use motes::plan::Plan;
use motes::scene::Scene;

use crate::common;
use crate::support::*;

/// A point light as people read it: place and colour.
#[derive(Clone, Copy, Debug)]
struct Light {
    place: Place,
    color: [f64; 3],
    extent: f64,
}

/// What a frame comes to: the point lights, red, green, blue and what shows of what is behind in
/// each pixel of the ground and of pillars before it, and the sum of all light of flames.
struct Lit {
    lights: Vec<Light>,
    ground: Vec<[f64; 4]>,
    light: [f64; 3],
}

fn lit(scene: &Scene, frame: u32) -> Lit {
    let plan = plan(scene);
    let inputs = plan.inputs(frame);
    let mut cpu = common::on_cpu(&plan);
    cpu.step(&inputs).expect("it runs");
    cpu.draw(&inputs).expect("it runs");
    let mut read = |name: &str| cpu.read(name).expect("it is read");
    let float = |bits: u32| f64::from(f32::from_bits(bits));
    let lights: Vec<FlameLight> = bytemuck::pod_collect_to_vec(&read("flame_lights"));
    let lights = lights.iter().map(|light| {
        let [x, y, z, extent] = light.place.map(float);
        let [red, green, blue, _] = light.color.map(float);
        Light {
            place: [x, y, z],
            color: [red, green, blue],
            extent: extent.sqrt(),
        }
    });
    let ground = read("ground_pixels");
    let surfaces = read("surface_pixels");
    let mut before = surfaces.chunks(4);
    let ground = ground.chunks(4).map(|pixel| {
        let [red, green, blue, clear] = [0, 1, 2, 3].map(|i| float(pixel[i]));
        let surface = before.next().map(|of| [0, 1, 2, 3].map(|i| float(of[i])));
        let [of_red, of_green, of_blue, open] = surface.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        [
            of_red + red * open,
            of_green + green * open,
            of_blue + blue * open,
            clear * open,
        ]
    });
    Lit {
        lights: lights.collect(),
        ground: ground.collect(),
        light: drawn(scene, frame)
            .light
            .iter()
            .fold([0.0; 3], |sum, pixel| [0, 1, 2].map(|i| sum[i] + pixel[i])),
    }
}

/// A ground without light but that of flames.
const GROUND: &str = "[light]\ncolor = [0, 0, 0]\nambient = [0, 0, 0]\n\
                      [ground]\nposition = [0, -0.4, 0]\nradius = 1000\ncolor = [0.5, 0.4, 0.3]\n";

/// Where the middle of a pixel of the test scene's picture meets the plane y = `height`: how far
/// that is along the line, in lengths that are 1 deep, and where.
fn seen_at(pixel: usize, height: f64) -> (f64, Place) {
    let focal = 60.0 / 22.5f64.to_radians().tan();
    let across = ((pixel % 160) as f64 + 0.5 - 80.0) / focal;
    let up = (60.0 - (pixel / 160) as f64 - 0.5) / focal;
    let far = (height - 0.5) / up;
    (far, [across * far, height, 2.5 - far])
}

#[test]
fn p45_point_lights_stand_at_the_weighted_means_of_the_flames_nearest_to_them() {
    let text = "name = \"fire\"\nnoisiness = 0.3\nlights = 2\nwidth = 0.2\n\
        [[fire.flame]]\nposition = [-1, 0, 0]\nbrightness = 0.5\n\
        [[fire.flame]]\nposition = [-1.2, 0.1, 0]\nwidth = 0.1\n\
        [[fire.flame]]\nposition = [0.8, 0, 0.1]\nwidth = 0.3\n\
        [[fire.flame]]\nposition = [1, 0, 0]\nbrightness = 2";
    let scene = scene_with(&[text], GROUND);
    let ways = ways(&scene, 7);
    let mean = |at: usize| {
        let sum = |sum: Place, place: &Place| [0, 1, 2].map(|i| sum[i] + place[i]);
        ways[at].iter().fold([0.0; 3], sum).map(|x| x / 25.0)
    };
    // Brightness times squared width.
    let wanted = [[(0, 0.5 * 0.04), (1, 0.01)], [(2, 0.09), (3, 2.0 * 0.04)]].map(|flames| {
        let weight: f64 = flames.iter().map(|(_, weight)| weight).sum();
        let of = |axis: usize| {
            let terms = flames.iter().map(|(at, own)| mean(*at)[axis] * own);
            terms.sum::<f64>() / weight
        };
        (weight, [of(0), of(1), of(2)])
    });
    let lights = lit(&scene, 7).lights;
    for ((_, place), light) in wanted.iter().zip(&lights) {
        assert_near(light.place, *place, 1e-5);
    }
    let ratio = lights[1].color[0] / lights[0].color[0];
    assert!(
        (ratio / (wanted[1].0 / wanted[0].0) - 1.0).abs() < 1e-5,
        "{ratio}"
    );
    assert!(lights[2..].iter().all(|light| light.color == [0.0; 3]));
}

#[test]
fn p45_other_functions_of_the_way_can_be_chosen() {
    for (from, wanted) in [("middle", 12), ("tip", 24)] {
        let text = lone(&format!("noisiness = 0.3\nlight_from = \"{from}\""));
        let scene = scene_with(&[&text], GROUND);
        assert_near(lit(&scene, 5).lights[0].place, way(&scene, 5)[wanted], 1e-5);
    }
}

#[test]
fn p45_what_a_flame_throws_is_what_it_sends_to_the_picture() {
    for more in ["", "inner_alpha = 1.5\ninner_radius = 0.4\n"] {
        let stop = "[[fire.ramp]]\nage = 0\ncenter = [1, 0.6, 0.3]\nrim = [0.9, 0.2, 0.1]\n\
                    alpha = 0.4\nrim_alpha = 0.1\n";
        let text = format!("height = 0.5\nwidth = 0.4\n{more}{stop}");
        let scene = scene_with(&[&lone(&text)], GROUND);
        let Lit { lights, light, .. } = lit(&scene, 0);
        // A pixel is so many world units wide at the flame, 2.5 away; the same in all directions, so
        // 1 / pi of it is what a surface makes of it.
        let pixel = 2.5 * 22.5f64.to_radians().tan() / 60.0;
        for (channel, sum) in light.iter().enumerate() {
            let wanted = sum * pixel * pixel / std::f64::consts::PI;
            let got = lights[0].color[channel];
            assert!(
                (got / wanted - 1.0).abs() < 0.01,
                "{got} instead of {wanted}"
            );
        }
        let brighter = scene_with(&[&lone(&format!("light = 3\n{text}"))], GROUND);
        let got = lit(&brighter, 0).lights[0].color[0] / lights[0].color[0];
        assert!((got - 3.0).abs() < 1e-5, "{got}");
    }
}

#[test]
fn p45_light_falls_with_the_squared_distance_and_the_slant() {
    let scene = scene_with(&[&lone("light = 9")], GROUND);
    let Lit { lights, ground, .. } = lit(&scene, 0);
    let light = lights[0];
    let mut looked_at = 0;
    for pixel in (160 * 62..160 * 120).step_by(17) {
        let (_, place) = seen_at(pixel, -0.4);
        let away = minus(light.place, place);
        let squared = dot(away, away) + light.extent * light.extent;
        let [red, green, blue, clear] = ground[pixel];
        let faded = (1.0 - dot(place, place) / 1e6).powi(2);
        assert!((clear - (1.0 - faded)).abs() < 1e-4 + 1e-3 * clear);
        for (got, (color, albedo)) in [red, green, blue]
            .iter()
            .zip(light.color.iter().zip([0.5, 0.4, 0.3]))
        {
            let wanted = faded * albedo * color * away[1] / squared.powf(1.5);
            assert!(
                (got / wanted - 1.0).abs() < 1e-3,
                "{got}, not {wanted} at {place:?}"
            );
        }
        looked_at += 1;
    }
    assert!(looked_at > 500);
    let above = ground[160 * 30 + 80];
    assert_eq!(
        above,
        [0.0, 0.0, 0.0, 1.0],
        "there is no ground above the horizon"
    );
}

#[test]
fn p45_surfaces_flicker_where_flames_waver() {
    let brightest = |noisiness: f64, frame: u32| {
        let scene = scene_with(
            &[&lone(&format!("noisiness = {noisiness}\nlight = 9"))],
            GROUND,
        );
        let reds = lit(&scene, frame).ground;
        reds.iter().map(|pixel| pixel[0]).collect::<Vec<f64>>()
    };
    assert_eq!(brightest(0.0, 0), brightest(0.0, 40));
    let (early, late) = (brightest(0.3, 0), brightest(0.3, 40));
    let most = early.iter().copied().fold(0.0, f64::max);
    let changes = early.iter().zip(&late).map(|(a, b)| (a - b).abs());
    assert!(changes.fold(0.0, f64::max) > 0.1 * most);
}

/// Pixels of a ground at y = -0.4 and a pillar on it, under a lamp.
fn pillar(more: &str) -> Vec<[f64; 4]> {
    let dark = lone("light = 0");
    let rest = format!(
        "{GROUND}[[pillar]]\nposition = [0, -0.4, 0]\nradius = 0.25\nheight = 0.6\n\
         color = [1, 1, 1]\n{more}\n"
    );
    lit(&scene_with(&[&dark], &rest), 0).ground
}

#[test]
fn p45_pillars_are_seen_lit_and_in_the_way_of_light() {
    let lamp = "[[lamp]]\nposition = [2, 0.6, 0]\ncolor = [3, 3, 3]";
    let lit = pillar(lamp);
    let at = |x: usize, y: usize| lit[160 * y + x];
    // To the left of the pillar is its shade; as far to the right there is light.
    let [shade, open] = [22, 137].map(|x| at(x, 112)[0]);
    assert_eq!(shade, 0.0);
    assert!(open > 0.2);
    // Its side towards the lamp is lit, the other is not; both hide the ground.
    let focal = 60.0 / 22.5f64.to_radians().tan();
    let edge = 0.25 / (2.5f64 * 2.5 - 0.0625).sqrt() * focal;
    for (side, is_lit) in [(0.9, true), (-0.5, false), (-0.9, false)] {
        let x = (80.0 + side * edge) as usize;
        assert_eq!(at(x, 90)[0] > 0.0, is_lit, "{side}");
    }
    // Places of its side: their light by the angle.
    for x in [84, 88, 92] {
        let across = (x as f64 + 0.5 - 80.0) / focal;
        // The nearer root of |(across t, 2.5 - t)| = 0.25.
        let (a, b, c) = (across * across + 1.0, -5.0, 6.25 - 0.0625);
        let far = (-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
        let place = [across * far, 0.5 - (90.5 - 60.0) / focal * far, 2.5 - far];
        let away = minus([2.0, 0.6, 0.0], place);
        let normal = [place[0] / 0.25, 0.0, place[2] / 0.25];
        let wanted = 3.0 * dot(away, normal) / length(away).powi(3);
        let got = at(x, 90)[0];
        assert!(
            (got / wanted.max(1e-9) - 1.0).abs() < 2e-3,
            "{got}, not {wanted}"
        );
    }
    // Its top is at y = 0.2, seen from above.
    let row = (60.0 + 0.3 / 2.5 * focal) as usize;
    let (_, place) = seen_at(160 * row + 80, 0.2);
    let away = minus([2.0, 0.6, 0.0], place);
    let wanted = 3.0 * away[1] / length(away).powi(3);
    assert!((at(80, row)[0] / wanted - 1.0).abs() < 2e-3);
    // Half as many pixels as the outline is wide, at both ends of a line.
    let covered: f64 = (0..160)
        .map(|x| at(x, 90)[3])
        .map(|clear| 1.0 - clear)
        .sum::<f64>();
    assert!(covered > 159.9, "the ground is behind it: {covered}");
}

#[test]
fn p45_pillars_hide_the_flames_behind_them() {
    let pillar = "[[pillar]]\nposition = [0, -0.4, 0]\nradius = 0.25\nheight = 0.9\n";
    let focal = 60.0 / 22.5f64.to_radians().tan();
    let edge = 0.25 / (2.5f64 * 2.5 - 0.0625).sqrt() * focal;
    for form in ["particles", "strip"] {
        // Wider and higher than the pillar, as the eye sees it.
        let light = |z: f64, rest: &str| {
            let fire = lone(&format!(
                "form = \"{form}\"\nlight = 0\nwidth = 1.2\nheight = 1.5\n\
                 [[fire.flame]]\nposition = [0, -0.1, {z}]\n"
            ));
            drawn(&scene_with(&[&fire], rest), 3).light
        };
        let (alone, behind) = (light(-0.8, ""), light(-0.8, pillar));
        let (mut hidden, mut open, mut above) = (0, 0, 0);
        // Its top is as high as the eye: what is above the middle is not behind it.
        for (at, (alone, behind)) in alone.iter().zip(&behind).enumerate() {
            let across = ((at % 160) as f64 + 0.5 - 80.0).abs();
            let row = at / 160;
            let lights = [length(*alone), length(*behind)];
            if row > 61 && row < 90 && across < edge - 1.0 {
                assert_eq!(lights[1], 0.0, "{form}: {row}, {across}");
                hidden += u32::from(lights[0] > 0.0);
            } else if row < 59 || across > edge + 1.0 {
                assert_eq!(alone, behind, "{form}: {row}, {across}");
                open += u32::from(lights[0] > 0.0 && row >= 59);
                above += u32::from(lights[0] > 0.0 && row < 59);
            }
        }
        assert!(
            hidden > 300 && open > 100 && above > 300,
            "{form}: {hidden}, {open}, {above}"
        );
        assert_eq!(light(0.8, ""), light(0.8, pillar), "{form} before it");
    }
}

#[test]
fn p45_pillars_hide_pillars_behind_them() {
    let pillar = |z: f64, color: &str| {
        format!(
            "[[pillar]]\nposition = [0, -0.4, {z}]\nradius = 0.25\nheight = 0.9\ncolor = {color}\n"
        )
    };
    let dark = lone("light = 0");
    let (red, green) = ("[1, 0, 0]", "[0, 1, 0]");
    for (first, second) in [(0.5, -0.5), (-0.5, 0.5)] {
        let rest = format!(
            "[light]\nambient = [1, 1, 1]\ncolor = [0, 0, 0]\n{}{}",
            pillar(first, red),
            pillar(second, green)
        );
        let [of_red, of_green, ..] = lit(&scene_with(&[&dark], &rest), 0).ground[160 * 80 + 80];
        let is_red = first > second;
        assert_eq!([of_red > 0.99, of_green > 0.99], [is_red, !is_red]);
        assert_eq!([of_red == 0.0, of_green == 0.0], [!is_red, is_red]);
    }
}

#[test]
fn p45_an_outline_takes_as_much_of_a_line_as_it_is_wide() {
    let scene = scene_with(
        &[&lone("light = 0")],
        "[light]\nambient = [1, 1, 1]\ncolor = [0, 0, 0]\n\
         [[pillar]]\nposition = [0.01, -0.4, 0]\nradius = 0.25\nheight = 2\ncolor = [1, 1, 1]\n",
    );
    let ground = lit(&scene, 0).ground;
    let line = &ground[160 * 60..160 * 61];
    let covered: f64 = line.iter().map(|pixel| 1.0 - pixel[3]).sum();
    let half: f64 = 0.25 / (2.5f64 * 2.5 - 0.0625).sqrt();
    let focal = 60.0 / 22.5f64.to_radians().tan();
    assert!((covered - 2.0 * half * focal).abs() < 0.1, "{covered}");
    // White in white light, as far as it covers.
    assert!(
        line.iter()
            .all(|[red, .., clear]| (red + clear - 1.0).abs() < 1e-6)
    );
}

#[test]
fn p45_wax_lets_the_light_of_its_flame_through() {
    let glow = |lines: &str| {
        let rest = format!(
            "{GROUND}[[pillar]]\nposition = [0, -0.6, 0]\nradius = 0.2\nheight = 0.55\n{lines}"
        );
        let ground = lit(
            &scene_with(&[&lone("light = 9\nlight_from = \"middle\"")], &rest),
            0,
        )
        .ground;
        // Up and down the middle of its side.
        [97usize, 104, 112].map(|row| ground[160 * row + 80][0])
    };
    let dull = glow("");
    let wax = glow("translucence = 0.8\ndepth = 0.3\n");
    assert!(wax.iter().zip(dull).all(|(wax, dull)| *wax > dull));
    assert!(wax[0] > wax[1] && wax[1] > wax[2], "{wax:?}");
}

#[test]
fn grounds_need_a_place_to_be_seen_from() {
    let text = "name = \"fire\"\n[[fire.flame]]\nposition = [0, 0, 0]";
    let mut scene = scene_with(&[text], GROUND);
    scene.camera.projection = motes::scene::Projection::Orthographic;
    let refused = Plan::new(&scene, 1).expect_err("it cannot be seen");
    assert!(refused.message.contains("orthographic"), "{refused}");
}

#[test]
fn p45_a_light_of_what_burns_is_as_large_as_its_part_of_it() {
    // Half of a cube's edge is 0.5: its area is 6, which so many lights share. They are no smaller
    // than those of other fires: a fifth of a flame's height.
    for (lights, height, wanted) in [
        (10, 1.0, (6.0 / (10.0 * std::f64::consts::PI)).sqrt()),
        (40, 1.0, (6.0 / (40.0 * std::f64::consts::PI)).sqrt()),
        (10, 0.3, (6.0 / (10.0 * std::f64::consts::PI)).sqrt()),
        (64, 2.0, 0.4),
    ] {
        let scene = common::scene_of(&format!(
            "camera = {{ position = [0, 1, 5], target = [0, 0, 0] }}\n[ground]\nradius = 5\n[[fire]]\nname = \"fire\"\nheight = {height}\nlights = {lights}\n\
             [fire.spread]\nmesh = \"cube\"\nscale = 0.5\n[[fire.spread.ignition]]\nposition = [0, 0, 0.5]"
        ));
        let plan = motes::plan::Plan::new(&scene, 1).expect("it can be planned");
        let extent = f64::from(plan.inputs(0).fires[0].light[3]).sqrt();
        assert!(
            (extent - wanted).abs() < 1e-4,
            "{lights}, {height}: {extent} instead of {wanted}"
        );
    }
}
