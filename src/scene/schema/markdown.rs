//! The tables as a page for people.

use super::json::sentence;
use super::{
    BURST, CAMERA, CHAR, EDGES, EXTINCTIONS, FIRE, FLAME, FLOCK, FORMULA, Field, GENERATION_SHAPES,
    GOAL, GRAIN, GROUND, IGNITION, IMAGE, INHERIT, Kind, LAMP, LAYER, LIGHT, LINE, Limits,
    MATERIAL, OBSTACLES, PILLAR, PLANET, PROFILE, Presence, RAMP, REGION, RELATIONS, ROOTS, SCENE,
    SMOKE, SPREAD, SURFACE, SYSTEM, Variant, WINDS, parent_of,
};
use crate::scene::expect::{digits, range};

/// What holds for all keys.
const INTRODUCTION: &str = include_str!("introduction.md");

/// Stands after keys that can change with the frame.
const CAN_CHANGE: &str = " ◆";

/// A page of Markdown about every key of a scene file.
#[must_use]
pub fn reference_page() -> String {
    let mut page = INTRODUCTION.to_owned();
    let tables: [(&str, &str, &[Field]); 10] = [
        ("Top of the file", "Above the first header.", SCENE),
        (
            "`[image]`",
            "The picture that frames are drawn into.",
            IMAGE,
        ),
        ("`[camera]`", "The viewer.", CAMERA),
        (
            "`[light]`",
            "What the planet, the ground and surfaces reflect, and particles that cover and are shaded.",
            LIGHT,
        ),
        ("`[planet]`", "A ball with a surface, at most one.", PLANET),
        (
            "`[[lamp]]`",
            "A light near the planet, the ground and surfaces, as many as you like.",
            LAMP,
        ),
        (
            "`[ground]`",
            "A plane behind everything, at most one.",
            GROUND,
        ),
        (
            "`[[pillar]]`",
            "An upright cylinder before the ground, as many as you like.",
            PILLAR,
        ),
        (
            "`[[surface]]`",
            "A mesh that is seen, as many as you like. The camera is in perspective.",
            SURFACE,
        ),
        (
            "`[[system]]`",
            "A particle system, as many as you like.",
            SYSTEM,
        ),
    ];
    for (heading, about, fields) in tables {
        page += &section(heading, about, fields);
    }
    let about = "How much the systems of one kind differ that the `[[system]]` above it stands for: \
                 each value is the half-width of a range around what that says.";
    page += &section("`[system.inherit]`", about, INHERIT);
    let about = "Births all at once, inside the `[[system]]` above it.";
    page += &section("`[[system.burst]]`", about, BURST);
    let about = "Where the particles of a system are born: a table by its kind.";
    let inline = |key: &'static str| {
        move |kind: &Variant| {
            let keys = lines(kind).collect::<Vec<_>>().join(", ");
            format!("{key} = {{ {keys} }}\n")
        }
    };
    let shape = inline("generation_shape");
    page += &kinds("`generation_shape`", about, GENERATION_SHAPES, shape);
    let list = |header: &'static str| {
        move |kind: &Variant| {
            let lines: String = lines(kind).map(|line| line + "\n").collect();
            format!("{header}\n{lines}")
        }
    };
    let about = "Where the particles of the `[[system]]` above it may not be: a table by its kind.";
    let header = "[[system.extinction]]";
    page += &kinds("`[[system.extinction]]`", about, EXTINCTIONS, list(header));
    let about = "A flock, as many as you like: boids that are all there from the first frame on.";
    page += &section("`[[flock]]`", about, FLOCK);
    let about = "Where the boids of a flock are at first: anywhere in a box along the axes.";
    page += &section("`[region]`", about, REGION);
    let about = "A place that the boids of a flock steer to.";
    page += &section("`[goal]`", about, GOAL);
    let about = "What happens to a flock at the ends of the world: a table by its kind.";
    page += &kinds("`edges`", about, EDGES, inline("edges"));
    let about = "What the `[[flock]]` above it makes of another one, or of itself: a table by its \
                 kind. Predators and attractors are flocks that others avoid and approach.";
    let header = "[[flock.relation]]";
    page += &kinds("`[[flock.relation]]`", about, RELATIONS, list(header));
    let about = "What boids of a flock turn away from and never enter; not across edges.";
    let header = "[[flock.obstacle]]";
    page += &kinds("`[[flock.obstacle]]`", about, OBSTACLES, list(header));
    let about =
        "A fire, as many as you like: flames of one kind, each the whole way of one particle.";
    page += &section("`[[fire]]`", about, FIRE);
    let about = "A flame that is told by itself, inside the `[[fire]]` above it.";
    page += &section("`[[fire.flame]]`", about, FLAME);
    let about = "Where the flames of a fire stand: a table by its kind.";
    page += &kinds("`roots`", about, ROOTS, inline("roots"));
    let about =
        "What the particle of a flame looks like at an age, inside the `[[fire]]` above it.";
    page += &section("`[[fire.ramp]]`", about, RAMP);
    let about = "How the particle of a flame is squashed and stretched at an age, inside the `[[fire]]` above it.";
    page += &section("`[[fire.profile]]`", about, PROFILE);
    let about = "How the `[[fire]]` above it spreads over a mesh: a front of control points, which goes \
                 straight on from face to face.";
    page += &section("`[fire.spread]`", about, SPREAD);
    let about = "Where the fire above it begins to spread, inside its `[fire.spread]`.";
    page += &section("`[[fire.spread.ignition]]`", about, IGNITION);
    let about = "How a part of the mesh burns, inside the `[fire.spread]` above it.";
    page += &section("`[[fire.spread.material]]`", about, MATERIAL);
    let about = "Where the heat comes from, in SI units, inside the `[fire.spread]` above it.";
    page += &section("`[fire.spread.formula]`", about, FORMULA);
    let about = "A pattern as wood has it, inside the `[fire.spread]` above it, where it is slower, or inside a \
                 `[[surface]]`, where it is darker: then the table is `surface.grain`.";
    page += &section("`[fire.spread.grain]`", about, GRAIN);
    let about = "Circular, fuzzy, translucent marks where flames that a front has dropped have gone out, inside \
                 the `[fire.spread]` above it.";
    page += &section("`[fire.spread.char]`", about, CHAR);
    let about = "Puffs that rise where flames that a front has dropped have gone out, in the wind that flames \
                 are in, inside the `[fire.spread]` above it.";
    page += &section("`[fire.spread.smoke]`", about, SMOKE);
    let about = "The front as a line from control point to control point, inside the `[fire.spread]` above it.";
    page += &section("`[fire.spread.line]`", about, LINE);
    let about = "A part of the wind, which is the sum of all of them and moves the particles of \
                 systems and the boids of flocks with `drag`: a table by its kind.";
    page += &kinds("`[[wind]]`", about, WINDS, list("[[wind]]"));
    let about = "A plane that splits the picture into layers.";
    page + &section("`[[layer]]`", about, LAYER)
}

