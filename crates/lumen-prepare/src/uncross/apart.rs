//! The gentle way: vertices move, triangles stay.
//!
//! Two ways are tried, and the one that moves less is taken. A push moves the vertices of the place along their normals,
//! those of the first ring around it by two thirds and of the second by one third, in or out, in steps: it parts two walls
//! that overlap a little. A relaxation moves the vertices of the place and of the first ring half-way to the mean of their
//! neighbours, again and again: it unfolds what is folded. Both end where nothing crosses any more, or where the wall has
//! left its place by more than [`super::SHALLOW`] of the local radius. Vertices on open edges, and on edges of more than two
//! triangles, stay.
//!
//! A place that could not be cut either goes as much of the way to a membrane over the rings around it as it takes
//! (`membrane`), but no farther than [`super::DEEP`] of the local radius or two of
//! its triangles' sides.

use glam::{DVec3, Vec3};

use lumen_mesh::crossing::Face;
use lumen_mesh::{SurfaceIndex, TriMesh, outward_normal};

use super::clusters::{Cluster, NONE, bounds};
use super::membrane::membrane;
use super::{DEEP, SHALLOW, Surface};
use crate::folds::clash;

/// Steps of a push, of a relaxation, and to a membrane.
const PUSHES: u32 = 12;
const RELAXATIONS: usize = 30;
const SPANS: u32 = 16;
/// What a vertex of the place and of the rings around it takes of a push.
const SHARES: [f64; 3] = [1.0, 2.0 / 3.0, 1.0 / 3.0];
/// Places at which the local radius is measured, at most.
const MEASURED: usize = 64;

/// A round of pushing apart.
pub(super) struct Pushing<'a> {
    surface: &'a Surface<'a>,
    /// The positions as they are now, in mm.
    pub(super) positions: Vec<Vec3>,
    /// For each triangle its place, as long as that is not mended.
    cluster_of: Vec<u32>,
    /// How far a vertex moved in this round at most, in mm.
    moved: f64,
}

/// A vertex that may move.
struct Mobile {
    vertex: u32,
    ring: usize,
    normal: DVec3,
}

/// A place while it is pushed.
struct Region {
    number: u32,
    mobile: Vec<Mobile>,
    /// The triangles of vertices that may move, ascending.
    triangles: Vec<u32>,
    /// The vertices of these triangles, ascending, and the triangles by their places in that list.
    vertices: Vec<u32>,
    local: Vec<[u32; 3]>,
    /// The local radius, and the mean length of the triangles' sides, in mm.
    radius: f64,
    edge: f64,
}

/// Where the vertices of a region go, in its order.
struct Way {
    places: Vec<Vec3>,
    moved: f64,
}

impl<'a> Pushing<'a> {
    pub(super) fn new(surface: &'a Surface, clusters: &[Cluster]) -> Self {
        let mut cluster_of = vec![NONE; surface.mesh.triangles.len()];
        for (number, cluster) in (0..).zip(clusters) {
            cluster.triangles.iter().for_each(|&t| cluster_of[t as usize] = number);
        }
        Self { surface, positions: surface.mesh.positions.clone(), cluster_of, moved: 0.0 }
    }

    /// Pushes a place apart; how far its vertices moved in mm, or `None` where that does not do.
    /// Where it `is_free`, a place that cannot be within that bound goes on its way to a membrane.
    pub(super) fn push(&mut self, number: u32, cluster: &Cluster, is_free: bool) -> Option<f64> {
        let region = self.region(number, cluster);
        let ways = [self.pushed(&region), self.relaxed(&region)];
        let free = || if is_free { self.spanned(&region) } else { None };
        let ways = if ways.iter().all(Option::is_none) { [free(), None] } else { ways };
        let way = ways.into_iter().flatten().reduce(|best, way| if way.moved < best.moved { way } else { best })?;
        for (mobile, &place) in region.mobile.iter().zip(&way.places) {
            self.positions[mobile.vertex as usize] = place;
        }
        cluster.triangles.iter().for_each(|&t| self.cluster_of[t as usize] = NONE);
        self.moved = self.moved.max(way.moved);
        Some(way.moved)
    }

