//! Values that change with the frame in scene files: which can, and how they are written.

use motes::scene::schema::Kind;
use motes::scene::{Interpolation, Owner, Scene};

use crate::keys::KEYS;
use crate::text::{accepted, fields_of, line_of, refused, with};

/// Every key whose value can change: section, key, and two values.
#[rustfmt::skip]
pub(crate) const CHANGING: &[(&str, &str, &str, &str)] = &[
    ("image", "background", "[0, 0.5, 1]", "[1, 0, 0.25]"),
    ("image", "exposure", "0.5", "1000"),
    ("camera", "position", "[0, 1, 5]", "[3, 2, 4]"),
    ("camera", "target", "[0, 0, 0]", "[0, 1, 0]"),
    ("camera", "up", "[0, 1, 0]", "[0.5, 1, 0]"),
    ("camera", "view_height", "1", "0.25"),
    ("camera", "vertical_fov_degrees", "1", "170"),
    ("surface", "position", "[0, 0, 0]", "[-1, 2, 3]"),
    ("surface", "rotation_degrees", "[0, 0]", "[-10, 20]"),
    ("surface", "scale", "0", "1000"),
    ("surface", "color", "[0, 0.5, 1]", "[1, 0, 0.25]"),
    ("lamp", "position", "[0, 0, 0]", "[-1, 2, 3]"),
    ("lamp", "color", "[0, 0.5, 1]", "[1_000_000, 0, 2]"),
    ("system", "position", "[0, 0, 0]", "[-1, 2, 3]"),
    ("system", "rotation_degrees", "[0, 36_000]", "[-36_000, 45]"),
    ("system", "initial_mean_parts", "0", "16_000_000"),
    ("system", "var_parts", "0", "5"),
    ("system", "initial_mean_parts_per_area", "0.5", "1000"),
    ("system", "var_parts_per_area", "0", "2"),
    ("system", "ejection_angle_degrees", "0", "180"),
    ("system", "speed", "-1", "1"),
    ("system", "lifetime", "1", "65_000"),
    ("system", "color", "[0, 0, 0]", "[1000, 1, 2]"),
    ("system", "transparency", "0", "1"),
    ("system", "size", "0.25", "4"),
    ("system", "acceleration", "[0, -1, 0]", "[0, 1, 0]"),
    ("system", "drag", "0", "1"),
    ("system", "intensity_threshold", "0", "0.5"),
    ("system", "light_distance", "1", "8"),
    ("system", "light", "0", "12"),
    ("fire", "position", "[0, 0, 0]", "[-1, 2, 3]"),
    ("fire", "rotation_degrees", "[0, 36_000]", "[-36_000, 45]"),
    ("fire", "height", "1", "2"),
    ("fire", "width", "0.1", "0.25"),
    ("fire", "buoyancy", "-1", "2"),
    ("fire", "noisiness", "0", "1"),
    ("fire", "wind_factor", "0", "8"),
    ("fire", "brightness", "0", "1"),
    ("fire", "color_noise", "0", "1"),
    ("fire", "inner_alpha", "0", "1"),
    ("fire", "detail_spread", "0", "1"),
    ("fire", "detail_alpha", "1", "0"),
    ("fire", "strip_contrast", "0", "1"),
    ("fire", "matrix_noise", "0", "1"),
    ("fire", "light", "0", "12"),
    ("spread", "time_scale", "0.1", "0.4"),
    ("spread", "opposed_flux", "0.1", "0.2"),
    ("spread", "concurrent_flux", "0.1", "0.2"),
    ("spread", "ignition_heat", "0.5", "1"),
    ("spread", "drop_distance", "0.1", "0.2"),
    ("spread", "separation", "0.1", "0.2"),
    ("spread", "curvature_distance", "0.1", "0.2"),
    ("wind.uniform", "velocity", "[0, 0, 0]", "[1, 2, 3]"),
    ("wind.buoyancy", "gravity", "[0, -1, 0]", "[1, 0, 0]"),
    ("wind.buoyancy", "strength", "-1", "1"),
    ("wind.gusts", "velocity", "[0, 0, 0]", "[1, 2, 3]"),
    ("wind.vortex", "position", "[0, 0, 0]", "[1, 2, 3]"),
    ("wind.vortex", "speed", "-1", "1"),
    ("wind.vortex", "radius", "1", "2"),
    ("wind.source", "position", "[0, 0, 0]", "[1, 2, 3]"),
    ("wind.source", "strength", "-1", "4"),
    ("wind.source", "radius", "1", "2"),
    ("wind.sink", "position", "[0, 0, 0]", "[1, 2, 3]"),
    ("wind.sink", "strength", "-1", "4"),
    ("wind.sink", "radius", "1", "2"),
    ("wind.attractor", "position", "[0, 0, 0]", "[1, 2, 3]"),
    ("wind.attractor", "speed", "-1", "1"),
    ("wind.attractor", "radius", "1", "2"),
    ("wind.noise", "strength", "-1", "1"),
    ("wind.curl", "strength", "-1", "1"),
    ("generation_shape.sphere", "radius", "0", "1"),
    ("generation_shape.circle", "radius", "0", "1"),
    ("generation_shape.rectangle", "length", "0", "1"),
    ("generation_shape.rectangle", "width", "0", "1"),
    ("generation_shape.ring", "inner_radius", "0", "1"),
    ("generation_shape.ring", "outer_radius", "1", "2"),
    ("generation_shape.box", "length", "0", "1"),
    ("generation_shape.box", "width", "0", "1"),
    ("generation_shape.box", "height", "0", "1"),
    ("generation_shape.cone", "height", "0", "1"),
    ("generation_shape.line", "length", "0", "1"),
    ("generation_shape.attractor", "radius", "0", "1"),
    ("generation_shape.mesh", "scale", "0", "1"),
    ("flock", "max_speed", "1", "10_000"),
    ("flock", "force", "[0, 0, 0]", "[-1, 2, 3]"),
    ("flock", "size", "3", "0.5"),
    ("flock", "color", "[1, 0.5, 0]", "[0, 0, 1]"),
    ("flock", "drag", "0", "1"),
    ("goal", "position", "[0, 0, 0]", "[1, 2, 3]"),
    ("goal", "weight", "-1", "1"),
];

