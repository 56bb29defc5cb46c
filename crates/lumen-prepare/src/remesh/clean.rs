//! What is left with small angles after the steps: edges are flipped, vertices moved and edges collapsed where the
//! least angle around grows by it.
//!
//! A vertex is moved by a pattern search along the surface (Freitag and Ollivier-Gooch, "Tetrahedral mesh improvement
//! using swapping and smoothing", 1997, have the idea of moving a vertex for the worst of its elements).

use glam::Vec3;

use super::net::{CORNER, FREE, NONE, Net, next, prev};
use super::steps::{Original, facing, flip_if_wider, keeps_faces, keeps_lengths, settle};
use super::triangle::sharpness;

/// Cosine of the angle from which on a triangle is good: 33 degrees.
const GOOD: f32 = 0.838_67;
/// First step of the search, as a part of the wanted length; it is halved as often as [`HALVINGS`].
const STEP: f32 = 0.2;
const HALVINGS: usize = 4;
/// Moves of one search, at most.
const MOVES: usize = 12;
/// A collapse may make edges of 1.5 wanted lengths, squared.
const LONGEST: f32 = 2.25;
/// Rounds, at most.
const ROUNDS: usize = 8;

/// Widens small angles, as far as it can.
pub(super) fn widen_angles(net: &mut Net, original: &Original) {
    for _ in 0..ROUNDS {
        let mut count = 0;
        for t in 0..net.patch.len() as u32 {
            count += usize::from(is_sharp(net, t) && widen(net, original, t));
        }
        if count == 0 {
            break;
        }
    }
}

fn is_sharp(net: &Net, t: u32) -> bool {
    net.is_live(3 * t) && sharpness(net.corners(t)) > GOOD
}

/// Whether something could be done about a triangle.
fn widen(net: &mut Net, original: &Original, t: u32) -> bool {
    let edges = [3 * t, 3 * t + 1, 3 * t + 2];
    for h in edges {
        let one_of_two = h.min(net.twin(h));
        if flip_if_wider(net, one_of_two) {
            return true;
        }
    }
    let mut has_moved = false;
    for h in edges {
        has_moved |= improve(net, original, net.origin(h));
    }
    if !is_sharp(net, t) {
        return true;
    }
    for h in edges {
        for way in [h, net.twin(h)] {
            if way != NONE && collapse_if_wider(net, way) {
                return true;
            }
        }
    }
    has_moved
}

/// The sharpest triangle around `v`, where it would lie at `p`.
fn sharpest(net: &Net, v: u32, p: Vec3) -> f32 {
    let at = |h: u32| {
        let [b, c] = [next(h), prev(h)].map(|e| net.at[net.origin(e) as usize]);
        sharpness([p, b, c])
    };
    net.around(v).map(at).fold(0.0, f32::max)
}

/// Collapses an edge if the sharpest triangle around what is left is less sharp than the sharpest around the vertex
/// that goes.
fn collapse_if_wider(net: &mut Net, h: u32) -> bool {
    let (v, w) = (net.origin(h), net.end(h));
    let target = net.at[w as usize];
    let stays = |e: &u32| net.end(*e) != w && net.apex(*e) != w;
    let after = |e: u32| sharpness([target, net.at[net.end(e) as usize], net.at[net.apex(e) as usize]]);
    let sharpest_after = net.around(v).filter(stays).map(after).fold(0.0, f32::max);
    let may = sharpest_after < sharpest(net, v, net.at[v as usize]).min(0.95)
        && net.can_collapse(h)
        && keeps_lengths(net, h, LONGEST)
        && keeps_faces(net, h);
    if may {
        net.collapse(h);
    }
    may
}

/// Moves a vertex to where its sharpest triangle is less sharp.
fn improve(net: &mut Net, original: &Original, v: u32) -> bool {
    /// By this much in the cosine.
    const ENOUGH: f32 = 1e-3;
    let start = net.at[v as usize];
    let directions: Vec<Vec3> = match net.kind[v as usize] {
        CORNER => return false,
        FREE => {
            let normal = facing(net, v).normalize_or_zero();
            let side = normal.any_orthonormal_vector();
            let up = normal.cross(side);
            [side, side + up, up, up - side, -side, -side - up, -up, side - up].map(Vec3::normalize_or_zero).to_vec()
        }
        _ => {
            let Some(along) = net.along_curve(v) else { return false };
            along.map(|n| (net.at[n as usize] - start).normalize_or_zero()).to_vec()
        }
    };
    let before = sharpest(net, v, start);
    let (mut best, mut at) = (before, start);
    let mut step = STEP * net.size[v as usize];
    let mut halvings = 0;
    for _ in 0..MOVES {
        let (mut better, mut to) = (best, at);
        for direction in &directions {
            let p = at + *direction * step;
            let value = sharpest(net, v, p);
            if value < better {
                (better, to) = (value, p);
            }
        }
        if better < best {
            (best, at) = (better, to);
        } else if halvings < HALVINGS {
            halvings += 1;
            step /= 2.0;
        } else {
            break;
        }
    }
    if best >= before - ENOUGH {
        return false;
    }
    let Some(place) = original.project(net, v, at) else { return false };
    sharpest(net, v, place.at()) < before - ENOUGH && settle(net, v, &place)
}
