//! Vertices of very many triangles: the middle of a fan that closes an end, the root of a needle.
//!
//! Near such a hub the boxes of all its triangles overlap, so that a search for pairs of triangles looks at the square of
//! their number. Two triangles of one hub can only run into each other where the opposite side of one, half-way to the
//! hub, passes through the other (`crossing.rs`): so a search leaves out whole branches of the hierarchy that hold
//! triangles of one hub alone, and looks there with the small box of that side in place of the triangle's.

use glam::Vec3;

use super::nearest::SurfaceIndex;

/// A vertex of more triangles is a hub; in tests fewer are enough, so that small random surfaces have some.
const MANY: u32 = if cfg!(test) { 12 } else { 64 };

/// No hub.
const NONE: u32 = u32::MAX;

/// The hubs of a surface.
#[derive(Debug, Default)]
pub(super) struct HighValenceVertices {
    /// Whether a vertex is one; empty where none is.
    is_hub: Vec<bool>,
    /// Of each lane of each node: a hub that all triangles below it have in common.
    of_lanes: Vec<[u32; 4]>,
}

impl HighValenceVertices {
    /// Those of the surface that `index` was built from.
    pub(super) fn of(index: &SurfaceIndex, triangles: &[[u32; 3]]) -> Self {
        let count = triangles.iter().flatten().max().map_or(0, |&most| most as usize + 1);
        let mut degrees = vec![0u32; count];
        triangles.iter().flatten().for_each(|&v| degrees[v as usize] += 1);
        if degrees.iter().all(|&degree| degree <= MANY) {
            return Self::default();
        }
        let is_hub: Vec<bool> = degrees.into_iter().map(|degree| degree > MANY).collect();
        let mut of_lanes = vec![[NONE; 4]; index.nodes.len()];
        let mut of_nodes = vec![[NONE; 3]; index.nodes.len()];
        // A node stands behind its parent.
        for (n, node) in index.nodes.iter().enumerate().rev() {
            let mut all = None;
            for (lane, of_lane) in of_lanes[n].iter_mut().enumerate().take(usize::from(node.used)) {
                let child = node.child[lane] as usize;
                let common = match usize::from(node.count[lane]) {
                    0 => of_nodes[child],
                    count => {
                        let of_leaf = |slot: usize| {
                            let corners = triangles[index.leaves[slot].triangle as usize];
                            corners.map(|v| if is_hub[v as usize] { v } else { NONE })
                        };
                        (child..child + count).map(of_leaf).reduce(common).unwrap_or([NONE; 3])
                    }
                };
                *of_lane = common.into_iter().find(|&hub| hub != NONE).unwrap_or(NONE);
                all = Some(all.map_or(common, |all| self::common(all, common)));
            }
            of_nodes[n] = all.unwrap_or([NONE; 3]);
        }
        Self { is_hub, of_lanes }
    }

    /// The corners of a triangle that are hubs: their places in it.
    pub(super) fn corners(&self, vertices: [u32; 3]) -> impl Iterator<Item = usize> + '_ {
        (0..3).filter(move |&i| self.is_hub.get(vertices[i] as usize).is_some_and(|&is_hub| is_hub))
    }

    /// Bits of the lanes of a node below which every triangle has a hub in common with the one over `vertices`.
    #[inline]
    pub(super) fn shared(&self, node: u32, vertices: [u32; 3]) -> u32 {
        let Some(lanes) = self.of_lanes.get(node as usize) else { return 0 };
        (0..4).fold(0, |bits, lane| bits | u32::from(vertices.contains(&lanes[lane])) << lane)
    }
}

/// What two lists of hubs have in common.
fn common(a: [u32; 3], b: [u32; 3]) -> [u32; 3] {
    a.map(|hub| if b.contains(&hub) { hub } else { NONE })
}

/// The box around the side opposite to corner `at`, half-way to that corner; rounded outwards.
pub(super) fn half_way_box(corners: [Vec3; 3], at: usize) -> (Vec3, Vec3) {
    let half_way = |other: usize| (corners[other].as_dvec3() + corners[at].as_dvec3()) * 0.5;
    let (p, q) = (half_way((at + 1) % 3), half_way((at + 2) % 3));
    let outward = |v: glam::DVec3, round: fn(f32) -> f32| Vec3::from(v.as_vec3().to_array().map(round));
    (outward(p.min(q), f32::next_down), outward(p.max(q), f32::next_up))
}
