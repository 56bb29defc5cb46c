//! What can go wrong with the file of a volume, each in one plain sentence.

use thiserror::Error;

use super::super::error::ReadError;
use crate::volume::VolumeError;

/// Why a volume was not opened.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ScanError {
    /// The file is broken, cut short, or uses what Lumen does not read.
    #[error(transparent)]
    File(#[from] ReadError),
    /// Its points or numbers make no volume.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// None of the files is a volume.
    #[error(
        "\"{name}\" is not a volume that Lumen knows: it opens NIfTI, NRRD, MetaImage and VTI files and series of DICOM."
    )]
    NoVolume {
        /// The first file's name.
        name: String,
    },
    /// The numbers stand in a file of their own.
    #[error("The {format} header keeps its numbers in the file \"{name}\": open both together.")]
    DataElsewhere {
        /// The format.
        format: &'static str,
        /// The name of the file.
        name: String,
    },
    /// More numbers than can be held.
    #[error("The volume is too large: its numbers take {bytes} bytes, and Lumen can take {limit}.")]
    TooLarge {
        /// Bytes of its numbers.
        bytes: u64,
        /// The most that can be taken.
        limit: u64,
    },
    /// There is no memory for it here.
    #[error("There is not enough memory for the {bytes} bytes of the volume.")]
    Memory {
        /// Bytes of its numbers.
        bytes: u64,
    },
}

impl ScanError {
    /// That a file breaks its format's rules.
    pub(super) fn malformed(format: &'static str, problem: impl Into<String>) -> Self {
        ReadError::Malformed { format, problem: problem.into() }.into()
    }

    /// That a file uses a part of its format that is not read.
    pub(super) fn unsupported(format: &'static str, feature: impl Into<String>) -> Self {
        ReadError::Unsupported { format, feature: feature.into() }.into()
    }
}
