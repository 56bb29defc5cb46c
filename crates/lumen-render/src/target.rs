//! What is rendered to: a picture that the window shows, or that is read back, and what it takes to draw it.
//!
//! A target of any kind is made here, has its size changed here, and is let go of when it is dropped. On another device
//! it is made anew, like all that stands on one.
//!
//! Colours. The window library samples a texture as `Rgba8Unorm` and takes what it reads as gamma-encoded sRGB (the
//! comment in its shader: "We expect 'normal' textures that are NOT sRGB-aware"), whatever the format of its own
//! target. An sRGB texture would be decoded once too often, and a second view of it in another format does not exist
//! on WebGL2. So the target is `Rgba8Unorm`, shaders light in linear light and encode to sRGB themselves, and a
//! [`Colour`](super::Colour) appears on screen as it is written. Multisamples are therefore averaged as encoded values:
//! edges and lines have the same visual weight dark on light as light on dark.

use std::sync::OnceLock;

use super::texture::{allowed, attachment, whole};

/// What openness is kept in: 0 closed, 1 open.
pub(super) const OPENNESS: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// What a kind of target has beside its picture.
pub trait Attachments: Sized {
    /// What the picture is called where a device speaks of it.
    const LABEL: &'static str;

    /// What decides beside the size what they are.
    type Form: Copy;

    /// Those of a picture of `size` pixels, which the device allows.
    fn new(device: &wgpu::Device, size: [u32; 2], form: Self::Form) -> Self;

    /// What they were made by.
    fn form(&self) -> Self::Form;
}

/// A picture, with what it is drawn by.
#[derive(Debug)]
pub struct Target<A> {
    size: [u32; 2],
    picture: wgpu::Texture,
    view: wgpu::TextureView,
    pub(super) attachments: A,
}

impl<A: Attachments> Target<A> {
    /// A target of `size` pixels, brought within 1 and what the device allows.
    pub(super) fn of(device: &wgpu::Device, size: [u32; 2], form: A::Form) -> Self {
        let size = allowed(device, size);
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let picture = attachment(device, A::LABEL, size, 1, ViewTarget::FORMAT, usage);
        Self { size, view: whole(&picture), picture, attachments: A::new(device, size, form) }
    }

    /// Makes the target `width` by `height` pixels, brought within 1 and what the device allows. Says whether it is a
    /// new one: then [`Self::view`] is another texture, with nothing drawn yet.
    pub fn resize(&mut self, device: &wgpu::Device, width: u32, height: u32) -> bool {
        let size = [width, height];
        let changes = self.size != allowed(device, size);
        if changes {
            *self = Self::of(device, size, self.attachments.form());
        }
        changes
    }

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

    /// Width / height.
    pub fn aspect(&self) -> f32 {
        self.size[0] as f32 / self.size[1] as f32
    }
}

/// What a 3-D view is drawn by: multisampled colour, resolved into the picture, and depth; beside it what ambient
/// occlusion takes, once that is drawn.
#[derive(Debug)]
pub struct Multisampled {
    colour: wgpu::TextureView,
    depth: wgpu::TextureView,
    pub(super) gathered: OnceLock<Gathered>,
}

impl Attachments for Multisampled {
    const LABEL: &'static str = "view";

    type Form = ();

    fn new(device: &wgpu::Device, size: [u32; 2], (): ()) -> Self {
        let texture = |label, format| {
            whole(&attachment(device, label, size, ViewTarget::SAMPLES, format, wgpu::TextureUsages::empty()))
        };
        Self {
            colour: texture("view, multisampled", ViewTarget::FORMAT),
            depth: texture("view, depth", ViewTarget::DEPTH_FORMAT),
            gathered: OnceLock::new(),
        }
    }

    fn form(&self) {}
}

/// What a target has for ambient occlusion, made when it is first wanted there.
#[derive(Debug)]
pub(super) struct Gathered {
    pub(super) depth: wgpu::TextureView,
    pub(super) openness: wgpu::TextureView,
}

impl Gathered {
    pub(super) fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let half = size.map(|side| side.div_ceil(2));
        let texture =
            |label, format| whole(&attachment(device, label, half, 1, format, wgpu::TextureUsages::TEXTURE_BINDING));
        Self {
            depth: texture("occlusion, depth", ViewTarget::DEPTH_FORMAT),
            openness: texture("occlusion, openness", OPENNESS),
        }
    }
}

/// The target of a 3-D view.
pub type ViewTarget = Target<Multisampled>;

impl ViewTarget {
    /// The picture: gamma-encoded sRGB in a format that does not know it, opaque (see the module's notes on colours).
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
    pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
    pub(super) const SAMPLES: u32 = 4;

    /// A target of `width` by `height` pixels, brought within 1 and what the device allows.
    pub fn new(device: &wgpu::Device, width: u32, height: u32) -> Self {
        Self::of(device, [width, height], ())
    }

    /// Begins drawing all of it anew. Something must cover all of it, and only the picture is kept.
    pub(super) fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("view"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.attachments.colour,
                depth_slice: None,
                resolve_target: Some(&self.view),
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Discard },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.attachments.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }
}
