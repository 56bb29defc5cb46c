//! Whether a level still has the vessels of the surface it comes from: pinched and lost branches.
//!
//! The middles of the vessels are sampled once: the centres of inner balls ([`InnerRadii`]) of the finest level,
//! one in each cell of half a ball's radius, each with its clearance, the distance to the wall. On a level the same
//! points have to lie inside and clear of the wall: where the clearance has fallen below half of what it was, or the
//! point lies outside, the vessel is pinched or lost there. At a pinch between two samples, the wall comes nearer to
//! one of them than half the radius, so it is not missed.
//!
//! Where the nearest wall is an open end, which side is inside cannot be told; there the distance alone counts.

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use super::{CLEAR, is_inside, ring_median};
use lumen_mesh::parallel;
use lumen_mesh::task::{Yielder, at_once, blocks};
use lumen_mesh::{Ball, InnerRadii, Sides, SurfaceIndex, Topology, TriMesh, rms_edge};

/// The part of the clearance below which a vessel counts as pinched.
pub const PINCHED: f32 = 0.5;

/// Samples at most, the narrowest first.
const MAX_SAMPLES: usize = 20_000;
/// A ball's radius must agree with the median around it to this factor, to be a sample.
const AGREE: f32 = 1.4;
/// A vessel of less than so many mean edges in diameter counts as drawn shut by smoothing: reduction cannot lose it.
pub const SHUT: f64 = 0.25;
/// Samples between two looks at the clock, and inner balls, of about 200 ns each, that may become some.
const SAMPLES: usize = 256;
const BALLS: usize = 4096;
/// Samples that are measured in one piece.
const PIECE: usize = 64;

/// Where a level has narrowed the vessels most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Narrowing {
    /// Clearance on the level over that on the smoothed surface; 0 where the vessel is gone, 1 where all is as it was.
    pub ratio: f64,
    /// Where, in mm.
    pub at_mm: [f32; 3],
    /// Diameter there before, in mm.
    pub diameter_before_mm: f64,
    /// Diameter there on the level, in mm; 0 where the vessel is gone.
    pub diameter_after_mm: f64,
    /// Places where less than half is left.
    pub pinched_places: usize,
}

/// The middles of the vessels of `mesh`, from its inner balls, each with its clearance as radius; `index` is of this surface, in
/// whatever numbering.
pub fn samples(mesh: &TriMesh, topology: &Topology, balls: &InnerRadii, index: &SurfaceIndex) -> Vec<Ball> {
    at_once(samples_in_slices(mesh, topology, balls, index, &Yielder::never()))
}

/// As [`samples`], resting every millisecond or so.
pub async fn samples_in_slices(
    mesh: &TriMesh,
    topology: &Topology,
    balls: &InnerRadii,
    index: &SurfaceIndex,
    yielder: &Yielder,
) -> Vec<Ball> {
    // Radius that a ball must have, in mm.
    let least = (rms_edge(mesh) * SHUT / 2.0) as f32;
    // The cells that have a ball; the balls that may be samples.
    let (mut taken, mut chosen, mut ring) = (HashSet::new(), Vec::new(), Vec::new());
    for block in blocks(balls.own.len(), BALLS) {
        for &v in &balls.own[block] {
            let Some(ball) = balls.ball(mesh, topology, v).filter(|ball| ball.radius > least) else { continue };
            let median = ring_median(topology, &balls.radii, v, &mut ring);
            let agrees = ball.radius * AGREE >= median && ball.radius <= median * AGREE;
            if agrees && taken.insert(cell(&ball)) {
                chosen.push(ball);
            }
        }
        yielder.rest(0.0).await;
    }
    drop(taken);
    let mut found = Vec::new();
    for block in blocks(chosen.len(), SAMPLES) {
        let (end, chosen_now) = (block.end, &chosen[block]);
        let pieces = parallel::map_ranges(chosen_now.len(), PIECE, |piece| {
            chosen_now[piece].iter().filter_map(|ball| sample(ball, index)).collect::<Vec<_>>()
        });
        found.extend(pieces.into_iter().flatten());
        yielder.rest(end as f32 / chosen.len() as f32).await;
    }
    // The narrowest, where they are too many.
    if found.len() > MAX_SAMPLES {
        found.sort_by(|a, b| a.radius.total_cmp(&b.radius));
        found.truncate(MAX_SAMPLES);
    }
    found
}

/// The ball about an inner ball's middle that reaches to the nearest wall, if that middle is inside and clear of the wall.
fn sample(inner: &Ball, index: &SurfaceIndex) -> Option<Ball> {
    let clearance = index.nearest(inner.centre)?.distance;
    let is_middle = clearance >= CLEAR * inner.radius && is_inside(inner.centre, index);
    is_middle.then_some(Ball { centre: inner.centre, radius: clearance })
}

