//! The steps of Botsch and Kobbelt, "A remeshing approach to multiresolution modeling" (2004): long edges are split,
//! short ones collapsed, edges flipped towards six neighbours a vertex, and vertices relaxed along the surface, with
//! lengths that differ from place to place (Dunyach, Vanderhaeghe, Barthe and Botsch, "Adaptive remeshing for real-time
//! mesh deformation", 2013).
//!
//! A vertex on a feature curve splits, collapses and relaxes along the curve alone, a corner stays.

use std::sync::OnceLock;

use glam::Vec3;
use lumen_mesh::SurfaceIndex;

use super::features::Curves;
use super::measure::Target;
use super::net::{CORNER, FREE, Foot, NONE, Net, next, prev};
use super::ring::Ring;
use super::triangle::{doubled, faces_along, is_thin, may_become, quality, sharpness};
use super::walk::Walk;

/// An edge above this many wanted lengths is split, squared.
pub(super) const LONG: f32 = 16.0 / 9.0;
/// What a collapse may make of an edge at first: 1.6 wanted lengths, squared.
pub(super) const LONGER: f32 = 2.56;
/// An edge below this many wanted lengths is collapsed, squared.
const SHORT: f32 = 16.0 / 25.0;
/// An edge below this many wanted lengths is tiny, squared: no vessel that has a shape at this size is so narrow.
const TINY: f32 = 0.09;
/// Passes over all edges in which they are split, at most: each halves the longest ones.
const SPLIT_PASSES: usize = 60;
/// Passes in which edges are collapsed, at most.
const COLLAPSE_PASSES: usize = 20;
/// A pass that collapses fewer edges than this part of the triangles is the last one.
const FEW: usize = 200;
/// The part of its way to the middle of its neighbours that a vertex goes.
const DAMPING: f32 = 0.9;
/// A vertex that would go by less than this part of a wanted length stays.
const AT_REST: f32 = 0.02;
/// A flip makes no triangle of a lesser quality than this, unless it was there.
const FLIP_QUALITY: f32 = 0.3;
/// Cosine of the most that two faces turn at an edge that a flip makes, or is made of: 45 degrees.
const FLIP_TURN: f32 = 0.7;

/// The surface that entered, to project on.
#[derive(Clone, Debug)]
pub(super) struct Original {
    /// As a net, before the steps.
    pub(super) first: Net,
    /// Its triangles, in the vertices that the net began with.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Their normals, as long as twice their area.
    pub(super) normals: Vec<Vec3>,
    /// Their patches.
    pub(super) patch: Vec<u32>,
    /// An index of them, once it was asked for: most vertices are found without.
    pub(super) index: OnceLock<SurfaceIndex>,
    /// A way over them.
    pub(super) walk: Walk,
    /// Feature curves.
    pub(super) curves: Curves,
    /// Wanted lengths at its vertices, in mm.
    pub(super) lengths: Vec<f32>,
}

/// A place on the surface that entered.
#[derive(Clone, Copy)]
pub(super) struct Place {
    at: Vec3,
    foot: Foot,
    near: u32,
    size: f32,
}

impl Place {
    /// Where it is, in mm.
    pub(super) fn at(&self) -> Vec3 {
        self.at
    }

    /// The wanted length there, in mm.
    pub(super) fn size(&self) -> f32 {
        self.size
    }
}

impl Original {
    /// The index of its triangles.
    pub(super) fn index(&self) -> &SurfaceIndex {
        self.index.get_or_init(|| SurfaceIndex::new(&self.first.at, &self.triangles))
    }

    /// The surface to measure distances from.
    pub(super) fn to_measure(&self) -> Target<'_> {
        Target { walk: &self.walk, index: self.index() }
    }

    /// The place of the same curve, or of the same patch, that is nearest to `p`, for a vertex that is there or near.
    pub(super) fn project(&self, net: &Net, v: u32, p: Vec3) -> Option<Place> {
        match net.kind[v as usize] {
            CORNER => None,
            FREE => self.project_free(net, v, p, facing(net, v)),
            curve => {
                let found = self.curves.nearest(p, curve)?;
                let [u, v, w] = found.barycentric;
                let foot = Foot { on: found.triangle, weights: [u, v + w, 0.0] };
                Some(Place { at: found.point, foot, near: NONE, size: self.size_at(curve, foot) })
            }
        }
    }

    /// As [`Self::project`], for a vertex of no curve where the surface faces there.
    fn project_free(&self, net: &Net, v: u32, p: Vec3, facing: Vec3) -> Option<Place> {
        let is_own = |t: u32| self.normals[t as usize].dot(facing) >= 0.0;
        let size = net.size[v as usize];
        let found = self.walk.from(net.near[v as usize], p, 0.0);
        let (on, at, weights) = if found.squared <= f64::from(size * size) && is_own(found.triangle) {
            (found.triangle, found.point, found.weights)
        } else {
            let mut found = self.index().nearest(p)?;
            // Where two walls nearly touch, the nearest may be the other one, which faces the other way.
            if !is_own(found.triangle) {
                found = self.index().nearest_of(p, is_own).filter(|own| own.distance <= size)?;
            }
            (found.triangle, found.point, found.barycentric)
        };
        let patch = net.patch[(net.out[v as usize] / 3) as usize];
        if self.patch[on as usize] != patch {
            return None;
        }
        let foot = Foot { on, weights };
        Some(Place { at, foot, near: on, size: self.size_at(FREE, foot) })
    }

    /// The wanted length at a foot, of a vertex of this kind.
    pub(super) fn size_at(&self, kind: u32, foot: Foot) -> f32 {
        let at = |v: u32| self.lengths[v as usize];
        let [x, y, z] = foot.weights;
        if kind == FREE {
            let [a, b, c] = self.triangles[foot.on as usize].map(at);
            a * x + b * y + c * z
        } else {
            let [a, b] = self.curves.segments[foot.on as usize].map(at);
            a * x + b * y
        }
    }
}

