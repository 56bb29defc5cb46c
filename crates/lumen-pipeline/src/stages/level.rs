//! Taking a level, as a stage: a prefix of the progressive mesh as a surface of its own.

use std::sync::Arc;

use web_time::Instant;

use super::{Row, Run};
use crate::normals::{Weighting, vertex_normals};
use crate::results::{Levels, Reduced, fingerprint};
use crate::stage::Stage;
use crate::store::Store;
use crate::times::Part;
use lumen_mesh::{Topology, measures};

pub(super) const ROW: Row = Row {
    needs: &[Stage::Decimation, Stage::Bound],
    is_decided_anew: |old, new| old.target != new.target,
    is_wanted: |_, _| true,
    is_background: false,
    has: |now| now.reduced.is_some(),
    clear: |now| (now.reduced, now.indices.level) = (None, None),
    time: |times| &mut times.level,
    start,
};

/// One piece.
fn start(store: &Store) -> Option<Run> {
    let Levels { progressive, .. } = store.now.levels.clone()?;
    let (bound, target) = (store.now.bound, store.now.target());
    Some(Run::new(move |_, outbox| async move {
        let level = match bound {
            Some(bound) => progressive.level_after(bound.steps),
            None => progressive.level(target),
        };
        let mesh = Arc::new(progressive.extract(&level.triangles));
        let begun = Instant::now();
        let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
        outbox.tell_apart(Part::Normals, begun);
        let begun = Instant::now();
        let topology = Arc::new(Topology::new(mesh.positions.len(), &mesh.triangles));
        let measures = measures(&mesh, &topology);
        let fingerprint = fingerprint(&mesh);
        outbox.tell_apart(Part::LevelAreas, begun);
        let reduced = Reduced { target, level, mesh, topology, normals, measures, fingerprint };
        outbox.leave(|store| store.now.reduced = Some(Arc::new(reduced)));
    }))
}
