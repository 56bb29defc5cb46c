//! Mending as a stage: the surface as it was opened, or what mending makes of it, with its arrays.

use std::sync::Arc;

use super::running::Run;
use crate::results::Entering;
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};
use lumen_mesh::mending::{MendTask, Mended};

pub(super) enum Mending {
    /// Nothing was asked for.
    Nothing,
    Task(Box<MendTask>),
}

impl Mending {
    pub(super) fn start(store: &Store) -> Self {
        let asked = store.now.settings.mending;
        if asked.is_off() {
            return Self::Nothing;
        }
        let (mesh, arrays) = ((*store.opened).clone(), (*store.arrays).clone());
        Self::Task(Box::new(MendTask::new(mesh, arrays, asked)))
    }
}

impl Run for Mending {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        store.now.settings.check()?;
        let unchanged = |report| Entering { mesh: store.opened.clone(), arrays: store.arrays.clone(), report };
        let entering = match self {
            Self::Nothing => unchanged(None),
            Self::Task(task) => match task.advance(budget) {
                Progress::Working(fraction) => return Ok(Progress::Working(fraction)),
                Progress::Done(Mended { mesh, report, .. }) if mesh == *store.opened => unchanged(Some(report)),
                Progress::Done(Mended { mesh, arrays, report }) => {
                    Entering { mesh: Arc::new(mesh), arrays: Arc::new(arrays), report: Some(report) }
                }
            },
        };
        store.now.mended = Some(Arc::new(entering));
        Ok(Progress::Done(()))
    }
}