/// The normal at a vertex, weighted by area; not of unit length.
pub(super) fn facing(net: &Net, v: u32) -> Vec3 {
    net.around(v).fold(Vec3::ZERO, |sum, h| sum + doubled(net.corners(h / 3)))
}

/// Whether a vertex can go to `p` with no face turned over.
fn may_move(net: &Net, v: u32, p: Vec3) -> bool {
    net.around(v).all(|h| {
        let [b, c] = [next(h), prev(h)].map(|e| net.at[net.origin(e) as usize]);
        may_become([net.at[v as usize], b, c], [p, b, c], || facing(net, v))
    })
}

/// Moves a vertex to a place, unless that turns a face over.
pub(super) fn settle(net: &mut Net, v: u32, place: &Place) -> bool {
    let may = may_move(net, v, place.at);
    if may {
        put(net, v, place);
    }
    may
}

fn put(net: &mut Net, v: u32, place: &Place) {
    net.at[v as usize] = place.at;
    net.size[v as usize] = place.size;
    net.foot[v as usize] = place.foot;
    net.is_adrift[v as usize] = false;
    if place.near != NONE {
        net.near[v as usize] = place.near;
    }
    net.wake_ring(v);
}

/// Splits long edges until there are none, or more triangles than `most`; returns how many triangles that made.
pub(super) fn split_long(net: &mut Net, original: &Original, most: usize) -> usize {
    let before = net.triangle_count();
    let is_long = |net: &Net, h: u32| net.is_edge(h) && net.stretch(h) > LONG;
    let mut long: Vec<u32> = (0..net.half_edges()).filter(|&h| is_long(net, h)).collect();
    for _ in 0..SPLIT_PASSES {
        let mut count = 0;
        // Those that a split makes come last.
        let mut left = Vec::new();
        let mut made = Vec::new();
        for h in long {
            if net.triangle_count() >= most {
                return net.triangle_count() - before;
            }
            let stretch = net.stretch(h);
            if stretch <= LONG {
                continue;
            }
            if !is_longest(net, h, stretch) || !can_halve(net, h) {
                left.push(h);
                continue;
            }
            let m = net.split(h);
            if let Some(place) = original.project(net, m, net.at[m as usize]) {
                net.size[m as usize] = place.size;
                settle(net, m, &place);
            }
            made.extend(net.neighbours(m).map(|(_, h)| net.edge(h)));
            count += 1;
        }
        if count == 0 {
            break;
        }
        left.extend(made.into_iter().filter(|&h| is_long(net, h)));
        left.sort_unstable();
        left.dedup();
        long = left;
    }
    net.triangle_count() - before
}

/// Whether an edge is long enough for its middle to differ from its ends by more than rounding.
fn can_halve(net: &Net, h: u32) -> bool {
    let [a, b] = [net.origin(h), net.end(h)].map(|v| net.at[v as usize]);
    a.distance(b) > 16.0 * f32::EPSILON * a.abs().max(b.abs()).max_element()
}

/// Whether no edge of the triangles beside `h` is more stretched.
fn is_longest(net: &Net, h: u32, stretch: f32) -> bool {
    let is_longest_in = |h: u32| net.stretch(next(h)) <= stretch && net.stretch(prev(h)) <= stretch;
    let g = net.twin(h);
    is_longest_in(h) && (g == NONE || is_longest_in(g))
}

