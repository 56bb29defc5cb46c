//! What is taken of the file: its unit and axes, the pieces that are kept, its arrays and what is mended.

use egui::{ComboBox, RichText, Role, ScrollArea, Ui};

use super::set;
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::document::Document;
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
    let piece = pieces.kept(keep).or(pieces.by_size.first().copied())?;
    Some(match keep {
        Keep::All => document.opened.triangles.len(),
        _ => pieces.list.get(piece as usize).map_or(0, |piece| piece.triangles as usize),
    })
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
    let Some(kept_count) = kept(document, state.settings.keep) else { return };
    number(ui, &say!("panel-kept"), &say!("panel-triangle-count", count = kept_count), "");
    let left_out = document.opened.triangles.len() - kept_count;
    let others = pieces.list.len().saturating_sub(1);
    if others > 0 && state.settings.keep != Keep::All {
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
        ui.label(RichText::new(say!("panel-unit")).weak()).on_hover_text(say!("panel-unit-help"));
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
    let selected = match *keep {
        Keep::All => say!("panel-all-pieces"),
        keep => pieces.kept(keep).map(|piece| piece_label(document, piece)).unwrap_or_default(),
    };
    let list = ComboBox::from_id_salt("pieces").width(ui.available_width() - 16.0).selected_text(selected);
    let response = list.show_ui(ui, |ui| {
        ui.selectable_value(keep, Keep::All, say!("panel-all-pieces"));
        let row = ui.spacing().interact_size.y;
        ScrollArea::vertical().max_height(240.0).show_rows(ui, row, pieces.by_size.len(), |ui, rows| {
            for i in rows {
                let piece = pieces.by_size[i];
                let value = if i == 0 { Keep::Largest } else { Keep::Component(piece) };
                let is_kept = *keep != Keep::All && pieces.kept(*keep) == Some(piece);
                if ui.selectable_label(is_kept, piece_label(document, piece)).clicked() {
                    *keep = value;
                    ui.close();
                }
            }
        });
    });
    name(&response.response, Role::ComboBox, &say!("panel-piece-list"));
}
