//! Outlines of ends that cross themselves, as those of rough walls do.
//!
//! The vertices of edges that meet others go to the mean of their two neighbours on the rim, again and again, until the rim
//! crosses itself no more. They stay in its plane, and the other vertices where they are.

use glam::{DVec2, DVec3};
use lumen_mesh::TriMesh;

use super::OpenEnd;

/// Rounds, at most: a rim of so many folds is no outline of a vessel.
const ROUNDS: usize = 20;

/// Relaxes the rims of those ends whose outlines cross themselves.
pub fn unfold(mesh: &mut TriMesh, ends: &[OpenEnd]) {
    for end in ends {
        let (x, y) = end.normal.any_orthonormal_pair();
        let mut places: Vec<DVec3> = end.rim.iter().map(|&v| mesh.positions[v as usize].as_dvec3()).collect();
        let flat = |p: &DVec3| DVec2::new(p.dot(x), p.dot(y));
        for _ in 0..ROUNDS {
            let meeting = meeting(&places.iter().map(flat).collect::<Vec<DVec2>>());
            if meeting.is_empty() {
                break;
            }
            let before = places.clone();
            let count = places.len();
            for i in meeting {
                places[i] = before[(i + count - 1) % count].midpoint(before[(i + 1) % count]);
            }
        }
        for (&v, p) in end.rim.iter().zip(&places) {
            mesh.positions[v as usize] = p.as_vec3();
        }
    }
}

/// The ends of those edges of a polygon that meet one that is no neighbour.
fn meeting(polygon: &[DVec2]) -> Vec<usize> {
    let count = polygon.len();
    let edge = |i: usize| (polygon[i], polygon[(i + 1) % count]);
    let meets = |i: usize, j: usize| {
        let ((a, b), (c, d)) = (edge(i), edge(j));
        let parts = |a: DVec2, b: DVec2, c: DVec2, d: DVec2| (b - a).perp_dot(c - a) * (b - a).perp_dot(d - a) <= 0.0;
        // Of edges on one straight line no signs tell, but where they lie.
        let are_apart = a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any();
        !are_apart && parts(a, b, c, d) && parts(c, d, a, b)
    };
    let pairs = (0..count).flat_map(|i| (i + 2..count).map(move |j| (i, j)));
    let found = pairs.filter(|&(i, j)| (j + 1) % count != i && meets(i, j));
    let mut ends: Vec<usize> = found.flat_map(|(i, j)| [i, i + 1, j, (j + 1) % count]).collect();
    ends.sort_unstable();
    ends.dedup();
    ends
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use lumen_mesh::Vec3;
    use lumen_mesh::shapes::tube;

    use super::super::open_ends;
    use super::*;
    use crate::cap::{CapError, CapKind, cap};

    #[test]
    fn straight_sides_stay_as_they_are() {
        // A square duct, askew, with four edges a side.
        let mut mesh = tube(16, 10, 20.0, |_| 2.0);
        for p in &mut mesh.positions {
            let square = p.truncate() * (2.0 / p.truncate().abs().max_element());
            *p = Vec3::new(square.x, 0.8 * square.y - 0.6 * p.z, 0.6 * square.y + 0.8 * p.z);
        }
        let before = mesh.clone();
        let (ends, _) = open_ends(&mesh).unwrap();
        assert_eq!(ends.len(), 2);
        unfold(&mut mesh, &ends);
        assert_eq!(mesh, before);
    }

    #[test]
    fn an_outline_that_crosses_itself_is_unfolded_and_can_be_closed() {
        let sound = tube(48, 40, 20.0, |_| 2.0);
        let mut mesh = sound.clone();
        let (ends, _) = open_ends(&mesh).unwrap();
        // Two neighbours of one rim change places: the outline goes back and forth there.
        let [a, b] = [ends[0].rim[7], ends[0].rim[8]];
        mesh.positions.swap(a as usize, b as usize);
        let (ends, _) = open_ends(&mesh).unwrap();
        assert!(matches!(cap(&mesh, &ends, CapKind::Planar), Err(CapError::SelfCrossing { .. })));
        unfold(&mut mesh, &ends);
        let (ends, _) = open_ends(&mesh).unwrap();
        let closed = cap(&mesh, &ends, CapKind::Planar).unwrap();
        for patch in &closed.patches[1..] {
            assert!((patch.area_mm2 / (4.0 * PI) - 1.0).abs() < 0.02, "{patch:?}");
        }
        // The other rim is as it was.
        let is_of_other = |v: &&u32| sound.positions[**v as usize].z != sound.positions[a as usize].z;
        let rims: Vec<u32> = ends.iter().flat_map(|end| end.rim.clone()).collect();
        assert!(rims.iter().filter(is_of_other).all(|&v| mesh.positions[v as usize] == sound.positions[v as usize]));
    }
}
