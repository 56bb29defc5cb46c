//! NRRD: a header of `field: value` lines up to an empty one, the numbers behind it (.nrrd) or in a file of their own (.nhdr).
//!
//! Kindlmann, "Definition of NRRD File Format" (teem). The directions of its axes are steps, spacing included, in the space
//! that it names: left-posterior-superior and right-anterior-superior are known here. Volumes of more than three axes, as
//! colours or time, are not read. There is no crate of some standing that reads it.

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::error::Feature;
use super::super::numbers::Scalar;
use super::super::problem::ScanProblem;
use super::super::text;
use super::super::warnings::{ScanWarning, Warning};
use super::axes::{numbers, ras_to_lps, silent};
use super::error::ScanError;
use super::lines::lines;
use super::numbers::{Layout, Packing};
use super::outline::Outline;
use super::parts::{Head, named};
use lumen_volume::{Geometry, VolumeError};

const FORMAT: &str = "NRRD";

/// What a header says, and where it ends.
struct Header<'a> {
    fields: Vec<(String, &'a str)>,
    length: usize,
}

impl<'a> Header<'a> {
    fn parse(bytes: &'a [u8]) -> Result<Self, ScanError> {
        let (mut fields, mut length) = (Vec::new(), 0);
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
                return Ok(Self { fields, length });
            }
            // A field; `key:=value` is a remark of the writer's, and so is what begins with a cross.
            if let Some((key, value)) = line.split_once(": ")
                && !line.starts_with('#')
            {
                // Some fields are written with and without the space in their name.
                fields.push((key.to_ascii_lowercase().replace(' ', ""), value.trim()));
            }
        }
        // A header of its own may end with its last line.
        if length == bytes.len() { Ok(Self { fields, length }) } else { Err(Self::endless()) }
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

    fn numbers<const N: usize>(&self, key: &'static str) -> Result<Option<[f64; N]>, ScanError> {
        let problem = || ScanError::malformed(FORMAT, ScanProblem::NotNumbers { key, count: N });
        self.get(key).map(|value| numbers(value).ok_or_else(problem)).transpose()
    }
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
fn geometry(header: &Header, size: [usize; 3]) -> Result<(Geometry, Axes, Vec<Warning>), ScanError> {
    let steps = match header.numbers::<9>("spacedirections")? {
        Some(columns) => DMat3::from_cols_array(&columns),
        None => {
            let spacing = header.numbers::<3>("spacings")?.unwrap_or([1.0; 3]);
            DMat3::from_diagonal(DVec3::from(spacing))
        }
    };
    let origin = DVec3::from(header.numbers::<3>("spaceorigin")?.unwrap_or_default());
    let (mut warnings, space) = (Vec::new(), header.get("space").map(str::to_ascii_lowercase));
    let mut axes = Axes::Lps;
    let (steps, origin) = match space.as_deref() {
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
    if header.need("dimension")? != "3" {
        return Err(ScanError::unsupported(FORMAT, Feature::NotThreeDimensions));
    }
    let missing = || ScanError::malformed(FORMAT, ScanProblem::HeaderLacks { key: "sizes" });
    let size = header.numbers::<3>("sizes")?.ok_or_else(missing)?.map(|n| n as usize);
    let (geometry, axes, warnings) = geometry(&header, size)?;
    let name = header.need("type")?;
    let scalar = scalar(name)
        .ok_or_else(|| ScanError::unsupported(FORMAT, Feature::NumberType { kind: text::quoted(name.as_bytes()) }))?;
    let layout = Layout::new(FORMAT, size, scalar, header.get("endian") == Some("big"))?;
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
    let (is_ct, scaling) = (false, [1.0, 0.0]);
    Ok(Outline { format: FORMAT, geometry, layout, packing, file, start, skipped, scaling, axes, is_ct, warnings })
}
