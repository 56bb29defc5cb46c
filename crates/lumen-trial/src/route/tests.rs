//! Trees and routes of surfaces whose centrelines are known.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::*;
use crate::course::Course;
use crate::setup::Setup;
use lumen_mesh::shapes::{fork, in_capsule, isosurface, joined, tube};
use lumen_vessel::{Branch, End, Tree};

fn near(found: f64, expected: f64, part: f64) {
    assert!((found - expected).abs() <= part * expected.abs(), "{found}, not {expected} to {part}");
}

#[test]
fn a_straight_tube_is_one_branch_as_long_and_wide_as_it_is() {
    let tree = Tree::new(&tube(48, 80, 40.0, |_| 1.5)).unwrap();
    let [branch] = tree.branches() else { panic!("{:?}", tree.branches().len()) };
    assert_eq!((branch.name.as_str(), branch.parent, branch.ends), ("branch 1", None, [End::Open; 2]));
    near(branch.length_mm(), 40.0, 0.01);
    for place in &branch.points {
        near(place.radius, 1.5, 0.01);
        assert!(place.at.truncate().length() < 0.02, "{place:?}");
    }
    let route = tree.route(Vec3::new(0.4, 0.3, 3.0), Vec3::new(-0.5, 0.1, 37.0)).unwrap();
    near(route.length_mm, 34.0, 0.002);
    near(route.tortuosity, 1.0, 1e-3);
    near(route.smallest_radius_mm, 1.5, 0.01);
    assert_eq!((route.branches.clone(), route.branches_passed), (vec![0], 0));
    for (i, station) in route.stations.into_iter().enumerate() {
        near(station, 34.0 * (i as f64 + 0.5) / 5.0, 0.003);
        let place = route.at(station);
        assert!((place.at.z - 3.0 - station).abs() < 0.05 && place.direction.z > 0.999, "{place:?}");
    }
    let on = route.locate(DVec3::new(0.0, 0.9, 20.0));
    assert!((on.arc_mm - 17.0).abs() < 0.05 && (on.distance_mm - 0.9).abs() < 0.03, "{on:?}");
    // Before the cross-section, beside it, in it, past it, and far off.
    for (p, expected) in
        [([0.0, 0.0, 30.0], 7.0), ([1.0, 0.0, 35.0], 2.0), ([0.0, 1.0, 37.02], 0.0), ([0.0, 0.0, 39.0], 0.0)]
    {
        let found = route.distance_to_target(DVec3::from(p));
        assert!((found - expected).abs() < 0.05, "{p:?}: {found}");
    }
    assert!(route.distance_to_target(DVec3::new(9.0, 0.0, 38.0)) > 7.0);
    assert_eq!(route.clearance(2.9), Ok(()));
    let thin = route.clearance(3.1).unwrap_err();
    assert!(thin.to_string().starts_with("the lumen is too thin for a wire of 3.10 mm: it is "), "{thin}");
}

