//! What wire and target are proposed where nobody has said any.

use super::reach::{ASIDE, gets_in};
use super::route::{Fork, PlaceName, Proposals as _, Route, Routes as _, Target, last_passed};
use super::setup::Entry;
use super::wire::Wire;
use lumen_mesh::Vec3;
use lumen_vessel::Tree;

/// The lumen is so many times as wide as the wire all along to a target that is proposed.
const ROOM: f64 = 2.0;
/// A wire of 0.035 in is proposed for a way of at least this usual radius, in mm, and as far as it comes: past small
/// branches it goes straight on, and at forks its long bend reaches to the other side of a wide lumen.
const WIDE: f64 = 2.0;
/// Unless it comes less far than this part of where one of 0.014 in comes.
const PART: f64 = 0.5;

/// So many of the widest ends are looked at as entries, and so many other targets where the first is hard to reach.
const ENTRIES: usize = 6;
const TARGETS: usize = 12;
/// An entry is proposed if what can be reached from it lies at least this part as far as from the best of the others.
const FAR: f64 = 0.5;

/// The entry that is proposed: the widest end, unless a wire comes much farther from another. An end with nothing behind it
/// is none: the rim of a flat cap, or a stump beside the vessel; nor is one where the wire does not fit, as `fits` says.
pub(super) fn proposed_entry(
    tree: &Tree,
    entries: &[(PlaceName, Entry)],
    wire: Option<&Wire>,
    fits: impl Fn(&Entry, &Wire) -> bool,
) -> Option<Entry> {
    let length = |entry: &Entry| {
        let from = Vec3::from(entry.at);
        let (wire, target) = match wire {
            Some(wire) => (wire.clone(), reached(tree, from, wire, Choice::First)),
            None => proposed(tree, from, None, Choice::First),
        };
        target.filter(|_| fits(entry, &wire)).map_or(0.0, |target| target.length_mm)
    };
    let lengths: Vec<f64> = entries.iter().take(ENTRIES).map(|(_, entry)| length(entry)).collect();
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let is_far = |&i: &usize| lengths[i] >= FAR * longest;
    (0..lengths.len()).find(is_far).map(|i| entries[i].1)
}

/// The wires for which there is room along a route, in the order in which they go in where their tips get in alike: of the
/// diameter of `first`, the shorter tip before the longer, and that of 60 degrees before the catheter's curve of 90, which
/// slides past forks that turn by less.
pub(super) fn suiting(route: &Route, first: &Wire) -> Vec<Wire> {
    let is_thick = first.diameter_mm > Wire::named(Wire::USUAL).diameter_mm;
    let names: &[&str] = if is_thick {
        &[Wire::LONG_BEND, Wire::LONG_TIP, Wire::CURVE, Wire::USUAL]
    } else {
        &[Wire::USUAL, Wire::LONG_BEND, "workhorse-j"]
    };
    with_room(route, names.iter().copied())
}

/// Those wires of these names for which there is room along a route.
pub(super) fn with_room(route: &Route, names: impl Iterator<Item = &'static str>) -> Vec<Wire> {
    names.map(Wire::named).filter(|wire| route.clearance(ROOM * wire.diameter_mm).is_ok()).collect()
}

/// Which of the targets that a wire comes to is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Choice<'a> {
    /// The first.
    First,
    /// The first; where the wire has less room on the way than it should, or its tip does not get into one of the forks, the
    /// first of the next [`TARGETS`] where that is otherwise.
    Open {
        /// Whether it is the only wire. Else the tip of one that follows it may do as well.
        is_only: bool,
        /// Where a guide catheter leads it in: what lies before is the catheter's.
        ostia: &'a [(PlaceName, Entry)],
    },
}

/// The best target that a wire can reach.
pub(super) fn reached(tree: &Tree, from: Vec3, wire: &Wire, choice: Choice<'_>) -> Option<Target> {
    let mut targets = tree.targets(from, ROOM * wire.diameter_mm).into_iter();
    // The middle of the lumen may go another way there than the spheres do that the room was taken of.
    let way = |target: Target| {
        let route = tree.route(from, target.at).ok()?;
        route.clearance(wire.diameter_mm).is_ok().then_some((target, route))
    };
    let (first, route) = targets.find_map(way)?;
    let Choice::Open { is_only, ostia } = choice else { return Some(first) };
    let forks = |target: &Target, route: &Route| {
        let guided = last_passed(ostia, route, target.at).map_or(f64::NEG_INFINITY, |(arc, _)| arc);
        let forks = route.forks(tree);
        forks.into_iter().filter(|fork| fork.arc_mm > guided).collect::<Vec<_>>()
    };
    let is_open = |forks: &[Fork], route: &Route| {
        let has_room = route.clearance(ROOM * wire.diameter_mm).is_ok();
        has_room
            && match is_only {
                true => gets_in(forks, std::slice::from_ref(wire)),
                false => gets_in(forks, &suiting(route, wire)),
            }
    };
    if is_open(&forks(&first, &route), &route) {
        return Some(first);
    }
    let open = targets.take(TARGETS).filter_map(way).find(|(target, route)| {
        let forks = forks(target, route);
        // Of a turn by more than a right angle nothing is known.
        forks.iter().all(|fork| fork.turn_degrees <= ASIDE) && is_open(&forks, route)
    });
    Some(open.map_or(first, |(target, _)| target))
}

