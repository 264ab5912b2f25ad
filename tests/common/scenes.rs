//! Scenes to test on: small, and made to reach every branch.

use std::sync::Arc;

use motes::mesh;
use motes::plan::{FrameInputs, Plan, Turn};
use motes::scene::{self, GenerationShape, Scene, Spread, System};

/// One system of [`everything`] on its own cannot reach all branches; together they do:
/// all generation and particle shapes, both kinds of streak light, both roundings, births that
/// vary, grow, shrink and stop, rates of both signs, negative speeds, thresholds, transparencies
/// that clamp, particles off-screen, on the picture's edges, behind the camera and across its near plane, discs larger
/// than the picture and smaller than a pixel, particles at rest, sums of light that carry in one channel or in all.
const EVERYTHING: &str = r#"
frames = 16
seed = 77

[image]
width = 161
height = 91
background = [0.02, 0.3, 0.11]
shutter = 0.7

[camera]
position = [1.4, 1.2, 4.5]
target = [0.1, 0.3, 0.2]
up = [0.2, 1, 0.1]
near = 0.25

[[system]]
name = "jet"
position = [-0.4, -0.6, 0.2]
rotation_degrees = [-80, 25]
initial_mean_parts = 60
var_parts = 25
birth_rounding = "nearest"
generation_shape = { kind = "circle", radius = 0.3 }
ejection_angle_degrees = 20
speed = { mean = 0.25, var = 0.1 }
lifetime = { mean = 9, var = 5 }
color = { mean = [0.3, 0.2, 0.1], var = [0.3, 0.1, 0.15], rate = [0.02, -0.01, 0.03] }
transparency = { mean = 0.2, var = 0.3, rate = 0.05 }
size = { mean = 0.05, var = 0.03, rate = -0.004 }
acceleration = [0.01, -0.03, 0.02]
particle_shape = "streak"
intensity_threshold = 0.09

[[system]]
name = "ball"
position = [0.9, 0.4, -0.3]
rotation_degrees = [200, -130]
initial_mean_parts = 45
delta_mean_parts = -6
var_parts = 40
generation_shape = { kind = "sphere", radius = 0.6 }
speed = { mean = -0.05, var = 0.08 }
lifetime = { mean = 6, var = 5.9 }
color = { mean = [0.05, 0.2, 0.4], var = [0.06, 0.1, 0.2], rate = [-0.004, 0.02, -0.02] }
transparency = { mean = 0.9, var = 0.4, rate = -0.06 }
size = { mean = 0.005, var = 0.01, rate = 0.001 }
acceleration = [0, 0.01, -0.01]

[[system]]
name = "plate"
position = [-1.2, 0.9, -1]
rotation_degrees = [33, 12]
initial_mean_parts = 110
var_parts = 10
generation_shape = { kind = "rectangle", length = 2, width = 0.7 }
ejection_angle_degrees = 180
speed = { mean = 0.08, var = 0.08 }
lifetime = { mean = 8, var = 2 }
color = { mean = [0.1, 0.02, 0.05], var = [0.1, 0.02, 0.05] }
transparency = { mean = 0.1, var = 0.1, rate = -0.05 }
size = { mean = 0.06, var = 0.05, rate = 0.003 }
particle_shape = "rectangle"

[[system]]
name = "sparks"
position = [0.2, 0.2, 0]
initial_mean_parts = 30
var_parts = 30
generation_shape = { kind = "sphere", radius = 0.05 }
speed = { mean = 0.5, var = 0.5 }
lifetime = { mean = 10, var = 3 }
color = { mean = [0.2, 0.15, 0.02], var = [0.1, 0.1, 0.02], rate = [-0.02, -0.02, 0] }
size = { mean = 0.02, var = 0.018 }
acceleration = [0, -0.05, 0]
particle_shape = "streak"
streak_light = "constant"

[[system]]
name = "around-the-camera"
position = [1.3, 1.1, 4.2]
initial_mean_parts = 2.4
var_parts = 1.5
generation_shape = { kind = "sphere", radius = 0.7 }
speed = { mean = 0.02, var = 0.05 }
lifetime = { mean = 5, var = 4 }
color = { mean = [0.05, 0.03, 0.01], var = [0.02, 0.02, 0.02] }
transparency = 0.5
size = { mean = 0.1, var = 0.4 }

