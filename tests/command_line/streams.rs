//! Standard output is for what was asked for, standard error for all else.

use std::fs::OpenOptions;

use crate::{Ended, Workshop};

#[test]
fn render_tells_on_standard_error_where_it_ran_and_what_it_wrote() {
    let here = Workshop::new();
    let ended = here.render(&["-o", "a.gif"]);
    assert_eq!(ended.stdout, "");
    let lines: Vec<_> = ended.stderr.lines().collect();
    // No progress bar in a pipe, so these two lines are all.
    assert_eq!(lines.len(), 2, "{}", ended.stderr);
    assert!(
        lines[0].starts_with("motes: sparks on cpu ("),
        "{}",
        lines[0]
    );
    let wrote = "motes: wrote a.gif: 10 frames of 32x18 pixels in ";
    assert!(
        lines[1].starts_with(wrote) && lines[1].ends_with(" s"),
        "{}",
        lines[1]
    );
}

#[test]
fn without_a_vulkan_driver_auto_takes_the_processor_and_says_so() {
    let here = Workshop::new();
    let driverless = |arguments: &[&str]| {
        let mut command = here.command(arguments);
        for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"] {
            command.env_remove(variable);
        }
        Ended::of(
            command
                .env("VK_DRIVER_FILES", "/nonexistent/icd.json")
                .output(),
        )
    };
    let ended = driverless(&["render", "sparks.toml", "-o", "auto.gif"]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("motes: sparks on cpu ("),
        "{}",
        ended.stderr
    );
    here.render(&["-o", "cpu.gif"]);
    assert_eq!(here.read("auto.gif"), here.read("cpu.gif"));
    let ended = driverless(&["adapters"]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(ended.stdout.starts_with("* cpu\n"), "{}", ended.stdout);
}

#[test]
fn the_variable_means_the_same_as_the_argument_and_the_argument_wins() {
    let here = Workshop::new();
    let with_variable = |value: &str, arguments: &[&str]| {
        Ended::of(here.command(arguments).env("MOTES_ADAPTER", value).output())
    };
    let ended = with_variable("CPU", &["render", "sparks.toml", "-o", "a.gif"]);
    assert!(ended.stderr.contains(" on cpu "), "{}", ended.stderr);
    let arguments = ["render", "sparks.toml", "-o", "a.gif", "--adapter", "cpu"];
    let ended = with_variable("no-such-adapter", &arguments);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
}

#[test]
fn lists_go_to_standard_output_alone() {
    let here = Workshop::new();
    let scenes = here.run(&["scenes"]);
    assert_eq!((scenes.code, scenes.stderr.as_str()), (0, ""));
    for name in ["fireworks", "fountain", "million"] {
        assert!(
            scenes.stdout.lines().any(|line| line.starts_with(name)),
            "{}",
            scenes.stdout
        );
    }
    let adapters = here.run(&["adapters"]);
    assert_eq!(adapters.code, 0, "{}", adapters.stderr);
    assert!(
        adapters.stdout.contains(" cpu\n    processor, cpu, motes "),
        "{}",
        adapters.stdout
    );
    let json = here.run(&["adapters", "--json"]);
    assert!(
        json.stdout.starts_with("[\n") && json.stdout.ends_with("]\n"),
        "{}",
        json.stdout
    );
    assert!(
        json.stdout
            .contains("{\"name\": \"cpu\", \"driver\": \"motes "),
        "{}",
        json.stdout
    );
}

#[test]
fn help_and_version_go_to_standard_output_and_no_arguments_is_a_wrong_use() {
    let here = Workshop::new();
    let version = here.run(&["--version"]);
    assert_eq!((version.code, version.stderr.as_str()), (0, ""));
    assert_eq!(
        version.stdout,
        concat!("motes ", env!("CARGO_PKG_VERSION"), "\n")
    );
    let help = here.run(&["render", "--help"]);
    assert_eq!((help.code, help.stderr.as_str()), (0, ""));
    let arguments = [
        "--output",
        "--frames",
        "--frame",
        "--size",
        "--seed",
        "--adapter",
        "--stats",
        "--dump",
        "--dump-dir",
        "--set",
        "--inputs",
    ];
    for argument in arguments {
        assert!(
            help.stdout.contains(argument),
            "no {argument} in\n{}",
            help.stdout
        );
    }
    let nothing = here.run(&[]);
    assert_eq!((nothing.code, nothing.stdout.as_str()), (2, ""));
    assert!(
        nothing.stderr.contains("Usage: motes"),
        "{}",
        nothing.stderr
    );
}

