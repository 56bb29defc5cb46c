//! The shaded vessel: a matte wall under a soft sky and one key light that goes with the camera, with a rim where it
//! turns away from the eye, and its inside in another colour.
//!
//! Light in linear colour: hemispheric (Phong's ambient term with a sky above and a ground below: the OpenGL "Orange
//! Book", Rost 2006, section 12.1) plus a Lambertian key light, and a rim after Schlick's form of Fresnel's equations
//! (1994). No highlight: a wall has none, and highlights move where a coarse level's normals do.

use super::GpuSurface;
use super::buffer::draw;
use super::draw::{DrawContext, Phase, Pipelines};
use super::occlusion::Occlusion;
use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// The pipelines of shaded surfaces.
#[derive(Debug)]
pub(super) struct Shaded {
    plain: wgpu::RenderPipeline,
    mapped: wgpu::RenderPipeline,
}

impl Shaded {
    pub(super) const PHASES: &[Phase] = &[Phase::Depth, Phase::Opaque];

    /// Draws `surface`, with its scalars as colours where it has any and the style has a map.
    pub(super) fn draw(context: &mut DrawContext<'_, '_>, surface: &GpuSurface) {
        if context.phase == Phase::Depth {
            return Occlusion::draw_depth(context, surface);
        }
        let Self { plain, mapped } = context.pipelines();
        if context.style.map.is_some() && !surface.scalars.is_empty() {
            let vertices = [&surface.positions, &surface.normals, &surface.scalars];
            draw(context.pass, mapped, &vertices, &surface.triangles);
        } else {
            draw(context.pass, plain, &[&surface.positions, &surface.normals], &surface.triangles);
        }
    }
}

impl Pipelines for Shaded {
    fn new(layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::{Float32, Float32x3};
        let module = scene_shader!(layout.device, "shaded.wgsl");
        Self {
            plain: layout.pipeline(&PipelineParts {
                attributes: &[Float32x3, Float32x3],
                ..PipelineParts::new("shaded", &module)
            }),
            mapped: layout.pipeline(&PipelineParts {
                vertex: "vertex_mapped",
                fragment: "fragment_mapped",
                attributes: &[Float32x3, Float32x3, Float32],
                ..PipelineParts::new("shaded, colour map", &module)
            }),
        }
    }
}
