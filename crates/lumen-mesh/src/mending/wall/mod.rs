//! A wall with two sides: a vessel that was modelled as its wall, from which the lumen is taken.
//!
//! Two cases. As two pieces, one in the other: straight out of the inner one the outer one is met first, nearly parallel,
//! and straight into the outer one the inner, everywhere about as far. As one piece that is joined at the open rims: some
//! of it lines a space that is closed nearly all around, with a wall behind it that is thinner than the space is wide and
//! whose other side lines no such space; or its sheets come apart at creases, and those of one side face each other. All is
//! asked of places spread evenly over the area of the largest pieces.
//!
//! The lumen is the inner side, its triangles turned so that it bounds the blood (a piece of its own does already), cut
//! where the way through the wall no longer ends on its other side: at the rims. The rest of that piece, and the outer
//! piece, are left out; pieces that have nothing to do with the wall stay.
//!
//! Limits: a wall without creases whose thickness varies by more than [`SPREAD`] times, or one of a vessel narrower than its
//! wall, is not recognised. Windings must agree and face outwards.

mod creases;
mod parting;
mod regions;
mod search;
mod visibility;

use std::sync::Arc;

pub use self::search::{SPREAD, Wall};
use self::visibility::Visibility;
use crate::parallel;
use crate::task::{Yielder, at_once, blocks};
use crate::{Blend, SurfaceIndex, TriMesh, components};

/// Triangles between two looks at the clock, and of one thread.
const SLICE: usize = 8_192;
const CHUNK: usize = 256;

/// The lumen of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Lumen {
    /// The surface without the wall's outer side and rims.
    pub mesh: TriMesh,
    /// What each vertex was made of.
    pub vertices: Blend,
    /// What each triangle was made of.
    pub triangles: Blend,
    /// Triangles that were left out.
    pub left_out: usize,
    /// The wall.
    pub wall: Wall,
}

/// What there is of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct WallFound {
    /// The wall, if there is one: of several the first.
    pub wall: Option<Wall>,
    /// Its lumen, where that was asked for; `None` also where the sides cannot be told apart.
    pub lumen: Option<Lumen>,
}

/// Looks for a wall in `mesh`, whose windings agree and face outwards, and takes its lumen if `takes_lumen`.
pub fn find(mesh: &TriMesh, takes_lumen: bool) -> WallFound {
    at_once(find_in_slices(mesh, None, takes_lumen, &Yielder::never()))
}

