//! Scans and masks: bytes to [`Grid`], one file a format.
//!
//! A volume may stand in several files: a header and its numbers, or a series of slices. So what is read is a list of named
//! files ([`Part`]); a header that names another gets it from that list. Which file is what is decided by the content.
//!
//! Coordinates become LPS millimetres where a file says which way the patient lies: DICOM has them, MetaImage where it has an
//! `AnatomicalOrientation`, as ITK writes it; NRRD says what it has, NIfTI is RAS and is turned. Where a file does not say it,
//! its coordinates are taken as they stand, their axes are unknown, and a warning says so.
//!
//! Memory: numbers are kept in their stored type, and read straight into it (`numbers`). What a header claims is checked
//! against the bytes that are there, and against the most that deflate can make of them (1032 times as many): masks of
//! mostly nothing are honestly packed 800 : 1. Room is made as numbers arrive, never for more than four times as many.

mod axes;
mod dicom;
mod error;
#[cfg(not(target_arch = "wasm32"))]
mod files;
mod lines;
mod metaimage;
mod nifti;
mod nrrd;
mod numbers;
mod stream;
mod vti;

pub use error::ScanError;
#[cfg(not(target_arch = "wasm32"))]
pub use files::{Files, Unreadable, find, gather};
pub use stream::{HEAD, Head, Stream, begin};

use super::axes::Axes;
use super::detect::{self, Volume as Content};
use super::error::ReadError;
use crate::volume::Grid;

/// A file by its name.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Its name, with extension; a folder before it does not matter.
    pub name: &'a str,
    /// Its bytes.
    pub bytes: &'a [u8],
}

/// A volume as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// The numbers, and where they lie.
    pub grid: Grid,
    /// What the files are: "NIfTI", "NRRD", "MetaImage", "VTI", "DICOM".
    pub format: &'static str,
    /// What its coordinates grow towards: LPS, or unknown where the file does not say it.
    pub axes: Axes,
    /// Whether values are Hounsfield units, as DICOM and MetaImage say of CT; the other formats do not say.
    pub is_ct: bool,
    /// Sentences for the user about what looks odd.
    pub warnings: Vec<String>,
}

/// Whether a file is a volume, or the header of one, by its first bytes.
pub fn is_volume(bytes: &[u8]) -> bool {
    content(bytes).is_some()
}

/// The name of the file in which the numbers of a header stand, if `bytes` is a header that names one.
pub fn data_name(bytes: &[u8], name: &str) -> Option<String> {
    match content(bytes)? {
        Content::MetaImage => metaimage::data_name(bytes),
        Content::Nrrd => nrrd::data_name(bytes),
        Content::Nifti => nifti::data_name(bytes, name),
        Content::Vti | Content::Dicom => None,
    }
}

/// Reads the volume in `parts`: one file, a header with its data, or the files of a DICOM series in any order.
///
/// # Errors
/// [`ScanError`], each in one plain sentence: no file is a volume, one is broken or cut short, the numbers are missing, do not
/// fit into memory or have no place in a patient.
pub fn read(parts: &[Part]) -> Result<Scan, ScanError> {
    let found = parts.iter().enumerate().find_map(|(at, part)| content(part.bytes).map(|content| (at, content)));
    let Some((at, content)) = found else {
        return Err(match parts {
            [] => ReadError::Empty.into(),
            [only] if only.bytes.is_empty() => ReadError::Empty.into(),
            [first, ..] => ScanError::NoVolume { name: base_name(first.name).to_owned() },
        });
    };
    let whole = |part: &Part<'_>| part.bytes.len() as u64;
    let heads: Vec<Head> =
        parts.iter().map(|part| Head { name: part.name, bytes: part.bytes, length: whole(part) }).collect();
    match content {
        Content::Nifti => stream::read_whole(nifti::outline(at, &heads)?, parts),
        Content::Nrrd => stream::read_whole(nrrd::outline(at, &heads)?, parts),
        Content::MetaImage => stream::read_whole(metaimage::outline(at, &heads)?, parts),
        Content::Vti => vti::read(parts[at].bytes),
        Content::Dicom => {
            let slices: Vec<&Part> =
                parts.iter().filter(|part| self::content(part.bytes) == Some(Content::Dicom)).collect();
            dicom::read(&slices)
        }
    }
}

/// What the first bytes say; of a packed file, those that it unfolds to.
fn content(bytes: &[u8]) -> Option<Content> {
    if numbers::is_gzip(bytes) && nifti::is_header(&numbers::first_unfolded(bytes)) {
        return Some(Content::Nifti);
    }
    detect::volume(bytes).filter(|&found| found != Content::Nifti || nifti::is_header(bytes))
}

/// A file's name without the folder before it.
fn base_name(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// Which file a header names, whatever folder it lies in.
fn named(files: &[Head], name: &str, format: &'static str) -> Result<usize, ScanError> {
    let wanted = base_name(name);
    let same = |file: &Head| base_name(file.name) == wanted;
    let alike = |file: &Head| base_name(file.name).eq_ignore_ascii_case(wanted);
    let found = files.iter().position(same).or_else(|| files.iter().position(alike));
    found.ok_or_else(|| ScanError::DataElsewhere { format, name: wanted.to_owned() })
}