#[test]
fn a_fork_has_three_branches_and_each_route_is_as_long_as_its_axes() {
    let (mesh, [bottom, joint, left, right]) = fork();
    let tree = Tree::new(&mesh).unwrap();
    assert_eq!(tree.branches().len(), 3, "{:?}", tree.branches().iter().map(Branch::length_mm).collect::<Vec<_>>());
    for branch in tree.branches() {
        assert_eq!(branch.ends.iter().filter(|&&end| end == End::Closed).count(), 1);
        assert_eq!(branch.ends.iter().filter(|&&end| end == End::Joint).count(), 1);
    }
    // Far enough from the fork, each place has the branch and the radius of its axis.
    let branch = |from: DVec3, to: DVec3, radius: f64| {
        let mut found = Vec::new();
        for part in [0.45, 0.6, 0.8, 0.95] {
            let p = from.lerp(to, part);
            let located = tree.locate(p, None).unwrap();
            near(located.radius_mm, radius, 0.03);
            assert!(located.distance_mm < 0.05 * radius, "{p} {located:?}");
            assert_eq!(tree.locate(p, Some(&located)), Some(located), "a hint changes nothing");
            found.push(located.branch);
        }
        found.dedup();
        assert_eq!(found.len(), 1, "{found:?}");
        found[0]
    };
    let [trunk, wide, thin] = [branch(joint, bottom, 4.0), branch(joint, left, 3.0), branch(joint, right, 2.0)];
    for (from, to, expected, through) in
        [(bottom, left, 80.0, [trunk, wide]), (bottom, right, 80.0, [trunk, thin]), (right, left, 80.0, [thin, wide])]
    {
        let route = tree.route(from.as_vec3(), to.as_vec3()).unwrap();
        // Where they meet, the middle of the lumen is not where the axes are: it cuts the corner, a sharp one more.
        let slack = if from == right { 0.07 } else { 0.02 };
        near(route.length_mm, expected, slack);
        assert_eq!((route.branches.clone(), route.branches_passed), (through.to_vec(), 1));
        let aside = [trunk, wide, thin].into_iter().find(|branch| !through.contains(branch)).unwrap();
        let off = [bottom, left, right].into_iter().find(|end| *end != from && *end != to).unwrap();
        let located = tree.locate(off, None).unwrap();
        assert_eq!(located.branch, aside);
        assert!(route.is_off(off, &located) && !route.is_off(joint, &tree.locate(joint, None).unwrap()));
    }
    let widths = tree.entries().into_iter().map(|(name, _)| {
        let PlaceName::Entry { diameter_mm, .. } = name else { panic!("{name:?}") };
        diameter_mm
    });
    widths.zip([8.0, 6.0, 4.0]).for_each(|(found, expected)| near(found, expected, 0.05));
    let (_, entry) = tree.entries().swap_remove(0);
    let targets = tree.targets(entry.at.into(), 0.0);
    assert_eq!((tree.entries().len(), targets.len()), (3, 2));
    assert!(Vec3::from(entry.at).distance(bottom.as_vec3()) < 6.0 && entry.direction[2] > 0.99, "{entry:?}");
    assert!(targets[0].at.distance(right.as_vec3()) < 6.0, "the thin branch is the best target");
    let route = tree.route(entry.at.into(), targets[0].at).unwrap();
    near(targets[0].length_mm, route.length_mm, 0.05);
    // Where there is no room in the thin branch, it goes as far as its mouth, and the wide one is the best target.
    let roomy = tree.targets(entry.at.into(), 2.5 * targets[0].radius_mm);
    assert!(roomy[0].at.distance(left.as_vec3()) < 6.0, "{roomy:?}");
    assert!(roomy.len() == 2 && roomy[1].radius_mm > 1.25 * targets[0].radius_mm, "{roomy:?}");
}

#[test]
fn the_usual_radius_goes_by_length_and_not_by_how_finely_a_way_is_cut() {
    let thin = std::iter::repeat_n((1.0, 0.5), 80);
    let pieces: Vec<(f64, f64)> = [(4.0, 60.0), (5.0, 40.0)].into_iter().chain(thin).collect();
    // 40 mm of 1 mm, 60 of 4 and 40 of 5: half of 140 lies in the second.
    assert_eq!(usual_radius(pieces), 4.0);
    assert_eq!(usual_radius(Vec::new()), 0.0);
}

