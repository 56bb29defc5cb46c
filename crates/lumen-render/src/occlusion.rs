//! Ambient occlusion: where walls stand close together less light comes in, so folds and forks are darker.
//!
//! In screen space, after Mittring ("Finding next gen", 2007) in the form of McGuire et al. ("The Alchemy screen-space
//! ambient obscurance algorithm", 2011): around each pixel what rises above its tangent plane within reach closes it.
//! Depth is drawn once more for that, at half the size and with one sample a pixel, since WebGL2 reads no multisampled
//! depth; it is bound as plain floats, with a sampler that filters nothing. The pattern of the samples is the same
//! in every picture. Surfaces alone are darkened, never what is behind them.

use super::buffer::draw;
use super::draw::{DrawContext, Frame, Phase, Pipelines};
use super::pipeline::{Destination, PipelineParts, cover, scene_shader};
use super::scene::SceneLayout;
use super::target::{Gathered, OPENNESS, ViewTarget};
use super::texture::begin;
use super::{GpuSurface, binding};

/// Multiplies what is there with what is drawn.
const MULTIPLY: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::Dst,
    dst_factor: wgpu::BlendFactor::Zero,
    operation: wgpu::BlendOperation::Add,
};

/// Darkens what is closed in.
#[derive(Debug)]
pub(super) struct Occlusion {
    depth: wgpu::RenderPipeline,
    gather: wgpu::RenderPipeline,
    shade: wgpu::RenderPipeline,
    group: wgpu::BindGroupLayout,
    nearest: wgpu::Sampler,
}

/// Whether things of a picture are darkened: never under a colour map, whose colours are read as values, nor with
/// something behind the surfaces, since what stands before or behind a slice is no neighbour of it.
pub(super) fn is_wanted(frame: &Frame<'_>) -> bool {
    let style = frame.style;
    style.occlusion && style.map.is_none() && frame.has(Phase::Depth) && !frame.has(Phase::Behind)
}

impl Occlusion {
    /// Draws the depth of a surface: the phase [`Phase::Depth`] of things that are darkened.
    pub(super) fn draw_depth(context: &mut DrawContext<'_, '_>, surface: &GpuSurface) {
        let Self { depth, .. } = context.pipelines();
        draw(context.pass, depth, &[&surface.positions], &surface.triangles);
    }

    /// Finds out how open each pixel of a view is, before the view is drawn; gives what [`Self::shade`] takes.
    pub(super) fn gather(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &ViewTarget,
        frame: &Frame<'_>,
    ) -> wgpu::BindGroup {
        let device = &frame.layout.device;
        let gathered = target.attachments.gathered.get_or_init(|| Gathered::new(device, target.size()));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("occlusion, depth"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &gathered.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        frame.draw(&mut pass, Phase::Depth);
        drop(pass);
        let mut pass = begin(encoder, "occlusion", &gathered.openness, wgpu::Color::WHITE);
        frame.bindings.set(&mut pass, 0);
        // What is drawn into cannot be read: depth stands in its place.
        pass.set_bind_group(2, &self.bind(device, &gathered.depth, &gathered.depth), &[]);
        cover(&mut pass, &self.gather);
        drop(pass);
        self.bind(device, &gathered.depth, &gathered.openness)
    }

    /// Darkens the surfaces that are drawn so far; the scene must be bound.
    pub(super) fn shade(&self, pass: &mut wgpu::RenderPass<'_>, gathered: &wgpu::BindGroup) {
        pass.set_bind_group(2, gathered, &[]);
        cover(pass, &self.shade);
    }

    fn bind(&self, device: &wgpu::Device, depth: &wgpu::TextureView, openness: &wgpu::TextureView) -> wgpu::BindGroup {
        let [depth, openness] = [depth, openness].map(wgpu::BindingResource::TextureView);
        let nearest = wgpu::BindingResource::Sampler(&self.nearest);
        binding::group(device, "occlusion", &self.group, [depth, openness, nearest])
    }
}

impl Pipelines for Occlusion {
    fn new(layout: &SceneLayout) -> Self {
        let device = &layout.device;
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering);
        let types = [binding::texture(false), binding::texture(false), sampler];
        let group = binding::layout(device, "occlusion", wgpu::ShaderStages::FRAGMENT, &types);
        let module = scene_shader!(device, "occlusion.wgsl");
        let depth = layout.pipeline(&PipelineParts {
            vertex: "vertex_depth",
            fragment: "fragment_depth",
            attributes: &[wgpu::VertexFormat::Float32x3],
            into: Destination::Depth,
            ..PipelineParts::new("occlusion, depth", &module)
        });
        let gather = layout.pipeline(&PipelineParts {
            vertex: "vertex_everywhere",
            fragment: "fragment_gather",
            into: Destination::Texture(OPENNESS),
            group: Some(&group),
            ..PipelineParts::new("occlusion, gather", &module)
        });
        let shade = layout.pipeline(&PipelineParts {
            vertex: "vertex_everywhere",
            fragment: "fragment_shade",
            // It lies in the far plane: before it is what was drawn, and the background is not.
            depth_compare: wgpu::CompareFunction::Less,
            depth_write: false,
            blend: Some(wgpu::BlendState { color: MULTIPLY, alpha: MULTIPLY }),
            group: Some(&group),
            ..PipelineParts::new("occlusion, shade", &module)
        });
        let nearest = device.create_sampler(&wgpu::SamplerDescriptor::default());
        Self { depth, gather, shade, group, nearest }
    }
}
