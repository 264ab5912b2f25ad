//! Where particles may not be: Reeves (1983), section 2.4.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use crate::support::{Member, Run, Who, living, on_every_backend, sample, scene};

fn vector(words: [f32; 3]) -> DVec3 {
    DVec3::from_array(words.map(f64::from))
}

#[test]
fn r29_a_distance_is_exact_on_a_grid() {
    // 100 jets go up by an eighth a frame for 100 frames: 10,000 places, all of them without
    // rounding. Jet i ends beyond i eighths, so each has one particle that is exactly there.
    let jets: Vec<String> = (0..100)
        .map(|i| {
            let end = f64::from(i) / 8.0;
            format!(
                "name = \"s{i}\"\n position = [{i}, -{i}.5, 0.25]\n rotation_degrees = [90, -90]
                generation_shape = {{ kind = \"circle\", radius = 0 }}\n speed = 0.125
                extinction = [{{ kind = \"distance\", direction = [0, 0, 3], distance = {end} }}]"
            )
        })
        .collect();
    let jets: Vec<&str> = jets.iter().map(String::as_str).collect();
    let scene = scene("", &jets);
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene, 100);
        let mut ages = vec![BTreeSet::new(); 100];
        for member in living(&mut run, 99).values() {
            ages[member.state.system as usize].insert(member.state.age);
        }
        for (i, ages) in (0u32..).zip(&ages) {
            // Of age a it has gone a + 1 steps.
            let kept: BTreeSet<u32> = (0..i).collect();
            assert_eq!(*ages, kept, "jet {i} on {on}");
        }
        let died: u32 = run
            .statistics()
            .iter()
            .map(|line| line.died_of_bounds)
            .sum();
        assert_eq!(died, 100 * 100 - (0..100).sum::<u32>());
    });
}

/// 10,000 particles in a box, at rest where they are born, in a system that is moved and turned.
const CLOUD: &str = "initial_mean_parts = 10_000\n end_frame = 1\n position = [1, -2, 0.5]
    rotation_degrees = [35, -110]\n particle_space = \"system\"
    generation_shape = { kind = \"box\", length = 8, width = 6, height = 7 }";

/// Particles of a cloud that an extinction leaves alive, and all of them in the world, where the
/// system has no extinction.
fn kept(on: &str, lines: &str, extinction: &str) -> (BTreeSet<Who>, BTreeMap<Who, Member>) {
    let mut free = Run::new("cpu", &scene("", &[lines]), 1);
    let all = living(&mut free, 0);
    assert_eq!(all.len(), 10_000);
    let lines = format!("{lines}\n extinction = [{extinction}]");
    let mut run = Run::new(on, &scene("", &[&lines]), 1);
    let some = living(&mut run, 0);
    for (who, member) in &some {
        assert_eq!(member.raw, all[who].raw, "the survivors are the same");
    }
    (some.into_keys().collect(), all)
}

/// Fails unless an extinction leaves those alive whose depth in what is forbidden is not above 0.
/// Nearer to the edge than 1e-5, rounding may decide.
fn assert_kept(on: &str, lines: &str, extinction: &str, depth: impl Fn(DVec3) -> f64) {
    let (some, all) = kept(on, lines, extinction);
    let mut close = 0;
    for (who, member) in &all {
        let depth = depth(vector(member.state.position));
        if depth.abs() < 1e-5 {
            close += 1;
            continue;
        }
        let is_kept = some.contains(who);
        assert_eq!(
            is_kept,
            depth < 0.0,
            "{extinction}: {depth} deep, {member:?}"
        );
    }
    println!(
        "{extinction}: {} of 10,000 live, {close} are close",
        some.len()
    );
    assert!(close < 20, "{close} are too close to tell");
    assert!(
        (500..9500).contains(&some.len()),
        "{extinction}: {}",
        some.len()
    );
}

#[test]
fn r29_a_distance_turns_and_moves_with_its_system() {
    // About x by 35 degrees, then about y by -110; the direction need not be of length 1.
    let turned = |v: DVec3| {
        let (about_x, about_y) = (35f64.to_radians(), (-110f64).to_radians());
        glam::DMat3::from_rotation_y(about_y) * (glam::DMat3::from_rotation_x(about_x) * v)
    };
    let direction = turned(DVec3::new(1.0, 2.0, -2.0) / 3.0);
    let origin = DVec3::new(1.0, -2.0, 0.5);
    on_every_backend(|on| {
        for space in ["system", "world"] {
            let lines = CLOUD.replace("\"system\"", &format!("\"{space}\""));
            for distance in sample(on, &[0.5, -1.0, 2.25]) {
                let extinction = format!(
                    "{{ kind = \"distance\", direction = [2, 4, -4], distance = {distance:?} }}"
                );
                assert_kept(on, &lines, &extinction, |p| {
                    (p - origin).dot(direction) - distance
                });
            }
        }
    });
}

#[test]
fn r29_planes_spheres_and_boxes_stand_in_the_world() {
    let normal = DVec3::new(1.0, 0.5, -0.25).normalize();
    let center = DVec3::new(0.0, -1.0, 1.0);
    let sphere = |p: DVec3| 3.0 - (p - center).length();
    let (low, high) = (DVec3::new(-1.0, -5.0, -1.0), DVec3::new(3.0, 0.0, 4.0));
    // How far in, by the nearest face.
    let into_box = |p: DVec3| (p - low).min(high - p).min_element();
    let outside = |p: DVec3| -into_box(p);
    on_every_backend(|on| {
        assert_kept(
            on,
            CLOUD,
            "{ kind = \"plane\", point = [1, -2, 1], normal = [1, 0.5, -0.25] }",
            |p| -(p - DVec3::new(1.0, -2.0, 1.0)).dot(normal),
        );
        let at = "kind = \"sphere\", center = [0, -1, 1], radius = 3";
        assert_kept(
            on,
            CLOUD,
            &format!("{{ {at}, kills = \"inside\" }}"),
            sphere,
        );
        let beyond = |p: DVec3| -sphere(p);
        assert_kept(
            on,
            CLOUD,
            &format!("{{ {at}, kills = \"outside\" }}"),
            beyond,
        );
        let at = "kind = \"box\", min = [-1, -5, -1], max = [3, 0, 4]";
        assert_kept(
            on,
            CLOUD,
            &format!("{{ {at}, kills = \"inside\" }}"),
            into_box,
        );
        assert_kept(
            on,
            CLOUD,
            &format!("{{ {at}, kills = \"outside\" }}"),
            outside,
        );
        // Any one of several is enough.
        let both = "{ kind = \"plane\", point = [1, -2, 1], normal = [1, 0.5, -0.25] },
            { kind = \"sphere\", center = [0, -1, 1], radius = 3, kills = \"outside\" }"
            .replace('\n', " ");
        assert_kept(on, CLOUD, &both, |p| {
            (-(p - DVec3::new(1.0, -2.0, 1.0)).dot(normal)).max(beyond(p))
        });
    });
}

#[test]
fn r29_edges_themselves_are_allowed() {
    // One particle at (0, 0, 0.5) after its step, exactly on what ends there.
    let jet = "generation_shape = { kind = \"circle\", radius = 0 }\n speed = 0.5\n end_frame = 1";
    let edges = [
        "{ kind = \"distance\", direction = [0, 0, 1], distance = 0.5 }",
        "{ kind = \"plane\", point = [7, 3, 0.5], normal = [0, 0, 2] }",
        "{ kind = \"sphere\", center = [0, 0, 0], radius = 0.5, kills = \"outside\" }",
        "{ kind = \"sphere\", center = [0, 0, 1], radius = 0.5, kills = \"inside\" }",
        "{ kind = \"box\", min = [0, 0, 0], max = [1, 1, 0.5], kills = \"outside\" }",
    ];
    on_every_backend(|on| {
        let all = edges.join(", ");
        let mut run = Run::new(
            on,
            &scene("", &[&format!("{jet}\n extinction = [{all}]")]),
            1,
        );
        assert_eq!(living(&mut run, 0).len(), 1, "on the edges on {on}");
    });
    // And a little farther is beyond them, one by one.
    for edge in edges.map(|edge| edge.replace("0.5", "0.4999")) {
        let lines = format!("{jet}\n extinction = [{edge}]");
        let is_plane_or_inside = edge.contains("plane") || edge.contains("\"inside\"");
        let mut run = Run::new("cpu", &scene("", &[&lines]), 1);
        let alive = living(&mut run, 0).len();
        assert_eq!(alive, usize::from(is_plane_or_inside), "{edge}");
    }
}

#[test]
fn r29_no_one_is_seen_out_of_bounds_on_a_parabola() {
    // Upward and pulled back: the way of a frame is velocity + acceleration / 2.
    let lines = "generation_shape = { kind = \"circle\", radius = 0 }\n initial_mean_parts = 200
        rotation_degrees = [-90, 0]\n speed = { mean = 1, var = 0.5 }\n lifetime = 30
        acceleration = [0, -0.25, 0]\n integration = \"parabola\"
        extinction = [{ kind = \"plane\", point = [0, 0, 0], normal = [0, 1, 0] }]";
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene("", &[lines]), 14);
        for frame in 0..14 {
            let below = living(&mut run, frame)
                .values()
                .map(|member| member.state.position[1])
                .filter(|y| *y < -1e-6)
                .fold((0, 0.0f32), |(count, low), y| (count + 1, low.min(y)));
            assert_eq!(
                below.0, 0,
                "frame {frame}: {} below, to {}",
                below.0, below.1
            );
        }
    });
}
