//! MetaImage: a header of `Key = Value` lines, the numbers behind it (.mha) or in a file of their own (.mhd).
//!
//! The format is described in ITK's "MetaIO documentation". Its coordinates are LPS, as all of ITK's are, where it has an
//! `AnatomicalOrientation`; what has none was written by others, and nothing is known of its axes. Each row of
//! `TransformMatrix` is the direction of an axis of the grid. `ElementSize` is the size of a voxel, and only where there is
//! no `ElementSpacing` their distance. There is no crate that reads it.

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::error::Feature;
use super::super::numbers::Scalar;
use super::super::problem::ScanProblem;
use super::super::text;
use super::super::warnings::{ScanWarning, Warning};
use super::axes::{list, silent};
use super::error::ScanError;
use super::lines::lines;
use super::numbers::{Layout, Packing};
use super::outline::Outline;
use super::parts::Head;
use super::parts::named;
use lumen_volume::{Geometry, VolumeError};

const FORMAT: &str = "MetaImage";
/// Axes that are looked at; all beyond the third have one entry.
const MOST_AXES: usize = 8;

/// What a header says, and where it ends.
struct Header<'a> {
    fields: Vec<(&'a str, &'a str)>,
    length: usize,
}

impl<'a> Header<'a> {
    fn parse(bytes: &'a [u8]) -> Result<Self, ScanError> {
        let mut fields = Vec::new();
        let start = bytes.len() - text::without_mark(bytes).len();
        for (line, length) in lines(bytes, start) {
            let Ok(line) = std::str::from_utf8(line) else { break };
            if let Some((key, value)) = line.split_once('=') {
                fields.push((key.trim(), value.trim()));
                if key.trim().eq_ignore_ascii_case("ElementDataFile") {
                    return Ok(Self { fields, length });
                }
            }
        }
        Err(ScanError::malformed(FORMAT, ScanProblem::NoDataFile { key: "ElementDataFile" }))
    }

    fn get(&self, key: &str) -> Option<&'a str> {
        self.fields.iter().find(|(known, _)| known.eq_ignore_ascii_case(key)).map(|&(_, value)| value)
    }

    fn is(&self, key: &str, value: &str) -> bool {
        self.get(key).is_some_and(|found| found.eq_ignore_ascii_case(value))
    }

    /// The first of `keys` that is there, as `count` numbers.
    fn numbers(&self, keys: &[&'static str], count: usize) -> Result<Option<Vec<f64>>, ScanError> {
        let Some((key, value)) = keys.iter().find_map(|&key| self.get(key).map(|value| (key, value))) else {
            return Ok(None);
        };
        let problem = || ScanError::malformed(FORMAT, ScanProblem::NotNumbers { key, count });
        list(value).filter(|found| found.len() == count).map(Some).ok_or_else(problem)
    }

    /// As [`numbers`](Self::numbers), one for each axis, of which the first three count.
    fn of_axes(&self, keys: &[&'static str], axes: usize) -> Result<Option<[f64; 3]>, ScanError> {
        Ok(self.numbers(keys, axes)?.and_then(|found| found.first_chunk().copied()))
    }

    /// The file that the numbers stand in; `None` for the header's own.
    fn data(&self) -> Option<&'a str> {
        self.get("ElementDataFile").filter(|name| !name.eq_ignore_ascii_case("LOCAL"))
    }
}

/// The file in which the numbers stand, where it is not the header's own.
pub(super) fn data_name(bytes: &[u8]) -> Option<String> {
    Header::parse(bytes).ok()?.data().map(str::to_owned)
}

/// The type that a file calls `name`.
fn scalar(name: &str) -> Option<Scalar> {
    Some(match name {
        "MET_CHAR" => Scalar::I8,
        "MET_UCHAR" => Scalar::U8,
        "MET_SHORT" => Scalar::I16,
        "MET_USHORT" => Scalar::U16,
        "MET_INT" | "MET_LONG" => Scalar::I32,
        "MET_UINT" | "MET_ULONG" => Scalar::U32,
        "MET_LONG_LONG" => Scalar::I64,
        "MET_ULONG_LONG" => Scalar::U64,
        "MET_FLOAT" => Scalar::F32,
        "MET_DOUBLE" => Scalar::F64,
        _ => return None,
    })
}