#[test]
fn where_there_is_no_way_the_sentence_says_why() {
    let mut other = tube(32, 40, 20.0, |_| 1.5);
    other.positions.iter_mut().for_each(|p| *p += Vec3::new(8.0, 0.0, 0.0));
    let tree = Tree::new(&joined(&[tube(32, 60, 30.0, |_| 2.0), other])).unwrap();
    let (inside, elsewhere, outside) = (Vec3::Z * 4.0, Vec3::new(8.0, 0.0, 10.0), Vec3::new(5.0, 0.0, 10.0));
    assert_eq!(tree.branches().iter().map(|branch| branch.tree).collect::<Vec<_>>(), [0, 1]);
    let says = |from, to| tree.route(from, to).unwrap_err();
    let entry = says(outside, inside);
    assert!(
        matches!(entry, RouteError::EntryOutside { distance_mm, .. } if (distance_mm - 1.5).abs() < 0.05),
        "{entry}"
    );
    assert!(matches!(says(inside, outside), RouteError::TargetOutside { .. }));
    assert!(matches!(says(Vec3::Z * -3.0, inside), RouteError::EntryOutside { .. }), "beyond the open end");
    let gap = says(inside, elsewhere);
    assert!(matches!(gap, RouteError::NoWay { gap_mm, .. } if (gap_mm - 4.5).abs() < 0.1), "{gap}");
    assert!(matches!(says(inside, inside), RouteError::TooShort { .. }));
}

#[test]
fn a_pinched_vessel_ends_where_it_is_pinched_and_a_narrow_one_goes_on() {
    let waisted = |waist: f32| tube(48, 320, 40.0, move |z| 1.5 - (1.5 - waist) * (-(z - 20.0) * (z - 20.0)).exp());
    let [from, to] = [Vec3::Z * 3.0, Vec3::Z * 37.0];
    let route = Tree::new(&waisted(0.3)).unwrap().route(from, to).unwrap();
    near(route.smallest_radius_mm, 0.3, 0.06);
    assert!((route.points[route.smallest_at].at.z - 20.0).abs() < 0.3);
    let shut = Tree::new(&waisted(1e-4)).unwrap().route(from, to).unwrap_err();
    assert!(matches!(shut, RouteError::NoWay { at, .. } if (at.0[2] - 20.0).abs() < 1.5), "{shut}");
}

/// A trunk of 5 mm radius along z, and a branch that leaves it half-way by an angle; all ends are round.
fn side_branch(degrees: f64, radius: f64) -> (lumen_mesh::TriMesh, [DVec3; 3]) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let [bottom, joint, top] = [0.0, 50.0, 100.0].map(|z| DVec3::Z * z);
    let end = joint + DVec3::new(sin, 0.0, cos) * 45.0;
    let inside = |p: DVec3| in_capsule(p, bottom, top, 5.0).max(in_capsule(p, joint, end, radius));
    let (low, high) = (DVec3::new(-6.0, -6.0, -6.0), DVec3::new(50.0, 6.0, 106.0));
    (isosurface(low, high, 0.5, inside), [bottom, top, end])
}

#[test]
fn a_fork_has_the_angle_and_the_radii_that_it_was_made_with() {
    for (degrees, radius) in [(30.0, 3.0), (45.0, 2.0), (60.0, 3.0), (75.0, 2.0), (90.0, 3.0)] {
        let (mesh, [bottom, top, end]) = side_branch(degrees, radius);
        let tree = Tree::new(&mesh).unwrap();
        let forks = |from: DVec3, to: DVec3| tree.route(from.as_vec3(), to.as_vec3()).unwrap().forks(&tree);
        let into = forks(bottom, end);
        let [fork] = into[..] else { panic!("{degrees} degrees: {into:?}") };
        assert!((fork.turn_degrees - degrees).abs() < 5.0, "{degrees} degrees: {fork:?}");
        near(fork.parent_radius_mm, 5.0, 0.1);
        near(fork.branch_radius_mm, radius, 0.1);
        // Their axes part at 50 mm, and that of the branch leaves the lumen of the trunk so much farther on.
        assert!((fork.arc_mm - 50.0).abs() < 5.0 / degrees.to_radians().sin(), "{fork:?}");
        assert_eq!(forks(bottom, top), [], "past the branch it goes straight on");
        assert_eq!(forks(end, bottom), [], "out of the branch the wall of the trunk leads on");
    }
}

