//! How far a reduction is called safe, audited by cross-sections that share no code with the search: straight vessels about
//! the z axis, whose areas at a height are sums over the triangles that the plane cuts.

use std::f64::consts::PI;
use std::sync::Arc;

use lumen::mesh::{TriMesh, Vec3};
use lumen::pipeline::report::Report;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::safe::{NoSafeRate, Safe};
use lumen::pipeline::settings::{Method, Settings, Smoothing, Target};
use lumen::pipeline::stage::Stage;
use lumen::pipeline::task::Budget;

use crate::smoothing::{tube, turned};

/// Area within the surface at a height: each triangle's cut is a segment, and Green's theorem adds them up.
fn area(mesh: &TriMesh, height: f64) -> f64 {
    let twice = mesh.triangles.iter().map(|t| {
        let corners = t.map(|v| mesh.positions[v as usize].as_dvec3());
        let is_above = corners.map(|p| p.z > height);
        let alone = (0..3).find(|&i| is_above[i] != is_above[(i + 1) % 3] && is_above[i] != is_above[(i + 2) % 3]);
        let Some(i) = alone else { return 0.0 };
        let at = |k: usize| {
            let (p, q) = (corners[i], corners[(i + k) % 3]);
            p.lerp(q, (height - p.z) / (q.z - p.z))
        };
        let (a, b) = (at(1), at(2));
        let cross = a.x * b.y - a.y * b.x;
        // Seen from outside triangles run anticlockwise: the cut runs from the second side to the third below a corner.
        if is_above[i] { cross } else { -cross }
    });
    (twice.sum::<f64>() / 2.0).abs()
}

/// Radius of the circle of the mean area over a stretch as long as the vessel is wide, as the certificate has it.
fn radius(mesh: &TriMesh, height: f64, reach: f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in -24..=24 {
        let from = f64::from(i) / 24.0;
        let weight = 1.0 - from.abs();
        sum += weight * area(mesh, height + from * reach);
        weights += weight;
    }
    (sum / weights / PI).sqrt()
}

/// The largest change of the radius in percent between two heights.
fn worst(before: &TriMesh, after: &TriMesh, heights: std::ops::Range<u32>, reach: f64) -> f64 {
    let change = |z: u32| {
        let [before, after] = [before, after].map(|mesh| radius(mesh, f64::from(z) / 2.0, reach));
        100.0 * (after / before - 1.0).abs()
    };
    heights.map(change).fold(0.0, f64::max)
}

fn found(mesh: &Arc<TriMesh>, settings: &Settings, tolerance: f64) -> (Pipeline, Safe) {
    let settings = Settings { tolerance_percent: tolerance, ..settings.clone() };
    let mut pipeline = Pipeline::new(mesh.clone(), settings).with_samples(200).with_safe();
    pipeline.finish().unwrap();
    let safe = (**pipeline.safe().unwrap()).clone();
    (pipeline, safe)
}

fn level(pipeline: &mut Pipeline, per_mille: u32) -> TriMesh {
    pipeline.set(Settings { target: Target::Reduction(per_mille), ..pipeline.settings().clone() }).unwrap();
    pipeline.finish().unwrap();
    (*pipeline.reduced().unwrap().mesh).clone()
}

#[test]
fn the_marked_rate_keeps_the_calibre_and_the_next_does_not() {
    let mesh = Arc::new(tube(3.0, 60.0, 0.7, 0.1));
    for (method, tolerance) in [(Method::Schroeder, 2.0), (Method::Schroeder, 5.0), (Method::Quadric, 2.0)] {
        let mut settings = Settings::default();
        settings.decimation.method = method;
        let (mut pipeline, safe) = found(&mesh, &settings, tolerance);
        let rate = (safe.percent.unwrap() * 10.0).round() as u32;
        assert!(rate > 500 && safe.branches.len() == 1 && safe.refused.is_none(), "{safe:?}");
        let [here, next] = [rate, rate + 1].map(|rate| {
            let after = level(&mut pipeline, rate);
            worst(&mesh, &after, 8..112, 3.0)
        });
        // The audit's heights are not the search's stations.
        assert!(here < tolerance + 0.2, "{method:?}: {here} % at {rate}");
        assert!(next > tolerance - 0.2, "{method:?}: only {next} % at the next, {safe:?}");
        assert!(safe.stopped_by.is_some());
    }
}

#[test]
fn auto_goes_as_far_as_is_safe_and_no_farther_than_ninety_percent() {
    // About thirteen edges around it: of a tenth of them no circle is left.
    let mesh = Arc::new(tube(2.0, 40.0, 1.0, 0.0));
    let auto = |pipeline: &Pipeline| pipeline.reduced().unwrap().mesh.clone();
    let mut followed = Pipeline::new(mesh.clone(), Settings::default()).with_samples(200).with_safe();
    let rates = [20.0, 2.0, 3.0].map(|tolerance| {
        let settings = Settings { tolerance_percent: tolerance, ..Settings::default() };
        let (mut shown, safe) = found(&mesh, &settings, tolerance);
        let rate = safe.percent.unwrap().min(90.0);
        let found = auto(&shown);
        let told = Report::new("tube", &shown).unwrap().auto.unwrap();
        assert!(told.is_decided && (told.percent - rate).abs() < 1e-9, "{told:?}");
        // Who sees no level before has the same, and so has who goes on from another tolerance, after a cancel on the way.
        let mut alone = Pipeline::new(mesh.clone(), settings.clone()).without_measures();
        alone.finish().unwrap();
        assert_eq!(auto(&alone), found);
        followed.set(settings).unwrap();
        while followed.next_stage() != Some(Stage::Level) && followed.next_stage().is_some() {
            followed.advance(Budget::UNLIMITED).unwrap();
        }
        followed.cancel();
        followed.finish().unwrap();
        assert_eq!(auto(&followed), found);
        assert_eq!(level(&mut shown, (rate * 10.0).round() as u32), *found, "as the number gives it");
        rate
    });
    assert!(rates[0] == 90.0 && rates[1] < rates[2] && rates[2] < 90.0, "{rates:?}");
}

