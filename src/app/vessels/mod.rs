//! The vessels, and what smoothing and reduction made of the calibre of each: a table, the radius along the one that is
//! chosen, and a way to each place.

pub(super) mod action;
mod plot;
mod view;
mod words;

use egui::Ui;

pub use self::action::Action;
pub(super) use self::action::FILES;
pub(super) use self::words::verdict;
use super::action::Action as Ask;
use super::mode::{Acting, Beside, Entry, Group, Layer, Mode, Now, Panel, Place};
use super::state::State;
use crate::language::Key;
use crate::say;
use crate::vessel::certificate::Certificate;

/// What of the vessels is shown.
#[derive(Clone, Copy, Debug, Default)]
pub struct Vessels {
    /// The number of the branch whose radius is drawn; `None` for the one that stands first.
    selected: Option<u32>,
    /// Whether its row is to be brought into sight.
    scrolls: bool,
    /// Arc length of the reference of its narrowest place, if that was chosen, in mm.
    reference_mm: Option<f64>,
}

const TOGGLE: Ask = Ask::Vessels(Action::Toggle);

impl Panel for Vessels {
    fn id(&self) -> &'static str {
        "vessels"
    }

    fn is_there(&self, _: &State, beside: Beside) -> bool {
        beside == Beside::Vessels
    }

    fn place(&self, ui: &Ui, now: Now<'_>) -> Place {
        if now.is_narrow {
            return Place::Panel;
        }
        Place::Below((ui.available_height() * 0.4).clamp(160.0, 320.0), Some(120.0..=480.0))
    }

    fn entry(&self, now: Now<'_>) -> Option<Entry> {
        let is_open = now.shows(Beside::Vessels);
        Some(Entry {
            group: Group::Tabs,
            label: Key("app-vessels"),
            help: Key("app-vessels-help"),
            key: Some(egui::Key::V),
            action: TOGGLE,
            is_open,
            is_enabled: now.has_level() || is_open,
        })
    }

    fn key_help(&self) -> &'static [(Key, Key)] {
        &[(Key("app-key-vessels"), Key("app-key-vessels-does"))]
    }

    fn escape(&self, now: Now<'_>, layer: Layer) -> Option<Ask> {
        (layer == Layer::Open && now.shows(Beside::Vessels)).then_some(TOGGLE)
    }

    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Ask>) {
        let shown = std::mem::take(&mut self.scrolls);
        view::show(ui, Self { scrolls: shown, ..*self }, now, asked);
    }

    fn act(&mut self, action: Ask, acting: &mut Acting<'_>) -> Option<Ask> {
        let Ask::Vessels(action) = action else { return Some(action) };
        match action {
            Action::Toggle => {
                let is_open = acting.mode == Mode::Method && *acting.beside == Beside::Vessels;
                if !is_open && acting.in_trial {
                    acting.then.push(Ask::Unmark);
                } else if is_open {
                    *acting.beside = Beside::Nothing;
                    acting.then.push(Ask::Unmark);
                } else {
                    acting.state.leave_modes();
                    *acting.beside = Beside::Vessels;
                }
            }
            Action::Select(branch) => (self.selected, self.reference_mm) = (Some(branch), None),
            Action::ShowNarrowing(number) => {
                *self = Self { selected: Some(number), scrolls: true, reference_mm: None };
                let found = acting.state.calibre().and_then(|calibre| calibre.found.as_ref().ok());
                let branch = found.and_then(|found| found.branches.iter().find(|branch| branch.number == number));
                acting.then.extend(branch.into_iter().flat_map(view::narrowing));
            }
            Action::Refer(at_mm) => {
                self.reference_mm = at_mm;
                if at_mm.is_none() {
                    acting.then.push(Ask::Unmark);
                }
            }
            Action::ShowUnmeasured => {
                acting.state.leave_modes();
                *acting.beside = Beside::Vessels;
                let found = acting.state.calibre().and_then(|calibre| calibre.found.as_ref().ok());
                if let Some((branch, station)) = found.and_then(Certificate::least_measured) {
                    *self = Self { selected: Some(branch.number), scrolls: true, reference_mm: None };
                    acting.then.extend(view::go_to_station(branch, station));
                }
            }
            Action::SaveTable => match acting.state.calibre_table() {
                Some((name, bytes)) => acting.platform.offer_file(&name, bytes, acting.ctx),
                None => acting.state.tell(&say!("app-nothing-to-save")),
            },
            Action::SaveCentrelines(format) => acting.state.save_centrelines(format, acting.platform.link()),
        }
        None
    }

    fn leave_surface(&mut self, _: &mut Acting<'_>) {
        (self.selected, self.reference_mm) = (None, None);
    }
}
