//! What a header says of its volume, and the volume that comes of it with its numbers.

use super::super::axes::Axes;
use super::super::offer::{LabelName, Offer};
use super::super::warnings::{ScanWarning, Warning};
use super::error::ScanError;
pub(super) use super::layers::{Layers, Segment};
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
    /// The volumes that the files hold; none where they hold one, and cannot hold more.
    pub offers: Vec<Offer>,
    /// Which of them this is.
    pub taken: usize,
    /// Names and colours of labels.
    pub names: Vec<LabelName>,
}

impl Scan {
    /// A volume of which nothing else is known.
    pub(super) fn new(grid: Grid, format: &'static str, axes: Axes) -> Self {
        let (warnings, offers, names) = (Vec::new(), Vec::new(), Vec::new());
        Self { grid, format, axes, is_ct: false, warnings, offers, taken: 0, names }
    }
}

/// All volumes that some files hold.
#[derive(Default)]
pub(super) struct Offers {
    pub(super) list: Vec<Offer>,
}

impl Offers {
    /// The first of those with most slices, among the numbers that may be taken.
    pub(super) fn largest(&self, may_be: impl Fn(usize) -> bool) -> usize {
        let numbers = (0..self.list.len()).rev().filter(|&number| may_be(number));
        numbers.max_by_key(|&number| self.list[number].slices).unwrap_or(0)
    }

    /// What is told where series number `series`, of which volume `taken` was taken, holds others.
    pub(super) fn warning(&self, series: usize, taken: usize) -> Option<Warning> {
        /// More are not listed.
        const LISTED: usize = 12;
        let by = self.list.get(taken)?.by?;
        let of_series: Vec<&Offer> = self.list.iter().filter(|offer| offer.series == series).collect();
        let listed = of_series.iter().take(LISTED).map(|offer| format!("{} ({})", offer.value, offer.slices));
        let mut list = listed.collect::<Vec<_>>().join(", ");
        if of_series.len() > LISTED {
            list.push_str(", \u{2026}");
        }
        let taken = self.list[taken].value.clone();
        Some(ScanWarning::Volumes { count: of_series.len(), by, list, taken }.into())
    }
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
    pub(super) layers: Layers,
}

impl Outline {
    /// A header that says no more than this: its numbers stand in the first file from its beginning on, as they are.
    pub(super) fn new(format: &'static str, geometry: Geometry, layout: Layout) -> Self {
        Self {
            format,
            geometry,
            layout,
            packing: Packing::Plain,
            file: 0,
            start: 0,
            skipped: 0,
            scaling: [1.0, 0.0],
            axes: Axes::Unknown,
            is_ct: false,
            warnings: Vec::new(),
            layers: Layers::default(),
        }
    }

    pub(super) fn finish(self, samples: Samples) -> Result<Scan, ScanError> {
        let [slope, intercept] = self.scaling;
        let unfolded = self.layers.unfold(samples, self.geometry.size[2], self.format)?;
        let grid = Grid::new(self.geometry, unfolded.samples, slope, intercept)?;
        let mut scan = Scan::new(grid, self.format, self.axes);
        (scan.is_ct, scan.warnings, scan.names) = (self.is_ct, self.warnings, unfolded.names);
        scan.warnings.extend(unfolded.offers.warning(0, unfolded.taken));
        (scan.offers, scan.taken) = (unfolded.offers.list, unfolded.taken);
        Ok(scan)
    }
}
