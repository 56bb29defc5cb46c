//! What each stage is and does, a file each: its [`Row`] says what it needs, what decides it and what it leaves.

mod bound;
mod calibre;
mod carry;
mod connectivity;
mod decimation;
mod deviation;
mod faults;
mod level;
mod measures;
mod mending;
mod running;
mod safe;
mod smoothing;

use std::sync::Arc;

use super::results::{Results, Smoothed, Surface};
use super::settings::Settings;
use super::stage::{Stage, Wanted};
use super::store::Store;
use super::task::Yielder;
use super::times::StageTimes;
use lumen_mesh::{SurfaceIndex, refitted};
pub(super) use running::{Outbox, Run};

/// All that is known of a stage.
pub(super) struct Row {
    /// The stages whose results it takes.
    pub(super) needs: &'static [Stage],
    /// Whether it depends on a setting that differs between the old and the new ones.
    pub(super) is_decided_anew: fn(&Settings, &Settings) -> bool,
    /// Whether it is made at all.
    pub(super) is_wanted: fn(&Settings, Wanted) -> bool,
    /// Whether it runs while the user works with the level, and nothing waits for it.
    pub(super) is_background: bool,
    /// Whether its result is there.
    pub(super) has: fn(&Results) -> bool,
    /// Drops its result.
    pub(super) clear: fn(&mut Results),
    /// The time in a report that its own is part of.
    pub(super) time: fn(&mut StageTimes) -> &mut f64,
    /// Starts it on what it needs; `None` while that is not there.
    pub(super) start: fn(&Store) -> Option<Run>,
}

/// The row of a stage.
pub(super) fn row(stage: Stage) -> &'static Row {
    match stage {
        Stage::Mending => &mending::ROW,
        Stage::Connectivity => &connectivity::ROW,
        Stage::Smoothing => &smoothing::ROW,
        Stage::Decimation => &decimation::ROW,
        Stage::Bound => &bound::ROW,
        Stage::Level => &level::ROW,
        Stage::Deviation => &deviation::ROW,
        Stage::Arrays => &carry::ROW,
        Stage::SmoothedMeasures => &measures::OF_SMOOTHED,
        Stage::Measures => &measures::OF_LEVEL,
        Stage::Faults => &faults::ROW,
        Stage::Vessels => &calibre::VESSELS,
        Stage::Certificate => &calibre::CERTIFICATE,
        Stage::Safe => &safe::ROW,
    }
}

/// The index of the smoothed surface: always that of the kept surface with boxes of its own, whatever was made before, so that
/// results are the same.
pub(super) struct SmoothedIndex {
    kept: Arc<Surface>,
    smoothed: Arc<Smoothed>,
    of_kept: Option<Arc<SurfaceIndex>>,
    of_smoothed: Option<Arc<SurfaceIndex>>,
}

impl SmoothedIndex {
    /// What there is of it; `None` before a surface is smoothed.
    pub(super) fn known(store: &Store) -> Option<Self> {
        let Results { kept, smoothed, indices, .. } = &store.now;
        let (of_kept, of_smoothed) = (indices.kept.clone(), indices.smoothed.clone());
        Some(Self { kept: kept.clone()?, smoothed: smoothed.clone()?, of_kept, of_smoothed })
    }

    /// The indices of the kept and of the smoothed surface.
    pub(super) async fn both(self, yielder: &Yielder) -> [Arc<SurfaceIndex>; 2] {
        let (kept, smoothed) = (&self.kept.mesh, &self.smoothed.mesh);
        let of_kept = SurfaceIndex::known_or_built(self.of_kept, kept, &yielder.part(0.0..0.8)).await;
        let of_smoothed = match self.of_smoothed {
            Some(known) => known,
            None if Arc::ptr_eq(kept, smoothed) => of_kept.clone(),
            None => Arc::new(refitted(&of_kept, smoothed, &yielder.part(0.8..1.0)).await),
        };
        [of_kept, of_smoothed]
    }
}
