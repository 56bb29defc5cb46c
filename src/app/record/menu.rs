//! Reports and pictures in the menu of what can be saved, and the sheet of the report.

use egui::{Button, Role, TextEdit, Ui};

use super::{Action, Chosen, Said};
use crate::app::assist::{heading, name};
use crate::app::menus;
use crate::app::row::wrapped;
use crate::report::ReportFormat;
use crate::say;

/// Shows the report, which waits for the vessels. Returns whether it was clicked.
pub(in crate::app) fn report(ui: &mut Ui, is_measured: bool) -> Option<Action> {
    let report = ui.add_enabled(is_measured, Button::new(say!("record-report")));
    report.on_hover_text(say!("record-report-help")).clicked().then_some(Action::Describe)
}

/// Shows the pictures. Returns what was clicked.
pub(in crate::app) fn pictures(ui: &mut Ui, mut chosen: Chosen, has_video: bool) -> Option<Action> {
    let mut asked = None;
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
    if has_video && ui.button(say!("record-video")).on_hover_text(say!("record-video-help")).clicked() {
        asked = Some(Action::Video);
    }
    asked
}

/// Most letters of a case and of a comment.
const LONGEST: [usize; 2] = [120, 2000];

/// Shows the sheet of the report. Returns what was clicked.
pub(super) fn sheet(ui: &mut Ui, said: &mut Said, mut chosen: Chosen) -> Option<Action> {
    let mut asked = None;
    heading(ui, &say!("record-drawing-report"));
    ui.add_space(8.0);
    let Said { surface, case, comment } = said;
    let fields = [
        (say!("report-case"), TextEdit::singleline(case), LONGEST[0]),
        (say!("report-comment"), TextEdit::multiline(comment).desired_rows(4), LONGEST[1]),
    ];
    for (i, (label, field, longest)) in fields.into_iter().enumerate() {
        ui.label(&label);
        // Of each surface fields of their own: undo in a field brings back nothing of another.
        let field = field.id_salt((*surface, i)).desired_width(f32::INFINITY).char_limit(longest);
        name(&ui.add(field), if i == 0 { Role::TextInput } else { Role::MultilineTextInput }, &label);
        ui.add_space(4.0);
    }
    wrapped(ui, &say!("record-said-kept"), |text| text.small().weak());
    ui.add_space(4.0);
    let names = ui.checkbox(&mut chosen.names_file, say!("record-name-file"));
    if names.on_hover_text(say!("record-name-file-help")).changed() {
        asked = Some(Action::NameFile(chosen.names_file));
    }
    ui.add_space(8.0);
    ui.horizontal_wrapped(|ui| {
        for (text, format, help) in [
            (say!("record-report-pdf"), ReportFormat::Pdf, say!("record-report-pdf-help")),
            (say!("record-report-html"), ReportFormat::Html, say!("record-report-html-help")),
            (say!("record-report-surface"), ReportFormat::HtmlWithSurface, say!("record-report-surface-help")),
        ] {
            if ui.button(text).on_hover_text(help).clicked() {
                asked = Some(Action::Report(format));
            }
        }
    });
    asked
}
