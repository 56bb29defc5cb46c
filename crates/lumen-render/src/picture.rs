//! Reading a finished view back from the GPU: for files, figures and tests.

use super::target::{Attachments, Target};

/// Pixels of a view: gamma-encoded sRGB and alpha (opaque), row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height * 4` bytes.
    pub rgba: Vec<u8>,
}

/// Why a view could not be read back.
#[derive(Clone, Debug, thiserror::Error)]
pub enum PictureError {
    /// The GPU did not hand over the memory.
    #[error("the GPU did not hand over the picture: {0}")]
    Map(String),
    /// The device went away first.
    #[error("the GPU went away before the picture was read")]
    Lost,
}

impl Picture {
    /// The pixel at column `x` and row `y` as red, green, blue; `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let at = 4 * (y as usize * self.width as usize + x as usize);
        self.rgba.get(at..at + 3)?.try_into().ok()
    }

    /// Reads back what was submitted for `target` and hands it to `then`: in a browser by itself, elsewhere within a
    /// later `wgpu::Device::poll`.
    pub fn read(
        target: &Target<impl Attachments>,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        then: impl FnOnce(Result<Self, PictureError>) + wgpu::WasmNotSend + 'static,
    ) {
        Self::read_texture(target.picture(), device, queue, then);
    }

    /// As [`Self::read`], of a texture in [`super::ViewTarget::FORMAT`] that can be copied from.
    pub fn read_texture(
        texture: &wgpu::Texture,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        then: impl FnOnce(Result<Self, PictureError>) + wgpu::WasmNotSend + 'static,
    ) {
        let (width, height) = (texture.width(), texture.height());
        let row = width * 4;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(padded) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("picture") });
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        queue.submit([encoder.finish()]);
        let mapped = buffer.clone();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            let failed = |error: &dyn std::fmt::Display| PictureError::Map(error.to_string());
            then(result.map_err(|error| failed(&error)).and_then(|()| {
                let bytes = mapped.get_mapped_range(..).map_err(|error| failed(&error))?;
                let rows = bytes.chunks_exact(padded as usize);
                Ok(Self { width, height, rgba: rows.flat_map(|padded| &padded[..row as usize]).copied().collect() })
            }));
        });
    }

    /// As [`Self::read`], waiting for it: not in a browser, which cannot wait.
    ///
    /// # Errors
    /// When the GPU does not hand over the memory.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read_now(
        target: &Target<impl Attachments>,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<Self, PictureError> {
        Self::read_texture_now(target.picture(), device, queue)
    }

    /// As [`Self::read_now`], of a texture in [`super::ViewTarget::FORMAT`] that can be copied from.
    ///
    /// # Errors
    /// When the GPU does not hand over the memory.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn read_texture_now(
        texture: &wgpu::Texture,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<Self, PictureError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        // The receiver outlives the call, or nobody waits any more.
        Self::read_texture(texture, device, queue, move |result| drop(sender.send(result)));
        device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| PictureError::Map(error.to_string()))?;
        // Another thread that polls the same device may be the one to deliver the picture, a moment after this poll.
        receiver.recv().map_err(|_| PictureError::Lost)?
    }
}
