//! A surface beside another file: that is read, the surface is moved onto it, and the two are compared.

use std::collections::VecDeque;
use std::sync::Arc;

use super::found::{FilesCompared, TwoFiles};
use super::message::{Event, Judged, Work};
use super::opening::{Read, read};
use super::progress::tell_progress;
use super::source::Source;
use crate::language::tell;
use crate::mesh::{Measures, Topology, TriMesh, measures};
use crate::pipeline::beside::{Align, BesideReport, FileFrame, Looking, Placed, Side, axes_differ, beside, placed};
use crate::pipeline::deviation::{REPORT_SAMPLES, Rigid};
use crate::task::{Budget, Progress, Running, Yielder};

/// The parts of the time that reading and aligning take.
const READ: f32 = 0.2;
const ALIGNED: f32 = 0.3;

/// A surface that is compared with another file.
pub(super) struct Besiding {
    pub(super) id: u64,
    running: Running<'static, Result<TwoFiles, String>>,
}

impl Besiding {
    /// Nothing done yet; `id` is that of the command.
    pub(super) fn new(id: u64, reference: Source, mesh: Arc<TriMesh>, of: Judged, how: (Align, f64)) -> Self {
        let work = |yielder: Yielder| async move { compared(reference, mesh, of, how, &yielder).await };
        Self { id, running: Running::new(work) }
    }

    /// Works for about `budget`; whether there is more to do.
    pub(super) fn advance(&mut self, budget: Budget, events: &mut VecDeque<Event>) -> bool {
        match self.running.advance(budget) {
            Progress::Working(fraction) => {
                tell_progress(Work::Beside, fraction, events);
                true
            }
            Progress::Done(outcome) => {
                events.push_back(Event::Beside(Box::new(FilesCompared { id: self.id, outcome })));
                false
            }
        }
    }
}

