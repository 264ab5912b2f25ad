//! Records as files: JSON, one record by itself or several in an array.

use std::collections::HashSet;
use std::fmt;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::Value;

use super::fits::{Sweep, sweeps};
use super::readable::Readable;
use super::record::{Measure, Record, SCHEMA};
use super::spread::Spread;
use super::units::shortened;
use crate::output::{OutputError, write_whole};

/// A file that holds no records.
#[derive(Debug)]
pub struct RecordError {
    /// The file, as the user wrote it.
    pub path: PathBuf,
    /// What is wrong, and where.
    pub problem: String,
    /// What would be right.
    pub help: String,
    /// Whether another file would help; else the machine could not read this one.
    pub is_users_fault: bool,
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (path, problem, help) = (self.path.display(), &self.problem, &self.help);
        write!(f, "error: {problem}\n  --> {path}\n  = help: {help}")
    }
}

impl std::error::Error for RecordError {}

/// Characters of a problem, at most.
const MOST_LETTERS: usize = 400;

/// No measurement takes longer, ms: thirty years.
const MOST_MS: f64 = 1e12;

/// Bytes of a file at most; a record has some ten thousand.
const MOST_BYTES: u64 = 32 << 20;

const HELP: &str = "give a file that `motes bench --json FILE` wrote";

/// The records of a file: one, or an array of them.
///
/// # Errors
/// The user's fault: no such file, not JSON, no record, one of another version, or numbers that no
/// measurement gives. The machine's: the file cannot be read.
pub fn read_records(path: &Path) -> Result<Vec<Record>, RecordError> {
    use io::ErrorKind::{IsADirectory, NotADirectory, NotFound, PermissionDenied};
    let read = std::fs::File::open(path).and_then(|file| {
        let mut bytes = Vec::new();
        // It may be a pipe, or grow: one byte more than allowed is enough to know.
        file.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    });
    let bytes = read.map_err(|error| RecordError {
        path: path.to_owned(),
        problem: format!("cannot read the record: {error}"),
        help: match error.kind() {
            PermissionDenied => "give a file that you may read".to_owned(),
            _ => HELP.to_owned(),
        },
        is_users_fault: matches!(error.kind(), NotFound | IsADirectory | NotADirectory),
    })?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(RecordError {
            path: path.to_owned(),
            problem: format!("the record is larger than {} MiB", MOST_BYTES >> 20),
            help: HELP.to_owned(),
            is_users_fault: true,
        });
    }
    parse_records(&bytes).map_err(|(problem, help)| RecordError {
        path: path.to_owned(),
        problem,
        help,
        is_users_fault: true,
    })
}

/// The records in this JSON; else the problem, and what would be right.
///
/// # Errors
/// See [`read_records`].
pub fn parse_records(json: &[u8]) -> Result<Vec<Record>, (String, String)> {
    // A strange file has strange names; they are not to reach a terminal as they are.
    let no_record = |problem: String| (printable(&problem), HELP.to_owned());
    // Some editors begin a text with a byte order mark.
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    if json.trim_ascii().is_empty() {
        return Err(no_record("the file is empty".to_owned()));
    }
    // First the syntax, then the version, then the keys: each fault is called by its name.
    let value: Value = serde_json::from_slice(json)
        .map_err(|error| no_record(format!("this is not JSON: {error}")))?;
    let is_array = value.is_array();
    let objects = match &value {
        Value::Array(items) => items.as_slice(),
        one => std::slice::from_ref(one),
    };
    for object in objects {
        let Value::Object(keys) = object else {
            let problem = "this JSON is no record of `motes bench`";
            return Err(no_record(problem.to_owned()));
        };
        match keys.get("schema") {
            Some(schema) if *schema == SCHEMA => {}
            Some(schema) => {
                return Err((
                    printable(&format!(
                        "a record with schema {schema}, and this program reads schema {SCHEMA}"
                    )),
                    "read it with the Motes that wrote it, or measure again".to_owned(),
                ));
            }
            None => {
                return Err(no_record(
                    "the key `schema` is missing, so this is no record".to_owned(),
                ));
            }
        }
    }
    let records = match is_array {
        true => serde_json::from_slice(json),
        false => serde_json::from_slice(json).map(|record| vec![record]),
    };
    let records: Vec<Record> =
        records.map_err(|error| no_record(format!("in this record: {error}")))?;
    if records.is_empty() {
        return Err(no_record("the file holds no record".to_owned()));
    }
    for record in &records {
        check(record).map_err(no_record)?;
    }
    Ok(records)
}

