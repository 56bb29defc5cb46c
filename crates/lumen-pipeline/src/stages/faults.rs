//! The faults of the surface as it was opened, as a stage: whatever of it is mended or kept.

use std::sync::Arc;

use super::{Row, Run};
use crate::stage::Wanted;
use crate::store::Store;
use crate::task::Yielder;
use lumen_mesh::mending::Faults;
use lumen_mesh::mending::wall::find_in_slices;
use lumen_mesh::{SurfaceIndex, Topology, TriMesh, joined_index};

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
    let now = &store.now;
    // What is kept is often the whole surface, or nearly, and its adjacency and its boxes are known.
    let kept = now.kept.as_ref().filter(|kept| Arc::ptr_eq(&kept.mesh, &mesh));
    let topology = kept.map(|kept| kept.topology.clone());
    let is_unmended = now.mended.as_ref().is_some_and(|mended| Arc::ptr_eq(&mended.mesh, &mesh));
    let known = now.indices.kept.clone().zip(now.connectivity.clone()).filter(|_| is_unmended);
    let keep = now.settings.keep;
    Some(Run::new(move |yielder, outbox| async move {
        let build = || Arc::new(Topology::new(mesh.positions.len(), &mesh.triangles));
        let topology = topology.unwrap_or_else(build);
        yielder.rest(0.1).await;
        let mut faults = Faults::of_in_slices(&mesh, &topology, &yielder.part(0.1..0.4)).await;
        if topology.is_consistent() {
            let mut index = None;
            if let Some((of_kept, connectivity)) = known {
                let rows = connectivity.kept_rows(&mesh, keep).ok().flatten().map(|rows| rows.triangles);
                index = Some(index_of_all(&mesh, of_kept, rows, &yielder.part(0.4..0.6)).await);
            }
            faults.wall = find_in_slices(&mesh, index, false, &yielder.part(0.6..1.0)).await.wall;
        }
        outbox.leave(|store| store.now.faults = Some(Arc::new(faults)));
    }))
}

/// The index of `mesh`, from that of what is kept of it: the triangles of these numbers, or all.
async fn index_of_all(
    mesh: &TriMesh,
    of_kept: Arc<SurfaceIndex>,
    kept: Option<Vec<u32>>,
    yielder: &Yielder,
) -> Arc<SurfaceIndex> {
    let Some(kept) = kept else { return of_kept };
    let mut is_kept = vec![false; mesh.triangles.len()];
    kept.iter().for_each(|&t| is_kept[t as usize] = true);
    let rest: Vec<u32> = (0..mesh.triangles.len() as u32).filter(|&t| !is_kept[t as usize]).collect();
    let triangles: Vec<[u32; 3]> = rest.iter().map(|&t| mesh.triangles[t as usize]).collect();
    let of_rest = SurfaceIndex::build(&mesh.positions, &triangles, &yielder.part(0.0..0.5)).await;
    Arc::new(joined_index([(&of_kept, &kept), (&of_rest, &rest)], &yielder.part(0.5..1.0)).await)
}
