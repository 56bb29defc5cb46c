//! What plain Laplacian smoothing makes of the surface that is open: to be seen beside the filter, never the result.

use std::collections::VecDeque;
use std::sync::Arc;

use super::found::Averaged;
use super::message::Event;
use crate::mesh::{TriMesh, Vec3};
use crate::pipeline::filter::Filter;
use crate::pipeline::run::Pipeline;
use crate::pipeline::settings::Keep;
use crate::pipeline::smoothing::smooth_in_slices;
use crate::task::{self, Budget, Progress};

/// The passes that are asked for, and the work on them once the surface is there.
pub(super) struct Averaging {
    pub(super) id: u64,
    passes: u32,
    running: Option<Running>,
}

struct Running {
    keep: Keep,
    whole: Arc<TriMesh>,
    /// The vertices of `whole` that are smoothed, in their order.
    kept: Vec<u32>,
    smoothing: task::Running<'static, Vec<Vec3>>,
}

impl Averaging {
    /// Nothing done yet; `id` is that of the command.
    pub(super) fn new(id: u64, passes: u32) -> Self {
        Self { id, passes, running: None }
    }

    /// Works for about `budget` on what `pipeline` keeps; whether there is more to do.
    pub(super) fn advance(&mut self, pipeline: &Pipeline, budget: Budget, events: &mut VecDeque<Event>) -> bool {
        if self.running.is_none() {
            self.running = Running::begin(pipeline, self.passes);
        }
        let Some(running) = &mut self.running else { return false };
        let Progress::Done(smoothed) = running.smoothing.advance(budget) else { return true };
        let mut positions = running.whole.positions.clone();
        for (&v, p) in running.kept.iter().zip(smoothed) {
            positions[v as usize] = p;
        }
        let (id, passes, keep) = (self.id, self.passes, running.keep);
        events.push_back(Event::Averaged(Box::new(Averaged { id, passes, keep, positions })));
        false
    }
}

impl Running {
    fn begin(pipeline: &Pipeline, passes: u32) -> Option<Self> {
        let (entering, found, kept) = (pipeline.entering()?, pipeline.connectivity()?, pipeline.kept()?);
        let (keep, whole) = (pipeline.settings().keep, entering.mesh.clone());
        let vertices = match found.kept_rows(&whole, keep).ok()? {
            None => (0..whole.positions.len() as u32).collect(),
            Some(rows) => rows.vertices,
        };
        let boundary = pipeline.settings().smoothing.boundary;
        let (filter, kept) = (Filter::laplacian(passes), kept.clone());
        let smoothing = task::Running::new(|yielder| async move {
            smooth_in_slices(&kept.mesh.positions, &kept.topology, boundary, &filter, &yielder).await
        });
        Some(Self { keep, whole, kept: vertices, smoothing })
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::engine::{Command, Engine, Source};
    use crate::io::Axes;
    use crate::mesh::shapes::{icosphere, joined, tube};
    use crate::pipeline::settings::Settings;

    /// A tube of 3 mm beside a smaller sphere.
    fn surface() -> TriMesh {
        joined(&[tube(24, 60, 60.0, |_| 3.0), icosphere(2, 2.0, Vec3::new(20.0, 0.0, 0.0))])
    }

    fn averaged(keep: Keep, passes: u32) -> (Averaged, TriMesh) {
        let (mut engine, mesh) = (Engine::new(), surface());
        let source = Source::Made {
            name: "made".into(),
            format: "OBJ".into(),
            mesh: Arc::new(mesh.clone()),
            axes: Axes::Unknown,
            warnings: Vec::new(),
            threshold: None,
        };
        engine.handle(Command::Open { id: 1, source, settings: Settings { keep, ..Settings::default() } });
        engine.handle(Command::Average { id: 2, passes: 100 });
        // The newest alone is answered.
        engine.handle(Command::Average { id: 3, passes });
        let mut answers = Vec::new();
        while engine.advance(Duration::from_millis(2)) {}
        while let Some(event) = engine.poll() {
            if let Event::Averaged(found) = event {
                answers.push(*found);
            }
        }
        let [found] = <[Averaged; 1]>::try_from(answers).expect("one answer");
        assert_eq!((found.id, found.passes, found.keep), (3, passes, keep));
        (found, mesh)
    }

    #[test]
    fn a_tube_that_is_kept_becomes_thinner_and_what_is_not_stays() {
        let (found, mesh) = averaged(Keep::Largest, 15);
        assert_eq!(found.positions.len(), mesh.positions.len());
        for (before, after) in mesh.positions.iter().zip(&found.positions) {
            if before.x > 10.0 {
                assert_eq!(before, after, "the sphere");
            } else if (before.z - 30.0).abs() < 5.0 {
                let (before, after) = (before.truncate().length(), after.truncate().length());
                // By the wave around it: cosines of the steps to its six neighbours.
                let step = std::f32::consts::TAU / 24.0;
                let mean = (2.0 * step.cos() + 4.0 * (step / 2.0).cos()) / 6.0;
                let stated = (0.5 + 0.5 * mean).powi(15);
                assert!((after / before - stated).abs() < 1e-3, "{after} of {before}, {stated} is stated");
            }
        }
        let (all, _) = averaged(Keep::All, 15);
        let moved = |v: &usize| all.positions[*v] != mesh.positions[*v];
        assert!((0..mesh.positions.len()).filter(|&v| mesh.positions[v].x > 10.0).all(|v| moved(&v)));
    }
}
