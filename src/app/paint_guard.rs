//! Keeps the window library's painter from a device that is gone.

use egui::Plugin;

use crate::render::DeviceHealth;

/// Paints nothing with a device that is gone: the window library's painter would panic over it.
pub(super) struct PaintGuard(pub(super) DeviceHealth);

impl Plugin for PaintGuard {
    fn debug_name(&self) -> &'static str {
        "paint guard"
    }

    fn output_hook(&mut self, _: &egui::Context, output: &mut egui::FullOutput) {
        if self.0.end().is_some() {
            output.shapes.clear();
        }
    }
}
