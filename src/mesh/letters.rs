//! Words as solid letters: capitals of strokes two cells wide, with their corners cut, on a grid ten
//! cells high. `letters.txt` has them; a cell is empty (`.`), full (`#`), or the half of it at one of its
//! corners: `d` below right, `b` below left, `q` above right, `p` above left.

use std::collections::{HashMap, HashSet};

use super::build::Builder;
use super::{Mesh, MeshError};

/// Letters of a text at most.
pub const MOST_LETTERS: usize = 64;

const FONT: &str = include_str!("letters.txt");
/// Cells of a letter's height, and of the solid's depth.
const HEIGHT: i32 = 10;
const DEPTH: i32 = 3;
/// Half cells between letters, and of a space.
const BETWEEN: i32 = 3;
const SPACE: i32 = 8;

/// A place on the grid, in half cells to the right and in cells up.
type Node = (i32, i32);

/// What a letter is made of: convex polygons, counterclockwise.
struct Glyph {
    cells: Vec<Vec<Node>>,
    width: i32,
}

/// The text as solid letters that stand along x, face +z and are 1 high and 0.3 deep, all around the
/// origin; a part a letter. Small letters become capitals.
///
/// # Errors
/// No letters, more than [`MOST_LETTERS`], or one that is none of A to Z, 0 to 9, `!`, `?`, `.`, `-`
/// and spaces.
pub fn letters(text: &str) -> Result<Mesh, MeshError> {
    let count = text.chars().filter(|letter| *letter != ' ').count();
    if count == 0 || text.chars().count() > MOST_LETTERS {
        let what = match count {
            0 => "there are no letters".to_owned(),
            _ => format!("there are {} letters", text.chars().count()),
        };
        let help = format!("1 to {MOST_LETTERS} letters, as in \"letters:FIRE\"");
        return Err(MeshError::new(what, help));
    }
    let mut placed = Vec::new();
    let mut at = 0;
    for letter in text.chars() {
        let letter = letter.to_ascii_uppercase();
        if letter == ' ' {
            at += SPACE;
            continue;
        }
        let Some(glyph) = glyph(letter) else {
            let what = format!("there is no solid letter \"{}\"", letter.escape_debug());
            return Err(MeshError::new(
                what,
                "A to Z, 0 to 9, !, ?, ., - and spaces",
            ));
        };
        let width = glyph.width;
        placed.push((letter, at, glyph));
        at += 2 * width + BETWEEN;
    }
    let whole = at - BETWEEN;
    let mut built = Builder::default();
    for (letter, right, glyph) in placed {
        built.part(&letter.to_string(), "")?;
        solid(&mut built, &glyph, 2 * right - whole)?;
    }
    built.finish(&format!("letters:{text}"))
}

/// The letter of the font.
fn glyph(letter: char) -> Option<Glyph> {
    let mut lines = FONT.lines();
    lines.find(|line| line.len() > 1 && line.starts_with(letter) && line[1..].starts_with(' '))?;
    let mut cells = Vec::new();
    let mut width = 0;
    for (row, line) in (0..HEIGHT).zip(lines) {
        width = line.len() as i32;
        let (low, high) = (HEIGHT - 1 - row, HEIGHT - row);
        for (column, cell) in (0..).zip(line.chars()) {
            let (left, right) = (2 * column, 2 * column + 2);
            let corners = [(left, low), (right, low), (right, high), (left, high)];
            let without = |corner: usize| {
                let left = (0..4).filter(|at| *at != corner);
                left.map(|at| corners[at]).collect()
            };
            match cell {
                '#' => cells.push(corners.to_vec()),
                'd' => cells.push(without(3)),
                'b' => cells.push(without(2)),
                'q' => cells.push(without(0)),
                'p' => cells.push(without(1)),
                _ => {}
            }
        }
    }
    Some(Glyph { cells, width })
}

/// A letter's front, back and sides, `right` quarters of a cell to the right.
fn solid(built: &mut Builder, glyph: &Glyph, right: i32) -> Result<(), MeshError> {
    let mut known: HashMap<(Node, bool), u32> = HashMap::new();
    let mut vertex = |built: &mut Builder, (x, y): Node, is_front: bool| {
        if let Some(at) = known.get(&((x, y), is_front)) {
            return Ok(*at);
        }
        let depth = if is_front { DEPTH } else { -DEPTH };
        let quarters = [2 * x + right, 4 * y - 2 * HEIGHT, 2 * depth];
        built.vertex(quarters.map(|quarter| quarter as f32 / (4 * HEIGHT) as f32))?;
        let at = known.len() as u32;
        known.insert(((x, y), is_front), at);
        Ok::<u32, MeshError>(at)
    };
    let first = built.vertex_count() as u32;
    let edges = |cell: &[Node]| -> Vec<(Node, Node)> {
        let next = cell.iter().copied().cycle().skip(1);
        cell.iter().copied().zip(next).collect()
    };
    let all: HashSet<(Node, Node)> = glyph.cells.iter().flat_map(|cell| edges(cell)).collect();
    for cell in &glyph.cells {
        let mut corners = Vec::new();
        for node in cell {
            corners.push(first + vertex(built, *node, true)?);
        }
        built.polygon(&corners)?;
        corners.clear();
        for node in cell.iter().rev() {
            corners.push(first + vertex(built, *node, false)?);
        }
        built.polygon(&corners)?;
        for (from, to) in edges(cell) {
            if all.contains(&(to, from)) {
                continue;
            }
            let mut side = Vec::new();
            for (node, is_front) in [(from, true), (from, false), (to, false), (to, true)] {
                side.push(first + vertex(built, node, is_front)?);
            }
            built.polygon(&side)?;
        }
    }
    Ok(())
}
