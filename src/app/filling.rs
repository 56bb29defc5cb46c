//! What fills the middle of the window in a mode, and what of it stands on the graphics device.

use egui::Ui;

use super::action::Action;
use super::state::State;
use super::views::Views;

/// A mode that has views of its own.
pub(super) trait Filling {
    /// Takes another device, on which nothing stands yet; with `None` it lets go of all that stands on the last.
    fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>);

    /// Gives up what stands on the device, whose memory is full.
    fn refuse(&mut self);

    /// Lets go of the device's memory where nothing needs it, to be called each frame.
    fn let_go(&mut self, state: &State, views: &mut Views);

    /// Shows it in what is left of `ui`.
    fn fill(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) -> Vec<Action>;
}
