//! `motes compare`: whether it got slower.

use std::path::{Path, PathBuf};

use super::collisions::{self, Input, Output};
use super::{CliError, note, print, refuse_folder};
use crate::bench::{self, CompareError, Record, RecordError};
use crate::output::write_whole;

/// Arguments of `motes compare`.
#[derive(Debug, clap::Args)]
pub(super) struct CompareArgs {
    /// Records before, made by `motes bench --json`; several with commas between
    #[arg(value_name = "OLD.json")]
    old: PathBuf,
    /// Records now; as many as before are taken as pairs, so measure in turns
    #[arg(value_name = "NEW.json")]
    new: PathBuf,
    /// End with exit code 1 if anything that matters is slower by more percent, its whole interval
    #[arg(long, value_name = "PERCENT", value_parser = parse_percent, allow_hyphen_values = true)]
    fail_above: Option<f64>,
    /// Compare records of different adapters, drivers or interfaces
    #[arg(long)]
    any_adapter: bool,
    /// Write the comparison as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

fn parse_percent(text: &str) -> Result<f64, String> {
    let percent = text
        .trim()
        .trim_end_matches('%')
        .trim_end()
        .parse::<f64>()
        .ok();
    percent
        .filter(|percent| (0.0..=1000.0).contains(percent))
        .ok_or_else(|| "percent are a number from 0 to 1000, e.g. 5".to_owned())
}

impl From<RecordError> for CliError {
    fn from(error: RecordError) -> Self {
        Self {
            message: error.to_string(),
            code: if error.is_users_fault { 2 } else { 3 },
        }
    }
}

impl From<CompareError> for CliError {
    fn from(error: CompareError) -> Self {
        Self {
            message: error.to_string(),
            code: 2,
        }
    }
}

pub(super) fn run(args: &CompareArgs) -> Result<u8, CliError> {
    let (old, new) = (files(&args.old)?, files(&args.new)?);
    if let Some(path) = &args.json {
        refuse_folder("--json", path)?;
        let inputs = old.iter().chain(&new);
        let inputs: Vec<Input> = inputs.map(|path| ("a record", path.clone())).collect();
        collisions::refuse(&[Output::file("--json", path)], &inputs)?;
    }
    let (old, new) = (records(&old)?, records(&new)?);
    let comparisons = bench::compare(&old, &new, args.any_adapter)?;
    let texts: Vec<String> = comparisons
        .iter()
        .map(|it| it.text(args.fail_above))
        .collect();
    if let Some(path) = &args.json {
        write_whole(
            path,
            bench::comparisons_json(&comparisons, args.fail_above).as_bytes(),
        )?;
        note!("motes: wrote {}: the comparison", path.display());
    }
    print(&texts.join("\n"))?;
    let fails = |percent| {
        comparisons
            .iter()
            .any(|it| !it.slower_by(percent).is_empty())
    };
    Ok(u8::from(args.fail_above.is_some_and(fails)))
}

/// One file, or several with commas between.
fn files(asked: &Path) -> Result<Vec<PathBuf>, CliError> {
    let text = asked.to_string_lossy();
    // A file may have a comma in its name.
    if asked.exists() || !text.contains(',') {
        return Ok(vec![asked.to_owned()]);
    }
    if text.split(',').any(str::is_empty) {
        return Err(CliError::usage(
            format!("a file's name is missing beside a comma in {text}"),
            "put a comma between two names and nowhere else, e.g. a.json,b.json",
        ));
    }
    Ok(text.split(',').map(PathBuf::from).collect())
}

/// The records of all these files.
fn records(files: &[PathBuf]) -> Result<Vec<Record>, CliError> {
    let mut records = Vec::new();
    for path in files {
        records.extend(bench::read_records(path)?);
    }
    Ok(records)
}
