//! Which pass has how much of a frame, a bar a count.

use super::super::record::{Measure, Run};
use super::super::units::{digits, percent};
use super::Labelled;
use super::svg::{escaped, figure, pass_color, tick};

/// A pass that has less of every frame is shown among the rest.
const LEAST_SHARE: f64 = 0.02;

/// A piece with this share of the frame has room for its name; where the page is narrow, one with the
/// second.
const ROOM: [f64; 2] = [0.11, 0.34];

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

/// As the tables have it.
fn share(pass: &Measure, run: &Run) -> f64 {
    run.share_of_frame(&pass.ms).unwrap_or(0.0)
}

fn all_shares(run: &Run) -> f64 {
    run.passes.iter().map(|pass| share(pass, run)).sum()
}

/// A chart of one record's runs of all scenes.
pub(super) fn chart(labelled: &Labelled, colors: &Colors) -> String {
    let all = labelled.record.runs.iter();
    let mut runs: Vec<&Run> = all.filter(|run| all_shares(run) > 0.0).collect();
    if runs.is_empty() {
        return String::new();
    }
    // Scenes in the order that they came in, counts in theirs.
    let scenes: Vec<&str> = runs.iter().map(|run| run.scene.as_str()).collect();
    let place = |run: &&Run| scenes.iter().position(|scene| *scene == run.scene);
    runs.sort_by_key(|run| (place(run), run.particles));
    // Medians of passes add up to about the median of the frame, not to it.
    let most = runs.iter().map(|run| all_shares(run)).fold(1.0, f64::max);
    let mut html = String::from("<div class=\"rows\">\n");
    let mut scene = "";
    for run in &runs {
        if run.scene != scene {
            scene = &run.scene;
            html += &format!("<h4>{}</h4>\n", escaped(scene));
        }
        html += &bar(run, colors, most);
    }
    html += "</div>\n<ul class=\"legend\">";
    let passes = || runs.iter().flat_map(|run| &run.passes);
    let is_here = |name: &str| passes().any(|pass| last(&pass.name) == name);
    let colored = colors.0.iter().enumerate();
    for (at, name) in colored.filter(|(_, name)| is_here(name)) {
        html += &item(&pass_color(at), name);
    }
    html += &item("var(--rest)", "the rest");
    html += "</ul>\n";
    let title = format!("{}: share of a frame", labelled.label);
    let words = "Each bar is a frame, each piece the median of a pass over that of the frame, in the order in which they \
                 run; point at one for its numbers.";
    figure(&title, words, &html)
}

fn item(color: &str, name: &str) -> String {
    format!(
        "<li><i style=\"background:{color}\"></i>{}</li>",
        escaped(name)
    )
}

fn bar(run: &Run, colors: &Colors, most: f64) -> String {
    let count = tick(run.particles as f64);
    let mut html = format!(
        "<div class=\"row\"><span class=\"name\">{count}</span><span class=\"value\">{} ms</span><div class=\"stack\">",
        digits(run.frame_ms.median)
    );
    for pass in &run.passes {
        let share = share(pass, run);
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
        let label = match ROOM.map(|least| share >= least) {
            [false, _] => String::new(),
            [_, narrow] => format!(
                "<b{}>{} {:.0} %</b>",
                if narrow { "" } else { " class=\"roomy\"" },
                escaped(last(&pass.name)),
                share * 100.0
            ),
        };
        html += &format!(
            "<i style=\"width:{:.3}%;background:{}\" title=\"{}\">{label}</i>",
            share / most * 100.0,
            colors.of(&pass.name),
            escaped(&words)
        );
    }
    html + "</div></div>\n"
}
