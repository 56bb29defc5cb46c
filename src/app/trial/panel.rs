//! The trial's part of the panel, and its keys.

use egui::{Button, Key, Modifiers, Ui};

use super::action::Action;
use super::state::{AWAITS, Open, Run, Stage, Trial};
use super::{device, fluoroscope, outcome, readout, rumble, setup, sound};
use crate::app::control::progress;
use crate::app::document::Document;
use crate::app::keys::pressed;
use crate::app::row::{remark, step, title, warning, wrapped};
use crate::app::theme;
use crate::language::tell;
use crate::pipeline::settings::Smoothing;
use crate::say;

/// Lines that there is room for in the sentence on how the trial stands.
const SENTENCE_LINES: f32 = 2.0;

/// Shows the step; while the trial's views are shown, what stands below its head. What was set there comes before what was
/// asked for, which is done with it.
pub(super) fn show(
    ui: &mut Ui,
    trial: &Trial,
    smoothing: &Smoothing,
    document: Option<&Document>,
    asked: &mut Vec<Action>,
) {
    let offers_smoothing = trial.gentler(smoothing).is_some();
    if let Some(shown) = trial.open() {
        if offers_smoothing {
            adapt_smoothing(ui, asked);
        }
        return open(ui, trial, shown, asked);
    }
    step(ui, 4, &say!("trial-title"), &say!("trial-title-help"));
    problem(ui, trial);
    if offers_smoothing {
        adapt_smoothing(ui, asked);
    }
    closed(ui, document, asked);
}

fn problem(ui: &mut Ui, trial: &Trial) {
    if let Some(problem) = &trial.problem {
        warning(ui, &problem.text);
    }
}

/// Offers the smoothing that leaves thin vessels as wide as they are.
fn adapt_smoothing(ui: &mut Ui, asked: &mut Vec<Action>) {
    let button = ui.add(Button::new(say!("trial-adapt")).wrap());
    if button.on_hover_text(say!("trial-adapt-help")).clicked() {
        asked.push(Action::AdaptSmoothing);
    }
}

fn closed(ui: &mut Ui, document: Option<&Document>, asked: &mut Vec<Action>) {
    let can_start = document.is_some_and(|document| document.shown.is_some());
    ui.horizontal(|ui| {
        ui.add_enabled_ui(can_start, |ui| {
            if ui.button(say!("trial-start")).clicked() {
                asked.push(Action::Start);
            }
            let tables = ui.button(say!("trial-tables")).on_hover_text(say!("trial-tables-help"));
            if tables.clicked() {
                asked.push(Action::Tables);
            }
        });
    });
}

/// Shows the buttons that steer the trial, and how it stands: these do not move with what is said.
pub(super) fn head(ui: &mut Ui, trial: &Trial, asked: &mut Vec<Action>) {
    let Some(shown) = trial.open() else { return };
    title(ui, 4, &say!("trial-title"));
    buttons(ui, trial, shown, asked);
    problem(ui, trial);
    let least = SENTENCE_LINES * ui.text_style_height(&egui::TextStyle::Body);
    ui.scope(|ui| {
        // Nor do the numbers below it, as far as there is room.
        ui.set_min_height(least);
        state(ui, shown);
    });
}

fn open(ui: &mut Ui, trial: &Trial, shown: &Open, asked: &mut Vec<Action>) {
    let before = asked.len();
    if let (true, Some(frame)) = (trial.is_on(), trial.frame()) {
        ui.push_id("numbers", |ui| readout::show(ui, trial, frame));
    }
    ui.separator();
    let mut setup = trial.setup.clone();
    ui.push_id("wire", |ui| setup::wire(ui, &mut setup, trial.proposed_wire()));
    let session = trial.session().filter(|_| !trial.has_changed());
    if let Some(reach) = session.and_then(|session| session.ready.reach.as_ref()) {
        warning(ui, &tell(reach));
    }
    ui.push_id("places", |ui| {
        if let Some(session) = trial.session() {
            setup::places(ui, &session.ready, &mut setup, shown.pick, asked);
        }
    });
    if setup != trial.setup {
        asked.insert(before, Action::Set(Box::new(setup)));
    }
    if trial.has_changed() {
        remark(ui, &say!("trial-restart-to-try"));
    }
    ui.separator();
    ui.push_id("device", |ui| device::show(ui, &trial.device, asked));
    ui.push_id("rumble", |ui| rumble::show(ui, &shown.rumble, asked));
    ui.push_id("sound", |ui| sound::show(ui, &shown.sound, asked));
    if trial.device.is_offered() {
        ui.separator();
    }
    ui.push_id("fluoroscopy", |ui| fluoroscope::show(ui, &shown.carm, asked));
    ui.separator();
    ui.push_id("outcome", |ui| outcome::show(ui, trial, asked));
    ui.separator();
    log(ui, trial, asked);
}

