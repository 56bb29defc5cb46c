//! What a step tells of itself: of which kind it was, what was fed of what was wanted, and what it left over.
//!
//! A step that is balanced has found forces that hold each other. Where something snaps the solver adds drag of its own,
//! lets forces rise by so much in a second only, or lets the guide wait: what is felt then is partly that; and now and then
//! its corrections end before the forces have settled. So the forces
//! that are shown, logged and summed up are those of balanced steps, and the share of the others stands beside them.

use serde::{Deserialize, Serialize};

/// Of which kind a step was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum StepKind {
    /// Its forces are in balance.
    #[default]
    Balanced,
    /// Nothing was damped, but its corrections ended before its forces were in balance.
    Unsettled,
    /// Artificial damping was needed: something snapped.
    Braked,
    /// It had to be damped so hard that the guide waited: nothing was fed or rolled.
    Waited,
    /// The solver found no way on: the rod is where it was.
    Held,
}

/// What came of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepReport {
    /// Of which kind it was.
    pub kind: StepKind,
    /// What the input asked to be fed in the step, in mm; negative withdraws.
    pub wanted_mm: f64,
    /// What was fed: less where the guide waits, its push is at its limit, or it is at an end of the wire.
    pub fed_mm: f64,
    /// What the input asked to be rolled, in radians.
    pub wanted_rad: f64,
    /// What was rolled.
    pub rolled_rad: f64,
    /// The residual: by how much Newton's second law is missed for the wire outside the guide as a whole, in N: what
    /// artificial damping took, and what was not settled.
    pub residual_n: f64,
    /// The push: what the hand does to the wire along the way in, in N, which is the work of each mm that is fed. Positive
    /// where it pushes the wire in, which pushes back; negative where it pulls. This is the sign of every push in frames,
    /// logs and summaries.
    pub push_n: f64,
    /// The torque: the moment of the guide on the wire about the way in, in N mm. Positive, right-handed, where the wire
    /// turns back from a positive roll. This is the sign of every torque.
    pub torque_n_mm: f64,
}

impl StepReport {
    /// Of two parts of a step: how far they went together, the larger residual, push and torque at the end, and the worse of
    /// the kinds. A step in which the guide waits for one part alone is braked.
    #[must_use]
    pub(super) fn followed_by(&self, next: &Self) -> Self {
        let (better, worse) = (self.kind.min(next.kind), self.kind.max(next.kind));
        Self {
            kind: if worse < StepKind::Waited { worse } else { better.max(StepKind::Braked) },
            wanted_mm: self.wanted_mm + next.wanted_mm,
            fed_mm: self.fed_mm + next.fed_mm,
            wanted_rad: self.wanted_rad + next.wanted_rad,
            rolled_rad: self.rolled_rad + next.rolled_rad,
            residual_n: self.residual_n.max(next.residual_n),
            ..*next
        }
    }
}

/// Numbers of steps, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StepCounts {
    /// In balance.
    pub balanced: u64,
    /// Not damped, and not in balance.
    pub unsettled: u64,
    /// Artificially damped.
    pub braked: u64,
    /// Artificially damped, with the guide waiting.
    pub waited: u64,
    /// Without a way on.
    pub held: u64,
}

impl StepCounts {
    /// Counts one more.
    pub fn count(&mut self, kind: StepKind) {
        *match kind {
            StepKind::Balanced => &mut self.balanced,
            StepKind::Unsettled => &mut self.unsettled,
            StepKind::Braked => &mut self.braked,
            StepKind::Waited => &mut self.waited,
            StepKind::Held => &mut self.held,
        } += 1;
    }

    /// All of them.
    pub fn all(&self) -> u64 {
        self.balanced + self.unsettled + self.braked + self.waited + self.held
    }

    /// The part of them that was not in balance, 0 to 1.
    pub fn unbalanced_share(&self) -> f64 {
        (self.all() - self.balanced) as f64 / self.all().max(1) as f64
    }

    /// Those since there were `before`.
    #[must_use]
    pub fn since(&self, before: &Self) -> Self {
        Self {
            balanced: self.balanced - before.balanced,
            unsettled: self.unsettled - before.unsettled,
            braked: self.braked - before.braked,
            waited: self.waited - before.waited,
            held: self.held - before.held,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_parts_of_a_step_are_one() {
        let part =
            |kind, fed_mm, residual_n| StepReport { kind, fed_mm, residual_n, push_n: fed_mm, ..Default::default() };
        let both = part(StepKind::Balanced, 0.05, 0.3).followed_by(&part(StepKind::Unsettled, 0.03, 0.1));
        assert_eq!((both.kind, both.residual_n, both.push_n), (StepKind::Unsettled, 0.3, 0.03));
        assert!((both.fed_mm - 0.08).abs() < 1e-12);
        let kind = |a, b| part(a, 0.0, 0.0).followed_by(&part(b, 0.0, 0.0)).kind;
        assert_eq!(kind(StepKind::Balanced, StepKind::Waited), StepKind::Braked);
        assert_eq!(kind(StepKind::Waited, StepKind::Held), StepKind::Waited);
        assert_eq!(kind(StepKind::Held, StepKind::Held), StepKind::Held);
    }

    #[test]
    fn kinds_are_counted_apart() {
        let mut counts = StepCounts::default();
        assert_eq!(counts.unbalanced_share(), 0.0);
        use StepKind::{Balanced, Braked, Held, Unsettled, Waited};
        let kinds = [Balanced, Braked, Waited, Held, Held, Unsettled, Unsettled, Balanced];
        kinds.into_iter().for_each(|kind| counts.count(kind));
        assert_eq!(counts, StepCounts { balanced: 2, unsettled: 2, braked: 1, waited: 1, held: 2 });
        assert_eq!((counts.all(), counts.unbalanced_share()), (8, 0.75));
        let before = counts;
        counts.count(StepKind::Waited);
        assert_eq!(counts.since(&before), StepCounts { waited: 1, ..StepCounts::default() });
    }
}
