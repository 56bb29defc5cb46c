//! A slice of a volume as a picture, to be shown behind the surface.

use serde::{Deserialize, Serialize};

use super::grid::Grid;

/// An axis of the grid, across which a slice lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Axis {
    /// The first: columns, i.
    I,
    /// The second: rows, j.
    J,
    /// The third: slices, k.
    K,
}

impl Axis {
    /// Its number.
    pub fn index(self) -> usize {
        match self {
            Self::I => 0,
            Self::J => 1,
            Self::K => 2,
        }
    }
}

/// The points of a grid in one plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Slice {
    /// Points along the two axes that lie in it, in their order.
    pub size: [usize; 2],
    /// A shade of grey for each point, the first axis running fastest.
    pub pixels: Vec<u8>,
    /// Where its four corners lie in the patient, in mm: the first point, the last along the first axis, the last along
    /// both, the last along the second.
    pub corners: [[f64; 3]; 4],
}

/// Slice `index` across `axis`, black at the first value of `window` and below, white at the last and above; `None` beyond
/// the grid.
pub fn slice(grid: &Grid, axis: Axis, index: usize, window: [f64; 2]) -> Option<Slice> {
    let geometry = grid.geometry();
    if index >= geometry.size[axis.index()] {
        return None;
    }
    let [across, down] = match axis {
        Axis::I => [1, 2],
        Axis::J => [0, 2],
        Axis::K => [0, 1],
    };
    let size = [geometry.size[across], geometry.size[down]];
    let point = |a: usize, b: usize| {
        let mut point = [index; 3];
        (point[across], point[down]) = (a, b);
        point
    };
    let [black, white] = window;
    let scale = 255.0 / (white - black).max(f64::MIN_POSITIVE);
    // A value that is no number is black.
    let shade = |value: f64| ((value - black) * scale) as u8;
    let pixels = (0..size[1]).flat_map(|b| (0..size[0]).map(move |a| (a, b)));
    let pixels = pixels.map(|(a, b)| shade(grid.value(point(a, b)))).collect();
    let [last_a, last_b] = size.map(|along| along - 1);
    let corners = [(0, 0), (last_a, 0), (last_a, last_b), (0, last_b)].map(|(a, b)| {
        let [i, j, k] = point(a, b).map(|index| index as f64);
        geometry.at(i, j, k).to_array()
    });
    Some(Slice { size, pixels, corners })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::geometry::Geometry;
    use super::super::samples::Samples;
    use super::*;

    #[test]
    fn a_slice_has_the_values_of_its_plane_at_their_place() {
        let geometry = Geometry::upright([3, 2, 2], DVec3::new(1.0, 2.0, 4.0), DVec3::splat(100.0));
        let values = vec![0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, f32::NAN, 1000.0];
        let grid = Grid::new(geometry, Samples::F32(values), 1.0, 0.0).unwrap();
        let top = slice(&grid, Axis::K, 1, [70.0, 95.5]).unwrap();
        assert_eq!((top.size, top.pixels), ([3, 2], vec![0, 0, 100, 200, 0, 255]));
        assert_eq!(top.corners[2], [102.0, 102.0, 104.0]);
        let side = slice(&grid, Axis::J, 0, [0.0, 255.0]).unwrap();
        assert_eq!((side.size, side.pixels), ([3, 2], vec![0, 10, 20, 60, 70, 80]));
        assert_eq!(side.corners[1..3], [[102.0, 100.0, 100.0], [102.0, 100.0, 104.0]]);
        assert_eq!(slice(&grid, Axis::I, 3, [0.0, 1.0]), None);
    }
}
