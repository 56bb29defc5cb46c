use std::f64::consts::PI;

use lumen_mesh::shapes::{icosphere, joined, square, tube, vertices_are_manifold};
use lumen_mesh::split_mix::SplitMix64;
use lumen_mesh::task::at_once;
use lumen_mesh::{Vec3, self_intersections, volume};

use super::*;
use crate::prepare::{Plan, prepare};

/// The wrap of `mesh`, which is a manifold whose triangles cross nowhere, with no point farther than `tolerance` from the
/// points that `distance` is of; and how many ends it has.
fn wrapped(mesh: &TriMesh, tolerance: f64, distance: impl Fn(DVec3) -> f64) -> (TriMesh, usize) {
    let mut notes = Vec::new();
    let found = at_once(wrap(mesh, tolerance, true, &mut notes, &Yielder::never())).unwrap();
    assert_eq!(found, at_once(wrap(mesh, tolerance, true, &mut Vec::new(), &Yielder::never())).unwrap());
    let topology = Topology::new(found.positions.len(), &found.triangles);
    let counts = topology.edge_counts();
    assert_eq!((counts.non_manifold, counts.flipped), (0, 0));
    assert!(vertices_are_manifold(&found, &topology) && self_intersections(&found).is_empty());
    let told = notes.iter().find_map(|note| match note {
        Note::Wrapped { deviation_mm } => Some(*deviation_mm),
        _ => None,
    });
    assert!(told.is_some_and(|told| told <= tolerance), "{notes:?}");
    for t in 0..found.triangles.len() {
        let [a, b, c] = found.corners(t).map(Vec3::as_dvec3);
        for p in [a, b, c, (a + b + c) / 3.0] {
            assert!(distance(p) <= tolerance, "{p} is {} away", distance(p));
        }
    }
    let ends = boundary_loops(&topology).len();
    (found, ends)
}

/// How far the vertices of `mesh` are from `wrap` at most.
fn farthest(mesh: &TriMesh, wrap: &TriMesh) -> f64 {
    let index = SurfaceIndex::new(&wrap.positions, &wrap.triangles);
    let far = mesh.positions.iter().filter_map(|&p| index.nearest(p)).map(|nearest| f64::from(nearest.distance));
    far.fold(0.0, f64::max)
}

/// Each triangle for itself, smaller by `part`, every second turned over.
fn soup(mesh: &TriMesh, part: f32) -> TriMesh {
    let mut soup = TriMesh::default();
    let mut random = SplitMix64::new(3);
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t);
        let middle = corners.iter().sum::<Vec3>() / 3.0;
        let first = soup.positions.len() as u32;
        soup.positions.extend(corners.map(|p| p.lerp(middle, part * random.unit() as f32)));
        soup.triangles.push(if t % 2 == 0 { [first, first + 1, first + 2] } else { [first, first + 2, first + 1] });
    }
    soup
}

#[test]
fn a_vessel_with_short_edges_at_its_rims_is_wrapped_as_its_lumen() {
    let mesh = tube(120, 20, 20.0, |_| 2.0);
    let (found, ends) = wrapped(&mesh, 0.3, |p| from_tube(p, 2.0, 20.0));
    assert_eq!(ends, 2);
    let topology = Topology::new(found.positions.len(), &found.triangles);
    // Open ends: by the flux through the wall and the flat ends, less what was cut off within the tolerance.
    let part = volume(&found, &topology) / (PI * 4.0 * 20.0);
    assert!((0.9..1.1).contains(&part), "{part}");
}

#[test]
fn a_tolerance_that_leaves_no_shape_is_refused() {
    let mesh = tube(48, 40, 20.0, |_| 2.0);
    let found = |mm| at_once(wrap(&mesh, mm, true, &mut Vec::new(), &Yielder::never()));
    for mm in [2.1, 1e18, 1e308, f64::INFINITY] {
        let Err(PrepareError::WrapCoarse { most_mm, .. }) = found(mm) else { panic!("{mm}") };
        assert!((most_mm - 2.0).abs() < 0.01);
    }
    // One that is too fine: what is proposed has more than two and fewer than six million triangles on 251 mm2.
    let Err(PrepareError::Wrap { least_mm, .. }) = found(1e-4) else { panic!() };
    let least = |triangles: f64| (2.0 * 251.0 / triangles).sqrt() / STEP;
    assert!((least(6e6)..least(2e6)).contains(&least_mm), "{least_mm}");
    assert!((rounded_up(0.0123) - 0.013).abs() < 1e-12 && (rounded_up(450.0) - 450.0).abs() < 1e-9);
}

