//! Whether a tree is one of vessels: none is as wide as a surface that was opened in another unit makes it.

use thiserror::Error;

use crate::TreeError;
use crate::tree::Tree;
use lumen_language::decimal;
use lumen_language::say;

/// Diameters in mm of the widest vessel of a surface: others are of another unit.
const DIAMETERS_MM: std::ops::RangeInclusive<f64> = 0.2..=200.0;

/// Why there is no certificate.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CalibreError {
    /// There is no tree.
    #[error(transparent)]
    Tree(#[from] TreeError),
    /// No vessel is as wide as that.
    #[error("{}", say!("vessels-error-unit", diameter = decimal(*.diameter_mm, 3)))]
    Unit {
        /// Diameter of the widest vessel in mm.
        diameter_mm: f64,
    },
}

/// A tree of vessels as wide as vessels are.
pub(crate) fn checked(tree: Result<Tree, TreeError>) -> Result<Tree, CalibreError> {
    let tree = tree?;
    let radii = tree.branches().iter().flat_map(|branch| branch.points.iter().map(|place| place.radius));
    let diameter_mm = 2.0 * radii.fold(0.0, f64::max);
    if DIAMETERS_MM.contains(&diameter_mm) { Ok(tree) } else { Err(CalibreError::Unit { diameter_mm }) }
}
