//! The open surface beside another file, whoever made it.
//!
//! - [`Against`]: the file, and what came of the comparison; [`Action`]: what is asked of it.
//! - `panel`: the numbers, in place of the method's steps; `view`: the two surfaces.

pub(super) mod action;
pub(super) mod against;
mod panel;
mod view;

use egui::Ui;

pub use self::action::Action;
pub use self::against::Against;
pub(super) use self::view::ReferenceView;
use super::action::Action as Ask;
use super::filling::Filling;
use super::mode::{Acting, Beside, Layer, Mode, Now, Panel};
use super::state::State;
use super::views::Views;
use against::Next;

impl Panel for ReferenceView {
    fn id(&self) -> &'static str {
        "reference"
    }

    fn is_there(&self, state: &State, _: Beside) -> bool {
        state.against.is_open
    }

    fn mode(&self) -> Option<Mode> {
        Some(Mode::Reference)
    }

    fn replaces_method(&self) -> bool {
        true
    }

    fn escape(&self, now: Now<'_>, layer: Layer) -> Option<Ask> {
        (layer == Layer::Open && now.mode == Mode::Reference).then_some(Ask::Reference(Action::Show(false)))
    }

    fn has_head(&self) -> bool {
        true
    }

    fn show_head(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Ask>) {
        panel::head(ui, now.state, asked);
    }

    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Ask>) {
        panel::numbers(ui, now.state, asked);
    }

    fn act(&mut self, action: Ask, acting: &mut Acting<'_>) -> Option<Ask> {
        let is_shown = acting.mode == Mode::Reference;
        let action = match action {
            // The surfaces need not lie where the document does.
            Ask::Fit | Ask::View(_) if is_shown => {
                self.look(action);
                return None;
            }
            Ask::Reference(action) => action,
            other => return Some(other),
        };
        let state = &mut *acting.state;
        let against = &mut state.against;
        match action {
            Action::Choose => {
                against.expect(Next::Reference);
                acting.platform.choose_file(acting.ctx);
            }
            Action::TakeNext => {
                against.expect(Next::Reference);
                state.notices.take_away();
                acting.platform.open_next();
            }
            Action::Unit(unit) => against.read_in(unit),
            Action::OfLevel(of_level) => against.of_level = of_level,
            Action::Align(align) => against.align = align,
            Action::Plain(is_plain) => against.is_plain = is_plain,
            Action::Again => against.go_on(),
            Action::SaveNumbers | Action::SaveStations => {
                let file =
                    if action == Action::SaveNumbers { state.compared_numbers() } else { state.compared_stations() };
                if let Some((name, bytes)) = file {
                    acting.platform.offer_file(&name, bytes, acting.ctx);
                }
            }
            Action::Show(is_open) => {
                state.leave_modes();
                state.against.is_open = is_open && state.against.source.is_some();
            }
        }
        None
    }

    fn leave_surface(&mut self, acting: &mut Acting<'_>) {
        acting.state.against.leave_surface();
    }
}

impl Filling for ReferenceView {
    fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        *self = Self::new(device);
    }

    fn refuse(&mut self) {
        self.give_up();
    }

    fn release(&mut self, state: &State, views: &mut Views) {
        if !state.against.is_open {
            self.leave(views);
        }
    }

    fn fill(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) -> Vec<Ask> {
        self.show_two(ui, state, views, is_narrow);
        Vec::new()
    }
}
