//! A surface cut at planes, each of which cuts one vessel and no other.
//!
//! Of the outlines in which a plane meets the surface, the smallest closed one around the plane's centre is the vessel's.
//! Only the edges that this outline passes are cut. A vertex within a tenth of such an edge from the plane is moved along
//! the edge into the plane, unless a triangle around it would fold or two parts of the outline would meet in it; the
//! other edges get a new vertex in the plane. What lies beyond is found by a flood fill from the outline along the normal,
//! and removed.
//!
//! New vertices lie in the plane up to the rounding of coordinates to single precision. The surface need not be closed or
//! free of self-intersections; only the edges that the outline passes must have two triangles.

use std::collections::VecDeque;

use glam::DVec3;
use lumen_mesh::cut::Outline;
use lumen_mesh::{Topology, TriMesh, triangle_area, used_vertices};
use thiserror::Error;

use crate::ends::{EndPlane, OpenEnd, RimError, SurfaceError, check_surface, forwards, names};

/// A vertex nearer to the plane than this part of an edge that the outline passes is moved into it.
const SNAP: f64 = 0.1;
/// A vertex is not moved where a triangle would turn by more than about 60 degrees.
const TURN: f64 = 0.5;
/// A vertex is not moved where a triangle would keep less than this part of its area.
const SHRINK: f64 = 0.02;
/// New vertices on neighbouring edges nearer to each other than this part of these are one.
const MERGE: f64 = 1e-3;
/// The largest part of the surface's area that one plane may remove.
const MOST: f64 = 0.5;

/// Why a surface cannot be cut. Ends count from 1 in the texts, from 0 in the fields.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ClipError {
    /// The surface is broken.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A plane has a number that is not finite, or a normal that is not of length 1.
    #[error("the plane of end {} has no finite centre or no unit normal", end + 1)]
    Plane {
        /// The place of the plane.
        end: usize,
    },
    /// No outline goes around the plane's centre.
    #[error("the plane of end {} does not cut the surface around its centre", end + 1)]
    NoOutline {
        /// The place of the plane.
        end: usize,
    },
    /// Outlines near the centre run into the surface's border.
    #[error("the outline of end {} is not closed: it runs into the border of the surface", end + 1)]
    Open {
        /// The place of the plane.
        end: usize,
    },
    /// An edge on the outline has more than two triangles.
    #[error("the outline of end {} passes an edge with more than two triangles", end + 1)]
    NonManifold {
        /// The place of the plane.
        end: usize,
    },
    /// The outline passes too few edges to be a loop.
    #[error("the outline of end {} passes too few triangles to become an open end", end + 1)]
    TooCoarse {
        /// The place of the plane.
        end: usize,
    },
    /// What lies beyond is connected with what lies before.
    #[error("the plane of end {} does not separate anything: the surface beyond it leads around to the other side", end + 1)]
    NotSeparating {
        /// The place of the plane.
        end: usize,
    },
    /// Another end would be removed.
    #[error("the plane of end {} would cut off end {}", end + 1, other + 1)]
    OtherEnd {
        /// The place of the plane.
        end: usize,
        /// The end that would go.
        other: usize,
    },
    /// Most of the surface would be removed.
    #[error("the plane of end {} would remove {:.0} % of the surface", end + 1, part * 100.0)]
    MostOfSurface {
        /// The place of the plane.
        end: usize,
        /// The part of the area, 0 to 1.
        part: f64,
    },
    /// The cut is no open end.
    #[error(transparent)]
    Rim(#[from] RimError),
}

impl ClipError {
    /// The place of the plane that cannot be cut at, where it is that of one plane.
    pub fn end(&self) -> Option<usize> {
        match self {
            Self::Plane { end }
            | Self::NoOutline { end }
            | Self::Open { end }
            | Self::NonManifold { end }
            | Self::TooCoarse { end }
            | Self::NotSeparating { end }
            | Self::OtherEnd { end, .. }
            | Self::MostOfSurface { end, .. } => Some(*end),
            Self::Surface(_) | Self::Rim(_) => None,
        }
    }
}

