//! The comparison as a mode of the window.

use egui::Ui;

use super::view::CompareView;
use crate::app::action::Action;
use crate::app::filling::Filling;
use crate::app::mode::{Acting, Beside, Entry, Group, Layer, Mode, Now, Panel};
use crate::app::state::State;
use crate::app::views::Views;
use crate::language::Key;

impl Panel for CompareView {
    fn id(&self) -> &'static str {
        "compare"
    }

    fn is_there(&self, state: &State, _: Beside) -> bool {
        state.comparison.is_open()
    }

    fn mode(&self) -> Option<Mode> {
        Some(Mode::Compare)
    }

    fn entry(&self, now: Now<'_>) -> Option<Entry> {
        Some(Entry {
            group: Group::Tabs,
            label: Key("app-compare"),
            help: Key("app-compare-help"),
            key: Some(egui::Key::C),
            action: Action::Compare,
            is_open: matches!(now.mode, Mode::Compare | Mode::Reference),
            is_enabled: true,
        })
    }

    fn key_help(&self) -> &'static [(Key, Key)] {
        &[
            (Key("app-key-compare"), Key("app-key-compare-does")),
            (Key("app-key-compare-first"), Key("app-key-compare-first-does")),
        ]
    }

    fn escape(&self, now: Now<'_>, layer: Layer) -> Option<Action> {
        (layer == Layer::Open && now.state.comparison.is_open()).then_some(Action::Compare)
    }

    /// The steps of the method stand beside it.
    fn show(&mut self, _: &mut Ui, _: Now<'_>, _: &mut Vec<Action>) {}

    fn act(&mut self, action: Action, acting: &mut Acting<'_>) -> Option<Action> {
        match action {
            Action::Compare => acting.state.toggle_comparison(),
            Action::Comparison(action) => acting.state.comparison.act(action, &acting.state.settings),
            other => return Some(other),
        }
        None
    }
}

impl Filling for CompareView {
    fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        *self = Self::new(device);
    }

    fn refuse(&mut self) {
        self.give_up();
    }

    fn release(&mut self, state: &State, views: &mut Views) {
        if !state.comparison.is_open() {
            self.leave(views);
        }
    }

    fn fill(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) -> Vec<Action> {
        self.show_cells(ui, state, views, is_narrow)
    }
}
