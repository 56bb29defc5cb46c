//! What reduced surfaces are judged by: where the opened surface is measured, and what it and the smoothed one have there.

use glam::DVec3;

use super::BranchCalibre;
use super::branch::branch_calibre;
use crate::calibre::{Calibre, Indexing, Known, Measuring, Subject};
use crate::centrelines::Centrelines;
use crate::locating::Located;
use crate::space::Space;
use crate::stations::Stations;
use crate::tree::{Branch, Tree};
use crate::zones::Zone;
use lumen_mesh::task::Budget;

/// What more reduced surfaces are judged by: where the opened surface is measured, and what it and the smoothed one have
/// there.
pub struct Basis {
    pub(super) measure: Box<Measure>,
    pub(super) smoothed: Subject,
    pub(super) edge_mm: f64,
}

/// A reduced surface that is measured where a [`Basis`] is.
pub struct Candidate {
    subject: Subject,
    indexing: Indexing,
    measuring: Option<Measuring>,
}

impl Candidate {
    /// Begins to measure `subject`.
    pub fn new(subject: Subject) -> Self {
        Self { indexing: Indexing::new(&subject), measuring: None, subject }
    }

    /// Measures until `budget` is spent; then the calibre of each branch, if all is measured.
    pub fn advance(&mut self, basis: &Basis, tolerance_percent: f64, budget: Budget) -> Option<Vec<BranchCalibre>> {
        let Subject { mesh, topology, .. } = &self.subject;
        if self.measuring.is_none() {
            let index = self.indexing.advance(mesh, budget)?;
            self.measuring = Some(Measuring::new(&self.subject, Space::new(mesh, topology, index)));
        }
        let measuring = self.measuring.as_mut()?;
        let Measure { stations, radii, done, .. } = &*basis.measure;
        let known = Known { radii, before: &basis.smoothed, calibres: &done[1] };
        measuring.advance(&stations.all, Some(known), budget).then(|| basis.judged(&measuring.found, tolerance_percent))
    }
}

impl Basis {
    /// The calibre of each branch where nothing is reduced: the surface is the smoothed one.
    pub fn of_smoothed(&self, tolerance_percent: f64) -> Vec<BranchCalibre> {
        self.judged(&self.measure.done[1], tolerance_percent)
    }

    /// The centrelines of the opened surface, with its calibre.
    pub fn centrelines(&self) -> Centrelines {
        let Measure { tree, stations, zones, done, .. } = &*self.measure;
        Centrelines {
            branches: tree.branches().to_vec(),
            stations: stations.clone(),
            calibres: done[0].clone(),
            zones: zones.clone().unwrap_or_default(),
        }
    }

    /// The branch and the number of the station on it that `p` is beside, and how far `p` is from the centreline there,
    /// in radii of the vessel. `last` is what [`Tree::locate`] found for a point near by; it makes this faster.
    pub fn beside(&self, p: DVec3, last: &mut Option<Located>) -> Option<(usize, usize, f64)> {
        let Measure { tree, stations, .. } = &*self.measure;
        let found = tree.locate(p, last.as_ref())?;
        let branch = found.branch as usize;
        let own = &stations.all[stations.of.get(branch)?.clone()];
        let abscissa = found.arc_mm + stations.before_mm[branch];
        let after = own.partition_point(|station| station.abscissa_mm < abscissa);
        let nearer = |&i: &usize| (own[i].abscissa_mm - abscissa).abs();
        let station =
            (after.saturating_sub(1)..(after + 1).min(own.len())).min_by(|a, b| nearer(a).total_cmp(&nearer(b)));
        let radii = found.distance_mm / found.radius_mm.max(f64::MIN_POSITIVE);
        *last = Some(found);
        Some((branch, station?, radii))
    }

    /// The calibre of each branch, on a surface that has `reduced` at the stations.
    pub(super) fn judged(&self, reduced: &[Calibre], tolerance_percent: f64) -> Vec<BranchCalibre> {
        let Measure { tree, stations, zones, done, .. } = &*self.measure;
        let zones = zones.as_deref().unwrap_or_default();
        let of = |(branch, range): (&Branch, &std::ops::Range<usize>)| {
            let own = range.clone();
            let calibres = [&done[0][own.clone()], &done[1][own.clone()], &reduced[own.clone()]];
            let (stations, zones) = (&stations.all[own.clone()], &zones[own]);
            branch_calibre(branch, stations, zones, calibres, self.edge_mm, tolerance_percent)
        };
        tree.branches().iter().zip(&stations.of).map(of).collect()
    }
}

/// The surfaces along one set of stations.
pub(super) struct Measure {
    pub(super) tree: Tree,
    pub(super) stations: Stations,
    /// Of each station, once the opened surface was measured a first time.
    pub(super) zones: Option<Vec<Zone>>,
    pub(super) others: [Option<Space>; 2],
    /// Of the surface that is being measured.
    pub(super) measuring: Measuring,
    pub(super) done: Vec<Vec<Calibre>>,
    /// What the vessel has at each station of the opened surface, in mm.
    pub(super) radii: Vec<f64>,
}