#[test]
fn a_larger_tolerance_is_never_safe_for_less() {
    let narrow = |z: f64| if (25.0..35.0).contains(&z) { 1.6 } else { 4.0 };
    let mesh = Arc::new(turned(36, 60.0, 0.7, 0.05, narrow));
    let percents = [0.5, 1.0, 2.0, 5.0, 20.0].map(|tolerance| {
        let (_, safe) = found(&mesh, &Settings::default(), tolerance);
        safe.percent.unwrap_or(-1.0)
    });
    assert!(percents.is_sorted() && percents[4] > 90.0, "{percents:?}");
}

/// A duct of four flat sides about the z axis, of so many rings 1 mm apart, with two flanges round each end: the rims are
/// on edges of three triangles, and stay.
fn flanged(rings: u16) -> TriMesh {
    let around =
        [(-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0)].map(|(x, y)| (x as f32, y as f32));
    let end = f32::from(rings - 1);
    let walls = (0..rings).map(|ring| (3.0, f32::from(ring)));
    let flanges = [-0.5, 0.5, end - 0.5, end + 0.5].map(|z| (3.5, z));
    let place = |(half, z): (f32, f32)| around.map(|(x, y)| Vec3::new(x * half, y * half, z));
    // A band of quads between two rings.
    let band = |(lower, upper): (u16, u16)| {
        (0..8).flat_map(move |i| {
            let next = (i + 1) % 8;
            let [a, b, c, d] =
                [(lower, i), (lower, next), (upper, next), (upper, i)].map(|(r, i)| u32::from(8 * r + i));
            [[a, b, c], [a, c, d]]
        })
    };
    let bands = (0..rings - 1).map(|ring| (ring, ring + 1));
    let rims = [(0, rings), (0, rings + 1), (rings - 1, rings + 2), (rings - 1, rings + 3)];
    TriMesh {
        positions: walls.chain(flanges).flat_map(place).collect(),
        triangles: bands.chain(rims).flat_map(band).collect(),
    }
}

#[test]
fn what_is_called_safe_can_be_reached() {
    let mesh = Arc::new(flanged(60));
    let settings = Settings { smoothing: Smoothing::NONE, ..Settings::default() };
    // More than the coarsest level of what is left changes it by.
    let (mut pipeline, safe) = found(&mesh, &settings, 50.0);
    let percent = safe.percent.unwrap_or_else(|| panic!("{safe:?}"));
    assert!(percent > 90.0 && percent < 99.0 && safe.stopped_by.is_none(), "{safe:?}");
    let after = level(&mut pipeline, (percent * 10.0).round() as u32);
    assert!(pipeline.reduced().unwrap().level.shortfall.is_none());
    assert!(after.triangles.len().abs_diff(safe.triangles.unwrap()) <= 4, "{} {safe:?}", after.triangles.len());
    // It goes no further.
    level(&mut pipeline, (percent * 10.0).round() as u32 + 1);
    assert!(pipeline.reduced().unwrap().level.shortfall.is_some());
}

#[test]
fn branches_that_smoothing_changes_are_told_and_do_not_count() {
    // The paper's filter draws a vessel of 1.5 mm on edges of 0.7 mm shut.
    let mesh = Arc::new(tube(1.5, 40.0, 0.7, 0.05));
    let settings = Settings { smoothing: Smoothing::PAPER, ..Settings::default() };
    let (_, safe) = found(&mesh, &settings, 2.0);
    assert!(safe.branches.iter().all(|branch| branch.changed_by_smoothing), "{safe:?}");
    assert!(safe.percent.is_none() && safe.refused == Some(NoSafeRate::NoneKept));
    let (_, safe) = found(&mesh, &Settings::default(), 2.0);
    assert!(safe.percent.is_some_and(|percent| percent > 20.0), "{safe:?}");
    assert!(safe.branches.iter().all(|branch| !branch.changed_by_smoothing), "{safe:?}");
}

#[test]
fn what_has_no_inside_has_no_safe_rate_and_says_why() {
    let positions = (0..400u16).map(|i| Vec3::new(f32::from(i % 20), f32::from(i / 20), 0.0)).collect();
    let square = |i: u32| [[i, i + 1, i + 21], [i, i + 21, i + 20]];
    let triangles = (0..380u32).filter(|i| i % 20 < 19).flat_map(square).collect();
    let (_, safe) = found(&Arc::new(TriMesh { positions, triangles }), &Settings::default(), 2.0);
    assert!(safe.percent.is_none() && safe.refused.is_some_and(|why| why.to_string().contains("no inside")));
}
