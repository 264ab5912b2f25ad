//! Wrong command lines.

use crate::SPARKS;
use crate::all_are_refused;
use crate::row::Row;

/// `render sparks.toml` with one argument and its value.
pub(crate) fn one(argument: &str, value: &str, said: &[&str]) -> Row {
    Row::render(&[argument, value], said)
}

#[test]
fn wrong_numbers_are_answered_with_what_was_typed() {
    let size = |value, said: &[&str]| one("--size", value, said);
    let mut rows = vec![
        size(
            "0x0",
            &["`image.width`", "| --size 0x0\n", "from 1 to 4096"],
        ),
        size(
            "5x0",
            &["`image.height`", "| --size 5x0\n", "from 1 to 4096"],
        ),
        size(
            "99999x1",
            &["`image.width`", "| --size 99999x1\n", "from 1 to 4096"],
        ),
        one(
            "--seed",
            "0x10",
            &["'0x10'", "'--seed", "a whole number from 0 to"],
        ),
        one(
            "--seed",
            "-1",
            &["'-1'", "'--seed", "a whole number from 0 to"],
        ),
        one(
            "--seed",
            "18446744073709551615",
            &["'--seed", "from 0 to 9223372036854775807"],
        ),
        one(
            "--seed",
            "1.5",
            &["'1.5'", "'--seed", "a whole number from 0 to"],
        ),
        one("--seed", "", &["'--seed", "a whole number from 0 to"]),
        one("--frame", "1000000", &["'--frame", "below 1000000"]),
        one("--dump", "1,,2", &["'--dump", "commas between"]),
        one("--dump", "-1", &["'-1'", "'--dump", "commas between"]),
        one("--dump", "99", &["frame 99", "0..10", "--frames"]),
        one(
            "--snapshot-every",
            "-1",
            &["'-1'", "'--snapshot-every", "seconds are a number"],
        ),
        one("--snapshot-every", "nan", &["'nan'", "'--snapshot-every"]),
        Row::new(
            &["check", "sparks.toml", "--frames", "0"],
            &["'--frames", "from 1 to 1000000"],
        ),
        Row::new(
            &["check", "sparks.toml", "--frames", "-1"],
            &["'-1'", "'--frames", "from 1 to 1000000"],
        ),
    ];
    for value in ["-1x5", "12", "x", "4294967296x1", "1e3x5", "3x4x5", ""] {
        rows.push(size(
            value,
            &["'--size <WxH>'", "WxH in pixels, e.g. 1280x720"],
        ));
    }
    for value in ["-1", "4294967296", "x", "1.5", "1..2"] {
        rows.push(one(
            "--frame",
            value,
            &["'--frame", "a whole number below 1000000"],
        ));
    }
    for value in [
        "5..2",
        "3..3",
        "-1..2",
        "0..1000001",
        "a..b",
        "..5",
        "1..=3",
        "5",
    ] {
        rows.push(one(
            "--frames",
            value,
            &["'--frames <A..B>'", "A before B, e.g. 0..48"],
        ));
    }
    all_are_refused(&rows);
}

