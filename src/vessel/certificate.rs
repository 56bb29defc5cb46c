//! The certificate of calibre: what smoothing and reduction made of each branch of a vessel tree.
//!
//! Stations are taken along the centrelines of the surface as it was opened, and all three surfaces are cut there by
//! the same planes. What is compared is the radius of the circle of the same area,
//!
//! ```text
//! r(s) = sqrt( mean of A over s - r .. s + r / pi )
//! ```
//!
//! with the mean weighted by `1 - |s - t| / r`. The mean is over the same stretch on all surfaces, so that a taper does not
//! tell in the change from one to another; in the radius that is shown, where there is more of the vessel on one side than
//! on the other, the line of least squares stands in its place. The area of one cross-section of a
//! stair-stepped surface jumps by whole rows of voxels as the plane goes on, that of a stretch as long as the vessel is
//! wide does not, and to the first order steps in and out of the wall leave it as it is. The inscribed radius, which
//! stands beside it, does not have that property: steps that stand in make the ball smaller by a part of a voxel, and
//! smoothing gives that back, though the calibre is the same.
//!
//! A change counts where the vessel can be measured: see [`zones`](super::zones) for ends and forks; where the cut
//! closes on the opened surface; and where the vessel is at least two mean edges wide. Where the others are open or
//! folded in the plane, there is no saying. Where they have no vessel any more, the change is -100 %.

use std::fmt::Write as _;
use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::TreeError;
use super::balls::mean_edge;
use super::calibre::{Calibre, Indexing, Measuring, Subject};
use super::centrelines::Centrelines;
use super::recentring::recentre;
use super::space::Space;
use super::stations::{Station, Stations};
use super::tree::{Branch, Located, Tree, TreeTask};
use super::zones::{Zone, zones};
use crate::mesh::{SurfaceIndex, Topology, TriMesh};
use crate::task::{Budget, Progress, Task};

/// The change in percent that a vessel is allowed, unless it is said otherwise.
pub const TOLERANCE_PERCENT: f64 = 2.0;
/// Diameters in mm of the widest vessel of a surface: others are of another unit.
const DIAMETERS_MM: std::ops::RangeInclusive<f64> = 0.2..=200.0;
/// Least half length of the stretch that a radius is of, in mean edges.
const WINDOW_EDGES: f64 = 4.0;
/// The least part of the mean over its stretch that an area can be.
const LEAST_OF_MEAN: f64 = 0.25;
/// A vessel is measured from so many mean edges of diameter on.
const EDGES: f64 = 2.0;

/// Why there is no certificate.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CalibreError {
    /// There is no tree.
    #[error(transparent)]
    Tree(#[from] TreeError),
    /// No vessel is as wide as that.
    #[error(
        "the widest vessel is {diameter_mm:.3} mm across: the surface is probably not in the unit that it was opened in"
    )]
    Unit {
        /// Diameter of the widest vessel in mm.
        diameter_mm: f64,
    },
}

/// What is found of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Nowhere more change than the tolerance.
    Kept,
    /// More change than the tolerance.
    Changed,
    /// The vessel can nowhere be measured.
    NotMeasured,
}

/// Why a station does not count, or that it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    /// It counts.
    Counts,
    /// Within a radius of an end.
    End,
    /// At a fork.
    Fork,
    /// The vessel is less than two mean edges wide.
    Thin,
    /// One of the surfaces has no closed loop around the centreline there.
    NotClosed,
}

/// Least, mean and largest of something.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Least.
    pub least: f64,
    /// Mean over the length.
    pub mean: f64,
    /// Largest.
    pub largest: f64,
}

/// A change of calibre.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// Change of the radius in percent of what it was.
    pub percent: f64,
    /// Where, in mm.
    pub at_mm: [f32; 3],
    /// Arc length there, from the first point of the branch, in mm.
    pub abscissa_mm: f64,
}

/// A branch on one of the surfaces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OnSurface {
    /// Radius of the circle of the same area, in mm, over what is one vessel; null where no cut closes.
    pub radius_mm: Option<Spread>,
    /// Radius of the largest ball inside, in mm, over the same.
    pub inscribed_radius_mm: Option<Spread>,
    /// The largest change of the radius from the opened surface; null for that itself, and where nothing can be measured.
    pub largest_change: Option<Change>,
    /// Area of the cross-section at each station, in mm2; null where the cut does not close.
    pub areas_mm2: Vec<Option<f32>>,
    /// Radius of the circle of the same area at each station, in mm; null likewise.
    pub radii_mm: Vec<Option<f32>>,
    /// Radius of the largest ball inside at each station, in mm; null where the centreline is not inside.
    pub inscribed_radii_mm: Vec<Option<f32>>,
    /// Change of the radius from the opened surface at each station, in percent; null where the station does not count, and
    /// for the opened surface.
    #[serde(default)]
    pub changes_percent: Vec<Option<f32>>,
}

