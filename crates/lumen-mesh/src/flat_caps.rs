//! Flat caps: the plane discs that close the ends of vessels, as models for flow have them.
//!
//! A cap is a connected set of triangles in one plane whose rim is one loop with a crease that stands out everywhere, and
//! behind which the vessel goes on: cut by planes half a radius and a whole radius further in, what is joined to the rim is
//! as wide as the cap; and the rim is round. So neither the steps and ends of a voxel surface nor the faces of a box are caps. Caps that touch are none.
//!
//! A rim of few edges could be that of a facet or of the end of a mask's thin vessel. There the crease is nearly square in the
//! mean, the rim rounder than a square, and the vessel behind it hardly wider or narrower: a mask's end stands back half a
//! voxel from the wall around it, which is half as large again or more where the rim has fewer than a dozen edges.

use glam::{DVec3, Vec3};

use super::task::{Yielder, at_once, blocks};
use super::{Topology, TriMesh, cut, parallel};

/// Cosine of the angle up to which triangles belong to the plane of a cap's largest: 2 degrees.
const FLAT: f64 = 0.999_390_827_019_095_8;
/// Cosine of the least crease between cap and wall: 25 degrees.
const CREASE: f64 = 0.906_307_787_036_65;
/// The part of the rim's length that has such a crease.
const CREASED: f64 = 0.95;
/// Edges of the least rim.
const LEAST_RIM: usize = 6;
/// A rim of fewer edges is one of few, all of which have the crease. The ends of the thinnest vessels of a mask are flat and
/// round, too: most have 6 to 10.
const FEW: usize = 12;
/// Cosine of the least mean crease of a rim of few edges: 65 degrees. That of a mask's end has 45 to 55 where voxels are cubes,
/// that of a tube 90, however it is cut.
const SQUARE: f64 = 0.422_618_261_740_699_4;
/// 4 pi times the area over the squared length of a rim of few edges: 0.907 for a regular hexagon, 0.785 for a square.
const ROUND: f64 = 0.82;
/// By how much the vessel's section behind a rim of few edges may be smaller or larger than the cap.
const WIDER_OF_FEW: f64 = 1.45;
/// The bends of a rim sum up to at most so many full turns: those of a rim of voxels sum up to 2 and more.
const TURNS: f64 = 1.6;
/// How far in the vessel is cut, in radii of the cap.
const DEPTHS: [f64; 2] = [0.5, 1.0];
/// How far from the cap's axis the wall is followed, in radii of the cap.
const ASIDE: f64 = 4.0;
/// By how much the vessel's section there may be smaller or larger than the cap.
const WIDER: f64 = 2.2;
/// Off the plane, in radii of the cap, a corner of a cap lies at most.
const OFF_PLANE: f64 = 0.01;

/// By how much the cosine of two rounded normals is off at most.
const ROUNDED: f32 = 1e-5;

/// No triangle, and no region.
const NONE: u32 = u32::MAX;

/// Triangles between two looks at the clock, and those that a core works on in one go.
const TRIANGLES: usize = 1 << 15;
const PIECE: usize = 4096;

/// A flat end of a closed vessel.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatCap {
    /// Its triangles, in ascending order.
    pub triangles: Vec<u32>,
    /// The vertices around it, counter-clockwise seen from outside.
    pub rim: Vec<u32>,
    /// The middle of its area, in mm.
    pub centre: DVec3,
    /// Its unit normal, out of the vessel.
    pub normal: DVec3,
    /// Its area in mm2.
    pub area_mm2: f64,
}

impl FlatCap {
    /// The radius of a circle of its area, in mm.
    pub fn radius_mm(&self) -> f64 {
        libm::sqrt(self.area_mm2 / std::f64::consts::PI)
    }
}

/// The flat caps of a surface whose triangles have the adjacency `topology`, by their first triangle.
pub fn flat_caps(mesh: &TriMesh, topology: &Topology) -> Vec<FlatCap> {
    at_once(flat_caps_in_slices(mesh, topology, &Yielder::never()))
}

