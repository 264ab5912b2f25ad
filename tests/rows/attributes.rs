//! What a newborn is given, and how it changes: Reeves (1983), sections 2.2 and 2.3.

use std::collections::BTreeSet;

use crate::common::statistics::{assert_uniform, ks_p_value};
use crate::light::Light;
use crate::support::{Member, Run, assert_within, on_every_backend, scene};

const ALL_VARY: &str = "lifetime = { mean = 20, var = 5 }\n speed = { mean = 0.5, var = 0.25 }
    generation_shape = { kind = \"circle\", radius = 2 }\n ejection_angle_degrees = 40
    color = { mean = [0.5, 0.25, 0.125], var = [0.25, 0.125, 0.0625] }
    transparency = { mean = 0.5, var = 0.25 }\n size = { mean = 1, var = 0.5 }";

fn members_of(system: &str) -> Vec<Member> {
    let mut run = Run::new("cpu", &scene("", &[system]), 1);
    run.step_to(0);
    run.members()
}

/// 100,000 newborns on the processor; the other backends give the same bits.
fn newborns(lines: &str) -> Vec<Member> {
    let members = members_of(&format!("{lines}\n initial_mean_parts = 100_000"));
    assert_eq!(members.len(), 100_000);
    members
}

/// Red, green, blue, transparency, size, lifetime and speed at birth.
fn drawn_attributes(member: &Member) -> [f64; 7] {
    let look = &member.at_birth;
    let velocity = glam::DVec3::from_array(member.raw.velocity().map(f64::from));
    [
        f64::from(look.color.x),
        f64::from(look.color.y),
        f64::from(look.color.z),
        f64::from(look.transparency),
        f64::from(look.size),
        f64::from(member.state.lifetime),
        velocity.length(),
    ]
}

#[test]
fn r4_every_attribute_is_within_its_half_width_of_its_mean() {
    let ranges = [
        (0.25, 0.75),
        (0.125, 0.375),
        (0.0625, 0.1875),
        (0.25, 0.75),
        (0.5, 1.5),
        (15.0, 25.0),
        // A direction's length is not 1 to the last bit.
        (0.25 - 1e-7, 0.75 + 1e-7),
    ];
    let mut extremes = [(f64::MAX, f64::MIN); 7];
    for member in newborns(ALL_VARY) {
        for (extreme, value) in extremes.iter_mut().zip(drawn_attributes(&member)) {
            *extreme = (extreme.0.min(value), extreme.1.max(value));
        }
    }
    for (at, ((least, most), (low, high))) in extremes.into_iter().zip(ranges).enumerate() {
        println!("attribute {at}: {least} ..= {most} in {low} ..= {high}");
        assert!(
            low <= least && most <= high,
            "attribute {at}: {least} ..= {most}"
        );
        // The half-width is reached, and not only a part of it.
        assert!(
            least - low < 0.001 * (high - low),
            "attribute {at}: {least}"
        );
        assert!(high - most < 0.001 * (high - low), "attribute {at}: {most}");
    }
}

#[test]
fn r11_a_particle_has_all_seven_attributes_and_each_varies_by_itself() {
    let members = newborns(ALL_VARY);
    let distinct = |value: &dyn Fn(&Member) -> u64| {
        members
            .iter()
            .take(2000)
            .map(value)
            .collect::<BTreeSet<_>>()
            .len()
    };
    let places = distinct(&|member| u64::from(member.raw.position_and_index[0]));
    let velocities = distinct(&|member| u64::from(member.raw.velocity_and_birth[0]));
    assert!(places > 1900 && velocities > 1900, "{places}, {velocities}");
    for at in [0, 1, 2, 3, 4, 6] {
        let count = distinct(&|member| drawn_attributes(member)[at].to_bits());
        assert!(count > 1900, "attribute {at}: {count}");
    }
    assert_eq!(distinct(&|member| u64::from(member.state.lifetime)), 11);
    // No two attributes are one draw: their correlation is within 4 sigma of none.
    let values: Vec<[f64; 7]> = members.iter().map(drawn_attributes).collect();
    for a in 0..7 {
        for b in 0..a {
            let r = correlation(values.iter().map(|value| (value[a], value[b])));
            assert!(
                r.abs() < 4.0 / (1e5f64).sqrt(),
                "attributes {a} and {b}: {r}"
            );
        }
    }
}

fn correlation(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let n = pairs.clone().count() as f64;
    let sum = pairs
        .clone()
        .fold((0.0, 0.0), |sum, (a, b)| (sum.0 + a, sum.1 + b));
    let center = (sum.0 / n, sum.1 / n);
    let moments = pairs.fold((0.0, 0.0, 0.0), |moments, (a, b)| {
        let (a, b) = (a - center.0, b - center.1);
        (moments.0 + a * a, moments.1 + a * b, moments.2 + b * b)
    });
    moments.1 / (moments.0 * moments.2).sqrt()
}

#[test]
fn r20_color_is_uniform_about_its_mean_and_never_negative() {
    let members = newborns("color = { mean = [0.5, 0.1, 0], var = [0.25, 0.3, 0.1] }");
    let channel = |at: usize| -> Vec<f64> {
        members
            .iter()
            .map(|member| drawn_attributes(member)[at])
            .collect()
    };
    assert_uniform("red", &channel(0), 0.25, 0.75);
    for (name, at, mean, var) in [("green", 1, 0.1, 0.3), ("blue", 2, 0.0, 0.1)] {
        let clamped = channel(at);
        assert!(clamped.iter().all(|&light| light >= 0.0), "{name}");
        let kept: Vec<f64> = clamped
            .iter()
            .copied()
            .filter(|&light| light > 0.0)
            .collect();
        assert_uniform(name, &kept, 0.0, mean + var);
        let dark = 1.0 - kept.len() as f64 / 1e5;
        let expected = (var - mean) / (2.0 * var);
        assert!(
            (dark - expected).abs() < 0.005,
            "{name}: {dark} dark, expected {expected}"
        );
    }
}

#[test]
fn r21_transparency_and_size_are_uniform_and_clamped() {
    let members =
        newborns("transparency = { mean = 0.8, var = 0.4 }\n size = { mean = 0.5, var = 1.5 }");
    let clear: Vec<f64> = members
        .iter()
        .map(|m| f64::from(m.at_birth.transparency))
        .collect();
    assert!(clear.iter().all(|value| (0.4..=1.0).contains(value)));
    let below: Vec<f64> = clear.iter().copied().filter(|&value| value < 1.0).collect();
    assert_uniform("transparency", &below, 0.4, 1.0);
    assert!(
        (below.len() as f64 / 1e5 - 0.75).abs() < 0.005,
        "a quarter is clamped to 1"
    );
    let sizes: Vec<f64> = members.iter().map(|m| f64::from(m.at_birth.size)).collect();
    assert!(sizes.iter().all(|&size| size > 0.0 && size <= 2.0));
    // What would be negative is as small as can be: a third of uniform in -1 .. 2.
    let seen: Vec<f64> = sizes.into_iter().filter(|&size| size > 1e-5).collect();
    assert_uniform("size", &seen, 0.0, 2.0);
    assert!(
        (seen.len() as f64 / 1e5 - 2.0 / 3.0).abs() < 0.005,
        "a third is clamped"
    );
}

/// One square particle a frame that lives for it: its light over the light of its picture.
fn light_by_frame(on: &str, lines: &str, frames: u32) -> Vec<(Member, Light)> {
    let still = "particle_shape = \"rectangle\"\n lifetime = 1\n position = [0.3, -0.4, 0]";
    let mut run = Run::new(on, &scene("", &[&format!("{still}\n{lines}")]), frames);
    let frame = |frame| {
        run.step_to(frame);
        let mut members = run.members();
        assert_eq!(members.len(), 1);
        (members.remove(0), run.light())
    };
    (0..frames).map(frame).collect()
}

#[test]
fn r20_r21_the_picture_shows_color_transparency_and_size() {
    // One of the three varies at a time, so that light tells its value: 2 x 2 pixels of colour.
    on_every_backend(|on| {
        let frames = if on == "cpu" { 400 } else { 40 };
        let passes = |what: &str, values: &[f64], low: f64, high: f64| {
            let cdf = |x: f64| ((x - low) / (high - low)).clamp(0.0, 1.0);
            assert!(
                values.iter().all(|&x| x >= low - 1e-5 && x <= high + 1e-5),
                "{what}"
            );
            let p = ks_p_value(values, cdf);
            assert!(p > 0.01, "{what} on {on}: p = {p}");
        };
        let mut reds = Vec::new();
        for (member, light) in light_by_frame(
            on,
            "color = { mean = [0.5, 0.25, 0.05], var = [0.25, 0.125, 0.1] }",
            frames,
        ) {
            for channel in 0..3 {
                let value = light.total(channel) / 4.0;
                let expected = f64::from(member.drawn.color.to_array()[channel]);
                assert!((value - expected).abs() < 1e-5, "{value}, {expected}");
            }
            reds.push(light.total(0) / 4.0);
        }
        passes("red", &reds, 0.25, 0.75);

        let clear = light_by_frame(on, "transparency = { mean = 0.5, var = 0.4 }", frames);
        let value = |(member, light): &(Member, Light)| {
            let value = 1.0 - light.total(0) / (4.0 * 0.5);
            assert!((value - f64::from(member.drawn.transparency)).abs() < 1e-5);
            value
        };
        passes(
            "transparency",
            &clear.iter().map(value).collect::<Vec<_>>(),
            0.1,
            0.9,
        );

        let sizes = light_by_frame(on, "size = { mean = 4, var = 3 }", frames);
        let value = |(member, light): &(Member, Light)| {
            let value = (light.total(0) / (4.0 * 0.5)).sqrt();
            assert_within("size", value, f64::from(member.drawn.size), 1e-4);
            value
        };
        passes(
            "size",
            &sizes.iter().map(value).collect::<Vec<_>>(),
            1.0,
            7.0,
        );
    });
}
