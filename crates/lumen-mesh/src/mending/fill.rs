//! Filling: a patch over each hole that is small enough.
//!
//! The way of Liepa, "Filling holes in meshes" (2003): the triangles over the rim that bend least (`triangulate`), made as
//! small as those around (`refine`), and moved so that the patch goes on as the wall does (`fair`). A patch that would run
//! into the surface, into another patch or into itself, or would fold, is taken less far: as a membrane, then as the first
//! triangles alone; where these cross too, the hole stays, and is counted.
//!
//! Ends of vessels and outer edges of sheets are never filled. Rims that cannot be triangulated stay too: of more than
//! [`LONGEST`] edges, or whose vertices are joined across already.

use glam::{DVec3, Vec3};

use super::fair;
use super::holes::{Hole, Opening, behind, edges, holes};
use super::patch_mesh::Patch;
use super::refine::refine;
pub use super::triangulate::LONGEST;
use super::triangulate::triangulate;
use crate::crossing::{Face, cross};
use crate::task::{Yielder, at_once};
use crate::{Blend, SurfaceIndex, Topology, TriMesh};

/// What is new is made of so many vertices or triangles of the rim.
const SOURCES: usize = 4;
/// A patch folds where it bends by more than 120 degrees, unless its first triangles did.
const FOLD: f64 = 1.5;

/// A surface whose holes were filled.
#[derive(Clone, Debug, PartialEq)]
pub struct Filled {
    /// The surface: its first vertices and triangles are those of before.
    pub mesh: TriMesh,
    /// What each vertex was made of: a new one of those of its hole's rim, the nearer the more.
    pub vertices: Blend,
    /// What each triangle was made of: a new one of those along the rim, the nearer the more.
    pub triangles: Blend,
    /// Holes that were filled.
    pub filled: usize,
    /// Holes within the limit that could not be.
    pub left: usize,
}

/// Fills the holes of `mesh` that are at most `limit` mm across.
pub fn fill(mesh: &TriMesh, limit: f64) -> Filled {
    at_once(fill_in_slices(mesh, limit, &Yielder::never()))
}

/// As [`fill`], resting between the holes, and while a large one is triangulated. A patch is one piece.
pub async fn fill_in_slices(mesh: &TriMesh, limit: f64, yielder: &Yielder) -> Filled {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let mut holes = holes(mesh, &topology);
    holes.retain(|hole| hole.opening == Opening::Hole && hole.diameter_mm <= limit);
    let index = if holes.is_empty() {
        SurfaceIndex::default()
    } else {
        SurfaceIndex::build(&mesh.positions, &mesh.triangles, &yielder.part(0.0..0.3)).await
    };
    let mut filling = Filling { mesh, topology, index, done: Vec::new() };
    for (number, hole) in holes.iter().enumerate() {
        let part = yielder.part(0.3..1.0);
        let [begun, end] = [number, number + 1].map(|number| number as f32 / holes.len() as f32);
        let triangles = filling.triangles(&hole.rim, &part.part(begun..end)).await;
        let patch = triangles.and_then(|triangles| filling.patch(&hole.rim, triangles));
        filling.done.extend(patch.map(|patch| Done { hole: number, ..patch }));
        part.rest(end).await;
    }
    filling.result(&holes)
}

/// A surface while its holes are filled.
struct Filling<'a> {
    mesh: &'a TriMesh,
    topology: Topology,
    /// Of the surface, where there is a hole to fill.
    index: SurfaceIndex,
    done: Vec<Done>,
}

/// A patch in its place.
#[derive(Debug)]
struct Done {
    hole: usize,
    /// Of its own vertices, in mm.
    points: Vec<Vec3>,
    /// Over the vertices of the surface and, from their number on, its own.
    triangles: Vec<[u32; 3]>,
    index: SurfaceIndex,
    low: Vec3,
    high: Vec3,
}

