//! Which way the patient lies in a surface: what the file says, or the user where it does not.

use egui::{ComboBox, Role, Ui};

use super::action::Action;
use super::assist::name;
use super::document::Document;
use super::row::{number, row};
use crate::engine::Source;
use crate::io::Axes;

/// What the axes are called in a list.
fn label(axes: Axes) -> &'static str {
    match axes {
        Axes::Lps => "LPS",
        Axes::Ras => "RAS",
        Axes::Unknown => "Unknown",
    }
}

/// The axes of the file: a choice where it does not say.
pub(super) fn list(ui: &mut Ui, document: &Document, asked: &mut Vec<Action>) {
    const HELP: &str = "What the coordinates grow towards: left, posterior, superior (LPS, as in DICOM) or right, \
                        anterior, superior (RAS)";
    if !matches!(document.source, Source::File { .. }) {
        return;
    }
    let mut axes = document.import.axes;
    if document.states_axes {
        number(ui, "Axes of the file", label(axes), HELP);
        return;
    }
    row(ui, "Axes of the file", HELP, |ui| {
        let list = ComboBox::from_id_salt("axes").width(80.0).selected_text(label(axes));
        let response = list.show_ui(ui, |ui| {
            for choice in [Axes::Unknown, Axes::Lps, Axes::Ras] {
                ui.selectable_value(&mut axes, choice, label(choice));
            }
        });
        name(&response.response, Role::ComboBox, "Axes");
    });
    if axes != document.import.axes {
        asked.push(Action::Axes(axes));
    }
}