    fn region(&self, number: u32, cluster: &Cluster) -> Region {
        let Surface { mesh, topology, .. } = self.surface;
        let rings = self.surface.rings(&cluster.vertices, SHARES.len());
        let is_inner = |v: u32| topology.edge_uses(v).iter().all(|edge| edge.triangles() == 2);
        let mut mobile = Vec::new();
        for (ring, vertices) in rings.iter().take(SHARES.len()).enumerate() {
            for &vertex in vertices.iter().filter(|&&v| is_inner(v)) {
                let normal = outward_normal(mesh, topology, vertex).unwrap_or(Vec3::ZERO).as_dvec3();
                mobile.push(Mobile { vertex, ring, normal });
            }
        }
        let mut triangles: Vec<u32> =
            mobile.iter().flat_map(|mobile| topology.triangles(mobile.vertex).iter().copied()).collect();
        triangles.sort_unstable();
        triangles.dedup();
        let corners = |t: &u32| mesh.triangles[*t as usize];
        let mut vertices: Vec<u32> = triangles.iter().flat_map(corners).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let place = |v: u32| vertices.partition_point(|&other| other < v) as u32;
        let local = triangles.iter().map(|t| corners(t).map(place)).collect();
        let radius = self.radius(rings.iter().rev().find(|ring| !ring.is_empty()).map_or(&[][..], |ring| ring));
        let around = triangles.iter().map(|&t| {
            let [a, b, c] = mesh.corners(t as usize);
            f64::from(a.distance(b)) + f64::from(b.distance(c)) + f64::from(c.distance(a))
        });
        let edge = around.sum::<f64>() / (3 * triangles.len()).max(1) as f64;
        Region { number, mobile, triangles, vertices, local, radius, edge }
    }

    /// The radius of the lumen in mm: the middle one of the inner balls at some of `vertices`; without one, half of how far
    /// these lie apart.
    fn radius(&self, vertices: &[u32]) -> f64 {
        let Surface { mesh, topology, index, bounds } = self.surface;
        let reach = bounds.diagonal();
        let some = vertices.iter().step_by(vertices.len().div_ceil(MEASURED).max(1));
        let ball = |&v: &u32| index.inner_ball(mesh.positions[v as usize], outward_normal(mesh, topology, v)?, reach);
        let mut radii: Vec<f32> = some.filter_map(ball).map(|ball| ball.radius).collect();
        radii.sort_by(f32::total_cmp);
        if let Some(&radius) = radii.get(radii.len() / 2) {
            return f64::from(radius);
        }
        let points = vertices.iter().map(|&v| mesh.positions[v as usize]);
        let (low, high) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        if vertices.is_empty() { 0.0 } else { f64::from((high - low).length()) / 2.0 }
    }

    /// The least push that parts the walls.
    fn pushed(&self, region: &Region) -> Option<Way> {
        (1..=PUSHES).flat_map(|step| [(step, -1.0), (step, 1.0)]).find_map(|(step, sign)| {
            let depth = SHALLOW * region.radius * f64::from(step) / f64::from(PUSHES);
            let place = |mobile: &Mobile| {
                let at = self.positions[mobile.vertex as usize].as_dvec3();
                (at + mobile.normal * (sign * depth * SHARES[mobile.ring])).as_vec3()
            };
            let places: Vec<Vec3> = region.mobile.iter().map(place).collect();
            (!self.crosses(region, &places)).then(|| self.way(region, places))
        })
    }

    /// The first relaxation that unfolds the place.
    fn relaxed(&self, region: &Region) -> Option<Way> {
        let Surface { topology, index, .. } = self.surface;
        let mut slot = region.mobile.iter().map(|mobile| mobile.vertex).zip(0usize..).collect::<Vec<_>>();
        slot.sort_unstable();
        let mut at: Vec<DVec3> =
            region.mobile.iter().map(|mobile| self.positions[mobile.vertex as usize].as_dvec3()).collect();
        let first = at.clone();
        let where_is = |at: &[DVec3], v: u32| match slot.binary_search_by_key(&v, |&(vertex, _)| vertex) {
            Ok(found) => at[slot[found].1],
            Err(_) => self.positions[v as usize].as_dvec3(),
        };
        let limit = SHALLOW * region.radius;
        for _ in 0..RELAXATIONS {
            let half_way = |(mobile, p): (&Mobile, &DVec3)| {
                let around = topology.neighbours(mobile.vertex);
                if mobile.ring > 1 || around.is_empty() {
                    return *p;
                }
                let sum: DVec3 = around.iter().map(|&v| where_is(&at, v)).sum();
                p.midpoint(sum / around.len() as f64)
            };
            at = region.mobile.iter().zip(&at).map(half_way).collect();
            let places: Vec<Vec3> = at.iter().map(|p| p.as_vec3()).collect();
            let is_near = |p: &Vec3| index.nearest(*p).is_some_and(|near| f64::from(near.distance) <= limit);
            let is_beyond = || at.iter().zip(&first).any(|(p, q)| p.distance(*q) > region.edge);
            if is_beyond() || !places.iter().all(is_near) {
                return None;
            }
            if !self.crosses(region, &places) {
                let sheet = self.sheet(region, &places);
                let wall = SurfaceIndex::new(&sheet.positions, &sheet.triangles);
                let is_near =
                    |p: &DVec3| wall.nearest(p.as_vec3()).is_some_and(|near| f64::from(near.distance) <= limit);
                return first.iter().all(is_near).then(|| self.way(region, places));
            }
        }
        None
    }