impl Filling<'_> {
    /// The first triangles over a hole.
    async fn triangles(&self, rim: &[u32], yielder: &Yielder) -> Option<Vec<[u32; 3]>> {
        if rim.len() > LONGEST {
            return None;
        }
        let Self { mesh, topology, .. } = self;
        let normal = |(a, b)| {
            let corners = behind(mesh, topology, a, b).map(|(t, _)| mesh.corners(t as usize).map(Vec3::as_dvec3));
            corners.map_or(DVec3::ZERO, |[a, b, c]| (b - a).cross(c - a).normalize_or_zero())
        };
        let behind: Vec<DVec3> = edges(rim).map(normal).collect();
        triangulate(points(mesh, rim), behind, chords(topology, rim), yielder).await
    }

    /// The patch over a hole that begins with `triangles`, if one crosses nothing.
    fn patch(&self, rim: &[u32], triangles: Vec<[u32; 3]>) -> Option<Done> {
        let mesh = self.mesh;
        let taken = chords(&self.topology, rim);
        let is_taken = |a: u32, b: u32| taken.binary_search(&[a.min(b), a.max(b)]).is_ok();
        let first = Patch::new(points(mesh, rim), triangles);
        let at = |v: u32| mesh.positions[v as usize].as_dvec3() - origin(mesh, rim);
        let lengths: Vec<f64> = rim
            .iter()
            .map(|&v| {
                let around = self.topology.neighbours(v);
                around.iter().map(|&w| at(w).distance(at(v))).sum::<f64>() / around.len() as f64
            })
            .collect();
        let mut sorted = rim.to_vec();
        sorted.sort_unstable();
        let beyond: Vec<Vec<DVec3>> = rim
            .iter()
            .map(|&v| {
                let outer = self.topology.neighbours(v).iter().filter(|w| sorted.binary_search(w).is_err());
                outer.map(|&w| at(w)).collect()
            })
            .collect();
        let mut fine = first.clone();
        refine(&mut fine, &lengths, is_taken);
        let mut membrane = fine.clone();
        fair::relax(&mut membrane);
        let mut plate = membrane.clone();
        fair::fair(&mut plate, &beyond);
        let bend = first.sharpest().max(FOLD);
        [plate, membrane].into_iter().filter(|patch| patch.sharpest() <= bend).chain([first]).find_map(|patch| {
            let done = self.placed(rim, &patch)?;
            (!self.crosses(&done)).then_some(done)
        })
    }

    /// The patch among the vertices of the surface.
    fn placed(&self, rim: &[u32], patch: &Patch) -> Option<Done> {
        let mesh = self.mesh;
        let (origin, count) = (origin(mesh, rim), mesh.positions.len() as u32);
        let points: Vec<Vec3> = patch.points[patch.rim..].iter().map(|p| (*p + origin).as_vec3()).collect();
        let own = |v: u32| if (v as usize) < patch.rim { rim[v as usize] } else { count + v - patch.rim as u32 };
        let triangles: Vec<[u32; 3]> = patch.triangles.iter().map(|t| t.map(own)).collect();
        let corners: Vec<[Vec3; 3]> = triangles.iter().map(|&t| corners(mesh, &points, t)).collect();
        let flat = (0..corners.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect::<Vec<_>>();
        let index = SurfaceIndex::new(corners.as_flattened(), &flat);
        let (low, high) = corners
            .as_flattened()
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
        (low.is_finite() && high.is_finite()).then_some(Done { hole: 0, points, triangles, index, low, high })
    }

    /// Whether a patch runs into the surface, into itself or into one that is in its place.
    fn crosses(&self, new: &Done) -> bool {
        let (mesh, surface) = (self.mesh, &self.index);
        let near: Vec<&Done> =
            self.done.iter().filter(|done| done.low.cmple(new.high).all() && done.high.cmpge(new.low).all()).collect();
        (0..).zip(&new.triangles).any(|(number, &triangle)| {
            let corners = self::corners(mesh, &new.points, triangle);
            let face = Face { vertices: triangle, corners };
            let (low, high) = (corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2]));
            let mut does = false;
            surface.for_each_near(low, high, |t| {
                let other = Face { vertices: mesh.triangles[t as usize], corners: mesh.corners(t as usize) };
                does |= cross(&face, &other);
            });
            new.index.for_each_near(low, high, |t| {
                let vertices = new.triangles[t as usize];
                let other = Face { vertices, corners: self::corners(mesh, &new.points, vertices) };
                does |= t > number && cross(&face, &other);
            });
            // Vertices that are new have the same numbers in every patch: they are told apart by a shift.
            let foreign = face.vertices.map(|v| if (v as usize) < mesh.positions.len() { v } else { u32::MAX - v });
            for done in &near {
                done.index.for_each_near(low, high, |t| {
                    let vertices = done.triangles[t as usize];
                    let other = Face { vertices, corners: self::corners(mesh, &done.points, vertices) };
                    does |= cross(&Face { vertices: foreign, corners }, &other);
                });
            }
            does
        })
    }

    /// The surface with its patches.
    fn result(&self, holes: &[Hole]) -> Filled {
        let Self { mesh, done, .. } = self;
        let mut filled = (*mesh).clone();
        let (mut new_vertices, mut new_triangles) = (Vec::new(), Vec::new());
        for Done { hole, points, triangles, .. } in done {
            let rim = &holes[*hole].rim;
            let shift = filled.positions.len() as u32 - mesh.positions.len() as u32;
            let along: Vec<(u32, Vec3)> = edges(rim)
                .filter_map(|(a, b)| {
                    let (t, _) = behind(mesh, &self.topology, a, b)?;
                    Some((t, mesh.positions[a as usize].midpoint(mesh.positions[b as usize])))
                })
                .collect();
            let around: Vec<(u32, Vec3)> = rim.iter().map(|&v| (v, mesh.positions[v as usize])).collect();
            new_vertices.extend(points.iter().map(|&p| nearer(&around, p)));
            for &t in triangles {
                let [a, b, c] = corners(mesh, points, t);
                new_triangles.push(nearer(&along, (a + b + c) / 3.0));
                filled.triangles.push(t.map(|v| if (v as usize) < mesh.positions.len() { v } else { v + shift }));
            }
            filled.positions.extend(points);
        }
        Filled {
            vertices: Blend::of_rows(0..mesh.positions.len() as u32).followed_by(&new_vertices),
            triangles: Blend::of_rows(0..mesh.triangles.len() as u32).followed_by(&new_triangles),
            mesh: filled,
            filled: done.len(),
            left: holes.len() - done.len(),
        }
    }
}