/// A branch of the vessel tree, on all three surfaces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchCalibre {
    /// 1 for the first.
    pub number: u32,
    /// "branch 1" for the first.
    pub name: String,
    /// Number of the branch that it comes out of; null for the first of a tree.
    pub parent: Option<u32>,
    /// Length of the centreline in mm.
    pub length_mm: f64,
    /// Length over the distance of the ends; null where they are at one place.
    pub tortuosity: Option<f64>,
    /// Whether the reduced surface keeps it within the tolerance.
    pub verdict: Verdict,
    /// Whether the smoothed surface does.
    pub verdict_smoothed: Verdict,
    /// Stations that count.
    pub stations_counted: usize,
    /// Arc length at each station, from the first point of the branch, in mm.
    pub abscissas_mm: Vec<f32>,
    /// Each station, in mm.
    pub at_mm: Vec<[f32; 3]>,
    /// Whether each counts, and why not.
    pub standings: Vec<Standing>,
    /// As opened.
    pub opened: OnSurface,
    /// Smoothed.
    pub smoothed: OnSurface,
    /// Reduced.
    pub reduced: OnSurface,
}

/// What became of all branches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The change in percent that is allowed.
    pub tolerance_percent: f64,
    /// Changed where one branch is; kept where the others are.
    pub verdict: Verdict,
    /// The branches, a parent before its branches.
    pub branches: Vec<BranchCalibre>,
}

impl Certificate {
    /// Of these branches, which were judged by this tolerance.
    pub(crate) fn new(branches: Vec<BranchCalibre>, tolerance_percent: f64) -> Self {
        let has = |verdict: Verdict| branches.iter().any(|branch| branch.verdict == verdict);
        let verdict = if has(Verdict::Changed) {
            Verdict::Changed
        } else if has(Verdict::Kept) {
            Verdict::Kept
        } else {
            Verdict::NotMeasured
        };
        Self { tolerance_percent, verdict, branches }
    }

    /// A row a station, in the order of the branches. A field is empty where a cross-section does not close.
    pub fn csv(&self) -> String {
        let mut text = "branch,abscissa_mm,x_mm,y_mm,z_mm,standing,area_opened_mm2,area_smoothed_mm2,area_reduced_mm2,\
                        radius_opened_mm,radius_smoothed_mm,radius_reduced_mm,change_smoothed_percent,\
                        change_reduced_percent\n"
            .to_owned();
        for branch in &self.branches {
            for i in 0..branch.abscissas_mm.len() {
                let [x, y, z] = branch.at_mm[i];
                let (number, at, standing) = (branch.number, branch.abscissas_mm[i], branch.standings[i].label());
                let _ = write!(text, "{number},{at:.4},{x:.4},{y:.4},{z:.4},{standing}");
                let surfaces = [&branch.opened, &branch.smoothed, &branch.reduced];
                let areas = surfaces.map(|of| of.areas_mm2[i]);
                let radii = surfaces.map(|of| of.radii_mm[i]);
                let changes = [&branch.smoothed, &branch.reduced].map(|of| of.changes_percent[i]);
                for value in areas.into_iter().chain(radii).chain(changes) {
                    let _ = match value {
                        Some(value) => write!(text, ",{value:.5}"),
                        None => write!(text, ","),
                    };
                }
                text.push('\n');
            }
        }
        text
    }
}

/// The part of these vessels that is measured, by stations, in percent; `None` without a station.
pub fn measured_percent(branches: &[BranchCalibre]) -> Option<f64> {
    let counted: usize = branches.iter().map(|branch| branch.stations_counted).sum();
    let all: usize = branches.iter().map(|branch| branch.standings.len()).sum();
    (all > 0).then(|| 100.0 * counted as f64 / all as f64)
}

impl Standing {
    /// As tables have it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Counts => "counts",
            Self::End => "end",
            Self::Fork => "fork",
            Self::Thin => "thin",
            Self::NotClosed => "not_closed",
        }
    }
}

