//! The deviation of one surface from another: how far apart they are, in millimetres, measured both ways.
//!
//! Each surface is sampled evenly by area and each sample is measured to the nearest point of the other; mean, RMS and
//! 95th percentile are over the pooled samples of both, as in Metro (Cignoni, Rocchini and Scopigno, "Metro: measuring
//! error on simplified surfaces", 1998). The maximum is over the samples and all
//! vertices of both, so it misses no tip; it remains a lower bound of the Hausdorff distance, which can lie between.
//!
//! Sample `i` of `n` lies in the `i`-th of `n` equal parts of the area, in the order of the triangles (of the second
//! surface in that of its index, where neighbours in space follow each other), and its place there comes from a hash of
//! `i` (SplitMix64: Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014). A sample is thus known
//! from its number alone, and the result depends on neither slices nor threads: all cores measure samples, and of equal
//! distances the first counts.
//!
//! The same samples make a map over the second surface ([`Comparing::with_map`]): each counts at the corners of the
//! triangle that it lies on or is nearest to, by its place there, and a vertex has the mean of what counts at it. So the
//! mean over the map is the mean that is reported, and its range is that of the percentile: a map of the farthest point
//! around each vertex would be of another kind than the numbers beside it. With the map come the histogram of the samples
//! and the map of signed distances: a sample has the sign of the way from the first surface to the second, seen along the
//! normal of the triangle that it lies on, positive where the second lies outside.

mod align;
mod map;
mod sampling;
mod summary;
mod task;

pub use align::{Aligned, Rigid, align};
pub use summary::Deviation;
pub use task::{Compared, Comparing, Comparison, compare};

use lumen_mesh::TriMesh;
use lumen_mesh::task::{Yielder, at_once};

/// Samples of each surface for a report.
pub const REPORT_SAMPLES: usize = 200_000;
/// Samples of each surface while a user waits.
pub const INTERACTIVE_SAMPLES: usize = 50_000;

