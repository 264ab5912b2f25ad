//! What the exact functions promise besides their errors: awkward arguments, exact cases, order; the processor's side only,
//! but for the constants, which are compared with those of `wgsl/lib/`.

use glam::Vec3;
use motes::exact::*;
use motes::transcendental::*;

/// A random word by another generator than the one under test (splitmix of Steele et al. 2014).
fn hash(index: u32) -> u32 {
    let mut z = (u64::from(index) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 32) as u32
}

/// 2^n.
fn power(n: i32) -> f32 {
    2f32.powi(n)
}

/// Floats that trip conversions and comparisons: zeros, denormals, edges of every range, infinities, NaN, and any bits.
fn awkward() -> Vec<f32> {
    let edges = [
        0.0,
        f32::from_bits(1),
        f32::from_bits(0x007f_ffff),
        f32::MIN_POSITIVE,
        SMALLEST.next_down(),
        SMALLEST,
        SMALLEST.next_up(),
        0.5,
        1.0f32.next_down(),
        1.0,
        power(24),
        power(30).next_down(),
        power(30),
        power(30).next_up(),
        power(31),
        power(40).next_up(),
        power(80).next_up(),
        f32::MAX,
        f32::INFINITY,
        f32::NAN,
    ];
    edges
        .into_iter()
        .flat_map(|x| [x, -x])
        .chain((0..100_000).map(|i| f32::from_bits(hash(i))))
        .collect()
}

#[test]
fn snap_is_idempotent_and_leaves_no_denormal_and_no_negative_zero() {
    for x in awkward() {
        let snapped = snap(x);
        assert_eq!(snap(snapped).to_bits(), snapped.to_bits(), "{x:e}");
        if x.abs() < power(-40) {
            assert_eq!(snapped.to_bits(), 0, "{x:e}");
        } else {
            assert_eq!(snapped.to_bits(), x.to_bits(), "{x:e}");
        }
        assert_eq!(bits_of(x), snapped.to_bits());
    }
    let v = glam::Vec4::new(-0.0, 1e-20, -3.0, SMALLEST);
    let bits = |v: &[f32]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let want = bits(&[0.0, 0.0, -3.0, SMALLEST]);
    assert_eq!(bits(&snap4(v).to_array()), want);
    assert_eq!(bits(&snap3(v.truncate()).to_array()), want[..3]);
    assert_eq!(bits(&snap2(v.truncate().truncate()).to_array()), want[..2]);
}

#[test]
fn comparisons_agree_with_those_of_snapped_numbers() {
    let numbers: Vec<f32> = awkward()
        .into_iter()
        .filter(|x| !x.is_nan())
        .take(120)
        .collect();
    for &a in &numbers {
        for &b in &numbers {
            let (p, q) = (snap(a), snap(b));
            assert_eq!(less(a, b), p < q, "{a:e} {b:e}");
            assert_eq!(less_equal(a, b), p <= q, "{a:e} {b:e}");
            assert_eq!(min_exact(a, b).to_bits(), p.min(q).to_bits());
            assert_eq!(max_exact(a, b).to_bits(), p.max(q).to_bits());
            for &x in &numbers[..40] {
                let (low, high) = (p.min(q), p.max(q));
                let want = snap(x).clamp(low, high);
                assert_eq!(clamp_exact(x, low, high).to_bits(), want.to_bits());
            }
        }
    }
    let (a, b) = (Vec3::new(1.0, -2.0, 0.0), Vec3::new(-1.0, 3.0, 1e-20));
    assert_eq!(min3(a, b), Vec3::new(-1.0, -2.0, 0.0));
    assert_eq!(max3(a, b), Vec3::new(1.0, 3.0, 0.0));
    assert_eq!(
        clamp3(Vec3::new(5.0, -5.0, 0.5), Vec3::splat(-1.0), Vec3::ONE),
        Vec3::new(1.0, -1.0, 0.5)
    );
}

#[test]
fn low_bits_are_those_of_whole_numbers() {
    const HELD: u32 = (1 << 22) - 1;
    for whole in (-4_194_303i32..=4_194_303)
        .step_by(37)
        .chain([0, -1, 1, 4095, -4096])
    {
        let low = low_bits(whole as f32) & HELD;
        assert_eq!(low, whole.cast_unsigned() & HELD, "{whole}");
    }
}

