//! Patches of a surface that cannot run into themselves, seen at a glance.
//!
//! Looked at along some direction, let every triangle of a patch face the viewer. Then as many of its triangles lie over
//! one another at a point as the patch's boundary goes around that point (the degree of a map), and that is the same
//! for all points that can be joined without meeting the boundary. So where the boundary keeps out of a rectangle and a
//! single triangle lies over one point of it, no two triangles of the patch lie over one another anywhere in it: none in
//! the rectangle runs into another of the patch. (Volino and Magnenat-Thalmann 1994 ask for a boundary that does not
//! cross itself; to keep it out of a rectangle is found in one pass over the patch.)
//!
//! Near nearly every triangle of a vessel this answers for hundreds of pairs at once. What is not certain by more than
//! the rounding of f32 is not said: such triangles are looked at pair by pair (`self_intersections`).

use glam::{Vec2, Vec3};

use super::nearest::Leaf;
use super::topology::{EdgeUse, Topology, opposite};

/// Vertices that a patch is looked at by, at most.
const MAX_VERTICES: usize = 512;
/// Places of the table that finds a vertex of the patch: a power of two, a quarter of them filled at most.
const PLACES: usize = 4 * MAX_VERTICES;
/// By what a vertex is multiplied for its place in the table: 2^32 over the golden ratio (Knuth).
const HASH: u32 = 0x9E37_79B1;
/// By what places in the plane may be off, as a part of the rectangle's size: ten times the rounding of f32.
const ROUNDING: f32 = 2e-6;

/// A vertex of the patch, or one beside it.
#[derive(Clone, Copy)]
struct Corner {
    vertex: u32,
    /// Seen along the direction, relative to the middle of the rectangle, in mm.
    at: Vec2,
    /// Whether it lies in the rectangle or near it, and so all of its triangles are in the patch.
    is_inside: bool,
}

/// The directions that a patch is seen by, and the box around the triangles that it is made for.
#[derive(Clone, Copy, Default)]
struct View {
    /// Right, up, and to the viewer: unit vectors.
    axes: [Vec3; 3],
    middle: Vec3,
    /// Half the box's sides along the axes, in mm.
    half: Vec3,
}

/// What is asked of the triangles that a patch is made for, found in one pass over them.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    /// Their normals, as long as twice their areas, added up.
    normal: Vec3,
    /// The box around them, along the axes of space.
    pub(super) min: Vec3,
    pub(super) max: Vec3,
    /// The mean length of their edges, one of each triangle, in mm.
    edge: f32,
}

impl Extent {
    /// That of `leaves`.
    pub(super) fn of<'a>(leaves: impl Iterator<Item = &'a Leaf>) -> Self {
        let (mut min, mut max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (mut normal, mut edges, mut count) = (Vec3::ZERO, 0.0, 0);
        for &Leaf { corners: [a, b, c], .. } in leaves {
            (min, max) = (min.min(a).min(b).min(c), max.max(a).max(b).max(c));
            normal += (b - a).cross(c - a);
            edges += a.distance(b);
            count += 1;
        }
        Self { normal, min, max, edge: edges / count as f32 }
    }
}

impl View {
    /// Along the mean normal of `leaves`, whose extent is `extent`, as wide as they lie; `None` where they have none.
    fn of<'a>(leaves: impl Iterator<Item = &'a Leaf>, extent: &Extent) -> Option<Self> {
        let towards = extent.normal.try_normalize()?;
        // A hierarchy cuts along the axes of space: the longest is the one that the triangles most likely lie along.
        let [centre, size] = [(extent.min + extent.max) * 0.5, (extent.max - extent.min) * 0.5];
        let longest = if size.x >= size.y && size.x >= size.z {
            Vec3::X
        } else if size.y >= size.z {
            Vec3::Y
        } else {
            Vec3::Z
        };
        let right = longest.reject_from_normalized(towards).try_normalize()?;
        let axes = [right, towards.cross(right), towards];
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for p in leaves.flat_map(|leaf| leaf.corners) {
            let seen = Vec3::from_array(axes.map(|axis| axis.dot(p - centre)));
            (low, high) = (low.min(seen), high.max(seen));
        }
        let [offset, half] = [(low + high) * 0.5, (high - low) * 0.5];
        let middle = centre + axes[0] * offset.x + axes[1] * offset.y + axes[2] * offset.z;
        // Rounding may move what is seen of a triangle by as much.
        let view = Self { axes, middle, half: half + half.max_element() * 4.0 * ROUNDING };
        view.half.is_finite().then_some(view)
    }

    fn seen(&self, p: Vec3) -> Vec3 {
        Vec3::from_array(self.axes.map(|axis| axis.dot(p - self.middle)))
    }

    /// Whether a triangle lies wholly beyond one side of the box.
    fn is_beyond(&self, corners: [Vec3; 3]) -> bool {
        let [a, b, c] = corners.map(|p| self.seen(p));
        a.min(b).min(c).cmpgt(self.half).any() || a.max(b).max(c).cmplt(-self.half).any()
    }
}

