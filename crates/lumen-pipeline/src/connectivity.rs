//! Connectivity: which pieces the surface has, and the ones that go on (the paper's section II-A).

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::settings::{Keep, SettingsError};
use lumen_mesh::{Bounds, Components, TriMesh, Vec3, components, triangle_area, used_vertices};

/// One connected piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Component {
    /// Its triangles.
    pub triangles: u32,
    /// Its area in mm2.
    pub area_mm2: f64,
    /// The box around it.
    pub bounds: Bounds,
}

/// The least part of the surface, by area, that the largest piece has where the others are left out without a word: three
/// quarters. The noisiest vessel known here, an MR angiogram cut at a threshold (`vmtk_aorta_mra_iso800`), has 75.5 % of its area
/// in the aorta and the rest in 300 specks of 2.3 % at most. Of two arteries, or a heart in its chambers, no piece has as much.
const KEPT_PART: f64 = 0.75;

/// What the largest piece leaves out, where that is much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOut {
    /// The part of the surface in percent, by area.
    pub percent: f64,
    /// In so many pieces.
    pub pieces: usize,
}

impl LeftOut {
    /// Of a surface of these pieces. Where somebody has chosen what is kept, they know what is left out.
    pub fn of(pieces: &[Component], keep: Keep) -> Option<Self> {
        let kept = pieces.iter().reduce(|most, next| if next.triangles > most.triangles { next } else { most })?;
        let whole: f64 = pieces.iter().map(|piece| piece.area_mm2).sum();
        let is_much = keep == Keep::Largest && kept.area_mm2 < KEPT_PART * whole;
        is_much.then(|| Self { percent: 100.0 * (1.0 - kept.area_mm2 / whole), pieces: pieces.len() - 1 })
    }
}

/// The rows of a surface that are kept, ascending.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeptRows {
    /// Its vertices.
    pub vertices: Vec<u32>,
    /// Its triangles.
    pub triangles: Vec<u32>,
}

/// The pieces of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Connectivity {
    /// The piece of each triangle.
    pub labels: Components,
    /// The pieces, numbered by their first triangle.
    pub components: Vec<Component>,
}

impl Connectivity {
    /// Finds the pieces of `mesh` and measures them.
    pub fn of(mesh: &TriMesh) -> Self {
        let mut found = Self::unmeasured(mesh);
        found.measure(mesh);
        found
    }

    /// Finds the pieces of `mesh`; [`Self::components`] is empty until [`Self::measure`].
    pub fn unmeasured(mesh: &TriMesh) -> Self {
        Self { labels: components(mesh.positions.len(), &mesh.triangles), components: Vec::new() }
    }

    /// Measures the pieces of `mesh`, in which they were found.
    pub fn measure(&mut self, mesh: &TriMesh) {
        let empty = Component { triangles: 0, area_mm2: 0.0, bounds: Bounds::EMPTY };
        self.components = vec![empty; self.labels.count()];
        let mut t = 0;
        for run in self.labels.of_triangle.chunk_by(|a, b| a == b) {
            let piece = &mut self.components[run[0] as usize];
            let (mut min, mut max) = (Vec3::from(piece.bounds.min), Vec3::from(piece.bounds.max));
            let mut area = piece.area_mm2;
            for triangle in &mesh.triangles[t..t + run.len()] {
                let corners = triangle.map(|v| mesh.positions[v as usize]);
                area += triangle_area(corners);
                for p in corners {
                    (min, max) = (min.min(p), max.max(p));
                }
            }
            piece.triangles += run.len() as u32;
            piece.area_mm2 = area;
            piece.bounds = Bounds { min: min.into(), max: max.into() };
            t += run.len();
        }
    }

    /// The part of `mesh` that `keep` names: all of it where it is the only piece.
    ///
    /// # Errors
    /// When there is no such component.
    pub fn kept(&self, mesh: &Arc<TriMesh>, keep: Keep) -> Result<Arc<TriMesh>, SettingsError> {
        Ok(match self.chosen(keep)? {
            Some(is_kept) => Arc::new(mesh.filtered(|t| is_kept[self.labels.of_triangle[t] as usize])),
            None => mesh.clone(),
        })
    }

    /// Which vertices and triangles of `mesh` those of [`Self::kept`] are; `None` where that is the whole surface.
    ///
    /// # Errors
    /// When there is no such component.
    pub fn kept_rows(&self, mesh: &TriMesh, keep: Keep) -> Result<Option<KeptRows>, SettingsError> {
        Ok(self.chosen(keep)?.map(|is_kept| {
            let of_triangle = &self.labels.of_triangle;
            let is_in = |&t: &u32| is_kept[of_triangle[t as usize] as usize];
            let rows: Vec<u32> = (0..of_triangle.len() as u32).filter(is_in).collect();
            let triangles: Vec<[u32; 3]> = rows.iter().map(|&t| mesh.triangles[t as usize]).collect();
            KeptRows { vertices: used_vertices(mesh.positions.len(), &triangles), triangles: rows }
        }))
    }

