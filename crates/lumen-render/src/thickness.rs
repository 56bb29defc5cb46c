//! The lumen's thickness along each ray: the sum of the distances at which the ray leaves it less those at which it
//! enters, by blending all walls into one target, without sorting.
//!
//! The target is of half floats where they can be blended (WebGPU, nearly all of WebGL2), else of bytes: then thickness
//! is to 0.25 mm, for four walls or fewer before each other and a vessel of 500 mm or less in depth.

use super::GpuSurface;
use super::buffer::draw;
use super::draw::{Draw, DrawContext, Phase, Pipelines};
use super::pipeline::{ADD, Destination, PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// What a machine can add up thickness in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThicknessFormat {
    /// Half floats.
    Floats,
    /// Bytes.
    Bytes,
}

impl ThicknessFormat {
    /// The better one that `adapter` can blend.
    pub fn of(adapter: &wgpu::Adapter) -> Self {
        let can = adapter.get_texture_format_features(wgpu::TextureFormat::Rgba16Float);
        let blends = can.flags.contains(wgpu::TextureFormatFeatureFlags::BLENDABLE);
        let renders = can.allowed_usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT);
        if blends && renders { Self::Floats } else { Self::Bytes }
    }

    pub(super) fn texture(self) -> wgpu::TextureFormat {
        match self {
            Self::Floats => wgpu::TextureFormat::Rgba16Float,
            Self::Bytes => wgpu::TextureFormat::Rgba8Unorm,
        }
    }

    /// An empty sum: steps in red, the rest in green.
    pub(super) fn none(self) -> wgpu::Color {
        let [_, _, steps, rest] = self.unit().map(f64::from);
        wgpu::Color { r: steps, g: rest, b: 0.0, a: 0.0 }
    }

    /// Value of a step of 8 mm and of a mm, and what both are at first; `unit` in `fluoroscopy.wgsl`.
    pub(super) fn unit(self) -> [f32; 4] {
        match self {
            Self::Floats => [1.0, 1.0, 0.0, 0.0],
            Self::Bytes => [1.0 / 255.0, 4.0 / 255.0, 16.0 / 255.0, 128.0 / 255.0],
        }
    }
}

/// A closed surface whose thickness is added up. Its scalars say where along the vessel each node is, 0 to 1.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a>(pub &'a GpuSurface);

impl Draw for Body<'_> {
    fn phases(&self) -> &'static [Phase] {
        &[Phase::Thickness]
    }

    fn draw(&self, context: &mut DrawContext<'_, '_>) {
        let BodyPipelines { far, near } = context.pipelines();
        // All that adds before all that takes away: bytes cannot go below nothing.
        for pipeline in [far, near] {
            draw(context.pass, pipeline, &[&self.0.positions, &self.0.scalars], &self.0.triangles);
        }
    }
}

#[derive(Debug)]
struct BodyPipelines {
    far: wgpu::RenderPipeline,
    near: wgpu::RenderPipeline,
}

impl Pipelines for BodyPipelines {
    fn new(layout: &SceneLayout) -> Self {
        let module = scene_shader!(layout.device, "thickness.wgsl");
        let wall = |label, fragment, cull, operation| {
            layout.pipeline(&PipelineParts {
                fragment,
                attributes: &[wgpu::VertexFormat::Float32x3, wgpu::VertexFormat::Float32],
                blend: Some(wgpu::BlendState { color: wgpu::BlendComponent { operation, ..ADD }, alpha: ADD }),
                cull: Some(cull),
                into: Destination::Texture(layout.thickness.texture()),
                ..PipelineParts::new(label, &module)
            })
        };
        let [far, near] = match layout.thickness {
            ThicknessFormat::Floats => ["fragment_far", "fragment_near"],
            ThicknessFormat::Bytes => ["fragment_far_bytes", "fragment_near_bytes"],
        };
        Self {
            far: wall("thickness, far walls", far, wgpu::Face::Front, wgpu::BlendOperation::Add),
            near: wall("thickness, near walls", near, wgpu::Face::Back, wgpu::BlendOperation::ReverseSubtract),
        }
    }
}