#[test]
fn wrong_changes_are_answered_with_the_argument() {
    let set = |value, said: &[&str]| one("--set", value, said);
    all_are_refused(&[
        set("seed", &["no `=`", "| --set seed\n", "path.to.key=value"]),
        set(
            "seed=",
            &["no value", "| --set seed=\n", "path.to.key=value"],
        ),
        set("=3", &["empty key", "path.to.key=value"]),
        set("seed=-1", &["`seed`", "| --set seed=-1\n", "from 0 to"]),
        set(
            "system.9.size=1",
            &["no `9` in `system`", "only item is 0, or by name sparks"],
        ),
        set(
            "system.spark.size=1",
            &["`spark`", "did you mean `sparks`?"],
        ),
        set("system.sparks.sise=1", &["`sise`", "did you mean `size`?"]),
        set("a.b.c.d.e.f.g.h.i=1", &["too long", "8 parts"]),
        set("image=3", &["`image` must be a table", "width, height"]),
        set("frames=[", &["--set frames=[", "expected `]`"]),
        set(
            "image.width.x=3",
            &["has no key `x`", "end the path at `image.width`"],
        ),
        set(
            "frames=1e3",
            &[
                "`frames`",
                "write 1000, without a point",
                "a whole number from 1",
            ],
        ),
        // More than there may be is not what would be right.
        set(
            "frames=1e9",
            &["cannot be the number 1000000000", "as in `frames = 120`"],
        ),
        set(
            "wind.0.strength=2",
            &[
                "no `wind`, and so no `0`",
                "--set wind.0.strength=2\n   |       ^^^^\n",
            ],
        ),
        set("flock.x.count=2", &["no `flock`, and so no `x`", "--knobs"]),
        set("surface.0.mesh=../x.obj", &["no `surface`, and so no `0`"]),
        set(
            "camera.up.1=2",
            &[
                "`camera.up` is not written",
                "set it whole, e.g. camera.up=[",
            ],
        ),
        set(
            "system.sparks.generation_shape={ kind = \"mesh\", mesh = \"cube\", mesh = 1 }",
            &["--set system.sparks.generation_shape="],
        ),
        Row::render(&["--set"], &["--set <path.to.key=value>"]),
    ]);
}

#[test]
fn what_a_plan_refuses_is_told_with_its_place() {
    let flock = |count: &str| {
        format!(
            "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n\n[[flock]]\nname = \"crows\"\n\
             count = {count}\ndimensions = 3\nperception_radius = 100000\n\
             region = {{ min = [0, 0, 0], max = [9, 9, 9] }}\n\
             [[flock.relation]]\nkind = \"flock\"\n"
        )
    };
    let planet = "[planet]\ncenter = [0, 0, 0]\nradius = 1\n";
    let flat = format!(
        "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nprojection = \"orthographic\"\n\
         view_height = 2\n{planet}{}",
        &flock("9")[flock("9").find("[[flock]]").expect("it is there")..]
    );
    all_are_refused(&[
        Row::new(
            &["render", "w.toml", "--adapter", "cpu", "-o", "a.gif"],
            &[
                "would look at 1000000000000 others",
                "w.toml:7:9",
                "a smaller `count`",
            ],
        )
        .file("w.toml", flock("1000000").as_str()),
        Row::new(
            &[
                "render",
                "w.toml",
                "--adapter",
                "cpu",
                "-o",
                "a.gif",
                "--set",
                "flock.crows.count=1000000",
            ],
            &["would look at", "| --set flock.crows.count=1000000\n"],
        )
        .file("w.toml", flock("9").as_str()),
        Row::new(
            &["bench", "w.toml", "--set", "flock.crows.count=1000000"],
            &["would look at", "| --set flock.crows.count=1000000\n"],
        )
        .file("w.toml", flock("9").as_str()),
        Row::new(
            &["bench", "million", "--set", "sede=2"],
            &["`sede`", "| --set sede=2\n", "`seed`"],
        ),
        Row::new(
            &["bench", "--micro", "--set", "seed=2"],
            &["--set changes scenes", "name a scene"],
        ),
        Row::new(
            &["check", "w.toml"],
            &["a planet and an orthographic camera", "w.toml:4:14"],
        )
        .file("w.toml", flat.as_str()),
        Row::new(
            &["bench", "w.toml"],
            &["a planet and an orthographic camera", "w.toml:4:14"],
        )
        .file("w.toml", flat.as_str()),
    ]);
}