    /// Whether each piece is of those that `keep` names; `None` where they are the whole surface.
    fn chosen(&self, keep: Keep) -> Result<Option<Vec<bool>>, SettingsError> {
        self.check(keep)?;
        let largest = self.labels.largest();
        let is_kept: Vec<bool> = (0..self.labels.count() as u32).map(|piece| keep.names(piece, largest)).collect();
        Ok(is_kept.contains(&false).then_some(is_kept))
    }

    /// Whether the pieces that `keep` names are there.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self, keep: Keep) -> Result<(), SettingsError> {
        let count = self.labels.count();
        let missing = keep.numbers().iter().find(|&&wanted| wanted as usize >= count);
        missing.map_or(Ok(()), |&wanted| Err(SettingsError::Component { wanted, count }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vertices of a parabola.
    fn row(count: u8) -> TriMesh {
        let at = |i: u8| Vec3::new(f32::from(i), f32::from(i) * f32::from(i), 0.0);
        TriMesh { positions: (0..count).map(at).collect(), triangles: Vec::new() }
    }

    #[test]
    fn the_largest_piece_is_kept_and_the_others_can_be() {
        let mesh = Arc::new(TriMesh { triangles: vec![[4, 5, 6], [0, 1, 2], [1, 3, 2]], ..row(7) });
        let found = Connectivity::of(&mesh);
        assert_eq!(found.components.iter().map(|c| c.triangles).collect::<Vec<_>>(), [1, 2]);
        assert_eq!(found.kept(&mesh, Keep::Largest).unwrap().triangles, [[0, 1, 2], [1, 3, 2]]);
        let small = found.kept(&mesh, Keep::Component(0)).unwrap();
        assert_eq!((small.positions.len(), &small.triangles[..]), (3, &[[0, 1, 2]][..]));
        assert_eq!(found.kept(&mesh, Keep::All).unwrap(), mesh);
        let both = Keep::pieces(&[1, 0]).unwrap();
        assert_eq!((found.kept(&mesh, both).unwrap(), found.kept_rows(&mesh, both)), (mesh.clone(), Ok(None)));
        assert!(found.kept(&mesh, Keep::pieces(&[0, 2]).unwrap()).is_err());
        let three = Arc::new(TriMesh { triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]], ..row(9) });
        let some = Connectivity::of(&three).kept(&three, Keep::pieces(&[0, 2]).unwrap()).unwrap();
        assert_eq!((some.positions.len(), &some.triangles[..]), (6, &[[0, 1, 2], [3, 4, 5]][..]));
        assert!(found.kept(&mesh, Keep::Component(2)).is_err());
        let nothing = Arc::new(TriMesh::default());
        assert_eq!(Connectivity::of(&nothing).kept(&nothing, Keep::Largest).unwrap(), nothing);
    }

    #[test]
    fn what_is_left_out_is_told_where_it_is_more_than_a_quarter_and_nobody_has_chosen_it() {
        let piece = |triangles, area_mm2| Component { triangles, area_mm2, bounds: Bounds::EMPTY };
        // The largest by triangles, as it is kept: of two that have as many the first.
        let heart = [piece(10, 40.0), piece(50, 24.0), piece(50, 30.0), piece(3, 6.0)];
        let found = LeftOut::of(&heart, Keep::Largest).unwrap();
        assert!((found.percent - 76.0).abs() < 1e-9 && found.pieces == 3, "{found:?}");
        assert_eq!([Keep::All, Keep::Component(1)].map(|keep| LeftOut::of(&heart, keep)), [None; 2]);
        let beside = |area_mm2| LeftOut::of(&[piece(10, 75.0), piece(5, area_mm2)], Keep::Largest);
        assert!(beside(24.9).is_none() && beside(25.1).is_some());
        assert_eq!(LeftOut::of(&[piece(10, 80.0)], Keep::Largest), None);
        assert_eq!(LeftOut::of(&[], Keep::Largest), None);
    }

    #[test]
    fn pieces_are_measured_however_their_triangles_take_turns() {
        let positions =
            vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::splat(5.0), Vec3::new(5.0, 7.0, 5.0), Vec3::new(9.0, 5.0, 5.0)];
        let mesh = TriMesh { positions, triangles: vec![[0, 1, 2], [3, 4, 5], [0, 2, 1], [5, 4, 3]] };
        let [small, large] = &Connectivity::of(&mesh).components[..] else { panic!("there are two pieces") };
        assert_eq!((small.triangles, small.area_mm2, small.bounds.max), (2, 1.0, [1.0, 1.0, 0.0]));
        assert_eq!((large.triangles, large.area_mm2), (2, 8.0));
        assert_eq!((large.bounds.min, large.bounds.max), ([5.0; 3], [9.0, 7.0, 5.0]));
    }
}