/// What the header's unit of length is in mm, and what is to be said where it is none.
fn unit(header: &Header) -> (f64, Vec<Warning>) {
    match header.get("DistanceUnits") {
        None | Some("?" | "" | "mm") => (1.0, Vec::new()),
        Some("cm") => (10.0, Vec::new()),
        Some("um") => (1e-3, Vec::new()),
        Some(other) => {
            let quoted = text::quoted(other.as_bytes());
            (1.0, vec![ScanWarning::UnknownUnit { format: FORMAT.to_owned(), unit: quoted }.into()])
        }
    }
}

/// What the header in file `at` says.
pub(super) fn outline(at: usize, files: &[Head]) -> Result<Outline, ScanError> {
    let header = Header::parse(files[at].bytes)?;
    let axes = header.get("NDims").map_or(Some(3), |n| n.parse().ok());
    let axes = axes.filter(|axes| (3..=MOST_AXES).contains(axes));
    let axes: usize = axes.ok_or_else(|| ScanError::unsupported(FORMAT, Feature::NotThreeDimensions))?;
    if header.get("ElementNumberOfChannels").is_some_and(|n| n != "1") {
        return Err(ScanError::unsupported(FORMAT, Feature::NumbersAVoxel));
    }
    let missing = |key| ScanError::malformed(FORMAT, ScanProblem::HeaderLacks { key });
    let sizes = header.numbers(&["DimSize"], axes)?.ok_or_else(|| missing("DimSize"))?;
    if sizes[3..].iter().any(|&along| along != 1.0) {
        return Err(ScanError::unsupported(FORMAT, Feature::MoreDimensions));
    }
    let size = [0, 1, 2].map(|axis| sizes[axis] as usize);
    let spacing = header.of_axes(&["ElementSpacing", "ElementSize"], axes)?.unwrap_or([1.0; 3]);
    let origin = header.of_axes(&["Offset", "Position", "Origin"], axes)?.unwrap_or_default();
    let rows = header.numbers(&["TransformMatrix", "Rotation", "Orientation"], axes * axes)?;
    let direction = rows.map_or(DMat3::IDENTITY, |rows| {
        DMat3::from_cols_array_2d(&[0, 1, 2].map(|row| [0, 1, 2].map(|column| rows[row * axes + column])))
    });
    let (scale, mut warnings) = unit(&header);
    // ITK writes three letters beside directions that are LPS, "???" where it does not know them.
    let orientation = header.get("AnatomicalOrientation").unwrap_or_default();
    let is_stated = orientation.len() == 3 && orientation.bytes().all(|letter| b"RLAPISrlapis".contains(&letter));
    let known = if is_stated { Axes::Lps } else { Axes::Unknown };
    if !is_stated {
        warnings.push(silent(FORMAT));
    }
    let steps = direction * DMat3::from_diagonal(spacing.into()) * scale;
    let geometry = Geometry::from_steps(size, steps, DVec3::from(origin) * scale);
    let geometry = geometry.map_err(VolumeError::from)?;
    let name = header.get("ElementType").ok_or_else(|| missing("ElementType"))?;
    let scalar = scalar(name)
        .ok_or_else(|| ScanError::unsupported(FORMAT, Feature::NumberType { kind: text::quoted(name.as_bytes()) }))?;
    let is_big_endian = header.is("BinaryDataByteOrderMSB", "True") || header.is("ElementByteOrderMSB", "True");
    let layout = Layout::new(FORMAT, size, scalar, is_big_endian)?;
    let (file, start) = match header.data() {
        None => (at, header.length as u64),
        Some(name) if name.starts_with("LIST") || name.contains('%') => {
            return Err(ScanError::unsupported(FORMAT, Feature::FileASlice));
        }
        Some(name) => (named(files, name, FORMAT)?, 0),
    };
    let packing = match (header.is("CompressedData", "True"), header.is("BinaryData", "False")) {
        (true, _) => Packing::Zlib,
        (false, true) => Packing::Text,
        (false, false) => Packing::Plain,
    };
    let skipped = match header.get("HeaderSize") {
        // The numbers stand at the end, whatever is before them.
        Some("-1") => (files[file].length - start).saturating_sub(layout.bytes()),
        Some(skipped) => skipped.parse().unwrap_or(0),
        None => 0,
    };
    let (axes, is_ct) = (known, header.is("Modality", "MET_MOD_CT"));
    Ok(Outline { packing, file, start, skipped, axes, is_ct, warnings, ..Outline::new(FORMAT, geometry, layout) })
}
