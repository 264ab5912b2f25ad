//! `--set path.to.key=value`.

use motes::scene::{
    EjectionAxis, Extinction, GenerationShape, Scene, SceneError, Side, Spread, Wind, load_with,
};

use crate::text::FULL;

/// The full scene with these sets.
fn set(sets: &[&str]) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("some.toml");
    std::fs::write(&path, FULL).expect("a file");
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    load_with(&path.to_string_lossy(), &sets)
}

#[track_caller]
fn right(sets: &[&str]) -> Scene {
    set(sets).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn sets_change_what_they_name_and_nothing_else() {
    let mut wanted = right(&[]);
    wanted.image.width = 320;
    wanted.camera.position = [0.0, 7.0, 5.5];
    wanted.title = "Fire, at night".to_owned();
    wanted.systems[0].speed = Spread {
        mean: 2.0,
        var: 0.02,
    };
    wanted.systems[0].color.rate[2] = 0.5;
    // Once written as a mean alone, so its var has to be made.
    wanted.systems[1].lifetime = Some(Spread {
        mean: 2.0,
        var: 1.0,
    });
    wanted.systems[1].color.initial.var = [0.0, 0.0, 0.25];
    wanted.systems[1].size.rate_var = 0.125;
    // The shape's axis goes with it.
    wanted.systems[1].ejection_axis = EjectionAxis::Outward;
    wanted.systems[0].bursts[1].parts = Spread {
        mean: 7.0,
        var: 2.0,
    };
    wanted.systems[0].trigger_frames[2] = 41;
    wanted.systems[0].extinctions[2] = Extinction::Sphere {
        center: [0.0, 1.0, 2.0],
        radius: 0.75,
        kills: Side::Inside,
    };
    wanted.winds[0] = Wind::Uniform {
        velocity: [0.01, 0.5, 0.03],
    };
    wanted.layers[1].point = [0.0, 0.0, -5.0];
    wanted.systems[1].generation_shape = GenerationShape::Sphere { radius: 9.0 };
    wanted.systems[1].position = [1.0, 2.0, 3.0];
    let sets = [
        "image.width=1",
        " image . width = 320 ",
        "camera.position.1=7",
        "camera.position.2=5.5",
        "title=Fire, at night",
        "system.0.speed.mean=2",
        "system.first.color.rate.2=0.5",
        "system.1.lifetime.var=1",
        "system.second.color.var=[0, 0, 0.25]",
        "system.second.size.rate_var=0.125",
        "system.first.burst.1.parts.var=2",
        "system.first.trigger_frames.2=41",
        "system.first.extinction.2.radius=0.75",
        "wind.0.velocity.1=0.5",
        "layer.far.point=[0, 0, -5]",
        "system.second.generation_shape={ kind = \"sphere\", radius = 9 }",
        "system.second.position=[1, 2, 3]",
    ];
    assert_eq!(right(&sets), wanted);
    assert_eq!(right(&["description=\"a=b\""]).description, "a=b");
    assert_eq!(
        right(&["system.0.particle_shape=rectangle"]),
        right(&["system.0.particle_shape='rectangle'"])
    );
    // Tables that the file does not have are made.
    let sets = ["image.shutter=0.25".to_owned()];
    assert_eq!(
        load_with("million", &sets).map(|scene| scene.image.shutter),
        Ok(0.25)
    );
}

#[test]
fn a_wrong_set_is_shown_with_what_would_be_right() {
    #[rustfmt::skip]
    let cases = [
        ("image.width", "no `=`", "--set image.width=640", 7),
        ("image.width=", "no value", "--set image.width=640", 19),
        ("=3", "empty key", "--set image.width=640", 7),
        ("image..width=3", "empty key", "--set image.width=640", 13),
        ("image.width=0", "`image.width` is out of range: 0", "from 1 to 4096", 19),
        ("image.width=wide", "`image.width` cannot be text", "from 1 to 4096", 19),
        ("image.width=6 40", "values must be quoted", "key = value", 19),
        ("image.widht=3", "no key `widht`", "did you mean `width`?", 13),
        ("camra.position=[1,2,3]", "no key `camra`", "did you mean `camera`?", 7),
        ("camera.position.3=1", "no `3` in `camera.position`", "items are 0 to 2", 23),
        ("camera.position.x=1", "no `x` in `camera.position`", "items are 0 to 2", 23),
        ("image.width.x=1", "`image.width` is the whole number 640", "end the path", 19),
        ("system.3.speed=1", "no `3` in `system`", "items are 0 to 2, or by name first, second, rings", 14),
        ("system.frist.speed=1", "no `frist` in `system`", "did you mean `first`?", 14),
        ("system.0.speed=\"fast\"", "`system.first.speed` cannot be text", "mean", 22),
        ("system.1.name=first", "already that of another", "a name of its own", 21),
        ("system.0.initial_mean_parts_per_area=1", "both births", "keep one", 44),
        ("a.b.c.d.e.f.g.h.i=1", "too long", "8 parts", 23),
    ];
    for (text, message, help, column) in cases {
        let error = set(&[text]).expect_err(text);
        assert!(error.message().contains(message), "{error}");
        assert!(error.help().contains(help), "{error}");
        assert_eq!(error.file(), Some("command line"), "{error}");
        assert_eq!(error.column(), Some(column), "{error}");
        let shown = error.to_string();
        assert!(shown.contains(&format!("   | --set {text}\n")), "{error}");
        let caret = shown
            .lines()
            .find(|line| line.contains('^'))
            .expect("a caret");
        assert_eq!(caret.find('^'), Some("   | ".len() + column - 1), "{error}");
    }
    let deep = "a.".repeat(1_000_000) + "a=1";
    assert!(
        set(&[&deep])
            .expect_err("deep")
            .message()
            .contains("too long")
    );
}

#[test]
fn sets_reach_keys() {
    let sets = [
        "system.0.speed={ keys = [[0, 1], [10, 2]] }",
        "system.first.speed.keys.1.1=3",
        "system.first.speed.interpolation=smooth",
        "system.first.speed.keys.0=[4, 2]",
        // A var beside keys that stand for the mean.
        "system.second.size={ keys = [[0, 1], [8, 5]] }",
        "system.second.size.var=0.25",
        "camera.position={ keys = [[0, [0, 1, 5]], [4, [0, 1, 9]]] }",
        "camera.position.keys.1.1.0=4",
        "image.exposure={ keys = [[0, 1], [4, 2]] }",
        "image.exposure=7",
        "wind.sink.strength=1",
    ];
    let scene = right(&sets[..10]);
    assert_eq!(scene.image.exposure, 7.0);
    assert_eq!(scene.tracks.len(), 3);
    let now = scene.at(4.0);
    let speed = Spread {
        mean: 2.0,
        var: 0.0,
    };
    assert_eq!(now.systems[0].speed, speed);
    assert_eq!(scene.at(10.0).systems[0].speed.mean, 3.0);
    let size = Spread {
        mean: 3.0,
        var: 0.25,
    };
    assert_eq!(now.systems[1].size.initial, size);
    assert_eq!(now.camera.position, [4.0, 1.0, 9.0]);
    // A wind has no name to go by.
    assert!(set(&sets).is_err());
    #[rustfmt::skip]
    let cases = [
        ("system.0.speed={ keys = [] }", "`system.first.speed.keys` is empty", "[]"),
        ("system.0.speed.keys.1.1=10_001", "`system.first.speed.keys.1.1` is out of range: 10001", "10_001"),
        ("system.0.speed.keys.1.0=-1", "`system.first.speed.keys.1.0` is -1, but the key before is at 4", "-1"),
        ("system.0.speed.keys.2=[9, 1]", "there is no `2` in `system.0.speed.keys`", "2="),
        ("system.0.speed.interpolation=soft", "`system.first.speed.interpolation` cannot be \"soft\"", "soft"),
        ("camera.near={ keys = [[0, 1]] }", "`camera.near` cannot change with the frame", "{ keys"),
        ("camera.target={ keys = [[0, [0, 0, 0]], [4, [4, 1, 9]]] }", "`camera.target.keys.1`: at frame 4, `camera.target` is where", "[4, ["),
    ];
    for (text, message, piece) in cases {
        let error = set(&[&sets[..8], &[text]].concat()).expect_err(text);
        assert!(
            error.message().contains(message),
            "wants {message}: {error}"
        );
        assert_eq!(error.file(), Some("command line"), "{error}");
        let column = text.find(piece).map(|index| "--set ".len() + index + 1);
        assert_eq!(error.column(), column, "{error}");
    }
}

#[test]
fn what_is_unset_is_as_if_the_scene_did_not_say_it() {
    let scene = right(&[
        "system.first.drag=unset",
        "system.first.size.var=unset",
        "system.first.end_frame=unset",
        "light.shadow_radius = unset",
    ]);
    let mut wanted = right(&[]);
    wanted.systems[0].drag = 0.0;
    wanted.systems[0].size.initial.var = 0.0;
    wanted.systems[0].end_frame = None;
    wanted.light.shadow_radius = None;
    assert_eq!(scene.systems[0], wanted.systems[0]);
    assert_eq!(scene.light, wanted.light);
    #[rustfmt::skip]
    let cases = [
        ("system.first.drog=unset", "there is no `system.first.drog` to leave out", "drog"),
        ("system.first=unset", "`first` is one of a list", "first"),
        ("system.ferst.drag=unset", "there is no `system.ferst.drag` to leave out", "ferst"),
        ("system.first.name=unset", "`system.0.name` is missing", "system"),
    ];
    for (text, message, piece) in cases {
        let error = set(&[text]).expect_err(text);
        let told = error.to_string();
        assert!(
            error.message().contains(message) && told.contains(piece),
            "{told}"
        );
    }
}

#[test]
fn whatever_is_set_and_unset_is_as_it_was() {
    for name in [
        "fireworks",
        "burning-cube",
        "flock",
        "genesis-impact",
        "candle-wind",
    ] {
        let known = load_with(name, &[]).expect("it is built in");
        let mut count = 0;
        for knob in motes::scene::knobs(name).expect("it is built in") {
            if matches!(knob.value, motes::scene::KnobValue::Written(_)) {
                continue;
            }
            count += 1;
            let unset = format!("{}=unset", knob.path);
            let other = format!("{}={}", knob.path, knob.field.sample());
            for sets in [vec![unset.clone()], vec![other, unset]] {
                let scene = load_with(name, &sets).unwrap_or_else(|told| panic!("{sets:?} {told}"));
                assert!(scene == known, "{name}: {sets:?}");
            }
        }
        assert!(count > 10, "{name}: {count}");
    }
}
