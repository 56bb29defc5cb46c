//! What can go wrong between a volume and its surface, each in one plain sentence.

use thiserror::Error;

use super::geometry::GeometryError;
use super::selection::PRESETS;

/// Why a volume, or a surface of it, was not made.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum VolumeError {
    /// Its points cannot lie so.
    #[error("The volume cannot be placed in the patient: {0}.")]
    Geometry(#[from] GeometryError),
    /// Not one number for each point.
    #[error("The volume has {points} points and {samples} numbers for them.")]
    Samples {
        /// Points of the grid.
        points: usize,
        /// Numbers that there are.
        samples: usize,
    },
    /// A scan, of which nobody said where the vessels begin.
    #[error(
        "This is a scan with values from {low} to {high}: say at which threshold its surface is to be made \
         (contrast-filled vessels in CT: {presets})."
    )]
    NothingChosen {
        /// The smallest value.
        low: f64,
        /// The largest.
        high: f64,
        /// Names of presets and their values.
        presets: String,
    },
    /// A threshold that no value, or every value, reaches.
    #[error("No surface lies at the threshold {threshold}: the values go from {low} to {high}.")]
    OutsideRange {
        /// The threshold.
        threshold: f64,
        /// The smallest value.
        low: f64,
        /// The largest.
        high: f64,
    },
    /// A label that the volume has not.
    #[error("There is no label {label} in the volume; {known}.")]
    NoSuchLabel {
        /// The label.
        label: i64,
        /// What there is.
        known: String,
    },
    /// A box that holds no cube of eight points.
    #[error("The box holds nothing of the volume, which has {} x {} x {} voxels.", .size[0], .size[1], .size[2])]
    OutsideBox {
        /// Points along i, j, k.
        size: [usize; 3],
    },
    /// Nothing but inside, or nothing but outside.
    #[error("There is no surface within the box: all of it lies on one side.")]
    NoSurface,
    /// More than can be worked on.
    #[error(
        "The surface has more than {limit} triangles, most of them noise or bone: raise the threshold or set a box around \
         the vessels."
    )]
    TooManyTriangles {
        /// The most that are made.
        limit: usize,
    },
}

impl VolumeError {
    /// That a threshold is wanted of a scan with values from `low` to `high`.
    pub(super) fn nothing_chosen([low, high]: [f64; 2]) -> Self {
        let named = PRESETS.map(|preset| format!("{} {}", preset.value, preset.name));
        Self::NothingChosen { low, high, presets: named.join(", ") }
    }
}
