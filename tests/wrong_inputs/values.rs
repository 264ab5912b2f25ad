//! Wrong values in scene files, and too many of them.

use crate::SPARKS;
use crate::all_are_refused;
use crate::row::Row;
use crate::scenes::{longer, spoiled, with};

#[test]
fn wrong_values_are_answered_with_their_range() {
    let triggers: Vec<String> = (0..100_000).map(|frame| frame.to_string()).collect();
    let triggers = format!("trigger_frames = [{}]\n", triggers.join(","));
    let size =
        |value: &str, said: &[&str]| spoiled("size = 0.05", &format!("size = {value}"), said);
    all_are_refused(&[
        size(
            "nan",
            &[
                "`system.sparks.size`",
                "not a finite number",
                "w.toml:21:8",
                "from 0.000001 to 10_000",
            ],
        ),
        size(
            "-inf",
            &[
                "not a finite number",
                "w.toml:21:8",
                "from 0.000001 to 10_000",
            ],
        ),
        size(
            "1e400",
            &[
                "not a finite number",
                "w.toml:21:8",
                "from 0.000001 to 10_000",
            ],
        ),
        size(
            "1e-320",
            &["out of range: 1e-320", "w.toml:21:8", "from 0.000001"],
        ),
        size("-0.0", &["out of range", "w.toml:21:8", "from 0.000001"]),
        size(
            "2020-01-01",
            &["cannot be a date", "w.toml:21:8", "as in `size = "],
        ),
        size(
            "[1, 2]",
            &["cannot be an array of 2", "w.toml:21:8", "as in `size = "],
        ),
        size("{}", &["w.toml:21:8", "mean"]),
        size("99999999999999999999", &["64 bits", "w.toml:21:8"]),
        longer(
            "particle_shape = \"stroke\"\nblend = \"over\"\nlight = 1\n",
            &["`system.sparks.light`", "throw none", "w.toml:24:9", "0"],
        ),
        longer(
            "light = -1\n",
            &[
                "`system.sparks.light`",
                "w.toml:22:9",
                "from 0 to 1_000_000",
            ],
        ),
        spoiled(
            "seed = 7",
            "seed = -1",
            &["`seed`", "w.toml:3:8", "from 0 to"],
        ),
        spoiled(
            "seed = 7",
            "seed = 7.5",
            &["`seed`", "w.toml:3:8", "a whole number"],
        ),
        spoiled(
            "seed = 7",
            "capacity = 0",
            &["`capacity`", "w.toml:3:12", "from 1 to"],
        ),
        spoiled(
            "seed = 7",
            "capacity = 2_000_000_000",
            &["`capacity`", "w.toml:3:12", "1_000_000_000"],
        ),
        spoiled(
            "frames = 10",
            "frames = 0",
            &["`frames`", "w.toml:2:10", "from 1 to"],
        ),
        spoiled(
            "width = 32",
            "width = 0",
            &["`image.width`", "w.toml:6:9", "from 1 to 4096"],
        ),
        spoiled(
            "height = 18",
            "height = 4097",
            &["`image.height`", "w.toml:7:10", "from 1 to 4096"],
        ),
        spoiled(
            "[0, 0, 0]",
            "[0, 0]",
            &["`camera.target`", "w.toml:11:10", "3 numbers"],
        ),
        spoiled(
            "[0, 0, 0]",
            "[0, 0, 5]",
            &["looks nowhere", "w.toml:11:10", "from the position"],
        ),
        spoiled(
            "[0, 0, 0]",
            "[0, 9, 5]",
            &["`camera.up`", "parallel", "w.toml:11:10", "up = [0, 0, -1]"],
        ),
        spoiled(
            "\"sphere\"",
            "\"spere\"",
            &["w.toml:17:29", "did you mean `sphere`?"],
        ),
        spoiled(
            "\"sparks\"",
            "\"../../etc\"",
            &["w.toml:14:8", "a letter or _"],
        ),
        spoiled("\"sparks\"", "\"\"", &["w.toml:14:8", "a letter or _"]),
        spoiled(
            "var = 1 }",
            "var = -1 }",
            &["`system.sparks.lifetime.var`", "w.toml:19:30", "from 0 to"],
        ),
        spoiled(
            "= 20",
            "= 1e9",
            &[
                "`system.sparks.initial_mean_parts`",
                "w.toml:15:22",
                "from 0 to 16_000_000",
            ],
        ),
        spoiled(
            "= 0.05, var",
            "= { keys = [[3, 1], [1, 2]] }, var",
            &["w.toml:18:37", "ascending order"],
        ),
        spoiled(
            "{ mean = 0.05, var = 0.02 }",
            "{ keys = [] }",
            &["is empty", "w.toml:18:18", "[FRAME, VALUE]"],
        ),
        longer(&triggers, &["too many", "w.toml:22:18", "at most 256"]),
        longer(
            "trigger_frames = [3, 2]\n",
            &["not greater", "w.toml:22:22", "ascending"],
        ),
        longer(
            "first_frame = 9\nend_frame = 3\n",
            &["births begin at frame 9", "w.toml:23:13", "at least 10"],
        ),
        longer(
            "[[wind]]\nkind = \"nois\"\n",
            &["w.toml:23:8", "did you mean `noise`?"],
        ),
    ]);
}

