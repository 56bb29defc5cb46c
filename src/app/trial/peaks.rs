//! The largest force that each place of the wall has felt: what the vessel is coloured by.
//!
//! A touch is a point on one triangle; it is shown as a spot with a soft edge, as wide on a fine surface as on a
//! coarse one.

use crate::mesh::{Topology, TriMesh, Vec3};
use crate::trial::frame::Touch;

/// The radius of a spot in mm: up to half of it in full colour.
const SPOT: f32 = 3.0;

/// Peak forces on the nodes of a surface, in N.
#[derive(Debug)]
pub(super) struct Peaks {
    topology: Topology,
    forces: Vec<f32>,
    /// Counts up with every change.
    pub(super) changes: u64,
    /// Nodes yet to be visited, and by which touch a node was visited last.
    open: Vec<u32>,
    visited: Vec<u32>,
    touch: u32,
}

impl Peaks {
    /// No force anywhere on `mesh`.
    pub(super) fn new(mesh: &TriMesh) -> Self {
        let nodes = mesh.positions.len();
        Self {
            topology: Topology::new(nodes, &mesh.triangles),
            forces: vec![0.0; nodes],
            changes: 0,
            open: Vec::new(),
            visited: vec![0; nodes],
            touch: 0,
        }
    }

    /// In N, one for each node.
    pub(super) fn forces(&self) -> &[f32] {
        &self.forces
    }

    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.forces.fill(0.0);
        self.changes += 1;
    }

    /// Takes what the wall feels now; `mesh` is the one it was made for.
    pub(super) fn take(&mut self, mesh: &TriMesh, touches: &[Touch]) {
        let mut changes = false;
        for touch in touches {
            let Some(&corners) = mesh.triangles.get(touch.triangle as usize) else { continue };
            self.touch += 1;
            // The corners of a large triangle count wherever they are.
            for v in corners {
                changes |= self.raise(v, touch.force * 0.5);
                self.visited[v as usize] = self.touch;
                self.open.push(v);
            }
            while let Some(v) = self.open.pop() {
                let away = mesh.positions[v as usize].distance(Vec3::from(touch.at)) / SPOT;
                if away >= 1.0 {
                    continue;
                }
                changes |= self.raise(v, touch.force * (2.0 - 2.0 * away).min(1.0));
                for &next in self.topology.neighbours(v) {
                    if std::mem::replace(&mut self.visited[next as usize], self.touch) != self.touch {
                        self.open.push(next);
                    }
                }
            }
        }
        self.changes += u64::from(changes);
    }

    fn raise(&mut self, v: u32, force: f32) -> bool {
        let peak = &mut self.forces[v as usize];
        let is_more = force > *peak;
        if is_more {
            *peak = force;
        }
        is_more
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_touch_leaves_a_spot_of_its_size_and_only_the_largest_force_stays() {
        // A plane of squares of 0.5 mm.
        let n = 41;
        let positions = (0..n * n).map(|i| Vec3::new((i % n) as f32 * 0.5, (i / n) as f32 * 0.5, 0.0)).collect();
        let square = |i: u32| [[i, i + 1, i + n + 1], [i, i + n + 1, i + n]];
        let triangles: Vec<_> = (0..n * (n - 1)).filter(|i| i % n != n - 1).flat_map(square).collect();
        let mesh = TriMesh { positions, triangles };
        let at = [10.1, 10.1, 0.0];
        let triangle = mesh.triangles.iter().position(|t| t[0] == 20 * n + 20).unwrap() as u32;
        let mut peaks = Peaks::new(&mesh);
        peaks.take(&mesh, &[Touch { at, triangle, force: 0.4 }]);
        peaks.take(&mesh, &[Touch { at, triangle, force: 0.1 }]);
        for (p, &force) in mesh.positions.iter().zip(peaks.forces()) {
            let away = p.distance(at.into());
            if away < SPOT / 2.0 {
                assert_eq!(force, 0.4);
            } else if away > SPOT {
                assert_eq!(force, 0.0);
            }
        }
        assert_eq!(peaks.changes, 1);
    }
}
