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
        if let Some((_, title)) = tag.split_once(" title=\"") {
            titles.push(title.split('"').next().unwrap_or_default().to_owned());
        }
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
    let files = ["a.json", "b.json", "c<d>.json"].map(str::to_owned);
    let page = html(&records, &files);
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
    for file in ["a.json", "b.json", "c&lt;d&gt;.json"] {
        assert!(page.contains(&format!(">{file}</div>")), "{file}");
    }
}

/// What makes numbers doubtful stands before them, not folded away.
#[test]
fn warnings_come_first_and_in_full() {
    let mut records = records();
    records[0]
        .warnings
        .push("built without optimisation".into());
    records[1].runs[2]
        .warnings
        .push("births were dropped".into());
    let page = html(&records, &[]);
    let place = |words: &str| page.find(words).unwrap_or_else(|| panic!("{words}"));
    let charts = place("From few particles to many");
    assert!(place("<b>llvmpipe</b>: built without optimisation") < charts);
    assert!(place("<b>SwiftShader, million at 1 M</b>: births were dropped") < charts);
}

fn three_digits(ms: f64) -> String {
    let decimals = (2 - ms.log10().floor() as i32).clamp(0, 4) as usize;
    format!("{ms:.decimals$} ms")
}

/// Pieces of a frame are as long, and called, as the table has them: shares of the frame's median.
#[test]
fn pieces_of_a_bar_are_the_shares_of_the_table() {
    let mut record = LLVMPIPE.record(&[1_000_000]);
    // Medians of passes need not add up to that of the frame.
    for ms in &mut record.runs[0].frame_ms.samples {
        *ms *= 1.4;
    }
    let samples = record.runs[0].frame_ms.samples.clone();
    record.runs[0].frame_ms = motes::bench::Spread::new(samples, record.runs[0].frame_ms.clock);
    let frame = record.runs[0].frame_ms.median;
    let page = html(std::slice::from_ref(&record), &[]);
    let table = motes::bench::table(&record);
    for pass in &record.runs[0].passes {
        let expected = pass.ms.median / frame * 100.0;
        let told = format!("{expected:.1} %");
        let line = table.lines().find(|line| line.contains(&pass.name));
        assert!(line.expect("a line").ends_with(&told), "{line:?}: {told}");
        let at = page
            .find(&format!("title=\"{}: ", pass.name))
            .expect("it is there");
        let tag = &page[page[..at].rfind("<i ").expect("it is a bar's")..];
        let tag = &tag[..tag.find('>').expect("it ends")];
        assert!(tag.contains(&format!(", {told} of the frame")), "{tag}");
        let width = tag
            .split("width:")
            .nth(1)
            .and_then(|it| it.split('%').next());
        let width: f64 = width.and_then(|it| it.parse().ok()).expect("a number");
        assert!((width - expected).abs() < 1e-3, "{tag}: {expected}");
    }
}

/// Names of lines stand at their ends: as high as the line, in its own picture.
#[test]
fn the_floor_is_named_where_it_ends() {
    let record = LLVMPIPE.record(&[10_000, 1_000_000]);
    let page = html(std::slice::from_ref(&record), &[]);
    let end = page.find(">floor</text>").expect("it has a name");
    let text = &page[page[..end].rfind("<text").expect("its tag")..end];
    let number = |tag: &str, key: &str| -> f64 {
        let value = tag.split(&format!(" {key}=\"")).nth(1);
        let value = value.and_then(|it| it.split('"').next());
        value.and_then(|it| it.parse().ok()).expect("a number")
    };
    let dots: Vec<&str> = page[..end]
        .match_indices("<circle")
        .map(|(at, _)| &page[at..at + page[at..].find("</circle>").expect("it ends")])
        .collect();
    let mut floors = dots.iter().filter(|dot| dot.contains(": floor "));
    let last = floors.next_back().expect("it has a point");
    assert!(last.contains("1,000,000"), "{last}");
    assert!(
        (number(text, "y") - number(last, "cy")).abs() < 40.0,
        "{text} {last}"
    );
    assert!(number(text, "x") > number(last, "cx"), "{text} {last}");
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
        let page = html(&records, &[]);
        read(&page).unwrap_or_else(|fault| panic!("{fault}"));
        assert!(!page.contains("NaN") && !page.contains("inf"), "{page}");
    }
}
