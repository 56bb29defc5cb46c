//! Modes with views of their own, and what these hold on the graphics device.

use egui::Ui;

use super::action::Action;
use super::state::State;
use super::views::Views;

/// A mode that has views of its own.
pub(super) trait Filling {
    /// Moves to another device, which holds nothing yet; `None` frees all on the last one.
    fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>);

    /// Frees what it holds on the device, whose memory is full.
    fn refuse(&mut self);

    /// Frees the memory of the device where nothing needs it. Called each frame.
    fn release(&mut self, state: &State, views: &mut Views);

    /// Shows the views in the rest of `ui`.
    fn fill(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) -> Vec<Action>;
}