/// The cell of half a radius, rounded down to a power of two, in which a ball's middle lies.
fn cell(ball: &Ball) -> (i32, [i32; 3]) {
    let level = libm::ilogb(f64::from(ball.radius)) - 1;
    let size = libm::exp2(f64::from(level));
    (level, ball.centre.to_array().map(|x| (f64::from(x) / size).floor() as i32))
}

/// For each of a range of samples the clearance on another surface, in mm: 0 outside of it.
pub fn clearances(samples: &[Ball], mesh: &TriMesh, topology: &Topology, index: &SurfaceIndex) -> Vec<f32> {
    let sides = Sides::new(mesh, topology);
    let clearance = |sample: &Ball| {
        let Some(nearest) = index.nearest(sample.centre) else { return 0.0 };
        // Beside triangles that are there twice, once turned, the nearest says no more than chance: rays have the last word.
        let is_outside = sides.is_outside(sample.centre, &nearest) == Some(true) && !is_inside(sample.centre, index);
        if is_outside { 0.0 } else { nearest.distance }
    };
    parallel::map_ranges(samples.len(), PIECE, |piece| samples[piece].iter().map(clearance).collect::<Vec<_>>())
        .concat()
}

/// What a level makes of the samples; `None` without a sample. `index` is of `mesh`.
pub fn narrowing(samples: &[Ball], mesh: &TriMesh, topology: &Topology, index: &SurfaceIndex) -> Option<Narrowing> {
    let clearances = clearances(samples, mesh, topology, index);
    let (worst, ratio) = worst(samples, &clearances)?;
    let pinched: Vec<Ball> =
        samples.iter().zip(&clearances).filter(|(s, c)| **c < PINCHED * s.radius).map(|(s, _)| *s).collect();
    Some(Narrowing {
        ratio: f64::from(ratio),
        at_mm: samples[worst].centre.to_array(),
        diameter_before_mm: 2.0 * f64::from(samples[worst].radius),
        diameter_after_mm: 2.0 * f64::from(clearances[worst]),
        pinched_places: places(pinched),
    })
}

/// The sample with the least part of its clearance left, and that part; of several, the widest.
pub fn worst(samples: &[Ball], clearances: &[f32]) -> Option<(usize, f32)> {
    let ratios = samples.iter().zip(clearances).map(|(sample, left)| left / sample.radius).enumerate();
    ratios.reduce(|least, next| {
        let wider = samples[next.0].radius > samples[least.0].radius;
        if next.1 < least.1 || (next.1 == least.1 && wider) { next } else { least }
    })
}

