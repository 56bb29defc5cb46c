//! Axis-aligned bounding boxes.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Points that [`Bounds::of_most`] looks at, at most.
const LOOKED_AT: usize = 4096;

/// Of their coordinates along an axis, one in so many at either end may be a stray's.
const STRAYS: usize = 16;

/// By so much the box around all must be longer than that around the others for a stray to be one. A surface of which
/// no part is that small loses four digits of seven at most.
const FAR: f32 = 64.0;

/// An axis-aligned box in mm. The empty box has `min > max`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// Smallest x, y, z.
    pub min: [f32; 3],
    /// Largest x, y, z.
    pub max: [f32; 3],
}

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };

    /// The smallest box around `points`.
    pub fn of(points: &[Vec3]) -> Self {
        // Four at a time, which the processor compares at once: a million in 2 ms for 9 where a browser has just begun.
        let (fours, rest) = points.as_chunks::<4>();
        let (mut min, mut max) = ([Vec3::INFINITY; 4], [Vec3::NEG_INFINITY; 4]);
        for four in fours {
            for i in 0..4 {
                min[i] = min[i].min(four[i]);
                max[i] = max[i].max(four[i]);
            }
        }
        let min = min.into_iter().chain(rest.iter().copied()).fold(Vec3::INFINITY, Vec3::min);
        let max = max.into_iter().chain(rest.iter().copied()).fold(Vec3::NEG_INFINITY, Vec3::max);
        Self { min: min.into(), max: max.into() }
    }

    /// The smallest box around `points`, strays left out: where that is more than 64 times as long as the box around
    /// seven eighths of the coordinates along each axis, that smaller box, enlarged by its length on all sides. A
    /// surface of which one vertex was flung away is so measured, and centred, by the rest of it.
    pub fn of_most(points: &[Vec3]) -> Self {
        let (all, mut core) = (Self::of(points), Self::EMPTY);
        let step = points.len().div_ceil(LOOKED_AT).max(1);
        for axis in 0..3 {
            let mut along: Vec<f32> = points.iter().step_by(step).map(|p| p[axis]).collect();
            along.sort_unstable_by(f32::total_cmp);
            let tail = along.len() / STRAYS;
            if let (Some(&low), Some(&high)) = (along.get(tail), along.iter().nth_back(tail)) {
                (core.min[axis], core.max[axis]) = (low, high);
            }
        }
        let length = core.longest_side();
        // False for what is no number.
        let has_strays = length > 0.0 && all.longest_side() > FAR * length;
        if !has_strays {
            return all;
        }
        Self { min: core.min.map(|x| x - length), max: core.max.map(|x| x + length) }
    }

    /// The smallest box around this one and `other`.
    pub fn joined(&self, other: &Self) -> Self {
        Self {
            min: Vec3::from(self.min).min(other.min.into()).into(),
            max: Vec3::from(self.max).max(other.max.into()).into(),
        }
    }

    /// Whether the box holds no point.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|i| self.min[i] > self.max[i])
    }

    /// The middle of the box; the origin for an empty box.
    pub fn centre(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { (Vec3::from(self.min) + Vec3::from(self.max)) / 2.0 }
    }

    /// Edge lengths in mm; zero for an empty box.
    pub fn size(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { Vec3::from(self.max) - Vec3::from(self.min) }
    }

    /// Length of the longest side in mm; unlike the diagonal it needs no squares.
    pub fn longest_side(&self) -> f32 {
        self.size().max_element()
    }

    /// Length of the diagonal in mm.
    pub fn diagonal(&self) -> f32 {
        self.size().length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_stray_of_many_points_is_left_out_and_a_long_vessel_is_not() {
        let line = |scale: f32| (0..200).map(move |i| Vec3::new(i as f32 * scale, (i % 7) as f32, 3.0));
        let long: Vec<Vec3> = line(10.0).collect();
        assert_eq!(Bounds::of_most(&long), Bounds::of(&long));
        for far in [1e5, 1e6, 1e9, f32::INFINITY] {
            for at in [0, 77, 200] {
                let mut points: Vec<Vec3> = line(1.0).collect();
                points.insert(at, Vec3::new(far, -far, 5.0));
                let most = Bounds::of_most(&points);
                assert!((most.centre() - Vec3::new(100.0, 3.0, 3.0)).abs().max_element() < 15.0, "{most:?}");
                assert!((175.0..600.0).contains(&most.longest_side()), "{most:?}");
            }
        }
    }

    #[test]
    fn few_points_points_in_one_place_and_none_have_the_box_around_all() {
        for points in [vec![], vec![Vec3::ONE; 40], vec![Vec3::ZERO, Vec3::X * 1e9]] {
            let (most, all) = (Bounds::of_most(&points), Bounds::of(&points));
            assert_eq!(most, all);
        }
    }
}
