#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

mod angles;
pub mod arrays;
mod ball;
mod blend;
mod boundary;
mod bounds;
mod branches;
mod capsule;
mod closest_point;
mod clustered;
mod components;
pub mod crossing;
pub mod cut;
pub mod disjoint_sets;
mod flat_caps;
mod four;
mod hausdorff;
mod high_valence;
mod index_build;
mod inner_ball;
mod inside;
mod measures;
pub mod mending;
mod nearest;
pub mod parallel;
mod patch;
mod planes;
mod ray;
mod refit;
mod roughness;
mod self_intersections;
pub mod shapes;
mod shuffle;
mod split_boxes;
pub mod split_mix;
pub mod task;
mod topology;
mod values;
pub mod winding;

pub use angles::AngleCounts;
pub use angles::{Angles, angles, corner_angles};
pub use arrays::{Array, ArrayInfo};
pub use ball::Ball;
pub use blend::{Blend, blended};
pub use boundary::boundary_loops;
pub use bounds::Bounds;
pub use capsule::{PointProjection, SegmentProjection};
pub use closest_point::distance_to_triangle;
pub use closest_point::{TriangleProjection, closest_point_on_triangle};
pub use clustered::clustered;
pub use components::{Components, components};
pub use cut::{Outline, cut, cut_pieces};
pub use flat_caps::{FlatCap, flat_caps, flat_caps_in_slices, without_caps};
pub use glam::Vec3;
pub use hausdorff::{FarPoint, HausdorffBound, Reach, TOLERANCE, reach};
pub use index_build::IndexBuild;
pub use inner_ball::{InnerRadii, inner_radii, inner_radii_in_slices, outward_normal};
pub use inside::Sides;
pub use measures::{
    Measures, mean_edge, measures, measures_within, oriented_loops, rms_edge, surface_area, triangle_area, volume,
    volume_of, volume_within,
};
pub use nearest::{Nearest, SurfaceIndex};
pub use refit::{joined_index, refitted};
pub use roughness::{Roughness, roughness};
pub use roughness::{bends, summarise_bends};
pub use self_intersections::{Crossing, Indexed};
pub use self_intersections::{self_intersections, self_intersections_in, touching_in};
pub use shuffle::shuffled;
pub use topology::opposite;
pub use topology::{EdgeCounts, EdgeUse, Topology};

/// A triangle surface. Triangles wind counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriMesh {
    /// Vertex positions in mm.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl TriMesh {
    /// The axis-aligned box around all positions; empty for a mesh without vertices.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.positions)
    }

    /// The corners of triangle `t`.
    ///
    /// # Panics
    /// When `t` or one of its indices is out of range.
    pub fn corners(&self, t: usize) -> [Vec3; 3] {
        self.triangles[t].map(|v| self.positions[v as usize])
    }

    /// The sub-surface of the triangles for which `keep` is true, with unused vertices left out.
    /// Vertices and triangles keep their order.
    pub fn filtered(&self, keep: impl Fn(usize) -> bool) -> TriMesh {
        let count = (0..self.triangles.len()).filter(|&t| keep(t)).count();
        let mut kept = Vec::with_capacity(count);
        kept.extend((0..self.triangles.len()).filter(|&t| keep(t)).map(|t| self.triangles[t]));
        compacted(&self.positions, kept)
    }
}

/// The surface of `triangles` over those of `positions` that they use, which keep their order.
pub fn compacted(positions: &[Vec3], mut triangles: Vec<[u32; 3]>) -> TriMesh {
    const UNUSED: u32 = u32::MAX;
    let mut index = vec![UNUSED; positions.len()];
    for &v in triangles.as_flattened() {
        index[v as usize] = 0;
    }
    let mut used = Vec::with_capacity(index.iter().filter(|&&slot| slot != UNUSED).count());
    for (slot, &p) in index.iter_mut().zip(positions) {
        if *slot != UNUSED {
            *slot = used.len() as u32;
            used.push(p);
        }
    }
    for v in triangles.as_flattened_mut() {
        *v = index[*v as usize];
    }
    TriMesh { positions: used, triangles }
}

/// Those of `vertices` vertices that `triangles` use, in their order: what [`compacted`] keeps.
pub fn used_vertices(vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut is_used = vec![false; vertices];
    triangles.as_flattened().iter().for_each(|&v| is_used[v as usize] = true);
    (0..vertices as u32).filter(|&v| is_used[v as usize]).collect()
}

/// What the messages of this crate need of a translation.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[mending::MendWarning::MESSAGES];
