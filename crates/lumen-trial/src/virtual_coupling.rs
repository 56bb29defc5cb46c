//! What the hand holds at the guide: a spring between where the hand has moved the wire and where the wire is.
//!
//! A hand that is put straight onto the guide's reaction feels what the solver does: elements that are born, contacts that
//! change their triangle, steps that are not balanced. So it holds the wire by a virtual coupling (Colgate, Stanley & Brown,
//! "Issues in the haptic display of tool use", IROS 1995): the hand is at c, the wire is fed to f, the hand feels `K (c - f)`,
//! and the wire is fed at the speed v for which, a row of the log later, `K (c + T c' - f - T v) = push + (S T + B) v`. S is
//! the stiffness of the wire itself, by what the push has changed over the last rows. Once nothing moves the hand feels the
//! push; and the same about the axis with the roll and the torque.
//!
//! `B v` is all that a free wire is felt by, and what makes the coupling passive: the hand's work goes into the spring, into
//! the wire and into B. The push counts as of the last step that was balanced, and in other steps what is felt stands still.
//! It is bounded: a hand that pushes harder slips on the wire. The delay is that of the row, 20 ms, and of `B / K`, 17 ms.

use serde::{Deserialize, Serialize};

use super::STEP;
use super::report::{StepKind, StepReport};
use super::session::ROW_STEPS;
use super::setup::Input;

/// Seconds for which an input is latched.
const ROW: f64 = ROW_STEPS as f64 * STEP;

/// What is left of the wire's stiffness after a row in which it showed less.
const REMEMBERED: f64 = 0.8;

/// How the hand holds the wire along one direction; lengths in mm and forces in N, or in radians and N mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CouplingGains {
    /// K: by how much the force grows with each mm or radian that the wire stays behind.
    pub stiffness: f64,
    /// B: by which force a speed of 1 is felt.
    pub drag: f64,
    /// The most that is felt; beyond that the hand slips.
    pub most: f64,
    /// By how much what is felt changes in a second at most.
    pub slew: f64,
}

impl CouplingGains {
    /// Along the wire. A device renders `stiffness` times its factor as a spring, and can render only so stiff a spring: the
    /// softer this is, the more of a push is felt.
    pub const FEED: Self = Self { stiffness: 0.06, drag: 0.001, most: 2.0, slew: 5.0 };
    /// About it.
    pub const ROLL: Self = Self { stiffness: 1.0, drag: 0.01, most: 5.0, slew: 25.0 };
}

/// One direction of what is held.
#[derive(Clone, Copy, Debug)]
struct Coupling {
    grip: CouplingGains,
    /// How far the hand is ahead of the wire.
    ahead: f64,
    /// How far the hand went since the last row.
    moved: f64,
    /// The guide's reaction in the last balanced step, how far the wire had gone by then, and how far since.
    reaction: f64,
    gone: f64,
    went: f64,
    /// The same at the last row.
    before: [f64; 2],
    /// S: how stiff the wire is.
    wire: f64,
    felt: f64,
}

impl Coupling {
    fn new(grip: CouplingGains) -> Self {
        Self {
            grip,
            ahead: 0.0,
            moved: 0.0,
            reaction: 0.0,
            gone: 0.0,
            went: 0.0,
            before: [0.0; 2],
            wire: 0.0,
            felt: 0.0,
        }
    }

    fn moves(&mut self, by: f64) {
        let by = if by.is_finite() { by } else { 0.0 };
        let most = self.grip.most / self.grip.stiffness;
        self.ahead = (self.ahead + by).clamp(-most, most);
        self.moved += by;
    }

    fn speed(&mut self) -> f64 {
        let moved = std::mem::take(&mut self.moved);
        let [reaction, gone] = std::mem::replace(&mut self.before, [self.reaction, self.gone]);
        // Over less than a hundredth of a mm, or of a radian, a change says nothing.
        let way = self.gone - gone;
        let shown = if way.abs() > 0.01 { ((self.reaction - reaction) / way).max(0.0) } else { 0.0 };
        self.wire = shown.max(REMEMBERED * self.wire);
        let CouplingGains { stiffness, drag, .. } = self.grip;
        (stiffness * (self.ahead + moved) - self.reaction) / (drag + (stiffness + self.wire) * ROW)
    }

    fn stepped(&mut self, went: f64, reaction: f64, is_balanced: bool) {
        let CouplingGains { stiffness, most, slew, .. } = self.grip;
        self.ahead -= went;
        self.went += went;
        if is_balanced {
            self.reaction = reaction;
            self.gone += std::mem::take(&mut self.went);
            let change = stiffness * self.ahead - self.felt;
            self.felt = (self.felt + change.clamp(-slew * STEP, slew * STEP)).clamp(-most, most);
        }
    }
}

/// A hand on the wire.
#[derive(Clone, Copy, Debug)]
pub struct VirtualCoupling {
    feed: Coupling,
    roll: Coupling,
}

impl Default for VirtualCoupling {
    fn default() -> Self {
        Self::new(CouplingGains::FEED, CouplingGains::ROLL)
    }
}

impl VirtualCoupling {
    /// A hand that has just taken hold, and feels nothing yet.
    pub fn new(feed: CouplingGains, roll: CouplingGains) -> Self {
        Self { feed: Coupling::new(feed), roll: Coupling::new(roll) }
    }

    /// The hand moves so far, in mm and in radians; what is no number is nothing.
    pub fn moves(&mut self, by: [f64; 2]) {
        self.feed.moves(by[0]);
        self.roll.moves(by[1]);
    }

