//! What a device is asked for: what WebGL2 can everywhere, and of textures and buffers as much as the adapter has.
//!
//! A device has the limits that it was asked for, not those of its adapter: with wgpu's defaults a buffer of more than
//! 256 MB is refused by every card, and a texture of 8192 pixels is asked of cards that have 4096, which then have no
//! device at all.

/// The description of a device of `adapter` on which all of this folder runs.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("Lumen"),
        required_limits: limits(adapter.limits()),
        ..wgpu::DeviceDescriptor::default()
    }
}

fn limits(adapter: wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_buffer_size: adapter.max_buffer_size,
        ..wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_and_textures_are_as_large_as_the_adapter_allows() {
        for (buffer, texture) in [(1 << 28, 4096), (1 << 31, 16_384)] {
            let adapter = wgpu::Limits {
                max_buffer_size: buffer,
                max_texture_dimension_2d: texture,
                ..wgpu::Limits::downlevel_webgl2_defaults()
            };
            let asked = limits(adapter.clone());
            assert_eq!((asked.max_buffer_size, asked.max_texture_dimension_2d), (buffer, texture));
            assert!(asked.check_limits(&adapter), "no more than the adapter has");
        }
    }
}
