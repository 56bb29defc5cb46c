//! Decimation as a stage: all levels, and the smoothed surface in their numbering.

use std::sync::Arc;

use super::Run;
use crate::mesh::{Topology, TriMesh};
use crate::pipeline::decimation::DecimationTask;
use crate::pipeline::results::Levels;
use crate::pipeline::settings::SettingsError;
use crate::pipeline::store::Store;
use crate::pipeline::task::{Budget, Progress, Task as _};

pub(super) struct Decimating(DecimationTask<Arc<TriMesh>, Arc<Topology>>);

impl Decimating {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let (kept, smoothed) = (store.now.kept.as_ref()?, store.now.smoothed.as_ref()?);
        let settings = &store.now.settings.decimation;
        Some(Self(DecimationTask::new(smoothed.mesh.clone(), kept.topology.clone(), settings)))
    }
}

impl Run for Decimating {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        Ok(match self.0.advance(budget) {
            Progress::Working(fraction) => Progress::Working(fraction),
            Progress::Done(progressive) => {
                let finest = Arc::new(progressive.finest());
                store.now.levels = Some(Levels { progressive: Arc::new(progressive), finest });
                Progress::Done(())
            }
        })
    }
}
