//! The wireframe: every edge once, as a line list, because neither WebGPU nor WebGL2 fills polygons with lines.
//!
//! Hidden lines are removed by depth: the triangles are first drawn into the depth buffer alone, so the background
//! shows between the lines. To keep a surface from hiding its own edges, its triangles are pushed back in proportion
//! to their slope (polygon offset), and lines are pulled towards the eye by the size of a pixel, along the ray through
//! them, which leaves them where they are in the view.

use super::Style;
use super::buffer::draw;
use super::kind::{DrawKind, Drawable, Look, Turn};
use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// Draws wireframes.
#[derive(Debug)]
pub(super) struct Wireframe {
    fill: wgpu::RenderPipeline,
    visible: wgpu::RenderPipeline,
    hidden: wgpu::RenderPipeline,
}

impl Wireframe {
    pub(super) fn new(device: &wgpu::Device, layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::Float32x3;
        let module = scene_shader!(device, "wireframe.wgsl");
        let fill = PipelineParts {
            vertex: "vertex_fill",
            fragment: "fragment_fill",
            attributes: &[Float32x3],
            // Depth grows towards the eye, so back is negative.
            depth_bias: wgpu::DepthBiasState { constant: -2, slope_scale: -1.0, clamp: 0.0 },
            write_mask: wgpu::ColorWrites::empty(),
            ..PipelineParts::new("wireframe, depth", &module)
        };
        let visible = PipelineParts {
            attributes: &[Float32x3, Float32x3],
            topology: wgpu::PrimitiveTopology::LineList,
            ..PipelineParts::new("wireframe, visible lines", &module)
        };
        let hidden = PipelineParts {
            fragment: "fragment_hidden",
            attributes: &[Float32x3, Float32x3],
            topology: wgpu::PrimitiveTopology::LineList,
            depth_compare: wgpu::CompareFunction::Less,
            depth_write: false,
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            ..PipelineParts::new("wireframe, hidden lines", &module)
        };
        Self {
            fill: layout.pipeline(device, &fill),
            visible: layout.pipeline(device, &visible),
            hidden: layout.pipeline(device, &hidden),
        }
    }
}

impl DrawKind for Wireframe {
    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, drawable: &Drawable<'_>, turn: Turn, _: &Style) {
        let surface = drawable.surface;
        let edges: &[&wgpu::RenderPipeline] = match drawable.look {
            Look::Wireframe => &[&self.visible],
            Look::SeeThrough => &[&self.hidden, &self.visible],
            Look::Shaded | Look::Flat => return,
        };
        match turn {
            Turn::Solid => draw(pass, &self.fill, &[&surface.positions], &surface.triangles),
            Turn::Lines => {
                for pipeline in edges {
                    draw(pass, pipeline, &[&surface.positions, &surface.normals], &surface.edges);
                }
            }
        }
    }
}
