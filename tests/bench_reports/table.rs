//! The table for a terminal.

use motes::bench::{COLUMNS, Measure, Spread, fits, sweep_tables, table};

use crate::synthetic::{LLVMPIPE, Model};

/// Golden text; `UPDATE_GOLDEN=1` writes it anew.
#[test]
fn a_record_reads_as_it_did() {
    let mut record = LLVMPIPE.record(&[10_000, 1_000_000]);
    record.warnings.push("debug build".into());
    record.runs[1]
        .warnings
        .push("995,000 particles live, and 1,000,000 were asked for".into());
    let text = table(&record);
    let golden = "tests/bench_reports/table.txt";
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(golden, &text).expect("the folder can be written");
    }
    let expected = std::fs::read_to_string(golden).expect("the text is there");
    assert_eq!(text, expected, "\n{text}");
}

#[test]
fn nothing_is_wider_than_the_terminal() {
    let mut record = LLVMPIPE.record(&[1, 1_000_000_000_000]);
    record.adapter = "adapter ".repeat(30);
    record.warnings.push("word ".repeat(80));
    record.runs[0].scene = "scene".repeat(40);
    record.runs[0].passes[0].name = "pass".repeat(20);
    record.micro[0].note = Some("note ".repeat(40));
    record.micro[1] = Measure {
        name: "none".into(),
        ..Measure::default()
    };
    for line in table(&record).lines() {
        assert!(line.chars().count() <= COLUMNS, "{line}");
        assert_eq!(line, line.trim_end(), "blanks at the end");
    }
}

/// A scene that was changed in many places has a long name; the rest of its title stands.
#[test]
fn titles_tell_count_and_size_however_long_the_scenes_name_is() {
    let mut record = LLVMPIPE.record(&[10_000, 100_000, 1_000_000]);
    let scene = format!("million with {}", "image.width=640, ".repeat(12));
    for run in &mut record.runs {
        run.scene.clone_from(&scene);
    }
    let text = table(&record);
    for words in [
        "at 1,000,000 particles",
        "frames after",
        "as a line over 3 counts",
    ] {
        let titles = text
            .lines()
            .filter(|line| line.starts_with("million with image"));
        assert!(
            titles.into_iter().any(|line| line.contains(words)),
            "{words}:\n{text}"
        );
    }
}

/// Shares and rates as whoever reads the table would work them out.
#[test]
fn numbers_follow_from_the_record() {
    let record = LLVMPIPE.record(&[1_000_000]);
    let text = table(&record);
    let run = &record.runs[0];
    let advance = run
        .passes
        .iter()
        .find(|pass| pass.name == "particles/advance")
        .expect("it is there");
    let line = text
        .lines()
        .find(|line| line.contains("particles/advance"))
        .expect("it is told");
    let share = advance.ms.median / run.frame_ms.median * 100.0;
    let rate = 64e6 / advance.ms.median * 1e3 / 1e9;
    let of_copy = rate / 8.72 * 100.0;
    for words in [
        format!("{:.2}", rate),
        format!("{of_copy:.1} %"),
        format!("{share:.1} %"),
        "1.00 M".into(),
    ] {
        assert!(line.contains(&words), "{words} is not in\n{line}");
    }
    let bytes: f64 = 1e6 * (0.55 + 1.1 + 0.13 + 64.0 + 40.0);
    let floor = format!("{:.1}  to copy", bytes / 8.72e6);
    assert!(text.contains(&floor), "{floor} is not in\n{text}");
}

/// What a model costs is what its line says: each pass so much to start, and its bytes at its rate.
#[test]
fn a_sweep_is_told_as_the_line_that_made_it() {
    let counts = [1_000, 10_000, 100_000, 1_000_000];
    let model = Model {
        noise: 0.0,
        delayed: 0.0,
        ..LLVMPIPE
    };
    let record = model.record(&counts);
    let runs: Vec<_> = record.runs.iter().collect();
    let all = fits(&runs);
    let of = |name: &str| {
        all.iter()
            .find(|fit| fit.name == name)
            .expect("it is there")
    };
    let advance = of("particles/advance");
    let (start_ms, each_ns) = (0.03, 64.0 / (8.72 * 0.78));
    assert!((advance.a_ms / start_ms - 1.0).abs() < 0.02, "{advance:?}");
    assert!((advance.b_ns / each_ns - 1.0).abs() < 0.02, "{advance:?}");
    assert!(
        advance.strays().expect("there are steps") < 0.02,
        "{advance:?}"
    );
    let frame = of("whole frame");
    assert!((frame.a_ms / 2.061 - 1.0).abs() < 0.02, "{frame:?}");
    // What costs the same whatever lives has no line worth telling.
    assert!(all.iter().all(|fit| fit.name != "particles/births"));

    let text = sweep_tables(&record);
    let line = text.lines().find(|line| line.contains("particles/advance"));
    assert!(line.expect("it is told").contains("9.4"), "{text}");
    let two = model.record(&counts[..2]);
    assert_eq!(sweep_tables(&two), "", "two counts make any line");
}

/// Cost that grows faster than the count shows in its steps, and a line never begins below zero.
#[test]
fn a_sweep_that_is_no_line_shows_it() {
    let mut record = LLVMPIPE.record(&[10_000, 100_000, 1_000_000]);
    for run in &mut record.runs {
        let n = run.particles as f64;
        let ms = 1e-9 * n * n;
        run.frame_ms = Spread::new(vec![ms; 5], run.frame_ms.clock);
    }
    let runs: Vec<_> = record.runs.iter().collect();
    let all = fits(&runs);
    let frame = all.last().expect("the frame");
    assert!(frame.off > 0.5, "{frame:?}");
    assert!(frame.a_ms >= 0.0 && frame.b_ns >= 0.0, "{frame:?}");
    let strays = frame.strays().expect("there are steps");
    assert!(
        (strays - 9.0).abs() < 1e-6,
        "from 110,000 to 1,100,000: {strays}"
    );
}

/// A sample of the wind is an item of the pass that traces flames, on every backend.
#[test]
fn samples_of_the_wind_are_told() {
    for name in ["flames/trace", "trace"] {
        let mut record = LLVMPIPE.record(&[1_000]);
        assert!(!table(&record).contains("samples of the wind"));
        let clock = record.runs[0].frame_ms.clock;
        let traced = Measure::new(name, vec![0.5; 9], clock, 25_000, 0, None);
        record.runs[0].passes.push(traced);
        let told = format!("50.0 M samples of the wind/s in {name}\n");
        let text = table(&record);
        assert!(text.contains(&told), "{text}");
        assert!(text.contains("particles/s"), "{text}");
    }
}
