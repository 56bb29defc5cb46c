//! A level that is made ready for a solver, and the files that are made of it.

use std::collections::VecDeque;
use std::sync::Arc;

use super::found::{Ready, SolverReady};
use super::message::{Event, Work};
use super::progress::tell_progress;
use crate::mesh::TriMesh;
use crate::prepare::Patched;
use crate::prepare::notes::PrepareError;
use crate::prepare::prepare::{Plan, Prepared, prepare};
use crate::prepare::write::SolverFormat;
use crate::task::{Budget, Progress, Running};

/// A surface on its way to a solver.
pub(super) struct Preparing {
    pub(super) id: u64,
    running: Running<'static, Result<Prepared, PrepareError>>,
}

impl Preparing {
    /// Nothing done yet; `id` is that of the command.
    pub(super) fn new(id: u64, mesh: Arc<TriMesh>, plan: Plan) -> Self {
        Self { id, running: Running::new(|yielder| async move { prepare(&mesh, &plan, &yielder).await }) }
    }

    /// Works for about `budget`; whether there is more to do. What comes of it is put into `made` and told.
    pub(super) fn advance(
        &mut self,
        budget: Budget,
        made: &mut Option<(u64, Patched)>,
        events: &mut VecDeque<Event>,
    ) -> bool {
        let outcome = match self.running.advance(budget) {
            Progress::Working(fraction) => {
                tell_progress(Work::Preparing, fraction, events);
                return true;
            }
            Progress::Done(outcome) => outcome,
        };
        let outcome = outcome.map(|Prepared { surface, fate, notes, crossing, remeshed }| {
            let ready = Ready {
                mesh: Arc::new(surface.mesh.clone()),
                of_triangle: surface.of_triangle.clone(),
                patches: surface.patches.clone(),
                fate,
                notes,
                crossing,
                remeshed,
            };
            *made = Some((self.id, surface));
            ready
        });
        events.push_back(Event::Prepared(Box::new(SolverReady { id: self.id, outcome })));
        false
    }
}

/// A file of a surface in patches, which are called by these names.
pub(super) fn written(surface: &Patched, names: Vec<String>, format: SolverFormat) -> Result<Vec<u8>, String> {
    let mut surface = surface.clone();
    surface.patches.iter_mut().zip(names).for_each(|(patch, name)| patch.name = name);
    let files = format.written(&surface, "").map_err(|error| error.to_string())?;
    files.into_iter().next().map(|(_, bytes)| bytes).ok_or_else(String::new)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::engine::{Command, Engine, with_sample};
    use crate::mesh::shapes::tube;
    use crate::prepare::PatchKind;

    fn run(engine: &mut Engine) -> Vec<Event> {
        while engine.advance(Duration::from_millis(2)) {}
        std::iter::from_fn(|| engine.poll()).collect()
    }

    fn prepared(events: Vec<Event>) -> Option<SolverReady> {
        events.into_iter().find_map(|event| if let Event::Prepared(found) = event { Some(*found) } else { None })
    }

    #[test]
    fn a_tube_is_made_ready_and_written_under_the_names_that_it_is_given() {
        let mut engine = with_sample();
        run(&mut engine);
        let mesh = Arc::new(tube(48, 80, 40.0, |_| 2.0));
        engine.handle(Command::Prepare { id: 7, mesh, plan: Plan::flow() });
        let found = prepared(run(&mut engine)).expect("an answer");
        assert_eq!(found.id, 7);
        let ready = found.outcome.unwrap();
        assert!(ready.fate.is_ready() && ready.patches.len() == 3, "{:?}", ready.fate);
        let ends = ready.patches.iter().filter(|patch| patch.kind != PatchKind::Wall);
        // A circle of 2 mm, but for the flat sides of the tube that it was.
        assert!(ends.clone().all(|patch| (patch.area_mm2 / (4.0 * std::f64::consts::PI) - 1.0).abs() < 0.01));
        let names = vec!["wall".to_owned(), "heart".to_owned(), "leg".to_owned()];
        let write =
            |id| Command::WriteSolver { id, name: "a.stl".to_owned(), format: SolverFormat::Stl, names: names.clone() };
        engine.handle(write(7));
        let files = run(&mut engine);
        let [Event::Written { bytes, .. }] = files.as_slice() else { panic!("{files:?}") };
        let text = String::from_utf8_lossy(bytes);
        assert!(["solid wall", "solid heart", "solid leg"].iter().all(|solid| text.contains(solid)));
        // Another than the one that is shown.
        engine.handle(write(6));
        assert!(matches!(run(&mut engine).as_slice(), [Event::NotWritten { .. }]));
    }

    #[test]
    fn what_cannot_be_prepared_is_told_and_a_cancel_ends_the_work() {
        let mut engine = with_sample();
        run(&mut engine);
        engine.handle(Command::Prepare { id: 2, mesh: Arc::default(), plan: Plan::flow() });
        assert_eq!(prepared(run(&mut engine)).unwrap().outcome, Err(PrepareError::Empty));
        engine.handle(Command::Prepare { id: 3, mesh: Arc::new(tube(48, 80, 40.0, |_| 2.0)), plan: Plan::flow() });
        assert!(engine.advance(Duration::ZERO));
        engine.handle(Command::Cancel);
        assert!(prepared(run(&mut engine)).is_none());
    }
}
