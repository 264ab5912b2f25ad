//! The page: well-formed, by itself, complete.

use motes::bench::{Record, Run, html};

use crate::synthetic::{LLVMPIPE, Model};

/// Three adapters, a scene at several counts, others at one.
fn records() -> Vec<Record> {
    let models = [
        (LLVMPIPE, 8.72),
        (
            Model {
                adapter: "SwiftShader Device (Subzero)",
                seed: 2,
                noise: 0.06,
                ..LLVMPIPE
            },
            4.1,
        ),
        (
            Model {
                adapter: "cpu",
                seed: 3,
                ..LLVMPIPE
            },
            11.5,
        ),
    ];
    let record = |(model, copy_gb_per_s): (Model, f64)| {
        let mut record = Model {
            copy_gb_per_s,
            ..model
        }
        .record(&[10_000, 100_000, 1_000_000, 10_000_000]);
        for (scene, of) in [("bench-discs", 1), ("fountain", 0)] {
            let run = record.runs[of].clone();
            record.runs.push(Run {
                scene: scene.into(),
                ..run
            });
        }
        let ms: Vec<f64> = record.micro[0]
            .ms
            .samples
            .iter()
            .map(|ms| ms * 0.8)
            .collect();
        record.micro.push(motes::bench::Measure::new(
            "noise_gradient",
            ms,
            record.micro[0].ms.clock,
            1_000_000,
            0,
            None,
        ));
        record
    };
    models.into_iter().map(record).collect()
}

/// What is wrong with the page as XML but for its first line; and the text of its titles.
fn read(page: &str) -> Result<Vec<String>, String> {
    let mut rest = page
        .strip_prefix("<!DOCTYPE html>\n")
        .ok_or("no document type")?;
    let mut open: Vec<&str> = Vec::new();
    let mut titles = Vec::new();
    while let Some(start) = rest.find('<') {
        let text = &rest[..start];
        let is_style = open.last() == Some(&"style");
        let entities = ["&amp;", "&lt;", "&gt;", "&quot;"];
        for (at, _) in text.match_indices('&') {
            if !is_style && !entities.iter().any(|entity| text[at..].starts_with(entity)) {
                return Err(format!("a bare & in {text}"));
            }
        }
        if text.contains('>') && !is_style {
            return Err(format!("a bare > in {text}"));
        }
        if open.last() == Some(&"title") {
            titles.push(text.to_owned());
        }
        let end = rest[start..].find('>').ok_or("a tag without an end")? + start;
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if tag.matches('"').count() % 2 == 1 {
            return Err(format!("an odd quote in <{tag}>"));
        }
        match tag.strip_prefix('/') {
            Some(name) if open.pop() != Some(name) => {
                return Err(format!("</{name}> closes another"));
            }
            None if !tag.ends_with('/') => open.push(tag.split(' ').next().unwrap_or_default()),
            _ => {}
        }
    }
    match open.is_empty() {
        true => Ok(titles),
        false => Err(format!("left open: {open:?}")),
    }
}

/// `KEEP_PAGE=FILE` keeps it to be looked at.
#[test]
fn a_page_is_whole_and_by_itself() {
    let records = records();
    let page = html(&records);
    if let Some(path) = std::env::var_os("KEEP_PAGE") {
        std::fs::write(path, &page).expect("it can be written");
    }
    let titles = read(&page).unwrap_or_else(|fault| panic!("{fault}"));
    for foreign in [
        "http", "<script", "url(", "@import", "NaN", "inf ", "href", "<img",
    ] {
        assert!(!page.contains(foreign), "{foreign} is in the page");
    }
    for record in &records {
        for run in &record.runs {
            for pass in &run.passes {
                let ms = format!("{}: {}", pass.name, three_digits(pass.ms.median));
                assert!(
                    titles.iter().any(|title| title.starts_with(&ms)),
                    "{ms} cannot be pointed at"
                );
            }
        }
        for measure in &record.micro {
            assert!(
                titles
                    .iter()
                    .any(|title| title.contains(&format!(", {}", measure.name))),
                "{}",
                measure.name
            );
        }
    }
    assert!(page.contains("Example 3000 &lt;dual&gt; &amp; &quot;fast&quot;"));
    assert!(page.contains("SwiftShader: share of a frame"));
}

fn three_digits(ms: f64) -> String {
    let decimals = (2 - ms.log10().floor() as i32).clamp(0, 4) as usize;
    format!("{ms:.decimals$} ms")
}

/// Bars of a frame are as long as their passes are: read back from the picture.
#[test]
fn pieces_of_a_bar_are_in_proportion() {
    let record = LLVMPIPE.record(&[1_000_000]);
    let page = html(std::slice::from_ref(&record));
    let all: f64 = record.runs[0]
        .passes
        .iter()
        .map(|pass| pass.ms.median)
        .sum();
    for pass in &record.runs[0].passes {
        let at = page
            .find(&format!("<title>{}: ", pass.name))
            .expect("it is there");
        let tag = &page[page[..at].rfind("<rect").expect("it is a bar's")..at];
        let width = tag
            .split("width=\"")
            .nth(1)
            .and_then(|rest| rest.split('"').next());
        let width: f64 = width
            .and_then(|it| it.parse().ok())
            .expect("it is a number");
        let expected = pass.ms.median / all * 870.0 - 1.0;
        assert!(
            (width - expected.max(0.3)).abs() < 0.02,
            "{}: {width}, not {expected}",
            pass.name
        );
    }
}

#[test]
fn strange_records_make_a_page_too() {
    let mut empty = Record {
        schema: 1,
        adapter: "<b>".into(),
        ..Record::default()
    };
    let mut zeros = LLVMPIPE.record(&[1000]);
    zeros.copy_kernel_gb_per_s = None;
    for pass in &mut zeros.runs[0].passes {
        *pass = motes::bench::Measure {
            name: pass.name.clone(),
            ..Default::default()
        };
    }
    zeros.runs[0].frame_ms = Default::default();
    empty.warnings.push("a & b".into());
    for records in [
        vec![],
        vec![empty.clone()],
        vec![empty, zeros.clone(), zeros],
    ] {
        let page = html(&records);
        read(&page).unwrap_or_else(|fault| panic!("{fault}"));
        assert!(!page.contains("NaN") && !page.contains("inf"), "{page}");
    }
}
