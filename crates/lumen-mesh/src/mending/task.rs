//! Mending as it is asked for, in an order in which each step leaves the next what it needs: open edges are joined, windings
//! made to agree (a soup of triangles has none before), the lumen is taken out of a wall, sheets are parted, holes filled.

use serde::{Deserialize, Serialize};

use super::fill::{Filled, fill_in_slices};
use super::split::{Split, split};
use super::wall::{Lumen, Wall, WallFound, find_in_slices};
use super::weld::{Welded, weld_in_slices};
use crate::task::Yielder;
use crate::{Array, Blend, Topology, TriMesh, blended, components, winding};
use lumen_message::messages;

/// What of a surface is mended. By default nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mending {
    /// Vertices on open edges become one where they are this near, in mm; `None`: none do.
    #[serde(default)]
    pub weld_mm: Option<f64>,
    /// Whether sheets that share an edge or a vertex are parted.
    #[serde(default)]
    pub split: bool,
    /// Holes in walls are filled up to this distance across, in mm; `None`: none is.
    #[serde(default)]
    pub fill_mm: Option<f64>,
    /// Whether the lumen is taken where the surface is a wall with two sides.
    #[serde(default)]
    pub lumen: bool,
}

impl Mending {
    /// The tolerance that can be asked for, in mm.
    pub const WELD_MM: std::ops::RangeInclusive<f64> = 1e-6..=100.0;
    /// The size of holes that can be asked for, in mm.
    pub const FILL_MM: std::ops::RangeInclusive<f64> = 0.001..=1000.0;

    /// The size to be asked for that fills a hole of `mm`: the next tenth of a mm above.
    pub fn filling(mm: f64) -> f64 {
        (((mm * 10.0).ceil() + 1.0) / 10.0).clamp(*Self::FILL_MM.start(), *Self::FILL_MM.end())
    }

    /// Whether nothing is mended.
    pub fn is_off(&self) -> bool {
        *self == Self::default()
    }
}

/// What mending did. The names of the fields are public and stay.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MendReport {
    /// Vertices on open edges that became one with another.
    pub vertices_welded: usize,
    /// Vertices on open edges where the triangles are too small for the tolerance, so that less was taken.
    pub weld_limited: usize,
    /// Triangles that were turned to agree with their neighbours after a weld or a split.
    pub reoriented_triangles: usize,
    /// Pieces that then faced inwards and were turned.
    pub components_turned: usize,
    /// The wall of which the lumen was taken, or would have been.
    pub wall: Option<Wall>,
    /// Triangles of the wall that were left out with its outer side and rims.
    pub wall_triangles_left_out: usize,
    /// Whether a wall's sides could not be told apart, so that its lumen was not taken.
    pub wall_not_parted: bool,
    /// Edges of more than two triangles that were parted.
    pub edges_split: usize,
    /// Vertices that were divided between the sheets that met there.
    pub vertices_split: usize,
    /// Triangles over the same three vertices as another that were left out.
    pub duplicates_left_out: usize,
    /// Holes that were filled.
    pub holes_filled: usize,
    /// Holes within the limit that could not be filled.
    pub holes_left: usize,
    /// Triangles in the patches.
    pub triangles_added: usize,
}

impl MendReport {
    /// What of that which was `asked` for was not done.
    pub fn warnings(&self, asked: &Mending) -> Vec<MendWarning> {
        let mut warnings = Vec::new();
        if let Some(mm) = asked.weld_mm.filter(|_| self.weld_limited > 0) {
            warnings.push(MendWarning::WeldLimited { vertices: self.weld_limited, mm });
        }
        if asked.lumen && self.wall_not_parted {
            warnings.push(MendWarning::WallNotParted);
        } else if asked.lumen && self.wall.is_none() {
            warnings.push(MendWarning::NoWall);
        }
        if self.holes_left > 0 {
            warnings.push(MendWarning::HolesLeft { count: self.holes_left });
        }
        warnings
    }
}

