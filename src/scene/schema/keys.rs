//! The tables themselves. A row: key, kind, default or example, unit, meaning.

use super::{Field, Kind, Limits, Presence, Variant};

/// Keys at the top of a scene file.
#[rustfmt::skip] // one row a line
pub const SCENE: &[Field] = &[
    optional("title", TITLE, "\"A fountain\"", "", "one line for people; the scene's name if left out"),
    default("description", DESCRIPTION, "\"\"", "", "a few sentences for people"),
    default("frames", whole(1, 1_000_000), "120", "frames", "how long the scene lasts when nobody says otherwise"),
    default("frame_rate", whole(1, 240), "24", "frames a second", "the speed of animated files"),
    default("seed", whole(0, i64::MAX), "1", "", "decides every random number"),
    optional("capacity", whole(1, 1_000_000_000), "200_000", "particles", "most particles alive at once; computed from births and lifetimes if left out"),
    default("image", Kind::Table(IMAGE), "{}", "", "the picture that frames are drawn into"),
    required("camera", Kind::Table(CAMERA), "{ position = [0, 1, 5], target = [0, 0, 0] }", "", "the viewer"),
    required("system", Kind::Tables { fields: SYSTEM, max: 1024 }, "[{ name = \"jet\", initial_mean_parts = 100, generation_shape = { kind = \"sphere\", radius = 1 }, speed = 0.1, lifetime = 60, color = [0.4, 0.1, 0.02], size = 0.02 }]", "", "the particle systems, one `[[system]]` each"),
];

/// Keys of `[image]`.
#[rustfmt::skip] // one row a line
pub const IMAGE: &[Field] = &[
    default("width", whole(1, 4096), "1280", "pixels", "across"),
    default("height", whole(1, 4096), "720", "pixels", "down"),
    default("background", numbers(3, 0.0, 1.0), "[0, 0, 0]", "display-referred red, green, blue", "colour behind everything"),
    default("shutter", numbers(1, 0.0, 1.0), "0.5", "frames", "how much of a frame the shutter is open, so how long streaks are"),
];

/// Keys of `[camera]`.
#[rustfmt::skip] // one row a line
pub const CAMERA: &[Field] = &[
    required("position", PLACE, "[0, 1, 5]", "world units", "where it stands"),
    required("target", PLACE, "[0, 0, 0]", "world units", "what it looks at"),
    default("up", PLACE, "[0, 1, 0]", "world space", "which way is up in the picture"),
    default("vertical_fov_degrees", numbers(1, 1.0, 170.0), "45", "degrees", "the whole vertical angle of view"),
    default("near", numbers(1, 1e-6, 1e6), "0.1", "world units", "nothing nearer is drawn"),
];

/// Keys of each `[[system]]` (Reeves 1983, section 2).
#[rustfmt::skip] // one row a line
pub const SYSTEM: &[Field] = &[
    required("name", Kind::Name, "\"jet\"", "", "unique; a part of every particle's identity"),
    default("position", PLACE, "[0, 0, 0]", "world units", "the system's origin"),
    default("rotation_degrees", numbers(2, -360.0, 360.0), "[0, 0]", "degrees", "turns about x, then about y; local +z is the system's up"),
    default("first_frame", whole(0, 1_000_000), "0", "frames", "the first frame with births"),
    optional("end_frame", whole(1, 1_000_000), "60", "frames", "the first frame without births again; never if left out"),
    optional("initial_mean_parts", PARTS, "1000", "particles a frame", "mean births in the first frame"),
    default("delta_mean_parts", PARTS_CHANGE, "0", "particles a frame", "added to the mean each frame"),
    default("var_parts", PARTS, "0", "particles a frame", "half the width of the range around the mean"),
    optional("initial_mean_parts_per_area", DENSITY, "0.5", "particles a frame and pixel of screen area", "mean births in the first frame"),
    default("delta_mean_parts_per_area", DENSITY_CHANGE, "0", "particles a frame and pixel of screen area", "added to the mean each frame"),
    default("var_parts_per_area", DENSITY, "0", "particles a frame and pixel of screen area", "half the width of the range around the mean"),
    default("birth_rounding", Kind::Choice(&["stochastic", "nearest"]), "\"stochastic\"", "", "how a fractional number of births becomes a whole one"),
    required("generation_shape", Kind::Variants(GENERATION_SHAPES), "{ kind = \"sphere\", radius = 1 }", "", "where particles are born"),
    default("ejection_angle_degrees", numbers(1, 0.0, 180.0), "0", "degrees", "half-angle of the cone about local +z that circle and rectangle births leave within"),
    required("speed", spread((-1e4, 1e4), (0.0, 1e4)), "{ mean = 0.1, var = 0.02 }", "world units a frame", "initial speed"),
    required("lifetime", spread((1.0, 65_000.0), (0.0, 65_000.0)), "{ mean = 60, var = 10 }", "frames", "how long particles live"),
    required("color", changing(3, (0.0, 1e3), 1e3), "{ mean = [0.4, 0.1, 0.02] }", "light of a fully covered pixel in red, green, blue", "colour"),
    default("transparency", changing(1, (0.0, 1.0), 1.0), "{ mean = 0 }", "0 opaque, 1 invisible", "light is scaled by 1 - transparency"),
    required("size", changing(1, (1e-6, 1e4), 1e4), "{ mean = 0.02 }", "world units", "radius, or half the width of a rectangle"),
    default("acceleration", numbers(3, -1e4, 1e4), "[0, 0, 0]", "world units a frame squared, world space", "added to the velocity each frame"),
    default("particle_shape", Kind::Choice(&["sphere", "rectangle", "streak"]), "\"sphere\"", "", "what a particle looks like"),
    default("streak_light", Kind::Choice(&["conserved", "constant"]), "\"conserved\"", "", "whether a streak's light is spread along it, or full everywhere"),
    optional("intensity_threshold", numbers(1, 0.0, 1e3), "0.01", "light", "a particle dimmer than this is killed; never if left out"),
];

