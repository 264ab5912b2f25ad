//! `--set path.to.key=value`.

use motes::scene::{GenerationShape, Scene, SceneError, Spread, load_with};

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
    wanted.systems[1].lifetime = Spread {
        mean: 2.0,
        var: 1.0,
    };
    wanted.systems[1].color.initial.var = [0.0, 0.0, 0.25];
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
        ("system.2.speed=1", "no `2` in `system`", "items are 0 to 1, or by name first, second", 14),
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
