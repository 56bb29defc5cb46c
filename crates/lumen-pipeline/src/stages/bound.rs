//! The search for the level within a bound on the deviation, as a stage.

use super::{Row, Run};
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
    let levels = store.now.levels.clone()?;
    let bound_mm = store.now.settings.target.deviation_mm()?;
    Some(Run::new(move |yielder, outbox| async move {
        let bound = bound_in_slices(&levels.progressive, bound_mm, &yielder).await;
        outbox.leave(move |store| store.now.bound = Some(bound));
    }))
}
