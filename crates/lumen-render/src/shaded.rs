//! The shaded vessel: a matte wall under a soft sky and one key light that goes with the camera, with a rim where it
//! turns away from the eye, and its inside in another colour.
//!
//! Light in linear colour: hemispheric (Phong's ambient term with a sky above and a ground below: the OpenGL "Orange
//! Book", Rost 2006, section 12.1) plus a Lambertian key light, and a rim after Schlick's form of Fresnel's equations
//! (1994). No highlight: a wall has none, and highlights move where a coarse level's normals do.

use super::Style;
use super::buffer::draw;
use super::kind::{DrawKind, Drawable, Look, Turn};
use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;

/// Draws shaded surfaces.
#[derive(Debug)]
pub(super) struct Shaded {
    plain: wgpu::RenderPipeline,
    mapped: wgpu::RenderPipeline,
}

impl Shaded {
    pub(super) fn new(device: &wgpu::Device, layout: &SceneLayout) -> Self {
        use wgpu::VertexFormat::{Float32, Float32x3};
        let module = scene_shader!(device, "shaded.wgsl");
        let plain = PipelineParts { attributes: &[Float32x3, Float32x3], ..PipelineParts::new("shaded", &module) };
        let mapped = PipelineParts {
            vertex: "vertex_mapped",
            fragment: "fragment_mapped",
            attributes: &[Float32x3, Float32x3, Float32],
            ..PipelineParts::new("shaded, colour map", &module)
        };
        Self { plain: layout.pipeline(device, &plain), mapped: layout.pipeline(device, &mapped) }
    }
}

impl DrawKind for Shaded {
    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, drawable: &Drawable<'_>, turn: Turn, style: &Style) {
        let surface = drawable.surface;
        if turn != Turn::Solid || !matches!(drawable.look, Look::Shaded | Look::Flat) {
            return;
        }
        if style.map.is_some() && !surface.scalars.is_empty() {
            let vertices = [&surface.positions, &surface.normals, &surface.scalars];
            draw(pass, &self.mapped, &vertices, &surface.triangles);
        } else {
            draw(pass, &self.plain, &[&surface.positions, &surface.normals], &surface.triangles);
        }
    }
}
