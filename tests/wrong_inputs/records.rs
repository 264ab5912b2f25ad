//! Wrong records of measurements, the files that `compare` and `report` take.

use crate::all_are_refused;
use crate::row::Row;

/// The least that is a record.
const RECORD: &str = r#"{"schema": 1, "adapter": "cpu", "driver": "", "backend": "cpu", "exact": true,
  "copy_kernel_gb_per_s": 8, "copy_buffer_gb_per_s": null, "runs": [],
  "micro": [{"name": "copy", "ms": {"median": 2, "p10": 1, "p90": 3, "samples": [1, 2, 3]},
    "items": 1, "bytes": 1, "gb_per_s": 1, "share_of_copy": 1}]}
"#;

/// The comparison of `right.json` with this text, called `wrong.json`.
fn record(text: impl Into<Vec<u8>>, said: &[&str]) -> Row {
    let all = [&["--> wrong.json"], said].concat();
    Row::new(&["compare", "right.json", "wrong.json"], &all)
        .file("right.json", RECORD)
        .file("wrong.json", text)
}

/// The same with one thing changed.
fn changed(from: &str, to: &str, said: &[&str]) -> Row {
    assert!(RECORD.contains(from), "{from}");
    record(RECORD.replacen(from, to, 1), said)
}

#[test]
fn wrong_records_are_answered_with_what_is_wrong() {
    let bench = "motes bench --json";
    let no_record = "no record of `motes bench`";
    let mut twice = RECORD.trim_end().to_owned();
    let copy = twice[twice.find("{\"name\"").expect("it is there")..twice.len() - 2].to_owned();
    twice.insert_str(twice.len() - 2, &format!(", {copy}"));
    all_are_refused(&[
        record("", &["the file is empty", bench]),
        record("\n \n", &["the file is empty", bench]),
        record("nonsense", &["not JSON", "line 1 column", bench]),
        record(&RECORD[..150], &["not JSON", "line 3", bench]),
        record(
            RECORD.replace("\"median\": 2", "\"median\": NaN"),
            &["not JSON", "line 3 column"],
        ),
        record(
            RECORD.replace("[1, 2, 3]", "[1, 1e999]"),
            &["not JSON", "number out of range"],
        ),
        record(vec![0xff, 0xfe, 0x00], &["not JSON", bench]),
        record(
            "[".repeat(100_000) + &"]".repeat(100_000),
            &["not JSON", "recursion", bench],
        ),
        record("3", &[no_record]),
        record("\"text\"", &[no_record]),
        record("[]", &["holds no record"]),
        record("[3]", &[no_record]),
        record("{}", &["`schema` is missing", bench]),
        record(format!("[{RECORD}, {{}}]"), &["`schema` is missing", bench]),
        changed(
            "\"schema\": 1",
            "\"schema\": 2",
            &["schema 2", "reads schema 1", "measure again"],
        ),
        changed(
            "\"schema\": 1",
            "\"schema\": \"1\u{7f}\"",
            &["reads schema 1"],
        ),
        changed(
            "\"adapter\": \"cpu\", ",
            "",
            &["missing field `adapter`", bench],
        ),
        changed(
            "\"exact\": true",
            "\"exact\": 1",
            &["expected a boolean", "line 1", bench],
        ),
        changed(
            "\"median\": 2",
            "\"median\": \"2\"",
            &["expected f64", "line 3", bench],
        ),
        changed(
            "\"median\": 2",
            "\"median\": -2",
            &["`copy` of micro", "no time is negative"],
        ),
        changed("\"median\": 2", "\"median\": 5", &["out of order"]),
        changed("[1, 2, 3]", "[1, -2]", &["no time is negative"]),
        changed("\"p90\": 3", "\"p90\": 1e300", &["nobody has waited"]),
        changed(
            "\"copy\", \"ms\"",
            "\"a\\u001b[2Jb\", \"ms\"",
            &["control characters"],
        ),
        changed(
            "\"p90\": 3",
            "\"p90\": 3, \"clock\": \"\\u001bsun\"",
            &["unknown variant"],
        ),
        record(twice, &["`copy` stands twice in micro", bench]),
    ]);
}

