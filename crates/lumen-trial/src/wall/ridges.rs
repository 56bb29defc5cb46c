//! Where the inside of a segment can come nearer to a wall than its ends: at ridges.

use lumen_mesh::{Topology, TriMesh};

/// Cosine of the turn between two triangles below which they are folded.
const FOLD: f64 = 0.3;

/// The sides of each triangle that the inside of a segment in the lumen can come nearest to, bit by bit: not those of
/// valleys, as to a point in the lumen one of the triangles beside them is nearer, and ridges in one of their two
/// triangles only. Where walls cross each other, one is seen from behind, and only nodes are kept off by it. `order` has
/// all triangles, neighbours mostly side by side, as they are at hand then.
pub(super) fn ridges(mesh: &TriMesh, topology: &Topology, order: impl Iterator<Item = u32>) -> Vec<u8> {
    let at = |v: u32| mesh.positions[v as usize].as_dvec3();
    let of = |t: usize| {
        let corners = mesh.triangles[t];
        let [a, b, c] = corners.map(at);
        let outward = (b - a).cross(c - a);
        let is_kept = |&k: &usize| {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            let is_beside = |&&other: &&u32| other as usize != t && mesh.triangles[other as usize].contains(&to);
            let mut beside = topology.triangles(from).iter().filter(is_beside);
            let (Some(&other), None) = (beside.next(), beside.next()) else { return true };
            // Triangles that are wound against each other have no common outside.
            let Some(far) = beyond(mesh.triangles[other as usize], to, from).map(at) else { return true };
            let others = (at(from) - at(to)).cross(far - at(to));
            // Slivers that are folded over a ridge seem to lie between two valleys.
            let is_plain = outward.dot(others) > FOLD * outward.length() * others.length();
            !is_plain || other as usize > t && outward.dot(far - a) >= 0.0
        };
        (0..3).filter(is_kept).fold(0, |sides, k| sides | 1 << k)
    };
    let mut sides = vec![0; mesh.triangles.len()];
    for t in order.map(|t| t as usize).filter(|&t| t < mesh.triangles.len()) {
        sides[t] = of(t);
    }
    sides
}

/// The corner of a triangle beyond its side from `from` to `to`, if it is wound that way.
fn beyond(triangle: [u32; 3], from: u32, to: u32) -> Option<u32> {
    (0..3).find(|&k| triangle[k] == from && triangle[(k + 1) % 3] == to).map(|k| triangle[(k + 2) % 3])
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::Vec3;
    use lumen_mesh::shapes::icosphere;

    #[test]
    fn a_lumen_without_ridges_has_no_side_to_be_near_to() {
        let ball = icosphere(3, 5.0, Vec3::ZERO);
        let sides = |mesh: &TriMesh| -> u32 {
            let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
            ridges(mesh, &topology, 0..mesh.triangles.len() as u32).into_iter().map(u8::count_ones).sum()
        };
        assert_eq!(sides(&ball), 0);
        // Seen from outside each side is a ridge, in one triangle.
        let mut turned = ball;
        turned.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
        assert_eq!(sides(&turned) as usize, turned.triangles.len() * 3 / 2);
        // The sides at an open end have one triangle.
        turned.triangles.pop();
        assert_eq!(sides(&turned) as usize, (turned.triangles.len() + 1) * 3 / 2);
    }
}
