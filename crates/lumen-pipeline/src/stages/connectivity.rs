//! Connectivity as a stage: the pieces, those that are kept, their adjacency, their area and volume.

use std::sync::Arc;

use web_time::Instant;

use super::running::Run;
use crate::connectivity::Connectivity;
use crate::results::Surface;
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress};
use crate::times::Part as Aside;
use lumen_mesh::{Topology, TriMesh, measures_within, oriented_loops};

/// The surface that is parted, and how far that is.
pub(super) struct Connecting {
    whole: Arc<TriMesh>,
    part: Part,
}

/// Each is one slice.
enum Part {
    Pieces,
    Kept,
    Adjacency(Arc<TriMesh>),
    Measures(Arc<TriMesh>, Arc<Topology>),
}

impl Connecting {
    pub(super) fn start(store: &Store) -> Option<Self> {
        Some(Self { whole: store.now.mended.as_ref()?.mesh.clone(), part: Part::Pieces })
    }
}

impl Run for Connecting {
    fn advance(&mut self, store: &mut Store, _: Budget) -> Result<Progress<()>, SettingsError> {
        store.now.settings.check()?;
        let whole = &self.whole;
        let found = match &mut store.now.connectivity {
            Some(found) => found,
            none => none.insert(Arc::new(Connectivity::unmeasured(whole))),
        };
        let (next, fraction) = match &self.part {
            Part::Pieces => (Part::Kept, 0.2),
            Part::Kept => (Part::Adjacency(found.kept(whole, store.now.settings.keep)?), 0.3),
            Part::Adjacency(mesh) => {
                let start = Instant::now();
                let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
                store.now.times.tell_apart(Aside::Adjacency, start);
                (Part::Measures(mesh.clone(), Arc::new(topology)), 0.7)
            }
            Part::Measures(mesh, topology) => {
                let start = Instant::now();
                if found.components.is_empty() {
                    Arc::make_mut(found).measure(whole);
                }
                let loops = oriented_loops(topology);
                let measures = measures_within(mesh, loops.as_deref());
                let (mesh, topology) = (mesh.clone(), topology.clone());
                store.now.kept = Some(Arc::new(Surface { mesh, topology, loops, measures }));
                store.now.times.tell_apart(Aside::KeptAreas, start);
                return Ok(Progress::Done(()));
            }
        };
        self.part = next;
        Ok(Progress::Working(fraction))
    }
}
