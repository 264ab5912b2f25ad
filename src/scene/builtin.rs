//! The scenes that the program carries with their files, and the text of a scene by name or path.

use std::borrow::Cow;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use super::SceneError;
use super::error::{nearest, shortened};

/// A scene that is part of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltinScene {
    /// What the user calls it; the stem of its file in `scenes/`.
    pub name: &'static str,
    /// Its TOML.
    pub text: &'static str,
}

macro_rules! builtin {
    ($($name:literal),* $(,)?) => {
        &[$(BuiltinScene {
            name: $name,
            text: include_str!(concat!("../../scenes/", $name, ".toml")),
        }),*]
    };
}

/// Every built-in scene, by name.
pub const BUILTIN: &[BuiltinScene] = builtin![
    "bench-discs",
    "bench-flames",
    "bench-free",
    "bench-points",
    "bench-streaks",
    "bench-wind-3",
    "billow",
    "billows",
    "boids-alignment",
    "boids-cohesion",
    "boids-free",
    "boids-separation",
    "bonfire",
    "bounce-constrain",
    "bounce-repel",
    "bounce-wrap",
    "bronze-knot",
    "burning-cube",
    "burning-house",
    "burning-letters",
    "burning-log",
    "burning-torus",
    "campfire",
    "candle",
    "candle-wind",
    "candles",
    "crossed-flocks",
    "ember-knot",
    "explosion",
    "explosion-lines",
    "fireworks",
    "fireworks-green-blue",
    "fireworks-multicolored",
    "fireworks-red",
    "flames-compare",
    "flames-rejected",
    "flock",
    "flock-million",
    "forest",
    "fountain",
    "genesis",
    "genesis-engulfed",
    "genesis-impact",
    "genesis-limb",
    "genesis-rings",
    "genesis-wall",
    "million",
    "murmuration",
    "paper",
    "predators",
    "predators-ignored",
    "ribbons",
    "rorschach",
    "rorschach-inverted",
    "rorschach-three",
    "school",
    "smoke-ring",
    "sparks-in-wind",
    "spill",
    "torch",
    "torch-moving",
    "two-flocks",
    "two-flocks-predators",
    "wall-spread",
    "white-sand",
    "wood-grain",
];

/// Files that built-in scenes name, by their paths.
pub const BUILTIN_FILES: &[(&str, &[u8])] = &[
    (
        "meshes/forest.obj",
        include_bytes!("../../scenes/meshes/forest.obj"),
    ),
    (
        "meshes/house.obj",
        include_bytes!("../../scenes/meshes/house.obj"),
    ),
    (
        "meshes/paper.obj",
        include_bytes!("../../scenes/meshes/paper.obj"),
    ),
    (
        "meshes/torch.obj",
        include_bytes!("../../scenes/meshes/torch.obj"),
    ),
    (
        "meshes/torus-knot.obj",
        include_bytes!("../../scenes/meshes/torus-knot.obj"),
    ),
    (
        "meshes/volcano.obj",
        include_bytes!("../../scenes/meshes/volcano.obj"),
    ),
];

/// Names of a folder that are looked through for one like another, at most.
const MOST_NAMES: usize = 10_000;

/// Bytes of a scene file at most.
const MAX_BYTES: u64 = 1 << 20;

/// A scene's TOML.
pub(super) struct SceneText {
    pub(super) text: Cow<'static, str>,
    /// What errors call it.
    pub(super) file: String,
    /// The scene's name.
    pub(super) name: String,
}

impl SceneText {
    /// Whether the program carries it.
    pub(super) fn is_builtin(&self) -> bool {
        matches!(self.text, Cow::Borrowed(_))
    }
}

/// The text of a scene by name or by path, as [`load`](super::load()) has it.
pub(super) fn text_of(name_or_path: &str) -> Result<SceneText, SceneError> {
    if is_path(name_or_path) {
        return Ok(SceneText {
            text: read(name_or_path)?.into(),
            file: name_or_path.to_owned(),
            name: scene_name(name_or_path),
        });
    }
    let Some(scene) = BUILTIN.iter().find(|scene| scene.name == name_or_path) else {
        return Err(unknown(name_or_path));
    };
    Ok(SceneText {
        text: scene.text.into(),
        file: format!("scenes/{}.toml", scene.name),
        name: scene.name.to_owned(),
    })
}

fn is_path(name_or_path: &str) -> bool {
    let is_toml = Path::new(name_or_path)
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    is_toml || name_or_path.contains(['/', std::path::MAIN_SEPARATOR])
}

