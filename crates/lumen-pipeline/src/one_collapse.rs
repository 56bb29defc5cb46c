//! A single step of a progressive mesh, as it can be shown: what goes, the hole that is left and what fills it.

use super::progressive::ProgressiveMesh;

/// A step: the collapse that leads from one level to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct OneCollapse {
    /// The nodes that end: one that goes to its neighbour, or two that become a new one.
    pub gone: Vec<u32>,
    /// The node that takes over.
    pub heir: u32,
    /// The triangles around what goes, which make the hole.
    pub hole: Vec<[u32; 3]>,
    /// The edges around the hole, those of the surface's boundary among them.
    pub outline: Vec<[u32; 2]>,
    /// The triangles that fill it.
    pub patch: Vec<[u32; 3]>,
    /// The error that the method has logged for it, in mm.
    pub cost_mm: f32,
}

impl ProgressiveMesh {
    /// Step `step`, from the level that has `triangles`; `None` after the last.
    pub fn collapse_at(&self, step: u32, triangles: &[[u32; 3]]) -> Option<OneCollapse> {
        let cost_mm = *self.costs.get(step as usize)?;
        let from = self.node_ends.partition_point(|&end| end > step);
        let to = self.node_ends.partition_point(|&end| end >= step);
        let gone: Vec<u32> = (from as u32..to as u32).collect();
        let heir = *self.parents.get(from)?;
        let goes = |node: &u32| gone.contains(node);
        let hole: Vec<[u32; 3]> = triangles.iter().filter(|corners| corners.iter().any(goes)).copied().collect();
        let filled = |corners: &[u32; 3]| corners.map(|node| if goes(&node) { heir } else { node });
        let is_whole = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        let patch = hole.iter().map(filled).filter(is_whole).collect();
        let edges = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]);
        let mut outline: Vec<[u32; 2]> = hole.iter().flat_map(edges).collect();
        outline.sort_unstable();
        let outline = outline.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]).collect();
        Some(OneCollapse { gone, heir, hole, outline, patch, cost_mm })
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use crate::decimation::decimate;
    use crate::settings::{Decimation, Method};
    use lumen_mesh::Topology;
    use lumen_mesh::shapes::{icosphere, joined, tube};

    fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
        // From the least corner on, as the same triangle may begin anywhere.
        triangles.iter_mut().for_each(|t| {
            let least = (0..3).min_by_key(|&i| t[i]).unwrap_or(0);
            t.rotate_left(least);
        });
        triangles.sort_unstable();
        triangles
    }

    #[test]
    fn what_goes_and_what_fills_the_hole_make_the_next_level() {
        let mesh = joined(&[icosphere(2, 5.0, Vec3::ZERO), tube(8, 6, 20.0, |_| 2.0)]);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        for method in Method::ALL {
            let levels = decimate(&mesh, &topology, &Decimation { method, ..Decimation::default() });
            let last = levels.errors.len() as u32;
            let mut triangles = levels.triangles_at(0);
            for step in 0..last {
                let found = levels.collapse_at(step, &triangles).unwrap();
                triangles.retain(|corners| !corners.iter().any(|node| found.gone.contains(node)));
                triangles.extend(&found.patch);
                assert_eq!(sorted(triangles.clone()), sorted(levels.triangles_at(step + 1)), "{method:?}, {step}");
                // A disc loses two triangles, a half-disc one.
                let fewer = found.hole.len() - found.patch.len();
                assert!((1..=2).contains(&fewer) && !found.gone.contains(&found.heir));
                assert!(found.outline.len() >= 3 && found.cost_mm <= levels.errors[step as usize]);
            }
            assert_eq!(levels.collapse_at(last, &triangles), None);
        }
    }
}
