//! Vulkan's validation layer has nothing to say about a whole run, and would be heard if it had.
//! The program runs in a process of its own, for the layer is chosen by variables that drivers'
//! loader reads once.

use std::process::Command;

/// Small, with every kind of stage: births, deaths, pages, streaks, rectangles.
const SCENE: &str = r#"
frames = 6
[image]
width = 64
height = 48
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "streaks"
initial_mean_parts = 200
var_parts = 50
generation_shape = { kind = "circle", radius = 1 }
ejection_angle_degrees = 30
speed = { mean = 0.1, var = 0.05 }
lifetime = { mean = 3, var = 2 }
color = [0.1, 0.2, 0.3]
size = { mean = 0.05, var = 0.04 }
particle_shape = "streak"
intensity_threshold = 0.05
[[system]]
name = "squares"
initial_mean_parts = 1000
generation_shape = { kind = "rectangle", length = 1, width = 2 }
speed = 0.1
lifetime = 4
color = [0.1, 0.05, 0.01]
size = 0.03
particle_shape = "rectangle"
"#;

/// The layer's settings: all messages to standard output, hazards between dispatches among them.
const SETTINGS: &str = "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG
khronos_validation.report_flags = error,warn,perf,info
khronos_validation.log_filename = stdout
khronos_validation.enables = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT";

/// What the layer says once in every run, so that its silence can be told from its absence.
const STATUS: &str = "Khronos Validation Layer Active";

/// First lines of the layer's messages about a whole run, with `more` of its checks enabled.
fn messages(more: &str) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("scene.toml"), SCENE).expect("the scene can be written");
    let settings = format!("{SETTINGS}{more}\n");
    std::fs::write(at("vk_layer_settings.txt"), settings).expect("the settings can be written");
    let output = Command::new(env!("CARGO_BIN_EXE_motes"))
        .arg("render")
        .arg(at("scene.toml"))
        .args(["--frames", "0..6", "--adapter", "llvmpipe", "--stats"])
        .arg(at("statistics.csv"))
        .arg("-o")
        .arg(at("frames"))
        .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation")
        .env("VK_LAYER_SETTINGS_PATH", folder.path())
        .output()
        .expect("the program starts");
    let [stdout, stderr] =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{stdout}\n{stderr}");
    assert!(
        at("frames")
            .read_dir()
            .expect("frames have been written")
            .count()
            >= 6
    );
    stdout
        .lines()
        .filter(|line| line.contains("msgNum:"))
        .map(str::to_owned)
        .collect()
}

#[test]
fn the_validation_layer_is_active_and_silent() {
    let messages = messages("");
    assert!(
        messages.iter().any(|message| message.contains(STATUS)),
        "the layer is not there: install vulkan-validationlayers; {messages:#?}"
    );
    let others: Vec<_> = messages
        .iter()
        .filter(|message| !message.contains(STATUS))
        .collect();
    assert!(others.is_empty(), "{others:#?}");
}

/// The layer's advice on best practices finds fault with wgpu itself.
#[test]
fn a_message_of_the_layer_would_be_seen() {
    let messages = messages(",VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT");
    let is_warning = |message: &&String| message.contains("Validation Warning");
    assert!(
        messages.iter().filter(is_warning).count() > 0,
        "{messages:#?}"
    );
}