/// As [`flat_caps`], resting after some triangles.
pub async fn flat_caps_in_slices(mesh: &TriMesh, topology: &Topology, yielder: &Yielder) -> Vec<FlatCap> {
    let search = Search::new(mesh, topology, yielder).await;
    let mut caps: Vec<FlatCap> = search.regions().filter_map(|region| search.cap(region)).collect();
    let mut owner = vec![u32::MAX; mesh.positions.len()];
    let mut touches = vec![false; caps.len()];
    for (i, cap) in caps.iter().enumerate() {
        for &v in &cap.rim {
            let other = std::mem::replace(&mut owner[v as usize], i as u32);
            if other != u32::MAX {
                (touches[i], touches[other as usize]) = (true, true);
            }
        }
    }
    let mut touches = touches.into_iter();
    caps.retain(|_| !touches.next().unwrap_or(false));
    caps
}

/// Those of `triangles` that are in none of `caps`, in their order.
pub fn without_caps(triangles: &[[u32; 3]], caps: &[FlatCap]) -> Vec<[u32; 3]> {
    let mut is_cap = vec![false; triangles.len()];
    caps.iter().flat_map(|cap| &cap.triangles).for_each(|&t| is_cap[t as usize] = true);
    triangles.iter().zip(&is_cap).filter(|(_, is_cap)| !**is_cap).map(|(&triangle, _)| triangle).collect()
}

/// The search for caps in one surface.
struct Search<'a> {
    mesh: &'a TriMesh,
    /// Unit normals, rounded; 0 where there is none.
    normals: Vec<Vec3>,
    /// The triangle on the other side of each edge; [`NONE`] where there is none, or more than one.
    across: Vec<[u32; 3]>,
    /// The region of each triangle.
    regions: Vec<u32>,
    /// The triangles of each region of at least a few, in ascending order.
    found: Vec<Vec<u32>>,
}

impl<'a> Search<'a> {
    async fn new(mesh: &'a TriMesh, topology: &Topology, yielder: &Yielder) -> Self {
        let count = mesh.triangles.len();
        let mut normals = Vec::with_capacity(count);
        for block in blocks(count, TRIANGLES) {
            let first = block.start;
            let found = parallel::map_ranges(block.len(), PIECE, |range| {
                range.map(|i| normal(mesh, first + i).as_vec3()).collect::<Vec<_>>()
            });
            normals.extend(found.into_iter().flatten());
            yielder.rest(0.3 * normals.len() as f32 / count as f32).await;
        }
        let mut across = vec![[NONE; 3]; count];
        let mut ends = Vec::new();
        for block in blocks(topology.vertex_count(), TRIANGLES / 2) {
            let end = block.end;
            block.for_each(|v| join_around(mesh, topology, v as u32, &mut ends, &mut across));
            yielder.rest(0.3 + 0.3 * end as f32 / topology.vertex_count() as f32).await;
        }
        let mut search = Self { mesh, normals, across, regions: vec![NONE; count], found: Vec::new() };
        for block in blocks(count, TRIANGLES) {
            let (first, of) = (block.start, &search);
            let found = parallel::map_ranges(block.len(), PIECE, |range| {
                range.map(|i| (first + i) as u32).filter(|&t| of.may_be_at_a_rim(t)).collect::<Vec<_>>()
            });
            let end = block.end;
            found.into_iter().flatten().for_each(|seed| search.grow(seed));
            yielder.rest(0.6 + 0.4 * end as f32 / count as f32).await;
        }
        search
    }

    /// Whether a triangle has a neighbour in its plane, and one across a crease that stands out.
    fn may_be_at_a_rim(&self, t: u32) -> bool {
        let rounded = self.normals[t as usize];
        let may = |least: f32, most: f32| {
            let between = |other: u32| (least..most).contains(&self.normals[other as usize].dot(rounded));
            rounded != Vec3::ZERO && self.across(t).any(between)
        };
        if !(may(FLAT as f32 - ROUNDED, 2.0) && may(-2.0, CREASE as f32 + ROUNDED)) {
            return false;
        }
        let normal = self.normal(t);
        let cosines = || self.across(t).map(|other| self.normal(other).dot(normal));
        cosines().any(|cosine| cosine > FLAT) && cosines().any(|cosine| cosine < CREASE)
    }

