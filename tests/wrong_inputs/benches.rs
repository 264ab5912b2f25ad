//! Wrong things to measure.

use super::{Row, SPARKS, all_are_refused};

fn bench(more: &[&str], said: &[&str]) -> Row {
    let all = [&["bench", "sparks.toml", "--adapter", "cpu"], more].concat();
    Row::new(&all, said)
}

#[test]
fn wrong_counts_are_answered_with_their_range() {
    let mut rows = Vec::new();
    for value in [
        "0", "-5", "1.5", "2e9", "1e", "many", "", "1e5,", "1e5;1e6", "inf", "NaN",
    ] {
        let said = &["--particles <N,N,…>", "from 1 to 1e9, e.g. 1e6"];
        rows.push(bench(&["--particles", value], said));
    }
    for value in ["0", "-1", "1001", "2.5", "x"] {
        rows.push(bench(
            &["--frames", value],
            &["--frames <N>", "from 1 to 1000"],
        ));
    }
    for value in ["0", "-1", "101", "x"] {
        rows.push(bench(&["--noise", value], &["--noise <PERCENT>", "e.g. 1"]));
    }
    for value in ["0", "-1", "1e9", "x"] {
        rows.push(bench(&["--seconds", value], &["--seconds <S>", "e.g. 10"]));
    }
    all_are_refused(&rows);
}

#[test]
fn scenes_that_cannot_be_measured_so_are_named() {
    let scaled = SPARKS.replace("seed = 7", "seed = 7\nsteady_particles = 80");
    let none = SPARKS.replace("seed = 7", "seed = 7\nsteady_particles = 0");
    all_are_refused(&[
        bench(
            &["--particles", "1000"],
            &[
                "`sparks` does not say how",
                "--> sparks",
                "`steady_particles`",
            ],
        ),
        Row::new(
            &["bench", "w.toml", "--particles", "9e8", "--adapter", "cpu"],
            &["births a frame in one system", "--> w", "at most "],
        )
        .file("w.toml", scaled.as_str()),
        Row::new(
            &["bench", "w.toml", "--adapter", "cpu"],
            &[
                "`steady_particles` is out of range",
                "w.toml:4:20",
                "from 1 to",
            ],
        )
        .file("w.toml", none.as_str()),
        Row::new(
            &["bench", "sparks"],
            &["no built-in scene `sparks`", "sparks.toml"],
        ),
        bench(
            &["sparks.toml"],
            &["two scenes are called `sparks`", "each once"],
        ),
        Row::new(
            &["bench", "sparks.toml", "d/sparks.toml", "--adapter", "cpu"],
            &["two scenes are called `sparks`", "each once"],
        )
        .file("d/", "")
        .file("d/sparks.toml", SPARKS),
    ]);
}

#[test]
fn wrong_adapters_and_reports_are_refused_before_anything_is_measured() {
    let on =
        |adapter, said: &[&str]| Row::new(&["bench", "sparks.toml", "--adapter", adapter], said);
    all_are_refused(&[
        on("nope", &["`nope`", "adapters here: ", "cpu"]),
        on("cpu,nope", &["`nope`", "adapters here: ", "cpu"]),
        on(
            "cpu,cpu",
            &["`cpu,cpu` names cpu twice", "each adapter once"],
        ),
        bench(&["--json", "."], &["--json needs a file", "is a folder"]),
        bench(&["--csv", "sparks.toml/a.csv"], &["sparks.toml is a file"]),
        bench(&["--html", "d"], &["--html needs a file"]).file("d/", ""),
        bench(
            &["--json", "a", "--html", "a"],
            &[
                "--html and --json would be written to the same place",
                "of its own",
            ],
        ),
        bench(
            &["--frames", "3", "--noise", "2"],
            &["'--frames <N>'", "'--noise"],
        ),
        bench(&["--micr"], &["'--micr'", "'--micro'"]),
    ]);
}
