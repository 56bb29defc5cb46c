//! The numbers of a shape, each with its unit and what it says.

use egui::{RichText, Ui};

use super::row::number;
use crate::pipeline::narrowest::Narrowest;
use crate::pipeline::report::Report;
use crate::pipeline::shape::Shape;

/// Shows the shape of the level and, where it is known, that of the smoothed surface; folded up at first.
pub(super) fn shape(ui: &mut Ui, report: Option<&Report>) {
    ui.collapsing("Shape", |ui| {
        let level = report.and_then(|report| report.output_shape.as_ref());
        let smoothed = report.and_then(|report| report.smoothed_shape.as_ref());
        for row in &ROWS {
            let cell = |shape: Option<&Shape>| shape.and_then(row.value);
            let text = match (cell(level), cell(smoothed)) {
                (Some(now), Some(before)) => format!("{}, was {}", row.text(now), row.text(before)),
                (Some(now), None) => row.text(now),
                _ => "–".to_owned(),
            };
            number(ui, row.name, &text, row.help);
        }
        if let Some(Narrowest { at_mm: [x, y, z], .. }) = level.and_then(|shape| shape.smallest_lumen) {
            ui.label(RichText::new(format!("Narrowest at ({x:.1}, {y:.1}, {z:.1}) mm")).small().weak());
        }
    });
}

struct Row {
    name: &'static str,
    help: &'static str,
    unit: &'static str,
    decimals: usize,
    value: fn(&Shape) -> Option<f64>,
}

impl Row {
    fn text(&self, value: f64) -> String {
        format!("{value:.*}{}", self.decimals, self.unit)
    }
}

const ROWS: [Row; 4] = [
    Row {
        name: "Roughness",
        help: "RMS angle between neighbouring triangles; \"was\" is the smoothed surface. Fewer triangles bend more.",
        unit: "°",
        decimals: 1,
        value: |shape| Some(shape.roughness?.rms_deg),
    },
    Row {
        name: "Slivers",
        help: "Triangles with an angle below 10 degrees, as a part of all",
        unit: " %",
        decimals: 1,
        value: |shape| Some(shape.angles.as_ref()?.below_10_percent),
    },
    Row {
        name: "Self-intersecting",
        help: "Triangles that run into others",
        unit: "",
        decimals: 0,
        value: |shape| Some(shape.self_intersecting_faces as f64),
    },
    Row {
        name: "Smallest lumen",
        help: "Diameter of the vessels where they are narrowest: of the largest ball inside that touches the wall",
        unit: " mm",
        decimals: 2,
        value: |shape| Some(shape.smallest_lumen?.diameter_mm),
    },
];
