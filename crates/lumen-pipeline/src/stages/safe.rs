//! The search for the highest safe rate, as a stage: the same for every level.

use std::sync::Arc;

use super::{Row, Run};
use crate::safe::{NoSafeRate, Safe, safe_in_slices};
use crate::settings::Target;
use crate::stage::{Stage, Wanted};
use crate::store::Store;

pub(super) const ROW: Row = Row {
    needs: &[Stage::SmoothedMeasures, Stage::Vessels],
    is_decided_anew: |old, new| old.tolerance_percent != new.tolerance_percent,
    is_wanted: |settings, wanted| wanted >= Wanted::Safe || settings.target == Target::Auto,
    is_background: true,
    has: |now| now.safe.is_some(),
    clear: |now| now.safe = None,
    time: |times| &mut times.safe,
    start,
};

fn start(store: &Store) -> Option<Run> {
    let now = &store.now;
    let (vessels, levels) = (now.vessels.clone()?, now.levels.clone()?);
    let (tolerance, known) = (now.settings.tolerance_percent, now.calibres.clone());
    let pinch = now.smoothed_measures.as_ref().and_then(|found| found.pinch);
    Some(Run::new(move |yielder, outbox| async move {
        let safe = match vessels {
            Ok(basis) => {
                let known = known.as_deref();
                let (safe, there) =
                    safe_in_slices(&basis, &levels.progressive, pinch, tolerance, known, &yielder).await;
                if let Some(there) = there {
                    outbox.leave(|store| store.now.calibres = Some(Arc::new(there)));
                }
                safe
            }
            // There are no vessels.
            Err(error) => Safe::refused(tolerance, NoSafeRate::NoTree(error)),
        };
        outbox.leave(|store| store.now.safe = Some(Arc::new(safe)));
    }))
}