/// The deviation between `a` and `b` by `samples` samples of each (at least one); `None` where one of them has no area.
///
/// # Panics
/// When an index of a triangle is out of range.
pub fn deviation(a: &TriMesh, b: &TriMesh, samples: usize) -> Option<Deviation> {
    let how = Comparing { samples, ..Comparing::default() };
    Some(at_once(compare(a, b, how, &Yielder::never())).comparison?.deviation)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::histogram::Histogram;
    use lumen_mesh::parallel;
    use lumen_mesh::shapes::{icosphere, sagitta, square};
    use lumen_mesh::task::{Budget, Progress, Running};
    use lumen_mesh::{Vec3, triangle_area};

    const SAMPLES: usize = 20_000;

    fn comparison(a: &TriMesh, b: &TriMesh, how: Comparing) -> Comparison {
        at_once(compare(a, b, how, &Yielder::never())).comparison.unwrap()
    }

    /// With a map.
    fn compared(a: &TriMesh, b: &TriMesh, samples: usize) -> Comparison {
        comparison(a, b, Comparing { samples, with_map: true, ..Comparing::default() })
    }

    #[test]
    fn parallel_planes_are_their_distance_apart() {
        let found = deviation(&square(7, 8.0, 1.0), &square(16, 8.0, 3.5), SAMPLES).unwrap();
        assert_eq!([found.mean, found.rms, found.p95, found.max], [2.5; 4]);
        assert_eq!(found.max_at_mm.map(|[.., z]| z), [1.0, 3.5]);
    }

    #[test]
    fn a_surface_does_not_deviate_from_itself() {
        let sphere = icosphere(4, 20.0, Vec3::new(100.0, 50.0, -30.0));
        let found = deviation(&sphere, &sphere, SAMPLES).unwrap();
        // A sample is rounded to f32, by at most 4e-6 mm a coordinate here.
        assert!(found.max < 1e-5, "{found:?}");
    }

    #[test]
    fn concentric_spheres_are_the_difference_of_their_radii_apart() {
        let (small, large) = (icosphere(5, 10.0, Vec3::ONE), icosphere(4, 12.0, Vec3::ONE));
        let slack = f64::from(sagitta(&small, 10.0, Vec3::ONE).max(sagitta(&large, 12.0, Vec3::ONE)));
        let found = deviation(&small, &large, SAMPLES).unwrap();
        for value in [found.mean, found.rms, found.p95, found.max] {
            assert!((value - 2.0).abs() <= slack + 1e-5, "{found:?}, slack {slack}");
        }
        assert!(found.mean <= found.rms && found.rms <= found.p95 && found.p95 <= found.max);
    }

    #[test]
    fn a_sphere_that_was_moved_is_as_far_as_it_was_moved_at_most_and_half_of_it_on_average() {
        let (radius, shift) = (10.0, 0.1);
        let sphere = icosphere(5, radius, Vec3::ZERO);
        let moved = icosphere(5, radius, Vec3::X * shift);
        let found = deviation(&moved, &sphere, SAMPLES).unwrap();
        let slack = f64::from(sagitta(&sphere, radius, Vec3::ZERO));
        // The distance is |shift cos(angle)| to first order, and cos is spread evenly over a sphere.
        let shift = f64::from(shift);
        assert!((found.max - shift).abs() <= slack, "{found:?}");
        assert!((found.mean - shift / 2.0).abs() <= slack, "{found:?}");
        assert!((found.rms - shift / 3f64.sqrt()).abs() <= slack, "{found:?}");
        assert!((found.p95 - shift * 0.95).abs() <= slack, "{found:?}");
    }

    #[test]
    fn what_one_surface_lacks_counts_once_whichever_comes_first() {
        // Half of a square of 10 mm is missing: the whole is 0 to 5 mm from it there, it is nowhere from the whole. Over
        // the samples of both: mean 5/8, mean square 25/12, and one in twenty farther than 4 mm.
        let (whole, mut half) = (square(16, 10.0, 0.0), square(16, 10.0, 0.0));
        half.triangles.retain(|t| t.iter().all(|&v| whole.positions[v as usize].x <= 5.0));
        let expected = [5.0 / 8.0, (25.0f64 / 12.0).sqrt(), 4.0, 5.0];
        for (a, b) in [(&whole, &half), (&half, &whole)] {
            let found = deviation(a, b, SAMPLES).unwrap();
            for (value, expected) in [found.mean, found.rms, found.p95, found.max].into_iter().zip(expected) {
                assert!((value - expected).abs() < 0.01, "{found:?}");
            }
        }
    }

    #[test]
    fn a_tip_between_the_samples_counts_for_the_maximum_from_either_side() {
        let flat = square(10, 10.0, 0.0);
        let mut tipped = flat.clone();
        tipped.positions[60].z = 3.0;
        for (a, b) in [(&tipped, &flat), (&flat, &tipped)] {
            let found = comparison(a, b, Comparing { samples: 10, ..Comparing::default() });
            assert_eq!(found.deviation.max, 3.0);
            let tip = tipped.positions[60].to_array();
            let projection = [tip[0], tip[1], 0.0];
            let expected = if std::ptr::eq(a, &tipped) { [tip, projection] } else { [projection, tip] };
            assert_eq!(found.deviation.max_at_mm, expected);
        }
    }

    #[test]
    fn the_map_is_the_mean_around_each_vertex_and_over_all_the_mean_that_is_reported() {
        // A floor below two storeys of one ceiling, with a ramp from the one to the other.
        let floor = square(20, 10.0, 0.0);
        let mut steps = floor.clone();
        steps.positions.iter_mut().for_each(|p| p.z = 0.5 + ((p.x - 3.0) * 0.375).clamp(0.0, 1.5));
        let found = compared(&floor, &steps, SAMPLES);
        for (p, &near) in steps.positions.iter().zip(&found.map) {
            let expected = if p.x < 2.0 { 0.5 } else { 2.0 };
            assert!((2.0..8.5).contains(&p.x) || (near - expected).abs() < 1e-4, "{p}: {near}");
        }
        let share = |t: &[u32; 3]| {
            let area = triangle_area(t.map(|v| steps.positions[v as usize]));
            let values: f64 = t.iter().map(|&v| f64::from(found.map[v as usize])).sum();
            [area, area * values / 3.0]
        };
        let [area, sum] = steps.triangles.iter().map(share).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        assert!((sum / area / found.deviation.mean - 1.0).abs() < 0.05, "{} of {:?}", sum / area, found.deviation);
    }

    #[test]
    fn what_lies_outside_is_positive_and_what_lies_inside_negative() {
        let (small, large) = (icosphere(4, 10.0, Vec3::ZERO), icosphere(4, 11.0, Vec3::ZERO));
        for (a, b, sign) in [(&small, &large, 1.0), (&large, &small, -1.0)] {
            let found = compared(a, b, SAMPLES);
            assert!(found.signed_map.iter().all(|&signed| (signed - sign).abs() < 0.05), "{sign}");
            let Histogram { inside, outside, .. } = &found.histogram;
            let (inside, outside) = (inside.iter().sum::<u32>(), outside.iter().sum::<u32>());
            let expected = 2 * SAMPLES as u32;
            assert_eq!((inside, outside), if sign > 0.0 { (0, expected) } else { (expected, 0) });
        }
        // A sphere that was moved lies outside where it was moved to, by as much as the cosine says.
        let moved = icosphere(4, 10.0, Vec3::X * 0.5);
        let found = compared(&small, &moved, SAMPLES);
        for (p, &signed) in moved.positions.iter().zip(&found.signed_map) {
            let expected = 0.5 * (p.x - 0.5) / 10.0;
            assert!((signed - expected).abs() < 0.06, "{p}: {signed} for {expected}");
        }
        let over = found.histogram.percent_over(f64::from(0.25f32));
        assert!((over - 50.0).abs() < 1.5, "|cos| is more than a half on half of a sphere: {over}");
        let share = found.histogram.percent_over(found.deviation.p95);
        assert!((share - 5.0).abs() < 0.3, "percentile and histogram are of the same samples: {share}");
    }

    #[test]
    fn a_map_of_few_samples_has_no_holes_and_none_is_made_unless_asked() {
        let (low, high) = (square(40, 10.0, 0.0), square(40, 10.0, 3.0));
        let found = compared(&low, &high, 5);
        assert!(found.map.iter().all(|&near| (near - 3.0).abs() < 1e-5), "{:?}", found.map);
        assert!(comparison(&low, &high, Comparing { samples: 5, ..Comparing::default() }).map.is_empty());
    }

    #[test]
    fn vertices_that_no_triangle_uses_do_not_count() {
        let flat = square(4, 4.0, 0.0);
        let mut littered = flat.clone();
        littered.positions.extend([Vec3::splat(50.0), Vec3::splat(f32::NAN)]);
        for (a, b) in [(&littered, &flat), (&flat, &littered)] {
            let found = compared(a, b, 100);
            assert_eq!((found.deviation.max, found.map), (0.0, vec![0.0; b.positions.len()]));
        }
    }

    #[test]
    fn a_surface_without_area_has_no_deviation() {
        let (flat, empty) = (square(2, 2.0, 0.0), TriMesh::default());
        let line = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0], triangles: vec![[0, 1, 2]] };
        for (a, b) in [(&flat, &empty), (&empty, &flat), (&empty, &empty), (&line, &flat), (&flat, &line)] {
            assert_eq!(deviation(a, b, 10), None);
        }
    }

    #[test]
    fn slices_and_a_given_index_change_nothing() {
        let (a, b) = (&icosphere(3, 10.0, Vec3::ZERO), &icosphere(4, 10.5, Vec3::X));
        let how = Comparing { samples: 5000, with_map: true, ..Comparing::default() };
        let whole = compared(a, b, 5000);
        let mut running = Running::new(|yielder| async move { compare(a, b, how, &yielder).await });
        let mut fraction = 0.0;
        let sliced = loop {
            match running.advance(Budget::new(Duration::ZERO)) {
                Progress::Working(now) => {
                    assert!((fraction..=1.0).contains(&now), "{fraction} then {now}");
                    fraction = now;
                }
                Progress::Done(result) => break result,
            }
        };
        assert_eq!(sliced.comparison.unwrap(), whole);
        let indices = sliced.indices;
        assert_eq!(comparison(a, b, Comparing { samples: 5000, with_map: true, indices }), whole);
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let (a, b) = (icosphere(4, 10.0, Vec3::ZERO), icosphere(3, 10.2, Vec3::new(0.3, 0.2, 0.1)));
        let all = |threads| parallel::with_threads(threads, || compared(&a, &b, 5000));
        let alone = all(1);
        assert_eq!([all(2), all(7)], [alone.clone(), alone]);
    }
}
