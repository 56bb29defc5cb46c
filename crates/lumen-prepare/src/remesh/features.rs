//! Feature curves of the surface that enters: rims, borders between patches, and creases, as chains of edges between
//! corners.
//!
//! A crease is an edge at which the faces turn by more than [`CREASE_DEG`], and so does the surface to both sides of
//! it, seen over a wanted edge: the steps of a voxel grid do not. An edge of a triangle so thin that it has no normal
//! to speak of is no crease, nor is a connected piece of creases shorter than [`SHORTEST`] wanted edges, nor a chain
//! that could not be resolved, be it too short or too near to another. Rims and borders always are features.

use glam::{DVec3, Vec3};
use lumen_mesh::disjoint_sets::{root, union};
use lumen_mesh::{Nearest, SurfaceIndex};

use super::net::{CORNER, FREE, NONE, Net};
use super::triangle::doubled;
use super::walk::Walk;

/// Faces that turn by more than this at an edge make it a crease; degrees.
const CREASE_DEG: f64 = 50.0;
/// A curve that turns by more than this at a vertex has a corner there; degrees.
const CORNER_DEG: f64 = 50.0;
/// Least length of connected creases, in wanted edges.
const SHORTEST: f64 = 6.0;
/// Least length of a chain of creases that ends in no other, in wanted edges.
const SHORTEST_END: f64 = 3.0;
/// A crease nearer than this to another curve leaves no room for triangles between; in wanted edges.
const ROOM: f32 = 0.4;
/// The part of its length along which a crease has another curve so near that it is dropped.
const CROWDED: f64 = 0.75;
/// The turn at a vertex counts over this part of a wanted edge to both sides too.
const REACH: f64 = 0.5;
/// How far to both sides of a crease normals are looked at, in wanted edges.
const REACH_OF_CREASE: f64 = 1.5;
/// Where normals are looked at on a side of a crease: away from it and along it, in parts of that.
const SAMPLES: [(f64, f64); 9] =
    [(0.2, -0.3), (0.2, 0.0), (0.2, 0.3), (0.5, -0.4), (0.5, 0.1), (0.5, 0.4), (0.8, -0.2), (0.8, 0.0), (0.8, 0.3)];
/// A triangle whose doubled area is below this part of its longest edge squared has no normal.
const THIN: f64 = 0.02;

/// The feature curves as segments.
#[derive(Clone, Debug, Default)]
pub(super) struct Curves {
    /// The ends of each segment, in vertices of the surface that entered.
    pub(super) segments: Vec<[u32; 2]>,
    /// The curve of each segment.
    of_segment: Vec<u32>,
    index: SurfaceIndex,
    /// Whether creases were dropped that have no room beside others.
    pub(super) were_crowded: bool,
}

impl Curves {
    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.of_segment.iter().max().map_or(0, |&last| last as usize + 1)
    }

    /// The point of a curve nearest to `p`; `None` where another curve is nearer.
    pub(super) fn nearest(&self, p: Vec3, curve: u32) -> Option<Nearest> {
        let found = self.index.nearest(p)?;
        (self.of_segment.get(found.triangle as usize) == Some(&curve)).then_some(found)
    }
}

/// Unit normal of a triangle that is not too thin to have one.
fn normal(net: &Net, t: u32) -> Option<DVec3> {
    let [a, b, c] = net.corners(t).map(Vec3::as_dvec3);
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    let doubled = (b - a).cross(c - a);
    let length = doubled.length();
    (length > THIN * longest).then(|| doubled / length)
}

/// Finds the feature curves of `net`, whose sizes are known, and notes them in it; creases that have no room beside others
/// too if it `keeps_crowded` ones.
pub(super) fn find(net: &mut Net, walk: &Walk, keeps_crowded: bool) -> Curves {
    let mut is_crease = mark(net, walk);
    let mut were_crowded = false;
    let kinds = net.kind.clone();
    loop {
        drop_short_pieces(net, &mut is_crease);
        let counts = counts(net);
        for (v, &count) in counts.iter().enumerate() {
            if count != 0 && (count != 2 || has_corner(net, &counts, v as u32)) {
                net.kind[v] = CORNER;
            }
        }
        let mut curves = chains(net, &counts);
        if !drop_weak(net, &curves, &counts, &mut is_crease) {
            let triangles: Vec<[u32; 3]> = curves.segments.iter().map(|&[a, b]| [a, b, b]).collect();
            curves.index = SurfaceIndex::new(&net.at, &triangles);
            if keeps_crowded || !drop_crowded(net, &curves, &mut is_crease) {
                return Curves { were_crowded, ..curves };
            }
            were_crowded = true;
        }
        net.kind.clone_from(&kinds);
    }
}

/// Features not yet in a chain.
const UNNAMED: u32 = 0;

