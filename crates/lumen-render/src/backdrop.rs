//! The background: the theme's two colours from the top of the view to its bottom, behind everything.

use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// Draws the background.
#[derive(Debug)]
pub(super) struct Backdrop {
    pipeline: wgpu::RenderPipeline,
}

impl Backdrop {
    pub(super) fn new(device: &wgpu::Device, layout: &SceneLayout) -> Self {
        let module = scene_shader!(device, "backdrop.wgsl");
        let parts = PipelineParts {
            vertex: "vertex_everywhere",
            depth_compare: wgpu::CompareFunction::Always,
            depth_write: false,
            ..PipelineParts::new("backdrop", &module)
        };
        Self { pipeline: layout.pipeline(device, &parts) }
    }

    /// Fills the view; any scene must be bound.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..3, 0..1);
    }
}