/// A place of the table: a vertex and its number among the corners.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Entry {
    vertex: u32,
    corner: u32,
}

/// A search for patches; it keeps its memory from one to the next.
pub(super) struct Patch {
    view: View,
    /// Those inside are looked around in their order.
    corners: Vec<Corner>,
    /// By the hash of the vertex.
    table: Vec<Entry>,
    /// The place in it of each corner.
    places: Vec<u32>,
}

impl Patch {
    const FREE: Entry = Entry { vertex: u32::MAX, corner: u32::MAX };

    pub(super) fn new() -> Self {
        Self {
            view: View::default(),
            corners: Vec::with_capacity(MAX_VERTICES),
            table: vec![Self::FREE; PLACES],
            places: Vec::with_capacity(MAX_VERTICES),
        }
    }

    /// Whether none of `leaves`, whose extent is `extent`, runs into a triangle that [`Self::has`], for certain. They are
    /// triangles of the surface of `positions` and `triangles`, whose adjacency is `topology`.
    pub(super) fn certify<'a>(
        &mut self,
        leaves: impl Iterator<Item = &'a Leaf> + Clone,
        extent: &Extent,
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        topology: &Topology,
    ) -> bool {
        let Some((view, first)) = View::of(leaves.clone(), extent).zip(leaves.clone().next()) else { return false };
        self.view = view;
        // A patch fills a small part of the table.
        self.places.drain(..).for_each(|place| self.table[place as usize] = Self::FREE);
        self.corners.clear();
        let half = Vec2::new(view.half.x, view.half.y);
        let rounding = ROUNDING * view.half.max_element();
        // Where a boundary would cut a corner of the rectangle, it is pushed out by an edge.
        let reach = half + 0.5 * extent.edge;
        // A single triangle is to lie over the middle of the first.
        let place = view.seen(first.corners.iter().sum::<Vec3>() / 3.0).truncate();
        let mut over_place = 0;
        for vertex in leaves.flat_map(|leaf| triangles[leaf.triangle as usize]) {
            self.number(vertex, positions, reach);
        }
        let mut next = 0;
        while let Some(&corner) = self.corners.get(next) {
            let known = next;
            next += 1;
            if !corner.is_inside {
                continue;
            }
            // Any vertex adds fewer than are left over.
            let around = topology.edge_uses(corner.vertex);
            if around.len() + self.corners.len() > MAX_VERTICES || around.iter().any(|&edge| edge != Self::TWO) {
                return false;
            }
            for &t in topology.triangles(corner.vertex) {
                let [second, third] = opposite(triangles[t as usize], corner.vertex);
                // Each triangle once: at the first of its corners that are inside.
                let Some(second) = self.number_unless_before(second, known, positions, reach) else { continue };
                let Some(third) = self.number_unless_before(third, known, positions, reach) else { continue };
                let corners = [corner, second, third];
                let seen = corners.map(|corner| corner.at);
                if !faces_viewer(seen, rounding) {
                    return false;
                }
                over_place += usize::from(is_over(seen, place));
                // The sides at the corner, which is inside, are within.
                let is_within = second.is_inside || third.is_inside;
                if !is_within && !keeps_out(second.at, third.at, half, rounding) {
                    return false;
                }
            }
        }
        over_place == 1
    }

    /// Each edge in the patch has a triangle on either side.
    const TWO: EdgeUse = EdgeUse { forward: 1, backward: 1 };

    /// Whether a triangle touches a vertex of the patch; of those, none runs into the triangles that were certified.
    pub(super) fn has(&self, triangle: [u32; 3]) -> bool {
        triangle.iter().any(|&v| self.find(v).is_ok_and(|corner| self.corners[corner].is_inside))
    }

    /// Whether a triangle, which the patch has not, is away from those that were certified.
    pub(super) fn is_away(&self, corners: [Vec3; 3]) -> bool {
        self.view.is_beyond(corners)
    }

    /// The number of a vertex among the corners, or the place of the table that is free for it.
    #[inline]
    fn find(&self, vertex: u32) -> Result<usize, usize> {
        let mut place = vertex.wrapping_mul(HASH) as usize >> (u32::BITS - PLACES.ilog2());
        loop {
            match self.table[place] {
                entry if entry.vertex == vertex => return Ok(entry.corner as usize),
                Self::FREE => return Err(place),
                _ => place = (place + 1) % PLACES,
            }
        }
    }

    /// The number of a vertex among the corners, where it is added if it is not there yet.
    #[inline]
    fn number(&mut self, vertex: u32, positions: &[Vec3], reach: Vec2) -> usize {
        let place = match self.find(vertex) {
            Ok(corner) => return corner,
            Err(free) => free,
        };
        let corner = self.corners.len();
        self.table[place] = Entry { vertex, corner: corner as u32 };
        self.places.push(place as u32);
        let at = self.view.seen(positions[vertex as usize]).truncate();
        self.corners.push(Corner { vertex, at, is_inside: at.abs().cmple(reach).all() });
        corner
    }

    /// A vertex as a corner, added if it is not there yet; `None` where it is inside and stands before `known`.
    #[inline]
    fn number_unless_before(&mut self, vertex: u32, known: usize, positions: &[Vec3], reach: Vec2) -> Option<Corner> {
        let number = self.number(vertex, positions, reach);
        let corner = self.corners[number];
        (!corner.is_inside || number > known).then_some(corner)
    }
}

