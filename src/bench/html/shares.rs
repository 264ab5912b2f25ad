//! Which pass has how much of a frame, a bar a count.

use super::super::record::{Measure, Run};
use super::super::units::{digits, percent};
use super::Labelled;
use super::svg::{escaped, figure, pass_color, picture, tick};

const WIDTH: f64 = 1120.0;
const LEFT: f64 = 150.0;
const RIGHT: f64 = 1020.0;
const BAR: f64 = 30.0;
const STEP: f64 = 42.0;

/// A pass that has less of every frame is shown among the rest.
const LEAST_SHARE: f64 = 0.02;

/// Passes with a colour of their own, in order of their colours; the others are the rest. They go by their
/// last names, for one backend says `draw/splat` and another `splat`.
pub(super) struct Colors<'a>(Vec<&'a str>);

impl<'a> Colors<'a> {
    /// One for each of the ten passes that have most of any frame.
    pub(super) fn new(records: &[Labelled<'a>]) -> Self {
        let mut passes: Vec<(&str, f64)> = Vec::new();
        for run in records.iter().flat_map(|it| &it.record.runs) {
            for pass in &run.passes {
                let share = share(pass, run);
                match passes
                    .iter_mut()
                    .find(|(name, _)| *name == last(&pass.name))
                {
                    Some((_, most)) => *most = most.max(share),
                    None => passes.push((last(&pass.name), share)),
                }
            }
        }
        let mut shares: Vec<f64> = passes.iter().map(|pass| pass.1).collect();
        shares.sort_by(|a, b| b.total_cmp(a));
        let least = shares.get(9).copied().unwrap_or(0.0).max(LEAST_SHARE);
        let large = passes.into_iter().filter(|(_, share)| *share >= least);
        Self(large.map(|(name, _)| name).take(10).collect())
    }

    fn of(&self, pass: &str) -> String {
        let at = self.0.iter().position(|name| *name == last(pass));
        at.map_or("var(--rest)".to_owned(), pass_color)
    }
}

/// A pass's name without its folder.
fn last(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or_default()
}

fn share(pass: &Measure, run: &Run) -> f64 {
    pass.ms.median / all_ms(run)
}

/// Medians of all passes together: what the bar holds.
fn all_ms(run: &Run) -> f64 {
    run.passes
        .iter()
        .map(|pass| pass.ms.median)
        .sum::<f64>()
        .max(1e-12)
}

/// A chart of one record's runs of all scenes.
pub(super) fn chart(labelled: &Labelled, colors: &Colors) -> String {
    let runs: Vec<&Run> = labelled
        .record
        .runs
        .iter()
        .filter(|run| !run.passes.is_empty())
        .collect();
    if runs.is_empty() {
        return String::new();
    }
    let mut svg = String::new();
    let mut y = 4.0;
    let mut scene = "";
    for run in runs {
        if run.scene != scene {
            scene = &run.scene;
            svg += &format!(
                "<text class=\"name strong\" x=\"0\" y=\"{:.1}\">{}</text>",
                y + 14.0,
                escaped(scene)
            );
            y += 24.0;
        }
        svg += &bar(run, y, colors);
        y += STEP;
    }
    let mut legend = String::new();
    let passes = || labelled.record.runs.iter().flat_map(|run| &run.passes);
    let is_here = |name: &str| passes().any(|pass| last(&pass.name) == name);
    let colored = colors.0.iter().enumerate();
    for (at, name) in colored.filter(|(_, name)| is_here(name)) {
        legend += &item(&pass_color(at), name);
    }
    legend += &item("var(--rest)", "the rest");
    let title = format!("{}: share of a frame", labelled.label);
    let words = "Each bar is a frame, each piece the median of a pass, in the order in which they run; point at one for \
                 its numbers.";
    let inside = picture(WIDTH, y, &title, &svg) + "<ul class=\"legend\">" + &legend + "</ul>\n";
    figure(&title, words, &inside)
}

fn item(color: &str, name: &str) -> String {
    format!(
        "<li><i style=\"background:{color}\"></i>{}</li>",
        escaped(name)
    )
}

fn bar(run: &Run, y: f64, colors: &Colors) -> String {
    let middle = y + BAR / 2.0 + 4.5;
    let count = tick(run.particles as f64);
    let mut svg = format!(
        "<text class=\"name\" x=\"{:.1}\" y=\"{middle:.1}\" text-anchor=\"end\">{count}</text>",
        LEFT - 12.0
    );
    let mut x = LEFT;
    for pass in &run.passes {
        let share = share(pass, run);
        let width = share * (RIGHT - LEFT);
        let gb = pass
            .gb_per_s
            .map_or(String::new(), |rate| format!(", {} GB/s", digits(rate)));
        let copy = pass.share_of_copy.map_or(String::new(), |share| {
            format!(", {} of the copy", percent(share))
        });
        let words = format!(
            "{}: {} ms ({} .. {}), {} of the frame{gb}{copy}",
            pass.name,
            digits(pass.ms.median),
            digits(pass.ms.p10),
            digits(pass.ms.p90),
            percent(share)
        );
        // A hair of the ground between two pieces.
        let shown = (width - 1.0).max(0.3);
        svg += &format!(
            "<rect x=\"{x:.2}\" y=\"{y:.1}\" width=\"{shown:.2}\" height=\"{BAR}\" rx=\"2\" fill=\"{}\"><title>{}</title></rect>",
            colors.of(&pass.name),
            escaped(&words)
        );
        let name = last(&pass.name);
        let label = format!("{name} {:.0} %", share * 100.0);
        if label.chars().count() as f64 * 7.0 + 10.0 < width {
            svg += &format!(
                "<text class=\"on\" x=\"{:.1}\" y=\"{middle:.1}\" text-anchor=\"middle\" pointer-events=\"none\">{}</text>",
                x + width / 2.0,
                escaped(&label)
            );
        }
        x += width;
    }
    let frame = digits(run.frame_ms.median);
    svg + &format!(
        "<text class=\"name\" x=\"{:.1}\" y=\"{middle:.1}\">{frame} ms</text>",
        RIGHT + 12.0
    )
}
