//! Detached islands: the specks that thresholding a noisy scan leaves beside the vessels.
//!
//! Noise has the size of voxels, not of anatomy, so islands are sized in voxels and look the same at every
//! resolution. They lie near the walls and touch neither them nor one another. Places come from a linear
//! congruential generator (Knuth's MMIX constants), so they are the same everywhere and in every run.

use glam::DVec3;

use super::field::Field;
use super::vessel::Vessel;

/// Islands beside a sample's vessels.
pub(super) const COUNT: usize = 12;
/// Places tried before giving up; coarse grids leave little room beside the vessels.
const TRIES: usize = 4000;

/// Adds up to [`COUNT`] islands to `field`, beside `vessels`.
pub(super) fn scatter(field: &mut Field, vessels: &[Vessel], spacing: DVec3, seed: u64) {
    let voxel = spacing.max_element();
    let mut random = Random(seed);
    let mut placed: Vec<(DVec3, f64)> = Vec::new();
    for _ in 0..TRIES {
        if placed.len() == COUNT {
            break;
        }
        let vessel = &vessels[random.below(vessels.len())];
        let station = vessel.stations[random.below(vessel.stations.len())];
        // Two voxels across to about six; small ones are the more frequent.
        let size = random.unit();
        let radius = voxel * (1.2 + 2.0 * size * size);
        let gap = radius + 3.0 * voxel + 6.0 * random.unit();
        let centre = station.position + random.direction() * (station.diameter / 2.0 + gap);
        let clearance = radius + 2.5 * voxel;
        let crowded = placed.iter().any(|(other, reach)| other.distance(centre) < reach + clearance);
        if crowded || field.distance(centre) < clearance || field.is_behind_an_end(centre, clearance) {
            continue;
        }
        placed.push((centre, radius));
    }
    for (centre, radius) in placed {
        // A lump of three: a core, and two arms that stay within the radius.
        field.begin_part(0.0);
        let core = 0.7 * radius;
        field.add([centre; 2], [core; 2]);
        for _ in 0..2 {
            let arm = (0.35 + 0.25 * random.unit()) * radius;
            let tip = centre + random.direction() * (radius - arm);
            field.add([centre, tip], [core, arm]);
        }
    }
}

/// A linear congruential generator modulo 2^64.
struct Random(u64);

impl Random {
    /// Uniform in 0..1.
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // The low bits of such a generator have short periods.
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in 0..n.
    fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }

    /// Uniform over the unit sphere, by rejection from the cube.
    fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0;
            let squared = v.length_squared();
            if squared > 0.01 && squared < 1.0 {
                return v / squared.sqrt();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_have_unit_length_and_no_preferred_side() {
        let mut random = Random(1);
        let mut sum = DVec3::ZERO;
        for _ in 0..10_000 {
            let direction = random.direction();
            assert!((direction.length() - 1.0).abs() < 1e-12);
            sum += direction;
        }
        assert!(sum.length() < 300.0, "three standard deviations of the mean of 10,000: {sum}");
    }
}
