//! The result below the steps of the panel: what the method made of the surface, in numbers.

use egui::{CollapsingHeader, Ui};

use crate::app::action::Action;
use crate::app::assist::heading;
use crate::app::numbers;
use crate::app::row::{number, remark, row};
use crate::app::state::State;
use crate::app::vessels;
use crate::language::{Key, decimal, signed, tell};
use crate::pipeline::deviation::Deviation;
use crate::pipeline::settings::reduction_percent;
use crate::say;

/// Shows what came of it, in numbers.
pub(in crate::app) fn result(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let Some(document) = &state.document else { return };
    ui.separator();
    heading(ui, &say!("panel-result"));
    let (Some((_, levels)), Some(shown)) = (&document.levels, &document.shown) else {
        return remark(ui, &say!("panel-result-follows"));
    };
    let (before, after) = (levels.triangles.len(), shown.level.triangles.len());
    let vertices = say!("panel-of", count = shown.vertices, all = document.entering_vertices);
    number(ui, &say!("panel-vertices"), &vertices, &say!("panel-of-help"));
    number(ui, &say!("panel-removed"), &format!("{} %", decimal(reduction_percent(before, after), 2)), "");
    row(ui, &say!("panel-calibre"), &say!("panel-calibre-help"), |ui| {
        if ui.button(say!("panel-vessels")).on_hover_text(say!("panel-vessels-help")).clicked() {
            asked.push(Action::Vessels(vessels::Action::Toggle));
        }
        ui.label(vessels::verdict(state));
    });
    let Some(measured) = &document.measured else { return };
    let is_current = measured.generation == state.generation() && measured.report.output.triangles == after;
    let report = &measured.report;
    let percent = |change: Option<f64>| {
        change.filter(|_| is_current).map_or("–".to_owned(), |change| format!("{} %", signed(change, 2)))
    };
    let distance = |pick: fn(&Deviation) -> f64| {
        let found = report.deviation_mm.as_ref().filter(|_| is_current);
        found.map_or("–".to_owned(), |d| format!("{} mm", decimal(pick(d), 3)))
    };
    let help = say!("panel-deviation-help");
    number(ui, &say!("panel-deviation-mean"), &distance(|d| d.mean), &help);
    number(ui, &say!("panel-deviation-max"), &distance(|d| d.max), &help);
    number(ui, &say!("panel-volume"), &percent(report.volume_change_percent), &say!("panel-volume-help"));
    number(ui, &say!("panel-area"), &percent(report.area_change_percent), &say!("panel-area-help"));
    numbers::shape(ui, is_current.then_some(report));
    CollapsingHeader::new(say!("panel-times")).id_salt("Time a stage").show(ui, |ui| {
        let ms = &report.stages_ms;
        let stages = [
            (Key("panel-time-reading"), ms.read),
            (Key("panel-time-mending"), ms.mending),
            (Key("panel-time-connectivity"), ms.connectivity),
            (Key("panel-time-smoothing"), ms.smoothing),
            (Key("panel-time-decimation"), ms.decimation),
            (Key("panel-time-bound"), ms.bound),
            (Key("panel-time-level"), ms.level),
            (Key("panel-time-normals"), ms.normals),
            (Key("panel-time-deviation"), ms.deviation),
            (Key("panel-time-measures"), ms.measures),
            (Key("panel-time-calibre"), ms.calibre),
        ];
        for (stage, ms) in stages {
            number(ui, &stage.say(), &format!("{} ms", decimal(ms, 1)), "");
        }
    });
    if !document.import.warnings.is_empty() {
        CollapsingHeader::new(say!("panel-notes")).id_salt("Notes on the file").show(ui, |ui| {
            for warning in &document.import.warnings {
                remark(ui, &tell(warning));
            }
        });
    }
}
