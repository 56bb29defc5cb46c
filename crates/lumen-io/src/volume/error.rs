//! What can go wrong with the file of a volume, each in one plain sentence.

use lumen_message::messages;
use lumen_volume::VolumeError;

use super::super::error::{Feature, ReadError};
use super::super::problem::Problem;

messages! {
    /// Why a volume was not opened.
    #[derive(Clone, Debug, PartialEq)]
    pub enum ScanError {
        /// None of the files is a volume.
        "scan-no-volume" NoVolume {
            /// The first file's name.
            name: String,
        } => "\"{name}\" is not a volume that Lumen knows: it opens NIfTI, NRRD, MetaImage and VTI files and series of DICOM.",
        /// A file, which may be sound, without what a volume takes.
        "scan-no-scan" NoScan {
            /// The format.
            format: &'static str,
            /// What it lacks.
            problem: Problem,
        } => "The {format} file cannot be opened as a scan: {problem}.",
        /// The numbers stand in a file of their own.
        "scan-data-elsewhere" DataElsewhere {
            /// The format.
            format: &'static str,
            /// The name of the file.
            name: String,
        } => "The {format} header keeps its numbers in the file \"{name}\": open both together.",
        /// More numbers than can be held.
        "scan-too-large" TooLarge {
            /// Bytes of its numbers.
            bytes: u64,
            /// The most that can be taken.
            limit: u64,
        } => "The volume is too large: its numbers take {bytes} bytes, and Lumen can take {limit}.",
        /// There is no memory for it here.
        "scan-volume-memory" Memory {
            /// Bytes of its numbers.
            bytes: u64,
        } => "There is not enough memory for the {bytes} bytes of the volume.",
        /// Several slices at a place.
        "scan-dicom-mixed" Mixed {
            /// How many places.
            places: usize,
        } => (
            places,
            "Several slices lie at one place, and nothing in the files says which volume each is of: open the files of one volume alone.",
            "Several slices lie at each of {places} places, and nothing in the files says which volume each is of: open the files of one volume alone."
        ),
        /// Fewer volumes than that.
        "scan-no-such-volume" NoSuchVolume {
            /// The one asked for, from 1.
            number: usize,
            /// How many there are.
            count: usize,
        } => (
            count,
            "There is no volume {number}: the files hold one.",
            "There is no volume {number}: the files hold {count}."
        ),
    } or {
        /// The file is broken, cut short, or uses what Lumen does not read.
        File(ReadError),
        /// Its points or numbers make no volume.
        Volume(VolumeError),
    }
}

impl ScanError {
    /// That a file breaks its format's rules.
    pub(super) fn malformed(format: &'static str, problem: impl Into<Problem>) -> Self {
        ReadError::Malformed { format, problem: problem.into() }.into()
    }

    /// That a file uses a part of its format that is not read.
    pub(super) fn unsupported(format: &'static str, feature: Feature) -> Self {
        ReadError::Unsupported { format, feature }.into()
    }
}
