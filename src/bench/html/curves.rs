//! Times and rates against counts, a curve an adapter.

use super::super::record::Run;
use super::super::units::{digits, grouped, percent, prefixed};
use super::Labelled;
use super::chart::{Chart, Curve, DASHED, DOTTED, Line, SOLID};
use super::svg::figure;
use crate::bench::fits::fits;

/// Scenes that some record measured at several counts, in the order of the records.
pub(super) fn scenes_in_several_counts<'a>(records: &[Labelled<'a>]) -> Vec<&'a str> {
    let mut scenes: Vec<(&str, Vec<u64>)> = Vec::new();
    for run in records.iter().flat_map(|it| &it.record.runs) {
        match scenes.iter_mut().find(|(scene, _)| *scene == run.scene) {
            Some((_, counts)) if counts.contains(&run.particles) => {}
            Some((_, counts)) => counts.push(run.particles),
            None => scenes.push((&run.scene, vec![run.particles])),
        }
    }
    let several = scenes.into_iter().filter(|(_, counts)| counts.len() > 1);
    several.map(|(scene, _)| scene).collect()
}

/// Both charts of a scene: time a frame, and particles a second. Empty if nothing has a time.
pub(super) fn charts(scene: &str, records: &[Labelled]) -> String {
    let curves: Vec<Curve> = records
        .iter()
        .enumerate()
        .map(|(at, labelled)| {
            let of_scene =
                |run: &&Run| run.scene == scene && run.particles > 0 && run.frame_ms.median > 0.0;
            let mut runs: Vec<&Run> = labelled.record.runs.iter().filter(of_scene).collect();
            runs.sort_by_key(|run| run.particles);
            Curve { at, labelled, runs }
        })
        .filter(|curve| !curve.runs.is_empty())
        .collect();
    if curves.is_empty() {
        return String::new();
    }
    format!(
        "<div class=\"charts\">\n{}{}</div>\n",
        times(scene, &curves),
        rates(scene, &curves)
    )
}

fn times(scene: &str, curves: &[Curve]) -> String {
    let mut lines = Vec::new();
    for curve in curves {
        let label = &curve.labelled.label;
        let floor = |run: &Run| run.floor_ms(curve.labelled.record);
        let idle = |run: &Run| run.dispatches_ms().map(|(ms, _)| ms);
        let at = |run: &Run| format!("{label} at {} particles", grouped(run.particles));
        lines.push(Line::new(curve, "floor", DASHED, &floor, &|run, ms| {
            format!("{}: floor {} ms", at(run), digits(ms))
        }));
        lines.push(Line::new(curve, "dispatches", DOTTED, &idle, &|run, ms| {
            let count = run.dispatches_ms().map_or(0, |(_, count)| count);
            format!("{}: {count} idle dispatches, {} ms", at(run), digits(ms))
        }));
        let frame = |run: &Run| Some(run.frame_ms.median);
        lines.push(Line::new(curve, label, SOLID, &frame, &|run, _| {
            let ms = &run.frame_ms;
            let floor = floor(run).map_or(String::new(), |ms| format!(", floor {} ms", digits(ms)));
            format!(
                "{}: {} ms a frame ({} .. {}), step {} ms, draw {} ms{floor}",
                at(run),
                digits(ms.median),
                digits(ms.p10),
                digits(ms.p90),
                digits(run.step_ms.median),
                digits(run.draw_ms.median)
            )
        }));
    }
    let bands: Vec<Vec<[f64; 3]>> = curves
        .iter()
        .map(|curve| {
            let range = |run: &&Run| [run.particles as f64, run.frame_ms.p10, run.frame_ms.p90];
            let ranges = curve.runs.iter().map(range);
            ranges.filter(|[_, low, _]| *low > 0.0).collect()
        })
        .collect();
    let references = [(1000.0 / 60.0, "60 frames/s"), (1000.0, "1 frame/s")];
    let title = format!("{scene}: time a frame");
    let costs = curves.iter().filter_map(|curve| {
        let fits = fits(&curve.runs);
        let frame = fits.last()?;
        Some(format!(
            " On {} a frame takes {} ms and {} ns for each that lives, within {}.",
            curve.labelled.label,
            digits(frame.a_ms),
            digits(frame.b_ns),
            percent(frame.off)
        ))
    });
    let words = "Median of step and drawing, with p10 to p90 behind it. Dashed is the floor: what the adapter's own copies of \
                 the bytes that the passes must move take. Dotted is what as many dispatches cost that do nothing."
        .to_owned()
        + &costs.collect::<String>();
    let value = |ms: f64| digits(ms) + " ms";
    let chart = Chart {
        title: &title,
        unit: "ms a frame",
        lines: &lines,
        bands: &bands,
        references: &references,
        value: &value,
    };
    figure(&title, &words, &chart.drawn(curves))
}

fn rates(scene: &str, curves: &[Curve]) -> String {
    let lines: Vec<Line> = curves
        .iter()
        .map(|curve| {
            let label = &curve.labelled.label;
            Line::new(curve, label, SOLID, &Run::particles_per_s, &|run, rate| {
                let (count, rate) = (grouped(run.particles), prefixed(rate));
                format!("{label} at {count} particles: {rate} particles a second")
            })
        })
        .collect();
    let title = format!("{scene}: particles a second");
    let words = "Particles stepped and drawn in a second. Level means that each particle costs the same, however many \
                 there are.";
    let value = |rate: f64| prefixed(rate) + "/s";
    let chart = Chart {
        title: &title,
        unit: "particles a second",
        lines: &lines,
        bands: &[],
        references: &[],
        value: &value,
    };
    figure(&title, words, &chart.drawn(curves))
}
