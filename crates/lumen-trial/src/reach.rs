//! Whether a wire's tip reaches into the branches that a route takes.
//!
//! A tip that is bent by an angle `a` over a length `l`, with a straight end of length `s`, comes aside of its shaft by
//!
//! ```text
//! r (1 - cos a) + s sin a,   r = l / a
//! ```
//!
//! Where `a` is more than a right angle the end points back and the bow leads, which comes aside by `r`.
//!
//! The shaft lies at the wall, often at the one across from the branch: a tip gets in if it comes aside by 1.2 radii of the
//! lumen that is left. That was found on forks that were made for it: docs/benchmarks/trial.md.
//!
//! Limits: of turns by more than a right angle nothing is said, as from one iliac artery into the other. Friction, what lies
//! before the fork, and how a mouth widens do not come in: a wire that is not expected to get in may.

use super::route::Fork;
use super::wire::Wire;
use lumen_message::messages;

/// In degrees: a tip that is bent by more points back, and of forks that turn by more nothing is said.
pub(super) const ASIDE: f64 = 90.0;
/// A fork takes a reach of so many radii of the lumen that is left.
const RADII: f64 = 1.2;
/// The radius of a lumen before a fork is known to a tenth: a tip that lacks no more gets in.
const KNOWN_TO: f64 = 1.1;

impl Wire {
    /// How far its tip comes aside of its shaft where nothing bends it, in mm.
    pub fn reach_mm(&self) -> f64 {
        let bend = self.bend_degrees.to_radians();
        if bend <= 0.0 {
            return 0.0;
        }
        let radius = (self.bend_mm - self.straight_end_mm).max(0.0) / bend;
        if self.bend_degrees > ASIDE {
            return radius;
        }
        radius * (1.0 - libm::cos(bend)) + self.straight_end_mm * libm::sin(bend)
    }
}

impl Fork {
    /// How far aside a tip must come to get in, in mm; nothing where that is not known.
    pub fn takes_mm(&self) -> f64 {
        if self.turn_degrees <= ASIDE { RADII * self.parent_radius_mm } else { 0.0 }
    }
}

/// The fork that takes more than a wire's tip reaches: of several the one that takes most.
fn missed(forks: &[Fork], wire: &Wire) -> Option<Fork> {
    let most = forks.iter().copied().reduce(|most, next| if next.takes_mm() > most.takes_mm() { next } else { most });
    most.filter(|fork| fork.takes_mm() > KNOWN_TO * wire.reach_mm())
}

/// Whether the tip of one of these wires gets into all forks.
pub(super) fn gets_in(forks: &[Fork], wires: &[Wire]) -> bool {
    wires.iter().any(|wire| missed(forks, wire).is_none())
}

/// Puts the wires whose tips get into all forks first, then those that reach farther. Of equal ones the order stays.
pub(super) fn rank(wires: &mut [Wire], forks: &[Fork]) {
    let lacks = |wire: &Wire| missed(forks, wire).map_or(0.0, |fork| fork.takes_mm() - wire.reach_mm());
    wires.sort_by(|a, b| lacks(a).total_cmp(&lacks(b)));
}

/// What is said where the tip of `wire` does not get into a fork; `others` are the wires that could go in instead.
pub(super) fn finding(forks: &[Fork], wire: &Wire, others: &[Wire]) -> Option<ReachFinding> {
    let fork = missed(forks, wire)?;
    let (along, turn, width) = (fork.arc_mm, fork.turn_degrees, 2.0 * fork.parent_radius_mm);
    let (takes, reach) = (fork.takes_mm(), wire.reach_mm());
    Some(if gets_in(forks, others) {
        ReachFinding::Another { along, turn, width, takes, reach }
    } else {
        ReachFinding::None { along, turn, width, takes, reach }
    })
}