/// The same values as plain scenes and as one with keys at frames 2 and 7.
#[track_caller]
fn check_changing(text: impl Fn(&str) -> String, from: &str, to: &str) {
    let plain = [from, to].map(|value| accepted(&text(value)));
    assert_ne!(plain[0], plain[1], "{from} and {to} do not differ");
    for interpolation in ["linear", "smooth", "step"] {
        let keys = format!("keys = [[2, {from}], [7, {to}]]");
        let written = format!("{{ {keys}, interpolation = \"{interpolation}\" }}");
        let scene = accepted(&text(&written));
        assert_eq!(scene.tracks.len(), 1, "{written}");
        let first = Scene {
            tracks: vec![],
            ..scene.clone()
        };
        assert_eq!(
            first, plain[0],
            "the fields hold the first key's value: {written}"
        );
        assert_eq!(*scene.at(2.0), plain[0], "{written}");
        assert_eq!(*scene.at(7.0), plain[1], "{written}");
        // Before its last key a step is where it was, and the others are on their way.
        let midway = scene.at(4.5);
        assert_eq!(*midway == plain[0], interpolation == "step", "{written}");
        assert_ne!(*midway, plain[1], "{written}");
    }
}

#[test]
fn every_value_that_can_change_does() {
    for &(section, key, from, to) in CHANGING {
        check_changing(|value| with(section, key, value), from, to);
    }
}

#[test]
fn every_part_of_a_spread_can_change() {
    for key in ["speed", "lifetime", "color", "transparency", "size"] {
        let field = fields_of("system").iter().find(|field| field.key == key);
        let field = field.expect("a key of a system");
        let mean = if key == "color" { "[1, 1, 1]" } else { "1" };
        let [from, to] = match key {
            "color" => ["[1, 0, 1]", "[0, 1, 0.5]"],
            "lifetime" => ["1", "9"],
            _ => ["0.25", "1"],
        };
        for part in field.randomised_fields() {
            let text = |value: &str| match part.key {
                "mean" => with("system", key, &format!("{{ mean = {value} }}")),
                part => with(
                    "system",
                    key,
                    &format!("{{ mean = {mean}, {part} = {value} }}"),
                ),
            };
            check_changing(text, from, to);
        }
    }
}