fn unknown(name: &str) -> SceneError {
    let file = format!("{name}.toml");
    if Path::new(&file).is_file() {
        return SceneError::general(
            format!("there is no built-in scene `{}`", shortened(name)),
            None,
            format!("did you mean {}, which is a file here?", shortened(&file)),
        );
    }
    if Path::new(name).is_dir() {
        return SceneError::general(
            format!("`{}` is a folder, and a scene is a file", shortened(name)),
            None,
            "a path to a scene's TOML file; `motes scenes` lists the built-in scenes",
        );
    }
    let close = nearest(name, BUILTIN.iter().map(|scene| scene.name));
    let meant = match close.as_slice() {
        [] => like(name),
        close => format!("did you mean {}? ", close.join(" or ")),
    };
    let help = format!(
        "{meant}`motes scenes` lists the built-in scenes; a file is a path that ends in .toml, such as ./my.toml"
    );
    SceneError::general(
        format!("there is no scene `{}`", shortened(name)),
        None,
        help,
    )
}

fn read(path: &str) -> Result<String, SceneError> {
    let refuse = |what: String, help: &str| SceneError::general(what, Some(path), help);
    let expected = "a path to a scene's TOML file; `motes scenes` lists the built-in scenes";
    let cannot = |error: std::io::Error| {
        let help = match error.kind() {
            std::io::ErrorKind::PermissionDenied => "a file that you may read".to_owned(),
            std::io::ErrorKind::NotFound => like(path) + expected,
            _ => expected.to_owned(),
        };
        refuse(format!("the scene file cannot be read: {error}"), &help)
    };
    if Path::new(path).is_dir() {
        let what = "this is a folder, and a scene is a file".to_owned();
        return Err(refuse(what, expected));
    }
    let file = File::open(path).map_err(cannot)?;
    let mut bytes = Vec::new();
    // One byte more than allowed is enough to know, whatever the file's size claims to be.
    let mut limited = file.take(MAX_BYTES + 1);
    limited.read_to_end(&mut bytes).map_err(cannot)?;
    if bytes.len() as u64 > MAX_BYTES {
        let what = "the scene file is larger than 1 MiB".to_owned();
        return Err(refuse(
            what,
            "a scene's TOML file, which is a few kilobytes",
        ));
    }
    let not_text = |bytes: &[u8], end: usize, what: String| {
        // Everything before the first bad byte is itself in the lossy text, byte for byte.
        let text = String::from_utf8_lossy(bytes);
        let help = "save the file as UTF-8";
        SceneError::located(what, (path, &text, Some(1)), end..end + 1, help)
    };
    // UTF-16 is UTF-8 if it has no mark at its beginning, but not without these.
    if let Some(zero) = bytes.iter().position(|&byte| byte == 0) {
        let what = format!("the scene file is not text in UTF-8: byte {zero} is zero");
        return Err(not_text(&bytes, zero.min(valid_until(&bytes)), what));
    }
    String::from_utf8(bytes).map_err(|error| {
        let end = error.utf8_error().valid_up_to();
        let what = format!("the scene file is not UTF-8 from byte {end} on");
        not_text(error.as_bytes(), end, what)
    })
}

/// A question whether a file beside the one that is missing was meant, or a built-in scene; or
/// nothing.
fn like(path: &str) -> String {
    let path = Path::new(path);
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
        return String::new();
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let looked_in = match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    };
    let entries = looked_in.read_dir().into_iter().flatten().take(MOST_NAMES);
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let names: Vec<String> = names.filter(|name| is_path(name)).collect();
    let close = nearest(name, names.iter().map(String::as_str));
    if let Some(close) = close.first() {
        let close = folder.join(close).display().to_string();
        return format!("did you mean `{}`? ", shortened(&close));
    }
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    match nearest(stem, BUILTIN.iter().map(|scene| scene.name)).first() {
        Some(close) => format!("did you mean `{close}`, which is built in? "),
        None => String::new(),
    }
}

/// Bytes before the first that is not UTF-8.
fn valid_until(bytes: &[u8]) -> usize {
    std::str::from_utf8(bytes).map_or_else(|error| error.valid_up_to(), str::len)
}

/// The file's stem, fit to be a part of output paths.
fn scene_name(path: &str) -> String {
    let stem = Path::new(path)
        .file_stem()
        .map(|stem| stem.to_string_lossy());
    let stem = stem.unwrap_or_default();
    let plain = |c: char| if c.is_control() { '-' } else { c };
    let name: String = stem.trim_start_matches('.').chars().map(plain).collect();
    if name.is_empty() {
        "scene".to_owned()
    } else {
        name
    }
}
