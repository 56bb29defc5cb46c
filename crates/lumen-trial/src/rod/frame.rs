//! The frames of a rod: the tangent and the directors of an edge, and the bend and the twist between two edges.
//!
//! A director is carried from frame to frame by parallel transport: the shortest turn that takes the one tangent to the
//! other.

use glam::DVec3;

/// An edge as it is now.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edge {
    pub(super) length: f64,
    /// 1 / length.
    pub(super) inverse: f64,
    pub(super) tangent: DVec3,
    /// The directors, at right angles to the tangent and each other.
    pub(super) m1: DVec3,
    pub(super) m2: DVec3,
}

/// The bend and the twist at a node as they are now.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Strain {
    /// Discrete curvature towards the director, and across: means of the two edges' frames.
    pub(super) towards: f64,
    pub(super) across: f64,
    /// Twist in radians.
    pub(super) twist: f64,
    /// The vector of the discrete curvature, and its square.
    pub(super) binormal: DVec3,
    pub(super) squared: f64,
    /// 1 / (1 + cos) of the turn.
    pub(super) inverse: f64,
}

impl Edge {
    /// The edge between two nodes. `frame` are the tangent and the director at the start of the step, and `spin` is how far
    /// it has turned about its tangent since, in radians.
    #[inline]
    pub(super) fn new(from: DVec3, to: DVec3, [before, director]: [DVec3; 2], spin: f64) -> Self {
        let along = to - from;
        let length = along.length();
        let tangent = if length > 0.0 { along / length } else { before };
        let across = carried(director, before, tangent);
        let m1 = if spin == 0.0 {
            across
        } else {
            let (sine, cosine) = libm::sincos(spin);
            across * cosine + tangent.cross(across) * sine
        };
        Self { length, inverse: 1.0 / length, tangent, m1, m2: tangent.cross(m1) }
    }
}

impl Strain {
    /// Between two edges; the twist is the one next to `near`.
    #[inline]
    pub(super) fn new(a: &Edge, b: &Edge, near: f64) -> Self {
        let inverse = 1.0 / chi(a.tangent, b.tangent);
        let binormal = a.tangent.cross(b.tangent) * (2.0 * inverse);
        let director = carried(a.m1, a.tangent, b.tangent);
        let twist = unwrapped(angle(-director.dot(b.m2), director.dot(b.m1)), near);
        Self {
            towards: 0.5 * binormal.dot(a.m2 + b.m2),
            across: -0.5 * binormal.dot(a.m1 + b.m1),
            binormal,
            squared: binormal.length_squared(),
            inverse,
            twist,
        }
    }
}

/// `v`, at right angles to `from`, carried to where `from` becomes `to` by the shortest turn; both of length 1.
#[inline]
pub(super) fn carried(v: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    v - (from + to) * (to.dot(v) / chi(from, to))
}

/// The angle of a sine and a cosine, in radians.
#[inline]
fn angle(sine: f64, cosine: f64) -> f64 {
    if cosine < 0.87 {
        return libm::atan2(sine, cosine);
    }
    // Twice the arc tangent of the half angle's tangent, which is at most 0.27: the rest of the series is below 1e-10.
    let t = sine / (1.0 + cosine);
    let s = t * t;
    let tail = 1.0 / 9.0 - s * (1.0 / 11.0 - s * (1.0 / 13.0 - s / 15.0));
    2.0 * t * (1.0 - s * (1.0 / 3.0 - s * (0.2 - s * (1.0 / 7.0 - s * tail))))
}

/// `angle` plus the number of whole turns that brings it next to `near`.
#[inline]
fn unwrapped(angle: f64, near: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if (near - angle).abs() <= PI { angle } else { angle + TAU * ((near - angle) / TAU).round() }
}

/// `1 + cos` of the turn; never 0.
#[inline]
fn chi(a: DVec3, b: DVec3) -> f64 {
    (1.0 + a.dot(b)).max(1e-6)
}