#[test]
fn records_that_cannot_be_compared_are_told_apart() {
    let row = |arguments: &[&str], said: &[&str]| {
        Row::new(arguments, said)
            .file("right.json", RECORD)
            .file(
                "other.json",
                RECORD.replace("\"backend\": \"cpu\"", "\"backend\": \"vulkan\""),
            )
            .file("none.json", RECORD.replace("\"copy\"", "\"another\""))
            .file("folder/", "")
    };
    let compare = |new: &str, said: &[&str]| row(&["compare", "right.json", new], said);
    let with = |more: &[&str], said: &[&str]| {
        row(
            &[&["compare", "right.json", "right.json"], more].concat(),
            said,
        )
    };
    all_are_refused(&[
        compare(
            "other.json",
            &[
                "different adapters",
                "cpu (cpu)",
                "cpu (vulkan)",
                "--any-adapter",
            ],
        ),
        compare("none.json", &["in common", "--particles"]),
        compare(
            "right.json,other.json",
            &["different adapters", "--any-adapter"],
        ),
        row(
            &[
                "compare",
                "right.json",
                "right.json,other.json",
                "--any-adapter",
            ],
            &["several adapters on a side"],
        ),
        compare("missing.json", &["cannot read", "--> missing.json"]),
        compare(
            "right.json,missing.json",
            &["cannot read", "--> missing.json"],
        ),
        compare("right.json,,right.json", &["missing beside a comma"]),
        compare("folder", &["cannot read", "--> folder"]),
        row(&["compare", "right.json"], &["<NEW.json>"]),
        row(&["report"], &["<RECORD.json>"]),
        row(
            &["report", "missing.json"],
            &["cannot read", "--> missing.json"],
        ),
        row(
            &["report", "right.json", "--html", "folder"],
            &["--html needs a file"],
        ),
        row(
            &["report", "right.json", "--csv", "a", "--html", "a"],
            &["the same place"],
        ),
        row(
            &["report", "right.json", "--html", "./right.json"],
            &["right.json is a record", "written over"],
        ),
        row(
            &[
                "report",
                "right.json",
                "other.json",
                "--csv",
                "folder/../other.json",
            ],
            &["other.json is a record", "written over"],
        ),
        with(
            &["--json", "./right.json"],
            &["right.json is a record", "written over"],
        ),
        row(
            &[
                "compare",
                "right.json",
                "right.json,none.json",
                "--json",
                "none.json",
            ],
            &["none.json is a record", "written over"],
        ),
        row(&["schema", "bench", "--markdown"], &["no page in Markdown"]),
        row(&["schema", "bnech"], &["'bnech'", "bench"]),
        with(&["--fail-above", "-1"], &["'-1'", "from 0 to 1000, e.g. 5"]),
        with(
            &["--fail-above", "nan"],
            &["'nan'", "from 0 to 1000, e.g. 5"],
        ),
        with(&["--fail-above", ""], &["from 0 to 1000, e.g. 5"]),
        with(&["--json", "folder"], &["--json needs a file"]),
    ]);
}

#[cfg(target_os = "linux")]
#[test]
fn records_without_an_end_are_not_waited_for() {
    all_are_refused(&[
        Row::new(
            &["report", "/dev/zero"],
            &["larger than 32 MiB", "--> /dev/zero"],
        ),
        Row::new(
            &["compare", "/dev/zero", "/dev/zero"],
            &["larger than 32 MiB"],
        ),
    ]);
}

#[test]
fn many_measures_are_told_apart_in_time() {
    let one = &RECORD[RECORD.find("{\"name\"").expect("it is there")..RECORD.len() - 3];
    let many: Vec<String> = (0..100_000)
        .map(|at| one.replacen("\"copy\"", &format!("\"a{at}\""), 1))
        .collect();
    let mut text = RECORD.replace(one, &many.join(","));
    // The last is the first again.
    text = text.replacen("\"a99999\"", "\"a0\"", 1);
    all_are_refused(&[record(text, &["`a0` stands twice in micro"])]);
}