messages! {
    /// What mending was asked for and did not do.
    #[derive(Clone, Debug, PartialEq)]
    pub enum MendWarning {
        /// Triangles are too small for the tolerance.
        "errors-weld-limited" WeldLimited {
            /// Vertices on open edges where less was taken.
            vertices: usize,
            /// The tolerance in mm.
            mm: f64,
        } => "At {vertices} vertices on open edges less than {mm} mm was welded: their triangles are as small.",
        /// The sides of a wall cannot be told apart.
        "errors-wall-not-parted" WallNotParted =>
            "The lumen was not taken: the sides of the wall cannot be told apart.",
        /// There is no wall to take the lumen of.
        "errors-no-wall" NoWall => "The surface is no wall with two sides: it is taken as it is.",
        /// Holes could not be filled.
        "errors-holes-left" HolesLeft {
            /// Those within the limit.
            count: usize,
        } => (
            count,
            "{count} hole within the limit could not be filled without crossing the surface.",
            "{count} holes within the limit could not be filled without crossing the surface."
        ),
    }
}

/// A surface that was mended.
#[derive(Clone, Debug, PartialEq)]
pub struct Mended {
    /// The surface.
    pub mesh: TriMesh,
    /// Its arrays.
    pub arrays: Vec<Array>,
    /// What was done.
    pub report: MendReport,
}

/// Mends `mesh`, whose triangles repeat no vertex, with its arrays. Parting sheets and making windings agree are one piece
/// each.
pub async fn mend(mesh: TriMesh, arrays: Vec<Array>, asked: Mending, yielder: &Yielder) -> Mended {
    let mut made = Mended { mesh, arrays, report: MendReport::default() };
    if let Some(tolerance) = asked.weld_mm {
        let Welded { mesh, vertices, joined, limited } =
            weld_in_slices(&made.mesh, tolerance, &yielder.part(0.0..0.2)).await;
        (made.report.vertices_welded, made.report.weld_limited) = (joined, limited);
        made.take(mesh, Some(&vertices), None);
        yielder.rest(0.2).await;
        made.orient();
    }
    yielder.rest(0.25).await;
    // Where its sides do not agree there is no wall to be found, as `Faults` finds none.
    if asked.lumen && made.topology().is_consistent() {
        let WallFound { wall, lumen } = find_in_slices(&made.mesh, None, true, &yielder.part(0.25..0.5)).await;
        made.take_lumen(wall, lumen);
    }
    yielder.rest(0.5).await;
    if asked.split {
        made.split();
        yielder.rest(0.6).await;
        made.orient();
    }
    yielder.rest(0.65).await;
    if let Some(limit) = asked.fill_mm {
        let Filled { mesh, vertices, triangles, filled, left } =
            fill_in_slices(&made.mesh, limit, &yielder.part(0.65..1.0)).await;
        (made.report.holes_filled, made.report.holes_left) = (filled, left);
        made.report.triangles_added = mesh.triangles.len() - made.mesh.triangles.len();
        made.take(mesh, Some(&vertices), Some(&triangles));
    }
    made
}

impl Mended {
    /// Goes over to what a step made.
    fn take(&mut self, mesh: TriMesh, vertices: Option<&Blend>, triangles: Option<&Blend>) {
        if !self.arrays.is_empty() {
            let own = |count: usize| Blend::of_rows(0..count as u32);
            let vertices = vertices.map_or_else(|| own(mesh.positions.len()), Clone::clone);
            let triangles = triangles.map_or_else(|| own(mesh.triangles.len()), Clone::clone);
            self.arrays = blended(&self.arrays, &vertices, &triangles);
        }
        self.mesh = mesh;
    }

    fn topology(&self) -> Topology {
        Topology::new(self.mesh.positions.len(), &self.mesh.triangles)
    }

    /// Makes windings agree, and pieces face outwards, where they can.
    fn orient(&mut self) {
        let pieces = components(self.mesh.positions.len(), &self.mesh.triangles);
        let mut topology = self.topology();
        let mut orientable = vec![true; pieces.count()];
        if !topology.is_consistent() {
            let made = winding::make_consistent(&mut self.mesh.triangles, &topology, &pieces);
            self.report.reoriented_triangles += made.reversed;
            orientable = made.orientable;
            topology = self.topology();
        }
        self.report.components_turned += winding::turn_outward(&mut self.mesh, &topology, &pieces, &orientable);
    }

    fn split(&mut self) {
        let Split { mesh, vertices, triangles, edges, divided, duplicates } = split(&self.mesh);
        self.take(mesh, Some(&vertices), Some(&triangles));
        self.report.edges_split = edges;
        self.report.vertices_split = divided;
        self.report.duplicates_left_out = duplicates;
    }