/// What a plane removed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Removed {
    /// Triangles, and parts of such as were cut.
    pub triangles: usize,
    /// Their area in mm2.
    pub area_mm2: f64,
}

/// A surface that was cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Clipped {
    /// The surface. What is left keeps its order, and vertices that no outline touches keep their coordinates.
    pub mesh: TriMesh,
    /// The open end at each plane, in their order, named by the planes' radii.
    pub ends: Vec<OpenEnd>,
    /// What each plane removed.
    pub removed: Vec<Removed>,
    /// For each triangle the one of the surface before that it is, or is a part of.
    pub from: Vec<u32>,
}

/// Cuts `mesh` at each plane.
///
/// # Errors
/// [`ClipError`], where a plane does not cut one vessel off in a closed outline. Nothing is cut then.
pub fn clip(mesh: &TriMesh, planes: &[EndPlane]) -> Result<Clipped, ClipError> {
    check_surface(mesh)?;
    for (end, plane) in planes.iter().enumerate() {
        let is_unit = (plane.normal.length() - 1.0).abs() < 1e-6;
        if !plane.centre.is_finite() || !plane.normal.is_finite() || !is_unit {
            return Err(ClipError::Plane { end });
        }
    }
    let mut work = Work {
        mesh: mesh.clone(),
        from: (0..mesh.triangles.len() as u32).collect(),
        total: lumen_mesh::surface_area(mesh),
        crossed: Vec::with_capacity(planes.len()),
    };
    for (end, plane) in planes.iter().enumerate() {
        let mut crossed: Vec<u32> = work.trace(end, plane)?.iter().map(|passage| passage.triangle).collect();
        crossed.sort_unstable();
        work.crossed.push(crossed);
    }
    let (mut rims, mut removed) = (Vec::new(), Vec::new());
    for (end, plane) in planes.iter().enumerate() {
        let (rim, gone) = work.cut(end, plane)?;
        rims.push(rim);
        removed.push(gone);
    }
    let radii: Vec<f64> = planes.iter().map(|plane| plane.radius_mm).collect();
    let used = used_vertices(work.mesh.positions.len(), &work.mesh.triangles);
    let new_number = |v: u32| used.binary_search(&v).map_or(u32::MAX, |at| at as u32);
    let mesh = TriMesh {
        positions: used.iter().map(|&v| work.mesh.positions[v as usize]).collect(),
        triangles: work.mesh.triangles.iter().map(|t| t.map(new_number)).collect(),
    };
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let mut ends = Vec::with_capacity(rims.len());
    for (rim, (kind, name)) in rims.into_iter().zip(names(&radii)) {
        let mut rim: Vec<u32> = rim.into_iter().map(new_number).collect();
        if rim.iter().all(|&v| v != u32::MAX) && forwards(&mesh, &topology, &rim) < 0.0 {
            rim.reverse();
        }
        ends.push(OpenEnd::new(&mesh, &topology, rim, name, kind)?);
    }
    Ok(Clipped { mesh, ends, removed, from: work.from })
}

/// A triangle that an outline passes.
struct Passage {
    triangle: u32,
    /// The edges by which it comes in and goes out, the lesser vertex first.
    edges: [[u32; 2]; 2],
}

/// A surface while it is cut.
struct Work {
    mesh: TriMesh,
    /// The triangle of the surface before that each triangle comes from.
    from: Vec<u32>,
    /// The area of the surface before, in mm2.
    total: f64,
    /// The triangles of the surface before that each plane's outline passes, ascending.
    crossed: Vec<Vec<u32>>,
}

impl Work {
    fn at(&self, v: u32) -> DVec3 {
        self.mesh.positions[v as usize].as_dvec3()
    }

    fn height(&self, plane: &EndPlane, v: u32) -> f64 {
        (self.at(v) - plane.centre).dot(plane.normal)
    }

    /// How far along an edge the plane is, from its first vertex.
    fn part(&self, plane: &EndPlane, [a, b]: [u32; 2]) -> f64 {
        let [from, to] = [a, b].map(|v| self.height(plane, v));
        if from == to { 0.0 } else { (from / (from - to)).clamp(0.0, 1.0) }
    }

