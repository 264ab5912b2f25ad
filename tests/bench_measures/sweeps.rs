//! Counts: reached, swept, refused; when measuring begins and ends.

use motes::bench::{BenchError, Budget, Job, Request, Target, measure, run};
use motes::scene::Scene;

use crate::{common, counted, small, targets};

fn job(scene: &Scene, particles: u32) -> Job<'_> {
    Job {
        scene,
        particles: Some(particles),
    }
}

#[test]
fn r87_any_count_is_reached_within_two_percent() {
    for particles in [1, 40, 1000, 20_000, 300_000] {
        let runs = run(
            &[Target::Cpu],
            &job(&small(), particles),
            &counted(3),
            &mut |_| true,
        );
        let run = &runs.expect("it is measured")[0];
        assert_eq!(run.particles, u64::from(particles));
        let live = run.live.expect("it is counted") as f64;
        let off = (live / f64::from(particles) - 1.0).abs();
        let said = run.warnings.iter().any(|told| told.contains("asked for"));
        assert_eq!(
            said,
            off > 0.02,
            "{live} of {particles}: {:?}",
            run.warnings
        );
        assert!(off < 0.02 || particles < 100, "{live} of {particles}");
    }
}

#[test]
fn r87_built_in_scenes_that_scale_say_truly_how_many_live() {
    for name in [
        "bench-free",
        "bench-wind-3",
        "bench-points",
        "bench-streaks",
        "bench-discs",
        "million",
    ] {
        let mut scene = motes::scene::load(name).expect("it is built in");
        assert!(
            scene.steady_particles.is_some_and(|count| count >= 10_000),
            "{name}"
        );
        (scene.image.width, scene.image.height) = (64, 36);
        let job = job(&scene, 6000);
        let runs = run(&[Target::Cpu], &job, &counted(3), &mut |_| true).expect("it runs");
        assert_eq!(runs[0].warnings, [""; 0], "{name}");
        // A sixtieth is renewed in each frame.
        let emit = runs[0]
            .passes
            .iter()
            .find(|pass| pass.name == "emit")
            .expect("a pass");
        assert_eq!(emit.items, 100, "{name}");
    }
}

#[test]
fn a_record_for_each_adapter_has_every_scene_at_every_count() {
    let second = Scene {
        name: "second".into(),
        ..small()
    };
    let request = Request {
        scenes: vec![small(), second],
        particles: vec![500, 2000],
        micro: false,
        budget: counted(2),
    };
    let targets = targets();
    let records = measure(&targets, &request, &mut |_| true).expect("all is measured");
    assert_eq!(records.len(), targets.len());
    for (record, target) in records.iter().zip(&targets) {
        assert_eq!(record.adapter, target.name());
        let runs: Vec<_> = record
            .runs
            .iter()
            .map(|run| (run.scene.as_str(), run.particles))
            .collect();
        let expected = [
            ("small", 500),
            ("small", 2000),
            ("second", 500),
            ("second", 2000),
        ];
        assert_eq!(runs, expected);
        assert!(record.copy_kernel_gb_per_s.is_some_and(|rate| rate > 0.0));
        assert!(record.copy_buffer_gb_per_s.is_some_and(|rate| rate > 0.0));
        assert!(!record.driver.is_empty() && record.cpu_threads > 0);
    }
    let text = motes::bench::records_json(&records);
    assert_eq!(motes::bench::parse_records(text.as_bytes()), Ok(records));
}

#[test]
fn what_does_not_scale_or_scales_too_far_is_refused_before_anything_runs() {
    let mut asked = 0;
    let mut refused = |scene: &Scene, particles| {
        let request = Request {
            scenes: vec![scene.clone()],
            particles: vec![particles],
            budget: counted(2),
            micro: true,
        };
        let result = measure(&[Target::Cpu], &request, &mut |_| {
            asked += 1;
            true
        });
        let error = result.expect_err("it is the input's fault");
        assert!(error.is_users_fault());
        error.to_string()
    };
    let fixed = Scene {
        steady_particles: None,
        ..small()
    };
    assert!(refused(&fixed, 1000).contains("give it `steady_particles`"));
    // 40 frames of at most 16 million births.
    let far = refused(&small(), 700_000_000);
    assert!(
        far.contains("at most 640000000 particles") || far.contains("at most 63999"),
        "{far}"
    );
    assert_eq!(asked, 0);
}

