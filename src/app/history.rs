//! Undo and redo.

use serde::{Deserialize, Serialize};

/// Values in the order in which they were left, and a way back and forth. A drag is one step: values are recorded
/// when the hand comes off.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct History<T> {
    undo: Vec<T>,
    redo: Vec<T>,
    /// The value that stands.
    present: T,
}

/// Steps that are remembered.
const DEPTH: usize = 200;

impl<T: Clone + PartialEq> History<T> {
    /// A history that begins with `present`.
    pub fn new(present: T) -> Self {
        Self { undo: Vec::new(), redo: Vec::new(), present }
    }

    /// Makes `value` the present one; the one before can be had back. Nothing happens where they are the same.
    pub fn record(&mut self, value: &T) {
        if *value != self.present {
            self.undo.push(std::mem::replace(&mut self.present, value.clone()));
            self.redo.clear();
            if self.undo.len() > DEPTH {
                self.undo.remove(0);
            }
        }
    }

    /// Puts `value` in place of the present one, without a step.
    pub fn replace(&mut self, value: &T) {
        self.present = value.clone();
    }

    /// Changes every value alike; steps that lead nowhere then are left out.
    pub fn change_all(&mut self, change: impl Fn(&mut T)) {
        change(&mut self.present);
        for steps in [&mut self.undo, &mut self.redo] {
            steps.iter_mut().for_each(&change);
            steps.dedup();
            steps.pop_if(|next| *next == self.present);
        }
    }

    /// Goes one step back: the value that stands then.
    pub fn undo(&mut self) -> Option<&T> {
        let before = self.undo.pop()?;
        self.redo.push(std::mem::replace(&mut self.present, before));
        Some(&self.present)
    }

    /// Takes one step back again: the value that stands then.
    pub fn redo(&mut self) -> Option<&T> {
        let after = self.redo.pop()?;
        self.undo.push(std::mem::replace(&mut self.present, after));
        Some(&self.present)
    }

    /// The same of other values, made of these.
    #[must_use]
    pub fn map<U>(&self, of: impl Fn(&T) -> U) -> History<U> {
        let all = |values: &[T]| values.iter().map(&of).collect();
        History { undo: all(&self.undo), redo: all(&self.redo), present: of(&self.present) }
    }

    /// The value that stands.
    pub fn present(&self) -> &T {
        &self.present
    }

    /// Every value, in no order.
    pub fn all(&self) -> impl Iterator<Item = &T> {
        self.undo.iter().chain(&self.redo).chain([&self.present])
    }

    /// The same with no more than the last `steps` of each way.
    #[must_use]
    pub fn recent(&self, steps: usize) -> Self {
        let last = |of: &[T]| of[of.len().saturating_sub(steps)..].to_vec();
        Self { undo: last(&self.undo), redo: last(&self.redo), present: self.present.clone() }
    }

    /// Whether there is a step to undo.
    pub fn can_undo(&self) -> bool {
        !self.undo.is_empty()
    }

    /// Whether there is a step to redo.
    pub fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_go_back_and_forth_and_a_new_value_ends_the_future() {
        let mut history = History::new(1);
        history.record(&1);
        assert!(!history.can_undo());
        history.record(&2);
        history.record(&3);
        assert_eq!(
            (history.undo().copied(), history.undo().copied(), history.undo().copied()),
            (Some(2), Some(1), None)
        );
        assert_eq!(history.redo().copied(), Some(2));
        history.record(&9);
        assert!(!history.can_redo());
        assert_eq!(history.undo().copied(), Some(2));
    }
}
