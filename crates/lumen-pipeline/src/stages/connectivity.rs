//! Connectivity as a stage: the pieces, those that are kept, their adjacency, their area and volume.

use std::sync::{Arc, OnceLock};

use web_time::Instant;

use super::{Row, Run};
use crate::connectivity::Connectivity;
use crate::results::Surface;
use crate::stage::Stage;
use crate::store::Store;
use crate::times::Part;
use lumen_mesh::{Topology, measures_within, oriented_loops};

pub(super) const ROW: Row = Row {
    needs: &[Stage::Mending],
    is_decided_anew: |old, new| old.keep != new.keep,
    is_wanted: |_, _| true,
    is_background: false,
    has: |now| now.kept.is_some(),
    clear: |now| (now.kept, now.indices.kept) = (None, None),
    time: |times| &mut times.connectivity,
    start,
};

/// Each part is one piece.
fn start(store: &Store) -> Option<Run> {
    let (whole, keep) = (store.now.mended.as_ref()?.mesh.clone(), store.now.settings.keep);
    let known = store.now.connectivity.clone();
    Some(Run::fallible(move |yielder, outbox| async move {
        let mut found = known.unwrap_or_else(|| Arc::new(Connectivity::unmeasured(&whole)));
        yielder.rest(0.2).await;
        let mesh = found.kept(&whole, keep)?;
        yielder.rest(0.3).await;
        let begun = Instant::now();
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        outbox.tell_apart(Part::Adjacency, begun);
        yielder.rest(0.7).await;
        let begun = Instant::now();
        if found.components.is_empty() {
            Arc::make_mut(&mut found).measure(&whole);
        }
        let loops = oriented_loops(&topology);
        let measures = measures_within(&mesh, loops.as_deref());
        outbox.tell_apart(Part::KeptAreas, begun);
        let kept = Surface { mesh, topology: Arc::new(topology), loops, measures, caps: OnceLock::new() };
        outbox.leave(|store| {
            store.now.connectivity = Some(found);
            store.now.kept = Some(Arc::new(kept));
        });
        Ok(())
    }))
}
