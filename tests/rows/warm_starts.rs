//! Scenes that are under way when they begin: births before frame 0.

use motes::layout::FrameStats;

use crate::support::{Run, on_every_backend, scene};

/// Nothing is drawn at random, so that births of any two frames are alike.
const FOUNTAIN: &str = "initial_mean_parts = 3\n lifetime = 9
    generation_shape = { kind = \"circle\", radius = 0 }\n speed = 0.25
    acceleration = [0.125, -0.0625, 0]
    size = { mean = 0.5, rate = 0.0625 }\n particle_shape = \"rectangle\"";

/// The fountain from `first` on, with a burst `after` frames later.
fn fountain(first: i32, after: i32, extra: &str) -> motes::scene::Scene {
    let lines = format!(
        "first_frame = {first}\n{FOUNTAIN}\n{extra}
        burst = [{{ frame = {}, parts = 40 }}]",
        first + after
    );
    scene("", &[&lines])
}

type Shown = (Vec<(u32, [f32; 3], [f32; 3])>, Vec<u64>);

/// What there is after `frame`: age, place and velocity of each, and the picture's light.
fn shown(run: &mut Run, frame: i32) -> Shown {
    run.step_through(frame);
    let states = run.members().into_iter().map(|m| m.state);
    let members = states.map(|state| (state.age, state.position, state.velocity));
    (members.collect(), run.light().steps)
}

#[test]
fn births_before_the_first_frame_are_births_as_any() {
    let extra = "end_frame = 30\n drag = 0.03125\n delta_mean_parts = 1";
    on_every_backend(|on| {
        for first in [-5, -14] {
            let mut warm = Run::new(on, &fountain(first, 2, extra), 20);
            let mut cold = Run::new(on, &fountain(0, 2, extra), 20 + first.unsigned_abs());
            for frame in [0, 3, 12] {
                let (warm, cold) = (shown(&mut warm, frame), shown(&mut cold, frame - first));
                assert!(warm.0.len() > 20, "{}", warm.0.len());
                assert!(warm == cold, "from {first}, frame {frame} on {on}");
            }
            // The books balance from the first birth on.
            let lines = warm.statistics();
            assert_eq!(lines.len() as i32, 13 - first);
            let mut live = 0;
            for (line, frame) in lines.iter().zip(first..) {
                assert_eq!(line.frame, frame.cast_unsigned());
                assert_eq!(line.live, live + line.born - line.died);
                let burst = if frame == first + 2 { 40 } else { 0 };
                let expected = (3 + (frame - first).cast_unsigned()) + burst;
                assert_eq!((line.requested, line.born), (expected, expected));
                live = line.live;
            }
            let shifted: Vec<FrameStats> = cold.statistics();
            let books = |line: &FrameStats| (line.born, line.died, line.live);
            assert!(lines.iter().map(books).eq(shifted.iter().map(books)));
        }
    });
}

#[test]
fn births_long_before_the_first_frame_are_gone_by_then() {
    // A thousand frames of a lifetime of 9: a restart need not step them all.
    let scene = fountain(-1000, 997, "end_frame = 30");
    on_every_backend(|on| {
        let mut whole = Run::new(on, &scene, 3);
        let mut restarted = Run::new(on, &scene, 3);
        restarted.simulation.seek(0).expect("the backend steps");
        let stepped = restarted.take_calls().len();
        assert!(stepped < 20, "{stepped} frames to see a lifetime of 9");
        let whole = shown(&mut whole, 0);
        assert_eq!(whole.0.len(), 9 * 3 + 40);
        assert!(whole == shown(&mut restarted, 0), "{on}");
    });
}

#[test]
fn systems_that_draw_at_random_begin_before_the_first_frame_too() {
    let lines = "first_frame = -30\n initial_mean_parts = 50\n var_parts = 20\n drag = 0.05
        birth_rounding = \"stochastic\"\n generation_shape = { kind = \"sphere\", radius = 5 }
        speed = { mean = 0.2, var = 0.1 }\n lifetime = { mean = 12, var = 6 }
        color = { mean = [0.3, 0.2, 0.1], var = [0.1, 0.1, 0.1], rate_var = [0.01, 0.01, 0.01] }
        position = { keys = [[-20, [0, 0, 0]], [5, [5, 0, 0]]] }\n particle_space = \"world\"
        birth_moment = \"within_frame\"";
    let scene = scene("", &[lines]);
    let expected = shown(&mut Run::new("cpu", &scene, 4), 0);
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene, 4);
        assert!(shown(&mut run, 0) == expected, "{on}");
        let members = run.members();
        // About 50 x 12, of all ages to 18, most born before frame 0.
        assert!((450..750).contains(&members.len()), "{}", members.len());
        assert!(members.iter().all(|member| member.state.age < 18));
        let early = members
            .iter()
            .filter(|m| m.who.birth_frame.cast_signed() < 0);
        assert!(early.count() > 400);
        let lines = run.statistics();
        assert!(lines.len() == 31 && lines.iter().all(|line| line.dropped == 0));
        let mut live = 0;
        for line in &lines {
            assert_eq!(line.live, live + line.born - line.died);
            live = line.live;
        }
        assert_eq!(live as usize, members.len());
    });
}
