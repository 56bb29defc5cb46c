//! A surface on the GPU: positions once, then levels.
//!
//! The positions are those of the first nodes of a progressive mesh. A level is a triangle list over them, its edges, and a
//! normal for each node (those of nodes that the level does not use are never read), so moving the reduction slider
//! uploads indices and normals and leaves positions alone. Buffers keep their memory and grow by half again.

use glam::Vec3;
use lumen_mesh::TriMesh;

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
        self.clear_level();
        self.scalars.clear();
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
        self.clear_level();
        if normals.len() != self.nodes {
            return Err(SurfaceError::Count { what: "normals", expected: self.nodes, found: normals.len() });
        }
        self.check(triangles.as_flattened())?;
        self.check(edges.as_flattened())?;
        self.normals.write(device, queue, bytemuck::cast_slice(normals))?;
        self.edges.write(device, queue, bytemuck::cast_slice(edges))?;
        self.triangles.write(device, queue, bytemuck::cast_slice(triangles))
    }

    /// Replaces the surface by `mesh`, each triangle in its own plane and without edges, a part with each call, so that
    /// none takes long: of what is to be uploaded, `from` bytes are there, 0 with the first call. Gives how many are then, or
    /// `None` once all are; nothing is drawn before.
    ///
    /// # Errors
    /// When an index is out of range, or the device does not allow a buffer of that size. Nothing is drawn then.
    pub fn upload_part(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        mesh: &TriMesh,
        from: usize,
    ) -> Result<Option<usize>, SurfaceError> {
        /// Bytes of one part: about 4 ms where there is no graphics card.
        const PART: usize = 1 << 20;
        if from == 0 {
            self.set_positions(device, queue, &[])?;
            self.nodes = mesh.positions.len();
            self.check(mesh.triangles.as_flattened())?;
            // A triangle whose corners have no normals is lit by that of its plane.
            self.normals.write_zeros(device, queue, size_of_val(&*mesh.positions) as u64)?;
        }
        let (mut start, to) = (0, from + PART);
        for (buffer, bytes) in [
            (&mut self.positions, bytemuck::cast_slice(&mesh.positions)),
            (&mut self.triangles, bytemuck::cast_slice(&mesh.triangles)),
        ] {
            let within = |at: usize| at.saturating_sub(start).min(bytes.len());
            let part = within(from)..within(to);
            if !part.is_empty() {
                buffer.write_part(device, queue, bytes, part)?;
            }
            start += bytes.len();
        }
        Ok((to < start).then_some(to))
    }

    fn check(&self, indices: &[u32]) -> Result<(), SurfaceError> {
        // By value: the largest of references is found several times slower, and a million triangles have three million.
        let largest = indices.iter().copied().fold(0, u32::max);
        if indices.is_empty() || (largest as usize) < self.nodes {
            return Ok(());
        }
        Err(SurfaceError::IndexOutOfRange { index: largest, nodes: self.nodes })
    }

    /// Nothing is drawn until the next level.
    fn clear_level(&mut self) {
        for buffer in [&mut self.triangles, &mut self.edges, &mut self.normals] {
            buffer.clear();
        }
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
