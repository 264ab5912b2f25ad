//! Horizontal bars: kernels alone, and scenes measured at one count.

use super::super::record::Measure;
use super::super::spread::Spread;
use super::super::units::{digits, grouped, percent, prefixed};
use super::Labelled;
use super::svg::{color, escaped, figure, tick};

/// A dispatch alone is no work; the cards tell of it.
const IDLE: &str = "dispatch";

/// One bar.
struct Bar {
    /// Which record.
    at: usize,
    value: f64,
    /// Beside the bar.
    label: String,
    /// When pointed at.
    words: String,
    /// Where the samples lie, as values: most of them between these.
    range: [f64; 2],
    /// A mark across the bar.
    mark: Option<f64>,
}

/// How a value changes with the time it was made from.
enum Goes {
    WithTime,
    AgainstTime,
}

/// A name and a bar for each record that has it.
struct Row {
    name: String,
    bars: Vec<Bar>,
}

/// What kernels alone reach: of the copy where they move bytes, in items where they do not.
pub(super) fn micro(records: &[Labelled]) -> String {
    let moving = rows(records, &|measure| {
        let share = measure.share_of_copy?;
        let rate = measure.gb_per_s.map_or(String::new(), digits);
        Some((
            share,
            Goes::AgainstTime,
            format!("{rate} GB/s, {}", percent(share)),
        ))
    });
    let working = rows(records, &|measure| {
        let rate = measure
            .items_per_s()
            .filter(|_| measure.share_of_copy.is_none() && measure.name != IDLE)?;
        Some((
            1e9 / rate,
            Goes::WithTime,
            format!("{} ns an item, {}/s", digits(1e9 / rate), prefixed(rate)),
        ))
    });
    let mut html = chart(
        "Kernels alone, as a share of the copy",
        "What the adapter's own copy of as many bytes takes, over what the kernel takes. The upright line is the copy; thin \
         lines go from p10 to p90.",
        &moving,
        Some(1.0),
    );
    html += &chart(
        "Kernels alone, time an item",
        "Kernels that are about computing: nanoseconds for each of their items, all lanes together. Thin lines go from p10 to p90.",
        &working,
        None,
    );
    html
}

/// Scenes without several counts: time a frame, and its floor.
pub(super) fn scenes(records: &[Labelled], in_curves: &[&str]) -> String {
    let mut rows: Vec<Row> = Vec::new();
    for (at, labelled) in records.iter().enumerate() {
        for run in &labelled.record.runs {
            if in_curves.contains(&run.scene.as_str()) {
                continue;
            }
            let name = format!("{} at {}", run.scene, tick(run.particles as f64));
            let ms = &run.frame_ms;
            let words = format!(
                "{}, {} at {} particles: {} ms a frame ({} .. {})",
                labelled.label,
                run.scene,
                grouped(run.particles),
                digits(ms.median),
                digits(ms.p10),
                digits(ms.p90)
            );
            let bar = Bar {
                at,
                value: ms.median,
                label: digits(ms.median) + " ms",
                words,
                range: [ms.p10, ms.p90],
                mark: run.floor_ms(labelled.record),
            };
            push(&mut rows, name, bar);
        }
    }
    chart(
        "Scenes at one count, time a frame",
        "Median of step and drawing; a thin line goes from p10 to p90. The mark across a bar is its floor: what the \
         adapter's own copies of the passes' bytes take.",
        &rows,
        None,
    )
}

/// A value, how it goes, and what is written beside it.
type Told = (f64, Goes, String);

/// A row a kernel, of what `of` makes of it: a value that goes with the time, or against it.
fn rows(records: &[Labelled], of: &dyn Fn(&Measure) -> Option<Told>) -> Vec<Row> {
    let mut rows = Vec::new();
    for (at, Labelled { label, record, .. }) in records.iter().enumerate() {
        for measure in &record.micro {
            let Some((value, goes, text)) = of(measure) else {
                continue;
            };
            let Spread {
                median, p10, p90, ..
            } = measure.ms;
            let range = match goes {
                Goes::WithTime => [p10, p90].map(|ms| value * ms / median),
                Goes::AgainstTime => [p90, p10].map(|ms| value * median / ms.max(1e-9)),
            };
            let note = measure
                .note
                .as_ref()
                .map_or(String::new(), |note| format!(" ({note})"));
            let words = format!(
                "{label}, {}{note}: {} ms ({} .. {}) for {} items",
                measure.name,
                digits(measure.ms.median),
                digits(measure.ms.p10),
                digits(measure.ms.p90),
                grouped(measure.items)
            );
            let bar = Bar {
                at,
                value,
                label: text,
                words,
                range,
                mark: None,
            };
            push(&mut rows, measure.name.clone(), bar);
        }
    }
    rows
}

fn push(rows: &mut Vec<Row>, name: String, bar: Bar) {
    match rows.iter_mut().find(|row| row.name == name) {
        Some(row) => row.bars.push(bar),
        None => rows.push(Row {
            name,
            bars: vec![bar],
        }),
    }
}

fn chart(title: &str, words: &str, rows: &[Row], reference: Option<f64>) -> String {
    let bars = rows.iter().flat_map(|row| &row.bars);
    let values = bars.flat_map(|bar| [Some(bar.value), bar.mark]).flatten();
    let most = values.chain(reference).fold(0.0, f64::max);
    if rows.is_empty() || !most.is_finite() || most <= 0.0 {
        return String::new();
    }
    let mut html = String::from("<div class=\"rows bars\">\n");
    for row in rows {
        for (at, bar) in row.bars.iter().enumerate() {
            // Of several bars the first has the name.
            let name = if at == 0 { row.name.as_str() } else { "" };
            html += &drawn(name, bar, most, reference);
        }
    }
    figure(title, words, &(html + "</div>\n"))
}

fn drawn(name: &str, bar: &Bar, most: f64, reference: Option<f64>) -> String {
    let part = |value: f64| (value / most * 100.0).clamp(0.0, 100.0);
    let [low, high] = bar.range.map(part);
    let line = |value: f64, class: &str| {
        let left = part(value);
        format!("<s class=\"{class}\" style=\"left:{left:.2}%\"></s>")
    };
    let marks = [(reference, "copy"), (bar.mark, "floor")];
    let marks: String = marks
        .into_iter()
        .filter_map(|(value, class)| Some(line(value?, class)))
        .collect();
    format!(
        "<div class=\"row\"><span class=\"name\">{}</span><span class=\"value\">{}</span>\
         <div class=\"track\" title=\"{}\"><i style=\"width:{:.2}%;background:{}\"></i>\
         <u style=\"left:{low:.2}%;width:{:.2}%\"></u>{marks}</div></div>\n",
        escaped(name),
        escaped(&bar.label),
        escaped(&bar.words),
        part(bar.value),
        color(bar.at),
        (high - low).max(0.0)
    )
}
