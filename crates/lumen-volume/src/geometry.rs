//! Where the points of a grid lie in the patient.

use glam::{DMat3, DVec3};
use lumen_message::messages;

/// The most points along an axis that indices are kept for.
const LONGEST: usize = 1 << 20;
/// Spacings outside of this, in mm, are of no scan.
const SPACINGS_MM: std::ops::RangeInclusive<f64> = 1e-4..=1e3;
/// Farther out than this, in mm, nothing is a place in a body.
const FARTHEST_MM: f64 = 1e6;
/// The least volume of the box that the three directions span: less, and they lie in a plane.
const FLAT: f64 = 1e-3;

/// A regular grid of sample points: point (i, j, k) lies at `origin + direction * (spacing * (i, j, k))`.
///
/// Coordinates are the patient's, in millimetres; where a file says how the patient lies, in LPS: x to the left, y to the back,
/// z to the head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// Points along i, j, k.
    pub size: [usize; 3],
    /// Distance between points along i, j, k in mm.
    pub spacing: DVec3,
    /// Position of point (0, 0, 0) in mm.
    pub origin: DVec3,
    /// The directions in which i, j, k grow, as columns of unit length. They need not be orthogonal (a tilted gantry
    /// shears a scan) nor right-handed.
    pub direction: DMat3,
}

messages! {
    /// Why no surface in mm can be made on a grid.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum GeometryError {
        /// An axis without points, or with more than can be.
        "scan-no-points" Size {
            /// Points along i, j, k.
            size: [usize; 3],
        } => { format!("{} points make no volume", product(*size)) },
        /// A spacing that no scan has.
        "scan-no-spacing" Spacing {
            /// The spacing in mm.
            spacing: f64,
        } => "a distance of {spacing} mm between its points is none that a scan has",
        /// Directions that are in one plane, or no numbers.
        "scan-no-directions" Direction => "the directions of its axes span no space",
        /// An origin that is no number, or too far away.
        "scan-no-origin" Origin => "its origin is not a place in a body",
    }
}

impl Geometry {
    /// A grid along the patient's own axes.
    pub fn upright(size: [usize; 3], spacing: DVec3, origin: DVec3) -> Self {
        Self { size, spacing, origin, direction: DMat3::IDENTITY }
    }

    /// A grid from the steps between neighbours along i, j, k in mm, as columns.
    ///
    /// # Errors
    /// As [`Self::check`].
    pub fn from_steps(size: [usize; 3], steps: DMat3, origin: DVec3) -> Result<Self, GeometryError> {
        let columns = [steps.x_axis, steps.y_axis, steps.z_axis];
        let spacing = DVec3::from(columns.map(DVec3::length));
        let [x, y, z] = columns.map(|column| column / column.length());
        let geometry = Self { size, spacing, origin, direction: DMat3::from_cols(x, y, z) };
        geometry.check()?;
        Ok(geometry)
    }

    /// The grid of the given spacing that holds the box from `min` to `max` with two points of padding.
    pub fn around(min: DVec3, max: DVec3, spacing: DVec3) -> Self {
        let extent = (max - min) / spacing;
        let size = extent.to_array().map(|points| libm::ceil(points.max(0.0)) as usize + 5);
        Self::upright(size, spacing, min - spacing * 2.0)
    }

    /// Whether a volume can lie so.
    ///
    /// # Errors
    /// [`GeometryError`]: no points, a spacing that no scan has, directions in one plane, an origin that is no place.
    pub fn check(&self) -> Result<(), GeometryError> {
        let points = self.size.iter().try_fold(1usize, |points, &along| points.checked_mul(along));
        if self.size.iter().any(|along| !(1..=LONGEST).contains(along)) || points.is_none() {
            return Err(GeometryError::Size { size: self.size });
        }
        // What is no number is in no range.
        if let Some(&spacing) = self.spacing.to_array().iter().find(|&mm| !SPACINGS_MM.contains(mm)) {
            return Err(GeometryError::Spacing { spacing });
        }
        if !self.direction.is_finite() || self.direction.determinant().abs() < FLAT {
            return Err(GeometryError::Direction);
        }
        if !self.origin.is_finite() || self.origin.abs().max_element() > FARTHEST_MM {
            return Err(GeometryError::Origin);
        }
        Ok(())
    }

    /// How many points there are.
    pub fn points(&self) -> usize {
        self.size.iter().product()
    }

    /// The steps between neighbours along i, j, k in mm, as columns.
    pub fn steps(&self) -> DMat3 {
        self.direction * DMat3::from_diagonal(self.spacing)
    }