/// Makes a certificate in slices.
pub struct CertificateTask {
    subjects: [Subject; 3],
    tolerance_percent: f64,
    indices: [Indexing; 3],
    step: Step,
    /// What the certificate was made from, once it is.
    made_from: Option<Box<Measure>>,
}

/// What more reduced surfaces are judged by: where the opened surface is measured, and what it and the smoothed one have
/// there.
pub struct Basis {
    measure: Box<Measure>,
    edge_mm: f64,
}

/// A reduced surface that is measured where a [`Basis`] is.
pub(crate) struct Candidate {
    subject: Subject,
    indexing: Indexing,
    measuring: Option<Measuring>,
}

impl Candidate {
    pub(crate) fn new(subject: Subject) -> Self {
        Self { indexing: Indexing::new(&subject), measuring: None, subject }
    }

    /// Measures until `budget` is spent; then the calibre of each branch, if all is measured.
    pub(crate) fn advance(
        &mut self,
        basis: &Basis,
        tolerance_percent: f64,
        budget: Budget,
    ) -> Option<Vec<BranchCalibre>> {
        let Subject { mesh, topology, .. } = &self.subject;
        if self.measuring.is_none() {
            let index = self.indexing.advance(mesh, budget)?;
            self.measuring = Some(Measuring::new(&self.subject, Space::new(mesh, topology, index)));
        }
        let measuring = self.measuring.as_mut()?;
        let Measure { stations, radii, .. } = &*basis.measure;
        measuring.advance(&stations.all, Some(radii), budget).then(|| basis.judged(&measuring.found, tolerance_percent))
    }
}

