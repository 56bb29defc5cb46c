//! What a step tells of itself: of which kind it was, what was fed of what was wanted, and what it left over.
//!
//! A step that is balanced has found forces that hold each other. Where something snaps the solver adds drag of its own,
//! lets forces rise by so much in a second only, or lets the guide wait: what is felt then is partly that. So the forces
//! that are shown, logged and summed up are those of balanced steps, and the share of the others stands beside them.

use serde::{Deserialize, Serialize};

/// Of which kind a step was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum StepKind {
    /// Its forces are in balance.
    #[default]
    Balanced,
    /// The rod had to be braked: something snapped.
    Braked,
    /// It had to be braked so hard that what is held waited: nothing was fed or rolled.
    Waited,
    /// There was no way: the rod is where it was.
    Held,
}

/// What came of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepReport {
    /// Of which kind it was.
    pub kind: StepKind,
    /// What the input asked to be fed in the step, in mm; negative withdraws.
    pub wanted_mm: f64,
    /// What was fed: less where the guide waits, holds back, or is at an end of the wire.
    pub fed_mm: f64,
    /// What the input asked to be rolled, in radians.
    pub wanted_rad: f64,
    /// What was rolled.
    pub rolled_rad: f64,
    /// By how much Newton's second law is missed for the wire outside the guide as a whole, in N: what the brake took, and
    /// what was not settled.
    pub residual_n: f64,
    /// What it took to hold the wire at the guide against its way in, in N: positive when it pushes back.
    pub push_n: f64,
    /// What it took about that way, in N mm: positive when it turns back.
    pub torque_n_mm: f64,
}

/// Numbers of steps, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StepCounts {
    /// In balance.
    pub balanced: u64,
    /// Braked.
    pub braked: u64,
    /// Braked, with the guide waiting.
    pub waited: u64,
    /// Without a way.
    pub held: u64,
}

impl StepCounts {
    /// Counts one more.
    pub fn count(&mut self, kind: StepKind) {
        *match kind {
            StepKind::Balanced => &mut self.balanced,
            StepKind::Braked => &mut self.braked,
            StepKind::Waited => &mut self.waited,
            StepKind::Held => &mut self.held,
        } += 1;
    }

    /// All of them.
    pub fn all(&self) -> u64 {
        self.balanced + self.braked + self.waited + self.held
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
    fn kinds_are_counted_apart() {
        let mut counts = StepCounts::default();
        assert_eq!(counts.unbalanced_share(), 0.0);
        let kinds = [StepKind::Balanced, StepKind::Braked, StepKind::Waited, StepKind::Held, StepKind::Held];
        kinds.into_iter().for_each(|kind| counts.count(kind));
        assert_eq!(counts, StepCounts { balanced: 1, braked: 1, waited: 1, held: 2 });
        assert_eq!((counts.all(), counts.unbalanced_share()), (5, 0.8));
        let before = counts;
        counts.count(StepKind::Waited);
        assert_eq!(counts.since(&before), StepCounts { waited: 1, ..StepCounts::default() });
    }
}