/// Scenes of flocks alone have as many boids as asked for, and no more than a file may have.
#[test]
fn r87_scenes_of_boids_scale_by_boids() {
    let mut scene = motes::scene::load("crossed-flocks").expect("it is built in");
    (scene.image.width, scene.image.height) = (64, 36);
    assert!(scene.systems.is_empty() && scene.flocks.len() > 1);
    let runs = run(&[Target::Cpu], &job(&scene, 900), &counted(2), &mut |_| {
        true
    });
    let run = &runs.expect("it is measured")[0];
    let live = run.live.expect("it is counted");
    assert!(live.abs_diff(900) <= scene.flocks.len() as u64, "{live}");
    assert_eq!(run.warnings, [""; 0]);
    // Where they begin, boids see as many as the area within 60 px has of 450 on average, but at edges.
    let seen = run.neighbour_reads.expect("they flock") as f64 / 900.0;
    let area = std::f64::consts::PI * 60.0 * 60.0;
    let [low, high] = [scene.flocks[0].region.min, scene.flocks[0].region.max];
    let world = f64::from((high[0] - low[0]) * (high[1] - low[1]));
    let expected = f64::from(scene.flocks[0].count) * area / world;
    assert!(
        (0.6..1.2).contains(&(seen / expected)),
        "{seen}, not {expected}"
    );
    let rates = [run.neighbour_reads_per_s(), run.particles_per_s()];
    assert!(
        rates[0] > rates[1].map(|rate| rate * seen * 0.9),
        "{rates:?}"
    );
    let error = job(&scene, 32_000_001).scaled().expect_err("too many");
    assert!(error.is_users_fault() && error.to_string().contains("at most 32000000 boids"));
}

#[test]
fn scenes_of_fires_alone_scale_by_their_flames() {
    let text = "camera = { position = [0, 1, 5], target = [0, 0, 0] }\n\
                [[fire]]\nname = \"line\"\nroots = { kind = \"line\", length = 2, count = 20 }\n\
                [[fire]]\nname = \"disc\"\nroots = { kind = \"disc\", radius = 1, count = 50 }\n\
                [[fire.flame]]\nposition = [0, 0, 0]\n";
    let scene = motes::scene::parse(text, "fires.toml", "fires").expect("a good scene");
    for flames in [5, 71, 1000, 1_000_000] {
        let scaled = job(&scene, flames).scaled().expect("it scales");
        let counts: Vec<u32> = scaled.fires.iter().map(|fire| fire.count()).collect();
        assert_eq!(counts.iter().sum::<u32>(), flames);
        let share = f64::from(counts[0]) / f64::from(flames - 1);
        assert!(
            (share - 2.0 / 7.0).abs() < 1.0 / f64::from(flames - 1),
            "{counts:?}"
        );
    }
    let runs = run(&[Target::Cpu], &job(&scene, 71), &counted(3), &mut |_| true);
    assert_eq!(runs.expect("it is measured")[0].live, Some(71));
    for (flames, said) in [(1, "are listed"), (1_000_001, "at most 1000000 flames")] {
        let error = job(&scene, flames).scaled().expect_err("it cannot be");
        assert!(
            error.is_users_fault() && error.to_string().contains(said),
            "{error}"
        );
    }
}

#[test]
fn whoever_watches_may_stop_it_at_any_frame() {
    for most in [0, 1, 41, 43] {
        let mut frames = 0;
        let mut warm = 0;
        let mut watch = |progress: &motes::bench::Progress| {
            frames += 1;
            warm += u32::from(progress.is_warm_up);
            frames <= most
        };
        let result = run(&[Target::Cpu], &job(&small(), 100), &counted(9), &mut watch);
        assert_eq!(result.expect_err("it was stopped"), BenchError::Stopped);
        assert_eq!((frames, warm), (most + 1, (most + 1).min(40)));
    }
}

#[test]
fn what_never_becomes_steady_is_measured_in_its_second_half_with_a_warning() {
    let text = crate::SMALL.replace("steady_particles = 1000\n", "");
    let text = text.replace("lifetime = 40\n", "");
    let scene = motes::scene::parse(&text, "growing.toml", "growing").expect("a good scene");
    let job = Job {
        scene: &scene,
        particles: None,
    };
    let budget = Budget {
        noise: 1e-9,
        secs: 20.0,
        ..Budget::default()
    };
    let runs = run(&[Target::Cpu], &job, &budget, &mut |_| true).expect("it is measured");
    // Of 60 frames; it grows by 25 in each.
    assert_eq!((runs[0].warm_up_frames, runs[0].frames), (30, 30));
    assert_eq!(runs[0].live, Some(25 * 30 + (25 + 25 * 30) / 2 + 1));
    let warnings = runs[0].warnings.join("; ");
    assert!(
        warnings.contains("not steady: it strayed by 48."),
        "{warnings}"
    );
    assert!(warnings.contains("uncertain by"), "{warnings}");
}

#[test]
fn several_adapters_are_measured_frame_by_frame_in_turn() {
    let targets = [Target::Gpu(common::open("llvmpipe")), Target::Cpu];
    let mut frames = Vec::new();
    let runs = run(
        &targets,
        &job(&small(), 3000),
        &counted(4),
        &mut |progress| {
            frames.push((progress.is_warm_up, progress.frames));
            true
        },
    );
    let runs = runs.expect("both are measured");
    assert_eq!(runs.len(), 2);
    assert_eq!(
        (runs[0].live, runs[0].frames),
        (runs[1].live, runs[1].frames)
    );
    // One walk through the frames for both.
    let expected: Vec<_> = (0..40)
        .map(|at| (true, at))
        .chain((0..4).map(|at| (false, at)))
        .collect();
    assert_eq!(frames, expected);
}
