//! Where flames stand, when they burn, and what single ones have of their own.

use motes::cpu::CpuBackend;
use motes::simulation::Simulation;

use crate::common::on_cpu;
use crate::support::*;

fn simulation(scene: &motes::scene::Scene) -> Simulation {
    let plan = plan(scene);
    let cpu: CpuBackend = on_cpu(&plan);
    Simulation::with_backend(plan, Box::new(cpu))
}

#[test]
fn p04_single_flames_have_places_and_shapes_of_their_own() {
    let text = "name = \"fire\"\nposition = [0, 1, 0]\nheight = 0.5\nwidth = 0.1\nbrightness = 2\n\
        roots = { kind = \"line\", length = 1, count = 2 }\n\
        [[fire.flame]]\nposition = [0.25, 0, 0]\n\
        [[fire.flame]]\nposition = [0, 0.5, 0]\nnormal = [0, 0, 2]\nheight = 1.5\nwidth = 0.4\n\
        brightness = 3\nfirst_frame = 5";
    let scene = scene_with(&[text], "");
    let flames = flames(&scene, 4);
    let look = |at: usize| [0, 1, 2].map(|i| f32::from_bits(flames[at].look[i]));
    assert_eq!(flames.len(), 4);
    assert_eq!(flames[0].root(), [0.25, 1.0, 0.0]);
    assert_eq!(flames[1].root(), [0.0, 1.5, 0.0]);
    assert_eq!((look(0), look(1)), ([0.5, 0.1, 2.0], [1.5, 0.4, 6.0]));
    assert_eq!(
        (flames[0].normal(), flames[1].normal()),
        ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
    );
    assert_eq!(
        [0, 1, 2, 3].map(|at| flames[at].burns()),
        [true, false, true, true]
    );
    assert_eq!(flames[2].root(), [-0.25, 1.0, 0.0]);
    assert_eq!(flames[3].root(), [0.25, 1.0, 0.0]);
    assert_eq!(look(3), [0.5, 0.1, 2.0]);
    // Where it goes in still air tells its height.
    let still = format!(
        "noisiness = 0\n{}",
        text.replace("normal = [0, 0, 2]\n", "")
    );
    let still = scene_with(&[&still], "");
    for (way, height) in ways(&still, 5).iter().zip([0.5, 1.5, 0.5, 0.5]) {
        assert_near(minus(way[24], way[0]), [0.0, height, 0.0], 1e-5);
    }
}

#[test]
fn p04_roots_stand_on_lines_circles_discs_and_meshes() {
    let of = |roots: &str| {
        flames(
            &scene_with(&[&format!("name = \"fire\"\nroots = {roots}")], ""),
            0,
        )
    };
    let circle = of("{ kind = \"circle\", radius = 2, count = 12 }");
    for (at, flame) in circle.iter().enumerate() {
        let angle = std::f64::consts::TAU * at as f64 / 12.0;
        let root = flame.root().map(f64::from);
        assert_near(root, [2.0 * angle.cos(), 0.0, 2.0 * angle.sin()], 1e-5);
    }
    let disc = of("{ kind = \"disc\", radius = 2, count = 4000 }");
    let within = |r: f32| {
        let inside = disc.iter().filter(|flame| {
            let [x, _, z] = flame.root();
            x.hypot(z) < r
        });
        inside.count() as f64 / 4000.0
    };
    assert_eq!(within(2.0), 1.0);
    assert!(
        (within(1.0) - 0.25).abs() < 0.03,
        "as many everywhere: {}",
        within(1.0)
    );
    let ball = of("{ kind = \"mesh\", mesh = \"sphere\", scale = 3, count = 500 }");
    let mut upward = 0;
    for flame in &ball {
        let [root, normal] = [flame.root(), flame.normal()].map(|v| v.map(f64::from));
        assert!((length(normal) - 1.0).abs() < 1e-5);
        let outward = dot(root, normal) / length(root);
        assert!(outward > 0.98, "normals of faces: {outward}");
        upward += u32::from(root[1] > 0.0);
    }
    assert!((200..300).contains(&upward), "{upward}");
}

#[test]
fn p04_flames_are_kindled_grow_and_burn_down() {
    let text = "name = \"fire\"\nroots = { kind = \"line\", length = 1, count = 10 }\nfirst_frame = 3\n\
                kindling_frames = 20\nlifetime = 8\ngrowth_frames = 4\nheight = 1";
    let scene = scene_with(&[text], "");
    let mut plan_of = plan(&scene);
    let mut live = 0;
    for frame in 0..40_i32 {
        let flames = flames(&scene, frame as u32);
        let burning = flames.iter().filter(|flame| flame.burns()).count() as i32;
        for (at, flame) in (0..).zip(&flames) {
            let age = frame - (3 + 2 * at);
            assert_eq!(flame.burns(), (0..8).contains(&age), "{at} at {frame}");
            let height = f32::from_bits(flame.look[0]);
            if flame.burns() {
                let wanted = [0.25, 0.5, 0.75, 1.0, 1.0, 0.75, 0.5, 0.25][age as usize];
                assert!((height - wanted).abs() < 1e-6, "{height}");
            }
        }
        let [born, died, counted] = plan_of.flames_at(frame).map(|count| count as i32);
        live += born - died;
        assert_eq!((counted, live), (burning, burning), "frame {frame}");
    }
    // Whoever burns when a run begins was born then.
    plan_of.first_frame = 5;
    assert_eq!(plan_of.flames_at(5), [2, 0, 2]);
}

#[test]
fn p45_a_flames_light_is_the_mean_of_its_way() {
    let text = "name = \"fire\"\nnoisiness = 0.2\n\
                [[fire.flame]]\nposition = [1, 0, 0]\nfirst_frame = 9\n\
                [[fire.flame]]\nposition = [0.5, 0.2, 0]\n[[fire.flame]]\nposition = [0, 0, 0.1]";
    let scene = scene_with(&[text], "");
    let mut run = simulation(&scene);
    run.seek(6).expect("it runs");
    let lights = run.flame_lights().expect("it is read");
    let burning = run.flames().expect("it is read");
    assert_eq!(
        (lights.len(), burning.len()),
        (2, 2),
        "one does not burn yet"
    );
    assert_eq!(burning[0].position, [0.5, 0.2, 0.0]);
    assert_eq!(
        (burning[0].age, burning[0].lifetime, burning[0].fire),
        (6, 0, 0)
    );
    for (light, way) in lights.iter().zip(&ways(&scene, 6)[1..]) {
        let sum = way
            .iter()
            .fold([0.0; 3], |sum, place| [0, 1, 2].map(|i| sum[i] + place[i]));
        assert_near(light.map(f64::from), sum.map(|x| x / 25.0), 1e-5);
    }
}

#[test]
fn flames_have_no_past() {
    let scene = crate::common::all_kinds_of_fires();
    let frames = scene.frames.min(7);
    let mut whole = simulation(&scene);
    for _ in 0..frames {
        whole.step().expect("it runs");
    }
    let mut late = simulation(&scene);
    late.seek(frames - 1).expect("it runs");
    let snapshot = whole.snapshot().expect("it is read").expect("it has begun");
    let mut restored = simulation(&scene);
    restored.restore(&snapshot).expect("it is of this run");
    for run in [&mut late, &mut restored] {
        run.draw().expect("it runs");
        whole.draw().expect("it runs");
        let digests = |run: &mut Simulation| {
            (
                run.state_digest().expect("it runs"),
                run.image_digest().expect("it runs"),
            )
        };
        assert_eq!(digests(run), digests(&mut whole));
    }
}