/// What `generation_shape` can be (Reeves 1983, 2.2).
pub const GENERATION_SHAPES: &[Variant] = &[
    Variant {
        name: "sphere",
        fields: &[required(
            "radius",
            EXTENT,
            "1",
            "world units",
            "particles leave outward",
        )],
    },
    Variant {
        name: "circle",
        fields: &[required(
            "radius",
            EXTENT,
            "1",
            "world units",
            "in the local x-y plane",
        )],
    },
    Variant {
        name: "rectangle",
        fields: &[
            required("length", EXTENT, "1", "world units", "extent along local x"),
            required("width", EXTENT, "1", "world units", "extent along local y"),
        ],
    },
];

const TITLE: Kind = text(200, false);
const DESCRIPTION: Kind = text(10_000, true);
const PLACE: Kind = numbers(3, -1e6, 1e6);
const EXTENT: Kind = numbers(1, 0.0, 1e6);
const PARTS: Kind = numbers(1, 0.0, 16e6);
const PARTS_CHANGE: Kind = numbers(1, -16e6, 16e6);
const DENSITY: Kind = numbers(1, 0.0, 1e3);
const DENSITY_CHANGE: Kind = numbers(1, -1e3, 1e3);

const fn text(max_chars: usize, lines: bool) -> Kind {
    Kind::Text { max_chars, lines }
}

const fn whole(min: i64, max: i64) -> Kind {
    Kind::Whole { min, max }
}

const fn limits((min, max): (f64, f64)) -> Limits {
    Limits { min, max }
}

const fn numbers(count: usize, min: f64, max: f64) -> Kind {
    let limits = limits((min, max));
    Kind::Numbers { count, limits }
}

const fn spread(mean: (f64, f64), var: (f64, f64)) -> Kind {
    Kind::Randomised {
        count: 1,
        mean: limits(mean),
        var: limits(var),
        rate: None,
    }
}

const fn changing(count: usize, mean: (f64, f64), most: f64) -> Kind {
    Kind::Randomised {
        count,
        mean: limits(mean),
        var: limits((0.0, most)),
        rate: Some(limits((-most, most))),
    }
}

type Str = &'static str;

const fn required(key: Str, kind: Kind, example: Str, unit: Str, about: Str) -> Field {
    let presence = Presence::Required(example);
    Field {
        key,
        kind,
        presence,
        unit,
        about,
    }
}

const fn optional(key: Str, kind: Kind, example: Str, unit: Str, about: Str) -> Field {
    let presence = Presence::Optional(example);
    Field {
        key,
        kind,
        presence,
        unit,
        about,
    }
}

const fn default(key: Str, kind: Kind, value: Str, unit: Str, about: Str) -> Field {
    let presence = Presence::Default(value);
    Field {
        key,
        kind,
        presence,
        unit,
        about,
    }
}
