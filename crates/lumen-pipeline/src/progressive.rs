//! The progressive mesh: every reduction rate of one decimation run at once.
//!
//! Hoppe, "Progressive meshes" (1996), kept as a merge forest (the vertex hierarchy of Xia and Varshney 1996): step
//! `s` of the run ends some nodes and some triangles. A half-edge collapse ends one node, whose parent is the
//! survivor; a method that places a new vertex ends two, whose parent is a new node. Nodes and triangles are stored
//! in the order in which they end, the last first, so that the level after `s` steps is
//!
//! - the triangles that end later: a prefix;
//! - with each corner replaced by its first ancestor that ends later, found for all nodes in one pass, because a
//!   parent ends later than its children and so stands before them.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::lines::Lines;
use super::settings::Target;
use lumen_mesh::{TriMesh, compacted};
use lumen_message::messages;

/// The step at which a node or triangle ends that is never removed.
pub const NEVER: u32 = u32::MAX;

/// In place of a vertex, for a node that was none.
pub const MADE: u32 = u32::MAX;

/// Every level of a surface between the one that entered decimation and the coarsest that was reached.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProgressiveMesh {
    /// Positions of all nodes in mm, by end, the last first.
    pub positions: Vec<Vec3>,
    /// The node that takes over when a node ends; itself where it never ends.
    pub parents: Vec<u32>,
    /// The step that ends each node, descending; [`NEVER`] first.
    pub node_ends: Vec<u32>,
    /// Corners of each triangle (nodes of the finest level), by end, the last first.
    pub triangles: Vec<[u32; 3]>,
    /// The step that ends each triangle, descending.
    pub triangle_ends: Vec<u32>,
    /// The error of each step in mm, as the method measures it, made non-decreasing.
    pub errors: Vec<f32>,
    /// The same as it was measured, which may fall from one step to the next.
    pub costs: Vec<f32>,
    /// Feature edges, boundary and complex vertices of the finest level.
    pub lines: Lines,
    /// Why the run ended where it did.
    pub limit: Limit,
}

/// One step of a run, as it is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Merge {
    /// The node that ends.
    pub gone: u32,
    /// The node that takes over, if none is made.
    pub kept: u32,
    /// The node that takes over from both.
    pub made: Option<u32>,
}

impl Merge {
    /// The nodes that end.
    fn ended(&self) -> [Option<u32>; 2] {
        [Some(self.gone), self.made.map(|_| self.kept)]
    }

    /// The node that takes over.
    fn heir(&self) -> u32 {
        self.made.unwrap_or(self.kept)
    }
}

/// The order of `count` nodes: those that never end, then the others by end, the last first.
fn order(count: usize, merges: &[Merge]) -> Vec<u32> {
    let ended = || merges.iter().flat_map(|merge| merge.ended().into_iter().flatten());
    let mut ends = vec![false; count];
    ended().for_each(|node| ends[node as usize] = true);
    let mut order: Vec<u32> = Vec::with_capacity(count);
    order.extend((0..count as u32).filter(|&node| !ends[node as usize]));
    let survivors = order.len();
    order.extend(ended());
    order[survivors..].reverse();
    order
}

/// The step that ends a triangle, the first after which two of its corners are one; `ends` has for each node the step
/// that ends it and the node that takes over.
fn end_of([mut a, mut b, mut c]: [u32; 3], ends: &[(u32, u32)]) -> u32 {
    loop {
        let [of_a, of_b, of_c] = [a, b, c].map(|node| ends[node as usize]);
        let first = of_a.0.min(of_b.0).min(of_c.0);
        if first == NEVER {
            return NEVER;
        }
        // Both nodes that a step ends go on at once.
        for (corner, (end, heir)) in [(&mut a, of_a), (&mut b, of_b), (&mut c, of_c)] {
            if end == first {
                *corner = heir;
            }
        }
        if a == b || b == c || c == a {
            return first;
        }
    }
}

/// Why a decimation run went no further.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Limit {
    /// Vertices that could go no further because the surface's topology would change (a tube pinched shut, an open
    /// end with three edges, two pieces joined).
    pub topology: u32,
    /// Vertices that could not go because a triangle would fold over or become a sliver.
    pub geometry: u32,
    /// Vertices that stay by rule: on non-manifold edges, or where several open ends meet.
    pub complex: u32,
}

