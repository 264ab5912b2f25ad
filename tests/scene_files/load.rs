//! Loading by name and by path, and how errors look.

use std::fs;
use std::path::Path;

use motes::scene::{BUILTIN, load, parse};

use crate::text::{FILE, MINIMAL, refused, with};

#[test]
fn every_file_in_scenes_is_built_in_and_right() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut files: Vec<String> = fs::read_dir(folder)
        .expect("the folder of scenes")
        .filter_map(|entry| entry.expect("an entry").file_name().into_string().ok())
        .filter_map(|file| file.strip_suffix(".toml").map(str::to_owned))
        .collect();
    files.sort();
    let mut names: Vec<&str> = BUILTIN.iter().map(|scene| scene.name).collect();
    names.sort_unstable();
    assert_eq!(files, names);
    for scene in BUILTIN {
        let loaded = load(scene.name).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(loaded.name, scene.name);
        assert_ne!(loaded.title, scene.name, "a built-in scene has a title");
        assert!(
            !loaded.description.is_empty(),
            "a built-in scene has a description"
        );
    }
}

#[test]
fn an_unknown_name_gets_the_nearest() {
    let error = load("fontain").expect_err("no such scene");
    assert!(error.message().contains("no scene `fontain`"), "{error}");
    assert!(error.help().contains("did you mean fountain?"), "{error}");
    assert_eq!((error.file(), error.line()), (None, None));
    let error = load("zzz").expect_err("no such scene");
    assert!(error.help().contains("`motes scenes` lists"), "{error}");
    assert!(load("").is_err());
}

#[test]
fn a_path_ends_in_toml_or_has_a_slash() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let named = |name: &str| {
        fs::write(path(name), MINIMAL).expect("a file");
        load(&path(name)).map(|scene| scene.name)
    };
    assert_eq!(named("mine.toml"), Ok("mine".to_owned()));
    assert_eq!(named("other"), Ok("other".to_owned()));
    // A name is a part of output paths, so it must not be able to climb.
    assert_eq!(named("...toml"), Ok("scene".to_owned()));
    let folder = load(&path("")).expect_err("it is a folder");
    assert!(folder.message().contains("folder"), "{folder}");
    assert_eq!(folder.file(), Some(path("").as_str()));
    for missing in ["nowhere.toml", "./nowhere", &path("nowhere.toml")] {
        let error = load(missing).expect_err(missing);
        assert!(error.message().contains("cannot be read"), "{error}");
        assert_eq!(error.file(), Some(missing));
        assert!(
            error.to_string().contains(&format!("--> {missing}")),
            "{error}"
        );
    }
}

#[test]
fn large_and_garbled_files_are_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let load_bytes = |bytes: &[u8]| {
        let path = folder.path().join("some.toml");
        fs::write(&path, bytes).expect("a file");
        load(&path.to_string_lossy())
    };
    let padded = |length: usize| {
        let mut text = MINIMAL.to_owned() + "#";
        text.extend(std::iter::repeat_n('x', length - text.len()));
        text
    };
    assert!(load_bytes(padded(1 << 20).as_bytes()).is_ok());
    let error = load_bytes(padded((1 << 20) + 1).as_bytes()).expect_err("too large");
    assert!(error.message().contains("larger than 1 MiB"), "{error}");
    let error = load_bytes(b"title = \"x\"\n# caf\xe9\n").expect_err("not UTF-8");
    assert!(error.message().contains("not UTF-8"), "{error}");
    assert_eq!((error.line(), error.column()), (Some(2), Some(6)));
    let with_mark = [
        "\u{feff}".as_bytes(),
        MINIMAL.replace('\n', "\r\n").as_bytes(),
    ]
    .concat();
    assert!(load_bytes(&with_mark).is_ok());
}

#[test]
fn an_error_reads_like_this() {
    let wanted = "\
error: `camera.up.1` is out of range: -2000000
  --> scenes/some.toml:19:10
   |
19 | up = [0, -2e6, 0]
   |          ^^^^
   = help: `up` (which way is up in the picture) is an array of 3 numbers, each from -1_000_000 to 1_000_000, world space";
    let error = refused(&with("camera", "up", "[0, -2e6, 0]"));
    assert_eq!(error.to_string(), wanted);
    let far = refused(&with("camera", "near", "1e300"));
    assert!(far.message().ends_with("is out of range: 1e300"), "{far}");
    let not_toml = parse("title = \"x\"\nframes 12\n", FILE, "s").expect_err("not TOML");
    assert!(
        not_toml.to_string().contains("--> scenes/some.toml:2:"),
        "{not_toml}"
    );
    assert!(not_toml.to_string().contains("frames 12"), "{not_toml}");
    assert!(not_toml.help().contains("key = value"), "{not_toml}");
    let twice = refused(&MINIMAL.replace("speed", "speed = 1\nspeed"));
    assert!(twice.message().contains("duplicate key"), "{twice}");
    assert_eq!(twice.line(), Some(10), "{twice}");
}

#[test]
fn what_is_shown_cannot_disturb_a_terminal() {
    let long = "x".repeat(5000);
    for value in [
        "\"a\u{9b}31m\u{202e}b\"",
        "\"tab\there\"",
        &format!("'{long}'"),
    ] {
        for text in [
            with("", "frames", value),
            with("system", "birth_rounding", value),
        ] {
            let shown = refused(&text).to_string();
            let bad = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
            assert!(!shown.contains(bad), "{shown:?}");
            assert!(
                shown.lines().all(|line| line.chars().count() < 400),
                "{shown}"
            );
            assert!(shown.contains('^'), "{shown}");
        }
    }
    // The caret stands under the value, however many characters and bytes are before it.
    for padding in [0, 20, 5000] {
        let padding = "x".repeat(padding);
        let value = format!("{{ \"é{padding}\" = 1, \"Z{padding}\" = 2 }}");
        let error = refused(&MINIMAL.replace("0.1", &value));
        assert!(error.message().contains("no key `Z"), "{error}");
        let shown = error.to_string();
        let lines: Vec<&str> = shown.lines().collect();
        let caret = lines[4].chars().position(|c| c == '^').expect("a caret");
        let under: String = lines[3].chars().skip(caret).take(2).collect();
        assert_eq!(under, "\"Z", "{shown}");
        assert_eq!(error.column(), Some(20 + padding.len()), "{shown}");
    }
}
