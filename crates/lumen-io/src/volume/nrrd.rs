//! NRRD: a header of `field: value` lines up to an empty one, the numbers behind it (.nrrd) or in a file of their own (.nhdr).
//!
//! Kindlmann, "Definition of NRRD File Format" (teem). The directions of its axes are steps, spacing included, in the space
//! that it names: left-posterior-superior and right-anterior-superior are known here. Of more than three axes those of one entry
//! do not count; the first may be the layers of a segmentation, as 3D Slicer writes them with the names of its segments. Other
//! axes, as colours or time, are not read. There is no crate of some standing that reads it.

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::error::Feature;
use super::super::numbers::Scalar;
use super::super::offer::LabelName;
use super::super::problem::ScanProblem;
use super::super::text;
use super::super::warnings::{ScanWarning, Warning};
use super::axes::{list, ras_to_lps, silent};
use super::error::ScanError;
use super::lines::lines;
use super::numbers::{Layout, Packing};
use super::outline::{Layers, Outline, Segment};
use super::parts::{Head, named};
use lumen_volume::{Geometry, VolumeError};

const FORMAT: &str = "NRRD";
/// Axes that are looked at, and segments.
const MOST_AXES: usize = 8;
const MOST_SEGMENTS: usize = 4096;

/// What a header says, and where it ends.
struct Header<'a> {
    fields: Vec<(String, &'a str)>,
    /// What the writer has added, `key:=value`.
    remarks: Vec<(&'a str, &'a str)>,
    length: usize,
}

impl<'a> Header<'a> {
    fn parse(bytes: &'a [u8]) -> Result<Self, ScanError> {
        let (mut fields, mut remarks, mut length) = (Vec::new(), Vec::new(), 0);
        for (line, end) in lines(bytes, 0) {
            length = end;
            let is_remark = line.starts_with(b"#") || line.windows(2).any(|pair| pair == b":=");
            let line = match std::str::from_utf8(line) {
                Ok(line) => line.trim_end_matches('\r'),
                // In whatever letters a writer has put it.
                Err(_) if is_remark => continue,
                Err(_) => return Err(Self::endless()),
            };
            if line.is_empty() {
                return Ok(Self { fields, remarks, length });
            }
            // A field; what begins with a cross is a remark, too.
            if line.starts_with('#') {
                continue;
            }
            if let Some((key, value)) = line.split_once(":=") {
                remarks.push((key.trim(), value.trim()));
            } else if let Some((key, value)) = line.split_once(": ") {
                // Some fields are written with and without the space in their name.
                fields.push((key.to_ascii_lowercase().replace(' ', ""), value.trim()));
            }
        }
        // A header of its own may end with its last line.
        if length == bytes.len() { Ok(Self { fields, remarks, length }) } else { Err(Self::endless()) }
    }

    fn endless() -> ScanError {
        ScanError::malformed(FORMAT, ScanProblem::EndlessHeader)
    }

    fn get(&self, key: &str) -> Option<&'a str> {
        self.fields.iter().find(|(known, _)| known == key).map(|&(_, value)| value)
    }

    fn need(&self, key: &'static str) -> Result<&'a str, ScanError> {
        self.get(key).ok_or_else(|| ScanError::malformed(FORMAT, ScanProblem::HeaderLacks { key }))
    }

    fn remark(&self, key: &str) -> Option<&'a str> {
        self.remarks.iter().find(|(known, _)| *known == key).map(|&(_, value)| value)
    }

    /// A list of `count` numbers.
    fn numbers(&self, key: &'static str, count: usize) -> Result<Option<Vec<f64>>, ScanError> {
        let problem = || ScanError::malformed(FORMAT, ScanProblem::NotNumbers { key, count });
        self.get(key).map(|value| list(value).filter(|found| found.len() == count).ok_or_else(problem)).transpose()
    }

    /// The segments of a segmentation: layer, label, name and colour of each.
    fn segments(&self) -> Vec<Segment> {
        let segment = |number: usize| {
            let get = |what: &str| self.remark(&format!("Segment{number}_{what}"));
            let whole = |what: &str| get(what).and_then(|value| value.parse::<u32>().ok());
            let name = get("Name").or_else(|| get("ID"))?.chars().take(128).collect();
            let (layer, value) = (whole("Layer").unwrap_or(0) as usize, whole("LabelValue").unwrap_or(1).into());
            Some(Segment { layer, named: LabelName { value, name, colour: get("Color").and_then(colour) } })
        };
        (0..MOST_SEGMENTS).map_while(segment).collect()
    }
}

