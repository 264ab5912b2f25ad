//! Times and rates against counts, a curve an adapter.

use super::super::record::Run;
use super::super::units::{digits, grouped, prefixed};
use super::Labelled;
use super::svg::{Plane, Scale, axes, color, escaped, figure, picture, polyline, spread_apart};

const WIDTH: f64 = 580.0;
const HEIGHT: f64 = 400.0;

/// Room for names is on the right.
const PLANE: Plane = Plane {
    left: 56.0,
    top: 34.0,
    right: 462.0,
    bottom: 348.0,
};

/// A record's runs of one scene, by count.
struct Curve<'a> {
    at: usize,
    labelled: &'a Labelled<'a>,
    runs: Vec<&'a Run>,
}

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

fn count_scale(curves: &[Curve]) -> Scale {
    let counts = curves
        .iter()
        .flat_map(|curve| curve.runs.iter().map(|run| run.particles as f64));
    Scale::log(counts, [PLANE.left, PLANE.right])
}

fn times(scene: &str, curves: &[Curve]) -> String {
    let floor = |curve: &Curve, run: &Run| run.floor_ms(curve.labelled.record);
    let x = count_scale(curves);
    let values = curves.iter().flat_map(|curve| {
        let told = |run: &&Run| {
            [
                Some(run.frame_ms.p90),
                Some(run.frame_ms.p10),
                floor(curve, run),
            ]
        };
        let values: Vec<f64> = curve
            .runs
            .iter()
            .flat_map(told)
            .flatten()
            .filter(|it| *it > 0.0)
            .collect();
        values
    });
    let values: Vec<f64> = values.collect();
    let y = Scale::log(values.iter().copied(), [PLANE.bottom, PLANE.top]);
    let mut svg = axes(&PLANE, (&x, "particles"), (&y, "ms a frame"));
    for (ms, words) in [(1000.0 / 60.0, "60 frames/s"), (1000.0, "1 frame/s")] {
        // At the upper edge its words would cover the axis's.
        if y.holds(ms) && y.at(ms) > PLANE.top + 16.0 {
            svg += &reference(y.at(ms), words);
        }
    }
    for curve in curves {
        let color = color(curve.at);
        let points = |of: &dyn Fn(&Run) -> Option<f64>| -> Vec<(f64, f64)> {
            let place = |run: &&Run| {
                Some((
                    x.at(run.particles as f64),
                    y.at(of(run).filter(|ms| *ms > 0.0)?),
                ))
            };
            curve.runs.iter().filter_map(place).collect()
        };
        let mut band = points(&|run| Some(run.frame_ms.p90));
        band.extend(points(&|run| Some(run.frame_ms.p10)).into_iter().rev());
        let band: Vec<String> = band.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        svg += &format!(
            "<polygon points=\"{}\" fill=\"{color}\" opacity=\"0.18\"/>",
            band.join(" ")
        );
        let floors = points(&|run| floor(curve, run));
        svg += &polyline(
            &floors,
            &color,
            "stroke-width=\"1.5\" stroke-dasharray=\"5 5\" opacity=\"0.8\"",
        );
        if let ([.., (x, y)], true) = (floors.as_slice(), curves.len() == 1) {
            let (x, y) = (x - 6.0, y + 18.0);
            svg += &format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"end\">floor</text>");
        }
        svg += &polyline(
            &points(&|run| Some(run.frame_ms.median)),
            &color,
            "stroke-width=\"2.5\" stroke-linejoin=\"round\"",
        );
        for run in &curve.runs {
            let floor =
                floor(curve, run).map_or(String::new(), |ms| format!(", floor {} ms", digits(ms)));
            let words = format!(
                "{} at {} particles: {} ms a frame ({} .. {}), step {} ms, draw {} ms{floor}",
                curve.labelled.label,
                grouped(run.particles),
                digits(run.frame_ms.median),
                digits(run.frame_ms.p10),
                digits(run.frame_ms.p90),
                digits(run.step_ms.median),
                digits(run.draw_ms.median)
            );
            svg += &dot(
                x.at(run.particles as f64),
                y.at(run.frame_ms.median),
                &color,
                &words,
            );
        }
    }
    svg += &end_labels(curves, &|run| y.at(run.frame_ms.median), &x, &|run| {
        digits(run.frame_ms.median) + " ms"
    });
    let title = format!("{scene}: time a frame");
    let words = "Median of step and drawing, with p10 to p90 behind it. Dashed is the floor: the bytes that the passes \
                 must move, at the rate of the adapter's own copy.";
    figure(&title, words, &picture(WIDTH, HEIGHT, &title, &svg))
}

