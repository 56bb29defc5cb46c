//! A level that is made ready for a solver, and the files that are made of it.

use std::collections::VecDeque;
use std::io::{Cursor, Write as _};
use std::sync::Arc;

use super::found::{CutsPlanned, PlannedCuts, Ready, SolverReady};
use super::message::{Event, Work};
use super::progress::tell_progress;
use crate::mesh::{Array, TriMesh};
use crate::pipeline::carry::carry_over;
use crate::prepare::Patched;
use crate::prepare::cuts::cuts;
use crate::prepare::prepare::{Plan, Prepared, prepare};
use crate::prepare::write::SolverFormat;
use crate::task::{Budget, Progress, Running};

/// The part of the work that the surface is; the rest is its arrays.
const PREPARED: f32 = 0.9;

/// A surface that was made ready.
pub(super) struct Made {
    /// The number of the command.
    pub(super) id: u64,
    surface: Patched,
    /// The arrays of the level that it was made of; `None` where that was another than the newest.
    pub(super) arrays: Option<Vec<Array>>,
}

/// A surface on its way to a solver, or the plan of its cuts.
pub(super) enum Preparing {
    /// Nothing is done yet: the number of the command, the surface, and what is done to it.
    Asked(u64, Arc<TriMesh>, Plan),
    /// The number of the command; what is told of it, and the surface where there is one.
    Begun(u64, Running<'static, (Event, Option<Made>)>),
}

impl Preparing {
    /// The number of the command.
    pub(super) fn id(&self) -> u64 {
        match self {
            Self::Asked(id, ..) | Self::Begun(id, _) => *id,
        }
    }

    /// Of a surface with these arrays.
    fn begun(id: u64, mesh: Arc<TriMesh>, plan: Plan, arrays: Option<Arc<Vec<Array>>>) -> Self {
        Self::Begun(
            id,
            Running::new(|yielder| async move {
                let found = match prepare(&mesh, &plan, &yielder.part(0.0..PREPARED)).await {
                    Ok(found) => found,
                    Err(error) => return (Event::Prepared(Box::new(SolverReady { id, outcome: Err(error) })), None),
                };
                let Prepared { surface, fate, notes, crossing, remeshed } = found;
                let arrays = match arrays {
                    Some(arrays) if !arrays.is_empty() => {
                        let part = yielder.part(PREPARED..1.0);
                        Some(carry_over(arrays.to_vec(), &mesh, &surface.mesh, &part).await)
                    }
                    known => known.map(|_| Vec::new()),
                };
                let Patched { mesh, of_triangle, patches } = surface.clone();
                let ready = Ready { mesh: Arc::new(mesh), of_triangle, patches, fate, notes, crossing, remeshed };
                let event = Event::Prepared(Box::new(SolverReady { id, outcome: Ok(ready) }));
                (event, Some(Made { id, surface, arrays }))
            }),
        )
    }

    /// Where the ends of a surface are cut.
    pub(super) fn cuts(id: u64, mesh: Arc<TriMesh>, plan: Plan) -> Self {
        Self::Begun(
            id,
            Running::new(|yielder| async move {
                let outcome = cuts(&mesh, &plan, &yielder).await.map(PlannedCuts::from);
                (Event::CutsPlanned(Box::new(CutsPlanned { id, outcome })), None)
            }),
        )
    }

    /// Works for about `budget`; whether there is more to do. What comes of it is put into `made` and told. `arrays` finds those
    /// of a level.
    pub(super) fn advance(
        &mut self,
        budget: Budget,
        arrays: impl FnOnce(&TriMesh) -> Option<Arc<Vec<Array>>>,
        made: &mut Option<Made>,
        events: &mut VecDeque<Event>,
    ) -> bool {
        if let Self::Asked(id, mesh, plan) = self {
            let arrays = arrays(mesh);
            *self = Self::begun(*id, mesh.clone(), std::mem::take(plan), arrays);
        }
        let Self::Begun(_, running) = self else { return false };
        match running.advance(budget) {
            Progress::Working(fraction) => {
                tell_progress(Work::Preparing, fraction, events);
                true
            }
            Progress::Done((event, surface)) => {
                if surface.is_some() {
                    *made = surface;
                }
                events.push_back(event);
                false
            }
        }
    }
}

/// The file `name` of a surface in patches, which are called by `names`. Of a format of several files it is a ZIP.
pub(super) fn written(made: &Made, name: &str, names: Vec<String>, format: SolverFormat) -> Result<Vec<u8>, String> {
    let mut surface = made.surface.clone();
    let arrays = made.arrays.as_deref().unwrap_or_default();
    surface.patches.iter_mut().zip(names).for_each(|(patch, name)| patch.name = name);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let mut files = format.written_with(&surface, arrays, stem).map_err(|error| error.to_string())?;
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
    use crate::engine::{Command, Engine, Source, with_sample};
    use crate::io;
    use crate::mesh::arrays::{Association, Values};
    use crate::mesh::shapes::tube;
    use crate::pipeline::settings::{Preset, Settings, Target};
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
    fn the_arrays_of_a_level_are_in_the_files_that_have_a_place_for_them() {
        let mesh = tube(48, 80, 40.0, |_| 2.0);
        let heights: Vec<f32> = mesh.positions.iter().map(|p| p.z).collect();
        let arrays = [Array::new("Height", Association::Point, 1, Values::from_floats(&heights))];
        let output = io::Output { mesh: &mesh, normals: None, arrays: &arrays, axes: io::Axes::Unknown };
        let bytes = io::write_output(&output, io::Format::Vtp).unwrap();
        let (options, bytes) = (io::ImportOptions::default(), Arc::new(bytes));
        let source = Source::File { name: "a.vtp".to_owned(), bytes, options };
        let mut engine = Engine::new();
        let target = Target::Reduction(500);
        let settings = Settings { smoothing: Preset::None.smoothing(), target, ..Settings::default() };
        engine.handle(Command::Open { id: 1, source, settings });
        let events = run(&mut engine);
        let level = events.iter().find_map(|event| match event {
            Event::Reduced(reduced) => Some(reduced.mesh.extract(&reduced.mesh.level(target).triangles)),
            _ => None,
        });
        let level = level.expect("a level");
        for (mesh, is_carried) in [(level, true), (mesh, false)] {
            engine.handle(Command::Prepare { id: 2, mesh: Arc::new(mesh), plan: Plan::flow() });
            prepared(run(&mut engine)).expect("an answer").outcome.unwrap();
            for (format, has_arrays) in
                [(SolverFormat::Vtp, true), (SolverFormat::Msh, true), (SolverFormat::Stl, false)]
            {
                let (name, names) = ("a.vtp".to_owned(), ["wall", "a", "b"].map(str::to_owned).to_vec());
                engine.handle(Command::WriteSolver { id: 2, name, format, names });
                let files = run(&mut engine);
                let [Event::Written { bytes, left_out, .. }] = files.as_slice() else { panic!("{files:?}") };
                let is_there = bytes.windows(6).any(|word| word == b"Height");
                assert_eq!(is_there, has_arrays && is_carried, "{format:?}");
                assert_eq!(left_out.is_some(), has_arrays && !is_carried, "{format:?}");
            }
        }
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
