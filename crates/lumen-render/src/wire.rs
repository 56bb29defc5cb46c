//! The guidewire: dark metal with a bright tip, never thinner than can be seen; and the same as what X-rays leave of it,
//! for the fluoroscopy.

use super::GpuWire;
use super::draw::{Draw, DrawContext, Phase, Pipelines};
use super::pipeline::{ADD, Destination, PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// The format of what the wire takes away: its optical depth over the largest, `MAX_DEPTH` in the shaders.
pub(super) const SHADOW: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

impl Draw for GpuWire {
    fn phases(&self) -> &'static [Phase] {
        &[Phase::Opaque, Phase::Shadow]
    }

    fn draw(&self, context: &mut DrawContext<'_, '_>) {
        let WirePipelines { lit, shadow } = context.pipelines();
        self.draw_by(context.pass, if context.phase == Phase::Shadow { shadow } else { lit });
    }
}

#[derive(Debug)]
struct WirePipelines {
    lit: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
}

impl Pipelines for WirePipelines {
    fn new(layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::{Float32x2, Float32x3};
        let module = scene_shader!(layout.device, "wire.wgsl");
        let lit =
            PipelineParts { attributes: &[Float32x3, Float32x3, Float32x2], ..PipelineParts::new("wire", &module) };
        let shadow = PipelineParts {
            label: "wire, shadow",
            fragment: "fragment_shadow",
            blend: Some(wgpu::BlendState { color: ADD, alpha: ADD }),
            // A ray enters the tube once: what it takes away is counted where it does.
            cull: Some(wgpu::Face::Back),
            into: Destination::Texture(SHADOW),
            ..lit
        };
        Self { lit: layout.pipeline(&lit), shadow: layout.pipeline(&shadow) }
    }
}
