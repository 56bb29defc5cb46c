//! The search for the level within a bound on the deviation, as a stage.

use super::{Row, Run, SmoothedIndex};
use crate::bound::bound_in_slices;
use crate::stage::Stage;
use crate::store::Store;

pub(super) const ROW: Row = Row {
    needs: &[Stage::Decimation],
    is_decided_anew: |old, new| old.target != new.target,
    is_wanted: |settings, _| settings.target.deviation_mm().is_some(),
    is_background: false,
    has: |now| now.bound.is_some(),
    clear: |now| {
        now.bound = None;
        now.times.begin(Stage::Bound);
    },
    time: |times| &mut times.bound,
    start,
};

fn start(store: &Store) -> Option<Run> {
    let (levels, smoothed) = (store.now.levels.clone()?, store.now.smoothed.clone()?);
    let bound_mm = store.now.settings.target.deviation_mm()?;
    let index = SmoothedIndex::known(store);
    Some(Run::new(move |yielder, outbox| async move {
        let index = index.get(&smoothed.mesh, &yielder.part(0.0..0.0)).await;
        let bound = bound_in_slices(&levels.progressive, &smoothed.mesh, &index, bound_mm, &yielder).await;
        outbox.leave(move |store| {
            store.now.indices.smoothed = Some(index);
            store.now.bound = Some(bound);
        });
    }))
}
