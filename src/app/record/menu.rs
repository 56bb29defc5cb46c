//! Reports and pictures in the menu of what can be saved.

use egui::Ui;

use super::{Action, Chosen};
use crate::app::menus;
use crate::report::ReportFormat;
use crate::say;

/// Shows them; a report waits for the vessels. Returns what was clicked.
pub(in crate::app) fn menu(ui: &mut Ui, mut chosen: Chosen, is_measured: bool) -> Option<Action> {
    let mut asked = None;
    ui.add_enabled_ui(is_measured, |ui| {
        for (text, format, help) in [
            (say!("record-report-pdf"), ReportFormat::Pdf, say!("record-report-pdf-help")),
            (say!("record-report-html"), ReportFormat::Html, say!("record-report-html-help")),
        ] {
            if ui.button(text).on_hover_text(help).clicked() {
                asked = Some(Action::Report(format));
            }
        }
        let names = ui.checkbox(&mut chosen.names_file, say!("record-name-file"));
        if names.on_hover_text(say!("record-name-file-help")).changed() {
            asked = Some(Action::NameFile(chosen.names_file));
        }
    });
    menus::menu(ui, &say!("record-picture"), &mut |ui| {
        for scale in 1..=4 {
            let size = ui.button(say!("record-pixels", count = (super::job::PICTURE * scale).to_string()));
            if size.on_hover_text(say!("record-pixels-help")).clicked() {
                asked = Some(Action::Picture(scale));
            }
        }
        let clear = ui.checkbox(&mut chosen.is_clear, say!("record-clear"));
        if clear.on_hover_text(say!("record-clear-help")).changed() {
            asked = Some(Action::Clear(chosen.is_clear));
        }
    });
    if ui.button(say!("record-turntable")).on_hover_text(say!("record-turntable-help")).clicked() {
        asked = Some(Action::Turntable);
    }
    asked
}