/// In how many groups of samples, whose balls touch each other, these lie.
fn places(mut pinched: Vec<Ball>) -> usize {
    pinched.sort_by(|a, b| a.centre.x.total_cmp(&b.centre.x));
    let widest = pinched.iter().map(|sample| sample.radius).fold(0.0, f32::max);
    let mut group: Vec<usize> = (0..pinched.len()).collect();
    let root = |group: &mut Vec<usize>, mut i: usize| {
        while group[i] != i {
            group[i] = group[group[i]];
            i = group[i];
        }
        i
    };
    for (i, a) in pinched.iter().enumerate() {
        for (j, b) in pinched.iter().enumerate().skip(i + 1) {
            if b.centre.x - a.centre.x > a.radius + widest {
                break;
            }
            if a.centre.distance(b.centre) <= a.radius + b.radius {
                let (one, other) = (root(&mut group, i), root(&mut group, j));
                group[one.max(other)] = one.min(other);
            }
        }
    }
    (0..group.len()).filter(|&i| group[i] == i).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;
    use lumen_mesh::shapes::{icosphere, tube};
    use lumen_mesh::{Vec3, inner_radii};

    fn indexed(mesh: &TriMesh) -> (Topology, SurfaceIndex) {
        (Topology::new(mesh.positions.len(), &mesh.triangles), SurfaceIndex::new(&mesh.positions, &mesh.triangles))
    }

    fn samples_of(mesh: &TriMesh) -> Vec<Ball> {
        let (topology, index) = indexed(mesh);
        samples(mesh, &topology, &inner_radii(mesh, &topology, &index), &index)
    }

    fn narrowing_of(before: &TriMesh, after: &TriMesh) -> Option<Narrowing> {
        let (topology, index) = indexed(after);
        narrowing(&samples_of(before), after, &topology, &index)
    }

    /// A tube of 1.5 mm with a waist at z = 20.
    fn waisted(waist: f32) -> TriMesh {
        tube(32, 160, 40.0, |z| 0.75 - (0.75 - waist) * (-(z - 20.0) * (z - 20.0)).exp())
    }

    #[test]
    fn beside_a_membrane_of_triangles_twice_both_sides_are_inside() {
        // A disc across a tube that is there twice, once turned.
        let mut mesh = waisted(0.75);
        let rim = (0..32u32).map(|i| Vec2::from_angle(std::f32::consts::TAU * i as f32 / 32.0) * 0.74);
        for is_turned in [false, true] {
            let first = mesh.positions.len() as u32;
            mesh.positions.push(Vec3::Z * 10.0);
            mesh.positions.extend(rim.clone().map(|p| p.extend(10.0)));
            let fan = (0..32).map(|i| [first, first + 1 + i, first + 1 + (i + 1) % 32]);
            mesh.triangles.extend(fan.map(|[a, b, c]| if is_turned { [a, c, b] } else { [a, b, c] }));
        }
        let (topology, index) = indexed(&mesh);
        let samples = [9.7, 10.3].map(|z| Ball { centre: Vec3::new(0.2, 0.1, z), radius: 0.3 });
        for clearance in clearances(&samples, &mesh, &topology, &index) {
            assert!((clearance - 0.3).abs() < 1e-5, "{clearance}");
        }
    }

    #[test]
    fn samples_lie_on_the_axis_close_enough_together() {
        let mut samples = samples_of(&waisted(0.75));
        samples.sort_by(|a, b| a.centre.z.total_cmp(&b.centre.z));
        for sample in &samples {
            assert!(sample.centre.truncate().length() < 0.02 && (sample.radius - 0.75).abs() < 0.02, "{sample:?}");
        }
        assert!(samples.windows(2).all(|pair| pair[1].centre.z - pair[0].centre.z <= 0.75 / 2.0), "{samples:?}");
        assert!(samples[0].centre.z < 0.4 && samples[samples.len() - 1].centre.z > 39.6);
    }

    #[test]
    fn a_surface_narrows_itself_nowhere() {
        let mesh = waisted(0.4);
        let found = narrowing_of(&mesh, &mesh).unwrap();
        assert_eq!((found.ratio, found.pinched_places), (1.0, 0));
        assert_eq!(narrowing_of(&TriMesh::default(), &mesh), None);
    }

    #[test]
    fn a_waist_is_found_where_it_is_and_as_narrow_as_it_is() {
        for waist in [0.5, 0.38, 0.3, 0.05] {
            let found = narrowing_of(&waisted(0.75), &waisted(waist)).unwrap();
            // The nearest sample may lie a quarter of a millimetre beside the waist, and the wall is in facets.
            let slack = 2.0 * (0.75 - f64::from(waist)) * (1.0 - (-0.0625f64).exp()) + 0.02;
            let error = found.diameter_after_mm - 2.0 * f64::from(waist);
            assert!((-0.02..slack + 0.02).contains(&error), "{waist}: {found:?}");
            assert!((found.at_mm[2] - 20.0).abs() < 0.3 && (found.diameter_before_mm - 1.5).abs() < 0.03, "{found:?}");
            assert_eq!(found.pinched_places, usize::from(waist < 0.36), "{waist}: {found:?}");
        }
    }

    #[test]
    fn two_waists_are_two_places() {
        let bump = |z: f32, at: f32| (-(z - at) * (z - at) * 4.0).exp();
        let pinched = tube(32, 160, 40.0, |z| 0.75 - 0.6 * (bump(z, 10.0) + bump(z, 30.0)));
        assert_eq!(narrowing_of(&waisted(0.75), &pinched).unwrap().pinched_places, 2);
    }

    #[test]
    fn a_vessel_that_is_gone_is_lost() {
        let (large, mut both) = (icosphere(3, 10.0, Vec3::ZERO), icosphere(3, 10.0, Vec3::ZERO));
        let small = icosphere(3, 1.0, Vec3::X * 30.0);
        let first = both.positions.len() as u32;
        both.positions.extend(&small.positions);
        both.triangles.extend(small.triangles.iter().map(|t| t.map(|v| v + first)));
        let found = narrowing_of(&both, &large).unwrap();
        assert_eq!((found.ratio, found.diameter_after_mm, found.pinched_places), (0.0, 0.0, 1));
        assert!(Vec3::from(found.at_mm).distance(Vec3::X * 30.0) < 0.1, "{found:?}");
        assert!((found.diameter_before_mm - 2.0).abs() < 0.1, "{found:?}");
    }
}