    /// The input for the row of the log that begins now, every [`ROW_STEPS`] steps.
    pub fn input(&mut self) -> Input {
        Input { feed: self.feed.speed() as f32, roll: self.roll.speed() as f32 }.limited()
    }

    /// Takes in a step of the trial.
    pub fn stepped(&mut self, report: &StepReport) {
        let is_balanced = report.kind == StepKind::Balanced;
        self.feed.stepped(report.fed_mm, report.push_n, is_balanced);
        self.roll.stepped(report.rolled_rad, report.torque_n_mm, is_balanced);
    }

    /// The force in N and the torque in N mm that the hand feels: positive against positive feed and roll.
    pub fn felt(&self) -> [f64; 2] {
        [self.feed.felt, self.roll.felt]
    }

    /// By how much these grow with each mm and each radian that the hand goes on.
    pub fn stiffness(&self) -> [f64; 2] {
        [self.feed.grip.stiffness, self.roll.grip.stiffness]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wire that pushes back as a spring of so many N/mm beyond a wall, and its hand.
    struct Spring {
        hold: VirtualCoupling,
        fed: f64,
        wall: f64,
        stiffness: f64,
        steps: u64,
        input: Input,
    }

    impl Spring {
        fn new(wall: f64, stiffness: f64) -> Self {
            Self { hold: VirtualCoupling::default(), fed: 0.0, wall, stiffness, steps: 0, input: Input::default() }
        }

        fn step(&mut self, by: f64, kind: StepKind) -> f64 {
            if self.steps.is_multiple_of(ROW_STEPS) {
                self.input = self.hold.input();
            }
            self.steps += 1;
            self.hold.moves([by, 0.0]);
            let fed_mm = f64::from(self.input.feed) * STEP;
            self.fed += fed_mm;
            let push_n = self.stiffness * (self.fed - self.wall).max(0.0);
            self.hold.stepped(&StepReport { kind, fed_mm, push_n, ..StepReport::default() });
            self.hold.felt()[0]
        }
    }

    #[test]
    fn a_free_wire_follows_and_is_felt_by_its_drag() {
        let mut wire = Spring::new(f64::INFINITY, 1.0);
        let felt: Vec<f64> = (0..1000).map(|_| wire.step(20.0 * STEP, StepKind::Balanced)).collect();
        // 20 mm/s by B = 0.001 N s/mm.
        let mean = felt[500..].iter().sum::<f64>() / 500.0;
        assert!((mean - 0.02).abs() < 0.002, "{mean} N");
        assert!((wire.fed - 40.0).abs() < 1.0);
    }

    #[test]
    fn at_rest_the_hand_feels_the_push() {
        for stiffness in [0.05, 0.5, 5.0] {
            let mut wire = Spring::new(5.0, stiffness);
            (0..500).for_each(|_| _ = wire.step(10.0 * STEP, StepKind::Balanced));
            let felt = (0..3000).map(|_| wire.step(0.0, StepKind::Balanced)).last().unwrap();
            // Two springs in a row: 10 mm of the hand, 5 mm to the wall.
            let expected = 5.0 / (1.0 / stiffness + 1.0 / CouplingGains::FEED.stiffness);
            assert!((felt - expected).abs() < 1e-3, "{felt} N, not {expected} N, by {stiffness} N/mm");
        }
    }

    #[test]
    fn over_closed_cycles_the_hand_gives() {
        for stiffness in [0.02, 0.1, 0.5] {
            for hz in [0.3, 1.0, 2.0] {
                let mut wire = Spring::new(0.0, stiffness);
                let (mut work, mut before) = (0.0, 0.0);
                let steps = (1.0 / hz / STEP) as u32;
                for i in 0..10 * steps {
                    let part = f64::from(i) / f64::from(steps);
                    let place = 5.0 * (1.0 - libm::cos(std::f64::consts::TAU * part));
                    let felt = wire.hold.felt()[0];
                    work += 0.5 * (felt + wire.step(place - before, StepKind::Balanced)) * (place - before);
                    before = place;
                }
                // In a cycle both springs take 10 mm in and give it back.
                let stored = 0.5 * 100.0 / (1.0 / stiffness + 1.0 / CouplingGains::FEED.stiffness);
                assert!(work > -0.005 * 10.0 * stored, "{work} N mm in ten cycles of {hz} Hz by {stiffness} N/mm");
            }
        }
    }

    #[test]
    fn what_is_not_balanced_is_not_felt_and_what_is_too_much_slips() {
        let mut wire = Spring::new(5.0, 0.5);
        let before = (0..800).map(|_| wire.step(10.0 * STEP, StepKind::Balanced)).last().unwrap();
        for kind in [StepKind::Braked, StepKind::Unsettled, StepKind::Waited, StepKind::Held] {
            assert_eq!((0..20).map(|_| wire.step(0.02, kind)).last(), Some(before));
        }
        let felt: Vec<f64> = (0..5000).map(|_| wire.step(0.1, StepKind::Balanced)).collect();
        assert!(felt.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= CouplingGains::FEED.slew * STEP + 1e-12));
        assert!((felt[4999] - CouplingGains::FEED.most).abs() < 0.01);
        // It does not first have to come back all the way that it slipped.
        let back = (0..200).map(|_| wire.step(-0.1, StepKind::Balanced)).last().unwrap();
        assert!(back < 1.0, "{back} N");
        wire.hold.moves([f64::NAN, f64::INFINITY]);
        assert!(wire.step(0.0, StepKind::Balanced).is_finite());
    }
}
