//! A tree of systems, and what goes down it (Reeves 1983, 2.6).

use motes::layout::{NODE_LIVES, Particle, SystemRow};
use motes::scene::Scene;

use crate::common::statistics::assert_uniform;
use crate::support::{CHILD, PARENT, Run, dot, family, length, origin, particles, scene, up};

/// Three levels: clouds bear clusters, which bear puffs, which bear particles.
fn three_levels() -> Scene {
    let clouds = PARENT
        .replace("\"parent\"", "\"clouds\"")
        .replace("parts = 3", "parts = 1");
    let cluster = "name = \"cluster\"
        parent = \"clouds\"
        end_frame = 6
        initial_mean_parts = 2
        birth_rounding = \"nearest\"
        generation_shape = { kind = \"sphere\", radius = 1 }
        speed = 0.05
        lifetime = 8
        color = [0.2, 0.2, 0.2]
        size = 1
        [system.inherit]
        color = { mean = [0.1, 0.1, 0.1] }";
    let puff = CHILD
        .replace("\"child\"", "\"puff\"")
        .replace("\"parent\"", "\"cluster\"");
    scene(&[&clouds, cluster, &puff])
}

#[test]
fn r42_a_tree_of_three_levels_has_the_children_that_its_systems_bear() {
    let mut run = Run::new(&three_levels());
    assert_eq!(run.plan.tree_levels, 2);
    let mut live = 0;
    for frame in 0..30u32 {
        run.step();
        // A cluster a frame; two puffs from each cluster in its first six frames.
        let clusters = 1;
        let puffs = 2 * (frame + 1).min(6);
        let counts = run.counts();
        assert_eq!(counts.requested, clusters + puffs, "frame {frame}");
        assert_eq!((counts.born, counts.dropped), (counts.requested, 0));
        live = live + counts.born - counts.died;
        assert_eq!(counts.live, live);
        let borne = run.borne();
        let alive = borne
            .iter()
            .filter(|(node, ..)| node.spans[0] == NODE_LIVES);
        assert_eq!(alive.count() as u32, live);
        // Four particles from each puff that lives, none from clusters and clouds.
        let puffs = borne
            .iter()
            .filter(|(node, ..)| node.who[2] == 2 && node.spans[0] == NODE_LIVES)
            .count() as u32;
        assert_eq!(run.births().iter().sum::<u32>(), 4 * puffs, "frame {frame}");
    }
    // Everybody's particles name a slot of a puff.
    assert!(live > 30);
}

#[test]
fn r42_slots_do_not_move_and_are_used_again() {
    let mut run = Run::new(&family("", ""));
    let mut slots = std::collections::BTreeMap::new();
    for _ in 0..60 {
        run.step();
        for (node, ..) in run.borne() {
            // Key and birth belong to one parent and index for good.
            let known = *slots.entry(node.who[0]).or_insert(node);
            assert_eq!((known.who, known.spans[3]), (node.who, node.spans[3]));
        }
    }
    let room = (run.plan.system_count - run.plan.own_system_count) as usize;
    assert_eq!(slots.len(), 180, "keys differ");
    assert!(room < 150, "slots are used again: {room}");
    assert_eq!(run.counts().dropped, 0);
}

#[test]
fn r43_what_turns_a_parent_turns_all_of_its_descendants() {
    let mut scene = three_levels();
    let straight = particles(&scene, 20);
    scene.systems[0].rotation_degrees = [90.0, 0.0];
    let turned = particles(&scene, 20);
    assert!(straight.len() > 500);
    assert_eq!(straight.len(), turned.len());
    for (a, b) in straight.iter().zip(&turned) {
        // About x by 90 degrees: y becomes z, z becomes -y.
        let [x, y, z] = a.position;
        let expected = [x, -z, y];
        for (axis, expected) in expected.into_iter().enumerate() {
            assert!(
                (b.position[axis] - expected).abs() < 1e-5 * 10.0,
                "{a:?} {b:?}"
            );
        }
        assert_eq!(a.id, b.id);
    }
}

#[test]
fn r44_childrens_colours_are_chosen_within_the_range() {
    let scene = many_children("color = { mean = [0.2, 0.05, 0.01], var = [0.1, 0.02, 0.005] }");
    let rows = rows_of(&scene);
    for (channel, (mean, half)) in [(0.4, 0.2), (0.1, 0.05), (0.02, 0.01)]
        .into_iter()
        .enumerate()
    {
        let means: Vec<f64> = rows
            .iter()
            .map(|row| f64::from(row.color_mean[channel]))
            .collect();
        assert_uniform("means", &means, mean - half, mean + half);
    }
    // Half-widths, too: what is below 0 is 0.
    let vars: Vec<f32> = rows.iter().map(|row| row.color_var[0]).collect();
    let zeros = vars.iter().filter(|var| **var == 0.0).count() as f64;
    assert!((zeros / vars.len() as f64 - 0.5).abs() < 0.1, "{zeros}");
    assert!(vars.iter().all(|var| (0.0..=0.1).contains(var)));
}

/// 40 systems a frame whose values differ by these half-widths.
fn many_children(inherit: &str) -> Scene {
    scene(&[
        &PARENT.replace("parts = 3", "parts = 40"),
        &format!("{CHILD}\n[system.inherit]\n{inherit}"),
    ])
}

/// The rows of 400 systems.
fn rows_of(scene: &Scene) -> Vec<SystemRow> {
    let mut run = Run::new(scene);
    (0..10).for_each(|_| run.step());
    let rows: Vec<SystemRow> = run.borne().into_iter().map(|(.., row)| row).collect();
    assert_eq!(rows.len(), 400);
    rows
}

#[test]
fn r44_a_childs_children_have_what_it_has() {
    let mut run = Run::new(&three_levels());
    (0..12).for_each(|_| run.step());
    let borne = run.borne();
    // Puffs of one cluster have one colour, its own deviation from its kind.
    let mut colors = std::collections::BTreeMap::new();
    for (node, _, row) in borne.iter().filter(|(node, ..)| node.who[2] == 2) {
        let color = colors.entry(node.who[3]).or_insert(row.color_mean);
        assert_eq!(*color, row.color_mean);
        assert!((row.color_mean[0] - 0.4).abs() <= 0.1 + 1e-6);
    }
    let mut reds: Vec<u32> = colors.values().map(|color| color[0].to_bits()).collect();
    reds.sort_unstable();
    reds.dedup();
    assert!(reds.len() > 5, "clusters differ: {}", reds.len());
}

#[test]
fn r45_as_many_systems_are_born_as_the_parents_rate_says() {
    let parent = PARENT.replace("parts = 3", "parts = 6").replace(
        "birth_rounding = \"nearest\"",
        "var_parts = 4\ndelta_mean_parts = 0.5",
    );
    let mut run = Run::new(&scene(&[&parent, CHILD]));
    let mut sum = 0.0;
    let mut seen = std::collections::BTreeSet::new();
    for frame in 0..60 {
        run.step();
        let born = f64::from(run.counts().born);
        let mean = 6.0 + 0.5 * f64::from(frame);
        assert!((born - mean).abs() <= 5.0, "frame {frame}: {born}");
        sum += born - mean;
        seen.insert((born - mean).floor() as i64);
    }
    // Half-width 4: a standard deviation of 2.3, and 0.3 of the mean of 60.
    assert!((sum / 60.0).abs() < 1.2, "{sum}");
    assert!(seen.len() > 4, "{seen:?}");
}

#[test]
fn r46_every_parameter_can_differ_from_child_to_child() {
    let alike = rows_of(&many_children(""));
    let key = |inherit: &str, of: &dyn Fn(&SystemRow) -> f32, half: f32, least: f32| {
        let rows = rows_of(&many_children(inherit));
        let base = of(&alike[0]);
        assert!(alike.iter().all(|row| of(row) == base), "{inherit}");
        let values: Vec<f32> = rows.iter().map(of).collect();
        let (low, high) = values.iter().fold((f32::MAX, f32::MIN), |(low, high), x| {
            (low.min(*x), high.max(*x))
        });
        assert!(
            high <= base + half * 1.0001 && low >= (base - half * 1.0001).max(least),
            "{inherit}: {low} {high}"
        );
        assert!(
            high > base + half * 0.8,
            "{inherit}: {high} of {base} and {half}"
        );
    };
    let floor = f32::MIN;
    key("generation_scale = 0.5", &|row| row.shape[0], 0.25, 0.0);
    key(
        "ejection_angle_degrees = 36",
        &|row| row.ejection_and_light[1],
        0.1,
        0.0,
    );
    key(
        "speed = { mean = 0.1 }",
        &|row| row.speed_and_lifetime[0],
        0.1,
        floor,
    );
    key(
        "speed = { mean = 0, var = 0.04 }",
        &|row| row.speed_and_lifetime[1],
        0.04,
        0.0,
    );
    key("lifetime = 3", &|row| row.speed_and_lifetime[2], 3.0, floor);
    key(
        "lifetime = { mean = 0, var = 1 }",
        &|row| row.speed_and_lifetime[3],
        1.0,
        0.0,
    );
    key("size = 0.02", &|row| row.size_and_threshold[0], 0.02, 0.0);
    key(
        "size = { mean = 0, var = 0.01 }",
        &|row| row.size_and_threshold[1],
        0.01,
        0.0,
    );
    key(
        "size = { mean = 0, rate = 0.01 }",
        &|row| row.size_and_threshold[2],
        0.01,
        floor,
    );
    key(
        "size = { mean = 0, rate_var = 0.01 }",
        &|row| row.ejection_and_light[3],
        0.01,
        0.0,
    );
    key(
        "color = { mean = [0, 0, 0.01] }",
        &|row| row.color_mean[2],
        0.01,
        0.0,
    );
    key(
        "color = { mean = [0, 0, 0], rate = [0.1, 0, 0] }",
        &|row| row.color_rate[0],
        0.1,
        floor,
    );
    key(
        "color = { mean = [0, 0, 0], rate_var = [0, 0.1, 0] }",
        &|row| row.color_rate_var[1],
        0.1,
        0.0,
    );
    key("transparency = 0.3", &|row| row.color_mean[3], 0.3, 0.0);
    key(
        "transparency = { mean = 0, rate = 0.1 }",
        &|row| row.color_rate[3],
        0.1,
        floor,
    );
    // Births: the mean and the half-width.
    let mut run = Run::new(&many_children("mean_parts = 2\nvar_parts = 1"));
    (0..10).for_each(|_| run.step());
    let means: Vec<f64> = run
        .borne()
        .iter()
        .map(|(_, system, _)| f64::from(system.mean_parts))
        .collect();
    assert_uniform("mean births", &means, 2.0, 6.0);
}

#[test]
fn r47_a_parents_drift_moves_all_of_its_children_alike() {
    let still = family("", "");
    let moving = family(
        "position = { keys = [[0, [0, 0, 0]], [30, [30, 15, 0]]] }",
        "",
    );
    let (a, b) = (particles(&still, 20), particles(&moving, 20));
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(&b) {
        let moved = [0, 1, 2].map(|i| b.position[i] - a.position[i]);
        for (got, wanted) in moved.into_iter().zip([20.0, 10.0, 0.0]) {
            assert!((got - wanted).abs() < 1e-4, "{moved:?}");
        }
    }
}

#[test]
fn r54_taller_explosions_are_those_that_start_faster() {
    let child = CHILD.replace("lifetime = { mean = 10, var = 2 }", "lifetime = 60");
    let scene = scene(&[
        &PARENT.replace("parts = 3", "parts = 40"),
        &format!(
            "{child}\nacceleration = [0, 0, -0.03]\nacceleration_space = \"system\"
             integration = \"parabola\"\n[system.inherit]\nspeed = 0.1"
        ),
    ]);
    let mut run = Run::new(&scene);
    run.step();
    let first = run.plan.own_system_count;
    let means: Vec<f64> = run
        .borne()
        .iter()
        .map(|(_, _, row)| f64::from(row.speed_and_lifetime[0]))
        .collect();
    assert_eq!(means.len(), 40);
    // How high the particles of each get, along its own up: the fastest is up after 12 frames.
    let mut apexes = vec![0.0f64; means.len()];
    for _ in 0..14 {
        run.step();
        for particle in run.read::<Particle>("particles") {
            let at = particle.slot().wrapping_sub(first) as usize;
            if let Some(apex) = apexes.get_mut(at) {
                *apex = apex.max(f64::from(particle.position()[2]));
            }
        }
    }
    let squares: Vec<f64> = means.iter().map(|mean| mean * mean).collect();
    let low = apexes.iter().copied().fold(f64::MAX, f64::min);
    let high = apexes.iter().copied().fold(0.0, f64::max);
    assert!(low > 0.0 && high > 4.0 * low, "apexes from {low} to {high}");
    let r = correlation(&squares, &apexes);
    assert!(r > 0.95, "correlation of apexes and squares of speeds: {r}");
}

/// Pearson's coefficient.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len() as f64;
    let [ma, mb] = [a, b].map(|values| values.iter().sum::<f64>() / n);
    let sum = |x: &[f64], mx: f64, y: &[f64], my: f64| -> f64 {
        let pairs = x.iter().zip(y);
        pairs.map(|(x, y)| (x - mx) * (y - my)).sum()
    };
    sum(a, ma, b, mb) / (sum(a, ma, a, ma) * sum(b, mb, b, mb)).sqrt()
}

