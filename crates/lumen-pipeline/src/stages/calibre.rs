//! The certificate of calibre as two stages: where the vessels of the opened and the smoothed surface are and how wide, the
//! same for every level; and what a level makes of them.

use std::sync::Arc;

use super::{Row, Run};
use crate::results::{Certified, LevelCalibres, NOT_MEASURED};
use crate::settings::Target;
use crate::stage::{Stage, Wanted};
use crate::store::Store;
use crate::task::{Yielder, blocks};
use lumen_mesh::Vec3;
use lumen_vessel::certificate::{Basis, Certificate};
use lumen_vessel::{Asked, Subject};

/// Triangles whose nodes are coloured between two looks at the clock.
const TRIANGLES: usize = 256;
/// Farther than this many radii from the centreline a vertex is on no vessel that was measured.
const BESIDE: f64 = 2.0;

pub(super) const VESSELS: Row = Row {
    needs: &[Stage::Smoothing],
    is_decided_anew: |_, _| false,
    is_wanted: |settings, wanted| wanted >= Wanted::Certificate || settings.target == Target::Auto,
    is_background: true,
    has: |now| now.vessels.is_some(),
    clear: |now| {
        (now.vessels, now.calibres) = (None, None);
        now.times.begin(Stage::Vessels);
    },
    time: |times| &mut times.calibre,
    start: start_vessels,
};

/// The finding of the vessels.
fn start_vessels(store: &Store) -> Option<Run> {
    let now = &store.now;
    let (kept, smoothed) = (now.kept.as_ref()?, now.smoothed.as_ref()?);
    let (topology, index) = (kept.topology.clone(), now.indices.kept.clone());
    let of_kept = Subject { mesh: kept.mesh.clone(), topology: topology.clone(), index };
    let of_smoothed = Subject { mesh: smoothed.mesh.clone(), topology, index: now.indices.smoothed.clone() };
    Some(Run::new(|yielder, outbox| async move {
        let vessels = Basis::find(of_kept, of_smoothed, &yielder).await.map(Arc::new);
        outbox.leave(|store| store.now.vessels = Some(vessels));
    }))
}

pub(super) const CERTIFICATE: Row = Row {
    needs: &[Stage::Level, Stage::Vessels],
    is_decided_anew: |old, new| old.tolerance_percent != new.tolerance_percent,
    // Where the vessels are found for the rate they are measured as well: that is one level of the many that were looked at.
    is_wanted: |settings, wanted| {
        wanted >= Wanted::Certificate || wanted >= Wanted::Measures && settings.target == Target::Auto
    },
    is_background: true,
    has: |now| now.certified.is_some(),
    clear: |now| {
        now.certified = None;
        now.times.begin(Stage::Certificate);
    },
    time: |times| &mut times.calibre,
    start: start_certificate,
};

/// The certifying of a level.
fn start_certificate(store: &Store) -> Option<Run> {
    let now = &store.now;
    let (vessels, reduced, levels) = (now.vessels.clone()?, now.reduced.clone()?, now.levels.clone()?);
    let (tolerance, known) = (now.settings.tolerance_percent, now.calibres.clone());
    Some(Run::new(move |yielder, outbox| async move {
        let certified = match vessels {
            // There are no vessels.
            Err(error) => Err(error),
            Ok(basis) => {
                let steps = reduced.level.steps;
                let branches = match known.and_then(|known| known.at(steps, tolerance)) {
                    Some(known) => known,
                    None => {
                        let (mesh, topology, index) = (reduced.mesh.clone(), reduced.topology.clone(), None);
                        let subject = Subject { mesh, topology, index };
                        let part = yielder.part(0.0..0.5);
                        let branches = basis.measured(&subject, Asked::SectionAndBall, tolerance, &part).await;
                        let left = LevelCalibres { steps, tolerance_percent: tolerance, branches: branches.clone() };
                        outbox.leave(|store| store.now.calibres = Some(Arc::new(left)));
                        branches
                    }
                };
                let certificate = Certificate::new(branches, tolerance, basis.openings_without_branch());
                let coloured = (&levels.progressive.positions[..], &reduced.level.triangles[..]);
                let change_by_node = colours(coloured, &basis, &certificate, &yielder.part(0.5..1.0)).await;
                Ok(Arc::new(Certified { certificate, change_by_node }))
            }
        };
        outbox.leave(|store| store.now.certified = Some(certified));
    }))
}

/// The change of calibre beside each node of a level, in percent; [`NOT_MEASURED`] where it is not known.
async fn colours(
    (positions, triangles): (&[Vec3], &[[u32; 3]]),
    basis: &Basis,
    certificate: &Certificate,
    yielder: &Yielder,
) -> Vec<f32> {
    let (mut changes, mut is_done) = (vec![NOT_MEASURED; positions.len()], vec![false; positions.len()]);
    let mut last = None;
    let mut change_at = |p: Vec3| {
        let (branch, station, radii) = basis.beside(p.as_dvec3(), &mut last)?;
        let branch = certificate.branches.get(branch).filter(|_| radii <= BESIDE)?;
        branch.reduced.changes_percent[station]
    };
    for block in blocks(triangles.len(), TRIANGLES) {
        let end = block.end;
        for &node in triangles[block].as_flattened() {
            let node = node as usize;
            if !std::mem::replace(&mut is_done[node], true) {
                changes[node] = change_at(positions[node]).unwrap_or(NOT_MEASURED);
            }
        }
        yielder.rest(end as f32 / triangles.len() as f32).await;
    }
    changes
}