/// Where a rim's numbers are near zero.
fn origin(mesh: &TriMesh, rim: &[u32]) -> DVec3 {
    mesh.positions[rim[0] as usize].as_dvec3()
}

/// The places of a rim's vertices from its origin on.
fn points(mesh: &TriMesh, rim: &[u32]) -> Vec<DVec3> {
    let origin = origin(mesh, rim);
    rim.iter().map(|&v| mesh.positions[v as usize].as_dvec3() - origin).collect()
}

/// The corners of a triangle of the surface, and from its number of vertices on of a patch.
fn corners(mesh: &TriMesh, points: &[Vec3], triangle: [u32; 3]) -> [Vec3; 3] {
    let count = mesh.positions.len();
    triangle.map(|v| mesh.positions.get(v as usize).copied().unwrap_or_else(|| points[v as usize - count]))
}

/// Pairs of a rim's vertices, by their place in it, that have an edge besides the rim's own.
fn chords(topology: &Topology, rim: &[u32]) -> Vec<[u32; 2]> {
    let mut place: Vec<(u32, u32)> = rim.iter().copied().zip(0..).collect();
    place.sort_unstable();
    let last = rim.len() as u32 - 1;
    let mut chords = Vec::new();
    for (i, &v) in (0u32..).zip(rim) {
        for w in topology.neighbours(v) {
            let Ok(at) = place.binary_search_by_key(w, |&(vertex, _)| vertex) else { continue };
            let (low, high) = (i.min(place[at].1), i.max(place[at].1));
            if i == low && high - low > 1 && (low, high) != (0, last) {
                chords.push([low, high]);
            }
        }
    }
    chords.sort_unstable();
    chords
}

