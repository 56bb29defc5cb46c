//! The search for the highest safe rate, as a stage: the same for every level.

use std::sync::Arc;

use super::running::Run;
use crate::safe::{Safe, SafeTask};
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};

pub(super) enum Searching {
    Search(Box<SafeTask>),
    /// There are no vessels.
    Refused(Safe),
}

impl Searching {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let now = &store.now;
        let (vessels, levels) = (now.vessels.as_ref()?, now.levels.as_ref()?);
        let tolerance = now.settings.tolerance_percent;
        let basis = match vessels {
            Ok(basis) => basis.clone(),
            Err(error) => return Some(Self::Refused(Safe::refused(tolerance, error))),
        };
        let pinch = now.smoothed_measures.as_ref().and_then(|found| found.pinch);
        Some(Self::Search(Box::new(SafeTask::new(basis, levels.progressive.clone(), pinch, tolerance))))
    }
}

impl Run for Searching {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        let safe = match self {
            Self::Search(task) => match task.advance(budget) {
                Progress::Working(fraction) => return Ok(Progress::Working(fraction)),
                Progress::Done(safe) => safe,
            },
            Self::Refused(safe) => safe.clone(),
        };
        store.now.safe = Some(Arc::new(safe));
        Ok(Progress::Done(()))
    }
}
