//! What can go wrong between a volume and its surface, each in one plain sentence.

use thiserror::Error;

use super::geometry::{GeometryError, product};
use lumen_language::exact;
use lumen_language::say;

/// Why a volume, or a surface of it, was not made.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum VolumeError {
    /// Its points cannot lie so.
    #[error("{}", say!("scan-no-place", why = .0.to_string()))]
    Geometry(#[from] GeometryError),
    /// Not one number for each point.
    #[error("{}", say!("scan-points", points = .points.to_string(), samples = .samples.to_string()))]
    Samples {
        /// Points of the grid.
        points: usize,
        /// Numbers that there are.
        samples: usize,
    },
    /// A scan, of which nobody said where the vessels begin.
    #[error("{}", say!("scan-nothing-chosen", low = exact(*.low), high = exact(*.high), presets = .presets))]
    NothingChosen {
        /// The smallest value.
        low: f64,
        /// The largest.
        high: f64,
        /// Names of presets and their values.
        presets: String,
    },
    /// A threshold that no value, or every value, reaches.
    #[error(
        "{}",
        say!("scan-outside-range", threshold = exact(*.threshold), low = exact(*.low), high = exact(*.high))
    )]
    OutsideRange {
        /// The threshold.
        threshold: f64,
        /// The smallest value.
        low: f64,
        /// The largest.
        high: f64,
    },
    /// A label that the volume has not.
    #[error("{}", say!("scan-no-label", label = .label.to_string(), known = .known))]
    NoSuchLabel {
        /// The label.
        label: i64,
        /// What there is.
        known: String,
    },
    /// A box that holds no cube of eight points.
    #[error("{}", say!("scan-outside-box", size = product(*.size)))]
    OutsideBox {
        /// Points along i, j, k.
        size: [usize; 3],
    },
    /// Slices for which there would be no memory.
    #[error("{}", say!("scan-slice-too-large", points = .points.to_string(), limit = .limit.to_string()))]
    SliceTooLarge {
        /// Points of a slice.
        points: usize,
        /// The most that are worked on.
        limit: usize,
    },
    /// Nothing but inside, or nothing but outside.
    #[error("{}", say!("scan-one-side"))]
    NoSurface,
    /// More than can be worked on.
    #[error("{}", say!("scan-too-many-triangles", limit = .limit.to_string()))]
    TooManyTriangles {
        /// The most that are made.
        limit: usize,
    },
}