fn section(heading: &str, about: &str, fields: &[Field]) -> String {
    format!("\n## {heading}\n\n{about}\n\n{}", table(fields))
}

fn kinds(
    heading: &str,
    about: &str,
    kinds: &[Variant],
    example: impl Fn(&Variant) -> String,
) -> String {
    let mut text = format!("\n## {heading}\n\n{about}\n");
    for kind in kinds {
        let about = sentence(kind.about);
        let (table, example) = (table(kind.fields), example(kind));
        text += &format!(
            "\n### `{}`\n\n{about}\n\n{table}\n```toml\n{example}```\n",
            kind.name
        );
    }
    text
}

/// `key = value` for each key of a kind.
fn lines(kind: &Variant) -> impl Iterator<Item = String> {
    let first = format!("kind = \"{}\"", kind.name);
    let fields = kind.fields.iter();
    std::iter::once(first).chain(fields.map(|field| format!("{} = {}", field.key, field.sample())))
}

fn table(fields: &[Field]) -> String {
    let mut text = "| key | what it is | value | unit | default | source |\n\
                    |---|---|---|---|---|---|\n"
        .to_owned();
    for field in fields {
        let can_change = if field.keyed { CAN_CHANGE } else { "" };
        let default = match field.presence {
            Presence::Required(_) => "required".to_owned(),
            Presence::Optional(_) => "none".to_owned(),
            Presence::Default(toml) => format!("`{toml}`"),
        };
        let source = match field.source {
            "" => "Motes",
            source => source,
        };
        let (words, unit, about) = (value(field), field.unit, field.about);
        text += &format!(
            "| `{}`{can_change} | {about} | {words} | {unit} | {default} | {source} |\n",
            field.key
        );
    }
    text
}

