//! Which vertex goes next: rounds of a threshold that grows, after Schroeder, Zarge and Lorensen (1992).

use super::rings::gather;

/// By what the threshold grows from round to round.
const GROWTH: f32 = 1.1;

/// Up to so many vertices a round are taken by their distances, the smallest first.
const FEW: usize = 4096;

/// Of so many slots one is left when those that are gone are dropped.
const SPARSE: usize = 3;

/// Keys that are passed over at once where none is small enough.
const BLOCK: usize = 32;

/// Why a vertex could not go when it was last tried.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Stuck {
    /// The link condition.
    Topology,
    /// Something would fold, become a sliver or cross.
    Geometry,
    /// It stays where it is.
    Complex,
}

/// What the run knows of a slot.
#[derive(Clone, Copy, Default)]
pub(super) struct State {
    /// Whether its surroundings changed since it was judged.
    pub(super) is_stale: bool,
    /// The index into [`STRICTNESS`](super::collapse::STRICTNESS) that it is held to.
    pub(super) strictness: u8,
    /// Tried and refused; comes back when its surroundings change.
    pub(super) stuck: Option<Stuck>,
}

/// The order in which slots are looked at.
#[derive(Default)]
pub(super) struct Schedule {
    /// The threshold at which each slot is looked at again; infinite for those that are gone or stuck.
    pub(super) keys: Vec<f32>,
    pub(super) states: Vec<State>,
    /// The slots of the round, and the next one.
    round: Vec<u32>,
    next: usize,
    /// The bits of each slot's key, then the slot.
    sorted: Vec<u64>,
    pub(super) threshold: f32,
    /// Slots that are left.
    pub(super) alive: usize,
}

impl Schedule {
    /// Of so many slots, none of which has a key yet.
    pub(super) fn new(slots: usize) -> Self {
        let (keys, states) = (vec![f32::INFINITY; slots], vec![State::default(); slots]);
        Self { keys, states, alive: slots, ..Self::default() }
    }

    /// The next slot of the round.
    pub(super) fn pop(&mut self) -> Option<u32> {
        let v = self.round.get(self.next).copied();
        self.next += usize::from(v.is_some());
        v
    }

    /// `v` cannot go until its surroundings change.
    pub(super) fn set_stuck(&mut self, v: u32, stuck: Stuck) {
        self.states[v as usize].stuck = Some(stuck);
        self.keys[v as usize] = f32::INFINITY;
    }

    /// The surroundings of `v` have changed.
    pub(super) fn set_stale(&mut self, v: u32) {
        let state = &mut self.states[v as usize];
        state.is_stale = true;
        if state.stuck.take().is_some() {
            self.keys[v as usize] = 0.0;
        }
    }

    /// `v` is gone.
    pub(super) fn remove(&mut self, v: u32) {
        self.keys[v as usize] = f32::INFINITY;
        self.alive -= 1;
    }

    /// Whether so few are left that the slots of those that are gone should be dropped.
    pub(super) fn is_sparse(&self) -> bool {
        self.alive * SPARSE < self.keys.len()
    }

    /// Only the slots in `kept` are left, renumbered in this order.
    pub(super) fn compact(&mut self, kept: &[u32]) {
        self.keys = gather(&self.keys, kept);
        self.states = gather(&self.states, kept);
    }

    /// The slots of the next round. Returns false when there is none.
    pub(super) fn next_round(&mut self) -> bool {
        self.round.clear();
        self.next = 0;
        let mut least = f32::INFINITY;
        let smaller = |a: f32, b: f32| if b < a { b } else { a };
        for (block, keys) in self.keys.chunks(BLOCK).enumerate() {
            let smallest = keys.iter().fold(f32::INFINITY, |smallest, &key| smaller(smallest, key));
            if smallest > self.threshold {
                least = smaller(least, smallest);
                continue;
            }
            for (i, &key) in keys.iter().enumerate() {
                if key <= self.threshold {
                    self.round.push((block * BLOCK + i) as u32);
                } else {
                    least = smaller(least, key);
                }
            }
        }
        if self.round.is_empty() {
            self.raise(least);
            return least < f32::INFINITY;
        }
        if self.round.len() <= FEW {
            // By key, then by slot: the bits of keys that are not negative are in their order.
            let bits = |slot: u32| u64::from(self.keys[slot as usize].max(0.0).to_bits());
            self.sorted.clear();
            self.sorted.extend(self.round.iter().map(|&slot| bits(slot) << 32 | u64::from(slot)));
            self.sorted.sort_unstable();
            self.round.clear();
            self.round.extend(self.sorted.iter().map(|&keyed| keyed as u32));
        }
        self.raise(0.0);
        true
    }

    /// Raises the threshold, to beyond `least` at least. It stays finite over any number of rounds: the key of what is stuck is
    /// infinite, and would be in every round.
    fn raise(&mut self, least: f32) {
        self.threshold = (self.threshold.max(least) * GROWTH).min(f32::MAX);
    }
}
