//! The command line: parsed low, checked high, one file a subcommand.

mod adapters;
mod check;
mod completions;
mod man;
mod render;
mod scenes;
mod schema;

use std::io::{IsTerminal, Write};

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use crate::backend::BackendError;
use crate::output::OutputError;
use crate::plan::PlanError;
use crate::recording::RecordingError;
use crate::scene::SceneError;
use crate::simulation::SimulationError;

/// A headless-first particle laboratory: the same bits on every driver.
#[derive(Debug, Parser)]
#[command(
    name = "motes",
    version,
    max_term_width = 100,
    arg_required_else_help = true
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate a scene and draw it into pictures or an animation
    Render(render::RenderArgs),
    /// Compare an adapter with the processor, bit for bit
    Check(check::CheckArgs),
    /// List the adapters that scenes can run on, best first
    Adapters(adapters::AdaptersArgs),
    /// List the built-in scenes, or what can be changed in one
    Scenes(scenes::ScenesArgs),
    /// Describe every key of a scene file, for editors or for people
    Schema(schema::SchemaArgs),
    /// Write what has a shell complete commands at the Tab key
    Completions(completions::CompletionsArgs),
    /// Write the manual's pages
    Man(man::ManArgs),
}

/// What a command has to say when it cannot do its work, and with which exit code.
#[derive(Debug)]
pub struct CliError {
    /// A few lines: what, where, what would be right.
    pub message: String,
    /// 2: the input is at fault; 3: the machine is.
    pub code: u8,
}

impl CliError {
    /// The input is at fault.
    pub fn usage(what: impl std::fmt::Display, help: impl std::fmt::Display) -> Self {
        Self {
            message: format!("error: {what}\n  = help: {help}"),
            code: 2,
        }
    }
}

impl From<SceneError> for CliError {
    fn from(error: SceneError) -> Self {
        Self {
            message: error.to_string(),
            code: 2,
        }
    }
}

impl From<PlanError> for CliError {
    fn from(error: PlanError) -> Self {
        Self {
            message: error.to_string(),
            code: 2,
        }
    }
}

impl From<RecordingError> for CliError {
    fn from(error: RecordingError) -> Self {
        Self {
            message: error.to_string(),
            code: 2,
        }
    }
}

impl From<SimulationError> for CliError {
    fn from(error: SimulationError) -> Self {
        Self {
            message: error.to_string(),
            code: if error.is_users_fault() { 2 } else { 3 },
        }
    }
}

impl From<BackendError> for CliError {
    fn from(error: BackendError) -> Self {
        Self {
            message: error.to_string(),
            code: 3,
        }
    }
}

impl From<OutputError> for CliError {
    fn from(error: OutputError) -> Self {
        let code = if error.is_users_fault() { 2 } else { 3 };
        let text = error.to_string();
        let message = if text.starts_with("error:") {
            text
        } else {
            format!("error: {text}")
        };
        Self { message, code }
    }
}

/// Writes to standard output; a reader that has gone away is an error, not a panic.
pub(crate) fn print(text: &str) -> Result<(), CliError> {
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(|e| CliError {
            message: format!("error: standard output cannot be written: {e}"),
            code: 3,
        })
}

/// Runs the program with the process's arguments; the exit code.
pub fn main() -> u8 {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(e) => {
            // Help and version are no failures; a closed terminal cannot be told about.
            let _ = e.print();
            return u8::from(e.use_stderr()) * 2;
        }
    };
    let result = match cli.command {
        Command::Render(args) => render::run(args),
        Command::Check(args) => check::run(&args),
        Command::Adapters(args) => adapters::run(&args),
        Command::Scenes(args) => scenes::run(&args),
        Command::Schema(args) => schema::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
    };
    match result {
        Ok(code) => code,
        Err(e) => {
            let _ = writeln!(std::io::stderr(), "{}", e.message.trim_end());
            e.code
        }
    }
}

/// Whether the program would take this command line, its own name first. Nothing is run: scenes,
/// files and adapters are not looked for.
///
/// # Errors
/// The message that the program would print, with exit code 2; that of `--help` or `--version`, with 0.
pub fn parse(arguments: &[&str]) -> Result<(), CliError> {
    match Cli::try_parse_from(arguments) {
        Ok(_) => Ok(()),
        Err(e) => Err(CliError {
            message: e.to_string(),
            code: u8::from(e.use_stderr()) * 2,
        }),
    }
}

/// Progress with rate and time left on a terminal, nothing in a pipe.
pub(crate) fn progress_bar(frames: u64) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {per_sec}, {eta} left");
    let bar = ProgressBar::new(frames);
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
