//! What the stages read and write: the surface, their results, and what they keep for the next time.

use std::sync::Arc;

use super::results::{Results, Surface};
use super::settings::Settings;
use super::smoothing::KeptTerms;
use lumen_mesh::{Array, TriMesh};

/// One opened surface and what the stages made of it so far.
pub(super) struct Store {
    pub(super) opened: Arc<TriMesh>,
    /// What the file says of its vertices and triangles.
    pub(super) arrays: Arc<Vec<Array>>,
    /// Of each surface, for the deviation.
    pub(super) samples: usize,
    pub(super) now: Results,
    /// The arrays of what connectivity kept, and the surface that they are of.
    pub(super) kept_arrays: Option<(Arc<Surface>, Arc<Vec<Array>>)>,
    /// How wide the vessel is at each vertex, as a radius in mm, and the surface that this is of.
    pub(super) widths: Option<(Arc<Surface>, Arc<[f32]>)>,
    /// The least pass bands that leave vessels their calibre.
    pub(super) bands: Option<LeastBands>,
    /// What makes another pass band cheap.
    pub(super) terms: Option<Arc<KeptTerms>>,
    /// Whether the kept surface has been smoothed before: then it may well be again.
    pub(super) is_smoothed_again: bool,
}

/// The least pass bands that leave vessels their calibre.
#[derive(Clone)]
pub(super) struct LeastBands {
    pub(super) of: Arc<Surface>,
    /// Those above this are exact; the others are no more than it.
    pub(super) above: f32,
    pub(super) bands: Arc<[f32]>,
}

impl Store {
    pub(super) fn new(opened: Arc<TriMesh>, settings: Settings, samples: usize) -> Self {
        let now = Results { settings, ..Results::default() };
        Self {
            opened,
            arrays: Arc::default(),
            samples,
            now,
            kept_arrays: None,
            widths: None,
            bands: None,
            terms: None,
            is_smoothed_again: false,
        }
    }

    /// The same surface with the same results. Terms stay behind: they are large.
    pub(super) fn fork(&self) -> Self {
        Self {
            opened: self.opened.clone(),
            arrays: self.arrays.clone(),
            samples: self.samples,
            now: self.now.clone(),
            kept_arrays: self.kept_arrays.clone(),
            widths: self.widths.clone(),
            bands: self.bands.clone(),
            terms: None,
            is_smoothed_again: false,
        }
    }

    /// The widths of the kept surface, if they are known.
    pub(super) fn known_widths(&self) -> Option<&Arc<[f32]>> {
        let (kept, (of, widths)) = (self.now.kept.as_ref()?, self.widths.as_ref()?);
        Arc::ptr_eq(of, kept).then_some(widths)
    }

    /// Whether there are no terms that suit the settings, though they would fit.
    pub(super) fn lacks_terms(&self) -> bool {
        let settings = &self.now.settings.smoothing;
        let suit = |kept: &Arc<Surface>| self.terms.as_ref().is_some_and(|terms| terms.suit(kept, settings));
        self.now.kept.as_ref().is_some_and(|kept| KeptTerms::would_fit(kept, settings) && !suit(kept))
    }
}
