//! Axes, marks and text of a chart, as SVG within HTML.

use super::super::units::prefixed;

/// Text as HTML and SVG have it.
pub(super) fn escaped(text: &str) -> String {
    let mut all = String::new();
    for letter in text.chars() {
        match letter {
            '&' => all += "&amp;",
            '<' => all += "&lt;",
            '>' => all += "&gt;",
            '"' => all += "&quot;",
            letter if letter.is_control() => all.push(' '),
            letter => all.push(letter),
        }
    }
    all
}

/// The colour of the `at`-th of several, as CSS has it; the first ten differ.
pub(super) fn color(at: usize) -> String {
    format!("var(--c{})", at % 10)
}

/// The same of passes, which are not to be taken for adapters.
pub(super) fn pass_color(at: usize) -> String {
    format!("var(--p{})", at % 10)
}

/// From values to pixels, over their logarithms.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    from: [f64; 2],
    to_px: [f64; 2],
}

impl Scale {
    /// Between 1, 2 or 5 times powers of ten that hold all these values, which are above 0.
    pub(super) fn log(values: impl Iterator<Item = f64> + Clone, to_px: [f64; 2]) -> Self {
        let least = values.clone().fold(f64::MAX, f64::min);
        let most = values.fold(f64::MIN_POSITIVE, f64::max);
        let (least, most) = if least < most {
            (least, most)
        } else {
            (most / 2.0, most * 2.0)
        };
        let round = round_numbers(least / 10.0, most * 10.0);
        let low = round.iter().copied().rfind(|it| *it <= least * 1.000_001);
        let high = round.iter().copied().find(|it| *it >= most * 0.999_999);
        Self {
            from: [low.unwrap_or(least), high.unwrap_or(most)],
            to_px,
        }
    }

    /// Pixels of a value.
    pub(super) fn at(&self, value: f64) -> f64 {
        let [low, high] = self.from.map(f64::log10);
        let [start, end] = self.to_px;
        start + (value.log10() - low) / (high - low) * (end - start)
    }

    /// Whether a value lies within.
    pub(super) fn holds(&self, value: f64) -> bool {
        (self.from[0]..=self.from[1]).contains(&value)
    }

    /// Values to be marked, and whether they get a number.
    fn ticks(&self) -> Vec<(f64, bool)> {
        let [low, high] = self.from;
        let inside = |it: &f64| (low * 0.999_999..=high * 1.000_001).contains(it);
        let round: Vec<f64> = round_numbers(low, high)
            .into_iter()
            .filter(inside)
            .collect();
        let is_decade = |value: f64| (value.log10() - value.log10().round()).abs() < 1e-6;
        let few = round.len() <= 7;
        round
            .into_iter()
            .map(|it| (it, few || is_decade(it)))
            .collect()
    }
}

fn round_numbers(low: f64, high: f64) -> Vec<f64> {
    let powers = low.log10().floor() as i32..=high.log10().ceil() as i32;
    powers
        .flat_map(|power| [1.0, 2.0, 5.0].map(|it| it * 10f64.powi(power)))
        .collect()
}

/// Where a chart's plane lies in its picture, pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

/// The grid of a plane with numbers on both axes, and what they count.
pub(super) fn axes(
    plane: &Plane,
    (x, x_title): (&Scale, &str),
    (y, y_title): (&Scale, &str),
) -> String {
    let Plane {
        left,
        top,
        right,
        bottom,
    } = *plane;
    let mut svg = String::new();
    for (value, is_told) in x.ticks() {
        let (px, class) = (x.at(value), if is_told { "grid" } else { "faint" });
        svg += &format!(
            "<line class=\"{class}\" x1=\"{px:.1}\" x2=\"{px:.1}\" y1=\"{top}\" y2=\"{bottom}\"/>"
        );
        if is_told {
            let (y, number) = (bottom + 19.0, tick(value));
            svg += &format!("<text x=\"{px:.1}\" y=\"{y}\" text-anchor=\"middle\">{number}</text>");
        }
    }
    for (value, is_told) in y.ticks() {
        let (px, class) = (y.at(value), if is_told { "grid" } else { "faint" });
        svg += &format!(
            "<line class=\"{class}\" x1=\"{left}\" x2=\"{right}\" y1=\"{px:.1}\" y2=\"{px:.1}\"/>"
        );
        if is_told {
            let (x, y, number) = (left - 8.0, px + 4.5, tick(value));
            svg += &format!("<text x=\"{x}\" y=\"{y:.1}\" text-anchor=\"end\">{number}</text>");
        }
    }
    let (middle, below, above) = (0.5 * (left + right), bottom + 42.0, top - 14.0);
    svg += &format!("<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{x_title}</text>");
    svg += &format!("<text x=\"4\" y=\"{above}\">{y_title}</text>");
    svg
}

