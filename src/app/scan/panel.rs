//! What of a scan is the vessel, to be chosen: threshold or label, box, slice; and the way to its surface.

use egui::{Color32, ComboBox, DragValue, RichText, Role, Sense, Stroke, Ui, Vec2};

use super::state::OpenScan;
use super::{Action, histogram, slices_panel};
use crate::app::assist::{describe, name};
use crate::app::control::{self, Setting, reads_comma};
use crate::app::explain::explain;
use crate::app::row::{self, number, remark, row, step, warning};
use crate::app::swipe::Way;
use crate::engine::scan::ScanWork;
use crate::io::Offer;
use crate::language::{Key, decimal, grouped, inner, tell};
use crate::say;
use crate::volume::{Axis, Method, PRESETS, Region, Selection};

/// The axes of a grid as a user knows them.
const AXES: [(Axis, Key); 3] =
    [(Axis::I, Key("scan-columns")), (Axis::J, Key("scan-rows")), (Axis::K, Key("scan-slices"))];

/// Shows the panel of a scan.
pub(super) fn show(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    step(ui, 1, &say!("scan-title"), &say!("scan-what"));
    facts(ui, scan);
    if scan.opened.offers.len() > 1 {
        volumes(ui, scan, asked);
    }
    ui.separator();
    if scan.opened.survey.is_mask() {
        labels(ui, scan, asked);
        method(ui, scan, asked);
    } else {
        threshold(ui, scan, asked);
    }
    seed(ui, scan, asked);
    ui.separator();
    bounds(ui, scan, asked);
    ui.separator();
    slice(ui, scan, asked);
    let mut window = scan.window;
    slices_panel::window(ui, scan.is_ct(), &scan.opened.survey, &mut window);
    if window != scan.window {
        asked.push(Action::Window(window));
    }
    ui.separator();
    made(ui, scan, asked);
}

fn facts(ui: &mut Ui, scan: &OpenScan) {
    let opened = &scan.opened;
    let [i, j, k] = opened.dimensions;
    let [x, y, z] = opened.spacing_mm;
    number(ui, &say!("scan-format"), &opened.format, "");
    number(ui, &say!("scan-voxels"), &format!("{i} x {j} x {k}"), &say!("scan-voxels-help"));
    let spacing = format!("{} x {} x {} mm", decimal(x, 3), decimal(y, 3), decimal(z, 3));
    number(ui, &say!("scan-spacing"), &spacing, &say!("scan-spacing-help"));
    let [low, high] = opened.survey.range;
    let [low, high] = [low, high].map(|value| grouped(format!("{value:.0}")));
    number(ui, &say!("scan-values"), &say!("scan-values-range", low = low, high = high, unit = scan.unit()), "");
    for found in &opened.warnings {
        warning(ui, &tell(found));
    }
}

fn threshold(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let Selection::Threshold(mut value) = scan.selection else { return };
    let [low, high] = scan.opened.survey.range;
    histogram::show(ui, &scan.opened.survey, value);
    let decimals = if high - low > 20.0 { 0 } else { 3 };
    let setting = Setting {
        name: &say!("scan-threshold"),
        help: &say!("scan-threshold-help"),
        unit: scan.unit(),
        range: low..=high,
        default: PRESETS[1].value.clamp(low, high),
        auto: None,
        decimals,
        logarithmic: false,
    };
    if setting.show(ui, &mut value) {
        asked.push(Action::Select(Selection::Threshold(value)));
    }
    if scan.is_ct() {
        ui.horizontal_wrapped(|ui| {
            for preset in PRESETS {
                let button = ui.button(format!("{} HU", preset.value)).on_hover_text(tell(&preset.name));
                if button.clicked() {
                    asked.push(Action::Select(Selection::Threshold(preset.value)));
                }
            }
        });
    }
}

/// The voxel that the vessel is connected to, and what was found around it.
fn seed(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let Some(seed) = scan.seed else { return remark(ui, &say!("scan-seed-click")) };
    row(ui, &say!("scan-seed"), &say!("scan-seed-help"), |ui| {
        if ui.button(say!("scan-seed-remove")).clicked() {
            asked.push(Action::Seed(None));
        }
        ui.label(seed.map(|along| along.to_string()).join(", "));
    });
    if let Some(found) = &scan.half_way {
        let [vessel, around] = [found.vessel, found.background].map(|value| grouped(format!("{value:.0}")));
        remark(ui, &say!("scan-half-way", vessel = vessel, around = around, unit = scan.unit()));
    }
}

