//! One frame as a line drawing: an SVG with lines for all that lives, as a vector display would
//! draw it (Reeves 1983, 4.2).

use std::fmt::Write as _;
use std::path::Path;

use super::OutputError;
use super::folder::write_whole;
use crate::simulation::Line;

/// What a line drawing needs besides its lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawing<'a> {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Colour behind everything, each 0 ..= 1.
    pub background: [f32; 3],
    /// Factor of the lines' light.
    pub exposure: f32,
    /// What lives, as [`Simulation::lines`](crate::Simulation::lines) gives it.
    pub lines: &'a [Line],
}

/// Writes the drawing, whole or not at all; folders that are missing above it are created.
///
/// Lines stand in the order of `lines`, in pixels with two decimals; what is outside the picture is
/// written too, and the viewer clips it.
///
/// # Errors
/// The user's fault: a path that cannot be a file. The machine's: it cannot be written.
pub fn write_svg(path: &Path, drawing: &Drawing) -> Result<(), OutputError> {
    write_whole(path, svg_of(drawing).as_bytes())
}

fn svg_of(drawing: &Drawing) -> String {
    let Drawing {
        width,
        height,
        background,
        exposure,
        lines,
    } = *drawing;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n\
         <g stroke-width=\"1\" stroke-linecap=\"round\">\n",
        hex(background)
    );
    for line in lines {
        let ([x1, y1], [x2, y2]) = (line.from_px, line.to_px);
        let color = hex(line.color.map(|channel| channel * exposure));
        // Writing to a text cannot fail.
        let _ = writeln!(
            svg,
            "<line x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" stroke=\"{color}\"/>"
        );
    }
    svg.push_str("</g>\n</svg>\n");
    svg
}

/// A colour as `#rrggbb`; what is brighter than white is white.
fn hex(color: [f32; 3]) -> String {
    let [r, g, b] = color.map(|channel| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Population;

    #[test]
    fn a_drawing_has_its_background_and_a_line_for_each_in_order() {
        let line = |from_px, to_px, color| Line {
            population: Population::Particles,
            slot: 0,
            from_px,
            to_px,
            color,
        };
        let drawing = Drawing {
            width: 32,
            height: 18,
            background: [0.0, 1.0, 0.5],
            exposure: 2.0,
            lines: &[
                line([1.0, 2.0], [3.5, 4.256], [0.25, 0.0, 9.0]),
                line([-7.0, 2.0], [40.0, 4.0], [0.5, 0.1, 0.0]),
            ],
        };
        assert_eq!(
            svg_of(&drawing),
            concat!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"32\" height=\"18\" viewBox=\"0 0 32 18\">\n",
                "<rect width=\"100%\" height=\"100%\" fill=\"#00ff80\"/>\n",
                "<g stroke-width=\"1\" stroke-linecap=\"round\">\n",
                "<line x1=\"1.00\" y1=\"2.00\" x2=\"3.50\" y2=\"4.26\" stroke=\"#8000ff\"/>\n",
                "<line x1=\"-7.00\" y1=\"2.00\" x2=\"40.00\" y2=\"4.00\" stroke=\"#ff3300\"/>\n",
                "</g>\n</svg>\n",
            )
        );
    }
}
