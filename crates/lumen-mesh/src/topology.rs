//! Who touches whom: compressed-row adjacency of a triangle list, built once and shared by every stage.
//!
//! For each vertex: the triangles around it, its neighbours in ascending order, and for each neighbour how many
//! triangles use the edge in either direction. An edge is a boundary edge when one triangle uses it, and
//! non-manifold when more than two do. Triangles with a repeated vertex have no place here: drop them before.

/// How triangles use the edge from a vertex `v` to a neighbour `n`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EdgeUse {
    /// Triangles that run `v -> n` (saturating at 255).
    pub forward: u8,
    /// Triangles that run `n -> v` (saturating at 255).
    pub backward: u8,
}

impl EdgeUse {
    /// Number of triangles on the edge.
    pub fn triangles(self) -> u32 {
        u32::from(self.forward) + u32::from(self.backward)
    }

    /// One triangle only.
    pub fn is_boundary(self) -> bool {
        self.triangles() == 1
    }

    /// More than two triangles.
    pub fn is_non_manifold(self) -> bool {
        self.triangles() > 2
    }

    /// Two triangles whose windings disagree.
    pub fn is_flipped(self) -> bool {
        self.triangles() == 2 && self.forward != 1
    }
}

/// Edges of a surface by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EdgeCounts {
    /// All edges.
    pub edges: usize,
    /// Edges of one triangle.
    pub boundary: usize,
    /// Edges of more than two triangles.
    pub non_manifold: usize,
    /// Edges of two triangles whose windings disagree.
    pub flipped: usize,
}

/// Adjacency of a triangle list in compressed rows.
#[derive(Clone, Debug, Default)]
pub struct Topology {
    triangle_offsets: Vec<u32>,
    triangle_lists: Vec<u32>,
    neighbour_offsets: Vec<u32>,
    neighbour_lists: Vec<u32>,
    edge_uses: Vec<EdgeUse>,
}

