//! The program in a folder of its own, with a small scene.

use std::path::PathBuf;
use std::process::{Command, Output};

use tempfile::TempDir;

/// Sparks that burn out to both sides of a plane, over a background, ten frames.
const SPARKS: &str = r#"
frames = 10
frame_rate = 30
seed = 7
layer = [{ name = "left", point = [0, 0, 0], normal = [1, 0, 0] }]

[image]
width = 161
height = 91
background = [0.02, 0.03, 0.11]

[camera]
position = [0, 0, 5]
target = [0, 0, 0]

[[system]]
name = "sparks"
initial_mean_parts = 60
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.05, var = 0.02 }
lifetime = { mean = 4, var = 1 }
color = [0.9, 0.5, 0.2]
size = 0.2
"#;

pub(crate) struct Studio {
    pub(crate) folder: TempDir,
}

impl Studio {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("sparks.toml"), SPARKS).unwrap();
        Self { folder }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `motes render sparks.toml` on the processor, to be run in the folder.
    pub(crate) fn render(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        command
            .args(["render", "sparks.toml", "--adapter", "cpu"])
            .args(arguments)
            .current_dir(self.folder.path())
            .env_remove("MOTES_ADAPTER");
        command
    }

    /// As [`Studio::render`], run, which must succeed.
    pub(crate) fn rendered(&self, arguments: &[&str]) {
        let (code, told) = ended(self.render(arguments).output());
        assert_eq!(code, 0, "{arguments:?}: {told}");
    }

    /// The files beside the scene, hidden ones too.
    pub(crate) fn files(&self) -> Vec<String> {
        let names = crate::names_in(self.folder.path());
        names.into_iter().filter(|n| n != "sparks.toml").collect()
    }
}

/// The exit code, and what was said on standard error.
pub(crate) fn ended(output: std::io::Result<Output>) -> (i32, String) {
    let output = output.unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(!told.contains("panicked"), "{told}");
    let code = output.status.code();
    (code.expect("it ends by itself, not by a signal"), told)
}