    /// The place of a point given in grid units, in mm.
    pub fn at(&self, i: f64, j: f64, k: f64) -> DVec3 {
        self.origin + self.steps() * DVec3::new(i, j, k)
    }

    /// Whether i, j, k grow as the fingers of a left hand.
    pub fn is_left_handed(&self) -> bool {
        self.direction.determinant() < 0.0
    }

    /// The part of the grid within `region`, which must be within it.
    pub(crate) fn cropped(&self, region: &Region) -> Self {
        let [i, j, k] = region.first.map(|first| first as f64);
        Self { size: region.size(), origin: self.at(i, j, k), ..*self }
    }

    /// Every `step`-th point along each axis.
    pub fn coarser(&self, step: usize) -> Self {
        Self { size: self.size.map(|along| along.div_ceil(step)), spacing: self.spacing * step as f64, ..*self }
    }
}

/// A box of grid points, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Region {
    /// The first point along i, j, k, from 0.
    pub first: [usize; 3],
    /// The last point along i, j, k.
    pub last: [usize; 3],
}

impl Region {
    /// All points of a grid.
    pub fn all(geometry: &Geometry) -> Self {
        Self { first: [0; 3], last: geometry.size.map(|along| along.saturating_sub(1)) }
    }

    /// The part of the box that lies within a grid; `None` where that has not two points along each axis, between which a
    /// surface could run.
    pub fn within(&self, geometry: &Geometry) -> Option<Self> {
        let all = Self::all(geometry);
        let last: [usize; 3] = std::array::from_fn(|axis| self.last[axis].min(all.last[axis]));
        let region = Self { first: self.first, last };
        (0..3).all(|axis| region.first[axis] < last[axis]).then_some(region)
    }

    /// Points along i, j, k of a box within a grid.
    pub fn size(&self) -> [usize; 3] {
        std::array::from_fn(|axis| self.last[axis] + 1 - self.first[axis])
    }
}

/// Points along i, j, k: 512 x 512 x 800.
pub(super) fn product([i, j, k]: [usize; 3]) -> String {
    format!("{i} x {j} x {k}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_where_origin_spacing_and_direction_put_them() {
        // j runs down the patient, k to the right.
        let direction = DMat3::from_cols(DVec3::Y, DVec3::NEG_Z, DVec3::NEG_X);
        let geometry =
            Geometry { size: [4, 5, 6], spacing: DVec3::new(0.5, 2.0, 3.0), origin: DVec3::splat(10.0), direction };
        assert_eq!(geometry.check(), Ok(()));
        assert_eq!(geometry.at(1.0, 2.0, 3.0), DVec3::new(1.0, 10.5, 6.0));
        assert!(!geometry.is_left_handed());
        let part = geometry.cropped(&Region { first: [1, 2, 3], last: [3, 4, 5] });
        assert_eq!((part.size, part.origin), ([3, 3, 3], DVec3::new(1.0, 10.5, 6.0)));
        assert_eq!(geometry.coarser(4).size, [1, 2, 2]);
        let again = Geometry::from_steps([4, 5, 6], geometry.steps(), geometry.origin);
        assert_eq!(again, Ok(geometry));
    }

    #[test]
    fn grids_that_are_none_are_refused() {
        let good = Geometry::upright([2; 3], DVec3::ONE, DVec3::ZERO);
        let with = |change: fn(&mut Geometry)| {
            let mut geometry = good;
            change(&mut geometry);
            geometry.check()
        };
        assert_eq!(with(|g| g.size[1] = 0), Err(GeometryError::Size { size: [2, 0, 2] }));
        assert_eq!(with(|g| g.size = [1 << 20; 3]).is_ok(), usize::BITS == 64);
        assert_eq!(with(|g| g.spacing.y = 0.0), Err(GeometryError::Spacing { spacing: 0.0 }));
        assert!(with(|g| g.spacing.y = f64::NAN).is_err());
        assert_eq!(with(|g| g.direction.z_axis = DVec3::X), Err(GeometryError::Direction));
        assert_eq!(with(|g| g.origin.x = 1e9), Err(GeometryError::Origin));
    }

    #[test]
    fn a_box_is_cut_to_the_grid() {
        let geometry = Geometry::upright([10, 10, 10], DVec3::ONE, DVec3::ZERO);
        let region = Region { first: [2, 0, 9], last: [50, 9, 9] };
        assert_eq!(region.within(&geometry), None);
        let region = Region { first: [2, 0, 8], last: [50, 9, 9] };
        assert_eq!(region.within(&geometry).map(|region| region.size()), Some([8, 10, 2]));
    }
}
