//! The branches of a hierarchy of boxes: its subtrees of few triangles, which lie close together.

use std::ops::Range;

use super::nearest::SurfaceIndex;

/// The branches of an index, and which slots each of its nodes has.
#[derive(Debug, Default)]
pub(super) struct Branches {
    /// The largest subtrees that have no more slots than were asked for, in the order of these.
    all: Vec<Branch>,
    /// The slots below each node.
    slots: Vec<Range<u32>>,
}

/// A subtree.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    /// Its node; `None` for a leaf.
    pub(super) node: Option<u32>,
    /// The slots that it has.
    pub(super) slots: Range<u32>,
}

impl Branches {
    /// Those of up to `most` slots, and leaves of more where there are any.
    pub(super) fn of(index: &SurfaceIndex, most: usize) -> Self {
        let mut slots = vec![0..0; index.nodes.len()];
        // A node stands behind its parent, and what is below it in one row.
        for n in (0..index.nodes.len()).rev() {
            let below = below(index, &slots, n as u32).map(|branch| branch.slots);
            slots[n] = below.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)).unwrap_or(0..0);
        }
        let mut branches = Self { all: Vec::new(), slots };
        let root = branches.slots.first().map(|slots| Branch { node: Some(0), slots: slots.clone() });
        let mut open: Vec<Branch> = root.into_iter().collect();
        while let Some(branch) = open.pop() {
            match branch.node {
                Some(node) if branch.slots.len() > most => open.extend(branches.below(index, node)),
                _ => branches.all.push(branch),
            }
        }
        branches.all.sort_by_key(|branch| branch.slots.start);
        branches
    }

    /// The branches that have some of these slots, and which.
    pub(super) fn within(&self, slots: Range<usize>) -> impl Iterator<Item = (&Branch, Range<u32>)> {
        let (start, end) = (slots.start as u32, slots.end as u32);
        let first = self.all.partition_point(|branch| branch.slots.end <= start);
        let within = self.all[first..].iter().take_while(move |branch| branch.slots.start < end);
        within.map(move |branch| (branch, branch.slots.start.max(start)..branch.slots.end.min(end)))
    }

    /// The parts of a node.
    pub(super) fn below(&self, index: &SurfaceIndex, node: u32) -> impl Iterator<Item = Branch> {
        below(index, &self.slots, node)
    }
}

/// The parts of a node, where `slots` are known of those behind it.
fn below(index: &SurfaceIndex, slots: &[Range<u32>], node: u32) -> impl Iterator<Item = Branch> {
    let node = &index.nodes[node as usize];
    (0..usize::from(node.used)).map(move |lane| match (node.child[lane], u32::from(node.count[lane])) {
        (child, 0) => Branch { node: Some(child), slots: slots[child as usize].clone() },
        (first, count) => Branch { node: None, slots: first..first + count },
    })
}