/// How the surface of a mask is made.
fn method(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    // Beside its label there is no room for both.
    explain(ui.label(say!("scan-method")), &say!("scan-method-help"));
    ui.horizontal_wrapped(|ui| {
        for (method, text) in
            [(Method::SurfaceNets, say!("scan-surface-nets")), (Method::MarchingCubes, say!("scan-marching-cubes"))]
        {
            if ui.selectable_label(method == scan.method, text).clicked() {
                asked.push(Action::Method(method));
            }
        }
    });
}

fn volumes(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let opened = &scan.opened;
    let has_series = opened.offers.iter().any(|offer| offer.series != opened.offers[0].series);
    let text = |Offer { series, slices, by, value }: &Offer| {
        let series = say!("scan-volume-series", number = series + 1);
        let what = match by {
            Some(by) if has_series => format!("{series}, {} {value}", tell(by)),
            Some(by) => format!("{} {value}", tell(by)),
            None => series,
        };
        say!("scan-volume-offer", what = what, slices = *slices)
    };
    // What tells volumes apart may be long: the list has a row of its own.
    explain(ui.label(say!("scan-volume")), &say!("scan-volume-help"));
    let chosen = opened.offers.get(opened.taken).map_or_else(String::new, text);
    let list = ComboBox::from_id_salt("volume").width(ui.available_width()).truncate().selected_text(chosen);
    let list = list.show_ui(ui, |ui| {
        for (number, offer) in opened.offers.iter().enumerate() {
            if ui.selectable_label(number == opened.taken, text(offer)).clicked() && number != opened.taken {
                asked.push(Action::Volume(number));
            }
        }
    });
    name(&list.response, Role::ComboBox, &say!("scan-volume"));
}

fn labels(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let named = |label: i64| scan.opened.names.iter().find(|named| named.value == label);
    let text = |selection| match selection {
        Selection::Label(label) => match named(label) {
            Some(named) => say!("scan-label-named", label = label.to_string(), name = &named.name),
            None => say!("scan-label", label = label.to_string()),
        },
        Selection::AnyLabel | Selection::EachLabel | Selection::Threshold(_) => say!("scan-all-labels"),
    };
    let colour = |selection| match selection {
        Selection::Label(label) => named(label)?.colour.map(|[r, g, b]| Color32::from_rgb(r, g, b)),
        _ => None,
    };
    let known = scan.opened.survey.labels.iter().map(|label| Selection::Label(label.value));
    row(ui, &say!("scan-vessel"), &say!("scan-vessel-help"), |ui| {
        swatch(ui, colour(scan.selection));
        let list = ComboBox::from_id_salt("label").selected_text(text(scan.selection)).show_ui(ui, |ui| {
            for selection in std::iter::once(Selection::AnyLabel).chain(known) {
                let is_clicked = ui.horizontal(|ui| {
                    swatch(ui, colour(selection));
                    ui.selectable_label(selection == scan.selection, text(selection)).clicked()
                });
                if is_clicked.inner {
                    asked.push(Action::Select(selection));
                }
            }
        });
        name(&list.response, Role::ComboBox, &say!("scan-vessel-label"));
    });
}

/// The colour of a label, if it has one; its name stands beside it.
fn swatch(ui: &mut Ui, colour: Option<Color32>) {
    const SIDE: f32 = 12.0;
    if let Some(colour) = colour {
        let (place, _) = ui.allocate_exact_size(Vec2::splat(SIDE), Sense::hover());
        ui.painter().rect_filled(place, 2.0, colour);
    }
}

fn bounds(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let mut region = scan.region;
    explain(ui.label(say!("scan-box")), &say!("scan-box-help"));
    for (axis, title) in AXES {
        let (at, last) = (axis.index(), scan.opened.dimensions[axis.index()].saturating_sub(1));
        let (title, help) = (title.say(), say!("scan-box-ends"));
        row(ui, &title, &help, |ui| {
            let high =
                DragValue::new(&mut region.last[at]).range(region.first[at] + 1..=last.max(region.first[at] + 1));
            describe(
                &ui.add(reads_comma(high, true)),
                Role::SpinButton,
                &say!("scan-last-of", axis = inner(&title)),
                scan.region.last[at] as f64,
            );
            let low = DragValue::new(&mut region.first[at]).range(0..=region.last[at].saturating_sub(1));
            describe(
                &ui.add(reads_comma(low, true)),
                Role::SpinButton,
                &say!("scan-first-of", axis = inner(&title)),
                scan.region.first[at] as f64,
            );
        });
    }
    if region != scan.region {
        asked.push(Action::Bound(region));
    }
    let whole = Region { first: [0; 3], last: scan.opened.dimensions.map(|along| along.saturating_sub(1)) };
    if ui.add_enabled(scan.region != whole, egui::Button::new(say!("scan-whole"))).clicked() {
        asked.push(Action::Bound(whole));
    }
}

