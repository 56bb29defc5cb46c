//! Boundary loops: the closed chains of edges that belong to one triangle each.

use super::Topology;

/// The boundary of a surface as closed loops of vertices, each in the direction in which its triangles run,
/// ordered by the smallest vertex they begin at. Where several loops touch in one vertex they are told apart by
/// walking on to the unused edge with the smallest end; a chain that does not close (possible only where
/// windings disagree) ends where it can go no further and is returned as it is.
pub fn boundary_loops(topology: &Topology) -> Vec<Vec<u32>> {
    // Directed boundary edges a -> b, by a.
    let mut starts: Vec<(u32, u32)> = Vec::new();
    for (a, b, edge) in topology.edges() {
        if edge.is_boundary() {
            starts.push(if edge.forward == 1 { (a, b) } else { (b, a) });
        }
    }
    starts.sort_unstable();
    let mut used = vec![false; starts.len()];
    let mut loops = Vec::new();
    for first in 0..starts.len() {
        if used[first] {
            continue;
        }
        let mut chain = Vec::new();
        let mut edge = Some(first);
        while let Some(e) = edge {
            used[e] = true;
            chain.push(starts[e].0);
            let end = starts[e].1;
            if end == chain[0] {
                break;
            }
            let from = starts.partition_point(|&(a, _)| a < end);
            edge = (from..starts.len()).take_while(|&i| starts[i].0 == end).find(|&i| !used[i]);
            if edge.is_none() {
                chain.push(end);
            }
        }
        loops.push(chain);
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_of_two_triangles_has_one_loop_in_its_winding() {
        let loops = boundary_loops(&Topology::new(4, &[[0, 1, 2], [0, 2, 3]]));
        assert_eq!(loops, vec![vec![0, 1, 2, 3]]);
    }

    #[test]
    fn two_triangles_that_touch_in_a_vertex_have_two_loops() {
        let loops = boundary_loops(&Topology::new(5, &[[0, 1, 2], [2, 3, 4]]));
        assert_eq!(loops, vec![vec![0, 1, 2], vec![2, 3, 4]]);
    }
}