impl Topology {
    /// Builds the adjacency of `triangles` over `vertex_count` vertices in linear time.
    ///
    /// # Panics
    /// When an index is not below `vertex_count`, or a triangle repeats a vertex (debug builds).
    pub fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut triangle_offsets = vec![0u32; vertex_count + 1];
        for &v in triangles.as_flattened() {
            triangle_offsets[v as usize + 1] += 1;
        }
        for v in 0..vertex_count {
            triangle_offsets[v + 1] += triangle_offsets[v];
        }
        let mut cursor = triangle_offsets.clone();
        let mut triangle_lists = vec![0u32; triangles.len() * 3];
        for (t, corners) in triangles.iter().enumerate() {
            debug_assert!(corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]);
            for &v in corners {
                triangle_lists[cursor[v as usize] as usize] = t as u32;
                cursor[v as usize] += 1;
            }
        }
        let mut neighbour_offsets = Vec::with_capacity(vertex_count + 1);
        let mut neighbour_lists = Vec::with_capacity(triangles.len() * 3 + triangles.len() / 8);
        let mut edge_uses = Vec::with_capacity(neighbour_lists.capacity());
        let mut ring: Vec<(u32, EdgeUse)> = Vec::new();
        neighbour_offsets.push(0);
        for v in 0..vertex_count {
            let around = &triangle_lists[triangle_offsets[v] as usize..triangle_offsets[v + 1] as usize];
            if let Some(neighbours) = interior_ring(triangles, around, v as u32) {
                neighbour_lists.extend_from_slice(&neighbours[..around.len()]);
                edge_uses.extend_from_slice(&[EdgeUse { forward: 1, backward: 1 }; SMALL_RING][..around.len()]);
            } else {
                ring.clear();
                for &t in around {
                    let [next, last] = opposite(triangles[t as usize], v as u32);
                    ring.push((next, EdgeUse { forward: 1, backward: 0 }));
                    ring.push((last, EdgeUse { forward: 0, backward: 1 }));
                }
                ring.sort_unstable_by_key(|entry| entry.0);
                add_ring(&ring, &mut neighbour_lists, &mut edge_uses);
            }
            neighbour_offsets.push(neighbour_lists.len() as u32);
        }
        Self { triangle_offsets, triangle_lists, neighbour_offsets, neighbour_lists, edge_uses }
    }

    /// Number of vertices, used or not.
    pub fn vertex_count(&self) -> usize {
        self.triangle_offsets.len().saturating_sub(1)
    }

    /// Triangles around vertex `v`, ascending.
    pub fn triangles(&self, v: u32) -> &[u32] {
        row(&self.triangle_offsets, &self.triangle_lists, v)
    }

    /// The triangles on the edge between two vertices, of `triangles` that this was made of. Looks around the end with fewer of
    /// them, so that the hub of a large fan costs no more than its rim.
    pub fn triangles_on<'a>(&'a self, triangles: &'a [[u32; 3]], a: u32, b: u32) -> impl Iterator<Item = u32> + 'a {
        let (hub, end) = if self.triangles(a).len() <= self.triangles(b).len() { (a, b) } else { (b, a) };
        self.triangles(hub).iter().copied().filter(move |&t| triangles[t as usize].contains(&end))
    }

    /// Vertices that share an edge with `v`, ascending.
    pub fn neighbours(&self, v: u32) -> &[u32] {
        row(&self.neighbour_offsets, &self.neighbour_lists, v)
    }

    /// How the edge to each of [`Self::neighbours`] is used, in the same order.
    pub fn edge_uses(&self, v: u32) -> &[EdgeUse] {
        row(&self.neighbour_offsets, &self.edge_uses, v)
    }

    /// The use of the edge `a -> b`, or `None` where there is no such edge.
    pub fn edge(&self, a: u32, b: u32) -> Option<EdgeUse> {
        let i = self.neighbours(a).binary_search(&b).ok()?;
        Some(self.edge_uses(a)[i])
    }

    /// Row starts into [`Self::neighbour_lists`]; one more than there are vertices.
    pub fn neighbour_offsets(&self) -> &[u32] {
        &self.neighbour_offsets
    }

    /// All neighbour rows, one after another.
    pub fn neighbour_lists(&self) -> &[u32] {
        &self.neighbour_lists
    }

    /// Every edge once, as `(a, b, use)` with `a < b`, ascending.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32, EdgeUse)> + '_ {
        (0..self.vertex_count() as u32).flat_map(move |a| {
            let row = self.neighbours(a).iter().zip(self.edge_uses(a));
            row.filter(move |(b, _)| a < **b).map(move |(&b, &edge)| (a, b, edge))
        })
    }

    /// Whether the two triangles of every edge that has two wind the same way.
    pub fn is_consistent(&self) -> bool {
        !self.edge_uses.iter().any(|edge| edge.is_flipped())
    }

    /// Edges by kind.
    pub fn edge_counts(&self) -> EdgeCounts {
        let mut counts = EdgeCounts::default();
        for (_, _, edge) in self.edges() {
            counts.edges += 1;
            counts.boundary += usize::from(edge.is_boundary());
            counts.non_manifold += usize::from(edge.is_non_manifold());
            counts.flipped += usize::from(edge.is_flipped());
        }
        counts
    }

    /// Checks every promise of the structure against `triangles`; for tests.
    ///
    /// # Panics
    /// When a promise is broken.
    pub fn assert_well_formed(&self, triangles: &[[u32; 3]]) {
        assert_eq!(self.triangle_lists.len(), triangles.len() * 3);
        for v in 0..self.vertex_count() as u32 {
            assert!(self.triangles(v).iter().all(|&t| triangles[t as usize].contains(&v)));
            assert!(self.neighbours(v).is_sorted_by(|a, b| a < b), "neighbours of {v} ascend without repetition");
            for (&n, edge) in self.neighbours(v).iter().zip(self.edge_uses(v)) {
                let twin = self.edge(n, v).expect("the neighbour relation is symmetric");
                assert_eq!((twin.forward, twin.backward), (edge.backward, edge.forward));
                let users = self.triangles(v).iter().filter(|&&t| triangles[t as usize].contains(&n)).count();
                assert_eq!(users as u32, edge.triangles());
            }
        }
    }
}

fn row<'a, T>(offsets: &[u32], lists: &'a [T], v: u32) -> &'a [T] {
    &lists[offsets[v as usize] as usize..offsets[v as usize + 1] as usize]
}

