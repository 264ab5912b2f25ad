//! Values with keys: what rules particles holds for those born at the frame, what acts on them
//! for all. Reeves (1983), section 2.1, further work.

use glam::DVec3;

use crate::support::{Run, assert_within, on_every_backend, scene};

/// A square of 2 x 2 pixels a frame.
const SQUARES: &str = "particle_shape = \"rectangle\"\n lifetime = 3\n position = [0.3, -0.4, 0]";

/// Light of the picture in red, frame by frame.
fn reds(on: &str, lines: &str, frames: u32) -> Vec<f64> {
    let mut run = Run::new(on, &scene("", &[&format!("{SQUARES}\n{lines}")]), frames);
    let frame = |frame| {
        run.step_to(frame);
        run.light().total(0)
    };
    (0..frames).map(frame).collect()
}

/// Fails unless every frame shows what those born in it and in the two before it look like:
/// `light` of a birth frame and of the steps since.
fn assert_cohorts(on: &str, lines: &str, light: impl Fn(f64, f64) -> f64) {
    for (frame, red) in (0i32..).zip(reds(on, lines, 30)) {
        let births = (frame - 2).max(0)..=frame;
        let expected: f64 = births
            .map(|birth| light(f64::from(birth), f64::from(frame - birth + 1)))
            .sum();
        assert_within(&format!("{lines}: frame {frame}"), red, expected, 2e-5);
    }
}

#[test]
fn keyed_looks_are_those_of_the_frame_of_birth() {
    // From frame 4 to 20 in a line, else level.
    let ramp = |frame: f64, low: f64, high: f64| {
        low + (high - low) * ((frame - 4.0) / 16.0).clamp(0.0, 1.0)
    };
    on_every_backend(|on| {
        let color = "color = { mean = { keys = [[4, [0.25, 0, 0]], [20, [0.75, 0, 0]]] }, rate = [0.125, 0, 0] }";
        assert_cohorts(on, color, |birth, steps| {
            4.0 * (ramp(birth, 0.25, 0.75) + 0.125 * steps)
        });
        let rate = "color = { mean = [0.5, 0, 0], rate = { keys = [[4, [-0.125, 0, 0]], [20, [0.25, 0, 0]]] } }";
        assert_cohorts(on, rate, |birth, steps| {
            4.0 * (0.5 + ramp(birth, -0.125, 0.25) * steps)
        });
        let clear = "transparency = { keys = [[4, 0], [20, 0.75]] }";
        assert_cohorts(on, clear, |birth, _| {
            4.0 * 0.5 * (1.0 - ramp(birth, 0.0, 0.75))
        });
        let size = "size = { keys = [[4, 1], [20, 3]] }";
        assert_cohorts(on, size, |birth, _| {
            4.0 * 0.5 * ramp(birth, 1.0, 3.0).powi(2)
        });
    });
}

#[test]
fn keyed_lifetimes_and_thresholds_are_those_of_the_frame_of_birth() {
    let lifetime = "lifetime = { keys = [[0, 3], [6, 9], [12, 2]], interpolation = \"step\" }";
    let dim = "lifetime = 40
        intensity_threshold = { keys = [[0, 0.25], [8, 0.75]], interpolation = \"step\" }";
    let ages = |run: &mut Run, frame: u32| -> Vec<u32> {
        run.step_to(frame);
        run.members()
            .iter()
            .map(|member| member.who.birth_frame)
            .collect()
    };
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene("", &[lifetime]), 24);
        for frame in 0..24 {
            let given = |birth: u32| match birth {
                0..6 => 3,
                6..12 => 9,
                _ => 2,
            };
            let expected: Vec<u32> = (0..=frame)
                .filter(|&birth| frame < birth + given(birth))
                .collect();
            assert_eq!(ages(&mut run, frame), expected, "frame {frame} on {on}");
        }
        // Those born before the threshold rose keep theirs; those after are never seen.
        let mut run = Run::new(on, &scene("", &[dim]), 24);
        assert_eq!(ages(&mut run, 23), (0..8).collect::<Vec<u32>>(), "{on}");
    });
}

#[test]
fn keyed_places_and_speeds_are_those_of_the_frame_of_birth() {
    let lines = "generation_shape = { kind = \"ring\", inner_radius = { keys = [[0, 1], [16, 5]] }, outer_radius = { keys = [[0, 1], [16, 5]] } }
        speed = { mean = { keys = [[0, 1], [16, 3]] } }\n initial_mean_parts = 20
        ejection_angle_degrees = { keys = [[0, 0], [16, 64]] }";
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene("", &[lines]), 17);
        run.step_to(16);
        let members = run.members();
        assert_eq!(members.len(), 17 * 20);
        let mut widest = [0.0f64; 17];
        for member in members {
            let [place, velocity] = [member.state.position, member.state.velocity]
                .map(|words| DVec3::from_array(words.map(f64::from)));
            let birth = f64::from(member.who.birth_frame);
            let place = place - velocity * (17.0 - birth);
            assert_within("distance", place.length(), 1.0 + birth / 4.0, 1e-4);
            assert_within("speed", velocity.length(), 1.0 + birth / 8.0, 1e-5);
            let angle = velocity.truncate().length().atan2(velocity.z).to_degrees();
            let widest = &mut widest[member.who.birth_frame as usize];
            *widest = widest.max(angle);
        }
        for (birth, angle) in widest.into_iter().enumerate() {
            // Of 20 in a cone, some are in its outer part.
            let cone = 4.0 * birth as f64;
            assert!(
                angle <= cone + 0.01 && angle >= 0.7 * cone,
                "{birth}: {angle}"
            );
        }
    });
}

#[test]
fn keyed_forces_act_on_all_the_living() {
    let pulled = "acceleration = { keys = [[5, [0, 0, 0]], [6, [0, -0.5, 0.25]]], interpolation = \"step\" }";
    let slowed = "generation_shape = { kind = \"circle\", radius = 0 }\n speed = 1
        drag = { keys = [[5, 0], [6, 0.25]], interpolation = \"step\" }";
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene("", &[pulled]), 12);
        run.step_to(11);
        for member in run.members() {
            // In frames 6 to 11, or since its birth.
            let times = 12 - member.who.birth_frame.max(6);
            let expected = [0.0, -0.5 * times as f32, 0.25 * times as f32];
            assert_eq!(member.state.velocity, expected, "{on}");
        }
        let mut run = Run::new(on, &scene("", &[slowed]), 12);
        run.step_to(11);
        for member in run.members() {
            let times = 12 - member.who.birth_frame.max(6);
            let expected = 0.75f64.powi(times as i32);
            assert_within("speed", f64::from(member.state.velocity[2]), expected, 1e-6);
        }
    });
}
