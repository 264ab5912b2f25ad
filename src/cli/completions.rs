//! `motes completions`: what has a shell complete commands at the Tab key.

use clap::CommandFactory;
use clap_complete::Shell;

use super::{Cli, CliError, print};
use crate::scene::BUILTIN;

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
    let script = String::from_utf8_lossy(&script).into_owned();
    print(&match args.shell {
        Shell::Zsh => with_files(&script),
        Shell::Fish => script + &offers(),
        _ => script,
    })?;
    Ok(0)
}

/// The names of the built-in scenes, with spaces between.
fn names() -> String {
    let names: Vec<&str> = BUILTIN.iter().map(|scene| scene.name).collect();
    names.join(" ")
}

/// The script for zsh with files beside the scenes, which a list by itself leaves no room for.
fn with_files(script: &str) -> String {
    let function = format!(
        "\n_motes_scenes() {{\n    _alternative 'scenes:built-in scene:({})' 'files:file:_files'\n}}\n",
        names()
    );
    let script = script.replace(&format!(":({})", names()), ":_motes_scenes");
    let (first, rest) = script.split_once('\n').unwrap_or_default();
    format!("{first}\n{function}{rest}")
}

/// What has fish offer scenes beside files, which it does by itself for options alone.
fn offers() -> String {
    let line = |command: &str| {
        format!(
            "complete -c motes -n \"__fish_motes_using_subcommand {command}\" -a \"{}\" -d 'built-in scene'\n",
            names()
        )
    };
    ["render", "check", "bench"].map(line).concat()
}