[[system]]
name = "at-rest"
position = [0.5, 0.6, 0.4]
rotation_degrees = [0, 90]
initial_mean_parts = 1
var_parts = 4
generation_shape = { kind = "circle", radius = 0.8 }
speed = 0
lifetime = { mean = 4, var = 3.4 }
color = { mean = [0.5, 0.1, 0.3], var = [0.1, 0.1, 0.1] }
size = { mean = 0.04, var = 0.06 }
particle_shape = "streak"

[[system]]
name = "passing-cloud"
position = [0, -0.9, -2]
first_frame = 3
end_frame = 9
initial_mean_parts_per_area = 0.02
delta_mean_parts_per_area = 0.006
var_parts_per_area = 0.01
generation_shape = { kind = "circle", radius = 0.9 }
ejection_angle_degrees = 75
speed = { mean = 0.03, var = 0.02 }
lifetime = { mean = 3, var = 1.5 }
color = { mean = [0.05, 0.05, 0.06], var = [0.01, 0.01, 0.01] }
size = { mean = 0.07, var = 0.05, rate = -0.02 }
particle_shape = "streak"

[[system]]
name = "torch"
position = [-0.7, 0.1, 0.5]
initial_mean_parts = 2.5
var_parts = 2
generation_shape = { kind = "rectangle", length = 0.01, width = 0 }
speed = 0
lifetime = { mean = 6, var = 1 }
color = { mean = [900, 650, 980], var = [90, 10, 200], rate = [-30, 40, 0] }
size = { mean = 0.05, var = 0.02 }
particle_shape = "rectangle"

[[system]]
name = "red-torch"
position = [-1.2, -0.5, 0.4]
initial_mean_parts = 3
generation_shape = { kind = "rectangle", length = 0.1, width = 0.1 }
speed = 0
lifetime = 8
color = [990, 0.1, 0.01]
size = { mean = 0.08, var = 0.02 }
particle_shape = "rectangle"

[[system]]
name = "green-torch"
position = [0.9, -0.4, 0.1]
initial_mean_parts = 3
generation_shape = { kind = "rectangle", length = 0.1, width = 0.1 }
speed = 0
lifetime = 8
color = [0.02, 970, 0]
size = { mean = 0.08, var = 0.02 }
particle_shape = "rectangle"

[[system]]
name = "blue-torch"
position = [0.1, 1.2, 0.3]
initial_mean_parts = 3
generation_shape = { kind = "rectangle", length = 0.1, width = 0.1 }
speed = 0
lifetime = 8
color = [0, 0.2, 980]
size = { mean = 0.08, var = 0.02 }
particle_shape = "rectangle"

[[system]]
name = "backdrop"
position = [0, 0.2, -1]
rotation_degrees = [-10, 15]
initial_mean_parts = 90
generation_shape = { kind = "rectangle", length = 14, width = 9 }
speed = 0.01
lifetime = { mean = 6, var = 2 }
color = { mean = [0.2, 0.25, 0.15], var = [0.4, 0.4, 0.4], rate = [0.05, 0.04, 0.06] }
transparency = { mean = 0.5, var = 0.3, rate = 0.2 }
intensity_threshold = 0
size = { mean = 0.02, var = 0.015 }

[[system]]
name = "dust"
position = [0.3, 0.3, 0]
rotation_degrees = [15, 40]
initial_mean_parts = 260
var_parts = 160
generation_shape = { kind = "sphere", radius = 1.9 }
speed = { mean = 0.01, var = 0.03 }
lifetime = { mean = 9, var = 4 }
color = { mean = [0.01, 0.012, 0.02], var = [0.01, 0.01, 0.02], rate = [-0.001, 0.0005, -0.001] }
size = { mean = 0.000002, var = 0.02 }
acceleration = [-0.002, 0, 0.001]
intensity_threshold = 0.008
intensity = "luminance"
"#;

/// A scene from its text.
///
/// # Panics
/// Fails the test where the text is no scene.
pub(crate) fn scene_of(toml: &str) -> Scene {
    match scene::parse(toml, "test.toml", "test") {
        Ok(scene) => scene,
        Err(e) => panic!("{e}"),
    }
}

