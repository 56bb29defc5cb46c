//! Textures that are drawn into or read, and passes over one of them.

use wgpu::util::DeviceExt;

/// A size in pixels, brought within 1 and what the device allows.
pub(super) fn allowed(device: &wgpu::Device, size: [u32; 2]) -> [u32; 2] {
    let largest = device.limits().max_texture_dimension_2d;
    size.map(|side| side.clamp(1, largest))
}

/// A texture to draw into, with so many samples a pixel; `usage` is what else is done with it.
pub(super) fn attachment(
    device: &wgpu::Device,
    label: &'static str,
    size: [u32; 2],
    samples: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    let usage = usage | wgpu::TextureUsages::RENDER_ATTACHMENT;
    device.create_texture(&wgpu::TextureDescriptor { sample_count: samples, ..flat(label, size, format, usage) })
}

/// All of a texture with these texels, row by row, to be read by shaders.
pub(super) fn filled(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &'static str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
    texels: &[u8],
) -> wgpu::TextureView {
    let descriptor = flat(label, size, format, wgpu::TextureUsages::TEXTURE_BINDING);
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    whole(&device.create_texture_with_data(queue, &descriptor, order, texels))
}

/// A texture of two dimensions, with one level and a sample a pixel.
fn flat(
    label: &'static str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureDescriptor<'static> {
    wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    }
}

/// All of a texture.
pub(super) fn whole(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Begins drawing over one texture, cleared first.
pub(super) fn begin<'a>(
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
