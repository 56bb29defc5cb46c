//! What reduced surfaces are judged by: where the opened surface is measured, and what it and the smoothed one have there.

use std::sync::Arc;

use glam::DVec3;

use super::branch::branch_calibre;
use super::unit::{CalibreError, checked};
use super::{BranchCalibre, Certificate};
use crate::calibre::{Asked, Calibre, Known, Subject, measure};
use crate::centrelines::{Centrelines, settled};
use crate::locating::Located;
use crate::stations::{Station, Stations};
use crate::tree::{Branch, Tree};
use crate::width::circle;
use crate::zones::Zone;
use lumen_mesh::task::Yielder;
use lumen_mesh::{SurfaceIndex, mean_edge, refitted};

/// What more reduced surfaces are judged by: where the opened surface is measured, and what it and the smoothed one have
/// there.
pub struct Basis {
    tree: Tree,
    stations: Stations,
    /// Of each station.
    zones: Vec<Zone>,
    /// What the opened and the smoothed surface have at each station.
    calibres: [Vec<Calibre>; 2],
    /// What the vessel has at each station of the opened surface, in mm.
    radii: Vec<f64>,
    smoothed: Subject,
    /// Mean length of an edge of the opened surface.
    edge_mm: f64,
}

impl Certificate {
    /// Of the surface as it was opened, smoothed and reduced; `tolerance_percent` is the change that is allowed.
    ///
    /// # Errors
    /// [`CalibreError`] where there are no vessels in the opened surface.
    pub async fn of(
        [opened, smoothed, reduced]: [Subject; 3],
        tolerance_percent: f64,
        yielder: &Yielder,
    ) -> Result<Self, CalibreError> {
        let is_reduced = !Arc::ptr_eq(&smoothed.mesh, &reduced.mesh);
        let basis = Basis::find(opened, smoothed, &yielder.part(0.0..0.8)).await?;
        let branches = if is_reduced {
            basis.measured(&reduced, Asked::SectionAndBall, tolerance_percent, &yielder.part(0.8..1.0)).await
        } else {
            basis.of_smoothed(tolerance_percent)
        };
        Ok(Self::new(branches, tolerance_percent, basis.openings_without_branch()))
    }
}

impl Basis {
    /// How many open ends of the surface as opened no branch leads to.
    pub fn openings_without_branch(&self) -> usize {
        self.tree.openings_without_branch()
    }

    /// Finds the vessels of the surface as it was opened, and measures them there and on the smoothed one.
    ///
    /// # Errors
    /// [`CalibreError`] where there are none.
    pub async fn find(mut opened: Subject, mut smoothed: Subject, yielder: &Yielder) -> Result<Self, CalibreError> {
        let index = SurfaceIndex::known_or_built(opened.index.take(), &opened.mesh, &yielder.part(0.0..0.05)).await;
        opened.index = Some(index.clone());
        let Subject { mesh, topology, .. } = &opened;
        let part = yielder.part(0.05..0.5);
        let tree = checked(Tree::with_topology_in_slices(mesh, topology, index.clone(), &part).await)?;
        let (stations, zones, of_opened) = settled(&opened, &tree, &yielder.part(0.5..0.8)).await;
        let radius = |(station, found): (&Station, &Calibre)| {
            found.area_mm2.map_or(station.radius_mm, circle).max(station.radius_mm)
        };
        let radii: Vec<f64> = stations.all.iter().zip(&of_opened).map(radius).collect();

        if smoothed.index.is_none() && smoothed.mesh.triangles == mesh.triangles {
            smoothed.index = Some(Arc::new(refitted(&index, &smoothed.mesh, &yielder.part(0.8..0.82)).await));
        }
        let space = smoothed.space(&yielder.part(0.82..0.85)).await;
        // From here on only the surface is asked for.
        smoothed.index = None;
        let known = Known { radii: &radii, before: &opened, calibres: &of_opened };
        let of_smoothed =
            measure(&smoothed, &space, &stations.all, (Asked::SectionAndBall, Some(known)), &yielder.part(0.85..1.0))
                .await;
        let edge_mm = f64::from(mean_edge(mesh));
        Ok(Self { tree, stations, zones, calibres: [of_opened, of_smoothed], radii, smoothed, edge_mm })
    }

    /// The calibre of each branch on a surface that was made from the smoothed one.
    pub async fn measured(
        &self,
        subject: &Subject,
        asked: Asked,
        tolerance_percent: f64,
        yielder: &Yielder,
    ) -> Vec<BranchCalibre> {
        let space = subject.space(&yielder.part(0.0..0.3)).await;
        let known = Known { radii: &self.radii, before: &self.smoothed, calibres: &self.calibres[1] };
        let part = yielder.part(0.3..1.0);
        let found = measure(subject, &space, &self.stations.all, (asked, Some(known)), &part).await;
        self.judged(&found, tolerance_percent)
    }

    /// The calibre of each branch where nothing is reduced: the surface is the smoothed one.
    pub fn of_smoothed(&self, tolerance_percent: f64) -> Vec<BranchCalibre> {
        self.judged(&self.calibres[1], tolerance_percent)
    }

    /// The centrelines of the opened surface, with its calibre.
    pub fn centrelines(&self) -> Centrelines {
        Centrelines {
            branches: self.tree.branches().to_vec(),
            stations: self.stations.clone(),
            calibres: self.calibres[0].clone(),
            zones: self.zones.clone(),
            bumps: self.tree.bumps,
            openings_without_branch: self.openings_without_branch(),
        }
    }

    /// The branch and the number of the station on it that `p` is beside, and how far `p` is from the centreline there,
    /// in radii of the vessel. `last` is what [`Tree::locate`] found for a point near by; it makes this faster.
    pub fn beside(&self, p: DVec3, last: &mut Option<Located>) -> Option<(usize, usize, f64)> {
        let Self { tree, stations, .. } = self;
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
    fn judged(&self, reduced: &[Calibre], tolerance_percent: f64) -> Vec<BranchCalibre> {
        let Self { tree, stations, zones, calibres: [opened, smoothed], .. } = self;
        let of = |(branch, range): (&Branch, &std::ops::Range<usize>)| {
            let own = range.clone();
            let calibres = [&opened[own.clone()], &smoothed[own.clone()], &reduced[own.clone()]];
            let (stations, zones) = (&stations.all[own.clone()], &zones[own]);
            branch_calibre(branch, stations, zones, calibres, self.edge_mm, tolerance_percent)
        };
        tree.branches().iter().zip(&stations.of).map(of).collect()
    }
}
