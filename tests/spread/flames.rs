//! Flames that fronts drop (Perry 1994, 3.4).

use motes::gpu::GpuOptions;
use motes::plan::Plan;
use motes::scene::Scene;
use motes::simulation::{FlameState, Simulation};

use crate::common::{compare_run, frames_of, on_cpu, on_each_adapter, on_gpu};
use crate::support::*;

/// A fire on a wide plane in the open, whose points go `step` in a frame on rays of their own.
fn on_plane(fire: &str, spread: &str, step: f64) -> Scene {
    let spread = format!(
        "mesh = \"plane\"\nscale = 100\ncurvature = \"ignored\"\nopposed_flux = 1\nconcurrent_flux = 0\n\
         ignition_heat = 1\ntime_scale = {step}\nseparation = 10000\n{spread}"
    );
    scene(fire, &spread, &["position = [40, -40, 0]\npoints = 8"], "")
}

fn flames_at(scene: &Scene, frame: u32) -> Vec<FlameState> {
    let mut run = run(scene);
    run.seek(frame).expect("it runs");
    run.flames().expect("they are read")
}

/// How far the flames along one ray are from where it began, in the order of distances.
fn along_ray(flames: &[FlameState], ray: u32) -> Vec<f64> {
    let turns = std::f64::consts::TAU * f64::from(ray) / 8.0;
    let (sin, cos) = turns.sin_cos();
    let away = flames.iter().filter_map(|flame| {
        let [x, y, z] = minus(place(flame.position), [40.0, -40.0, 0.0]);
        assert_close(z, 0.0, 1e-4);
        let (along, across) = (x * cos + y * sin, y * cos - x * sin);
        (across.abs() < 1e-3 && along > 1e-6).then_some(along)
    });
    let mut away: Vec<f64> = away.collect();
    away.sort_by(f64::total_cmp);
    away
}

#[test]
fn p72_points_drop_flames_by_the_distance_that_they_have_come() {
    // Rays in the plane's triangle, of 60 steps: to the letter a flame comes with the first step that
    // ends at d_d or beyond; carried on, flames are d_d apart wherever steps end.
    let step = 0.05;
    for (distance, carries, spacing, count) in [
        (0.17, false, 0.2, 15),
        (0.17, true, 0.17, 17),
        (0.085, true, 0.085, 35),
        (0.013, true, 0.013, 230),
        (0.013, false, 0.05, 60),
        (2.0, true, 2.0, 1),
        (3.1, true, 3.1, 0),
    ] {
        let counter = if carries { "carry" } else { "reset" };
        let spread = format!("drop_distance = {distance}\ndrop_counter = \"{counter}\"");
        let flames = flames_at(&on_plane("", &spread, step), 60);
        assert_eq!(flames.len(), 8 * count, "{distance} {counter}");
        for ray in 0..8 {
            let away = along_ray(&flames, ray);
            assert_eq!(away.len(), count, "{distance} {counter} on ray {ray}");
            for (nth, away) in (1..).zip(away) {
                assert_close(away, f64::from(nth) * spacing, 2e-4);
            }
        }
    }
}

#[test]
fn p72_inserted_points_count_from_the_mean_of_their_neighbours() {
    // A circle in the open: all points have come as far, and drop their flames in the same frame.
    let spread = "separation = 0.3\ndrop_distance = 0.5\nmax_flames = 5000";
    let scene = on_plane("", &spread.replace("separation = 0.3\n", ""), 0.05);
    let mut circle = scene.clone();
    circle.fires[0]
        .spread
        .as_mut()
        .expect("it spreads")
        .separation = 0.3;
    let flames = flames_at(&circle, 45);
    assert!(flames.len() > 8 * 4 + 20, "{}", flames.len());
    for flame in &flames {
        let away = length(minus(place(flame.position), [40.0, -40.0, 0.0]));
        let nearest = (away / 0.5).round() * 0.5;
        assert_close(away, nearest, 1e-3);
    }
}

#[test]
fn p73_a_flame_burns_its_lifetime_however_many_there_are() {
    let spread = "drop_distance = 0.1\nmax_flames = 5000";
    let born_by = |lifetime: u32, frame: u32| {
        let fire = format!("lifetime = {lifetime}");
        let mut run = run(&on_plane(&fire, spread, 0.05));
        run.seek(frame).expect("it runs");
        let statistics = run.take_statistics().expect("they are read");
        let born: u32 = statistics.iter().map(|line| line.flames_born).sum();
        for flame in run.flames().expect("they are read") {
            assert!(flame.age < lifetime, "{flame:?}");
        }
        (born, run.flames().expect("they are read").len())
    };
    // 8 rays drop one in every second frame.
    for lifetime in [1, 2, 7, 20, 1000] {
        for frame in [1, 20, 41] {
            let dropped = |at: u32| 8 * (at / 2);
            let (born, burning) = born_by(lifetime, frame);
            assert_eq!(born, dropped(frame));
            let gone = frame.saturating_sub(lifetime);
            assert_eq!(
                burning as u32,
                dropped(frame) - dropped(gone),
                "{lifetime} {frame}"
            );
        }
    }
}

