//! Which edges of a rod may come to touch each other: a neighbour list with a skin (Verlet 1967), behind two tests that cost
//! next to nothing for a wire that does not come near itself.
//!
//! A piece of the rod that turns by an angle T in all, less than half a turn, has its ends at least `l cos(T / 2)` apart,
//! where l is its length (Schwarz's inequality on its tangents; Schur 1921). So edges with less than [`TURN`] between them
//! cannot touch, and most wires have no others. Of the others, whole blocks of edges are told apart by balls around them.
//! What was listed stands until motion, or turning, may have used up what was left.

use glam::DVec3;

use crate::rod::Rod;

/// Edges with a shorter piece of the rod between them, in diameters, are neighbours: it is curvature that brings them near.
const NEIGHBOURS: f64 = 3.0;
/// Edges are listed from this turn between them on, in radians.
const TURN: f64 = 1.6;
/// The change of a turn, counted from the tip, after which edges are listed anew. Between two edges it counts twice: with 2.2
/// radians between them, ends 3 diameters of arc apart are 1.36 apart, which is more than what touches.
const DRIFT: f64 = 0.3;
/// Edges are listed while the rod's surfaces are nearer than this beyond reach, in diameters.
const SKIN: f64 = 2.0;
/// Edges in a block.
const BLOCK: usize = 8;

/// The edges of a rod that are listed, until they have to be listed anew.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidates {
    /// Two edges, the one nearer to the tip first.
    pub(super) edges: Vec<[usize; 2]>,
    /// A node and an edge, in order. Of nodes that are nearer to each other than a radius only some are listed: each costs a
    /// solution of the band matrix, and a wire does not bend in between.
    pub(super) nodes: Vec<[usize; 2]>,
    /// By how much the edges that are not listed were out of reach at least, in mm.
    slack: f64,
    /// Where the nodes were, and how far the rod had turned from the tip up to each edge.
    from: Vec<DVec3>,
    turned: Vec<f64>,
    /// The same now.
    turns: Vec<f64>,
    /// From the tip to each node along the rod, in mm.
    arcs: Vec<f64>,
    /// Centre and radius of a ball around each block of edges.
    balls: Vec<(DVec3, f64)>,
}

impl Candidates {
    /// Sees to it that all edges between the first `count` nodes are listed whose middle lines are within `reach` mm, for
    /// a rod of this diameter. `is_new` in the first call of a step. Returns by how much all others are out of reach at
    /// least, in mm.
    pub(super) fn update(&mut self, rod: &Rod, count: usize, reach: f64, diameter: f64, is_new: bool) -> f64 {
        if is_new || self.turns.len() + 1 != count {
            self.turns.clear();
            let mut turn = 0.0;
            self.turns.extend((0..count.saturating_sub(1)).map(|edge| {
                turn += rod.turn(edge);
                turn
            }));
            if turn < TURN {
                self.clear();
                return f64::INFINITY;
            }
        } else if self.from.is_empty() {
            return f64::INFINITY;
        }
        let left = if self.from.len() == count { self.slack - 2.0 * self.moved(rod) } else { 0.0 };
        if left > 0.0 && !(is_new && self.has_turned()) {
            return left;
        }
        self.list(rod, count, reach, diameter);
        self.slack
    }

    fn clear(&mut self) {
        self.edges.clear();
        self.nodes.clear();
        self.from.clear();
    }

    /// How far a node has moved since, at most.
    fn moved(&self, rod: &Rod) -> f64 {
        let squared = rod.positions.iter().zip(&self.from).map(|(a, b)| a.distance_squared(*b));
        squared.fold(0.0, f64::max).sqrt()
    }

    fn has_turned(&self) -> bool {
        self.turns.iter().zip(&self.turned).any(|(now, then)| (now - then).abs() > DRIFT)
    }

    /// Lists all edges anew.
    fn list(&mut self, rod: &Rod, count: usize, reach: f64, diameter: f64) {
        self.clear();
        self.slack = f64::INFINITY;
        self.from.extend_from_slice(&rod.positions[..count]);
        self.turned.clone_from(&self.turns);
        self.arcs.clear();
        let mut arc = 0.0;
        self.arcs.extend(rod.sections[..count].iter().map(|section| {
            let here = arc;
            arc += section.length;
            here
        }));
        let edges = count - 1;
        let blocks = edges.div_ceil(BLOCK);
        let block = |i: usize| i * BLOCK..((i + 1) * BLOCK).min(edges);
        self.balls.clear();
        self.balls.extend((0..blocks).map(|i| {
            let nodes = &self.from[block(i).start..=block(i).end];
            let centre = nodes[0].midpoint(nodes[nodes.len() - 1]);
            (centre, nodes.iter().map(|p| p.distance_squared(centre)).fold(0.0, f64::max).sqrt())
        }));
        for i in 0..blocks {
            for j in i..blocks {
                if self.turned[block(j).end - 1] - self.turned[block(i).start] < TURN {
                    continue;
                }
                let ((a, radius_a), (b, radius_b)) = (self.balls[i], self.balls[j]);
                let left = a.distance(b) - radius_a - radius_b - reach;
                if left > SKIN * diameter {
                    self.slack = self.slack.min(left);
                    continue;
                }
                for first in block(i) {
                    let begin = block(j).start.max(first + 2);
                    (begin..block(j).end).for_each(|second| self.consider([first, second], reach, diameter));
                }
            }
        }
        self.nodes.sort_unstable();
        self.nodes.dedup();
    }

    /// Lists two edges if they are near and no neighbours.
    fn consider(&mut self, [i, j]: [usize; 2], reach: f64, diameter: f64) {
        let is_neighbour = self.arcs[j] - self.arcs[i + 1] < NEIGHBOURS * diameter;
        if is_neighbour || self.turned[j] - self.turned[i] < TURN {
            return;
        }
        let [[a, b], [c, d]] = [i, j].map(|edge| [self.from[edge], self.from[edge + 1]]);
        let left = a.midpoint(b).distance(c.midpoint(d)) - 0.5 * (a.distance(b) + c.distance(d)) - reach;
        if left > SKIN * diameter {
            self.slack = self.slack.min(left);
            return;
        }
        self.edges.push([i, j]);
        let has_edge_between = |[node, edge]: &[usize; 2]| *edge > node + 1 || edge + 2 < *node;
        let number = |node: usize| (2.0 * self.arcs[node] / diameter).floor();
        let is_first = |node: usize| node == 0 || number(node) > number(node - 1);
        let is_listed = |pair: &&[usize; 2]| has_edge_between(pair) && is_first(pair[0]);
        self.nodes.extend([[i, j], [i + 1, j], [j, i], [j + 1, i]].iter().filter(is_listed));
    }
}