    /// The least part of the way to a membrane that parts the walls.
    fn spanned(&self, region: &Region) -> Option<Way> {
        let first: Vec<DVec3> =
            region.mobile.iter().map(|mobile| self.positions[mobile.vertex as usize].as_dvec3()).collect();
        let inner: Vec<u32> =
            region.mobile.iter().filter(|mobile| mobile.ring < 2).map(|mobile| mobile.vertex).collect();
        let membrane = membrane(&self.surface.topology, &self.positions, &inner);
        // Those of the second ring stay; they stand last.
        let ends: Vec<DVec3> = membrane.into_iter().chain(first.iter().skip(inner.len()).copied()).collect();
        let limit = (DEEP * region.radius).max(2.0 * region.edge);
        let way = (1..=SPANS).find_map(|step| {
            let part = f64::from(step) / f64::from(SPANS);
            let places: Vec<Vec3> = first.iter().zip(&ends).map(|(from, to)| from.lerp(*to, part).as_vec3()).collect();
            (!self.crosses(region, &places)).then(|| self.way(region, places))
        });
        way.filter(|way| way.moved <= limit)
    }

    fn way(&self, region: &Region, places: Vec<Vec3>) -> Way {
        let from = |mobile: &Mobile| self.positions[mobile.vertex as usize];
        let ways = region.mobile.iter().zip(&places).map(|(mobile, place)| f64::from(from(mobile).distance(*place)));
        Way { moved: ways.fold(0.0, f64::max), places }
    }

    /// The triangles of a region with its vertices at `places`.
    fn sheet(&self, region: &Region, places: &[Vec3]) -> TriMesh {
        let mut positions: Vec<Vec3> = region.vertices.iter().map(|&v| self.positions[v as usize]).collect();
        for (mobile, &place) in region.mobile.iter().zip(places) {
            if let Ok(at) = region.vertices.binary_search(&mobile.vertex) {
                positions[at] = place;
            }
        }
        TriMesh { positions, triangles: region.local.clone() }
    }

    /// Whether a triangle of a region crosses another once its vertices are at `places`. What is of another place that is not
    /// mended does not count. Places that are not finite, as the normals of 1e30 mm make them, are none to go to.
    fn crosses(&self, region: &Region, places: &[Vec3]) -> bool {
        let Surface { mesh, index, .. } = self.surface;
        if !places.iter().all(|p| p.is_finite()) {
            return true;
        }
        let sheet = self.sheet(region, places);
        let own = SurfaceIndex::new(&sheet.positions, &sheet.triangles);
        let is_foreign = |t: u32| ![NONE, region.number].contains(&self.cluster_of[t as usize]);
        let margin = Vec3::splat(self.moved as f32);
        (0..).zip(&region.triangles).any(|(number, &t)| {
            if is_foreign(t) {
                return false;
            }
            let corners = sheet.corners(number as usize);
            let (low, high) = bounds(corners);
            let face = Face { vertices: mesh.triangles[t as usize], corners };
            let mut does = false;
            own.for_each_near(low, high, |other| {
                let of_mesh = region.triangles[other as usize];
                if other > number && !does && !is_foreign(of_mesh) {
                    let vertices = mesh.triangles[of_mesh as usize];
                    does = clash(&face, &Face { vertices, corners: sheet.corners(other as usize) });
                }
            });
            index.for_each_near(low - margin, high + margin, |other| {
                if !does && !is_foreign(other) && region.triangles.binary_search(&other).is_err() {
                    let vertices = mesh.triangles[other as usize];
                    does = clash(&face, &Face { vertices, corners: vertices.map(|v| self.positions[v as usize]) });
                }
            });
            does
        })
    }
}

impl Surface<'_> {
    /// `vertices`, ascending, then those one edge away, then those two, up to `rings`; each ascending.
    pub(super) fn rings(&self, vertices: &[u32], rings: usize) -> Vec<Vec<u32>> {
        let mut found = vec![vertices.to_vec()];
        let mut all = vertices.to_vec();
        for _ in 0..rings {
            let last = found.last().map_or(&[][..], |ring| ring);
            let mut ring: Vec<u32> = last.iter().flat_map(|&v| self.topology.neighbours(v).iter().copied()).collect();
            ring.sort_unstable();
            ring.dedup();
            ring.retain(|v| all.binary_search(v).is_err());
            all.extend(&ring);
            all.sort_unstable();
            found.push(ring);
        }
        found
    }
}
