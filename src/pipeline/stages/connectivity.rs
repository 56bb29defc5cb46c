//! Connectivity as a stage: the pieces, those that are kept, their adjacency, their area and volume.

use std::sync::Arc;

use web_time::Instant;

use super::Run;
use crate::mesh::{Topology, TriMesh, measures_within, oriented_loops};
use crate::pipeline::connectivity::Connectivity;
use crate::pipeline::results::{Part, Surface};
use crate::pipeline::settings::SettingsError;
use crate::pipeline::store::Store;
use crate::pipeline::task::{Budget, Progress};

/// How far it is; each part is one slice.
pub(super) enum Connecting {
    Pieces,
    Kept,
    Adjacency(Arc<TriMesh>),
    Measures(Arc<TriMesh>, Arc<Topology>),
}

impl Connecting {
    pub(super) fn start() -> Self {
        Self::Pieces
    }
}

impl Run for Connecting {
    fn advance(&mut self, store: &mut Store, _: Budget) -> Result<Progress<()>, SettingsError> {
        store.now.settings.check()?;
        let found = match &mut store.connectivity {
            Some(found) => found,
            none => none.insert(Arc::new(Connectivity::unmeasured(&store.opened))),
        };
        let (next, fraction) = match self {
            Self::Pieces => (Self::Kept, 0.2),
            Self::Kept => (Self::Adjacency(found.kept(&store.opened, store.now.settings.keep)?), 0.3),
            Self::Adjacency(mesh) => {
                let start = Instant::now();
                let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
                store.now.times.tell_apart(Part::Adjacency, start);
                (Self::Measures(mesh.clone(), Arc::new(topology)), 0.7)
            }
            Self::Measures(mesh, topology) => {
                let start = Instant::now();
                if found.components.is_empty() {
                    Arc::make_mut(found).measure(&store.opened);
                }
                let loops = oriented_loops(topology);
                let measures = measures_within(mesh, loops.as_deref());
                let (mesh, topology) = (mesh.clone(), topology.clone());
                store.now.kept = Some(Arc::new(Surface { mesh, topology, loops, measures }));
                store.now.times.tell_apart(Part::KeptAreas, start);
                return Ok(Progress::Done(()));
            }
        };
        *self = next;
        Ok(Progress::Working(fraction))
    }
}
