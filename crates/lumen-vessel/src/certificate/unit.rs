//! Whether a tree is one of vessels: none is as wide as a surface that was opened in another unit makes it.

use crate::TreeError;
use crate::tree::Tree;
use lumen_message::messages;
use serde::{Deserialize, Serialize};

/// Diameters in mm of the widest vessel of a surface: others are of another unit.
const DIAMETERS_MM: std::ops::RangeInclusive<f64> = 0.2..=200.0;

messages! {
    /// Why there is no certificate.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum CalibreError {
        /// No vessel is as wide as that.
        "vessels-error-unit" Unit {
            /// Diameter of the widest vessel in mm.
            diameter: f64 [3],
        } => "the widest vessel is {diameter:.3} mm across: \
              the surface is probably not in the unit that it was opened in",
    } or {
        /// There is no tree.
        Tree(TreeError),
    }
}

/// A tree of vessels as wide as vessels are.
pub(crate) fn checked(tree: Result<Tree, TreeError>) -> Result<Tree, CalibreError> {
    let tree = tree?;
    let radii = tree.branches().iter().flat_map(|branch| branch.points.iter().map(|place| place.radius));
    let diameter = 2.0 * radii.fold(0.0, f64::max);
    if DIAMETERS_MM.contains(&diameter) { Ok(tree) } else { Err(CalibreError::Unit { diameter }) }
}
