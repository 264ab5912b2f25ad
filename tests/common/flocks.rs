//! Flocks of every kind.

use motes::scene::Scene;

use super::scene_of;

/// Every kind of relation, edge, look and dimension at once; some of it out of sight, too near or at
/// the same place.
pub(crate) fn all_kinds_of_flocks() -> Scene {
    let box_of = "min = [0, 0, -20], max = [300, 200, 20]";
    // Who does not move, or only along one axis.
    let still = |name: &str, lines: &str| {
        format!(
            "name = \"{name}\"\ncount = 3\nregion = {{ min = [120, 80, 0], max = [180, 120, 0] }}\n\
             start_speed = 0\nsize = 8\n{lines}"
        )
    };
    let flocks = [
        format!(
            "name = \"a\"\ncount = 300\nregion = {{ {box_of} }}\ndimensions = 3\n\
             edges = {{ kind = \"torus\", {box_of} }}\nperception_radius = 18\n\
             [[flock.relation]]\nkind = \"flock\"\n\
             [[flock.relation]]\nkind = \"avoid\"\nother = \"c\"\n"
        ),
        format!(
            "name = \"b\"\ncount = 200\ndimensions = 3\nmass = 3\nmax_speed = 3\n\
             region = {{ min = [5, 25, -15], max = [300, 200, 20] }}\n\
             force = [0.01, 0, 0.02]\nedges = {{ kind = \"repel\", inward = true, {box_of} }}\n\
             [[flock.relation]]\nkind = \"flock\"\nseparation = \"inverse_distance\"\n\
             [[flock.relation]]\nkind = \"flock\"\nother = \"a\"\nradius = 15\n\
             [[flock.relation]]\nkind = \"approach\"\nother = \"c\"\nlimit = 20\n"
        ),
        "name = \"c\"\ncount = 7\nregion = { min = [10, 10, 0], max = [200, 200, 0] }\n\
         start_speed = 10\nedges = { kind = \"constrain\", min = [0, 0, 0], max = [200, 200, 0] }"
            .into(),
        "name = \"boids\"\ncount = 500\nregion = { min = [0, 0, 0], max = [500, 300, 0] }\n\
         edges = { kind = \"wrap\", min = [0, 0, 0], max = [500, 300, 0] }\nforce = [0, 0.1, 0]\n\
         shape = \"disc\"\nopacity = 0.5\nmirrored = true"
            .into(),
        // More cells than two runs of the prefix sum.
        format!(
            "name = \"g\"\ncount = 1500\nregion = {{ {box_of} }}\nopacity = 0\n\
             edges = {{ kind = \"torus\", {box_of} }}\nperception_radius = 5\n\
             [[flock.relation]]\nkind = \"flock\"\n"
        ),
        still("d", "force = [0, 0.1, 0]"),
        still("e", "force = [0, 0, 0.1]\ndimensions = 3"),
        // The last, of one less than sixteen.
        still("f", "").replace("count = 3", "count = 15"),
    ];
    let text: String = flocks
        .iter()
        .map(|lines: &String| format!("[[flock]]\n{lines}\n"))
        .collect();
    scene_of(&format!(
        "image = {{ width = 96, height = 64 }}
         camera = {{ position = [150, 100, -90], target = [150, 100, 0], up = [0, -1, 0], \
         vertical_fov_degrees = 90, near = 75 }}
         {text}
         [[layer]]
         name = \"near\"
         point = [0, 0, 4]
         normal = [0.1, 0, 1]"
    ))
}

