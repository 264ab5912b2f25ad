//! The tables of what goes by its `kind`. A row is as in the other tables.

use super::rows::{DIRECTION, PLACE, default, keyed, numbers, required, text, whole};
use super::{Field, Kind, Variant};

/// What an `[[system.extinction]]` can be (Reeves 1983, 2.4).
#[rustfmt::skip] // one row a line
pub const EXTINCTIONS: &[Variant] = &[
    Variant { name: "distance", about: "particles die beyond a distance from their system", fields: &[
        required("direction", DIRECTION, "[0, 0, 1]", "the system's space", "a direction from the system's origin", "Reeves 2.4"),
        required("distance", numbers(1, -1e6, 1e6), "5", "world units", "how far along it a particle may be", "Reeves 2.4"),
    ] },
    Variant { name: "plane", about: "particles die behind a plane, such as under the ground", fields: &[
        required("point", PLACE, "[0, 0, 0]", "world units", "a point of the plane", "Reeves 3"),
        required("normal", DIRECTION, "[0, 1, 0]", "world space", "where the plane faces; what is behind it dies", "Reeves 3"),
    ] },
    Variant { name: "sphere", about: "particles die inside a ball, or outside it", fields: &[
        required("center", PLACE, "[0, 0, 0]", "world units", "its centre", "Reeves 3"),
        required("radius", EXTENT, "1", "world units", "its radius", "Reeves 3"),
        required("kills", SIDE, "\"inside\"", "", "which side of it kills", "Reeves 3"),
    ] },
    Variant { name: "box", about: "particles die inside a box along the axes, or outside it", fields: &[
        required("min", PLACE, "[-1, -1, -1]", "world units", "the corner with the least coordinates", ""),
        required("max", PLACE, "[1, 1, 1]", "world units", "the corner with the greatest", ""),
        required("kills", SIDE, "\"outside\"", "", "which side of it kills", ""),
    ] },
];

/// What a `[[wind]]` can be (Perry 1994, 3.2.3).
#[rustfmt::skip] // one row a line
pub const WINDS: &[Variant] = &[
    Variant { name: "uniform", about: "the same wind everywhere", fields: &[
        keyed(required("velocity", VELOCITY, "[0.02, 0, 0]", "world units a frame", "the same everywhere", "Perry 3.2.3")),
    ] },
    Variant { name: "buoyancy", about: "hot air that rises against gravity", fields: &[
        keyed(default("gravity", VELOCITY, "[0, -1, 0]", "world units a frame", "g, which the wind goes against", "Perry 3.2.3")),
        keyed(required("strength", numbers(1, -1e4, 1e4), "0.02", "", "k_g, the factor of g", "Perry 3.2.3")),
    ] },
    Variant { name: "gusts", about: "the same wind everywhere, now stronger, now weaker", fields: &[
        keyed(required("velocity", VELOCITY, "[0.02, 0, 0]", "world units a frame", "the same everywhere, on average", "Perry 3.2.3")),
        default("amplitude", numbers(1, 0.0, 10.0), "0.5", "a share of the velocity", "how far it strays from that", ""),
        default("frames", numbers(1, 1.0, 1e6), "48", "frames", "how long a gust lasts", ""),
    ] },
    Variant { name: "vortex", about: "a wind around an axis", fields: &[
        keyed(required("position", PLACE, "[0, 0, 0]", "world units", "a point of the axis", "Perry 3.2.3")),
        default("axis", DIRECTION, "[0, 1, 0]", "world space", "the axis", "Perry 3.2.3"),
        keyed(required("speed", numbers(1, -1e4, 1e4), "0.05", "world units a frame", "around the axis, where it is fastest", "Perry 3.2.3")),
        keyed(default("radius", RADIUS, "1", "world units", "how far from the axis that is", "")),
    ] },
    Variant { name: "source", about: "air that flows out of a place", fields: &[
        keyed(required("position", PLACE, "[0, 0, 0]", "world units", "where it flows out", "")),
        keyed(required("strength", numbers(1, -1e9, 1e9), "0.05", "cubic world units a frame", "speed times squared distance, far away", "")),
        keyed(default("radius", RADIUS, "1", "world units", "within which it is slower than that", "")),
    ] },
    Variant { name: "sink", about: "air that flows into a place", fields: &[
        keyed(required("position", PLACE, "[0, 0, 0]", "world units", "where it flows in", "")),
        keyed(required("strength", numbers(1, -1e9, 1e9), "0.05", "cubic world units a frame", "speed times squared distance, far away", "")),
        keyed(default("radius", RADIUS, "1", "world units", "within which it is slower than that", "")),
    ] },
    Variant { name: "attractor", about: "a wind towards a place, as fast from anywhere", fields: &[
        keyed(required("position", PLACE, "[0, 0, 0]", "world units", "where it blows to", "")),
        keyed(required("speed", numbers(1, -1e4, 1e4), "0.05", "world units a frame", "as fast from anywhere", "")),
        keyed(default("radius", RADIUS, "1", "world units", "within which it slows down", "")),
    ] },
    Variant { name: "noise", about: "turbulence: the gradient of a noise", fields: TURBULENCE },
    Variant { name: "curl", about: "turbulence: the curl of a noise, which gathers particles nowhere", fields: TURBULENCE },
];

