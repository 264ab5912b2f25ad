//! Particles in the wind: drag, no strength at all, restarts.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};
use motes::cpu::wind::wind_at;
use motes::exact::snap3;
use motes::layout::Particle;
use motes::plan::Plan;

use crate::support::{Run, on_every_backend, scene};

const CLOUD: &str = "name = \"cloud\"\n initial_mean_parts = 200\n lifetime = 60\n speed = 0
    generation_shape = { kind = \"sphere\", radius = 3 }\n drag = 1";

const STIRRED: &str = "{ kind = \"noise\", strength = 0.3, octaves = 2, drift = [0, 0.1, 0] }, \
    { kind = \"curl\", strength = 0.2, scale = [0.5, 0.5, 0.5] }, \
    { kind = \"vortex\", position = [0, 0, 0], speed = 0.1 }, \
    { kind = \"gusts\", velocity = [0.05, 0, 0], frames = 6 }";

fn velocity_of(particle: &Particle) -> Vec3 {
    particle.velocity().into()
}

#[test]
fn p36_a_tracer_has_the_velocity_of_the_wind() {
    let scene = scene(&format!("wind = [{STIRRED}]"), &[CLOUD]);
    on_every_backend(|on| {
        let plan = Plan::new(&scene, 4).expect("the scene can be planned");
        let mut run = Run::of_plan(on, plan.clone());
        let mut before: BTreeMap<(u32, u32), Particle> = BTreeMap::new();
        for frame in 0..4 {
            run.step_to(frame);
            let winds = plan.inputs(frame).winds;
            let members = run.members();
            assert_eq!(members.len(), 200 * (frame as usize + 1));
            for member in &members {
                let who = (member.who.birth_frame, member.who.index);
                match before.get(&who) {
                    // It was at rest, where it still is: not a bit is lost.
                    None => {
                        let u = snap3(wind_at(&winds, member.raw.position().into()));
                        assert_eq!(velocity_of(&member.raw), u, "newborn in frame {frame}");
                    }
                    Some(before) => {
                        let u = wind_at(&winds, before.position().into());
                        let off = (velocity_of(&member.raw) - u).length();
                        assert!(off < 1e-6, "frame {frame}: off by {off}");
                    }
                }
            }
            let who = |member: &crate::support::Member| (member.who.birth_frame, member.who.index);
            before = members
                .iter()
                .map(|member| (who(member), member.raw))
                .collect();
        }
    });
}

#[test]
fn p34_drag_takes_its_part_of_what_is_lacking_each_frame() {
    // v(n) = u + (v0 - u) (1 - k)^n, in the world, whichever way the system is turned.
    let u = DVec3::new(0.5, -0.25, 0.125);
    on_every_backend(|on| {
        for k in [0.1f64, 0.5, 1.0] {
            let system = format!(
                "lifetime = 60\n end_frame = 1\n drag = {k}\n speed = 0.75
                 rotation_degrees = [30, 70]\n position = [3, -2, 1]
                 generation_shape = {{ kind = \"circle\", radius = 0 }}"
            );
            let wind = "wind = [{ kind = \"uniform\", velocity = [0.5, -0.25, 0.125] }]";
            let mut run = Run::new(on, &scene(wind, &[&system]), 20);
            let (a, b) = (30f64.to_radians(), 70f64.to_radians());
            let v0 = 0.75 * DVec3::new(b.sin() * a.cos(), -a.sin(), b.cos() * a.cos());
            let (mut v, mut p) = (v0, DVec3::new(3.0, -2.0, 1.0));
            for frame in 0..20 {
                run.step_to(frame);
                p += v;
                v = u + (v0 - u) * (1.0 - k).powi(frame as i32 + 1);
                let state = run.members()[0].state;
                let got = Vec3::from(state.velocity).as_dvec3();
                assert!(
                    (got - v).length() < 1e-5,
                    "frame {frame}: {got}, expected {v}"
                );
                let got = Vec3::from(state.position).as_dvec3();
                assert!(
                    (got - p).length() < 1e-4,
                    "frame {frame}: {got}, expected {p}"
                );
            }
        }
    });
}

#[test]
fn p39_a_noise_without_strength_has_no_effect() {
    let moving = CLOUD
        .replace("speed = 0\n", "speed = 0.2\n")
        .replace("drag = 1", "drag = 0.25");
    let digest = |on: &str, winds: &str| {
        let scene = scene(&format!("wind = [{winds}]"), &[&moving]);
        let mut run = Run::new(on, &scene, 12);
        run.step_to(11);
        run.simulation.state_digest().expect("the backend digests")
    };
    on_every_backend(|on| {
        let calm = "{ kind = \"buoyancy\", strength = 0.1 }";
        let expected = digest(on, calm);
        for kind in ["noise", "curl"] {
            let with = |strength: f64| {
                format!(
                    "{calm}, {{ kind = \"{kind}\", strength = {strength}, octaves = 2, \
                     drift = [0, 0.5, 0] }}"
                )
            };
            assert_eq!(digest(on, &with(0.0)), expected, "{kind}");
            assert_ne!(digest(on, &with(0.04)), expected, "{kind}");
        }
    });
}

#[test]
fn p39_without_small_scales_flights_are_straight_and_the_same_in_every_frame() {
    let rising = CLOUD.replace("radius = 3", "radius = 0");
    let scene = scene(
        "wind = [{ kind = \"buoyancy\", strength = 0.1 }]",
        &[&rising],
    );
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene, 20);
        run.step_to(19);
        for member in run.members() {
            let steps = 19 - member.who.birth_frame;
            let height = 0.1 * f64::from(steps);
            let [x, y, z] = member.state.position;
            assert_eq!([x, z], [0.0, 0.0]);
            assert!(
                (f64::from(y) - height).abs() < 1e-6,
                "{y}, expected {height}"
            );
        }
    });
}

