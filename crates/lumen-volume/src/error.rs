//! What can go wrong between a volume and its surface, each in one plain sentence.

use lumen_message::messages;

use super::geometry::{GeometryError, product};
use super::selection::Presets;

messages! {
    /// Why a volume, or a surface of it, was not made.
    #[derive(Clone, Debug, PartialEq)]
    pub enum VolumeError {
        /// Its points cannot lie so.
        "scan-no-place" Geometry {
            /// What is wrong with them.
            why: GeometryError,
        } => "The volume cannot be placed in the patient: {why}.",
        /// Not one number for each point.
        "scan-points" Samples {
            /// Points of the grid.
            points: usize,
            /// Numbers that there are.
            samples: usize,
        } => "The volume has {points} points and {samples} numbers for them.",
        /// A scan, of which nobody said where the vessels begin.
        "scan-nothing-chosen" NothingChosen {
            /// The smallest value.
            low: f64,
            /// The largest.
            high: f64,
            /// Thresholds that are of use.
            presets: Presets,
        } => "This is a scan with values from {low} to {high}: say at which threshold its surface is to be made (contrast-filled vessels in CT: {presets}).",
        /// A threshold that no value, or every value, reaches.
        "scan-outside-range" OutsideRange {
            /// The threshold.
            threshold: f64,
            /// The smallest value.
            low: f64,
            /// The largest.
            high: f64,
        } => "No surface lies at the threshold {threshold}: the values go from {low} to {high}.",
        /// A label that the volume has not.
        "scan-no-label" NoSuchLabel {
            /// The label.
            label: i64,
            /// What there is.
            known: Known,
        } => "There is no label {label} in the volume; {known}.",
        /// A box that holds no cube of eight points.
        "scan-outside-box" OutsideBox {
            /// Points along i, j, k.
            size: [usize; 3],
        } => { format!("The box holds nothing of the volume, which has {} voxels.", product(*size)) },
        /// A seed that is not in what is chosen.
        "scan-seed-outside" SeedOutside {
            /// The value there.
            value: f64,
        } => "The seed is not in the vessel: its value {value} is not chosen.",
        /// A seed where there is no voxel, or none of the box.
        "scan-seed-nowhere" SeedNowhere => "The seed is not in the scan, or not in the box.",
        /// A seed around which no edge is.
        "scan-seed-no-edge" NoEdge => "No edge of a vessel was found around the seed: set the threshold.",
        /// Slices for which there would be no memory.
        "scan-slice-too-large" SliceTooLarge {
            /// Points of a slice.
            points: usize,
            /// The most that are worked on.
            limit: usize,
        } => "A slice has {points} voxels, of which {limit} can be worked on: set a box around the vessels.",
        /// Nothing but inside, or nothing but outside.
        "scan-one-side" NoSurface => "There is no surface within the box: all of it lies on one side.",
        /// The same, where there is no box.
        "scan-all-one-side" NothingThere => "There is no surface: all of the volume lies on one side.",
        /// More than can be worked on.
        "scan-too-many-triangles" TooManyTriangles {
            /// The most that are made.
            limit: usize,
        } => "The surface has more than {limit} triangles, most of them noise or bone: raise the threshold or set a box around the vessels.",
    }
}

impl From<GeometryError> for VolumeError {
    fn from(why: GeometryError) -> Self {
        Self::Geometry { why }
    }
}

messages! {
    /// What there is in a volume without the label that is asked for.
    #[derive(Clone, Debug, PartialEq)]
    pub enum Known {
        /// Values of a scan.
        "scan-known-range" Range {
            /// The smallest.
            low: f64,
            /// The largest.
            high: f64,
        } => "it is a scan with values from {low} to {high}",
        /// Labels.
        "scan-known-labels" Labels {
            /// All of them, with commas between.
            labels: String,
        } => "it has {labels}",
    }
}