#[test]
fn wrong_names_are_answered_with_those_that_there_are() {
    let bad = SPARKS.replace("size = 0.05", "size = x");
    let mut rows = vec![
        Row::new(
            &["render", "sparks"],
            &["no built-in scene `sparks`", "did you mean sparks.toml"],
        ),
        Row::new(
            &["render", "firework"],
            &["`firework`", "did you mean fireworks"],
        ),
        Row::new(&["render", "."], &["`.` is a folder", "TOML file"]),
        Row::new(&["render", "-"], &["no scene `-`", "ends in .toml"]),
        Row::new(&["render", ""], &["no scene", "ends in .toml"]),
        Row::new(&["render", "./"], &["./", "is a folder", "TOML file"]),
        Row::new(
            &["render", "d.toml"],
            &["d.toml", "is a folder", "TOML file"],
        )
        .file("d.toml/", ""),
        Row::new(
            &["render", "none/x.toml"],
            &["none/x.toml", "No such file", "motes scenes"],
        ),
        Row::new(
            &["render", "sparks.toml", "--adapter", "nope", "-o", "a.gif"],
            &["`nope`", "adapters here: ", "cpu"],
        ),
        Row::new(
            &["check", "nope"],
            &["`nope`", "`motes scenes` lists the built-in scenes"],
        ),
        Row::new(
            &["check", "sparks.toml", "--adapter", "cpu"],
            &["with itself", "--adapter"],
        ),
        Row::new(
            &[
                "check",
                "sparks.toml",
                "--adapter",
                "cpu",
                "--against",
                "nope",
            ],
            &["`nope`", "cpu"],
        ),
        Row::new(&["check", "w.toml"], &["w.toml:21:8", "quoted"]).file("w.toml", bad.as_str()),
        Row::new(
            &["scenes", "--show", "nope"],
            &["`nope`", "`motes scenes` lists the built-in scenes"],
        ),
        Row::new(
            &["scenes", "--show", "sparks.toml"],
            &["`sparks.toml`", "motes scenes"],
        ),
        Row::new(
            &["scenes", "--knobs", "nope"],
            &["`nope`", "`motes scenes` lists the built-in scenes"],
        ),
        Row::new(&["scenes", "--knobs", "w.toml"], &["w.toml:21:8", "quoted"])
            .file("w.toml", bad.as_str()),
    ];
    if cfg!(target_os = "linux") {
        rows.push(Row::new(
            &["render", "/dev/zero"],
            &["/dev/zero", "larger than 1 MiB"],
        ));
        rows.push(Row::new(
            &["render", "/dev/null"],
            &["/dev/null:1:1", "`camera`", "add"],
        ));
    }
    all_are_refused(&rows);
}

#[test]
fn arguments_that_do_not_go_together_are_named() {
    all_are_refused(&[
        Row::new(&["render"], &["<SCENE>", "Usage: motes render"]),
        Row::new(&["rendr", "x"], &["'rendr'", "'render'"]),
        Row::render(&["x.toml"], &["'x.toml'", "Usage: motes render"]),
        Row::new(
            &["--adapter", "cpu", "render", "sparks.toml"],
            &["'--adapter'", "'render --adapter'"],
        ),
        Row::render(&["--sizes", "3x3"], &["'--sizes'", "'--size'"]),
        Row::render(
            &["--frame", "1", "--frames", "0..2"],
            &["'--frame <N>'", "'--frames <A..B>'"],
        ),
        Row::render(
            &["--frame", "1", "--frame", "2"],
            &["'--frame <N>'", "multiple times"],
        ),
        Row::render(&["--dump-dir", "d"], &["--dump <N,N,…>"]),
        Row::new(&["scenes", "--json"], &["--knobs <SCENE>"]),
        Row::new(
            &["scenes", "--show", "million", "--knobs", "million"],
            &["'--show <SCENE>'", "'--knobs <SCENE>'"],
        ),
        Row::new(
            &["scenes", "million"],
            &["'million'", "Usage: motes scenes"],
        ),
        Row::new(&["adapters", "--jsn"], &["'--jsn'", "'--json'"]),
        Row::new(&["adapters", "x"], &["'x'", "Usage: motes adapters"]),
        Row::new(&["schema", "--markdwn"], &["'--markdwn'", "'--markdown'"]),
        Row::new(&["help", "x"], &["'x'", "Usage: motes"]),
    ]);
}