/// The distance from a tube along z of this radius and length.
fn from_tube(p: DVec3, radius: f64, length: f64) -> f64 {
    let beyond = (p.z - length).max(-p.z).max(0.0);
    libm::hypot(libm::hypot(p.x, p.y) - radius, beyond)
}

fn volume_closed(mesh: &TriMesh) -> f64 {
    volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles))
}

#[test]
fn a_sphere_is_wrapped_within_the_tolerance_and_keeps_its_volume() {
    let sphere = icosphere(4, 5.0, Vec3::new(1.0, 2.0, 3.0));
    let (found, ends) = wrapped(&sphere, 0.3, |p| (p.distance(DVec3::new(1.0, 2.0, 3.0)) - 5.0).abs());
    assert_eq!(ends, 0);
    assert!(farthest(&sphere, &found) < 0.1, "{}", farthest(&sphere, &found));
    let part = volume_closed(&found) / volume_closed(&sphere);
    assert!((part - 1.0).abs() < 0.01, "{part}");
    // Pieces inside are gone.
    let nested = joined(&[sphere.clone(), icosphere(3, 2.0, Vec3::new(1.0, 2.0, 3.0))]);
    assert_eq!(at_once(wrap(&nested, 0.3, true, &mut Vec::new(), &Yielder::never())).unwrap(), found);
}

#[test]
fn an_open_tube_is_wrapped_as_its_lumen_and_stays_open() {
    let (radius, length) = (2.0, 20.0);
    let mesh = tube(48, 80, 20.0, |_| 2.0);
    let (found, ends) = wrapped(&mesh, 0.3, |p| from_tube(p, radius, length));
    assert_eq!(ends, 2);
    assert!(farthest(&mesh, &found) < 0.3, "{}", farthest(&mesh, &found));
    let part = volume_closed(&found) / (PI * radius * radius * (length - 2.0 * INSIDE * 0.3));
    assert!((part - 1.0).abs() < 0.02, "{part}");
}

#[test]
fn two_tubes_that_cross_become_one_lumen() {
    let (radius, length) = (2.0, 20.0);
    let along = tube(48, 80, 20.0, |_| 2.0);
    let mut across = along.clone();
    across.positions.iter_mut().for_each(|p| *p = Vec3::new(p.z - 10.0, p.x, p.y + 10.0));
    let mesh = joined(&[along, across]);
    assert!(!self_intersections(&mesh).is_empty());
    let from_either = |p: DVec3| {
        let other = DVec3::new(p.y, p.z - 10.0, p.x + 10.0);
        from_tube(p, radius, length).min(from_tube(other, radius, length))
    };
    let (found, ends) = wrapped(&mesh, 0.3, from_either);
    assert_eq!(ends, 4);
    // Steinmetz: what two cylinders have in common is 16 / 3 of the radius cubed.
    let open = 2.0 * PI * radius * radius * (length - 2.0 * INSIDE * 0.3) - 16.0 / 3.0 * radius * radius * radius;
    assert!((volume_closed(&found) / open - 1.0).abs() < 0.02, "{} of {open}", volume_closed(&found));
}

#[test]
fn of_two_layers_the_outer_one_is_wrapped() {
    let (radius, length) = (2.2, 20.0);
    let mesh = joined(&[tube(48, 80, 20.0, |_| 2.0), tube(48, 80, 20.0, |_| 2.2)]);
    let (found, ends) = wrapped(&mesh, 0.3, |p| from_tube(p, radius, length));
    assert_eq!(ends, 2);
    let part = volume_closed(&found) / (PI * radius * radius * (length - 2.0 * INSIDE * 0.3));
    assert!((part - 1.0).abs() < 0.02, "{part}");
}

