//! Fires: roots, defaults, and what is at odds.

use motes::scene::{Burning, FireLights, FlameForm, LightFrom, Profile, Roots};

use crate::text::{accepted, refused, with};

const SCENE: &str = "[camera]\nposition = [0, 1, 5]\ntarget = [0, 0, 0]\n";

fn fire(lines: &str) -> String {
    format!("{SCENE}[[fire]]\nname = \"a\"\n{lines}\n")
}

const FLAME: &str = "[[fire.flame]]\nposition = [1, 2, 3]\n";

#[test]
fn a_fire_alone_is_a_scene_with_the_documented_defaults() {
    let scene = accepted(&fire(FLAME));
    assert_eq!((scene.systems.len(), scene.fires.len()), (0, 1));
    let own = &scene.fires[0];
    assert_eq!(own.roots, Roots::Listed);
    assert_eq!((own.height.mean, own.height.var), (1.0, 0.0));
    assert_eq!((own.width.mean, own.width.var), (0.25, 0.0));
    let profile = Profile {
        base_width: 0.67,
        swell: 0.4,
        base_height: 0.3,
        height_growth: 0.032,
        stops: vec![],
    };
    assert_eq!(own.profile, profile);
    assert_eq!((own.start_speed, own.normalised), (1.0, true));
    assert_eq!((own.buoyancy, own.gravity), (1.0, [0.0, -1.0, 0.0]));
    let noise = (own.noisiness, own.sampling, own.inverse_cohesion);
    assert_eq!(noise, (0.04, 0.05, 1.0));
    assert_eq!((own.wind_factor, own.brightness), (1.0, 1.0));
    assert_eq!((own.color_noise, own.color_noise_scale), (0.0, 4.0));
    assert_eq!((own.inner_radius, own.inner_alpha), (0.5, 0.0));
    assert_eq!((own.blackbody, own.blackbody_rim), (None, 0.8));
    let details = (own.details, own.detail_spread, own.detail_alpha);
    assert_eq!(details, (0, 1.0, 0.5));
    assert_eq!(
        (own.form, own.strip_cells),
        (FlameForm::Particles, [2.0, 5.0])
    );
    assert_eq!(own.strip_contrast, 0.6);
    let same = [0, 5, 10, 15];
    assert!((0..16).all(|at| own.particle_matrix[at] == f32::from(u8::from(same.contains(&at)))));
    assert_eq!(own.matrix_noise, 0.0);
    let lights = FireLights {
        gain: 1.0,
        count: 1,
        from: LightFrom::Mean,
    };
    assert_eq!(own.lights, lights);
    let burning = Burning {
        first_frame: 0,
        kindling_frames: 0,
        lifetime: None,
        growth_frames: 0,
    };
    assert_eq!(own.burning, burning);
    let flame = own.listed[0];
    assert_eq!(
        (flame.position, flame.normal),
        ([1.0, 2.0, 3.0], [0.0, 1.0, 0.0])
    );
    assert_eq!(
        (flame.height, flame.width, flame.first_frame),
        (None, None, None)
    );
    // Light fades towards the tip.
    let ends = own.ramp.first().zip(own.ramp.last()).expect("it has stops");
    assert_eq!((ends.0.age, ends.1.age, ends.1.alpha), (0.0, 1.0, 0.0));
    assert!(own.ramp.iter().all(|stop| stop.rim_alpha == 0.0));
}

#[test]
fn every_kind_of_root_is_read_as_what_it_says() {
    let read = |section: &str| {
        accepted(&with(section, "count", "9")).fires[0]
            .roots
            .clone()
    };
    assert_eq!(
        read("roots.line"),
        Roots::Line {
            length: 2.0,
            count: 9
        }
    );
    assert_eq!(
        read("roots.circle"),
        Roots::Circle {
            radius: 1.0,
            count: 9
        }
    );
    assert_eq!(
        read("roots.disc"),
        Roots::Disc {
            radius: 1.0,
            count: 9
        }
    );
    let Roots::Mesh { mesh, scale, count } = read("roots.mesh") else {
        panic!("no mesh");
    };
    assert_eq!((mesh.name(), scale, count), ("sphere", 1.0, 9));
}

#[test]
fn fires_that_are_at_odds_with_themselves_are_refused() {
    let roots =
        |count: u32| format!("roots = {{ kind = \"disc\", radius = 1, count = {count} }}\n");
    let stop = |age: &str| {
        format!("[[fire.ramp]]\nage = {age}\ncenter = [1, 1, 1]\nrim = [1, 1, 1]\nalpha = 1\n")
    };
    let many = format!(
        "{}{}",
        fire(&roots(600_000)),
        &fire(&roots(600_000))[SCENE.len()..]
    );
    let spreads = |lines: &str| {
        format!(
            "{}[fire.spread]\nmesh = \"cube\"\n{lines}[[fire.spread.ignition]]\nposition = [0, 0, 1]\n",
            roots(90_000)
        )
    };
    let cases = [
        (fire(""), "`fire.a` has no flame"),
        (
            fire(&format!("ramp = []\n{FLAME}")),
            "`fire.a.ramp` is empty",
        ),
        (
            fire(&format!("{FLAME}{}{}", stop("0.5"), stop("0.5"))),
            "`fire.a.ramp.1.age` is 0.5, not more than the one before",
        ),
        (
            fire(&format!(
                "{FLAME}{0}{0}",
                "[[fire.profile]]\nage = 0.25\nwidth = 1\nheight = 1\n"
            )),
            "`fire.a.profile.1.age` is 0.25, not more than the one before",
        ),
        (
            many.replacen("\"a\"", "\"b\"", 1),
            "the fires have 1200000 flames in all, too many",
        ),
        (
            fire(&spreads("max_flames = 20_000\ncatch_points = 16\n")),
            "the fires have 110000 flames in all, too many where something may catch fire",
        ),
        (
            fire(&spreads("max_flames = 60_000\n"))
                + &fire(&spreads("max_flames = 60_000\n")).replacen("\"a\"", "\"b\"", 1)
                    [SCENE.len()..],
            "the fires may have dropped 120000 flames in all, too many",
        ),
        (
            fire(&format!("lights = 60\n{FLAME}"))
                + &fire(&format!("lights = 5\n{FLAME}"))[SCENE.len()..],
            "the fires have 65 point lights in all, too many",
        ),
        (
            fire(FLAME) + "[[fire]]\nname = \"a\"\n" + FLAME,
            "already that of another fire",
        ),
        (
            fire("[[fire.flame]]\nnormal = [0, 1, 0]"),
            "`fire.a.flame.0.position` is missing",
        ),
    ];
    for (text, wanted) in cases {
        let error = refused(&text);
        assert!(error.message().contains(wanted), "wants {wanted}: {error}");
        assert!(error.line().is_some(), "{error}");
    }
}

#[test]
fn p25_a_matrix_that_makes_everything_flat_is_refused() {
    for (rows, wanted) in [
        (
            "2, 1, 0, 0, 4, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1",
            "is singular",
        ),
        (
            "1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1",
            "is singular",
        ),
        (
            "1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1",
            "is singular",
        ),
        (
            "1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0",
            "too far away",
        ),
    ] {
        let error = refused(&fire(&format!("particle_matrix = [{rows}]\n{FLAME}")));
        assert!(error.message().contains(wanted), "{error}");
    }
}
