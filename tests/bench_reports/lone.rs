//! Machines that do not keep their pace, and one record a side: what that tells, and what it says that it
//! cannot tell.

use motes::bench::{Kind, Record, Spread, Verdict};

use crate::compare::{one, records, slowed};
use crate::synthetic::{LLVMPIPE, Model};

/// One run a side cannot show five percent, and does not say that it does; a third it can.
#[test]
fn lone_records_tell_what_is_large_and_say_what_they_cannot() {
    let lone = |factor| one(&records(LLVMPIPE, 1..2), &records(slowed(factor), 2..3));
    let comparison = lone(1.05);
    assert!(comparison.slowed_most().is_none());
    let text = comparison.text(None);
    let first = text.find("one record a side").expect("it is said");
    assert!(first < text.find("million at").expect("a table"), "{text}");
    assert!(text.contains("cannot tell (within 1"), "{text}");
    assert!(text.contains("hardly one is called slower"), "{text}");
    let comparison = lone(1.33);
    let most = comparison.slowed_most().expect("something slowed");
    assert_eq!(most.name, "particles/advance");
    let change = most.change.expect("there are samples");
    assert!(change.low > 1.15 && change.low < 1.25, "{change:?}");
}

/// Times of a machine that goes at two paces, 1.6 apart, the slower from some frame on.
fn two_paced(seed: u64, slow_from: usize) -> Vec<Record> {
    let mut records = records(LLVMPIPE, seed..seed + 1);
    for run in &mut records[0].runs {
        let slow = |ms: &mut Spread| {
            let times = ms.samples.iter().enumerate();
            let times = times.map(|(at, ms)| if at >= slow_from { ms * 1.6 } else { *ms });
            *ms = Spread::new(times.collect(), ms.clock);
        };
        run.passes.iter_mut().for_each(|pass| slow(&mut pass.ms));
        let whole = [&mut run.frame_ms, &mut run.step_ms, &mut run.draw_ms];
        whole.into_iter().for_each(slow);
    }
    records
}

#[test]
fn a_machine_of_two_paces_deceives_nobody() {
    // 61 frames: the medians are of different groups.
    let (old, new) = (two_paced(1, 45), two_paced(2, 15));
    let comparison = one(&old, &new);
    let told = comparison
        .compared
        .iter()
        .filter(|it| it.kind != Kind::Micro);
    for compared in told {
        assert_eq!(compared.verdict(), Verdict::Unclear, "{}", compared.words());
        let change = compared.change.expect("there are samples");
        assert!(change.low < 1.0 && change.high > 1.6, "{change:?}");
    }
    let text = comparison.text(Some(5.0));
    let warned = text.find("fall into two groups").expect("it is said");
    assert!(warned < text.find("million at").expect("a table"), "{text}");
    assert!(text.contains("4 of 4 runs"), "{text}");
}

/// The copy beside the frames tells that the machine was another.
#[test]
fn what_the_copy_shows_is_allowed_for() {
    let old = records(LLVMPIPE, 1..2);
    let slower = |factor: f64| {
        let mut new = records(slowed(1.4), 2..3);
        for run in &mut new[0].runs {
            run.copy_kernel_gb_per_s = Some(8.72 / factor);
        }
        let comparison = one(&old, &new);
        let mut all = comparison.compared.iter().rev();
        let advance = all.find(|it| it.name == "particles/advance");
        advance.expect("it was compared").verdict()
    };
    assert_eq!(slower(1.0), Verdict::Slower);
    assert_eq!(slower(1.5), Verdict::Unclear);
}

/// Runs that differ by a quarter as wholes hide a pass that slowed by a half, but not beside the others.
#[test]
fn a_slowed_pass_stands_out_from_the_rest_of_its_frames() {
    let drifting = |model, seeds| {
        let model = Model {
            drift: 0.25,
            ..model
        };
        records(model, seeds)
    };
    let old = drifting(LLVMPIPE, 1..6);
    let comparison = one(&old, &drifting(slowed(1.5), 11..16));
    let most = comparison.slowed_most().expect("it is found");
    assert_eq!(
        (most.name.as_str(), most.kind),
        ("particles/advance", Kind::Pass)
    );
    assert_eq!(most.verdict(), Verdict::Unclear, "{}", most.words());
    let rest = most.against_rest.expect("there are others");
    assert!(
        (rest.ratio - 1.5).abs() < 0.1 && rest.low > 1.05,
        "{rest:?}"
    );
    assert!(most.words().starts_with("slower against other passes by"));
    let failing = comparison.slower_by(5.0);
    assert!(
        failing.iter().all(|it| it.name == "particles/advance"),
        "{failing:?}"
    );
    for seed in 0..6 {
        let new = drifting(LLVMPIPE, 100 + 5 * seed..105 + 5 * seed);
        let comparison = one(&old, &new);
        let failing = comparison.slower_by(5.0);
        assert!(failing.is_empty(), "{failing:?}");
    }
}