/// As [`find`], with an index of that surface, where there is one.
pub async fn find_in_slices(
    mesh: &TriMesh,
    index: Option<Arc<SurfaceIndex>>,
    takes_lumen: bool,
    yielder: &Yielder,
) -> WallFound {
    let pieces = components(mesh.positions.len(), &mesh.triangles);
    let index = SurfaceIndex::known_or_built(index, mesh, &yielder.part(0.0..0.4)).await;
    let looks = Visibility { mesh, index: &index, pieces: &pieces };
    let found = looks.walls();
    yielder.rest(0.5).await;
    let wall = found.first().map(|found| found.wall);
    if !takes_lumen || found.is_empty() {
        return WallFound { wall, lumen: None };
    }
    // For each triangle of a piece that is a wall by itself, whether the other side is behind it.
    let mut is_walled = Vec::new();
    if found.iter().any(|found| !found.wall.is_two_pieces) {
        for block in blocks(mesh.triangles.len(), SLICE) {
            let from = block.start;
            let flags = parallel::map_ranges(block.len(), CHUNK, |range| {
                range.map(|t| looks.is_walled((from + t) as u32, &found)).collect::<Vec<_>>()
            });
            is_walled.extend(flags.into_iter().flatten());
            yielder.rest(0.5 + 0.5 * block.end as f32 / mesh.triangles.len() as f32).await;
        }
    }
    WallFound { wall, lumen: looks.lumen(&found, &is_walled) }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::mending::holes::{Opening, holes};
    use crate::shapes::{icosphere, joined, tube};
    use crate::{Topology, Vec3, volume};

    /// A tube in a tube, joined at the rims by a ring of triangles.
    fn joined_tubes(scale: f32) -> TriMesh {
        joined_in(scale, |_| 5.0)
    }

    /// A tube of radius 4 in one of another radius, joined at the rims.
    fn joined_in(scale: f32, outer: impl Fn(f32) -> f32) -> TriMesh {
        let (sides, rings) = (48, 100);
        let outer = tube(sides, rings, 60.0 * scale, |z| outer(z / scale) * scale);
        let inner = tube(sides, rings, 60.0 * scale, |_| 4.0 * scale);
        let first = outer.positions.len() as u32;
        let mut mesh = joined(&[outer, inner]);
        mesh.triangles[(2 * sides * rings) as usize..].iter_mut().for_each(|t| t.swap(1, 2));
        for side in 0..sides {
            let next = (side + 1) % sides;
            let (low, high) = (0, rings * sides);
            let [a, b, c, d] = [low + side, low + next, first + low + side, first + low + next];
            mesh.triangles.extend([[a, c, b], [b, c, d]]);
            let [a, b, c, d] = [high + side, high + next, first + high + side, first + high + next];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
        mesh
    }

    #[test]
    fn the_lumen_of_tubes_joined_at_their_rims_is_the_inner_tube() {
        for scale in [0.1, 1.0, 1000.0] {
            let mesh = joined_tubes(scale);
            let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
            let edges = topology.edge_counts();
            assert_eq!((edges.boundary, edges.flipped), (0, 0), "the wall is closed");
            assert!(volume(&mesh, &topology) > 0.0);
            let found = find(&mesh, true);
            let wall = found.wall.expect("it is a wall");
            assert!(!wall.is_two_pieces && (wall.thickness_mm / f64::from(scale) - 1.0).abs() < 0.03, "{wall:?}");
            let lumen = found.lumen.expect("its sides can be told apart");
            assert_eq!((lumen.mesh.triangles.len(), lumen.mesh.positions.len()), (2 * 48 * 100, 48 * 101));
            assert_eq!(lumen.left_out, 2 * 48 * 100 + 4 * 48);
            let topology = Topology::new(lumen.mesh.positions.len(), &lumen.mesh.triangles);
            let ends = holes(&lumen.mesh, &topology);
            assert!(ends.len() == 2 && ends.iter().all(|end| end.opening == Opening::VesselEnd));
            // It bounds the blood: the volume of 48 sides of radius 4 and length 60, facing outwards.
            let section = 48.0 / 2.0 * 16.0 * libm::sin(std::f64::consts::TAU / 48.0);
            let part = volume(&lumen.mesh, &topology) / (60.0 * section * f64::from(scale).powi(3));
            assert!((part - 1.0).abs() < 0.01, "{part}");
        }
    }

    #[test]
    fn a_wall_of_any_thickness_comes_apart_at_the_creases_of_its_rims() {
        for scale in [0.1, 1.0, 1000.0] {
            // From 0.1 mm thick to 6 mm, by the same part from ring to ring; a wall without creases may vary by 4 times.
            let at = |part: f64| 0.1 * libm::pow(60.0, part);
            let mesh = joined_in(scale, |z| 4.0 + at(f64::from(z) / 60.0) as f32);
            let found = find(&mesh, true);
            let wall = found.wall.expect("it is a wall");
            for (found, part) in [(wall.thinner_mm, 0.1), (wall.thickness_mm, 0.5), (wall.thicker_mm, 0.9)] {
                let expected = at(part) * f64::from(scale);
                assert!((found / expected - 1.0).abs() < 0.1, "{found}, not {expected}");
            }
            let lumen = found.lumen.expect("its sides can be told apart");
            assert_eq!((lumen.mesh.triangles.len(), lumen.mesh.positions.len()), (2 * 48 * 100, 48 * 101));
            let topology = Topology::new(lumen.mesh.positions.len(), &lumen.mesh.triangles);
            let section = 48.0 / 2.0 * 16.0 * libm::sin(std::f64::consts::TAU / 48.0);
            let part = volume(&lumen.mesh, &topology) / (60.0 * section * f64::from(scale).powi(3));
            assert!((part - 1.0).abs() < 0.01, "{part}");
        }
    }

    #[test]
    fn of_two_pieces_the_inner_one_stays() {
        let (outer, inner) = (icosphere(4, 10.0, Vec3::ONE), icosphere(4, 9.8, Vec3::ONE));
        let found = find(&joined(&[outer.clone(), inner.clone()]), true);
        let wall = found.wall.expect("it is a wall");
        assert!(wall.is_two_pieces && (wall.thickness_mm - 0.2).abs() < 0.03, "{wall:?}");
        assert_eq!(found.lumen.expect("it is a piece").mesh, inner);
        let tubes = joined(&[tube(32, 40, 30.0, |_| 3.0), tube(32, 40, 30.0, |_| 3.6)]);
        assert!(find(&tubes, false).wall.is_some_and(|wall| (wall.thickness_mm - 0.6).abs() < 0.05));
    }

    #[test]
    fn a_bent_body_whose_legs_face_each_other_is_no_wall() {
        // A U of a section of 5 x 20 mm with a gap of 10 mm between its legs, of cubes of 1 mm.
        let is_in = |[x, y, z]: [i32; 3]| {
            (0..20).contains(&x) && (0..20).contains(&y) && (0..40).contains(&z) && (!(5..15).contains(&x) || z < 5)
        };
        let (mut mesh, mut numbers) = (TriMesh::default(), BTreeMap::new());
        let cells = (0..20).flat_map(|x| (0..20).flat_map(move |y| (0..40).map(move |z| [x, y, z])));
        for (cell, axis, side) in cells
            .filter(|&cell| is_in(cell))
            .flat_map(|cell| (0..6).map(move |face| (cell, face % 3, (face / 3) as i32)))
        {
            let mut beside = cell;
            beside[axis] += 2 * side - 1;
            if is_in(beside) {
                continue;
            }
            let corner = |first: i32, second: i32| {
                let mut at = cell;
                at[axis] += side;
                at[(axis + 1) % 3] += first;
                at[(axis + 2) % 3] += second;
                at
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)].map(|at| {
                *numbers.entry(at).or_insert_with(|| {
                    mesh.positions.push(Vec3::from(at.map(|x| x as f32)));
                    mesh.positions.len() as u32 - 1
                })
            });
            mesh.triangles.extend(if side == 1 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        assert!(
            topology.is_consistent() && (volume(&mesh, &topology) - (20.0 * 40.0 - 10.0 * 35.0) * 20.0).abs() < 1e-3
        );
        assert_eq!(find(&mesh, true), WallFound { wall: None, lumen: None });
    }

    #[test]
    fn bodies_beside_or_far_inside_others_have_no_wall() {
        let beside = joined(&[icosphere(3, 5.0, Vec3::ZERO), icosphere(3, 5.0, Vec3::X * 10.2)]);
        assert_eq!(find(&beside, false).wall, None);
        let within = joined(&[icosphere(3, 10.0, Vec3::ZERO), icosphere(3, 2.0, Vec3::X * 6.0)]);
        assert_eq!(find(&within, false).wall, None);
        assert_eq!(find(&tube(32, 60, 40.0, |_| 3.0), false).wall, None);
    }
}
