//! How values get from key to key, and the scene at a time.

use std::borrow::Cow;

use motes::scene::{Interpolation, Key, Owner, Track};

use crate::text::{FULL, KEYED, accepted};

/// A track of one number.
fn track(interpolation: Interpolation, keys: &[(f64, f32)]) -> Track {
    let key = |&(frame, value): &(f64, f32)| Key {
        frame,
        value: [value, 0.0, 0.0],
    };
    Track {
        owner: Owner::Image,
        key: "exposure".into(),
        interpolation,
        keys: keys.iter().map(key).collect(),
    }
}

/// Keys that rise, rest, turn and fall, at uneven frames.
const UNEVEN: [(f64, f32); 8] = [
    (-3.0, 1.0),
    (0.0, 2.0),
    (1.0, 7.0),
    (1.5, 7.0),
    (4.0, 7.5),
    (9.0, -2.0),
    (9.25, -40.0),
    (30.0, -41.0),
];

const ALL: [Interpolation; 3] = [
    Interpolation::Linear,
    Interpolation::Smooth,
    Interpolation::Step,
];

#[test]
fn every_track_passes_through_its_keys_and_stays_before_and_after() {
    for interpolation in ALL {
        let track = track(interpolation, &UNEVEN);
        for (frame, value) in UNEVEN {
            assert_eq!(
                track.at(frame),
                [value, 0.0, 0.0],
                "{interpolation:?} {frame}"
            );
        }
        for time in [-3.0001, -1e9, f64::NEG_INFINITY] {
            assert_eq!(track.at(time)[0], 1.0, "{interpolation:?} {time}");
        }
        for time in [30.0001, 1e9, f64::INFINITY] {
            assert_eq!(track.at(time)[0], -41.0, "{interpolation:?} {time}");
        }
    }
    for interpolation in ALL {
        let track = track(interpolation, &[(5.0, 3.0)]);
        assert_eq!([4.0, 5.0, 6.0].map(|time| track.at(time)[0]), [3.0; 3]);
    }
}

#[test]
fn linear_tracks_go_straight_and_step_tracks_jump_at_the_key() {
    let linear = track(
        Interpolation::Linear,
        &[(0.0, 1.0), (10.0, 3.0), (12.0, -1.0)],
    );
    let times = [2.5, 5.0, 9.0, 11.0, 11.5];
    assert_eq!(
        times.map(|time| linear.at(time)[0]),
        [1.5, 2.0, 2.8, 1.0, 0.0]
    );
    let step = track(
        Interpolation::Step,
        &[(0.0, 1.0), (10.0, 3.0), (12.0, -1.0)],
    );
    let times = [0.5, 9.999, 10.0, 11.999, 12.0];
    assert_eq!(
        times.map(|time| step.at(time)[0]),
        [1.0, 1.0, 3.0, 3.0, -1.0]
    );
    // Each number of an array by itself.
    let key = |frame, value| Key { frame, value };
    let array = Track {
        keys: vec![key(0.0, [0.0, 4.0, -1.0]), key(4.0, [8.0, 0.0, -1.0])],
        ..linear
    };
    assert_eq!(array.at(1.0), [2.0, 3.0, -1.0]);
}

#[test]
fn a_smooth_track_is_the_cubic_with_harmonic_slopes() {
    // Slopes of the lines are 1 and 2, so that at the middle key is 2 / (1/1 + 1/2) = 4/3; those
    // at the ends are 0. Hermite's cubic in the middle is the mean of its ends, and an eighth of
    // the difference of its slopes.
    let smooth = track(Interpolation::Smooth, &[(0.0, 0.0), (1.0, 1.0), (2.0, 3.0)]);
    let wanted = [0.5 - 1.0 / 6.0, 2.0 + 1.0 / 6.0];
    for (time, wanted) in [0.5, 1.5].into_iter().zip(wanted) {
        assert!(
            (smooth.at(time)[0] - wanted).abs() < 1e-6,
            "{time}: {smooth:?}"
        );
    }
    // With uneven keys, slopes count per frame: 1/4 and 2 give 4/9, over 4 frames and over 1.
    let uneven = track(Interpolation::Smooth, &[(0.0, 0.0), (4.0, 1.0), (5.0, 3.0)]);
    let wanted = [0.5 - 4.0 / 9.0 * 4.0 / 8.0, 2.0 + 4.0 / 9.0 / 8.0];
    for (time, wanted) in [2.0, 4.5].into_iter().zip(wanted) {
        assert!(
            (uneven.at(time)[0] - wanted).abs() < 1e-6,
            "{time}: {uneven:?}"
        );
    }
}

