//! The vessel as a trial shows it: translucent from outside, so that the wire is seen in it, and from inside as the
//! tip sees it.
//!
//! From outside the far wall is drawn first and then the near one, each opaque where it turns away from the eye
//! (Schlick's form of Fresnel's equations, softened): form reads, and no order within a wall matters much. Where the
//! wire has pressed, the wall takes the colour of the largest force there.

use super::GpuSurface;
use super::buffer::draw;
use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// Draws vessels that can be seen through, and from inside.
#[derive(Debug)]
pub(super) struct Glass {
    far: wgpu::RenderPipeline,
    near: wgpu::RenderPipeline,
    inside: wgpu::RenderPipeline,
}

impl Glass {
    pub(super) fn new(device: &wgpu::Device, layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::{Float32, Float32x3};
        let module = scene_shader!(device, "glass.wgsl");
        let wall = |label, fragment, cull| PipelineParts {
            fragment,
            attributes: &[Float32x3, Float32x3, Float32],
            depth_write: false,
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            cull: Some(cull),
            ..PipelineParts::new(label, &module)
        };
        let far = wall("vessel, far wall", "fragment_far", wgpu::Face::Front);
        let near = wall("vessel, near wall", "fragment_near", wgpu::Face::Back);
        let inside = PipelineParts {
            depth_write: true,
            blend: None,
            cull: None,
            ..wall("vessel, inside", "fragment_inside", wgpu::Face::Front)
        };
        Self {
            far: layout.pipeline(device, &far),
            near: layout.pipeline(device, &near),
            inside: layout.pipeline(device, &inside),
        }
    }

    /// Draws the walls of `vessel`, the far one first. Its scene must be bound, here and below, and it must have
    /// scalars: forces.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, vessel: &GpuSurface) {
        for pipeline in [&self.far, &self.near] {
            draw(pass, pipeline, &[&vessel.positions, &vessel.normals, &vessel.scalars], &vessel.triangles);
        }
    }

    /// Draws `vessel` as it is seen from inside, by a light beside the eye.
    pub(super) fn draw_inside(&self, pass: &mut wgpu::RenderPass<'_>, vessel: &GpuSurface) {
        draw(pass, &self.inside, &[&vessel.positions, &vessel.normals, &vessel.scalars], &vessel.triangles);
    }
}