#[rustfmt::skip] // one row a line
const TURBULENCE: &[Field] = &[
    keyed(required("strength", numbers(1, -1e4, 1e4), "0.04", "world units a frame", "C, the root mean square of one octave's speed", "Perry 3.2.3")),
    default("scale", numbers(3, 0.0, 1e4), "[1, 1, 1]", "noise cells a world unit", "k_p along each axis", "Perry 2.1.2, 3.4"),
    default("drift", numbers(3, -1e4, 1e4), "[0, 0, 0]", "noise cells a frame", "k_s j, how the pattern moves", "Perry 3.2.3"),
    default("octaves", whole(1, 8), "1", "", "how many, each of twice the frequency", "Perry 2.1.2"),
    default("spectrum_exponent", numbers(1, 0.0, 8.0), "3.6666667", "", "beta: the noise's power falls as 1 / frequency^beta", "Perry 2.1.2"),
    default("absolute", Kind::Flag, "false", "", "whether octaves count by their absolute value", "Perry 2.1.2"),
];

/// What `generation_shape` can be (Reeves 1983, 2.2).
#[rustfmt::skip] // one row a line
pub const GENERATION_SHAPES: &[Variant] = &[
    Variant { name: "sphere", about: "a ball around the system's origin", fields: &[
        keyed(required("radius", EXTENT, "1", "world units", "particles leave outward", "Reeves 2.2")),
    ] },
    Variant { name: "circle", about: "a disc", fields: &[
        keyed(required("radius", EXTENT, "1", "world units", "in the local x-y plane", "Reeves 2.2")),
    ] },
    Variant { name: "rectangle", about: "a rectangle in the local x-y plane", fields: &[
        keyed(required("length", EXTENT, "1", "world units", "extent along local x", "Reeves 2.2")),
        keyed(required("width", EXTENT, "1", "world units", "extent along local y", "Reeves 2.2")),
    ] },
    Variant { name: "ring", about: "what is between two circles in the local x-y plane", fields: &[
        keyed(required("inner_radius", EXTENT, "0.8", "world units", "of the inner circle", "")),
        keyed(required("outer_radius", EXTENT, "1", "world units", "of the outer circle", "")),
    ] },
    Variant { name: "box", about: "a box around the system's origin", fields: &[
        keyed(required("length", EXTENT, "1", "world units", "extent along local x", "")),
        keyed(required("width", EXTENT, "1", "world units", "extent along local y", "")),
        keyed(required("height", EXTENT, "1", "world units", "extent along local z", "")),
    ] },
    Variant { name: "cone", about: "a cone that opens along local z", fields: &[
        keyed(required("height", EXTENT, "1", "world units", "along local z, from the apex", "")),
        required("angle_degrees", numbers(1, 0.0, 89.0), "20", "degrees", "from the axis to the side", ""),
    ] },
    Variant { name: "line", about: "a piece of the local x axis", fields: &[
        keyed(required("length", EXTENT, "1", "world units", "extent along local x", "")),
    ] },
    Variant { name: "attractor", about: "the trajectory of a chaotic system", fields: &[
        required("attractor", Kind::Choice(&["lorenz", "rossler", "halvorsen"]), "\"lorenz\"", "", "which chaotic system's trajectory", "Reeves 2.2"),
        keyed(required("radius", EXTENT, "1", "world units", "from its centre to its farthest point", "Reeves 2.2")),
    ] },
    Variant { name: "rings", about: "of a system that bears systems: rings that run over a sphere from its origin, which they begin at, its top along local z", fields: &[
        required("radius", numbers(1, 1e-3, 1e6), "10", "world units", "of the sphere, which is below the local x-y plane and touches it", "Reeves 3"),
        required("wall_speed", numbers(1, 1e-6, 1e4), "0.1", "world units a frame", "how fast the rings run, along the sphere", "Reeves 3"),
        default("ring_frames", whole(1, 65_000), "1", "frames", "from one ring to the next", "Reeves 3"),
        required("density", numbers(1, 0.0, 1e4), "2", "systems a world unit of circumference", "a ring has as many systems, anywhere around it", "Reeves 3"),
    ] },
    Variant { name: "mesh", about: "the faces of a mesh, as many on each part of their area", fields: &[
        required("mesh", text(1000, false), "\"torus\"", "", "a file in the scene's folder that ends in .obj, .ply, .gltf or .glb; or cube, cylinder, plane, sphere, torus or letters:TEXT, which need none", ""),
        keyed(default("scale", numbers(1, 0.0, 1e3), "1", "world units", "what a unit of the mesh's coordinates becomes", "")),
    ] },
];

const VELOCITY: Kind = numbers(3, -1e4, 1e4);
const RADIUS: Kind = numbers(1, 1e-3, 1e6);
const SIDE: Kind = Kind::Choice(&["inside", "outside"]);
const EXTENT: Kind = numbers(1, 0.0, 1e6);
