//! Scans and masks: bytes to `Grid`, one file a format.
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
mod headers;
mod layers;
mod lines;
mod metaimage;
mod nifti;
mod nrrd;
mod numbers;
mod outline;
mod parts;
mod stream;
mod vti;

pub use error::ScanError;
#[cfg(not(target_arch = "wasm32"))]
pub use files::{Files, Unreadable, find, gather};
pub use headers::{data_name, is_volume};
pub use outline::Scan;
pub use parts::{HEAD, Head, Part};
pub use stream::{Stream, begin};

use super::error::ReadError;
use headers::Way;
use parts::base_name;

/// Reads the volume in `parts`: one file, a header with its data, or the files of a DICOM series in any order.
///
/// # Errors
/// [`ScanError`], each in one plain sentence: no file is a volume, one is broken or cut short, the numbers are missing, do not
/// fit into memory or have no place in a patient.
pub fn read(parts: &[Part]) -> Result<Scan, ScanError> {
    read_volume(parts, None)
}

/// As [`read`]; of files that hold several volumes that of number `choice` in [`Scan::offers`], or where there is none the one of
/// most slices.
///
/// # Errors
/// As [`read`], and [`ScanError::NoSuchVolume`].
pub fn read_volume(parts: &[Part], choice: Option<usize>) -> Result<Scan, ScanError> {
    let found =
        parts.iter().enumerate().find_map(|(at, part)| headers::content(part.bytes).map(|content| (at, content)));
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
    match Way::of(content, at, &heads)? {
        Way::Pieces(mut outline) => {
            outline.layers.choice = choice;
            stream::read_whole(*outline, parts)
        }
        Way::Vti => match choice {
            Some(number @ 1..) => Err(ScanError::NoSuchVolume { number: number + 1, count: 1 }),
            _ => vti::read(parts[at].bytes),
        },
        Way::Dicom => {
            let is_slice = |part: &&Part| headers::content(part.bytes) == Some(content);
            dicom::read(&parts.iter().filter(is_slice).collect::<Vec<_>>(), choice)
        }
    }
}