/// Why a target was not met.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shortfall {
    /// Triangles asked for.
    pub wanted: u32,
    /// Triangles of the coarsest level there is.
    pub reached: u32,
    /// What stopped the run.
    pub limit: Limit,
}

messages! {
    /// A [`Shortfall`] in words, without a full stop.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum ShortfallMessage {
        /// The surface's topology stopped the run.
        "verdict-shortfall-topology" Topology {
            /// Triangles of the coarsest level there is.
            reached: u32,
            /// Triangles asked for.
            wanted: u32,
        } => "{reached} triangles is as far as this surface goes ({wanted} were asked for): removing more would close \
            an open end or pinch a vessel",
        /// Triangles would have folded over.
        "verdict-shortfall-geometry" Geometry {
            /// Triangles of the coarsest level there is.
            reached: u32,
            /// Triangles asked for.
            wanted: u32,
        } => "{reached} triangles is as far as this surface goes ({wanted} were asked for): removing more would fold \
            the surface over itself",
        /// What is left stays by rule.
        "verdict-shortfall-complex" Complex {
            /// Triangles of the coarsest level there is.
            reached: u32,
            /// Triangles asked for.
            wanted: u32,
        } => "{reached} triangles is as far as this surface goes ({wanted} were asked for): the rest lies on edges of \
            more than two triangles, which are kept as they are",
    }
}

impl Shortfall {
    /// In words: what of the limit weighs most.
    pub fn message(&self) -> ShortfallMessage {
        let Self { wanted, reached, limit: Limit { topology, geometry, complex } } = *self;
        match (topology >= geometry && topology >= complex, geometry >= complex) {
            (true, _) => ShortfallMessage::Topology { reached, wanted },
            (false, true) => ShortfallMessage::Geometry { reached, wanted },
            (false, false) => ShortfallMessage::Complex { reached, wanted },
        }
    }
}

impl std::fmt::Display for Shortfall {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.message().fmt(f)
    }
}

/// One level of a progressive mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Level {
    /// Steps taken from the finest level.
    pub steps: u32,
    /// Triangles over the nodes of the progressive mesh.
    pub triangles: Vec<[u32; 3]>,
    /// Why the level is finer than was asked for, if it is.
    pub shortfall: Option<Shortfall>,
}