#[test]
fn a_branch_at_the_outer_side_of_a_bend_is_no_fork_and_one_at_its_inner_side_is() {
    // A trunk of 5 mm radius along a half circle of 40 mm about the y axis, and a straight piece on either end.
    let at =
        |degrees: f64, radius: f64| DVec3::new(-degrees.to_radians().cos(), 0.0, degrees.to_radians().sin()) * radius;
    let mut line = vec![at(0.0, 40.0) - DVec3::Z * 40.0];
    line.extend((0..=36).map(|i| at(5.0 * f64::from(i), 40.0)));
    line.push(at(180.0, 40.0) - DVec3::Z * 40.0);
    let joint = at(90.0, 40.0);
    for (side, expected) in [(1.0, 0), (-1.0, 1)] {
        // By 50 degrees, outwards or inwards; there it goes past the other piece.
        let way = DVec3::new(50.0_f64.to_radians().cos(), 0.0, side * 50.0_f64.to_radians().sin());
        let end = joint + (way + DVec3::Y * if side < 0.0 { 0.5 } else { 0.0 }) * 45.0;
        let inside = |p: DVec3| {
            let depths = line.windows(2).map(|pair| in_capsule(p, pair[0], pair[1], 5.0));
            depths.fold(in_capsule(p, joint, end, 3.0), f64::max)
        };
        let mesh = isosurface(DVec3::new(-46.0, -6.0, -46.0), DVec3::new(46.0, 30.0, 80.0), 0.8, inside);
        let tree = Tree::new(&mesh).unwrap();
        let route = tree.route(line[0].as_vec3(), end.as_vec3()).unwrap();
        assert_eq!(route.forks(&tree).len(), expected, "{side}: {:?}", route.forks(&tree));
    }
}

#[test]
fn where_a_vessel_parts_in_two_alike_each_way_is_a_fork() {
    let (mesh, [bottom, joint, left, right]) = fork();
    let tree = Tree::new(&mesh).unwrap();
    for (end, radius) in [(left, 3.0), (right, 2.0)] {
        let forks = tree.route(bottom.as_vec3(), end.as_vec3()).unwrap().forks(&tree);
        let [fork] = forks[..] else { panic!("{forks:?}") };
        assert!((fork.turn_degrees - 40.0).abs() < 5.0 && (fork.arc_mm - joint.z).abs() < 4.0, "{fork:?}");
        near(fork.parent_radius_mm, 4.0, 0.15);
        near(fork.branch_radius_mm, radius, 0.1);
    }
}

/// An aorta of 18 mm that parts into two arteries of 10 mm at 25 degrees each, the one longer, with one of 6 mm at its side,
/// all `scale` times as large: the ends of the aorta, of the long and the short artery, and of that at the side.
fn aorta(scale: f64) -> (lumen_mesh::TriMesh, [DVec3; 4]) {
    let (sin, cos) = 25.0_f64.to_radians().sin_cos();
    let (top, fork, renal) = (DVec3::Z * 130.0, DVec3::ZERO, DVec3::Z * 50.0);
    let [long, short] = [(120.0, 1.0), (80.0, -1.0)].map(|(length, side)| DVec3::new(side * sin, 0.0, -cos) * length);
    let side = renal + DVec3::new(0.0, 48.0, 16.0);
    let vessels = [(top, fork, 9.0), (fork, long, 5.0), (fork, short, 5.0), (renal, side, 3.0)];
    let inside = |p: DVec3| {
        let depths = vessels.map(|(from, to, radius)| in_capsule(p, scale * from, scale * to, scale * radius));
        depths.into_iter().fold(f64::NEG_INFINITY, f64::max)
    };
    let (low, high) = (DVec3::new(-42.0, -11.0, -116.0), DVec3::new(58.0, 53.0, 141.0));
    (isosurface(scale * low, scale * high, scale, inside), [top, long, short, side].map(|end| scale * end))
}

