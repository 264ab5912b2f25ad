//! Surfaces of every kind.

use motes::scene::Scene;

use super::scene_of;

/// Meshes of every size, through each other, the near plane and the picture's edges, with all that may
/// be before or behind them: a planet, a ground, pillars, lamps, flames, light and what covers.
pub(crate) fn all_kinds_of_surfaces() -> Scene {
    let surfaces = [
        (
            "torus",
            "rotation_degrees = { keys = [[0, [70, 20]], [4, [50, 60]]] }\nscale = 0.8",
        ),
        (
            "cube",
            "position = [0.9, -0.3, 0.4]\nrotation_degrees = [25, 40]\nscale = 0.7",
        ),
        (
            "sphere",
            "position = [-0.8, 0.5, -0.4]\nscale = { keys = [[0, 0.3], [4, 0.6]] }",
        ),
        // Through the eye, and far beyond the picture on all sides.
        (
            "plane",
            "position = [0, -0.9, 2]\nrotation_degrees = [-86, 30]\nscale = 40",
        ),
        (
            "cube",
            "position = [1.9, 0.5, 2.9]\nscale = 0.9\nrotation_degrees = [40, 10]",
        ),
        (
            "cylinder",
            "position = [-0.7, -0.4, 2.4]\nscale = 0.4\ncrease_degrees = 180",
        ),
        // Smaller than a pixel, behind the eye, and of no size.
        ("torus", "position = [0.3, 0.6, 0.5]\nscale = 0.004"),
        ("sphere", "position = [0, 0, 9]"),
        ("cube", "scale = 0"),
        // The same as another, in the same place.
        (
            "sphere",
            "position = [0.4, -0.5, 1]\nscale = 0.3\ncolor = [0.9, 0.2, 0.1]",
        ),
        ("sphere", "position = [0.4, -0.5, 1]\nscale = 0.3"),
    ];
    let surfaces: String = surfaces
        .iter()
        .map(|(mesh, lines)| format!("[[surface]]\nmesh = \"{mesh}\"\n{lines}\n"))
        .collect();
    let system = |name: &str, more: &str| {
        format!(
            "[[system]]
             name = \"{name}\"
             initial_mean_parts = 60
             generation_shape = {{ kind = \"sphere\", radius = 2 }}
             speed = {{ mean = 0.1, var = 0.1 }}
             lifetime = 5
             color = {{ mean = [0.3, 0.2, 0.1], var = [0.2, 0.1, 0.1] }}
             {more}\n"
        )
    };
    let systems = [
        system("dots", "size = 0.01"),
        system("discs", "size = { mean = 0.1, var = 0.1 }\nlight = 2"),
        system("streaks", "size = 0.02\nparticle_shape = \"streak\"\nstreak_light = \"constant\"\nlight = { keys = [[0, 0], [4, 40]] }"),
        system("squares", "size = 0.05\nparticle_shape = \"rectangle\"\nlight = 3"),
        system("smoke", "size = 0.3\nblend = \"over\"\ntransparency = 0.4"),
        system(
            "balls",
            "size = 0.1\nblend = \"over\"\nshading = \"lit_sphere\"",
        ),
    ]
    .concat();
    scene_of(&format!(
        "frames = 5
         image = {{ width = 93, height = 61, background = [0.01, 0, 0.02] }}
         camera = {{ position = [0.1, 0.3, 3], target = [0, 0.1, 0], near = 0.2 }}
         light = {{ direction = [1, 1, 1], color = [0.4, 0.3, 0.2], ambient = [0.02, 0.03, 0.01] }}
         planet = {{ center = [1, 0.4, -1], radius = 0.8 }}
         {surfaces}{systems}
         [ground]
         position = [0, -0.6, 0]
         normal = [0.05, 1, 0.1]
         radius = 9
         [[pillar]]
         position = [-0.2, -0.6, 0.8]
         radius = 0.2
         height = 1.1
         [[lamp]]
         position = [2, 2, 1]
         color = [0.5, 0.4, 0.3]
         distance = 1.5
         [[fire]]
         name = \"ring\"
         lights = 4
         roots = {{ kind = \"circle\", radius = 0.7, count = 12 }}
         height = 0.7
         width = 0.3
         details = 1
         [[layer]]
         name = \"near\"
         point = [0, 0, 0.1]
         normal = [0.1, 0, 1]"
    ))
}
