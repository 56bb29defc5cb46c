//! What is written over a picture that is drawn apart from the window: the same letters and lines as over a view.

use egui::{Context, Pos2, RawInput, Rect, Theme, Ui, vec2};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};

use super::theme;
use crate::render::ViewTarget;

/// Lets the window library write over pictures.
pub(super) struct Lettering {
    ctx: Context,
    renderer: Renderer,
}

impl Lettering {
    /// On a device.
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let ctx = Context::default();
        theme::apply(&ctx);
        Self { ctx, renderer: Renderer::new(device, ViewTarget::FORMAT, RendererOptions::PREDICTABLE) }
    }

    /// Writes over what was submitted for `target`, with `scale` pixels to a point; `write` is given all of it.
    pub(super) fn write(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        target: &ViewTarget,
        scale: f32,
        theme: Theme,
        mut write: impl FnMut(&Ui, Rect),
    ) {
        self.ctx.set_theme(theme);
        let [width, height] = target.size();
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(width as f32, height as f32) / scale);
        let side = device.limits().max_texture_dimension_2d as usize;
        let mut input = RawInput { screen_rect: Some(rect), max_texture_side: Some(side), ..Default::default() };
        if let Some(viewport) = input.viewports.get_mut(&egui::ViewportId::ROOT) {
            viewport.native_pixels_per_point = Some(scale);
        }
        let output = self.ctx.run_ui(input, |ui| write(ui, rect));
        let mut delta = output.textures_delta;
        for (id, parts) in delta.set.drain() {
            for part in parts {
                self.renderer.update_texture(device, queue, id, &part);
            }
        }
        let jobs = self.ctx.tessellate(output.shapes, scale);
        let screen = ScreenDescriptor { size_in_pixels: [width, height], pixels_per_point: scale };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("lettering") });
        let uploads = self.renderer.update_buffers(device, queue, &mut encoder, &jobs, &screen);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("lettering"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        self.renderer.render(&mut pass.forget_lifetime(), &jobs, &screen);
        queue.submit(uploads.into_iter().chain([encoder.finish()]));
        for id in delta.free.drain() {
            self.renderer.free_texture(&id);
        }
    }
}