fn value(field: &Field) -> String {
    match field.kind {
        Kind::Text { max_chars, lines } => {
            let lines = if lines { "text" } else { "a line" };
            format!("{lines} of at most {} characters", digits(max_chars as f64))
        }
        Kind::Name { .. } => "a name".to_owned(),
        Kind::Whole { min, max } => format!("a whole number {}", range(min as f64, max as f64)),
        Kind::Wholes { min, max, most } => {
            let range = range(min.into(), max.into());
            format!("at most {most} whole numbers in ascending order, each {range}")
        }
        Kind::Flag => "`true` or `false`".to_owned(),
        Kind::Numbers {
            count,
            limits,
            nonzero,
        } => {
            let but = if nonzero { ", not all 0" } else { "" };
            format!("{}{but}", numbers(count, limits))
        }
        Kind::Randomised { count, .. } => {
            let of = if count == 1 {
                "a spread"
            } else {
                "a spread of 3 numbers"
            };
            let parts = field.randomised_fields();
            let parts = parts.iter().filter_map(|part| match part.kind {
                Kind::Numbers { limits, .. } => {
                    Some(format!("{} {}", part.key, range(limits.min, limits.max)))
                }
                _ => None,
            });
            format!("{of}: {}", parts.collect::<Vec<_>>().join(", "))
        }
        Kind::Choice(words) => {
            let words: Vec<String> = words.iter().map(|word| format!("`\"{word}\"`")).collect();
            words.join(" or ")
        }
        Kind::Table(_) => match parent_of(field.key) {
            // A flock's region and a fire's roots are written in braces, too.
            Some(parent @ ("system" | "fire" | "fire.spread")) => {
                let anchor = format!("{parent}{}", field.key).replace('.', "");
                format!("a table: [`[{parent}.{}]`](#{anchor})", field.key)
            }
            _ => format!("a table: [`[{0}]`](#{0})", field.key),
        },
        Kind::Tables { max, .. } => tables(field, max),
        Kind::Variants(_) => format!("a table: [`{0}`](#{0})", field.key),
        Kind::List { max, .. } => tables(field, max),
    }
}

fn tables(field: &Field, max: usize) -> String {
    let least = match field.presence {
        Presence::Required(_) | Presence::Optional(_) => "1 to",
        _ => "at most",
    };
    let (path, anchor) = match parent_of(field.key) {
        Some(parent) => (
            format!("{parent}.{}", field.key),
            format!("{parent}{}", field.key).replace('.', ""),
        ),
        None => (field.key.to_owned(), field.key.to_owned()),
    };
    format!(
        "{least} {} tables: [`[[{path}]]`](#{anchor})",
        digits(max as f64)
    )
}

fn numbers(count: usize, limits: Limits) -> String {
    let range = range(limits.min, limits.max);
    match count {
        1 => format!("a number {range}"),
        _ => format!("{count} numbers, each {range}"),
    }
}
