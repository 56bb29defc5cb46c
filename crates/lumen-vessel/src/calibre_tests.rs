//! The certificate on surfaces whose calibre is known.

use std::f64::consts::PI;
use std::sync::Arc;
use std::time::Duration;

use glam::{DVec3, Vec3};

use super::certificate::*;
use super::{Centrelines, Subject, TreeError};
use lumen_mesh::TriMesh;
use lumen_mesh::shapes::{fork, icosphere, in_capsule, isosurface, square, tube};
use lumen_mesh::task::{Budget, Progress, Running};

fn task(surfaces: [&TriMesh; 3]) -> Running<'static, Result<Certificate, CalibreError>> {
    let subjects = surfaces.map(|mesh| Subject::new(&Arc::new(mesh.clone())));
    Running::new(|yielder| async move { Certificate::of(subjects, TOLERANCE_PERCENT, &yielder).await })
}

fn certificate(surfaces: [&TriMesh; 3]) -> Certificate {
    task(surfaces).finish().unwrap()
}

fn at(branch: &BranchCalibre, i: usize) -> DVec3 {
    Vec3::from(branch.at_mm[i]).as_dvec3()
}

/// The numbers of the stations that count.
fn counted(branch: &BranchCalibre) -> impl Iterator<Item = usize> + '_ {
    (0..branch.standings.len()).filter(|&i| branch.standings[i] == StationStatus::Counts)
}

/// The surface around what `inside` holds, as a grid of whole points in or out would have it: with stair-steps.
fn stepped(low: DVec3, high: DVec3, spacing: f64, inside: impl Fn(DVec3) -> f64) -> TriMesh {
    isosurface(low, high, spacing, |p| inside(p).signum())
}

#[test]
fn what_is_the_same_has_not_changed_and_has_the_area_of_its_circle() {
    let cone = |z: f32| 4.0 - 0.05 * z;
    for (mesh, radius) in [
        (tube(96, 120, 40.0, |_| 3.0), Box::new(|_| 3.0) as Box<dyn Fn(f64) -> f64>),
        (tube(96, 160, 40.0, cone), Box::new(|z: f64| 4.0 - 0.05 * z)),
    ] {
        let found = certificate([&mesh; 3]);
        assert_eq!((found.verdict, found.branches.len()), (Verdict::Kept, 1));
        let branch = &found.branches[0];
        assert!((branch.tortuosity.unwrap() - 1.0).abs() < 1e-3 && (branch.length_mm - 40.0).abs() < 0.1);
        assert!(branch.abscissas_mm.windows(2).all(|pair| pair[1] - pair[0] <= 1.0));
        assert!(branch.stations_counted * 5 > branch.standings.len() * 4);
        for i in counted(branch) {
            let (area, expected) = (f64::from(branch.opened.areas_mm2[i].unwrap()), radius(at(branch, i).z));
            assert!((area / (PI * expected * expected) - 1.0).abs() < 0.005, "{area} at {i}");
            assert!((f64::from(branch.opened.radii_mm[i].unwrap()) / expected - 1.0).abs() < 0.005);
        }
        for of in [&branch.smoothed, &branch.reduced] {
            assert_eq!(of.largest_change.unwrap().percent, 0.0);
            assert_eq!(
                (&of.areas_mm2, &of.inscribed_radii_mm),
                (&branch.opened.areas_mm2, &branch.opened.inscribed_radii_mm)
            );
        }
        assert!(branch.opened.largest_change.is_none());
    }
}

/// The most that stations lie apart, in mm: each of the ends of what is measured is known to that.
const APART: f64 = 1.0;

#[test]
fn coverage_is_the_length_away_from_open_ends_over_all_of_it() {
    // Of an open tube a radius is left out at each end.
    for (length, is_enough) in [(60.0f32, true), (40.0, true), (20.0, false), (12.0, false)] {
        let found = certificate([&tube(96, 4 * length as u32, length, |_| 3.0); 3]);
        let (coverage, length) = (found.coverage, f64::from(length));
        assert_eq!((found.verdict, coverage.vessels, coverage.vessels_measured), (Verdict::Kept, 1, 1));
        assert!((coverage.length_mm - length).abs() < 0.1, "{coverage:?}");
        assert!((coverage.measured_mm - (length - 6.0)).abs() <= 2.0 * APART, "{coverage:?}");
        assert!((coverage.measured_mm + coverage.ends_mm - coverage.length_mm).abs() < 1e-6, "{coverage:?}");
        assert_eq!(coverage.is_enough(), is_enough, "{coverage:?}");
    }
}

