//! What of a scan is the vessel, to be chosen: threshold or label, box, slice; and the way to its surface.

use egui::{ComboBox, DragValue, RichText, Role, Stroke, Ui, Vec2};

use super::state::OpenScan;
use super::{Action, histogram};
use crate::app::assist::{describe, name};
use crate::app::control::{self, Setting};
use crate::app::row::{number, remark, row, step, warning};
use crate::digits::grouped;
use crate::engine::scan::ScanWork;
use crate::volume::{Axis, PRESETS, Region, Selection};

/// The axes of a grid as a user knows them.
const AXES: [(Axis, &str); 3] = [(Axis::I, "Columns"), (Axis::J, "Rows"), (Axis::K, "Slices")];

/// Shows the panel of a scan.
pub(in crate::app) fn show(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let what = "The surface is made where values reach the threshold, or of a label; then it is smoothed and reduced.";
    step(ui, 1, "Scan", what);
    facts(ui, scan);
    ui.separator();
    if scan.opened.survey.is_mask() {
        labels(ui, scan, asked);
    } else {
        threshold(ui, scan, asked);
    }
    ui.separator();
    bounds(ui, scan, asked);
    ui.separator();
    slice(ui, scan, asked);
    ui.separator();
    made(ui, scan, asked);
}

fn facts(ui: &mut Ui, scan: &OpenScan) {
    let opened = &scan.opened;
    let [i, j, k] = opened.dimensions;
    let [x, y, z] = opened.spacing_mm;
    number(ui, "Format", &opened.format, "");
    number(ui, "Voxels", &format!("{i} x {j} x {k}"), "Columns, rows and slices");
    number(ui, "Spacing", &format!("{x:.3} x {y:.3} x {z:.3} mm"), "Between columns, rows and slices");
    let [low, high] = opened.survey.range;
    number(
        ui,
        "Values",
        &format!("{} to {}{}", grouped(format!("{low:.0}")), grouped(format!("{high:.0}")), scan.unit()),
        "",
    );
    for text in &opened.warnings {
        warning(ui, text);
    }
}

fn threshold(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let Selection::Threshold(mut value) = scan.selection else { return };
    let [low, high] = scan.opened.survey.range;
    histogram::show(ui, &scan.opened.survey, value);
    let decimals = if high - low > 20.0 { 0 } else { 3 };
    let setting = Setting {
        name: "Threshold",
        help: "What has this value and more is the vessel; contrast-filled vessels in CT have 150 to 500 HU.",
        unit: scan.unit(),
        range: low..=high,
        default: PRESETS[1].value.clamp(low, high),
        decimals,
        logarithmic: false,
    };
    if setting.show(ui, &mut value) {
        asked.push(Action::Select(Selection::Threshold(value)));
    }
    if scan.is_ct() {
        ui.horizontal_wrapped(|ui| {
            for preset in PRESETS {
                let button = ui.button(format!("{} HU", preset.value)).on_hover_text(preset.name);
                if button.clicked() {
                    asked.push(Action::Select(Selection::Threshold(preset.value)));
                }
            }
        });
    }
}

fn labels(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let text = |selection| match selection {
        Selection::Label(label) => format!("Label {label}"),
        Selection::AnyLabel | Selection::Threshold(_) => "All labels".to_owned(),
    };
    let known = scan.opened.survey.labels.iter().map(|label| Selection::Label(label.value));
    row(ui, "Vessel", "Which label of the mask is the vessel", |ui| {
        let list = ComboBox::from_id_salt("label").selected_text(text(scan.selection)).show_ui(ui, |ui| {
            for selection in std::iter::once(Selection::AnyLabel).chain(known) {
                if ui.selectable_label(selection == scan.selection, text(selection)).clicked() {
                    asked.push(Action::Select(selection));
                }
            }
        });
        name(&list.response, Role::ComboBox, "Label of the vessel");
    });
}

fn bounds(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let mut region = scan.region;
    ui.label("Box").on_hover_text("Only these voxels are looked at: what lies outside, such as bone, is left out");
    for (axis, title) in AXES {
        let (at, last) = (axis.index(), scan.opened.dimensions[axis.index()].saturating_sub(1));
        row(ui, title, "The first and the last, from 0", |ui| {
            let high =
                DragValue::new(&mut region.last[at]).range(region.first[at] + 1..=last.max(region.first[at] + 1));
            describe(
                &ui.add(high),
                Role::SpinButton,
                &format!("Last of {}", title.to_lowercase()),
                scan.region.last[at] as f64,
            );
            let low = DragValue::new(&mut region.first[at]).range(0..=region.last[at].saturating_sub(1));
            describe(
                &ui.add(low),
                Role::SpinButton,
                &format!("First of {}", title.to_lowercase()),
                scan.region.first[at] as f64,
            );
        });
    }
    if region != scan.region {
        asked.push(Action::Bound(region));
    }
    let whole = Region { first: [0; 3], last: scan.opened.dimensions.map(|along| along.saturating_sub(1)) };
    if ui.add_enabled(scan.region != whole, egui::Button::new("Whole scan")).clicked() {
        asked.push(Action::Bound(whole));
    }
}

fn slice(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let (chosen, index) = scan.slice;
    row(ui, "Slice across", "Which way the slice that is shown lies", |ui| {
        for (axis, title) in AXES.into_iter().rev() {
            if ui.selectable_label(axis == chosen, title).clicked() && axis != chosen {
                asked.push(Action::Slice(axis, scan.opened.dimensions[axis.index()] / 2));
            }
        }
    });
    let last = scan.opened.dimensions[chosen.index()].saturating_sub(1);
    let mut shown = index;
    ui.spacing_mut().slider_width = ui.available_width() - 64.0;
    let slider = ui.add(egui::Slider::new(&mut shown, 0..=last));
    describe(&slider, Role::Slider, "Slice", index as f64);
    if shown != index {
        asked.push(Action::Slice(chosen, shown));
    }
}

fn made(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    if let Some((mesh, step, _)) = &scan.preview {
        number(
            ui,
            "Preview",
            &format!("{} triangles", grouped(mesh.triangles.len())),
            "The surface at reduced resolution",
        );
        if *step > 1 {
            remark(
                ui,
                &format!(
                    "The preview is made of every {step}th voxel, the largest value of each block: thin vessels look wider than they are."
                ),
            );
        }
    }
    if let Some(problem) = &scan.problem {
        warning(ui, problem);
    }
    if let Some((work, fraction)) = scan.progress {
        let what = match work {
            ScanWork::Surveying => "Counting values",
            ScanWork::Preview => "Preview",
            ScanWork::Surface => "Making the surface",
        };
        remark(ui, what);
        control::progress(ui, fraction, ui.available_width(), what);
    }
    ui.horizontal(|ui| {
        if scan.is_making() {
            if ui.button("Cancel").clicked() {
                asked.push(Action::Cancel);
            }
        } else {
            let can = scan.problem.is_none();
            let make = egui::Button::new(RichText::new("Make the surface").strong())
                .stroke(Stroke::new(1.0, ui.visuals().hyperlink_color))
                .min_size(Vec2::new(0.0, 28.0));
            if ui.add_enabled(can, make).on_hover_text("At full resolution, and open it").clicked() {
                asked.push(Action::Make);
            }
        }
        if ui.button("Close the scan").clicked() {
            asked.push(Action::Close);
        }
    });
}