/// Flocks with everything that drives boids besides each other, in a plane and in space, some of it at
/// odds; some begin inside of what they may not be in.
pub(crate) fn driven_flocks() -> Scene {
    let box_of = "min = [0, 0, -60], max = [300, 200, 60]";
    let flocks = [
        format!(
            "name = \"deep\"\ncount = 250\ndimensions = 3\nregion = {{ {box_of} }}\ndrag = 0.05\n\
             edges = {{ kind = \"torus\", {box_of} }}\nperception_radius = 24\nshape = \"cone\"\nsize = 9\n\
             goal = {{ position = {{ keys = [[0, [20, 100, 0]], [9, [280, 20, 50]]] }}, \
             slowing_radius = 60 }}\n\
             [[flock.relation]]\nkind = \"flock\"\nview_angle_degrees = 270\nnearest = 7\n\
             [[flock.obstacle]]\nkind = \"sphere\"\ncenter = [150, 100, 0]\nradius = 40\n\
             [[flock.obstacle]]\nkind = \"box\"\nmin = [200, 20, -20]\nmax = [240, 60, 30]\n\
             [[flock.obstacle]]\nkind = \"plane\"\npoint = [10, 10, 0]\nnormal = [1, 2, 0.5]\n\
             [[flock.obstacle]]\nkind = \"mesh\"\nmesh = \"cylinder\"\nposition = [90, 150, 10]\n\
             scale = 35\nmargin = 12\n"
        ),
        format!(
            "name = \"flat\"\ncount = 250\nregion = {{ {box_of} }}\ndrag = 0.2\n\
             shape = \"cone\"\nmirrored = true\nopacity = 0.7\ncolor = [0.9, 0.6, 0.3]\ntrail_frames = 5\n\
             edges = {{ kind = \"wrap\", {box_of} }}\n\
             goal = {{ position = [150, 100, 77], weight = -0.5, speed = 2 }}\n\
             [[flock.relation]]\nkind = \"flock\"\nview_angle_degrees = 120\nradius = 30\n\
             [[flock.relation]]\nkind = \"avoid\"\nother = \"deep\"\nview_angle_degrees = 200\nnearest = 13\n\
             [[flock.obstacle]]\nkind = \"sphere\"\ncenter = [150, 100, 9]\nradius = 90\n\
             stay = \"inside\"\nmargin = 5\n\
             [[flock.obstacle]]\nkind = \"box\"\nmin = [70, 30, 5]\nmax = [230, 180, 6]\n\
             stay = \"inside\"\nlimit = 2\n"
        ),
        format!(
            "name = \"caged\"\ncount = 60\ndimensions = 3\nregion = {{ {box_of} }}\nmax_speed = 9\ntrail_frames = 1\n\
             [[flock.obstacle]]\nkind = \"mesh\"\nmesh = \"cube\"\nposition = [220, 140, -20]\n\
             scale = 30\nstay = \"inside\"\nlimit = 3\n\
             [[flock.obstacle]]\nkind = \"mesh\"\nmesh = \"cylinder\"\nposition = [235, 140, -20]\n\
             scale = 12\n"
        ),
        // Nothing but wind; and one at the very middle of a ball.
        format!(
            "name = \"leaves\"\ncount = 40\ndimensions = 3\nstart_speed = 0\ndrag = 1\ntrail_frames = 8\n\
             region = {{ {box_of} }}\nshape = \"disc\""
        ),
        "name = \"lost\"\ncount = 1\ndimensions = 3\nregion = { min = [50, 50, 0], max = [50, 50, 0] }\n\
         start_speed = 0\n[[flock.obstacle]]\nkind = \"sphere\"\ncenter = [50, 50, 0]\nradius = 30\n\
         [[flock.relation]]\nkind = \"flock\"\nother = \"deep\"\nradius = 60\nview_angle_degrees = 90\n"
            .into(),
        // In a box, each nearest to another of its faces, and heavier than others that are drawn to somebody.
        "name = \"boxed\"\ncount = 50\ndimensions = 3\nmass = 2\n\
         region = { min = [100, 40, -40], max = [180, 120, 40] }\n\
         [[flock.obstacle]]\nkind = \"box\"\nmin = [100, 40, -40]\nmax = [180, 120, 40]\n\
         [[flock.relation]]\nkind = \"approach\"\nother = \"flat\"\nradius = 40\n"
            .into(),
        // So near each other that no one counts more than another.
        "name = \"huddled\"\ncount = 8\nregion = { min = [20, 180, 0], max = [20.2, 180.2, 0] }\n\
         [[flock.relation]]\nkind = \"flock\"\nseparation = \"inverse_distance\"\n"
            .into(),
    ];
    let text: String = flocks
        .iter()
        .map(|lines: &String| format!("[[flock]]\n{lines}\n"))
        .collect();
    scene_of(&format!(
        "image = {{ width = 96, height = 64 }}
         camera = {{ position = [150, 100, -190], target = [150, 100, 0], up = [0, -1, 0] }}
         [[wind]]
         kind = \"vortex\"
         position = [150, 100, 0]
         axis = [0, 0.2, 1]
         speed = 2
         radius = 30
         [[wind]]
         kind = \"curl\"
         strength = 0.4
         scale = [0.02, 0.02, 0.02]
         {text}"
    ))
}
