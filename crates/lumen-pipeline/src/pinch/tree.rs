//! Which samples are near a triangle: a tree of boxes around their balls.

use std::ops::Range;

use lumen_mesh::{Ball, Vec3};
use lumen_vessel::width::PINCHED;

/// Samples in a leaf of the tree.
const LEAF: usize = 4;

/// Boxes around the balls that no triangle may come into: a binary tree, its nodes in the order of their number, the
/// children of node `i` at `2 i + 1` and `2 i + 2`.
#[derive(Debug)]
pub(super) struct Tree {
    boxes: Vec<[Vec3; 2]>,
    /// Samples of the leaves, in order.
    order: Vec<u32>,
    /// Levels below the root.
    depth: u32,
    samples: Vec<[Vec3; 2]>,
}

impl Tree {
    pub(super) fn new(samples: &[Ball]) -> Self {
        let around = |sample: &Ball| {
            let reach = Vec3::splat(sample.radius * PINCHED * 1.0001);
            [sample.centre - reach, sample.centre + reach]
        };
        let depth = samples.len().div_ceil(LEAF).next_power_of_two().ilog2();
        let mut tree = Self {
            boxes: vec![[Vec3::INFINITY, Vec3::NEG_INFINITY]; (2 << depth) - 1],
            order: (0..samples.len() as u32).collect(),
            depth,
            samples: samples.iter().map(around).collect(),
        };
        for node in 0..tree.boxes.len() {
            let range = tree.range(node);
            let (all, own) = (&tree.samples, &mut tree.order[range]);
            let [low, high] = own
                .iter()
                .map(|&i| all[i as usize])
                .fold(tree.boxes[node], |[low, high], [l, h]| [low.min(l), high.max(h)]);
            tree.boxes[node] = [low, high];
            let size = high - low;
            let axis = if size.x >= size.y && size.x >= size.z { 0 } else { usize::from(size.z > size.y) + 1 };
            let middle = |i: u32| all[i as usize][0][axis] + all[i as usize][1][axis];
            own.sort_unstable_by(|&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
        }
        tree
    }

    /// The part of the order that a node has: each child a half.
    fn range(&self, node: usize) -> Range<usize> {
        let level = (node + 1).ilog2();
        let (place, parts, count) = (node + 1 - (1 << level), 1usize << level, self.order.len() as u64);
        let start = |place: usize| (place as u64 * count / parts as u64) as usize;
        start(place)..start(place + 1)
    }

    /// Adds to `near` the samples whose balls' boxes touch a box.
    pub(super) fn near(&self, low: Vec3, high: Vec3, near: &mut Vec<u32>) {
        let touches = |[min, max]: &[Vec3; 2]| (min.cmple(high) & max.cmpge(low)).all();
        let mut stack = [0u32; 64];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let node = stack[count] as usize;
            if !touches(&self.boxes[node]) {
                continue;
            }
            if (node + 1).ilog2() == self.depth {
                near.extend(self.order[self.range(node)].iter().filter(|&&i| touches(&self.samples[i as usize])));
            } else {
                (stack[count], stack[count + 1]) = (2 * node as u32 + 1, 2 * node as u32 + 2);
                count += 2;
            }
        }
    }
}
