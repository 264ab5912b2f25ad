//! Every kind of shape and wind, and every word, is read as what it says.

use std::sync::Arc;

use motes::mesh;
use motes::scene::{
    Attractor, BirthMoment, BirthRounding, Blend, EjectionAxis, EjectionSpread, Extinction,
    GenerationShape, Integration, Intensity, ParticleShape, ParticleSpace, Projection, Shading,
    ShutterWeighting, Side, StreakLight, Turbulence, Wind,
};

use crate::text::{MINIMAL, accepted, with};

#[test]
fn what_is_not_written_of_a_wind_has_the_documented_default() {
    let text = MINIMAL.to_owned()
        + r#"
[[wind]]
kind = "buoyancy"
strength = 0.5
[[wind]]
kind = "gusts"
velocity = [1, 0, 0]
[[wind]]
kind = "vortex"
position = [1, 2, 3]
speed = 2
[[wind]]
kind = "source"
position = [1, 2, 3]
strength = 3
[[wind]]
kind = "sink"
position = [1, 2, 3]
strength = -4
[[wind]]
kind = "attractor"
position = [1, 2, 3]
speed = 5
[[wind]]
kind = "noise"
strength = 6
[[wind]]
kind = "curl"
strength = 7
"#;
    let turbulence = |strength| Turbulence {
        strength,
        scale: [1.0; 3],
        drift: [0.0; 3],
        octaves: 1,
        spectrum_exponent: 11.0 / 3.0,
        absolute: false,
    };
    let position = [1.0, 2.0, 3.0];
    let source = |strength| Wind::Source {
        position,
        strength,
        radius: 1.0,
    };
    let wanted = [
        Wind::Buoyancy {
            gravity: [0.0, -1.0, 0.0],
            strength: 0.5,
        },
        Wind::Gusts {
            velocity: [1.0, 0.0, 0.0],
            amplitude: 0.5,
            frames: 48.0,
        },
        Wind::Vortex {
            position,
            axis: [0.0, 1.0, 0.0],
            speed: 2.0,
            radius: 1.0,
        },
        source(3.0),
        source(4.0),
        Wind::Attractor {
            position,
            speed: 5.0,
            radius: 1.0,
        },
        Wind::Noise(turbulence(6.0)),
        Wind::Curl(turbulence(7.0)),
    ];
    assert_eq!(accepted(&text).winds, wanted);
}

#[test]
fn every_shape_is_read_with_the_axis_that_goes_with_it() {
    use GenerationShape as Shape;
    let attractor = |attractor| Shape::Attractor {
        attractor,
        radius: 6.0,
    };
    #[rustfmt::skip]
    let cases = [
        ("kind = 'sphere', radius = 1", Shape::Sphere { radius: 1.0 }, EjectionAxis::Outward),
        ("kind = 'circle', radius = 2", Shape::Circle { radius: 2.0 }, EjectionAxis::Up),
        ("kind = 'rectangle', width = 3, length = 4", Shape::Rectangle { length: 4.0, width: 3.0 }, EjectionAxis::Up),
        ("kind = 'ring', outer_radius = 5, inner_radius = 4", Shape::Ring { inner_radius: 4.0, outer_radius: 5.0 }, EjectionAxis::Up),
        ("kind = 'box', height = 3, width = 2, length = 1", Shape::Box { length: 1.0, width: 2.0, height: 3.0 }, EjectionAxis::Up),
        ("kind = 'cone', angle_degrees = 89, height = 2", Shape::Cone { height: 2.0, angle_degrees: 89.0 }, EjectionAxis::Outward),
        ("kind = 'line', length = 7", Shape::Line { length: 7.0 }, EjectionAxis::Up),
        ("kind = 'attractor', attractor = 'lorenz', radius = 6", attractor(Attractor::Lorenz), EjectionAxis::Outward),
        ("kind = 'attractor', attractor = 'rossler', radius = 6", attractor(Attractor::Rossler), EjectionAxis::Outward),
        ("kind = 'attractor', attractor = 'halvorsen', radius = 6", attractor(Attractor::Halvorsen), EjectionAxis::Outward),
    ];
    let mesh = mesh::builtin("torus").expect("it is built in");
    let mesh = Shape::Mesh {
        mesh: Arc::new(mesh.expect("it is right")),
        scale: 3.0,
    };
    let mesh = (
        "kind = 'mesh', mesh = 'torus', scale = 3",
        mesh,
        EjectionAxis::Outward,
    );
    for (toml, shape, axis) in cases.into_iter().chain([mesh]) {
        let toml = format!("{{ {toml} }}");
        let text = MINIMAL.replace("{ kind = \"sphere\", radius = 1 }", &toml);
        let system = &accepted(&text).systems[0];
        assert_eq!(
            (system.generation_shape.clone(), system.ejection_axis),
            (shape.clone(), axis),
            "{toml}"
        );
        // What is written counts whatever the shape.
        let system = &accepted(&with("system", "generation_shape", &toml)).systems[0];
        let axis = EjectionAxis::Around;
        assert_eq!(
            (system.generation_shape.clone(), system.ejection_axis),
            (shape, axis),
            "{toml}"
        );
    }
}