#[test]
fn to_i32_floors_and_clamps_whatever_it_is_given() {
    for x in awkward() {
        let want = if x.is_nan() || x.abs() < power(-40) {
            0
        } else {
            let floor = f64::from(x).floor();
            floor.clamp(-1_073_741_824.0, 1_073_741_824.0) as i32
        };
        assert_eq!(to_i32(x), want, "{x:e}");
    }
    assert_eq!(to_i32(-0.5), -1);
    assert_eq!(to_i32(-1e-20), 0, "what is snapped is not below zero");
    assert_eq!(to_i32(f32::NEG_INFINITY), -1_073_741_824);
    for x in awkward() {
        let want = if x.abs() < power(-40) { 0.0 } else { x.floor() };
        let same =
            floor_exact(x).to_bits() == want.to_bits() || x.is_nan() && floor_exact(x).is_nan();
        assert!(same, "{x:e}: {} instead of {want}", floor_exact(x));
    }
    assert_eq!(floor_exact(-1.5), -2.0);
    assert_eq!(floor_exact(-1e-20).to_bits(), 0);
}

#[test]
fn limbs_hold_the_nearest_whole_number_up_to_2_to_the_37() {
    let whole = |x: f32| {
        let limbs = limbs3(Vec3::new(0.0, x, -x));
        assert_eq!((limbs.coarse.x, limbs.fine.x), (0, 0));
        let of = |coarse: i32, fine: i32| {
            assert!(fine.abs() <= 1 << 15, "{x:e}: {fine}");
            i64::from(coarse) * 65_536 + i64::from(fine)
        };
        let (above, below) = (
            of(limbs.coarse.y, limbs.fine.y),
            of(limbs.coarse.z, limbs.fine.z),
        );
        assert_eq!(above, -below, "{x:e}");
        above
    };
    for x in awkward().into_iter().filter(|x| x.abs() <= power(37)) {
        assert_eq!(whole(x), f64::from(x).round_ties_even() as i64, "{x:e}");
    }
    for (x, nearest) in [
        (0.5, 0),
        (1.5, 2),
        (2.5, 2),
        (0.500_000_06, 1),
        (32_767.5, 32_768),
        (32_768.0, 32_768),
        (65_535.5, 65_536),
        (8_388_607.5, 8_388_608),
        (536_870_912.0, 536_870_912),
    ] {
        assert_eq!(whole(x), nearest, "{x:e}");
    }
}

#[test]
fn integers_become_floats_exactly_up_to_2_to_the_24() {
    for i in [0, 1, -1, 12_345, 16_777_215, 16_777_216, -16_777_216] {
        assert_eq!(f64::from(f32_of_i32(i)), f64::from(i));
    }
    for i in [16_777_217, 1 << 30, i32::MAX] {
        assert_eq!(f32_of_i32(i), power(24));
        assert_eq!(f32_of_i32(-i), -power(24));
        assert_eq!(f32_of_u32(i.cast_unsigned()), power(24));
    }
    assert_eq!(f32_of_i32(i32::MIN), -power(24));
    assert_eq!(f32_of_u32(u32::MAX), power(24));
    assert_eq!(f32_of_u32(16_777_215), 16_777_215.0);
    assert_eq!(f32_of_u32(0).to_bits(), 0);
}

#[test]
fn powers_of_two_are_exact() {
    for n in -40..=40 {
        assert_eq!(reciprocal(power(n)), power(-n), "1/2^{n}");
        assert_eq!(reciprocal(-power(n)), -power(-n), "-1/2^{n}");
    }
    for n in -20..=40 {
        assert_eq!(inverse_square_root(power(2 * n)), power(-n), "4^{n}");
        assert_eq!(square_root(power(2 * n)), power(n), "4^{n}");
    }
    for n in -40..=60 {
        assert_eq!(exp2_exact(n as f32), power(n), "2^{n}");
        assert_eq!(log2_exact(power(n)), n as f32, "log2 2^{n}");
    }
    for n in -13..=13 {
        assert_eq!(cube_root(power(3 * n)), power(n), "8^{n}");
    }
}

