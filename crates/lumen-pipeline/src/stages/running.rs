//! What every stage is to whoever runs it.

use super::super::settings::SettingsError;
use super::super::store::Store;
use super::super::task::{Budget, Progress};

/// A stage under way.
pub(crate) trait Run: Send {
    /// Works until `budget` is spent or the stage is done and its result in its slot.
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError>;
}
