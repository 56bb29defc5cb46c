//! The colours of an array that came with a file, and its legend.

use egui::{Align2, Color32, FontId, Painter, Rect, pos2, vec2};

use super::document::Document;
use super::halo;
use super::options::Colours;
use crate::language::decimal;
use crate::mesh::{ArrayInfo, used_vertices};
use crate::render::{Colour, ColourMap, label_colour};
use crate::say;

/// Labels that a legend names.
const NAMED: usize = 12;

/// A number without a unit, to four digits.
pub(super) fn short(x: f64) -> String {
    let size = x.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        let text = format!("{x:.3e}");
        let parts = text.split_once('e').and_then(|(lead, power)| Some((lead.parse::<f64>().ok()?, power)));
        return parts.map_or_else(|| text.clone(), |(lead, power)| format!("{}e{power}", decimal(lead, 3)));
    }
    let decimals =
        if size >= 1000.0 || x.fract() == 0.0 { 0 } else { (3 - size.max(1.0).log10() as i32).max(0) as usize };
    decimal(x, decimals)
}

/// The array that has the colours, if one has.
pub(super) fn chosen(document: &Document, colours: Colours) -> Option<&ArrayInfo> {
    let Colours::Array(index) = colours else { return None };
    document.import.arrays.get(usize::from(index))
}

/// The map of an array's colours: from its least to its largest value as 0 to 1, or labels by their number.
pub(super) fn colour_map() -> ColourMap {
    ColourMap { range: (0.0, 1.0) }
}

impl Document {
    /// For each node of the level that is shown, what array `index` has there, as [`colour_map`] takes it, if it is known.
    pub(super) fn array_by_node(&self, index: u16) -> Option<Vec<f32>> {
        let (levels, shown) = (&self.levels.as_ref()?.1, self.shown.as_ref()?);
        let arrays = &self.import.arrays;
        let info = arrays.get(usize::from(index))?;
        let carried = self.carried_shown().filter(|carried| carried.len() == arrays.len() * shown.vertices)?;
        let values = carried.chunks_exact(shown.vertices.max(1)).nth(usize::from(index))?;
        let mut by_node = vec![0.0; levels.positions.len()];
        let nodes = used_vertices(levels.positions.len(), &shown.level.triangles);
        for (node, &value) in nodes.into_iter().zip(values) {
            by_node[node as usize] = shown_number(info, value);
        }
        Some(by_node)
    }
}

/// What is drawn of a value.
fn shown_number(info: &ArrayInfo, value: f32) -> f32 {
    if !info.labels.is_empty() {
        return info.labels.partition_point(|&label| (label as f32) < value) as f32;
    }
    let [least, most] = info.range.unwrap_or_default();
    let width = (most - least).max(f64::MIN_POSITIVE);
    let part = (f64::from(value) - least) / width;
    // What is no number has the colour of the surface.
    if part.is_finite() { part.clamp(0.0, 1.0) as f32 } else { 2.0 * ColourMap::UNKNOWN }
}

/// The ends of a legend of continuous values.
pub(super) fn ends(info: &ArrayInfo) -> [String; 2] {
    info.range.unwrap_or_default().map(short)
}

/// Draws the colours of labels, each with its value.
pub(super) fn label_legend(painter: &Painter, inner: Rect, info: &ArrayInfo, colour: Color32) {
    const SIDE: f32 = 12.0;
    const STEP: f32 = 18.0;
    let shown = info.labels.len().min(NAMED);
    let font = FontId::proportional(12.0);
    let top = inner.center().y - 0.5 * STEP * shown as f32;
    halo::text(painter, pos2(inner.right(), top - 6.0), Align2::RIGHT_BOTTOM, &info.name, font.clone(), colour);
    for (n, &label) in info.labels.iter().take(shown).enumerate() {
        let corner = pos2(inner.right() - SIDE, top + STEP * n as f32);
        let Colour([r, g, b]) = label_colour(n);
        painter.rect_filled(Rect::from_min_size(corner, vec2(SIDE, SIDE)), 2.0, Color32::from_rgb(r, g, b));
        let at = corner + vec2(-6.0, 0.5 * SIDE);
        halo::text(painter, at, Align2::RIGHT_CENTER, &label.to_string(), font.clone(), colour);
    }
    let more = info.labels.len() - shown;
    if more > 0 {
        let at = pos2(inner.right(), top + STEP * shown as f32 + 2.0);
        halo::text(painter, at, Align2::RIGHT_TOP, &say!("panel-labels-more", count = more), font, colour);
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::mesh::Array;
    use crate::mesh::arrays::{Association, Scalar, Values};

    /// What is told of an array `Pressure` of these numbers, one a vertex.
    pub(in crate::app) fn info(scalar: Scalar, numbers: &[f64]) -> ArrayInfo {
        Array::new("Pressure", Association::Point, 1, Values::of(scalar, numbers.iter().copied())).info()
    }

    #[test]
    fn values_become_parts_of_the_range_and_labels_their_number() {
        let pressure = info(Scalar::F32, &[-10.0, 30.0, f64::NAN]);
        assert_eq!([-10.0, 0.0, 30.0, 99.0].map(|x| shown_number(&pressure, x)), [0.0, 0.25, 1.0, 1.0]);
        assert!(shown_number(&pressure, f32::NAN) > ColourMap::UNKNOWN);
        let parts = info(Scalar::I16, &[7.0, -3.0, 7.0, 100.0]);
        assert_eq!([-3.0, 7.0, 100.0].map(|x| shown_number(&parts, x)), [0.0, 1.0, 2.0]);
    }

    #[test]
    fn numbers_have_four_digits() {
        assert_eq!([0.0, 0.25, 1234.5, 1e-7, 2.5e9].map(short), ["0", "0.250", "1234", "1.000e-7", "2.500e9"]);
    }
}
