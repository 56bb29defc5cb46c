//! A level that is made ready for a solver, and the files that are made of it.

use std::collections::VecDeque;
use std::io::{Cursor, Write as _};
use std::sync::Arc;

use super::found::{CutsPlanned, PlannedCuts, Ready, SolverReady};
use super::message::{Event, Work};
use super::progress::tell_progress;
use crate::mesh::TriMesh;
use crate::prepare::Patched;
use crate::prepare::cuts::cuts;
use crate::prepare::prepare::{Plan, Prepared, prepare};
use crate::prepare::write::SolverFormat;
use crate::task::{Budget, Progress, Running};

/// A surface on its way to a solver, or the plan of its cuts.
pub(super) struct Preparing {
    pub(super) id: u64,
    /// What is told of it, and the surface where there is one.
    running: Running<'static, (Event, Option<Patched>)>,
}

impl Preparing {
    /// Nothing done yet; `id` is that of the command.
    pub(super) fn new(id: u64, mesh: Arc<TriMesh>, plan: Plan) -> Self {
        let running = Running::new(|yielder| async move {
            let mut made = None;
            let outcome = prepare(&mesh, &plan, &yielder).await.map(|found| {
                let Prepared { surface, fate, notes, crossing, remeshed } = found;
                let Patched { mesh, of_triangle, patches } = surface.clone();
                made = Some(surface);
                Ready { mesh: Arc::new(mesh), of_triangle, patches, fate, notes, crossing, remeshed }
            });
            (Event::Prepared(Box::new(SolverReady { id, outcome })), made)
        });
        Self { id, running }
    }

    /// The same of where its ends are cut.
    pub(super) fn cuts(id: u64, mesh: Arc<TriMesh>, plan: Plan) -> Self {
        let running = Running::new(|yielder| async move {
            let outcome = cuts(&mesh, &plan, &yielder).await.map(PlannedCuts::from);
            (Event::CutsPlanned(Box::new(CutsPlanned { id, outcome })), None)
        });
        Self { id, running }
    }

    /// Works for about `budget`; whether there is more to do. What comes of it is put into `made` and told.
    pub(super) fn advance(
        &mut self,
        budget: Budget,
        made: &mut Option<(u64, Patched)>,
        events: &mut VecDeque<Event>,
    ) -> bool {
        match self.running.advance(budget) {
            Progress::Working(fraction) => {
                tell_progress(Work::Preparing, fraction, events);
                true
            }
            Progress::Done((event, surface)) => {
                if let Some(surface) = surface {
                    *made = Some((self.id, surface));
                }
                events.push_back(event);
                false
            }
        }
    }
}

/// The file `name` of a surface in patches, which are called by `names`. Of a format of several files it is a ZIP.
pub(super) fn written(
    surface: &Patched,
    name: &str,
    names: Vec<String>,
    format: SolverFormat,
) -> Result<Vec<u8>, String> {
    let mut surface = surface.clone();
    surface.patches.iter_mut().zip(names).for_each(|(patch, name)| patch.name = name);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let mut files = format.written(&surface, stem).map_err(|error| error.to_string())?;
    if format.is_folder() {
        return zipped(&files).map_err(|error| error.to_string());
    }
    files.pop().map(|(_, bytes)| bytes).ok_or_else(String::new)
}

/// A ZIP of files by their paths, not compressed.
fn zipped(files: &[(String, Vec<u8>)]) -> zip::result::ZipResult<Vec<u8>> {
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let stored = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (path, bytes) in files {
        archive.start_file(path.as_str(), stored)?;
        archive.write_all(bytes)?;
    }
    archive.finish().map(Cursor::into_inner)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::engine::{Command, Engine, with_sample};
    use crate::mesh::shapes::tube;
    use crate::prepare::PatchKind;
    use crate::prepare::cuts::{ClipAt, Cut};
    use crate::prepare::ends::Length;
    use crate::prepare::notes::PrepareError;

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
        let zip = Command::WriteSolver {
            id: 7,
            name: "a-solver.zip".to_owned(),
            format: SolverFormat::SimVascular,
            names: names.clone(),
        };
        engine.handle(zip);
        let files = run(&mut engine);
        let [Event::Written { bytes, .. }] = files.as_slice() else { panic!("{files:?}") };
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        let inside = archive.by_name("a-solver-mesh-complete/mesh-surfaces/heart.vtp").unwrap();
        let text = std::io::read_to_string(inside).unwrap();
        assert!(text.contains("<VTKFile") && text.trim_end().ends_with("</VTKFile>"));
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

    #[test]
    fn cuts_are_planned_without_a_surface_being_made_ready() {
        let mut engine = with_sample();
        run(&mut engine);
        let mesh = Arc::new(tube(48, 80, 40.0, |_| 2.0));
        engine.handle(Command::Prepare { id: 7, mesh: mesh.clone(), plan: Plan::flow() });
        run(&mut engine);
        let cut = Cut { end_mm: [0.0, 0.0, 40.0], at: Some(ClipAt::Distance(Length::Mm(10.0))) };
        engine.handle(Command::PlanCuts { id: 8, mesh, plan: Plan { cuts: vec![cut], ..Plan::flow() } });
        let events = run(&mut engine);
        let found =
            events.iter().find_map(|event| if let Event::CutsPlanned(found) = event { Some(found) } else { None });
        let found = found.filter(|found| found.id == 8).expect("an answer").outcome.as_ref().unwrap();
        let at = |z: f32| found.ends.iter().find(|end| (end.way[0][2] - z).abs() < 2.5).unwrap();
        assert!((at(40.0).plane.unwrap().centre[2] - 30.0).abs() < 0.1 && at(0.0).plane.unwrap().centre[2] < 1.0);
        // What was made ready before can still be written.
        let names = vec!["wall".to_owned(), "heart".to_owned(), "leg".to_owned()];
        engine.handle(Command::WriteSolver { id: 7, name: "a.stl".to_owned(), format: SolverFormat::Stl, names });
        assert!(matches!(run(&mut engine).as_slice(), [Event::Written { .. }]));
    }
}
