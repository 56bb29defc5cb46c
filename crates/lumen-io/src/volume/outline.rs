//! What a header says of its volume, and the volume that comes of it with its numbers.

use super::super::axes::Axes;
use super::super::warnings::Warning;
use super::error::ScanError;
use super::numbers::{Layout, Packing};
use lumen_volume::{Geometry, Grid, Samples};

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
    pub warnings: Vec<Warning>,
}

/// What a header says.
pub(super) struct Outline {
    pub(super) format: &'static str,
    pub(super) geometry: Geometry,
    pub(super) layout: Layout,
    pub(super) packing: Packing,
    /// Which file the numbers stand in.
    pub(super) file: usize,
    /// Where they begin there, as it stands.
    pub(super) start: u64,
    /// Bytes before the numbers in what that unfolds to.
    pub(super) skipped: u64,
    /// Slope and intercept.
    pub(super) scaling: [f64; 2],
    pub(super) axes: Axes,
    pub(super) is_ct: bool,
    pub(super) warnings: Vec<Warning>,
}

impl Outline {
    pub(super) fn finish(self, samples: Samples) -> Result<Scan, ScanError> {
        let [slope, intercept] = self.scaling;
        let grid = Grid::new(self.geometry, samples, slope, intercept)?;
        Ok(Scan { grid, format: self.format, axes: self.axes, is_ct: self.is_ct, warnings: self.warnings })
    }
}
