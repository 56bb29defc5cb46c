//! STL as text: a solid for each patch, whose name snappyHexMesh makes the patch's.

use glam::{DVec3, Vec3};

use super::{Sheet, point, put};

pub(super) fn stl(sheet: &Sheet) -> String {
    let mut text = String::new();
    for part in &sheet.parts {
        put!(&mut text, "solid {}", part.name);
        for corners in sheet.corners(part) {
            put!(&mut text, "facet normal {}", point(normal(corners), " "));
            text.push_str("outer loop\n");
            for corner in corners {
                put!(&mut text, "vertex {}", point(corner, " "));
            }
            text.push_str("endloop\nendfacet\n");
        }
        put!(&mut text, "endsolid {}", part.name);
    }
    text
}

/// The unit normal of a triangle; 0 where it has none.
fn normal(corners: [Vec3; 3]) -> Vec3 {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let normal: DVec3 = (b - a).cross(c - a).normalize_or_zero();
    normal.as_vec3()
}
