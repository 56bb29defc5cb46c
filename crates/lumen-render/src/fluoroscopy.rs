//! The fluoroscopy: what X-rays leave after lumen and wire, `I = I0 exp(-sum of mu d)` (Beer and Lambert).
//!
//! Contrast: 70 mg iodine in 1 ml of blood, 0.06 /mm at 60 keV (NIST XCOM); tissue is the same everywhere and part of the
//! brightness. How thick the lumen is, is added up in [`thickness`](super::thickness), and what the wire takes away in
//! [`wire`](super::wire).

use bytemuck::{Pod, Zeroable};

use super::buffer::uniforms;
use super::draw::{Draw, Phase, Pipelines};
use super::pipeline::{Destination, PipelineParts, cover, scene_shader};
use super::scene::SceneLayout;
use super::target::{Attachments, Target};
use super::texture::{attachment, begin, whole};
use super::thickness::ThicknessFormat;
use super::wire::SHADOW;
use super::{Camera, Renderer, Style, ViewTarget, binding};

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

impl Renderer {
    /// A target for fluoroscopies of `size` pixels, brought within 1 and what the device allows.
    pub fn fluoroscopy_target(&self, size: [u32; 2]) -> FluoroscopyTarget {
        FluoroscopyTarget::of(&self.layout.device, size, self.layout.thickness)
    }

    /// Records a fluoroscopy of `things` into `target`; `camera` looks from the tube. The thickness stays in the target
    /// until it is `measured` anew, which it must be where the camera, a thing that has thickness or the target changed.
    pub fn expose(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &FluoroscopyTarget,
        camera: &Camera,
        things: &[&dyn Draw],
        exposure: &Exposure,
        measured: bool,
    ) {
        let frame = self.frame(target.size(), camera, things, &Style::LIGHT);
        let sums = &target.attachments;
        if measured {
            let mut pass = begin(encoder, "thickness", &sums.thickness, sums.format.none());
            frame.draw(&mut pass, Phase::Thickness);
        }
        let mut pass = begin(encoder, "shadow", &sums.shadow, wgpu::Color::TRANSPARENT);
        frame.draw(&mut pass, Phase::Shadow);
        drop(pass);
        let fluoroscopy: &Fluoroscopy = frame.pipelines.get(&self.layout);
        let group = fluoroscopy.bind(&self.layout, target, exposure);
        let mut pass = begin(encoder, Sums::LABEL, target.view(), wgpu::Color::BLACK);
        frame.bindings.set(&mut pass, 0);
        pass.set_bind_group(2, &group, &[]);
        cover(&mut pass, &fluoroscopy.pipeline);
    }
}

/// Turns thickness and shadow into grey.
#[derive(Debug)]
struct Fluoroscopy {
    pipeline: wgpu::RenderPipeline,
    exposure: wgpu::BindGroupLayout,
}

impl Pipelines for Fluoroscopy {
    fn new(layout: &SceneLayout) -> Self {
        let uniform = binding::uniform(size_of::<ExposureUniforms>(), false);
        let types = [uniform, binding::texture(false), binding::texture(false)];
        let exposure = binding::layout(&layout.device, "exposure", wgpu::ShaderStages::FRAGMENT, &types);
        let module = scene_shader!(layout.device, "fluoroscopy.wgsl");
        let pipeline = layout.pipeline(&PipelineParts {
            vertex: "vertex_everywhere",
            into: Destination::Texture(ViewTarget::FORMAT),
            group: Some(&exposure),
            ..PipelineParts::new("exposure", &module)
        });
        Self { pipeline, exposure }
    }
}

impl Fluoroscopy {
    fn bind(&self, layout: &SceneLayout, target: &FluoroscopyTarget, exposure: &Exposure) -> wgpu::BindGroup {
        let [width, height] = target.size().map(|side| side as f32);
        let sums = &target.attachments;
        let roadmap = f32::from(u8::from(exposure.roadmap));
        let values = ExposureUniforms {
            unit: sums.format.unit(),
            contrast: [exposure.contrast_s.unwrap_or(-1.0), exposure.flow.max(1e-3), CONTRAST, roadmap],
            picture: [exposure.pulse as f32, NOISE, width, height],
        };
        let buffer = uniforms(&layout.device, &layout.queue, "exposure", bytemuck::bytes_of(&values));
        let [thickness, shadow] = [&sums.thickness, &sums.shadow].map(wgpu::BindingResource::TextureView);
        let resources = [buffer.as_entire_binding(), thickness, shadow];
        binding::group(&layout.device, "exposure", &self.exposure, resources)
    }
}
