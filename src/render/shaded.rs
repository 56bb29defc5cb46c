//! The shaded vessel: a matte wall under a soft sky and one key light that goes with the camera, with a rim where it
//! turns away from the eye, and its inside in another colour.
//!
//! Light in linear colour: hemispheric (Phong's ambient term with a sky above and a ground below: the OpenGL "Orange
//! Book", Rost 2006, section 12.1) plus a Lambertian key light, and a rim after Schlick's form of Fresnel's equations
//! (1994). No highlight: a wall has none, and highlights move where a coarse level's normals do.

use super::GpuSurface;
use super::scene::{PipelineParts, SceneLayout, scene_shader};

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

    /// Draws `surface`, with its scalars as colours if `mapped` and if it has them. Its scene must be bound.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, surface: &GpuSurface, mapped: bool) {
        let (Some(positions), Some(normals), Some(triangles)) =
            (surface.positions.slice(), surface.normals.slice(), surface.triangles.slice())
        else {
            return;
        };
        match surface.scalars.slice().filter(|_| mapped) {
            Some(scalars) => {
                pass.set_pipeline(&self.mapped);
                pass.set_vertex_buffer(2, scalars);
            }
            None => pass.set_pipeline(&self.plain),
        }
        pass.set_vertex_buffer(0, positions);
        pass.set_vertex_buffer(1, normals);
        pass.set_index_buffer(triangles, wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..surface.triangles.count(size_of::<u32>()), 0, 0..1);
    }
}