/// Marks feature edges by [`UNNAMED`], and returns for each half-edge whether it is one as a crease alone.
fn mark(net: &mut Net, walk: &Walk) -> Vec<bool> {
    let normals: Vec<Option<DVec3>> = (0..net.patch.len() as u32).map(|t| normal(net, t)).collect();
    let limit = libm::cos(CREASE_DEG.to_radians());
    let mut is_crease = vec![false; net.origin.len()];
    for h in 0..net.half_edges() {
        let g = net.twin(h);
        if g == NONE {
            net.curve[h as usize] = UNNAMED;
        } else if h < g {
            let (t, s) = ((h / 3) as usize, (g / 3) as usize);
            if net.patch[t] != net.patch[s] {
                net.curve[h as usize] = UNNAMED;
                net.curve[g as usize] = UNNAMED;
            } else if let (Some(one), Some(other)) = (normals[t], normals[s])
                && one.dot(other) < limit
                && bends_widely(net, walk, h, [one, other], limit)
            {
                net.curve[h as usize] = UNNAMED;
                net.curve[g as usize] = UNNAMED;
                is_crease[h as usize] = true;
                is_crease[g as usize] = true;
            }
        }
    }
    is_crease
}

/// Takes the mark from the edges for which `is_weak`.
fn unmark(net: &mut Net, is_crease: &mut [bool], is_weak: impl Fn(&Net, u32) -> bool) -> bool {
    let mut is_any = false;
    for h in 0..net.half_edges() {
        if is_crease[h as usize] && net.is_edge(h) && is_weak(net, h) {
            for e in [h, net.twin(h)] {
                is_crease[e as usize] = false;
                net.curve[e as usize] = NONE;
            }
            is_any = true;
        }
    }
    is_any
}

/// Drops connected creases that are shorter than [`SHORTEST`] together.
fn drop_short_pieces(net: &mut Net, is_crease: &mut [bool]) {
    if !is_crease.contains(&true) {
        return;
    }
    let mut pieces: Vec<u32> = (0..net.at.len() as u32).collect();
    let creases: Vec<u32> = (0..net.half_edges()).filter(|&h| is_crease[h as usize] && net.is_edge(h)).collect();
    for &h in &creases {
        union(&mut pieces, net.origin(h), net.end(h));
    }
    let mut lengths = vec![0.0f64; net.at.len()];
    for &h in &creases {
        lengths[root(&mut pieces, net.origin(h)) as usize] += f64::from(net.stretch(h)).sqrt();
    }
    for v in 0..net.at.len() as u32 {
        pieces[v as usize] = root(&mut pieces, v);
    }
    unmark(net, is_crease, |net, h| lengths[pieces[net.origin(h) as usize] as usize] < SHORTEST);
}

/// Drops chains of creases that are shorter than a wanted edge, and those shorter than [`SHORTEST_END`] that end in no
/// other; whether there are any.
fn drop_weak(net: &mut Net, curves: &Curves, counts: &[u32], is_crease: &mut [bool]) -> bool {
    let mut lengths = vec![0.0f64; curves.count()];
    let mut has_end = vec![false; curves.count()];
    for (&[a, b], &curve) in curves.segments.iter().zip(&curves.of_segment) {
        lengths[curve as usize] += f64::from(net.stretch_between(a, b)).sqrt();
        has_end[curve as usize] |= counts[a as usize] == 1 || counts[b as usize] == 1;
    }
    unmark(net, is_crease, |net, h| {
        let curve = net.curve[h as usize] as usize;
        lengths[curve] < if has_end[curve] { SHORTEST_END } else { 1.0 }
    })
}

/// Drops chains of creases that run beside another one, or a rim or border, nearer than triangles fit between: along
/// [`CROWDED`] of their length nearer than [`ROOM`]. Of two that do the longer one stays. Whether there are any.
fn drop_crowded(net: &mut Net, curves: &Curves, is_crease: &mut [bool]) -> bool {
    let mut is_of_crease = vec![false; curves.count()];
    for h in (0..net.half_edges()).filter(|&h| is_crease[h as usize]) {
        is_of_crease[net.curve[h as usize] as usize] = true;
    }
    let mut lengths = vec![0.0f64; curves.count()];
    let mut of_curve = vec![Vec::new(); curves.count()];
    for (s, (&[a, b], &curve)) in curves.segments.iter().zip(&curves.of_segment).enumerate() {
        lengths[curve as usize] += f64::from(net.stretch_between(a, b)).sqrt();
        of_curve[curve as usize].push(s);
    }
    let mut creases: Vec<usize> = (0..curves.count()).filter(|&c| is_of_crease[c]).collect();
    creases.sort_by(|&c, &d| lengths[d].total_cmp(&lengths[c]).then(c.cmp(&d)));
    let mut is_kept: Vec<bool> = is_of_crease.iter().map(|of_crease| !of_crease).collect();
    for &curve in &creases {
        let is_other = |s: u32| is_kept[curves.of_segment[s as usize] as usize];
        let is_near = |s: &&usize| {
            let [a, b] = curves.segments[**s];
            let middle = net.at[a as usize].midpoint(net.at[b as usize]);
            let room = ROOM * f32::midpoint(net.size[a as usize], net.size[b as usize]);
            curves.index.nearest_of(middle, is_other).is_some_and(|found| found.distance < room)
        };
        let length = |&s: &usize| {
            let [a, b] = curves.segments[s];
            f64::from(net.stretch_between(a, b)).sqrt()
        };
        let near: f64 = of_curve[curve].iter().filter(is_near).map(length).sum();
        is_kept[curve] = near <= CROWDED * lengths[curve];
    }
    unmark(net, is_crease, |net, h| !is_kept[net.curve[h as usize] as usize])
}

