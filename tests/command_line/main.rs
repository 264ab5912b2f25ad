//! The program as its users and their scripts meet it: arguments, exit codes, what goes to standard
//! output and what to standard error, and what lies on the disk afterwards. All on the processor, so
//! that a machine without a Vulkan driver passes too.

mod failing;
mod families;
mod meshes;
mod outputs;
mod readme;
mod refused;
mod remains;
mod render;
mod reports;
mod resume;
mod streams;
mod unwritable;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// A scene that takes milliseconds: its particles live 3 to 5 frames, so frames from the fifth on
/// can be entered late.
const SPARKS: &str = r#"title = "Sparks"
frames = 10
seed = 7

[image]
width = 32
height = 18

[camera]
position = [0, 0, 5]
target = [0, 0, 0]

[[system]]
name = "sparks"
initial_mean_parts = 20
var_parts = 8
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.05, var = 0.02 }
lifetime = { mean = 4, var = 1 }
color = [0.5, 0.3, 0.1]
size = 0.05
"#;

/// Frames of [`SPARKS`].
const FRAMES: u32 = 10;

/// A folder of its own with `sparks.toml` in it, in which the program is run.
struct Workshop {
    folder: TempDir,
}

/// The program with every signal as it is by default: tests that run in the background may ignore
/// some, and so would what they start.
fn heedful(program: &str) -> Command {
    if !cfg!(target_os = "linux") {
        return Command::new(program);
    }
    let mut command = Command::new("/usr/bin/env");
    command.args(["--default-signal=INT,HUP,TERM", program]);
    command
}

impl Workshop {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("the machine has room for temporary files");
        let workshop = Self { folder };
        workshop.write("sparks.toml", SPARKS);
        workshop
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        let path = self.path(name);
        let folder = path.parent().expect("it is in the folder");
        std::fs::create_dir_all(folder).expect("a temporary folder can be written");
        std::fs::write(path, text).expect("a temporary folder can be written");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name))
            .unwrap_or_else(|e| panic!("{name}: {e}; there are {:?}", self.files()))
    }

    /// The program, to be run in the folder, free of variables that would change its course.
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = heedful(env!("CARGO_BIN_EXE_motes"));
        command.args(arguments).current_dir(self.folder.path());
        command
            .env_remove("MOTES_ADAPTER")
            .env("NODEVICE_SELECT", "1");
        command
    }

    /// Runs the program.
    fn run(&self, arguments: &[&str]) -> Ended {
        Ended::of(self.command(arguments).output())
    }

    /// Renders `sparks.toml` on the processor with these further arguments, which must succeed.
    fn render(&self, arguments: &[&str]) -> Ended {
        let all = [&["render", "sparks.toml", "--adapter", "cpu"], arguments].concat();
        let ended = self.run(&all);
        assert_eq!(ended.code, 0, "motes {}\n{}", all.join(" "), ended.stderr);
        ended
    }

    /// Every file of the folder, hidden ones too, by its path in it, sorted.
    fn files(&self) -> Vec<String> {
        let mut files = Vec::new();
        let mut folders = vec![self.folder.path().to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(&folder).expect("a temporary folder can be read") {
                let path = entry.expect("a temporary folder can be read").path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    files.push(relative(&path, self.folder.path()));
                }
            }
        }
        files.sort();
        files
    }
}

fn relative(path: &Path, folder: &Path) -> String {
    path.strip_prefix(folder)
        .expect("it was found in there")
        .display()
        .to_string()
}

/// How a run of the program ended.
struct Ended {
    code: i32,
    stdout: String,
    stderr: String,
}

impl Ended {
    fn of(output: std::io::Result<Output>) -> Self {
        let output = output.expect("the program can be started");
        let text = |bytes| String::from_utf8(bytes).expect("the program writes UTF-8");
        let ended = Self {
            code: output
                .status
                .code()
                .expect("the program ends by itself, not by a signal"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        };
        assert!(
            !ended.stderr.contains("panicked") && !ended.stderr.contains("defect"),
            "the program panicked: {}",
            ended.stderr
        );
        ended
    }
}
