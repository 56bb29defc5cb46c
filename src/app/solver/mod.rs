//! The step that makes a level ready for a solver, and the views of what it made.
//!
//! - [`Preparation`]: what is done, and what came of it; [`Action`]: what is asked of it.
//! - `step`: its controls, below the reduction; `cuts`: those of single ends, in the list and in the view; `view`: what was
//!   made, or what is cut off, in place of the level.

pub(super) mod action;
mod cuts;
pub(super) mod preparation;
mod step;
mod view;

use egui::Ui;

pub use self::action::Action;
pub use self::preparation::{Preparation, Shown};
pub(super) use self::view::SolverView;
use super::action::Action as Ask;
use super::filling::Filling;
use super::mode::{Acting, Beside, Layer, Mode, Now, Panel};
use super::state::State;
use super::views::Views;

impl SolverView {
    /// Shows the step in the method's panel.
    pub(super) fn show_step(ui: &mut Ui, state: &State, asked: &mut Vec<Ask>) {
        step::show(ui, state, asked);
    }
}

impl Panel for SolverView {
    fn id(&self) -> &'static str {
        "solver"
    }

    fn is_there(&self, state: &State, _: Beside) -> bool {
        state.preparation.shown.is_some()
    }

    fn mode(&self) -> Option<Mode> {
        Some(Mode::Solver)
    }

    fn escape(&self, now: Now<'_>, layer: Layer) -> Option<Ask> {
        (layer == Layer::Open && now.mode == Mode::Solver).then_some(Ask::Solver(Action::Show(None)))
    }

    /// The steps of the method stand beside it, its own among them.
    fn show(&mut self, _: &mut Ui, _: Now<'_>, _: &mut Vec<Ask>) {}

    fn act(&mut self, action: Ask, acting: &mut Acting<'_>) -> Option<Ask> {
        let Ask::Solver(action) = action else { return Some(action) };
        let state = &mut *acting.state;
        match action {
            Action::Set(plan) => state.preparation.plan = plan,
            Action::Prepare => state.prepare_for_solver(acting.platform.link()),
            Action::Show(shown) => {
                state.leave_modes();
                let is_there = shown != Some(Shown::Made) || state.preparation.made.is_some();
                state.preparation.shown = shown.filter(|_| is_there);
                state.preparation.failure.take_if(|_| shown == Some(Shown::Cuts));
            }
            Action::Rename(place, name) => state.preparation.rename(place, &name),
            Action::Save(format) => state.save_for_solver(format, acting.platform.link()),
        }
        None
    }

    fn leave_surface(&mut self, acting: &mut Acting<'_>) {
        acting.state.preparation.leave_surface();
    }
}

impl Filling for SolverView {
    fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        *self = Self::new(device);
    }

    fn refuse(&mut self) {
        self.give_up();
    }

    fn release(&mut self, state: &State, views: &mut Views) {
        if state.preparation.shown.is_none() {
            self.leave(views);
        }
    }

    fn fill(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) -> Vec<Ask> {
        self.show_shown(ui, state, views, is_narrow).map(Ask::Solver).into_iter().collect()
    }
}
