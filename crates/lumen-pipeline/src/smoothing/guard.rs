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
use crate::shape::crossing_triangles;
use crate::task::Yielder;
use lumen_mesh::parallel;
use lumen_mesh::{Indexed, SurfaceIndex, Topology, TriMesh, refitted};

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

/// What the guard left.
#[derive(Debug)]
pub(crate) struct Guarded {
    /// The surface.
    pub mesh: Arc<TriMesh>,
    /// Where the filter was weakened; `None` where it was nowhere.
    pub weakened: Option<Weakened>,
    /// Whether no triangle at all crosses another.
    pub crosses_nothing: bool,
}

impl Guarded {
    /// What the filter made, not looked at.
    pub(crate) fn without(mesh: TriMesh) -> Self {
        Self { mesh: Arc::new(mesh), weakened: None, crosses_nothing: false }
    }
}

/// Keeps `smoothed`, the positions that the filter gave the vertices of `kept`, from crossing where `kept` does not. `index`
/// is that of `kept`, if there is one. To put back what is weakened is one piece: about 50 ns a vertex of the surface.
pub(crate) async fn guard(
    kept: &Surface,
    index: Option<Arc<SurfaceIndex>>,
    smoothed: Vec<Vec3>,
    yielder: &Yielder,
) -> Guarded {
    let mesh = Arc::new(TriMesh { positions: smoothed, triangles: kept.mesh.triangles.clone() });
    let part = yielder.part(0.0..0.2);
    let smoothed_index = match &index {
        Some(index) => refitted(index, &mesh, &part).await,
        None => SurfaceIndex::build(&mesh.positions, &mesh.triangles, &part).await,
    };
    let after = crossing(&mesh, &kept.topology, &smoothed_index, &yielder.part(0.2..0.8)).await;
    if after.is_empty() {
        return Guarded { mesh, weakened: None, crosses_nothing: true };
    }
    let before = {
        let part = yielder.part(0.8..0.9);
        let index = SurfaceIndex::known_or_built(index, &kept.mesh, &part).await;
        crossing(&kept.mesh, &kept.topology, &index, &part).await
    };
    let mut crossed = vec![false; kept.mesh.triangles.len()];
    before.into_iter().for_each(|t| crossed[t as usize] = true);

    let (heights, spared, rounds) = (Vec::new(), 0, 0);
    let mut weakening =
        Weakening { kept, smoothed: mesh.clone(), index: smoothed_index, mesh, heights, crossed, spared, rounds };
    let (mut crossed, part) = (after, yielder.part(0.9..0.95));
    while let Some((patch, numbers)) = weakening.weaken(&crossed) {
        let topology = Topology::new(patch.positions.len(), &patch.triangles);
        let index = SurfaceIndex::build(&patch.positions, &patch.triangles, &part).await;
        let still = crossing(&patch, &topology, &index, &part).await;
        crossed = still.into_iter().map(|t| numbers[t as usize]).collect();
    }
    weakening.result()
}

async fn crossing(mesh: &TriMesh, topology: &Topology, index: &SurfaceIndex, yielder: &Yielder) -> Vec<u32> {
    crossing_triangles(Indexed { mesh, topology: Some(topology) }, index, yielder).await
}

/// The surface while the filter is weakened on it.
struct Weakening<'a> {
    kept: &'a Surface,
    /// As the filter made it, and an index of that.
    smoothed: Arc<TriMesh>,
    index: SurfaceIndex,
    /// As it is now.
    mesh: Arc<TriMesh>,
    /// Heights from which the part follows, by vertex.
    heights: Vec<u16>,
    /// Whether each triangle crosses another before smoothing.
    crossed: Vec<bool>,
    spared: usize,
    rounds: u32,
}

impl Weakening<'_> {
    fn result(self) -> Guarded {
        let parts: Vec<f32> = self.heights.iter().map(|&height| part(height)).collect();
        let weakened = (!parts.is_empty()).then_some(Weakened { parts, spared: self.spared });
        Guarded { mesh: self.mesh, weakened, crosses_nothing: false }
    }

    /// Weakens the filter at the triangles of `crossing` that crossed none before; `None` where there is none. Triangles may
    /// cross still of the ones that were moved and those near them: these as a surface, and their numbers.
    fn weaken(&mut self, crossing: &[u32]) -> Option<(TriMesh, Vec<u32>)> {
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
        Some((patch, near))
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
        let mut near = parallel::map_ranges(moved.len(), PIECE, |range| {
            let mut near = Vec::new();
            for &t in &moved[range] {
                let [a, b, c] = self.mesh.corners(t as usize);
                self.index.for_each_near(a.min(b).min(c), a.max(b).max(c), |t| near.push(t));
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
