//! Fires of every kind.

use motes::scene::Scene;

use super::scene_of;

/// Every kind of root, speed, wind and look at once; some of it out of sight, too near, below a
/// ceiling, not yet kindled or burnt down.
pub(crate) fn all_kinds_of_fires() -> Scene {
    let fires = [
        // Candles, some with extents of their own; one behind the eye, one that comes later.
        "name = \"candles\"\nspeed = \"free\"\nstart_speed = 4\nlights = 3\nheight = { mean = 0.8, var = 0.2 }\n\
         width = { mean = 0.3, var = 0.1 }\nroots = { kind = \"line\", length = 2, count = 3 }\n\
         [[fire.flame]]\nposition = [0.2, 0.1, 0.3]\nheight = 1.5\nbrightness = 2\n\
         [[fire.flame]]\nposition = [0, 1, 6]\nwidth = 0.7\nnormal = [0.3, -0.5, 0.2]\n\
         [[fire.flame]]\nposition = [-0.4, 0, 0]\nfirst_frame = 3\n"
            .to_owned(),
        // A ring that turns and moves; flames one after the other, that grow and burn down.
        "name = \"ring\"\nposition = { keys = [[0, [0, 0.5, 0]], [6, [0.6, 0.7, 0.2]]] }\n\
         rotation_degrees = { keys = [[0, [10, 0]], [6, [25, 80]]] }\n\
         roots = { kind = \"circle\", radius = 0.7, count = 9 }\nkindling_frames = 7\n\
         lifetime = 3\ngrowth_frames = 2\nheight = 0.6\nnoisiness = 0.3\nsampling = 0.7\n"
            .to_owned(),
        // Small ones, that cover less than a pixel.
        "name = \"bed\"\nposition = [0, -0.3, -3]\nroots = { kind = \"disc\", radius = 2, count = 40 }\n\
         height = 0.3\nwidth = 0.02\nlight = 30\nlights = 5\nramp = [{ age = 0.5, center = [1, 2, 3], rim = [0.5, 0, 0.2], \
         alpha = 0.5, rim_alpha = 0.25 }]\n"
            .to_owned(),
        "name = \"ball\"\nposition = [0.5, 0.3, -1]\nwind_factor = 3\ninverse_cohesion = 4\n\
         roots = { kind = \"mesh\", mesh = \"sphere\", scale = 0.5, count = 60 }\nlights = 4\nlight_from = \"tip\"\nheight = 0.7\n\
         width = 0.2\nnoisiness = 0.1\ndetails = 2\ncolor_noise = 0.6\ngravity = [0.2, -1, 0.1]\n"
            .to_owned(),
        // Below a ceiling: in still air, the rise stops what goes down.
        "name = \"ceiling\"\nwind_factor = 0\nnoisiness = 0\nheight = 0.5\n\
         [[fire.flame]]\nposition = [-0.8, 1.2, 0]\nnormal = [0, -1, 0]\n"
            .to_owned(),
        // The same where a wind blows along it.
        "name = \"draught\"\nnoisiness = 0\nheight = 0.5\n\
         [[fire.flame]]\nposition = [-0.8, 1.2, 0]\nnormal = [0, -1, 0]\n"
            .to_owned(),
        // A strip and particles with matrices, bent by a strong noise.
        "name = \"strips\"\nform = \"strip\"\nposition = [0.3, -0.2, 0.5]\nheight = 1.2\nwidth = 0.5\n\
         roots = { kind = \"circle\", radius = 0.6, count = 5 }\nnoisiness = 0.2\nsampling = 0.4\n\
         color_noise = 0.3\nstrip_contrast = 0.8\n[[fire.flame]]\nposition = [0, 0, 5]\n\
         [[fire.flame]]\nposition = [0, 0.5, 2.2]\nnormal = [0, 0, 1]\n"
            .to_owned(),
        "name = \"skewed\"\nposition = [-0.2, 0.2, -0.5]\nroots = { kind = \"line\", length = 1.5, count = 4 }\n\
         particle_matrix = [0.5, 0.75, 0, 0.4, -0.25, 1.5, 0, -0.6, 0.3, -2, 1, 1.5, 0.1, -0.2, 0, 1.1]\nmatrix_noise = 0.5\ndetails = 1\n"
            .to_owned(),
        // One that is kindled after the others and burns for two frames: its light is dark, lit and dark again.
        "name = \"brief\"\nfirst_frame = 1\nlifetime = 2\n[[fire.flame]]\nposition = [0.4, 0, 0.2]\nheight = 0.5\n"
            .to_owned(),
        // Larger than the picture.
        "name = \"huge\"\nheight = 6\nwidth = 9\nbrightness = 0.05\ninner_alpha = 2\ninner_radius = 0.3\n\
         [[fire.flame]]\nposition = [0, -2, -2]\n"
            .to_owned(),
    ];
    let text: String = fires
        .iter()
        .map(|lines: &String| format!("[[fire]]\n{lines}\n"))
        .collect();
    scene_of(&format!(
        "image = {{ width = 93, height = 61, background = [0.01, 0, 0.02] }}
         camera = {{ position = [0, 0.6, 3], target = [0, 0.4, 0] }}
         light = {{ direction = [1, 1, 1], color = [0.1, 0.1, 0.2], ambient = [0.02, 0.03, 0.01] }}
         {text}
         [ground]
         position = [0, -0.6, 0]
         normal = [0.05, 1, 0.1]
         radius = 9
         contrast = 0.6
         scale = 3
         octaves = 3
         [[pillar]]
         position = [-0.5, -0.6, 0.4]
         radius = 0.2
         height = 0.7
         translucence = 0.5
         depth = 0.2
         [[pillar]]
         position = [0.6, -0.7, -0.3]
         radius = 0.3
         height = 1.6
         color = [0.2, 0.5, 0.7]
         [[lamp]]
         position = [2, 2, 1]
         color = [0.5, 0.4, 0.3]
         distance = 1.5
         [[wind]]
         kind = \"vortex\"
         position = [0.2, 0, 0]
         speed = 0.3
         [[wind]]
         kind = \"noise\"
         strength = 0.1
         [[layer]]
         name = \"near\"
         point = [0, 0, 0.1]
         normal = [0.1, 0, 1]"
    ))
}
