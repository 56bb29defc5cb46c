//! What every shader knows: the camera and the theme (group 0) and what is drawn (group 1), and how a pipeline over
//! them is made. `scene.wgsl` is the other side of it, put in front of each shader.

use bytemuck::{Pod, Zeroable};
use glam::Mat4;
use wgpu::util::DeviceExt;

use super::buffer::uniforms;
use super::{Camera, Colour, Drawable, Look, Style, VIRIDIS, ViewTarget};

/// Distance of two sets of uniforms in a buffer: the largest alignment that any device asks for.
const STRIDE: u64 = 256;

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
    /// The scalar of the map's first colour, one over the width of its range.
    map: [f32; 2],
    /// Height of a pixel at distance 1.
    pixel: f32,
    /// Height of the view in pixels.
    height: f32,
}

/// One thing drawn; `Drawn` in `scene.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct DrawnUniforms {
    /// Linear.
    surface: [f32; 4],
    /// Linear.
    inside: [f32; 4],
    /// Linear.
    rim: [f32; 4],
    /// Gamma-encoded.
    line: [f32; 4],
    /// Gamma-encoded.
    line_facing: [f32; 4],
    /// 1 for flat shading.
    flat: f32,
    unused: [f32; 3],
}

/// Layouts that all pipelines share, and the colour map.
#[derive(Debug)]
pub(super) struct SceneLayout {
    pub(super) queue: wgpu::Queue,
    scene: wgpu::BindGroupLayout,
    drawn: wgpu::BindGroupLayout,
    pipeline: wgpu::PipelineLayout,
    map: wgpu::TextureView,
}

/// The uniforms of one call to draw.
///
/// They are a buffer of their own: two views are drawn in one submission, and what is written to a shared buffer
/// arrives before the first of them is drawn.
#[derive(Debug)]
pub(super) struct SceneBindings {
    scene: wgpu::BindGroup,
    drawn: wgpu::BindGroup,
}

/// What differs between pipelines.
pub(super) struct PipelineParts<'a> {
    pub(super) label: &'static str,
    pub(super) module: &'a wgpu::ShaderModule,
    pub(super) vertex: &'static str,
    pub(super) fragment: &'static str,
    /// Formats of the vertex buffers, one attribute each, locations in their order.
    pub(super) attributes: &'a [wgpu::VertexFormat],
    pub(super) topology: wgpu::PrimitiveTopology,
    pub(super) depth_compare: wgpu::CompareFunction,
    pub(super) depth_write: bool,
    pub(super) depth_bias: wgpu::DepthBiasState,
    pub(super) blend: Option<wgpu::BlendState>,
    pub(super) write_mask: wgpu::ColorWrites,
    /// The side that is left out.
    pub(super) cull: Option<wgpu::Face>,
    /// In place of a [`ViewTarget`]: one texture of this format, a sample a pixel, without depth.
    pub(super) plain: Option<wgpu::TextureFormat>,
}

impl<'a> PipelineParts<'a> {
    /// Opaque triangles with depth.
    pub(super) fn new(label: &'static str, module: &'a wgpu::ShaderModule) -> Self {
        Self {
            label,
            module,
            vertex: "vertex",
            fragment: "fragment",
            attributes: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            depth_compare: wgpu::CompareFunction::GreaterEqual,
            depth_write: true,
            depth_bias: wgpu::DepthBiasState::default(),
            blend: None,
            write_mask: wgpu::ColorWrites::ALL,
            cull: None,
            plain: None,
        }
    }
}

