//! Comparisons tell what is so, and no more.

use motes::bench::{Comparison, Kind, Record, Verdict, compare};

use crate::synthetic::{LLVMPIPE, Model};

const COUNTS: [u64; 2] = [10_000, 1_000_000];

/// Records of this model, each by itself.
pub(crate) fn records(model: Model, seeds: impl Iterator<Item = u64>) -> Vec<Record> {
    seeds
        .map(|seed| Model { seed, ..model }.record(&COUNTS))
        .collect()
}

pub(crate) fn one(old: &[Record], new: &[Record]) -> Comparison {
    let mut comparisons = compare(old, new, false).expect("they are of one adapter");
    assert_eq!(comparisons.len(), 1);
    comparisons.remove(0)
}

pub(crate) fn slowed(factor: f64) -> Model {
    Model {
        slower: Some(("particles/advance", factor)),
        ..LLVMPIPE
    }
}

/// Six runs a side, no two quite alike.
#[test]
fn five_percent_are_found_and_named() {
    let model = |model| Model {
        drift: 0.004,
        ..model
    };
    let comparison = one(
        &records(model(LLVMPIPE), 1..7),
        &records(model(slowed(1.05)), 11..17),
    );
    let most = comparison.slowed_most().expect("something slowed");
    assert_eq!(
        (most.name.as_str(), most.kind),
        ("particles/advance", Kind::Pass)
    );
    let at_million = comparison.compared.iter().find(|it| {
        it.name == "particles/advance" && it.run.as_ref().is_some_and(|run| run.1 == 1_000_000)
    });
    let at_million = at_million.expect("it was compared");
    let change = at_million.change.expect("there are samples");
    assert_eq!(at_million.verdict(), Verdict::Slower);
    assert!((change.ratio - 1.05).abs() < 0.015, "{change:?}");
    assert!(change.low < 1.05 && 1.05 < change.high, "{change:?}");
    assert!(change.high - change.low < 0.08, "{change:?}");
    let words = at_million.words();
    assert!(words.starts_with("slower by "), "{words}");
}

/// Both directions, and the middle, at several sizes of difference: the interval holds the truth.
#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    for factor in [0.8, 1.0, 1.05] {
        let mut held = 0;
        let mut all = 0;
        for trial in 0..15 {
            let old = records(LLVMPIPE, 100 + trial..101 + trial);
            let new = records(slowed(factor), 300 + trial..301 + trial);
            let comparison = one(&old, &new);
            for compared in comparison
                .compared
                .iter()
                .filter(|it| it.kind == Kind::Pass)
            {
                let truth = if compared.name == "particles/advance" {
                    factor
                } else {
                    1.0
                };
                let change = compared.change.expect("there are samples");
                held += u32::from(change.low <= truth && truth <= change.high);
                all += 1;
            }
        }
        let share = f64::from(held) / f64::from(all);
        assert!(
            share > 0.96,
            "at {factor}, {held} of {all} intervals hold the truth"
        );
    }
}

/// Shares of trials in which the pass is called slower or faster though nothing changed.
fn false_alarms(model: Model, records_a_side: u64, trials: u64) -> usize {
    let is_alarm = |trial: u64| {
        let first = trial * 2 * records_a_side + 1000;
        let new = first + records_a_side;
        // The one pass that is looked at; the rest would take time.
        let less = |seeds: std::ops::Range<u64>| {
            let mut records = records(model, seeds);
            for record in &mut records {
                record.micro.clear();
                record.runs.truncate(1);
                record.runs[0]
                    .passes
                    .retain(|pass| pass.name == "particles/advance");
            }
            records
        };
        let comparison = one(&less(first..new), &less(new..new + records_a_side));
        let advance = comparison
            .compared
            .iter()
            .find(|it| it.name == "particles/advance");
        let verdict = advance.expect("it was compared").verdict();
        matches!(verdict, Verdict::Slower | Verdict::Faster)
    };
    (0..trials).filter(|&trial| is_alarm(trial)).count()
}

/// One in a hundred is expected; seven in two hundred, or five in one hundred, would be a chance of one in two hundred.
#[test]
fn equal_builds_are_seldom_told_apart() {
    let alarms = false_alarms(LLVMPIPE, 1, 200);
    assert!(alarms <= 6, "{alarms} of 200 one by one");
    // Records that differ as wholes by more than their samples do: only several a side can show it.
    let drifting = Model {
        drift: 0.03,
        frames: 31,
        ..LLVMPIPE
    };
    for records_a_side in [3, 5] {
        let alarms = false_alarms(drifting, records_a_side, 100);
        assert!(
            alarms <= 4,
            "{alarms} of 100 with {records_a_side} records a side"
        );
    }
    // One record a side does not show the drift, which is allowed for.
    let deceived = false_alarms(drifting, 1, 100);
    assert!(deceived <= 4, "{deceived} of 100 one by one");
}

#[test]
fn several_records_find_what_drift_hides() {
    let drifting = |model| Model {
        drift: 0.01,
        ..model
    };
    let comparison = one(
        &records(drifting(LLVMPIPE), 10..16),
        &records(drifting(slowed(1.10)), 20..26),
    );
    let most = comparison.slowed_most().expect("something slowed");
    assert_eq!(most.name, "particles/advance");
    let change = most.change.expect("there are samples");
    assert!(
        change.low > 1.02 && (change.ratio - 1.10).abs() < 0.03,
        "{change:?}"
    );
    assert!(
        comparison
            .text(None)
            .contains("6 records before, 6 records now, in pairs")
    );
}

