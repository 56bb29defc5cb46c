//! Spicules: short thin stubs of a rough wall, as noise leaves them on the surface of a mask. The tree has a branch for each,
//! which ends as a vessel does.
//!
//! A side branch is one where it sticks out of its vessel by hardly more than that is wide, has at most a sixth of its radius, and is
//! hardly wider than the wall beside it is rough. The roughness is the spread of the umbrella vectors, from each vertex to the
//! mean of its neighbours, along the normal: a bend, which all of them share, counts for nothing. Of the steps of a mask it is
//! a sixth of a voxel, so that what counts as a spicule there is at most about a voxel in radius.
//!
//! A thin vessel of a smooth wall is none, however short. Where a wall has fewer than four edges to its radius its roughness
//! is that of its triangles, and nothing is told by it.

use glam::DVec3;
use lumen_mesh::{Topology, TriMesh};
use lumen_vessel::{Branch, End, Place, Tree};

/// It sticks out of its vessel by less than so many of the vessel's diameters: one, and what steps take of the largest balls.
const STICKS_OUT: f64 = 1.25;
/// Its mean radius is at most this part of the vessel's.
const THIN: f64 = 1.0 / 6.0;
/// And less than this many times the roughness of the wall.
const ROUGH: f64 = 8.0;
/// Edges to the radius of a vessel whose roughness is known, at least.
const FINE: f64 = 4.0;
/// The wall beside it: so many of the vessel's radii from where it leaves, and farther from it than so many of its own.
const BESIDE: std::ops::Range<f64> = 0.7..2.0;
const CLEAR: f64 = 2.0;

/// Whether the last point of a branch of `tree` is the end of a spicule of `mesh`, whose adjacency is `topology`. What parts
/// within a stub is of it: its vessel is the first one back that is wide enough.
pub(crate) fn is_spicule(mesh: &TriMesh, topology: &Topology, tree: &Tree, branch: &Branch) -> bool {
    let (mut stub, mut out, mut part) = (Vec::new(), 0.0, branch);
    if let Some(tip) = branch.points.last().filter(|_| branch.ends[1] == End::Closed) {
        out += tip.radius;
    }
    for _ in tree.branches() {
        let Some(parent) = part.parent else { return false };
        let parent = &tree.branches()[parent as usize];
        let Some(joint) = part.points.first().map(|place| place.at) else { return false };
        stub.extend_from_slice(&part.points[part.ostium..]);
        out += part.length_mm() - part.arcs[part.ostium];
        let beside = parent.points.iter().map(|place| (place.at.distance(joint), place.radius));
        let nearest = beside.reduce(|least, next| if next.0 < least.0 { next } else { least });
        let Some((_, vessel)) = nearest else { return false };
        let mean = stub.iter().map(|place| place.radius).sum::<f64>() / stub.len() as f64;
        if mean <= THIN * vessel {
            return out < STICKS_OUT * 2.0 * vessel && is_of_rough_wall(mesh, topology, &stub, joint, [mean, vessel]);
        }
        part = parent;
    }
    false
}

/// Whether a stub of these mean radii, its own and its vessel's, is hardly wider than the wall beside it is rough.
fn is_of_rough_wall(mesh: &TriMesh, topology: &Topology, stub: &[Place], joint: DVec3, radii: [f64; 2]) -> bool {
    let [mean, vessel] = radii;
    let is_beside = |p: DVec3| {
        let is_clear = |place: &Place| place.at.distance(p) > CLEAR * mean;
        BESIDE.contains(&(p.distance(joint) / vessel)) && stub.iter().all(is_clear)
    };
    roughness(mesh, topology, is_beside).is_some_and(|(rough, edge)| mean < ROUGH * rough && vessel >= FINE * edge)
}

