//! What right scenes are read as: every key in its place, and what holds where it is not written.

use std::sync::Arc;

use motes::mesh::{self, Surface};
use motes::scene::{
    BirthMoment, BirthRounding, BirthUnit, Births, Blend, BoidShape, Burning, Burst, Camera,
    Changing, Char, ChildUp, Corners, Curvature, Dimensions, Edges, EjectionAxis, EjectionSpread,
    Extinction, Fire, FireLights, FireSpread, FlameForm, Flock, FluxFormula, FrontHeading,
    FrontLine, GenerationShape, Goal, Grain, GrainPattern, Ground, Ignition, Image, Inherit,
    Insertion, Integration, Intensity, Lamp, Layer, Light, LightFrom, ListedFlame, LitSurface,
    Material, Obstacle, ObstacleShape, ParticleShape, ParticleSpace, Pillar, Planet, Profile,
    ProfileStop, Projection, RampStop, Relation, RelationKind, Roots, Rule, Scene, Shading,
    ShutterWeighting, Side, Smoke, Spread, SpreadLaw, StreakLight, System, Turbulence, Wind,
};

use crate::text::{FULL, MINIMAL, accepted};

/// The only system of [`MINIMAL`], with every documented default.
fn minimal_system() -> System {
    System {
        name: "only".into(),
        parent: None,
        child_up: ChildUp::Parent,
        inherit: Inherit::default(),
        position: [0.0; 3],
        rotation_degrees: [0.0; 2],
        first_frame: 0,
        end_frame: None,
        trigger_frames: vec![],
        bursts: vec![],
        birth_moment: BirthMoment::FrameStart,
        particle_space: ParticleSpace::System,
        births: Births {
            per: BirthUnit::Frame,
            initial_mean_parts: 100.0,
            delta_mean_parts: 0.0,
            quadratic_mean_parts: 0.0,
            cubic_mean_parts: 0.0,
            var_parts: 0.0,
            delta_var_parts: 0.0,
            quadratic_var_parts: 0.0,
            cubic_var_parts: 0.0,
            mean_parts_wander: 0.0,
            mean_parts_wander_frames: 24.0,
        },
        birth_rounding: BirthRounding::Stochastic,
        generation_shape: GenerationShape::Sphere { radius: 1.0 },
        ejection_axis: EjectionAxis::Outward,
        ejection_angle_degrees: 0.0,
        ejection_spread: EjectionSpread::SolidAngle,
        // A mean alone has no spread and no rate.
        speed: spread(0.1, 0.0),
        lifetime: Some(spread(60.0, 0.0)),
        color: changing(spread([0.4, 0.1, 0.02], [0.0; 3]), [0.0; 3], [0.0; 3]),
        transparency: changing(spread(0.0, 0.0), 0.0, 0.0),
        size: changing(spread(0.02, 0.0), 0.0, 0.0),
        acceleration: [0.0; 3],
        acceleration_space: ParticleSpace::World,
        drag: 0.0,
        integration: Integration::Euler,
        particle_shape: ParticleShape::Sphere,
        blend: Blend::Add,
        shading: Shading::Flat,
        edge_softness: 0.0,
        streak_light: StreakLight::Conserved,
        stroke_taper: 1.0,
        stroke_pieces: 16,
        stroke_shadow: 0.0,
        intensity_threshold: None,
        intensity: Intensity::Brightest,
        extinctions: vec![],
        light_distance: None,
        light: 0.0,
    }
}

fn spread<T>(mean: T, var: T) -> Spread<T> {
    Spread { mean, var }
}

fn changing<T>(initial: Spread<T>, rate: T, rate_var: T) -> Changing<T> {
    Changing {
        initial,
        rate,
        rate_var,
    }
}

