//! What a view is drawn into and the window shows: a target of ours, registered with the window's renderer, which is
//! told when it becomes another texture and lets go of it when it is dropped.

use std::sync::Arc;

use egui::TextureId;
use egui::mutex::RwLock;

use crate::render::{Attachments, Multisampled, Target, ViewTarget};

/// The window's renderer.
pub(in crate::app) type WindowRenderer = Arc<RwLock<egui_wgpu::Renderer>>;

/// A texture of ours among the window's.
struct WindowTexture {
    window: WindowRenderer,
    id: TextureId,
}

impl WindowTexture {
    /// Gives a texture to the window.
    fn new(device: &wgpu::Device, window: &WindowRenderer, view: &wgpu::TextureView) -> Self {
        let id = window.write().register_native_texture(device, view, wgpu::FilterMode::Linear);
        Self { window: window.clone(), id }
    }

    /// Gives it another in its place.
    fn replace(&self, device: &wgpu::Device, view: &wgpu::TextureView) {
        let filter = wgpu::FilterMode::Linear;
        self.window.write().update_egui_texture_from_wgpu_texture(device, view, filter, self.id);
    }

    /// What the window calls it.
    fn id(&self) -> TextureId {
        self.id
    }
}

impl Drop for WindowTexture {
    fn drop(&mut self) {
        self.window.write().free_texture(&self.id);
    }
}

/// A target that the window shows, and what its picture was drawn from: drawn again where that is another.
pub(in crate::app) struct WindowTarget<Of, A = Multisampled> {
    target: Target<A>,
    texture: WindowTexture,
    drawn: Option<Of>,
}

impl<Of: PartialEq> WindowTarget<Of> {
    /// The target of a 3-D view, of a pixel: it has the size of what is drawn first.
    pub(in crate::app) fn new(device: &wgpu::Device, window: &WindowRenderer) -> Self {
        Self::with(device, window, ViewTarget::new(device, 1, 1))
    }
}

impl<Of: PartialEq, A: Attachments> WindowTarget<Of, A> {
    /// Shows this target.
    pub(in crate::app) fn with(device: &wgpu::Device, window: &WindowRenderer, target: Target<A>) -> Self {
        let texture = WindowTexture::new(device, window, target.view());
        Self { target, texture, drawn: None }
    }

    /// Gives the target these pixels, or as many as the device allows; says whether it has to be drawn anew for that.
    pub(in crate::app) fn resize(&mut self, device: &wgpu::Device, [width, height]: [u32; 2]) -> bool {
        let is_other = self.target.resize(device, width, height);
        if is_other {
            self.texture.replace(device, self.target.view());
        }
        is_other
    }

    /// The target with these pixels where its picture is not one of `of`: what is drawn into it now is.
    pub(in crate::app) fn stale(&mut self, device: &wgpu::Device, size: [u32; 2], of: Of) -> Option<&Target<A>> {
        if self.drawn.as_ref() == Some(&of) {
            return None;
        }
        self.resize(device, size);
        self.drawn = Some(of);
        Some(&self.target)
    }

    /// Forgets what was drawn, if that is so.
    pub(in crate::app) fn forget_if(&mut self, is_so: impl FnOnce(&Of) -> bool) {
        self.drawn.take_if(|of| is_so(of));
    }

    /// What is drawn into.
    pub(in crate::app) fn target(&self) -> &Target<A> {
        &self.target
    }

    /// What the window calls it.
    pub(in crate::app) fn id(&self) -> TextureId {
        self.texture.id()
    }
}
