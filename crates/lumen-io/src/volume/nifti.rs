//! NIfTI-1 and NIfTI-2: one file (.nii), packed by gzip (.nii.gz), or a header and its numbers (.hdr and .img).
//!
//! The standards are Cox et al., "NIfTI-1 Data Format" (2003), and its 64-bit successor (2011). Coordinates are RAS in the
//! unit that the header names, and are turned into LPS millimetres. Where a header has both, its quaternion (`qform`) is
//! taken if its matrix (`sform`) has no code, as the standard's own tools do, or is none that a grid can have. Volumes of more
//! than three axes are read where the others have one entry.
//!
//! Analyze 7.5, which NIfTI came from, has the same header without its last word, its slope and its place: always a header and
//! its numbers, in axes that nobody knows.
//!
//! The crate `nifti` is not used: it takes memory as a header claims it, and knows no NIfTI-2.

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::detect;
use super::super::error::Feature;
use super::super::numbers::Scalar;
use super::super::problem::ScanProblem;
use super::super::warnings::{ScanWarning, Warning};
use super::axes::{ras_to_lps, silent};
use super::error::ScanError;
use super::numbers::{Layout, Packing, first_unfolded, is_gzip};
use super::outline::Outline;
use super::parts::{Head, base_name, named};
use lumen_volume::{Geometry, VolumeError};

const FORMAT: &str = "NIfTI";
const SIZE_1: usize = 348;
const SIZE_2: usize = 540;

/// Where the fields of the two versions stand.
struct Places {
    dimensions: usize,
    data_type: usize,
    spacings: usize,
    offset: usize,
    slope: usize,
    intercept: usize,
    qform: usize,
    sform: usize,
    quaternion: usize,
    rows: usize,
    units: usize,
}

const PLACES_1: Places = Places {
    dimensions: 40,
    data_type: 70,
    spacings: 76,
    offset: 108,
    slope: 112,
    intercept: 116,
    qform: 252,
    sform: 254,
    quaternion: 256,
    rows: 280,
    units: 123,
};

const PLACES_2: Places = Places {
    dimensions: 16,
    data_type: 12,
    spacings: 104,
    offset: 168,
    slope: 176,
    intercept: 184,
    qform: 344,
    sform: 348,
    quaternion: 352,
    rows: 400,
    units: 500,
};

/// A header of either version, whole.
struct Header<'a> {
    bytes: &'a [u8],
    is_second: bool,
    is_analyze: bool,
    is_big_endian: bool,
}

/// Whether bytes begin as a header does.
pub(super) fn is_header(bytes: &[u8]) -> bool {
    Header::parse(bytes).is_some()
}

/// The name of the file of the numbers, where they are not in that of the header, whose name is `name`.
pub(super) fn data_name(bytes: &[u8], name: &str) -> Option<String> {
    let unfolded = if is_gzip(bytes) { first_unfolded(bytes) } else { Vec::new() };
    let header = Header::parse(if unfolded.is_empty() { bytes } else { &unfolded })?;
    if !header.is_apart() {
        return None;
    }
    let stem = base_name(name);
    let (stem, packed) = stem.strip_suffix(".gz").map_or((stem, ""), |stem| (stem, ".gz"));
    let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
    Some(format!("{stem}.img{packed}"))
}

impl<'a> Header<'a> {
    fn parse(bytes: &'a [u8]) -> Option<Self> {
        let length = i32::from_le_bytes(*bytes.first_chunk()?);
        let is = |size: usize, at: usize, magics: [&[u8]; 2]| {
            let is_big_endian = length.swap_bytes() == size as i32;
            let magic = bytes.get(at..at + 4)?;
            let known = bytes.len() >= size && (is_big_endian || length == size as i32) && magics.contains(&magic);
            known.then_some(is_big_endian)
        };
        if let Some(is_big_endian) = is(SIZE_1, 344, [b"n+1\0", b"ni1\0"]) {
            return Some(Self { bytes, is_second: false, is_analyze: false, is_big_endian });
        }
        if let Some(is_big_endian) = detect::analyze(bytes) {
            return Some(Self { bytes, is_second: false, is_analyze: true, is_big_endian });
        }
        let is_big_endian = is(SIZE_2, 4, [b"n+2\0", b"ni2\0"])?;
        Some(Self { bytes, is_second: true, is_analyze: false, is_big_endian })
    }

