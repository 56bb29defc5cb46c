//! A surface in another order: the same triangles, vertices and winding, in a place that chance decides.
//!
//! Where results depend on that order, by sums and by which of two equals comes first, this shows by how much.

use super::TriMesh;
use crate::split_mix::SplitMix64;

/// The surface with its vertices and triangles in an order that `seed` decides, each triangle from a corner that it
/// decides on.
#[must_use]
pub fn shuffled(mesh: &TriMesh, seed: u64) -> TriMesh {
    let mut random = SplitMix64::new(seed);
    let vertices = order(&mut random, mesh.positions.len());
    let triangles = order(&mut random, mesh.triangles.len());
    let mut place = vec![0u32; vertices.len()];
    vertices.iter().enumerate().for_each(|(to, &from)| place[from as usize] = to as u32);
    let triangle = |&t: &u32| {
        let mut corners = mesh.triangles[t as usize].map(|v| place[v as usize]);
        corners.rotate_left(below(&mut random, 3));
        corners
    };
    TriMesh {
        positions: vertices.iter().map(|&v| mesh.positions[v as usize]).collect(),
        triangles: triangles.iter().map(triangle).collect(),
    }
}

/// From 0 to less than `count`, all about as often.
fn below(random: &mut SplitMix64, count: usize) -> usize {
    (random.bits() % count.max(1) as u64) as usize
}

/// All numbers below `count`, each once (Fisher and Yates).
fn order(random: &mut SplitMix64, count: usize) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count as u32).collect();
    for last in (1..count).rev() {
        order.swap(last, below(random, last + 1));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;
    use crate::shapes::icosphere;

    /// Each triangle by its places, from the least of them on, in order.
    fn faces(mesh: &TriMesh) -> Vec<[[u32; 3]; 3]> {
        let bits = |v: u32| mesh.positions[v as usize].to_array().map(f32::to_bits);
        let face = |corners: &[u32; 3]| {
            let mut face = corners.map(bits);
            let least = (0..3).min_by_key(|&k| face[k]).unwrap_or(0);
            face.rotate_left(least);
            face
        };
        let mut faces: Vec<_> = mesh.triangles.iter().map(face).collect();
        faces.sort_unstable();
        faces
    }

    #[test]
    fn it_is_the_same_surface_in_another_order() {
        let mesh = icosphere(3, 5.0, Vec3::ZERO);
        let [one, other, again] = [1, 2, 1].map(|seed| shuffled(&mesh, seed));
        for shuffled in [&one, &other] {
            assert_eq!(faces(shuffled), faces(&mesh), "wound as it was");
            let moved = shuffled.positions.iter().zip(&mesh.positions).filter(|(a, b)| a != b).count();
            assert!(moved * 10 > mesh.positions.len() * 9, "{moved}");
        }
        assert_ne!(one.triangles, other.triangles);
        assert_eq!((one.positions, one.triangles), (again.positions, again.triangles));
        assert!(shuffled(&TriMesh::default(), 3).triangles.is_empty());
    }
}