#[test]
fn ragged_ends_stay_open_and_are_cut_square_after() {
    // The rims go up and down three times.
    let whole = tube(24, 80, 40.0, |_| 2.0);
    let mesh = whole.filtered(|t| {
        let middle = whole.corners(t).iter().sum::<Vec3>() / 3.0;
        let from_end = middle.z.min(40.0 - middle.z);
        from_end > 1.5 + 0.6 * libm::sinf(3.0 * libm::atan2f(middle.y, middle.x))
    });
    // What is filled between the rags is flat.
    let (found, ends) = wrapped(&mesh, 0.3, |p| from_tube(p, 2.0, 40.0) - 0.2);
    assert_eq!((ends, components(found.positions.len(), &found.triangles).count()), (2, 1));
    // Where nothing is cut they stay closed.
    let plan = Plan { wrap: Some(0.3), ..Plan::default() };
    let found = at_once(prepare(&mesh, &plan, &Yielder::never())).unwrap();
    assert!(found.fate.is_ready() && found.surface.patches.len() == 1, "{:?} {:?}", found.fate, found.notes);
    let are_told = |note: &Note| matches!(note, Note::AsWallMany { count: 2, places, .. } if places.0.len() == 2);
    assert!(found.notes.iter().any(are_told), "{:?}", found.notes);
    let plan = Plan { wrap: Some(0.3), ..Plan::flow() };
    let found = at_once(prepare(&mesh, &plan, &Yielder::never())).unwrap();
    assert!(found.fate.is_ready() && found.surface.patches.len() == 3, "{:?} {:?}", found.fate, found.notes);
    for patch in &found.surface.patches[1..] {
        assert!((patch.area_mm2 / (PI * 4.0) - 1.0).abs() < 0.06, "{patch:?}");
    }
}

#[test]
fn a_sheet_gets_two_sides_and_a_wrap_that_is_too_fine_says_what_may_do() {
    let mesh = square(20, 10.0, 0.0);
    let away = |p: DVec3| (p.abs() - DVec3::new(5.0, 5.0, 0.0)).max(DVec3::ZERO).length();
    let middle = mesh.bounds().centre().as_dvec3();
    let (found, ends) = wrapped(&mesh, 0.4, |p| away(p - middle));
    assert_eq!(ends, 0);
    assert!((volume_closed(&found) / (100.0 * 0.4) - 0.8).abs() < 0.25, "{}", volume_closed(&found));
    let wrap = |tolerance| at_once(wrap(&mesh, tolerance, true, &mut Vec::new(), &Yielder::never()));
    assert!(matches!(wrap(1e-3), Err(PrepareError::Wrap { least_mm, .. }) if least_mm > 1e-3 && wrap(0.1).is_ok()));
}

#[test]
fn a_wrapped_tube_has_the_ids_of_its_ends_whatever_comes_after() {
    let mesh = soup(&tube(24, 40, 20.0, |_| 2.0), 0.2);
    let flow = Plan { wrap: Some(0.3), ..Plan::flow() };
    for plan in [Plan { wrap: Some(0.3), ..Plan::default() }, flow] {
        let found = at_once(prepare(&mesh, &plan, &Yielder::never())).unwrap();
        assert!(found.fate.is_ready(), "{:?}", found.fate);
        let patches: Vec<(u32, &str)> = found.surface.patches.iter().map(|p| (p.id, p.name.as_str())).collect();
        assert_eq!(patches, [(1, "wall"), (2, "inlet"), (3, "outlet_1")]);
        let areas = found.surface.patches[1..].iter().map(|patch| patch.area_mm2 / (PI * 4.0));
        assert!(areas.clone().all(|part| (part - 1.0).abs() < 0.06), "{:?}", areas.collect::<Vec<_>>());
    }
}

#[test]
fn a_soup_with_gaps_is_wrapped_as_the_tube_that_it_is() {
    let (radius, length) = (2.0, 20.0);
    let mesh = soup(&tube(24, 40, 20.0, |_| 2.0), 0.2);
    let (found, ends) = wrapped(&mesh, 0.3, |p| from_tube(p, radius, length));
    assert_eq!(ends, 2);
    let part = volume_closed(&found) / (PI * radius * radius * (length - 2.0 * INSIDE * 0.3));
    assert!((part - 1.0).abs() < 0.04, "{part}");
}
