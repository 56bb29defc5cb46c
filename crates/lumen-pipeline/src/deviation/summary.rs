//! What a deviation is told in: mean, RMS, percentile and maximum of the distances.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Two-sided distance between two surfaces, in mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deviation {
    /// Mean over the samples of both surfaces.
    pub mean: f64,
    /// Root of the mean square over the samples.
    pub rms: f64,
    /// 95th percentile of the samples, interpolated between neighbours.
    pub p95: f64,
    /// Largest over the samples and the vertices of both surfaces.
    pub max: f64,
    /// Where: the two points that are so far apart, on the first surface and on the second, in mm.
    pub max_at_mm: [[f32; 3]; 2],
}

/// Two points that are farther apart than all before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Farthest {
    /// Less than 0 where there is none yet.
    pub(super) distance: f32,
    /// On the first surface and on the second.
    pub(super) points: [Vec3; 2],
}

impl Default for Farthest {
    fn default() -> Self {
        Self { distance: -1.0, points: [Vec3::ZERO; 2] }
    }
}

impl Farthest {
    pub(super) fn take(&mut self, other: Self) {
        if other.distance > self.distance {
            *self = other;
        }
    }
}

/// Summary of at least one distance; leaves them in another order.
pub(super) fn summary(distances: &mut [f32], farthest: &Farthest) -> Deviation {
    let (mut sum, mut squares) = (0.0, 0.0);
    for &distance in &*distances {
        let distance = f64::from(distance);
        sum += distance;
        squares += distance * distance;
    }
    let count = distances.len() as f64;
    let rank = 0.95 * (count - 1.0);
    let (_, &mut at, above) = distances.select_nth_unstable_by(rank as usize, f32::total_cmp);
    let next = above.iter().copied().min_by(f32::total_cmp).unwrap_or(at);
    let (at, next) = (f64::from(at), f64::from(next));
    Deviation {
        mean: sum / count,
        rms: (squares / count).sqrt(),
        p95: at + (next - at) * rank.fract(),
        max: f64::from(farthest.distance.max(0.0)),
        max_at_mm: farthest.points.map(|p| p.to_array()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_percentile_is_interpolated() {
        let mut distances: Vec<f32> = (0..=10).rev().map(|i| i as f32).collect();
        let farthest = Farthest { distance: 11.0, points: [Vec3::X, Vec3::Y] };
        let found = summary(&mut distances, &farthest);
        assert!((found.p95 - 9.5).abs() < 1e-12);
        assert_eq!((found.mean, found.rms, found.max), (5.0, 35f64.sqrt(), 11.0));
        let max_at_mm = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(found.max_at_mm, max_at_mm);
        let alone = summary(&mut [2.0], &Farthest { distance: 2.0, ..farthest });
        assert_eq!(alone, Deviation { mean: 2.0, rms: 2.0, p95: 2.0, max: 2.0, max_at_mm });
    }
}
