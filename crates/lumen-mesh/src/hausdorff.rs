//! Whether a surface stays within a distance of another, for certain: a decision on the one-sided Hausdorff distance.
//!
//! The distance from one triangle is a convex function, so where all corners of a convex piece are within the bound of
//! one triangle, all of the piece is (the certificate of Guthe, Borodin and Klein, "Fast and accurate Hausdorff
//! distance calculation between meshes", 2005, and of Tang, Lee and Kim, "Interactive Hausdorff distance computation for
//! general polygonal models", 2009). Each triangle of the first surface begins as one piece. A piece that has no such
//! triangle is cut along the sides of the triangle that is nearest to its middle, so that what is left overlays the
//! second surface and the number of pieces does not depend on the bound; where that cuts nothing off, it is halved. A
//! piece may also be so small, and so near, that the distance of its middle settles it.
//!
//! From the largest distance that samples have found, [`reach`] raises the bound until nothing is beyond it: the distance
//! itself, for certain.
//!
//! "Within" is exact but for the rounding of f64, "beyond" to [`TOLERANCE`] and the rounding of a point to f32: samples
//! are nowhere taken for the whole.

use std::task::Poll;

use glam::{DVec3, Vec3};

use super::TriMesh;
use super::nearest::{Leaf, Nearest, SurfaceIndex};
use super::task::Yielder;

/// What lies between "within" and "beyond", as a part of the bound.
pub const TOLERANCE: f64 = 1e-3;

/// Most corners of a piece; one that has more is halved.
const CORNERS: usize = 10;

/// The rounding of a distance to f32.
const F32_ROUNDING: f64 = 1e-7;

/// A length below this part of the size of the coordinates is lost in their rounding.
const ROUNDING: f64 = 1e-12;

/// A point of one surface that is far from another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FarPoint {
    /// The point, in mm.
    pub point: Vec3,
    /// Its distance from the other surface in mm; never more than the truth.
    pub distance: f64,
}

/// The one-sided Hausdorff distance of a surface from another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// The point of the surface that is farthest, but for less than [`TOLERANCE`] three times of its distance.
    pub farthest: FarPoint,
    /// No point of the surface is farther, in mm.
    pub at_most_mm: f64,
}

/// Pieces that are settled between two looks at the clock.
const PIECES: usize = 64;

/// How far `mesh` reaches from `surface`; `None` where one of them has no triangle, or a corner that is not finite.
/// `known_mm`, a distance that some point is known to have, or 0, saves time.
pub async fn reach(mesh: &TriMesh, surface: &SurfaceIndex, known_mm: f64, yielder: &Yielder) -> Option<Reach> {
    let first = mesh.positions[mesh.triangles.first()?[0] as usize];
    let nearest = surface.nearest(first)?;
    let mut farthest = FarPoint { point: first, distance: f64::from(nearest.distance) };
    // What is nearer than the rounding of the coordinates is no distance.
    let size = mesh.positions.iter().map(|p| p.abs().max_element()).fold(0.0, f32::max);
    let raised = |distance: f64, by: f64| distance * (1.0 + by * TOLERANCE);
    let mut bound = HausdorffBound::new(raised(farthest.distance, 2.0).max(f64::from(size * f32::EPSILON)));
    if known_mm > bound.within {
        // Whoever has that distance is found: it is beyond a bound that is a little less.
        bound = HausdorffBound::new(raised(known_mm, -1.0));
    }
    for t in 0..mesh.triangles.len() {
        bound.begin(mesh.corners(t));
        loop {
            match bound.advance(surface, PIECES) {
                Poll::Ready(None) => break,
                Poll::Ready(Some(found)) if found.distance.is_finite() => {
                    if found.distance > farthest.distance {
                        farthest = found;
                    }
                    bound.raise(raised(found.distance.max(bound.within), 2.0));
                }
                Poll::Ready(Some(_)) => return None,
                Poll::Pending => yielder.rest(t as f32 / mesh.triangles.len() as f32).await,
            }
        }
        if t % PIECES == 0 {
            yielder.rest(t as f32 / mesh.triangles.len() as f32).await;
        }
    }
    Some(Reach { farthest, at_most_mm: bound.within })
}

