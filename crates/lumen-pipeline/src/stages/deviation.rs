//! The deviation as a stage: of the level from the smoothed surface, with the map that is drawn, and from the surface as
//! it was opened.

use std::sync::Arc;

use super::{Row, Run, SmoothedIndex};
use crate::deviation::{Comparing, Comparison, compare};
use crate::progressive::ProgressiveMesh;
use crate::results::{Deviations, Reduced};
use crate::stage::{Stage, Wanted};
use crate::store::Store;

pub(super) const ROW: Row = Row {
    needs: &[Stage::Level],
    is_decided_anew: |_, _| false,
    is_wanted: |_, wanted| wanted >= Wanted::Measures,
    is_background: false,
    has: |now| now.deviations.is_some(),
    clear: |now| now.deviations = None,
    time: |times| &mut times.deviation,
    start,
};

fn start(store: &Store) -> Option<Run> {
    let now = &store.now;
    let (kept, levels, reduced) = (now.kept.clone()?, now.levels.clone()?, now.reduced.clone()?);
    let smoothed = now.smoothed.clone()?;
    let indices = SmoothedIndex::known(store)?;
    let samples = store.samples;
    Some(Run::new(move |yielder, outbox| async move {
        let comparing = |indices| Comparing { samples, with_map: true, indices };
        let [of_kept, of_smoothed] = indices.both(&yielder.part(0.0..0.05)).await;
        let part = yielder.part(0.05..0.5);
        let smoothed = compare(&smoothed.mesh, &reduced.mesh, comparing([Some(of_smoothed), None]), &part).await;
        let part = yielder.part(0.5..1.0);
        let [of_smoothed, of_level] = smoothed.indices;
        let original = compare(&kept.mesh, &reduced.mesh, comparing([Some(of_kept), of_level]), &part).await;
        let by_node = by_node(&levels.progressive, &reduced, smoothed.comparison.as_ref());
        let deviations = Deviations { from_smoothed: smoothed.comparison, from_original: original.comparison, by_node };
        outbox.leave(|store| {
            let indices = &mut store.now.indices;
            indices.smoothed = of_smoothed;
            [indices.kept, indices.level] = original.indices;
            store.now.deviations = Some(Arc::new(deviations));
        });
    }))
}

/// The map of the deviation over the level, at the nodes of the progressive mesh.
fn by_node(progressive: &ProgressiveMesh, reduced: &Reduced, found: Option<&Comparison>) -> Vec<f32> {
    let mut is_used = vec![false; progressive.positions.len()];
    reduced.level.triangles.as_flattened().iter().for_each(|&node| is_used[node as usize] = true);
    // The level's own vertices are the nodes in use, in their order.
    let mut map = found.map_or(&[][..], |found| &found.map).iter();
    is_used.into_iter().map(|used| if used { map.next().copied().unwrap_or(0.0) } else { 0.0 }).collect()
}