/// Collapses short edges around which something has changed `since` then; returns how many triangles are gone by it.
pub(super) fn collapse_short(net: &mut Net, longest: f32, since: u32) -> usize {
    let before = net.triangle_count();
    // Whether something around a vertex has changed; at first all is asked for.
    let mut is_open = vec![since == 0; net.at.len()];
    if since > 0 {
        for v in (0..net.at.len() as u32).filter(|&v| net.is_there(v) && net.was_touched(v, since)) {
            is_open[v as usize] = true;
            net.neighbours(v).for_each(|(n, _)| is_open[n as usize] = true);
        }
    }
    let is_short = |net: &Net, h: u32| net.stretch(h) < SHORT;
    let is_asked = |&h: &u32| {
        net.is_edge(h) && (is_open[net.origin(h) as usize] || is_open[net.end(h) as usize]) && is_short(net, h)
    };
    let mut edges: Vec<u32> = (0..net.half_edges()).filter(is_asked).collect();
    is_open.fill(false);
    for _ in 0..COLLAPSE_PASSES {
        let mut count = 0;
        let mut open = Vec::new();
        for h in edges {
            // What was listed may be gone or have become another.
            if !net.is_edge(h) || !is_short(net, h) {
                continue;
            }
            let mut ways = [h, net.twin(h)];
            // The vertex with fewer neighbours goes.
            if ways[1] != NONE && net.valence(net.origin(ways[1])) < net.valence(net.origin(h)) {
                ways.swap(0, 1);
            }
            for way in ways {
                if way != NONE && keeps_lengths(net, way, longest) && net.can_collapse(way) && keeps_faces(net, way) {
                    let left = net.end(way);
                    net.collapse(way);
                    for v in net.neighbours(left).map(|(n, _)| n).chain([left]) {
                        if !std::mem::replace(&mut is_open[v as usize], true) {
                            open.push(v);
                        }
                    }
                    count += 1;
                    break;
                }
            }
        }
        if count * FEW <= net.triangle_count() {
            break;
        }
        open.retain(|&v| net.is_there(v));
        edges = Vec::with_capacity(4 * open.len());
        for &v in &open {
            // An edge between two of them comes once.
            let is_first = |n: u32| v < n || !is_open[n as usize];
            let short = net.neighbours(v).filter(|&(n, _)| is_first(n) && net.stretch_between(v, n) < SHORT);
            edges.extend(short.map(|(_, h)| net.edge(h)));
        }
        open.iter().for_each(|&v| is_open[v as usize] = false);
    }
    before - net.triangle_count()
}

/// Whether the collapse of an edge to its end turns no face over. At a tiny edge a face that does turn, as those of a spike, may
/// if it comes to face where the surface around both ends does; a sliver that stays one faces nowhere.
pub(super) fn keeps_faces(net: &Net, h: u32) -> bool {
    let (v, w) = (net.origin(h), net.end(h));
    let (start, target) = (net.at[v as usize], net.at[w as usize]);
    let is_tiny = net.stretch(h) < TINY;
    let around = || facing(net, v) + facing(net, w);
    net.around(v).all(|e| {
        let [b, c] = [net.end(e), net.apex(e)];
        let [p, q] = [b, c].map(|v| net.at[v as usize]);
        let (old, new) = ([start, p, q], [target, p, q]);
        let is_kept = || may_become(old, new, || facing(net, v)) || (is_tiny && faces_along(new, around()));
        b == w || c == w || is_kept() || (is_tiny && is_thin(old) && is_thin(new))
    })
}

/// Whether the collapse of an edge to its end makes no edge longer than `longest`, squared, in wanted lengths.
pub(super) fn keeps_lengths(net: &Net, h: u32, longest: f32) -> bool {
    let (v, w) = (net.origin(h), net.end(h));
    net.neighbours(v).all(|(n, _)| n == w || net.stretch_between(n, w) <= longest)
}

/// Flips edges where the numbers of neighbours come nearer to what they should be, six and four at a rim, and something
/// has changed `since` then; returns how many.
pub(super) fn flip_to_valence(net: &mut Net, since: u32) -> usize {
    let mut count = 0;
    let mut excess = vec![-6i32; net.at.len()];
    for h in (0..net.half_edges()).filter(|&h| net.is_live(h)) {
        let v = net.origin(h) as usize;
        excess[v] += 1;
        // A rim vertex has a neighbour more than triangles.
        excess[v] += if net.twin(h) == NONE { 3 } else { 0 };
    }
    for h in 0..net.half_edges() {
        let Some(ends) = quad(net, h).filter(|ends| ends.iter().any(|&v| net.was_touched(v, since))) else { continue };
        let gain = |v: u32, change: i32| {
            if net.kind[v as usize] == CORNER {
                return 0;
            }
            let excess = excess[v as usize];
            excess * excess - (excess + change) * (excess + change)
        };
        let [v, w, a, b] = ends;
        if gain(v, -1) + gain(w, -1) + gain(a, 1) + gain(b, 1) > 0 && may_flip(net, ends, FLIP_QUALITY) {
            net.flip(h);
            count += 1;
            excess[v as usize] -= 1;
            excess[w as usize] -= 1;
            excess[a as usize] += 1;
            excess[b as usize] += 1;
        }
    }
    count
}