/// The roughness of the wall in some places, and the mean length of its edges, in mm.
fn roughness(mesh: &TriMesh, topology: &Topology, is_in: impl Fn(DVec3) -> bool) -> Option<(f64, f64)> {
    let at = |v: u32| mesh.positions[v as usize].as_dvec3();
    let (mut count, mut edges, mut sum, mut squares) = (0.0, 0.0, 0.0, 0.0);
    for v in (0..mesh.positions.len() as u32).filter(|&v| is_in(at(v))) {
        let around = topology.neighbours(v);
        if around.is_empty() {
            continue;
        }
        let normal = topology.triangles(v).iter().map(|&t| {
            let [a, b, c] = mesh.corners(t as usize).map(glam::Vec3::as_dvec3);
            (b - a).cross(c - a)
        });
        let normal = normal.sum::<DVec3>().normalize_or_zero();
        let mean = around.iter().map(|&w| at(w)).sum::<DVec3>() / around.len() as f64;
        let umbrella = (mean - at(v)).dot(normal);
        count += 1.0;
        edges += around.iter().map(|&w| at(w).distance(at(v))).sum::<f64>() / around.len() as f64;
        sum += umbrella;
        squares += umbrella * umbrella;
    }
    let variance = squares / count - (sum / count) * (sum / count);
    (count > 0.0).then(|| (variance.max(0.0).sqrt(), edges / count))
}

#[cfg(test)]
mod tests {
    use glam::Vec3Swizzles as _;
    use lumen_mesh::shapes::{in_capsule, isosurface};
    use lumen_mesh::task::{Yielder, at_once};

    use crate::cuts::{ClipAt, cuts};
    use crate::ends::Length;
    use crate::notes::Reason;
    use crate::prepare::Plan;

    use super::*;

    /// Where a stub or branch leaves a vessel of 4 mm along z, and by which angle; how far it sticks out, and its radius.
    type Stub = (f64, f64, f64, f64);

    const SPIKES: [Stub; 6] = [
        (6.0, 0.3, 3.0, 0.5),
        (10.0, 2.1, 4.0, 0.6),
        (20.0, 4.0, 5.0, 0.5),
        (27.0, 5.5, 3.5, 0.7),
        (34.0, 1.0, 6.0, 0.6),
        (54.0, 3.0, 3.0, 0.6),
    ];
    const BRANCHES: [Stub; 2] = [(16.0, 2.9, 14.0, 1.0), (44.0, 0.2, 16.0, 0.9)];

    fn tip((z, angle, out, _): Stub) -> DVec3 {
        DVec3::new(libm::cos(angle), libm::sin(angle), 0.0) * (4.0 + out) + DVec3::Z * z
    }

    /// Distance into a vessel of 60 mm with these.
    fn inside(p: DVec3, stubs: &[Stub]) -> f64 {
        let vessel = (4.0 - p.xy().length()).min(p.z).min(60.0 - p.z);
        stubs.iter().map(|&stub| in_capsule(p, DVec3::Z * stub.0, tip(stub), stub.3)).fold(vessel, f64::max)
    }

    /// The tips of the ends that are spicules, and of those that are cut.
    fn ends(mesh: &TriMesh) -> [Vec<DVec3>; 2] {
        let plan = Plan { clip: Some(ClipAt::Distance(Length::Radii(1.0))), ..Plan::default() };
        let ends = at_once(cuts(mesh, &plan, &Yielder::never())).unwrap().ends;
        let tips = |is: &dyn Fn(&crate::cuts::PlannedEnd) -> bool| {
            ends.iter().filter(|end| is(end)).map(crate::cuts::PlannedEnd::tip).collect()
        };
        [tips(&|end| end.why == Some(Reason::Spicule)), tips(&|end| end.plane.is_some())]
    }

    #[test]
    fn spikes_of_a_mask_are_no_ends_and_its_thin_branches_are() {
        let all = [&SPIKES[..], &BRANCHES].concat();
        let (low, high) = (DVec3::new(-22.0, -22.0, -2.0), DVec3::new(22.0, 22.0, 62.0));
        for voxel in [0.5, 0.6, 0.7] {
            let [spicules, cut] = ends(&isosurface(low, high, voxel, |p| inside(p, &all).signum()));
            let is_near = |p: &DVec3, stubs: &[Stub]| stubs.iter().any(|&stub| tip(stub).distance(*p) < 2.0);
            assert!(spicules.len() >= 3 && spicules.iter().all(|p| is_near(p, &SPIKES)), "{voxel}: {spicules:?}");
            assert!(!cut.iter().any(|p| is_near(p, &SPIKES)), "{voxel}: {cut:?}");
            for branch in BRANCHES {
                assert!(cut.iter().any(|p| is_near(p, &[branch])), "{voxel}: {branch:?} {cut:?}");
            }
        }
        // Who says that the wall is smooth says that they are vessels.
        let [spicules, cut] = ends(&isosurface(low, high, 0.4, |p| inside(p, &all)));
        assert!(spicules.is_empty() && cut.len() > 6, "{spicules:?} {cut:?}");
    }
}
