//! Horizontal bars: kernels alone, and scenes measured at one count.

use super::super::record::Measure;
use super::super::spread::Spread;
use super::super::units::{digits, grouped, percent, prefixed, shortened};
use super::Labelled;
use super::svg::{Scale, color, escaped, figure, picture, tick};

const WIDTH: f64 = 1120.0;
const LEFT: f64 = 250.0;
const RIGHT: f64 = 900.0;
const BAR: f64 = 18.0;
const GAP: f64 = 14.0;

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
            .filter(|_| measure.share_of_copy.is_none())?;
        Some((
            1e9 / rate,
            Goes::WithTime,
            format!("{} ns an item, {}/s", digits(1e9 / rate), prefixed(rate)),
        ))
    });
    let mut html = chart(
        "Kernels alone, as a share of the copy",
        "Bytes that a kernel must move, by the time it takes, over the same of the fastest copy by a kernel on the same \
         adapter. Thin lines go from p10 to p90.",
        &moving,
        Some((1.0, "the copy")),
        &|share| format!("{:.0} %", share * 100.0),
    );
    html += &chart(
        "Kernels alone, time an item",
        "Kernels that are about computing: nanoseconds for each of their items, all lanes together. Thin lines go from p10 to p90.",
        &working,
        None,
        &|ns| format!("{} ns", tick(ns)),
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
        "Median of step and drawing; a thin line goes from p10 to p90. The mark across a bar is its floor: the bytes that the passes must move, at the rate \
         of the adapter's own copy.",
        &rows,
        None,
        &|ms| format!("{} ms", tick(ms)),
    )
}

/// A value, how it goes, and what is written beside it.
type Told = (f64, Goes, String);

/// A row a kernel, of what `of` makes of it: a value that goes with the time, or against it.
fn rows(records: &[Labelled], of: &dyn Fn(&Measure) -> Option<Told>) -> Vec<Row> {
    let mut rows = Vec::new();
    for (at, Labelled { label, record }) in records.iter().enumerate() {
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

fn chart(
    title: &str,
    words: &str,
    rows: &[Row],
    reference: Option<(f64, &str)>,
    told: &dyn Fn(f64) -> String,
) -> String {
    let bars = rows.iter().flat_map(|row| &row.bars);
    let values = bars.flat_map(|bar| [Some(bar.value), bar.mark]).flatten();
    let most = values.chain(reference.map(|it| it.0)).fold(0.0, f64::max);
    if rows.is_empty() || !most.is_finite() {
        return String::new();
    }
    let x = Scale::linear(most, [LEFT, RIGHT]);
    let height_of = |row: &Row| row.bars.len() as f64 * (BAR + 2.0) + GAP;
    let bottom = 26.0 + rows.iter().map(height_of).sum::<f64>();
    let mut svg = String::new();
    for value in x.numbers() {
        let px = x.at(value);
        svg += &format!(
            "<line class=\"grid\" x1=\"{px:.1}\" x2=\"{px:.1}\" y1=\"26\" y2=\"{bottom:.1}\"/>\
             <text x=\"{px:.1}\" y=\"16\" text-anchor=\"middle\">{}</text>",
            told(value)
        );
    }
    let mut y = 26.0 + GAP / 2.0;
    for row in rows {
        let middle = y + (height_of(row) - GAP) / 2.0 + 3.5;
        let name = escaped(&shortened(&row.name, 32));
        svg += &format!(
            "<text class=\"name\" x=\"{:.1}\" y=\"{middle:.1}\" text-anchor=\"end\">{name}</text>",
            LEFT - 12.0
        );
        for bar in &row.bars {
            svg += &drawn(bar, y, &x);
            y += BAR + 2.0;
        }
        y += GAP;
    }
    if let Some((value, words)) = reference {
        let px = x.at(value);
        svg += &format!(
            "<line x1=\"{px:.1}\" x2=\"{px:.1}\" y1=\"26\" y2=\"{bottom:.1}\" stroke=\"var(--ink)\" stroke-width=\"1.5\"/>\
             <text class=\"name\" x=\"{px:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{words}</text>",
            bottom + 18.0
        );
    }
    figure(title, words, &picture(WIDTH, bottom + 26.0, title, &svg))
}

fn drawn(bar: &Bar, y: f64, x: &Scale) -> String {
    let middle = y + BAR / 2.0;
    let [low, high] = bar.range.map(|value| x.at(value).min(RIGHT + 4.0));
    let range = format!(
        "<line x1=\"{low:.1}\" x2=\"{high:.1}\" y1=\"{middle:.1}\" y2=\"{middle:.1}\" stroke=\"var(--ink)\" \
         stroke-width=\"1.5\" opacity=\"0.65\"/>"
    );
    let width = (x.at(bar.value) - LEFT).max(1.0);
    let mark = bar.mark.map_or(String::new(), |value| {
        let px = x.at(value);
        let (top, bottom) = (y - 2.0, y + BAR + 2.0);
        format!("<line x1=\"{px:.1}\" x2=\"{px:.1}\" y1=\"{top:.1}\" y2=\"{bottom:.1}\" stroke=\"var(--ink)\" stroke-width=\"2\"/>")
    });
    format!(
        "<rect x=\"{LEFT}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{BAR}\" rx=\"2\" fill=\"{}\"><title>{}</title></rect>\
         {range}{mark}<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
        color(bar.at),
        escaped(&bar.words),
        (LEFT + width).max(high) + 8.0,
        middle + 4.5,
        escaped(&bar.label)
    )
}
