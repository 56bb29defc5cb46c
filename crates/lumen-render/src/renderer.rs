//! Records pictures of 3-D views: one render pass for all things, phase by phase, with ambient occlusion where the style
//! asks for it.

use super::draw::{Draw, Frame, Phase, PipelineList};
use super::occlusion::{Occlusion, is_wanted};
use super::scene::SceneLayout;
use super::thickness::ThicknessFormat;
use super::{Camera, Style, ViewTarget};

/// Draws on one device, in all of its targets. Pipelines are compiled when they are first used.
#[derive(Debug)]
pub struct Renderer {
    pub(super) layout: SceneLayout,
    pipelines: PipelineList,
}

impl Renderer {
    /// A renderer on `device`. Fluoroscopies are computed in bytes; see [`Self::with_thickness`].
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        Self { layout: SceneLayout::new(device, queue), pipelines: PipelineList::default() }
    }

    /// The same with another format for the thickness of fluoroscopies, which the adapter must be able to blend.
    #[must_use]
    pub fn with_thickness(mut self, format: ThicknessFormat) -> Self {
        self.layout.thickness = format;
        self
    }

    /// Records into `encoder` a picture of `things`, seen by `camera`, which replaces what is in `target`. It is black
    /// where nothing covers it. One encoder can record several pictures.
    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &ViewTarget,
        camera: &Camera,
        things: &[&dyn Draw],
        style: &Style,
    ) {
        let frame = self.frame(target.size(), camera, things, style);
        let occlusion = is_wanted(&frame).then(|| {
            let occlusion: &Occlusion = self.pipelines.get(&self.layout);
            (occlusion, occlusion.gather(encoder, target, &frame))
        });
        let mut pass = target.begin(encoder);
        for phase in Phase::OF_VIEW {
            frame.draw(&mut pass, phase);
            if let (Phase::Opaque, Some((occlusion, gathered))) = (phase, &occlusion) {
                occlusion.shade(&mut pass, gathered);
            }
        }
    }

    /// The uniforms of `things` in a picture of `size` pixels.
    pub(super) fn frame<'a>(
        &'a self,
        size: [u32; 2],
        camera: &Camera,
        things: &'a [&'a dyn Draw],
        style: &'a Style,
    ) -> Frame<'a> {
        let bindings = self.layout.bind(size, camera, style, things);
        Frame { things, style, layout: &self.layout, pipelines: &self.pipelines, bindings }
    }
}
