//! Decimation as a stage: all levels.

use std::sync::Arc;

use super::carry::kept_arrays;
use super::{Row, Run};
use crate::caps::with_caps;
use crate::decimation::{Decimated, Holds, decimate_in_slices, labels_of};
use crate::results::Levels;
use crate::stage::Stage;
use crate::store::Store;
use lumen_vessel::width::widths;

pub(super) const ROW: Row = Row {
    needs: &[Stage::Smoothing],
    is_decided_anew: |old, new| !old.decimation.gives_same(&new.decimation),
    is_wanted: |_, _| true,
    is_background: false,
    has: |now| now.levels.is_some(),
    clear: |now| (now.levels, now.calibres) = (None, None),
    time: |times| &mut times.decimation,
    start,
};

/// The part of the work that it is to find the widths.
const WIDTHS: f32 = 0.5;

fn start(store: &Store) -> Option<Run> {
    let (kept, smoothed) = (store.now.kept.clone()?, store.now.smoothed.clone()?);
    let settings = store.now.settings.decimation;
    let (index, known_widths) = (store.now.indices.kept.clone(), store.known_widths().cloned());
    let arrays = if settings.keep_labels { kept_arrays(store) } else { None };
    let labels = arrays.and_then(|arrays| labels_of(&kept.mesh, &arrays));
    let smoothing = store.now.settings.smoothing;
    let needs_vertices = !store.arrays.is_empty();
    Some(Run::new(move |yielder, outbox| async move {
        // The widths are those of the kept surface, whoever finds them: the levels are the same.
        let (known, begun) = match known_widths {
            None if settings.spare_thin => {
                let part = yielder.part(0.0..WIDTHS);
                let (found, index) = widths(&kept.mesh, &kept.topology, index, &part).await;
                let (of, found) = (kept.clone(), Arc::<[f32]>::from(found));
                let left = found.clone();
                outbox.leave(|store| {
                    store.now.indices.kept = Some(index);
                    store.widths = Some((of, left));
                });
                (Some(found), WIDTHS)
            }
            known => (known.filter(|_| settings.spare_thin), 0.0),
        };
        let capped = if smoothing.hold_caps { kept.capped(&yielder.part(begun..begun)).await } else { None };
        let caps = capped.map_or(&[][..], |capped| &capped.caps);
        let labels = with_caps(labels, caps, kept.mesh.triangles.len());
        let holds = Holds { widths: known.as_deref(), labels: labels.as_deref(), caps };
        let part = yielder.part(begun..1.0);
        let Decimated { progressive, vertex_of_node } =
            decimate_in_slices(&smoothed.mesh, &kept.topology, &settings, holds, &part).await;
        yielder.rest(1.0).await;
        let vertex_of_node = if needs_vertices { vertex_of_node } else { Vec::new() }.into();
        let levels = Levels { progressive: Arc::new(progressive), vertex_of_node };
        outbox.leave(|store| store.now.levels = Some(levels));
    }))
}