#[test]
fn out_of_range_arguments_give_what_is_documented() {
    for x in awkward() {
        let magnitude = x.abs();
        if x.is_nan() || magnitude < power(-40) || magnitude > power(40) {
            assert_eq!(reciprocal(x).to_bits(), 0, "{x:e}");
        }
        let usable = x >= power(-40) && x <= power(80);
        assert_eq!(inverse_square_root(x) > 0.0, usable, "{x:e}");
        if !usable {
            assert_eq!(inverse_square_root(x).to_bits(), 0, "{x:e}");
        }
        if !x.is_nan() {
            assert!((0.0..=power(14)).contains(&cube_root(x)), "{x:e}");
            assert!((power(-40)..=power(60)).contains(&exp2_exact(x)), "2^{x:e}");
            assert!((-40.0..=60.0).contains(&log2_exact(x)), "log2 {x:e}");
        }
    }
    assert_eq!(square_root(0.0), 0.0);
    assert_eq!(square_root(-4.0), 0.0);
    assert_eq!(cube_root(0.0).to_bits(), 0);
    assert_eq!(cube_root(-8.0).to_bits(), 0);
    assert_eq!(exp2_exact(-41.0), power(-40));
    assert_eq!(exp2_exact(f32::INFINITY), power(60));
    assert_eq!(log2_exact(0.0), -40.0);
    assert_eq!(log2_exact(-1.0), -40.0);
}

#[test]
fn quarter_turns_are_exact() {
    let wave = [0.0, 1.0, 0.0, -1.0f32];
    for quarters in (-4_194_304..=4_194_304).step_by(41).chain(-9..=9) {
        let t = quarters as f32 * 0.25;
        let at = |shift: i32| wave[(quarters + shift).rem_euclid(4) as usize].to_bits();
        assert_eq!(sin_turns(t).to_bits(), at(0), "sin of {t} turns");
        assert_eq!(cos_turns(t).to_bits(), at(1), "cos of {t} turns");
    }
    assert_eq!(sin_turns(1e-20).to_bits(), 0);
    for x in awkward().into_iter().filter(|x| x.abs() <= power(20)) {
        assert!(sin_turns(x).abs() <= 1.0 && cos_turns(x).abs() <= 1.0);
    }
}

#[test]
fn dot_and_cross_keep_their_order_and_normalize_keeps_zero() {
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    assert_eq!(cross3(x, y), z);
    assert_eq!(cross3(y, z), x);
    assert_eq!(cross3(z, x), y);
    // Another order of summation would lose the 1.
    let order = dot3(
        Vec3::new(power(24), power(24), 1.0),
        Vec3::new(1.0, -1.0, 1.0),
    );
    assert_eq!(order, 1.0);
    assert_eq!(normalize_exact(Vec3::ZERO), Vec3::ZERO);
    let vanishing = normalize_exact(Vec3::new(-0.0, -1e-13, 1e-30));
    assert_eq!(vanishing.to_array().map(f32::to_bits), [0; 3]);
    assert_eq!(length3(Vec3::splat(1e-13)).to_bits(), 0);
    assert_eq!(normalize_exact(Vec3::new(0.0, -3e-10, 0.0)), -y);
    assert_eq!(length3(Vec3::new(0.0, 0.0, -power(40))), power(40));
}

/// Every constant of a WGSL file and of the Rust module of its name: the same names, the same bits.
#[test]
fn constants_match_rust() {
    let twins = [
        ("lib/exact", motes::exact::CONSTANTS),
        ("lib/transcendental", motes::transcendental::CONSTANTS),
        ("lib/rng", motes::rng::CONSTANTS),
    ];
    for (file, in_rust) in twins {
        let in_wgsl = motes::gpu::shader::constants(file).expect("a library that composes");
        let mut in_wgsl: Vec<_> = in_wgsl.iter().map(|c| (c.name.as_str(), c.bits)).collect();
        // What a file imports from exact comes with it.
        let exact = motes::exact::CONSTANTS;
        in_wgsl.retain(|constant| file == "lib/exact" || exact.iter().all(|e| e != constant));
        let mut in_rust = in_rust.to_vec();
        in_wgsl.sort_unstable();
        in_rust.sort_unstable();
        assert_eq!(in_wgsl, in_rust, "{file}");
    }
}
