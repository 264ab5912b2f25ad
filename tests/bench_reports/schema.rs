//! The record's JSON Schema and the record say the same.

use std::collections::BTreeSet;

use jsonschema::Validator;
use motes::bench::{Clock, Record, Spread, fits, parse_records, record_schema, records_json};
use serde_json::{Value, json};

use crate::synthetic::LLVMPIPE;

fn schema() -> Value {
    serde_json::from_str(record_schema()).expect("it is JSON")
}

fn validator() -> Validator {
    jsonschema::draft202012::new(&schema()).expect("it is a schema")
}

/// A record with every key.
fn full() -> Record {
    let mut record = LLVMPIPE.record(&[1000, 10_000, 100_000, 1_000_000]);
    record.began_unix_secs = Some(1);
    record.driver_version = Some("1".into());
    record.warnings.push("a".into());
    let run = &mut record.runs[0];
    run.copy_kernel_gb_per_s = Some(8.0);
    run.warnings.push("a".into());
    run.passes[0].note = Some("a".into());
    run.passes[0].dispatches = Some(2);
    run.passes[0].floor_ms = Some(0.01);
    run.copy_in_cache_gb_per_s = Some(9.0);
    run.copy_buffer_gb_per_s = Some(20.0);
    let spread = || Some(Spread::new(vec![0.1, 0.2], Clock::Wall));
    run.copy_ms = spread();
    run.dispatch_ms = spread();
    record.dispatch_ms = spread();
    let run = &mut record.runs[0];
    run.wall_ms = Some(Spread::new(vec![1.0, 2.0], Clock::Wall));
    record
}

fn value(record: &Record) -> Value {
    let written = records_json(std::slice::from_ref(record));
    serde_json::from_str(&written).expect("a record is JSON")
}

/// Keys of an object in the record, and those that the schema has for it.
fn keys_agree(object: &Value, name: &str) {
    let keys = |value: &Value| -> BTreeSet<String> {
        let object = value.as_object().expect("it is an object");
        object.keys().cloned().collect()
    };
    let described = &schema()["$defs"][name]["properties"];
    assert_eq!(keys(object), keys(described), "{name}");
    for (key, property) in described.as_object().expect("it is an object") {
        let words = property["description"].as_str().unwrap_or_default();
        assert!(words.ends_with('.'), "{key} of {name} is not described");
    }
}

#[test]
fn every_key_is_described_and_every_description_is_of_a_key() {
    let record = value(&full());
    keys_agree(&record, "record");
    let run = &record["runs"][0];
    keys_agree(run, "run");
    let pass = &run["passes"][0];
    keys_agree(pass, "measure");
    keys_agree(&pass["ms"], "spread");
    let sweep = &record["lines"][0];
    keys_agree(sweep, "sweep");
    keys_agree(&sweep["fits"][0], "fit");
}

/// Readers take the runs, and nobody has to believe lines that somebody wrote beside them.
#[test]
fn a_sweep_is_written_as_lines_that_follow_from_its_runs() {
    let sweep = LLVMPIPE.record(&[10_000, 1_000_000, 100_000]);
    let written = value(&sweep);
    assert_eq!(written["lines"][0]["scene"], json!("million"));
    assert_eq!(
        written["lines"][0]["counts"],
        json!([10_000, 100_000, 1_000_000])
    );
    let runs: Vec<_> = sweep.runs.iter().collect();
    let fits = fits(&runs);
    let lines = written["lines"][0]["fits"].as_array().expect("an array");
    assert_eq!(lines.len(), fits.len());
    for (line, fit) in lines.iter().zip(&fits) {
        assert_eq!(line["name"], json!(fit.name));
        assert_eq!(line["part"].is_null(), fit.part.is_none());
        assert_eq!(
            [&line["a_ms"], &line["b_ns"], &line["off"]],
            [&json!(fit.a_ms), &json!(fit.b_ns), &json!(fit.off)]
        );
        assert_eq!(line["steps_ns"], json!(fit.steps_ns));
    }
    let mut wrong = written.clone();
    wrong["lines"][0]["fits"][0]["b_ns"] = json!(1e9);
    let read = parse_records(wrong.to_string().as_bytes()).expect("a record");
    assert_eq!(value(&read[0]), written);
    let two = value(&LLVMPIPE.record(&[10_000, 100_000]));
    assert!(two.get("lines").is_none(), "two counts make any line");
}

#[test]
fn what_is_written_is_valid_and_so_are_keys_to_come() {
    let validator = validator();
    let (one, two) = (full(), LLVMPIPE.record(&[1000]));
    for records in [vec![one.clone()], vec![one.clone(), two]] {
        let json: Value = serde_json::from_str(&records_json(&records)).expect("it is JSON");
        assert!(validator.is_valid(&json));
    }
    let mut later = value(&one);
    later["weather"] = json!("rain");
    later["runs"][0]["passes"][0]["ms"]["mode"] = json!(3);
    assert!(validator.is_valid(&later));
    assert!(parse_records(later.to_string().as_bytes()).is_ok());
}

/// One key at a time: taken away, or made another kind of thing. Schema and reader refuse alike.
#[test]
fn schema_and_reader_refuse_the_same() {
    let validator = validator();
    let record = value(&full());
    let places = [
        "",
        "/runs/0",
        "/runs/0/passes/0",
        "/runs/0/passes/0/ms",
        "/micro/1",
        "/runs/1/frame_ms",
    ];
    let mut refused = 0;
    for place in places {
        let object = record
            .pointer(place)
            .and_then(Value::as_object)
            .expect("it is an object");
        for key in object.keys() {
            for wrong in [
                None,
                Some(json!({"a": 1})),
                Some(json!("text")),
                Some(json!(-1)),
                Some(Value::Null),
            ] {
                let mut changed = record.clone();
                let object = changed
                    .pointer_mut(place)
                    .and_then(Value::as_object_mut)
                    .expect("it is an object");
                match &wrong {
                    Some(wrong) => drop(object.insert(key.clone(), wrong.clone())),
                    None => drop(object.remove(key)),
                }
                let taken = parse_records(changed.to_string().as_bytes());
                // The reader takes more where nothing is misread: null for a key that may be missing, rates
                // that it does not use, lines that follow from runs; and it alone knows that percentiles have an order.
                let reader_is_looser = matches!(&wrong, Some(Value::Null))
                    || key.ends_with("gb_per_s")
                    || key == "share_of_copy"
                    || key == "lines"
                    || key == "cpu_seconds"
                    || (key == "options" && wrong.is_some())
                    || wrong.is_none();
                let is_valid = validator.is_valid(&changed);
                let in_order = !matches!(key.as_str(), "p10" | "median" | "p90");
                if is_valid && in_order {
                    assert!(
                        taken.is_ok(),
                        "the reader refuses {place}/{key} = {wrong:?}: {taken:?}"
                    );
                }
                if taken.is_ok() && !reader_is_looser {
                    assert!(is_valid, "the schema refuses {place}/{key} = {wrong:?}");
                }
                refused += u32::from(!is_valid);
            }
        }
    }
    assert!(refused > 150, "{refused}");
}
