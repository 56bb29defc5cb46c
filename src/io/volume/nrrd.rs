//! NRRD: a header of `field: value` lines up to an empty one, the numbers behind it (.nrrd) or in a file of their own (.nhdr).
//!
//! Kindlmann, "Definition of NRRD File Format" (teem). The directions of its axes are steps, spacing included, in the space
//! that it names: left-posterior-superior and right-anterior-superior are known here. Volumes of more than three axes, as
//! colours or time, are not read. There is no crate of some standing that reads it.

use glam::{DMat3, DVec3};

use super::super::numbers::Scalar;
use super::super::text;
use super::axes::{numbers, ras_to_lps};
use super::error::ScanError;
use super::numbers::{Layout, Packing};
use super::{Part, Scan, named};
use crate::volume::{Geometry, Grid, VolumeError};

const FORMAT: &str = "NRRD";
/// Lines of a header at most.
const MOST_LINES: usize = 1000;

/// What a header says, and where it ends.
struct Header<'a> {
    fields: Vec<(String, &'a str)>,
    length: usize,
}

impl<'a> Header<'a> {
    fn parse(bytes: &'a [u8]) -> Result<Self, ScanError> {
        let (mut fields, mut length) = (Vec::new(), 0);
        for _ in 0..MOST_LINES {
            let rest = &bytes[length..];
            let line = rest.iter().position(|&byte| byte == b'\n').map_or(rest, |end| &rest[..end]);
            length = bytes.len().min(length + line.len() + 1);
            let line = std::str::from_utf8(line).map_err(|_| Self::endless())?.trim_end_matches('\r');
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
            if length == bytes.len() {
                // A header of its own may end with its last line.
                return Ok(Self { fields, length });
            }
        }
        Err(Self::endless())
    }

    fn endless() -> ScanError {
        ScanError::malformed(FORMAT, "its header does not end with an empty line")
    }

    fn get(&self, key: &str) -> Option<&'a str> {
        self.fields.iter().find(|(known, _)| known == key).map(|&(_, value)| value)
    }

    fn need(&self, key: &str) -> Result<&'a str, ScanError> {
        self.get(key).ok_or_else(|| ScanError::malformed(FORMAT, format!("its header has no \"{key}\"")))
    }

    fn numbers<const N: usize>(&self, key: &str) -> Result<Option<[f64; N]>, ScanError> {
        let problem = || ScanError::malformed(FORMAT, format!("\"{key}\" is not {N} numbers"));
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

/// The place of the grid, and what is to be said about it.
fn geometry(header: &Header, size: [usize; 3]) -> Result<(Geometry, Vec<String>), ScanError> {
    let steps = match header.numbers::<9>("spacedirections")? {
        Some(columns) => DMat3::from_cols_array(&columns),
        None => {
            let spacing = header.numbers::<3>("spacings")?.unwrap_or([1.0; 3]);
            DMat3::from_diagonal(DVec3::from(spacing))
        }
    };
    let origin = DVec3::from(header.numbers::<3>("spaceorigin")?.unwrap_or_default());
    let (mut warnings, space) = (Vec::new(), header.get("space").map(str::to_ascii_lowercase));
    let (steps, origin) = match space.as_deref() {
        Some("left-posterior-superior" | "lps") => (steps, origin),
        Some("right-anterior-superior" | "ras") => ras_to_lps(steps, origin),
        Some("left-anterior-superior" | "las") => {
            let turn = DVec3::new(1.0, -1.0, 1.0);
            (DMat3::from_diagonal(turn) * steps, turn * origin)
        }
        _ => {
            warnings
                .push("The NRRD file does not say which way the patient lies: its axes are taken as LPS.".to_owned());
            (steps, origin)
        }
    };
    Ok((Geometry::from_steps(size, steps, origin).map_err(VolumeError::from)?, warnings))
}

/// Reads the volume whose header is `part`.
pub(super) fn read(part: &Part, parts: &[Part]) -> Result<Scan, ScanError> {
    let header = Header::parse(part.bytes)?;
    if header.need("dimension")? != "3" {
        return Err(ScanError::unsupported(FORMAT, "other than three dimensions"));
    }
    let missing = || ScanError::malformed(FORMAT, "its header has no \"sizes\"");
    let size = header.numbers::<3>("sizes")?.ok_or_else(missing)?.map(|n| n as usize);
    let (geometry, warnings) = geometry(&header, size)?;
    let name = header.need("type")?;
    let scalar = scalar(name)
        .ok_or_else(|| ScanError::unsupported(FORMAT, format!("numbers of type {}", text::quoted(name.as_bytes()))))?;
    let layout = Layout::new(FORMAT, size, scalar, header.get("endian") == Some("big"))?;
    let bytes = match header.get("datafile") {
        None => &part.bytes[header.length..],
        Some(name) if name.starts_with("LIST") || name.contains('%') => {
            return Err(ScanError::unsupported(FORMAT, "a file for each slice"));
        }
        Some(name) => named(parts, name, FORMAT)?,
    };
    let packing = match header.need("encoding")?.to_ascii_lowercase().as_str() {
        "raw" => Packing::Plain,
        "gzip" | "gz" => Packing::Gzip,
        "text" | "txt" | "ascii" => Packing::Text,
        other => {
            return Err(ScanError::unsupported(FORMAT, format!("the encoding {}", text::quoted(other.as_bytes()))));
        }
    };
    let skip = |key| header.get(key).map_or(Ok(0), str::parse::<i64>).unwrap_or(0);
    // Lines are skipped as they stand in the file, bytes in what it unfolds to; -1 is all before the numbers.
    let lines = usize::try_from(skip("lineskip")).unwrap_or(0);
    let mut ends = bytes.iter().enumerate().filter(|&(_, &byte)| byte == b'\n').map(|(at, _)| at + 1);
    let start = if lines == 0 { 0 } else { ends.nth(lines - 1).unwrap_or(bytes.len()) };
    let bytes = &bytes[start..];
    let skipped = match skip("byteskip") {
        -1 => bytes.len().saturating_sub(layout.points.saturating_mul(scalar.size())) as u64,
        skipped => u64::try_from(skipped).unwrap_or(0),
    };
    let grid = Grid::new(geometry, layout.take(bytes, packing, skipped)?, 1.0, 0.0)?;
    Ok(Scan { grid, format: FORMAT, is_ct: false, warnings })
}
