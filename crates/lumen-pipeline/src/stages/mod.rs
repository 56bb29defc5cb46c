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

use super::results::Results;
use super::settings::Settings;
use super::stage::{Stage, Wanted};
use super::store::Store;
use super::task::Yielder;
use super::times::StageTimes;
use lumen_mesh::{SurfaceIndex, TriMesh, refitted};
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

/// What the index of the smoothed surface is taken or made from.
pub(super) struct SmoothedIndex {
    smoothed: Option<Arc<SurfaceIndex>>,
    kept: Option<Arc<SurfaceIndex>>,
}

impl SmoothedIndex {
    pub(super) fn known(store: &Store) -> Self {
        let indices = &store.now.indices;
        Self { smoothed: indices.smoothed.clone(), kept: indices.kept.clone() }
    }

    /// The index of `smoothed`: the one that is there, that of the kept surface with boxes of its own, or one built anew.
    pub(super) async fn get(self, smoothed: &TriMesh, yielder: &Yielder) -> Arc<SurfaceIndex> {
        match self {
            Self { smoothed: None, kept: Some(kept) } => Arc::new(refitted(&kept, smoothed, yielder).await),
            Self { smoothed: known, .. } => SurfaceIndex::known_or_built(known, smoothed, yielder).await,
        }
    }
}