fn slice(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    let (chosen, index) = scan.slice;
    row(ui, &say!("scan-across"), &say!("scan-across-help"), |ui| {
        for (axis, title) in AXES.into_iter().rev() {
            if ui.selectable_label(axis == chosen, title.say()).clicked() && axis != chosen {
                asked.push(Action::Slice(axis, scan.opened.dimensions[axis.index()] / 2));
            }
        }
    });
    let last = scan.opened.dimensions[chosen.index()].saturating_sub(1);
    let mut shown = index;
    ui.spacing_mut().slider_width = ui.available_width() - 64.0;
    let slider = ui.add(egui::Slider::new(&mut shown, 0..=last));
    describe(&slider, Role::Slider, &say!("scan-slice"), index as f64);
    if !Way::of(ui).scroll(ui, &slider) && shown != index {
        asked.push(Action::Slice(chosen, shown));
    }
}

fn made(ui: &mut Ui, scan: &OpenScan, asked: &mut Vec<Action>) {
    if let Some((mesh, step, _)) = &scan.preview {
        let count = say!("scan-triangles", count = mesh.triangles.len());
        number(ui, &say!("scan-preview"), &count, &say!("scan-preview-help"));
        if *step > 1 {
            remark(ui, &say!("scan-preview-coarse", block = format!("{step} x {step} x {step}")));
        }
    }
    if let Some(problem) = &scan.problem {
        warning(ui, problem);
    }
    if let Some((work, fraction)) = scan.progress {
        let what = label(work).say();
        remark(ui, &what);
        control::progress(ui, fraction, ui.available_width(), &what);
    }
    slices_panel::keep(ui, scan.opened.bytes, scan.keeps, asked);
    ui.horizontal(|ui| {
        if scan.is_making() {
            if ui.button(say!("scan-cancel")).clicked() {
                asked.push(Action::Cancel);
            }
        } else {
            let make = egui::Button::new(RichText::new(say!("scan-make")).strong())
                .stroke(Stroke::new(1.0, ui.visuals().hyperlink_color))
                .min_size(Vec2::new(0.0, 28.0));
            // What the preview is too coarse for may have a surface all the same.
            if ui.add(make).on_hover_text(say!("scan-make-help")).clicked() {
                asked.push(Action::Make);
            }
        }
        if ui.button(say!("scan-close")).clicked() {
            asked.push(Action::Close);
        }
    });
}

/// What the engine does, for a user.
fn label(work: ScanWork) -> Key {
    match work {
        ScanWork::Fetching => Key("scan-fetching"),
        ScanWork::Reading => Key("scan-reading"),
        ScanWork::Surveying => Key("scan-surveying"),
        ScanWork::Preview => Key("scan-preview"),
        ScanWork::Surface => Key("scan-making"),
    }
}

/// Shows in the bar below how far the scan is that is on its way in.
pub(super) fn status(
    ui: &mut Ui,
    (file, work, fraction): (&str, ScanWork, f32),
    is_narrow: bool,
    asked: &mut Vec<Action>,
) {
    if work == ScanWork::Fetching {
        ui.add(egui::Label::new(label(work).say()).truncate());
    } else {
        control::progress(ui, fraction, if is_narrow { 96.0 } else { 160.0 }, &say!("scan-progress"));
        ui.label(format!("{} {:.0} %", label(work).say(), fraction * 100.0));
    }
    if !is_narrow {
        row::name_of_file(ui, file);
    }
    if ui.button(say!("scan-cancel")).on_hover_text(say!("scan-cancel-help")).clicked() {
        asked.push(Action::Cancel);
    }
    if !is_narrow {
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.label(RichText::new(say!("about-not-clinical")).small().weak());
        });
    }
}
