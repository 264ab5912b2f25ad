//! `motes schema`: every key of a scene file, for editors or for people.

use std::path::PathBuf;

use super::{CliError, print};
use crate::output::write_whole;
use crate::scene::schema::{json_schema, reference_page};

/// Arguments of `motes schema`.
#[derive(Debug, clap::Args)]
pub(super) struct SchemaArgs {
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// A page in Markdown for people instead of JSON Schema for editors
    #[arg(long)]
    markdown: bool,
}

pub(super) fn run(args: &SchemaArgs) -> Result<u8, CliError> {
    let text = if args.markdown {
        reference_page()
    } else {
        json_schema()
    };
    match &args.output {
        Some(path) => write_whole(path, text.as_bytes())?,
        None => print(&text)?,
    }
    Ok(0)
}
