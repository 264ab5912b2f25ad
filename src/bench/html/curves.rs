//! Times and rates against counts, a curve an adapter.

use super::super::record::Run;
use super::super::units::{digits, grouped, prefixed, shortened};
use super::Labelled;
use super::svg::{Plane, Scale, axes, color, escaped, figure, picture, polyline, spread_apart};

/// A picture's size. Pages of any width show one of two.
struct Size {
    class: &'static str,
    width: f64,
    height: f64,
    plane: Plane,
    /// Whether there is room for names on the right.
    has_names: bool,
}

const SIZES: [Size; 2] = [
    Size {
        class: "wide",
        width: 580.0,
        height: 400.0,
        plane: Plane {
            left: 56.0,
            top: 34.0,
            right: 452.0,
            bottom: 348.0,
        },
        has_names: true,
    },
    Size {
        class: "narrow",
        width: 330.0,
        height: 300.0,
        plane: Plane {
            left: 42.0,
            top: 34.0,
            right: 318.0,
            bottom: 250.0,
        },
        has_names: false,
    },
];

/// More adapters than this, and their floors go without a name.
const MOST_FLOOR_NAMES: usize = 3;

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

/// A line of a chart.
struct Line<'a> {
    curve: &'a Curve<'a>,
    points: Vec<Point>,
    is_floor: bool,
    /// Dashes, width.
    style: &'static str,
    /// What is written at its end, before the last value; none for no words.
    name: String,
}

/// A value at a count, with what is written beside it at the end, and what is told when pointed at.
struct Point {
    count: f64,
    value: f64,
    words: String,
}

const SOLID: &str = "stroke-width=\"2.5\" stroke-linejoin=\"round\"";
const DASHED: &str = "stroke-width=\"1.6\" stroke-dasharray=\"6 4\"";
const DOTTED: &str = "stroke-width=\"1.6\" stroke-dasharray=\"1.5 4\" stroke-linecap=\"round\"";

impl<'a> Line<'a> {
    /// Through what is known and above 0 of these values.
    fn new(
        curve: &'a Curve<'a>,
        name: &str,
        style: &'static str,
        value: &dyn Fn(&Run) -> Option<f64>,
        words: &dyn Fn(&Run, f64) -> String,
    ) -> Self {
        let point = |run: &&Run| {
            let value = value(run).filter(|value| *value > 0.0)?;
            Some(Point {
                count: run.particles as f64,
                value,
                words: words(run, value),
            })
        };
        Self {
            curve,
            points: curve.runs.iter().filter_map(point).collect(),
            is_floor: style != SOLID,
            style,
            name: name.to_owned(),
        }
    }
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
    let words = "Median of step and drawing, with p10 to p90 behind it. Dashed is the floor: what the adapter's own copies of \
                 the bytes that the passes must move take. Dotted is what as many dispatches cost that do nothing.";
    let value = |ms: f64| digits(ms) + " ms";
    let chart = Chart {
        title: &title,
        unit: "ms a frame",
        lines: &lines,
        bands: &bands,
        references: &references,
        value: &value,
    };
    figure(&title, words, &chart.drawn(curves))
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

struct Chart<'a> {
    title: &'a str,
    unit: &'a str,
    lines: &'a [Line<'a>],
    /// Count, low, high; a band a curve.
    bands: &'a [Vec<[f64; 3]>],
    references: &'a [(f64, &'a str)],
    value: &'a dyn Fn(f64) -> String,
}

