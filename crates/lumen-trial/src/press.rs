//! A load that presses the wire to the wall, away from the middle of the route.
//!
//! A wire under its own weight or a push lies along one side here and crosses the lumen there. Pressed outward it lies at
//! the wall nearly all along: the most that contact can ask of a step (`benches/trial.rs`).
//!
//! The middle is the route's point beside each node, found from the guide on by going forward along the route while that
//! comes nearer: a wire that turns back is pressed away from where it turned. A node at the middle itself has no way
//! outward, and one that crosses it is pressed to the other side from then on.

use glam::DVec3;

use super::route::Route;

/// The way outward at each node of a wire, of length 1: across the route, away from its middle. `nodes` are from the tip
/// to the guide's mouth, where the route begins.
pub(super) fn outward(route: &Route, nodes: impl DoubleEndedIterator<Item = DVec3>) -> Vec<DVec3> {
    let points = &route.points;
    let mut at = 0;
    let mut ways: Vec<DVec3> = nodes
        .rev()
        .map(|node| {
            let distance = |i: usize| points.get(i).map_or(f64::INFINITY, |point| point.at.distance_squared(node));
            while distance(at + 1) < distance(at) {
                at += 1;
            }
            points
                .get(at)
                .map_or(DVec3::ZERO, |point| (node - point.at).reject_from(point.direction).normalize_or_zero())
        })
        .collect();
    ways.reverse();
    ways
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::course::Course;
    use crate::session::Trial;
    use crate::setup::{Entry, Press, Setup};
    use crate::wire::Wire;
    use lumen_mesh::shapes::tube;

    #[test]
    fn a_wire_that_is_pressed_lies_at_the_wall_which_bears_all_of_the_load() {
        let mesh = Arc::new(tube(48, 60, 60.0, |_| 2.0));
        let wire = Wire { bend_degrees: 0.0, shaft_ei: 0.1, ..Wire::preset("workhorse").unwrap() };
        let entry = Some(Entry { at: [0.8, 0.0, 3.0], direction: [0.0, 0.0, 1.0] });
        let press = Press { n_per_mm: 1e-3, from_mm: 20.0 };
        let mut setup = Setup { wire, entry, target: Some([0.0, 0.0, 55.0]), press, ..Setup::default() };
        let course = Arc::new(Course::new(&mesh, None, &mut setup).unwrap());
        let mut trial = Trial::new(course, setup).unwrap();
        trial.set_autopilot(true);
        while trial.simulation().inserted() < 19.0 {
            trial.step();
        }
        assert_eq!(trial.simulation().body().pressure().0, 0.0);
        while trial.simulation().inserted() < 40.0 {
            trial.step();
        }
        trial.set_autopilot(false);
        (0..2000).for_each(|_| trial.step());
        let simulation = trial.simulation();
        let off = |p: DVec3| 2.0 - p.truncate().length() - simulation.body().contacts.radius;
        let nodes: Vec<DVec3> = simulation.nodes().collect();
        let at_wall = nodes.iter().filter(|&&node| off(node) < 0.05).count();
        assert!(at_wall as f64 > 0.75 * nodes.len() as f64, "{at_wall} of {}", nodes.len());
        // The guide bears a few mm of it.
        let all = 1e-3 * simulation.inserted();
        let borne = simulation.body().pressure().0;
        assert!(borne < 1.01 * all && borne > 0.85 * all, "{borne} N of {all}");
    }
}
