//! The guidewire: dark metal with a bright tip, never thinner than can be seen; and the same as what X-rays leave of it,
//! for the fluoroscopy.

use super::GpuWire;
use super::pipeline::{ADD, PipelineParts, scene_shader};
use super::scene::{SceneBindings, SceneLayout};
use super::texture::begin;

/// The format of what the wire takes away: its optical depth over the largest, `MOST_DEPTH` in the shaders.
pub(super) const SHADOW: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// Draws wires.
#[derive(Debug)]
pub(super) struct Wire {
    lit: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
}

impl Wire {
    pub(super) fn new(device: &wgpu::Device, layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::{Float32x2, Float32x3};
        let module = scene_shader!(device, "wire.wgsl");
        let attributes = &[Float32x3, Float32x3, Float32x2];
        let lit = PipelineParts { attributes, ..PipelineParts::new("wire", &module) };
        let shadow = PipelineParts {
            fragment: "fragment_shadow",
            attributes,
            blend: Some(wgpu::BlendState { color: ADD, alpha: ADD }),
            // A ray enters the tube once: what it takes away is counted where it does.
            cull: Some(wgpu::Face::Back),
            plain: Some(SHADOW),
            ..PipelineParts::new("wire, shadow", &module)
        };
        Self { lit: layout.pipeline(device, &lit), shadow: layout.pipeline(device, &shadow) }
    }

    /// Draws the wire, lit. Its scene must be bound.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, wire: &GpuWire) {
        wire.draw(pass, &self.lit);
    }

    /// Draws what the wire takes away from X-rays, and nothing else, into a target of [`SHADOW`].
    pub(super) fn draw_shadow(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        bindings: &SceneBindings,
        wire: &GpuWire,
    ) {
        let mut pass = begin(encoder, "shadow", target, wgpu::Color::TRANSPARENT);
        bindings.set(&mut pass, 0);
        wire.draw(&mut pass, &self.shadow);
    }
}