impl Basis {
    /// The calibre of each branch where nothing is reduced: the surface is the smoothed one.
    pub(crate) fn of_smoothed(&self, tolerance_percent: f64) -> Vec<BranchCalibre> {
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
    pub(crate) fn beside(&self, p: DVec3, last: &mut Option<Located>) -> Option<(usize, usize, f64)> {
        let Measure { tree, stations, .. } = &*self.measure;
        let found = tree.locate(p, last.as_ref())?;
        let branch = found.branch as usize;
        let own = &stations.all[stations.of.get(branch)?.clone()];
        let after = own.partition_point(|station| station.abscissa_mm < found.arc_mm);
        let nearer = |&i: &usize| (own[i].abscissa_mm - found.arc_mm).abs();
        let station =
            (after.saturating_sub(1)..(after + 1).min(own.len())).min_by(|a, b| nearer(a).total_cmp(&nearer(b)));
        let radii = found.distance_mm / found.radius_mm.max(f64::MIN_POSITIVE);
        *last = Some(found);
        Some((branch, station?, radii))
    }

    /// The calibre of each branch, on a surface that has `reduced` at the stations.
    fn judged(&self, reduced: &[Calibre], tolerance_percent: f64) -> Vec<BranchCalibre> {
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

enum Step {
    Index,
    Spaces(Box<[Arc<SurfaceIndex>; 3]>, Vec<Space>),
    Tree(Box<[Space; 2]>, Box<TreeTask<Arc<TriMesh>, Arc<Topology>>>),
    Measure(Box<Measure>),
}

struct Measure {
    tree: Tree,
    stations: Stations,
    /// Of each station, once the opened surface was measured a first time.
    zones: Option<Vec<Zone>>,
    others: [Option<Space>; 2],
    /// Of the surface that is being measured.
    measuring: Measuring,
    done: Vec<Vec<Calibre>>,
    /// What the vessel has at each station of the opened surface, in mm.
    radii: Vec<f64>,
}

impl CertificateTask {
    /// Of the surface as it was opened, smoothed and reduced; `tolerance_percent` is the change that is allowed.
    pub fn new(subjects: [Subject; 3], tolerance_percent: f64) -> Self {
        let indices = [0, 1, 2].map(|i| Indexing::new(&subjects[i]));
        Self { subjects, tolerance_percent, indices, step: Step::Index, made_from: None }
    }

    /// What else can be judged by what this certificate was made from; `None` where there is none.
    pub(crate) fn into_basis(mut self) -> Option<Basis> {
        let measure = self.made_from.take()?;
        Some(self.basis(measure))
    }

    /// Whether the reduced surface is the smoothed one: then it is measured once.
    fn is_reduced_smoothed(&self) -> bool {
        Arc::ptr_eq(&self.subjects[1].mesh, &self.subjects[2].mesh)
    }

    fn basis(&self, measure: Box<Measure>) -> Basis {
        let edge_mm = f64::from(mean_edge(&self.subjects[0].mesh));
        Basis { measure, edge_mm }
    }

    fn found(&mut self, measure: Box<Measure>) -> Certificate {
        let basis = self.basis(measure);
        let branches = basis.judged(&basis.measure.done[2], self.tolerance_percent);
        self.made_from = Some(basis.measure);
        Certificate::new(branches, self.tolerance_percent)
    }
}

impl Task for CertificateTask {
    type Output = Result<Certificate, CalibreError>;

    fn advance(&mut self, budget: Budget) -> Progress<Self::Output> {
        loop {
            match std::mem::replace(&mut self.step, Step::Index) {
                Step::Index => {
                    let mut all = Vec::with_capacity(3);
                    let is_same = self.is_reduced_smoothed();
                    for (i, (indexing, subject)) in self.indices.iter_mut().zip(&self.subjects).enumerate() {
                        if i == 2 && is_same {
                            all.push(Arc::clone(&all[1]));
                            continue;
                        }
                        match indexing.advance(&subject.mesh, budget) {
                            Some(index) => all.push(index),
                            None => return Progress::Working(0.1 * all.len() as f32 / 3.0),
                        }
                    }
                    let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|i| all.get(i).cloned()) else { continue };
                    self.step = Step::Spaces(Box::new([a, b, c]), Vec::new());
                }
                Step::Spaces(indices, mut spaces) => {
                    let Subject { mesh, topology, .. } = &self.subjects[1 + spaces.len()];
                    spaces.push(Space::new(mesh, topology, indices[1 + spaces.len()].clone()));
                    self.step = match <[Space; 2]>::try_from(spaces) {
                        Ok(spaces) => {
                            let Subject { mesh, topology, .. } = self.subjects[0].clone();
                            let [index, ..] = *indices;
                            Step::Tree(Box::new(spaces), Box::new(TreeTask::new(mesh, topology, index)))
                        }
                        Err(spaces) => Step::Spaces(indices, spaces),
                    };
                }
                Step::Tree(others, mut task) => {
                    let opened = &self.subjects[0];
                    let tree = match task.advance(budget) {
                        Progress::Working(fraction) => {
                            self.step = Step::Tree(others, task);
                            return Progress::Working(0.1 + 0.4 * fraction);
                        }
                        Progress::Done(tree) => tree,
                    };
                    let tree = match checked(tree) {
                        Ok(tree) => tree,
                        Err(error) => return Progress::Done(Err(error)),
                    };
                    let stations = Stations::new(tree.branches());
                    let measuring = Measuring::new(opened, tree.space.clone());
                    let others = others.map(Some);
                    let (done, radii) = (Vec::new(), Vec::new());
                    self.step = Step::Measure(Box::new(Measure {
                        tree,
                        stations,
                        zones: None,
                        others,
                        measuring,
                        done,
                        radii,
                    }));
                }
                Step::Measure(mut measure) => {
                    let Measure { tree, stations, zones: found, others, measuring, done, radii } = &mut *measure;
                    let known = (!done.is_empty()).then_some(&radii[..]);
                    if measuring.advance(&stations.all, known, budget) {
                        let calibres = std::mem::take(&mut measuring.found);
                        if found.is_none() {
                            // Once more, where the stations are moved to: all three surfaces are cut by the same planes.
                            let own: Vec<Option<f64>> =
                                calibres.iter().map(|found| found.area_mm2.map(circle)).collect();
                            let zones = found.insert(zones(tree.branches(), stations, &own));
                            recentre(stations, &calibres, zones);
                        } else {
                            if done.is_empty() {
                                let radius = |(station, found): (&Station, &Calibre)| {
                                    found.area_mm2.map_or(station.radius_mm, circle).max(station.radius_mm)
                                };
                                *radii = stations.all.iter().zip(&calibres).map(radius).collect();
                            }
                            done.push(calibres);
                            if done.len() == 2 && self.is_reduced_smoothed() {
                                done.extend_from_within(1..);
                                return Progress::Done(Ok(self.found(measure)));
                            }
                            match others.get_mut(done.len() - 1).and_then(Option::take) {
                                Some(space) => *measuring = Measuring::new(&self.subjects[done.len()], space),
                                None => return Progress::Done(Ok(self.found(measure))),
                            }
                        }
                    }
                    let passes = usize::from(measure.zones.is_some()) + measure.done.len();
                    let part = (passes as f32 + measure.measuring.fraction(&measure.stations.all)) / 4.0;
                    self.step = Step::Measure(measure);
                    if budget.is_spent() {
                        return Progress::Working(0.5 + 0.5 * part);
                    }
                    continue;
                }
            }
            if budget.is_spent() {
                return Progress::Working(0.1);
            }
        }
    }
}

/// A tree of vessels as wide as vessels are.
pub(super) fn checked(tree: Result<Tree, TreeError>) -> Result<Tree, CalibreError> {
    let tree = tree?;
    let radii = tree.branches().iter().flat_map(|branch| branch.points.iter().map(|place| place.radius));
    let diameter_mm = 2.0 * radii.fold(0.0, f64::max);
    if DIAMETERS_MM.contains(&diameter_mm) { Ok(tree) } else { Err(CalibreError::Unit { diameter_mm }) }
}

/// The radius of the circle of an area.
pub(super) fn circle(area: f64) -> f64 {
    (area / std::f64::consts::PI).sqrt()
}

fn branch_calibre(
    branch: &Branch,
    stations: &[Station],
    zones: &[Zone],
    calibres: [&[Calibre]; 3],
    edge_mm: f64,
    tolerance_percent: f64,
) -> BranchCalibre {
    let standing = |i: usize| {
        let areas = calibres.map(|of| of[i].area_mm2);
        match (zones[i], areas) {
            (Zone::End, _) => Standing::End,
            (Zone::Fork, _) => Standing::Fork,
            (Zone::Vessel, [Some(opened), Some(_), Some(_)]) if 2.0 * circle(opened) >= EDGES * edge_mm => {
                Standing::Counts
            }
            (Zone::Vessel, [Some(_), Some(_), Some(_)]) => Standing::Thin,
            (Zone::Vessel, _) => Standing::NotClosed,
        }
    };
    let standings: Vec<Standing> = (0..stations.len()).map(standing).collect();
    // Of a branch that is nowhere one vessel, all of it.
    let is_vessel = |standing: &Standing| matches!(standing, Standing::Counts | Standing::Thin);
    let has_vessel = standings.iter().any(is_vessel);
    let shown: Vec<usize> = (0..stations.len()).filter(|&i| !has_vessel || is_vessel(&standings[i])).collect();
    let stretches = calibres.map(|of| stretches(stations, of, calibres[0], &standings, edge_mm));
    let radii = |surface: usize| stretches[surface].iter().map(|stretch| stretch.map(|stretch| stretch.radius));
    let of = |surface: usize| {
        let change = |i: usize| {
            let is_counted = surface > 0 && standings[i] == Standing::Counts;
            let [before, after] = [0, surface].map(|surface| stretches[surface][i].filter(|_| is_counted));
            Some(100.0 * (after?.mean / before?.mean.max(f64::MIN_POSITIVE) - 1.0))
        };
        let changes: Vec<Option<f64>> = (0..stations.len()).map(change).collect();
        let all = changes.iter().enumerate().filter_map(|(i, change)| Some(((*change)?, i)));
        let most = all.reduce(|most, next| if next.0.abs() > most.0.abs() { next } else { most });
        let largest_change = most.map(|(percent, i)| Change {
            percent,
            at_mm: stations[i].at.as_vec3().to_array(),
            abscissa_mm: stations[i].abscissa_mm,
        });
        let single = |value: Option<f64>| value.map(|value| value as f32);
        OnSurface {
            radius_mm: spread(shown.iter().filter_map(|&i| Some(stretches[surface][i]?.radius))),
            inscribed_radius_mm: spread(shown.iter().filter_map(|&i| calibres[surface][i].inscribed_mm)),
            largest_change,
            areas_mm2: calibres[surface].iter().map(|found| single(found.area_mm2)).collect(),
            radii_mm: radii(surface).map(single).collect(),
            inscribed_radii_mm: calibres[surface].iter().map(|found| single(found.inscribed_mm)).collect(),
            changes_percent: changes.into_iter().map(single).collect(),
        }
    };
    let [opened, smoothed, reduced] = [0, 1, 2].map(of);
    let verdict = |of: &OnSurface| match of.largest_change {
        None => Verdict::NotMeasured,
        Some(change) if change.percent.abs() <= tolerance_percent => Verdict::Kept,
        Some(_) => Verdict::Changed,
    };
    let ends = stations.first().zip(stations.last()).map_or(0.0, |(from, to)| from.at.distance(to.at));
    let length_mm = stations.last().map_or(0.0, |station| station.abscissa_mm);
    BranchCalibre {
        number: branch.id + 1,
        name: branch.name.clone(),
        parent: branch.parent.map(|parent| parent + 1),
        length_mm,
        tortuosity: (ends > 1e-6 * length_mm).then(|| length_mm / ends),
        verdict: verdict(&reduced),
        verdict_smoothed: verdict(&smoothed),
        stations_counted: standings.iter().filter(|&&standing| standing == Standing::Counts).count(),
        abscissas_mm: stations.iter().map(|station| station.abscissa_mm as f32).collect(),
        at_mm: stations.iter().map(|station| station.at.as_vec3().to_array()).collect(),
        standings,
        opened,
        smoothed,
        reduced,
    }
}

/// What a vessel has over a stretch around a station.
#[derive(Clone, Copy)]
struct Stretch {
    /// Radius of the circle of the area at the station, by the line of least squares, in mm.
    radius: f64,
    /// Of the circle of the mean area, in mm.
    mean: f64,
}

/// What a branch has around each station on one of the surfaces, over stations of one vessel, where all surfaces have an
/// area: so all are judged over the same. At the station alone where it is not one vessel.
fn stretches(
    stations: &[Station],
    of: &[Calibre],
    opened: &[Calibre],
    standings: &[Standing],
    edge_mm: f64,
) -> Vec<Option<Stretch>> {
    let is_vessel = |i: usize| matches!(standings[i], Standing::Counts | Standing::Thin);
    let one = |i: usize| {
        let own = of[i].area_mm2?;
        if !is_vessel(i) {
            return Some(Stretch { radius: circle(own), mean: circle(own) });
        }
        let reach = circle(opened[i].area_mm2?).max(WINDOW_EDGES * edge_mm);
        let (mut line, mut as_opened) = (Line::default(), Line::default());
        let mut add = |k: usize| {
            let from = stations[k].abscissa_mm - stations[i].abscissa_mm;
            let weight = 1.0 - from.abs() / reach.max(f64::MIN_POSITIVE);
            let Some(area) = of[k].area_mm2.filter(|_| weight > 0.0) else { return false };
            line.add(from, area, weight);
            as_opened.add(from, opened[k].area_mm2.unwrap_or(area), weight);
            true
        };
        // As far on either side as it is one vessel.
        let before = (0..i).rev().take_while(|&k| is_vessel(k));
        let after = (i..stations.len()).take_while(|&k| is_vessel(k));
        for k in before {
            if !add(k) {
                break;
            }
        }
        for k in after {
            if !add(k) {
                break;
            }
        }
        // A line that comes down to nothing says nothing: then the mean does, on all surfaces alike.
        let is_line = as_opened.at_origin() >= LEAST_OF_MEAN * as_opened.mean();
        let area = if is_line { line.at_origin().max(0.0) } else { line.mean() };
        Some(Stretch { radius: circle(area), mean: circle(line.mean()) })
    };
    (0..stations.len()).map(one).collect()
}

/// The line through weighted points that is nearest to them (local linear regression).
#[derive(Default)]
struct Line {
    weights: f64,
    first: f64,
    second: f64,
    sum: f64,
    moment: f64,
}

impl Line {
    fn add(&mut self, x: f64, y: f64, weight: f64) {
        self.weights += weight;
        self.first += weight * x;
        self.second += weight * x * x;
        self.sum += weight * y;
        self.moment += weight * x * y;
    }

    /// The weighted mean of the heights.
    fn mean(&self) -> f64 {
        self.sum / self.weights
    }

    /// Its height at x = 0.
    fn at_origin(&self) -> f64 {
        let determinant = self.weights * self.second - self.first * self.first;
        if determinant > 1e-9 * self.weights * self.second {
            (self.second * self.sum - self.first * self.moment) / determinant
        } else {
            self.mean()
        }
    }
}

fn spread(values: impl Iterator<Item = f64>) -> Option<Spread> {
    let (mut count, mut sum, mut least, mut largest) = (0usize, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        (count, sum, least, largest) = (count + 1, sum + value, least.min(value), largest.max(value));
    }
    (count > 0).then(|| Spread { least, mean: sum / count as f64, largest })
}
