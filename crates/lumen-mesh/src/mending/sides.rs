//! The sides of triangles by the edge that they are on, and the triangles that lie twice there.

use crate::TriMesh;

/// The sides of all triangles, three each, by the edge that they are on: `(low, high)` in one number, and the side.
pub(super) fn by_edge(triangles: &[[u32; 3]]) -> Vec<(u64, u32)> {
    let ends = |side: usize| {
        let t = triangles[side / 3];
        let (a, b) = (t[side % 3], t[(side + 1) % 3]);
        u64::from(a.min(b)) << 32 | u64::from(a.max(b))
    };
    let mut sides: Vec<(u64, u32)> = (0..3 * triangles.len()).map(|side| (ends(side), side as u32)).collect();
    sides.sort_unstable();
    sides
}

/// Triangles over the same three vertices as an earlier one, where they share an edge with a third.
pub(super) fn doubles(mesh: &TriMesh) -> Vec<bool> {
    let mut is_double = vec![false; mesh.triangles.len()];
    let sorted = |t: u32| {
        let mut corners = mesh.triangles[t as usize];
        corners.sort_unstable();
        corners
    };
    for sides in by_edge(&mesh.triangles).chunk_by(|a, b| a.0 == b.0).filter(|sides| sides.len() > 2) {
        let mut here: Vec<([u32; 3], u32)> = sides.iter().map(|&(_, side)| (sorted(side / 3), side / 3)).collect();
        here.sort_unstable();
        for pair in here.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            is_double[pair[1].1 as usize] = true;
        }
    }
    is_double
}
