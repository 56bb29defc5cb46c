//! For each leaf the leaves that a collapse in it has to ask.
//!
//! A leaf with very many of them (a tangle, in which everything is near everything) is crowded: it has no list, and asks
//! the tree each time. So the lists of a surface have no more than some hundreds of bytes a slot, whatever it is.

/// Most pairs of a leaf that is not crowded: of those found at first, and of those found later.
pub(super) const MAX_PAIRS: usize = 256;

/// End of a list.
const NONE: u32 = u32::MAX;

/// The lists of pairs.
#[derive(Default)]
pub(super) struct Pairs {
    /// The pairs found at first: those of a leaf are `others[offsets[leaf]..offsets[leaf + 1]]`.
    offsets: Vec<u32>,
    others: Vec<u32>,
    /// For each leaf the first of its later pairs in `later`: the other leaf, and where the next one stands.
    first: Vec<u32>,
    later: Vec<[u32; 2]>,
    /// How many later pairs each leaf has.
    counts: Vec<u16>,
    crowded: Vec<bool>,
}

impl Pairs {
    /// How many leaves have their first pairs.
    pub(super) fn len(&self) -> usize {
        self.first.len()
    }

    /// Adds the first pairs of the next leaf: all that there are, or more than [`MAX_PAIRS`].
    pub(super) fn add_leaf(&mut self, others: &[u32]) {
        let is_crowded = others.len() > MAX_PAIRS;
        if self.offsets.is_empty() {
            self.offsets.push(0);
        }
        if !is_crowded {
            self.others.extend_from_slice(others);
        }
        self.offsets.push(self.others.len() as u32);
        self.first.push(NONE);
        self.counts.push(0);
        self.crowded.push(is_crowded);
    }

    /// Adds `other` to the later pairs of `leaf`, which does not have it yet.
    pub(super) fn add(&mut self, leaf: u32, other: u32) {
        let i = leaf as usize;
        if self.crowded[i] {
            return;
        }
        if usize::from(self.counts[i]) == MAX_PAIRS {
            self.crowded[i] = true;
            return;
        }
        self.counts[i] += 1;
        self.later.push([other, self.first[i]]);
        self.first[i] = self.later.len() as u32 - 1;
    }

    /// Whether `leaf` has too many pairs to list.
    pub(super) fn is_crowded(&self, leaf: u32) -> bool {
        self.crowded[leaf as usize]
    }

    /// Whether `leaf`, if it has a list, has `other` in it.
    pub(super) fn knows(&self, leaf: u32, other: u32) -> bool {
        self.is_crowded(leaf) || self.of(leaf).any(|known| known == other)
    }

    /// The pairs of a leaf that is not crowded.
    pub(super) fn of(&self, leaf: u32) -> impl Iterator<Item = u32> + '_ {
        let known = self.offsets[leaf as usize] as usize..self.offsets[leaf as usize + 1] as usize;
        let mut next = self.first[leaf as usize];
        let later = std::iter::from_fn(move || {
            let &[other, after] = self.later.get(next as usize)?;
            next = after;
            Some(other)
        });
        self.others[known].iter().copied().chain(later)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(pairs: &Pairs, leaf: u32) -> Vec<u32> {
        let mut found: Vec<u32> = pairs.of(leaf).collect();
        found.sort_unstable();
        found
    }

    #[test]
    fn each_leaf_has_what_was_found_at_first_and_later() {
        let mut pairs = Pairs::default();
        for others in [&[0, 2][..], &[], &[1]] {
            pairs.add_leaf(others);
        }
        for (leaf, other) in [(1, 0), (0, 1), (1, 2)] {
            pairs.add(leaf, other);
        }
        assert_eq!([0, 1, 2].map(|leaf| sorted(&pairs, leaf)), [vec![0, 1, 2], vec![0, 2], vec![1]]);
        assert_eq!(pairs.len(), 3);
    }

    #[test]
    fn a_leaf_with_more_pairs_than_fit_has_no_list_and_takes_no_room() {
        let mut pairs = Pairs::default();
        let many: Vec<u32> = (0..=MAX_PAIRS as u32).collect();
        pairs.add_leaf(&many);
        pairs.add_leaf(&many[1..]);
        pairs.add_leaf(&[]);
        assert_eq!([0, 1, 2].map(|leaf| pairs.is_crowded(leaf)), [true, false, false]);
        for _ in 0..10 {
            many.iter().for_each(|&other| pairs.add(0, other));
            many.iter().for_each(|&other| pairs.add(2, other));
        }
        assert!(pairs.is_crowded(2) && !pairs.is_crowded(1));
        assert_eq!((pairs.others.len(), pairs.later.len()), (MAX_PAIRS, MAX_PAIRS));
    }
}