#[test]
fn r42_children_leave_as_their_parents_particles_would() {
    let scene = family(
        "acceleration = [0, 0.01, 0]\nejection_angle_degrees = 30",
        "",
    );
    let mut run = Run::new(&scene);
    run.step();
    let first = run.newborn();
    let places: Vec<[f64; 3]> = first.iter().map(|(_, system, _)| origin(system)).collect();
    for _ in 0..10 {
        run.step();
    }
    let later = run.borne();
    for ((node, ..), place) in first.iter().zip(&places) {
        assert!(length([place[0], place[1], 0.0]) <= 5.0 && place[2].abs() < 1e-6);
        let (_, system, _) = later
            .iter()
            .find(|(other, ..)| other.who == node.who)
            .expect("it lives longer");
        let velocity = node.velocity.map(|bits| f64::from(f32::from_bits(bits)));
        let speed = length([velocity[0], velocity[1], velocity[2]]);
        assert!((0.05..=0.1501).contains(&speed), "{speed}");
        assert!(velocity[2] >= speed * (30f64).to_radians().cos() - 1e-6);
        let expected = [0, 1, 2].map(|i| {
            let acceleration = [0.0, 0.01, 0.0][i];
            place[i] + 10.0 * velocity[i] + 50.0 * acceleration
        });
        let off = [0, 1, 2].map(|i| origin(system)[i] - expected[i]);
        assert!(dot(off, off) < 1e-8, "{off:?}");
    }
}

