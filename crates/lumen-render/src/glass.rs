//! The vessel as a trial shows it: translucent from outside, so that the wire is seen in it, and from inside as the
//! tip sees it.
//!
//! From outside the far wall is drawn first and then the near one, each opaque where it turns away from the eye
//! (Schlick's form of Fresnel's equations, softened): form reads, and no order within a wall matters much. Where the
//! wire has pressed, the wall takes the colour of the largest force there.

use super::GpuSurface;
use super::buffer::draw;
use super::draw::{Draw, DrawContext, Phase, Pipelines};
use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// A translucent vessel. Its scalars are forces in N.
#[derive(Clone, Copy, Debug)]
pub struct Glass<'a>(pub &'a GpuSurface);

/// A vessel seen from inside, lit by a light beside the eye. Its scalars are forces in N.
#[derive(Clone, Copy, Debug)]
pub struct Inside<'a>(pub &'a GpuSurface);

impl Draw for Glass<'_> {
    fn phases(&self) -> &'static [Phase] {
        &[Phase::Transparent]
    }

    fn draw(&self, context: &mut DrawContext<'_, '_>) {
        let GlassPipelines { far, near, .. } = context.pipelines();
        wall(context, far, self.0);
        wall(context, near, self.0);
    }
}

impl Draw for Inside<'_> {
    fn phases(&self) -> &'static [Phase] {
        &[Phase::Opaque]
    }

    fn draw(&self, context: &mut DrawContext<'_, '_>) {
        let GlassPipelines { inside, .. } = context.pipelines();
        wall(context, inside, self.0);
    }
}

fn wall(context: &mut DrawContext<'_, '_>, pipeline: &wgpu::RenderPipeline, vessel: &GpuSurface) {
    draw(context.pass, pipeline, &[&vessel.positions, &vessel.normals, &vessel.scalars], &vessel.triangles);
}

#[derive(Debug)]
struct GlassPipelines {
    far: wgpu::RenderPipeline,
    near: wgpu::RenderPipeline,
    inside: wgpu::RenderPipeline,
}

impl Pipelines for GlassPipelines {
    fn new(layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::{Float32, Float32x3};
        let module = scene_shader!(layout.device, "glass.wgsl");
        let inside = PipelineParts {
            fragment: "fragment_inside",
            attributes: &[Float32x3, Float32x3, Float32],
            ..PipelineParts::new("vessel, inside", &module)
        };
        let wall = |label, fragment, cull| {
            layout.pipeline(&PipelineParts {
                label,
                fragment,
                depth_write: false,
                blend: Some(wgpu::BlendState::ALPHA_BLENDING),
                cull: Some(cull),
                ..inside
            })
        };
        Self {
            far: wall("vessel, far wall", "fragment_far", wgpu::Face::Front),
            near: wall("vessel, near wall", "fragment_near", wgpu::Face::Back),
            inside: layout.pipeline(&inside),
        }
    }
}
