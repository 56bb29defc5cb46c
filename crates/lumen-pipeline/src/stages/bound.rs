//! The search for the level within a bound on the deviation, as a stage.

use super::running::Run;
use crate::bound::BoundTask;
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};

pub(super) struct Bounding(BoundTask);

impl Bounding {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let levels = store.now.levels.as_ref()?;
        let bound = store.now.settings.target.deviation_mm()?;
        let task = BoundTask::new(levels.progressive.clone(), levels.finest.clone(), bound);
        Some(Self(match &store.now.indices.finest {
            Some(index) => task.with_index(index.clone()),
            None => task,
        }))
    }
}

impl Run for Bounding {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        Ok(match self.0.advance(budget) {
            Progress::Working(fraction) => Progress::Working(fraction),
            Progress::Done(bound) => {
                store.now.indices.finest = self.0.index().cloned();
                store.now.bound = Some(bound);
                Progress::Done(())
            }
        })
    }
}
