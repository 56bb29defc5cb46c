//! The header of a PLY file: its encoding, and its elements with their typed properties.

use super::super::error::{Counted, ReadError};
use super::super::numbers::Scalar;
use super::super::problem::{PlyProblem, TextProblem};
use super::super::text;
use super::malformed;
use lumen_mesh::arrays::Association;

/// The type that a header calls `name`.
fn scalar_type(name: &str) -> Option<Scalar> {
    Some(match name {
        "char" | "int8" => Scalar::I8,
        "uchar" | "uint8" => Scalar::U8,
        "short" | "int16" => Scalar::I16,
        "ushort" | "uint16" => Scalar::U16,
        "int" | "int32" => Scalar::I32,
        "uint" | "uint32" => Scalar::U32,
        "float" | "float32" => Scalar::F32,
        "double" | "float64" => Scalar::F64,
        _ => return None,
    })
}

#[derive(Debug, PartialEq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Scalar,
    /// The type of the length, if this is a list.
    pub(super) length: Option<Scalar>,
}

#[derive(Debug, PartialEq)]
pub(super) struct Element {
    pub(super) name: String,
    /// As the header claims it: nothing is allocated for it before the bytes are seen.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// What to call many of it.
    pub(super) fn plural(&self) -> Counted {
        match self.name.as_str() {
            "vertex" => Counted::Vertices,
            "face" => Counted::Faces,
            "tristrips" => Counted::Strips,
            name => Counted::Rows { name: text::quoted(name.as_bytes()) },
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

impl Encoding {
    pub(super) fn label(self) -> &'static str {
        match self {
            Self::Ascii => "PLY ascii",
            Self::Little => "PLY binary little-endian",
            Self::Big => "PLY binary big-endian",
        }
    }
}

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the numbers begin, in bytes and in lines.
    pub(super) body: usize,
    pub(super) body_line: usize,
}

/// Reads the header, which is text in every encoding.
pub(super) fn header(bytes: &[u8]) -> Result<Header, ReadError> {
    if !bytes.get(..3).is_some_and(|magic| magic.eq_ignore_ascii_case(b"ply")) {
        return Err(malformed(PlyProblem::Begin));
    }
    // Old Macintosh files end lines with a carriage return alone; then a line feed after it is a number's byte.
    let ending: &[u8] = match bytes.get(3..5) {
        Some(b"\r\n") => b"\r\n",
        Some([b'\r', _]) => b"\r",
        _ => b"\n",
    };
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let (mut at, mut line) = (0, 0);
    loop {
        let rest = &bytes[at..];
        let Some(length) = rest.windows(ending.len()).position(|part| part == ending) else {
            return Err(malformed(PlyProblem::NoEndHeader));
        };
        at += length + ending.len();
        line += 1;
        let row = String::from_utf8_lossy(&rest[..length]);
        // No line that means anything has more.
        let words: Vec<&str> = row.split_ascii_whitespace().take(6).collect();
        let property = |name: &str, kind: &str, length: Option<&str>| {
            let scalar = |kind: &str| {
                let unknown =
                    || ReadError::syntax("PLY", line, TextProblem::NoType { word: text::quoted(kind.as_bytes()) });
                scalar_type(kind).ok_or_else(unknown)
            };
            Ok(Property { name: name.to_owned(), kind: scalar(kind)?, length: length.map(scalar).transpose()? })
        };
        match words[..] {
            ["end_header"] => break,
            ["format", kind, _version] => {
                encoding = Some(match kind {
                    "ascii" => Encoding::Ascii,
                    "binary_little_endian" => Encoding::Little,
                    "binary_big_endian" => Encoding::Big,
                    _ => {
                        return Err(ReadError::syntax(
                            "PLY",
                            line,
                            PlyProblem::UnknownEncoding { word: text::quoted(kind.as_bytes()) },
                        ));
                    }
                });
            }
            ["element", name, count] => {
                let count = count.parse().map_err(|_| {
                    ReadError::syntax("PLY", line, TextProblem::NoCount { word: text::quoted(count.as_bytes()) })
                })?;
                elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
            }
            ["property", ref rest @ ..] => {
                let element =
                    elements.last_mut().ok_or_else(|| ReadError::syntax("PLY", line, PlyProblem::PropertyFirst))?;
                element.properties.push(match *rest {
                    ["list", length, kind, name] => property(name, kind, Some(length))?,
                    [kind, name] => property(name, kind, None)?,
                    _ => return Err(ReadError::syntax("PLY", line, PlyProblem::ShortProperty)),
                });
            }
            // Comments, obj_info and what later versions may add.
            _ => {}
        }
    }
    let encoding = encoding.ok_or_else(|| malformed(PlyProblem::NoEncoding))?;
    Ok(Header { encoding, elements, body: at, body_line: line + 1 })
}

/// What an element means to Lumen, with the place of the property that matters.
pub(super) enum Meaning {
    /// Vertices, with the places of x, y and z.
    Vertices([usize; 3]),
    /// Faces, one list of vertices each.
    Faces(usize),
    /// Triangle strips in one list, -1 between them.
    Strips(usize),
    Other,
}

impl Meaning {
    /// What arrays of the element are on.
    pub(super) fn on(&self) -> Option<Association> {
        match self {
            Self::Vertices(_) => Some(Association::Point),
            Self::Faces(_) => Some(Association::Triangle),
            Self::Strips(_) | Self::Other => None,
        }
    }
}

pub(super) fn meaning(element: &Element) -> Result<Meaning, ReadError> {
    let scalar = |name: &str| element.properties.iter().position(|p| p.name == name && p.length.is_none());
    let indices = || {
        let named = |p: &Property| p.name == "vertex_indices" || p.name == "vertex_index";
        element.properties.iter().position(|p| named(p) && p.length.is_some())
    };
    Ok(match element.name.as_str() {
        "vertex" => match (scalar("x"), scalar("y"), scalar("z")) {
            (Some(x), Some(y), Some(z)) => Meaning::Vertices([x, y, z]),
            _ => return Err(malformed(PlyProblem::NoCoordinates)),
        },
        "face" => indices().map_or(Meaning::Other, Meaning::Faces),
        "tristrips" => indices().map_or(Meaning::Other, Meaning::Strips),
        _ => Meaning::Other,
    })
}

/// Whether coordinates may have more digits than f32.
pub(super) fn has_doubles(header: &Header) -> bool {
    let vertices = header.elements.iter().filter(|element| element.name == "vertex");
    let is_double = |property: &Property| {
        property.kind == Scalar::F64 && matches!(property.name.to_ascii_lowercase().as_str(), "x" | "y" | "z")
    };
    header.encoding == Encoding::Ascii || vertices.flat_map(|element| &element.properties).any(is_double)
}