/// The end that each place lies at, of those that are given.
fn ends_of(places: impl Iterator<Item = [f32; 3]>, ends: &[DVec3]) -> Vec<usize> {
    let distance = |place: [f32; 3], i: usize| Vec3::from(place).as_dvec3().distance(ends[i]);
    let nearest = |place| (0..ends.len()).min_by(|&a, &b| distance(place, a).total_cmp(&distance(place, b))).unwrap();
    places.map(nearest).collect()
}

#[test]
fn an_aorta_is_entered_from_the_groin_and_other_vessels_where_they_are_wide() {
    const TOP: usize = 0;
    const LONG: usize = 1;
    const SHORT: usize = 2;
    const SIDE: usize = 3;
    let entered = |scale| {
        let (mesh, ends) = aorta(scale);
        let tree = Tree::new(&mesh).unwrap();
        ends_of(tree.entries().into_iter().map(|(_, entry)| entry.at), &ends)
    };
    let found = entered(1.0);
    assert!(matches!(found[..], [LONG, SHORT, TOP, SIDE] | [SHORT, LONG, TOP, SIDE]), "{found:?}");
    // A quarter as large it is as wide as a coronary artery.
    assert_eq!(entered(0.25)[0], TOP);
    assert_eq!(entered(0.25)[3], SIDE);
}

#[test]
fn a_thin_artery_that_leaves_an_aorta_is_entered_in_its_ostium() {
    // 6 mm are a renal artery's; 4.8 mm, beside an aorta of 14, are a coronary one's.
    assert_eq!(Tree::new(&aorta(1.0).0).unwrap().ostia(), []);
    let (mesh, ends) = aorta(0.8);
    let tree = Tree::new(&mesh).unwrap();
    let [top, long, _, side] = ends.map(|end| (0.95 * end).as_vec3());
    let found = tree.ostia();
    let [(PlaceName::Ostium { diameter_mm, .. }, entry)] = found[..] else { panic!("{found:?}") };
    near(diameter_mm, 4.8, 0.05);
    let (at, way) = (Vec3::from(entry.at).as_dvec3(), Vec3::from(entry.direction).as_dvec3());
    let (origin, along) = (DVec3::Z * 40.0, DVec3::new(0.0, 48.0, 16.0).normalize());
    // The artery leaves the aorta 7.2 mm from its axis, 7.6 along its own, and 3 mm on is the guide's end.
    let arc = (at - origin).dot(along);
    assert!((at - origin - along * arc).length() < 0.5 && (9.0..13.0).contains(&arc), "{at} at {arc}");
    assert!(way.dot(along) > 0.98, "{way}");
    assert_eq!(tree.ostium_on_way(long, side), Some(found[0]));
    assert_eq!(tree.ostium_on_way(top, side), Some(found[0]));
    assert_eq!((tree.ostium_on_way(long, top), tree.ostium_on_way(side, top)), (None, None));
    // It is proposed where nobody has said any, and what is asked for stays.
    let mesh = Arc::new(mesh);
    let task = |entry, target| {
        let mut setup = Setup { proposes_wire: true, entry, target, ..Setup::default() };
        let course = Course::new(&mesh, None, &mut setup).unwrap();
        assert!(course.entries.iter().any(|(_, known)| *known == found[0].1));
        (setup.entry.unwrap(), Vec3::from(setup.target.unwrap()))
    };
    let (entered, target) = task(None, None);
    assert!(target.distance(ends[3].as_vec3()) < 8.0, "{target}");
    assert_eq!(entered, found[0].1);
    assert_ne!(task(None, Some(side.to_array())).0, found[0].1);
}

