//! What one 3-D view renders to: multisampled colour and depth, resolved into a texture that the window shows.

/// The render target of one view.
#[derive(Debug)]
pub struct ViewTarget {
    size: [u32; 2],
    multisampled: wgpu::TextureView,
    depth: wgpu::TextureView,
    pub(super) resolved: wgpu::Texture,
    view: wgpu::TextureView,
}

impl ViewTarget {
    /// The resolved texture: gamma-encoded sRGB in a format that does not know it, opaque (see the module's notes on
    /// colours).
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
    pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
    pub(super) const SAMPLES: u32 = 4;

    /// A target of `width` by `height` pixels, brought within 1 and what the device allows.
    pub fn new(device: &wgpu::Device, width: u32, height: u32) -> Self {
        use wgpu::TextureUsages as Usage;
        let largest = device.limits().max_texture_dimension_2d;
        let size = [width.clamp(1, largest), height.clamp(1, largest)];
        let texture = |label, sample_count, format, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let whole = wgpu::TextureViewDescriptor::default();
        let multisampled = texture("view, multisampled", Self::SAMPLES, Self::FORMAT, Usage::RENDER_ATTACHMENT);
        let depth = texture("view, depth", Self::SAMPLES, Self::DEPTH_FORMAT, Usage::RENDER_ATTACHMENT);
        let shown = Usage::RENDER_ATTACHMENT | Usage::TEXTURE_BINDING | Usage::COPY_SRC;
        let resolved = texture("view", 1, Self::FORMAT, shown);
        Self {
            size,
            multisampled: multisampled.create_view(&whole),
            depth: depth.create_view(&whole),
            view: resolved.create_view(&whole),
            resolved,
        }
    }

    /// Makes the target `width` by `height` pixels, brought within 1 and what the device allows. Says whether it is a
    /// new one: then [`Self::view`] is another texture, with nothing drawn yet.
    pub fn resize(&mut self, device: &wgpu::Device, width: u32, height: u32) -> bool {
        let largest = device.limits().max_texture_dimension_2d;
        let changes = self.size != [width.clamp(1, largest), height.clamp(1, largest)];
        if changes {
            *self = Self::new(device, width, height);
        }
        changes
    }

    /// Begins drawing all of it anew. Something must cover all of it, and only the resolved texture is kept.
    pub(super) fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("view"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.multisampled,
                depth_slice: None,
                resolve_target: Some(&self.view),
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Discard },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }

    /// The texture with the finished picture, in [`Self::FORMAT`].
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
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
