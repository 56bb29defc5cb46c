//! Centrelines and calibres of the samples, beside the centrelines with diameters that they are made from.

use std::sync::Arc;

use lumen::mesh::{Vec3, components};
use lumen::phantom::{Sample, Vessel, generate, vessels};
use lumen::task::{Yielder, at_once};
use lumen::vessel::Subject;
use lumen::vessel::certificate::{Certificate, StationStatus, TOLERANCE_PERCENT};

type Point = [f64; 3];

fn distance(a: Point, b: Point) -> f64 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt()
}

/// Distance of `p` from a line of points, and what stands beside them there.
fn beside(p: Point, line: &[(Point, f64)]) -> (f64, f64) {
    let of = |pair: &[(Point, f64)]| {
        let ((a, one), (b, other)) = (pair[0], pair[1]);
        let along: f64 = (0..3).map(|i| (p[i] - a[i]) * (b[i] - a[i])).sum();
        let part = (along / distance(a, b).powi(2).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let projection = [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part);
        (distance(p, projection), one + (other - one) * part)
    };
    line.windows(2).map(of).fold((f64::INFINITY, 0.0), |least, next| if next.0 < least.0 { next } else { least })
}

fn certificate(sample: Sample, triangles: usize) -> Certificate {
    let mesh = generate(sample, triangles).unwrap();
    let pieces = components(mesh.positions.len(), &mesh.triangles);
    let largest = pieces.largest().unwrap();
    let subject = Subject::new(&Arc::new(mesh.filtered(|t| pieces.of_triangle[t] == largest)));
    let subjects = [0, 1, 2].map(|_| subject.clone());
    at_once(Certificate::of(subjects, TOLERANCE_PERCENT, &Yielder::never())).unwrap()
}

fn line_of(vessel: &Vessel) -> Vec<(Point, f64)> {
    vessel.stations.iter().map(|station| (station.position.to_array(), station.diameter / 2.0)).collect()
}

/// Voxels across, from which on a mask shows a vessel's calibre at each place. Thinner ones it does on the whole.
const WIDE: f64 = 6.0;

/// Where the sample is one round vessel, the Hausdorff distance of the centrelines is at most 0.3 mm, and the radius is
/// within 3 %: at each station of wide vessels, in the mean of thin ones.
fn check(sample: Sample, triangles: usize, voxel: f64) {
    let found = certificate(sample, triangles);
    let truth: Vec<_> = vessels(sample).iter().map(line_of).collect();
    let stations: Vec<(Point, bool, Option<f32>)> = found
        .branches
        .iter()
        .flat_map(|branch| {
            let one = |i: usize| {
                let p = Vec3::from(branch.at_mm[i]).as_dvec3().to_array();
                (p, branch.standings[i] == StationStatus::Counts, branch.opened.radii_mm[i])
            };
            (0..branch.at_mm.len()).map(one)
        })
        .collect();
    let (mut looked_at, mut thin) = (0, Vec::new());
    for &(p, counts, radius) in stations.iter().filter(|station| station.1) {
        // The vessel that holds it deepest.
        let all = truth.iter().map(|line| beside(p, line));
        let deepest =
            |least: (f64, f64), next: (f64, f64)| if next.0 - next.1 < least.0 - least.1 { next } else { least };
        let (off, expected) = all.reduce(deepest).unwrap();
        assert!(counts && off <= 0.3, "{p:?}: {off} mm off");
        let error = f64::from(radius.unwrap()) / expected - 1.0;
        if 2.0 * expected >= WIDE * voxel {
            assert!(error.abs() <= 0.03, "{p:?}: {radius:?} mm, not {expected}");
        } else {
            thin.push(error);
        }
        looked_at += 1;
    }
    let mean = thin.iter().sum::<f64>() / thin.len().max(1) as f64;
    assert!(mean.abs() <= 0.03, "of {} stations in thin vessels {mean}", thin.len());
    assert!(looked_at * 2 > stations.len(), "{looked_at} of {} stations", stations.len());
    let lines: Vec<Vec<(Point, f64)>> = found
        .branches
        .iter()
        .filter(|branch| branch.at_mm.len() > 1)
        .map(|branch| branch.at_mm.iter().map(|&p| (Vec3::from(p).as_dvec3().to_array(), 0.0)).collect())
        .collect();
    for (p, _) in truth.iter().flatten() {
        let nearest = stations.iter().min_by(|a, b| distance(a.0, *p).total_cmp(&distance(b.0, *p))).unwrap();
        if nearest.1 {
            let off = lines.iter().map(|line| beside(*p, line).0).fold(f64::INFINITY, f64::min);
            assert!(off <= 0.3, "{p:?}: {off} mm off");
        }
    }
}

#[test]
fn the_aorta_has_the_centrelines_and_radii_that_it_was_made_from() {
    check(Sample::Aorta, 74_307, 0.742);
    check(Sample::Aorta, 300_000, 0.369);
}

#[test]
fn the_coronary_arteries_have_theirs() {
    check(Sample::Coronary, 380_000, 0.498);
}