    fn crossing(&self, plane: &EndPlane, edge: [u32; 2]) -> DVec3 {
        self.at(edge[0]).lerp(self.at(edge[1]), self.part(plane, edge))
    }

    /// The outline of a plane's vessel, from triangle to triangle.
    fn trace(&self, end: usize, plane: &EndPlane) -> Result<Vec<Passage>, ClipError> {
        let is_beyond: Vec<bool> =
            (0..self.mesh.positions.len() as u32).map(|v| self.height(plane, v) >= 0.0).collect();
        let passage = |(number, triangle): (usize, &[u32; 3])| {
            let [a, b, c] = *triangle;
            let crossed = |[a, b]: &[u32; 2]| is_beyond[*a as usize] != is_beyond[*b as usize];
            let mut edges =
                [[a.min(b), a.max(b)], [b.min(c), b.max(c)], [c.min(a), c.max(a)]].into_iter().filter(crossed);
            Some(Passage { triangle: number as u32, edges: [edges.next()?, edges.next()?] })
        };
        let passages: Vec<Passage> = self.mesh.triangles.iter().enumerate().filter_map(passage).collect();
        let ends = |(i, passage): (usize, &Passage)| passage.edges.map(|edge| (edge, i));
        let mut by_edge: Vec<([u32; 2], usize)> = passages.iter().enumerate().flat_map(ends).collect();
        by_edge.sort_unstable();
        let on = |edge: [u32; 2]| {
            let first = by_edge.partition_point(|end| end.0 < edge);
            by_edge[first..].iter().take_while(move |end| end.0 == edge).map(|end| end.1)
        };
        let mut is_left = vec![true; passages.len()];
        let mut best: Option<(f64, Vec<Passage>)> = None;
        let (mut is_open, mut is_branching) = (false, false);
        for start in 0..passages.len() {
            if !is_left[start] {
                continue;
            }
            let (mut i, mut into) = (start, passages[start].edges[0]);
            let mut walk = Vec::new();
            let mut branches = false;
            let is_closed = loop {
                is_left[i] = false;
                let [one, other] = passages[i].edges;
                let out = if one == into { other } else { one };
                walk.push(Passage { triangle: passages[i].triangle, edges: [into, out] });
                branches |= on(out).count() > 2;
                match on(out).find(|&next| is_left[next]) {
                    Some(next) => (i, into) = (next, out),
                    None => break out == walk[0].edges[0],
                }
            };
            let points = walk.iter().map(|passage| self.crossing(plane, passage.edges[0])).collect();
            let outline = Outline { points, is_closed };
            if !is_closed {
                is_open |= outline.points.iter().any(|p| p.distance(plane.centre) <= 1.5 * plane.radius_mm);
                continue;
            }
            let area = outline.area(plane.normal).abs();
            let is_smaller = best.as_ref().is_none_or(|(least, _)| area < *least);
            if is_smaller && outline.winding(plane.centre, plane.normal) != 0 {
                is_branching = branches;
                best = Some((area, walk));
            }
        }
        match best {
            Some(_) if is_branching => Err(ClipError::NonManifold { end }),
            Some((_, walk)) => Ok(walk),
            None if is_open => Err(ClipError::Open { end }),
            None => Err(ClipError::NoOutline { end }),
        }
    }