/// The scene that reaches every branch: about 5,000 particles, 160 × 90 pixels.
pub(crate) fn everything() -> Scene {
    scene_of(EVERYTHING)
}

/// [`everything`] with room for only `capacity` particles, so that births are dropped.
pub(crate) fn everything_within(capacity: u32) -> Scene {
    Scene {
        capacity: Some(capacity),
        ..everything()
    }
}

/// [`everything`], planned with parameters that change at frames 3, 4 and 8, so that rows of
/// several frames are in use.
pub(crate) fn everything_turning(scene: &Scene) -> Plan {
    let turn = |frame: u32, change: &dyn Fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        Turn { frame, scene }
    };
    let turns = [
        turn(3, &|scene| {
            for system in &mut scene.systems {
                system.color.initial.mean.rotate_left(1);
                system.speed.mean *= -0.5;
                if let Some(lifetime) = &mut system.lifetime {
                    lifetime.mean += 1.0;
                }
            }
        }),
        turn(4, &|scene| {
            scene.camera.position[0] -= 0.3;
            scene.camera.vertical_fov_degrees = 70.0;
            for system in &mut scene.systems {
                system.size.initial.mean *= 1.5;
                system.acceleration[1] += 0.01;
            }
        }),
        turn(8, &|scene| {
            scene.image.shutter = 1.0;
            scene.systems.iter_mut().for_each(|system| {
                system.transparency.initial.var = 0.3;
                system.intensity_threshold = Some(0.01);
            });
        }),
    ];
    Plan::with_turns(scene, &turns, scene.frames).expect("the scene can be planned")
}

/// Gives particles that are born from now on a lifetime.
pub(crate) fn set_lifetime(system: &mut System, mean: f32, var: f32) {
    system.lifetime = Some(Spread { mean, var });
}

/// The inputs of the first `count` frames of a plan.
pub(crate) fn frames_of(plan: &Plan, count: u32) -> Vec<FrameInputs> {
    (0..count).map(|frame| plan.inputs(frame)).collect()
}

/// A few particles that cover much of the picture, each of which several invocations draw: streaks
/// of both kinds that cross it, discs and squares larger than it, and light that carries.
pub(crate) fn large_shapes(width: u32, height: u32) -> Scene {
    let system = |name: &str, at: &str, color: &str, rest: &str| {
        format!(
            "[[system]]\nname = \"{name}\"\nposition = [{at}]\ninitial_mean_parts = 2\n\
             generation_shape = {{ kind = \"sphere\", radius = 0.5 }}\nlifetime = 3\n\
             color = {{ mean = [{color}], var = [0.05, 0.05, 0.05], rate_var = [0.03, 0.02, 0.01] }}\n\
             transparency = {{ mean = 0.3, var = 0.2 }}\n{rest}\n"
        )
    };
    let streak = "speed = { mean = 2, var = 1 }\nsize = { mean = 0.9, var = 0.6 }\n\
                  acceleration = [0.3, -0.2, 0.1]\nparticle_shape = \"streak\"\n";
    let large = "speed = 0.01\nsize = { mean = 1, var = 0.7 }\nlight_distance = 4\n";
    let systems = [
        system("streaks", "0.1, -0.3, 0", "0.3, 0.2, 0.1", streak),
        system(
            "constant-streaks",
            "-0.6, 0.5, 0.2",
            "0.1, 0.2, 0.15",
            &format!("{streak}streak_light = \"constant\""),
        ),
        system("discs", "0.7, 0.2, 1", "0.1, 0.2, 0.3", large),
        system(
            "squares",
            "-0.2, -0.6, 1.5",
            "0.2, 0.1, 0.3",
            &format!("{large}particle_shape = \"rectangle\""),
        ),
        system(
            "bright",
            "-0.5, 0.8, 0.5",
            "990, 980, 0",
            &format!("{large}particle_shape = \"rectangle\""),
        ),
        system("bright-discs", "0.9, 0.6, 0.5", "0, 0, 1000", large),
    ];
    scene_of(&format!(
        "frames = 4\n[image]\nwidth = {width}\nheight = {height}\n[camera]\n\
         position = [0.3, -0.2, 4]\ntarget = [0.1, 0.1, 0]\n{}",
        systems.concat()
    ))
}

