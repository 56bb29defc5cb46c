//! The terms of a surface, kept from one run of the stage to the next.

use std::sync::Arc;

use super::{SmoothingTask, Terms};
use crate::filter::Filter;
use crate::results::Surface;
use crate::settings::{Boundary, Smoothing};
use crate::task::{Budget, Progress, Task};
use lumen_mesh::Topology;

/// Bytes that terms may take. Surfaces of more than about 53,000 vertices at 100 iterations are filtered anew each time.
pub(crate) const TERMS_BYTES: usize = 64_000_000;

/// The terms of a surface, and which they are of.
pub(crate) struct KeptTerms {
    of: Arc<Surface>,
    boundary: Boundary,
    terms: Terms,
}

impl KeptTerms {
    /// Whether another filter for `settings` on `kept` is but a sum of these.
    pub(crate) fn suit(&self, kept: &Arc<Surface>, settings: &Smoothing) -> bool {
        let degree = settings.iterations as usize;
        Arc::ptr_eq(&self.of, kept) && self.boundary == settings.boundary && degree <= self.terms.degree()
    }

    /// The terms.
    pub(crate) fn terms(&self) -> &Terms {
        &self.terms
    }

    /// Whether the terms of `kept` for `settings` are few enough to be kept.
    pub(crate) fn would_fit(kept: &Surface, settings: &Smoothing) -> bool {
        settings.iterations > 0
            && Terms::bytes(kept.mesh.positions.len(), settings.iterations as usize) <= TERMS_BYTES as u64
    }
}

/// Runs the filter for its terms alone.
pub(crate) struct Preparation {
    kept: Arc<Surface>,
    boundary: Boundary,
    task: SmoothingTask<Arc<Topology>>,
}

impl Preparation {
    pub(crate) fn new(kept: &Arc<Surface>, settings: &Smoothing) -> Self {
        let positions = &kept.mesh.positions;
        let task = SmoothingTask::new(positions, kept.topology.clone(), settings.boundary, &Filter::new(settings));
        Self { kept: kept.clone(), boundary: settings.boundary, task: task.keeping_terms(TERMS_BYTES) }
    }

    /// Works until `budget` is spent; whether all is done.
    pub(crate) fn advance(&mut self, budget: Budget) -> bool {
        matches!(self.task.advance(budget), Progress::Done(_))
    }

    /// The terms of a run that is done.
    pub(crate) fn into_terms(self) -> Option<KeptTerms> {
        kept_terms(self.task, self.kept, self.boundary)
    }
}

/// The terms of a run that is done, if it kept them.
pub(crate) fn kept_terms(
    task: SmoothingTask<Arc<Topology>>,
    of: Arc<Surface>,
    boundary: Boundary,
) -> Option<KeptTerms> {
    Some(KeptTerms { of, boundary, terms: task.into_terms()? })
}