/// The rows nearest to `p`, with weights by the inverse square of their distance.
fn nearer(rows: &[(u32, Vec3)], p: Vec3) -> Vec<(u32, f32)> {
    let mut near: Vec<(f32, u32)> = rows.iter().map(|&(row, at)| (at.distance_squared(p), row)).collect();
    near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    near.truncate(SOURCES);
    let least = near.first().map_or(0.0, |&(squared, _)| squared);
    // The nearest has weight 1; one at the place itself is the only one.
    near.iter().map(|&(squared, row)| (row, if squared > 0.0 { least / squared } else { 1.0 })).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::holes::tests::{found, pierced};
    use super::*;
    use crate::self_intersections;
    use crate::shapes::{icosphere, square, tube};

    fn is_closed_but_for(mesh: &TriMesh, open: usize) -> bool {
        let edges = Topology::new(mesh.positions.len(), &mesh.triangles).edge_counts();
        (edges.boundary, edges.non_manifold, edges.flipped) == (open, 0, 0)
    }

    #[test]
    fn the_patch_over_a_hole_in_a_sphere_lies_on_the_sphere() {
        for scale in [0.1, 1.0, 1000.0] {
            let sphere = icosphere(5, 10.0 * scale, Vec3::splat(50.0 * scale));
            let open = pierced(&sphere, &[Vec3::splat(50.0 * scale) + Vec3::X * 10.0 * scale], 3.0 * scale);
            let found = fill(&open, 8.0 * f64::from(scale));
            assert_eq!((found.filled, found.left), (1, 0));
            assert!(is_closed_but_for(&found.mesh, 0));
            assert!(self_intersections(&found.mesh).is_empty());
            let patch = &found.mesh.positions[open.positions.len()..];
            let height = |p: &Vec3| p.distance(Vec3::splat(50.0 * scale)) / scale;
            let (low, high) = patch.iter().map(height).fold((f32::MAX, f32::MIN), |(l, h), x| (l.min(x), h.max(x)));
            // A flat lid would lie 0.46 below; the umbrella of even weights is off by a few hundredths.
            assert!(low > 9.93 && high < 10.07, "{low} to {high}");
            // As small as around: the hole had as many triangles.
            let (before, now) =
                (sphere.triangles.len() - open.triangles.len(), found.mesh.triangles.len() - open.triangles.len());
            assert!((0.5..2.0).contains(&(now as f64 / before as f64)), "{now} in place of {before}");
        }
    }

    #[test]
    fn holes_above_the_limit_ends_of_vessels_and_edges_of_sheets_stay() {
        let tube = tube(48, 120, 60.0, |_| 4.0);
        let open = pierced(&pierced(&tube, &[Vec3::new(4.0, 0.0, 15.0)], 1.0), &[Vec3::new(4.0, 0.0, 40.0)], 2.5);
        let sizes: Vec<f64> = found(&open).iter().map(|hole| hole.diameter_mm).collect();
        let filled = fill(&open, 4.0);
        assert_eq!((filled.filled, filled.left), (1, 0), "{sizes:?}");
        let left = found(&filled.mesh);
        let holes: Vec<_> = left.iter().filter(|hole| hole.opening == Opening::Hole).collect();
        assert!(left.len() == 3 && holes.len() == 1 && holes[0].diameter_mm > 4.0);
        assert_eq!(fill(&square(8, 1.0, 0.0), 100.0).filled, 0);
        assert_eq!(fill(&tube, 100.0).mesh, tube);
    }

    #[test]
    fn a_patch_that_would_run_through_another_wall_is_not_made() {
        // A plate with a hole of 2 mm, not quite level, and a needle that stands in it.
        let mut plate = pierced(&square(40, 10.0, 0.0), &[Vec3::new(5.0, 5.0, 0.0)], 1.0);
        plate.positions.iter_mut().for_each(|p| p.z = 0.1 * (p.x - 5.0) + 0.07 * (p.y - 5.0));
        let needle = tube(8, 20, 6.0, |_| 0.2);
        let shift = needle.positions.iter().map(|p| *p + Vec3::new(5.0, 5.0, -3.0));
        let first = plate.positions.len() as u32;
        let both = TriMesh {
            positions: plate.positions.iter().copied().chain(shift).collect(),
            triangles: plate
                .triangles
                .iter()
                .copied()
                .chain(needle.triangles.iter().map(|t| t.map(|v| v + first)))
                .collect(),
        };
        let found = fill(&both, 5.0);
        assert_eq!((found.filled, found.left), (0, 1));
        assert!(found.mesh == both);
    }

    #[test]
    fn new_vertices_are_made_of_the_rim() {
        let sphere = icosphere(4, 10.0, Vec3::ZERO);
        let open = pierced(&sphere, &[Vec3::X * 10.0], 3.0);
        let filled = fill(&open, 10.0);
        let hole = &found(&open)[0];
        assert_eq!(
            (filled.vertices.len(), filled.triangles.len()),
            (filled.mesh.positions.len(), filled.mesh.triangles.len())
        );
        for row in open.positions.len()..filled.mesh.positions.len() {
            assert!(filled.vertices.sources(row).iter().all(|(source, _)| hole.rim.contains(source)));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn no_hole_below_the_limit_is_left_and_nothing_new_crosses(
            places in prop::collection::vec((3.0f32..37.0, 0.0f32..std::f32::consts::TAU), 1..6),
            radius in 0.3f32..1.6,
            scale in prop::sample::select(vec![0.1f32, 1.0, 1000.0]),
        ) {
            let tube = tube(40, 100, 40.0 * scale, |z| (3.0 + libm::sinf(z / scale / 5.0)) * scale);
            let middles: Vec<Vec3> = places
                .iter()
                .map(|&(z, angle)| {
                    let r = 3.0 + libm::sinf(z / 5.0);
                    Vec3::new(r * libm::cosf(angle), r * libm::sinf(angle), z) * scale
                })
                .collect();
            let open = pierced(&tube, &middles, radius * scale);
            let limit = 3.0 * f64::from(scale);
            let filled = fill(&open, limit);
            prop_assert_eq!(filled.left, 0);
            let left = found(&filled.mesh);
            prop_assert!(left.iter().all(|hole| hole.opening != Opening::Hole || hole.diameter_mm > limit));
            prop_assert!(self_intersections(&filled.mesh).is_empty());
            prop_assert!(Topology::new(filled.mesh.positions.len(), &filled.mesh.triangles).is_consistent());
        }
    }
}