/// Without control characters, and not too long.
fn printable(text: &str) -> String {
    let letters = text
        .chars()
        .map(|it| if it.is_control() { ' ' } else { it });
    shortened(&letters.collect::<String>(), MOST_LETTERS)
}

/// Refuses numbers that no measurement gives, names that stand for two things, and text that is none.
fn check(record: &Record) -> Result<(), String> {
    check_texts(record)?;
    check_measures("micro", &record.micro)?;
    if let Some(ms) = &record.dispatch_ms {
        check_spread(ms).map_err(|fault| format!("`dispatch_ms` {fault}"))?;
    }
    let mut met = HashSet::new();
    for run in &record.runs {
        let place = format!("{} at {} particles", run.scene, run.particles);
        if !met.insert((&run.scene, run.particles)) {
            return Err(format!("`{place}` stands twice in this record"));
        }
        for (name, ms) in [
            ("frame_ms", &run.frame_ms),
            ("step_ms", &run.step_ms),
            ("draw_ms", &run.draw_ms),
        ] {
            check_spread(ms).map_err(|fault| format!("`{name}` of {place} {fault}"))?;
        }
        let beside = [("copy_ms", &run.copy_ms), ("dispatch_ms", &run.dispatch_ms)];
        for (name, ms) in beside {
            let fault = |fault| format!("`{name}` of {place} {fault}");
            ms.as_ref().map_or(Ok(()), check_spread).map_err(fault)?;
        }
        check_measures(&place, &run.passes)?;
    }
    Ok(())
}

fn check_texts(record: &Record) -> Result<(), String> {
    let Record {
        motes,
        adapter,
        driver,
        backend,
        os,
        cpu,
        ..
    } = record;
    let optional = [&record.commit, &record.driver_version];
    let measures = record.runs.iter().flat_map(|run| &run.passes);
    let measures = measures.chain(&record.micro);
    let mut texts: Vec<&str> = vec![motes, adapter, driver, backend, os, cpu];
    texts.extend(optional.into_iter().flatten().map(String::as_str));
    texts.extend(
        measures
            .flat_map(|it| [Some(it.name.as_str()), it.note.as_deref()])
            .flatten(),
    );
    texts.extend(
        record
            .options
            .iter()
            .flat_map(|(key, value)| [key.as_str(), value]),
    );
    texts.extend(record.runs.iter().map(|run| run.scene.as_str()));
    let warnings = record.runs.iter().flat_map(|run| &run.warnings);
    texts.extend(warnings.chain(&record.warnings).map(String::as_str));
    match texts.iter().find(|text| text.contains(char::is_control)) {
        Some(text) => Err(format!("control characters in the text `{text}`")),
        None => Ok(()),
    }
}

fn check_measures(place: &str, measures: &[Measure]) -> Result<(), String> {
    let mut met = HashSet::new();
    for measure in measures {
        let Measure {
            name, ms, floor_ms, ..
        } = measure;
        if !met.insert(name) {
            return Err(format!("`{name}` stands twice in {place}"));
        }
        check_spread(ms).map_err(|fault| format!("`{name}` of {place} {fault}"))?;
        let is_time = |ms: f64| (0.0..=MOST_MS).contains(&ms);
        if let Some(floor) = floor_ms.filter(|floor| !is_time(*floor)) {
            return Err(format!("`{name}` of {place} has a floor of {floor} ms"));
        }
    }
    Ok(())
}

fn check_spread(ms: &Spread) -> Result<(), String> {
    let told = [ms.p10, ms.median, ms.p90];
    if let Some(wrong) = told.iter().chain(&ms.samples).find(|it| **it < 0.0) {
        return Err(format!("took {wrong} ms, and no time is negative"));
    }
    if let Some(wrong) = told.iter().chain(&ms.samples).find(|it| **it > MOST_MS) {
        return Err(format!("took {wrong:e} ms, which nobody has waited for"));
    }
    match told.is_sorted() {
        true => Ok(()),
        false => Err(format!("has p10, median and p90 out of order: {told:?}")),
    }
}

