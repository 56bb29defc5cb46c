//! The wireframe: every edge once, as a line list, because neither WebGPU nor WebGL2 fills polygons with lines.
//!
//! Hidden lines are removed by depth: the triangles are first drawn into the depth buffer alone, so the background
//! shows between the lines. To keep a surface from hiding its own edges, its triangles are pushed back in proportion
//! to their slope (polygon offset), and lines are pulled towards the eye by the size of a pixel, along the ray through
//! them, which leaves them where they are in the view.

use super::GpuSurface;
use super::buffer::draw;
use super::draw::{DrawContext, Phase, Pipelines};
use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// The pipelines of wireframes.
#[derive(Debug)]
pub(super) struct Wireframe {
    fill: wgpu::RenderPipeline,
    visible: wgpu::RenderPipeline,
    hidden: wgpu::RenderPipeline,
}

impl Wireframe {
    pub(super) const PHASES: &[Phase] = &[Phase::Opaque, Phase::Lines];

    /// Draws the edges of `surface`; `has_hidden` draws the hidden ones too.
    pub(super) fn draw(context: &mut DrawContext<'_, '_>, surface: &GpuSurface, has_hidden: bool) {
        let Self { fill, visible, hidden } = context.pipelines();
        if context.phase == Phase::Opaque {
            return draw(context.pass, fill, &[&surface.positions], &surface.triangles);
        }
        let pipelines: &[_] = if has_hidden { &[hidden, visible] } else { &[visible] };
        for pipeline in pipelines {
            draw(context.pass, pipeline, &[&surface.positions, &surface.normals], &surface.edges);
        }
    }
}

impl Pipelines for Wireframe {
    fn new(layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::Float32x3;
        let module = scene_shader!(layout.device, "wireframe.wgsl");
        let lines = |label| PipelineParts {
            attributes: &[Float32x3, Float32x3],
            topology: wgpu::PrimitiveTopology::LineList,
            ..PipelineParts::new(label, &module)
        };
        Self {
            fill: layout.pipeline(&PipelineParts {
                vertex: "vertex_fill",
                fragment: "fragment_fill",
                attributes: &[Float32x3],
                // Depth grows towards the eye, so back is negative.
                depth_bias: wgpu::DepthBiasState { constant: -2, slope_scale: -1.0, clamp: 0.0 },
                write_mask: wgpu::ColorWrites::empty(),
                ..PipelineParts::new("wireframe, depth", &module)
            }),
            visible: layout.pipeline(&lines("wireframe, visible lines")),
            hidden: layout.pipeline(&PipelineParts {
                fragment: "fragment_hidden",
                depth_compare: wgpu::CompareFunction::Less,
                depth_write: false,
                blend: Some(wgpu::BlendState::ALPHA_BLENDING),
                ..lines("wireframe, hidden lines")
            }),
        }
    }
}