#[test]
fn every_word_is_read_as_what_it_says() {
    let first = |key, word: &str| {
        let scene = accepted(&with("system", key, &format!("\"{word}\"")));
        scene.systems.into_iter().next().expect("two systems")
    };
    let moment = |word| first("birth_moment", word).birth_moment;
    assert_eq!(moment("frame_start"), BirthMoment::FrameStart);
    let space = |word| first("particle_space", word).particle_space;
    assert_eq!(space("system"), ParticleSpace::System);
    let axis = |word| first("ejection_axis", word).ejection_axis;
    let axes = [EjectionAxis::Up, EjectionAxis::Outward];
    assert_eq!(["up", "outward"].map(axis), axes);
    let spread = |word| first("ejection_spread", word).ejection_spread;
    assert_eq!(spread("solid_angle"), EjectionSpread::SolidAngle);
    let integration = |word| first("integration", word).integration;
    assert_eq!(integration("euler"), Integration::Euler);
    let intensity = |word| first("intensity", word).intensity;
    assert_eq!(intensity("brightest"), Intensity::Brightest);
    let shape = |word| first("particle_shape", word).particle_shape;
    let shapes = [ParticleShape::Sphere, ParticleShape::Rectangle];
    assert_eq!(["sphere", "rectangle"].map(shape), shapes);
    let light = |word| first("streak_light", word).streak_light;
    assert_eq!(light("conserved"), StreakLight::Conserved);
    let blend = |word| first("blend", word).blend;
    assert_eq!(blend("add"), Blend::Add);
    let shading = |word| first("shading", word).shading;
    assert_eq!(shading("flat"), Shading::Flat);
    let rounding = |word| first("birth_rounding", word).birth_rounding;
    assert_eq!(rounding("stochastic"), BirthRounding::Stochastic);
    let scene = accepted(&with("image", "shutter_weighting", "\"camera\""));
    assert_eq!(scene.image.shutter_weighting, ShutterWeighting::Camera);
    let scene = accepted(&with("camera", "projection", "\"perspective\""));
    assert_eq!(scene.camera.projection, Projection::Perspective);
    let kills = |kind: &str, word: &str| {
        let text = with(
            &format!("extinction.{kind}"),
            "kills",
            &format!("\"{word}\""),
        );
        accepted(&text).systems[0].extinctions.clone()
    };
    let sphere = kills("sphere", "outside")[2];
    assert!(matches!(
        sphere,
        Extinction::Sphere {
            kills: Side::Outside,
            ..
        }
    ));
    let cuboid = kills("box", "inside")[3];
    assert!(matches!(
        cuboid,
        Extinction::Box {
            kills: Side::Inside,
            ..
        }
    ));
}
