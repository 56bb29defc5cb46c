//! Slices of a scan among the surfaces: a picture of greys on a parallelogram, seen from both sides.
//!
//! The middles of its outer pixels lie in the corners, so that each value is shown where the voxel lies. A picture with more
//! pixels than a texture of the device may have is thinned.

use bytemuck::cast_slice;
use glam::{Vec2, Vec3};

use super::binding;
use super::buffer::{GrowingBuffer, draw};
use super::draw::{Draw, DrawContext, Phase, Pipelines};
use super::error::SurfaceError;
use super::pipeline::{PipelineParts, scene_shader};
use super::scene::SceneLayout;
use super::texture::filled;

/// A slice in GPU memory.
#[derive(Debug)]
pub struct GpuSlice {
    greys: wgpu::TextureView,
    positions: GrowingBuffer,
    at: GrowingBuffer,
    triangles: GrowingBuffer,
}

impl GpuSlice {
    /// A slice of `size` pixels, the first axis running fastest, 0 black and 255 white; `corners` in mm around it: the first
    /// pixel, the last along the first axis, the last of all, the last along the second axis.
    ///
    /// # Errors
    /// Where there is not a grey for each pixel, no pixel at all, or the device does not allow a buffer.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        size: [usize; 2],
        pixels: &[u8],
        corners: [Vec3; 4],
    ) -> Result<Self, SurfaceError> {
        let expected = size[0] * size[1];
        if expected == 0 || pixels.len() != expected {
            return Err(SurfaceError::Count { what: "pixels", expected, found: pixels.len() });
        }
        let most = device.limits().max_texture_dimension_2d as usize;
        let step = size[0].max(size[1]).div_ceil(most.max(1)).max(1);
        let thinned = size.map(|side| side.div_ceil(step));
        let rows = pixels.chunks_exact(size[0]).step_by(step);
        let texels: Vec<u8> = rows.flat_map(|row| row.iter().step_by(step).copied()).collect();
        let [width, height] = thinned.map(|side| side as u32);
        let greys = filled(device, queue, "slice", [width, height], wgpu::TextureFormat::R8Unorm, &texels);

        // From middle to middle.
        let first = Vec2::new(0.5 / width as f32, 0.5 / height as f32);
        let last = |axis: usize| ((size[axis] - 1) as f32 / step as f32 + 0.5) / thinned[axis] as f32;
        let (right, bottom) = (last(0), last(1));
        let at = [first, Vec2::new(right, first.y), Vec2::new(right, bottom), Vec2::new(first.x, bottom)];
        let mut slice = Self {
            greys,
            positions: GrowingBuffer::vertices("slice, positions"),
            at: GrowingBuffer::vertices("slice, places"),
            triangles: GrowingBuffer::indices("slice, triangles"),
        };
        slice.positions.write(device, queue, cast_slice(&corners))?;
        slice.at.write(device, queue, cast_slice(&at))?;
        slice.triangles.write(device, queue, cast_slice(&[0_u32, 1, 2, 0, 2, 3]))?;
        Ok(slice)
    }
}

impl Draw for GpuSlice {
    fn phases(&self) -> &'static [Phase] {
        &[Phase::Behind]
    }

    fn draw(&self, context: &mut DrawContext<'_, '_>) {
        let SlicePipelines { pipeline, group, bilinear } = context.pipelines();
        let greys = wgpu::BindingResource::TextureView(&self.greys);
        let bilinear = wgpu::BindingResource::Sampler(bilinear);
        let group = binding::group(&context.layout.device, "slice", group, [greys, bilinear]);
        context.pass.set_bind_group(2, &group, &[]);
        draw(context.pass, pipeline, &[&self.positions, &self.at], &self.triangles);
    }
}

#[derive(Debug)]
struct SlicePipelines {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroupLayout,
    bilinear: wgpu::Sampler,
}

impl Pipelines for SlicePipelines {
    fn new(layout: &SceneLayout) -> Self {
        let device = &layout.device;
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let group = binding::layout(device, "slice", wgpu::ShaderStages::FRAGMENT, &[binding::texture(true), sampler]);
        let module = scene_shader!(device, "slice.wgsl");
        let pipeline = layout.pipeline(&PipelineParts {
            attributes: &[wgpu::VertexFormat::Float32x3, wgpu::VertexFormat::Float32x2],
            group: Some(&group),
            ..PipelineParts::new("slice", &module)
        });
        let bilinear = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("slice"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..wgpu::SamplerDescriptor::default()
        });
        Self { pipeline, group, bilinear }
    }
}