    /// The unit normal of a triangle; 0 where it has none.
    fn normal(&self, t: u32) -> DVec3 {
        normal(self.mesh, t as usize)
    }

    /// The triangles on the other side of the edges of `t`.
    fn across(&self, t: u32) -> impl Iterator<Item = u32> + use<> {
        self.across[t as usize].into_iter().filter(|&other| other != NONE)
    }

    /// Groups `seed` with all that lie in its plane, unless it is in a group.
    fn grow(&mut self, seed: u32) {
        if self.regions[seed as usize] != NONE {
            return;
        }
        let (number, normal) = (self.found.len() as u32, self.normal(seed));
        let (mut members, mut stack) = (vec![seed], vec![seed]);
        self.regions[seed as usize] = number;
        while let Some(t) = stack.pop() {
            for other in self.across(t) {
                if self.regions[other as usize] == NONE && self.normal(other).dot(normal) > FLAT {
                    self.regions[other as usize] = number;
                    members.push(other);
                    stack.push(other);
                }
            }
        }
        members.sort_unstable();
        self.found.push(members);
    }

    fn regions(&self) -> impl Iterator<Item = &Vec<u32>> {
        // A disc of so many rim vertices has at least two triangles fewer.
        self.found.iter().filter(|members| members.len() + 2 >= LEAST_RIM)
    }

    /// The region as a cap, if it is one.
    fn cap(&self, region: &[u32]) -> Option<FlatCap> {
        let number = self.regions[region[0] as usize];
        let corner = |v: u32| self.mesh.positions[v as usize].as_dvec3();
        let (mut area, mut moment, mut normal) = (0.0, DVec3::ZERO, DVec3::ZERO);
        let mut edges: Vec<[u32; 2]> = Vec::new();
        let (mut length, mut creased, mut cosines, mut is_all) = (0.0, 0.0, 0.0, true);
        for &t in region {
            let triangle = self.mesh.triangles[t as usize];
            let [a, b, c] = triangle.map(corner);
            let vector = (b - a).cross(c - a) / 2.0;
            let own = self.normal(t);
            area += vector.length();
            moment += (a + b + c) / 3.0 * vector.length();
            normal += vector;
            for (i, &other) in self.across[t as usize].iter().enumerate() {
                if other == NONE {
                    return None;
                }
                if self.regions[other as usize] == number {
                    continue;
                }
                let [from, to] = [triangle[i], triangle[(i + 1) % 3]];
                let cosine = self.normal(other).dot(own);
                let apex = self.mesh.triangles[other as usize].into_iter().find(|&v| v != from && v != to)?;
                let is_behind = (corner(apex) - corner(from)).dot(own) < 0.0;
                let is_creased = is_behind && cosine < CREASE;
                // Most regions end here: the facets of what is smooth.
                if !is_creased && region.len() + 2 < FEW {
                    return None;
                }
                let away = corner(from).distance(corner(to));
                edges.push([from, to]);
                length += away;
                cosines += cosine * away;
                creased += if is_creased { away } else { 0.0 };
                is_all &= is_creased;
            }
        }
        if edges.len() < LEAST_RIM || creased < CREASED * length || area <= 0.0 {
            return None;
        }
        let is_round = 2.0 * std::f64::consts::TAU * area > ROUND * length * length;
        if edges.len() < FEW && !(is_all && is_round && cosines < SQUARE * length) {
            return None;
        }
        let (centre, normal) = (moment / area, normal.normalize_or_zero());
        let cap = FlatCap { triangles: region.to_vec(), rim: rim(edges)?, centre, normal, area_mm2: area };
        let off = |&v: &u32| (corner(v) - centre).dot(normal).abs() > OFF_PLANE * cap.radius_mm();
        (!cap.rim.iter().any(off) && self.turns(&cap.rim) < TURNS && self.closes_a_vessel(&cap)).then_some(cap)
    }