#[test]
fn outliers_sway_nothing() {
    let disturbed = Model {
        delayed: 0.15,
        ..LLVMPIPE
    };
    let comparison = one(&records(LLVMPIPE, 1..2), &records(disturbed, 2..3));
    for compared in &comparison.compared {
        if compared.kind == Kind::Pass {
            assert!(
                compared.change.expect("there are samples").ratio < 1.02,
                "{}",
                compared.words()
            );
        }
    }
    let slower = Model {
        delayed: 0.15,
        ..slowed(1.18)
    };
    let comparison = one(&records(disturbed, 3..4), &records(slower, 4..5));
    assert_eq!(
        comparison.slowed_most().map(|it| it.name.as_str()),
        Some("particles/advance")
    );
}

/// What is too small to matter slows down and fails nothing.
#[test]
fn small_passes_fail_nothing() {
    let model = Model {
        slower: Some(("particles/births", 3.0)),
        ..LLVMPIPE
    };
    let comparison = one(&records(LLVMPIPE, 1..2), &records(model, 2..3));
    let births = comparison
        .compared
        .iter()
        .find(|it| it.name == "particles/births");
    let births = births.expect("it was compared");
    assert_eq!(
        (births.verdict(), births.matters()),
        (Verdict::Slower, false)
    );
    assert!(comparison.slower_by(50.0).is_empty());
    assert!(comparison.text(Some(50.0)).contains("but small"));
    // Its size is all that saves it.
    let resolve = Model {
        slower: Some(("draw/resolve", 3.0)),
        ..LLVMPIPE
    };
    let comparison = one(&records(LLVMPIPE, 1..2), &records(resolve, 2..3));
    let slower: Vec<&str> = comparison
        .slower_by(50.0)
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    assert!(slower.contains(&"draw/resolve"), "{slower:?}");
}

/// The order in which a pass stands, and what else is compared, change no answer.
#[test]
fn answers_do_not_depend_on_company() {
    let (old, new) = (records(LLVMPIPE, 1..4), records(slowed(1.05), 4..7));
    let whole = one(&old, &new);
    let mut less = old.clone();
    for record in &mut less {
        record.micro.clear();
        record.runs.remove(0);
        record.runs[0].passes.reverse();
    }
    let part = one(&less, &new);
    for compared in &part.compared {
        let same =
            |it: &&motes::bench::Compared| it.run == compared.run && it.name == compared.name;
        let other = whole.compared.iter().find(same).expect("it was compared");
        assert_eq!(compared.change, other.change, "{}", compared.name);
    }
    assert!(
        part.only_new.iter().any(|it| it == "copy_kernel alone"),
        "{:?}",
        part.only_new
    );
    assert!(
        part.only_new
            .iter()
            .any(|it| it == "draw/splat of million at 10,000 particles")
    );
}

#[test]
fn what_else_changed_is_said() {
    let old = records(LLVMPIPE, 1..2);
    let mut new = records(LLVMPIPE, 2..3);
    new[0].cpu = "Another".into();
    new[0].copy_kernel_gb_per_s = Some(8.72 * 0.9);
    new[0].runs[1].image_px = Some([640, 360]);
    new[0].runs[1].live = Some(400_000);
    new[0].runs[0].passes.remove(1);
    let comparison = one(&old, &new);
    let said = comparison.warnings.join("\n");
    for words in [
        "the processor differs",
        "10.0 % slower now",
        "size of million's picture",
        "live particles of million",
        "one record a side",
    ] {
        assert!(said.contains(words), "{words} is not in\n{said}");
    }
    assert_eq!(
        comparison.only_old,
        ["particles/emit of million at 10,000 particles"]
    );
}

#[test]
fn only_like_is_compared_with_like() {
    let llvmpipe = records(LLVMPIPE, 1..2);
    let cpu = records(
        Model {
            adapter: "cpu",
            ..LLVMPIPE
        },
        1..2,
    );
    let error = compare(&llvmpipe, &cpu, false).expect_err("they differ");
    assert!(error.to_string().contains("--any-adapter"), "{error}");
    assert_eq!(compare(&llvmpipe, &cpu, true).map(|all| all.len()), Ok(1));
    let both = [llvmpipe.clone(), cpu.clone()].concat();
    assert_eq!(compare(&both, &both, false).map(|all| all.len()), Ok(2));
    assert!(compare(&both, &llvmpipe, true).is_err());
    // Motes is the processor's driver; a newer one is what is to be judged.
    let mut newer = cpu.clone();
    newer[0].driver = "motes 0.2.0".into();
    assert!(compare(&cpu, &newer, false).is_ok());
    let mut elsewhere = llvmpipe.clone();
    elsewhere[0].micro.clear();
    for run in &mut elsewhere[0].runs {
        run.scene = "fountain".into();
    }
    assert!(compare(&llvmpipe, &elsewhere, false).is_err());
}

/// A record of another's making has medians only: told, not judged.
#[test]
fn medians_alone_are_not_judged() {
    let mut old = records(LLVMPIPE, 1..2);
    for run in &mut old[0].runs {
        for pass in &mut run.passes {
            pass.ms.samples.clear();
        }
    }
    let comparison = one(&old, &records(slowed(2.0), 2..3));
    let judged =
        |it: &&motes::bench::Compared| it.kind == Kind::Pass && it.verdict() != Verdict::Unclear;
    assert!(comparison.compared.iter().find(judged).is_none());
    assert!(comparison.text(Some(1.0)).contains("too few samples"));
}