/// Whether a triangle faces the viewer, for certain.
fn faces_viewer([a, b, c]: [Vec2; 3], rounding: f32) -> bool {
    let (ab, ac) = (b - a, c - a);
    let reach = ab.abs().element_sum() + ac.abs().element_sum();
    ab.perp_dot(ac) > 2.0 * rounding * (reach + rounding)
}

/// Whether a triangle that faces the viewer lies over a place.
fn is_over(corners: [Vec2; 3], place: Vec2) -> bool {
    (0..3).all(|i| (corners[(i + 1) % 3] - corners[i]).perp_dot(place - corners[i]) >= 0.0)
}

/// Whether the segment from `a` to `b` keeps out of the rectangle around the origin that is twice `half` wide, by more than
/// `rounding`.
fn keeps_out(a: Vec2, b: Vec2, half: Vec2, rounding: f32) -> bool {
    let half = half + 2.0 * rounding;
    if a.min(b).cmpgt(half).any() || a.max(b).cmplt(-half).any() {
        return true;
    }
    let across = (b - a).perp();
    across.dot(a).abs() > across.abs().dot(half) + 4.0 * rounding * across.abs().element_sum()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::crossing::{Face, cross};
    use super::super::{SurfaceIndex, TriMesh, self_intersections};
    use super::*;

    /// A strip of quads split in two, from `(0, 0)` to `(1, 1)`.
    fn strip(long: u32, wide: u32, at: impl Fn(f32, f32) -> Vec3) -> TriMesh {
        let vertex = |x: u32, y: u32| y * (long + 1) + x;
        let places = (0..=wide).flat_map(|y| (0..=long).map(move |x| (x, y)));
        let triangles = (0..wide).flat_map(|y| (0..long).map(move |x| (x, y))).flat_map(|(x, y)| {
            let (a, b, c, d) = (vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1));
            [[a, b, c], [a, c, d]]
        });
        TriMesh {
            positions: places.map(|(x, y)| at(x as f32 / long as f32, y as f32 / wide as f32)).collect(),
            triangles: triangles.collect(),
        }
    }

    fn one_by_one(mesh: &TriMesh) -> Vec<u32> {
        let face = |t: usize| Face { vertices: mesh.triangles[t], corners: mesh.corners(t) };
        let count = mesh.triangles.len();
        let runs = |s: usize| (0..count).any(|t| t != s && cross(&face(s.min(t)), &face(s.max(t))));
        (0..count).filter(|&s| runs(s)).map(|s| s as u32).collect()
    }

    /// Whether the triangles within `radius` of the middle are certified.
    fn is_certified(mesh: &TriMesh, radius: f32) -> bool {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        let near = |leaf: &&Leaf| leaf.corners.iter().all(|p| p.truncate().length() < radius);
        let leaves: Vec<&Leaf> = index.leaves.iter().filter(near).collect();
        assert!(leaves.len() >= 8);
        let extent = Extent::of(leaves.iter().copied());
        Patch::new().certify(leaves.into_iter(), &extent, &mesh.positions, &mesh.triangles, &topology)
    }

    fn wavy(height: f32) -> TriMesh {
        strip(40, 40, |x, y| Vec3::new(20.0 * x - 10.0, 20.0 * y - 10.0, height * (9.0 * x).sin() * (7.0 * y).cos()))
    }

    #[test]
    fn a_wavy_sheet_is_certified_away_from_its_boundary() {
        assert!(is_certified(&wavy(1.0), 4.0));
        assert!(!is_certified(&wavy(1.0), 12.0), "the boundary lies in the rectangle");
    }

    #[test]
    fn neither_a_hole_nor_a_triangle_turned_over_nor_a_third_on_an_edge_is_certified() {
        let whole = wavy(0.5);
        // The sheet's middle: half a row on from half of the rows.
        let middle = whole.triangles.len() / 2 + 40;
        let mut hole = whole.clone();
        hole.triangles.remove(middle);
        let mut turned = whole.clone();
        turned.triangles[middle].swap(1, 2);
        let mut third = whole.clone();
        let [a, b, _] = whole.triangles[middle];
        third.positions.push(Vec3::new(0.1, 0.1, 3.0));
        third.triangles.push([a, b, third.positions.len() as u32 - 1]);
        let mut folded = whole.clone();
        folded.positions[whole.triangles[middle][0] as usize] += Vec3::new(2.0, 1.0, 0.0);
        assert!(is_certified(&whole, 4.0));
        for broken in [hole, turned, third, folded] {
            assert!(!is_certified(&broken, 4.0));
        }
    }

    /// A ramp that goes around twice: every triangle of it faces upwards, and two lie over one another everywhere.
    #[test]
    fn a_ramp_that_goes_around_twice_runs_into_itself_where_its_storeys_do() {
        for sway in [0.0, 1.0, 3.0] {
            let ramp = strip(96, 6, |along, across| {
                let angle = along * 4.0 * std::f32::consts::PI;
                let radius = 4.0 + 6.0 * across;
                let z = 2.0 * along + sway * (1.5 * angle).sin();
                Vec3::new(radius * angle.cos(), radius * angle.sin(), z)
            });
            let found = self_intersections(&ramp);
            assert_eq!(found, one_by_one(&ramp), "{sway}");
            assert_eq!(found.is_empty(), sway == 0.0, "{sway}: {}", found.len());
        }
    }

    #[test]
    fn a_segment_keeps_out_of_a_rectangle_or_cuts_a_corner_of_it() {
        let half = Vec2::new(2.0, 1.0);
        let keeps = |ax: f32, ay: f32, bx: f32, by: f32| keeps_out(Vec2::new(ax, ay), Vec2::new(bx, by), half, 1e-6);
        assert!(keeps(2.1, -5.0, 2.1, 5.0) && keeps(-5.0, 1.1, 5.0, 1.2) && keeps(1.0, 2.5, 4.0, 0.0));
        assert!(!keeps(1.9, -5.0, 1.9, 5.0) && !keeps(-5.0, 0.9, 5.0, 0.9) && !keeps(1.0, 1.4, 3.0, 0.0));
        assert!(!keeps(-5.0, -3.0, 5.0, 3.0) && !keeps(0.0, 0.0, 0.1, 0.1));
    }

    #[test]
    fn only_what_turns_to_the_viewer_by_more_than_rounding_faces_it() {
        let faces = |x: f32| faces_viewer([Vec2::ZERO, Vec2::X, Vec2::new(x, 1e-3)], 1e-6);
        assert!(faces(0.5) && !faces(f32::NAN));
        assert!(!faces_viewer([Vec2::ZERO, Vec2::X, Vec2::new(0.5, 1e-6)], 1e-6), "too flat to say");
        assert!(!faces_viewer([Vec2::X, Vec2::ZERO, Vec2::new(0.5, 1.0)], 1e-6), "turned away");
    }

    proptest! {
        #[test]
        fn crumpled_sheets_run_into_themselves_as_pairs_do(
            noise in prop::collection::vec(prop::array::uniform3(-1.0f32..1.0), 19 * 13),
            amount in 0.0f32..1.5,
            bend in 0.0f32..7.0,
        ) {
            let mut sheet = strip(18, 12, |x, y| {
                let angle = bend * (x - 0.5);
                Vec3::new(9.0 * angle.sin(), 12.0 * y, 9.0 * angle.cos())
            });
            if bend < 0.1 {
                sheet = strip(18, 12, |x, y| Vec3::new(18.0 * x, 12.0 * y, 0.0));
            }
            for (p, n) in sheet.positions.iter_mut().zip(noise) {
                *p += Vec3::from(n) * amount;
            }
            prop_assert_eq!(self_intersections(&sheet), one_by_one(&sheet));
        }
    }
}
