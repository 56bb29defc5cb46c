//! What is done to a level for a solver, and what came of it. It draws nothing.

use std::sync::Arc;

use crate::app::document::Revision;
use crate::engine::{CutsPlanned, PlannedCuts, Ready, SolverReady};
use crate::mesh::TriMesh;
use crate::prepare::cuts::{ClipAt, Cut};
use crate::prepare::notes::PrepareError;
use crate::prepare::prepare::Plan;
use crate::render::ColourMap;

/// A surface that was made ready.
#[derive(Debug)]
pub struct Made {
    /// The number of the command.
    pub id: u64,
    /// The level that it was made of.
    pub(in crate::app) of: Level,
    /// What it was made by.
    pub plan: Plan,
    /// What the engine made.
    pub ready: Ready,
    /// The surface as it is drawn: no two patches have a vertex in common, so that each has a colour and normals of its own.
    pub mesh: Arc<TriMesh>,
    /// For each vertex of that the number of its end, from 0; no number on the wall.
    pub ends: Arc<Vec<f32>>,
}

/// Where the ends of a level are cut.
#[derive(Debug)]
pub struct Planned {
    /// What it was found by.
    pub(in crate::app) of: CutsOf,
    /// What the engine found.
    pub found: PlannedCuts,
    /// The surface as it is drawn, as that of [`Made`]: what goes with an end is a patch.
    pub mesh: Arc<TriMesh>,
    /// For each vertex of that the number of the end that it goes with, from 0; no number where it stays.
    pub ends: Arc<Vec<f32>>,
}

/// Which cuts of which level.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct CutsOf {
    level: Level,
    wrap: Option<f64>,
    clip: Option<ClipAt>,
    cuts: Vec<Cut>,
}

/// What is shown in place of the level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Where its ends are cut.
    Cuts,
    /// What was made of it.
    Made,
}

/// Which level of which document.
pub(in crate::app) type Level = (u64, u64, u64);

/// The level that is shown.
pub(in crate::app) fn level(revision: Revision) -> Level {
    (revision.document, revision.levels, revision.shown)
}

/// What was asked for, and what there is.
#[derive(Debug)]
pub struct Preparation {
    /// What is done to a level.
    pub plan: Plan,
    /// What is shown in place of the level.
    pub shown: Option<Shown>,
    /// What the engine works on: the number of the command, and the level.
    asked: Option<(u64, Level)>,
    /// The cuts that it is to find.
    asked_cuts: Option<(u64, CutsOf)>,
    /// Those that it found last.
    pub planned: Option<Planned>,
    /// What it made last.
    pub made: Option<Made>,
    /// Why it could not.
    pub failure: Option<PrepareError>,
}

impl Default for Preparation {
    fn default() -> Self {
        let (shown, asked, asked_cuts) = (None, None, None);
        Self { plan: Plan::flow(), shown, asked, asked_cuts, planned: None, made: None, failure: None }
    }
}

impl Preparation {
    /// Whether the engine makes a level ready.
    pub fn is_busy(&self) -> bool {
        self.asked.is_some()
    }

    /// Whether the engine works on it, or on its cuts.
    pub(in crate::app) fn is_worked_on(&self) -> bool {
        self.is_busy() || self.asked_cuts.is_some()
    }

    /// Notes what was asked for under this number, in place of all before.
    pub(in crate::app) fn ask(&mut self, id: u64, of: Level) {
        (self.asked, self.asked_cuts, self.failure) = (Some((id, of)), None, None);
    }

    /// Whether the cuts of this level are to be asked for: they are to be shown and are not known. What the engine works on
    /// is awaited first.
    pub(in crate::app) fn wants_cuts(&self, level: Level) -> bool {
        let is_known = || self.planned.as_ref().is_some_and(|planned| planned.of == self.cuts_of(level));
        self.shown == Some(Shown::Cuts) && !self.is_worked_on() && !is_known()
    }

    /// Notes that the cuts of this level are asked for under this number.
    pub(in crate::app) fn ask_cuts(&mut self, id: u64, level: Level) {
        self.asked_cuts = Some((id, self.cuts_of(level)));
    }

    fn cuts_of(&self, level: Level) -> CutsOf {
        CutsOf { level, wrap: self.plan.wrap, clip: self.plan.clip, cuts: self.plan.cuts.clone() }
    }

    /// Waits for nothing more. Whether it did.
    pub(in crate::app) fn give_up(&mut self) -> bool {
        if self.asked_cuts.take().is_some() && self.shown == Some(Shown::Cuts) {
            // They would be asked for again.
            self.shown = None;
        }
        self.asked.take().is_some()
    }

    /// Forgets all but the plan: another surface is open.
    pub(in crate::app) fn leave_surface(&mut self) {
        *self = Self { plan: std::mem::take(&mut self.plan), ..Self::default() };
    }

    /// Hears where the ends are cut. An answer to what is no longer asked for is passed over.
    pub fn receive_cuts(&mut self, CutsPlanned { id, outcome }: CutsPlanned) {
        let Some((_, of)) = self.asked_cuts.take_if(|(asked, _)| *asked == id) else { return };
        match outcome {
            Ok(found) => {
                let (mesh, ends) = drawn(&found.mesh, &found.of_triangle, found.ends.len() + 1);
                self.planned = Some(Planned { of, found, mesh: Arc::new(mesh), ends: Arc::new(ends) });
            }
            Err(error) => {
                self.failure = Some(error);
                self.shown.take_if(|shown| *shown == Shown::Cuts);
            }
        }
    }