impl Chart<'_> {
    /// In both sizes, and a legend for the small one.
    fn drawn(&self, curves: &[Curve]) -> String {
        let pictures = SIZES.iter().map(|size| self.picture(size, curves));
        let item = |curve: &Curve| {
            let (color, label) = (color(curve.at), escaped(&curve.labelled.label));
            format!("<li><i style=\"background:{color}\"></i>{label}</li>")
        };
        let items: String = curves.iter().map(item).collect();
        pictures.collect::<String>() + "<ul class=\"legend narrow\">" + &items + "</ul>\n"
    }

    fn picture(&self, size: &Size, curves: &[Curve]) -> String {
        let plane = &size.plane;
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let bands = || self.bands.iter().flatten();
        let counts = points().map(|point| point.count);
        let values = points().map(|point| point.value);
        let values = values.chain(bands().flat_map(|[_, low, high]| [*low, *high]));
        let x = Scale::log(counts, [plane.left, plane.right]);
        let y = Scale::log(values, [plane.bottom, plane.top]);
        let mut svg = axes(plane, (&x, "particles"), (&y, self.unit));
        for (value, words) in self.references {
            // At the upper edge its words would cover the axis's.
            if y.holds(*value) && y.at(*value) > plane.top + 16.0 {
                svg += &reference(plane, y.at(*value), words);
            }
        }
        for (curve, band) in curves.iter().zip(self.bands) {
            let upper = band.iter().map(|[count, _, high]| (*count, *high));
            let lower = band.iter().rev().map(|[count, low, _]| (*count, *low));
            let places = upper.chain(lower);
            let places = places.map(|(count, ms)| format!("{:.1},{:.1}", x.at(count), y.at(ms)));
            let places: Vec<String> = places.collect();
            let (places, color) = (places.join(" "), color(curve.at));
            svg += &format!("<polygon points=\"{places}\" fill=\"{color}\" opacity=\"0.18\"/>");
        }
        for line in self.lines {
            let color = color(line.curve.at);
            let place = |point: &Point| (x.at(point.count), y.at(point.value));
            let places: Vec<(f64, f64)> = line.points.iter().map(place).collect();
            svg += &polyline(&places, &color, line.style);
            for (point, (x, y)) in line.points.iter().zip(places) {
                let radius = if line.is_floor { 2.5 } else { 4.5 };
                svg += &dot((x, y), radius, &color, &point.words);
            }
        }
        if size.has_names {
            svg += &self.names(plane, &x, &y, curves.len());
        }
        picture(size.class, (size.width, size.height), self.title, &svg)
    }

    /// Names at the ends of the lines, with the last value.
    fn names(&self, plane: &Plane, x: &Scale, y: &Scale, curves: usize) -> String {
        let has_name = |line: &&Line| !line.is_floor || curves <= MOST_FLOOR_NAMES;
        let lines = self.lines.iter().filter(has_name);
        let ends = lines.filter_map(|line| Some((line, line.points.last()?)));
        let ends: Vec<(&Line, &Point)> = ends.collect();
        let wanted: Vec<f64> = ends.iter().map(|(_, end)| y.at(end.value)).collect();
        let room = [plane.top + 4.0, plane.bottom - 16.0];
        let placed = spread_apart(&wanted, 35.0, room);
        let mut svg = String::new();
        for (((line, end), wanted), y) in ends.into_iter().zip(wanted).zip(placed) {
            let color = color(line.curve.at);
            let from = x.at(end.count) + 6.0;
            let left = plane.right + 16.0;
            let weight = if line.is_floor {
                ""
            } else {
                " class=\"strong\""
            };
            svg += &format!(
                "<path d=\"M{from:.1} {wanted:.1}L{:.1} {y:.1}\" stroke=\"{color}\" opacity=\"0.5\" fill=\"none\"/>\
                 <text{weight} style=\"fill:{color}\" x=\"{left}\" y=\"{:.1}\">{}</text>\
                 <text x=\"{left}\" y=\"{:.1}\">{}</text>",
                left - 4.0,
                y + 4.0,
                escaped(&shortened(&line.name, 14)),
                y + 19.0,
                (self.value)(end.value)
            );
        }
        svg
    }
}

fn dot((x, y): (f64, f64), radius: f64, color: &str, words: &str) -> String {
    let words = escaped(words);
    format!(
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{color}\"><title>{words}</title></circle>"
    )
}

fn reference(plane: &Plane, y: f64, words: &str) -> String {
    let Plane { left, right, .. } = plane;
    let (text_x, text_y) = (left + 8.0, y - 5.0);
    format!(
        "<line class=\"mark\" x1=\"{left}\" x2=\"{right}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>\
         <text x=\"{text_x}\" y=\"{text_y:.1}\">{words}</text>"
    )
}
