//! The deviation as a stage: of the level from the smoothed surface, with the map that is drawn, and from the surface as
//! it was opened.

use std::sync::Arc;

use super::running::Run;
use crate::deviation::{Comparison, DeviationTask};
use crate::results::{Deviations, Results};
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};
use lumen_mesh::{SurfaceIndex, TriMesh};

pub(super) struct Deviating {
    from_smoothed: DeviationTask<Arc<TriMesh>>,
    from_original: DeviationTask<Arc<TriMesh>>,
    /// What came of the first.
    first: Option<Option<Comparison>>,
}

impl Deviating {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let now = &store.now;
        let (kept, levels, reduced) = (now.kept.as_ref()?, now.levels.as_ref()?, now.reduced.as_ref()?);
        let task = |mesh: &Arc<TriMesh>, index: &Option<Arc<SurfaceIndex>>| {
            let task = DeviationTask::new(mesh.clone(), reduced.mesh.clone(), store.samples);
            match index {
                Some(index) => task.with_index_of_a(index.clone()),
                None => task,
            }
        };
        let from_smoothed = task(&levels.finest, &now.indices.finest).with_map();
        let from_original = task(&kept.mesh, &now.indices.kept).with_map();
        Some(Self { from_smoothed, from_original, first: None })
    }
}

impl Run for Deviating {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        if self.first.is_none() {
            match self.from_smoothed.advance(budget) {
                Progress::Working(fraction) => return Ok(Progress::Working(fraction / 2.0)),
                Progress::Done(found) => self.first = Some(found),
            }
        }
        match self.from_original.advance(budget) {
            Progress::Working(fraction) => Ok(Progress::Working(0.5 + fraction / 2.0)),
            Progress::Done(from_original) => {
                let now = &mut store.now;
                now.indices.level = self.from_smoothed.index_of_b().cloned();
                now.indices.finest = self.from_smoothed.index_of_a().cloned();
                now.indices.kept = self.from_original.index_of_a().cloned();
                let from_smoothed = self.first.take().flatten();
                let by_node = by_node(now, from_smoothed.as_ref());
                now.deviations = Some(Arc::new(Deviations { from_smoothed, from_original, by_node }));
                Ok(Progress::Done(()))
            }
        }
    }
}

/// The map of the deviation over the level, at the nodes of the progressive mesh.
fn by_node(now: &Results, found: Option<&Comparison>) -> Vec<f32> {
    let (Some(levels), Some(reduced)) = (&now.levels, &now.reduced) else { return Vec::new() };
    let mut is_used = vec![false; levels.progressive.positions.len()];
    reduced.level.triangles.as_flattened().iter().for_each(|&node| is_used[node as usize] = true);
    // The level's own vertices are the nodes in use, in their order.
    let mut map = found.map_or(&[][..], |found| &found.map).iter();
    is_used.into_iter().map(|used| if used { map.next().copied().unwrap_or(0.0) } else { 0.0 }).collect()
}