    /// Cuts the vessel of one plane; the vertices around the cut, and what was removed.
    fn cut(&mut self, end: usize, plane: &EndPlane) -> Result<(Vec<u32>, Removed), ClipError> {
        let walk = self.trace(end, plane)?;
        let is_beyond: Vec<bool> =
            (0..self.mesh.positions.len() as u32).map(|v| self.height(plane, v) >= 0.0).collect();
        let crossings: Vec<DVec3> = walk.iter().map(|passage| self.crossing(plane, passage.edges[0])).collect();
        let snapped = self.snap(plane, &walk, &is_beyond);
        let snapped_at = |v: u32| snapped.binary_search(&v).is_ok();
        // The vertex of the cut on each edge that the outline passes.
        let mut on_cut = Vec::with_capacity(walk.len());
        let old_count = is_beyond.len() as u32;
        let length = |[a, b]: [u32; 2]| self.mesh.positions[a as usize].distance(self.mesh.positions[b as usize]);
        let lengths: Vec<f64> = walk.iter().map(|passage| f64::from(length(passage.edges[0]))).collect();
        let are_one = |i: usize, j: usize| crossings[i].distance(crossings[j]) <= MERGE * lengths[i].min(lengths[j]);
        for (i, (passage, p)) in walk.iter().zip(&crossings).enumerate() {
            let snapped = passage.edges[0].into_iter().find(|&v| snapped_at(v));
            let before = on_cut.last().copied().filter(|&v| v >= old_count && are_one(i - 1, i));
            on_cut.push(snapped.or(before).unwrap_or_else(|| {
                self.mesh.positions.push(p.as_vec3());
                self.mesh.positions.len() as u32 - 1
            }));
        }
        let mut rim = on_cut.clone();
        rim.dedup();
        while rim.len() > 1 && rim.first() == rim.last() {
            rim.pop();
        }
        let mut sorted = rim.clone();
        sorted.sort_unstable();
        if rim.len() < 3 || sorted.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(ClipError::TooCoarse { end });
        }
        let sides = self.split(&walk, &on_cut, &snapped, &is_beyond);
        let gone = self.flood(end, &rim, sides)?;
        Ok((rim, self.remove(end, &gone)?))
    }

    /// Moves vertices that are near to the plane into it; those that were moved, ascending.
    fn snap(&mut self, plane: &EndPlane, walk: &[Passage], is_beyond: &[bool]) -> Vec<u32> {
        let topology = Topology::new(self.mesh.positions.len(), &self.mesh.triangles);
        // Part of the edge, vertex, and where its edge meets the plane.
        let mut near: Vec<(f64, u32, DVec3)> = Vec::new();
        for passage in walk {
            let edge = passage.edges[0];
            let (part, p) = (self.part(plane, edge), self.crossing(plane, edge));
            if part < SNAP {
                near.push((part, edge[0], p));
            } else if 1.0 - part < SNAP {
                near.push((1.0 - part, edge[1], p));
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut snapped: Vec<u32> = Vec::new();
        for (_, v, p) in near {
            let Err(place) = snapped.binary_search(&v) else { continue };
            let is_snapped = |w: u32| snapped.binary_search(&w).is_ok();
            let has = |i: usize| walk[i].edges[0].contains(&v);
            // Its edges must follow each other on the outline, or the outline would touch itself in it.
            let runs = (0..walk.len()).filter(|&i| has(i) && !has((i + walk.len() - 1) % walk.len())).count();
            let has_partner = walk
                .iter()
                .map(|passage| passage.edges[0])
                .any(|edge| edge.contains(&v) && edge.into_iter().any(|w| w != v && is_snapped(w)));
            let flattens = topology
                .triangles(v)
                .iter()
                .map(|&t| self.mesh.triangles[t as usize])
                .any(|t| t.into_iter().all(|w| (w == v || is_snapped(w)) && !is_beyond[w as usize]));
            if runs != 1 || has_partner || flattens {
                continue;
            }
            let old = self.mesh.positions[v as usize];
            let normal = |mesh: &TriMesh, t: u32| {
                let [a, b, c] = mesh.corners(t as usize).map(glam::Vec3::as_dvec3);
                (b - a).cross(c - a)
            };
            let around = topology.triangles(v);
            let before: Vec<DVec3> = around.iter().map(|&t| normal(&self.mesh, t)).collect();
            self.mesh.positions[v as usize] = p.as_vec3();
            let is_sound = around.iter().zip(&before).all(|(&t, &before)| {
                let now = normal(&self.mesh, t);
                let (was, is) = (before.length(), now.length());
                was == 0.0 || (is > SHRINK * was && now.dot(before) > TURN * was * is)
            });
            if is_sound {
                snapped.insert(place, v);
            } else {
                self.mesh.positions[v as usize] = old;
            }
        }
        snapped
    }

    /// Splits the triangles of an outline; for each triangle after whether it lies beyond, where that is known.
    fn split(&mut self, walk: &[Passage], on_cut: &[u32], snapped: &[u32], is_beyond: &[bool]) -> Vec<Option<bool>> {
        let mut place: Vec<(u32, usize)> = walk.iter().map(|passage| passage.triangle).zip(0..).collect();
        place.sort_unstable();
        let is_snapped = |v: u32| snapped.binary_search(&v).is_ok();
        let (mut triangles, mut from, mut sides) = (Vec::new(), Vec::new(), Vec::new());
        for (number, &triangle) in self.mesh.triangles.iter().enumerate() {
            let mut add = |piece @ [a, b, c]: [u32; 3], side: Option<bool>| {
                // Without an area, where two new vertices are one.
                if a == b || b == c || c == a {
                    return;
                }
                triangles.push(piece);
                from.push(self.from[number]);
                sides.push(side);
            };
            let Ok(at) = place.binary_search_by_key(&(number as u32), |&(triangle, _)| triangle) else {
                add(triangle, None);
                continue;
            };
            let at = place[at].1;
            let edges = walk[at].edges;
            let new = [on_cut[at], on_cut[(at + 1) % walk.len()]];
            let side = |v: u32| Some(is_beyond[v as usize]);
            let [first, second] = edges.map(|edge| !edge.into_iter().any(is_snapped));
            if !first && !second {
                // The cut runs along an edge, or only touches a vertex.
                let other = triangle.into_iter().find(|&v| !is_snapped(v));
                add(triangle, other.and_then(side));
            } else if first != second {
                // From a vertex to the middle of the edge across from it.
                let (edge, middle) = if first { (edges[0], new[0]) } else { (edges[1], new[1]) };
                let [v, x, y] = turned(triangle, |v| !edge.contains(&v));
                add([v, x, middle], side(x));
                add([v, middle, y], side(y));
            } else {
                let [apex, b, c] = turned(triangle, |v| edges[0].contains(&v) && edges[1].contains(&v));
                let [m, n] = if edges[0].contains(&b) { new } else { [new[1], new[0]] };
                add([apex, m, n], side(apex));
                let at = |v: u32| self.mesh.positions[v as usize].as_dvec3();
                if at(m).distance_squared(at(c)) <= at(b).distance_squared(at(n)) {
                    add([m, b, c], side(b));
                    add([m, c, n], side(b));
                } else {
                    add([m, b, n], side(b));
                    add([b, c, n], side(b));
                }
            }
        }
        self.mesh.triangles = triangles;
        self.from = from;
        sides
    }

    /// Whether each triangle lies beyond a cut; `sides` has what is known of those on it.
    fn flood(&self, end: usize, rim: &[u32], mut sides: Vec<Option<bool>>) -> Result<Vec<bool>, ClipError> {
        let TriMesh { positions, triangles } = &self.mesh;
        let topology = Topology::new(positions.len(), triangles);
        let mut barrier: Vec<[u32; 2]> = crate::ends::edges(rim).map(|(a, b)| [a.min(b), a.max(b)]).collect();
        barrier.sort_unstable();
        // Where the cut runs along an edge, only the triangle on one side of it was passed.
        for &[a, b] in &barrier {
            let on: Vec<usize> = topology.triangles_on(triangles, a, b).map(|t| t as usize).collect();
            if let [one, other] = on[..] {
                let [was_one, was_other] = [sides[one], sides[other]];
                sides[one] = was_one.or(was_other.map(|side| !side));
                sides[other] = was_other.or(was_one.map(|side| !side));
            }
        }
        let mut is_gone: Vec<bool> = sides.iter().map(|side| *side == Some(true)).collect();
        let mut queue: VecDeque<u32> = (0..is_gone.len() as u32).filter(|&t| is_gone[t as usize]).collect();
        while let Some(t) = queue.pop_front() {
            let [a, b, c] = triangles[t as usize];
            for [a, b] in [[a, b], [b, c], [c, a]] {
                if barrier.binary_search(&[a.min(b), a.max(b)]).is_ok() {
                    continue;
                }
                for next in topology.triangles_on(triangles, a, b) {
                    if sides[next as usize] == Some(false) {
                        return Err(ClipError::NotSeparating { end });
                    }
                    if !std::mem::replace(&mut is_gone[next as usize], true) {
                        queue.push_back(next);
                    }
                }
            }
        }
        Ok(is_gone)
    }

    /// Removes triangles, unless they hold another end or most of the surface.
    fn remove(&mut self, end: usize, is_gone: &[bool]) -> Result<Removed, ClipError> {
        let mut removed = Removed::default();
        for t in (0..is_gone.len()).filter(|&t| is_gone[t]) {
            let has = |(_, crossed): &(usize, &Vec<u32>)| crossed.binary_search(&self.from[t]).is_ok();
            if let Some((other, _)) = self.crossed.iter().enumerate().filter(|(other, _)| *other != end).find(has) {
                return Err(ClipError::OtherEnd { end, other });
            }
            removed.triangles += 1;
            removed.area_mm2 += triangle_area(self.mesh.corners(t));
        }
        let part = if self.total > 0.0 { removed.area_mm2 / self.total } else { 1.0 };
        if part > MOST {
            return Err(ClipError::MostOfSurface { end, part });
        }
        let mut keep = is_gone.iter().map(|gone| !gone);
        self.mesh.triangles.retain(|_| keep.next().unwrap_or(true));
        let mut keep = is_gone.iter().map(|gone| !gone);
        self.from.retain(|_| keep.next().unwrap_or(true));
        Ok(removed)
    }
}

/// A triangle from the first corner on that is looked for.
fn turned([a, b, c]: [u32; 3], is_first: impl Fn(u32) -> bool) -> [u32; 3] {
    if is_first(a) {
        [a, b, c]
    } else if is_first(b) {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use lumen_mesh::shapes::{fork, joined, tube, vertices_are_manifold};
    use lumen_mesh::{Vec3, angles, self_intersections, volume};
    use lumen_vessel::Tree;

    use super::*;
    use crate::PatchKind;
    use crate::ends::proposed;

    /// A plane through `centre` out along `normal`, of any length, of a vessel of `radius_mm`.
    fn plane(centre: DVec3, normal: DVec3, radius_mm: f64) -> EndPlane {
        let normal = normal.normalize();
        EndPlane { branch: Some(0), at_end: true, centre, normal, radius_mm, roundness: 1.0, arc_mm: 0.0 }
    }

    /// Area of the polygon of `sides` in a circle.
    fn polygon(sides: f64, radius: f64) -> f64 {
        sides / 2.0 * radius * radius * libm::sin(2.0 * PI / sides)
    }

    fn assert_sound(mesh: &TriMesh, loops: usize) {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let edges = topology.edge_counts();
        assert_eq!((edges.non_manifold, edges.flipped), (0, 0));
        assert!(vertices_are_manifold(mesh, &topology));
        assert_eq!(lumen_mesh::boundary_loops(&topology).len(), loops);
    }

    #[test]
    fn a_tube_cut_five_mm_from_its_end_has_the_length_area_and_volume_that_are_left() {
        // Between rings, on a ring, and a little beside one.
        for z in [35.2, 35.0, 35.01, 34.99] {
            let mesh = tube(48, 80, 40.0, |_| 2.0);
            let clipped = clip(&mesh, &[plane(DVec3::new(0.3, 0.1, z), DVec3::Z, 2.0)]).unwrap();
            assert_sound(&clipped.mesh, 2);
            assert!(self_intersections(&clipped.mesh).is_empty());
            let [end] = &clipped.ends[..] else { panic!("one end") };
            assert!(end.rim.iter().all(|&v| (f64::from(clipped.mesh.positions[v as usize].z) - z).abs() < 1e-5));
            // Between rings the wall lies inside of the circle by no more than the sagitta of a chord.
            assert!(end.area_mm2 <= PI * 4.0 && end.area_mm2 > polygon(48.0, 2.0) * 0.995, "{}", end.area_mm2);
            assert!(end.normal.distance(DVec3::Z) < 1e-5 && end.centre.distance(DVec3::Z * z) < 1e-2);
            assert_eq!((end.kind, end.name.as_str()), (PatchKind::Inlet, "inlet"));
            let left = volume(&clipped.mesh, &Topology::new(clipped.mesh.positions.len(), &clipped.mesh.triangles));
            let before = volume(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
            assert!((left / before / (z / 40.0) - 1.0).abs() < 1e-3, "{left} of {before}");
            let area = lumen_mesh::surface_area(&clipped.mesh) + clipped.removed[0].area_mm2;
            assert!((area / lumen_mesh::surface_area(&mesh) - 1.0).abs() < 1e-3);
            let least = angles(&clipped.mesh).unwrap().min_deg;
            assert!(least > 3.0, "{least}");
            for (piece, &from) in clipped.from.iter().enumerate() {
                let middle = clipped.mesh.corners(piece).iter().sum::<Vec3>() / 3.0;
                let old = mesh.corners(from as usize).map(|p| p.distance(middle));
                assert!(old.iter().all(|&distance| distance < 1.0), "a piece lies in the triangle it comes from");
            }
        }
    }

    #[test]
    fn a_slanted_cut_is_an_ellipse() {
        let mesh = tube(64, 100, 40.0, |_| 2.0);
        let normal = DVec3::new(0.5, 0.3, 1.0).normalize();
        let at = DVec3::Z * 30.0;
        let clipped = clip(&mesh, &[plane(at, normal, 2.0)]).unwrap();
        assert_sound(&clipped.mesh, 2);
        assert!(self_intersections(&clipped.mesh).is_empty());
        let end = &clipped.ends[0];
        assert!((end.area_mm2 / (PI * 4.0 / normal.z) - 1.0).abs() < 5e-3, "{}", end.area_mm2);
        let off = |&v: &u32| (clipped.mesh.positions[v as usize].as_dvec3() - at).dot(normal).abs();
        assert!(end.rim.iter().map(off).fold(0.0, f64::max) < 1e-5);
        assert!(end.normal.distance(normal) < 1e-5);
    }

    #[test]
    fn a_fork_cut_at_its_three_ends_has_three_loops_and_elsewhere_the_same_bits() {
        // Without the triangles that have no area and may face either way.
        let mesh = lumen_io::import_mesh(fork().0, "made").mesh;
        let tree = Tree::new(&mesh).unwrap();
        let (planes, _) = proposed(&mesh, &tree);
        let clipped = clip(&mesh, &planes).unwrap();
        assert_eq!(clipped, clip(&mesh, &planes).unwrap());
        assert_sound(&clipped.mesh, 3);
        let mut names: Vec<(&str, f64)> = clipped.ends.iter().map(|e| (e.name.as_str(), e.radius_mm())).collect();
        names.sort_by(|a, b| a.0.cmp(b.0));
        for ((name, radius), (expected, size)) in
            names.iter().zip([("inlet", 4.0), ("outlet_1", 3.0), ("outlet_2", 2.0)])
        {
            assert!(*name == expected && (radius / size - 1.0).abs() < 0.03, "{names:?}");
        }
        let is_near = |p: Vec3| {
            planes.iter().any(|plane| {
                let off = p.as_dvec3() - plane.centre;
                off.dot(plane.normal) > -1.0 && off.length() < 3.0 * plane.radius_mm
            })
        };
        // The surface has slivers that touch each other, none of them near a cut.
        let crossing = self_intersections(&clipped.mesh);
        assert!(crossing.iter().all(|&t| clipped.mesh.corners(t as usize).iter().all(|&p| !is_near(p))));
        let kept = |mesh: &TriMesh| -> Vec<[u32; 3]> {
            let far: Vec<Vec3> = mesh.positions.iter().copied().filter(|&p| !is_near(p)).collect();
            far.into_iter().map(|p| p.to_array().map(f32::to_bits)).collect()
        };
        assert_eq!(kept(&clipped.mesh), kept(&mesh));
    }

    #[test]
    fn a_vessel_beside_in_the_same_plane_is_not_touched() {
        let other = {
            let mut other = tube(32, 60, 40.0, |_| 2.0);
            other.positions.iter_mut().for_each(|p| p.x += 6.0);
            other
        };
        let mesh = joined(&[tube(32, 60, 40.0, |_| 2.0), other.clone()]);
        let clipped = clip(&mesh, &[plane(DVec3::Z * 33.3, DVec3::Z, 2.0)]).unwrap();
        assert_sound(&clipped.mesh, 4);
        let beside = clipped.mesh.filtered(|t| clipped.mesh.corners(t)[0].x > 3.0);
        assert_eq!(beside, other);
    }

    #[test]
    fn planes_that_cut_off_too_much_or_nothing_are_refused() {
        let mesh = tube(32, 60, 40.0, |_| 2.0);
        let of = |planes: &[EndPlane]| clip(&mesh, planes).unwrap_err();
        let end = plane(DVec3::Z * 35.0, DVec3::Z, 2.0);
        assert!(matches!(of(&[plane(DVec3::Z * 35.0, -DVec3::Z, 2.0)]), ClipError::MostOfSurface { end: 0, .. }));
        let deep = plane(DVec3::Z * 30.0, DVec3::Z, 2.0);
        assert_eq!(of(&[deep.clone(), end.clone()]), ClipError::OtherEnd { end: 0, other: 1 });
        assert_eq!(of(&[end.clone(), deep]), ClipError::OtherEnd { end: 1, other: 0 });
        assert_eq!(of(&[plane(DVec3::Z * 50.0, DVec3::Z, 2.0)]), ClipError::NoOutline { end: 0 });
        assert_eq!(of(&[plane(DVec3::new(9.0, 0.0, 35.0), DVec3::Z, 2.0)]), ClipError::NoOutline { end: 0 });
        assert_eq!(of(&[plane(DVec3::Z * 35.0, DVec3::X, 2.0)]), ClipError::Open { end: 0 });
        assert_eq!(of(&[EndPlane { normal: DVec3::NAN, ..end.clone() }]), ClipError::Plane { end: 0 });
        assert_eq!(of(&[EndPlane { normal: DVec3::Z * 2.0, ..end.clone() }]), ClipError::Plane { end: 0 });
        let mut broken = mesh.clone();
        broken.positions[7].x = f32::INFINITY;
        assert!(matches!(clip(&broken, &[end]), Err(ClipError::Surface(SurfaceError::NotFinite { vertex: 7 }))));
        let unchanged = clip(&mesh, &[]).unwrap();
        assert_eq!((unchanged.mesh, unchanged.ends.len()), (mesh, 0));
    }

    #[test]
    fn a_ring_is_not_separated_by_one_plane() {
        // A torus: rings of a tube whose axis runs around a circle, with the last ring joined to the first.
        let (around, along) = (24u32, 96u32);
        let at = |i: u32, n: u32| f64::from(i) / f64::from(n) * 2.0 * PI;
        let position = |i: u32| {
            let ((s, c), (t, d)) = (libm::sincos(at(i % around, around)), libm::sincos(at(i / around, along)));
            let from_axis = 10.0 + 2.0 * c;
            Vec3::new((from_axis * d) as f32, (from_axis * t) as f32, (2.0 * s) as f32)
        };
        let v = |ring: u32, side: u32| ring % along * around + side % around;
        let mut mesh = TriMesh { positions: (0..around * along).map(position).collect(), triangles: Vec::new() };
        for ring in 0..along {
            for side in 0..around {
                let [a, b, c, d] = [v(ring, side), v(ring, side + 1), v(ring + 1, side), v(ring + 1, side + 1)];
                mesh.triangles.extend([[a, c, b], [b, c, d]]);
            }
        }
        let found = clip(&mesh, &[plane(DVec3::new(10.0, 0.05, 0.0), DVec3::Y, 2.0)]);
        assert_eq!(found, Err(ClipError::NotSeparating { end: 0 }));
    }
}
