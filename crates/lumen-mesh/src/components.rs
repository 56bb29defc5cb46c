//! Connected pieces of a surface: triangles that share a vertex belong together (`disjoint_sets`).

use super::disjoint_sets::{singles, union};

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
    let mut parent = singles(vertex_count);
    for &[a, b, c] in triangles {
        let [up_a, up_b, up_c] = [a, b, c].map(|v| parent[v as usize]);
        if up_a != up_b || up_b != up_c {
            union(&mut parent, a, b);
            union(&mut parent, a, c);
        }
    }
    // No parent is larger than its child, so each finds its parent at the root already.
    for v in 0..vertex_count {
        parent[v] = parent[parent[v] as usize];
    }
    number(&parent, triangles)
}

/// Numbers the pieces in the order of the triangles; `roots` has the representative of each vertex.
fn number(roots: &[u32], triangles: &[[u32; 3]]) -> Components {
    const UNSEEN: u32 = u32::MAX;
    let mut numbers = vec![UNSEEN; roots.len()];
    let mut result = Components { of_triangle: Vec::with_capacity(triangles.len()), triangle_counts: Vec::new() };
    // Triangles of one piece tend to follow each other.
    let (mut last_root, mut piece) = (UNSEEN, UNSEEN);
    for &[a, ..] in triangles {
        let root = roots[a as usize];
        if root != last_root {
            last_root = root;
            piece = numbers[root as usize];
            if piece == UNSEEN {
                piece = result.triangle_counts.len() as u32;
                numbers[root as usize] = piece;
                result.triangle_counts.push(0);
            }
        }
        result.of_triangle.push(piece);
        result.triangle_counts[piece as usize] += 1;
    }
    result
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
