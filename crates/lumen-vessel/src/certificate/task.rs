//! The certificate in slices: an index of each surface, the tree in the opened one, and the calibre of all three along it.

use std::sync::Arc;

use super::Certificate;
use super::basis::{Basis, Measure};
use super::unit::{CalibreError, checked};
use crate::balls::mean_edge;
use crate::calibre::{Calibre, Indexing, Known, Measuring, Subject, circle};
use crate::recentring::recentre;
use crate::space::Space;
use crate::stations::{Station, Stations};
use crate::tree::TreeTask;
use crate::zones::zones;
use lumen_mesh::task::{Budget, Progress, Task};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh};

/// Makes a certificate in slices.
pub struct CertificateTask {
    subjects: [Subject; 3],
    tolerance_percent: f64,
    indices: [Indexing; 3],
    step: Step,
    /// What the certificate was made from, once it is.
    made_from: Option<Box<Measure>>,
}

enum Step {
    Index,
    Spaces(Box<[Arc<SurfaceIndex>; 3]>, Vec<Space>),
    Tree(Box<[Space; 2]>, Box<TreeTask<Arc<TriMesh>, Arc<Topology>>>),
    Measure(Box<Measure>),
}

impl CertificateTask {
    /// Of the surface as it was opened, smoothed and reduced; `tolerance_percent` is the change that is allowed.
    pub fn new(subjects: [Subject; 3], tolerance_percent: f64) -> Self {
        let indices = [0, 1, 2].map(|i| Indexing::new(&subjects[i]));
        Self { subjects, tolerance_percent, indices, step: Step::Index, made_from: None }
    }

    /// What else can be judged by what this certificate was made from; `None` where there is none.
    pub fn into_basis(mut self) -> Option<Basis> {
        let measure = self.made_from.take()?;
        Some(self.basis(measure))
    }

    /// Whether the reduced surface is the smoothed one: then it is measured once.
    fn is_reduced_smoothed(&self) -> bool {
        Arc::ptr_eq(&self.subjects[1].mesh, &self.subjects[2].mesh)
    }

    fn basis(&self, measure: Box<Measure>) -> Basis {
        let edge_mm = f64::from(mean_edge(&self.subjects[0].mesh));
        Basis { measure, smoothed: self.subjects[1].clone(), edge_mm }
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
                    let stations = Stations::new(&tree);
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
                    let known = done.last().map(|calibres| Known {
                        radii: &radii[..],
                        before: &self.subjects[done.len() - 1],
                        calibres,
                    });
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
