//! Wrong scene files.

use crate::SPARKS;
use crate::all_are_refused;
use crate::row::Row;

/// The scene with `old` replaced.
pub(crate) fn with(old: &str, new: &str) -> String {
    assert_eq!(SPARKS.matches(old).count(), 1, "{old}");
    SPARKS.replace(old, new)
}

/// A scene with `old` replaced, and what must be said to that.
pub(crate) fn spoiled(old: &str, new: &str, said: &[&str]) -> Row {
    Row::scene(with(old, new), said)
}

/// The scene with more at its end, from line 22 on.
pub(crate) fn longer(more: &str, said: &[&str]) -> Row {
    Row::scene(SPARKS.to_owned() + more, said)
}

#[test]
fn what_is_no_toml_is_answered_with_its_place() {
    let utf16: Vec<u8> = SPARKS.encode_utf16().flat_map(u16::to_le_bytes).collect();
    all_are_refused(&[
        Row::scene("", &["`camera`", "`system`", "w.toml:1:1", "[[system]]"]),
        Row::scene("{ }", &["not TOML", "w.toml:1:1", "key = value"]),
        Row::scene("x y z\n", &["not TOML", "w.toml:1:", "key = value"]),
        spoiled(
            "\"Sparks\"",
            "Sparks",
            &["quoted", "w.toml:1:9", "double quotes"],
        ),
        spoiled("\"Sparks\"", "\"Sparks", &["w.toml:1:16", "expected `\"`"]),
        spoiled("[camera]", "[camera", &["w.toml:9:8", "expected `]`"]),
        spoiled("seed = 7", "seed = 07", &["w.toml:3:"]),
        spoiled(
            "seed = 7",
            "frames = 7",
            &["already there", "w.toml:3:1", "keep one"],
        ),
        spoiled(
            "[camera]",
            "[image]\n[camera]",
            &["already there", "w.toml:9:2", "[[…]]"],
        ),
        spoiled("seed = 7", "seed = 7, 8", &["w.toml:3:9"]),
        Row::scene(
            "a = ".to_owned() + &"[".repeat(100_000),
            &["nested too deep", "w.toml:1:", "16 levels"],
        ),
        Row::scene(
            format!("a = {}1{}", "[".repeat(30), "]".repeat(30)),
            &["nested too deep", "w.toml:1:"],
        ),
        Row::scene(
            "a.".repeat(300) + "b = 1",
            &["nested too deep", "w.toml", "16 levels"],
        ),
        Row::scene(
            "a = {".repeat(60) + &"}".repeat(60),
            &["nested too deep", "w.toml:1:"],
        ),
        Row::scene(utf16, &["UTF-8", "w.toml:1:2", "save the file"]),
        Row::scene(
            [SPARKS.as_bytes(), b"# \xe9\n"].concat(),
            &["UTF-8", "w.toml:22:3"],
        ),
        Row::scene([0; 64], &["w.toml:1:"]),
        Row::scene(b"\x89PNG\r\n\x1a\n\0".as_slice(), &["UTF-8", "w.toml:1:1"]),
        Row::scene("title = \"\x1b[2J\"\n", &["w.toml:1:10"]),
        Row::scene(
            vec![b'#'; 100 << 20],
            &["larger than 1 MiB", "w.toml", "few kilobytes"],
        ),
    ]);
}

#[test]
fn wrong_keys_are_answered_with_those_that_there_are() {
    let second = &SPARKS[SPARKS.find("[[system]]").expect("a system")..];
    all_are_refused(&[
        spoiled(
            "frames",
            "framse",
            &["`framse`", "w.toml:2:1", "did you mean `frames`?"],
        ),
        spoiled(
            "[image]",
            "[imgae]",
            &["`imgae`", "w.toml:5:2", "did you mean `image`?"],
        ),
        spoiled(
            "[[system]]",
            "[[sytem]]",
            &["`sytem`", "w.toml:13:3", "did you mean `system`?"],
        ),
        spoiled(
            "[[system]]",
            "[system]",
            &[
                "`system` cannot be a table",
                "w.toml:13:1",
                "`[[system]]` in double brackets",
            ],
        ),
        spoiled(
            "[image]",
            "[[image]]",
            &[
                "`image` must be a table",
                "w.toml:5:1",
                "its header has single brackets",
            ],
        ),
        spoiled(
            "radius",
            "raduis",
            &["`raduis`", "w.toml:17:39", "did you mean `radius`?"],
        ),
        spoiled(
            "radius = 0.5",
            "radius = 0.5, width = 1",
            &["`width`", "w.toml:17:53", "kind, radius"],
        ),
        spoiled(
            "{ mean = 4,",
            "{ maen = 4,",
            &["`maen`", "w.toml:19:14", "did you mean `mean`?"],
        ),
        spoiled(
            "[camera]",
            "fps = 24\n[camera]",
            &["`fps`", "w.toml:9:1", "width, height"],
        ),
        spoiled(
            "size = 0.05",
            "",
            &[
                "`system.sparks.size` is missing",
                "w.toml:13:1",
                "add `size",
            ],
        ),
        spoiled(
            "position = [0, 0, 5]",
            "",
            &[
                "`camera.position` is missing",
                "w.toml:9:1",
                "add `position",
            ],
        ),
        longer(
            second,
            &["already that of another", "w.toml:23:8", "line 14"],
        ),
        longer(
            "frame_rate = 30\n",
            &["`frame_rate`", "w.toml:22:1", "at the top of a scene"],
        ),
    ]);
}