/// A vessel along z of this diameter at each place, closed by round ends.
fn along_z(diameters: &[(f64, f64)]) -> Tree {
    let (low, high) = (diameters[0].0, diameters[diameters.len() - 1].0);
    let radius = |z: f64| {
        let z = z.clamp(low, high);
        let next = diameters.partition_point(|&(at, _)| at <= z).clamp(1, diameters.len() - 1);
        let [(from, one), (to, other)] = [diameters[next - 1], diameters[next]];
        (one + (other - one) * ((z - from) / (to - from)).clamp(0.0, 1.0)) / 2.0
    };
    let inside = |p: DVec3| radius(p.z) - p.distance(DVec3::Z * p.z.clamp(low, high));
    let [low, high] = [(low, -1.0), (high, 1.0)].map(|(z, side)| DVec3::new(side * 13.0, side * 13.0, z + side * 13.0));
    Tree::new(&isosurface(low, high, 0.8, inside)).unwrap()
}

#[test]
fn an_artery_that_an_aorta_runs_on_into_has_an_ostium_though_no_branch_begins_there() {
    // The root of an aorta of 22 mm narrows to 4 mm within 7: the vessel is one branch.
    for is_upward in [true, false] {
        let mut vessel = vec![(0.0, 22.0), (70.0, 22.0), (77.0, 4.0), (120.0, 4.0)];
        let way = if is_upward { 1.0 } else { -1.0 };
        if !is_upward {
            vessel = vessel.into_iter().rev().map(|(z, diameter)| (-z, diameter)).collect();
        }
        let tree = along_z(&vessel);
        assert_eq!(tree.branches().len(), 1);
        let found = tree.ostia();
        let [(PlaceName::Ostium { branch: 0, diameter_mm }, entry)] = found[..] else { panic!("{found:?}") };
        near(diameter_mm, 4.0, 0.1);
        assert!((78.0..81.0).contains(&(way * f64::from(entry.at[2]))), "{entry:?}");
        assert!(f64::from(entry.direction[2]) * way > 0.99, "{entry:?}");
        let [aorta, artery] = [10.0, 110.0].map(|z| (DVec3::Z * way * z).as_vec3());
        assert_eq!(tree.ostium_on_way(aorta, artery), Some(found[0]));
        assert_eq!(tree.ostium_on_way(artery, aorta), None, "out of the artery");
        assert_eq!(tree.ostium_on_way(aorta, aorta * 5.0), None, "within the aorta");
    }
}

#[test]
fn what_narrows_gently_or_only_for_a_while_has_no_ostium() {
    // Down to a femoral artery: 22 mm in the aorta, 10 in the common iliac artery, 5 at the groin.
    let femoral = [(0.0, 22.0), (60.0, 18.0), (70.0, 10.0), (120.0, 8.0), (170.0, 4.5), (220.0, 4.5)];
    // A coarctation, and an aneurysm of an artery.
    let coarctation = [(0.0, 20.0), (60.0, 20.0), (67.0, 4.0), (79.0, 4.0), (86.0, 20.0), (140.0, 20.0)];
    let aneurysm = [(0.0, 4.5), (40.0, 4.5), (47.0, 14.0), (57.0, 14.0), (64.0, 4.5), (110.0, 4.5)];
    for vessel in [&femoral, &coarctation, &aneurysm] {
        let tree = along_z(vessel);
        assert_eq!(tree.ostia(), []);
        let [from, to] = [5.0, vessel[5].0 - 5.0].map(|z| Vec3::Z * z as f32);
        assert!(tree.route(from, to).is_ok());
        assert_eq!((tree.ostium_on_way(from, to), tree.ostium_on_way(to, from)), (None, None));
    }
}

#[test]
fn a_target_behind_a_turn_back_is_the_last() {
    let (mesh, ends) = aorta(1.0);
    let tree = Tree::new(&mesh).unwrap();
    let from = |end: DVec3| {
        let targets = tree.targets((0.9 * end).as_vec3(), 0.0);
        ends_of(targets.into_iter().map(|target| target.at.to_array()), &ends)
    };
    let [top, long, short, _] = ends;
    // From below, the other artery is far and thin, and behind a turn of 130 degrees, that at the side behind one of 72.
    assert_eq!(from(short), [3, 0, 1]);
    assert_eq!(from(long), [3, 0, 2]);
    // From above, that at the side is behind a turn of 108.
    assert_eq!(from(top), [1, 2, 3], "the longer artery first");
}

