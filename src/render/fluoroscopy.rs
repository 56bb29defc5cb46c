//! The fluoroscopy: what X-rays leave after lumen and wire, `I = I0 exp(-sum of mu d)` (Beer and Lambert).
//!
//! The lumen's thickness along each ray is the sum of the distances at which the ray leaves it less those at which it
//! enters, by blending all walls into one target, without sorting. Contrast: 70 mg iodine in 1 ml of blood, 0.06 /mm at
//! 60 keV (NIST XCOM); tissue is the same everywhere and part of the brightness. The target is of half floats where
//! they can be blended (WebGPU, nearly all of WebGL2), else of bytes: then thickness is to 0.25 mm, for four walls or
//! fewer before each other and a vessel of 500 mm or less in depth.

use bytemuck::{Pod, Zeroable};

use super::scene::{PipelineParts, SceneBindings, SceneLayout, scene_shader};
use super::wire::{SHADOW, Wire};
use super::{GpuSurface, GpuWire, ViewTarget, buffer};

/// Attenuation of the contrast in 1/mm.
const CONTRAST: f32 = 0.06;
/// Noise where all light comes through, as a part of it.
const NOISE: f32 = 0.02;

/// What a machine can add up thickness in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThicknessFormat {
    /// Half floats.
    Floats,
    /// Bytes.
    Bytes,
}

impl ThicknessFormat {
    /// The better one that `adapter` can blend.
    pub fn of(adapter: &wgpu::Adapter) -> Self {
        let can = adapter.get_texture_format_features(wgpu::TextureFormat::Rgba16Float);
        let blends = can.flags.contains(wgpu::TextureFormatFeatureFlags::BLENDABLE);
        let renders = can.allowed_usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT);
        if blends && renders { Self::Floats } else { Self::Bytes }
    }

    fn texture(self) -> wgpu::TextureFormat {
        match self {
            Self::Floats => wgpu::TextureFormat::Rgba16Float,
            Self::Bytes => wgpu::TextureFormat::Rgba8Unorm,
        }
    }

    /// Value of a step of 8 mm and of a mm, and what both are at first; `unit` in the shader.
    fn unit(self) -> [f32; 4] {
        match self {
            Self::Floats => [1.0, 1.0, 0.0, 0.0],
            Self::Bytes => [1.0 / 255.0, 4.0 / 255.0, 16.0 / 255.0, 128.0 / 255.0],
        }
    }
}

/// One exposure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exposure {
    /// The number of the pulse: each has noise of its own.
    pub pulse: u32,
    /// Seconds since contrast was given, if it was.
    pub contrast_s: Option<f32>,
    /// How fast the blood takes it along, in vessel lengths a second.
    pub flow: f32,
    /// Whether the lumen is shown over the picture.
    pub roadmap: bool,
}

/// `Exposure` in `fluoroscopy.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct ExposureUniforms {
    unit: [f32; 4],
    contrast: [f32; 4],
    picture: [f32; 4],
}

/// What one fluoroscopy view renders to.
#[derive(Debug)]
pub struct FluoroscopyTarget {
    size: [u32; 2],
    thickness: wgpu::TextureView,
    shadow: wgpu::TextureView,
    picture: wgpu::Texture,
    view: wgpu::TextureView,
}

impl FluoroscopyTarget {
    /// The texture with the finished picture, in [`ViewTarget::FORMAT`].
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// The same, to be read back.
    pub fn picture(&self) -> &wgpu::Texture {
        &self.picture
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }
}

/// Draws fluoroscopies.
#[derive(Debug)]
pub(super) struct Fluoroscopy {
    queue: wgpu::Queue,
    format: ThicknessFormat,
    far: wgpu::RenderPipeline,
    near: wgpu::RenderPipeline,
    expose: wgpu::RenderPipeline,
    exposure: wgpu::BindGroupLayout,
}

impl Fluoroscopy {
    pub(super) fn new(device: &wgpu::Device, layout: &SceneLayout, format: ThicknessFormat) -> Self {
        let module = scene_shader!(device, "thickness.wgsl");
        let wall = |label, fragment, cull, operation| {
            let by = |operation| wgpu::BlendComponent {
                src_factor: wgpu::BlendFactor::One,
                dst_factor: wgpu::BlendFactor::One,
                operation,
            };
            let parts = PipelineParts {
                fragment,
                attributes: &[wgpu::VertexFormat::Float32x3, wgpu::VertexFormat::Float32],
                blend: Some(wgpu::BlendState { color: by(operation), alpha: by(wgpu::BlendOperation::Add) }),
                cull: Some(cull),
                plain: Some(format.texture()),
                ..PipelineParts::new(label, &module)
            };
            layout.pipeline(device, &parts)
        };
        let [far, near] = match format {
            ThicknessFormat::Floats => ["fragment_far", "fragment_near"],
            ThicknessFormat::Bytes => ["fragment_far_bytes", "fragment_near_bytes"],
        };
        let exposure = exposure_layout(device);
        Self {
            queue: layout.queue.clone(),
            format,
            far: wall("thickness, far walls", far, wgpu::Face::Front, wgpu::BlendOperation::Add),
            near: wall("thickness, near walls", near, wgpu::Face::Back, wgpu::BlendOperation::ReverseSubtract),
            expose: expose_pipeline(device, &exposure),
            exposure,
        }
    }

