//! The numbers of a shape, each with its unit and what it says.

use egui::{CollapsingHeader, RichText, Ui};

use super::row::number;
use crate::language::{Key, decimal, signed};
use crate::pipeline::caps::changes_percent;
use crate::pipeline::report::Report;
use crate::pipeline::shape::Shape;
use crate::say;
use crate::vessel::width::Narrowest;

/// Shows the shape of the level and, where it is known, that of the smoothed surface; folded up at first.
pub(super) fn shape(ui: &mut Ui, report: Option<&Report>) {
    CollapsingHeader::new(say!("panel-shape")).id_salt("Shape").show(ui, |ui| {
        let level = report.and_then(|report| report.output_shape.as_ref());
        let smoothed = report.and_then(|report| report.smoothed_shape.as_ref());
        for row in &ROWS {
            let cell = |shape: Option<&Shape>| shape.and_then(row.value);
            let text = match (cell(level), cell(smoothed)) {
                (Some(now), Some(before)) => say!("panel-shape-was", now = row.text(now), before = row.text(before)),
                (Some(now), None) => row.text(now),
                _ => "–".to_owned(),
            };
            number(ui, &row.name.say(), &text, &row.help.say());
        }
        let caps = report.and_then(|report| report.caps.as_deref()).unwrap_or_default();
        if let Some(changes) = changes_percent(caps) {
            let [least, most] = changes.map(|percent| signed(percent, 2));
            let text = say!("panel-caps-changed", count = caps.len(), least = least, most = most);
            number(ui, &say!("panel-caps"), &text, &say!("panel-caps-help"));
        }
        if let Some(Narrowest { at_mm: [x, y, z], .. }) = level.and_then(|shape| shape.smallest_lumen) {
            let [x, y, z] = [x, y, z].map(|x| decimal(x, 1));
            ui.label(RichText::new(say!("panel-shape-narrowest", x = x, y = y, z = z)).small().weak());
        }
    });
}

struct Row {
    name: Key,
    help: Key,
    unit: &'static str,
    decimals: usize,
    value: fn(&Shape) -> Option<f64>,
}

impl Row {
    fn text(&self, value: f64) -> String {
        format!("{}{}", decimal(value, self.decimals), self.unit)
    }
}

const ROWS: [Row; 4] = [
    Row {
        name: Key("panel-roughness"),
        help: Key("panel-roughness-help"),
        unit: "°",
        decimals: 1,
        value: |shape| Some(shape.roughness?.rms_deg),
    },
    Row {
        name: Key("panel-slivers"),
        help: Key("panel-slivers-help"),
        unit: " %",
        decimals: 1,
        value: |shape| Some(shape.angles.as_ref()?.below_10_percent),
    },
    Row {
        name: Key("panel-self-intersecting"),
        help: Key("panel-self-intersecting-help"),
        unit: "",
        decimals: 0,
        value: |shape| Some(shape.self_intersecting_faces as f64),
    },
    Row {
        name: Key("panel-smallest-lumen"),
        help: Key("panel-smallest-lumen-help"),
        unit: " mm",
        decimals: 2,
        value: |shape| Some(shape.smallest_lumen?.diameter_mm),
    },
];
