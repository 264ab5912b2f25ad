//! The tables of what goes by its `kind`. A row: key, kind, default or example, unit, meaning.

use super::keys::{PLACE, default, numbers, required, whole};
use super::{Kind, Variant};

/// What an `[[system.extinction]]` can be (Reeves 1983, 2.4).
#[rustfmt::skip] // one row a line
pub const EXTINCTIONS: &[Variant] = &[
    Variant { name: "distance", fields: &[
        required("direction", PLACE, "[0, 0, 1]", "the system's space", "a direction from the system's origin"),
        required("distance", numbers(1, -1e6, 1e6), "5", "world units", "how far along it a particle may be"),
    ] },
    Variant { name: "plane", fields: &[
        required("point", PLACE, "[0, 0, 0]", "world units", "a point of the plane"),
        required("normal", PLACE, "[0, 1, 0]", "world space", "where the plane faces; what is behind it dies"),
    ] },
    Variant { name: "sphere", fields: &[
        required("center", PLACE, "[0, 0, 0]", "world units", "its centre"),
        required("radius", EXTENT, "1", "world units", "its radius"),
        required("kills", SIDE, "\"inside\"", "", "which side of it kills"),
    ] },
    Variant { name: "box", fields: &[
        required("min", PLACE, "[-1, -1, -1]", "world units", "the corner with the least coordinates"),
        required("max", PLACE, "[1, 1, 1]", "world units", "the corner with the greatest"),
        required("kills", SIDE, "\"outside\"", "", "which side of it kills"),
    ] },
];

/// What a `[[wind]]` can be (Perry 1994, 3.2.3).
#[rustfmt::skip] // one row a line
pub const WINDS: &[Variant] = &[
    Variant { name: "uniform", fields: &[
        required("velocity", VELOCITY, "[0.02, 0, 0]", "world units a frame", "the same everywhere"),
    ] },
    Variant { name: "buoyancy", fields: &[
        default("gravity", VELOCITY, "[0, -1, 0]", "world units a frame", "g, which the wind goes against"),
        required("strength", numbers(1, -1e4, 1e4), "0.02", "", "k_g, the factor of g"),
    ] },
    Variant { name: "gusts", fields: &[
        required("velocity", VELOCITY, "[0.02, 0, 0]", "world units a frame", "the same everywhere, on average"),
        default("amplitude", numbers(1, 0.0, 10.0), "0.5", "a share of the velocity", "how far it strays from that"),
        default("frames", numbers(1, 1.0, 1e6), "48", "frames", "how long a gust lasts"),
    ] },
    Variant { name: "vortex", fields: &[
        required("position", PLACE, "[0, 0, 0]", "world units", "a point of the axis"),
        default("axis", PLACE, "[0, 1, 0]", "world space", "the axis"),
        required("speed", numbers(1, -1e4, 1e4), "0.05", "world units a frame", "around the axis, where it is fastest"),
        default("radius", RADIUS, "1", "world units", "how far from the axis that is"),
    ] },
    Variant { name: "source", fields: &[
        required("position", PLACE, "[0, 0, 0]", "world units", "where it flows out"),
        required("strength", numbers(1, -1e9, 1e9), "0.05", "cubic world units a frame", "speed times squared distance, far away"),
        default("radius", RADIUS, "1", "world units", "within which it is slower than that"),
    ] },
    Variant { name: "sink", fields: &[
        required("position", PLACE, "[0, 0, 0]", "world units", "where it flows in"),
        required("strength", numbers(1, -1e9, 1e9), "0.05", "cubic world units a frame", "speed times squared distance, far away"),
        default("radius", RADIUS, "1", "world units", "within which it is slower than that"),
    ] },
    Variant { name: "attractor", fields: &[
        required("position", PLACE, "[0, 0, 0]", "world units", "where it blows to"),
        required("speed", numbers(1, -1e4, 1e4), "0.05", "world units a frame", "as fast from anywhere"),
        default("radius", RADIUS, "1", "world units", "within which it slows down"),
    ] },
    Variant { name: "noise", fields: TURBULENCE },
    Variant { name: "curl", fields: TURBULENCE },
];

#[rustfmt::skip] // one row a line
const TURBULENCE: &[super::Field] = &[
    required("strength", numbers(1, -1e4, 1e4), "0.04", "world units a frame", "C, the root mean square of one octave's speed"),
    default("scale", numbers(3, 0.0, 1e4), "[1, 1, 1]", "noise cells a world unit", "k_p along each axis"),
    default("drift", numbers(3, -1e4, 1e4), "[0, 0, 0]", "noise cells a frame", "k_s j, how the pattern moves"),
    default("octaves", whole(1, 8), "1", "", "how many, each of twice the frequency"),
    default("spectrum_exponent", numbers(1, 0.0, 8.0), "3.6666667", "", "beta: the noise's power falls as 1 / frequency^beta"),
    default("absolute", Kind::Flag, "false", "", "whether octaves count by their absolute value"),
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
    Variant {
        name: "ring",
        fields: &[
            required(
                "inner_radius",
                EXTENT,
                "0.8",
                "world units",
                "of the inner circle",
            ),
            required(
                "outer_radius",
                EXTENT,
                "1",
                "world units",
                "of the outer circle",
            ),
        ],
    },
    Variant {
        name: "box",
        fields: &[
            required("length", EXTENT, "1", "world units", "extent along local x"),
            required("width", EXTENT, "1", "world units", "extent along local y"),
            required("height", EXTENT, "1", "world units", "extent along local z"),
        ],
    },
    Variant {
        name: "cone",
        fields: &[
            required(
                "height",
                EXTENT,
                "1",
                "world units",
                "along local z, from the apex",
            ),
            required(
                "angle_degrees",
                numbers(1, 0.0, 89.0),
                "20",
                "degrees",
                "from the axis to the side",
            ),
        ],
    },
    Variant {
        name: "line",
        fields: &[required(
            "length",
            EXTENT,
            "1",
            "world units",
            "extent along local x",
        )],
    },
    Variant {
        name: "attractor",
        fields: &[
            required(
                "attractor",
                Kind::Choice(&["lorenz", "rossler", "halvorsen"]),
                "\"lorenz\"",
                "",
                "which chaotic system's trajectory",
            ),
            required(
                "radius",
                EXTENT,
                "1",
                "world units",
                "from its centre to its farthest point",
            ),
        ],
    },
];

const VELOCITY: Kind = numbers(3, -1e4, 1e4);
const RADIUS: Kind = numbers(1, 1e-3, 1e6);
const SIDE: Kind = Kind::Choice(&["inside", "outside"]);
const EXTENT: Kind = numbers(1, 0.0, 1e6);
