//! Connected pieces of a surface: triangles that share a vertex belong together (union-find, Tarjan 1975).

/// A partition of the triangles into connected pieces, numbered by their first triangle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Components {
    /// The piece of each triangle.
    pub of_triangle: Vec<u32>,
    /// Triangles in each piece.
    pub triangle_counts: Vec<u32>,
}

impl Components {
    /// Number of pieces.
    pub fn count(&self) -> usize {
        self.triangle_counts.len()
    }

    /// The piece with the most triangles (the first of equals), or `None` where there is no triangle.
    pub fn largest(&self) -> Option<u32> {
        let best = self.triangle_counts.iter().enumerate().max_by_key(|&(i, &n)| (n, std::cmp::Reverse(i)))?;
        Some(best.0 as u32)
    }
}

/// The connected pieces of `triangles` over `vertex_count` vertices.
pub fn components(vertex_count: usize, triangles: &[[u32; 3]]) -> Components {
    let mut parent: Vec<u32> = (0..vertex_count as u32).collect();
    for &[a, b, c] in triangles {
        let root = union(&mut parent, a, b);
        union(&mut parent, root, c);
    }
    const UNSEEN: u32 = u32::MAX;
    let mut number = vec![UNSEEN; vertex_count];
    let mut result = Components { of_triangle: Vec::with_capacity(triangles.len()), triangle_counts: Vec::new() };
    for &[a, ..] in triangles {
        let root = find(&mut parent, a) as usize;
        if number[root] == UNSEEN {
            number[root] = result.triangle_counts.len() as u32;
            result.triangle_counts.push(0);
        }
        result.of_triangle.push(number[root]);
        result.triangle_counts[number[root] as usize] += 1;
    }
    result
}

/// The representative of `v`, halving the path on the way.
fn find(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        let up = parent[parent[v as usize] as usize];
        parent[v as usize] = up;
        v = up;
    }
    v
}

/// Joins the sets of `a` and `b` under the smaller representative, which is returned.
fn union(parent: &mut [u32], a: u32, b: u32) -> u32 {
    let (a, b) = (find(parent, a), find(parent, b));
    let (low, high) = (a.min(b), a.max(b));
    parent[high as usize] = low;
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_numbered_by_their_first_triangle() {
        let found = components(9, &[[6, 7, 8], [0, 1, 2], [2, 3, 4]]);
        assert_eq!(found, Components { of_triangle: vec![0, 1, 1], triangle_counts: vec![1, 2] });
        assert_eq!(found.largest(), Some(1));
        assert_eq!(components(3, &[]).largest(), None);
    }
}