#[test]
fn too_much_of_anything_is_answered_with_how_much_there_may_be() {
    let start = SPARKS.find("[[system]]").expect("a system");
    let named = |number| SPARKS[start..].replace("sparks", &format!("s{number}"));
    let systems: String = (0..1025).map(named).collect();
    let layer = |name: &str| {
        format!("[[layer]]\nname = \"{name}\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n")
    };
    let layers: String = (0..9).map(|number| layer(&format!("l{number}"))).collect();
    let long =
        with("frames = 10", "frames = 1000000").replace("lifetime = { mean = 4, var = 1 }", "");
    let crowd = with("= 20", "= 16e6")
        .replace("mean = 4,", "mean = 60000,")
        .replace("frames = 10", "frames = 9999");
    all_are_refused(&[
        Row::scene(
            SPARKS[..start].to_owned() + &systems,
            &["an array of 1025", "w.toml:13:1", "1 to 1024"],
        ),
        longer(&layers, &["an array of 9", "w.toml:22:1", "at most 8"]),
        longer(
            &layer("a").repeat(2),
            &["already that of another", "w.toml:27:8", "line 23"],
        ),
        longer(
            &layer("rest"),
            &["`layer.0.name`", "w.toml:23:8", "but not \"rest\""],
        ),
        longer(
            &layer("surfaces"),
            &[
                "`layer.0.name`",
                "w.toml:23:8",
                "\"particles\", \"surfaces\"",
            ],
        ),
        longer(
            "[[layer]]\nname = \"a\"\npoint = [0, 0, 0]\nnormal = [0, 0, 0]\n",
            &["no direction", "w.toml:25:10"],
        ),
        Row::scene(long, &["no lifetime", "--> w.toml", "65000"]),
        Row::scene(
            crowd,
            &["particles at once", "--> w.toml", "`capacity = N`"],
        ),
        longer(
            &("[[fire]]\nname = \"mill\"\n[fire.spread]\nmesh = \"cube\"\nmax_points = 30000\n"
                .to_owned()
                + &"[[fire.spread.ignition]]\nposition = [0, 0, 1]\npoints = 4096\n".repeat(5)),
            &["20480 control points", "at most 16384", "--> w.toml"],
        ),
        longer(
            "[[fire]]\nname = \"mill\"\n[fire.spread]\nmesh = \"cube\"\nmax_points = 30\n\
             ignition = [{ position = [0, 0, 1], points = 31 }]\n",
            &[
                "`fire.mill.spread.max_points` is 30",
                "31 or more",
                "w.toml:26:14",
            ],
        ),
        longer(
            "[[fire]]\nname = \"mill\"\nroots = { kind = \"line\", length = 2, count = 20 }\n\
             [[fire.profile]]\nage = 0.5\nwidth = 1\nheight = 1\n\
             [[fire.profile]]\nage = 0.5\nwidth = 1\nheight = 1\n",
            &[
                "`fire.mill.profile.1.age` is 0.5, not more than the one before",
                "w.toml:25:1",
            ],
        ),
        longer(
            "[[flock]]\nname = \"crowd\"\ncount = 600_000\nperception_radius = 9\n\
             region = { min = [0, 0, 0], max = [9, 9, 0] }\n\
             [[flock.relation]]\nkind = \"flock\"\n",
            &[
                "`crowd`",
                "360000000000 others in every frame",
                "--> w.toml",
                "at most 274877906944",
            ],
        ),
    ]);
}
