//! What passes between the app and the scan's engine. Large arrays cross as buffers ([`transfer`](crate::transfer)).

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::super::link::Link;
use super::super::surfaces::surface;
use crate::io::{Axes, LabelName, Offer, ThresholdReport, Warning};
use crate::mesh::TriMesh;
use crate::transfer::bulk;
use crate::volume::{Axis, Cut, HalfWay, Selection, Survey};

/// The app's end of the line to the engine.
pub type ScanLink = dyn Link<ScanCommand, ScanEvent>;

/// A file by its name: a scan, a header, its data, a slice.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NamedFile {
    /// Its name, with extension.
    pub name: String,
    /// What is in it.
    pub contents: Contents,
}

/// What is in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Contents {
    /// These bytes.
    Bytes(#[serde(with = "bulk")] Arc<Vec<u8>>),
    /// What the engine's [`Shelf`](super::Shelf) has under a number, so that no more than the engine holds it.
    Shelved {
        /// The number; a file that comes later has a larger one.
        number: u32,
        /// Its length in bytes.
        bytes: u64,
    },
}

impl NamedFile {
    /// A file whose bytes are here.
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self { name: name.into(), contents: Contents::Bytes(Arc::new(bytes)) }
    }
}

/// What the engine is asked to do. A surface or a preview takes the place of the one that is being made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ScanCommand {
    /// Read a volume, in place of what was open: one file, a header with its data, or the slices of a series.
    Open {
        /// Comes back with the answer.
        id: u64,
        /// The files, in any order.
        files: Vec<NamedFile>,
        /// Which of their volumes, by its number in [`OpenedScan::offers`]; `None` for the one of most slices.
        volume: Option<usize>,
    },
    /// Make a surface at reduced resolution.
    Preview {
        /// Comes back with the answer; each command's is larger than the one before.
        generation: u64,
        /// Of what, in voxels of the volume as it was opened.
        cut: Cut,
        /// Every how many voxels one is looked at; `None` for as few as a preview can take.
        step: Option<usize>,
    },
    /// Make the surface.
    Surface {
        /// Comes back with the answer.
        generation: u64,
        /// Of what.
        cut: Cut,
    },
    /// Look for the threshold around a seed.
    HalfWay {
        /// A voxel of the volume, from 0.
        seed: [usize; 3],
    },
    /// Make a picture of a slice.
    Slice {
        /// Across which axis.
        axis: Axis,
        /// Which, from 0.
        index: usize,
        /// The values that are black and white.
        window: [f64; 2],
    },
    /// Stop what is being made; the volume stays open.
    Cancel,
    /// Leave the volume, and its memory to others.
    Close,
}

/// What the engine is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ScanWork {
    /// Waiting for the engine itself, which is being fetched.
    Fetching,
    /// Taking in the bytes of its files.
    Reading,
    /// Counting the values of a volume.
    Surveying,
    /// Making a surface at reduced resolution.
    Preview,
    /// Making the surface.
    Surface,
}

/// A volume that was opened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpenedScan {
    /// That of the command.
    pub id: u64,
    /// "NIfTI", "NRRD", "MetaImage", "VTI", "DICOM".
    pub format: String,
    /// Voxels along the axes.
    pub dimensions: [usize; 3],
    /// Distance between them in mm.
    pub spacing_mm: [f64; 3],
    /// Place of the first in mm.
    pub origin_mm: [f64; 3],
    /// The directions of the three axes, each of unit length.
    pub directions: [[f64; 3]; 3],
    /// What coordinates grow towards: LPS, or unknown where the file does not say it.
    pub axes: Axes,
    /// Bytes that its numbers take in memory.
    pub bytes: u64,
    /// Whether the file says that values are Hounsfield units.
    pub is_ct: bool,
    /// Range, histogram and labels.
    pub survey: Survey,
    /// What to begin with: all of a mask; of a scan nothing is proposed.
    pub proposed: Option<Selection>,
    /// What looks odd.
    pub warnings: Vec<Warning>,
    /// The volumes of its files, and which of them this is.
    pub offers: Vec<Offer>,
    /// The number of this one.
    pub taken: usize,
    /// Names and colours of labels.
    pub names: Vec<LabelName>,
}

/// What the engine has to say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ScanEvent {
    /// A volume is open.
    Opened(Box<OpenedScan>),
    /// How far the work is.
    Progress {
        /// What is being done.
        work: ScanWork,
        /// The part of it that is done, 0 to 1.
        fraction: f32,
    },
    /// A surface at reduced resolution.
    Preview {
        /// That of the command.
        generation: u64,
        /// Every how many voxels one was looked at.
        step: usize,
        /// The surface in mm, not welded.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
    },
    /// The surface, to be opened like any other.
    Surface {
        /// That of the command.
        generation: u64,
        /// In mm, counter-clockwise seen from outside, not welded.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
        /// How it hangs on its threshold; none of a mask.
        threshold: Option<ThresholdReport>,
    },
    /// The threshold around a seed; `None` where no edge was found.
    HalfWay {
        /// That of the command.
        seed: [usize; 3],
        /// Between which values it is half way.
        found: Option<HalfWay>,
    },
    /// A picture of a slice.
    Slice {
        /// Across which axis.
        axis: Axis,
        /// Which, from 0.
        index: usize,
        /// Pixels along the two axes that lie in it.
        size: [usize; 2],
        /// A shade of grey for each.
        #[serde(with = "bulk")]
        pixels: Vec<u8>,
        /// The values that are black and white.
        window: [f64; 2],
        /// Where its corners lie in mm, around it from the first pixel on.
        corners: [[f64; 3]; 4],
    },
    /// Something cannot be done; what was open still is.
    Refused {
        /// The `id` or the `generation` of the command; 0 for a slice.
        number: u64,
        /// One plain sentence.
        sentence: String,
    },
    /// What was being made was stopped.
    Cancelled,
}

/// Whether this is the head of a [`ScanEvent::Progress`]: a message begins with the place of its variant.
pub fn is_progress(head: &[u8]) -> bool {
    head.first() == Some(&1)
}
