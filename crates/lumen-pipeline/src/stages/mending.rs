//! Mending as a stage: the surface as it was opened, or what mending makes of it, with its arrays.

use std::sync::Arc;

use super::{Row, Run};
use crate::results::MendedSurface;
use crate::store::Store;
use lumen_mesh::mending::{Mended, mend};

pub(super) const ROW: Row = Row {
    needs: &[],
    is_decided_anew: |old, new| old.mending != new.mending,
    is_wanted: |_, _| true,
    is_background: false,
    has: |now| now.mended.is_some(),
    clear: |now| (now.mended, now.connectivity) = (None, None),
    time: |times| &mut times.mending,
    start,
};

fn start(store: &Store) -> Option<Run> {
    let (opened, all, settings) = (store.opened.clone(), store.arrays.clone(), store.now.settings.clone());
    Some(Run::fallible(|yielder, outbox| async move {
        settings.check()?;
        let unchanged = |report| MendedSurface { mesh: opened.clone(), arrays: all.clone(), report };
        let entering = if settings.mending.is_off() {
            unchanged(None)
        } else {
            let (mesh, arrays) = ((*opened).clone(), (*all).clone());
            let Mended { mesh, arrays, report } = mend(mesh, arrays, settings.mending, &yielder).await;
            if mesh == *opened {
                unchanged(Some(report))
            } else {
                MendedSurface { mesh: Arc::new(mesh), arrays: Arc::new(arrays), report: Some(report) }
            }
        };
        outbox.leave(|store| store.now.mended = Some(Arc::new(entering)));
        Ok(())
    }))
}
