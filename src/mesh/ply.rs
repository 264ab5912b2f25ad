//! PLY (Turk 1994): vertices and polygons, as text or as binary numbers.

use super::build::{Builder, too_many};
use super::error::MeshError;
use super::ply_header::{Element, Format, Property, Scalar, header};
use super::{MOST_TRIANGLES, MOST_VERTICES};

/// Names of the list of a face's corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Reads the whole file.
pub(super) fn read(bytes: &[u8]) -> Result<Builder, MeshError> {
    let header = header(bytes)?;
    let mut built = Builder::default();
    let mut numbers = Numbers {
        rest: &bytes[header.body..],
        line: &[],
        line_bytes: 0,
        number: header.lines,
        format: header.format,
        whole: bytes.len(),
        record: header.body,
        last: header.body,
    };
    for element in &header.elements {
        if element.properties.is_empty() {
            continue;
        }
        let count = element.count;
        let least = element.least_bytes(header.format).saturating_mul(count);
        if least > numbers.rest.len() as u64 {
            let left = numbers.rest.len();
            let what = format!(
                "the header names {count} records of `{}`, at least {least} bytes, and {left} follow",
                element.name
            );
            let error = MeshError::new(what, "a whole file");
            return Err(match header.format {
                Format::Ascii => error,
                _ => error.at_byte(numbers.byte()),
            });
        }
        match element.name.as_str() {
            "vertex" => vertices(element, &mut numbers, &mut built)?,
            "face" => faces(element, &mut numbers, &mut built)?,
            _ => {
                for _ in 0..count {
                    numbers.begin()?;
                    for property in &element.properties {
                        numbers.pass(property)?;
                    }
                }
            }
        }
    }
    Ok(built)
}

fn vertices(
    element: &Element,
    numbers: &mut Numbers,
    built: &mut Builder,
) -> Result<(), MeshError> {
    if element.count > MOST_VERTICES as u64 {
        let what = format!("there are {} vertices", element.count);
        return Err(MeshError::new(what, format!("at most {MOST_VERTICES}")));
    }
    let mut axes = [usize::MAX; 3];
    for (axis, name) in axes.iter_mut().zip(["x", "y", "z"]) {
        let mut properties = element.properties.iter();
        let found = properties.position(|it| it.name == name && it.list.is_none());
        *axis = found.ok_or_else(|| {
            let what = format!("vertices have no `{name}`");
            MeshError::new(what, "`property float x`, `y` and `z`")
        })?;
    }
    built.reserve(element.count as usize)?;
    for _ in 0..element.count {
        numbers.begin()?;
        let mut place = [0.0; 3];
        for (at, property) in element.properties.iter().enumerate() {
            match axes.iter().position(|axis| *axis == at) {
                Some(axis) => place[axis] = numbers.next(property.kind)? as f32,
                None => numbers.pass(property)?,
            }
        }
        let done = built.vertex(place);
        done.map_err(|error| numbers.of_record(error))?;
    }
    Ok(())
}

fn faces(element: &Element, numbers: &mut Numbers, built: &mut Builder) -> Result<(), MeshError> {
    let is_corners = |it: &Property| it.list.is_some() && CORNERS.contains(&it.name.as_str());
    let at = element.properties.iter().position(is_corners);
    let at = at.ok_or_else(|| {
        let help = "`property list uchar int vertex_indices`";
        MeshError::new("faces have no list of corners", help)
    })?;
    let mut corners = Vec::new();
    for _ in 0..element.count {
        numbers.begin()?;
        for (index, property) in element.properties.iter().enumerate() {
            if index != at {
                numbers.pass(property)?;
                continue;
            }
            let count = numbers.length(property)?;
            if count > MOST_TRIANGLES as u64 + 2 {
                return Err(numbers.of_last(too_many()));
            }
            corners.clear();
            let reserved = corners.try_reserve(count as usize);
            reserved.map_err(|_| MeshError::no_memory(count, "corners of a face"))?;
            for _ in 0..count {
                let number = numbers.next(property.kind)?;
                let vertices = built.vertex_count();
                if !(number >= 0.0 && number < vertices as f64 && number.fract() == 0.0) {
                    let what =
                        format!("a face has the vertex {number}, counted from 0, of {vertices}");
                    let help = "vertices that the file has, before the faces";
                    return Err(numbers.of_last(MeshError::new(what, help)));
                }
                corners.push(number as u32);
            }
            let done = built.polygon(&corners);
            done.map_err(|error| numbers.of_record(error))?;
        }
    }
    Ok(())
}

/// The numbers of the body, one after the other.
struct Numbers<'a> {
    rest: &'a [u8],
    /// What is left of the record's line.
    line: &'a [u8],
    /// Bytes of that line.
    line_bytes: usize,
    /// Of the line.
    number: usize,
    format: Format,
    /// Bytes of the file.
    whole: usize,
    /// Byte of the file that the record begins at.
    record: usize,
    /// Byte of the file that the last number begins at.
    last: usize,
}