    fn take_lumen(&mut self, wall: Option<Wall>, lumen: Option<Lumen>) {
        self.report.wall = wall;
        self.report.wall_not_parted = wall.is_some() && lumen.is_none();
        if let Some(Lumen { mesh, vertices, triangles, left_out, .. }) = lumen {
            self.report.wall_triangles_left_out = left_out;
            self.take(mesh, Some(&vertices), Some(&triangles));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use proptest::prelude::*;

    use super::super::faults::Faults;
    use super::super::holes::tests::pierced;
    use super::*;
    use crate::Vec3;
    use crate::arrays::{Association, Values};
    use crate::shapes::{icosphere, tube};
    use crate::task::{Budget, Progress, Running, at_once};

    const ALL: Mending = Mending { weld_mm: Some(0.01), split: true, fill_mm: Some(3.0), lumen: true };

    fn mended(mesh: &TriMesh, asked: Mending) -> Mended {
        at_once(mend(mesh.clone(), Vec::new(), asked, &Yielder::never()))
    }

    #[test]
    fn nothing_asked_for_changes_nothing_and_neither_does_a_sound_surface() {
        let mesh = icosphere(3, 10.0, Vec3::ONE);
        for asked in [Mending::default(), ALL] {
            let found = mended(&mesh, asked);
            assert_eq!((found.mesh, found.report), (mesh.clone(), MendReport::default()));
        }
    }

    #[test]
    fn arrays_follow_whatever_is_done_and_slices_do_not_matter() {
        let mut mesh = pierced(&tube(40, 60, 40.0, |_| 4.0), &[Vec3::new(4.0, 0.0, 20.0)], 1.0);
        let [a, b, _] = mesh.triangles[500];
        let fin = mesh.positions[a as usize] * Vec3::new(1.5, 1.5, 1.0);
        mesh.positions.push(fin);
        mesh.triangles.push([b, a, mesh.positions.len() as u32 - 1]);
        let heights: Vec<f32> = mesh.positions.iter().map(|p| p.z).collect();
        let numbers: Vec<f32> = (0..mesh.triangles.len()).map(|t| mesh.corners(t)[0].z).collect();
        let arrays = vec![
            Array::new("z", Association::Point, 1, Values::from_floats(&heights)),
            Array::new("t", Association::Triangle, 1, Values::from_floats(&numbers)),
        ];
        let whole = at_once(mend(mesh.clone(), arrays.clone(), ALL, &Yielder::never()));
        assert_eq!((whole.report.edges_split, whole.report.holes_filled), (1, 1));
        assert_eq!(
            [whole.arrays[0].len(), whole.arrays[1].len()],
            [whole.mesh.positions.len(), whole.mesh.triangles.len()]
        );
        for (v, p) in whole.mesh.positions.iter().enumerate() {
            assert!((whole.arrays[0].values.get(v) - f64::from(p.z)).abs() < 1.0, "new ones are as those around");
        }
        let mut slices = Running::new(|yielder| async move { mend(mesh, arrays, ALL, &yielder).await });
        let sliced = loop {
            if let Progress::Done(sliced) = slices.advance(Budget::new(Duration::ZERO)) {
                break sliced;
            }
        };
        assert_eq!(sliced, whole);
    }

    proptest! {
        #[test]
        fn nothing_makes_it_panic_and_what_is_split_is_manifold(
            places in prop::collection::vec(prop::array::uniform3(-5i8..5), 3..10),
            corners in prop::collection::vec(prop::array::uniform3(0usize..10), 1..40),
            scale in prop::sample::select(vec![0.001f32, 1.0, 1000.0]),
        ) {
            let positions: Vec<Vec3> = places.iter().map(|p| Vec3::from(p.map(f32::from)) * scale).collect();
            let count = positions.len();
            let mut triangles: Vec<[u32; 3]> = corners.iter().map(|t| t.map(|v| (v % count) as u32)).collect();
            triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
            let mesh = crate::compacted(&positions, triangles);
            let asked = Mending { weld_mm: Some(f64::from(scale)), fill_mm: Some(f64::from(scale) * 3.0), ..ALL };
            let found = mended(&mesh, asked);
            let topology = Topology::new(found.mesh.positions.len(), &found.mesh.triangles);
            let faults = Faults::of(&found.mesh, &topology);
            prop_assert_eq!((faults.non_manifold_edges.len(), faults.non_manifold_vertices.len()), (0, 0));
        }
    }
}
