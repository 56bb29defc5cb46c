//! The card of a lesson: what its step tells, what to look at, its question, and the way back and on.

use egui::{Button, Label, RichText, ScrollArea, Ui};

use super::{Action, Given, Step};
use crate::app::action::Action as Ask;
use crate::app::assist::heading;
use crate::app::icon::{self, Icon};
use crate::app::row::wrapped;
use crate::say;

/// No line is longer, in points: for the eye.
const WIDEST: f32 = 760.0;

/// Room for the title beside the buttons, in points.
const ROOMY: f32 = 480.0;

/// Room for a link beside the title, in points.
const NARROWEST: f32 = 260.0;

/// Shows the card of the step that is given.
pub(super) fn show(ui: &mut Ui, given: &Given, has_links: bool, is_measuring: bool, asked: &mut Vec<Ask>) {
    let mut ask = |wanted: bool, action: Action| {
        if wanted {
            asked.push(Ask::Lesson(action));
        }
    };
    let count = given.lesson.steps.len();
    let place = say!("lesson-place", title = &given.lesson.title, step = given.step + 1, count = count);
    let has_room = ui.available_width() > ROOMY;
    let step = &given.lesson.steps[given.step];
    let is_last = given.step + 1 == count;
    let close = |ui: &mut Ui| icon::button(ui, Icon::Close, true, &say!("lesson-close"), &say!("lesson-close-help"));
    let next = |ui: &mut Ui| {
        ui.add_enabled(!is_last, Button::new(say!("lesson-next"))).on_hover_text(say!("lesson-next-help"))
    };
    let back = |ui: &mut Ui| {
        ui.add_enabled(given.step > 0, Button::new(say!("lesson-back"))).on_hover_text(say!("lesson-back-help"))
    };
    let again = |ui: &mut Ui| ui.button(say!("lesson-again")).on_hover_text(say!("lesson-again-help"));
    let copy = |ui: &mut Ui| ui.button(say!("lesson-copy-link")).on_hover_text(say!("lesson-copy-link-help"));
    let has_link = has_links && given.name.is_some();
    let title = |ui: &mut Ui| ui.add(Label::new(RichText::new(&place).weak()).truncate());
    // At the side of the window there is height, at its foot width.
    let is_side = ui.available_height() > ui.available_width();
    ui.horizontal(|ui| {
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ask(close(ui).clicked(), Action::Close);
            if !is_side {
                ask(next(ui).clicked(), Action::Go(given.step + 1));
                ask(back(ui).clicked(), Action::Go(given.step.saturating_sub(1)));
                ask(again(ui).clicked(), Action::Go(given.step));
                if has_link && ui.available_width() > NARROWEST {
                    ask(copy(ui).clicked(), Action::CopyLink);
                }
            }
            if has_room || is_side {
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), title);
            }
        });
    });
    if is_side {
        ui.horizontal_wrapped(|ui| {
            ask(back(ui).clicked(), Action::Go(given.step.saturating_sub(1)));
            ask(next(ui).clicked(), Action::Go(given.step + 1));
            ask(again(ui).clicked(), Action::Go(given.step));
            if has_link {
                ask(copy(ui).clicked(), Action::CopyLink);
            }
        });
        ui.add_space(8.0);
    }
    // Each step of each lesson scrolls by itself.
    ScrollArea::vertical().id_salt((&given.lesson.title, given.step)).auto_shrink(false).show(ui, |ui| {
        if !has_room && !is_side {
            wrapped(ui, &place, RichText::weak);
        }
        match &step.question {
            // Side by side where there is room: a question below the fold is not asked.
            Some(question) if ui.available_width() > WIDEST => ui.columns(2, |columns| {
                told(&mut columns[0], step, is_measuring);
                asks(&mut columns[1], question, given.is_answered, &mut ask);
            }),
            question => {
                ui.set_max_width(ui.available_width().min(WIDEST));
                told(ui, step, is_measuring);
                if let Some(question) = question {
                    asks(ui, question, given.is_answered, &mut ask);
                }
            }
        }
    });
}

fn told(ui: &mut Ui, step: &Step, is_measuring: bool) {
    heading(ui, &step.title);
    wrapped(ui, &step.text, |text| text);
    if !step.look.is_empty() {
        wrapped(ui, &say!("lesson-look", what = &step.look), RichText::strong);
        // Of one height, or what stands below would move.
        let measuring = if is_measuring { say!("lesson-measuring") } else { String::new() };
        ui.label(RichText::new(measuring).small().color(ui.visuals().warn_fg_color));
    }
}

fn asks(ui: &mut Ui, (question, answer): &(String, String), is_answered: bool, ask: &mut impl FnMut(bool, Action)) {
    wrapped(ui, question, RichText::strong);
    if is_answered {
        wrapped(ui, answer, |text| text);
    } else {
        let show = ui.button(say!("lesson-show-answer")).on_hover_text(say!("lesson-show-answer-help"));
        ask(show.clicked(), Action::Answer);
    }
}
