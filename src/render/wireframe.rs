//! The wireframe: every edge once, as a line list, because neither WebGPU nor WebGL2 fills polygons with lines.
//!
//! Hidden lines are removed by depth: the triangles are first drawn into the depth buffer alone, so the background
//! shows between the lines. To keep a surface from hiding its own edges, its triangles are pushed back in proportion
//! to their slope (polygon offset), and lines are pulled towards the eye by the size of a pixel, along the ray through
//! them, which leaves them where they are in the view.

use super::GpuSurface;
use super::scene::{PipelineParts, SceneLayout, scene_shader};

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

    /// Puts the triangles of `surface` into the depth buffer. Its scene must be bound, here and below.
    pub(super) fn draw_depth(&self, pass: &mut wgpu::RenderPass<'_>, surface: &GpuSurface) {
        if let (Some(positions), Some(triangles)) = (surface.positions.slice(), surface.triangles.slice()) {
            pass.set_pipeline(&self.fill);
            pass.set_vertex_buffer(0, positions);
            pass.set_index_buffer(triangles, wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..surface.triangles.count(size_of::<u32>()), 0, 0..1);
        }
    }

    /// Draws the edges of `surface` that nothing in the depth buffer hides.
    pub(super) fn draw_visible(&self, pass: &mut wgpu::RenderPass<'_>, surface: &GpuSurface) {
        draw_edges(&self.visible, pass, surface);
    }

    /// Draws the edges of `surface` that something in the depth buffer hides, faintly.
    pub(super) fn draw_hidden(&self, pass: &mut wgpu::RenderPass<'_>, surface: &GpuSurface) {
        draw_edges(&self.hidden, pass, surface);
    }
}

fn draw_edges(pipeline: &wgpu::RenderPipeline, pass: &mut wgpu::RenderPass<'_>, surface: &GpuSurface) {
    if let (Some(positions), Some(normals), Some(edges)) =
        (surface.positions.slice(), surface.normals.slice(), surface.edges.slice())
    {
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, positions);
        pass.set_vertex_buffer(1, normals);
        pass.set_index_buffer(edges, wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..surface.edges.count(size_of::<u32>()), 0, 0..1);
    }
}
