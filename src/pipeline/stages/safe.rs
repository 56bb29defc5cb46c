//! The search for the highest safe rate, as a stage: the same for every level.

use std::sync::Arc;

use super::Run;
use crate::pipeline::safe::SafeTask;
use crate::pipeline::settings::SettingsError;
use crate::pipeline::store::Store;
use crate::pipeline::task::{Budget, Progress, Task as _};
use crate::vessel::Subject;

pub(super) struct Searching(SafeTask);

impl Searching {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let now = &store.now;
        let (kept, smoothed, levels) = (now.kept.as_ref()?, now.smoothed.as_ref()?, now.levels.as_ref()?);
        let (topology, index) = (kept.topology.clone(), now.indices.kept.clone());
        let of_kept = Subject { mesh: kept.mesh.clone(), topology: topology.clone(), index };
        let of_smoothed = Subject { mesh: smoothed.mesh.clone(), topology, index: None };
        let pinch = now.smoothed_measures.as_ref().and_then(|found| found.pinch);
        let progressive = levels.progressive.clone();
        Some(Self(SafeTask::new(of_kept, of_smoothed, progressive, pinch, store.tolerance_percent)))
    }
}

impl Run for Searching {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        Ok(match self.0.advance(budget) {
            Progress::Working(fraction) => Progress::Working(fraction),
            Progress::Done(safe) => {
                store.now.safe = Some(Arc::new(safe));
                Progress::Done(())
            }
        })
    }
}
