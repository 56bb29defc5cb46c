//! Indices made of others, in a tenth of the time that a new one takes: of a surface whose vertices have moved, the same hierarchy
//! with boxes of its own, which is as good where nothing moved far; and of a surface in two parts, those of the parts.

use super::closest_point::is_sliver;
use super::nearest::{Leaf, Node, SurfaceIndex};
use super::{TriMesh, Vec3};
use crate::task::{Yielder, blocks};

/// Leaves or nodes between two looks at the clock.
const PIECE: usize = 4096;

/// The index of `moved`, from `index`, which is of a surface of the same triangles. What was left out of that stays out.
///
/// # Panics
/// When `moved` has fewer triangles.
pub async fn refitted(index: &SurfaceIndex, moved: &TriMesh, yielder: &Yielder) -> SurfaceIndex {
    let all = (index.leaves.len() + index.nodes.len()).max(1) as f32;
    let mut leaves = Vec::with_capacity(index.leaves.len());
    for block in blocks(index.leaves.len(), PIECE) {
        leaves.extend(index.leaves[block].iter().map(|old| {
            let corners = moved.corners(old.triangle as usize);
            Leaf { corners, triangle: old.triangle, is_sliver: is_sliver(corners), sides: Leaf::ALL_SIDES }
        }));
        yielder.rest(leaves.len() as f32 / all).await;
    }
    let mut nodes = vec![Node::EMPTY; index.nodes.len()];
    for block in blocks(nodes.len(), PIECE) {
        let end = block.end;
        // A node stands behind its parent, so the last come first.
        for from_last in block {
            let n = nodes.len() - 1 - from_last;
            nodes[n] = fitted(&index.nodes[n], &nodes, &leaves);
        }
        yielder.rest((leaves.len() + end) as f32 / all).await;
    }
    SurfaceIndex { nodes, leaves, planes: Vec::new(), triangles: index.triangles }
}

/// The index of a surface of two parts, from that of each and the number of each of its triangles on the whole. Nothing may be
/// missing.
///
/// # Panics
/// When a triangle of a part has no number.
pub async fn joined_index(parts: [(&SurfaceIndex, &[u32]); 2], yielder: &Yielder) -> SurfaceIndex {
    let slots = parts.iter().map(|(index, _)| index.leaves.len()).sum();
    let mut nodes = Vec::with_capacity(1 + parts.iter().map(|(index, _)| index.nodes.len()).sum::<usize>());
    nodes.push(Node::EMPTY);
    let mut leaves = Vec::with_capacity(slots);
    for (index, numbers) in parts {
        let (first_node, first_slot) = (nodes.len() as u32, leaves.len() as u32);
        if let Some(root) = index.nodes.first() {
            let (min, max) = around(root);
            nodes[0].add(min, max, first_node, 0);
        }
        for &(mut node) in &index.nodes {
            for lane in 0..usize::from(node.used) {
                node.child[lane] += if node.count[lane] == 0 { first_node } else { first_slot };
            }
            nodes.push(node);
        }
        for block in blocks(index.leaves.len(), PIECE) {
            let renumbered = |&leaf: &Leaf| Leaf { triangle: numbers[leaf.triangle as usize], ..leaf };
            leaves.extend(index.leaves[block].iter().map(renumbered));
            yielder.rest(leaves.len() as f32 / slots as f32).await;
        }
    }
    let triangles = parts.iter().map(|(index, _)| index.triangles).sum();
    SurfaceIndex { nodes, leaves, planes: Vec::new(), triangles }
}

/// The node `old` with the boxes that its children have among `nodes` and `leaves`.
fn fitted(old: &Node, nodes: &[Node], leaves: &[Leaf]) -> Node {
    let mut node = Node::EMPTY;
    for lane in 0..usize::from(old.used) {
        let (child, count) = (old.child[lane], old.count[lane]);
        let (min, max) = match usize::from(count) {
            0 => around(&nodes[child as usize]),
            count => {
                let leaves = &leaves[child as usize..child as usize + count];
                let corners = leaves.iter().flat_map(|leaf| leaf.corners);
                corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
            }
        };
        node.add(min, max, child, count);
    }
    node
}