    fn places(&self) -> &'static Places {
        if self.is_second { &PLACES_2 } else { &PLACES_1 }
    }

    /// Whether the numbers stand in a file of their own.
    fn is_apart(&self) -> bool {
        self.is_analyze || self.bytes[if self.is_second { 5 } else { 345 }] == b'i'
    }

    /// `N` bytes from `at` on, which lies within any header, in little-endian order.
    fn word<const N: usize>(&self, at: usize) -> [u8; N] {
        let mut word = [0; N];
        word.copy_from_slice(&self.bytes[at..at + N]);
        if self.is_big_endian {
            word.reverse();
        }
        word
    }

    /// Whole number `index` of a list: 16 bits in the first version, 64 in the second.
    fn dimension(&self, index: usize) -> i64 {
        let at = self.places().dimensions;
        if self.is_second {
            i64::from_le_bytes(self.word(at + 8 * index))
        } else {
            i64::from(i16::from_le_bytes(self.word(at + 2 * index)))
        }
    }

    fn short(&self, at: usize) -> i16 {
        i16::from_le_bytes(self.word(at))
    }

    /// Fraction `index` of a list: 32 bits in the first version, 64 in the second.
    fn float(&self, at: usize, index: usize) -> f64 {
        if self.is_second {
            f64::from_le_bytes(self.word(at + 8 * index))
        } else {
            f64::from(f32::from_le_bytes(self.word(at + 4 * index)))
        }
    }

    fn code(&self, at: usize) -> i64 {
        if self.is_second { i64::from(i32::from_le_bytes(self.word(at))) } else { i64::from(self.short(at)) }
    }

    /// Bytes before the numbers in their file.
    fn offset(&self) -> u64 {
        let at = self.places().offset;
        let offset = if self.is_second { i64::from_le_bytes(self.word(at)) } else { self.float(at, 0) as i64 };
        let least = match (self.is_apart(), self.is_second) {
            (true, _) => 0,
            (false, false) => SIZE_1 + 4,
            (false, true) => SIZE_2 + 4,
        };
        u64::try_from(offset).unwrap_or(0).max(least as u64)
    }

    fn size(&self) -> Result<[usize; 3], ScanError> {
        let axes = self.dimension(0);
        let along = |axis: i64| if axis <= axes { self.dimension(axis as usize) } else { 1 };
        if !(1..=7).contains(&axes) {
            return Err(ScanError::malformed(FORMAT, ScanProblem::Axes { axes }));
        }
        if (4..=axes).any(|axis| along(axis) > 1) {
            return Err(ScanError::unsupported(FORMAT, Feature::MoreDimensions));
        }
        Ok([1, 2, 3].map(|axis| usize::try_from(along(axis)).unwrap_or(0)))
    }

    fn scalar(&self) -> Result<Scalar, ScanError> {
        Ok(match self.short(self.places().data_type) {
            2 => Scalar::U8,
            4 => Scalar::I16,
            8 => Scalar::I32,
            16 => Scalar::F32,
            64 => Scalar::F64,
            256 => Scalar::I8,
            512 => Scalar::U16,
            768 => Scalar::U32,
            1024 => Scalar::I64,
            1280 => Scalar::U64,
            other => return Err(ScanError::unsupported(FORMAT, Feature::NumberType { kind: other.to_string() })),
        })
    }

    /// Millimetres in the unit of lengths.
    fn unit(&self) -> f64 {
        let at = self.places().units;
        let units = if self.is_second { i32::from_le_bytes(self.word(at)) } else { i32::from(self.bytes[at]) };
        match units & 7 {
            1 => 1000.0,
            3 => 0.001,
            _ => 1.0,
        }
    }

    fn spacing(&self, axis: usize) -> f64 {
        self.float(self.places().spacings, axis)
    }

    /// The steps along the axes and the origin, in RAS and in the file's unit; `None` where it says nothing of them. What is to be
    /// said of that goes to `warnings`.
    fn placed(&self, warnings: &mut Vec<Warning>) -> Option<(DMat3, DVec3)> {
        if self.is_analyze {
            return None;
        }
        let spans =
            |&(steps, _): &(DMat3, DVec3)| Geometry::from_steps([1; 3], steps * self.unit(), DVec3::ZERO).is_ok();
        let by_matrix = self.matrix();
        if let Some((steps, origin)) = by_matrix.filter(spans) {
            warnings.extend(self.contradiction(steps));
            return Some((steps, origin));
        }
        let by_quaternion = self.quaternion().filter(spans);
        if by_matrix.is_some() {
            warnings.push(match by_quaternion {
                Some(_) => ScanWarning::NoMatrix.into(),
                None => ScanWarning::NoPlace.into(),
            });
        }
        by_quaternion
    }

    /// What the matrix (`sform`) says, if it has a code.
    fn matrix(&self) -> Option<(DMat3, DVec3)> {
        let places = self.places();
        let row = |row: usize| [0, 1, 2, 3].map(|column| self.float(places.rows, 4 * row + column));
        let [x, y, z] = [row(0), row(1), row(2)];
        let column = |i: usize| DVec3::new(x[i], y[i], z[i]);
        (self.code(places.sform) > 0).then(|| (DMat3::from_cols(column(0), column(1), column(2)), column(3)))
    }

    /// Tells of spacings that are others than those of the matrix by a factor, as where a unit was changed in one of them.
    fn contradiction(&self, steps: DMat3) -> Option<Warning> {
        /// Rounding leaves less, and a sheared matrix as much.
        const FACTOR: f64 = 1.1;
        let columns = [steps.x_axis, steps.y_axis, steps.z_axis].map(DVec3::length);
        let is_off = |(axis, &length): (usize, &f64)| {
            let stated = self.spacing(axis + 1).abs();
            stated > 0.0 && !(1.0 / FACTOR..FACTOR).contains(&(length / stated))
        };
        let (axis, &matrix) = columns.iter().enumerate().find(|&column| is_off(column))?;
        let unit = self.unit();
        Some(ScanWarning::Spacings { matrix: unit * matrix, stated: unit * self.spacing(axis + 1).abs() }.into())
    }

    /// What the quaternion (`qform`) says, if it has a code.
    fn quaternion(&self) -> Option<(DMat3, DVec3)> {
        let places = self.places();
        if self.code(places.qform) <= 0 {
            return None;
        }
        let [b, c, d, x, y, z] = [0, 1, 2, 3, 4, 5].map(|index| self.float(places.quaternion, index));
        let squares = b * b + c * c + d * d;
        // A half turn has no real part; what is longer was rounded.
        let (a, [b, c, d]) = if squares < 1.0 {
            (libm::sqrt(1.0 - squares), [b, c, d])
        } else {
            (0.0, [b, c, d].map(|part| part / libm::sqrt(squares)))
        };
        let rotation = DMat3::from_cols(
            DVec3::new(a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)),
            DVec3::new(2.0 * (b * c - a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d + a * b)),
            DVec3::new(2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a + d * d - b * b - c * c),
        );
        let hand = if self.spacing(0) < 0.0 { -1.0 } else { 1.0 };
        let [along_i, along_j, along_k] = [1, 2, 3].map(|axis| some_spacing(self.spacing(axis)));
        let spacing = DVec3::new(along_i, along_j, hand * along_k);
        Some((rotation * DMat3::from_diagonal(spacing), DVec3::new(x, y, z)))
    }
}

