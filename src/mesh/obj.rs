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
    let mut lines = bytes.split(|byte| *byte == b'\n').zip(1..);
    while let Some((line, number)) = lines.next() {
        let mut joined;
        let mut line = line.trim_ascii();
        while let Some(before) = line.strip_suffix(b"\\") {
            let Some((next, _)) = lines.next() else {
                line = before;
                break;
            };
            joined = [before, b" ", next.trim_ascii()].concat();
            line = &joined;
        }
        let text = String::from_utf8_lossy(line);
        let (word, rest) = match text.split_once(|c: char| c.is_whitespace()) {
            Some((word, rest)) => (word, rest.trim()),
            None => (&*text, ""),
        };
        match word {
            "v" => built.vertex(place(rest, number)?, number)?,
            "f" => {
                face(rest, built.vertex_count(), number, &mut corners)?;
                built.polygon(&corners, number)?;
            }
            "g" | "o" => {
                group = rest.to_owned();
                built.part(&group, &material).map_err(|e| e.at(number))?;
            }
            "usemtl" => {
                material = rest.to_owned();
                built.part(&group, &material).map_err(|e| e.at(number))?;
            }
            "" => {}
            word if word.starts_with('#') || IGNORED.contains(&word) => {}
            word => {
                let word: String = word.chars().take(20).collect();
                let what = format!("`{word}` begins no line of an OBJ file");
                let help = "lines of `v X Y Z`, then of `f A B C` with numbers of vertices";
                return Err(MeshError::new(what, help).at(number));
            }
        }
    }
    Ok(built)
}

fn place(rest: &str, line: usize) -> Result<[f32; 3], MeshError> {
    let mut numbers = rest.split_whitespace();
    let mut next = || {
        let word = numbers
            .next()
            .ok_or("a vertex has fewer than 3 coordinates".to_owned())?;
        word.parse::<f32>().map_err(|_| {
            let word: String = word.chars().take(20).collect();
            format!("`{word}` is no coordinate")
        })
    };
    let place = (|| Ok::<_, String>([next()?, next()?, next()?]))();
    place.map_err(|what| MeshError::new(what, "`v X Y Z` with three numbers").at(line))
}

/// The vertices of a face, counted from 0; in the file they count from 1, or backward from -1.
fn face(rest: &str, count: usize, line: usize, corners: &mut Vec<u32>) -> Result<(), MeshError> {
    corners.clear();
    for word in rest.split_whitespace() {
        if corners.len() > MOST_TRIANGLES + 2 {
            return Err(too_many().at(line));
        }
        let number = word.split('/').next().unwrap_or_default();
        let Ok(number) = number.parse::<i64>() else {
            let word: String = word.chars().take(20).collect();
            let what = format!("`{word}` is no corner of a face");
            let help = "numbers of vertices, as in `f 1 2 3` or `f 1/1/1 2/2/1 3/3/1`";
            return Err(MeshError::new(what, help).at(line));
        };
        let at = match number {
            1.. => number - 1,
            _ => count as i64 + number,
        };
        if number == 0 || !(0..count as i64).contains(&at) {
            let what = format!("a face has the vertex {number}, and {count} are above it");
            let help = match count {
                0 => "lines of `v X Y Z` before those of faces".to_owned(),
                _ => format!("a number from 1 to {count}, or from -{count} to -1"),
            };
            return Err(MeshError::new(what, help).at(line));
        }
        corners.push(at as u32);
    }
    Ok(())
}
