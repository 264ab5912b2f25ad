//! A scene of what moves, blows and ends particles: wind of every kind, bounds of every kind, keys,
//! layers, shapes beyond the sphere, the circle and the rectangle.

use motes::plan::{FrameInputs, Plan};
use motes::scene::Scene;

use super::{frames_of, scene_of};

const WINDY: &str = r#"
frames = 24
seed = 5
[image]
width = 161
height = 91
exposure = 1.2
shutter_weighting = "eye"
shutter = 0.8
[camera]
position = { keys = [[0, [0, 2, 9]], [5, [3, 2, 8]], [11, [5, 1, 7]]], interpolation = "smooth" }
target = [0, 1, 0]
vertical_fov_degrees = { keys = [[0, 45], [11, 35]] }
[[layer]]
name = "back"
point = [0,0,0]
normal = [0,0,1]
[[layer]]
name = "left"
point = [-0.3,0,0]
normal = [1,0.1,0.2]
[[wind]]
kind = "uniform"
velocity = [0.01,0,0]
[[wind]]
kind = "gusts"
velocity = [0.02,0,0.01]
[[wind]]
kind = "vortex"
position = [0,0,0]
speed = 0.06
[[wind]]
kind = "sink"
position = [1,1,0]
strength = 0.02
[[wind]]
kind = "attractor"
position = [-1,2,0]
speed = 0.02
[[wind]]
kind = "noise"
strength = 0.03
octaves = 3
scale = [1, 0.7, 1.3]
drift = [0, 0.07, 0]
absolute = true
[[wind]]
kind = "curl"
strength = 0.02
octaves = 2
[[wind]]
kind = "buoyancy"
strength = 0.005
[[system]]
name = "ring"
first_frame = -6
position = { keys = [[0,[-2,0,0]],[10,[2,1,0]]] }
rotation_degrees = { keys = [[0,[-90,0]],[10,[-60,180]]] }
particle_space = "world"
birth_moment = "within_frame"
initial_mean_parts = 40
delta_mean_parts = -3
quadratic_mean_parts = 0.1
mean_parts_wander = 0.4
generation_shape = { kind = "ring", inner_radius = 0.3, outer_radius = 0.5 }
ejection_axis = "around"
ejection_angle_degrees = 20
ejection_spread = "angle"
speed = { mean = { keys = [[0, 0.02],[10, 0.08]] }, var = 0.01 }
lifetime = { mean = 7, var = 3 }
color = { mean = [0.4,0.2,0.1], rate = [-0.01,-0.01,-0.002], rate_var = [0.01,0.002,0.001] }
size = { mean = 0.03, rate = 0.0002, rate_var = 0.0005 }
drag = 0.1
integration = "parabola"
particle_shape = "streak"
intensity_threshold = 0.05
intensity = "luminance"
light_distance = 8
[[system.extinction]]
kind = "plane"
point = [0,-0.02,0]
normal = [0,1,0]
[[system.extinction]]
kind = "sphere"
center = [1,1,0]
radius = 0.5
kills = "inside"
[[system]]
name = "box"
initial_mean_parts_per_area = 0.02
generation_shape = { kind = "box", length = 1, width = 1, height = 0.4 }
ejection_axis = "outward"
ejection_angle_degrees = 70
speed = 0.03
color = [0.1,0.2,0.5]
size = 0.04
drag = 0.05
trigger_frames = [0, 4, 9]
end_frame = 3
[[system.burst]]
frame = 2
parts = { mean = 60, var = 20 }
[[system.extinction]]
kind = "box"
min = [-0.52,-0.47,-0.2]
max = [0.45,0.53,0.19]
kills = "outside"
[[system]]
name = "cone"
position = [-3,0,-1]
rotation_degrees = [-90,0]
initial_mean_parts = 60
generation_shape = { kind = "cone", height = 1, angle_degrees = 20 }
speed = 0.02
lifetime = 15
color = [0.4,0.4,0.1]
size = 0.03
particle_shape = "rectangle"
[[system.extinction]]
kind = "distance"
direction = [0.2,0,1]
distance = 0.8
[[system.extinction]]
kind = "box"
min = [-3.3,-0.1,-1.2]
max = [-2.9,0.7,-0.8]
kills = "inside"
[[system]]
name = "line"
position = [0,3,-1]
initial_mean_parts = 60
generation_shape = { kind = "line", length = 4 }
speed = 0.02
lifetime = 15
color = [0.1,0.4,0.1]
size = 0.03
acceleration = [0,-0.002,0]
[[system.extinction]]
kind = "plane"
point = [0,2.9,0]
normal = [0.1,1,0]
[[system]]
name = "point"
position = [0.4,0.9,1]
initial_mean_parts = 9
generation_shape = { kind = "circle", radius = 0 }
ejection_axis = "outward"
ejection_angle_degrees = 25
speed = 0.04
lifetime = 8
color = [0.3,0.1,0.4]
size = 0.03
[[system]]
name = "lorenz"
position = [2.5,1.5,-1]
rotation_degrees = { keys = [[0,[0,0]],[11,[0,90]]] }
initial_mean_parts = 60
generation_shape = { kind = "attractor", attractor = "lorenz", radius = 1.2 }
speed = 0.002
lifetime = 15
color = [0.3,0.1,0.4]
size = 0.01
[[system.extinction]]
kind = "sphere"
center = [2.4,1.6,-1.1]
radius = 0.8
kills = "outside"
"#;

/// See the module.
pub(crate) fn windy() -> Scene {
    scene_of(WINDY)
}

/// [`windy`] from frame 0 on, of which some frames are drawn layer by layer; with `flat`, seen
/// without perspective and as a camera sees.
pub(crate) fn windy_frames(flat: bool, count: u32) -> (Plan, Vec<FrameInputs>) {
    let mut scene = windy();
    if flat {
        scene.camera.projection = motes::scene::Projection::Orthographic;
        scene.image.shutter_weighting = motes::scene::ShutterWeighting::Camera;
        for system in &mut scene.systems {
            system.light_distance = None;
        }
    }
    let plan = Plan::new(&scene, scene.frames).expect("the scene can be planned");
    let mut frames = frames_of(&plan, count);
    for (at, inputs) in frames.iter_mut().enumerate() {
        inputs.frame.layer = [0, 1, 2, 3][at % 4];
    }
    (plan, frames)
}