impl ProgressiveMesh {
    /// Orders the outcome of a run on `mesh`: each step merges two nodes. Nodes are numbered from the vertices of `mesh`
    /// on, those at the positions `made` after them in the order in which they begin.
    ///
    /// # Panics
    /// When there are not as many errors as merges, or a node ends twice (debug builds).
    pub fn from_merges(mesh: &TriMesh, merges: &[Merge], made: &[Vec3], mut errors: Vec<f32>, limit: Limit) -> Self {
        assert_eq!(merges.len(), errors.len());
        let vertices = mesh.positions.len();
        let count = vertices + made.len();
        // For each node the step that ends it, and its parent.
        let mut ends: Vec<(u32, u32)> = vec![(NEVER, 0); count];
        for (step, merge) in merges.iter().enumerate() {
            for gone in merge.ended().into_iter().flatten() {
                debug_assert_eq!(ends[gone as usize].0, NEVER, "a node ends once");
                ends[gone as usize] = (step as u32, merge.heir());
            }
        }
        let order = order(count, merges);
        let mut node_of = vec![0; count];
        order.iter().enumerate().for_each(|(new, &old)| node_of[old as usize] = new as u32);
        let position = |node: u32| match (node as usize).checked_sub(vertices) {
            None => mesh.positions[node as usize],
            Some(made_as) => made[made_as],
        };
        let parent = |node: u32| match ends[node as usize] {
            (NEVER, _) => node_of[node as usize],
            (_, parent) => node_of[parent as usize],
        };
        let triangle_ends: Vec<u32> = mesh.triangles.iter().map(|&corners| end_of(corners, &ends)).collect();
        // A counting sort by end, the last first, keeps the order of triangles that end together.
        let slot = |end: u32| if end == NEVER { 0 } else { merges.len() - end as usize };
        let mut starts = vec![0u32; merges.len() + 2];
        triangle_ends.iter().for_each(|&end| starts[slot(end) + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut triangles = vec![[0; 3]; mesh.triangles.len()];
        let mut sorted_ends = vec![0; mesh.triangles.len()];
        for (corners, &end) in mesh.triangles.iter().zip(&triangle_ends) {
            let place = &mut starts[slot(end)];
            triangles[*place as usize] = corners.map(|v| node_of[v as usize]);
            sorted_ends[*place as usize] = end;
            *place += 1;
        }
        let costs = errors.clone();
        (1..errors.len()).for_each(|i| errors[i] = errors[i].max(errors[i - 1]));
        Self {
            positions: order.iter().map(|&node| position(node)).collect(),
            parents: order.iter().map(|&node| parent(node)).collect(),
            node_ends: order.iter().map(|&node| ends[node as usize].0).collect(),
            triangles,
            triangle_ends: sorted_ends,
            errors,
            costs,
            lines: Lines::default(),
            limit,
        }
    }

    /// The same with `lines` over the vertices of the mesh that entered, of which `vertices_of_nodes` says what each node
    /// was.
    #[must_use]
    pub fn with_lines(self, lines: &Lines, vertices_of_nodes: &[u32]) -> Self {
        let mut nodes = vec![0; vertices_of_nodes.len()];
        for (node, &vertex) in (0..).zip(vertices_of_nodes).filter(|(_, vertex)| **vertex != MADE) {
            nodes[vertex as usize] = node;
        }
        Self { lines: lines.mapped(|vertex| nodes[vertex as usize]), ..self }
    }

    /// For each node of what [`Self::from_merges`] makes of `vertices` vertices and `made` new ones, the vertex that it
    /// is; [`MADE`] where it is a new one.
    pub fn vertices_of_nodes(vertices: usize, made: usize, merges: &[Merge]) -> Vec<u32> {
        let mut order = order(vertices + made, merges);
        order.iter_mut().filter(|node| **node as usize >= vertices).for_each(|node| *node = MADE);
        order
    }

    /// Triangles of the level after `steps` steps.
    pub fn triangles_after(&self, steps: u32) -> usize {
        self.triangle_ends.partition_point(|&end| end >= steps)
    }

    /// The fewest steps after which there are at most `wanted` triangles; all steps if there are always more.
    pub fn steps_to(&self, wanted: usize) -> u32 {
        // The triangle at index `wanted` is the first that must be gone.
        match self.triangle_ends.get(wanted) {
            None => 0,
            Some(&NEVER) => self.errors.len() as u32,
            Some(&end) => end + 1,
        }
    }

    /// The level that meets `target`, or the coarsest there is together with why. For a bound on the deviation it is
    /// the one that the method's own errors point at, an estimate: `super::bound` finds the level.
    pub fn level(&self, target: Target) -> Level {
        if let Some(bound) = target.deviation_mm() {
            return self.level_after(self.errors.partition_point(|&error| f64::from(error) <= bound) as u32);
        }
        let wanted = target.triangles(self.triangles.len());
        let steps = self.steps_to(wanted);
        let triangles = self.triangles_at(steps);
        let reached = triangles.len();
        let shortfall = (reached > wanted).then_some(Shortfall {
            wanted: wanted as u32,
            reached: reached as u32,
            limit: self.limit,
        });
        Level { steps, triangles, shortfall }
    }

    /// The level after `steps` steps.
    pub fn level_after(&self, steps: u32) -> Level {
        Level { steps, triangles: self.triangles_at(steps), shortfall: None }
    }

    /// The triangles after `steps` steps, over the nodes. Linear in nodes and triangles of the level.
    pub fn triangles_at(&self, steps: u32) -> Vec<[u32; 3]> {
        let heir = self.heirs(steps);
        let level = &self.triangles[..self.triangles_after(steps)];
        level.iter().map(|corners| corners.map(|v| heir[v as usize])).collect()
    }

    /// For each node, the one that stands for it after `steps` steps: itself, or its first ancestor that ends later.
    pub fn heirs(&self, steps: u32) -> Vec<u32> {
        let alive = self.node_ends.partition_point(|&end| end >= steps) as u32;
        let mut heirs: Vec<u32> = Vec::with_capacity(self.parents.len());
        for (node, &parent) in (0..).zip(&self.parents) {
            heirs.push(if node < alive { node } else { heirs[parent as usize] });
        }
        heirs
    }

    /// The level without any step as a surface over the nodes: the one that entered, in another order.
    pub fn finest(&self) -> TriMesh {
        TriMesh { positions: self.positions.clone(), triangles: self.triangles.clone() }
    }

    /// A surface of its own of a level's triangles: nodes in use, in their order.
    pub fn extract(&self, triangles: &[[u32; 3]]) -> TriMesh {
        compacted(&self.positions, triangles.to_vec())
    }

    /// Checks every promise of the structure; for tests.
    ///
    /// # Panics
    /// When a promise is broken.
    pub fn assert_well_formed(&self) {
        let (nodes, steps) = (self.positions.len(), self.errors.len() as u32);
        assert_eq!((self.parents.len(), self.node_ends.len()), (nodes, nodes));
        assert_eq!(self.triangles.len(), self.triangle_ends.len());
        assert!(self.node_ends.is_sorted_by(|a, b| a >= b) && self.triangle_ends.is_sorted_by(|a, b| a >= b));
        assert_eq!(self.costs.len(), self.errors.len());
        assert!(self.errors.is_sorted() && self.errors.iter().all(|e| e.is_finite()));
        for (node, (&parent, &end)) in self.parents.iter().zip(&self.node_ends).enumerate() {
            assert!(if end == NEVER { parent as usize == node } else { (parent as usize) < node && end < steps });
        }
        assert!(self.triangle_ends.iter().all(|&end| end == NEVER || end < steps));
        assert!(self.triangles.as_flattened().iter().all(|&v| (v as usize) < nodes));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of four triangles around vertex 4; 4 goes to 0, then 1 goes to 0.
    fn fan() -> ProgressiveMesh {
        let positions = (0..5).map(|i| Vec3::splat(i as f32)).collect();
        let mesh = TriMesh { positions, triangles: vec![[4, 0, 1], [4, 1, 2], [4, 2, 3], [4, 3, 0]] };
        let merges = [[4, 0], [1, 0]].map(|[gone, kept]| Merge { gone, kept, made: None });
        ProgressiveMesh::from_merges(&mesh, &merges, &[], vec![0.5, 0.25], Limit::default())
    }

    #[test]
    fn levels_are_prefixes_with_ancestors() {
        let mesh = fan();
        mesh.assert_well_formed();
        assert_eq!(mesh.positions.iter().map(|p| p.x).collect::<Vec<_>>(), [0.0, 2.0, 3.0, 1.0, 4.0]);
        assert_eq!(mesh.triangles_at(0), [[4, 1, 2], [4, 3, 1], [4, 0, 3], [4, 2, 0]]);
        assert_eq!(mesh.triangles_at(1), [[0, 1, 2], [0, 3, 1]]);
        assert_eq!(mesh.triangles_at(2), [[0, 1, 2]]);
        assert_eq!(mesh.errors, [0.5, 0.5]);
        assert_eq!(mesh.extract(&mesh.triangles_at(2)).positions.len(), 3);
        let merges = [Merge { gone: 1, kept: 4, made: Some(5) }, Merge { gone: 0, kept: 5, made: None }];
        assert_eq!(ProgressiveMesh::vertices_of_nodes(5, 1, &merges), [2, 3, MADE, 0, 4, 1]);
    }

    #[test]
    fn targets_are_met_from_below_and_shortfalls_say_why() {
        let mesh = fan();
        assert_eq!([4, 3, 2, 1, 0].map(|n| mesh.level(Target::Triangles(n)).triangles.len()), [4, 2, 2, 1, 1]);
        assert_eq!(mesh.level(Target::Triangles(1)).shortfall, None);
        let shortfall = mesh.level(Target::Reduction(999)).shortfall.unwrap();
        assert_eq!((shortfall.wanted, shortfall.reached), (0, 1));
        assert_eq!(ProgressiveMesh::default().level(Target::Reduction(900)), Level::default());
    }
}
