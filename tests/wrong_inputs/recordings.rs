//! Wrong recordings, the files that `--inputs` takes.

use crate::all_are_refused;
use crate::row::Row;

/// A recording of this text, called `r.txt`.
fn recording(text: impl Into<Vec<u8>>, said: &[&str]) -> Row {
    Row::render(&["-o", "a.gif", "--inputs", "r.txt"], said).file("r.txt", text)
}

#[test]
fn wrong_recordings_are_answered_with_their_line() {
    let form = "FRAME path.to.key=value";
    let mut deep = "2 title=".to_owned();
    deep += &"[".repeat(100_000);
    all_are_refused(&[
        recording("nonsense\n", &["r.txt:1", "`nonsense`", form]),
        recording(
            "# none\n\nx seed=3\n",
            &["r.txt:3", "no frame number", form],
        ),
        recording(
            "-1 image.exposure=2\n",
            &["r.txt:1", "no frame number", form],
        ),
        recording(
            "99999999999 image.exposure=2\n",
            &["r.txt:1", "frame", form],
        ),
        recording(
            "1000001 image.exposure=2\n",
            &["r.txt:1", "1,000,000", form],
        ),
        recording("3 image.exposure\n", &["r.txt:1", "no `=`", form]),
        recording(
            "5 seed=2\n3 seed=3\n",
            &["r.txt:2", "before the last line's", form],
        ),
        recording("[image]\nexposure = 3\n", &["r.txt:1", form]),
        recording("1 \x1b[2J\x07=\n", &["r.txt:1:"]),
        recording(
            "2 image.exposrue=3\n",
            &["`exposrue`", "r.txt:1:9", "did you mean `exposure`?"],
        ),
        recording(
            "# c\n  2   system.sparks.size=nan\n",
            &["not a finite", "r.txt:2:26", "from 0.000001"],
        ),
        recording(
            "2 system.sparks.size=-1\r\n",
            &["out of range: -1", "r.txt:1:22", "from 0.000001"],
        ),
        recording(
            "2 system.9.size=2\n",
            &["no `9` in `system`", "r.txt:1:10", "by name sparks"],
        ),
        recording("2 =2\n", &["empty key", "r.txt:1:3", form]),
        recording("2 image.exposure=\n", &["no value", "r.txt:1:18", form]),
        recording("2 image.exposure=[1\n", &["expected `]`", "r.txt:1:"]),
        recording(deep, &["r.txt:1:"]),
        recording(
            "2 camera.position=[0, 0, 0]\n",
            &["r.txt:1: ", "looks nowhere", "sparks.toml:11:10"],
        ),
        recording(
            "2 image.width=48\n",
            &["r.txt:1: ", "frame 2", "image size"],
        ),
        recording("2 seed=8\n", &["r.txt:1: ", "frame 2", "seed"]),
        recording("2 system.sparks.name=x\n", &["r.txt:1: ", "names"]),
        recording(
            b"1 seed=1\n\xff\xfe2\0".as_slice(),
            &["r.txt:2: ", "UTF-8", "save the file"],
        ),
        recording(
            "3 ".to_owned() + &"x".repeat(1 << 20),
            &["r.txt:1", "no `=`"],
        ),
        recording(
            "3 ".to_owned() + &"x".repeat(17 << 20),
            &["r.txt", "too long", "16777216"],
        ),
        Row::render(
            &["--inputs", "none.txt"],
            &["none.txt", "No such file", form],
        ),
        Row::render(&["--inputs", "d"], &["d cannot be read", "directory", form]).file("d/", ""),
        Row::render(&["--inputs", ""], &["--inputs"]),
        Row::render(
            &["--stats", "r.txt", "--inputs", "r.txt"],
            &["r.txt is the recording", "path of its own"],
        )
        .file("r.txt", "2 image.exposure=2\n"),
    ]);
    if cfg!(target_os = "linux") {
        all_are_refused(&[Row::render(
            &["--inputs", "/dev/zero"],
            &["/dev/zero", "too long"],
        )]);
    }
}

/// Changes are made one after the other and not each from the beginning.
#[test]
fn a_long_recording_is_read_in_time() {
    let mut text: String = (0..20_000)
        .map(|at| format!("{} image.exposure=2\n", at / 1000))
        .collect();
    text += "20 image.exposure=-1\n";
    all_are_refused(&[recording(text, &["out of range: -1", "r.txt:20001:19"])]);
}
