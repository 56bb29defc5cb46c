//! The planes of triangles, in f32: a triangle is at least as far as its plane.
//!
//! What a wire touches is mostly concave, and there every plane is farther than the wall. So nearly all triangles that a
//! search comes to can be told by four numbers each, of which four lie side by side; the corners are not looked at.

use glam::{BVec4A, Mat4, Vec3, Vec4};

use super::closest_point::is_sliver;

/// What the rounding of coordinates to f32, and of sums of their products, may add to a distance from a plane: of the
/// distances of the point and the plane from the origin. (Four half units in the last place for sums, one for the point,
/// one for the plane, and the corners' [`THICKNESS`].)
const ROUNDING: f32 = 6e-7;
/// How far corners may be off the plane that f32 holds, as a part of its distance from the origin.
const THICKNESS: f64 = 1e-7;
/// The normal is a little shorter than 1, so that no distance from a plane is too large.
const SHORTER: f64 = 1.0 - 3e-7;

/// By what a squared distance may be too large by rounding, beside that.
const ALLOWANCE: f32 = 1.0 + 1e-6;

/// The plane of a triangle: its normal, and its distance from the origin along it; all 0 when it has none.
pub(super) fn plane(corners: [Vec3; 3]) -> Vec4 {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    if is_sliver(corners) {
        return Vec4::ZERO;
    }
    let normal = ((b - a).cross(c - a).normalize_or_zero() * SHORTER).as_vec3();
    let along = [a, b, c].map(|corner| normal.as_dvec3().dot(corner));
    let [least, most] =
        [along.into_iter().fold(f64::INFINITY, f64::min), along.into_iter().fold(f64::NEG_INFINITY, f64::max)];
    let distance = f64::midpoint(least, most);
    if most - least <= 2.0 * THICKNESS * distance.abs() { normal.extend(distance as f32) } else { Vec4::ZERO }
}

/// Four planes, lane by lane.
pub(super) struct Planes {
    normal: [Vec4; 3],
    distance: Vec4,
}

impl Planes {
    #[inline]
    pub(super) fn new(planes: &[Vec4; 4]) -> Self {
        let [a, b, c, d] = *planes;
        let Mat4 { x_axis, y_axis, z_axis, w_axis } = Mat4::from_cols(a, b, c, d).transpose();
        Self { normal: [x_axis, y_axis, z_axis], distance: w_axis }
    }

    /// Signed distances of a point.
    #[inline]
    fn height(&self, p: &[Vec4; 3]) -> Vec4 {
        let [x, y, z] = self.normal;
        x * p[0] + y * p[1] + z * p[2] - self.distance
    }

    /// Of each lane: whether the plane is farther than the root of `squared` from where it is `height` away, by more than
    /// rounding may add; `reach` is how far that is from the origin.
    #[inline]
    fn is_beyond(&self, height: Vec4, squared: f32, reach: Vec4) -> BVec4A {
        let beyond = height.abs() - (reach + self.distance.abs()) * ROUNDING;
        beyond.cmpgt(Vec4::ZERO) & (beyond * beyond).cmpgt(Vec4::splat(squared * ALLOWANCE))
    }

    /// Bits of the triangles that may be as near to a point as the root of `squared`.
    #[inline]
    pub(super) fn near_point(&self, p: &[Vec4; 3], reach: Vec4, squared: f32) -> u32 {
        !self.is_beyond(self.height(p), squared, reach).bitmask() & 0b1111
    }

    /// Bits of the triangles that may be as near to a segment as the root of `squared`, or are crossed by it.
    #[inline]
    pub(super) fn near_segment(&self, ends: [&[Vec4; 3]; 2], reach: Vec4, squared: f32) -> u32 {
        let [a, b] = ends.map(|p| self.height(p));
        let is_one_side = (a * b).cmpgt(Vec4::ZERO);
        let is_beyond = self.is_beyond(a.abs().min(b.abs()), squared, reach);
        !(is_one_side & is_beyond).bitmask() & 0b1111
    }
}