#[test]
fn what_is_too_coarse_and_what_lies_at_a_fork_is_not_covered() {
    // Wide up to 30 mm, then of less than an edge, which is 1 mm along it.
    let radius = |z: f32| if z <= 30.0 { 3.0 } else { (3.0 - (z - 30.0)).max(0.4) };
    let found = certificate([&tube(12, 60, 60.0, radius); 3]);
    let coverage = found.coverage;
    assert_eq!(found.verdict, Verdict::Kept, "where it is measured");
    assert!(!coverage.is_enough() && (0.4..0.6).contains(&(coverage.measured_mm / 60.0)), "{coverage:?}");
    assert!(coverage.thin_mm > 24.0, "{coverage:?}");
    let (branch, station) = found.least_measured().unwrap();
    assert!(branch.standings[station] == StationStatus::Thin && at(branch, station).z > 33.0);
    // Three vessels that meet.
    let (mesh, ends) = fork();
    let found = certificate([&mesh; 3]);
    let coverage = found.coverage;
    let length: f64 = [0, 2, 3].map(|i| ends[i].distance(ends[1])).iter().sum();
    assert!(coverage.length_mm >= length && coverage.length_mm < length + 3.0 * 4.0, "{coverage:?} of {length}");
    // As wide as the trunk at least.
    assert!(coverage.forks_mm > 8.0 && coverage.thin_mm == 0.0, "{coverage:?}");
    assert_eq!((coverage.vessels, coverage.vessels_measured), (3, 3));
}

#[test]
fn stair_steps_are_no_change_of_calibre() {
    let inside = |p: DVec3| in_capsule(p, DVec3::ZERO, DVec3::new(6.0, 4.0, 40.0), 3.0);
    let (low, high) = (DVec3::splat(-5.0), DVec3::new(11.0, 9.0, 45.0));
    let (steps, smooth) = (stepped(low, high, 0.5, inside), isosurface(low, high, 0.5, inside));
    let found = certificate([&steps, &smooth, &smooth]);
    let [branch] = &found.branches[..] else { panic!("{} branches", found.branches.len()) };
    assert_eq!(branch.verdict, Verdict::Kept);
    let change = branch.smoothed.largest_change.unwrap().percent;
    assert!(change.abs() < 1.0, "{change} %");
    // The inscribed radius does change, by a part of a voxel.
    let inscribed = |of: &OnSurface| of.inscribed_radius_mm.unwrap().mean;
    assert!(inscribed(&branch.smoothed) / inscribed(&branch.opened) > 1.04, "{branch:?}");
}

#[test]
fn a_narrowed_branch_is_named_and_its_change_is_what_it_was_narrowed_by() {
    let (mesh, [_, joint, left, right]) = fork();
    // Towards its axis, the farther from the fork the more, up to 5 %.
    let mut narrowed = mesh.clone();
    let way = right - joint;
    for p in &mut narrowed.positions {
        let from = p.as_dvec3() - joint;
        let part = from.dot(way) / way.length_squared();
        let projection = joint + way * part;
        if p.as_dvec3().distance(projection) < 2.5 && part * way.length() > 8.0 {
            let much = 0.05 * ((part * way.length() - 8.0) / 4.0).min(1.0);
            *p = projection.lerp(p.as_dvec3(), 1.0 - much).as_vec3();
        }
    }
    let found = certificate([&mesh, &mesh, &narrowed]);
    assert_eq!((found.verdict, found.branches.len()), (Verdict::Changed, 3));
    let near = |branch: &BranchCalibre, p: DVec3| {
        (0..branch.at_mm.len()).map(|i| at(branch, i).distance(p)).fold(f64::INFINITY, f64::min) < 5.0
    };
    for branch in &found.branches {
        assert_eq!((branch.verdict_smoothed, branch.smoothed.largest_change.unwrap().percent), (Verdict::Kept, 0.0));
        let change = branch.reduced.largest_change.unwrap();
        if near(branch, right) {
            assert_eq!(branch.verdict, Verdict::Changed);
            assert!((change.percent + 5.0).abs() <= 0.5, "{change:?}");
            let place = Vec3::from(change.at_mm).as_dvec3();
            assert!((place - joint).normalize().dot(way.normalize()) > 0.95, "{change:?}");
        } else {
            assert_eq!(branch.verdict, Verdict::Kept, "{change:?}");
            assert!(near(branch, left) || near(branch, DVec3::ZERO));
            assert!(change.percent.abs() < 0.2, "{change:?}");
        }
    }
}

