//! Where a surface comes from.

use std::borrow::Cow;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::surfaces::surface;
use crate::io::{Axes, ImportOptions, ThresholdReport, Warning};
use crate::language::tell;
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::transfer::bulk;

/// Where a surface comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Source {
    /// A file that was chosen or dropped.
    File {
        /// Its name, with extension.
        name: String,
        /// Its bytes.
        #[serde(with = "bulk")]
        bytes: Arc<Vec<u8>>,
        /// How to read it.
        options: ImportOptions,
    },
    /// A vessel tree that Lumen makes.
    Sample {
        /// Which.
        sample: Sample,
        /// Triangles of its largest piece.
        triangles: u32,
    },
    /// A surface that was made of a scan.
    Made {
        /// What it is called.
        name: String,
        /// What it was made of: "DICOM".
        format: String,
        /// The surface in mm.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
        /// What its coordinates grow towards, as far as the scan says it.
        axes: Axes,
        /// What looked odd about the scan.
        warnings: Vec<Warning>,
        /// How it hangs on its threshold; none of a mask.
        threshold: Option<ThresholdReport>,
    },
}

impl Source {
    /// The sample at its default size.
    pub fn sample(sample: Sample) -> Self {
        Self::Sample { sample, triangles: sample.default_triangles() as u32 }
    }

    /// The sample, if it is one with as many triangles as it has by itself: one of fewer is another surface.
    pub fn usual_sample(&self) -> Option<Sample> {
        match *self {
            Self::Sample { sample, triangles } if triangles as usize == sample.default_triangles() => Some(sample),
            _ => None,
        }
    }

    /// Whether both are one file, in whatever units it is read.
    pub fn is_same_file(&self, other: &Self) -> bool {
        matches!((self, other), (Self::File { bytes, .. }, Self::File { bytes: of, .. }) if Arc::ptr_eq(bytes, of))
    }

    /// What the surface is called, whatever is spoken: files are named by it.
    pub fn name(&self) -> &str {
        match self {
            Self::File { name, .. } | Self::Made { name, .. } => name,
            Self::Sample { sample, .. } => sample.title(),
        }
    }

    /// The same to a user: a sample has a name in the language that is spoken.
    pub fn label(&self) -> Cow<'_, str> {
        match self {
            Self::File { name, .. } | Self::Made { name, .. } => name.as_str().into(),
            Self::Sample { sample, .. } => tell(&sample.label()).into(),
        }
    }
}