    /// Hears what came of it, which is then shown. An answer to what is no longer asked for is passed over.
    pub fn receive(&mut self, SolverReady { id, outcome }: SolverReady) {
        let Some((_, of)) = self.asked.take_if(|(asked, _)| *asked == id) else { return };
        match outcome {
            Ok(ready) => {
                let (mesh, ends) = drawn(&ready.mesh, &ready.of_triangle, ready.patches.len());
                let plan = self.plan.clone();
                self.made = Some(Made { id, of, plan, ready, mesh: Arc::new(mesh), ends: Arc::new(ends) });
                self.shown = Some(Shown::Made);
            }
            Err(error) => self.failure = Some(error),
        }
    }

    /// The names of the patches, the wall first.
    pub fn names(&self) -> Vec<String> {
        self.made.iter().flat_map(|made| &made.ready.patches).map(|patch| patch.name.clone()).collect()
    }

    /// Calls a patch something else, of letters, digits, `_` and `-` alone. A name that another has, or none, is passed over.
    pub fn rename(&mut self, place: usize, name: &str) {
        let name: String =
            name.trim().chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect();
        let Some(made) = &mut self.made else { return };
        let patches = &mut made.ready.patches;
        if !name.is_empty() && patches.iter().all(|patch| patch.name != name) {
            patches.iter_mut().skip(place).take(1).for_each(|patch| patch.name.clone_from(&name));
        }
    }
}

/// A surface of so many patches, the wall first, of which no two have a vertex in common, and the number of the end at each
/// vertex.
fn drawn(mesh: &TriMesh, of_triangle: &[u32], patches: usize) -> (TriMesh, Vec<f32>) {
    let (mut split, mut ends) = (TriMesh::default(), Vec::new());
    let mut order: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    order.sort_by_key(|&t| of_triangle[t as usize]);
    let mut known = vec![(u32::MAX, 0); mesh.positions.len()];
    for t in order {
        let patch = of_triangle[t as usize];
        let corners = mesh.triangles[t as usize].map(|v| {
            let known = &mut known[v as usize];
            if known.0 != patch {
                *known = (patch, split.positions.len() as u32);
                split.positions.push(mesh.positions[v as usize]);
                let is_end = patch > 0 && (patch as usize) < patches;
                ends.push(if is_end { (patch - 1) as f32 } else { 2.0 * ColourMap::UNKNOWN });
            }
            known.1
        });
        split.triangles.push(corners);
    }
    (split, ends)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::tube;
    use crate::mesh::triangle_area;
    use crate::prepare::prepare::{Prepared, prepare};
    use crate::task::{Yielder, at_once};

    fn ready() -> Ready {
        let Prepared { surface, fate, notes, crossing, remeshed } =
            at_once(prepare(&tube(24, 40, 40.0, |_| 2.0), &Plan::flow(), &Yielder::never())).unwrap();
        let (mesh, of_triangle, patches) = (Arc::new(surface.mesh), surface.of_triangle, surface.patches);
        Ready { mesh, of_triangle, patches, fate, notes, crossing, remeshed }
    }

    #[test]
    fn each_patch_is_drawn_with_its_own_vertices_and_the_same_area() {
        let ready = ready();
        let (mesh, ends) = drawn(&ready.mesh, &ready.of_triangle, ready.patches.len());
        assert_eq!((mesh.triangles.len(), ends.len()), (ready.mesh.triangles.len(), mesh.positions.len()));
        for (place, patch) in ready.patches.iter().enumerate() {
            let is_of = |t: &usize| match place {
                0 => ends[mesh.triangles[*t][0] as usize] > ColourMap::UNKNOWN,
                _ => mesh.triangles[*t].iter().all(|&v| ends[v as usize] == (place - 1) as f32),
            };
            let area: f64 = (0..mesh.triangles.len()).filter(is_of).map(|t| triangle_area(mesh.corners(t))).sum();
            assert!((area / patch.area_mm2 - 1.0).abs() < 1e-9, "{}: {area} of {}", patch.name, patch.area_mm2);
        }
    }

    #[test]
    fn an_answer_counts_that_was_asked_for_and_names_stay_apart() {
        let mut preparation = Preparation::default();
        preparation.ask(5, (1, 1, 1));
        preparation.receive(SolverReady { id: 4, outcome: Ok(ready()) });
        assert!(preparation.is_busy() && preparation.made.is_none());
        preparation.receive(SolverReady { id: 5, outcome: Ok(ready()) });
        assert!(preparation.shown == Some(Shown::Made) && !preparation.is_busy());
        preparation.rename(1, " left heart ");
        preparation.rename(2, "left_heart");
        preparation.rename(0, "");
        preparation.rename(9, "none");
        assert_eq!(preparation.names(), ["wall", "left_heart", "outlet_1"]);
        preparation.ask(6, (1, 1, 2));
        preparation.receive(SolverReady { id: 6, outcome: Err(PrepareError::Empty) });
        // What was made before still is.
        assert!(preparation.failure == Some(PrepareError::Empty) && preparation.made.is_some());
        assert!(!preparation.give_up());
        preparation.leave_surface();
        assert!(preparation.made.is_none() && preparation.shown.is_none());
    }
}