fn rates(scene: &str, curves: &[Curve]) -> String {
    let rate =
        |run: &Run| run.live.unwrap_or(run.particles).max(1) as f64 / (run.frame_ms.median * 1e-3);
    let x = count_scale(curves);
    let values: Vec<f64> = curves
        .iter()
        .flat_map(|curve| curve.runs.iter().map(|run| rate(run)))
        .collect();
    let y = Scale::log(values.iter().copied(), [PLANE.bottom, PLANE.top]);
    let mut svg = axes(&PLANE, (&x, "particles"), (&y, "particles a second"));
    for curve in curves {
        let color = color(curve.at);
        let place = |run: &&Run| (x.at(run.particles as f64), y.at(rate(run)));
        let points: Vec<(f64, f64)> = curve.runs.iter().map(place).collect();
        svg += &polyline(
            &points,
            &color,
            "stroke-width=\"2.5\" stroke-linejoin=\"round\"",
        );
        for (run, (x, y)) in curve.runs.iter().zip(points) {
            let words = format!(
                "{} at {} particles: {} particles a second",
                curve.labelled.label,
                grouped(run.particles),
                prefixed(rate(run))
            );
            svg += &dot(x, y, &color, &words);
        }
    }
    svg += &end_labels(curves, &|run| y.at(rate(run)), &x, &|run| {
        prefixed(rate(run)) + "/s"
    });
    let title = format!("{scene}: particles a second");
    let words = "Particles stepped and drawn in a second. Level means that each particle costs the same, however many \
                 there are.";
    figure(&title, words, &picture(WIDTH, HEIGHT, &title, &svg))
}

/// Names at the ends of the curves, with the last value.
fn end_labels(
    curves: &[Curve],
    y: &dyn Fn(&Run) -> f64,
    x: &Scale,
    value: &dyn Fn(&Run) -> String,
) -> String {
    let ends: Vec<&Run> = curves
        .iter()
        .filter_map(|curve| curve.runs.last().copied())
        .collect();
    let wanted: Vec<f64> = ends.iter().map(|run| y(run)).collect();
    let placed = spread_apart(&wanted, 36.0, [PLANE.top + 4.0, PLANE.bottom - 16.0]);
    let mut svg = String::new();
    for ((curve, run), (wanted, y)) in curves.iter().zip(ends).zip(wanted.into_iter().zip(placed)) {
        let color = color(curve.at);
        let end = x.at(run.particles as f64) + 6.0;
        let left = PLANE.right + 14.0;
        svg += &format!(
            "<path d=\"M{end:.1} {wanted:.1}L{:.1} {y:.1}\" stroke=\"{color}\" opacity=\"0.5\" fill=\"none\"/>",
            left - 4.0
        );
        let label = escaped(&super::super::units::shortened(&curve.labelled.label, 15));
        let value = value(run);
        svg += &format!(
            "<text class=\"strong\" style=\"fill:{color}\" x=\"{left}\" y=\"{:.1}\">{label}</text>",
            y + 4.0
        );
        svg += &format!("<text x=\"{left}\" y=\"{:.1}\">{value}</text>", y + 20.0);
    }
    svg
}

fn dot(x: f64, y: f64, color: &str, words: &str) -> String {
    let words = escaped(words);
    format!(
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\" fill=\"{color}\"><title>{words}</title></circle>"
    )
}

fn reference(y: f64, words: &str) -> String {
    let Plane { left, right, .. } = PLANE;
    let (text_x, text_y) = (left + 8.0, y - 5.0);
    format!(
        "<line class=\"mark\" x1=\"{left}\" x2=\"{right}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>\
         <text x=\"{text_x}\" y=\"{text_y:.1}\">{words}</text>"
    )
}