fn state(ui: &mut Ui, shown: &Open) {
    if shown.awaits.is_some() {
        wrapped(ui, &AWAITS.say(), |text| text);
        return;
    }
    match &shown.stage {
        Stage::Preparing(preparing) => {
            progress(ui, preparing.fraction, ui.available_width(), &say!("trial-preparing"));
            ui.label(say!("trial-finding"));
        }
        Stage::Association(session) => {
            let run = &session.run;
            let Some(frame) = &run.frame else {
                ui.label(say!("trial-at-entry"));
                return;
            };
            let (text, is_well) = readout::sentence(run, frame, theme::suits_finger(ui.ctx()));
            let colour = ui.visuals().error_fg_color;
            wrapped(ui, &text, |text| {
                let text = if run.summary.is_some() { text.strong() } else { text };
                if is_well { text } else { text.color(colour) }
            });
        }
        Stage::Off(_) => {
            ui.label(say!("trial-none-on"));
        }
    }
}

fn buttons(ui: &mut Ui, trial: &Trial, shown: &Open, asked: &mut Vec<Action>) {
    let is_on = trial.is_on();
    let run = trial.run();
    // Once it is over nothing steers.
    let steers = |run: &Run| run.autopilot && run.summary.is_none();
    let (autopilot, is_paused) = run.map_or((false, false), |run| (steers(run), run.is_paused));
    ui.horizontal_wrapped(|ui| {
        let mut button = |ui: &mut Ui, enabled, is_down, label: &str, help: &str, what: Action| {
            let response = ui.add_enabled(enabled, Button::new(label).selected(is_down)).on_hover_text(help.to_owned());
            if response.clicked() {
                asked.push(what);
            }
        };
        if matches!(shown.stage, Stage::Off(_)) {
            button(ui, true, false, &say!("trial-start"), "", Action::Start);
        } else {
            let help = say!("trial-restart-help");
            button(ui, true, trial.has_changed(), &say!("trial-restart"), &help, Action::Restart);
        }
        let help = say!("trial-autopilot-help");
        button(ui, is_on, autopilot, &say!("trial-autopilot"), &help, Action::Autopilot);
        button(ui, is_on, is_paused, &say!("trial-pause"), &say!("trial-pause-help"), Action::Pause);
        button(ui, is_on, shown.is_slow, &say!("trial-slow"), &say!("trial-slow-help"), Action::Slow);
        button(ui, is_on, false, &say!("trial-step-back"), &say!("trial-step-back-help"), Action::StepBack);
        button(ui, true, false, &say!("trial-close"), &say!("trial-close-help"), Action::Close);
    });
}

fn log(ui: &mut Ui, trial: &Trial, asked: &mut Vec<Action>) {
    ui.horizontal_wrapped(|ui| {
        let save = ui.add_enabled(trial.is_on(), Button::new(say!("trial-save-log")));
        if save.on_hover_text(say!("trial-save-log-help")).clicked() {
            asked.push(Action::Save);
        }
        if ui.button(say!("trial-open-log")).on_hover_text(say!("trial-open-log-help")).clicked() {
            asked.push(Action::OpenLog);
        }
        if ui.button(say!("trial-tables")).on_hover_text(say!("trial-tables-help")).clicked() {
            asked.push(Action::Tables);
        }
    });
}

/// What the keys ask for while a trial is shown.
pub(super) fn keys(ui: &Ui, trial: &Trial, asked: &mut Vec<Action>) {
    let pressed = |key| pressed(ui, Modifiers::NONE, key);
    fluoroscope::keys(ui, pressed, asked);
    let is_on = trial.is_on();
    let keys = [
        (Key::R, true, Action::Restart),
        (Key::P, is_on, Action::Pause),
        (Key::Z, is_on, Action::StepBack),
        (Key::M, is_on, Action::Slow),
        (Key::G, is_on, Action::Autopilot),
    ];
    asked.extend(keys.into_iter().find(|(key, allowed, _)| *allowed && pressed(*key)).map(|(.., action)| action));
}