#[test]
fn a_track_knows_whose_value_it_is() {
    let of = |section, key, value| accepted(&with(section, key, value)).tracks.remove(0);
    let track = of(
        "system",
        "speed",
        "{ keys = [[0, 1], [2.5, 3]], interpolation = \"smooth\" }",
    );
    let long = "{ mean = { keys = [[0, 1], [2.5, 3]], interpolation = \"smooth\" } }";
    assert_eq!(track, of("system", "speed", long));
    assert_eq!(
        (track.owner, track.key.as_str()),
        (Owner::System(0), "speed.mean")
    );
    assert_eq!(track.interpolation, Interpolation::Smooth);
    let keys = track.keys.iter().map(|key| (key.frame, key.value));
    assert!(keys.eq([(0.0, [1.0, 0.0, 0.0]), (2.5, [3.0, 0.0, 0.0])]));
    let track = of(
        "wind.curl",
        "strength",
        "{ keys = [[-65_000, 1], [1_000_000, 2]] }",
    );
    assert_eq!(
        (track.owner, track.key.as_str()),
        (Owner::Wind(8), "strength")
    );
    assert_eq!(track.interpolation, Interpolation::Linear);
    let track = of(
        "system",
        "initial_mean_parts_per_area",
        "{ keys = [[0, 1]] }",
    );
    assert_eq!(track.owner, Owner::System(1));
    let track = of("generation_shape.line", "length", "{ keys = [[0, 1]] }");
    assert_eq!(track.key, "generation_shape.length");
}

#[test]
fn what_cannot_change_is_refused_where_it_tries() {
    for &(section, key, ..) in KEYS {
        if CHANGING.iter().any(|row| (row.0, row.1) == (section, key)) {
            continue;
        }
        let field = fields_of(section).iter().find(|field| field.key == key);
        let field = field.expect("a key of the schema");
        let sample = match field.kind {
            Kind::Randomised { count: 3, .. } => "[1, 1, 1]",
            Kind::Randomised { .. } => "1",
            _ => field.sample(),
        };
        let value = format!("{{ keys = [[0, {sample}]] }}");
        let error = refused(&with(section, key, &value));
        let what = format!("{key}` cannot change with the frame");
        assert!(error.message().contains(&what), "{section}: {error}");
        assert!(error.help().contains("one value for all frames"), "{error}");
        assert_eq!(error.line(), Some(line_of(section, key)), "{error}");
    }
    #[rustfmt::skip]
    let paths = [
        ("camera", "near", "0.1", "`camera.near`", "can have keys in `camera` is position, target, up, view_height, vertical_fov_degrees"),
        ("image", "shutter", "0.5", "`image.shutter`", "can have keys in `image` is background, exposure"),
        ("system", "delta_mean_parts", "1", "`system.first.delta_mean_parts`", "initial_mean_parts, "),
        ("system", "mean_parts_wander", "0", "`system.first.mean_parts_wander`", "lifetime.mean"),
        ("burst", "parts", "1", "`system.first.burst.0.parts`", "one value"),
        ("extinction.sphere", "radius", "1", "`system.first.extinction.2.radius`", "one value"),
        ("extinction.plane", "normal", "[0, 1, 0]", "`system.first.extinction.1.normal`", "one value"),
        ("wind.vortex", "axis", "[0, 1, 0]", "`wind.3.axis`", "position, speed, radius"),
        ("wind.gusts", "frames", "2", "`wind.2.frames`", "velocity"),
        ("layer", "normal", "[0, 1, 0]", "`layer.0.normal`", "one value"),
        ("fire", "swell", "1", "`fire.pyre.swell`", "position, rotation_degrees, height.mean, height.var, width.mean"),
        ("flame", "width", "1", "`fire.pyre.flame.0.width`", "brightness"),
        ("generation_shape.cone", "angle_degrees", "2", "`system.first.generation_shape.angle_degrees`", "generation_shape.height"),
        ("system", "generation_shape", "1", "`system.first.generation_shape`", "{ kind = \"circle\""),
        ("", "seed", "1", "`seed`", "a whole number"),
    ];
    for (section, key, value, path, help) in paths {
        let text = with(
            section,
            key,
            &format!("{{ keys = [[0, {value}], [9, {value}]] }}"),
        );
        let error = refused(&text);
        assert!(error.message().starts_with(path), "wants {path}: {error}");
        assert!(error.help().contains(help), "wants {help}: {error}");
    }
}

