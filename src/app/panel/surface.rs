//! What is taken of the file: its unit and axes, the pieces that are kept, its arrays and what is mended.

use egui::{ComboBox, RichText, Role, ScrollArea, Ui};

use super::set;
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::document::Document;
use crate::app::explain::explain;
use crate::app::options::ViewOptions;
use crate::app::row::{Fold, number};
use crate::app::state::State;
use crate::app::views::Views;
use crate::app::{array_list, axes, mending};
use crate::engine::Source;
use crate::io::Unit;
use crate::language::{decimal, grouped};
use crate::pipeline::settings::Keep;
use crate::say;

/// Shows the step.
pub(super) fn show(ui: &mut Ui, state: &State, views: &Views, asked: &mut Vec<Action>) {
    let summary = summary(ui, state);
    let (title, what) = (say!("panel-surface"), say!("panel-surface-does"));
    Fold { number: 1, title: &title, what: &what, summary, is_open: false }
        .show(ui, |ui| surface(ui, state, views, asked));
}

/// That the surface is to be mended; else how many triangles are kept.
fn summary(ui: &Ui, state: &State) -> RichText {
    if mending::is_called_for(state) {
        return RichText::new(say!("panel-surface-to-mend")).color(ui.visuals().error_fg_color);
    }
    let count = state.document.as_ref().and_then(|document| kept(document, state.settings.keep));
    RichText::new(count.map_or_else(String::new, |count| say!("panel-triangle-count", count = count))).weak()
}

/// How many triangles are kept, once the pieces are known.
fn kept(document: &Document, keep: Keep) -> Option<usize> {
    let pieces = &document.pieces;
    (!pieces.list.is_empty()).then(|| pieces.kept(keep).map(|piece| piece.triangles as usize).sum())
}

fn surface(ui: &mut Ui, state: &State, views: &Views, asked: &mut Vec<Action>) {
    let Some(document) = &state.document else {
        ui.label(say!("panel-surface-none"));
        return;
    };
    let pieces = &document.pieces;
    unit_list(ui, document, asked);
    axes::list(ui, document, asked);
    let in_file = grouped(document.import.triangles);
    number(ui, &say!("panel-in-file"), &in_file, &say!("panel-in-file-help"));
    let keep = state.settings.keep;
    let Some(kept_count) = kept(document, keep) else { return };
    number(ui, &say!("panel-kept"), &say!("panel-triangle-count", count = kept_count), "");
    let left_out = document.opened.triangles.len() - kept_count;
    let others = pieces.list.len() - pieces.kept(keep).count();
    if others > 0 {
        let text = say!("panel-left-out-count", count = left_out, pieces = others);
        number(ui, &say!("panel-left-out"), &text, &say!("panel-left-out-help"));
    }
    if pieces.list.len() > 1 {
        let mut settings = state.settings.clone();
        piece_list(ui, document, &mut settings.keep);
        set(settings, state, asked);
        let mut left_out = views.options.left_out;
        let shown = ui.checkbox(&mut left_out, say!("panel-show-left-out"));
        if shown.on_hover_text(say!("panel-show-left-out-help")).changed() {
            asked.push(Action::Show(ViewOptions { left_out, ..views.options }));
        }
    }
    array_list::list(ui, document, views, asked);
    mending::section(ui, state, views.options, asked);
}

/// The unit of the file's numbers.
fn unit_list(ui: &mut Ui, document: &Document, asked: &mut Vec<Action>) {
    if !matches!(document.source, Source::File { .. }) {
        return;
    }
    let mut unit = document.import.unit;
    ui.horizontal(|ui| {
        explain(ui.label(RichText::new(say!("panel-unit")).weak()), &say!("panel-unit-help"));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let list = ComboBox::from_id_salt("unit").width(56.0).selected_text(unit.symbol());
            let response = list.show_ui(ui, |ui| {
                for choice in Unit::ALL {
                    ui.selectable_value(&mut unit, choice, choice.symbol());
                }
            });
            name(&response.response, Role::ComboBox, &say!("panel-unit-list"));
        });
    });
    if unit != document.import.unit {
        asked.push(Action::ReadIn(unit));
    }
}

/// Size of a piece in words.
fn piece_label(document: &Document, piece: u32) -> String {
    let Some(found) = document.pieces.list.get(piece as usize) else { return String::new() };
    let size = found.bounds.size().max_element();
    say!("panel-piece", count = found.triangles, size = decimal(size, 1))
}

fn piece_list(ui: &mut Ui, document: &Document, keep: &mut Keep) {
    let pieces = &document.pieces;
    let selected = match (*keep, pieces.by_size.iter().find(|piece| pieces.is_kept(*keep, **piece))) {
        (Keep::All, _) => say!("panel-all-pieces"),
        (Keep::Pieces(set), _) => say!("panel-pieces", count = set.numbers().len()),
        (_, piece) => piece.map(|&piece| piece_label(document, piece)).unwrap_or_default(),
    };
    let list = ComboBox::from_id_salt("pieces").width(ui.available_width() - 16.0).selected_text(selected);
    // It stays open for one box after the other.
    let list = list.close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
    let response = list.show_ui(ui, |ui| {
        if ui.selectable_value(keep, Keep::All, say!("panel-all-pieces")).clicked() {
            ui.close();
        }
        let row = ui.spacing().interact_size.y;
        ScrollArea::vertical().max_height(240.0).show_rows(ui, row, pieces.by_size.len(), |ui, rows| {
            for i in rows {
                let piece = pieces.by_size[i];
                let mut is_kept = pieces.is_kept(*keep, piece);
                let label = piece_label(document, piece);
                ui.horizontal(|ui| {
                    let ticked = ui.checkbox(&mut is_kept, "").on_hover_text(say!("panel-piece-add"));
                    name(&ticked, Role::CheckBox, &say!("panel-piece-keep", piece = label.as_str()));
                    if ticked.clicked() {
                        *keep = pieces.toggled(*keep, piece);
                    }
                    let is_alone = pieces.only(piece) == *keep;
                    if ui.selectable_label(is_alone, label).clicked() {
                        *keep = pieces.only(piece);
                        ui.close();
                    }
                });
            }
        });
    });
    name(&response.response, Role::ComboBox, &say!("panel-piece-list"));
}