impl<'a> Numbers<'a> {
    /// Begins a record: in text, a line that is not empty.
    fn begin(&mut self) -> Result<(), MeshError> {
        self.record = self.byte();
        if self.format != Format::Ascii {
            return Ok(());
        }
        loop {
            if self.rest.is_empty() {
                let error = MeshError::new("the file ends too early", "a whole file");
                return Err(error.at(self.number));
            }
            self.record = self.byte();
            let end = self.rest.iter().position(|byte| *byte == b'\n');
            let end = end.unwrap_or(self.rest.len());
            (self.line, self.rest) = self.rest.split_at(end);
            self.line_bytes = end;
            self.rest = self.rest.get(1..).unwrap_or_default();
            self.number += 1;
            if !self.line.trim_ascii().is_empty() {
                return Ok(());
            }
        }
    }

    /// The byte of the file that follows.
    fn byte(&self) -> usize {
        self.whole - self.rest.len()
    }

    /// The error, of the record.
    fn of_record(&self, error: MeshError) -> MeshError {
        match self.format {
            Format::Ascii => error.at(self.number),
            _ => error.at_byte(self.record),
        }
    }

    /// The error, of the number that was read last.
    fn of_last(&self, error: MeshError) -> MeshError {
        match self.format {
            Format::Ascii => error.at_column(self.number, self.last - self.record + 1),
            _ => error.at_byte(self.last),
        }
    }

    /// The next number of the record.
    fn next(&mut self, kind: Scalar) -> Result<f64, MeshError> {
        match self.format {
            Format::Ascii => self.word(),
            _ => self.binary(kind),
        }
    }

    fn word(&mut self) -> Result<f64, MeshError> {
        let start = self.line.trim_ascii_start();
        // What is left of the line ends where the rest of the file begins, but for its end.
        let end_of_line = self.record + self.line_bytes;
        self.last = end_of_line - start.len();
        let end = start.iter().position(u8::is_ascii_whitespace);
        let (word, line) = start.split_at(end.unwrap_or(start.len()));
        self.line = line;
        if word.is_empty() {
            let what = "the line has fewer numbers than the header says";
            return Err(self.of_record(MeshError::new(what, "a number for each property")));
        }
        let number = std::str::from_utf8(word)
            .ok()
            .and_then(|it| it.parse().ok());
        number.ok_or_else(|| {
            let word = String::from_utf8_lossy(&word[..word.len().min(20)]);
            self.of_last(MeshError::new(format!("`{word}` is no number"), "a number"))
        })
    }

    fn binary(&mut self, kind: Scalar) -> Result<f64, MeshError> {
        self.last = self.byte();
        let Some((bytes, rest)) = self.rest.split_at_checked(kind.size()) else {
            return Err(self.of_last(MeshError::new("the file ends too early", "a whole file")));
        };
        self.rest = rest;
        let mut low_first = [0; 8];
        low_first[..bytes.len()].copy_from_slice(bytes);
        if self.format == Format::BigEndian {
            low_first[..bytes.len()].reverse();
        }
        let word = u64::from_le_bytes(low_first);
        let half = word as u32;
        Ok(match kind {
            Scalar::I8 => f64::from((word as u8).cast_signed()),
            Scalar::U8 => f64::from(word as u8),
            Scalar::I16 => f64::from((word as u16).cast_signed()),
            Scalar::U16 => f64::from(word as u16),
            Scalar::I32 => f64::from(half.cast_signed()),
            Scalar::U32 => f64::from(half),
            Scalar::F32 => f64::from(f32::from_bits(half)),
            Scalar::F64 => f64::from_bits(word),
        })
    }

    /// The length of a list, for which there are bytes.
    fn length(&mut self, property: &Property) -> Result<u64, MeshError> {
        let length = self.next(property.list.unwrap_or(property.kind))?;
        let (left, each) = match self.format {
            Format::Ascii => (self.line.len(), 2),
            _ => (self.rest.len(), property.kind.size()),
        };
        if length >= 0.0 && length.fract() == 0.0 && length * each as f64 <= left as f64 {
            return Ok(length as u64);
        }
        let what = format!("a list has {length} items, and {left} bytes are left for them");
        Err(self.of_last(MeshError::new(what, "a list as long as it says")))
    }

    /// Passes over a property.
    fn pass(&mut self, property: &Property) -> Result<(), MeshError> {
        let count = match property.list {
            Some(_) => self.length(property)?,
            None => 1,
        };
        for _ in 0..count {
            self.next(property.kind)?;
        }
        Ok(())
    }
}