/// A colour by its three parts, each from 0 to 1.
fn colour(text: &str) -> Option<[u8; 3]> {
    let parts: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let parts: [f64; 3] = parts.try_into().ok()?;
    let is_colour = parts.iter().all(|part| (0.0..=1.0).contains(part));
    is_colour.then(|| parts.map(|part| (255.0 * part).round() as u8))
}

/// The axes of a grid among those of a file.
struct Grid {
    /// The numbers of the three.
    axes: [usize; 3],
    size: [usize; 3],
    /// How many layers lie in each other, one number of each after another.
    layers: usize,
}

impl Grid {
    fn of(header: &Header) -> Result<Self, ScanError> {
        let refused = || ScanError::unsupported(FORMAT, Feature::NotThreeDimensions);
        let count = header.need("dimension")?.parse().ok().filter(|count| (3..=MOST_AXES).contains(count));
        let count: usize = count.ok_or_else(refused)?;
        header.need("sizes")?;
        let sizes = header.numbers("sizes", count)?.unwrap_or_default();
        let has_direction = |axis: usize| match header.get("spacedirections") {
            Some(text) => vectors(text).is_none_or(|vectors| vectors.get(axis).is_some_and(Option::is_some)),
            None => true,
        };
        let mut axes: Vec<usize> = (0..count).filter(|&axis| has_direction(axis)).collect();
        while let Some(at) = axes.iter().rposition(|&axis| sizes[axis] == 1.0).filter(|_| axes.len() > 3) {
            axes.remove(at);
        }
        let axes: [usize; 3] = axes.try_into().map_err(|_| refused())?;
        let others = (0..count).filter(|axis| !axes.contains(axis) && sizes[*axis] != 1.0);
        let layers = match others.collect::<Vec<_>>()[..] {
            [] => 1,
            [0] if !header.segments().is_empty() => sizes[0] as usize,
            _ => return Err(ScanError::unsupported(FORMAT, Feature::MoreDimensions)),
        };
        Ok(Self { axes, size: axes.map(|axis| sizes[axis] as usize), layers })
    }
}

/// A list of vectors, `none` for those that are none; `None` where it is no such list.
fn vectors(text: &str) -> Option<Vec<Option<[f64; 3]>>> {
    let (mut found, mut rest) = (Vec::new(), text.trim_start());
    while !rest.is_empty() && found.len() <= MOST_AXES {
        let end = if rest.starts_with('(') { rest.find(')')? + 1 } else { rest.find([' ', '(']).unwrap_or(rest.len()) };
        let (vector, after) = rest.split_at(end);
        // Of a space of more axes the first three are the body's.
        found.push(if vector == "none" { None } else { Some(*list(vector)?.first_chunk()?) });
        rest = after.trim_start();
    }
    Some(found)
}

/// The file in which the numbers stand, where it is not the header's own.
pub(super) fn data_name(bytes: &[u8]) -> Option<String> {
    Header::parse(bytes).ok()?.get("datafile").map(str::to_owned)
}

/// The type that a file calls `name`.
fn scalar(name: &str) -> Option<Scalar> {
    Some(match name {
        "signed char" | "int8" | "int8_t" => Scalar::I8,
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => Scalar::U8,
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => Scalar::I16,
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => Scalar::U16,
        "int" | "signed int" | "int32" | "int32_t" => Scalar::I32,
        "uint" | "unsigned int" | "uint32" | "uint32_t" => Scalar::U32,
        "longlong" | "long long" | "long long int" | "signed long long" | "int64" | "int64_t" => Scalar::I64,
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => Scalar::U64,
        "float" => Scalar::F32,
        "double" => Scalar::F64,
        _ => return None,
    })
}

/// What the header's unit of length is in mm; 1 where it has none, or one that is no length of a body, which is told.
fn unit(header: &Header, warnings: &mut Vec<Warning>) -> f64 {
    let Some(units) = header.get("spaceunits").or_else(|| header.get("units")) else { return 1.0 };
    let mut names = units.split('"').filter(|name| !name.trim().is_empty());
    let first = names.next().unwrap_or_default().trim();
    let scale = match first {
        "" | "mm" | "millimeter" | "millimetre" => 1.0,
        "cm" => 10.0,
        "m" => 1000.0,
        "um" | "\u{b5}m" | "\u{3bc}m" => 1e-3,
        _ => f64::NAN,
    };
    if scale.is_nan() || names.any(|name| name.trim() != first) {
        let quoted = text::quoted(units.as_bytes());
        warnings.push(ScanWarning::UnknownUnit { format: FORMAT.to_owned(), unit: quoted }.into());
        return 1.0;
    }
    scale
}

