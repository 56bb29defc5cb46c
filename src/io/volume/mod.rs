//! Scans and masks: bytes to [`Grid`], one file a format.
//!
//! A volume may stand in several files: a header and its numbers, or a series of slices. So what is read is a list of named
//! files ([`Part`]); a header that names another gets it from that list. Which file is what is decided by the content.
//!
//! Coordinates become LPS millimetres. MetaImage and DICOM have them, NRRD says what it has, NIfTI is RAS and is turned; VTI
//! says nothing and is taken as it stands, with a warning.
//!
//! Memory: numbers are kept in their stored type, and read straight into it (`numbers`). What a header claims is checked
//! against the bytes that are there, and against the most that deflate can make of them (1032 times as many): masks of
//! mostly nothing are honestly packed 800 : 1. Room is made as numbers arrive, never for more than four times as many.

mod axes;
mod dicom;
mod error;
#[cfg(not(target_arch = "wasm32"))]
mod files;
mod metaimage;
mod nifti;
mod nrrd;
mod numbers;
mod vti;

pub use error::ScanError;
#[cfg(not(target_arch = "wasm32"))]
pub use files::{Files, Unreadable, gather};

use super::error::ReadError;
use super::{text, vtk};
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
    /// Whether values are Hounsfield units, as DICOM says of CT; the other formats do not say.
    pub is_ct: bool,
    /// Sentences for the user about what looks odd.
    pub warnings: Vec<String>,
}

/// A kind of file that holds a volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    Nifti,
    Nrrd,
    MetaImage,
    Vti,
    Dicom,
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
    let found = parts.iter().find_map(|part| content(part.bytes).map(|content| (part, content)));
    let Some((part, content)) = found else {
        return Err(match parts {
            [] => ReadError::Empty.into(),
            [only] if only.bytes.is_empty() => ReadError::Empty.into(),
            [first, ..] => ScanError::NoVolume { name: base_name(first.name).to_owned() },
        });
    };
    match content {
        Content::Nifti => nifti::read(part, parts),
        Content::Nrrd => nrrd::read(part, parts),
        Content::MetaImage => metaimage::read(part, parts),
        Content::Vti => vti::read(part.bytes),
        Content::Dicom => {
            let slices: Vec<&Part> =
                parts.iter().filter(|part| self::content(part.bytes) == Some(Content::Dicom)).collect();
            dicom::read(&slices)
        }
    }
}

/// What the first bytes say.
fn content(bytes: &[u8]) -> Option<Content> {
    if nifti::is_header(bytes) || (numbers::is_gzip(bytes) && nifti::is_header(&numbers::first_unfolded(bytes))) {
        return Some(Content::Nifti);
    }
    if bytes.starts_with(b"NRRD000") {
        return Some(Content::Nrrd);
    }
    if bytes.get(128..132) == Some(b"DICM") {
        return Some(Content::Dicom);
    }
    let head = text::without_mark(bytes).trim_ascii_start();
    let head = &head[..head.len().min(2048)];
    let contains = |word: &[u8]| head.windows(word.len()).any(|part| part == word);
    if vtk::is_xml(head) {
        return contains(b"\"ImageData\"").then_some(Content::Vti);
    }
    let begins = [&b"ObjectType"[..], b"NDims", b"Comment"].iter().any(|word| head.starts_with(word));
    (begins && contains(b"DimSize")).then_some(Content::MetaImage)
}

/// A file's name without the folder before it.
fn base_name(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// The bytes of the part that a header names, whatever folder it lies in.
fn named<'a>(parts: &[Part<'a>], name: &str, format: &'static str) -> Result<&'a [u8], ScanError> {
    let wanted = base_name(name);
    let same = |part: &&Part| base_name(part.name) == wanted;
    let alike = |part: &&Part| base_name(part.name).eq_ignore_ascii_case(wanted);
    let found = parts.iter().find(same).or_else(|| parts.iter().find(alike));
    found.map(|part| part.bytes).ok_or_else(|| ScanError::DataElsewhere { format, name: wanted.to_owned() })
}