#[test]
fn p73_a_flame_keeps_the_lifetime_that_it_was_dropped_with() {
    // Another fire's flames, which last long, do not keep these.
    let text = "image = { width = 32, height = 24 }\ncamera = { position = [0, 0, 5], target = [0, 0, 0] }\n[[fire]]\nname = \"long\"\nlifetime = 50\n[fire.spread]\nmesh = \"plane\"\n\
        scale = 9\ntime_scale = 0.4\ndrop_distance = 0.2\n[[fire.spread.ignition]]\nposition = [1, 0, 0]\n\
        [[fire]]\nname = \"short\"\nlifetime = 3\n[fire.spread]\nmesh = \"plane\"\nscale = 9\ntime_scale = 0.4\n\
        drop_distance = 0.2\n[[fire.spread.ignition]]\nposition = [1, 0, 0]\n";
    let scene = crate::common::scene_of(text);
    let flames = flames_at(&scene, 40);
    let of = |fire: u32| flames.iter().filter(move |flame| flame.fire == fire);
    assert!(
        of(0).any(|flame| flame.age > 30),
        "none of the long ones lasts"
    );
    assert!(of(1).count() > 10 && of(1).all(|flame| flame.age < 3));
}

#[test]
fn p74_flames_leave_along_the_outward_normal() {
    let spread = "mesh = \"cube\"\ndrop_distance = 0.2\ntime_scale = 0.3";
    let flames = flames_at(&scene("", spread, &["position = [0, 0, 1]"], ""), 60);
    let mut faces = 0u32;
    for flame in &flames {
        let (root, normal) = (place(flame.position), place(flame.normal));
        let axis = (0..3).find(|axis| root[*axis].abs() > 1.0 - 1e-4);
        let axis = axis.expect("roots are on the cube");
        // At an edge it may be the other face's.
        let own = (0..3)
            .find(|axis| normal[*axis].abs() > 0.5)
            .unwrap_or(axis);
        assert_close(root[own].abs(), 1.0, 1e-4);
        assert_close(normal[own], root[own].signum(), 1e-5);
        assert_close(length(normal), 1.0, 1e-5);
        faces |= 1 << (2 * own + usize::from(normal[own] > 0.0));
    }
    assert!(faces.count_ones() >= 4, "fire came to {faces:b} alone");
}

/// The mean of how far flames lean, tip from root.
fn lean(scene: &Scene, frame: u32) -> [f64; 3] {
    let mut run = run(scene);
    run.seek(frame).expect("it runs");
    let roots = run.flames().expect("they are read");
    let means = run.flame_lights().expect("they are read");
    assert!(roots.len() > 20, "{}", roots.len());
    let sum = roots
        .iter()
        .zip(&means)
        .fold([0.0; 3], |sum, (flame, mean)| {
            let way = minus(place(*mean), place(flame.position));
            [0, 1, 2].map(|axis| sum[axis] + way[axis])
        });
    sum.map(|sum| sum / roots.len() as f64)
}

#[test]
fn p75_flames_of_what_moves_lean_as_in_the_wind_of_that() {
    let spread = "mesh = \"cube\"\nscale = 0.5\ntime_scale = 0.3\ndrop_distance = 0.1";
    let ignition = ["position = [0.5, 0, 0]"];
    let moving = "noisiness = 0\nposition = { keys = [[0, [0, 0, 0]], [100, [40, 0, 0]]] }";
    let moved = lean(&scene(moving, spread, &ignition, ""), 50);
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [-0.4, 0, 0]";
    let blown = lean(&scene("noisiness = 0", spread, &ignition, wind), 50);
    let still = lean(&scene("noisiness = 0", spread, &ignition, ""), 50);
    assert!(moved[0] < still[0] - 0.1, "{moved:?} {still:?}");
    for axis in 0..3 {
        assert_close(moved[axis], blown[axis], 0.01 * length(blown));
    }
}

