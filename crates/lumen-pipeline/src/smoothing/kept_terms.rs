//! The terms of a surface, kept from one run of the stage to the next.

use std::sync::Arc;

use super::{Terms, smooth_keeping_terms};
use crate::filter::Filter;
use crate::results::Surface;
use crate::settings::{Boundary, Smoothing};
use crate::task::{Running, Yielder};

/// Bytes that terms may take. Surfaces of more than about 53,000 vertices at 100 iterations are filtered anew each time.
pub(crate) const TERMS_BYTES: usize = 64_000_000;

/// The terms of a surface, and which they are of.
pub(crate) struct KeptTerms {
    of: Arc<Surface>,
    boundary: Boundary,
    terms: Terms,
}

impl KeptTerms {
    /// The `terms` of a run over `of`, if it kept them.
    pub(crate) fn of(of: &Arc<Surface>, boundary: Boundary, terms: Option<Terms>) -> Option<Self> {
        Some(Self { of: of.clone(), boundary, terms: terms? })
    }

    /// Runs the filter over `kept` for its terms alone.
    pub(crate) fn preparation(kept: &Arc<Surface>, settings: &Smoothing) -> Preparation {
        let (kept, settings) = (kept.smoothed_as(settings), *settings);
        Running::new(|yielder| prepare(kept, settings, yielder))
    }

    /// Whether another filter for `settings` on `kept` is but a sum of these.
    pub(crate) fn suit(&self, kept: &Arc<Surface>, settings: &Smoothing) -> bool {
        let degree = settings.iterations as usize;
        Arc::ptr_eq(&self.of, &kept.smoothed_as(settings))
            && self.boundary == settings.boundary
            && degree <= self.terms.degree()
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

/// A run of the filter for its terms alone.
pub(crate) type Preparation = Running<'static, Option<KeptTerms>>;

/// Runs the filter for its terms alone.
async fn prepare(kept: Arc<Surface>, settings: Smoothing, yielder: Yielder) -> Option<KeptTerms> {
    let (positions, boundary, filter) = (&kept.mesh.positions, settings.boundary, Filter::new(&settings));
    let (_, terms) = smooth_keeping_terms(positions, &kept.topology, boundary, &filter, TERMS_BYTES, &yielder).await;
    KeptTerms::of(&kept, boundary, terms)
}
