//! The header of a PLY file: which elements follow, and how their numbers are written.

use super::error::MeshError;

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A type of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of one.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// A property of an element: a number, or a list of as many as its first number says.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    /// The type of the list's length, if it is one.
    pub(super) list: Option<Scalar>,
    pub(super) kind: Scalar,
}

/// A kind of record that follows the header.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Bytes of a record at least; in text, each number and each list takes one.
    pub(super) fn least_bytes(&self, format: Format) -> u64 {
        let of = |property: &Property| match format {
            Format::Ascii => 1,
            _ => property.list.unwrap_or(property.kind).size() as u64,
        };
        self.properties.iter().map(of).sum()
    }
}

/// A header, and where its body begins.
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
    pub(super) body: usize,
    /// Lines of the header.
    pub(super) lines: usize,
}

/// Lines of a header at most.
const MOST_LINES: usize = 1000;

/// Reads a header.
pub(super) fn header(bytes: &[u8]) -> Result<Header, MeshError> {
    let help = "a header of `ply`, `format …`, `element …` and `property …`, then `end_header`";
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut body = 0;
    for (line, number) in bytes.split_inclusive(|byte| *byte == b'\n').zip(1..) {
        body += line.len();
        let refuse = |what: &str| Err(MeshError::new(what, help).at(number));
        if number > MOST_LINES {
            return refuse("the header has more than 1000 lines");
        }
        // Whatever is no header is not to be shown at length.
        let text = String::from_utf8_lossy(&line[..line.len().min(200)]);
        let words: Vec<&str> = text.split_whitespace().collect();
        match (number, words.as_slice()) {
            (1, ["ply"]) => {}
            (1, _) => return refuse("the file does not begin with `ply`"),
            (_, [] | ["comment" | "obj_info", ..]) => {}
            (_, ["format", name, _]) => {
                format = Some(match *name {
                    "ascii" => Format::Ascii,
                    "binary_little_endian" => Format::LittleEndian,
                    "binary_big_endian" => Format::BigEndian,
                    _ => {
                        return refuse(
                            "the format is none of ascii, binary_little_endian and binary_big_endian",
                        );
                    }
                });
            }
            (_, ["element", name, count]) => {
                let Ok(count) = count.parse() else {
                    return refuse(&format!("`{count}` is no count of elements"));
                };
                elements.push(Element {
                    name: (*name).to_owned(),
                    count,
                    properties: Vec::new(),
                });
            }
            (_, ["property", kinds @ .., name]) => {
                let (list, kind) = match kinds {
                    [kind] => (None, *kind),
                    ["list", length, kind] => (Some(*length), *kind),
                    _ => return refuse("the property has no type"),
                };
                let list = list.map(|it| Scalar::of(it).ok_or(it)).transpose();
                let (list, kind) = match (list, Scalar::of(kind).ok_or(kind)) {
                    (Ok(list), Ok(kind)) => (list, kind),
                    (Err(name), _) | (_, Err(name)) => {
                        return refuse(&format!("`{name}` is no type of numbers"));
                    }
                };
                let Some(element) = elements.last_mut() else {
                    return refuse("a property stands before any element");
                };
                let name = (*name).to_owned();
                element.properties.push(Property { name, list, kind });
            }
            (_, ["end_header"]) => {
                let Some(format) = format else {
                    return refuse("the header ends without a format");
                };
                return Ok(Header {
                    format,
                    elements,
                    body,
                    lines: number,
                });
            }
            _ => {
                let shown: String = text.trim_end().chars().take(40).collect();
                return refuse(&format!("`{shown}` is no line of a PLY header"));
            }
        }
    }
    Err(MeshError::new("the file ends in its header", help))
}
