//! The edges of a triangle list, each once: what a wireframe draws, rebuilt with every level of the progressive mesh.
//!
//! A counting sort puts each triangle's three edges into the bucket of their smaller vertex; a bucket holds the few
//! edges of one vertex, is sorted by insertion and loses its repetitions. Linear in the number of triangles for any
//! bounded valence, without hashing, and in one order: ascending, as `mesh::Topology::edges`.

/// Every edge of `triangles` once, as `[a, b]` with `a < b`, ascending. The sides of triangles with a repeated vertex
/// count as well, except the one that has no length.
///
/// # Panics
/// When an index is `node_count` or more.
pub fn unique_edges(triangles: &[[u32; 3]], node_count: usize) -> Vec<[u32; 2]> {
    // `ends[v]`: first the number of sides in v's bucket, then where the next one goes, at last where the bucket ends.
    let mut ends = vec![0_u32; node_count];
    for (low, _) in sides(triangles) {
        ends[low as usize] += 1;
    }
    let mut total = 0;
    for end in &mut ends {
        total += std::mem::replace(end, total);
    }
    let mut highs = vec![0_u32; total as usize];
    for (low, high) in sides(triangles) {
        let slot = &mut ends[low as usize];
        highs[*slot as usize] = high;
        *slot += 1;
    }
    let mut edges = Vec::with_capacity(total as usize / 2 + 1);
    let mut start = 0;
    for (low, &end) in ends.iter().enumerate() {
        let bucket = &mut highs[start..end as usize];
        start = end as usize;
        sort_short(bucket);
        let mut last = None;
        for &mut high in bucket {
            if last != Some(high) {
                edges.push([low as u32, high]);
                last = Some(high);
            }
        }
    }
    edges
}

/// The sides of all triangles, the smaller vertex first; without those from a vertex to itself.
fn sides(triangles: &[[u32; 3]]) -> impl Iterator<Item = (u32, u32)> + '_ {
    triangles
        .iter()
        .flat_map(|&[a, b, c]| [(a.min(b), a.max(b)), (b.min(c), b.max(c)), (c.min(a), c.max(a))])
        .filter(|&(low, high)| low != high)
}

/// Sorts by insertion where there is little to sort, which is nearly always.
fn sort_short(bucket: &mut [u32]) {
    const LONG: usize = 32;
    if bucket.len() > LONG {
        bucket.sort_unstable();
        return;
    }
    for i in 1..bucket.len() {
        let value = bucket[i];
        let mut j = i;
        while j > 0 && bucket[j - 1] > value {
            bucket[j] = bucket[j - 1];
            j -= 1;
        }
        bucket[j] = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::Topology;

    /// A torus of `n` by `m` quadrilaterals: closed, 2 n m triangles.
    fn torus(n: u32, m: u32) -> Vec<[u32; 3]> {
        let at = |i: u32, j: u32| (i % n) * m + j % m;
        let quad = |i, j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        (0..n)
            .flat_map(|i| (0..m).map(move |j| (i, j)))
            .flat_map(|(i, j)| {
                let [a, b, c, d] = quad(i, j);
                [[a, b, c], [a, c, d]]
            })
            .collect()
    }

    fn edges_by_topology(triangles: &[[u32; 3]], nodes: usize) -> Vec<[u32; 2]> {
        Topology::new(nodes, triangles).edges().map(|(a, b, _)| [a, b]).collect()
    }

    #[test]
    fn a_closed_surface_has_three_edges_for_two_triangles() {
        let triangles = torus(37, 23);
        let edges = unique_edges(&triangles, 37 * 23);
        assert_eq!(edges.len() * 2, triangles.len() * 3);
        assert_eq!(edges, edges_by_topology(&triangles, 37 * 23));
    }

    #[test]
    fn edges_are_those_of_the_topology_whatever_the_surface() {
        let fan: Vec<[u32; 3]> = (1..60).map(|i| [0, i, i + 1]).collect();
        let non_manifold = vec![[0, 1, 2], [1, 0, 3], [0, 1, 4], [9, 7, 8]];
        for (triangles, nodes) in [(fan, 70), (non_manifold, 12), (vec![], 5), (vec![], 0)] {
            assert_eq!(unique_edges(&triangles, nodes), edges_by_topology(&triangles, nodes));
        }
    }

    #[test]
    fn a_repeated_vertex_gives_no_edge_to_itself() {
        assert_eq!(unique_edges(&[[2, 2, 1]], 3), [[1, 2]]);
    }
}
