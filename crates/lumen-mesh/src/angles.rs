//! The angles of triangles: how many are slivers.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::roughness::sorted_percentile;
use super::{TriMesh, Vec3};

/// Bins of the histogram, of 10 degrees each.
const BINS: usize = 18;
/// A triangle with a smaller angle than this is a sliver; degrees.
const SLIVER_DEG: f64 = 10.0;

/// Angles of the triangles of a surface, in degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Angles {
    /// Smallest angle of all.
    pub min_deg: f64,
    /// First percentile, over the triangles, of the smallest angle of each.
    pub p1_deg: f64,
    /// Mean, over the triangles, of the smallest angle of each.
    pub mean_min_deg: f64,
    /// Percentage of triangles with an angle below 10 degrees.
    pub below_10_percent: f64,
    /// Angles (three a triangle) from 0 to 180 degrees, in bins of 10.
    pub histogram: [u64; BINS],
}

/// The angles of some triangles: the smallest of each, and all of them in bins.
#[derive(Clone, Debug, Default)]
pub struct AngleCounts {
    smallest: Vec<f32>,
    histogram: [u64; BINS],
}

/// The angles of `mesh`; `None` without a triangle.
pub fn angles(mesh: &TriMesh) -> Option<Angles> {
    let mut counts = AngleCounts::default();
    counts.add(AngleCounts::of(mesh, 0..mesh.triangles.len()));
    counts.finish()
}

impl AngleCounts {
    /// The angles of a range of triangles.
    pub fn of(mesh: &TriMesh, range: Range<usize>) -> Self {
        let mut counts = Self::default();
        for t in range {
            let angles = corner_angles(mesh.corners(t));
            counts.smallest.push(angles.into_iter().fold(f64::INFINITY, f64::min) as f32);
            for angle in angles {
                counts.histogram[((angle / 10.0) as usize).min(BINS - 1)] += 1;
            }
        }
        counts
    }

    /// Adds those of other triangles.
    pub fn add(&mut self, other: Self) {
        self.smallest.extend(other.smallest);
        self.histogram.iter_mut().zip(other.histogram).for_each(|(sum, count)| *sum += count);
    }

    /// What they come to.
    pub fn finish(mut self) -> Option<Angles> {
        if self.smallest.is_empty() {
            return None;
        }
        self.smallest.sort_unstable_by(f32::total_cmp);
        let count = self.smallest.len() as f64;
        let slivers = self.smallest.partition_point(|&angle| f64::from(angle) < SLIVER_DEG);
        Some(Angles {
            min_deg: f64::from(self.smallest[0]),
            p1_deg: sorted_percentile(&self.smallest, 0.01),
            mean_min_deg: self.smallest.iter().map(|&angle| f64::from(angle)).sum::<f64>() / count,
            below_10_percent: slivers as f64 / count * 100.0,
            histogram: self.histogram,
        })
    }
}

/// The three angles of a triangle in degrees; those at a corner where two others coincide, or that is not finite, are 0.
pub fn corner_angles(corners: [Vec3; 3]) -> [f64; 3] {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (ab, bc, ca) = (b - a, c - b, a - c);
    // Of two sides at a corner: the sine and the cosine of the angle, by the product of their lengths.
    let sine = ab.cross(bc).length();
    // Not -0, which is an angle of 180 degrees.
    [ab.dot(ca), bc.dot(ab), ca.dot(bc)].map(|back| {
        let angle = libm::atan2(sine, 0.0 - back).to_degrees();
        if angle.is_finite() { angle } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::shapes::{icosphere, square};

    #[test]
    fn equilateral_and_right_angled_triangles_are_what_they_are() {
        let found = angles(&icosphere(0, 3.0, Vec3::ONE)).unwrap();
        assert!((found.min_deg - 60.0).abs() < 1e-4 && (found.mean_min_deg - 60.0).abs() < 1e-4, "{found:?}");
        assert_eq!(found.histogram[5..=6].iter().sum::<u64>(), 60);
        let found = angles(&square(3, 3.0, 0.0)).unwrap();
        assert_eq!((found.min_deg, found.p1_deg, found.mean_min_deg, found.below_10_percent), (45.0, 45.0, 45.0, 0.0));
        assert_eq!((found.histogram[4], found.histogram[9]), (36, 18));
        assert_eq!(angles(&TriMesh::default()), None);
    }

    #[test]
    fn slivers_and_triangles_of_no_area_are_counted() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.5, 0.05, 0.0), Vec3::new(0.5, 0.0, 0.0)];
        let triangles = vec![[0, 1, 2], [0, 1, 3], [0, 1, 4], [0, 0, 0]];
        let found = angles(&TriMesh { positions, triangles }).unwrap();
        assert_eq!((found.min_deg, found.below_10_percent), (0.0, 75.0));
        // The widest angles: 169 degrees of the sliver, 180 of the flat one.
        assert_eq!((found.histogram[16], found.histogram[17]), (1, 1));
        assert_eq!(found.histogram.iter().sum::<u64>(), 12);
    }

    #[test]
    fn no_number_is_no_angle() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::new(0.0, f32::NAN, 0.0), Vec3::Y * f32::INFINITY];
        let found = angles(&TriMesh { positions, triangles: vec![[0, 1, 2], [0, 1, 3]] }).unwrap();
        assert_eq!((found.min_deg, found.below_10_percent), (0.0, 100.0));
    }

    proptest! {
        #[test]
        fn the_angles_of_a_triangle_add_up(corners in prop::array::uniform3(prop::array::uniform3(-9.0f32..9.0))) {
            let angles = corner_angles(corners.map(Vec3::from));
            prop_assert!((angles.iter().sum::<f64>() - 180.0).abs() < 1e-3, "{angles:?}");
        }
    }
}
