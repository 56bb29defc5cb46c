//! Keeps smoothing from making triangles cross.
//!
//! A filter moves the two sides of a fold, or two vessels that nearly touch, through each other. Triangles that cross
//! after smoothing and crossed none before are sought; around them the filter is weakened: `x = S x + w (x_0 - S x)`,
//! the filter with `w + (1 - w) f(k)` in place of `f(k)`. The part `w` is largest at those triangles and falls to 0
//! over some rings of neighbours, without a corner at either end. Where that was not enough it is raised, and reaches
//! twice as far, until no triangle crosses that did not: at the latest where the surface is as it was.
//!
//! The first search takes the hierarchy of the surface before smoothing, with boxes of its own. After it only what was
//! moved is looked at, and what is near it.

use std::collections::VecDeque;
use std::sync::Arc;

use glam::Vec3;

use crate::results::{Surface, Weakened};
use crate::shape::{Measured, ShapeTask};
use crate::task::{Budget, Progress, Task};
use lumen_mesh::parallel;
use lumen_mesh::{Refitting, SurfaceIndex, Topology, TriMesh};

/// Rings over which the part falls from 1 to 0.
const RINGS: f32 = 8.0;
/// The first height at a triangle that crosses: half of [`RINGS`], so that the part is a half there.
const FIRST: u16 = 4;
/// From this round on triangles that crossed others before are put back as well: a new one may cross them.
const BOTH: u32 = 3;
/// After so many rounds the surface is put back as it was. By then they reach tens of thousands of rings.
const ROUNDS: u32 = 16;
/// Triangles whose neighbourhood is looked up in one piece of work.
const PIECE: usize = 256;

type Search = Box<ShapeTask<Arc<TriMesh>, Arc<Topology>>>;

/// What the guard left.
#[derive(Debug)]
pub struct Guarded {
    /// The surface.
    pub mesh: Arc<TriMesh>,
    /// Where the filter was weakened; `None` where it was nowhere.
    pub weakened: Option<Weakened>,
    /// Whether no triangle at all crosses another.
    pub crosses_nothing: bool,
}

impl Guarded {
    /// What the filter made, not looked at.
    pub fn without(mesh: TriMesh) -> Self {
        Self { mesh: Arc::new(mesh), weakened: None, crosses_nothing: false }
    }
}

/// The guard at work, in slices.
pub struct GuardTask {
    kept: Arc<Surface>,
    kept_index: Option<Arc<SurfaceIndex>>,
    /// As the filter made it.
    smoothed: Arc<TriMesh>,
    /// Of that.
    index: Option<Arc<SurfaceIndex>>,
    /// As it is now.
    mesh: Arc<TriMesh>,
    /// Heights from which the part follows, by vertex.
    heights: Vec<u16>,
    /// Whether each triangle crosses another before smoothing.
    crossed: Vec<bool>,
    spared: usize,
    rounds: u32,
    step: Step,
}

enum Step {
    /// The hierarchy of the surface before smoothing takes the boxes of that after it.
    Refit(Arc<SurfaceIndex>, Refitting),
    /// Triangles that cross after smoothing.
    After(Search),
    /// Triangles that cross before it, as some do after it.
    Before(Search, Vec<u32>),
    /// Triangles that cross still, of the ones that were moved and those near them: the search, and their numbers.
    Again(Search, Vec<u32>),
}

impl GuardTask {
    /// Starts from `smoothed`, the positions that the filter gave the vertices of `kept`. `kept_index` is that of `kept`,
    /// if there is one.
    pub fn new(kept: Arc<Surface>, kept_index: Option<Arc<SurfaceIndex>>, smoothed: Vec<Vec3>) -> Self {
        let mesh = Arc::new(TriMesh { positions: smoothed, triangles: kept.mesh.triangles.clone() });
        let step = match &kept_index {
            Some(index) => Step::Refit(index.clone(), Refitting::new(index)),
            None => Step::After(Box::new(ShapeTask::crossings_only(mesh.clone(), kept.topology.clone()))),
        };
        Self {
            kept_index,
            smoothed: mesh.clone(),
            index: None,
            mesh,
            heights: Vec::new(),
            crossed: Vec::new(),
            spared: 0,
            rounds: 0,
            step,
            kept,
        }
    }

    fn result(&mut self, crosses_nothing: bool) -> Guarded {
        let parts: Vec<f32> = self.heights.iter().map(|&height| part(height)).collect();
        let weakened = (!parts.is_empty()).then_some(Weakened { parts, spared: self.spared });
        Guarded { mesh: self.mesh.clone(), weakened, crosses_nothing }
    }

