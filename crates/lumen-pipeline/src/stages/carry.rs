//! The arrays of the level as a stage: those of what connectivity kept, and then those of the level.

use std::sync::Arc;

use super::running::Run;
use crate::carry::{CarryTask, Entered};
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};
use lumen_mesh::arrays::gathered;
use lumen_mesh::{Array, SurfaceIndex, TriMesh};

pub(super) enum Carrying {
    /// The surface has none.
    Nothing,
    /// Those of what was kept come first.
    Begin,
    Level(Box<CarryTask>),
}

impl Carrying {
    pub(super) fn start(store: &Store) -> Option<Self> {
        store.now.reduced.as_ref()?;
        Some(if store.now.mended.as_ref()?.arrays.is_empty() { Self::Nothing } else { Self::Begin })
    }
}

impl Run for Carrying {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        match self {
            Self::Nothing => store.now.arrays = Some(Arc::default()),
            Self::Begin => match begin(store) {
                Some(task) => {
                    *self = Self::Level(Box::new(task));
                    return Ok(Progress::Working(0.1));
                }
                None => store.now.arrays = Some(Arc::default()),
            },
            Self::Level(task) => match task.advance(budget) {
                Progress::Working(fraction) => return Ok(Progress::Working(0.1 + 0.9 * fraction)),
                Progress::Done(arrays) => store.now.arrays = Some(Arc::new(arrays)),
            },
        }
        Ok(Progress::Done(()))
    }
}

/// Everything is there once there is a level.
fn begin(store: &mut Store) -> Option<CarryTask> {
    let arrays = kept(store)?;
    let now = &store.now;
    let (levels, reduced) = (now.levels.as_ref()?, now.reduced.as_ref()?);
    // The deviation has built both, but where one of the surfaces has no area.
    let index_of = |mesh: &TriMesh, built: &Option<Arc<SurfaceIndex>>| match built {
        Some(index) => index.clone(),
        None => Arc::new(SurfaceIndex::new(&mesh.positions, &mesh.triangles)),
    };
    let from = Entered {
        arrays,
        mesh: now.smoothed.as_ref()?.mesh.clone(),
        topology: now.kept.as_ref()?.topology.clone(),
        finest: levels.finest.clone(),
        index: index_of(&levels.finest, &now.indices.finest),
        vertex_of_node: levels.vertex_of_node.clone(),
    };
    let index = index_of(&reduced.mesh, &now.indices.level);
    Some(CarryTask::new(from, &reduced.level.triangles, reduced.mesh.clone(), index))
}

/// The arrays of what connectivity kept.
fn kept(store: &mut Store) -> Option<Arc<Vec<Array>>> {
    let (kept, arrays) = (store.now.kept.clone()?, kept_arrays(store)?);
    store.kept_arrays = Some((kept, arrays.clone()));
    Some(arrays)
}

/// The same, which nothing keeps.
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
