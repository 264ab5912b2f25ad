//! `motes schema`: every key of a scene file, or of a record of measurements, for editors or for people.

use std::path::PathBuf;

use super::{CliError, note, print};
use crate::bench::record_schema;
use crate::output::write_whole;
use crate::scene::schema::{json_schema, reference_page};

/// Arguments of `motes schema`.
#[derive(Debug, clap::Args)]
pub(super) struct SchemaArgs {
    /// Of which file: a scene, or the record that `motes bench --json` writes
    #[arg(value_enum, default_value_t = File::Scene, value_name = "FILE")]
    of: File,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// A page in Markdown for people instead of JSON Schema for editors; of scenes only
    #[arg(long)]
    markdown: bool,
}

/// A file that has a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum File {
    Scene,
    Bench,
}

pub(super) fn run(args: &SchemaArgs) -> Result<u8, CliError> {
    let text = match (args.of, args.markdown) {
        (File::Scene, true) => reference_page(),
        (File::Scene, false) => json_schema(),
        (File::Bench, false) => record_schema().to_owned(),
        (File::Bench, true) => {
            return Err(CliError::usage(
                "there is no page in Markdown of the record that bench writes",
                "leave --markdown out: each key of the JSON Schema has its description",
            ));
        }
    };
    match &args.output {
        Some(path) => {
            write_whole(path, text.as_bytes())?;
            note!("motes: wrote {}", path.display());
        }
        None => print(&text)?,
    }
    Ok(0)
}
