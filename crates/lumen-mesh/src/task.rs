//! Long work in slices: so that whoever runs it can hear a cancel, and draw, in between.

use std::time::Duration;

use web_time::Instant;

/// A length of time that a slice may take, from its making on.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    end: Option<Instant>,
}

impl Budget {
    /// A slice of `duration`, from now on.
    pub fn new(duration: Duration) -> Self {
        Self { end: Some(Instant::now() + duration) }
    }

    /// No limit: the work runs to its end.
    pub const UNLIMITED: Self = Self { end: None };

    /// Whether the time is used up. Reads the clock: ask every few thousand operations.
    pub fn is_spent(&self) -> bool {
        self.end.is_some_and(|end| Instant::now() >= end)
    }
}

/// How far a task is.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress<T> {
    /// Not done: the fraction that is, 0 to 1.
    Working(f32),
    /// Done, with this result. The task must not be advanced again.
    Done(T),
}

/// Work that is done in slices.
pub trait Task {
    /// What comes out.
    type Output;

    /// Works until `budget` is spent or the work is done. Each call makes progress, however small the budget.
    fn advance(&mut self, budget: Budget) -> Progress<Self::Output>;

    /// Works to the end.
    fn finish(mut self) -> Self::Output
    where
        Self: Sized,
    {
        loop {
            if let Progress::Done(output) = self.advance(Budget::UNLIMITED) {
                return output;
            }
        }
    }
}

/// Milliseconds since `start`.
pub fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