/// The wire for the way to a target; without one, for the best that it can reach, and that.
pub(super) fn proposed(tree: &Tree, from: Vec3, target: Option<Vec3>, choice: Choice<'_>) -> (Wire, Option<Target>) {
    let [thick, thin] = [Wire::LONG_BEND, Wire::USUAL].map(Wire::named);
    if let Some(target) = target {
        // That there is no route is said when it is asked for.
        let is_wide = tree
            .route(from, target)
            .is_ok_and(|route| route.usual_radius_mm() >= WIDE && route.clearance(ROOM * thick.diameter_mm).is_ok());
        return (if is_wide { thick } else { thin }, None);
    }
    let [by_thick, by_thin] = [&thick, &thin].map(|wire| reached(tree, from, wire, choice));
    let is_far = |target: &Target| by_thin.as_ref().is_none_or(|other| target.length_mm >= PART * other.length_mm);
    match by_thick.filter(|target| target.usual_radius_mm >= WIDE && is_far(target)) {
        Some(target) => (thick, Some(target)),
        None => (thin, by_thin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use lumen_mesh::shapes::{parted, tube};

    #[test]
    fn an_end_with_nothing_behind_it_is_not_proposed_as_an_entry() {
        // The wide end is a stump of 8 mm behind a waist of 0.8 mm; the thin vessel is 52 mm long.
        let radius = |z: f32| {
            let usual = if z < 8.0 { 3.0 } else { 1.5 };
            usual - (usual - 0.42) * (-(z - 8.0) * (z - 8.0) / 9.0).exp()
        };
        let tree = Tree::new(&tube(48, 480, 60.0, radius)).unwrap();
        let entries = tree.entries();
        assert!(entries[0].1.at[2] < 8.0, "the widest end is listed first: {entries:?}");
        let proposed_z = |wire| proposed_entry(&tree, &entries, Some(&Wire::named(wire)), |_, _| true).unwrap().at[2];
        // A wire that comes through the waist enters at the widest end; for a thicker one there is nothing behind it.
        assert!(proposed_z(Wire::USUAL) < 8.0 && proposed_z(Wire::LONG_BEND) > 50.0);
    }

    #[test]
    fn an_entry_where_the_wire_does_not_fit_is_not_proposed() {
        let tree = Tree::new(&tube(48, 480, 60.0, |z| 3.0 - 0.01 * z)).unwrap();
        let entries = tree.entries();
        let wire = Wire::named(Wire::USUAL);
        let proposed = |fits: &dyn Fn(&Entry, &Wire) -> bool| proposed_entry(&tree, &entries, Some(&wire), fits);
        assert_eq!(proposed(&|_, _| true), Some(entries[0].1));
        assert_eq!(proposed(&|entry, _| *entry != entries[0].1), Some(entries[1].1));
    }

    #[test]
    fn a_target_behind_a_fork_that_no_tip_gets_into_gives_way_to_another() {
        let goes_into_branch = |radius: f64, is_only| {
            let choice = Choice::Open { is_only, ostia: &[] };
            let (mesh, end) = parted(radius, 200.0, 100.0, radius / 8.0);
            let tree = Tree::new(&mesh).unwrap();
            let target = reached(&tree, Vec3::Z * 4.0, &Wire::named(Wire::LONG_BEND), choice).unwrap().at.as_dvec3();
            target.distance(end) < target.distance(DVec3::Z * 200.0)
        };
        // The fork takes 1.2 radii. The longest tip reaches 23 mm, that of the wire 9.
        assert!(goes_into_branch(16.0, false) && !goes_into_branch(24.0, false));
        assert!(goes_into_branch(7.0, true) && !goes_into_branch(16.0, true));
    }

    #[test]
    fn the_wires_of_a_route_have_room() {
        let of = |radius: f32, first| {
            let tree = Tree::new(&tube(32, 60, 40.0, |_| radius)).unwrap();
            let route = tree.route(Vec3::Z * 3.0, Vec3::Z * 37.0).unwrap();
            suiting(&route, &Wire::named(first)).into_iter().map(|wire| wire.name).collect::<Vec<_>>()
        };
        assert_eq!(of(2.0, Wire::LONG_BEND), [Wire::LONG_BEND, Wire::LONG_TIP, Wire::CURVE, Wire::USUAL]);
        assert_eq!(of(2.0, Wire::USUAL), [Wire::USUAL, Wire::LONG_BEND, "workhorse-j"]);
        // 1.2 mm across: twice 0.356 mm, and not 0.889.
        assert_eq!(of(0.6, Wire::USUAL), [Wire::USUAL, "workhorse-j"]);
    }

    #[test]
    fn what_a_wire_has_reached_before_it_moves_is_no_target() {
        let of = |length: f32| {
            let tree = Tree::new(&tube(32, 40, length, |_| 0.4)).unwrap();
            tree.targets(Vec3::Z * 1.0, 0.0).len()
        };
        assert_eq!((of(5.0), of(20.0)), (0, 1));
    }
}