/// Whether the surface at `h`, whose faces have these normals, turns as seen over a wanted edge: the mean normals of
/// places to both sides, up to that far away.
fn bends_widely(net: &Net, walk: &Walk, h: u32, normals: [DVec3; 2], limit: f64) -> bool {
    let [a, b] = [net.origin(h), net.end(h)].map(|v| net.at[v as usize].as_dvec3());
    let (middle, along) = (a.midpoint(b), (b - a).normalize_or_zero());
    let size = f64::from(f32::midpoint(net.size[net.origin(h) as usize], net.size[net.end(h) as usize]));
    let sides = [(h / 3, normals[0].cross(along)), (net.twin(h) / 3, along.cross(normals[1]))];
    let [one, other] = sides.map(|(mut triangle, away)| {
        let mut sum = DVec3::ZERO;
        for (out, aside) in SAMPLES {
            let p = middle + (away.normalize_or_zero() * out + along * aside) * (REACH_OF_CREASE * size);
            triangle = walk.from(triangle, p.as_vec3(), 0.0).triangle;
            sum += doubled(net.corners(triangle)).as_dvec3().normalize_or_zero();
        }
        sum.normalize_or_zero()
    });
    one.dot(other) < limit
}

/// Feature edges at each vertex.
fn counts(net: &Net) -> Vec<u32> {
    let mut counts = vec![0; net.at.len()];
    for h in (0..net.half_edges()).filter(|&h| net.is_edge(h) && net.is_feature(h)) {
        counts[net.origin(h) as usize] += 1;
        counts[net.end(h) as usize] += 1;
    }
    counts
}

/// Whether a curve turns by more than [`CORNER_DEG`] at a vertex, seen from its neighbours and from farther away.
fn has_corner(net: &Net, counts: &[u32], v: u32) -> bool {
    let Some([a, b]) = net.along_curve(v) else { return false };
    let at = |v: u32| net.at[v as usize].as_dvec3();
    let limit = libm::cos(CORNER_DEG.to_radians());
    let turns = |a: DVec3, b: DVec3| {
        let (before, after) = ((at(v) - a).normalize_or_zero(), (b - at(v)).normalize_or_zero());
        before.dot(after) < limit
    };
    let reach = REACH * f64::from(net.size[v as usize]);
    let ahead = |mut to: u32| {
        let (mut from, mut length) = (v, at(v).distance(at(to)));
        while length < reach && counts[to as usize] == 2 {
            let Some([one, other]) = net.along_curve(to) else { break };
            let on = if one == from { other } else { one };
            if on == v {
                break;
            }
            length += at(to).distance(at(on));
            (from, to) = (to, on);
        }
        at(to)
    };
    turns(at(a), at(b)) && turns(ahead(a), ahead(b))
}

/// Names the chains of feature edges between corners, and those that go round.
fn chains(net: &mut Net, counts: &[u32]) -> Curves {
    let mut curves = Curves::default();
    let mut was_named = vec![false; net.origin.len()];
    let mut name = 0;
    for h in 0..net.half_edges() {
        if net.is_feature(h) && !was_named[h as usize] {
            follow(net, h, name, &mut was_named, &mut curves);
            name += 1;
        }
    }
    for (v, &count) in counts.iter().enumerate() {
        if count == 2 && net.kind[v] == FREE {
            let along = net.neighbours(v as u32).find(|&(_, h)| net.is_feature(h));
            net.kind[v] = along.map_or(CORNER, |(_, h)| net.curve[h as usize]);
        }
    }
    curves
}

/// Names the chain that `h` is in, to both sides.
fn follow(net: &mut Net, h: u32, name: u32, was_named: &mut [bool], curves: &mut Curves) {
    let mut ahead = vec![h];
    while let Some(h) = ahead.pop() {
        if std::mem::replace(&mut was_named[h as usize], true) {
            continue;
        }
        net.curve[h as usize] = name;
        let g = net.twin(h);
        if g != NONE {
            was_named[g as usize] = true;
            net.curve[g as usize] = name;
        }
        let (a, b) = (net.origin(h), net.end(h));
        curves.segments.push([a, b]);
        curves.of_segment.push(name);
        for v in [a, b].into_iter().filter(|&v| net.kind[v as usize] != CORNER) {
            let on = net.neighbours(v).map(|(_, e)| e).filter(|&e| net.is_feature(e) && !was_named[e as usize]);
            ahead.extend(on);
        }
    }
}