/// Whether triangles of one surface lie within a bound of another, piece by piece.
#[derive(Clone, Debug)]
pub struct HausdorffBound {
    /// A piece whose points are all within this is settled.
    within: f64,
    /// A point that is farther than this is beyond.
    beyond: f64,
    pieces: Vec<Piece>,
    last: Option<Nearest>,
    /// The triangle that settled a piece last.
    by: Option<u32>,
}

/// A convex piece of a triangle: its corners in order.
#[derive(Clone, Copy, Debug)]
struct Piece {
    corners: [DVec3; CORNERS],
    count: usize,
}

/// What is known of a piece.
enum Verdict {
    Within,
    FarPoint(FarPoint),
    /// Neither yet; the triangle nearest to its middle, and how near that is.
    Open(Leaf, f64),
}

impl HausdorffBound {
    /// Nothing tested yet; `bound` in mm, above 0.
    pub fn new(bound: f64) -> Self {
        Self { within: bound, beyond: bound * (1.0 - TOLERANCE), pieces: Vec::new(), last: None, by: None }
    }

    /// Another bound, in mm, for what is not settled yet of the triangle that is tested, and for those that follow.
    pub fn raise(&mut self, bound: f64) {
        (self.within, self.beyond) = (bound, bound * (1.0 - TOLERANCE));
    }

    /// The triangle of the surface that settled a piece last.
    pub fn nearest(&self) -> Option<u32> {
        self.by
    }

    /// Puts a triangle to the test.
    pub fn begin(&mut self, corners: [Vec3; 3]) {
        self.pieces.clear();
        self.pieces.push(Piece::triangle(corners.map(Vec3::as_dvec3)));
    }

    /// Settles up to `work` pieces: `Ready(None)` where the triangle is within the bound of `surface`, or a point of
    /// it that is farther than the bound less [`TOLERANCE`].
    pub fn advance(&mut self, surface: &SurfaceIndex, work: usize) -> Poll<Option<FarPoint>> {
        for _ in 0..work.max(1) {
            let Some(piece) = self.pieces.pop() else { return Poll::Ready(None) };
            match self.judge(&piece, surface) {
                Verdict::Within => {}
                Verdict::FarPoint(found) => {
                    self.pieces.push(piece);
                    return Poll::Ready(Some(found));
                }
                Verdict::Open(nearest, distance) => self.divide(&piece, &nearest, distance),
            }
        }
        if self.pieces.is_empty() { Poll::Ready(None) } else { Poll::Pending }
    }

    fn judge(&mut self, piece: &Piece, surface: &SurfaceIndex) -> Verdict {
        let bound = self.within * self.within;
        let hint = self.last.and_then(|last| surface.leaves.get(last.slot as usize));
        // The hint may be of another surface: what counts is the triangle that stands in its place here.
        if let Some(leaf) = hint.filter(|leaf| piece.is_within(leaf, bound)) {
            self.by = Some(leaf.triangle);
            return Verdict::Within;
        }
        let middle = piece.middle();
        let query = middle.as_vec3();
        let found = match &self.last {
            Some(last) => surface.nearest_from(query, last),
            None => surface.nearest(query),
        };
        let Some(found) = found else {
            return Verdict::FarPoint(FarPoint { point: query, distance: f64::INFINITY });
        };
        self.last = Some(found);
        let leaf = surface.leaves[found.slot as usize];
        self.by = Some(leaf.triangle);
        // The query is the middle but for rounding.
        let aside = middle.distance(query.as_dvec3());
        let found = f64::from(found.distance);
        let beyond = FarPoint { point: query, distance: (found * (1.0 - F32_ROUNDING) - aside).max(0.0) };
        if beyond.distance > self.beyond {
            return Verdict::FarPoint(beyond);
        }
        let distance = found * (1.0 + F32_ROUNDING) + aside;
        let radius = piece.radius(middle);
        if distance + radius <= self.within || piece.is_within(&leaf, bound) {
            return Verdict::Within;
        }
        let size = middle.abs().max_element();
        if radius <= ((self.within - self.beyond) / 2.0).max(size * ROUNDING) {
            return Verdict::FarPoint(beyond);
        }
        Verdict::Open(leaf, distance)
    }