/// Light so bright that only a long sum of it is told apart, in squares that lie across each other
/// and in streaks that begin and end inside and outside of every edge or hardly move, in a picture whose
/// pixels are no multiple of four; and a wind of one part.
pub(crate) fn glaring() -> Scene {
    scene_of(
        r#"
frames = 6
[image]
width = 62
height = 47
shutter = 1
exposure = 0.00004
[camera]
position = [0.1, -0.1, 4]
target = [0.1, 0.1, 0]
[[wind]]
kind = "noise"
strength = 0.5
[[system]]
name = "squares"
rotation_degrees = [10, 0]
initial_mean_parts = 90
generation_shape = { kind = "rectangle", length = 4.5, width = 3.4 }
speed = 0
lifetime = 3
color = { mean = [700, 400, 200], var = [290, 390, 190] }
size = { mean = 0.25, var = 0.1 }
particle_shape = "rectangle"
[[system]]
name = "streaks"
initial_mean_parts = 160
generation_shape = { kind = "box", length = 6, width = 4.6, height = 0.2 }
ejection_axis = "outward"
ejection_angle_degrees = 180
speed = { mean = 0, var = 1.6 }
drag = 0.2
lifetime = 2
color = { mean = [500, 600, 700], var = [400, 300, 200] }
size = { mean = 0.05, var = 0.04 }
particle_shape = "streak"
[[system]]
name = "creeping"
initial_mean_parts = 60
generation_shape = { kind = "sphere", radius = 1.5 }
speed = { mean = 0.0003, var = 0.0003 }
lifetime = 2
color = [300, 200, 250]
size = 0.02
particle_shape = "streak"
"#,
    )
}

/// [`large_shapes`] behind more small particles, born before them, than a page of 64 KiB holds.
pub(crate) fn large_shapes_in_a_second_page() -> Scene {
    let mut scene = large_shapes(62, 47);
    let mut dust = scene_of(
        r#"
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "dust"
initial_mean_parts = 2100
generation_shape = { kind = "sphere", radius = 2 }
speed = 0
lifetime = 1
color = [0.01, 0.01, 0.01]
size = 0.001
"#,
    );
    scene.systems.splice(0..0, dust.systems.drain(..));
    scene
}

/// Streaks that cut the corners of the picture: they begin beyond one edge and end beyond another,
/// both ways around each corner.
pub(crate) fn cut_corners() -> Scene {
    let mut systems = String::new();
    for (right, up) in [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
        // From above or below to the side, and back.
        for (along, across, way) in [(-0.7, 0.3, -1.0), (0.3, -0.7, 1.0)] {
            // Drawn after its first step, of 0.99 in each direction.
            let step: f64 = 0.99 * way;
            let x = right * (2.186 + along + step);
            let y = up * (1.657 + across - step);
            // Turned about x and then about y, local +z points (right, up) or away from it.
            let (about_x, about_y) = (-45.0 * up * way, -90.0 * right * way);
            systems += &format!(
                r#"
[[system]]
name = "s{}"
position = [{x}, {y}, 0]
rotation_degrees = [{about_x}, {about_y}]
initial_mean_parts = 12
generation_shape = {{ kind = "sphere", radius = 0.2 }}
ejection_axis = "up"
speed = {{ mean = 1.4, var = 0.2 }}
lifetime = 1
color = [0.3, 0.2, 0.1]
size = 0.04
particle_shape = "streak"
"#,
                systems.matches("name").count()
            );
        }
    }
    scene_of(&format!(
        "frames = 3\n[image]\nwidth = 62\nheight = 47\nshutter = 1\n[camera]\n\
         position = [0, 0, 4]\ntarget = [0, 0, 0]\n{systems}"
    ))
}

