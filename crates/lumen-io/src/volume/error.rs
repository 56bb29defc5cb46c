//! What can go wrong with the file of a volume, each in one plain sentence.

use thiserror::Error;

use super::super::error::ReadError;
use lumen_language::say;
use lumen_volume::VolumeError;

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
    #[error("{}", say!("scan-no-volume", name = .name))]
    NoVolume {
        /// The first file's name.
        name: String,
    },
    /// The numbers stand in a file of their own.
    #[error("{}", say!("scan-data-elsewhere", format = *.format, name = .name))]
    DataElsewhere {
        /// The format.
        format: &'static str,
        /// The name of the file.
        name: String,
    },
    /// More numbers than can be held.
    #[error("{}", say!("scan-too-large", bytes = .bytes.to_string(), limit = .limit.to_string()))]
    TooLarge {
        /// Bytes of its numbers.
        bytes: u64,
        /// The most that can be taken.
        limit: u64,
    },
    /// There is no memory for it here.
    #[error("{}", say!("scan-volume-memory", bytes = .bytes.to_string()))]
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