/// The most triangles around a vertex for which [`interior_ring`] looks.
const SMALL_RING: usize = 12;

/// The neighbours of `v`, ascending, where each of its edges is used once in either direction, as nearly everywhere;
/// `None` where one is not, or where there are more triangles than [`SMALL_RING`].
fn interior_ring(triangles: &[[u32; 3]], around: &[u32], v: u32) -> Option<[u32; SMALL_RING]> {
    let count = around.len();
    if count > SMALL_RING {
        return None;
    }
    let (mut nexts, mut lasts) = ([0; SMALL_RING], [0; SMALL_RING]);
    for (i, &t) in around.iter().enumerate() {
        let [next, last] = opposite(triangles[t as usize], v);
        insert(&mut nexts, i, next);
        insert(&mut lasts, i, last);
    }
    (nexts == lasts && nexts[..count].is_sorted_by(|a, b| a < b)).then_some(nexts)
}

/// Puts `value` into its place among the first `count`, which ascend.
fn insert(values: &mut [u32; SMALL_RING], count: usize, value: u32) {
    let mut place = count;
    while place > 0 && values[place - 1] > value {
        values[place] = values[place - 1];
        place -= 1;
    }
    values[place] = value;
}

/// Adds a vertex's neighbours, which ascend, with the uses of each edge summed.
fn add_ring(ring: &[(u32, EdgeUse)], neighbour_lists: &mut Vec<u32>, edge_uses: &mut Vec<EdgeUse>) {
    let start = neighbour_lists.len();
    for &(n, edge) in ring {
        if neighbour_lists.len() > start && neighbour_lists[neighbour_lists.len() - 1] == n {
            let sum: &mut EdgeUse = edge_uses.last_mut().expect("one entry per neighbour");
            sum.forward = sum.forward.saturating_add(edge.forward);
            sum.backward = sum.backward.saturating_add(edge.backward);
        } else {
            neighbour_lists.push(n);
            edge_uses.push(edge);
        }
    }
}

/// The other two corners of a triangle, in its winding, after corner `v`.
#[inline]
pub fn opposite(triangle: [u32; 3], v: u32) -> [u32; 2] {
    let [a, b, c] = triangle;
    if a == v {
        [b, c]
    } else if b == v {
        [c, a]
    } else {
        [a, b]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_is_closed_and_consistent() {
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let topology = Topology::new(4, &triangles);
        topology.assert_well_formed(&triangles);
        assert_eq!(topology.edge_counts(), EdgeCounts { edges: 6, boundary: 0, non_manifold: 0, flipped: 0 });
    }

    #[test]
    fn fans_of_every_size_have_their_whole_ring() {
        for sides in 2..40u32 {
            // Around the last vertex, in an order that is none.
            let triangle = |i: u32| [sides, i * 7 % sides, (i * 7 % sides + 1) % sides];
            let fan: Vec<[u32; 3]> = (0..sides).map(triangle).collect();
            for open in [false, true] {
                let triangles = &fan[usize::from(open)..];
                let topology = Topology::new(sides as usize + 1, triangles);
                topology.assert_well_formed(triangles);
            }
        }
    }

    #[test]
    fn an_edge_that_is_used_twice_in_either_direction_is_no_interior_edge() {
        // Two closed fans around vertex 0 that share the edge to vertex 1.
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [0, 1, 4], [0, 4, 5], [0, 5, 1]];
        let topology = Topology::new(6, &triangles);
        topology.assert_well_formed(&triangles);
        assert_eq!(topology.edge(0, 1), Some(EdgeUse { forward: 2, backward: 2 }));
    }

    #[test]
    fn three_triangles_on_one_edge_are_non_manifold() {
        let triangles = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
        let topology = Topology::new(6, &triangles);
        topology.assert_well_formed(&triangles);
        assert_eq!(topology.edge_counts(), EdgeCounts { edges: 7, boundary: 6, non_manifold: 1, flipped: 0 });
        assert!(topology.neighbours(5).is_empty());
    }

    #[test]
    fn two_triangles_that_run_an_edge_the_same_way_are_flipped() {
        let topology = Topology::new(4, &[[0, 1, 2], [0, 1, 3]]);
        assert_eq!(topology.edge_counts().flipped, 1);
    }
}