    /// The sum of a rim's bends, in full turns: 1 where it is convex.
    fn turns(&self, rim: &[u32]) -> f64 {
        let corner = |i: usize| self.mesh.positions[rim[i % rim.len()] as usize].as_dvec3();
        let bend = |i: usize| {
            let ways = [corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1)];
            let [before, after] = ways.map(DVec3::normalize_or_zero);
            libm::acos(before.dot(after).clamp(-1.0, 1.0))
        };
        (0..rim.len()).map(bend).sum::<f64>() / std::f64::consts::TAU
    }

    /// Whether a vessel of the cap's width goes on behind it.
    fn closes_a_vessel(&self, cap: &FlatCap) -> bool {
        let radius = cap.radius_mm();
        let deepest = DEPTHS[DEPTHS.len() - 1] * radius;
        let wider = if cap.rim.len() < FEW { WIDER_OF_FEW } else { WIDER };
        let inwards = |v: u32| cap.centre - self.mesh.positions[v as usize].as_dvec3();
        let depth = |v: u32| inwards(v).dot(cap.normal);
        let aside = |v: u32| inwards(v).reject_from_normalized(cap.normal).length();
        // The wall from the rim on, as far as the deepest cut.
        let mut is_seen: std::collections::BTreeSet<u32> = cap.triangles.iter().copied().collect();
        let mut stack = cap.triangles.clone();
        let mut wall = Vec::new();
        while let Some(t) = stack.pop() {
            for other in self.across(t) {
                let triangle = self.mesh.triangles[other as usize];
                let depths = triangle.map(depth);
                let is_near = depths.iter().any(|&depth| depth < deepest)
                    && depths.iter().any(|&depth| depth > -0.1 * radius)
                    && triangle.iter().any(|&v| aside(v) < ASIDE * radius);
                if is_near && is_seen.insert(other) {
                    wall.push(other);
                    stack.push(other);
                }
            }
        }
        wall.sort_unstable();
        let wall: Vec<[u32; 3]> = wall.into_iter().map(|t| self.mesh.triangles[t as usize]).collect();
        DEPTHS.iter().all(|depth| {
            let at = cap.centre - cap.normal * depth * radius;
            let outlines = cut(&self.mesh.positions, &wall, at, cap.normal);
            let largest = outlines.iter().map(|outline| outline.area(cap.normal)).fold(0.0, f64::max);
            largest > cap.area_mm2 / wider && largest < cap.area_mm2 * wider
        })
    }
}

/// The unit normal of triangle `t`; 0 where it has none.
fn normal(mesh: &TriMesh, t: usize) -> DVec3 {
    let [a, b, c] = mesh.corners(t).map(Vec3::as_dvec3);
    (b - a).cross(c - a).normalize_or_zero()
}

/// Enters what lies across the edges from `v` to vertices of larger numbers into `across`: for each triangle and edge the
/// triangle on the other side; nothing where there is none, or more than one. `ends` is room for that.
fn join_around(mesh: &TriMesh, topology: &Topology, v: u32, ends: &mut Vec<[u32; 3]>, across: &mut [[u32; 3]]) {
    ends.clear();
    for &t in topology.triangles(v) {
        let [a, b, c] = mesh.triangles[t as usize];
        for (edge, [from, to]) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
            if from.min(to) == v {
                ends.push([from.max(to), t, edge as u32]);
            }
        }
    }
    ends.sort_unstable();
    for edge in ends.chunk_by(|one, other| one[0] == other[0]) {
        if let [[_, t, i], [_, u, j]] = *edge {
            (across[t as usize][i as usize], across[u as usize][j as usize]) = (u, t);
        }
    }
}

