//! The tables of flocks. A row is as in the other tables.

use super::rows::{DIRECTION, PLACE, default, keyed, numbers, optional, required, text, whole};
use super::{Field, Kind, Variant};

/// Keys of each `[[flock]]`.
#[rustfmt::skip] // one row a line
pub const FLOCK: &[Field] = &[
    required("name", Kind::Name { reserved: &[] }, "\"flock\"", "", "unique among flocks; a part of every boid's identity", ""),
    required("count", whole(1, 32_000_000), "500", "boids", "how many; all flocks together have at most 32_000_000", ""),
    default("dimensions", whole(2, 3), "2", "", "2: boids live in the plane of z = 0, and no z of the flock counts; 3: they live in space", ""),
    required("region", Kind::Table(REGION), "{ min = [0, 0, 0], max = [500, 300, 0] }", "", "where boids are at first", ""),
    default("mass", numbers(1, 1e-6, 1e6), "1", "", "what forces are divided by", ""),
    keyed(default("size", numbers(1, 1e-6, 1e4), "3", "world units, pixels of a point", "base of the triangle, or diameter of the disc or of the cone's base", "")),
    keyed(default("max_speed", numbers(1, 1e-6, 1e4), "2", "world units a frame", "velocities are limited to it after each move", "")),
    keyed(default("color", numbers(3, 0.0, 1.0), "[1, 1, 1]", "display-referred red, green, blue", "colour", "")),
    default("start_speed", numbers(1, 0.0, 1e4), "1", "world units a frame", "speed at first, in a random direction", ""),
    keyed(default("force", numbers(3, -1e4, 1e4), "[0, 0, 0]", "mass times world units a frame squared", "a constant force, such as gravity", "")),
    default("perception_radius", RADIUS, "60", "world units", "how far a boid sees, unless a relation says otherwise", ""),
    default("edges", Kind::Variants(EDGES), "{ kind = \"none\" }", "", "what happens at the ends of the world", ""),
    default("relation", Kind::List { variants: RELATIONS, max: 16 }, "[]", "", "what the flock makes of others and of itself, one `[[flock.relation]]` each; without any, boids are free particles", ""),
    optional("goal", Kind::Table(GOAL), "{ position = [250, 150, 0] }", "", "a place that boids steer to", "Reynolds 1999"),
    default("obstacle", Kind::List { variants: OBSTACLES, max: 16 }, "[]", "", "what boids turn away from and never enter, one `[[flock.obstacle]]` each; of those that overlap, the last counts", "Reynolds 1988"),
    keyed(default("drag", numbers(1, 0.0, 1.0), "0", "a share of the velocity", "how much of its velocity against the wind a boid loses each frame", "")),
    default("shape", Kind::Choice(&["triangle", "disc", "point", "cone"]), "\"triangle\"", "", "what a boid looks like: a triangle that points where it flies, or a disc; that of a point has its size in pixels; or a cone that points where it flies, with a round base, two and a half times as long as that is wide, and lit by `light`", ""),
    default("opacity", numbers(1, 0.0, 1.0), "1", "0 invisible, 1 opaque", "how much of what is behind it a boid hides", ""),
    default("trail_frames", whole(0, 64), "0", "frames", "how long the trail is that a boid draws behind it; it fades and narrows", ""),
    default("mirrored", Kind::Flag, "false", "", "whether each boid is drawn a second time, mirrored at the picture's upright middle line", ""),
];

/// Keys of a flock's `region`.
#[rustfmt::skip] // one row a line
pub const REGION: &[Field] = &[
    required("min", PLACE, "[0, 0, 0]", "world units", "the corner with the least coordinates", ""),
    required("max", PLACE, "[500, 300, 0]", "world units", "the corner with the greatest", ""),
];

/// What a flock's `edges` can be.
#[rustfmt::skip] // one row a line
pub const EDGES: &[Variant] = &[
    Variant { name: "none", about: "the world has no ends", fields: &[] },
    Variant { name: "wrap", about: "boids beyond an edge are put on the opposite one", fields: REGION },
    Variant { name: "repel", about: "velocities are reversed at the edges", fields: &[
        REGION[0], REGION[1],
        default("inward", Kind::Flag, "false", "", "whether velocities are turned inward instead, so that boids beyond an edge do not stick there", ""),
    ] },
    Variant { name: "constrain", about: "velocities are multiplied at the edges", fields: &[
        REGION[0], REGION[1],
        default("factor", numbers(1, -100.0, 100.0), "-4", "", "by this", ""),
    ] },
    Variant { name: "torus", about: "opposite edges are the same, and boids see across them", fields: REGION },
];

/// Keys of a flock's `goal`.
#[rustfmt::skip] // one row a line
pub const GOAL: &[Field] = &[
    keyed(required("position", PLACE, "[250, 150, 0]", "world units", "the place; on a torus they take the nearest way to it", "")),
    keyed(default("weight", WEIGHT, "1", "", "factor of the acceleration; below 0 they flee", "")),
    default("speed", SPEED, "4", "world units a frame", "the speed that boids want to it", ""),
    default("limit", LIMIT, "0.1", "world units a frame squared", "most that they accelerate", ""),
    default("slowing_radius", numbers(1, 0.0, 1e6), "0", "world units", "within it they slow down, so as to arrive", ""),
];

