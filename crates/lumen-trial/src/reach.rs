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
//! The shaft lies at the wall, often at the one across from the branch. At a fork that turns by up to 60 degrees the tip
//! gets in if it comes aside by 1.2 radii of the lumen that is left; at one that turns by 70 to 90 degrees if it comes
//! aside by 2 radii and is bent by no less than the fork turns. Both were found by trials in forks that were made for it.
//! The border is taken between, at 65 degrees: the turn of a fork is known to five.
//!
//! Limits: of turns by more than a right angle nothing is said, as from one iliac artery into the other. Friction, and
//! what lies before the fork, do not come in.

use super::route::Fork;
use super::wire::Wire;
use lumen_message::messages;

/// In degrees: a tip that is bent by more points back, and of forks that turn by more nothing is said.
const ASIDE: f64 = 90.0;
/// Up to so many degrees a fork takes a reach of so many radii of the lumen that is left.
const GENTLE: (f64, f64) = (65.0, 1.2);
/// Beyond, it takes so many radii, and a bend of no less than it turns.
const SHARP: f64 = 2.0;

/// What a tip reaches, or what a fork takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// How far it comes aside of the shaft, in mm.
    pub aside_mm: f64,
    /// The angle between shaft and tip there, in degrees.
    pub bend_degrees: f64,
}

impl Wire {
    /// What its tip reaches where nothing bends it.
    pub fn reach(&self) -> Reach {
        let bend = self.bend_degrees.to_radians();
        if bend <= 0.0 {
            return Reach::default();
        }
        let radius = (self.bend_mm - self.straight_end_mm).max(0.0) / bend;
        if self.bend_degrees > ASIDE {
            return Reach { aside_mm: radius, bend_degrees: ASIDE };
        }
        let aside_mm = radius * (1.0 - libm::cos(bend)) + self.straight_end_mm * libm::sin(bend);
        Reach { aside_mm, bend_degrees: self.bend_degrees }
    }
}

impl Fork {
    /// What a tip must reach to get in; nothing where that is not known.
    pub fn takes(&self) -> Reach {
        match self.turn_degrees {
            turn if turn <= GENTLE.0 => Reach { aside_mm: GENTLE.1 * self.parent_radius_mm, bend_degrees: 0.0 },
            turn if turn <= ASIDE => Reach { aside_mm: SHARP * self.parent_radius_mm, bend_degrees: turn },
            _ => Reach::default(),
        }
    }

    /// How many times as much it takes as a tip reaches: the tip gets in where that is no more than 1.
    fn excess(&self, tip: Reach) -> f64 {
        let takes = self.takes();
        let times = |takes: f64, has: f64| if takes > 0.0 { takes / has.max(f64::MIN_POSITIVE) } else { 0.0 };
        times(takes.aside_mm, tip.aside_mm).max(times(takes.bend_degrees, tip.bend_degrees))
    }
}

/// The fork that a wire's tip misses by most, and how many times as much as it reaches that takes.
fn missed(forks: &[Fork], wire: &Wire) -> Option<(f64, Fork)> {
    let tip = wire.reach();
    let missed = forks.iter().map(|fork| (fork.excess(tip), *fork)).filter(|(excess, _)| *excess > 1.0);
    missed.reduce(|most, next| if next.0 > most.0 { next } else { most })
}

/// Puts the wires whose tips get into all forks first, then those that miss one by less. Of equal ones the order stays.
pub(super) fn rank(wires: &mut [Wire], forks: &[Fork]) {
    let excess = |wire: &Wire| missed(forks, wire).map_or(1.0, |(excess, _)| excess);
    wires.sort_by(|a, b| excess(a).total_cmp(&excess(b)));
}