/// A round number of an axis: `20 k`, `0.5`.
pub(super) fn tick(value: f64) -> String {
    let text = match value >= 1e3 {
        true => prefixed(value),
        false => format!("{value:.6}"),
    };
    // Round numbers need no zeros after the point.
    let (number, unit) = text.split_once(' ').unwrap_or((&text, ""));
    let number = match number.contains('.') {
        true => number.trim_end_matches('0').trim_end_matches('.'),
        false => number,
    };
    format!("{number} {unit}").trim_end().to_owned()
}

/// A line through points in pixels.
pub(super) fn polyline(points: &[(f64, f64)], color: &str, more: &str) -> String {
    let points: Vec<String> = points
        .iter()
        .map(|(x, y)| format!("{x:.1},{y:.1}"))
        .collect();
    let points = points.join(" ");
    format!("<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" {more}/>")
}

/// Heights moved apart so that no two are nearer than `gap`, in the order given.
pub(super) fn spread_apart(wanted: &[f64], gap: f64, [top, bottom]: [f64; 2]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|&a, &b| wanted[a].total_cmp(&wanted[b]));
    let mut placed = wanted.to_vec();
    let mut least = top;
    for &at in &order {
        placed[at] = placed[at].max(least);
        least = placed[at] + gap;
    }
    let mut most = bottom;
    for &at in order.iter().rev() {
        placed[at] = placed[at].min(most);
        most = placed[at] - gap;
    }
    placed
}

/// A picture of this size with a title for those who cannot see it, for pages that are `wide` or
/// `narrow`.
pub(super) fn picture(
    class: &str,
    (width, height): (f64, f64),
    title: &str,
    inside: &str,
) -> String {
    let title = escaped(title);
    format!(
        "<svg class=\"{class}\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">{inside}</svg>\n"
    )
}

/// A figure with its caption: what it shows, and how to read it.
pub(super) fn figure(title: &str, words: &str, inside: &str) -> String {
    let (title, words) = (escaped(title), escaped(words));
    format!("<figure>\n<figcaption><b>{title}</b>{words}</figcaption>\n{inside}</figure>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_hold_their_values_between_round_numbers() {
        let scale = Scale::log([13.0, 4400.0].into_iter(), [100.0, 500.0]);
        assert_eq!(scale.from, [10.0, 5000.0]);
        assert_eq!((scale.at(10.0), scale.at(5000.0)), (100.0, 500.0));
        let middle = scale.at((10.0f64 * 5000.0).sqrt());
        assert!((middle - 300.0).abs() < 1e-9);
        assert_eq!(Scale::log([7.0].into_iter(), [0.0, 1.0]).from, [2.0, 20.0]);
        assert_eq!(
            Scale::log([1.0, 50.0].into_iter(), [0.0, 1.0])
                .ticks()
                .len(),
            6
        );
    }

    #[test]
    fn ticks_are_short() {
        let ticks = [0.05, 0.2, 1.0, 20.0, 1000.0, 50_000.0, 1e6, 2e9].map(tick);
        assert_eq!(
            ticks,
            ["0.05", "0.2", "1", "20", "1 k", "50 k", "1 M", "2 G"]
        );
    }

    #[test]
    fn labels_do_not_cover_one_another() {
        let placed = spread_apart(&[50.0, 10.0, 12.0, 98.0, 99.0], 10.0, [0.0, 100.0]);
        assert_eq!(placed, [50.0, 10.0, 20.0, 90.0, 100.0]);
    }
}
