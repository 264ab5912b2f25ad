//! Scene texts changed at random: each is a scene or an error, never a panic, never more than ten
//! seconds or a gibibyte, for the scene and for its first frames in a small picture.
//!
//! The changed texts are a fixed sequence, told apart by number. They are tried in a child process,
//! so that one that ends it, or never comes to an end, can be named: the test's binary calls itself
//! with the range in a variable. `MOTES_FULL=1` tries more of them.

mod corpus;
mod mutate;
mod trial;

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Write as _};
use std::ops::Range;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use corpus::corpus;
use mutate::mutant;
use trial::Outcome;

/// Names the range to the child process: `FIRST..END`.
const RANGE: &str = "MOTES_MUTANTS";

/// No mutant may take longer.
const MOST_SECS: u64 = 10;

/// No mutant may take more memory.
const MOST_KIB: u64 = 1 << 20;

/// Findings after which the rest is left untried.
const MOST_FINDINGS: usize = 20;

#[test]
fn a_mutated_scene_is_a_scene_or_an_error_in_bounded_time_and_memory() {
    if let Ok(range) = std::env::var(RANGE) {
        return try_all(&range);
    }
    let full = std::env::var("MOTES_FULL").is_ok_and(|value| !value.is_empty() && value != "0");
    let count = if full { 100_000 } else { 3_000 };
    let mut tally = Tally::default();
    let mut findings = Vec::new();
    let mut next = 0;
    while next < count && findings.len() < MOST_FINDINGS {
        if let Err((number, what)) = watch(next..count, &mut tally) {
            let path = std::env::temp_dir().join(format!("motes-mutant-{number}.toml"));
            std::fs::write(&path, mutant(&corpus(), number)).expect("the temporary folder");
            findings.push(format!("mutant {number}, {}: {what}", path.display()));
            next = number + 1;
        } else {
            next = count;
        }
    }
    println!("{tally}");
    assert!(findings.is_empty(), "{}\n{tally}", findings.join("\n"));
    // All happen often, so that all are tested.
    for outcome in Outcome::ALL {
        let seen = tally.outcomes.get(outcome.word()).copied().unwrap_or(0);
        assert!(seen * 100 > count, "{seen} {}\n{tally}", outcome.word());
    }
}

/// What a run came to.
#[derive(Default)]
struct Tally {
    outcomes: BTreeMap<String, u64>,
    /// Milliseconds, and which.
    slowest: (u64, u64),
    /// KiB, and which.
    largest: (u64, u64),
}

impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ((ms, slowest), (kib, largest)) = (self.slowest, self.largest);
        write!(
            f,
            "{:?}, slowest {ms} ms (mutant {slowest}), largest {} MiB (mutant {largest})",
            self.outcomes,
            kib >> 10
        )
    }
}

/// In the child process: a line before each mutant, and one after it.
fn try_all(range: &str) {
    let (first, end) = range.split_once("..").expect("the range is A..B");
    let number = |text: &str| text.parse::<u64>().expect("the range's ends are numbers");
    let corpus = corpus();
    // Past the capture of what tests print.
    let mut out = std::io::stdout().lock();
    let mut say = |line: String| {
        writeln!(out, "\n{line}")
            .and_then(|()| out.flush())
            .expect("the parent listens");
    };
    for at in number(first)..number(end) {
        say(format!("begin {at}"));
        let text = mutant(&corpus, at);
        let done = trial::run(&text, at);
        say(format!(
            "done {at} {} {} {}",
            done.outcome.word(),
            done.ms,
            done.peak_kib
        ));
    }
}

/// Has a child process try the range; the first mutant that is a finding, and why.
fn watch(range: Range<u64>, tally: &mut Tally) -> Result<(), (u64, String)> {
    let mut child = child(&range);
    let lines = lines_of(&mut child);
    let mut begun = range.start;
    let found = loop {
        // A child that starts has more to do than a mutant.
        match lines.recv_timeout(Duration::from_secs(MOST_SECS)) {
            Ok(line) => {
                let words: Vec<&str> = line.split(' ').collect();
                let number = |at: usize| words[at].parse::<u64>().expect("a child counts");
                match words[0] {
                    "begin" => begun = number(1),
                    "done" => {
                        let (ms, kib) = (number(3), number(4));
                        *tally.outcomes.entry(words[2].to_owned()).or_default() += 1;
                        tally.slowest = tally.slowest.max((ms, begun));
                        tally.largest = tally.largest.max((kib, begun));
                        if kib > MOST_KIB {
                            break Some(format!("it took {} MiB", kib >> 10));
                        }
                    }
                    _ => {}
                }
            }
            Err(RecvTimeoutError::Timeout) => break Some(format!("more than {MOST_SECS} s")),
            Err(RecvTimeoutError::Disconnected) => {
                let status = child.wait().expect("a child ends");
                break (!status.success()).then(|| format!("it ended the process: {status}"));
            }
        }
    };
    // It may have ended by itself.
    let _ = child.kill();
    let _ = child.wait();
    found.map_or(Ok(()), |what| Err((begun, what)))
}

/// This very test in another process, with a bound on its memory where there is a shell for that.
fn child(range: &Range<u64>) -> Child {
    let binary = std::env::current_exe().expect("a test has a binary");
    let name = "a_mutated_scene_is_a_scene_or_an_error_in_bounded_time_and_memory";
    let mut command = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        // Address space is more than memory: stacks and arenas of threads, and code.
        let limit = MOST_KIB * 3;
        shell.args(["-c", &format!("ulimit -v {limit}; exec \"$0\" \"$@\"")]);
        shell.arg(binary);
        shell
    } else {
        Command::new(binary)
    };
    command
        .args(["--exact", name, "--nocapture", "--test-threads", "1"])
        .env(RANGE, format!("{}..{}", range.start, range.end))
        .stdout(Stdio::piped())
        .spawn()
        .expect("the test's binary can be started again")
}

/// Its lines, while it runs.
fn lines_of(child: &mut Child) -> Receiver<String> {
    let out = child.stdout.take().expect("it is piped");
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        for line in BufReader::new(out).lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                return;
            }
        }
    });
    receiver
}
