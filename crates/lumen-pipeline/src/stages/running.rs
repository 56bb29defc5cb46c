//! A stage under way, and what it leaves in the store.

use std::mem;
use std::sync::{Arc, Mutex, PoisonError};

use web_time::Instant;

use super::super::settings::SettingsError;
use super::super::store::Store;
use super::super::task::{Budget, Progress, Running, Yielder, milliseconds};
use super::super::times::Part;

/// Puts something into the store.
type Leave = Box<dyn FnOnce(&mut Store) + Send>;

/// Where a stage leaves what it has made, part by part: it reaches the store at the end of the slice, whatever becomes of the
/// stage.
#[derive(Clone, Default)]
pub(crate) struct Outbox(Arc<Mutex<Vec<Leave>>>);

impl Outbox {
    /// Leaves something.
    pub(super) fn leave(&self, put: impl FnOnce(&mut Store) + Send + 'static) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(Box::new(put));
    }

    /// Tells the time since `start`, in the slice under way, apart from that of the stage.
    pub(super) fn tell_apart(&self, part: Part, start: Instant) {
        let ms = milliseconds(start);
        self.leave(move |store| store.now.times.tell_apart(part, ms));
    }

    fn empty_into(&self, store: &mut Store) {
        let all = mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner));
        all.into_iter().for_each(|put| put(store));
    }
}

/// A stage under way.
pub(crate) struct Run {
    work: Running<'static, Result<(), SettingsError>>,
    outbox: Outbox,
}

impl Run {
    /// Begins a stage that cannot fail.
    pub(super) fn new<W>(work: impl FnOnce(Yielder, Outbox) -> W) -> Self
    where
        W: Future<Output = ()> + Send + 'static,
    {
        Self::fallible(|yielder, outbox| {
            let work = work(yielder, outbox);
            async {
                work.await;
                Ok(())
            }
        })
    }

    /// Begins a stage that may refuse the settings.
    pub(super) fn fallible<W>(work: impl FnOnce(Yielder, Outbox) -> W) -> Self
    where
        W: Future<Output = Result<(), SettingsError>> + Send + 'static,
    {
        let outbox = Outbox::default();
        Self { work: Running::new(|yielder| work(yielder, outbox.clone())), outbox }
    }

    /// Works until `budget` is spent or the stage is done.
    pub(crate) fn advance(&mut self, store: &mut Store, budget: Budget) -> Progress<Result<(), SettingsError>> {
        let progress = self.work.advance(budget);
        self.outbox.empty_into(store);
        progress
    }
}