/// What a `[[flock.obstacle]]` can be.
#[rustfmt::skip] // one row a line
pub const OBSTACLES: &[Variant] = &[
    Variant { name: "sphere", about: "boids stay outside a ball, or inside it", fields: &[
        required("center", PLACE, "[250, 150, 0]", "world units", "its centre", ""),
        required("radius", numbers(1, 1e-3, 1e6), "40", "world units", "its radius", ""),
        STAY, MARGIN, PUSH,
    ] },
    Variant { name: "plane", about: "boids stay in front of a plane", fields: &[
        required("point", PLACE, "[0, 0, 0]", "world units", "a point of it", ""),
        required("normal", DIRECTION, "[0, 1, 0]", "world space", "where it faces", ""),
        MARGIN, PUSH,
    ] },
    Variant { name: "box", about: "boids stay outside a box along the axes, or inside it", fields: &[
        required("min", PLACE, "[-20, -20, -20]", "world units", "the corner with the least coordinates", ""),
        required("max", PLACE, "[20, 20, 20]", "world units", "the corner with the greatest", ""),
        STAY, MARGIN, PUSH,
    ] },
    Variant { name: "mesh", about: "boids of a flock in space stay outside a mesh, or inside it; it has no open edges, and all of a flock have at most 10_000 faces", fields: &[
        required("mesh", text(1000, false), "\"torus\"", "", "a file in the scene's folder that ends in .obj, .ply, .gltf or .glb; or cube, cylinder, sphere, torus or letters:TEXT, which need none", ""),
        default("position", PLACE, "[0, 0, 0]", "world units", "where its origin is", ""),
        default("scale", numbers(1, 1e-6, 1e4), "1", "world units", "what a unit of the mesh is", ""),
        STAY, MARGIN, PUSH,
    ] },
];

const STAY: Field = default(
    "stay",
    Kind::Choice(&["outside", "inside"]),
    "\"outside\"",
    "",
    "on which side of it boids stay",
    "",
);
const MARGIN: Field = default(
    "margin",
    numbers(1, 1e-3, 1e6),
    "20",
    "world units",
    "how far from its surface boids begin to turn away",
    "",
);
const PUSH: Field = default(
    "limit",
    LIMIT,
    "0.5",
    "world units a frame squared",
    "most that they accelerate away from it, at its surface",
    "",
);
const VIEW: Field = default(
    "view_angle_degrees",
    numbers(1, 1.0, 360.0),
    "360",
    "degrees",
    "how wide they see around where they fly; who does not move sees all around",
    "Reynolds 1987",
);

const NEAREST: Field = optional(
    "nearest",
    whole(1, 16),
    "7",
    "",
    "how many of those they see count, the nearest; all if left out; of those that are as far, the first of their flock",
    "",
);

/// What a `[[flock.relation]]` can be.
#[rustfmt::skip] // one row a line
pub const RELATIONS: &[Variant] = &[
    Variant { name: "flock", about: "boids flock with those they see, by Reynolds' three rules", fields: &[
        optional("other", OTHER, "\"flock\"", "", "with which flock; its own if left out", ""),
        optional("radius", RADIUS, "60", "world units", "how far they see; the flock's `perception_radius` if left out", ""),
        VIEW, NEAREST,
        default("separation_weight", WEIGHT, "1", "", "factor of the separation; 0 for none", ""),
        default("separation_speed", SPEED, "4", "world units a frame", "the speed that boids want away from each other", ""),
        default("separation_limit", LIMIT, "0.3", "world units a frame squared", "most that separation accelerates", ""),
        default("separation", Kind::Choice(&["literal", "inverse_distance"]), "\"literal\"", "", "whether all count alike, or near ones more", ""),
        default("alignment_weight", WEIGHT, "1", "", "factor of the alignment; 0 for none", ""),
        default("alignment_speed", SPEED, "4", "world units a frame", "the speed that boids want where others go", ""),
        default("alignment_limit", LIMIT, "0.2", "world units a frame squared", "most that alignment accelerates", ""),
        default("cohesion_weight", WEIGHT, "1", "", "factor of the cohesion; 0 for none", ""),
        default("cohesion_speed", SPEED, "4.5", "world units a frame", "the speed that boids want to the middle of the others", ""),
        default("cohesion_limit", LIMIT, "0.2", "world units a frame squared", "most that cohesion accelerates", ""),
    ] },
    Variant { name: "avoid", about: "boids flee from each of those they see", fields: &[
        required("other", OTHER, "\"flock\"", "", "from which flock", ""),
        default("radius", RADIUS, "40", "world units", "how far they see", ""),
        VIEW, NEAREST,
        default("limit", LIMIT, "1", "world units a frame squared", "most that each of them accelerates", ""),
    ] },
    Variant { name: "approach", about: "each of those they see pulls boids", fields: &[
        required("other", OTHER, "\"flock\"", "", "to which flock", ""),
        default("radius", RADIUS, "60", "world units", "how far they see", ""),
        VIEW, NEAREST,
        default("limit", LIMIT, "0.4", "mass times world units a frame squared", "most that each of them pulls", ""),
    ] },
];

const OTHER: Kind = Kind::Name { reserved: &[] };
const RADIUS: Kind = numbers(1, 1e-6, 1e6);
const WEIGHT: Kind = numbers(1, -100.0, 100.0);
const SPEED: Kind = numbers(1, 0.0, 1e4);
const LIMIT: Kind = numbers(1, 1e-6, 1e4);
