//! The guidewire in GPU memory: a round tube along its nodes.

use glam::Vec3;

use super::buffer::{GrowingBuffer, draw_first};
use super::error::SurfaceError;

/// Sides of the tube.
const SIDES: usize = 10;

/// A wire in GPU memory, written anew for every frame.
#[derive(Debug)]
pub struct GpuWire {
    centres: GrowingBuffer,
    normals: GrowingBuffer,
    /// Distance from the tip and radius, in mm.
    measures: GrowingBuffer,
    triangles: GrowingBuffer,
    /// Rings that the triangles go through.
    rings: usize,
    /// Indices that are drawn.
    drawn: u32,
    scratch: Scratch,
}

/// What is uploaded: kept from frame to frame, so that none allocates.
#[derive(Debug, Default)]
struct Scratch {
    centres: Vec<Vec3>,
    normals: Vec<Vec3>,
    measures: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
}

impl Default for GpuWire {
    fn default() -> Self {
        Self {
            centres: GrowingBuffer::vertices("wire, centres"),
            normals: GrowingBuffer::vertices("wire, normals"),
            measures: GrowingBuffer::vertices("wire, measures"),
            triangles: GrowingBuffer::indices("wire, triangles"),
            rings: 0,
            drawn: 0,
            scratch: Scratch::default(),
        }
    }
}

impl GpuWire {
    /// Puts the wire along `nodes`, from its tip on, with a radius, all in mm. Fewer than two nodes are no wire.
    ///
    /// # Errors
    /// When the device does not allow a buffer of that size.
    pub fn set(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        nodes: &[[f32; 3]],
        radius: f32,
    ) -> Result<(), SurfaceError> {
        self.drawn = 0;
        if nodes.len() < 2 {
            return Ok(());
        }
        self.scratch.tube(nodes, radius);
        self.centres.write(device, queue, bytemuck::cast_slice(&self.scratch.centres))?;
        self.normals.write(device, queue, bytemuck::cast_slice(&self.scratch.normals))?;
        self.measures.write(device, queue, bytemuck::cast_slice(&self.scratch.measures))?;
        let rings = nodes.len() + 1;
        if rings > self.rings {
            self.scratch.triangles(rings);
            self.triangles.write(device, queue, bytemuck::cast_slice(&self.scratch.triangles))?;
            self.rings = rings;
        }
        self.drawn = (6 * SIDES * (rings - 1)) as u32;
        Ok(())
    }

    /// Draws the wire by a pipeline over centres, normals and measures.
    pub(super) fn draw_by(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        draw_first(pass, pipeline, &[&self.centres, &self.normals, &self.measures], &self.triangles, self.drawn);
    }
}

impl Scratch {
    /// Rings about the nodes, with frames that are carried along without twist; before the first, one that closes the
    /// tip.
    fn tube(&mut self, nodes: &[[f32; 3]], radius: f32) {
        self.centres.clear();
        self.normals.clear();
        self.measures.clear();
        let node = |i: usize| Vec3::from(nodes[i]);
        let last = nodes.len() - 1;
        let mut side = Vec3::ZERO;
        let mut along = 0.0;
        for i in 0..=last {
            let forth = (node((i + 1).min(last)) - node(i.saturating_sub(1))).normalize_or(Vec3::Z);
            side = side.reject_from_normalized(forth).try_normalize().unwrap_or(forth.any_orthonormal_vector());
            if i == 0 {
                for _ in 0..SIDES {
                    self.push(node(0), -forth, [0.0, radius]);
                }
            } else {
                along += node(i).distance(node(i - 1));
            }
            let across = forth.cross(side);
            for k in 0..SIDES {
                let angle = std::f32::consts::TAU * k as f32 / SIDES as f32;
                let normal = side * libm::cosf(angle) + across * libm::sinf(angle);
                self.push(node(i), normal, [along, radius]);
            }
        }
    }

    fn push(&mut self, centre: Vec3, normal: Vec3, measure: [f32; 2]) {
        self.centres.push(centre);
        self.normals.push(normal);
        self.measures.push(measure);
    }

    fn triangles(&mut self, rings: usize) {
        self.triangles.clear();
        for ring in 0..rings - 1 {
            for k in 0..SIDES {
                let at = |ring: usize, k: usize| (ring * SIDES + k % SIDES) as u32;
                let [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)];
                self.triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tube_has_the_area_of_a_cylinder_and_faces_outwards() {
        let nodes: Vec<[f32; 3]> = (0..40).map(|i| [0.0, 0.0, i as f32]).collect();
        let mut scratch = Scratch::default();
        scratch.tube(&nodes, 2.0);
        scratch.triangles(nodes.len() + 1);
        let at = |v: u32| scratch.centres[v as usize] + scratch.normals[v as usize] * 2.0;
        let (mut area, mut outwards) = (0.0, 0);
        let side = &scratch.triangles[2 * SIDES..];
        for &[a, b, c] in side {
            let across = (at(b) - at(a)).cross(at(c) - at(a));
            area += across.length() / 2.0;
            outwards += u32::from(across.dot(scratch.normals[a as usize]) > 0.0);
        }
        let sides = SIDES as f32;
        let expected = 39.0 * 2.0 * sides * 2.0 * (std::f32::consts::PI / sides).sin();
        assert!((area / expected - 1.0).abs() < 1e-4, "{area}, not {expected}");
        assert_eq!(outwards as usize, side.len());
        assert_eq!(scratch.measures.last(), Some(&[39.0, 2.0]));
    }
}
