//! Whole files that the JSON Schema and the reader both refuse, and those that only the reader does.

use motes::scene::schema::{self, Field, Presence};

use crate::keys::KEYS;
use crate::schema::{both_refuse, both_take, reader_takes, schema_takes};
use crate::text::{MINIMAL, with, with_line_before, without};

#[test]
fn what_must_be_written_must_be_in_both() {
    let mut required = 0;
    for &(section, key, ..) in KEYS {
        // That only systems with a parent inherit is a rule between keys.
        if section.starts_with("generation_shape.") || key == "parent" {
            continue;
        }
        let text = without(section, key);
        // One of the two ways to give births must be there: a rule between keys.
        if key.starts_with("initial_mean_parts") {
            assert!(!reader_takes(&text) || section != "system" || key.ends_with("_per_area"));
            assert!(schema_takes(&text), "{key}");
        } else if reader_takes(&text) {
            both_take(&text, key);
        } else {
            required += 1;
            both_refuse(&text, key);
        }
    }
    assert!(required > 30, "{required}");
    for shape in schema::GENERATION_SHAPES {
        let required = |field: &&Field| matches!(field.presence, Presence::Required(_));
        for left_out in shape.fields.iter().filter(required) {
            let others = shape
                .fields
                .iter()
                .filter(|field| field.key != left_out.key);
            let others: String = others
                .map(|field| format!(", {} = {}", field.key, field.sample()))
                .collect();
            let value = format!("{{ kind = \"{}\"{others} }}", shape.name);
            both_refuse(&with("system", "generation_shape", &value), &value);
        }
    }
}

#[test]
fn wrong_files_are_wrong_in_both() {
    let system = MINIMAL.find("[[system]]").expect("it is there");
    let (head, system) = (&MINIMAL[..system], &MINIMAL[system..]);
    let many = |count: usize, one: &str| {
        let numbered = |i: usize| one.replace('#', &i.to_string());
        (0..count).map(numbered).collect::<String>()
    };
    let layer = "[[layer]]\nname = \"l#\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [0, 0, 0]\n";
    let burst = "[[system.burst]]\nframe = 1\nparts = 1\n";
    let plane = "[[system.extinction]]\nkind = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n";
    let ascending = |count: usize| {
        let frames: Vec<String> = (0..count).map(|i| i.to_string()).collect();
        format!("[{}]", frames.join(", "))
    };
    for (one, most) in [(layer, 8), (wind, 16), (burst, 64), (plane, 16)] {
        both_take(&format!("{MINIMAL}{}", many(most, one)), one);
        both_refuse(&format!("{MINIMAL}{}", many(most + 1, one)), one);
    }
    both_take(
        &with("system", "trigger_frames", &ascending(256)),
        "256 triggers",
    );
    both_refuse(
        &with("system", "trigger_frames", &ascending(257)),
        "257 triggers",
    );
    both_refuse(
        &with("system", "trigger_frames", "[1, 1]"),
        "a trigger twice",
    );
    #[rustfmt::skip]
    let cases = [
        String::new(),
        head.to_owned(),
        system.to_owned(),
        "camera = 3\n".to_owned() + system,
        "camera = []\n".to_owned() + system,
        "image = 3\n".to_owned() + MINIMAL,
        "image = [{}]\n".to_owned() + MINIMAL,
        "system = []\n".to_owned() + head,
        "system = [1]\n".to_owned() + head,
        "system = {}\n".to_owned() + head,
        "wind = {}\n".to_owned() + MINIMAL,
        "wind = [{}]\n".to_owned() + MINIMAL,
        "wind = [{ kind = \"noise\" }]\n".to_owned() + MINIMAL,
        "wind = [{ kind = \"breeze\", velocity = [0, 0, 0] }]\n".to_owned() + MINIMAL,
        "wind = [{ kind = [\"noise\"], strength = 1 }]\n".to_owned() + MINIMAL,
        "wind = [{ kind = \"uniform\", velocity = [0, 0, 0], strength = 1 }]\n".to_owned() + MINIMAL,
        "wind = [{ velocity = [0, 0, 0] }]\n".to_owned() + MINIMAL,
        "layer = [{ name = \"rest\", point = [0, 0, 0], normal = [0, 0, 1] }]\n".to_owned() + MINIMAL,
        "layer = [{ name = \"particles\", point = [0, 0, 0], normal = [0, 0, 1] }]\n".to_owned() + MINIMAL,
        with("system", "generation_shape", "{ radius = 1 }"),
        with("system", "generation_shape", "{ kind = \"sphere\", radius = 1, width = 1 }"),
        with("system", "speed", "{ var = 1 }"),
        with("system", "speed", "{ mean = 1, rate = 1 }"),
        with("system", "speed", "{ mean = 1, keys = [[0, 1]] }"),
        with("system", "speed", "[1]"),
        with("system", "color", "1"),
        with("system", "color", "[1, 1]"),
        with("system", "color", "{ mean = 1 }"),
        with("system", "color", "{}"),
        with("system", "position", "[0, 0, \"0\"]"),
        with("", "title", &format!("\"{}\"", "x".repeat(201))),
        with("", "title", "\"tab\\there\""),
        with("", "description", "\"tab\\there\""),
        with("", "frames", "[]"),
    ];
    for case in cases {
        both_refuse(&case, "this");
    }
    let names = ["a", "_", "é", "x1-_٣", &"n".repeat(64), "Ω", "字"];
    for name in names {
        both_take(&with("system", "name", &format!("\"{name}\"")), name);
    }
    let names = [
        "",
        "-",
        "1",
        "a b",
        "a.b",
        "a\\n",
        &"n".repeat(65),
        "٣",
        "a\u{301}!",
        "x/y",
    ];
    for name in names {
        both_refuse(&with("system", "name", &format!("\"{name}\"")), name);
    }
    both_take(&with("", "description", "\"a\\nb\""), "two lines");
    both_take(
        &with("", "title", &format!("\"{}\"", "é".repeat(200))),
        "200 characters",
    );
    // What is left out of a spread with a default is its default's.
    both_take(&with("system", "transparency", "{ var = 0.5 }"), "no mean");
    both_take(&with("system", "transparency", "{}"), "nothing");
}

#[test]
fn rules_between_keys_are_the_readers_alone() {
    #[rustfmt::skip]
    let cases = [
        with("camera", "target", "[0, 1, 5]"),
        with("camera", "up", "[0, 0, 0]"),
        with("system", "end_frame", "2"),
        with("system", "name", "\"second\""),
        with("system", "trigger_frames", "[1, 0]"),
        with("system", "lifetime", "{ mean = 65_000, var = 1 }"),
        with("system", "generation_shape", "{ kind = \"ring\", inner_radius = 2, outer_radius = 1 }"),
        with("extinction.box", "max", "[-2, 2, 2]"),
        with("image", "width", "4096").replace("height = 360", "height = 4096"),
        with_line_before("system", "speed", "var_parts_per_area = 1"),
        with("system", "speed", "{ keys = [[1, 1], [0, 1]] }"),
        with("layer", "normal", "[0, 1e-7, 0]"),
    ];
    for case in cases {
        assert!(!reader_takes(&case) && schema_takes(&case), "{case}");
    }
}
