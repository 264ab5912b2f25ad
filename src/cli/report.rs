//! `motes report`: records shown again, several on one page.

use std::path::PathBuf;

use super::collisions::{self, Input, Output};
use super::{CliError, print, refuse_folder};
use crate::bench::{self, Record};

/// Arguments of `motes report`.
#[derive(Debug, clap::Args)]
pub(super) struct ReportArgs {
    /// Records made by `motes bench --json`; those of one sweep, cut in pieces, are shown as one
    #[arg(value_name = "RECORD.json", required = true)]
    records: Vec<PathBuf>,
    /// Write one page with pictures of all records
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write all records as CSV, one line a measurement
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

pub(super) fn run(args: &ReportArgs) -> Result<u8, CliError> {
    let outputs = Output::given([("--html", &args.html), ("--csv", &args.csv)]);
    for output in &outputs {
        refuse_folder(output.what(), output.path())?;
    }
    let inputs = args.records.iter();
    let inputs: Vec<Input> = inputs.map(|path| ("a record", path.clone())).collect();
    collisions::refuse(&outputs, &inputs)?;
    let mut records: Vec<Record> = Vec::new();
    let mut files: Vec<String> = Vec::new();
    for path in &args.records {
        records.extend(bench::read_records(path)?);
        files.resize(records.len(), path.display().to_string());
    }
    let (records, files) = bench::merged(records, files);
    super::bench::reports(&records, &files, args.html.as_deref(), args.csv.as_deref())?;
    // Who asked for files has his answer in them.
    if args.html.is_none() && args.csv.is_none() {
        let tables: Vec<String> = records.iter().map(bench::table).collect();
        print(&tables.join("\n"))?;
    }
    Ok(0)
}
