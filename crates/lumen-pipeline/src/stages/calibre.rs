//! The certificate of calibre as two stages: where the vessels of the opened and the smoothed surface are and how wide, the
//! same for every level; and what a level makes of them.

use std::sync::Arc;

use super::running::Run;
use crate::results::{Certified, NOT_MEASURED, Reduced};
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};
use lumen_mesh::Vec3;
use lumen_vessel::certificate::{Basis, CalibreError, Candidate, Certificate, CertificateTask};
use lumen_vessel::{Located, Subject};

/// Nodes that are coloured between two looks at the clock.
const NODES: usize = 256;
/// Farther than this many radii from the centreline a vertex is on no vessel that was measured.
const BESIDE: f64 = 2.0;

/// The finding of the vessels.
pub(super) struct Finding(Option<Box<CertificateTask>>);

impl Finding {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let now = &store.now;
        let (kept, smoothed) = (now.kept.as_ref()?, now.smoothed.as_ref()?);
        let (topology, index) = (kept.topology.clone(), now.indices.kept.clone());
        let of_kept = Subject { mesh: kept.mesh.clone(), topology: topology.clone(), index };
        let of_smoothed = Subject { mesh: smoothed.mesh.clone(), topology, index: None };
        let subjects = [of_kept, of_smoothed.clone(), of_smoothed];
        Some(Self(Some(Box::new(CertificateTask::new(subjects, now.settings.tolerance_percent)))))
    }
}

impl Run for Finding {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        let Some(task) = &mut self.0 else { return Ok(Progress::Done(())) };
        let found = match task.advance(budget) {
            Progress::Working(fraction) => return Ok(Progress::Working(fraction)),
            Progress::Done(found) => found.map(|_| ()),
        };
        let basis = self.0.take().and_then(|task| task.into_basis());
        store.now.vessels = match (found, basis) {
            (Err(error), _) => Some(Err(error)),
            (Ok(()), basis) => basis.map(|basis| Ok(Arc::new(basis))),
        };
        Ok(Progress::Done(()))
    }
}

/// The certifying of a level.
pub(super) enum Certifying {
    Measure {
        basis: Arc<Basis>,
        reduced: Arc<Reduced>,
        candidate: Box<Candidate>,
    },
    /// What each node of the level shows.
    Colour {
        basis: Arc<Basis>,
        reduced: Arc<Reduced>,
        certificate: Certificate,
        colouring: Colouring,
    },
    /// There are no vessels.
    Refused(CalibreError),
}

impl Certifying {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let now = &store.now;
        let (vessels, reduced) = (now.vessels.as_ref()?, now.reduced.as_ref()?.clone());
        Some(match vessels {
            Err(error) => Self::Refused(error.clone()),
            Ok(basis) => {
                let (mesh, topology, index) = (reduced.mesh.clone(), reduced.topology.clone(), None);
                let candidate = Box::new(Candidate::new(Subject { mesh, topology, index }));
                Self::Measure { basis: basis.clone(), reduced, candidate }
            }
        })
    }
}

impl Run for Certifying {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        loop {
            match self {
                Self::Refused(error) => {
                    store.now.certified = Some(Err(error.clone()));
                    return Ok(Progress::Done(()));
                }
                Self::Measure { basis, reduced, candidate } => {
                    let tolerance = store.now.settings.tolerance_percent;
                    let Some(branches) = candidate.advance(basis, tolerance, budget) else {
                        return Ok(Progress::Working(0.2));
                    };
                    let nodes = store.now.levels.as_ref().map_or(0, |levels| levels.progressive.positions.len());
                    *self = Self::Colour {
                        basis: basis.clone(),
                        reduced: reduced.clone(),
                        certificate: Certificate::new(branches, tolerance),
                        colouring: Colouring::new(nodes),
                    };
                }
                Self::Colour { basis, reduced, certificate, colouring } => {
                    let Some(levels) = &store.now.levels else { return Ok(Progress::Done(())) };
                    while colouring.advance(&levels.progressive.positions, reduced, basis, certificate) {
                        if budget.is_spent() {
                            return Ok(Progress::Working(0.5 + 0.5 * colouring.fraction(reduced)));
                        }
                    }
                    let change_by_node = std::mem::take(&mut colouring.changes);
                    let certified = Certified { certificate: certificate.clone(), change_by_node };
                    store.now.certified = Some(Ok(Arc::new(certified)));
                    return Ok(Progress::Done(()));
                }
            }
            if budget.is_spent() {
                return Ok(Progress::Working(0.5));
            }
        }
    }
}

/// The change of calibre beside each node of a level.
pub(super) struct Colouring {
    /// In percent, by node of the progressive mesh; [`NOT_MEASURED`] where it is not known.
    changes: Vec<f32>,
    is_done: Vec<bool>,
    /// Triangles of the level that were looked at.
    next: usize,
    last: Option<Located>,
}

impl Colouring {
    fn new(nodes: usize) -> Self {
        Self { changes: vec![NOT_MEASURED; nodes], is_done: vec![false; nodes], next: 0, last: None }
    }

    /// Looks at the next triangles; whether there are more.
    fn advance(&mut self, positions: &[Vec3], reduced: &Reduced, basis: &Basis, certificate: &Certificate) -> bool {
        let triangles = &reduced.level.triangles;
        let end = triangles.len().min(self.next + NODES);
        for &node in triangles[self.next..end].as_flattened() {
            let node = node as usize;
            if !std::mem::replace(&mut self.is_done[node], true) {
                self.changes[node] = self.change_at(positions[node], basis, certificate).unwrap_or(NOT_MEASURED);
            }
        }
        self.next = end;
        end < triangles.len()
    }

    fn change_at(&mut self, p: Vec3, basis: &Basis, certificate: &Certificate) -> Option<f32> {
        let (branch, station, radii) = basis.beside(p.as_dvec3(), &mut self.last)?;
        let branch = certificate.branches.get(branch).filter(|_| radii <= BESIDE)?;
        branch.reduced.changes_percent[station]
    }

    fn fraction(&self, reduced: &Reduced) -> f32 {
        self.next as f32 / reduced.level.triangles.len().max(1) as f32
    }
}
