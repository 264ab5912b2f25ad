//! Strokes of every kind.

use motes::scene::Scene;

use super::scene_of;

/// Strokes of systems that others bear and of one that moves, long and short, straight and bent, wide
/// and thin, through the near plane and the picture's edges, with shadows, lamps, a surface and what
/// else covers.
pub(crate) fn all_kinds_of_strokes() -> Scene {
    let stroke = |name: &str, more: &str| {
        format!(
            "[[system]]
             name = \"{name}\"
             end_frame = 2
             lifetime = {{ mean = 30, var = 29 }}
             ejection_angle_degrees = 70
             color = {{ mean = [0.2, 0.3, 0.1], var = [0.1, 0.1, 0.1], rate = [0.004, 0.002, 0], rate_var = [0.001, 0, 0] }}
             transparency = {{ mean = 0.3, var = 0.3, rate = 0.005 }}
             blend = \"over\"
             particle_shape = \"stroke\"
             {more}\n"
        )
    };
    let systems = [
        stroke(
            "reeds",
            "initial_mean_parts = 30\nspeed = { mean = 0.05, var = 0.03 }\ngeneration_shape = { kind = \"circle\", radius = 2 }\nrotation_degrees = [-90, 0]
             position = { keys = [[0, [0, 0, 0]], [5, [0.3, 0.1, 0]]] }
             acceleration = { keys = [[0, [0, -0.002, 0]], [5, [0.001, -0.002, 0]]] }
             size = { mean = 0.02, var = 0.02, rate = 0.0004 }\nstroke_pieces = 9\nstroke_shadow = 0.5",
        ),
        stroke(
            "arcs",
            "initial_mean_parts = 8\ngeneration_shape = { kind = \"sphere\", radius = 3 }\nspeed = 0.4
             acceleration = [0.01, -0.03, 0.02]\nintegration = \"parabola\"\nsize = 0.1\nstroke_taper = 0.3",
        ),
        // What moves nowhere, and what goes straight on.
        stroke(
            "dots",
            "initial_mean_parts = 5\ngeneration_shape = { kind = \"box\", length = 2, width = 2, height = 2 }\nspeed = 0\nsize = 0.2",
        ),
        stroke(
            "needles",
            "initial_mean_parts = 9\nspeed = { mean = 0.05, var = 0.03 }\ngeneration_shape = { kind = \"sphere\", radius = 1 }\nsize = 0.004\nstroke_taper = 0\nstroke_pieces = 1",
        ),
        "[[system]]
         name = \"bed\"
         rotation_degrees = [-80, 20]
         initial_mean_parts = 3
         end_frame = 2
         generation_shape = { kind = \"rectangle\", length = 3, width = 2 }
         speed = 0.01
         lifetime = 4
         color = [0, 0, 0]
         size = 1\n"
            .to_owned(),
        stroke(
            "clump",
            "parent = \"bed\"\ninitial_mean_parts = 9\nspeed = { mean = 0.05, var = 0.03 }\ngeneration_shape = { kind = \"circle\", radius = 0.1 }
             acceleration = [0, -0.002, 0]\nsize = 0.02\nstroke_shadow = 1\ninherit = { lifetime = { mean = 9 }, color = { mean = [0.1, 0, 0] } }",
        ),
        "[[system]]
         name = \"balls\"
         initial_mean_parts = 9
         generation_shape = { kind = \"sphere\", radius = 2 }
         speed = 0.05
         lifetime = 3
         color = [0.4, 0.3, 0.2]
         size = 0.1
         blend = \"over\"
         shading = \"lit_sphere\"\n"
            .to_owned(),
    ]
    .concat();
    scene_of(&format!(
        "frames = 6
         capacity = 400
         max_systems = 40
         image = {{ width = 93, height = 61, background = [0.1, 0, 0.2] }}
         camera = {{ position = [0.1, 0.8, 3], target = [0, 0.3, 0], near = 0.2 }}
         light = {{ direction = [1, 1, 0.4], color = [0.9, 0.8, 0.7], ambient = [0.1, 0.1, 0.2] }}
         {systems}
         [ground]
         position = [0, -0.1, 0]
         normal = [0.05, 1, 0.1]
         radius = 9
         [[lamp]]
         position = [2, 1, 1]
         color = [0.5, 0.4, 0.3]
         distance = 1.5
         [[lamp]]
         position = [-1, 0.5, -1]
         [[surface]]
         mesh = \"torus\"
         scale = 0.4
         [[layer]]
         name = \"near\"
         point = [0, 0, 0.1]
         normal = [0.1, 0, 1]"
    ))
}

/// Clouds in and around a box of few cells, clear and opaque, soft and sharp, larger than a cell and
/// smaller than any number, beside what throws no shadows.
pub(crate) fn all_kinds_of_clouds() -> Scene {
    let cloud = |name: &str, more: &str| {
        format!(
            "[[system]]
             name = \"{name}\"
             generation_shape = {{ kind = \"sphere\", radius = 1.5 }}
             speed = {{ mean = 0.1, var = 0.05 }}
             lifetime = 3
             color = {{ mean = [0.5, 0.4, 0.6], var = [0.1, 0.1, 0.1] }}
             blend = \"over\"
             {more}\n"
        )
    };
    let systems = [
        cloud("thin", "initial_mean_parts = 900\nshading = \"lit_cloud\"\nsize = { mean = 0.05, var = 0.06 }\ntransparency = { mean = 0.8, var = 0.3, rate = 0.05 }"),
        cloud("thick", "initial_mean_parts = 60\nshading = \"lit_cloud\"\nsize = 0.4\nedge_softness = 0.7\nposition = { keys = [[0, [0, 0, 0]], [4, [1, 1, 0]]] }"),
        cloud("huge", "initial_mean_parts = 2\nshading = \"lit_cloud\"\nsize = 30\ntransparency = 0.9\nedge_softness = 1"),
        cloud("streaks", "initial_mean_parts = 20\nshading = \"lit_cloud\"\nsize = 0.02\nparticle_shape = \"streak\""),
        cloud("balls", "initial_mean_parts = 20\nshading = \"lit_sphere\"\nsize = 0.2"),
    ]
    .concat();
    scene_of(&format!(
        "frames = 4
         image = {{ width = 61, height = 45, background = [0.1, 0, 0.2] }}
         camera = {{ position = [0.1, 0.8, 4], target = [0, 0.1, 0] }}
         light = {{ direction = [1, 2, 0.4], color = [0.9, 0.8, 0.7], ambient = [0.1, 0.1, 0.2], shadow_center = [0.2, 0.1, 0], shadow_radius = 1.3, shadow_cells = 9 }}
         {systems}"
    ))
}
