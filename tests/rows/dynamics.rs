//! Motion beyond the text's: parabolas, drag, births at any moment, spaces. RA6 and RA4.

use glam::DVec3;

use crate::common::statistics::assert_uniform;
use crate::support::{Member, Run, on_every_backend, scene};

fn vector(words: [f32; 3]) -> DVec3 {
    DVec3::from_array(words.map(f64::from))
}

const ORIGIN: DVec3 = DVec3::new(1.0, 2.0, -3.0);
const SPRAY: &str = "position = [1, 2, -3]\n rotation_degrees = [20, -35]
    generation_shape = { kind = \"circle\", radius = 0 }\n ejection_angle_degrees = 180
    speed = { mean = 0.05, var = 0.02 }\n initial_mean_parts = 300\n end_frame = 1";

/// The states of 300 particles after n = 1, 10 and 100 steps, and their first velocities, which
/// a run without any force has.
fn spray(on: &str, lines: &str) -> Vec<(f64, Vec<(DVec3, Member)>)> {
    let mut free = Run::new("cpu", &scene("", &[SPRAY]), 1);
    free.step_to(0);
    let first: Vec<DVec3> = free
        .members()
        .iter()
        .map(|member| vector(member.state.velocity))
        .collect();
    let mut run = Run::new(on, &scene("", &[&format!("{SPRAY}\n{lines}")]), 100);
    let mut after = |steps: u32| {
        run.step_to(steps - 1);
        let members = run.members();
        assert_eq!((members.len(), first.len()), (300, 300));
        (
            f64::from(steps),
            first.iter().copied().zip(members).collect(),
        )
    };
    vec![after(1), after(10), after(100)]
}

fn assert_near(what: &str, got: [f32; 3], expected: DVec3) {
    let off = (vector(got) - expected).length();
    assert!(
        off <= 1e-5 * expected.length(),
        "{what}: {got:?}, expected {expected}, off by {off:e}"
    );
}

#[test]
fn r24_the_exact_parabola_is_an_option() {
    let acceleration = DVec3::new(0.001, -0.004, 0.0005);
    let lines = "integration = \"parabola\"\n acceleration = [0.001, -0.004, 0.0005]";
    on_every_backend(|on| {
        for (n, members) in spray(on, lines) {
            for (velocity, member) in members {
                let expected = ORIGIN + n * velocity + 0.5 * n * n * acceleration;
                assert_near("position", member.state.position, expected);
                let expected = velocity + n * acceleration;
                assert_near("velocity", member.state.velocity, expected);
            }
        }
    });
}

#[test]
fn drag_in_still_air_slows_by_its_share_each_frame() {
    on_every_backend(|on| {
        for drag in [0.125f64, 0.03, 1.0] {
            for (n, members) in spray(on, &format!("drag = {drag:?}")) {
                let kept = (1.0 - drag).powf(n);
                for (velocity, member) in members {
                    let off = (vector(member.state.velocity) - velocity * kept).length();
                    assert!(
                        off <= 1e-5 * kept * velocity.length() + 1e-12,
                        "off by {off:e}"
                    );
                    let expected = ORIGIN + velocity * ((1.0 - kept) / drag);
                    assert_near("position", member.state.position, expected);
                }
            }
        }
        // Falling with drag: toward the terminal velocity, g / drag.
        let fall = DVec3::new(0.0, -0.004, 0.0);
        for (n, members) in spray(on, "drag = 0.0625\n acceleration = [0, -0.004, 0]") {
            let kept = (1.0f64 - 0.0625).powf(n);
            for (velocity, member) in members {
                let expected = velocity * kept + fall * ((1.0 - kept) / 0.0625);
                assert_near("falling", member.state.velocity, expected);
            }
        }
    });
}

#[test]
fn r30_what_leaves_the_picture_lives_and_comes_back() {
    // Thrown to the right, up, and past the camera, and pulled back: s(n) = 8 n - n (n - 1) / 4.
    let place = |n: f64| 8.0 * n - 0.25 * n * (n - 1.0);
    for (rotation, pull, is_seen) in [
        ("[0, 90]", "[-0.5, 0, 0]", 33.0),
        ("[-90, 0]", "[0, -0.5, 0]", 33.0),
        ("[0, 0]", "[0, 0, -0.5]", 31.9),
    ] {
        let lines = format!(
            "generation_shape = {{ kind = \"circle\", radius = 0 }}\n rotation_degrees = {rotation}
            speed = 8\n acceleration = {pull}\n end_frame = 1\n lifetime = 34"
        );
        on_every_backend(|on| {
            let mut run = Run::new(on, &scene("", &[&lines]), 36);
            let mut seen = Vec::new();
            for frame in 0..34 {
                run.step_to(frame);
                let members = run.members();
                assert_eq!(members.len(), 1, "{rotation}: dead in frame {frame}");
                let at = place(f64::from(frame) + 1.0);
                let off = vector(members[0].state.position).length() - at.abs();
                assert!(off.abs() < 1e-4, "{rotation}: off by {off}");
                let is_lit = !run.light().is_dark();
                assert_eq!(is_lit, at < is_seen, "{rotation}: frame {frame}, at {at}");
                seen.push(is_lit);
            }
            seen.dedup();
            assert_eq!(
                seen,
                [true, false, true],
                "{rotation}: it did not come back"
            );
            run.step_to(34);
            assert!(
                run.members().is_empty(),
                "its lifetime goes on out of sight"
            );
        });
    }
}

/// Where along x particles are after `frame`.
fn along_x(on: &str, lines: &str, frame: u32) -> Vec<f64> {
    let mut run = Run::new(on, &scene("", &[lines]), frame + 1);
    run.step_to(frame);
    let members = run.members();
    members
        .iter()
        .map(|member| f64::from(member.state.position[0]))
        .collect()
}

const JET: &str = "generation_shape = { kind = \"circle\", radius = 0 }\n speed = 2
    rotation_degrees = [0, 90]\n lifetime = 10";

#[test]
fn a_jet_of_births_within_frames_has_no_gaps() {
    let spread = format!("{JET}\n birth_moment = \"within_frame\"");
    // One frame's births fill its step.
    let first = along_x(
        "cpu",
        &format!("{spread}\n initial_mean_parts = 100_000"),
        0,
    );
    assert!(first.iter().all(|x| (0.0..=2.0).contains(x)));
    assert_uniform("one frame", &first, 0.0, 2.0);
    on_every_backend(|on| {
        // Ten frames of births, the last ones to die still there.
        let all = along_x(on, &format!("{spread}\n initial_mean_parts = 2000"), 14);
        assert_eq!(all.len(), 20_000);
        assert_uniform("ten frames", &all, 0.0, 20.0);
        // At frames' starts there are ten places and nothing between.
        let all = along_x(on, &format!("{JET}\n initial_mean_parts = 2000"), 14);
        let is_whole = |x: &f64| (x / 2.0 - (x / 2.0).round()).abs() < 1e-5;
        assert!(all.len() == 20_000 && all.iter().all(is_whole));
    });
}

#[test]
fn the_moment_of_birth_is_no_other_attributes() {
    let lines = "generation_shape = { kind = \"line\", length = 8 }\n initial_mean_parts = 100_000
        speed = { mean = 2, var = 1 }\n birth_moment = \"within_frame\"";
    let mut run = Run::new("cpu", &scene("", &[lines]), 1);
    run.step_to(0);
    let members = run.members();
    // They leave up, along z: the way they have gone is the part of the frame that was left.
    let values: Vec<[f64; 4]> = members
        .iter()
        .map(|member| {
            let velocity = f64::from(member.state.velocity[2]);
            let [x, _, z] = member.state.position.map(f64::from);
            [z / velocity, velocity, x, f64::from(member.raw.index())]
        })
        .collect();
    let part: Vec<f64> = values.iter().map(|value| value[0]).collect();
    assert_uniform("part of the frame", &part, 0.0, 1.0);
    for (other, what) in [(1, "speed"), (2, "place"), (3, "index")] {
        let mut sorted = values.clone();
        sorted.sort_by(|a, b| a[other].total_cmp(&b[other]));
        for (half, name) in sorted.chunks(50_000).zip(["low", "high"]) {
            let part: Vec<f64> = half.iter().map(|value| value[0]).collect();
            assert_uniform(
                &format!("part of the frame, {name} {what}"),
                &part,
                0.0,
                1.0,
            );
        }
    }
}

#[test]
fn a_moving_system_leaves_an_even_trail_in_the_world() {
    let lines = "position = { keys = [[0, [0, 0, 0]], [10, [20, 0, 0]]] }\n lifetime = 100
        particle_space = \"world\"\n birth_moment = \"within_frame\"
        first_frame = 1\n end_frame = 11\n initial_mean_parts = 2000";
    on_every_backend(|on| {
        let trail = along_x(on, lines, 12);
        assert_eq!(trail.len(), 20_000);
        assert!(trail.iter().all(|x| (-1e-5..=20.0 + 1e-5).contains(x)));
        assert_uniform("trail", &trail, 0.0, 20.0);
        // Born at frames' starts they are where the system was in each frame.
        let clumps = along_x(on, &lines.replace("within_frame", "frame_start"), 12);
        let is_whole = |x: &f64| (x / 2.0 - (x / 2.0).round()).abs() < 1e-6;
        assert!(clumps.len() == 20_000 && clumps.iter().all(is_whole));
    });
}

#[test]
fn r19_a_turning_systems_births_within_frames_keep_their_speed() {
    // A sweep of 30 degrees a frame, from +z to +x.
    let lines = "rotation_degrees = { keys = [[0, [0, 0]], [3, [0, 90]]] }\n speed = 2
        generation_shape = { kind = \"circle\", radius = 0 }\n particle_space = \"world\"
        birth_moment = \"within_frame\"\n first_frame = 1\n end_frame = 4
        initial_mean_parts = 1000\n lifetime = 100";
    let mut run = Run::new("cpu", &scene("", &[lines]), 4);
    run.step_to(3);
    let members = run.members();
    assert_eq!(members.len(), 3000);
    let speeds = members
        .iter()
        .map(|member| vector(member.state.velocity).length());
    let (low, high) = speeds.fold((f64::MAX, 0.0), |(low, high): (f64, f64), speed| {
        (low.min(speed), high.max(speed))
    });
    assert!(
        (low - 2.0).abs() < 1e-4 && (high - 2.0).abs() < 1e-4,
        "speeds are {low} to {high}, all meant to be 2"
    );
}

#[test]
fn r43_the_living_move_and_turn_with_their_system_or_stay_behind() {
    // From (f, 0, 0), turned by 30 f degrees about y: up is (sin, 0, cos). Half a unit a frame.
    let lines = "position = { keys = [[0, [0, 0, 0]], [8, [8, 0, 0]]] }\n speed = 0.5
        rotation_degrees = { keys = [[0, [0, 0]], [8, [0, 240]]] }\n lifetime = 100
        generation_shape = { kind = \"circle\", radius = 0 }\n initial_mean_parts = 2";
    let up = |frame: f64| {
        let (sine, cosine) = (30.0 * frame).to_radians().sin_cos();
        DVec3::new(sine, 0.0, cosine)
    };
    on_every_backend(|on| {
        for space in ["system", "world"] {
            let lines = format!("{lines}\n particle_space = \"{space}\"");
            let mut run = Run::new(on, &scene("", &[&lines]), 9);
            run.step_to(8);
            let members = run.members();
            assert_eq!(members.len(), 18);
            for member in members {
                let birth = f64::from(member.who.birth_frame);
                // Their pose is the system's now, or what it was at their birth.
                let pose = if space == "system" { 8.0 } else { birth };
                let expected = DVec3::X * pose + up(pose) * (0.5 * (9.0 - birth));
                let off = (vector(member.state.position) - expected).length();
                assert!(off < 1e-5, "{space}: {member:?}, expected {expected}");
                let off = (vector(member.state.velocity) - up(pose) * 0.5).length();
                assert!(off < 1e-6, "{space}: {member:?}");
            }
        }
    });
}

#[test]
fn acceleration_is_the_worlds_however_a_system_is_turned() {
    for space in ["system", "world"] {
        let lines = format!(
            "rotation_degrees = [70, -130]\n acceleration = [0.25, -0.5, 0.125]\n end_frame = 1
            particle_space = \"{space}\""
        );
        on_every_backend(|on| {
            let mut run = Run::new(on, &scene("", &[&lines]), 10);
            run.step_to(9);
            let velocity = vector(run.members()[0].state.velocity);
            let off = (velocity - DVec3::new(2.5, -5.0, 1.25)).length();
            assert!(off < 1e-5, "{space}: {velocity}");
        });
    }
}
