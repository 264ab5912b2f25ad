//! What the command says and writes when the adapter under test is wrong, or fails.

use std::fs;
use std::path::Path;
use std::process::Command;

use clap::Parser;

use super::side::Side;
use super::{CheckArgs, check_all, jobs};
use crate::backend::{Backend, BackendError, Living};
use crate::cpu::CpuBackend;
use crate::layout::FrameStats;
use crate::plan::{FrameInputs, Plan, Population, Stage};

/// What is wrong with a processor.
#[derive(Clone, Copy, Debug)]
pub(super) enum Defect {
    /// The last pixel of frame 2 has its lowest bit turned.
    LastPixel,
    /// The device is lost in frame 2.
    Lost,
}

impl Defect {
    pub(super) fn start(self, plan: &Plan) -> Result<Box<dyn Backend>, BackendError> {
        Ok(Box::new(Wrong {
            cpu: CpuBackend::new(plan, None)?,
            defect: self,
            frame: 0,
        }))
    }
}

struct Wrong {
    cpu: CpuBackend,
    defect: Defect,
    frame: u32,
}

impl Wrong {
    fn is_wrong(&self) -> bool {
        self.frame == 2
    }
}

impl Backend for Wrong {
    fn adapter_name(&self) -> String {
        self.cpu.adapter_name()
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn run_stage(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.frame = inputs.frame.frame;
        if self.is_wrong() && matches!(self.defect, Defect::Lost) {
            return Err(BackendError::DeviceLost("gone & <away>".into()));
        }
        self.cpu.run_stage(stage, inputs)
    }

    fn restore(&mut self, living: &Living<'_>, recent: &[FrameInputs]) -> Result<(), BackendError> {
        self.cpu.restore(living, recent)
    }

    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        let mut words = self.cpu.read(buffer)?;
        if self.is_wrong() && buffer == "image" {
            words
                .last_mut()
                .expect("a picture has pixels")
                .clone_from(&0xff00_0001);
        }
        Ok(words)
    }

    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        self.cpu.take_statistics()
    }

    fn population_digest(&mut self, population: Population) -> Result<u64, BackendError> {
        self.cpu.population_digest(population)
    }

    fn image_digest(&mut self) -> Result<u64, BackendError> {
        Ok(crate::cpu::digest(&self.read("image")?, 1))
    }
}

const SCENE: &str = r#"
frames = 5
[image]
width = 16
height = 8
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "ball"
initial_mean_parts = 10
generation_shape = { kind = "sphere", radius = 0.3 }
speed = 0
lifetime = 3
color = [0.2, 0.3, 0.4]
size = 0.2
"#;

#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    check: CheckArgs,
}

/// Checks the scene in a new folder, which the reports go to.
fn check(name: &str, defect: Defect) -> (Result<u8, (u8, String)>, std::path::PathBuf) {
    let folder = std::env::temp_dir().join(format!("motes-check's {name}-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("writable");
    let path = |file: &str| folder.join(file).to_str().expect("UTF-8").to_owned();
    fs::write(path("ball.toml"), SCENE).expect("writable");
    let (scene, json, junit, saved) = (
        path("ball.toml"),
        path("r.json"),
        path("r.xml"),
        path("saved"),
    );
    let arguments = [
        "motes", &scene, "--json", &json, "--junit", &junit, "--save", &saved,
    ];
    let args = Arguments::parse_from(arguments).check;
    let jobs = jobs(&args).map_err(|e| e.message).expect("a good scene");
    let result = check_all(&args, &jobs, Side::Wrong(defect), Side::Cpu);
    (result.map_err(|e| (e.code, e.message)), folder)
}

fn text(folder: &Path, file: &str) -> String {
    fs::read_to_string(folder.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

fn assert_tells(text: &str, told: &[&str]) {
    for told in told {
        assert!(text.contains(told), "no `{told}` in\n{text}");
    }
}

#[test]
fn a_wrong_adapter_is_exit_code_1_and_stands_in_every_report() {
    let (result, folder) = check("wrong", Defect::LastPixel);
    assert_eq!(result, Ok(1));
    let json = text(&folder, "r.json");
    assert_tells(
        &json,
        &[
            r#""adapter": "Wrong \"<&'\u0001>\" adapter""#,
            r#""against": "cpu""#,
            r#""equal": false"#,
            r#""difference": {"frame": 2, "sign": "digest of the image: expected "#,
            r#""stage": "resolve", "buffer": "image", "differing_words": 1, "record": 127, "field": "", "word": 127"#,
            r#""expected": "0xff000000", "got": "0xff000001", "expected_float": null, "got_float": null"#,
            "ball-frame-0002-resolve",
        ],
    );
    let junit = text(&folder, "r.xml");
    assert_tells(
        &junit,
        &[
            "tests=\"1\" failures=\"1\" errors=\"0\"",
            "Wrong &quot;&lt;&amp;&apos;\u{fffd}&gt;&quot; adapter",
            "<failure message=\"differs at frame 2, stage resolve, buffer image, record 127 (pixel 15, 7)",
            "</failure>",
        ],
    );
    let readme = text(&folder, "saved/ball-frame-0002-resolve/README.txt");
    assert_tells(
        &readme,
        &[
            "record 127 (pixel 15, 7): expected 0xff000000 (4278190080), got 0xff000001",
            "--frames 5 --adapter 'auto' --against 'cpu'",
            "Compared with:      cpu (motes ",
        ],
    );
    // Read as a shell reads it: an apostrophe in the scene's path ends no text early.
    let command = readme
        .lines()
        .find_map(|line| Some(line.split_once("motes check ")?.1));
    let command = format!("set -- {}; echo \"$1\"", command.expect("it is told"));
    let said = Command::new("sh").args(["-c", &command]).output();
    let scene = folder.join("ball.toml");
    let said = String::from_utf8(said.expect("there is a shell").stdout).expect("UTF-8");
    assert_eq!(Path::new(said.trim_end()), scene);
    fs::remove_dir_all(&folder).expect("removable");
}

#[test]
fn a_lost_device_is_exit_code_3_and_stands_in_every_report() {
    let (result, folder) = check("lost", Defect::Lost);
    let (code, message) = result.expect_err("the device is lost");
    assert_eq!(code, 3);
    assert_tells(&message, &["gone & <away>"]);
    assert_tells(
        &text(&folder, "r.json"),
        &[r#""equal": false"#, r#""error": "error: the device"#],
    );
    assert_tells(
        &text(&folder, "r.xml"),
        &[
            "failures=\"0\" errors=\"1\"",
            "<error message=\"the machine failed\">",
            "gone &amp; &lt;away&gt;",
        ],
    );
    assert!(!folder.join("saved").exists());
    fs::remove_dir_all(&folder).expect("removable");
}
