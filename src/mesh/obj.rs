//! Wavefront OBJ: vertices and polygons, with the groups and materials that they are in.
//!
//! Read here rather than by a library, so that an error has its line, and a material its name
//! without the file that describes it.

use super::MOST_TRIANGLES;
use super::build::{Builder, too_many};
use super::error::MeshError;

/// Statements that say nothing about triangles: texture, normals, smoothing, display, free-form
/// curves and surfaces.
const IGNORED: [&str; 40] = [
    "vt",
    "vn",
    "vp",
    "s",
    "mg",
    "mtllib",
    "p",
    "l",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "usemap",
    "maplib",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "call",
    "csh",
    "bsp",
    "bzp",
    "cdc",
    "cdp",
    "res",
    "xref",
];

/// Reads the whole file.
pub(super) fn read(bytes: &[u8]) -> Result<Builder, MeshError> {
    let mut built = Builder::default();
    let (mut group, mut material) = (String::new(), String::new());
    let mut corners = Vec::new();
    let mut lines = Lines::new(bytes);
    while lines.next()? {
        let whole = String::from_utf8_lossy(&lines.joined);
        // A line that only goes on leaves space before the rest.
        let text = whole.trim();
        let (word, rest) = match text.split_once(|c: char| c.is_whitespace()) {
            Some((word, rest)) => (word, rest.trim()),
            None => (text, ""),
        };
        let here = |fault: Fault| {
            // Both are parts of the same text.
            let start = fault
                .word
                .as_ptr()
                .addr()
                .checked_sub(whole.as_ptr().addr());
            let start = start.filter(|start| *start < whole.len());
            lines.place(*fault.error, start)
        };
        match word {
            "v" => {
                let place = place(rest).map_err(here)?;
                built.vertex(place).map_err(|error| here(error.into()))?;
            }
            "f" => {
                face(rest, built.vertex_count(), &mut corners).map_err(here)?;
                built
                    .polygon(&corners)
                    .map_err(|error| here(error.into()))?;
            }
            "g" | "o" | "usemtl" => {
                let named = if word == "usemtl" {
                    &mut material
                } else {
                    &mut group
                };
                rest.clone_into(named);
                let part = built.part(&group, &material);
                part.map_err(|error| here(error.into()))?;
            }
            "" => {}
            word if word.starts_with('#') || IGNORED.contains(&word) => {}
            word => {
                let shown: String = word.chars().take(20).collect();
                let what = format!("`{shown}` begins no line of an OBJ file");
                let help = "lines of `v X Y Z`, then of `f A B C` with numbers of vertices";
                let error = MeshError::new(what, help);
                return Err(here(Fault::of(error, word)));
            }
        }
    }
    Ok(built)
}

/// What is wrong, and the word that is; empty if it is none in particular.
struct Fault<'a> {
    error: Box<MeshError>,
    word: &'a str,
}

impl<'a> Fault<'a> {
    fn of(error: MeshError, word: &'a str) -> Self {
        let error = Box::new(error);
        Self { error, word }
    }
}

impl From<MeshError> for Fault<'_> {
    fn from(error: MeshError) -> Self {
        Self::of(error, "")
    }
}

