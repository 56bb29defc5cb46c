//! When a triangle of some level came to be, and which ones each step ended: what lets the search leap over levels.

use std::ops::Range;

use glam::Vec3;

use super::trial::UNITS;
use crate::progressive::ProgressiveMesh;
use lumen_mesh::task::{Yielder, blocks};

/// The triangles that each step of a run ended or changed.
#[derive(Debug, Default)]
pub(super) struct History {
    /// For each step and one more, where its triangles begin.
    starts: Vec<u32>,
    /// Triangles that have a corner at a node that the step ends.
    triangles: Vec<u32>,
}

impl History {
    pub(super) async fn new(mesh: &ProgressiveMesh, yielder: &Yielder) -> Self {
        let count = mesh.triangles.len();
        let mut starts = vec![0; mesh.errors.len() + 2];
        for block in blocks(count, UNITS) {
            each_change(mesh, block, |step, _| starts[step as usize + 2] += 1);
            yielder.rest(0.0).await;
        }
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut triangles = vec![0; starts[starts.len() - 1] as usize];
        for block in blocks(count, UNITS) {
            each_change(mesh, block, |step, t| {
                let place = &mut starts[step as usize + 1];
                triangles[*place as usize] = t;
                *place += 1;
            });
            yielder.rest(0.0).await;
        }
        Self { starts, triangles }
    }

    /// The triangles, as they stand after `step` steps, that the next one ends or changes.
    pub(super) fn before<'a>(&'a self, mesh: &'a ProgressiveMesh, step: u32) -> impl Iterator<Item = [Vec3; 3]> + 'a {
        let range = self.starts[step as usize] as usize..self.starts[step as usize + 1] as usize;
        self.triangles[range].iter().map(move |&t| {
            mesh.triangles[t as usize].map(|mut node| {
                while mesh.node_ends[node as usize] < step {
                    node = mesh.parents[node as usize];
                }
                mesh.positions[node as usize]
            })
        })
    }
}

/// Calls `change` with each step and a triangle of `range` that has a corner at a node which the step ends.
fn each_change(mesh: &ProgressiveMesh, range: Range<usize>, mut change: impl FnMut(u32, u32)) {
    for t in range {
        let last = mesh.triangle_ends[t];
        for corner in mesh.triangles[t] {
            let mut node = corner as usize;
            // A node that never ends is its own parent.
            while mesh.node_ends[node] <= last && mesh.parents[node] as usize != node {
                change(mesh.node_ends[node], t as u32);
                node = mesh.parents[node] as usize;
            }
        }
    }
}

/// The first level, in steps, of which the triangles after `steps` steps are part as they stand: for each.
pub(super) fn births(mesh: &ProgressiveMesh, steps: u32) -> Vec<u32> {
    let mut since: Vec<u32> = Vec::with_capacity(mesh.parents.len());
    for (&end, &parent) in mesh.node_ends.iter().zip(&mesh.parents) {
        since.push(match end {
            end if end >= steps => 0,
            end if mesh.node_ends[parent as usize] >= steps => end + 1,
            _ => since[parent as usize],
        });
    }
    let level = &mesh.triangles[..mesh.triangles_after(steps)];
    level.iter().map(|corners| corners.map(|v| since[v as usize]).into_iter().fold(0, u32::max)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decimation::decimate;
    use crate::settings::{Decimation, Method};
    use lumen_mesh::Topology;
    use lumen_mesh::task::at_once;
    use lumen_vessel::phantom::{Sample, generate};

    /// A phantom by either method.
    fn runs() -> [ProgressiveMesh; 2] {
        let mesh = generate(Sample::Aorta, 2_000).unwrap();
        [Method::Schroeder, Method::Quadric].map(|method| {
            let settings = Decimation { method, ..Decimation::default() };
            decimate(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles), &settings)
        })
    }

    #[test]
    fn a_step_puts_back_what_the_level_before_has_and_the_one_after_has_not() {
        for levels in runs() {
            let history = at_once(History::new(&levels, &Yielder::never()));
            let corners = |steps: u32| -> Vec<[Vec3; 3]> {
                levels.triangles_at(steps).iter().map(|t| t.map(|v| levels.positions[v as usize])).collect()
            };
            for step in (0..levels.errors.len() as u32).step_by(37) {
                let (fine, coarse) = (corners(step), corners(step + 1));
                let mut put_back: Vec<_> = history.before(&levels, step).map(|t| format!("{t:?}")).collect();
                let mut gone: Vec<_> = fine.iter().filter(|t| !coarse.contains(t)).map(|t| format!("{t:?}")).collect();
                put_back.sort();
                // A triangle between two nodes that both end is there for each of them.
                put_back.dedup();
                gone.sort();
                assert_eq!(put_back, gone, "step {step}");
            }
        }
    }

    #[test]
    fn a_triangle_is_part_of_every_level_from_its_birth_on_and_of_none_before() {
        for levels in runs() {
            let steps = levels.errors.len() as u32 / 2;
            let level = levels.triangles_at(steps);
            for (t, &birth) in births(&levels, steps).iter().enumerate().step_by(17) {
                assert!(birth <= steps);
                assert_eq!(levels.triangles_at(birth)[t], level[t]);
                assert!(birth == 0 || levels.triangles_at(birth - 1)[t] != level[t]);
            }
        }
    }
}
