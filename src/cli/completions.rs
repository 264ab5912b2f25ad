//! `motes completions`: what has a shell complete commands at the Tab key.

use clap::CommandFactory;
use clap_complete::Shell;

use super::{Cli, CliError, print};

/// Arguments of `motes completions`.
#[derive(Debug, clap::Args)]
pub(super) struct CompletionsArgs {
    /// The shell that is to read it
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

pub(super) fn run(args: &CompletionsArgs) -> Result<u8, CliError> {
    // Into memory first: written directly, a closed pipe would be a panic.
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "motes", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(0)
}
