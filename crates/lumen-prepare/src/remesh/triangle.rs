//! What a change does to a triangle: how well it is shaped, and whether its face turns over.

use glam::Vec3;

/// Cosine of the most that a face may turn in a change: 60 degrees.
pub(super) const MOST_TURN: f32 = 0.5;
/// A triangle whose quality is below this has no normal to compare with.
const THIN: f32 = 0.02;

/// Twice the area, along the normal.
#[inline]
pub(super) fn doubled([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}

/// `4 sqrt(3) A` over the sum of the squared sides: 1 for an equilateral triangle, 0 for one without area.
#[inline]
pub(super) fn quality(corners: [Vec3; 3]) -> f32 {
    let [a, b, c] = corners;
    let sides = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    if sides > 0.0 { 3.464_101_6 * doubled(corners).length() / sides } else { 0.0 }
}

/// Cosine of the least angle: 0.5 for an equilateral triangle, 1 for one without area.
#[inline]
pub(super) fn sharpness([a, b, c]: [Vec3; 3]) -> f32 {
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let (x, y, z) = (ab.length_squared(), bc.length_squared(), ca.length_squared());
    // The least angle lies opposite the shortest side.
    let (dot, product) = if x <= y && x <= z {
        (-bc.dot(ca), y * z)
    } else if y <= z {
        (-ca.dot(ab), z * x)
    } else {
        (-ab.dot(bc), x * y)
    };
    if product > 0.0 { dot / product.sqrt() } else { 1.0 }
}

/// Whether a triangle may become another: its face turns by at most 60 degrees, or by less than 90 from what `facing`
/// says where it has no normal, and it does not become a sliver unless it is one.
#[inline]
pub(super) fn may_become(old: [Vec3; 3], new: [Vec3; 3], facing: impl FnOnce() -> Vec3) -> bool {
    let (before, after) = (quality(old), quality(new));
    let normal = doubled(new);
    let (reference, least) = if before > THIN { (doubled(old), MOST_TURN) } else { (facing(), 0.0) };
    let is_kept = normal.dot(reference) > least * normal.length() * reference.length();
    is_kept && after > (before * 0.9).min(0.1)
}

/// Whether a triangle is so thin that it has no normal to speak of.
#[inline]
pub(super) fn is_thin(corners: [Vec3; 3]) -> bool {
    quality(corners) < THIN
}

/// Whether a triangle is no sliver and faces within 60 degrees of `facing`.
#[inline]
pub(super) fn faces_along(corners: [Vec3; 3], facing: Vec3) -> bool {
    let normal = doubled(corners);
    quality(corners) > 0.1 && normal.dot(facing) > MOST_TURN * normal.length() * facing.length()
}