#[test]
fn a_branch_that_is_gone_has_lost_all() {
    let (mesh, [bottom, joint, left, right]) = fork();
    let inside = |p: DVec3| in_capsule(p, bottom, joint, 4.0).max(in_capsule(p, joint, left, 3.0));
    let without = isosurface(DVec3::new(-32.0, -5.0, -5.0), DVec3::new(32.0, 5.0, 78.0), 0.5, inside);
    let found = certificate([&mesh, &mesh, &without]);
    let lost: Vec<&BranchCalibre> = found.branches.iter().filter(|branch| branch.verdict == Verdict::Changed).collect();
    let [branch] = lost[..] else { panic!("{} branches", lost.len()) };
    assert_eq!(branch.reduced.largest_change.unwrap().percent, -100.0);
    let place = Vec3::from(branch.reduced.largest_change.unwrap().at_mm).as_dvec3();
    assert!(place.distance(right) < place.distance(left));
}

#[test]
fn the_degree_of_a_stenosis_is_what_it_is() {
    // 70 % of the diameter, 6 mm before.
    let radius = |z: f64| 3.0 - 2.1 * libm::exp(-(z - 30.0) * (z - 30.0) / 32.0);
    let smooth = tube(64, 240, 60.0, |z| radius(f64::from(z)) as f32);
    let inside = |p: DVec3| if (0.0..=60.0).contains(&p.z) { radius(p.z) - p.truncate().length() } else { -1.0 };
    let steps = stepped(DVec3::new(-4.0, -4.0, -1.0), DVec3::new(4.0, 4.0, 61.0), 0.5, inside);
    for mesh in [smooth, steps] {
        let found = certificate([&mesh; 3]);
        let branch = &found.branches[0];
        let whole = counted(branch).filter(|&i| (10.0..15.0).contains(&at(branch, i).z));
        let whole: Vec<f64> = whole.map(|i| f64::from(branch.opened.radii_mm[i].unwrap())).collect();
        let usual = whole.iter().sum::<f64>() / whole.len() as f64;
        let degree = 100.0 * (1.0 - branch.opened.radius_mm.unwrap().least / usual);
        assert!((degree - 70.0).abs() <= 2.0, "{degree} %");
    }
}

#[test]
fn a_loop_is_measured_all_around() {
    let inside = |p: DVec3| 3.0 - (p.truncate().length() - 20.0).hypot(p.z);
    let mesh = isosurface(DVec3::new(-24.0, -24.0, -4.0), DVec3::new(24.0, 24.0, 4.0), 0.6, inside);
    let found = certificate([&mesh; 3]);
    assert_eq!(found.verdict, Verdict::Kept);
    let mut sectors = [false; 12];
    for branch in &found.branches {
        for i in 0..branch.at_mm.len() {
            let p = at(branch, i);
            let off = (p.truncate().length() - 20.0).hypot(p.z);
            assert!(off < 0.3, "{off} mm off the axis");
            sectors[((libm::atan2(p.y, p.x) / (2.0 * PI) + 0.5) * 12.0) as usize % 12] = true;
        }
        for i in counted(branch) {
            let area = f64::from(branch.opened.areas_mm2[i].unwrap());
            assert!((area / (PI * 9.0) - 1.0).abs() < 0.02, "{area} mm2");
        }
    }
    assert_eq!(sectors, [true; 12]);
    let length: f64 = found.branches.iter().map(|branch| branch.length_mm).sum();
    assert!((length / (40.0 * PI) - 1.0).abs() < 0.05, "{length} mm");
    assert!(found.branches.iter().map(|branch| branch.stations_counted).sum::<usize>() > 60);
}

