//! A chart of lines over counts, in two sizes.

use super::super::record::Run;
use super::super::units::shortened;
use super::Labelled;
use super::svg::{Plane, Scale, axes, color, escaped, picture, polyline, spread_apart};

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
pub(super) struct Curve<'a> {
    pub(super) at: usize,
    pub(super) labelled: &'a Labelled<'a>,
    pub(super) runs: Vec<&'a Run>,
}

/// A line of a chart.
pub(super) struct Line<'a> {
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

pub(super) const SOLID: &str = "stroke-width=\"2.5\" stroke-linejoin=\"round\"";
pub(super) const DASHED: &str = "stroke-width=\"1.6\" stroke-dasharray=\"6 4\"";
pub(super) const DOTTED: &str =
    "stroke-width=\"1.6\" stroke-dasharray=\"1.5 4\" stroke-linecap=\"round\"";

impl<'a> Line<'a> {
    /// Through what is known and above 0 of these values.
    pub(super) fn new(
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

pub(super) struct Chart<'a> {
    pub(super) title: &'a str,
    pub(super) unit: &'a str,
    pub(super) lines: &'a [Line<'a>],
    /// Count, low, high; a band a curve.
    pub(super) bands: &'a [Vec<[f64; 3]>],
    pub(super) references: &'a [(f64, &'a str)],
    pub(super) value: &'a dyn Fn(f64) -> String,
}

impl Chart<'_> {
    /// In both sizes, and a legend for the small one.
    pub(super) fn drawn(&self, curves: &[Curve]) -> String {
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
