//! `motes scenes`: what is built in, and what can be changed in a scene.

use super::names::SceneName;
use super::{CliError, note, print};
use crate::json::Json;
use crate::scene::schema::Kind;
use crate::scene::{BUILTIN, BUILTIN_FILES, Knob, KnobValue, Loader, Scene, load};

/// Columns of a terminal that nobody has widened.
const COLUMNS: usize = 80;

/// Arguments of `motes scenes`.
#[derive(Debug, clap::Args)]
pub(super) struct ScenesArgs {
    /// Print the TOML text of one scene, to start your own from, or a file that a scene reads
    #[arg(long, value_name = "SCENE", value_parser = SceneName, hide_possible_values = true)]
    show: Option<String>,
    /// List every number, flag and choice of a scene that `--set` can change
    #[arg(long, value_name = "SCENE", value_parser = SceneName, hide_possible_values = true, conflicts_with = "show")]
    knobs: Option<String>,
    /// Let the scene of --knobs read files outside of its folder
    #[arg(long, requires = "knobs")]
    allow_outside: bool,
    /// Print the knobs as JSON
    #[arg(long, requires = "knobs")]
    json: bool,
}

pub(super) fn run(args: &ScenesArgs) -> Result<u8, CliError> {
    if let Some(scene) = &args.knobs {
        let loader = Loader {
            allow_outside: args.allow_outside,
        };
        let knobs = loader.knobs(scene)?;
        print(&if args.json {
            json(&knobs)
        } else {
            list(&knobs)
        })?;
        return Ok(0);
    }
    if let Some(name) = &args.show {
        let mut files = BUILTIN_FILES.iter();
        if let Some((_, bytes)) = files.find(|(file, _)| file == name) {
            print(&String::from_utf8_lossy(bytes))?;
            return Ok(0);
        }
        // Loading first gives the message about the nearest names.
        load(name)?;
        let builtin = BUILTIN
            .iter()
            .find(|scene| scene.name == name)
            .ok_or_else(|| {
                CliError::usage(
                    format!("`{name}` is not a built-in scene"),
                    "`motes scenes` lists the built-in ones",
                )
            })?;
        // Its first line names a file that lies beside it, but not beside a copy.
        let (first, rest) = builtin.text.split_once('\n').unwrap_or_default();
        print(if first.starts_with("#:schema") {
            rest
        } else {
            builtin.text
        })?;
        for (file, _) in BUILTIN_FILES {
            if builtin.text.contains(file) {
                note!("motes: it reads {file}, which --show {file} prints");
            }
        }
        return Ok(0);
    }
    let mut text = String::new();
    let width = BUILTIN.iter().map(|it| it.name.len()).max().unwrap_or(0);
    for builtin in BUILTIN {
        let scene = load(builtin.name)?;
        let about = wrapped(&scene.description, width + 1);
        text += &format!(
            "{:<width$} {}\n{about}{:<width$} {} frames at {} a second, {}x{}, {}\n",
            builtin.name,
            scene.title,
            "",
            scene.frames,
            scene.frame_rate,
            scene.image.width,
            scene.image.height,
            members(&scene)
        );
    }
    print(&text)?;
    Ok(0)
}

/// What a scene is made of: "2 systems, 1 flock".
fn members(scene: &Scene) -> String {
    let of = |count: usize, one: &str| match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        count => Some(format!("{count} {one}s")),
    };
    let parts = [
        of(scene.systems.len(), "system"),
        of(scene.flocks.len(), "flock"),
        of(scene.fires.len(), "fire"),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// The text in lines of at most [`COLUMNS`] columns, each begun with `indent` spaces.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= COLUMNS => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(format!("{:indent$}{word}", "")),
        }
    }
    lines.into_iter().map(|line| line + "\n").collect()
}

/// For people: a line as `--set` takes it, and one about it.
fn list(knobs: &[Knob]) -> String {
    let mut text = format!(
        "{} knobs: change one by --set 'PATH=VALUE', in quotes for the shell.\n",
        knobs.len()
    );
    let table = |knob: &Knob| {
        knob.path
            .rsplit_once('.')
            .map(|(table, _)| table.to_owned())
    };
    let mut last = None;
    for knob in knobs {
        let table = table(knob);
        if table != last {
            text.push('\n');
        }
        last = table;
        let (line, origin) = match &knob.value {
            KnobValue::Written(toml) => (format!("{}={toml}", knob.path), "the scene's"),
            KnobValue::Default(toml) => (format!("{}={toml}", knob.path), "default"),
            KnobValue::None => (format!("{}=", knob.path), "none"),
        };
        let keys = if knob.has_keys { " by keys" } else { "" };
        let (about, right) = (&knob.about, knob.right());
        text += &format!("{line}\n    {about} ({origin}{keys}; {right})\n");
    }
    text
}

fn json(knobs: &[Knob]) -> String {
    let knobs = knobs.iter().map(|knob| {
        let (value, from) = match &knob.value {
            KnobValue::Written(toml) => (toml.as_str().into(), "scene"),
            KnobValue::Default(toml) => (toml.as_str().into(), "default"),
            KnobValue::None => (Json::Null, "none"),
        };
        let field = &knob.field;
        let (kind, count, limits) = match field.kind {
            Kind::Whole { min, max } => ("whole", 1, Some((Json::Whole(min), Json::Whole(max)))),
            Kind::Wholes { min, max, most } => {
                let limits = (Json::Whole(min.into()), Json::Whole(max.into()));
                ("wholes", most, Some(limits))
            }
            Kind::Numbers { count, limits, .. } => {
                let limits = (Json::Number(limits.min), Json::Number(limits.max));
                ("number", count, Some(limits))
            }
            Kind::Flag => ("flag", 1, None),
            _ => ("choice", 1, None),
        };
        let json = Json::object([
            ("path", knob.path.as_str().into()),
            ("value", value),
            ("from", from.into()),
            ("has_keys", Json::Flag(knob.has_keys)),
            ("can_have_keys", Json::Flag(field.keyed)),
            ("kind", kind.into()),
            ("count", count.into()),
        ]);
        let json = match (limits, kind) {
            (Some((min, max)), _) => json.with("min", min).with("max", max),
            (None, "choice") => json.with("choices", Json::texts(knob.choices())),
            (None, _) => json,
        };
        let unit = Json::from(field.unit);
        let source = Json::from(field.source);
        let json = json
            .with("unit", unit)
            .with("about", knob.about.as_str().into());
        json.with("source", source)
    });
    Json::Array(knobs.collect()).pretty()
}