/// What is said where the tip of `wire` does not get into a fork; `others` are the wires that could go in instead.
pub(super) fn finding(forks: &[Fork], wire: &Wire, others: &[Wire]) -> Option<ReachFinding> {
    let (_, fork) = missed(forks, wire)?;
    let (takes, tip) = (fork.takes(), wire.reach());
    let reach = takes.aside_mm;
    let needs = match takes.bend_degrees {
        bend if bend > 0.0 => TipNeeded::Bent { reach, bend },
        _ => TipNeeded::Long { reach },
    };
    let (along, turn, width) = (fork.arc_mm, fork.turn_degrees, 2.0 * fork.parent_radius_mm);
    let (reach, bend) = (tip.aside_mm, tip.bend_degrees);
    Some(if others.iter().any(|other| missed(forks, other).is_none()) {
        ReachFinding::Another { along, turn, width, needs, reach, bend }
    } else {
        ReachFinding::None { along, turn, width, needs, reach, bend }
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
            /// The tip that it takes.
            needs: TipNeeded,
            /// How far this one reaches, in mm.
            reach: f64 [1],
            /// By how many degrees it is bent there.
            bend: f64 [0],
        } => "No wire is expected to get into the branch at the fork {along:.0} mm along the route, which turns by {turn:.0}° \
              out of a lumen {width:.1} mm wide: {needs}, and that of this one reaches {reach:.1} mm, bent by {bend:.0}°.",
        /// That of another wire does.
        "trial-reach-another" Another {
            /// Arc length of the fork along the route, in mm.
            along: f64 [0],
            /// The angle by which the route turns there, in degrees.
            turn: f64 [0],
            /// Diameter of the lumen that it leaves, in mm.
            width: f64 [1],
            /// The tip that it takes.
            needs: TipNeeded,
            /// How far this one reaches, in mm.
            reach: f64 [1],
            /// By how many degrees it is bent there.
            bend: f64 [0],
        } => "This wire is not expected to get into the branch at the fork {along:.0} mm along the route, which turns by \
              {turn:.0}° out of a lumen {width:.1} mm wide: {needs}, and its own reaches {reach:.1} mm, bent by {bend:.0}°. The \
              one that is proposed is.",
    }
}

messages! {
    /// The tip that a fork takes, as a clause.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum TipNeeded {
        /// Long enough.
        "trial-reach-long" Long {
            /// How far it reaches aside, in mm.
            reach: f64 [1],
        } => "it takes a tip that reaches {reach:.1} mm aside",
        /// And bent by enough: that is the curve of a catheter.
        "trial-reach-bent" Bent {
            /// How far it reaches aside, in mm.
            reach: f64 [1],
            /// By how many degrees it is bent.
            bend: f64 [0],
        } => "it takes a tip that reaches {reach:.1} mm aside and is bent by {bend:.0}° or more",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let square = shaped(quarter + 5.0, 90.0, 5.0).reach();
        near(square.aside_mm, 15.0);
        near(square.bend_degrees, 90.0);
        // Nearly no arc: the straight end is the side of a triangle.
        near(shaped(8.0 + 1e-9, 30.0, 8.0).reach().aside_mm, 4.0);
        // Of a half circle the bow leads: one radius. A straight wire reaches nowhere.
        near(shaped(2.0 * quarter, 180.0, 0.0).reach().aside_mm, 10.0);
        assert_eq!(shaped(12.0, 0.0, 8.0).reach(), Reach::default());
    }

    /// The lumen that is left has a radius of 5 mm.
    fn fork(turn_degrees: f64) -> Fork {
        Fork { arc_mm: 40.0, parent_radius_mm: 5.0, branch_radius_mm: 3.0, turn_degrees }
    }

    #[test]
    fn wires_that_get_into_every_fork_come_first_and_the_others_by_what_they_lack() {
        // Ends square to the shaft with nearly no arc: each reaches as far as it is long.
        let wire =
            |name: &str, length: f64, degrees: f64| Wire { name: name.to_owned(), ..shaped(length, degrees, length) };
        let order = |forks: &[Fork]| {
            let mut wires = [wire("short", 5.0, 90.0), wire("gentle", 13.0, 60.0), wire("curve", 10.0, 90.0)];
            rank(&mut wires, forks);
            wires.map(|wire| wire.name)
        };
        assert_eq!(order(&[]), ["short", "gentle", "curve"], "without a fork the order stays");
        // 1.2 radii are 6 mm.
        assert_eq!(order(&[fork(45.0)]), ["gentle", "curve", "short"]);
        // 2 radii are 10 mm, and a bend of 60 degrees is too little for a turn of 85.
        assert_eq!(order(&[fork(45.0), fork(85.0)]), ["curve", "gentle", "short"]);
        assert_eq!(order(&[fork(140.0)]), ["short", "gentle", "curve"], "nothing is known of it");
    }

    #[test]
    fn what_no_tip_reaches_is_said_with_its_numbers() {
        let short = shaped(5.0, 60.0, 5.0);
        let square = shaped(10.5, 90.0, 10.5);
        assert_eq!(finding(&[fork(45.0), fork(75.0)], &square, &[]), None);
        let said = finding(&[fork(45.0), fork(75.0)], &short, std::slice::from_ref(&short)).unwrap().to_string();
        assert_eq!(
            said,
            "No wire is expected to get into the branch at the fork 40 mm along the route, which turns by 75° out of a lumen 10.0 mm \
             wide: it takes a tip that reaches 10.0 mm aside and is bent by 75° or more, and that of this one reaches 4.3 mm, bent by 60°."
        );
        let said = finding(&[fork(45.0)], &short, &[square]).unwrap().to_string();
        assert!(
            said.starts_with("This wire is not expected") && said.contains("a tip that reaches 6.0 mm aside, and"),
            "{said}"
        );
    }
}
