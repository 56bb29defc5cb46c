//! A surface on the GPU: positions once, then levels.
//!
//! The positions are those of the first nodes of a progressive mesh. A level is a triangle list over them, its edges, and a
//! normal for each node (those of nodes that the level does not use are never read), so moving the reduction slider
//! uploads indices and normals and leaves positions alone. Buffers keep their memory and grow by half again.

use glam::Vec3;

use super::buffer::GrowingBuffer;
use super::error::SurfaceError;

/// Positions, normals, triangles, edges and perhaps scalars of one surface, in GPU memory.
#[derive(Debug)]
pub struct GpuSurface {
    nodes: usize,
    pub(super) positions: GrowingBuffer,
    pub(super) normals: GrowingBuffer,
    pub(super) scalars: GrowingBuffer,
    pub(super) triangles: GrowingBuffer,
    pub(super) edges: GrowingBuffer,
}

impl GpuSurface {
    /// A surface of the nodes at `positions`, in mm, without triangles: nothing is drawn before
    /// [`Self::set_level`].
    ///
    /// # Errors
    /// When the device does not allow a buffer of that size.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, positions: &[Vec3]) -> Result<Self, SurfaceError> {
        let mut surface = Self {
            nodes: 0,
            positions: GrowingBuffer::vertices("positions"),
            normals: GrowingBuffer::vertices("normals"),
            scalars: GrowingBuffer::vertices("scalars"),
            triangles: GrowingBuffer::indices("triangles"),
            edges: GrowingBuffer::indices("edges"),
        };
        surface.set_positions(device, queue, positions)?;
        Ok(surface)
    }

    /// Replaces the nodes, as after smoothing anew, and drops level and scalars: a new level must follow.
    ///
    /// # Errors
    /// When the device does not allow a buffer of that size; the surface is empty then.
    pub fn set_positions(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        positions: &[Vec3],
    ) -> Result<(), SurfaceError> {
        self.nodes = 0;
        for buffer in [&mut self.normals, &mut self.scalars, &mut self.triangles, &mut self.edges] {
            buffer.clear();
        }
        self.positions.write(device, queue, bytemuck::cast_slice(positions))?;
        self.nodes = positions.len();
        Ok(())
    }

    /// Shows `triangles` and their `edges` (see [`unique_edges`](super::unique_edges)) over the nodes, with one normal
    /// for each node. Without edges there is no wireframe.
    ///
    /// # Errors
    /// When an index is out of range, the normals are not as many as the nodes, or the device does not allow a buffer
    /// of that size. Nothing is drawn then until the next level.
    pub fn set_level(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        triangles: &[[u32; 3]],
        edges: &[[u32; 2]],
        normals: &[Vec3],
    ) -> Result<(), SurfaceError> {
        self.triangles.clear();
        self.edges.clear();
        if normals.len() != self.nodes {
            return Err(SurfaceError::Count { what: "normals", expected: self.nodes, found: normals.len() });
        }
        for indices in [triangles.as_flattened(), edges.as_flattened()] {
            if let Some(&index) = indices.iter().max().filter(|&&index| index as usize >= self.nodes) {
                return Err(SurfaceError::IndexOutOfRange { index, nodes: self.nodes });
            }
        }
        self.normals.write(device, queue, bytemuck::cast_slice(normals))?;
        self.edges.write(device, queue, bytemuck::cast_slice(edges))?;
        self.triangles.write(device, queue, bytemuck::cast_slice(triangles))
    }

    /// Gives each node a scalar in mm, for a style with a colour map to show, or takes them away.
    ///
    /// # Errors
    /// When the scalars are not as many as the nodes, or the device does not allow a buffer of that size; the surface
    /// is without scalars then.
    pub fn set_scalars(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scalars: Option<&[f32]>,
    ) -> Result<(), SurfaceError> {
        self.scalars.clear();
        let Some(scalars) = scalars else { return Ok(()) };
        if scalars.len() != self.nodes {
            return Err(SurfaceError::Count { what: "scalars", expected: self.nodes, found: scalars.len() });
        }
        self.scalars.write(device, queue, bytemuck::cast_slice(scalars))
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes
    }

    /// Number of triangles that are drawn.
    pub fn triangle_count(&self) -> u32 {
        self.triangles.count(size_of::<[u32; 3]>())
    }

    /// Number of edges that are drawn.
    pub fn edge_count(&self) -> u32 {
        self.edges.count(size_of::<[u32; 2]>())
    }
}
