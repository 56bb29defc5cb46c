//! What every shader knows: the camera and the theme (group 0) and the paint of what is drawn (group 1). `scene.wgsl` is
//! the other side of it, put in front of each shader.

use bytemuck::{Pod, Zeroable};
use glam::Mat4;

use super::buffer::uniforms;
use super::draw::Draw;
use super::paint::{PaintUniforms, encoded};
use super::texture::filled;
use super::thickness::ThicknessFormat;
use super::{Camera, Colour, Style, VIRIDIS, binding, diverging, label_colour};

/// Distance of two sets of uniforms in a buffer: the largest alignment that any device asks for.
const STRIDE: u64 = 256;

/// How far ambient occlusion reaches, as a part of the diagonal of what is shown: about a vessel's radius.
const REACH: f32 = 0.04;

/// The camera and the theme; `Scene` in `scene.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct SceneUniforms {
    /// World to camera.
    view: Mat4,
    /// Camera to clip.
    projection: Mat4,
    /// Gamma-encoded.
    background_top: [f32; 4],
    /// Gamma-encoded.
    background_bottom: [f32; 4],
    /// The scalar of the map's first colour, one over the width of its range; that is negative for labels,
    /// of which the first is 1 where they are the vertices' own.
    map: [f32; 2],
    /// Height of a pixel at distance 1.
    pixel: f32,
    /// Height of the view in pixels.
    height: f32,
    /// 1 for raking light, how far ambient occlusion reaches in mm; the others are not in use.
    light: [f32; 4],
    /// A plane in camera coordinates: what has a positive product with it, the fourth part added, is left out.
    clip: [f32; 4],
    /// The row of the colour map's texture; the others are not in use.
    row: [f32; 4],
}

/// The device, layouts that all pipelines share, and the colour map.
#[derive(Debug)]
pub(super) struct SceneLayout {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    scene: wgpu::BindGroupLayout,
    paint: wgpu::BindGroupLayout,
    map: wgpu::TextureView,
    /// What fluoroscopies add up thickness in.
    pub(super) thickness: ThicknessFormat,
}

/// The uniforms of one call to draw.
///
/// They are a buffer of their own: two views are drawn in one submission, and what is written to a shared buffer
/// arrives before the first of them is drawn.
#[derive(Debug)]
pub(super) struct SceneBindings {
    scene: wgpu::BindGroup,
    paint: wgpu::BindGroup,
}

impl SceneLayout {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let of_scene = [binding::uniform(size_of::<SceneUniforms>(), false), binding::texture(false)];
        let scene = binding::layout(device, "scene", stages, &of_scene);
        let of_paint = [binding::uniform(size_of::<PaintUniforms>(), true)];
        let paint = binding::layout(device, "paint", stages, &of_paint);
        Self {
            map: map_texture(device, queue),
            device: device.clone(),
            queue: queue.clone(),
            scene,
            paint,
            thickness: ThicknessFormat::Bytes,
        }
    }

    /// The layout of pipelines that read the scene, the paint, and perhaps another group.
    pub(super) fn pipeline_layout(&self, group: Option<&wgpu::BindGroupLayout>) -> wgpu::PipelineLayout {
        let groups = [Some(&self.scene), Some(&self.paint), group];
        self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("scene"),
            bind_group_layouts: &groups[..if group.is_some() { 3 } else { 2 }],
            immediate_size: 0,
        })
    }

    /// Uniforms of one view of `size` pixels, with a paint for each of `things`.
    pub(super) fn bind(&self, size: [u32; 2], camera: &Camera, style: &Style, things: &[&dyn Draw]) -> SceneBindings {
        let scene = scene_uniforms(size, camera, style);
        let paints_at = (size_of::<SceneUniforms>() as u64).next_multiple_of(STRIDE);
        let size = paints_at + STRIDE * things.len().max(1) as u64;
        let mut bytes = vec![0_u8; size as usize];
        bytes[..size_of::<SceneUniforms>()].copy_from_slice(bytemuck::bytes_of(&scene));
        for (slot, thing) in bytes[paints_at as usize..].chunks_exact_mut(STRIDE as usize).zip(things) {
            slot[..size_of::<PaintUniforms>()].copy_from_slice(bytemuck::bytes_of(&thing.paint(style).uniforms()));
        }
        let buffer = uniforms(&self.device, &self.queue, "scene", &bytes);
        let part = |offset, size: usize| {
            wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &buffer,
                offset,
                size: wgpu::BufferSize::new(size as u64),
            })
        };
        let map = wgpu::BindingResource::TextureView(&self.map);
        SceneBindings {
            scene: binding::group(&self.device, "scene", &self.scene, [part(0, size_of::<SceneUniforms>()), map]),
            paint: binding::group(&self.device, "paint", &self.paint, [part(paints_at, size_of::<PaintUniforms>())]),
        }
    }
}

impl SceneBindings {
    /// Binds the scene and paint `index`.
    pub(super) fn set(&self, pass: &mut wgpu::RenderPass<'_>, index: usize) {
        pass.set_bind_group(0, &self.scene, &[]);
        pass.set_bind_group(1, &self.paint, &[index as u32 * STRIDE as u32]);
    }
}

fn scene_uniforms([width, height]: [u32; 2], camera: &Camera, style: &Style) -> SceneUniforms {
    let (width, height) = (width as f32, height as f32);
    let view = camera.view();
    let map = style.map.map_or([0.0, 0.0], |map| {
        if style.labels {
            return [f32::from(u8::from(style.by_vertex)), -1.0];
        }
        let (low, high) = map.range;
        // Without a width, a step as steep as a number can be.
        [low, 1.0 / (high - low).max(f32::MIN_POSITIVE)]
    });
    let reach = if style.occlusion { REACH * camera.bounds.diagonal() } else { 0.0 };
    SceneUniforms {
        view,
        projection: camera.projection(width / height),
        background_top: encoded(style.background_top),
        background_bottom: encoded(style.background_bottom),
        map,
        pixel: 2.0 * (camera.fov_y / 2.0).tan() / height,
        height,
        light: [f32::from(u8::from(style.raking)), reach, 0.0, 0.0],
        clip: style.clip.map_or([0.0, 0.0, 0.0, -1.0], |plane| {
            let point = view.transform_point3(plane.normal * plane.offset);
            let normal = view.transform_vector3(plane.normal);
            normal.extend(-normal.dot(point)).to_array()
        }),
        row: [if style.diverging { 2.0 } else { 0.0 }, 0.0, 0.0, 0.0],
    }
}

/// The colour map's table as a texture, below it a row of the labels' palette over and over, and the diverging map's.
fn map_texture(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let last = VIRIDIS.len() - 1;
    let both_ways = (0..=last).map(|i| diverging(i as f32 / last as f32));
    let rows = VIRIDIS.into_iter().chain((0..=last).map(label_colour)).chain(both_ways);
    let texels: Vec<u8> = rows.flat_map(|Colour([r, g, b])| [r, g, b, 255]).collect();
    let size = [VIRIDIS.len() as u32, 3];
    filled(device, queue, "viridis", size, wgpu::TextureFormat::Rgba8Unorm, &texels)
}
