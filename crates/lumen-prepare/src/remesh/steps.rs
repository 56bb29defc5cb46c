//! The steps of Botsch and Kobbelt, "A remeshing approach to multiresolution modeling" (2004): long edges are split,
//! short ones collapsed, edges flipped towards six neighbours a vertex, and vertices relaxed along the surface, with
//! lengths that differ from place to place (Dunyach, Vanderhaeghe, Barthe and Botsch, "Adaptive remeshing for real-time
//! mesh deformation", 2013).
//!
//! A vertex on a feature curve splits, collapses and relaxes along the curve alone, a corner stays.

use glam::Vec3;
use lumen_mesh::{Nearest, SurfaceIndex, parallel};

use super::features::Curves;
use super::net::{CORNER, FREE, NONE, Net, next, prev};
use super::triangle::{doubled, may_become, quality, sharpness};

/// An edge above this many wanted lengths is split, squared.
pub(super) const LONG: f32 = 16.0 / 9.0;
/// What a collapse may make of an edge at first: 1.6 wanted lengths, squared.
pub(super) const LONGER: f32 = 2.56;
/// An edge below this many wanted lengths is collapsed, squared.
const SHORT: f32 = 16.0 / 25.0;
/// Passes over all edges in which they are split, at most: each halves the longest ones.
const SPLIT_PASSES: usize = 60;
/// Passes in which edges are collapsed, at most.
const COLLAPSE_PASSES: usize = 20;
/// A pass that collapses fewer edges than this part of the triangles is the last one.
const FEW: usize = 200;
/// The part of its way to the middle of its neighbours that a vertex goes.
const DAMPING: f32 = 0.5;
/// A vertex that would go by less than this part of a wanted length stays.
const AT_REST: f32 = 0.02;
/// Vertices that one thread relaxes at a time.
const CHUNK: usize = 2048;
/// A flip makes no triangle of a lesser quality than this, unless it was there.
const FLIP_QUALITY: f32 = 0.3;
/// Cosine of the most that two faces turn at an edge that a flip makes, or is made of: 45 degrees.
const FLIP_TURN: f32 = 0.7;

/// The surface that entered, to project on.
pub(super) struct Original {
    /// Its triangles, in the vertices that the net began with.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Their normals, as long as twice their area.
    pub(super) normals: Vec<Vec3>,
    /// Their patches.
    pub(super) patch: Vec<u32>,
    /// An index of them.
    pub(super) index: SurfaceIndex,
    /// Feature curves.
    pub(super) curves: Curves,
    /// Wanted lengths at its vertices, in mm.
    pub(super) lengths: Vec<f32>,
}

/// A place on the surface that entered.
#[derive(Clone, Copy)]
pub(super) struct Place {
    at: Vec3,
    foot: Nearest,
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
    /// The place of the same curve, or of the same patch, that is nearest to `p`, for a vertex that is there or near.
    pub(super) fn project(&self, net: &Net, v: u32, p: Vec3) -> Option<Place> {
        let kind = net.kind[v as usize];
        let (foot, corners) = match kind {
            CORNER => return None,
            FREE => {
                let mut found = match &net.foot[v as usize] {
                    Some(last) => self.index.nearest_from(p, last)?,
                    None => self.index.nearest(p)?,
                };
                // Where two walls nearly touch, the nearest may be the other one, which faces the other way.
                let facing = facing(net, v);
                let is_own = |t: u32| self.normals[t as usize].dot(facing) >= 0.0;
                if !is_own(found.triangle) {
                    found = self.index.nearest_of(p, is_own).filter(|own| own.distance <= net.size[v as usize])?;
                }
                let patch = net.patch[(net.out[v as usize] / 3) as usize];
                if self.patch[found.triangle as usize] != patch {
                    return None;
                }
                (found, self.triangles[found.triangle as usize])
            }
            curve => {
                let found = self.curves.nearest(p, curve)?;
                let [a, b] = self.curves.segments[found.triangle as usize];
                (found, [a, b, b])
            }
        };
        let [a, b, c] = corners.map(|v| self.lengths[v as usize]);
        let [u, v, w] = foot.barycentric;
        Some(Place { at: foot.point, foot, size: a * u + b * v + c * w })
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
        net.at[v as usize] = place.at;
        net.size[v as usize] = place.size;
        net.foot[v as usize] = Some(place.foot);
        net.is_adrift[v as usize] = false;
    }
    may
}

