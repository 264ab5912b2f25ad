//! The command line: parsed low, checked high, one file a subcommand.

mod adapters;
mod bench;
mod check;
mod collisions;
mod compare;
mod completions;
mod interrupt;
mod man;
mod names;
mod render;
mod report;
mod scenes;
mod schema;
#[cfg(feature = "view")]
mod view;

use std::collections::HashSet;
use std::io::{IsTerminal, Write};
use std::path::Path;

use clap::parser::ValueSource;
use clap::{ArgMatches, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
use indicatif::{ProgressBar, ProgressState, ProgressStyle};

use crate::backend::BackendError;
use crate::output::OutputError;
use crate::plan::PlanError;
use crate::recording::RecordingError;
use crate::scene::{Loader, Scene, SceneError, Set};
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
    /// Play with a scene in a window: look around, turn its knobs, save what you made
    #[cfg(feature = "view")]
    View(view::ViewArgs),
    /// Compare an adapter with the processor, bit for bit
    Check(check::CheckArgs),
    /// Measure what each pass of a frame costs on an adapter
    Bench(bench::BenchArgs),
    /// Tell whether it got slower, from records that bench made
    Compare(compare::CompareArgs),
    /// Show records that bench made: tables, a page with pictures, CSV
    Report(report::ReportArgs),
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

/// The variable that means the same as `--adapter`.
const ADAPTER: &str = "MOTES_ADAPTER";

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

    /// The machine is at fault.
    pub fn machine(what: impl std::fmt::Display, help: impl std::fmt::Display) -> Self {
        Self {
            code: 3,
            ..Self::usage(what, help)
        }
    }

    /// A plan that cannot be, of that scene with these changes.
    fn of_plan(error: &PlanError, loader: Loader, scene: &str, sets: &[Set]) -> Self {
        let PlanError { message, help, key } = error;
        // What came through a pipe is gone.
        let draft = key.as_ref().and_then(|_| loader.draft(scene, sets).ok());
        let placed = draft.zip(key.as_ref());
        if let Some(error) = placed.and_then(|(draft, key)| draft.error_at(key, message, help)) {
            return error.into();
        }
        Self {
            message: format!("error: {message}\n  --> {scene}\n  = help: {help}"),
            code: 2,
        }
    }
}

/// Tells something on standard error. Work goes on if nobody reads it.
macro_rules! note {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($text)*);
    }};
}
use note;

/// Tells what was mended in the files of these scenes, each note once.
fn tell_notes<'a>(scenes: impl IntoIterator<Item = &'a Scene>) {
    let mut told = HashSet::new();
    for text in scenes.into_iter().flat_map(Scene::notes) {
        if told.insert(text.clone()) {
            note!("motes: {text}");
        }
    }
}

impl From<SceneError> for CliError {
    fn from(error: SceneError) -> Self {
        Self {
            message: error.to_string(),
            code: if error.is_users_fault() { 2 } else { 3 },
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
        .map_err(|e| unprinted(&e))
}

/// Standard output cannot be written.
fn unprinted(error: &std::io::Error) -> CliError {
    let help = match error.kind() {
        std::io::ErrorKind::BrokenPipe => "what reads it has ended; write to a file and read that",
        std::io::ErrorKind::StorageFull => "make room, or write to another disk",
        _ => "direct it to a file that can be written",
    };
    CliError::machine(format!("standard output cannot be written: {error}"), help)
}

/// Refuses a folder, or a place below a file, where `argument` needs a file to write.
pub(crate) fn refuse_folder(argument: &str, path: &Path) -> Result<(), CliError> {
    let above = path.ancestors().skip(1).find(|it| it.exists());
    let problem = if path.is_dir() {
        format!(
            "{argument} needs a file, and {} is a folder",
            path.display()
        )
    } else if let Some(file) = above.filter(|it| it.is_file()) {
        format!(
            "{} is a file, so nothing can be written below it",
            file.display()
        )
    } else {
        return Ok(());
    };
    Err(CliError::usage(
        problem,
        format!("give {argument} the name of a file, in a folder"),
    ))
}

/// Reads a command line, its own name first.
fn read<T>(arguments: impl IntoIterator<Item = T>) -> Result<Cli, clap::Error>
where
    T: Into<std::ffi::OsString> + Clone,
{
    let mut command = Cli::command();
    let matches = command.try_get_matches_from_mut(arguments)?;
    let given = matches.subcommand().map(|(_, given)| given);
    // Whereas an empty variable of the environment is one that is not set.
    let is_empty = |given: &ArgMatches, name: &str| {
        let typed = given.try_get_one::<String>(name).ok().flatten();
        typed.is_some_and(|it| it.trim().is_empty())
            && given.value_source(name) == Some(ValueSource::CommandLine)
    };
    for name in ["adapter", "against"] {
        if given.is_some_and(|given| is_empty(given, name)) {
            let what =
                format!("--{name} has no name; give auto, cpu, or part of an adapter's name");
            return Err(command.error(clap::error::ErrorKind::InvalidValue, what));
        }
    }
    Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
}

/// Whether it is the environment and not what was typed that is no text.
fn is_of_the_variable(error: &clap::Error) -> bool {
    error.kind() == clap::error::ErrorKind::InvalidUtf8
        && std::env::args_os().all(|argument| argument.to_str().is_some())
        && std::env::var_os(ADAPTER).is_some_and(|it| it.to_str().is_none())
}

/// Runs the program with the process's arguments; the exit code.
pub fn main() -> u8 {
    interrupt::outlive_limits();
    let cli = match read(std::env::args_os()) {
        Ok(cli) => cli,
        Err(e) if is_of_the_variable(&e) => {
            note!(
                "error: the variable {ADAPTER} of the environment is not UTF-8\n  = help: let it be auto, \
                 cpu, or part of an adapter's name, or unset it"
            );
            return 2;
        }
        Err(e) => {
            // Help and version are no failures; a closed terminal cannot be told about.
            let printed = e.print().and_then(|()| std::io::stdout().flush());
            return match printed {
                _ if e.use_stderr() => 2,
                Ok(()) => 0,
                Err(error) => {
                    let error = unprinted(&error);
                    note!("{}", error.message);
                    error.code
                }
            };
        }
    };
    let result = match cli.command {
        Command::Render(args) => render::run(args),
        Command::Check(args) => check::run(&args),
        #[cfg(feature = "view")]
        Command::View(args) => view::run(&args),
        Command::Bench(args) => bench::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Report(args) => report::run(&args),
        Command::Adapters(args) => adapters::run(&args),
        Command::Scenes(args) => scenes::run(&args),
        Command::Schema(args) => schema::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
    };
    match result {
        Ok(code) => code,
        Err(e) => {
            note!("{}", e.message.trim_end());
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
    match read(arguments) {
        Ok(_) => Ok(()),
        Err(e) => Err(CliError {
            message: e.to_string(),
            code: u8::from(e.use_stderr()) * 2,
        }),
    }
}

/// Progress with rate and time left on a terminal, nothing in a pipe; `of_what`, e.g. `frames`.
pub(crate) fn progress_bar(count: u64, of_what: &'static str) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}, {rate}, {eta} left").map(
        |style| {
            style.with_key(
                "rate",
                |state: &ProgressState, out: &mut dyn std::fmt::Write| {
                    // A bar that cannot be drawn is no loss.
                    let _ = write!(out, "{:.1} a second", state.per_sec());
                },
            )
        },
    );
    let bar = ProgressBar::new(count).with_message(of_what);
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