messages! {
    /// That a wire's tip does not get in at a fork.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum ReachFinding {
        /// Nor does that of any other wire.
        "trial-reach-none" None {
            /// Arc length of the fork along the route, in mm.
            along: f64 [0],
            /// The angle by which the route turns there, in degrees.
            turn: f64 [0],
            /// Diameter of the lumen that it leaves, in mm.
            width: f64 [1],
            /// How far aside a tip must reach, in mm.
            takes: f64 [1],
            /// How far this one does, in mm.
            reach: f64 [1],
        } => "No wire is expected to get into the branch at the fork {along:.0} mm along the route, which turns by {turn:.0}° \
              out of a lumen {width:.1} mm wide: that takes a tip that reaches {takes:.1} mm aside, and this one reaches \
              {reach:.1} mm.",
        /// That of another wire does.
        "trial-reach-another" Another {
            /// Arc length of the fork along the route, in mm.
            along: f64 [0],
            /// The angle by which the route turns there, in degrees.
            turn: f64 [0],
            /// Diameter of the lumen that it leaves, in mm.
            width: f64 [1],
            /// How far aside a tip must reach, in mm.
            takes: f64 [1],
            /// How far this one does, in mm.
            reach: f64 [1],
        } => "This wire is not expected to get into the branch at the fork {along:.0} mm along the route, which turns by \
              {turn:.0}° out of a lumen {width:.1} mm wide: that takes a tip that reaches {takes:.1} mm aside, and this one \
              reaches {reach:.1} mm. The tip of another wire does.",
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::course::Course;
    use crate::frame::Progress;
    use crate::log::Log;
    use crate::session::Trial;
    use crate::setup::{Entry, Setup};
    use lumen_mesh::shapes::parted;

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-6 * expected.abs().max(1.0), "{found}, not {expected}");
    }

    fn shaped(bend_mm: f64, bend_degrees: f64, straight_end_mm: f64) -> Wire {
        Wire { bend_mm, bend_degrees, straight_end_mm, ..Wire::default() }
    }

    #[test]
    fn a_tip_reaches_as_far_aside_as_its_arc_and_its_straight_end_do() {
        // A quarter of a circle of radius 10 and an end of 5 mm square to the shaft.
        let quarter = 10.0 * std::f64::consts::FRAC_PI_2;
        near(shaped(quarter + 5.0, 90.0, 5.0).reach_mm(), 15.0);
        // Nearly no arc: the straight end is the side of a triangle.
        near(shaped(8.0 + 1e-9, 30.0, 8.0).reach_mm(), 4.0);
        // Of a half circle the bow leads: one radius. A straight wire reaches nowhere.
        near(shaped(2.0 * quarter, 180.0, 0.0).reach_mm(), 10.0);
        near(shaped(12.0, 0.0, 8.0).reach_mm(), 0.0);
    }

    fn fork(turn_degrees: f64, parent_radius_mm: f64) -> Fork {
        Fork { arc_mm: 40.0, parent_radius_mm, branch_radius_mm: 3.0, turn_degrees }
    }

    #[test]
    fn wires_that_get_into_every_fork_come_first_and_the_others_by_what_they_lack() {
        // Ends square to the shaft with nearly no arc: each reaches as far as it is long.
        let wire = |length: f64| Wire { name: format!("{length}"), ..shaped(length, 90.0, length) };
        let order = |forks: &[Fork]| {
            let mut wires = [wire(5.0), wire(8.0), wire(20.0), wire(10.0)];
            rank(&mut wires, forks);
            wires.map(|wire| wire.name)
        };
        assert_eq!(order(&[]), ["5", "8", "20", "10"], "without a fork the order stays");
        // 1.2 radii are 6 mm, of which 5 is too little.
        assert_eq!(order(&[fork(45.0, 5.0)]), ["8", "20", "10", "5"]);
        assert_eq!(order(&[fork(30.0, 3.0), fork(80.0, 12.5)]), ["20", "10", "8", "5"]);
        assert_eq!(order(&[fork(80.0, 100.0)]), ["20", "10", "8", "5"]);
        assert_eq!(order(&[fork(140.0, 12.5)]), ["5", "8", "20", "10"], "nothing is known of it");
    }

    #[test]
    fn what_no_tip_reaches_is_said_with_its_numbers() {
        let [short, long] = [5.0, 9.5].map(|length| shaped(length, 90.0, length));
        let forks = [fork(45.0, 5.0), fork(75.0, 8.0)];
        assert_eq!(finding(&forks, &long, &[]), None);
        let said = finding(&forks, &short, std::slice::from_ref(&short)).unwrap().to_string();
        assert_eq!(
            said,
            "No wire is expected to get into the branch at the fork 40 mm along the route, which turns by 75° out of a lumen \
             16.0 mm wide: that takes a tip that reaches 9.6 mm aside, and this one reaches 5.0 mm."
        );
        let said = finding(&forks, &short, &[long]).unwrap().to_string();
        assert!(said.starts_with("This wire is not") && said.contains("reaches 9.6 mm aside"), "{said}");
    }

    /// The simulation knows nothing of reach.
    #[test]
    fn the_tip_that_reaches_into_a_made_fork_gets_in_and_the_one_that_does_not_stays_out() {
        let (mesh, end) = parted(12.0, 160.0, 59.0, 1.2);
        let mesh = Arc::new(mesh);
        let entry = Some(Entry { at: [0.0, 0.0, 4.0], direction: [0.0, 0.0, 1.0] });
        let open = Setup { entry, target: Some(end.as_vec3().to_array()), seed: 1, ..Setup::default() };
        let steered = |mut setup: Setup| {
            let course = Course::new(&mesh, None, &mut setup).unwrap();
            let reach = course.reach;
            let mut trial = Trial::new(Arc::new(course), setup).unwrap();
            trial.set_autopilot(true);
            (trial, reach)
        };
        let (mut trial, reach) = steered(Setup { proposes_wire: true, ..open.clone() });
        // 1.2 radii are 14.4 mm: a tip of 12 mm is too short.
        assert_eq!((trial.wire().name.as_str(), reach), (Wire::LONG_TIP, None));
        trial.finish();
        let summary = trial.summary();
        assert!(summary.success && summary.failed_wires.is_empty(), "{}", summary.reason);
        // Beside a thin wire thick ones count, too.
        let (_, reach) = steered(Setup { wire: Wire::named(Wire::USUAL), ..open.clone() });
        assert!(matches!(reach, Some(ReachFinding::Another { .. })), "{reach:?}");
        let (mut trial, reach) = steered(Setup { wire: Wire::named(Wire::LONG_BEND), ..open });
        assert!(matches!(reach, Some(ReachFinding::Another { .. })), "{reach:?}");
        (0..2 * summary.steps).for_each(|_| trial.step());
        assert_eq!(trial.progress(), Progress::Running);
        let csv = trial.log().csv(1).unwrap();
        assert!(csv.contains("# This wire is not expected") && Log::read(csv.as_bytes()).is_ok());
    }
}