impl SceneLayout {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let entry = |size: usize, has_dynamic_offset| wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset,
                min_binding_size: wgpu::BufferSize::new(size as u64),
            },
            count: None,
        };
        let map = wgpu::BindGroupLayoutEntry {
            binding: 1,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        let layout = |label, entries: &[_]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let scene = layout("scene", &[entry(size_of::<SceneUniforms>(), false), map]);
        let drawn = layout("drawn", &[entry(size_of::<DrawnUniforms>(), true)]);
        let pipeline = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("scene"),
            bind_group_layouts: &[Some(&scene), Some(&drawn)],
            immediate_size: 0,
        });
        Self { queue: queue.clone(), scene, drawn, pipeline, map: map_texture(device, queue) }
    }

    /// A pipeline over these layouts, into a [`ViewTarget`]; its module is made by `scene_shader!`.
    pub(super) fn pipeline(&self, device: &wgpu::Device, parts: &PipelineParts<'_>) -> wgpu::RenderPipeline {
        let attributes: Vec<[wgpu::VertexAttribute; 1]> = (0..)
            .zip(parts.attributes)
            .map(|(shader_location, &format)| [wgpu::VertexAttribute { format, offset: 0, shader_location }])
            .collect();
        let buffers: Vec<_> = attributes
            .iter()
            .map(|attributes| {
                Some(wgpu::VertexBufferLayout {
                    array_stride: attributes[0].format.size(),
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes,
                })
            })
            .collect();
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(parts.label),
            layout: Some(&self.pipeline),
            vertex: wgpu::VertexState {
                module: parts.module,
                entry_point: Some(parts.vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState { topology: parts.topology, cull_mode: parts.cull, ..Default::default() },
            depth_stencil: parts.plain.is_none().then(|| wgpu::DepthStencilState {
                format: ViewTarget::DEPTH_FORMAT,
                depth_write_enabled: Some(parts.depth_write),
                depth_compare: Some(parts.depth_compare),
                stencil: wgpu::StencilState::default(),
                bias: parts.depth_bias,
            }),
            multisample: wgpu::MultisampleState {
                count: if parts.plain.is_none() { ViewTarget::SAMPLES } else { 1 },
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: parts.module,
                entry_point: Some(parts.fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: parts.plain.unwrap_or(ViewTarget::FORMAT),
                    blend: parts.blend,
                    write_mask: parts.write_mask,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// Uniforms for `drawables` in one view of `size` pixels.
    pub(super) fn bind(
        &self,
        device: &wgpu::Device,
        size: [u32; 2],
        camera: &Camera,
        drawables: &[Drawable<'_>],
        style: &Style,
    ) -> SceneBindings {
        let scene = scene_uniforms(size, camera, style);
        let drawn_at = (size_of::<SceneUniforms>() as u64).next_multiple_of(STRIDE);
        let size = drawn_at + STRIDE * drawables.len().max(1) as u64;
        let mut bytes = vec![0_u8; size as usize];
        bytes[..size_of::<SceneUniforms>()].copy_from_slice(bytemuck::bytes_of(&scene));
        for (slot, drawable) in bytes[drawn_at as usize..].chunks_exact_mut(STRIDE as usize).zip(drawables) {
            slot[..size_of::<DrawnUniforms>()].copy_from_slice(bytemuck::bytes_of(&drawn_uniforms(drawable, style)));
        }
        let buffer = uniforms(device, &self.queue, "scene", &bytes);
        let part = |offset, size: usize| {
            wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &buffer,
                offset,
                size: wgpu::BufferSize::new(size as u64),
            })
        };
        let map = wgpu::BindingResource::TextureView(&self.map);
        SceneBindings {
            scene: device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("scene"),
                layout: &self.scene,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: part(0, size_of::<SceneUniforms>()) },
                    wgpu::BindGroupEntry { binding: 1, resource: map },
                ],
            }),
            drawn: device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("drawn"),
                layout: &self.drawn,
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: part(drawn_at, size_of::<DrawnUniforms>()) }],
            }),
        }
    }
}

impl SceneBindings {
    /// Binds the scene and the uniforms of drawable `index`.
    pub(super) fn set(&self, pass: &mut wgpu::RenderPass<'_>, index: usize) {
        pass.set_bind_group(0, &self.scene, &[]);
        pass.set_bind_group(1, &self.drawn, &[index as u32 * STRIDE as u32]);
    }
}

/// The source of a shader of this folder with `scene.wgsl` in front.
macro_rules! scene_shader {
    ($device:expr, $file:literal) => {
        $device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some($file),
            source: wgpu::ShaderSource::Wgsl(concat!(include_str!("scene.wgsl"), include_str!($file)).into()),
        })
    };
}
pub(super) use scene_shader;

fn scene_uniforms([width, height]: [u32; 2], camera: &Camera, style: &Style) -> SceneUniforms {
    let (width, height) = (width as f32, height as f32);
    let map = style.map.map_or([0.0, 0.0], |map| {
        let (low, high) = map.range_mm;
        // Without a width, a step as steep as a number can be.
        [low, 1.0 / (high - low).max(f32::MIN_POSITIVE)]
    });
    SceneUniforms {
        view: camera.view(),
        projection: camera.projection(width / height),
        background_top: encoded(style.background_top),
        background_bottom: encoded(style.background_bottom),
        map,
        pixel: 2.0 * (camera.fov_y / 2.0).tan() / height,
        height,
    }
}

fn drawn_uniforms(drawable: &Drawable<'_>, style: &Style) -> DrawnUniforms {
    let (line, line_facing) = drawable.tint.map_or((style.line, style.line_facing), |tint| (tint, tint));
    DrawnUniforms {
        surface: linear(drawable.tint.unwrap_or(style.surface)),
        inside: linear(style.inside),
        rim: linear(style.rim),
        line: encoded(line),
        line_facing: encoded(line_facing),
        flat: f32::from(u8::from(drawable.look == Look::Flat)),
        unused: [0.0; 3],
    }
}

fn encoded(colour: Colour) -> [f32; 4] {
    let [r, g, b] = colour.0.map(|byte| f32::from(byte) / 255.0);
    [r, g, b, 1.0]
}

fn linear(colour: Colour) -> [f32; 4] {
    let [r, g, b] = colour.linear();
    [r, g, b, 1.0]
}

/// The colour map's table as a texture of one row.
fn map_texture(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let texels: Vec<u8> = VIRIDIS.iter().flat_map(|&Colour([r, g, b])| [r, g, b, 255]).collect();
    let texture = device.create_texture_with_data(
        queue,
        &wgpu::TextureDescriptor {
            label: Some("viridis"),
            size: wgpu::Extent3d { width: VIRIDIS.len() as u32, height: 1, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &texels,
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