/// Births on meshes of few faces and of more than 65,536, whose areas differ, among births of
/// other kinds; they leave along the normal, around the axis and upward.
pub(crate) fn born_on_meshes() -> Scene {
    let system = |name: &str, shape: &str, rest: &str| {
        format!(
            "[[system]]\nname = \"{name}\"\nposition = [0.1, -0.2, 0.3]\n\
             rotation_degrees = [20, 35]\ninitial_mean_parts = 400\n\
             generation_shape = {{ kind = {shape} }}\nspeed = {{ mean = 0.1, var = 0.05 }}\n\
             lifetime = {{ mean = 3, var = 1 }}\ncolor = [0.1, 0.2, 0.3]\nsize = 0.02\n{rest}\n"
        )
    };
    let mut scene = scene_of(&format!(
        "frames = 4\n[image]\nwidth = 62\nheight = 47\n[camera]\nposition = [0, 0, 5]\n\
         target = [0, 0, 0]\n{}{}{}{}{}",
        system("cylinder", "\"mesh\", mesh = \"cylinder\", scale = 0.7", ""),
        system("ball", "\"sphere\", radius = 1", ""),
        system(
            "many",
            "\"mesh\", mesh = \"sphere\"",
            "ejection_axis = \"around\"\nejection_angle_degrees = 15"
        ),
        system(
            "cube",
            "\"mesh\", mesh = \"cube\", scale = 1.3",
            "ejection_axis = \"up\"\nbirth_moment = \"within_frame\""
        ),
        system(
            "curve",
            "\"attractor\", attractor = \"lorenz\", radius = 1",
            ""
        ),
    ));
    scene.systems[2].generation_shape = GenerationShape::Mesh {
        mesh: Arc::new(mesh::sphere(1.5, 6).expect("its numbers are right")),
        scale: 0.8,
    };
    scene
}

/// Particles of every shape that cover each other and what glows, lit and flat, sharp and soft, in two
/// layers; more of them than are drawn at a time where that is as few as can be.
pub(crate) fn covering() -> Scene {
    let system = |name: &str, at: &str, births: u32, rest: &str| {
        format!(
            "[[system]]\nname = \"{name}\"\nposition = [{at}]\ninitial_mean_parts = {births}\n\
             generation_shape = {{ kind = \"sphere\", radius = 1.2 }}\n\
             speed = {{ mean = 0.05, var = 0.05 }}\nlifetime = 3\n\
             color = {{ mean = [0.6, 0.4, 0.3], var = [0.3, 0.3, 0.3], rate_var = [0.02, 0.02, 0.01] }}\n\
             transparency = {{ mean = 0.4, var = 0.5 }}\n{rest}\n"
        )
    };
    let over = "blend = \"over\"\n";
    let systems = [
        system(
            "puffs",
            "0, 0, 0",
            800,
            &format!(
                "{over}size = {{ mean = 0.2, var = 0.19 }}\nshading = \"lit_sphere\"\nedge_softness = 0.6"
            ),
        ),
        system(
            "balls",
            "0.3, 0.2, -1",
            200,
            &format!("{over}size = {{ mean = 0.06, var = 0.05 }}\nshading = \"lit_sphere\""),
        ),
        system(
            "panes",
            "-0.4, 0.3, 1",
            60,
            &format!("{over}size = 0.3\nparticle_shape = \"rectangle\""),
        ),
        system(
            "rods",
            "0, -0.5, 0.5",
            150,
            &format!(
                "{over}size = {{ mean = 0.03, var = 0.03 }}\nparticle_shape = \"streak\"\nacceleration = [0.1, 0.2, 0]"
            ),
        ),
        system(
            "coins",
            "-0.3, -0.4, 0.6",
            50,
            &format!("{over}size = {{ mean = 0.1, var = 0.05 }}\nejection_axis = \"outward\""),
        ),
        system("sparks", "0, 0, 0", 40, "size = 0.03\nlight_distance = 5"),
    ];
    scene_of(&format!(
        "frames = 4\nimage = {{ width = 62, height = 47, background = [0.2, 0.3, 0.1], exposure = 1.25 }}\n\
         camera = {{ position = [0.3, -0.2, 4], target = [0.1, 0.1, 0] }}\n\
         light = {{ direction = [-1, 0.5, 0.7], color = [1, 0.8, 0.6], ambient = [0.1, 0.15, 0.2] }}\n\
         [[layer]]\nname = \"behind\"\npoint = [0, 0, -0.2]\nnormal = [0.1, 0, 1]\n{}",
        systems.concat()
    ))
}