/// What the header in file `at` says.
pub(super) fn outline(at: usize, files: &[Head]) -> Result<Outline, ScanError> {
    let part = files[at];
    let unfolded = if is_gzip(part.bytes) { first_unfolded(part.bytes) } else { Vec::new() };
    let header = Header::parse(if unfolded.is_empty() { part.bytes } else { &unfolded });
    let header = header.ok_or_else(|| ScanError::malformed(FORMAT, ScanProblem::NoHeader))?;
    let format = if header.is_analyze { "Analyze" } else { FORMAT };
    let (places, size) = (header.places(), header.size()?);
    let mut warnings = Vec::new();
    let (steps, origin, axes) = match header.placed(&mut warnings) {
        Some((steps, origin)) => {
            let (steps, origin) = ras_to_lps(steps, origin);
            (steps, origin, Axes::Lps)
        }
        None => {
            warnings.push(silent(format));
            let spacing = DVec3::from([1, 2, 3].map(|axis| some_spacing(header.spacing(axis))));
            (DMat3::from_diagonal(spacing), DVec3::ZERO, Axes::Unknown)
        }
    };
    let (steps, origin) = (steps * header.unit(), origin * header.unit());
    let geometry = Geometry::from_steps(size, steps, origin).map_err(VolumeError::from)?;
    let layout = Layout::new(format, size, header.scalar()?, header.is_big_endian)?;
    let file = match data_name(part.bytes, part.name) {
        Some(name) => named(files, &name, format)?,
        None => at,
    };
    let packing = if is_gzip(files[file].bytes) { Packing::Gzip } else { Packing::Plain };
    let scaling = if header.is_analyze {
        [1.0, 0.0]
    } else {
        [places.slope, places.intercept].map(|place| header.float(place, 0))
    };
    let skipped = header.offset();
    Ok(Outline { packing, file, skipped, scaling, axes, warnings, ..Outline::new(format, geometry, layout) })
}

/// A spacing that was left out is 1.
fn some_spacing(spacing: f64) -> f64 {
    if spacing == 0.0 { 1.0 } else { spacing.abs() }
}
