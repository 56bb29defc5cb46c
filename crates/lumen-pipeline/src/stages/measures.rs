//! The measures as two stages: shape and lumen of the smoothed surface and of a level. They are no part of the method.
//!
//! What belongs to the smoothed surface (its shape, samples of its vessels, the rate at which the first is pinched) is
//! measured once and kept from level to level.

use std::sync::Arc;

use super::{Row, Run, SmoothedIndex};
use crate::caps::cap_areas;
use crate::pinch::first_pinch_of;
use crate::results::{LevelMeasures, SmoothedMeasures};
use crate::settings::Target;
use crate::shape::{Known, shape_in_slices};
use crate::stage::{Stage, Wanted};
use crate::store::Store;
use lumen_mesh::Ball;
use lumen_vessel::width::{narrowing, samples_in_slices};

/// The part of the work that the smoothed surface is, where it is to be measured.
const SMOOTHED: f32 = 0.9;

pub(super) const OF_SMOOTHED: Row = Row {
    needs: &[Stage::Decimation],
    is_decided_anew: |_, _| false,
    is_wanted: |settings, wanted| wanted >= Wanted::Measures || settings.target == Target::Auto,
    is_background: false,
    has: |now| now.smoothed_measures.is_some(),
    clear: |now| now.smoothed_measures = None,
    time: |times| &mut times.measures,
    start: start_smoothed,
};

fn start_smoothed(store: &Store) -> Option<Run> {
    let now = &store.now;
    let (kept, smoothed, levels) = (now.kept.clone()?, now.smoothed.clone()?, now.levels.clone()?);
    let indices = SmoothedIndex::known(store)?;
    Some(Run::new(|yielder, outbox| async move {
        let yielder = yielder.part(0.0..SMOOTHED);
        let (mesh, topology) = (&smoothed.mesh, &kept.topology);
        let [of_kept, of_smoothed] = indices.both(&yielder.part(0.0..0.1)).await;
        let known = Known { index: Some(of_smoothed.clone()), crosses_nothing: smoothed.crosses_nothing };
        let measured = shape_in_slices(mesh, topology, known, &yielder.part(0.1..0.4)).await;
        let part = yielder.part(0.4..0.5);
        let samples = samples_in_slices(mesh, topology, &measured.balls, &measured.index, &part).await;
        let pinch = first_pinch_of(&levels.progressive, &samples, &yielder.part(0.5..1.0)).await;
        let found = SmoothedMeasures { shape: measured.shape, samples: samples.into(), pinch };
        outbox.leave(|store| {
            (store.now.indices.kept, store.now.indices.smoothed) = (Some(of_kept), Some(of_smoothed));
            store.now.smoothed_measures = Some(Arc::new(found));
        });
    }))
}

pub(super) const OF_LEVEL: Row = Row {
    needs: &[Stage::Level, Stage::SmoothedMeasures],
    is_decided_anew: |_, _| false,
    is_wanted: |_, wanted| wanted >= Wanted::Measures,
    is_background: false,
    has: |now| now.level_measures.is_some(),
    clear: |now| {
        now.level_measures = None;
        // Both times are told as one: that of the smoothed surface counts where it was spent for this level.
        now.times.begin(Stage::SmoothedMeasures);
        now.times.begin(Stage::Measures);
    },
    time: |times| &mut times.measures,
    start: start_level,
};

/// The samples are measured in one piece, of up to 2 microseconds each.
fn start_level(store: &Store) -> Option<Run> {
    let now = &store.now;
    let (reduced, smoothed, kept) = (now.reduced.clone()?, now.smoothed.clone()?, now.kept.clone()?);
    let samples: Arc<[Ball]> = now.smoothed_measures.as_ref()?.samples.clone();
    let index = now.indices.level.clone();
    Some(Run::new(move |yielder, outbox| async move {
        let (mesh, topology) = (&reduced.mesh, &reduced.topology);
        let known = Known { index, crosses_nothing: false };
        let measured = shape_in_slices(mesh, topology, known, &yielder.part(SMOOTHED..1.0)).await;
        let narrowing = narrowing(&samples, mesh, topology, &measured.index);
        let capped = kept.capped(&yielder.part(1.0..1.0)).await;
        let caps = capped.map_or_else(Vec::new, |capped| cap_areas(&capped.caps, &kept.mesh, mesh));
        let found = LevelMeasures { shape: measured.shape, narrowing, caps };
        outbox.leave(move |store| {
            store.now.level_measures = Some(Arc::new(found));
            store.now.indices.release(smoothed.mesh.triangles.len());
        });
    }))
}