/// The place of the grid, its axes, and what is to be said about it.
fn geometry(header: &Header, grid: &Grid) -> Result<(Geometry, Axes, Vec<Warning>), ScanError> {
    let count = header.need("dimension")?.parse().unwrap_or(3);
    let steps = match header.get("spacedirections") {
        Some(text) => {
            let problem = || ScanError::malformed(FORMAT, ScanProblem::NotNumbers { key: "spacedirections", count: 9 });
            let vectors = vectors(text).filter(|vectors| vectors.len() == count).ok_or_else(problem)?;
            let [x, y, z] = grid.axes.map(|axis| vectors[axis].map(DVec3::from).ok_or_else(problem));
            DMat3::from_cols(x?, y?, z?)
        }
        None => {
            let spacings = header.numbers("spacings", count)?;
            let spacing = spacings.map_or([1.0; 3], |spacings| grid.axes.map(|axis| spacings[axis]));
            DMat3::from_diagonal(DVec3::from(spacing))
        }
    };
    let origin = match header.get("spaceorigin") {
        Some(text) => {
            let problem = || ScanError::malformed(FORMAT, ScanProblem::NotNumbers { key: "spaceorigin", count: 3 });
            list(text).and_then(|origin| origin.first_chunk().copied()).map(DVec3::from).ok_or_else(problem)?
        }
        None => DVec3::ZERO,
    };
    let size = grid.size;
    let (mut warnings, space) = (Vec::new(), header.get("space").map(str::to_ascii_lowercase));
    let mut axes = Axes::Lps;
    let (steps, origin) = match space.as_deref().map(|space| space.trim_end_matches("-time")) {
        Some("left-posterior-superior" | "lps") => (steps, origin),
        Some("right-anterior-superior" | "ras") => ras_to_lps(steps, origin),
        Some("left-anterior-superior" | "las") => {
            let turn = DVec3::new(1.0, -1.0, 1.0);
            (DMat3::from_diagonal(turn) * steps, turn * origin)
        }
        _ => {
            axes = Axes::Unknown;
            warnings.push(silent(FORMAT));
            (steps, origin)
        }
    };
    let scale = unit(header, &mut warnings);
    Ok((Geometry::from_steps(size, steps * scale, origin * scale).map_err(VolumeError::from)?, axes, warnings))
}

/// What the header in file `at` says.
pub(super) fn outline(at: usize, files: &[Head]) -> Result<Outline, ScanError> {
    let header = Header::parse(files[at].bytes)?;
    let grid = Grid::of(&header)?;
    let (geometry, axes, warnings) = geometry(&header, &grid)?;
    let name = header.need("type")?;
    let scalar = scalar(name)
        .ok_or_else(|| ScanError::unsupported(FORMAT, Feature::NumberType { kind: text::quoted(name.as_bytes()) }))?;
    let layout = Layout::new(FORMAT, grid.size, scalar, header.get("endian") == Some("big"))?.times(grid.layers)?;
    let (file, begin) = match header.get("datafile") {
        None => (at, header.length),
        Some(name) if name.starts_with("LIST") || name.contains('%') => {
            return Err(ScanError::unsupported(FORMAT, Feature::FileASlice));
        }
        Some(name) => (named(files, name, FORMAT)?, 0),
    };
    let packing = match header.need("encoding")?.to_ascii_lowercase().as_str() {
        "raw" => Packing::Plain,
        "gzip" | "gz" => Packing::Gzip,
        "text" | "txt" | "ascii" => Packing::Text,
        other => {
            return Err(ScanError::unsupported(FORMAT, Feature::Encoding { name: text::quoted(other.as_bytes()) }));
        }
    };
    let skip = |key| header.get(key).map_or(Ok(0), str::parse::<i64>).unwrap_or(0);
    // Lines are skipped as they stand in the file, bytes in what it unfolds to; -1 is all before the numbers.
    let lines = usize::try_from(skip("lineskip")).unwrap_or(0);
    let known = &files[file].bytes[begin..];
    let mut ends = known.iter().enumerate().filter(|&(_, &byte)| byte == b'\n').map(|(at, _)| at + 1);
    let start = begin + if lines == 0 { 0 } else { ends.nth(lines - 1).unwrap_or(known.len()) };
    let start = start as u64;
    let skipped = match skip("byteskip") {
        -1 => (files[file].length - start).saturating_sub(layout.bytes()),
        skipped => u64::try_from(skipped).unwrap_or(0),
    };
    let layers = Layers { count: grid.layers, segments: header.segments(), choice: None };
    Ok(Outline { packing, file, start, skipped, axes, warnings, layers, ..Outline::new(FORMAT, geometry, layout) })
}
