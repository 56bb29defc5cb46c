//! Abaqus input: shells of three nodes, an element set for each patch, and a surface `NAME_surface` of its inner side, on
//! which blood presses.

use super::{NOTICE, Sheet, point, put};

pub(super) fn inp(sheet: &Sheet) -> String {
    let Sheet { mesh, parts } = sheet;
    let text = &mut String::new();
    put!(text, "*HEADING\nVessel surface, lengths in mm. {NOTICE}\n*NODE");
    for (v, &p) in (1..).zip(&mesh.positions) {
        put!(text, "{v}, {}", point(p, ", "));
    }
    for part in parts {
        put!(text, "*ELEMENT, TYPE=S3, ELSET={}", part.name);
        for (t, [a, b, c]) in part.triangles.iter().zip(sheet.vertices(part)) {
            put!(text, "{}, {}, {}, {}", t + 1, a + 1, b + 1, c + 1);
        }
    }
    for part in parts {
        // The positive side of a shell is the one from which it winds counter-clockwise: the outer one.
        put!(text, "*SURFACE, TYPE=ELEMENT, NAME={0}_surface\n{0}, SNEG", part.name);
    }
    std::mem::take(text)
}