    /// Weakens the filter at the triangles of `crossing` that crossed none before; `None` where there is none.
    fn weaken(&mut self, crossing: &[u32]) -> Option<Step> {
        let new: Vec<u32> = crossing.iter().copied().filter(|&t| !self.crossed[t as usize]).collect();
        // Once all is as it was, nothing crosses that did not.
        if new.is_empty() || self.rounds >= ROUNDS {
            return None;
        }
        if self.heights.is_empty() {
            self.spared = new.len();
            self.heights = vec![0; self.kept.mesh.positions.len()];
        }
        self.rounds += 1;
        match self.rounds {
            ROUNDS.. => self.heights.fill(u16::MAX),
            BOTH.. => self.raise(crossing),
            _ => self.raise(&new),
        }
        let (kept, smoothed) = (&self.kept.mesh.positions, &self.smoothed.positions);
        let put_back = |v: usize| match part(self.heights[v]) {
            0.0 => smoothed[v],
            1.0 => kept[v],
            w => smoothed[v] + (kept[v] - smoothed[v]) * w,
        };
        let positions = (0..kept.len()).map(put_back).collect();
        self.mesh = Arc::new(TriMesh { positions, triangles: self.kept.mesh.triangles.clone() });
        let near = self.near_what_moved();
        let mut local = vec![u32::MAX; kept.len()];
        let mut patch = TriMesh::default();
        for &t in &near {
            patch.triangles.push(self.mesh.triangles[t as usize].map(|v| {
                if local[v as usize] == u32::MAX {
                    local[v as usize] = patch.positions.len() as u32;
                    patch.positions.push(self.mesh.positions[v as usize]);
                }
                local[v as usize]
            }));
        }
        let topology = Arc::new(Topology::new(patch.positions.len(), &patch.triangles));
        Some(Step::Again(Box::new(ShapeTask::crossings_only(Arc::new(patch), topology)), near))
    }

    /// Raises the heights at `triangles` to twice what they are, and lets them fall by one a ring around.
    fn raise(&mut self, triangles: &[u32]) {
        let mut queue = VecDeque::new();
        let mut corners: Vec<u32> = triangles.iter().flat_map(|&t| self.kept.mesh.triangles[t as usize]).collect();
        corners.sort_unstable();
        corners.dedup();
        for v in corners {
            let height = &mut self.heights[v as usize];
            *height = height.saturating_mul(2).max(FIRST);
            queue.push_back(v);
        }
        while let Some(v) = queue.pop_front() {
            let below = self.heights[v as usize] - 1;
            for &n in self.kept.topology.neighbours(v) {
                if self.heights[n as usize] < below {
                    self.heights[n as usize] = below;
                    queue.push_back(n);
                }
            }
        }
    }

    /// The triangles that were moved, and the others that may come near them; ascending.
    fn near_what_moved(&self) -> Vec<u32> {
        let triangles = &self.mesh.triangles;
        let is_moved = |t: u32| triangles[t as usize].iter().any(|&v| self.heights[v as usize] > 0);
        let moved: Vec<u32> = (0..triangles.len() as u32).filter(|&t| is_moved(t)).collect();
        let Some(index) = &self.index else { return moved };
        let mut near = parallel::map_ranges(moved.len(), PIECE, |range| {
            let mut near = Vec::new();
            for &t in &moved[range] {
                let [a, b, c] = self.mesh.corners(t as usize);
                index.for_each_near(a.min(b).min(c), a.max(b).max(c), |t| near.push(t));
            }
            near.sort_unstable();
            near.dedup();
            near
        })
        .concat();
        near.extend(moved);
        near.sort_unstable();
        near.dedup();
        near
    }
}

/// The part of the way back at a height.
fn part(height: u16) -> f32 {
    let at = (f32::from(height) / RINGS).min(1.0);
    at * at * (3.0 - 2.0 * at)
}

impl Task for GuardTask {
    type Output = Guarded;

    /// To put back what is weakened is one piece: about 50 ns a vertex of the surface.
    fn advance(&mut self, budget: Budget) -> Progress<Guarded> {
        loop {
            let next = match &mut self.step {
                Step::Refit(index, refitting) => match refitting.advance(index, &self.mesh) {
                    None if budget.is_spent() => return Progress::Working(0.2 * refitting.fraction(index)),
                    None => continue,
                    Some(refitted) => {
                        let search = ShapeTask::crossings_only(self.mesh.clone(), self.kept.topology.clone());
                        let search = search.with_index(self.mesh.clone(), Arc::new(refitted));
                        Some(Step::After(Box::new(search)))
                    }
                },
                Step::After(search) => match search.advance(budget) {
                    Progress::Working(fraction) => return Progress::Working(0.2 + 0.6 * fraction),
                    Progress::Done(Measured { crossing, .. }) if crossing.is_empty() => {
                        return Progress::Done(self.result(true));
                    }
                    Progress::Done(Measured { crossing, .. }) => {
                        self.index = search.index().cloned();
                        let Surface { mesh, topology, .. } = &*self.kept;
                        let search = ShapeTask::crossings_only(mesh.clone(), topology.clone());
                        let search = match self.kept_index.take() {
                            Some(index) => search.with_index(mesh.clone(), index),
                            None => search,
                        };
                        Some(Step::Before(Box::new(search), crossing))
                    }
                },
                Step::Before(search, after) => match search.advance(budget) {
                    Progress::Working(fraction) => return Progress::Working(0.8 + 0.1 * fraction),
                    Progress::Done(Measured { crossing, .. }) => {
                        self.crossed = vec![false; self.kept.mesh.triangles.len()];
                        crossing.iter().for_each(|&t| self.crossed[t as usize] = true);
                        let after = std::mem::take(after);
                        self.weaken(&after)
                    }
                },
                Step::Again(search, numbers) => match search.advance(budget) {
                    Progress::Working(_) => return Progress::Working(0.95),
                    Progress::Done(Measured { crossing, .. }) => {
                        let crossing: Vec<u32> = crossing.into_iter().map(|t| numbers[t as usize]).collect();
                        self.weaken(&crossing)
                    }
                },
            };
            match next {
                Some(step) => self.step = step,
                None => return Progress::Done(self.result(false)),
            }
        }
    }
}
