//! A GPU buffer that is written again and again, as while a slider is dragged: it is made anew only when it has to
//! grow, and then by half again. And what is drawn from such buffers.

use std::ops::Range;

use super::error::SurfaceError;

/// Sizes are multiples of this, so that small changes are no reason to grow.
const GRANULE: u64 = 4096;

/// A buffer and the part of it that is in use.
#[derive(Debug)]
pub(super) struct GrowingBuffer {
    label: &'static str,
    usage: wgpu::BufferUsages,
    buffer: Option<wgpu::Buffer>,
    used: u64,
}

impl GrowingBuffer {
    /// An empty buffer of an attribute of vertices; nothing is allocated before the first write.
    pub(super) fn vertices(label: &'static str) -> Self {
        Self { label, usage: wgpu::BufferUsages::VERTEX, buffer: None, used: 0 }
    }

    /// The same of indices of vertices.
    pub(super) fn indices(label: &'static str) -> Self {
        Self { label, usage: wgpu::BufferUsages::INDEX, buffer: None, used: 0 }
    }

    /// Replaces the contents by `bytes`, whose number must be a multiple of four.
    pub(super) fn write(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bytes: &[u8],
    ) -> Result<(), SurfaceError> {
        let needed = bytes.len() as u64;
        if let Some(buffer) = self.reserve(device, needed)? {
            queue.write_buffer(buffer, 0, bytes);
        }
        self.used = needed;
        Ok(())
    }

    /// Writes the part `range` of `bytes`, both in multiples of four, which replace the contents once the last part is there:
    /// nothing is in use before.
    pub(super) fn write_part(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bytes: &[u8],
        range: Range<usize>,
    ) -> Result<(), SurfaceError> {
        self.used = 0;
        if let Some(buffer) = self.reserve(device, bytes.len() as u64)? {
            queue.write_buffer(buffer, range.start as u64, &bytes[range.clone()]);
        }
        if range.end == bytes.len() {
            self.used = bytes.len() as u64;
        }
        Ok(())
    }

    /// Replaces the contents by `needed` bytes of zero, a multiple of four, of which none is uploaded.
    pub(super) fn write_zeros(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        needed: u64,
    ) -> Result<(), SurfaceError> {
        let label = Some(self.label);
        if let Some(buffer) = self.reserve(device, needed)? {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
            encoder.clear_buffer(buffer, 0, Some(needed));
            queue.submit([encoder.finish()]);
        }
        self.used = needed;
        Ok(())
    }

    /// The buffer, made anew where it does not hold `needed` bytes; `None` where none are needed.
    fn reserve(&mut self, device: &wgpu::Device, needed: u64) -> Result<Option<&wgpu::Buffer>, SurfaceError> {
        let limit = device.limits().max_buffer_size;
        if needed > limit {
            return Err(SurfaceError::TooLarge { what: self.label, bytes: needed, limit });
        }
        let capacity = self.buffer.as_ref().map_or(0, wgpu::Buffer::size);
        if needed > capacity {
            let size = grown(capacity, needed).min(limit.max(needed));
            self.buffer = Some(device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(self.label),
                size,
                usage: self.usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }));
        }
        Ok(self.buffer.as_ref().filter(|_| needed > 0))
    }

    /// Makes the buffer empty and keeps its memory.
    pub(super) fn clear(&mut self) {
        self.used = 0;
    }

    /// Whether nothing of it is in use.
    pub(super) fn is_empty(&self) -> bool {
        self.slice().is_none()
    }

    /// The part in use; `None` for an empty buffer.
    fn slice(&self) -> Option<wgpu::BufferSlice<'_>> {
        self.buffer.as_ref().filter(|_| self.used > 0).map(|buffer| buffer.slice(..self.used))
    }

    /// Number of elements in use, each of `size` bytes.
    pub(super) fn count(&self, size: usize) -> u32 {
        (self.used / size as u64) as u32
    }
}

/// Draws all of `indices` over `vertices`, the buffers in the order of their locations; nothing where one is empty.
pub(super) fn draw(
    pass: &mut wgpu::RenderPass<'_>,
    pipeline: &wgpu::RenderPipeline,
    vertices: &[&GrowingBuffer],
    indices: &GrowingBuffer,
) {
    draw_first(pass, pipeline, vertices, indices, indices.count(size_of::<u32>()));
}

/// The same of the first `count` indices.
pub(super) fn draw_first(
    pass: &mut wgpu::RenderPass<'_>,
    pipeline: &wgpu::RenderPipeline,
    vertices: &[&GrowingBuffer],
    indices: &GrowingBuffer,
    count: u32,
) {
    let Some(indices) = indices.slice().filter(|_| count > 0) else { return };
    if vertices.iter().any(|buffer| buffer.is_empty()) {
        return;
    }
    pass.set_pipeline(pipeline);
    for (slot, buffer) in (0..).zip(vertices) {
        if let Some(slice) = buffer.slice() {
            pass.set_vertex_buffer(slot, slice);
        }
    }
    pass.set_index_buffer(indices, wgpu::IndexFormat::Uint32);
    pass.draw_indexed(0..count, 0, 0..1);
}

/// A buffer of uniforms that is written once.
///
/// It is not mapped at creation: on a device that is lost, or without memory, that would panic.
pub(super) fn uniforms(device: &wgpu::Device, queue: &wgpu::Queue, label: &str, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.len() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytes);
    buffer
}

/// The size of a buffer of `capacity` bytes after it has grown to hold `needed`.
fn grown(capacity: u64, needed: u64) -> u64 {
    needed.max(capacity + capacity / 2).next_multiple_of(GRANULE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_is_by_half_and_never_too_little() {
        assert_eq!(grown(0, 1), GRANULE);
        assert_eq!(grown(8 * GRANULE, 8 * GRANULE + 4), 12 * GRANULE);
        assert_eq!(grown(GRANULE, 100 * GRANULE), 100 * GRANULE);
    }
}