    /// Cuts a piece along the sides of `nearest`, or in half.
    fn divide(&mut self, piece: &Piece, nearest: &Leaf, distance: f64) {
        let [a, b, c] = nearest.corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        // Where halves will soon be settled by their middles alone, the sides of small triangles cost more.
        let size = (b - a).length_squared().max((c - a).length_squared());
        let slack = self.within - distance;
        let is_near = slack * slack > size;
        if !nearest.is_sliver && !is_near {
            // The triangle reaches beyond its sides: so far, or half as far at its corners.
            let height = piece.corners().iter().map(|&p| normal.dot(p - a).abs()).fold(0.0, f64::max);
            let margin = (self.within * self.within - height * height).max(0.0).sqrt() / 2.0;
            for margin in [margin, 0.0] {
                if self.cut_off(piece, [a, b, c], normal, margin) {
                    return;
                }
            }
        }
        self.pieces.extend(piece.halves());
    }

    /// Cuts a piece `margin` beside the sides of a triangle; whether that took anything off. With a margin, which differs
    /// from piece to piece, only cuts count that get on; the sides themselves cut a piece once.
    fn cut_off(&mut self, piece: &Piece, [a, b, c]: [DVec3; 3], normal: DVec3, margin: f64) -> bool {
        let mut rest = *piece;
        let before = self.pieces.len();
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let outward = (to - from).cross(normal).normalize_or_zero();
            let least = if margin > 0.0 { 0.1 } else { 1e-6 };
            if let Some([inside, outside]) = rest.cut(from + outward * margin, outward, least) {
                self.pieces.push(outside);
                rest = inside;
            }
        }
        let is_cut = self.pieces.len() > before;
        if is_cut {
            self.pieces.push(rest);
        }
        is_cut
    }
}

impl Piece {
    fn triangle([a, b, c]: [DVec3; 3]) -> Self {
        let mut corners = [DVec3::ZERO; CORNERS];
        (corners[0], corners[1], corners[2]) = (a, b, c);
        Self { corners, count: 3 }
    }

    fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    fn middle(&self) -> DVec3 {
        self.corners().iter().sum::<DVec3>() / self.count as f64
    }