async fn compared(
    source: Source,
    mesh: Arc<TriMesh>,
    of: Judged,
    (align, tolerance_percent): (Align, f64),
    yielder: &Yielder,
) -> Result<TwoFiles, String> {
    let (name, is_file) = (source.name().to_owned(), matches!(source, Source::File { .. }));
    let Read { imported, digest } = read(source, &name, &yielder.part(0.0..READ)).await?;
    let (report, reference) = (imported.report, Arc::new(imported.mesh));
    let to = FileFrame::from(&report);
    let found = placed((&reference, to), (&mesh, of.frame), align, &yielder.part(READ..ALIGNED)).await;
    let Placed { motion, moved } = found.map_err(|error| tell(&error))?;
    let mut surface = mesh;
    if motion != Rigid::STILL {
        Arc::make_mut(&mut surface).positions.iter_mut().for_each(|p| *p = motion.of(*p));
    }
    yielder.rest(ALIGNED).await;
    let how = Looking { samples: REPORT_SAMPLES, tolerance_percent, with_reference_map: true };
    let found = beside(&reference, &surface, how, &yielder.part(ALIGNED..1.0)).await.map_err(|error| tell(&error))?;
    let of_reference = Measures { area_mm2: report.area_mm2, volume_mm3: report.volume_mm3 };
    let of_surface = measures(&surface, &Topology::new(surface.positions.len(), &surface.triangles));
    let axes = if moved.is_some() { report.axes } else { of.frame.axes };
    let sides = [
        Side::new(&name, digest.map(|digest| digest.to_string()), report.axes, &reference, of_reference),
        Side::new(&of.name, of.digest.map(|digest| digest.to_string()), axes, &surface, of_surface),
    ];
    Ok(TwoFiles {
        report: BesideReport::new(sides, moved, &found, tolerance_percent),
        csv: found.csv(),
        refused: found.calibre.as_ref().err().cloned(),
        lie_apart: found.lie_apart(&reference),
        axes_differ: align == Align::Still && axes_differ(to, of.frame),
        unit: is_file.then_some(report.unit),
        warnings: report.warnings,
        over_reference: found.over_reference.map_or_else(Default::default, Into::into),
        over_surface: found.over_surface.into(),
        reference,
        surface,
    })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::engine::{Command, Engine, with_sample};
    use crate::io::{Axes, Format, ImportOptions, write};
    use crate::mesh::Vec3;
    use crate::mesh::shapes::icosphere;

    fn engine() -> Engine {
        let mut engine = with_sample();
        run(&mut engine);
        engine
    }

    fn run(engine: &mut Engine) -> Option<FilesCompared> {
        while engine.advance(Duration::from_millis(2)) {}
        let events: Vec<Event> = std::iter::from_fn(|| engine.poll()).collect();
        events.into_iter().find_map(|event| if let Event::Beside(found) = event { Some(*found) } else { None })
    }

    fn file(bytes: Vec<u8>) -> Source {
        Source::File { name: "reference.ply".into(), bytes: Arc::new(bytes), options: ImportOptions::default() }
    }

    fn command(id: u64, reference: Source, mesh: TriMesh, align: Align) -> Command {
        let frame = FileFrame { moved_mm: [0.0; 3], axes: Axes::Unknown };
        let of = Judged { name: "surface".into(), digest: None, frame };
        Command::Beside { id, reference, mesh: Arc::new(mesh), of, align, tolerance_percent: 1.0 }
    }

    #[test]
    fn concentric_spheres_are_apart_by_the_difference_of_their_radii_outside_and_inside() {
        let mut engine = engine();
        let [small, large] = [10.0, 11.0].map(|radius| icosphere(4, radius, Vec3::ZERO));
        let bytes = write(&small, None, Format::Ply).unwrap();
        engine.handle(command(7, file(bytes.clone()), large.clone(), Align::Still));
        let found = run(&mut engine).expect("an answer");
        let two = found.outcome.unwrap();
        assert_eq!((found.id, two.report.reference.triangles), (7, small.triangles.len()));
        assert!((two.report.deviation_mm.mean - 1.0).abs() < 0.01, "{:?}", two.report.deviation_mm);
        // The larger lies outside, seen from either.
        let over = [&two.over_reference, &two.over_surface];
        assert_eq!(over.map(|over| over.signed.len()), [&small, &large].map(|m| m.positions.len()));
        let all = over.into_iter().flat_map(|over| over.signed.iter().chain(&over.plain));
        assert!(all.clone().all(|&mm| (mm - 1.0).abs() < 0.02), "{:?}", all.clone().fold(1.0_f32, |a, &b| a.min(b)));
        assert!(!two.lie_apart);
        // Far away it is brought back.
        let away = TriMesh { positions: large.positions.iter().map(|&p| p + 100.0).collect(), ..large };
        engine.handle(command(8, file(bytes.clone()), away.clone(), Align::Still));
        assert!(run(&mut engine).unwrap().outcome.unwrap().lie_apart);
        engine.handle(command(9, file(bytes), away, Align::Rigid));
        let two = run(&mut engine).unwrap().outcome.unwrap();
        assert!(two.report.moved.is_some_and(|moved| moved.fit.is_some()) && !two.lie_apart);
        let middle = two.surface.positions.iter().sum::<Vec3>() / two.surface.positions.len() as f32;
        assert!(middle.length() < 0.05 && (two.report.deviation_mm.mean - 1.0).abs() < 0.01, "{middle}");
    }

    #[test]
    fn what_cannot_be_read_or_turned_is_told_and_a_cancel_ends_the_work() {
        let mut engine = engine();
        let sphere = icosphere(3, 10.0, Vec3::ZERO);
        engine.handle(command(2, file(b"ply\nformat".to_vec()), sphere.clone(), Align::Still));
        assert!(run(&mut engine).unwrap().outcome.is_err_and(|message| !message.is_empty()));
        let bytes = write(&sphere, None, Format::Ply).unwrap();
        engine.handle(command(3, file(bytes.clone()), sphere.clone(), Align::Axes));
        assert!(run(&mut engine).unwrap().outcome.is_err_and(|message| message.contains("axes")));
        engine.handle(command(4, file(bytes.clone()), TriMesh::default(), Align::Still));
        assert!(run(&mut engine).unwrap().outcome.is_err_and(|message| message.contains("area")));
        engine.handle(command(5, file(bytes), sphere, Align::Still));
        assert!(engine.advance(Duration::ZERO));
        engine.handle(Command::Cancel);
        assert!(run(&mut engine).is_none());
    }
}