/// The box around a node's boxes.
fn around(node: &Node) -> (Vec3, Vec3) {
    let least = |axis: usize| node.min[axis].min_element();
    let most = |axis: usize| node.max[axis].max_element();
    (Vec3::new(least(0), least(1), least(2)), Vec3::new(most(0), most(1), most(2)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::self_intersections;
    use crate::shapes::{icosphere, joined};
    use crate::task::at_once;
    use crate::{Crossing, Indexed, Topology, distance_to_triangle};
    use crate::{self_intersections_in, shapes::square};

    #[test]
    fn it_answers_as_one_that_is_built_anew() {
        let mut mesh = joined(&[icosphere(4, 8.0, Vec3::ZERO), icosphere(4, 8.0, Vec3::new(17.0, 1.0, 2.0))]);
        // A needle, which stands in several leaves.
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([Vec3::new(-40.0, -40.0, 9.0), Vec3::new(40.0, 40.0, 9.0), Vec3::new(40.0, 40.01, 9.0)]);
        mesh.triangles.push([first, first + 1, first + 2]);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        let mut moved = mesh.clone();
        // One sphere into the other, and both bent.
        let nearer = |p: Vec3| if p.x > 8.5 { p - 4.0 * Vec3::X } else { p };
        moved.positions.iter_mut().for_each(|p| *p = nearer(*p) + Vec3::Z * (p.x * 0.4).sin());
        let refitted = at_once(refitted(&index, &moved, &Yielder::never()));
        let crossing = Crossing::none(&refitted, &moved.triangles);
        let topology = Topology::new(moved.positions.len(), &moved.triangles);
        let surface = Indexed { mesh: &moved, topology: Some(&topology) };
        refitted.mark_crossings(surface, 0..refitted.slots(), &crossing);
        let found: Vec<u32> = crossing.triangles().collect();
        assert!(found.len() > 20 && found == self_intersections(&moved), "{} triangles cross", found.len());
        for i in 0..200 {
            let p = Vec3::new((i % 20) as f32 - 8.0, (i / 20) as f32 - 4.0, 3.0);
            let nearest = (0..moved.triangles.len()).map(|t| distance_to_triangle(p, moved.corners(t)));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            let found = f64::from(refitted.nearest(p).unwrap().distance);
            assert!((found - nearest).abs() < 1e-5, "{p}: {found} beside {nearest}");
        }
    }

    #[test]
    fn of_two_parts_it_answers_as_one_that_is_built_anew() {
        let first = icosphere(3, 8.0, Vec3::ZERO);
        for second in [square(9, 12.0, 1.5), TriMesh::default()] {
            // The parts take turns.
            let mut whole = joined(&[first.clone(), second.clone()]);
            let count = first.triangles.len();
            let mut order: Vec<usize> = (0..whole.triangles.len()).collect();
            order.sort_by_key(|&t| if t < count { 2 * t } else { 2 * (t - count) + 1 });
            whole.triangles = order.iter().map(|&t| whole.triangles[t]).collect();
            let numbers = |is_first: bool| {
                (0..order.len() as u32).filter(|&t| (order[t as usize] < count) == is_first).collect::<Vec<u32>>()
            };
            let indices = [&first, &second].map(|part| SurfaceIndex::new(&part.positions, &part.triangles));
            let numbers = [true, false].map(numbers);
            let parts = [(&indices[0], &numbers[0][..]), (&indices[1], &numbers[1][..])];
            let found = at_once(joined_index(parts, &Yielder::never()));
            let anew = SurfaceIndex::new(&whole.positions, &whole.triangles);
            assert_eq!(found.len(), whole.triangles.len());
            for i in 0..300 {
                let p = Vec3::new((i % 20) as f32 - 4.0, (i / 20) as f32 - 4.0, 2.0);
                assert_eq!(found.nearest(p), anew.nearest(p));
            }
            let topology = Topology::new(whole.positions.len(), &whole.triangles);
            let crossing = [&found, &anew].map(|index| self_intersections_in(&whole, index, Some(&topology)));
            assert!(crossing[0] == crossing[1] && crossing[0].is_empty() == second.triangles.is_empty());
        }
    }
}
