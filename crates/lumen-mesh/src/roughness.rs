//! How rough a surface is: by how much neighbouring triangles are bent against each other.
//!
//! The dihedral deviation of an edge is the angle between the normals of its two triangles: 0 degrees where the surface
//! is flat, 90 at the edge of a cube. It is taken over the edges of two triangles that both have an area; boundary and
//! non-manifold edges have no such angle. On a smooth surface it falls with the length of the edges, so it compares
//! surfaces of about the same number of triangles.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::{Topology, TriMesh, Vec3};

/// Dihedral deviation over the inner edges, in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Roughness {
    /// Root of the mean square.
    pub rms_deg: f64,
    /// 95th percentile, interpolated between neighbours.
    pub p95_deg: f64,
    /// Largest.
    pub max_deg: f64,
}

/// The roughness of `mesh`, whose adjacency is `topology`; `None` where no edge has two triangles with an area.
pub fn roughness(mesh: &TriMesh, topology: &Topology) -> Option<Roughness> {
    summarise_bends(bends(mesh, topology, 0..topology.vertex_count()))
}

/// The dihedral deviation, in degrees, of each inner edge from a vertex in `from` to one of a higher number.
pub fn bends(mesh: &TriMesh, topology: &Topology, from: Range<usize>) -> Vec<f32> {
    let mut bends = Vec::new();
    for a in from.start as u32..from.end as u32 {
        let row = topology.neighbours(a).iter().zip(topology.edge_uses(a));
        for (&b, edge) in row.filter(|(b, edge)| **b > a && edge.triangles() == 2) {
            let mut pair = topology.triangles(a).iter().filter(|&&t| mesh.triangles[t as usize].contains(&b));
            if let (Some(&s), Some(&t)) = (pair.next(), pair.next()) {
                let turned = if edge.is_flipped() { -1.0 } else { 1.0 };
                bends.extend(bend(mesh.corners(s as usize), mesh.corners(t as usize), turned));
            }
        }
    }
    bends
}

/// The angle between two triangles' normals, in degrees.
fn bend(s: [Vec3; 3], t: [Vec3; 3], turned: f64) -> Option<f32> {
    let normal = |[a, b, c]: [Vec3; 3]| (b.as_dvec3() - a.as_dvec3()).cross(c.as_dvec3() - a.as_dvec3());
    let (m, n) = (normal(s), normal(t) * turned);
    let both_have_area = m.length_squared() > 0.0 && n.length_squared() > 0.0;
    let angle = libm::atan2(m.cross(n).length(), m.dot(n)).to_degrees();
    (both_have_area && angle.is_finite()).then_some(angle as f32)
}

/// What many bends come to, whatever their order.
pub fn summarise_bends(mut bends: Vec<f32>) -> Option<Roughness> {
    if bends.is_empty() {
        return None;
    }
    // Sorted, the sum does not depend on how the edges were numbered.
    bends.sort_unstable_by(f32::total_cmp);
    let squares: f64 = bends.iter().map(|&bend| f64::from(bend) * f64::from(bend)).sum();
    Some(Roughness {
        rms_deg: (squares / bends.len() as f64).sqrt(),
        p95_deg: sorted_percentile(&bends, 0.95),
        max_deg: f64::from(bends[bends.len() - 1]),
    })
}

/// The value below which `part` (0 to 1) of at least one sorted value lies, interpolated between neighbours.
pub(crate) fn sorted_percentile(sorted: &[f32], part: f64) -> f64 {
    let rank = part * (sorted.len() - 1) as f64;
    let at = f64::from(sorted[rank as usize]);
    let next = f64::from(sorted[(rank as usize + 1).min(sorted.len() - 1)]);
    at + (next - at) * rank.fract()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{icosphere, square};

    fn of(mesh: &TriMesh) -> Option<Roughness> {
        roughness(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles))
    }

    #[test]
    fn a_plane_is_flat_and_a_surface_without_inner_edges_has_no_roughness() {
        assert_eq!(of(&square(9, 3.0, 0.0)), Some(Roughness { rms_deg: 0.0, p95_deg: 0.0, max_deg: 0.0 }));
        assert_eq!(of(&TriMesh::default()), None);
        let one = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]] };
        assert_eq!(of(&one), None);
        let mut line = one.clone();
        line.positions[2] = Vec3::X * 2.0;
        line.positions.push(Vec3::X * 3.0);
        line.triangles.push([0, 3, 1]);
        assert_eq!(of(&line), None);
    }

    #[test]
    fn an_icosahedron_bends_by_the_supplement_of_its_dihedral_angle_everywhere() {
        let found = of(&icosphere(0, 7.0, Vec3::ONE)).unwrap();
        let bend = libm::acos(5f64.sqrt() / 3.0).to_degrees();
        for value in [found.rms_deg, found.p95_deg, found.max_deg] {
            assert!((value - bend).abs() < 1e-4, "{found:?}, {bend}");
        }
    }

    #[test]
    fn a_sheet_folded_along_one_row_of_edges_has_that_many_bends() {
        // Cells of 1 mm; beyond x = 2 the sheet rises at 30 degrees.
        let mut sheet = square(4, 4.0, 0.0);
        for p in sheet.positions.iter_mut().filter(|p| p.x > 2.0) {
            let over = p.x - 2.0;
            (p.x, p.z) = (2.0 + over * 30f32.to_radians().cos(), over * 30f32.to_radians().sin());
        }
        let found = of(&sheet).unwrap();
        // 4 folded edges of 4 * 3 * 2 + 16 inner ones.
        assert!((found.rms_deg - 30.0 * (4f64 / 40.0).sqrt()).abs() < 1e-4, "{found:?}");
        assert!((found.max_deg - 30.0).abs() < 1e-4 && (found.p95_deg - 30.0).abs() < 1e-4, "{found:?}");
    }

    #[test]
    fn windings_that_disagree_do_not_look_like_a_fold() {
        let mut sheet = square(2, 2.0, 0.0);
        sheet.triangles[3].swap(0, 1);
        assert_eq!(of(&sheet).unwrap().max_deg, 0.0);
    }
}