    /// A target of `size` pixels, brought within 1 and what the device allows.
    pub(super) fn target(&self, device: &wgpu::Device, size: [u32; 2]) -> FluoroscopyTarget {
        use wgpu::TextureUsages as Usage;
        let largest = device.limits().max_texture_dimension_2d;
        let size = size.map(|side| side.clamp(1, largest));
        let texture = |label, format, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: usage | Usage::RENDER_ATTACHMENT | Usage::TEXTURE_BINDING,
                view_formats: &[],
            })
        };
        let whole = wgpu::TextureViewDescriptor::default();
        let picture = texture("fluoroscopy", ViewTarget::FORMAT, Usage::COPY_SRC);
        FluoroscopyTarget {
            size,
            thickness: texture("thickness", self.format.texture(), Usage::empty()).create_view(&whole),
            shadow: texture("shadow", SHADOW, Usage::empty()).create_view(&whole),
            view: picture.create_view(&whole),
            picture,
        }
    }

    /// Adds up the thickness of `body`, a closed surface whose scalars say where along the vessel each node is.
    pub(super) fn measure(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &FluoroscopyTarget,
        bindings: &SceneBindings,
        body: &GpuSurface,
    ) {
        let [_, _, steps, rest] = self.format.unit().map(f64::from);
        let clear = wgpu::Color { r: steps, g: rest, b: 0.0, a: 0.0 };
        let mut pass = begin(encoder, "thickness", &target.thickness, clear);
        if let (Some(positions), Some(places), Some(triangles)) =
            (body.positions.slice(), body.scalars.slice(), body.triangles.slice())
        {
            bindings.set(&mut pass, 0);
            pass.set_vertex_buffer(0, positions);
            pass.set_vertex_buffer(1, places);
            pass.set_index_buffer(triangles, wgpu::IndexFormat::Uint32);
            // All that adds before all that takes away: bytes cannot go below nothing.
            for pipeline in [&self.far, &self.near] {
                pass.set_pipeline(pipeline);
                pass.draw_indexed(0..body.triangles.count(size_of::<u32>()), 0, 0..1);
            }
        }
    }

    /// Takes the picture: the wire's shadow, and both turned into grey.
    pub(super) fn expose(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &FluoroscopyTarget,
        bindings: &SceneBindings,
        (drawing, wire): (&Wire, &GpuWire),
        exposure: &Exposure,
    ) {
        {
            let mut pass = begin(encoder, "shadow", &target.shadow, wgpu::Color::TRANSPARENT);
            bindings.set(&mut pass, 0);
            drawing.draw_shadow(&mut pass, wire);
        }
        let group = self.bind(device, target, exposure);
        let mut pass = begin(encoder, "fluoroscopy", &target.view, wgpu::Color::BLACK);
        pass.set_pipeline(&self.expose);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }

    fn bind(&self, device: &wgpu::Device, target: &FluoroscopyTarget, exposure: &Exposure) -> wgpu::BindGroup {
        let [width, height] = target.size.map(|side| side as f32);
        let roadmap = f32::from(u8::from(exposure.roadmap));
        let uniforms = ExposureUniforms {
            unit: self.format.unit(),
            contrast: [exposure.contrast_s.unwrap_or(-1.0), exposure.flow.max(1e-3), CONTRAST, roadmap],
            picture: [exposure.pulse as f32, NOISE, width, height],
        };
        let buffer = buffer::uniforms(device, &self.queue, "exposure", bytemuck::bytes_of(&uniforms));
        let texture =
            |binding, view| wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) };
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("exposure"),
            layout: &self.exposure,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() },
                texture(1, &target.thickness),
                texture(2, &target.shadow),
            ],
        })
    }
}

fn exposure_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: wgpu::BufferSize::new(size_of::<ExposureUniforms>() as u64),
    };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("exposure"),
        entries: &[entry(0, uniform), entry(1, texture), entry(2, texture)],
    })
}

fn expose_pipeline(device: &wgpu::Device, exposure: &wgpu::BindGroupLayout) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::include_wgsl!("fluoroscopy.wgsl"));
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("exposure"),
        bind_group_layouts: &[Some(exposure)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("exposure"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(ViewTarget::FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A pass over one texture, cleared first.
fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &'static str,
    view: &wgpu::TextureView,
    clear: wgpu::Color,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}
