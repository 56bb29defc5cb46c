//! The faults of the surface as it was opened, as a stage: whatever of it is mended or kept.

use std::sync::Arc;

use super::{Row, Run};
use crate::stage::Wanted;
use crate::store::Store;
use lumen_mesh::Topology;
use lumen_mesh::mending::Faults;
use lumen_mesh::mending::wall::find_in_slices;

pub(super) const ROW: Row = Row {
    needs: &[],
    is_decided_anew: |_, _| false,
    is_wanted: |_, wanted| wanted >= Wanted::Certificate,
    is_background: true,
    has: |now| now.faults.is_some(),
    clear: |now| now.faults = None,
    time: |times| &mut times.faults,
    start,
};

fn start(store: &Store) -> Option<Run> {
    let mesh = store.opened.clone();
    // What is kept is often the whole surface, and its adjacency and its boxes are known.
    let kept = store.now.kept.as_ref().filter(|kept| Arc::ptr_eq(&kept.mesh, &mesh));
    let topology = kept.map(|kept| kept.topology.clone());
    let index = kept.and(store.now.indices.kept.clone());
    Some(Run::new(move |yielder, outbox| async move {
        let build = || Arc::new(Topology::new(mesh.positions.len(), &mesh.triangles));
        let topology = topology.unwrap_or_else(build);
        yielder.rest(0.1).await;
        let mut faults = Faults::of_in_slices(&mesh, &topology, &yielder.part(0.1..0.4)).await;
        if topology.is_consistent() {
            faults.wall = find_in_slices(&mesh, index, false, &yielder.part(0.4..1.0)).await.wall;
        }
        outbox.leave(|store| store.now.faults = Some(Arc::new(faults)));
    }))
}
