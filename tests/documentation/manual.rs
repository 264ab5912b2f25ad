//! Completions and pages of the manual know every subcommand and every flag that `--help` knows.

use std::io::Write;
use std::process::{Command, Stdio};

use crate::{motes, printed};

/// Subcommands, as the program's help lists them.
fn subcommands() -> Vec<String> {
    let help = printed(&["--help"]);
    let (_, rest) = help.split_once("Commands:\n").expect("a list of them");
    let lines = rest.lines().take_while(|line| !line.is_empty());
    let names = lines.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names = names.filter(|name| !name.is_empty() && *name != "help");
    names.map(str::to_owned).collect()
}

/// Long flags that a subcommand's help has at the beginning of its lines.
fn flags(subcommand: &str) -> Vec<String> {
    let help = printed(&[subcommand, "--help"]);
    let flag = |line: &str| {
        let line = line.trim_start();
        let line = match line.split_once(", --") {
            Some((short, _)) if short.len() == 2 => &line[4..],
            _ => line,
        };
        let name = line.strip_prefix("--")?;
        let end = name.find(|c: char| c != '-' && !c.is_ascii_alphanumeric());
        Some(format!("--{}", &name[..end.unwrap_or(name.len())]))
    };
    help.lines().filter_map(flag).collect()
}

/// Whether the flag is there, and not as the beginning of a longer one.
fn has(text: &str, flag: &str) -> bool {
    let after = |rest: &str| rest.starts_with(|c: char| c == '-' || c.is_ascii_alphanumeric());
    text.split(flag).skip(1).any(|rest| !after(rest))
}

#[test]
fn each_subcommand_has_a_page_with_all_its_flags() {
    let folder = tempfile::tempdir().expect("there is room");
    let pages = folder.path().join("share/man1");
    assert_eq!(printed(&["man", "-o", &pages.to_string_lossy()]), "");
    let read = |name: &str| {
        let text = std::fs::read_to_string(pages.join(name));
        // The manual's language has hyphens escaped.
        text.unwrap_or_else(|e| panic!("{name}: {e}"))
            .replace("\\-", "-")
    };
    let subcommands = subcommands();
    assert!(subcommands.len() >= 7, "{subcommands:?}");
    let mut names = vec!["motes.1".to_owned()];
    let mut count = 0;
    for subcommand in &subcommands {
        let name = format!("motes-{subcommand}.1");
        let page = read(&name);
        assert!(
            page.contains(&format!(".TH motes-{subcommand} 1")),
            "{page}"
        );
        assert!(page.contains("EXIT STATUS"), "{page}");
        for flag in flags(subcommand) {
            assert!(has(&page, &flag), "{name} does not name {flag}:\n{page}");
            count += 1;
        }
        assert!(read("motes.1").contains(&format!("motes-{subcommand}(1)")));
        names.push(name);
    }
    assert!(count > 30, "{count}");
    let mut found: Vec<String> = std::fs::read_dir(&pages)
        .expect("it is a folder")
        .map(|entry| {
            entry
                .expect("readable")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    found.sort();
    names.sort();
    assert_eq!(found, names);
    assert_eq!(printed(&["man"]).replace("\\-", "-"), read("motes.1"));
}

#[test]
fn bash_takes_the_completions_and_they_know_every_flag() {
    let script = printed(&["completions", "bash"]);
    let mut bash = Command::new("bash")
        .arg("-n")
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("there is a bash");
    let mut input = bash.stdin.take().expect("it is piped");
    input.write_all(script.as_bytes()).expect("bash reads");
    drop(input);
    let ended = bash.wait_with_output().expect("bash ends");
    assert!(
        ended.status.success() && ended.stderr.is_empty(),
        "{ended:?}"
    );

    // It is asked as bash does at the Tab key.
    let ask = |line: &str| {
        let words = line.split(' ').map(|word| format!("'{word}'"));
        let words: Vec<String> = words.collect();
        let last = words.len() - 1;
        let asked = format!(
            "{script}\nCOMP_WORDS=({}); COMP_CWORD={last}; _motes motes {} {}; echo \"${{COMPREPLY[@]}}\"",
            words.join(" "),
            words[last],
            words[last - 1]
        );
        let ended = Command::new("bash").args(["-c", &asked]).output();
        let ended = ended.expect("there is a bash");
        assert!(ended.status.success(), "{ended:?}");
        String::from_utf8(ended.stdout).expect("text")
    };
    let offered = ask("motes ");
    for subcommand in subcommands() {
        assert!(offered.contains(&subcommand), "{subcommand}: {offered}");
        let offered = ask(&format!("motes {subcommand} -"));
        for flag in flags(&subcommand) {
            assert!(has(&offered, &flag), "{flag}: {offered}");
        }
    }
    for line in [
        "motes render two-fl",
        "motes check two-fl",
        "motes bench two-fl",
        "motes scenes --knobs two-fl",
    ] {
        assert!(has(&ask(line), "two-flocks-predators"), "{line}");
    }
}

#[test]
fn every_shell_has_completions_and_no_other_has() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = printed(&["completions", shell]);
        assert!(
            script.contains("no-clobber") && script.len() > 2000,
            "{shell}"
        );
        // Elvish and PowerShell get no values from the library that writes the scripts.
        if !["elvish", "powershell"].contains(&shell) {
            assert!(script.contains("two-flocks-predators"), "{shell}");
        }
        // Where a list stands alone, zsh offers no files.
        let alone = script.matches("]:SCENE:(bench-discs").count();
        assert!(shell != "zsh" || alone == 0, "{script}");
    }
    let help = printed(&["render", "--help"]);
    assert!(!help.contains("two-flocks"), "{help}");
    let ended = motes(&["completions", "tcsh"]);
    assert_eq!(ended.status.code(), Some(2));
    let message = String::from_utf8(ended.stderr).expect("text");
    assert!(
        message.contains("bash, elvish, fish, powershell, zsh"),
        "{message}"
    );
}

#[test]
fn a_place_for_pages_that_is_none_is_the_users_fault() {
    let folder = tempfile::tempdir().expect("there is room");
    let file = folder.path().join("file");
    std::fs::write(&file, "x").expect("there is room");
    let ended = motes(&["man", "-o", &file.to_string_lossy()]);
    assert_eq!(ended.status.code(), Some(2), "{ended:?}");
}