#[test]
fn a_built_in_scene_can_be_shown_saved_and_rendered_from_the_file() {
    let here = Workshop::new();
    let shown = here.run(&["scenes", "--show", "fountain"]);
    assert_eq!((shown.code, shown.stderr.as_str()), (0, ""));
    here.write("mine.toml", &shown.stdout);
    let small = ["--adapter", "cpu", "--size", "64x36", "--frame", "40", "-o"];
    for (scene, out) in [("fountain", "builtin.png"), ("mine.toml", "file.png")] {
        let ended = here.run(&[&["render", scene], &small[..], &[out]].concat());
        assert_eq!(ended.code, 0, "{}", ended.stderr);
    }
    assert_eq!(here.read("builtin.png"), here.read("file.png"));
}

#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_cannot_be_written_is_told_with_exit_code_3() {
    let here = Workshop::new();
    let full = OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .expect("Linux has /dev/full");
    let ended = Ended::of(here.command(&["scenes"]).stdout(full).output());
    assert_eq!(ended.code, 3, "{}", ended.stderr);
    assert!(
        ended
            .stderr
            .starts_with("error: standard output cannot be written"),
        "{}",
        ended.stderr
    );
}

#[cfg(target_os = "linux")]
#[test]
fn standard_error_that_nobody_reads_stops_nothing() {
    let here = Workshop::new();
    let script = |redirected: &str| {
        let program = env!("CARGO_BIN_EXE_motes");
        let run = format!("{program} render sparks.toml --adapter cpu -o a.gif {redirected}");
        let mut shell = std::process::Command::new("bash");
        shell.args(["-c", &run]).current_dir(here.path(""));
        shell.output().expect("there is a shell").status.code()
    };
    here.render(&["-o", "whole.gif"]);
    for redirected in [
        "2>/dev/full",
        "2>&-",
        "2> >(true); sleep 0.1; test -e a.gif",
    ] {
        assert_eq!(script(redirected), Some(0), "{redirected}");
        assert!(here.read("a.gif") == here.read("whole.gif"), "{redirected}");
        std::fs::remove_file(here.path("a.gif")).expect("it was there");
    }
    // Nor does it hide an error.
    assert_eq!(script("--frames 3 2>/dev/full"), Some(2));
}

#[cfg(unix)]
#[test]
fn a_picture_goes_into_a_pipe_that_somebody_reads() {
    let here = Workshop::new();
    let script = format!(
        "mkfifo p.png; (cat p.png >copy.png) & {} render sparks.toml --adapter cpu -o p.png \
         --frame 5; wait",
        env!("CARGO_BIN_EXE_motes")
    );
    let mut shell = std::process::Command::new("timeout");
    shell
        .args(["20", "bash", "-c", &script])
        .current_dir(here.path(""));
    let ended = Ended::of(shell.output());
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    here.render(&["-o", "file.png", "--frame", "5"]);
    assert!(here.read("copy.png") == here.read("file.png"));
}

/// `script`, of util-linux, gives the program a terminal.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_shows_progress_with_its_rate_and_the_time_left() {
    let here = Workshop::new();
    let command = format!(
        "{} render sparks.toml --adapter cpu -o a.gif",
        env!("CARGO_BIN_EXE_motes")
    );
    let mut terminal = std::process::Command::new("script");
    terminal
        .args(["--quiet", "--return", "--command", &command, "/dev/null"])
        .current_dir(here.path(""))
        .env("TERM", "xterm")
        .stdin(std::process::Stdio::null());
    let ended = Ended::of(terminal.output());
    assert_eq!(ended.code, 0, "{}", ended.stdout);
    let drawn: Vec<&str> = ended.stdout.split('\r').collect();
    let bar = drawn
        .iter()
        .find(|line| line.contains("/10 frames, "))
        .unwrap_or_else(|| panic!("no bar in {drawn:?}"));
    assert!(
        bar.contains(" a second, ") && bar.contains("s left"),
        "{bar:?}"
    );
    // The bar is wiped before what stays.
    let last = drawn.iter().rfind(|line| !line.trim().is_empty());
    let last = last.expect("something is told").trim();
    assert!(
        last.starts_with("\u{1b}[2Kmotes: wrote a.gif: 10 frames"),
        "{last:?}"
    );
}
