//! Trees of systems and a planet, with all that they can have.

use motes::scene::Scene;

use super::scene_of;

/// Everything that children can have, on three levels, with parameters that change.
pub(crate) fn rich_tree() -> Scene {
    let parent = "name = \"parent\"
        position = { keys = [[0, [0, 0, 0]], [12, [3, 1, 0]]] }
        rotation_degrees = { keys = [[0, [0, 10]], [12, [40, -30]]] }
        initial_mean_parts = 2.5
        var_parts = 2
        burst = [{ frame = 1, parts = 4 }]
        generation_shape = { kind = \"sphere\", radius = 3 }
        ejection_angle_degrees = 40
        speed = { mean = 0.2, var = 0.1 }
        lifetime = { mean = 6, var = 3 }
        acceleration = [0, -0.01, 0]
        color = [0, 0, 0]
        size = 1";
    let middle = "name = \"middle\"
        parent = \"parent\"
        child_up = \"outward\"
        particle_space = \"world\"
        end_frame = 4
        initial_mean_parts = 1
        generation_shape = { kind = \"ring\", inner_radius = 0.4, outer_radius = 1 }
        ejection_angle_degrees = 20
        speed = 0.1
        lifetime = 4
        color = { mean = [0.1, 0.2, 0.3], rate = [0.01, 0, 0] }
        size = { mean = 0.5, rate = 0.01 }
        [system.inherit]
        generation_scale = 0.4
        color = { mean = [0.1, 0.1, 0.1], var = [0.1, 0.1, 0.1], rate = [0.01, 0.01, 0.01] }
        size = { mean = 0.02, var = 0.01, rate = 0.001, rate_var = 0.001 }";
    let puff = "name = \"puff\"
        parent = \"middle\"
        rotation_degrees = [20, 30]
        position = [0.1, 0, 0.2]
        first_frame = 1
        initial_mean_parts_per_area = 0.05
        delta_mean_parts_per_area = -0.004
        var_parts_per_area = 0.01
        burst = [{ frame = 0, parts = { mean = 6, var = 3 } }]
        generation_shape = { kind = \"cone\", height = 0.5, angle_degrees = 20 }
        ejection_angle_degrees = 30
        speed = { keys = [[0, 0.1], [12, 0.3]] }
        lifetime = { mean = 5, var = 2 }
        acceleration = [0, 0, -0.02]
        acceleration_space = \"system\"
        color = { mean = [0.4, 0.1, 0.02], var = [0.1, 0, 0] }
        transparency = 0.2
        size = 0.05
        particle_shape = \"streak\"
        birth_moment = \"within_frame\"
        [system.inherit]
        mean_parts = 0.02
        var_parts = 0.01
        ejection_angle_degrees = 20
        speed = { mean = 0.05, var = 0.02 }
        lifetime = { mean = 1, var = 1 }
        transparency = { mean = 0.1, var = 0.1, rate = 0.01, rate_var = 0.01 }
        color = { mean = [0.1, 0.1, 0.1], rate_var = [0.01, 0.01, 0.01] }";
    scene_of(&format!(
        "frames = 14
         capacity = 20_000
         image = {{ width = 160, height = 90 }}
         camera = {{ position = [0, 1, 14], target = [0, 0, 0] }}
         [[system]]\n{parent}\n[[system]]\n{middle}\n[[system]]\n{puff}"
    ))
}

/// The same with slots for few of the systems that are borne.
pub(crate) fn crowded_tree() -> Scene {
    Scene {
        max_systems: Some(7),
        ..rich_tree()
    }
}

/// Rings of systems that throw light on a planet under a sun and a lamp, before stars, while the camera moves
/// and its lens turns; the picture is of no whole fours of pixels.
pub(crate) fn lit_planet() -> Scene {
    scene_of(
        "image = { width = 129, height = 71, background = [0.1, 0, 0.2] }
         camera = { position = { keys = [[0, [4, 9, 20]], [12, [-3, 8, 19]]] }, target = [0, 1, 5], vertical_fov_degrees = { keys = [[0, 45], [12, 52]] } }
         light = { direction = [1, 0.2, 0.4], ambient = [0.05, 0.05, 0.05] }
         planet = { center = [0.5, 0, 0], radius = 10, color = [0.7, 0.5, 0.3], relief = 0.4, contrast = 0.8, octaves = 3 }
         [[lamp]]
         position = [0, 0, 13]
         color = { keys = [[0, [0, 0, 0]], [6, [3, 2, 1]]] }
         distance = 2
         [[lamp]]
         position = [9, 9, 4]
         color = [0.2, 0.5, 0.9]
         distance = 3
         [[system]]
         name = \"wall\"
         position = [0.5, 0, 10]
         generation_shape = { kind = \"rings\", radius = 10, wall_speed = 0.8, ring_frames = 2, density = 0.8 }
         speed = 0
         lifetime = 8
         color = [0, 0, 0]
         size = 1
         [[system]]
         name = \"child\"
    parent = \"wall\"
    initial_mean_parts = 4
    birth_rounding = \"nearest\"
    generation_shape = { kind = \"circle\", radius = 0.5 }
    ejection_angle_degrees = 20
    speed = { mean = 0.2, var = 0.05 }
    lifetime = { mean = 10, var = 2 }
    color = [0.4, 0.1, 0.02]
    size = 0.05
    light = 40
         [system.inherit]
         speed = 0.1
         [[system]]
         name = \"stars\"
         first_frame = -1
         end_frame = 0
         initial_mean_parts = 400
         generation_shape = { kind = \"sphere\", radius = 60 }
         speed = 0
         color = [1, 1, 1]
         size = { mean = 0.3, var = 0.25 }"
    )
}