/// Systems that a cube with edges of two units bears, all over it.
fn cube_family() -> Scene {
    let parent = PARENT
        .replace("parts = 3", "parts = 60")
        .replace(
            "{ kind = \"circle\", radius = 5 }",
            "{ kind = \"mesh\", mesh = \"cube\", scale = 2 }",
        )
        .replace("speed = { mean = 0.1, var = 0.05 }", "speed = 0");
    scene(&[&parent, &CHILD.replace("radius = 0.5", "radius = 0")])
}

#[test]
fn r42_systems_are_born_all_over_a_mesh_and_stand_upright_on_it() {
    let cube = motes::mesh::builtin("cube")
        .expect("it is built in")
        .expect("it is right");
    let corners = (0..cube.triangles().len()).flat_map(|face| cube.corners(face));
    let half = 2.0 * f64::from(corners.flatten().fold(0.0, |a: f32, b| a.max(b.abs())));
    let mut run = Run::new(&cube_family());
    (0..15).for_each(|_| run.step());
    let borne = run.borne();
    let mut on_sides = [0.0; 6];
    for (_, system, _) in &borne {
        let (place, up) = (origin(system), up(system));
        let side = (0..3)
            .find(|i| up[*i].abs() > 0.5)
            .expect("it is a unit vector");
        assert!((up[side].abs() - 1.0).abs() < 1e-5, "{up:?}");
        // On the face that its up points away from, and within it.
        assert!((place[side] - half * up[side]).abs() < 1e-5, "{place:?}");
        assert!(
            place.iter().all(|part| part.abs() < half + 1e-5),
            "{place:?}"
        );
        on_sides[2 * side + usize::from(up[side] > 0.0)] += 1.0;
    }
    let all = borne.len() as f64;
    println!("{all} systems: {on_sides:?}");
    assert_eq!(borne.len(), 15 * 60);
    // Six standard deviations of a sixth of them.
    for count in on_sides {
        assert!(
            (count - all / 6.0).abs() < 6.0 * (all * 5.0 / 36.0).sqrt(),
            "{on_sides:?}"
        );
    }
    // What a child bears leaves along its up.
    for particle in particles(&cube_family(), 3) {
        let place = particle.position.map(f64::from);
        assert!(
            place.iter().any(|part| part.abs() >= half - 1e-5),
            "{place:?}"
        );
    }
}

#[test]
fn systems_of_a_mesh_are_the_same_on_every_adapter() {
    crate::twins::assert_twins(&cube_family(), 8);
}