/// The statements of a file, each of a line, or of several that end in `\` but for the last.
struct Lines<'a> {
    rest: &'a [u8],
    /// Lines before `rest`.
    number: usize,
    /// The statement, with a space for each break.
    joined: Vec<u8>,
    /// What was left of the file where the statement begins, and lines before that.
    begin: (&'a [u8], usize),
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            number: 0,
            joined: Vec::new(),
            begin: (bytes, 0),
        }
    }

    /// Goes to the next statement, which may be empty; false if there is none.
    fn next(&mut self) -> Result<bool, MeshError> {
        self.joined.clear();
        self.begin = (self.rest, self.number);
        while let Some((line, goes_on, rest)) = line_of(self.rest, self.joined.is_empty()) {
            self.rest = rest;
            self.number += 1;
            let reserved = self.joined.try_reserve(line.len() + 1);
            reserved.map_err(|_| MeshError::no_memory(line.len() as u64, "bytes of a line"))?;
            self.joined.extend(line);
            if !goes_on {
                return Ok(true);
            }
            self.joined.push(b' ');
        }
        Ok(!self.joined.is_empty())
    }

    /// The error, at that byte of the statement; at its first line if it is of no byte.
    fn place(&self, error: MeshError, byte: Option<usize>) -> MeshError {
        let (mut rest, before) = self.begin;
        let Some(mut byte) = byte else {
            return error.at(before + 1);
        };
        for number in before + 1.. {
            let Some((line, goes_on, after)) = line_of(rest, number == before + 1) else {
                break;
            };
            if byte <= line.len() || !goes_on {
                let indent = rest.len() - rest.trim_ascii_start().len();
                return error.at_column(number, indent + byte + 1);
            }
            byte -= line.len() + 1;
            rest = after;
        }
        error.at(before + 1)
    }
}

/// The first line without space around it, whether it goes on in the next, and what follows;
/// `None` at the end. `begins`: whether it is the first of its statement.
fn line_of(rest: &[u8], begins: bool) -> Option<(&[u8], bool, &[u8])> {
    if rest.is_empty() {
        return None;
    }
    let end = rest.iter().position(|byte| *byte == b'\n');
    let (line, rest) = rest.split_at(end.unwrap_or(rest.len()));
    let rest = rest.get(1..).unwrap_or_default();
    let line = line.trim_ascii();
    // A comment ends with its line, whatever stands there.
    let is_comment = begins && line.starts_with(b"#");
    match line.strip_suffix(b"\\") {
        Some(line) if !is_comment => Some((line, true, rest)),
        _ => Some((line, false, rest)),
    }
}

fn place(rest: &str) -> Result<[f32; 3], Fault<'_>> {
    let mut numbers = rest.split_whitespace();
    let mut next = || {
        let refuse = |what: String, word| {
            Fault::of(MeshError::new(what, "`v X Y Z` with three numbers"), word)
        };
        let word = numbers.next();
        let word =
            word.ok_or_else(|| refuse("a vertex has fewer than 3 coordinates".to_owned(), ""))?;
        word.parse::<f32>().map_err(|_| {
            let shown: String = word.chars().take(20).collect();
            refuse(format!("`{shown}` is no coordinate"), word)
        })
    };
    Ok([next()?, next()?, next()?])
}

/// The vertices of a face, counted from 0; in the file they count from 1, or backward from -1.
fn face<'a>(rest: &'a str, count: usize, corners: &mut Vec<u32>) -> Result<(), Fault<'a>> {
    corners.clear();
    for word in rest.split_whitespace() {
        if corners.len() > MOST_TRIANGLES + 2 {
            return Err(too_many().into());
        }
        let number = word.split('/').next().unwrap_or_default();
        let Ok(number) = number.parse::<i64>() else {
            let shown: String = word.chars().take(20).collect();
            let what = format!("`{shown}` is no corner of a face");
            let help = "numbers of vertices, as in `f 1 2 3` or `f 1/1/1 2/2/1 3/3/1`";
            let error = MeshError::new(what, help);
            return Err(Fault::of(error, word));
        };
        let at = match number {
            1.. => number - 1,
            _ => (count as i64).saturating_add(number),
        };
        if number == 0 || !(0..count as i64).contains(&at) {
            let what = match number {
                0 => "a face has the vertex 0, and indices begin at 1".to_owned(),
                _ => format!("a face has the vertex {number}, and {count} are above it"),
            };
            let help = match count {
                0 => "lines of `v X Y Z` before those of faces".to_owned(),
                _ => format!("a number from 1 to {count}, or from -{count} to -1"),
            };
            let error = MeshError::new(what, help);
            return Err(Fault::of(error, word));
        }
        corners.push(at as u32);
    }
    Ok(())
}
