//! How flocks begin.

use std::collections::HashSet;

use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::plan::Stage;
use motes::scene::{Edges, Scene};

use crate::common::*;
use crate::support::*;

/// The boids as they hatch, before they move.
fn hatched(flocks: &[&str]) -> Vec<State> {
    hatched_in(&scene(flocks))
}

fn hatched_in(scene: &Scene) -> Vec<State> {
    let plan = plan(scene);
    let mut cpu = on_cpu(&plan);
    cpu.run_stage(Stage::Hatch, &plan.inputs(0))
        .expect("it runs");
    states_of(&boids(&mut cpu))
}

/// The greatest distance of an empirical distribution from the uniform one on 0 .. 1, times the
/// root of the number (Kolmogorov and Smirnov): above 1.95 once in a thousand.
fn ks(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len() as f64;
    let off = |(at, value): (usize, &f64)| {
        let (below, above) = (at as f64 / n, (at + 1) as f64 / n);
        (value - below).abs().max((above - value).abs())
    };
    values.iter().enumerate().map(off).fold(0.0, f64::max) * n.sqrt()
}

#[test]
fn f4_headings_are_unit_vectors_of_any_direction() {
    let flat = hatched(&[&with(FREE, &[("count", "10_000")])]);
    let turn = |v: &[f32; 3]| {
        (f64::from(v[1]).atan2(f64::from(v[0])) / std::f64::consts::TAU).rem_euclid(1.0)
    };
    for (_, v) in &flat {
        let length = v.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() <= 1e-6 && v[2] == 0.0, "{v:?}");
    }
    let off = ks(flat.iter().map(|(_, v)| turn(v)).collect());
    assert!(off < 1.95, "{off}");
    let deep = hatched(&[&with(FREE, &[("count", "10_000"), ("dimensions", "3")])]);
    for (_, v) in &deep {
        let length = v.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() <= 1e-6, "{v:?}");
    }
    let off = ks(deep.iter().map(|(_, v)| turn(v)).collect());
    assert!(off < 1.95, "{off}");
    // Archimedes: heights on a sphere are uniform.
    let off = ks(deep
        .iter()
        .map(|(_, v)| (f64::from(v[2]) + 1.0) / 2.0)
        .collect());
    assert!(off < 1.95, "{off}");
}

#[test]
fn f16_places_are_uniform_in_the_region() {
    let boids = hatched_in(&shipped("boids-free"));
    assert_eq!(boids.len(), 500);
    for (axis, extent) in [(0, 500.0), (1, 300.0)] {
        let off = ks(boids
            .iter()
            .map(|(p, _)| f64::from(p[axis]) / extent)
            .collect());
        assert!(off < 1.95, "axis {axis}: {off}");
    }
}

#[test]
fn f16_without_rules_polarisation_stays() {
    let plan = plan(&shipped("boids-free"));
    let mut cpu = on_cpu(&plan);
    let velocities = |cpu: &mut motes::cpu::CpuBackend| -> Vec<[f32; 3]> {
        boids(cpu).iter().map(|boid| boid.velocity()).collect()
    };
    step(&mut cpu, &plan.inputs(0));
    let first = velocities(&mut cpu);
    for frame in 1..100 {
        step(&mut cpu, &plan.inputs(frame));
    }
    assert_eq!(velocities(&mut cpu), first);
}

#[test]
fn f14_defaults_are_those_of_the_article() {
    let scene = scene(&[
        "name = \"b\"\ncount = 1\nregion = { min = [0, 0, 0], max = [1, 1, 0] }\n\
                         [[flock.relation]]\nkind = \"flock\"\n",
    ]);
    let flock = &scene.flocks[0];
    assert_eq!(
        (flock.mass, flock.max_speed, flock.perception_radius),
        (1.0, 2.0, 60.0)
    );
    assert_eq!((flock.start_speed, flock.color), (1.0, [1.0; 3]));
    let motes::scene::RelationKind::Flock {
        separation,
        alignment,
        cohesion,
        inverse_distance,
    } = flock.relations[0].kind
    else {
        panic!("{flock:?}");
    };
    assert!(!inverse_distance);
    let of = |rule: motes::scene::Rule| (rule.weight, rule.speed, rule.limit);
    assert_eq!(of(separation), (1.0, 4.0, 0.3));
    assert_eq!(of(alignment), (1.0, 4.0, 0.2));
    assert_eq!(of(cohesion), (1.0, 4.5, 0.2));
}