/// Splits long edges until there are none, or more triangles than `most`.
pub(super) fn split_long(net: &mut Net, original: &Original, most: usize) {
    for _ in 0..SPLIT_PASSES {
        let mut count = 0;
        let mut h = 0;
        while h < net.half_edges() && net.triangle_count() < most {
            if net.is_edge(h) {
                let stretch = net.stretch(h);
                if stretch > LONG && is_longest(net, h, stretch) && can_halve(net, h) {
                    let m = net.split(h);
                    if let Some(place) = original.project(net, m, net.at[m as usize]) {
                        net.size[m as usize] = place.size;
                        settle(net, m, &place);
                    }
                    count += 1;
                }
            }
            h += 1;
        }
        if count == 0 {
            break;
        }
    }
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

/// Collapses short edges.
pub(super) fn collapse_short(net: &mut Net, longest: f32) {
    for _ in 0..COLLAPSE_PASSES {
        let mut count = 0;
        for h in 0..net.half_edges() {
            if !net.is_edge(h) || net.stretch(h) >= SHORT {
                continue;
            }
            let mut ways = [h, net.twin(h)];
            // The vertex with fewer neighbours goes.
            if ways[1] != NONE && net.valence(net.origin(ways[1])) < net.valence(net.origin(h)) {
                ways.swap(0, 1);
            }
            for way in ways {
                if way != NONE && net.can_collapse(way) && keeps_shape(net, way, longest) {
                    net.collapse(way);
                    count += 1;
                    break;
                }
            }
        }
        if count * FEW <= net.triangle_count() {
            break;
        }
    }
}

/// Whether the collapse of an edge to its end turns no face over and makes no edge longer than `longest`, squared, in
/// wanted lengths.
pub(super) fn keeps_shape(net: &Net, h: u32, longest: f32) -> bool {
    let (v, w) = (net.origin(h), net.end(h));
    let target = net.at[w as usize];
    let is_kept = net.around(v).all(|e| {
        let [b, c] = [net.end(e), net.apex(e)];
        let [p, q] = [b, c].map(|v| net.at[v as usize]);
        b == w || c == w || may_become([net.at[v as usize], p, q], [target, p, q], || facing(net, v))
    });
    is_kept && net.neighbours(v).all(|(n, _)| n == w || net.stretch_between(n, w) <= longest)
}

/// Flips edges where the numbers of neighbours come nearer to what they should be, six and four at a rim.
pub(super) fn flip_to_valence(net: &mut Net) {
    let mut excess = vec![-6i32; net.at.len()];
    for h in (0..net.half_edges()).filter(|&h| net.is_live(h)) {
        let v = net.origin(h) as usize;
        excess[v] += 1;
        // A rim vertex has a neighbour more than triangles.
        excess[v] += if net.twin(h) == NONE { 3 } else { 0 };
    }
    for h in 0..net.half_edges() {
        let Some(ends) = quad(net, h) else { continue };
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
            excess[v as usize] -= 1;
            excess[w as usize] -= 1;
            excess[a as usize] += 1;
            excess[b as usize] += 1;
        }
    }
}

/// Flips edges where the least angle of the two triangles grows.
pub(super) fn flip_to_angles(net: &mut Net) -> usize {
    let mut count = 0;
    for h in 0..net.half_edges() {
        count += usize::from(flip_if_wider(net, h));
    }
    count
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

/// Where a vertex goes.
enum Step {
    Stay,
    /// Beside the surface.
    Drift(Vec3),
    Settle(Place),
}

/// Moves vertices along the surface to the middle of their triangles, each weighted by its area in wanted lengths; free
/// ones are put back on the surface if `is_last`.
pub(super) fn relax(net: &mut Net, original: &Original, is_last: bool) {
    let steps = parallel::map_ranges(net.at.len(), CHUNK, |vertices| {
        let step = |v: usize| {
            if net.out[v] == NONE {
                return Step::Stay;
            }
            let Some(p) = relaxed(net, v as u32) else { return Step::Stay };
            let is_at_rest = p.distance(net.at[v]) < AT_REST * net.size[v];
            if net.kind[v] == FREE && !is_last {
                return if is_at_rest { Step::Stay } else { Step::Drift(p) };
            }
            if is_at_rest && !net.is_adrift[v] {
                return Step::Stay;
            }
            original.project(net, v as u32, p).map_or(Step::Stay, Step::Settle)
        };
        vertices.map(step).collect::<Vec<Step>>()
    });
    for (v, step) in steps.into_iter().flatten().enumerate() {
        match step {
            Step::Stay => {}
            Step::Drift(p) => {
                if may_move(net, v as u32, p) {
                    net.at[v] = p;
                    net.is_adrift[v] = true;
                }
            }
            Step::Settle(place) => {
                if !settle(net, v as u32, &place) && net.is_adrift[v] {
                    // It is back on the surface at least.
                    if let Some(place) = original.project(net, v as u32, net.at[v]) {
                        settle(net, v as u32, &place);
                    }
                }
            }
        }
    }
}

/// Where a vertex would go, not yet on the surface.
fn relaxed(net: &Net, v: u32) -> Option<Vec3> {
    let p = net.at[v as usize];
    match net.kind[v as usize] {
        CORNER => None,
        FREE => {
            let (mut sum, mut weights, mut normal) = (Vec3::ZERO, 0.0, Vec3::ZERO);
            for h in net.around(v) {
                let vertices = [h, next(h), prev(h)].map(|e| net.origin(e) as usize);
                let [_, b, c] = vertices.map(|v| net.at[v]);
                let size = vertices.iter().map(|&v| net.size[v]).sum::<f32>();
                let area = doubled([p, b, c]);
                let weight = area.length() / (size * size);
                sum += ((b - p) + (c - p)) / 3.0 * weight;
                weights += weight;
                normal += area;
            }
            let (step, normal) = (sum / weights, normal.normalize_or_zero());
            let along = step - normal * step.dot(normal);
            along.is_finite().then(|| p + along * DAMPING)
        }
        _ => {
            let [a, b] = net.along_curve(v)?;
            let [to_a, to_b] = [a, b].map(|n| net.at[n as usize] - p);
            let [size_a, size_b] = [a, b].map(|n| net.size[n as usize] + net.size[v as usize]);
            let (long_a, long_b) = (to_a.length(), to_b.length());
            let step = (long_a + long_b) * size_a / (size_a + size_b) - long_a;
            let along = if step > 0.0 { to_b / long_b } else { to_a / long_a };
            let moved = p + along * (step.abs() * DAMPING);
            moved.is_finite().then_some(moved)
        }
    }
}
