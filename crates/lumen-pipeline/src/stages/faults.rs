//! The faults of the surface as it was opened, as a stage: whatever of it is mended or kept.

use std::sync::Arc;

use super::running::Run;
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress};
use lumen_mesh::mending::wall::WallTask;
use lumen_mesh::mending::{FaultSearch, Faults};
use lumen_mesh::{Topology, TriMesh};

/// The surface, and how far the search is.
pub(super) struct Looking {
    mesh: Arc<TriMesh>,
    part: Part,
}

enum Part {
    /// One slice.
    Adjacency,
    List(Arc<Topology>, FaultSearch),
    /// With what was listed.
    Wall(Faults, Box<WallTask>),
}

impl Looking {
    pub(super) fn start(store: &Store) -> Self {
        Self { mesh: store.opened.clone(), part: Part::Adjacency }
    }
}

impl Run for Looking {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        let mesh = &self.mesh;
        // What is kept is often the whole surface, and its adjacency and its boxes are known.
        let kept = store.now.kept.as_ref().filter(|kept| Arc::ptr_eq(&kept.mesh, mesh));
        match &mut self.part {
            Part::Adjacency => {
                let build = || Arc::new(Topology::new(mesh.positions.len(), &mesh.triangles));
                let topology = kept.map_or_else(build, |kept| kept.topology.clone());
                self.part = Part::List(topology, FaultSearch::default());
                Ok(Progress::Working(0.1))
            }
            Part::List(topology, search) => {
                let faults = match search.advance(mesh, topology, budget) {
                    Progress::Working(fraction) => return Ok(Progress::Working(0.1 + 0.3 * fraction)),
                    Progress::Done(faults) => faults,
                };
                if !topology.is_consistent() {
                    store.now.faults = Some(Arc::new(faults));
                    return Ok(Progress::Done(()));
                }
                let index = kept.and(store.now.indices.kept.clone());
                self.part = Part::Wall(faults, Box::new(WallTask::new(mesh, false).with_index(index)));
                Ok(Progress::Working(0.4))
            }
            Part::Wall(faults, task) => match task.advance(mesh, budget) {
                Progress::Working(fraction) => Ok(Progress::Working(0.4 + 0.6 * fraction)),
                Progress::Done(found) => {
                    let faults = Faults { wall: found.wall, ..std::mem::take(faults) };
                    store.now.faults = Some(Arc::new(faults));
                    Ok(Progress::Done(()))
                }
            },
        }
    }
}