/// A record as it is written: with what follows from it, which is reckoned anew whenever it is read.
#[derive(Serialize)]
struct Written<'a> {
    #[serde(flatten)]
    record: &'a Record,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    lines: Vec<Sweep<'a>>,
}

/// The records as JSON, keys in their documented order: one by itself, several in an array.
pub fn records_json(records: &[Record]) -> String {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Readable::default());
    let written = |record| Written {
        record,
        lines: sweeps(&record.runs),
    };
    let records: Vec<Written<'_>> = records.iter().map(written).collect();
    let done = match records.as_slice() {
        [record] => record.serialize(&mut serializer),
        records => records.serialize(&mut serializer),
    };
    done.expect("a record has text for keys, and memory takes all that is written");
    let mut text = String::from_utf8(bytes).expect("JSON is UTF-8");
    text.push('\n');
    text
}

/// Writes the records, whole or not at all; folders that are missing above are created.
///
/// # Errors
/// The user's fault: a path that cannot be a file. The machine's: it cannot be written.
pub fn write_records(path: &Path, records: &[Record]) -> Result<(), OutputError> {
    write_whole(path, records_json(records).as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{Clock, Part, Run};

    fn record() -> Record {
        let pass = Measure {
            part: Some(Part::Step),
            ..Measure::new(
                "advance",
                vec![2.0, 1.0, 4.0],
                Clock::Wall,
                10,
                640,
                Some(3.0),
            )
        };
        Record {
            schema: SCHEMA,
            adapter: "cpu \"quoted\"".to_owned(),
            backend: "cpu".to_owned(),
            copy_kernel_gb_per_s: Some(3.0),
            micro: vec![Measure::new(
                "copy_kernel",
                vec![0.5],
                Clock::Wall,
                1,
                64,
                None,
            )],
            runs: vec![Run {
                scene: "million".to_owned(),
                particles: 10,
                image_px: Some([16, 9]),
                passes: vec![pass],
                ..Run::default()
            }],
            ..Record::default()
        }
    }

    #[test]
    fn a_record_comes_back_as_it_was_written() {
        let one = record();
        let two = Record {
            adapter: "llvmpipe".to_owned(),
            ..record()
        };
        for records in [vec![one.clone()], vec![one, two]] {
            let json = records_json(&records);
            assert_eq!(parse_records(json.as_bytes()), Ok(records), "{json}");
        }
    }

    #[test]
    fn samples_stay_on_a_line_and_keys_in_their_order() {
        let json = records_json(&[record()]);
        assert!(json.contains("\"samples\": [2.0, 1.0, 4.0]\n"), "{json}");
        assert!(
            json.starts_with("{\n  \"schema\": 1,\n  \"motes\": "),
            "{json}"
        );
        assert!(json.ends_with("  ]\n}\n"), "{json}");
        let places = [
            "\"micro\": [\n    {\n",
            "\"runs\": [",
            "\"passes\": [\n        {",
        ];
        let found: Vec<Option<usize>> = places.iter().map(|it| json.find(it)).collect();
        assert!(
            found.is_sorted() && !found.contains(&None),
            "{found:?} {json}"
        );
    }

    #[test]
    fn unknown_keys_are_passed_over_and_the_least_record_is_read() {
        let json = r#"{"schema": 1, "adapter": "a", "driver": "d", "backend": "b", "exact": true,
            "copy_kernel_gb_per_s": 2, "copy_buffer_gb_per_s": null, "weather": {"rain": [1]},
            "micro": [], "runs": [{"scene": "s", "particles": 5, "frames": 2, "peak_memory_bytes": 1,
            "frame_ms": {"median": 2, "p10": 1, "p90": 3, "mode": 2}, "passes": [],
            "step_ms": {"median": 2, "p10": 1, "p90": 3}, "draw_ms": {"median": 0, "p10": 0, "p90": 0}}]}"#;
        let records = parse_records(json.as_bytes()).expect("it has every key of the contract");
        assert_eq!(records[0].runs[0].frame_ms.samples_or_median(), [2.0]);
    }
}