#[test]
fn keys_that_are_not_right_are_refused_with_their_path() {
    let many: Vec<String> = (0..1001).map(|i| format!("[{i}, 1]")).collect();
    let many = |count| format!("{{ keys = [{}] }}", many[..count].join(", "));
    accepted(&with("system", "speed", &many(1000)));
    let too_many = many(1001);
    let form = "{ keys = [[FRAME, VALUE], ...]";
    // Key, value, path and message, help, and the piece that is shown.
    #[rustfmt::skip]
    let cases: &[(&str, &str, &str, &str, &str)] = &[
        ("speed", "{ keys = [] }", ".keys` is empty", form, "[] }"),
        ("speed", &too_many, ".keys` has 1001 keys, too many", "1 to 1000 keys", "[[0, 1], [1, 1]"),
        ("speed", "{ keys = 3 }", ".keys` cannot be the whole number 3", form, "3 }"),
        ("speed", "{ keys = [3] }", ".keys.0` cannot be the whole number 3", form, "3] }"),
        ("speed", "{ keys = [[3]] }", ".keys.0` cannot be an array of 1", form, "[3]"),
        ("speed", "{ keys = [[0, 1], [3, 1, 2]] }", ".keys.1` cannot be an array of 3", form, "[3, 1"),
        ("speed", "{ keys = [[0, 1], ['x', 1]] }", ".keys.1.0` cannot be text", form, "'x'"),
        ("speed", "{ keys = [[0, 1], [0, 2]] }", ".keys.1.0` is 0, but the key before is at 0", "ascending order", "0, 2"),
        ("speed", "{ keys = [[5, 1], [4.5, 2]] }", ".keys.1.0` is 4.5, but the key before is at 5", "ascending order", "4.5"),
        ("speed", "{ keys = [[0, 1], [1_000_001, 2]] }", ".keys.1.0` is out of range: 1000001", "from -65_000 to 1_000_000", "1_000_001"),
        ("speed", "{ keys = [[-65_000.5, 2]] }", ".keys.0.0` is out of range: -65000.5", "from -65_000", "-65_000.5"),
        ("speed", "{ keys = [[nan, 2]] }", ".keys.0.0` is out of range: NaN", "from -65_000", "nan"),
        ("speed", "{ keys = [[0, 1], [1, 10_001]] }", ".keys.1.1` is out of range: 10001", "from -10_000 to 10_000", "10_001"),
        ("speed", "{ keys = [[0, 1], [1, inf]] }", ".keys.1.1` is inf, not a finite number", "from -10_000 to 10_000", "inf"),
        ("speed", "{ keys = [[0, 1], [1, 'fast']] }", ".keys.1.1` cannot be text", "a number from -10_000", "'fast'"),
        ("speed", "{ keys = [[0, 1], [1, [2, 3]]] }", ".keys.1.1` cannot be an array of 2", "a number from -10_000", "[2, 3]"),
        ("speed", "{ mean = { keys = [[0, 1], [1, 10_001]] } }", ".mean.keys.1.1` is out of range: 10001", "from -10_000", "10_001"),
        ("speed", "{ mean = 1, var = { keys = [[0, 0], [9, -1]] } }", ".var.keys.1.1` is out of range: -1", "from 0 to 10_000", "-1"),
        ("color", "{ keys = [[0, [1, 1, 1]], [5, [1, -2, 1]]] }", ".keys.1.1.1` is out of range: -2", "from 0 to 1000", "-2"),
        ("color", "{ keys = [[0, [1, 1, 1]], [5, [1, 1]]] }", ".keys.1.1` cannot be an array of 2", "3 numbers", "[1, 1]]]"),
        ("position", "{ keys = [[0, 5]] }", ".keys.0.1` cannot be the whole number 5", "3 numbers", "5"),
        ("speed", "{ keys = [[0, 1]], interpolation = 'cubic' }", ".interpolation` cannot be \"cubic\"", "linear, smooth or step", "'cubic'"),
        ("speed", "{ keys = [[0, 1]], interpolation = 'smoth' }", ".interpolation` cannot be \"smoth\"", "did you mean `smooth`?", "'smoth'"),
        ("speed", "{ keys = [[0, 1]], interpolation = 3 }", ".interpolation` cannot be the whole number 3", "linear, smooth or step", "3 }"),
        ("drag", "{ keys = [[0, 1]], interpolaton = 'step' }", "no key `interpolaton` in `system.first.drag`", "did you mean `interpolation`?", "interpolaton"),
        ("speed", "{ keys = [[0, 1]], zebra = 1 }", "no key `zebra` in `system.first.speed`", form, "zebra"),
        ("speed", "{ keys = [[0, 1]], var = 2 }", "no key `var` in `system.first.speed`", "`mean = { keys = [[FRAME, VALUE], ...] }`", "var"),
    ];
    for &(key, value, message, help, piece) in cases {
        let error = refused(&with("system", key, value));
        assert!(
            error.message().contains(message),
            "wants {message}: {error}"
        );
        assert!(
            error.message().contains(&format!("system.first.{key}")),
            "{error}"
        );
        assert!(error.help().contains(help), "wants {help}: {error}");
        assert_eq!(error.line(), Some(line_of("system", key)), "{error}");
        let column = format!("{key} = {value}")
            .find(piece)
            .map(|index| index + 1);
        assert_eq!(error.column(), column, "wants {piece}: {error}");
    }
}
