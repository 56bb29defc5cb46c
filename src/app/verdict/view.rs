//! The verdict as it is shown: in a place of its own above the controls, of the same height whatever it says, so that what
//! lies below never moves under the hand.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Align, Color32, FontSelection, Layout, RichText, Role, Shape, Stroke, Ui, pos2, vec2};

use super::findings::{Finding, Verdict};
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::state::State;
use crate::app::vessels;

/// Height of all of it, in points.
const HEIGHT: f32 = 92.0;
/// Lines of the sentence; the rest is seen under the pointer.
const LINES: usize = 2;

/// Shows the verdict on what is shown, and says what is asked for there.
pub(in crate::app) fn show(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let Some(document) = &state.document else { return };
    let verdict = Verdict::new(state, document);
    let size = vec2(ui.available_width(), HEIGHT);
    ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
        ui.set_min_size(size);
        ui.spacing_mut().item_spacing.y = 2.0;
        ui.spacing_mut().interact_size.y = 22.0;
        ui.horizontal(|ui| {
            mark(ui, verdict.is_safe);
            ui.label(RichText::new(&verdict.head).strong());
        });
        let first = verdict.findings.first().filter(|finding| finding.is_grave);
        let text = match (first, &verdict.calibre) {
            (Some(finding), _) => &finding.text,
            (None, Some(sentence)) => sentence,
            (None, None) => "Calibre, deviation and shape follow.",
        };
        sentence(ui, text);
        ui.horizontal(|ui| buttons(ui, &verdict, first, asked));
    });
    ui.separator();
}

fn buttons(ui: &mut Ui, verdict: &Verdict, first: Option<&Finding>, asked: &mut Vec<Action>) {
    match first {
        Some(finding) => act(ui, finding, asked),
        None => {
            let vessels = ui.add_enabled(verdict.calibre.is_some(), egui::Button::new("Show vessels").small());
            if vessels.on_hover_text("What became of each, and where (V)").clicked() {
                asked.push(Action::Vessels(vessels::Action::Toggle));
            }
        }
    }
    let others: Vec<&Finding> = verdict.findings.iter().skip(usize::from(first.is_some())).collect();
    if others.is_empty() {
        return;
    }
    let words = match (first, others.len()) {
        (Some(_), count) => format!("{count} more"),
        (None, 1) => "1 note".to_owned(),
        (None, count) => format!("{count} notes"),
    };
    ui.menu_button(RichText::new(words).small(), |ui| {
        ui.set_max_width(320.0);
        for (i, finding) in others.iter().enumerate() {
            if i > 0 {
                ui.separator();
            }
            ui.add(egui::Label::new(RichText::new(&finding.text).small()).wrap());
            ui.horizontal(|ui| act(ui, finding, asked));
        }
    });
}

/// What can be done about a finding.
fn act(ui: &mut Ui, finding: &Finding, asked: &mut Vec<Action>) {
    if let Some(place) = &finding.place
        && ui.small_button("Show me").on_hover_text("Goes to where it is").clicked()
    {
        asked.push(place.clone());
    }
    for (words, action) in &finding.remedies {
        if ui.small_button(words).on_hover_text("Would help; can be undone").clicked() {
            asked.push(action.clone());
        }
    }
}

/// A sentence of as many lines as there is room for; whole under the pointer and for assistive tools.
fn sentence(ui: &mut Ui, text: &str) {
    let font = FontSelection::from(egui::TextStyle::Small).resolve(ui.style());
    let colour = ui.visuals().text_color();
    let mut job = LayoutJob::simple(text.to_owned(), font, colour, ui.available_width());
    job.wrap = TextWrapping { max_rows: LINES, ..job.wrap };
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), galley.size().y), egui::Sense::hover());
    let is_cut = galley.elided;
    ui.painter().galley(rect.min, galley, colour);
    name(&response, Role::Label, text);
    if is_cut {
        response.on_hover_text(text);
    }
}

/// A tick, an exclamation mark, or an empty ring while nothing is known: shape and colour say the same.
fn mark(ui: &mut Ui, is_safe: Option<bool>) {
    let (rect, _) = ui.allocate_exact_size(vec2(18.0, 18.0), egui::Sense::hover());
    let (middle, painter) = (rect.center(), ui.painter());
    let Some(is_safe) = is_safe else {
        painter.circle_stroke(middle, 7.0, Stroke::new(1.5, ui.visuals().weak_text_color()));
        return;
    };
    let (ground, on) = if is_safe {
        (ui.visuals().hyperlink_color, ui.visuals().selection.stroke.color)
    } else {
        (ui.visuals().error_fg_color, ui.visuals().panel_fill)
    };
    painter.circle_filled(middle, 8.0, ground);
    let stroke = Stroke::new(2.0, on);
    if is_safe {
        let tick = [pos2(-3.8, 0.2), pos2(-1.2, 2.8), pos2(3.8, -2.6)].map(|p| middle + p.to_vec2());
        painter.add(Shape::line(tick.to_vec(), stroke));
    } else {
        painter.line_segment([middle + vec2(0.0, -4.2), middle + vec2(0.0, 1.0)], stroke);
        painter.circle(middle + vec2(0.0, 4.0), 1.2, on, Stroke::new(0.0, Color32::TRANSPARENT));
    }
}
