//! What is drawn of strokes: as wide and as clear as they are, without a seam where pieces meet.

use motes::backend::Backend;

use crate::support::{BLADES, HEIGHT, WIDTH, distance, drawn, ends, records, scene};

/// One that bends to one side and not over itself.
fn one() -> String {
    let one = BLADES.replace("initial_mean_parts = 40", "initial_mean_parts = 1");
    let wide = one.replace("ejection_angle_degrees = 60", "ejection_angle_degrees = 15");
    wide.replace("[0.0005, -0.002, 0.0003]", "[0.0015, -0.0004, 0.0001]")
}

/// What shows through in each pixel.
fn clear(backend: &mut motes::cpu::CpuBackend) -> Vec<f32> {
    let words = backend.read("cover_bt").expect("it can be read");
    words.chunks(2).map(|bt| f32::from_bits(bt[1])).collect()
}

#[test]
fn a_stroke_is_even_where_its_pieces_meet() {
    let one = one();
    let lines = format!("{one}\nstroke_taper = 0\ntransparency = 0.5")
        .replace("size = 0.01", "size = 0.06");
    for seed in 1..=12 {
        let scene = scene(&format!("seed = {seed}"), &[&lines]);
        let (plan, mut backend) = drawn(&scene, 0);
        let all = records(&plan, &mut backend);
        let [_, pieces] = &all[0];
        assert!(pieces.len() >= 3);
        let clear = clear(&mut backend);
        let (mut inside, mut outside) = (0, 0);
        for (at, clear) in clear.iter().enumerate() {
            let (x, y) = (at as u32 % WIDTH, at as u32 / WIDTH);
            let place = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let spans = pieces.iter().map(|piece| {
                let [a, b] = ends(piece);
                let halves = [piece.shape[0], piece.shape[1]].map(f32::from_bits);
                let [least, most] = [halves[0].min(halves[1]), halves[0].max(halves[1])];
                let off = distance(place, a, b);
                [off - f64::from(least), off - f64::from(most)]
            });
            let far = [f64::INFINITY; 2];
            let [inward, outward] = spans.fold(far, |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
            // Neither twice nor not at all.
            if inward < -0.75 {
                assert_eq!(*clear, 0.5, "seed {seed}, {place:?}");
                inside += 1;
            }
            if outward > 0.75 {
                assert_eq!(*clear, 1.0, "seed {seed}, {place:?}");
                outside += 1;
            }
        }
        assert!(
            inside > 100 && outside > 1000,
            "seed {seed}: {inside}, {outside}"
        );
    }
}

#[test]
fn strokes_taper_and_what_is_thin_is_clear() {
    let one = one();
    let area = |size: f64, taper: f64| {
        let sized = one.replace("size = 0.01", &format!("size = {size}"));
        let lines = format!("{sized}\nstroke_taper = {taper}");
        let (_, mut backend) = drawn(&scene("camera.position = [0, 2, 5]", &[&lines]), 0);
        let clear = clear(&mut backend);
        assert_eq!(clear.len(), (WIDTH * HEIGHT) as usize);
        clear
            .iter()
            .map(|clear| 1.0 - f64::from(*clear))
            .sum::<f64>()
    };
    // From three pixels wide to a tenth of one: as much area as it is wide.
    let whole = area(0.04, 0.0);
    for share in [0.5, 0.25, 0.125, 0.03125] {
        let part = area(0.04 * share, 0.0) / whole;
        assert!(
            (part / share - 1.0).abs() < 0.06,
            "{part} instead of {share}"
        );
    }
    // The mean of 1 - t^2 is two thirds; what is nearer counts more.
    let tapered = area(0.04, 1.0) / whole;
    assert!((0.5..0.8).contains(&tapered), "{tapered}");
}