#[test]
fn f34_rorschach_begins_in_its_box() {
    let scene = shipped("rorschach");
    // A white page around the box, with the sketch's origin in the middle of both.
    assert_eq!(scene.image.background, [1.0; 3]);
    assert_eq!(scene.camera.target, [0.0; 3]);
    let counts = scene.flocks.iter().map(|flock| flock.count);
    assert_eq!(counts.collect::<Vec<_>>(), [1000, 4]);
    for flock in &scene.flocks {
        let Edges::Constrain { corners, factor } = flock.edges else {
            panic!("{flock:?}");
        };
        assert_eq!(corners.min, [-50.0, -50.0, 0.0]);
        assert_eq!((corners.max, factor), ([50.0, 50.0, 0.0], -4.0));
    }
    let boids = hatched_in(&scene);
    let (boids, attractors) = boids.split_at(1000);
    for ([x, y, z], _) in boids {
        assert!((-4.0..=4.0).contains(x) && (-6.0..=-4.0).contains(y) && *z == 0.0);
    }
    // All over it: none of its quarters is empty by chance once in 10^120.
    let quarter = |at: &State| (at.0[0] < 0.0, at.0[1] < -5.0);
    let quarters = boids.iter().map(quarter).collect::<HashSet<_>>();
    assert_eq!(quarters.len(), 4);
    for (place, [vx, vy, _]) in attractors {
        assert_eq!(*place, [0.0; 3]);
        assert!((vx.hypot(*vy) - 10.0).abs() < 1e-4, "{vx}, {vy}");
    }
}

#[test]
fn f29_who_a_boid_is_depends_on_nothing_but_its_flock() {
    let other = with(FREE, &[("name", "\"others\"")]);
    let alone = hatched(&[FREE]);
    let behind = hatched(&[&other, FREE]);
    assert_eq!(alone, behind[500..]);
    assert_ne!(alone, behind[..500]);
    let more = hatched(&[&with(FREE, &[("count", "600")])]);
    assert_eq!(alone, more[..500]);
}

/// The sketches' `setup` and `draw`.
#[test]
fn f2_boids_begin_once_and_move_once_a_frame() {
    let free = "name = \"b\"\ncount = 50\nregion = { min = [0, 0, 0], max = [500, 300, 0] }";
    let plan = plan(&scene(&[free]));
    let begun = hatched(&[free]);
    let moves = |backend: &mut dyn Backend, name: &str| {
        let mut places: Vec<[f32; 3]> = begun.iter().map(|(place, _)| *place).collect();
        for frame in 0..6 {
            step(backend, &plan.inputs(frame));
            for (place, (_, velocity)) in places.iter_mut().zip(&begun) {
                *place = std::array::from_fn(|axis| place[axis] + velocity[axis]);
            }
            let got = states_of(&boids(backend));
            for ((got, _), expected) in got.iter().zip(&places) {
                assert_eq!(got, expected, "{name}, frame {frame}");
            }
        }
    };
    moves(&mut on_cpu(&plan), "cpu");
    on_each_adapter(|name, device| moves(&mut on_gpu(device, &plan, &GpuOptions::default()), name));
}

/// The constructor's arguments are keys, in its order: x and y, mass, size, speed and the colour.
#[test]
fn f3_a_particle_has_what_the_article_s_has() {
    let reference = include_str!("../../scenes/REFERENCE.md");
    let (_, table) = reference.split_once("## `[[flock]]`").expect("its table");
    let keys = ["region", "mass", "size", "max_speed", "color"];
    let places = keys.map(|key| table.find(&format!("| `{key}`")).expect(key));
    assert!(places.is_sorted(), "{places:?}");
    // Each boid has a place and a velocity of its own; what it has been accelerated by is gone.
    let pushed = "name = \"b\"\ncount = 1\nmass = 2\nmax_speed = 4\nforce = { keys = [[0, [2, 0, 0]], \
                  [1, [0, 0, 0]]], interpolation = \"step\" }\nstart_speed = 0\n\
                  region = { min = [7, 9, 0], max = [7, 9, 0] }";
    let plan = plan(&scene(&[pushed]));
    let mut cpu = on_cpu(&plan);
    for frame in 0..3u8 {
        step(&mut cpu, &plan.inputs(frame.into()));
        let states = states_of(&boids(&mut cpu));
        let x = 8.0 + f32::from(frame);
        assert_eq!(states, [([x, 9.0, 0.0], [1.0, 0.0, 0.0])], "frame {frame}");
    }
}