#[test]
fn what_is_not_written_has_the_documented_default() {
    let wanted = Scene {
        name: "some".into(),
        title: "some".into(),
        description: String::new(),
        frames: 120,
        frame_rate: 24,
        seed: 1,
        capacity: None,
        max_systems: None,
        steady_particles: None,
        image: Image {
            width: 1280,
            height: 720,
            background: [0.0; 3],
            shutter: 0.5,
            shutter_weighting: ShutterWeighting::Camera,
            exposure: 1.0,
        },
        camera: Camera {
            position: [0.0, 1.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective,
            view_height: 4.0,
            vertical_fov_degrees: 45.0,
            near: 0.1,
        },
        light: Light {
            direction: [0.4, 0.8, 0.5],
            color: [1.0; 3],
            ambient: [0.2; 3],
            shadow_center: [0.0; 3],
            shadow_radius: None,
            shadow_cells: 32,
        },
        systems: vec![minimal_system()],
        flocks: vec![],
        planet: None,
        lamps: vec![],
        ground: None,
        pillars: vec![],
        surfaces: vec![],
        fires: vec![],
        winds: vec![],
        layers: vec![],
        tracks: vec![],
    };
    assert_eq!(accepted(MINIMAL), wanted);
}

/// The first system of [`FULL`].
fn first_system() -> System {
    System {
        name: "first".into(),
        parent: None,
        child_up: ChildUp::Parent,
        inherit: Inherit::default(),
        position: [1.0, 2.0, 3.0],
        rotation_degrees: [-90.0, 45.5],
        first_frame: 3,
        end_frame: Some(9),
        trigger_frames: vec![-5, 0, 40],
        bursts: vec![
            Burst {
                frame: 13,
                parts: spread(500.0, 50.0),
            },
            Burst {
                frame: 4,
                parts: spread(7.0, 0.0),
            },
        ],
        birth_moment: BirthMoment::WithinFrame,
        particle_space: ParticleSpace::World,
        births: Births {
            per: BirthUnit::Frame,
            initial_mean_parts: 100.5,
            delta_mean_parts: -2.0,
            quadratic_mean_parts: 0.5,
            cubic_mean_parts: -0.25,
            var_parts: 20.0,
            delta_var_parts: 1.5,
            quadratic_var_parts: -0.75,
            cubic_var_parts: 0.125,
            mean_parts_wander: 0.3,
            mean_parts_wander_frames: 12.0,
        },
        birth_rounding: BirthRounding::Nearest,
        generation_shape: GenerationShape::Rectangle {
            length: 2.0,
            width: 0.5,
        },
        ejection_axis: EjectionAxis::Around,
        ejection_angle_degrees: 30.0,
        ejection_spread: EjectionSpread::Angle,
        speed: spread(-0.1, 0.02),
        lifetime: Some(spread(60.0, 10.0)),
        color: changing(
            spread([0.4, 0.1, 0.02], [0.1, 0.0, 0.0]),
            [0.0, -0.01, 0.01],
            [0.0, 0.0, 0.005],
        ),
        transparency: changing(spread(0.25, 0.125), 0.5, 0.0625),
        size: changing(spread(0.02, 0.01), -0.001, 0.0005),
        acceleration: [0.0, -0.01, 0.0],
        acceleration_space: ParticleSpace::World,
        drag: 0.05,
        integration: Integration::Parabola,
        particle_shape: ParticleShape::Streak,
        blend: Blend::Over,
        shading: Shading::LitSphere,
        edge_softness: 0.75,
        streak_light: StreakLight::Constant,
        stroke_taper: 0.25,
        stroke_pieces: 5,
        stroke_shadow: 0.125,
        intensity_threshold: Some(0.01),
        intensity: Intensity::Luminance,
        extinctions: vec![
            Extinction::Distance {
                direction: [0.0, 3.0, 4.0],
                distance: -2.0,
            },
            Extinction::Plane {
                point: [1.0, 0.0, 0.0],
                normal: [0.0, 2.0, 0.0],
            },
            Extinction::Sphere {
                center: [0.0, 1.0, 2.0],
                radius: 0.5,
                kills: Side::Inside,
            },
            Extinction::Box {
                min: [-1.0, -2.0, -3.0],
                max: [1.0, 2.0, -0.5],
                kills: Side::Outside,
            },
        ],
        light_distance: Some(7.5),
        light: 2.5,
    }
}

#[test]
fn every_key_of_a_system_reaches_its_place() {
    let scene = accepted(FULL);
    assert_eq!(scene.systems.len(), 3);
    assert_eq!(scene.systems[0], first_system());
    let second = System {
        name: "second".into(),
        parent: Some("rings".into()),
        child_up: ChildUp::Outward,
        acceleration_space: ParticleSpace::System,
        inherit: Inherit {
            mean_parts: 0.5,
            var_parts: 0.25,
            generation_scale: 0.125,
            ejection_angle_degrees: 4.0,
            speed: spread(0.1, 0.2),
            lifetime: spread(3.0, 4.0),
            color: changing(
                spread([0.1, 0.2, 0.3], [0.4, 0.5, 0.6]),
                [0.01, 0.02, 0.03],
                [0.04, 0.05, 0.06],
            ),
            transparency: changing(spread(0.11, 0.12), 0.13, 0.14),
            size: changing(spread(0.21, 0.22), 0.23, 0.24),
        },
        births: Births {
            per: BirthUnit::ScreenArea,
            initial_mean_parts: 0.5,
            delta_mean_parts: 0.1,
            quadratic_mean_parts: 0.01,
            cubic_mean_parts: -0.001,
            var_parts: 0.25,
            delta_var_parts: 0.02,
            quadratic_var_parts: -0.002,
            cubic_var_parts: 0.0002,
            ..minimal_system().births
        },
        generation_shape: GenerationShape::Circle { radius: 3.0 },
        ejection_axis: EjectionAxis::Up,
        speed: spread(1.0, 0.0),
        lifetime: Some(spread(2.0, 0.0)),
        color: changing(spread([1.0; 3], [0.0; 3]), [0.0; 3], [0.0; 3]),
        size: changing(spread(1.0, 0.0), 0.0, 0.0),
        ..minimal_system()
    };
    assert_eq!(scene.systems[1], second);
}

/// What the first flock of [`FULL`] is kept from.
fn obstacles() -> Vec<Obstacle> {
    let obstacle = |shape, margin, limit| Obstacle {
        shape,
        margin,
        limit,
    };
    let sphere = ObstacleShape::Sphere {
        center: [1.0, 2.0, -3.0],
        radius: 4.0,
        stay: Side::Inside,
    };
    let plane = ObstacleShape::Plane {
        point: [0.0, -1.0, 2.0],
        normal: [3.0, 0.0, 1.0],
    };
    let corners = Corners {
        min: [-5.0, -4.0, -3.0],
        max: [2.0, 3.0, 4.0],
    };
    let stay = Side::Inside;
    let mesh = motes::mesh::builtin("cube")
        .expect("it is built in")
        .expect("it is well");
    let solid = ObstacleShape::Mesh {
        surface: Arc::new(motes::mesh::Surface::new(&mesh, 1.0).expect("it has two sides")),
        mesh: Arc::new(mesh),
        position: [2.0, 1.0, -1.0],
        scale: 1.5,
        stay,
    };
    vec![
        obstacle(sphere, 6.0, 0.9),
        obstacle(plane, 7.0, 0.8),
        obstacle(ObstacleShape::Box { corners, stay }, 8.0, 0.6),
        obstacle(solid, 9.0, 0.4),
    ]
}

/// The flocks of [`FULL`].
fn flocks() -> Vec<Flock> {
    let rule = |weight, speed, limit| Rule {
        weight,
        speed,
        limit,
    };
    let relation = |other, radius, view_angle_degrees, nearest, kind| Relation {
        other,
        radius: Some(radius),
        view_angle_degrees,
        nearest: Some(nearest),
        kind,
    };
    let rules = RelationKind::Flock {
        separation: rule(0.5, 3.0, 0.1),
        inverse_distance: true,
        alignment: rule(-1.0, 2.0, 0.4),
        cohesion: rule(0.0, 1.0, 0.6),
    };
    let prey = Flock {
        name: "flock".into(),
        count: 30,
        dimensions: Dimensions::Three,
        region: Corners {
            min: [0.0, 1.0, -2.0],
            max: [3.0, 4.0, 5.0],
        },
        start_speed: 0.5,
        max_speed: 1.5,
        mass: 2.0,
        force: [0.0, 0.1, -0.1],
        perception_radius: 25.0,
        edges: Edges::Wrap(Corners {
            min: [-1.0, -2.0, -3.0],
            max: [1.0, 2.0, 3.0],
        }),
        relations: vec![
            relation(1, 12.0, 270.0, 7, rules),
            relation(0, 7.0, 180.0, 5, RelationKind::Avoid { limit: 0.8 }),
            relation(1, 8.0, 90.0, 3, RelationKind::Approach { limit: 0.9 }),
        ],
        goal: Some(Goal {
            position: [7.0, 8.0, 9.0],
            weight: 0.25,
            speed: 3.0,
            limit: 0.7,
            slowing_radius: 11.0,
        }),
        obstacles: obstacles(),
        drag: 0.25,
        shape: BoidShape::Disc,
        size: 4.0,
        color: [0.1, 0.2, 0.3],
        opacity: 0.6,
        trail_frames: 12,
        mirrored: true,
    };
    // What is not written has the documented default.
    let hunters = Flock {
        name: "hunters".into(),
        count: 3,
        dimensions: Dimensions::Two,
        region: Corners {
            min: [0.0; 3],
            max: [1.0; 3],
        },
        start_speed: 1.0,
        max_speed: 2.0,
        mass: 1.0,
        force: [0.0; 3],
        perception_radius: 60.0,
        edges: Edges::None,
        relations: vec![],
        goal: None,
        obstacles: vec![],
        drag: 0.0,
        shape: BoidShape::Triangle,
        size: 3.0,
        color: [1.0; 3],
        opacity: 1.0,
        trail_frames: 0,
        mirrored: false,
    };
    vec![prey, hunters]
}

/// The fire of [`FULL`].
fn fire() -> Fire {
    Fire {
        name: "pyre".into(),
        position: [1.0, 2.0, 3.0],
        rotation_degrees: [10.0, 20.0],
        roots: Roots::Circle {
            radius: 2.0,
            count: 7,
        },
        listed: vec![ListedFlame {
            position: [0.0, 1.0, 2.0],
            normal: [0.0, 1.0, 1.0],
            height: Some(3.0),
            width: Some(0.75),
            brightness: 0.5,
            first_frame: Some(12),
        }],
        height: spread(2.0, 0.5),
        width: spread(0.5, 0.1),
        profile: Profile {
            base_width: 0.6,
            swell: 0.3,
            base_height: 0.25,
            height_growth: 0.05,
            stops: vec![ProfileStop {
                age: 0.75,
                width: 1.5,
                height: 0.875,
            }],
        },
        start_speed: 3.0,
        normalised: false,
        buoyancy: 0.9,
        gravity: [0.0, -2.0, 1.0],
        noisiness: 0.02,
        sampling: 0.3,
        inverse_cohesion: 1.5,
        wind_factor: 4.0,
        brightness: 1.25,
        color_noise: 0.4,
        color_noise_scale: 3.0,
        inner_radius: 0.3,
        inner_alpha: 1.5,
        details: 3,
        detail_spread: 0.625,
        detail_alpha: 0.375,
        form: FlameForm::Strip,
        strip_cells: [3.0, 7.0],
        strip_contrast: 0.75,
        particle_matrix: [
            1.0, 0.5, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
        ],
        matrix_noise: 0.125,
        lights: FireLights {
            gain: 7.0,
            count: 5,
            from: LightFrom::Tip,
        },
        ramp: vec![RampStop {
            age: 0.25,
            center: [1.0, 0.75, 0.5],
            rim: [0.5, 0.25, 0.0],
            alpha: 0.5,
            rim_alpha: 0.125,
        }],
        blackbody: Some([1900.0, 1500.0]),
        blackbody_rim: 0.875,
        burning: Burning {
            first_frame: -3,
            kindling_frames: 10,
            lifetime: Some(90),
            growth_frames: 6,
        },
        spread: Some(fire_spread()),
    }
}

fn fire_spread() -> FireSpread {
    let mesh = Arc::new(mesh::cube(2.0).expect("it is right"));
    FireSpread {
        surface: Arc::new(Surface::new(&mesh, 2.0).expect("it can be walked on")),
        mesh,
        ignitions: vec![Ignition {
            position: [0.0, 0.0, 2.0],
            first_frame: 4,
            points: 24,
        }],
        materials: vec![Material {
            part: "+z".into(),
            speed: 1.5,
            thickness: Some(0.02),
            conductivity: Some(0.25),
            lifetime: Some(77),
        }],
        catch_points: Some(12),
        law: SpreadLaw::Stain,
        smoke: Some(Smoke {
            speed: 0.03,
            frames: 30.0,
            size: 0.2,
            growth: 2.0,
            color: [0.25, 0.5, 0.75],
            opacity: 0.375,
            max_puffs: 600,
        }),
        grain: Some(Grain {
            pattern: GrainPattern::Stripes,
            direction: [1.0, 0.0, 0.0],
            scale: 4.0,
            strength: 0.25,
            shift: 0.5,
            noise_scale: 2.0,
        }),
        time_scale: 0.25,
        opposed_flux: 0.1,
        concurrent_flux: 0.2,
        ignition_heat: 0.75,
        formula: Some(FluxFormula {
            flame_temperature: 1200.0,
            fuel_temperature: 350.0,
            conductivity: 0.06,
            emissivity: 0.3,
            flame_length: 0.2,
            flame_angle_degrees: 40.0,
            thickness: 0.01,
            density: 450.0,
            enthalpy: 250_000.0,
        }),
        drop_distance: 0.3,
        separation: 0.15,
        curvature_distance: 0.05,
        curvature: Curvature::Literal,
        heading: FrontHeading::Normal,
        insertion: Insertion::Midpoint,
        prevents_double_burning: false,
        carries_rest: true,
        max_flames: 300,
        char: Some(Char {
            size: Some(0.5),
            opacity: 0.75,
            edge_softness: 0.5,
            glow: [2.0, 0.5, 0.25],
            glow_frames: 40.0,
            appear_frames: 3.0,
            max_marks: 700,
        }),
        line: Some(FrontLine {
            width: 0.03,
            color: [0.5, 1.0, 0.25],
            opacity: 0.625,
        }),
        max_points: 5000,
    }
}

#[test]
fn every_other_key_reaches_its_place() {
    let scene = accepted(FULL);
    let noise = Turbulence {
        strength: 0.15,
        scale: [1.0, 2.0, 0.0],
        drift: [0.0, 0.5, 0.0],
        octaves: 3,
        spectrum_exponent: 2.5,
        absolute: true,
    };
    let curl = Turbulence {
        strength: 0.16,
        scale: [3.0; 3],
        drift: [0.25, 0.0, 0.0],
        octaves: 2,
        spectrum_exponent: 3.0,
        absolute: false,
    };
    let wanted = Scene {
        name: "some".into(),
        title: "All of it".into(),
        description: "Two lines:\nof text.".into(),
        frames: 10,
        frame_rate: 30,
        seed: 0xfeed,
        capacity: Some(200_000),
        max_systems: Some(300),
        steady_particles: Some(150_000),
        image: Image {
            width: 640,
            height: 360,
            background: [0.0, 0.5, 1.0],
            shutter: 0.48,
            shutter_weighting: ShutterWeighting::Eye,
            exposure: 1.5,
        },
        camera: Camera {
            position: [0.0, 1.0, 5.0],
            target: [0.0; 3],
            up: [0.5, 1.0, 0.0],
            projection: Projection::Orthographic,
            view_height: 3.5,
            vertical_fov_degrees: 60.0,
            near: 0.01,
        },
        light: Light {
            direction: [-1.0, 2.0, 0.5],
            color: [1.0, 0.9, 0.8],
            ambient: [0.05, 0.06, 0.07],
            shadow_center: [1.0, 2.0, 0.5],
            shadow_radius: Some(3.5),
            shadow_cells: 5,
        },
        systems: scene.systems.clone(),
        flocks: flocks(),
        planet: Some(Planet {
            center: [1.0, 2.0, 3.0],
            radius: 0.5,
            color: [0.2, 0.3, 0.4],
            relief: 0.6,
            contrast: 0.7,
            scale: 8.0,
            octaves: 3,
        }),
        lamps: vec![Lamp {
            position: [4.0, 5.0, 6.0],
            color: [3.0, 2.0, 1.0],
            distance: 2.5,
        }],
        ground: Some(Ground {
            position: [1.0, -2.0, 3.0],
            normal: [0.0, 1.0, 0.5],
            radius: 12.0,
            color: [0.3, 0.2, 0.1],
            contrast: 0.25,
            scale: 6.0,
            octaves: 2,
        }),
        pillars: vec![Pillar {
            position: [2.0, 3.0, 4.0],
            radius: 0.25,
            height: 1.5,
            color: [0.6, 0.5, 0.4],
            translucence: 0.75,
            depth: 0.4,
        }],
        surfaces: vec![LitSurface {
            mesh: Arc::new(mesh::cube(2.0).expect("it is right")),
            position: [3.0, 4.0, 5.0],
            rotation_degrees: [15.0, -25.0],
            scale: 2.5,
            color: [0.4, 0.6, 0.2],
            grain: Some(Grain {
                pattern: GrainPattern::Stripes,
                direction: [0.0, 1.0, 0.0],
                scale: 3.0,
                strength: 0.5,
                shift: 0.0,
                noise_scale: 1.0,
            }),
            crease_degrees: 75.0,
        }],
        fires: vec![fire()],
        winds: vec![
            Wind::Uniform {
                velocity: [0.01, 0.02, 0.03],
            },
            Wind::Buoyancy {
                gravity: [0.0, -2.0, 0.0],
                strength: 0.04,
            },
            Wind::Gusts {
                velocity: [0.05, 0.0, 0.0],
                amplitude: 0.75,
                frames: 20.0,
            },
            Wind::Vortex {
                position: [1.0, 2.0, 3.0],
                axis: [0.0, 0.0, 2.0],
                speed: -0.06,
                radius: 0.7,
            },
            Wind::Source {
                position: [4.0, 5.0, 6.0],
                strength: 0.08,
                radius: 0.9,
            },
            // A sink is a source that takes.
            Wind::Source {
                position: [7.0, 8.0, 9.0],
                strength: -0.11,
                radius: 1.2,
            },
            Wind::Attractor {
                position: [-1.0, -2.0, -3.0],
                speed: 0.13,
                radius: 1.4,
            },
            Wind::Noise(noise),
            Wind::Curl(curl),
        ],
        layers: vec![
            Layer {
                name: "smoke".into(),
                point: [0.0, 0.0, -2.0],
                normal: [0.0, 0.0, 3.0],
            },
            Layer {
                name: "far".into(),
                point: [0.0, 0.0, -4.0],
                normal: [0.0, 1.0, 1.0],
            },
        ],
        tracks: vec![],
    };
    assert_eq!(scene, wanted);
}
