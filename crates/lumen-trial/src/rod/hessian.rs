//! Which second derivatives of the energy a step is solved with.

/// What stands for the second derivatives of the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hessian {
    /// Squares of first derivatives, and what tension adds: always positive definite.
    Safe,
    /// The same, and what pressure takes away: nearer to the truth, and not positive definite beyond the load at which
    /// the rod buckles.
    Pressed,
    /// All of them.
    Exact,
}

impl Hessian {
    /// The one to be tried when this one is not positive definite.
    #[must_use]
    pub fn safer(self) -> Self {
        if self == Self::Exact { Self::Pressed } else { Self::Safe }
    }
}