/// An aorta of 18 mm from the origin along z, a little wider at its upper end, with arteries of `radius`: where each leaves the
/// middle of it, on which way across, and by how many degrees. Its tree, and the ends of the aorta and the arteries.
fn aorta_with_arteries(radius: f64, arteries: &[(f64, DVec3, f64)]) -> (Tree, Vec<DVec3>) {
    let [bottom, wide, top] = [0.0, 120.0, 150.0].map(|z| DVec3::Z * z);
    let mut ends = vec![bottom, top];
    let mut vessels = vec![(bottom, top, 9.0), (wide, top, 10.0)];
    for &(z, across, degrees) in arteries {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (from, way) = (DVec3::Z * z, across * sin + DVec3::Z * cos);
        let to = from + 50.0 * way;
        ends.push(to);
        vessels.push((from, to, radius));
    }
    let inside = |p: DVec3| {
        vessels.iter().map(|&(from, to, radius)| in_capsule(p, from, to, radius)).fold(f64::NEG_INFINITY, f64::max)
    };
    let mesh = isosurface(DVec3::new(-11.0, -54.0, -11.0), DVec3::new(54.0, 54.0, 162.0), 1.0, inside);
    (Tree::new(&mesh).unwrap(), ends)
}

#[test]
fn between_ostia_that_lie_closer_than_the_vessel_is_wide_it_goes_on_as_the_whole_vessel_does() {
    let (tree, ends) = aorta_with_arteries(3.0, &[(50.0, -DVec3::Y, 75.0), (74.0, DVec3::Y, 120.0)]);
    let is_short = |branch: &Branch| branch.ends == [End::Joint; 2] && branch.length_mm() < 18.0;
    assert_eq!(tree.branches().iter().filter(|branch| is_short(branch)).count(), 1);
    // What turns back is the last target, and past the other artery the aorta goes straight on.
    let from = Vec3::Z * 5.0;
    let targets = tree.targets(from, 0.0).into_iter().map(|target| target.at.to_array());
    assert_eq!(ends_of(targets, &ends), [2, 1, 3]);
    let forks = tree.route(from, (0.95 * ends[2]).as_vec3()).unwrap().forks(&tree);
    assert!(matches!(forks[..], [fork] if (fork.turn_degrees - 75.0).abs() < 5.0), "{forks:?}");
}

/// Arteries that leave an aorta closer to each other than it is wide.
const CLOSE: [(f64, DVec3, f64); 3] = [(50.0, DVec3::NEG_Y, 75.0), (61.0, DVec3::X, 75.0), (72.0, DVec3::Y, 75.0)];

#[test]
fn an_artery_that_leaves_a_short_piece_of_an_aorta_is_entered_in_its_ostium_too() {
    let (tree, ends) = aorta_with_arteries(2.4, &CLOSE);
    let ostia = tree.ostia();
    assert_eq!(ostia.len(), 3, "{ostia:?}");
    for end in &ends[2..] {
        let (_, entry) = tree.ostium_on_way(Vec3::Z * 5.0, end.as_vec3()).unwrap();
        let nearest = ends.iter().min_by(|a, b| {
            let away = |end: &DVec3| end.distance(Vec3::from(entry.at).as_dvec3());
            away(a).total_cmp(&away(b))
        });
        assert_eq!(nearest, Some(end), "{entry:?}");
    }
}

#[test]
fn a_piece_of_an_aorta_between_two_ostia_is_no_artery_that_leads_into_it() {
    // Both pieces beside the second artery are shorter than a branch of an aorta is.
    let (tree, ends) = aorta_with_arteries(3.0, &CLOSE);
    let found = ends_of(tree.entries().into_iter().map(|(_, entry)| entry.at), &ends);
    assert_eq!(found[..2], [0, 1], "by the aorta, not by an artery at its side: {found:?}");
}
