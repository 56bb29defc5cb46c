//! What several subcommands print: a line for each number.

use crate::io::ThresholdReport;
use crate::mesh::ArrayInfo;
use crate::mesh::arrays::{Association, Kind};
use crate::pipeline::shape::Shape;
use crate::vessel::width::Narrowest;
use lumen_message::signed;

/// A row of a table: what it is, padded, and how much.
pub(super) fn row(what: &str, how_much: impl std::fmt::Display) {
    println!("{what:<27} {how_much}");
}

/// The rows of what the threshold of a scan comes to.
pub(super) fn threshold_rows(ThresholdReport { value, lower_mm, higher_mm }: ThresholdReport) {
    row("threshold", format!("{value:.1}"));
    row("threshold 10 % lower", format!("wall {} mm", signed(lower_mm, 3)));
    row("threshold 10 % higher", format!("wall {} mm", signed(higher_mm, 3)));
}

/// A row for each array: its name, what it is on, its type, and its range.
pub(super) fn array_rows(arrays: &[ArrayInfo]) {
    for ArrayInfo { name, on, kind, scalar, components, range, .. } in arrays {
        let on = if *on == Association::Point { "point" } else { "triangle" };
        let kind = if *kind == Kind::Label { ", labels" } else { "" };
        let range =
            range.map_or("no finite value".to_owned(), |[least, most]| format!("{} to {}", plain(least), plain(most)));
        let (what, scalar) = (format!("array {name}"), scalar.name());
        row(&what, format!("{on}, {components} x {scalar}{kind}, {range}"));
    }
}

/// A number without a row of zeros.
fn plain(x: f64) -> String {
    if x != 0.0 && !(1e-4..1e15).contains(&x.abs()) { format!("{x:e}") } else { format!("{x}") }
}

/// The rows of a surface's shape.
pub(super) fn shape_rows(shape: &Shape) {
    if let Some(roughness) = shape.roughness {
        row("roughness", format!("{:.2} degrees RMS, {:.2} p95", roughness.rms_deg, roughness.p95_deg));
    }
    if let Some(angles) = &shape.angles {
        row("smallest angle", format!("{:.2} degrees", angles.min_deg));
        row("slivers under 10 degrees", format!("{:.2} % of triangles", angles.below_10_percent));
    }
    row("self-intersecting triangles", shape.self_intersecting_faces);
    if let Some(Narrowest { diameter_mm, at_mm: [x, y, z] }) = shape.smallest_lumen {
        row("smallest lumen", format!("{diameter_mm:.3} mm at ({x:.1}, {y:.1}, {z:.1})"));
    }
}