/// Directed edges as one loop through each of their vertices once, from the least on; `None` where they are none.
fn rim(mut edges: Vec<[u32; 2]>) -> Option<Vec<u32>> {
    edges.sort_unstable();
    if edges.windows(2).any(|pair| pair[0][0] == pair[1][0]) {
        return None;
    }
    let mut rim = vec![edges[0][0]];
    let mut at = 0;
    loop {
        let next = edges[at][1];
        if next == rim[0] {
            break;
        }
        if rim.len() >= edges.len() {
            return None;
        }
        rim.push(next);
        at = edges.binary_search_by_key(&next, |edge| edge[0]).ok()?;
    }
    (rim.len() == edges.len()).then_some(rim)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{capped, close_by_fans, icosphere, isosurface, tube};

    fn found(mesh: &TriMesh) -> Vec<FlatCap> {
        flat_caps(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles))
    }

    #[test]
    fn both_ends_of_a_closed_tube_are_caps_with_their_plane_and_area() {
        for sides in [6, 8, 10, 12, 24, 96] {
            let caps = found(&capped(sides, 30, 30.0, 2.0));
            let polygon = f64::from(sides) * 2.0 * (std::f64::consts::TAU / f64::from(sides)).sin();
            assert_eq!(caps.len(), 2, "{sides}");
            for cap in &caps {
                assert_eq!((cap.rim.len(), cap.triangles.len()), (sides as usize, sides as usize));
                assert!((cap.area_mm2 / polygon - 1.0).abs() < 1e-5 && cap.normal.z.abs() > 0.999_999, "{cap:?}");
                assert!(cap.normal.z * (cap.centre.z - 15.0) > 0.0, "out of the vessel: {cap:?}");
            }
        }
    }

    /// A tube of 2 mm along z whose ends have no vertex within their rims.
    fn planar(sides: u32, rings: u32, length: f32) -> TriMesh {
        let mut mesh = tube(sides, rings, length, |_| 2.0);
        for rim in crate::boundary_loops(&Topology::new(mesh.positions.len(), &mesh.triangles)) {
            // From side to side, so that no vertex has many triangles.
            let (mut first, mut last) = (0, rim.len() - 1);
            while first + 1 < last {
                let next = if (first + last) % 2 == 1 { first + 1 } else { last - 1 };
                mesh.triangles.push([rim[first], rim[last], rim[next]]);
                if next == first + 1 { first = next } else { last = next }
            }
        }
        mesh
    }

    #[test]
    fn ends_of_few_edges_are_caps_without_a_vertex_inside_and_where_they_lean() {
        for sides in [6, 8, 10, 12] {
            for lean in [0.0, 0.6] {
                let mut mesh = planar(sides, 20, 20.0);
                mesh.positions.iter_mut().for_each(|p| p.z += lean * p.x);
                let caps = found(&mesh);
                assert_eq!(caps.len(), 2, "{sides} {lean}");
                let slope = f64::from(1.0 + lean * lean).sqrt();
                let polygon = f64::from(sides) * 2.0 * (std::f64::consts::TAU / f64::from(sides)).sin() * slope;
                for cap in &caps {
                    assert_eq!((cap.rim.len(), cap.triangles.len()), (sides as usize, sides as usize - 2));
                    assert!((cap.area_mm2 / polygon - 1.0).abs() < 1e-5, "{cap:?}");
                }
            }
        }
    }

    /// The faces of the voxels of a grid that are inside, as squares of two triangles.
    fn blocks(low: i32, high: i32, inside: impl Fn([i32; 3]) -> bool) -> TriMesh {
        let (mut mesh, mut known) = (TriMesh::default(), std::collections::BTreeMap::new());
        let range = || low..high;
        for (x, y, z) in range().flat_map(|x| range().flat_map(move |y| range().map(move |z| (x, y, z)))) {
            for (axis, side) in [0, 1, 2].into_iter().flat_map(|axis| [(axis, 0), (axis, 1)]) {
                let mut beside = [x, y, z];
                beside[axis] += 2 * side - 1;
                if !inside([x, y, z]) || inside(beside) {
                    continue;
                }
                let mut corner = |u: i32, v: i32| {
                    let mut at = [x, y, z];
                    at[axis] += side;
                    at[(axis + 1) % 3] += u;
                    at[(axis + 2) % 3] += v;
                    *known.entry(at).or_insert_with(|| {
                        mesh.positions.push(Vec3::from_array(at.map(|x| x as f32)));
                        mesh.positions.len() as u32 - 1
                    })
                };
                let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                mesh.triangles.extend(if side == 1 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
            }
        }
        mesh
    }

    #[test]
    fn a_prism_has_caps_where_it_is_a_tube_and_other_coarse_solids_have_none() {
        assert_eq!(found(&planar(6, 1, 4.0)).len(), 2);
        let octahedron = {
            let positions = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|p| [p, -p]).collect();
            let triangles =
                vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
            TriMesh { positions, triangles }
        };
        let ball = |[x, y, z]: [i32; 3]| x * x + y * y + z * z < 50;
        let square = |[x, y, z]: [i32; 3]| (0..2).contains(&x) && (0..2).contains(&y) && z.abs() < 9;
        let cube = |p: [i32; 3]| p.into_iter().all(|x| (0..2).contains(&x));
        for (what, mesh) in [
            ("cube", blocks(-1, 4, cube)),
            ("icosahedron", icosphere(0, 2.0, Vec3::ZERO)),
            ("octahedron", octahedron),
            ("short prism", capped(6, 1, 0.5, 2.0)),
            ("short prism without a middle", planar(6, 1, 0.5)),
            ("ball of voxels", blocks(-9, 10, ball)),
            ("vessel of two by two voxels", blocks(-10, 11, square)),
        ] {
            assert!(found(&mesh).is_empty(), "{what}");
        }
    }

    #[test]
    fn the_ends_of_a_masks_thin_vessels_are_no_caps() {
        // Marching cubes leave the last slice's voxel centres, half a voxel in from the wall and half a slice out.
        for (sides, voxels) in [(6, 1.2), (8, 1.5), (10, 2.0)] {
            for slice in [0.7, 1.0, 1.7, 3.0] {
                let length = 20.0 * slice;
                let is_end = |z: f32| z < 0.1 * slice || z > length - 0.1 * slice;
                let mut mesh = tube(sides, 40, length, |z| if is_end(z) { voxels } else { voxels + 0.5 });
                close_by_fans(&mut mesh);
                assert!(found(&mesh).is_empty(), "{sides} {slice}");
                // The same without steps back is closed by caps.
                let mut mesh = tube(sides, 40, length, |_| voxels);
                close_by_fans(&mut mesh);
                assert_eq!(found(&mesh).len(), 2, "{sides} {slice}");
            }
        }
    }

    #[test]
    fn spheres_open_tubes_boxes_and_stumps_have_none() {
        let boxed = isosurface(DVec3::splat(-6.0), DVec3::splat(6.0), 1.0, |p| 4.2 - p.abs().max_element());
        for (what, mesh) in [
            ("sphere", icosphere(4, 5.0, Vec3::ZERO)),
            ("open tube", tube(24, 20, 20.0, |_| 2.0)),
            ("box", boxed),
            ("disc", capped(24, 2, 0.5, 2.0)),
            ("nothing", TriMesh::default()),
        ] {
            assert!(found(&mesh).is_empty(), "{what}");
        }
    }

    #[test]
    fn the_steps_of_a_binary_mask_are_no_caps() {
        // A vessel along z of 4 mm, in voxels of 0.5 mm.
        let inside = |p: DVec3| if p.truncate().length() < 4.0 && p.z.abs() < 9.9 { 0.5 } else { -0.5 };
        let caps = found(&isosurface(DVec3::new(-6.0, -6.0, -12.0), DVec3::new(6.0, 6.0, 12.0), 0.5, inside));
        assert!(caps.is_empty(), "{}", caps.len());
    }

    #[test]
    fn an_end_that_is_cut_at_a_slant_is_a_cap() {
        let mut mesh = capped(24, 40, 40.0, 2.0);
        mesh.positions.iter_mut().for_each(|p| p.z += 0.6 * p.x);
        let caps = found(&mesh);
        assert_eq!(caps.len(), 2);
        assert!(caps.iter().all(|cap| (cap.normal.x.abs() - 0.6 / 1.36_f64.sqrt()).abs() < 1e-5), "{caps:?}");
    }
}