/// Flips edges where the least angle of the two triangles grows, and something has changed `since` then.
pub(super) fn flip_to_angles(net: &mut Net, since: u32) {
    for h in 0..net.half_edges() {
        if quad(net, h).is_some_and(|ends| ends.iter().any(|&v| net.was_touched(v, since))) {
            flip_if_wider(net, h);
        }
    }
}

/// Flips an edge if the least angle of its two triangles grows.
pub(super) fn flip_if_wider(net: &mut Net, h: u32) -> bool {
    /// By this much in the cosine.
    const ENOUGH: f32 = 1e-3;
    let Some(ends) = quad(net, h) else { return false };
    let [v, w, a, b] = ends.map(|v| net.at[v as usize]);
    let before = sharpness([v, w, a]).max(sharpness([w, v, b]));
    let after = sharpness([a, b, w]).max(sharpness([b, a, v]));
    let may = after < before - ENOUGH && may_flip(net, ends, 0.0);
    if may {
        net.flip(h);
    }
    may
}

/// The ends of the edge that `h` stands for, and what is opposite, where it can be flipped.
fn quad(net: &Net, h: u32) -> Option<[u32; 4]> {
    if !net.is_edge(h) || net.is_feature(h) || net.twin(h) == NONE {
        return None;
    }
    Some([net.origin(h), net.end(h), net.apex(h), net.apex(net.twin(h))])
}

/// Whether an edge with these ends and opposite corners can be flipped: the four lie nearly in a plane and go round,
/// and no triangle gets worse than `least`, or than those that were there.
fn may_flip(net: &Net, [v, w, a, b]: [u32; 4], least: f32) -> bool {
    let [p, q, r, s] = [v, w, a, b].map(|v| net.at[v as usize]);
    let old = [doubled([p, q, r]), doubled([q, p, s])];
    let new = [doubled([r, s, q]), doubled([s, r, p])];
    let normal = (old[0] + old[1]).normalize_or_zero();
    let is_flat = new.iter().all(|n| n.dot(normal) > FLIP_TURN * n.length());
    let turn = new[0].dot(new[1]) > FLIP_TURN * new[0].length() * new[1].length();
    let worst = quality([r, s, q]).min(quality([s, r, p]));
    let was = quality([p, q, r]).min(quality([q, p, s]));
    is_flat && turn && worst > least.min(was) && worst > 1e-4 && !net.are_neighbours(a, b)
}

/// Moves the vertices that are awake along the surface to the middle of their triangles, one after the other.
pub(super) fn relax(net: &mut Net, original: &Original) {
    let mut ring = Ring::default();
    for v in 0..net.at.len() as u32 {
        if net.out[v as usize] == NONE || !net.is_awake[v as usize] {
            continue;
        }
        net.is_awake[v as usize] = false;
        let p = net.at[v as usize];
        let is_ring = net.kind[v as usize] == FREE && ring.gather(net, v);
        let (way, facing) = if is_ring { ring.pull() } else { (way_along_curve(net, v), Vec3::ZERO) };
        let rest = AT_REST * net.size[v as usize];
        let is_adrift = net.is_adrift[v as usize];
        let way = way * DAMPING;
        // False for what is no number.
        let has_way = way.length_squared() >= rest * rest;
        if !has_way && !is_adrift {
            continue;
        }
        let to = if has_way { p + way } else { p };
        let place = if is_ring { original.project_free(net, v, to, facing) } else { original.project(net, v, to) };
        let Some(place) = place else { continue };
        if is_ring && ring.surely_allows(place.at - p) {
            put(net, v, &place);
        } else if !settle(net, v, &place) && is_adrift {
            // It is back on the surface at least.
            if let Some(place) = original.project(net, v, p) {
                settle(net, v, &place);
            }
        }
    }
}

/// Where a vertex of a curve would go, seen from it, not yet on the curve.
fn way_along_curve(net: &Net, v: u32) -> Vec3 {
    let p = net.at[v as usize];
    if matches!(net.kind[v as usize], CORNER | FREE) {
        return Vec3::ZERO;
    }
    let Some([a, b]) = net.along_curve(v) else { return Vec3::ZERO };
    let [to_a, to_b] = [a, b].map(|n| net.at[n as usize] - p);
    let [size_a, size_b] = [a, b].map(|n| net.size[n as usize] + net.size[v as usize]);
    let (long_a, long_b) = (to_a.length(), to_b.length());
    let step = (long_a + long_b) * size_a / (size_a + size_b) - long_a;
    (if step > 0.0 { to_b / long_b } else { to_a / long_a }) * step.abs()
}
