//! A volume: a grid in the patient, and a number for each of its points.

use glam::DVec3;

use super::error::VolumeError;
use super::geometry::Geometry;
use super::samples::Samples;

/// Values so near to a label are of it: one that a slope has rounded lies beside its whole number.
pub(super) const LABEL_REACH: f64 = 0.25;

/// A scan or a mask. The value of a point is `slope * stored + intercept`, in Hounsfield units for CT.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    geometry: Geometry,
    samples: Samples,
    slope: f64,
    intercept: f64,
}

impl Grid {
    /// A volume of stored numbers, i running fastest, and what turns them into values. A slope of 0, or one that is no
    /// number, means that the numbers are the values.
    ///
    /// # Errors
    /// [`VolumeError::Geometry`] where the grid is none, [`VolumeError::Samples`] where there is not a number a point.
    pub fn new(geometry: Geometry, samples: Samples, slope: f64, intercept: f64) -> Result<Self, VolumeError> {
        geometry.check()?;
        if samples.len() != geometry.points() {
            return Err(VolumeError::Samples { points: geometry.points(), samples: samples.len() });
        }
        let is_scaled = slope.is_finite() && slope != 0.0 && intercept.is_finite();
        let (slope, intercept) = if is_scaled { (slope, intercept) } else { (1.0, 0.0) };
        Ok(Self { geometry, samples, slope, intercept })
    }

    /// Where its points lie.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The stored numbers.
    pub fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The value that a stored number stands for.
    pub fn value_of(&self, stored: f64) -> f64 {
        self.slope * stored + self.intercept
    }

    /// The stored number that would stand for a value, a fraction where there is none.
    pub fn stored_for(&self, value: f64) -> f64 {
        (value - self.intercept) / self.slope
    }

    /// The stored numbers, from the least to the largest, that stand for a label.
    pub(super) fn stored_for_label(&self, label: f64) -> [f64; 2] {
        let [a, b] = [label - LABEL_REACH, label + LABEL_REACH].map(|value| self.stored_for(value));
        [a.min(b), a.max(b)]
    }

    /// Whether larger stored numbers stand for smaller values.
    pub fn is_inverted(&self) -> bool {
        self.slope < 0.0
    }

    /// The value of a point, which must be in the grid.
    pub fn value(&self, point: [usize; 3]) -> f64 {
        self.value_of(self.samples.stored(self.index(point)))
    }

    /// The value at a place in voxels, interpolated linearly along the three axes; `None` outside of the grid, or beside a number
    /// that is none.
    pub(super) fn between(&self, at: DVec3) -> Option<f64> {
        let size = self.geometry.size;
        let is_in = (0..3).all(|axis| (0.0..=(size[axis] - 1) as f64).contains(&at[axis]));
        let low: [usize; 3] =
            std::array::from_fn(|axis| (at[axis].max(0.0) as usize).min(size[axis].saturating_sub(2)));
        let part = at - DVec3::from_array(low.map(|along| along as f64));
        let corner = |n: usize| {
            let offset = [n & 1, n >> 1 & 1, n >> 2];
            let weights = (0..3).map(|axis| if offset[axis] == 1 { part[axis] } else { 1.0 - part[axis] });
            let weight: f64 = weights.product();
            if weight == 0.0 { 0.0 } else { weight * self.value(std::array::from_fn(|axis| low[axis] + offset[axis])) }
        };
        is_in.then(|| (0..8).map(corner).sum::<f64>()).filter(|value| value.is_finite())
    }

    /// The number of a point, which must be in the grid.
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        let [nx, ny, _] = self.geometry.size;
        (k * ny + j) * nx + i
    }

    /// The volume of every `step`-th point along each axis, of which these are the stored numbers.
    pub fn coarser(&self, step: usize, samples: Samples) -> Self {
        Self { geometry: self.geometry.coarser(step), samples, ..*self }
    }
}
