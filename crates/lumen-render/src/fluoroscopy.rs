//! The fluoroscopy: what X-rays leave after lumen and wire, `I = I0 exp(-sum of mu d)` (Beer and Lambert).
//!
//! Contrast: 70 mg iodine in 1 ml of blood, 0.06 /mm at 60 keV (NIST XCOM); tissue is the same everywhere and part of the
//! brightness. How thick the lumen is, is added up in [`thickness`](super::thickness), and what the wire takes away in
//! [`wire`](super::wire).

use bytemuck::{Pod, Zeroable};

use super::buffer::uniforms;
use super::target::{Attachments, Target};
use super::texture::{attachment, begin, whole};
use super::thickness::ThicknessFormat;
use super::wire::SHADOW;
use super::{ViewTarget, binding};

/// Attenuation of the contrast in 1/mm.
const CONTRAST: f32 = 0.06;
/// Noise where all light comes through, as a part of it.
const NOISE: f32 = 0.02;

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

/// What a fluoroscopy is made of.
#[derive(Debug)]
pub struct Sums {
    format: ThicknessFormat,
    pub(super) thickness: wgpu::TextureView,
    pub(super) shadow: wgpu::TextureView,
}

impl Attachments for Sums {
    const LABEL: &'static str = "fluoroscopy";

    type Form = ThicknessFormat;

    fn new(device: &wgpu::Device, size: [u32; 2], format: ThicknessFormat) -> Self {
        let texture =
            |label, format| whole(&attachment(device, label, size, 1, format, wgpu::TextureUsages::TEXTURE_BINDING));
        Self { format, thickness: texture("thickness", format.texture()), shadow: texture("shadow", SHADOW) }
    }

    fn form(&self) -> ThicknessFormat {
        self.format
    }
}

/// The target of a fluoroscopy.
pub type FluoroscopyTarget = Target<Sums>;

/// Takes fluoroscopies.
#[derive(Debug)]
pub(super) struct Fluoroscopy {
    queue: wgpu::Queue,
    pipeline: wgpu::RenderPipeline,
    exposure: wgpu::BindGroupLayout,
}

impl Fluoroscopy {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let exposure = exposure_layout(device);
        Self { queue: queue.clone(), pipeline: expose_pipeline(device, &exposure), exposure }
    }

    /// Turns thickness and shadow into grey.
    pub(super) fn expose(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &FluoroscopyTarget,
        exposure: &Exposure,
    ) {
        let group = self.bind(device, target, exposure);
        let mut pass = begin(encoder, Sums::LABEL, target.view(), wgpu::Color::BLACK);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }

    fn bind(&self, device: &wgpu::Device, target: &FluoroscopyTarget, exposure: &Exposure) -> wgpu::BindGroup {
        let [width, height] = target.size().map(|side| side as f32);
        let sums = &target.attachments;
        let roadmap = f32::from(u8::from(exposure.roadmap));
        let values = ExposureUniforms {
            unit: sums.format.unit(),
            contrast: [exposure.contrast_s.unwrap_or(-1.0), exposure.flow.max(1e-3), CONTRAST, roadmap],
            picture: [exposure.pulse as f32, NOISE, width, height],
        };
        let buffer = uniforms(device, &self.queue, "exposure", bytemuck::bytes_of(&values));
        let [thickness, shadow] = [&sums.thickness, &sums.shadow].map(wgpu::BindingResource::TextureView);
        binding::group(device, "exposure", &self.exposure, [buffer.as_entire_binding(), thickness, shadow])
    }
}

fn exposure_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let uniform = binding::uniform(size_of::<ExposureUniforms>(), false);
    let types = [uniform, binding::texture(false), binding::texture(false)];
    binding::layout(device, "exposure", wgpu::ShaderStages::FRAGMENT, &types)
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