#[test]
fn a_smooth_track_never_leaves_the_range_of_two_neighbours() {
    let track = track(Interpolation::Smooth, &UNEVEN);
    for pair in UNEVEN.windows(2) {
        let ((from, low), (to, high)) = (pair[0], pair[1]);
        let mut last = low;
        for i in 0..=1000 {
            let value = track.at(from + (to - from) * f64::from(i) / 1000.0)[0];
            let range = low.min(high)..=low.max(high);
            assert!(range.contains(&value), "{value} between {low} and {high}");
            // What is more, it goes one way.
            assert!((value - last) * (high - low) >= 0.0, "{last} {value}");
            last = value;
        }
    }
}

#[test]
fn a_smooth_track_has_no_corners() {
    let track = track(Interpolation::Smooth, &UNEVEN);
    for (frame, value) in &UNEVEN[1..UNEVEN.len() - 1] {
        // One-sided differences, of values that are single precision; the second derivative is at
        // most some 6 * 42 / 0.25^2 here.
        let h = 1.0 / 1024.0;
        let [before, after] = [-h, h].map(|h| {
            let difference = track.at(frame + h)[0] - value;
            f64::from(difference) / h
        });
        assert!(
            (before - after).abs() < 5000.0 * h,
            "{frame}: {before} {after}"
        );
    }
    // The measure tells a corner from none: linear has them here.
    let linear = Track {
        interpolation: Interpolation::Linear,
        ..track
    };
    let [before, after] = [-0.25, 0.25].map(|h| f64::from(linear.at(9.0 + h)[0] + 2.0) / h);
    assert!((before - after).abs() > 100.0, "{before} {after}");
}

#[test]
fn tracks_are_finite_and_in_range_whatever_their_keys() {
    // As near in time, and as far apart in value, as a scene file may have them.
    let keys = [
        (0.0, 0.0),
        (5e-324, 1e6),
        (1.0, 2e6),
        (2.0, 1e-6),
        (2.0 + f64::EPSILON * 2.0, 1.0),
    ];
    for interpolation in ALL {
        let track = track(interpolation, &keys);
        for pair in keys.windows(2) {
            let ((from, low), (to, high)) = (pair[0], pair[1]);
            for i in 0..=64 {
                let inner = from + (to - from) * f64::from(i) / 64.0;
                for time in [inner, inner.next_up(), inner.next_down()] {
                    if time < from || time > to {
                        continue;
                    }
                    let value = track.at(time)[0];
                    let range = low.min(high)..=low.max(high);
                    assert!(
                        range.contains(&value),
                        "{interpolation:?} at {time:e}: {value}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_scene_without_keys_is_the_same_at_all_times() {
    let scene = accepted(FULL);
    assert!(matches!(scene.at(17.5), Cow::Borrowed(same) if *same == scene));
    assert_eq!(scene.key_frames().count(), 0);
}

#[test]
fn a_scene_is_what_its_tracks_say_at_a_time() {
    let scene = accepted(KEYED);
    let mut frames: Vec<f64> = scene.key_frames().collect();
    frames.sort_by(f64::total_cmp);
    frames.dedup();
    assert_eq!(frames, [-10.0, 0.0, 9.0, 10.0, 12.0, 24.0, 30.0, 48.5]);
    let six = scene.at(6.0);
    // The plain scene with the values of that frame by hand, but for the smooth one.
    let plain = KEYED
        .replace("{ keys = [[0, 1], [30, 0.5]] }", "0.9")
        .replace("{ keys = [[-10, 0], [10, 100]] }", "80")
        .replace("{ keys = [[0, 0.5], [9, 1]] }", "0.8333333333")
        .replace(
            "{ keys = [[0, 0.1], [12, 0.2]], interpolation = \"step\" }",
            "0.1",
        )
        .replace("{ keys = [[0, 0], [10, 30]] }", "18")
        .replace(
            "{ keys = [[0, [1, 1, 1]], [10, [0.5, 0, 0]]] }",
            "[0.7, 0.4, 0.4]",
        );
    let mut wanted = accepted(&plain);
    let camera = wanted.tracks.remove(0);
    assert_eq!(
        (camera.owner, camera.key.as_str()),
        (Owner::Camera, "position")
    );
    wanted.camera.position = camera.at(6.0);
    assert_eq!(wanted.tracks, []);
    assert_eq!(*six, wanted);
    // Between 0 and 24, x rises from 0 to 3: at a quarter it is still slow, but on its way.
    assert!((0.1..0.75).contains(&six.camera.position[0]), "{six:?}");
}
