//! What there is to say about the patches, as JSON: for boundary conditions, which go by area and radius.

use serde::Serialize;

use super::{NOTICE, Sheet, WriteError};
use crate::PatchKind;

/// The whole text.
#[derive(Serialize)]
struct Text<'a> {
    notice: &'static str,
    length_unit: &'static str,
    patches: Vec<Entry<'a>>,
}

/// A patch.
#[derive(Serialize)]
struct Entry<'a> {
    name: &'a str,
    id: u32,
    kind: PatchKind,
    triangles: usize,
    area_mm2: f64,
    /// Of inlets and outlets alone, as are the next two.
    centre: Option<[f64; 3]>,
    normal: Option<[f64; 3]>,
    radius_mm: Option<f64>,
}

pub(super) fn json(sheet: &Sheet) -> Result<String, WriteError> {
    let entries = sheet.parts.iter().map(|part| {
        let is_cap = part.patch.kind != PatchKind::Wall;
        Entry {
            name: &part.name,
            id: part.patch.id,
            kind: part.patch.kind,
            triangles: part.triangles.len(),
            area_mm2: part.area_mm2,
            centre: is_cap.then_some(part.patch.centre),
            normal: is_cap.then_some(part.patch.normal),
            radius_mm: is_cap.then(|| (part.area_mm2 / std::f64::consts::PI).sqrt()),
        }
    });
    let text = Text { notice: NOTICE, length_unit: "mm", patches: entries.collect() };
    Ok(serde_json::to_string_pretty(&text)? + "\n")
}
