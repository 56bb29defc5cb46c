//! The arrays that came with a file, as the panel lists them.

use egui::{ComboBox, Role, Ui};

use super::action::Action;
use super::arrays::{chosen, short};
use super::assist::name;
use super::document::Document;
use super::options::{Colours, ViewOptions};
use super::row::{remark, row};
use super::views::Views;
use crate::mesh::ArrayInfo;
use crate::mesh::arrays::{Association, Kind};
use crate::say;

/// The arrays, and which of them the surface is coloured by.
pub(super) fn list(ui: &mut Ui, document: &Document, views: &Views, asked: &mut Vec<Action>) {
    let arrays = &document.import.arrays;
    if arrays.is_empty() {
        return;
    }
    let mut colours = views.options.colours;
    row(ui, &say!("panel-colour"), &say!("panel-colour-help"), |ui| {
        let nothing = say!("panel-colour-none");
        let chosen = chosen(document, colours).map_or(&nothing, |info| &info.name);
        let list = ComboBox::from_id_salt("arrays").width(140.0).truncate().selected_text(chosen);
        let response = list.show_ui(ui, |ui| {
            ui.selectable_value(&mut colours, Colours::None, &nothing);
            for (info, i) in arrays.iter().zip(0..) {
                ui.selectable_value(&mut colours, Colours::Array(i), &info.name);
            }
        });
        name(&response.response, Role::ComboBox, &say!("panel-colour"));
    });
    for info in arrays {
        remark(ui, &described(info));
    }
    if colours != views.options.colours {
        asked.push(Action::Show(ViewOptions { colours, ..views.options }));
    }
}

/// What an array is, in a line.
fn described(info: &ArrayInfo) -> String {
    let on = if info.on == Association::Point { "vertices" } else { "triangles" };
    let (name, kind) = (&info.name, info.scalar.name());
    let text = match (info.kind, info.components) {
        (Kind::Label, _) if info.labels.is_empty() => {
            say!("panel-array-identifiers", name = name, on = on, kind = kind)
        }
        (Kind::Label, _) => {
            say!("panel-array-labels", name = name, count = info.labels.len(), on = on, kind = kind)
        }
        (Kind::Continuous, 1) => say!("panel-array-scalar", name = name, on = on, kind = kind),
        (Kind::Continuous, n) => say!("panel-array-components", name = name, count = n, on = on, kind = kind),
    };
    match info.range {
        Some([least, most]) => say!("panel-array-range", array = text, least = short(least), most = short(most)),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::arrays::tests::info;
    use crate::mesh::arrays::Scalar;

    #[test]
    fn an_array_is_described_in_a_line() {
        assert_eq!(
            described(&info(Scalar::F32, &[-10.0, 35.238_01])),
            "Pressure: scalar on vertices, float32, -10 to 35.24"
        );
        assert_eq!(described(&info(Scalar::U8, &[0.0, 3.0])), "Pressure: 2 labels on vertices, uint8, 0 to 3");
    }
}
