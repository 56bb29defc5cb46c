//! What a view is drawn into and the window shows: a target of ours, registered with the window's renderer, which is
//! told when it becomes another texture and lets go of it when it is dropped.

use std::sync::Arc;

use egui::TextureId;
use egui::mutex::RwLock;

use crate::render::ViewTarget;

/// The window's renderer.
pub(in crate::app) type WindowRenderer = Arc<RwLock<egui_wgpu::Renderer>>;

/// A texture of ours among the window's.
pub(in crate::app) struct WindowTexture {
    window: WindowRenderer,
    id: TextureId,
}

impl WindowTexture {
    /// Gives a texture to the window.
    pub(in crate::app) fn new(device: &wgpu::Device, window: &WindowRenderer, view: &wgpu::TextureView) -> Self {
        let id = window.write().register_native_texture(device, view, wgpu::FilterMode::Linear);
        Self { window: window.clone(), id }
    }

    /// Gives it another in its place.
    pub(in crate::app) fn replace(&self, device: &wgpu::Device, view: &wgpu::TextureView) {
        let filter = wgpu::FilterMode::Linear;
        self.window.write().update_egui_texture_from_wgpu_texture(device, view, filter, self.id);
    }

    /// What the window calls it.
    pub(in crate::app) fn id(&self) -> TextureId {
        self.id
    }
}

impl Drop for WindowTexture {
    fn drop(&mut self) {
        self.window.write().free_texture(&self.id);
    }
}

/// The target of a 3-D view that the window shows.
pub(in crate::app) struct WindowTarget {
    target: ViewTarget,
    texture: WindowTexture,
}

impl WindowTarget {
    /// A target of a pixel: [`Self::resize`] makes it what it should be.
    pub(in crate::app) fn new(device: &wgpu::Device, window: &WindowRenderer) -> Self {
        let target = ViewTarget::new(device, 1, 1);
        let texture = WindowTexture::new(device, window, target.view());
        Self { target, texture }
    }

    /// The target with these pixels, or as many as the device allows: then it has to be drawn anew.
    pub(in crate::app) fn resize(&mut self, device: &wgpu::Device, [width, height]: [u32; 2]) {
        if self.target.resize(device, width, height) {
            self.texture.replace(device, self.target.view());
        }
    }

    /// What is drawn into.
    pub(in crate::app) fn target(&self) -> &ViewTarget {
        &self.target
    }

    /// What the window calls it.
    pub(in crate::app) fn id(&self) -> TextureId {
        self.texture.id()
    }
}
