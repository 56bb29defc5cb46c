//! Triangles that a volume mesher refuses: those that touch others, and those that are folded onto a neighbour.
//!
//! TetGen and Gmsh decide exactly: an edge of the wall that lies in the plane of a cap and joins two places of its rim stops
//! them, though nothing runs through anything.
//!
//! Two triangles that share an edge do not cross, however sharply the surface turns there. TetGen takes two that lie
//! within 0.1 degrees of each other for one that is there twice, and no volume mesher makes good cells between them.

use lumen_mesh::crossing::{Face, touch};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh, Vec3, touching_in};

/// Two triangles at an edge are folded where the angle between them is smaller, in degrees. A thin plate has its sides at
/// edges of two right angles; so sharp an edge is a fault of a mesh.
pub const FOLD_DEGREES: f64 = 1.0;

/// The pairs of triangles that are folded onto each other. Edges of one triangle, or of more than two, have no fold.
pub fn folds(mesh: &TriMesh) -> Vec<[u32; 2]> {
    folds_in(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles))
}

fn folds_in(mesh: &TriMesh, topology: &Topology) -> Vec<[u32; 2]> {
    let face = |t: u32| Face { vertices: mesh.triangles[t as usize], corners: mesh.corners(t as usize) };
    let mut found = Vec::new();
    for (a, b, _) in topology.edges().filter(|(.., edge)| edge.triangles() == 2) {
        let mut beside = topology.triangles(a).iter().filter(|&&t| mesh.triangles[t as usize].contains(&b));
        if let (Some(&one), Some(&other)) = (beside.next(), beside.next())
            && is_folded(&face(one), &face(other))
        {
            found.push([one, other]);
        }
    }
    found
}

/// The triangles that share a point with another besides their common vertices or edge, ascending; each has three vertices.
pub(crate) fn touching(mesh: &TriMesh) -> Vec<u32> {
    let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
    touching_in(mesh, &index, Some(&Topology::new(mesh.positions.len(), &mesh.triangles)))
}

/// The triangles that touch others or are folded onto a neighbour, ascending.
pub(crate) fn clashing(mesh: &TriMesh) -> Vec<u32> {
    let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
    clashing_in(mesh, &index, &Topology::new(mesh.positions.len(), &mesh.triangles))
}

/// As [`clashing`], of a surface whose index and adjacency are known.
pub(crate) fn clashing_in(mesh: &TriMesh, index: &SurfaceIndex, topology: &Topology) -> Vec<u32> {
    let mut all = touching_in(mesh, index, Some(topology));
    all.extend(folds_in(mesh, topology).as_flattened());
    all.sort_unstable();
    all.dedup();
    all
}

/// Those of `triangles`, a few of a surface whose edges have two triangles at most, that [`clashing_in`] finds, in their order.
pub(crate) fn clashing_of(mesh: &TriMesh, index: &SurfaceIndex, mut triangles: Vec<u32>) -> Vec<u32> {
    let face = |t: u32| Face { vertices: mesh.triangles[t as usize], corners: mesh.corners(t as usize) };
    triangles.retain(|&t| {
        let [a, b, c] = mesh.corners(t as usize);
        let mut does = false;
        index.for_each_near(a.min(b).min(c), a.max(b).max(c), |other| {
            does = does || (other != t && clash(&face(t.min(other)), &face(t.max(other))));
        });
        does
    });
    triangles
}

/// Whether two triangles touch or are folded onto each other.
pub(crate) fn clash(a: &Face, b: &Face) -> bool {
    touch(a, b) || is_folded(a, b)
}

/// Whether two triangles share an edge and lie on each other.
fn is_folded(a: &Face, b: &Face) -> bool {
    let apex = |one: &Face, other: &Face| {
        let mut own = (0..3).filter(|&i| !other.vertices.contains(&one.vertices[i]));
        own.next().filter(|_| own.next().is_none())
    };
    let (Some(i), Some(j)) = (apex(a, b), apex(b, a)) else { return false };
    let at = |k: usize| a.corners[(i + k) % 3].as_dvec3();
    let (origin, along) = (at(1), (at(2) - at(1)).normalize_or_zero());
    let off_edge = |p: Vec3| (p.as_dvec3() - origin).reject_from_normalized(along);
    let (p, q) = (off_edge(a.corners[i]), off_edge(b.corners[j]));
    // The tangent of so small an angle is the angle.
    p.dot(q) > 0.0 && p.cross(q).length() < FOLD_DEGREES.to_radians() * p.dot(q)
}

#[cfg(test)]
pub(crate) mod tests {
    use lumen_mesh::shapes::{icosphere, tube};

    use super::*;

    /// A box of 10 mm with a vertex of its top just above the triangle on the other side of one of its edges.
    pub(crate) fn folded_box() -> TriMesh {
        let mut mesh = icosphere(4, 1.0, Vec3::ZERO);
        mesh.positions.iter_mut().for_each(|p| *p *= 5.0 / p.abs().max_element());
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let is_within = |t: &[u32; 3]| {
            t.iter().map(|&v| mesh.positions[v as usize]).all(|p| p.z == 5.0 && p.truncate().length() < 2.0)
        };
        let &[v, a, b] = mesh.triangles.iter().find(|t| is_within(t)).unwrap();
        let beside = topology.triangles(a).iter().map(|&t| mesh.triangles[t as usize]);
        let other = beside.rev().find(|t| t.contains(&b) && !t.contains(&v)).unwrap();
        let at = |v: u32| mesh.positions[v as usize];
        let beyond = at(a).midpoint(at(b)).lerp(other.map(at).iter().sum::<Vec3>() / 3.0, 0.3);
        mesh.positions[v as usize] = beyond + 2e-4 * Vec3::Z;
        mesh
    }

    /// Two triangles at the edge from 0 to 1 along x, at an angle in degrees.
    fn hinge(degrees: f64) -> TriMesh {
        let (sine, cosine) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        let wing = Vec3::new(0.4, cosine as f32, sine as f32);
        TriMesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(0.6, 2.0, 0.0), wing],
            triangles: vec![[0, 1, 2], [1, 0, 3]],
        }
    }

    #[test]
    fn two_triangles_are_folded_below_one_degree_alone() {
        for (degrees, is_folded) in [(0.0, true), (0.09, true), (0.95, true), (1.05, false), (60.0, false)] {
            for degrees in [degrees, -degrees] {
                assert_eq!(folds(&hinge(degrees)), if is_folded { vec![[0, 1]] } else { vec![] }, "{degrees}");
            }
        }
        let folded = folded_box();
        let index = SurfaceIndex::new(&folded.positions, &folded.triangles);
        let all = (0..folded.triangles.len() as u32).collect();
        assert_eq!(clashing_of(&folded, &index, all), clashing(&folded));
        assert!(touching(&folded).is_empty());
        assert_eq!(folds(&folded).len(), 3, "a triangle that is turned over lies on all its neighbours");
        // Flat is the opposite of folded.
        assert!(folds(&hinge(180.0)).is_empty());
    }

    #[test]
    fn a_sound_surface_has_no_fold_and_an_edge_of_three_triangles_none() {
        for mesh in [icosphere(3, 5.0, Vec3::ZERO), tube(12, 8, 10.0, |_| 2.0)] {
            assert!(clashing(&mesh).is_empty());
        }
        let mut fan = hinge(0.05);
        fan.positions.push(Vec3::new(0.5, -1.0, 0.0));
        fan.triangles.push([0, 1, 4]);
        assert!(folds(&fan).is_empty());
    }
}