    /// Distance of the farthest corner, and so of any point, from `middle`.
    fn radius(&self, middle: DVec3) -> f64 {
        self.corners().iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max).sqrt()
    }

    /// Whether all of the piece is within the bound, squared, of one triangle.
    fn is_within(&self, leaf: &Leaf, bound: f64) -> bool {
        self.corners().iter().all(|&p| leaf.project_point(p).squared <= bound)
    }

    fn push(&mut self, p: DVec3) {
        self.corners[self.count] = p;
        self.count += 1;
    }

    /// The parts below and above the plane through `origin` with unit normal `up`; `None` where one of them would have
    /// less than the part `least` of the height, or the piece has too many corners to be cut.
    fn cut(&self, origin: DVec3, up: DVec3, least: f64) -> Option<[Self; 2]> {
        if self.count == CORNERS {
            return None;
        }
        let height = |i: usize| (self.corners[i] - origin).dot(up);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..self.count {
            low = low.min(height(i));
            high = high.max(height(i));
        }
        // What lies along the plane is on both sides of it by rounding alone.
        let first = self.corners[0];
        let size = self.corners().iter().map(|p| p.distance_squared(first)).fold(0.0, f64::max).sqrt();
        let slight = (least * (high - low)).max(1e-9 * size).max(1e-14 * first.abs().max_element());
        if !(low < -slight && high > slight) {
            return None;
        }
        let mut parts = [Self { corners: [DVec3::ZERO; CORNERS], count: 0 }; 2];
        for i in 0..self.count {
            let j = (i + 1) % self.count;
            let (p, q) = (self.corners[i], self.corners[j]);
            let (from, to) = (height(i), height(j));
            if from <= 0.0 {
                parts[0].push(p);
            }
            if from >= 0.0 {
                parts[1].push(p);
            }
            if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
                let crossing = p + (q - p) * (from / (from - to));
                parts[0].push(crossing);
                parts[1].push(crossing);
            }
        }
        Some(parts)
    }

    /// Two halves: of a triangle across its longest side, of another piece along a diagonal.
    fn halves(&self) -> [Self; 2] {
        let p = self.corners();
        if let &[a, b, c] = p {
            let sides = [(a, b, c), (b, c, a), (c, a, b)];
            let longest = sides.into_iter().max_by(|x, y| {
                let length = |side: &(DVec3, DVec3, DVec3)| side.0.distance_squared(side.1);
                length(x).total_cmp(&length(y))
            });
            let (a, b, c) = longest.unwrap_or((a, b, c));
            let middle = a.midpoint(b);
            return [Self::triangle([a, middle, c]), Self::triangle([middle, b, c])];
        }
        let half = self.count / 2;
        let mut parts = [Self { corners: [DVec3::ZERO; CORNERS], count: 0 }; 2];
        p[..=half].iter().for_each(|&p| parts[0].push(p));
        p[half..].iter().chain([&p[0]]).for_each(|&p| parts[1].push(p));
        parts
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::TriMesh;
    use crate::shapes::{icosphere, sagitta, square};
    use crate::task::at_once;

    /// The first triangle of `a` that is beyond `bound` of `b`, and the pieces that it took to say so.
    fn beyond(a: &TriMesh, b: &TriMesh, bound: f64) -> (Option<FarPoint>, usize) {
        let index = SurfaceIndex::new(&b.positions, &b.triangles);
        let mut reach = HausdorffBound::new(bound);
        let mut pieces = 0;
        for t in 0..a.triangles.len() {
            reach.begin(a.corners(t));
            loop {
                pieces += 1;
                match reach.advance(&index, 1) {
                    Poll::Pending => {}
                    Poll::Ready(None) => break,
                    Poll::Ready(found) => return (found, pieces),
                }
            }
        }
        (None, pieces)
    }

    #[test]
    fn the_depth_of_a_valley_between_the_corners_is_found() {
        // From a flat square down to a valley 3 mm below its middle line: the walls are 4 x 3 / 5 mm from that line.
        let flat = square(1, 8.0, 0.0);
        let mut valley = square(8, 8.0, 0.0);
        valley.positions.iter_mut().for_each(|p| p.z = -3.0 * (1.0 - (p.x - 4.0).abs() / 4.0));
        assert_eq!(beyond(&flat, &valley, 2.403).0, None);
        for bound in [2.39, 1.0, 0.01] {
            let found = beyond(&flat, &valley, bound).0.unwrap();
            assert!(found.distance > bound * (1.0 - TOLERANCE) && found.distance <= 2.400_001, "{found:?}");
        }
        // The other way it is as deep as it is.
        assert_eq!(beyond(&valley, &flat, 3.004).0, None);
        assert!(beyond(&valley, &flat, 2.99).0.is_some());
    }

    #[test]
    fn a_sphere_is_within_the_difference_of_radii_and_no_less() {
        let (small, large) = (icosphere(4, 10.0, Vec3::ONE), icosphere(3, 12.0, Vec3::ONE));
        let slack = f64::from(sagitta(&small, 10.0, Vec3::ONE).max(sagitta(&large, 12.0, Vec3::ONE)));
        for (a, b) in [(&small, &large), (&large, &small)] {
            assert_eq!(beyond(a, b, 2.0 + slack).0, None);
            assert!(beyond(a, b, 2.0 - slack).0.is_some());
        }
    }

    /// How far `a` reaches from `b`, with nothing known, and with less than it known.
    fn reached(a: &TriMesh, b: &TriMesh) -> Reach {
        let index = SurfaceIndex::new(&b.positions, &b.triangles);
        let [found, known] = [0.0, 0.9].map(|part| {
            let known = part * at_once(reach(a, &index, 0.0, &Yielder::never())).unwrap().farthest.distance;
            at_once(reach(a, &index, known, &Yielder::never())).unwrap()
        });
        assert!((known.farthest.distance / found.farthest.distance - 1.0).abs() <= 4.0 * TOLERANCE);
        found
    }

    #[test]
    fn the_largest_distance_is_found_for_certain_where_no_corner_has_it() {
        let flat = square(1, 8.0, 0.0);
        let mut valley = square(8, 8.0, 0.0);
        valley.positions.iter_mut().for_each(|p| p.z = -3.0 * (1.0 - (p.x - 4.0).abs() / 4.0));
        // As in the test before: 2.4 mm down from the middle line, where the flat square has no corner; 3 mm up from it.
        for (a, b, truth) in [(&flat, &valley, 2.4), (&valley, &flat, 3.0)] {
            let Reach { farthest, at_most_mm } = reached(a, b);
            assert!(farthest.distance <= truth * (1.0 + 1e-6) && at_most_mm >= truth, "{farthest:?}, {at_most_mm}");
            assert!(at_most_mm <= farthest.distance * (1.0 + 4.0 * TOLERANCE), "{farthest:?}, {at_most_mm}");
            assert!((farthest.point.x - 4.0).abs() < 0.1, "{farthest:?}");
        }
    }

    #[test]
    fn a_surface_does_not_reach_from_itself_and_nothing_reaches_from_nothing() {
        let sphere = icosphere(3, 20.0, Vec3::new(100.0, 50.0, -30.0));
        assert!(reached_from_itself(&sphere) < 1e-4);
        let index = SurfaceIndex::new(&[], &[]);
        assert_eq!(at_once(reach(&sphere, &index, 0.0, &Yielder::never())), None);
    }

    fn reached_from_itself(mesh: &TriMesh) -> f64 {
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        at_once(reach(mesh, &index, 0.0, &Yielder::never())).unwrap().at_most_mm
    }

    #[test]
    fn the_number_of_pieces_depends_on_the_triangles_and_hardly_on_the_bound() {
        // A large triangle above a fine grid: it has to be overlaid with all of it.
        let large = TriMesh {
            positions: vec![Vec3::new(1.0, 1.0, 0.0), Vec3::new(31.0, 2.0, 0.0), Vec3::new(3.0, 30.0, 0.0)],
            triangles: vec![[0, 1, 2]],
        };
        let mut grid = square(32, 32.0, 0.0);
        grid.positions.iter_mut().enumerate().for_each(|(i, p)| p.z = 1e-3 * (i % 7) as f32);
        for bound in [0.0065, 0.01, 0.1, 1.0, 10.0] {
            let (found, pieces) = beyond(&large, &grid, bound);
            assert_eq!(found, None, "{bound}");
            assert!(pieces < 20 * grid.triangles.len(), "{bound}: {pieces}");
        }
    }

    #[test]
    fn a_needle_along_the_sides_of_triangles_comes_to_an_end() {
        // Thinner than rounding, along an edge of a roof: cut by that edge's planes it would stay as it is for ever.
        for height in [0.0, 0.1, 1.0] {
            let roof = TriMesh {
                positions: vec![
                    Vec3::ZERO,
                    Vec3::new(3.1, 4.7, 0.3),
                    Vec3::new(5.0, -2.0, height),
                    Vec3::new(-4.0, 3.0, height),
                ],
                triangles: vec![[0, 2, 1], [0, 1, 3]],
            };
            let tip = Vec3::new(3.1, 4.7, 0.3);
            let needle = TriMesh {
                positions: vec![Vec3::ZERO, tip, tip * 0.37 + Vec3::new(1e-7, 0.0, 0.0)],
                triangles: vec![[0, 1, 2]],
            };
            for lift in [0.0, 0.01, 0.5] {
                let mut lifted = needle.clone();
                lifted.positions.iter_mut().for_each(|p| p.z += lift);
                for bound in [0.3, 0.05, 0.0101] {
                    let (found, pieces) = beyond(&lifted, &roof, bound);
                    assert!(pieces < 100_000, "{height}, {lift}, {bound}: {found:?} after {pieces}");
                }
            }
        }
    }

    #[test]
    fn what_rounding_leaves_undecided_is_not_within() {
        // A gap whose middle lies half-way between two coordinates of f32: the middle is farther from both sides than the
        // bound, no place that f32 has is.
        let (edge, step) = (1024.0f32, 1.0 / 8192.0f32);
        let [left, right] = [edge, edge + 201.0 * step];
        let sides = |x: f32, far: f32| [Vec3::new(x, -9.0, 0.0), Vec3::new(x, 9.0, 0.0), Vec3::new(far, 0.0, 0.0)];
        let gap = TriMesh {
            positions: [sides(left, 1000.0), sides(right, 1048.0)].concat(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
        };
        let [low, high] = [left - step, right + step];
        let across = TriMesh {
            positions: vec![Vec3::new(low, 0.0, 0.0), Vec3::new(high, 0.0, 0.0), Vec3::new(high, step, 0.0)],
            triangles: vec![[0, 1, 2]],
        };
        let half = f64::from(right - left) / 2.0;
        let found = beyond(&across, &gap, half * 0.999).0;
        assert!(found.is_some_and(|found| found.distance <= half), "{found:?}");
        assert_eq!(beyond(&across, &gap, half * 1.0001).0, None);
    }

    #[test]
    fn everything_is_beyond_a_surface_of_nothing() {
        let found = beyond(&square(1, 1.0, 0.0), &TriMesh::default(), 1e9).0;
        assert_eq!(found.map(|found| found.distance), Some(f64::INFINITY));
    }

    #[test]
    fn no_size_of_coordinates_keeps_it_from_an_end() {
        for size in [1e-30f32, 1e-6, 1.0, 1e6, 1e18] {
            let (flat, apart) = (square(4, size, 0.0), square(3, size, size));
            assert!(beyond(&flat, &apart, f64::from(size) * 0.99).0.is_some(), "{size}");
            assert_eq!(beyond(&flat, &apart, f64::from(size) * 1.01).0, None, "{size}");
            assert_eq!(beyond(&flat, &flat, f64::from(size) * 1e-3).0, None, "{size}");
        }
    }

    fn point() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(prop_oneof![(-4i8..=4).prop_map(f32::from), -4.0f32..4.0]).prop_map(Vec3::from)
    }

    fn soup() -> impl Strategy<Value = TriMesh> {
        prop::collection::vec(prop::array::uniform3(point()), 1..24).prop_map(|list| TriMesh {
            triangles: (0..list.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
            positions: list.into_flattened(),
        })
    }

    proptest! {
        /// Samples bound the truth from below, and from above with their spacing: the answer must lie between.
        #[test]
        fn the_answer_is_that_of_dense_samples(corners in prop::array::uniform3(point()), b in soup(),
                                               part in 0.2f64..2.0) {
            let index = SurfaceIndex::new(&b.positions, &b.triangles);
            let n = 60;
            let [p, q, r] = corners.map(Vec3::as_dvec3);
            let mut most = 0.0f64;
            for i in 0..=n {
                for j in 0..=n - i {
                    let at = p + ((q - p) * f64::from(i) + (r - p) * f64::from(j)) / f64::from(n);
                    most = most.max(f64::from(index.nearest(at.as_vec3()).unwrap().distance));
                }
            }
            let spacing = p.distance(q).max(q.distance(r)).max(r.distance(p)) / f64::from(n);
            let bound = (most * part).max(1e-3);
            let a = TriMesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2]] };
            match beyond(&a, &b, bound).0 {
                None => prop_assert!(most <= bound + 1e-5),
                Some(found) => {
                    prop_assert!(found.distance >= bound * (1.0 - 3.0 * TOLERANCE));
                    prop_assert!(found.distance <= most + spacing + 1e-5);
                    let there = index.nearest(found.point).unwrap().distance;
                    prop_assert!((f64::from(there) - found.distance).abs() <= 1e-5);
                }
            }
        }
    }
}
