//! How far a surface that is compared is from the first: by vertex, in numbers, and where the most.

use std::collections::VecDeque;
use std::sync::Arc;

use super::found::Differed;
use super::message::{Event, Work};
use super::progress::tell_progress;
use crate::mesh::{SurfaceIndex, TriMesh};
use crate::pipeline::deviation::{Compared, Comparing, Comparison, INTERACTIVE_SAMPLES, compare};
use crate::task::{Budget, Progress, Running};

/// Two surfaces that are measured against each other.
pub(super) struct Differing {
    pub(super) id: u64,
    first: Arc<TriMesh>,
    comparing: Running<'static, Compared>,
}

impl Differing {
    /// Nothing measured yet; `id` is that of the command.
    pub(super) fn new(id: u64, first: Arc<TriMesh>, other: Arc<TriMesh>) -> Self {
        let how = Comparing { samples: INTERACTIVE_SAMPLES, with_map: true, ..Comparing::default() };
        let a = first.clone();
        Self { id, first, comparing: Running::new(|yielder| async move { compare(&a, &other, how, &yielder).await }) }
    }

    /// Works for about `budget`; whether there is more to do.
    pub(super) fn advance(&mut self, budget: Budget, events: &mut VecDeque<Event>) -> bool {
        let Compared { comparison: found, indices: [index, _] } = match self.comparing.advance(budget) {
            Progress::Working(fraction) => {
                tell_progress(Work::Comparing, fraction, events);
                return true;
            }
            Progress::Done(found) => found,
        };
        let width_mm = found.as_ref().zip(index).and_then(|(found, index)| self.width_mm(found, &index));
        let (by_vertex, deviation) = found.map_or((Vec::new(), None), |found| (found.map, Some(found.deviation)));
        events.push_back(Event::Differed(Box::new(Differed { id: self.id, by_vertex, deviation, width_mm })));
        false
    }

    /// The diameter of the first surface's lumen where the other is farthest from it.
    fn width_mm(&self, found: &Comparison, index: &SurfaceIndex) -> Option<f32> {
        let at = found.deviation.max_at_mm[0].into();
        let TriMesh { positions, triangles } = &*self.first;
        let (_, ball) = index.inner_ball_beside(positions, triangles, at, self.first.bounds().diagonal())?;
        Some(2.0 * ball.radius)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::engine::{Command, Engine, with_sample};
    use crate::mesh::Vec3;
    use crate::mesh::shapes::{icosphere, tube};
    use crate::pipeline::settings::Settings;

    /// What the engine says, and the surfaces that it compared.
    fn run(engine: &mut Engine) -> (Option<Differed>, Vec<Arc<TriMesh>>) {
        let (mut differed, mut meshes) = (None, Vec::new());
        while engine.advance(Duration::from_millis(2)) {}
        while let Some(event) = engine.poll() {
            match event {
                Event::Differed(found) => differed = Some(*found),
                Event::Compared(compared) => meshes.push(compared.mesh),
                _ => {}
            }
        }
        (differed, meshes)
    }

    fn differ(first: TriMesh, other: TriMesh) -> Differed {
        let mut engine = with_sample();
        engine.handle(Command::Differ { id: 7, first: Arc::new(first), other: Arc::new(other) });
        let found = run(&mut engine).0.expect("an answer");
        assert_eq!(found.id, 7);
        found
    }

    #[test]
    fn the_same_settings_twice_make_surfaces_that_nowhere_differ() {
        let mut engine = with_sample();
        engine.handle(Command::Compare { id: 2, settings: vec![Settings::default(); 2] });
        let (_, meshes) = run(&mut engine);
        let [first, other]: [Arc<TriMesh>; 2] = meshes.try_into().expect("two answers");
        engine.handle(Command::Differ { id: 3, first, other: Arc::clone(&other) });
        let found = run(&mut engine).0.unwrap();
        assert_eq!(found.by_vertex.len(), other.positions.len());
        // But for the rounding of samples on the triangles.
        assert!(found.deviation.unwrap().max < 1e-4 && found.by_vertex.iter().all(|&far| far < 1e-4));
    }

    #[test]
    fn a_tube_that_has_shrunk_differs_by_what_it_lost_of_its_radius() {
        // Of a radius of 5 mm and of 4.5 mm, with flat sides whose middles are nearer to each other by a cosine.
        let made = |radius: f32| tube(48, 40, 60.0, move |_| radius);
        let found = differ(made(5.0), made(4.5));
        let flat = (std::f32::consts::PI / 48.0).cos();
        assert!(found.by_vertex.iter().all(|&far| (0.5 * flat - 1e-3..0.5 + 1e-3).contains(&far)), "{found:?}");
        let deviation = found.deviation.unwrap();
        assert!((deviation.mean - 0.5).abs() < 2e-3 && (deviation.max - 0.5).abs() < 2e-3, "{deviation:?}");
        assert!((found.width_mm.unwrap() / 10.0 - 1.0).abs() < 0.03, "{:?}", found.width_mm);
    }

    #[test]
    fn the_place_is_that_of_the_largest_difference() {
        let sphere = icosphere(4, 10.0, Vec3::ZERO);
        let mut peaked = sphere.clone();
        let peak = &mut peaked.positions[100];
        *peak *= 1.2;
        let peak = *peak;
        let found = differ(sphere, peaked);
        let deviation = found.deviation.unwrap();
        assert!((deviation.max - 2.0).abs() < 1e-4, "a vertex was drawn out by 2 mm: {deviation:?}");
        assert_eq!(deviation.max_at_mm[1], peak.to_array());
        assert!(found.by_vertex[100] > 0.5 && (found.width_mm.unwrap() / 20.0 - 1.0).abs() < 0.03, "{found:?}");
    }

    #[test]
    fn a_cancel_ends_it() {
        let mut engine = with_sample();
        run(&mut engine);
        let [first, other] = [10.0, 11.0].map(|radius| Arc::new(icosphere(4, radius, Vec3::ZERO)));
        engine.handle(Command::Differ { id: 2, first, other });
        assert!(engine.advance(Duration::ZERO));
        engine.handle(Command::Cancel);
        assert!(run(&mut engine).0.is_none());
    }
}
