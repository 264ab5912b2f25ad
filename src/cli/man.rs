//! `motes man`: the manual's pages, one for the program and one for each subcommand.

use std::path::PathBuf;

use clap::{Command, CommandFactory};
use clap_mangen::Man;

use super::{Cli, CliError, note, print};
use crate::output::write_whole;

/// Arguments of `motes man`.
#[derive(Debug, clap::Args)]
pub(super) struct ManArgs {
    /// Write motes.1 and a page for each subcommand into this folder [default: motes.1 to standard
    /// output]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// What the pages say of all commands alike.
const EXIT_STATUS: &str = ".SH \"EXIT STATUS\"
.TP
0
done
.TP
1
it ran, and the answer is no: an adapter differs (check), it got slower (compare)
.TP
2
the input is at fault: the command line, a scene, an adapter that is not there
.TP
3
the machine is: it has no driver to check, a device is lost, a disk is full, memory is out
.TP
129, 130, 143
stopped: the terminal was closed, by Ctrl\\-C, or by a signal to end
";

pub(super) fn run(args: &ManArgs) -> Result<u8, CliError> {
    let mut program = Cli::command().disable_help_subcommand(true);
    program.build();
    let Some(folder) = &args.output else {
        print(&page(&program)?)?;
        return Ok(0);
    };
    let mut count = 0;
    for command in program.get_subcommands().chain([&program]) {
        let path = folder.join(format!("{}.1", title(command)));
        write_whole(&path, page(command)?.as_bytes())?;
        count += 1;
    }
    note!("motes: wrote {}: {count} pages", folder.display());
    Ok(0)
}

/// `motes`, or `motes-render`.
fn title(command: &Command) -> &str {
    command.get_display_name().unwrap_or(command.get_name())
}

fn page(command: &Command) -> Result<String, CliError> {
    let source = format!("motes {}", env!("CARGO_PKG_VERSION"));
    let mut page = Vec::new();
    Man::new(command.clone())
        .source(source)
        .manual("Motes")
        .render(&mut page)
        .map_err(|e| CliError {
            message: format!("error: the page cannot be made: {e}"),
            code: 3,
        })?;
    Ok(String::from_utf8_lossy(&page).into_owned() + EXIT_STATUS)
}