#[test]
fn a_blob_is_one_branch_that_is_nowhere_a_vessel() {
    let mesh = icosphere(4, 5.0, Vec3::new(1.0, 2.0, 3.0));
    let found = certificate([&mesh; 3]);
    assert_eq!((found.verdict, found.branches.len()), (Verdict::NotMeasured, 1));
    let branch = &found.branches[0];
    assert_eq!((branch.verdict, branch.stations_counted), (Verdict::NotMeasured, 0));
    assert!((branch.opened.inscribed_radius_mm.unwrap().largest - 5.0).abs() < 0.05, "{branch:?}");
}

#[test]
fn what_has_no_vessels_is_refused_with_a_sentence() {
    let says = |mesh: &TriMesh| task([mesh; 3]).finish().unwrap_err();
    assert_eq!(says(&TriMesh::default()), CalibreError::Tree(TreeError::NoTriangles));
    assert!(matches!(says(&square(6, 10.0, 0.0)), CalibreError::Tree(TreeError::NoInside { .. })));
    let mut turned = icosphere(3, 5.0, Vec3::ZERO);
    turned.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    assert_eq!(says(&turned), CalibreError::Tree(TreeError::InsideOut));
    for radius in [0.01f32, 150.0] {
        let error = says(&tube(32, 40, 20.0 * radius, |_| radius));
        assert!(matches!(error, CalibreError::Unit { .. }), "{error}");
        assert!(error.to_string().contains("not in the unit"), "{error}");
    }
    // Without vessels, the others are no matter.
    let found = certificate([&tube(32, 40, 20.0, |_| 2.0), &TriMesh::default(), &square(6, 10.0, 0.0)]);
    assert!(matches!(found.verdict, Verdict::Changed | Verdict::NotMeasured), "{:?}", found.verdict);
}

#[test]
fn slices_and_threads_change_nothing() {
    let (mesh, _) = fork();
    let whole = certificate([&mesh; 3]);
    let mut sliced = task([&mesh; 3]);
    let mut slices = 0;
    let found = loop {
        slices += 1;
        if let Progress::Done(found) = sliced.advance(Budget::new(Duration::ZERO)) {
            break found.unwrap();
        }
    };
    assert!(slices > 20, "{slices} slices");
    assert_eq!(found, whole);
    assert_eq!(lumen_mesh::parallel::with_threads(3, || certificate([&mesh; 3])), whole);
}

#[test]
fn centrelines_are_written_with_the_arrays_that_vmtk_names() {
    let (mesh, _) = fork();
    let found = Centrelines::new(&Subject::new(&Arc::new(mesh))).unwrap();
    let (points, lines) = (found.stations.all.len(), found.branches.len());
    let text = found.vtp();
    assert!(
        text.contains(&format!("NumberOfPoints=\"{points}\"")) && text.contains(&format!("NumberOfLines=\"{lines}\""))
    );
    let numbers = |name: &str| -> Vec<f64> {
        let from = text.split_once(&format!("Name=\"{name}\"")).unwrap().1.split_once('>').unwrap().1;
        from.split_once('<').unwrap().0.split_whitespace().map(|number| number.parse().unwrap()).collect()
    };
    let point = ["MaximumInscribedSphereRadius", "Abscissas", "CenterlineSectionArea", "CenterlineSectionClosed"];
    assert!(point.iter().all(|name| numbers(name).len() == points));
    let cell = ["CenterlineIds", "GroupIds", "TractIds", "Blanking"];
    assert!(cell.iter().all(|name| numbers(name).len() == lines));
    assert_eq!(numbers("Points").len(), 3 * points);
    assert_eq!(numbers("connectivity"), (0..points).map(|i| i as f64).collect::<Vec<_>>());
    let offsets = numbers("offsets");
    assert!(offsets.is_sorted() && offsets.last() == Some(&(points as f64)) && offsets.len() == lines);
    assert_eq!(numbers("GroupIds"), [0.0, 1.0, 2.0]);
    // Of three branches one goes straight on, and one comes out.
    assert_eq!((numbers("CenterlineIds"), numbers("TractIds")), (vec![0.0, 0.0, 1.0], vec![0.0, 1.0, 0.0]));
    assert!(numbers("Blanking").iter().all(|&blanking| blanking == 0.0));
    let abscissas = numbers("Abscissas");
    for range in &found.stations.of {
        assert_eq!(abscissas[range.start], 0.0);
        assert!(abscissas[range.clone()].is_sorted());
    }
    let csv = found.csv();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), points + 1);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    assert!(rows[1][9].parse::<f64>().is_ok() && rows[0][9] == "inscribed_radius_mm");
}