#[test]
fn r75_a_restart_in_turbulence_equals_the_whole_run() {
    let cloud = CLOUD
        .replace("lifetime = 60", "lifetime = { mean = 9, var = 3 }")
        .replace("drag = 1", "drag = 0.3");
    let scene = scene(&format!("wind = [{STIRRED}]"), &[&cloud]);
    let plan = Plan::new(&scene, 40).expect("the scene can be planned");
    on_every_backend(|on| {
        let frames: &[u32] = if on == "cpu" { &[5, 13, 20, 37] } else { &[20] };
        let result = |run: &mut Run| {
            let digest = run.simulation.state_digest().expect("the backend digests");
            (digest, run.image())
        };
        for &frame in frames {
            let mut whole = Run::of_plan(on, plan.clone());
            whole.step_to(frame);
            let mut entered = Run::of_plan(on, plan.clone());
            entered.simulation.seek(frame).expect("the backend steps");
            // L_max frames before, not the whole run again.
            let steps = entered.take_calls().len() as u32;
            assert_eq!(steps, frame.min(12) + 1);
            assert!(result(&mut entered) == result(&mut whole), "frame {frame}");
        }
    });
}

#[test]
fn r75_killing_does_not_change_the_survivors_in_turbulence() {
    let states = |on: &str, extinction: &str| {
        let system = format!("{}\n{extinction}", CLOUD.replace("drag = 1", "drag = 0.3"));
        let mut run = Run::new(on, &scene(&format!("wind = [{STIRRED}]"), &[&system]), 9);
        run.step_to(8);
        let members = run.members().into_iter();
        let state = members.map(|member| ((member.who.birth_frame, member.who.index), member.raw));
        state.collect::<BTreeMap<_, _>>()
    };
    on_every_backend(|on| {
        let all = states(on, "");
        let some = states(
            on,
            "extinction = [{ kind = \"sphere\", center = [1, 0, 0], radius = 2, kills = \"inside\" }]",
        );
        println!("{} of {} survive", some.len(), all.len());
        assert!(some.len() > 300 && some.len() + 300 < all.len());
        assert!(some.iter().all(|(who, state)| all.get(who) == Some(state)));
    });
}
