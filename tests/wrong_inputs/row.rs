//! One wrong input, and how the program is run on it.

use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::SPARKS;

/// No answer may take longer.
const MOST_TIME: Duration = Duration::from_secs(10);

/// No answer may be longer, bytes.
const MOST_TEXT: usize = 2500;

/// A wrong input.
pub(crate) struct Row {
    pub(crate) arguments: Vec<String>,
    /// Files beside `sparks.toml`; a name that ends in a slash is a folder's.
    pub(crate) files: Vec<(&'static str, Vec<u8>)>,
    /// 2: the input is at fault; 3: the machine is.
    pub(crate) code: i32,
    /// What the answer must have.
    pub(crate) said: Vec<String>,
}

impl Row {
    /// A command line that is the input's fault.
    pub(crate) fn new(arguments: &[&str], said: &[&str]) -> Self {
        let owned = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect();
        Self {
            arguments: owned(arguments),
            files: Vec::new(),
            code: 2,
            said: owned(said),
        }
    }

    /// The rendering of `sparks.toml` on the processor with more arguments.
    pub(crate) fn render(more: &[&str], said: &[&str]) -> Self {
        let all = [&["render", "sparks.toml", "--adapter", "cpu"], more].concat();
        Self::new(&all, said)
    }

    /// The rendering of this text, called `w.toml`.
    pub(crate) fn scene(text: impl Into<Vec<u8>>, said: &[&str]) -> Self {
        let all = ["render", "w.toml", "--adapter", "cpu", "-o", "a.gif"];
        Self::new(&all, said).file("w.toml", text)
    }

    pub(crate) fn file(mut self, name: &'static str, text: impl Into<Vec<u8>>) -> Self {
        self.files.push((name, text.into()));
        self
    }

    pub(crate) fn machine(self) -> Self {
        Self { code: 3, ..self }
    }

    /// What is not as it should be; `None` if all is.
    pub(crate) fn fault(&self) -> Option<String> {
        let here = Workshop::new(&self.files);
        let before = here.files();
        let arguments: Vec<&str> = self.arguments.iter().map(String::as_str).collect();
        let ended = here.run(&arguments);
        let text = &ended.stderr;
        let mut faults = Vec::new();
        let mut must = |is: bool, otherwise: String| {
            if !is {
                faults.push(otherwise);
            }
        };
        match ended.code {
            Some(code) => must(code == self.code, format!("exit code {code}")),
            None => must(false, format!("no end within {MOST_TIME:?}, or a signal")),
        }
        let is_error = |line: &str| line.starts_with("error: ");
        must(text.lines().any(is_error), "no `error: `".to_owned());
        for words in &self.said {
            must(text.contains(words), format!("`{words}` is not said"));
        }
        let right = [
            "a value is required for '",
            "= help: ",
            "tip: ",
            "Usage: ",
            ", e.g. ",
        ];
        let has_advice = right.iter().any(|mark| text.contains(mark));
        must(has_advice, "nothing says what would be right".to_owned());
        let inner = ["panicked", "defect", "RUST_BACKTRACE", "Error {", "src/"];
        let leaks = inner.iter().find(|words| text.contains(*words));
        must(leaks.is_none(), format!("{leaks:?}"));
        let is_strange = |letter: char| letter.is_control() && letter != '\n';
        must(!text.contains(is_strange), "control characters".to_owned());
        must(text.len() <= MOST_TEXT, format!("{} bytes", text.len()));
        must(ended.stdout.is_empty(), format!("printed {}", ended.stdout));
        let after = here.files();
        must(after == before, format!("{after:?} were {before:?}"));
        let shown: String = text.chars().take(MOST_TEXT).collect();
        (!faults.is_empty()).then(|| {
            let arguments = arguments.join(" ");
            let what = faults.join("\n  ");
            format!("motes {arguments:.200}\n  {what}\nanswered\n{shown}")
        })
    }
}

/// A folder with `sparks.toml` and other files in it, in which the program is run.
pub(crate) struct Workshop(TempDir);

impl Workshop {
    pub(crate) fn new(files: &[(&'static str, Vec<u8>)]) -> Self {
        let folder = tempfile::tempdir().expect("the machine has room for temporary files");
        let write = |name: &str, bytes: &[u8]| {
            let path = folder.path().join(name);
            let done = match name.ends_with('/') {
                true => std::fs::create_dir_all(path),
                false => std::fs::write(path, bytes),
            };
            done.expect("a temporary folder can be written");
        };
        write("sparks.toml", SPARKS.as_bytes());
        for (name, bytes) in files {
            write(name, bytes);
        }
        Self(folder)
    }

    /// The program, to be run in the folder, free of variables that would change its course.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        command
            .args(arguments)
            .current_dir(self.0.path())
            .env_remove("MOTES_ADAPTER")
            .env("NODEVICE_SELECT", "1");
        command
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Ended {
        Ended::of(self.command(arguments).stdout(Stdio::piped()))
    }

    /// A path in the folder.
    pub(crate) fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.path().join(name).is_file()
    }

    /// All that is in the folder, with sizes.
    fn files(&self) -> Vec<(String, u64)> {
        fn walk(folder: &Path, found: &mut Vec<(String, u64)>) {
            for entry in std::fs::read_dir(folder).expect("a temporary folder can be read") {
                let path = entry.expect("a temporary folder can be read").path();
                let bytes = path.metadata().map_or(0, |of| of.len());
                match path.is_dir() {
                    true => found.push((path.display().to_string(), 0)),
                    false => found.push((path.display().to_string(), bytes)),
                }
                if path.is_dir() {
                    walk(&path, found);
                }
            }
        }
        let mut found = Vec::new();
        walk(self.0.path(), &mut found);
        found.sort();
        found
    }
}

/// How a run of the program ended.
pub(crate) struct Ended {
    /// `None` where it had to be ended, or a signal did.
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Ended {
    /// Runs a command to its end, or to the end of its time.
    pub(crate) fn of(command: &mut Command) -> Self {
        let mut child = command
            .stdin(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program can be started");
        // Answers are short, so that they wait in the pipes.
        let begun = Instant::now();
        let status = loop {
            match child.try_wait().expect("a child can be waited for") {
                Some(status) => break Some(status),
                None if begun.elapsed() > MOST_TIME => {
                    child.kill().expect("a child can be ended");
                    child.wait().expect("a child can be waited for");
                    break None;
                }
                None => std::thread::sleep(Duration::from_millis(2)),
            }
        };
        let text = |pipe: Option<&mut dyn Read>| {
            let mut bytes = Vec::new();
            if let Some(pipe) = pipe {
                pipe.read_to_end(&mut bytes).expect("a pipe can be read");
            }
            String::from_utf8_lossy(&bytes).into_owned()
        };
        Self {
            code: status.and_then(|status| status.code()),
            stdout: text(child.stdout.as_mut().map(|pipe| pipe as &mut dyn Read)),
            stderr: text(child.stderr.as_mut().map(|pipe| pipe as &mut dyn Read)),
        }
    }
}
