//! The background: the theme's two colours from the top of the view to its bottom, behind everything.

use super::draw::{Draw, DrawContext, Phase, Pipelines};
use super::pipeline::{PipelineParts, cover, scene_shader};
use super::scene::SceneLayout;

/// The background of the style.
#[derive(Clone, Copy, Debug)]
pub struct Backdrop;

impl Draw for Backdrop {
    fn phases(&self) -> &'static [Phase] {
        &[Phase::Background]
    }

    fn draw(&self, context: &mut DrawContext<'_, '_>) {
        let BackdropPipelines(pipeline) = context.pipelines();
        cover(context.pass, pipeline);
    }
}

#[derive(Debug)]
struct BackdropPipelines(wgpu::RenderPipeline);

impl Pipelines for BackdropPipelines {
    fn new(layout: &SceneLayout) -> Self {
        let module = scene_shader!(layout.device, "backdrop.wgsl");
        Self(layout.pipeline(&PipelineParts {
            vertex: "vertex_everywhere",
            depth_compare: wgpu::CompareFunction::Always,
            depth_write: false,
            ..PipelineParts::new("backdrop", &module)
        }))
    }
}
