//! Which way the patient lies in a surface: what the file says, or the user where it does not; and in files that are saved.

use egui::{Button, ComboBox, Role, Ui, WidgetInfo, vec2};

use super::action::Action;
use super::assist::name;
use super::document::Document;
use super::row::{number, row};
use super::state::State;
use super::theme;
use crate::engine::Source;
use crate::io::Axes;
use crate::say;

/// What the axes are called in a list.
fn label(axes: Axes) -> String {
    match axes {
        Axes::Lps => "LPS".to_owned(),
        Axes::Ras => "RAS".to_owned(),
        Axes::Unknown => say!("panel-axes-unknown"),
    }
}

/// The axes of the file: a choice where it does not say.
pub(super) fn list(ui: &mut Ui, document: &Document, asked: &mut Vec<Action>) {
    if matches!(document.source, Source::Sample { .. }) {
        return;
    }
    let mut axes = document.import.axes;
    if document.states_axes {
        number(ui, &say!("panel-axes"), &label(axes), &say!("panel-axes-help"));
        return;
    }
    row(ui, &say!("panel-axes"), &say!("panel-axes-help"), |ui| {
        let list = ComboBox::from_id_salt("axes").width(80.0).selected_text(label(axes));
        let response = list.show_ui(ui, |ui| {
            for choice in [Axes::Unknown, Axes::Lps, Axes::Ras] {
                ui.selectable_value(&mut axes, choice, label(choice));
            }
        });
        name(&response.response, Role::ComboBox, &say!("panel-axes-list"));
    });
    if axes != document.import.axes {
        asked.push(Action::Axes(axes));
    }
}

/// The axes that surfaces are saved in.
pub(super) fn written(ui: &mut Ui, state: &State, ask: &mut impl FnMut(bool, Action)) {
    let is_known = state.document.as_ref().is_some_and(|document| document.import.axes != Axes::Unknown);
    let help = if is_known { say!("panel-axes-written-help") } else { say!("panel-axes-unknown-help") };
    ui.add_enabled_ui(is_known, |ui| {
        ui.horizontal(|ui| {
            ui.label(say!("panel-axes-list")).on_hover_text(help.clone()).on_disabled_hover_text(&help);
            for (choice, text, spoken) in [
                (None, say!("panel-axes-kept"), say!("panel-axes-save-kept")),
                (Some(Axes::Lps), "LPS".to_owned(), say!("panel-axes-save", axes = "LPS")),
                (Some(Axes::Ras), "RAS".to_owned(), say!("panel-axes-save", axes = "RAS")),
            ] {
                let is_chosen = if is_known { state.written_axes == choice } else { choice.is_none() };
                // Menus have little room around words.
                let choose = Button::selectable(is_chosen, text).min_size(vec2(theme::row(ui.ctx(), 0.0), 0.0));
                let response = ui.add(choose).on_hover_text(help.clone());
                response.widget_info(|| WidgetInfo::selected(Role::RadioButton, is_known, is_chosen, &spoken));
                ask(response.clicked(), Action::SaveAxes(choice));
            }
        });
    });
}
