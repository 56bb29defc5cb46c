//! The arrays of the level as a stage: those of what connectivity kept, and then those of the level.

use std::sync::Arc;

use super::{Row, Run, SmoothedIndex};
use crate::carry::{Entered, carry};
use crate::stage::{Stage, Wanted};
use crate::store::Store;
use lumen_mesh::arrays::gathered;
use lumen_mesh::{Array, SurfaceIndex};

pub(super) const ROW: Row = Row {
    needs: &[Stage::Level],
    is_decided_anew: |_, _| false,
    is_wanted: |_, wanted| wanted >= Wanted::Measures,
    is_background: false,
    has: |now| now.arrays.is_some(),
    clear: |now| now.arrays = None,
    time: |times| &mut times.arrays,
    start,
};

fn start(store: &Store) -> Option<Run> {
    let now = &store.now;
    let (kept, smoothed) = (now.kept.clone()?, now.smoothed.clone()?);
    let (levels, reduced) = (now.levels.clone()?, now.reduced.clone()?);
    if now.mended.as_ref()?.arrays.is_empty() {
        return Some(Run::new(
            |_, outbox| async move { outbox.leave(|store| store.now.arrays = Some(Arc::default())) },
        ));
    }
    let arrays = kept_arrays(store)?;
    let (of_smoothed, of_level) = (SmoothedIndex::known(store)?, now.indices.level.clone());
    Some(Run::new(|yielder, outbox| async move {
        let left = (kept.clone(), arrays.clone());
        outbox.leave(|store| store.kept_arrays = Some(left));
        let [_, of_smoothed] = of_smoothed.both(&yielder.part(0.0..0.05)).await;
        let of_level = SurfaceIndex::known_or_built(of_level, &reduced.mesh, &yielder.part(0.05..0.1)).await;
        let from =
            Entered { arrays, mesh: smoothed.mesh.clone(), index: of_smoothed, vertex_of_node: levels.vertex_of_node };
        let (triangles, part) = (&reduced.level.triangles, yielder.part(0.1..1.0));
        let arrays = Arc::new(carry(&from, triangles, &reduced.mesh, &of_level, &part).await);
        outbox.leave(|store| store.now.arrays = Some(arrays));
    }))
}

/// The arrays of what connectivity kept.
pub(super) fn kept_arrays(store: &Store) -> Option<Arc<Vec<Array>>> {
    let kept = store.now.kept.as_ref()?;
    if let Some((of, arrays)) = &store.kept_arrays
        && Arc::ptr_eq(of, kept)
    {
        return Some(arrays.clone());
    }
    let (entering, connectivity) = (store.now.mended.as_ref()?, store.now.connectivity.as_ref()?);
    Some(match connectivity.kept_rows(&entering.mesh, store.now.settings.keep).ok()? {
        None => entering.arrays.clone(),
        Some(rows) => Arc::new(gathered(&entering.arrays, &rows.vertices, &rows.triangles)),
    })
}