fn statistics_balance(run: &mut Simulation, frames: u32) -> (u64, u64) {
    let (mut live, mut lost, mut most) = (0, 0, 0);
    let (mut born, mut died) = (0, 0);
    for frame in 0..frames {
        run.seek(frame).expect("it runs");
        for line in run.take_statistics().expect("they are read") {
            assert!(line.flames_born <= line.flames_requested);
            assert_eq!(line.flames_live + line.flames_died, live + line.flames_born);
            live = line.flames_live;
            lost += u64::from(line.flames_requested - line.flames_born);
            born += u64::from(line.flames_born);
            died += u64::from(line.flames_died);
        }
        let flames = run.flames().expect("they are read");
        assert_eq!(flames.len() as u32, live, "in frame {frame}");
        most = most.max(u64::from(live));
    }
    assert_eq!(born, u64::from(live) + died);
    (most, lost)
}

#[test]
fn p72_the_books_of_dropped_flames_balance() {
    for (lifetime, max_flames) in [(10, 4000), (10, 60), (400, 60), (3, 1), (70, 33)] {
        let spread = format!(
            "mesh = \"cube\"\nscale = 0.5\ntime_scale = 0.3\ndrop_distance = 0.07\nseparation = 0.06\n\
             drop_counter = \"carry\"\nmax_flames = {max_flames}"
        );
        let fire = format!("lifetime = {lifetime}");
        let scene = scene(&fire, &spread, &["position = [0, 0, 0.5]"], "");
        let (most, lost) = statistics_balance(&mut run(&scene), 90);
        assert!(most <= max_flames, "{most} flames");
        let (fits, is_full) = (lost == 0, most == max_flames);
        assert_eq!(fits, max_flames == 4000);
        assert_eq!(is_full, max_flames < 4000);
    }
}

#[test]
fn p72_a_run_goes_on_from_a_snapshot_with_its_flames() {
    let spread =
        "mesh = \"cube\"\nscale = 0.5\ntime_scale = 0.3\ndrop_distance = 0.1\nmax_flames = 300";
    let scene = scene("lifetime = 15", spread, &["position = [0, 0, 0.5]"], "");
    let mut first = run(&scene);
    first.seek(30).expect("it runs");
    let snapshot = first
        .snapshot()
        .expect("it is taken")
        .expect("a frame is there");
    first.seek(40).expect("it runs");
    let mut second = run(&scene);
    second.restore(&snapshot).expect("it is of the same scene");
    second.seek(40).expect("it runs");
    let [first, second] = [&mut first, &mut second].map(|run| run.flames().expect("they are read"));
    assert!(first.len() > 50 && first == second);
}

#[test]
fn p45_flames_that_are_dropped_light_the_ground() {
    let spread = "mesh = \"plane\"\nscale = 2\ntime_scale = 0.2\ndrop_distance = 0.2";
    let light = |lights: u32| {
        let fire = format!(
            "lights = {lights}\nlight = 30\nrotation_degrees = [-90, 0]\nposition = [0, -0.4, 0]"
        );
        let ground = "[light]\ncolor = [0, 0, 0]\nambient = [0, 0, 0]\n[ground]\nposition = [0, -0.5, 0]\n\
                      radius = 1000\ncolor = [0.5, 0.4, 0.3]";
        let mut run = run(&scene(&fire, spread, &["position = [0, 0, 0]"], ground));
        run.seek(60).expect("it runs");
        run.draw().expect("it draws");
        let image = run.image().expect("it is read");
        image
            .chunks(4)
            .map(|pixel| u64::from(pixel[0]))
            .sum::<u64>()
    };
    // Flames by themselves are in all three pictures.
    let [none, one, many] = [light(0), light(1), light(9)];
    assert!(one > none + none / 10, "{none} {one}");
    assert!(many > none + none / 10, "{none} {many}");
}

#[test]
fn p20_a_fire_spreads_without_flames() {
    let of = |max_flames: u32| {
        let spread = format!(
            "mesh = \"cube\"\nscale = 0.5\ntime_scale = 0.3\ndrop_distance = 0.07\nseparation = 0.06\n\
             max_flames = {max_flames}"
        );
        scene("", &spread, &["position = [0, 0, 0.5]"], "")
    };
    let (mut without, mut with) = (run(&of(0)), run(&of(300)));
    let mut wanted = 0;
    for frame in 0..30 {
        without.seek(frame).expect("it runs");
        with.seek(frame).expect("it runs");
        let points = with.control_points().expect("they are read");
        assert_eq!(without.control_points().expect("they are read"), points);
        assert!(without.flames().expect("they are read").is_empty());
        wanted = points.len();
    }
    assert!(wanted > 20, "{wanted}");
    assert!(!with.flames().expect("they are read").is_empty());
    let plan = Plan::new(&of(0), 30).expect("it can be planned");
    let frames = frames_of(&plan, 30);
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
        if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(&plan)) {
            panic!("{name}: {difference}");
        }
    });
}
