//! What Perry left for later: colours by noise, tips that part, two layers of triangles; and the
//! models that were rejected.

use motes::cpu::fan::{disc_light, inner_share};
use motes::scene::load;

use crate::support::*;

#[test]
fn p79_noise_moves_particles_along_the_ramp() {
    let with = |noise: &str| drawn(&flame(&format!("height = 0.9\n{noise}")), 5);
    let plain = with("");
    assert_eq!(
        with("color_noise = 0\ncolor_noise_scale = 9").image,
        plain.image
    );
    let noisy = with("color_noise = 0.5");
    assert_ne!(noisy.image, plain.image);
    // Places and shapes stay; only colours move.
    for (a, b) in noisy.discs.iter().zip(&plain.discs) {
        assert_eq!(a.place, b.place);
    }
    // All colours are of the ramp: brightest where its opacity is greatest.
    let opacity = |disc: &motes::layout::FlameDisc| f32::from_bits(disc.center[3]);
    let most = plain.discs.iter().map(opacity).fold(0.0, f32::max);
    assert!(
        noisy
            .discs
            .iter()
            .all(|disc| (0.0..=most + 1e-6).contains(&opacity(disc)))
    );
    let moved = noisy.discs.iter().zip(&plain.discs);
    let moved = moved.filter(|(a, b)| (opacity(a) - opacity(b)).abs() > 0.01);
    assert!(moved.count() >= 5);
}

/// The pieces that pixels which are bright enough make, at a corner or a side of each other: how high the
/// mean of each is above the foot of the picture and how high its foot is, in pixels.
fn pieces(light: &[[f64; 3]], width: usize, least: f64) -> Vec<[f64; 2]> {
    let mut open: Vec<bool> = light.iter().map(|pixel| pixel[0] > least).collect();
    let height = open.len() / width;
    let mut pieces = Vec::new();
    for start in 0..open.len() {
        let mut reached = vec![start];
        let (mut size, mut sum, mut foot) = (0.0, 0.0, f64::MAX);
        while let Some(at) = reached.pop() {
            if !std::mem::take(&mut open[at]) {
                continue;
            }
            let (x, y) = (at % width, at / width);
            let above = (height - y) as f64;
            size += 1.0;
            sum += above;
            foot = foot.min(above);
            for y in y.saturating_sub(1)..(y + 2).min(height) {
                reached.extend((x.saturating_sub(1)..(x + 2).min(width)).map(|x| y * width + x));
            }
        }
        if size > 3.0 {
            pieces.push([sum / size, foot]);
        }
    }
    pieces
}

#[test]
fn p81_tips_part_and_rise_where_noise_colours() {
    let scene = |noise: &str| flame(&format!("height = 1\nwidth = 0.12\n{noise}"));
    // The mean height of the one piece that is above the flame, where there is one.
    let tips = |noise: &str| -> Vec<Option<f64>> {
        let scene = scene(noise);
        let tip = |frame: u32| {
            let mut pieces = pieces(&drawn(&scene, frame).light, 160, 0.08);
            pieces.sort_by(|a, b| a[1].total_cmp(&b[1]));
            match pieces[..] {
                [_, [mean, _]] => Some(mean),
                _ => None,
            }
        };
        (0..100).map(tip).collect()
    };
    assert!(tips("").iter().all(Option::is_none));
    let tips = tips("color_noise = 1.5\ncolor_noise_scale = 5");
    let parted = tips.iter().flatten().count();
    // From frame to frame, as long as it is the same one.
    let steps: Vec<f64> = tips
        .windows(2)
        .filter_map(|two| Some(two[1]? - two[0]?))
        .filter(|step| step.abs() < 4.0)
        .collect();
    let count = |of: fn(&&f64) -> bool| steps.iter().filter(of).count();
    let (rising, sinking) = (count(|step| **step > 0.0), count(|step| **step < 0.0));
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    assert!(parted >= 20 && steps.len() >= 15, "{parted} frames of 100");
    assert!(rising > 3 * sinking, "{rising} rise, {sinking} sink");
    assert!(mean > 0.1, "{mean} pixels a frame");
}

#[test]
fn p83_two_layers_make_two_slopes() {
    let (center, rim) = (
        glam::Vec4::new(1.0, 1.0, 1.0, 0.2),
        glam::Vec4::new(1.0, 1.0, 1.0, 0.0),
    );
    let light = |share: f32| disc_light(center, rim, [1.5, 1.0 / 0.4], share).x;
    let slope = |from: f32, to: f32| (light(to) - light(from)) / (to - from);
    // Outside the inner layer's radius of 0.4 there is the outer one alone.
    for (from, to) in [(0.05, 0.2), (0.2, 0.59)] {
        assert!((slope(from, to) - 0.2).abs() < 1e-5);
    }
    for (from, to) in [(0.61, 0.7), (0.7, 1.0)] {
        assert!((slope(from, to) - (0.2 + 0.3 / 0.4)).abs() < 1e-5);
    }
    assert!((light(1.0) - 0.5).abs() < 1e-6);
    assert_eq!(inner_share(0.5, 1.0 / 0.4), 0.0);
    // Without it, all is as it was.
    let one = drawn(&flame("height = 0.9\ninner_radius = 0.1"), 2).image;
    assert_eq!(one, drawn(&flame("height = 0.9"), 2).image);
    assert_ne!(one, drawn(&flame("height = 0.9\ninner_alpha = 1"), 2).image);
}

/// The light of each third of a picture of the scene, frame by frame.
fn thirds(frames: u32) -> Vec<[f64; 3]> {
    let mut scene = load("flames-rejected").expect("it is built in");
    (scene.image.width, scene.image.height) = (240, 135);
    let plan = plan(&scene);
    let mut cpu = crate::common::on_cpu(&plan);
    let mut sums = Vec::new();
    use motes::backend::Backend;
    for frame in plan.first_frame..frames as i32 {
        let inputs = plan.inputs(frame.cast_unsigned());
        cpu.step(&inputs).expect("it runs");
        if frame < 0 {
            continue;
        }
        cpu.draw(&inputs).expect("it runs");
        let low = cpu.read("light_low").expect("it is read");
        let mut sum = [0.0; 3];
        for (at, pixel) in low.chunks(3).enumerate() {
            sum[at % 240 / 80] += f64::from(pixel[0]) / 1_048_576.0;
        }
        sums.push(sum);
    }
    sums
}

#[test]
fn p46_many_particles_flicker_more_than_one_whose_way_is_shown() {
    let sums = thirds(60);
    let flicker = |at: usize| {
        let mean = sums.iter().map(|sum| sum[at]).sum::<f64>() / sums.len() as f64;
        let changes = sums.windows(2).map(|two| (two[1][at] - two[0][at]) / mean);
        changes.map(|change| change * change).sum::<f64>() / (sums.len() - 1) as f64
    };
    let (many, one) = (flicker(0), flicker(2));
    assert!(many > 3.0 * one, "{many} and {one}");
}

#[test]
fn p47_one_particle_in_the_shape_of_a_flame_cannot_bend() {
    let sums = thirds(3);
    assert!(sums[0][1] > 10.0, "it shines: {sums:?}");
    assert!(sums.iter().all(|sum| sum[1] == sums[0][1]), "{sums:?}");
}
