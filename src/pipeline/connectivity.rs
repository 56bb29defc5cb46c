//! Connectivity: which pieces the surface has, and the ones that go on (the paper's section II-A).

use serde::{Deserialize, Serialize};

use super::settings::{Keep, SettingsError};
use crate::mesh::{Bounds, Components, TriMesh, components, triangle_area};

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

/// The pieces of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Connectivity {
    /// The piece of each triangle.
    pub labels: Components,
    /// The pieces, numbered by their first triangle.
    pub components: Vec<Component>,
}

impl Connectivity {
    /// Finds the pieces of `mesh`.
    pub fn of(mesh: &TriMesh) -> Self {
        let labels = components(mesh.positions.len(), &mesh.triangles);
        let empty = Component { triangles: 0, area_mm2: 0.0, bounds: Bounds::EMPTY };
        let mut pieces = vec![empty; labels.count()];
        for (t, &c) in labels.of_triangle.iter().enumerate() {
            let corners = mesh.corners(t);
            let piece = &mut pieces[c as usize];
            piece.triangles += 1;
            piece.area_mm2 += triangle_area(corners);
            piece.bounds = piece.bounds.joined(&Bounds::of(&corners));
        }
        Self { labels, components: pieces }
    }

    /// The part of `mesh` that `keep` names, and the number of the piece (none for all).
    ///
    /// # Errors
    /// When there is no such component.
    pub fn kept(&self, mesh: &TriMesh, keep: Keep) -> Result<TriMesh, SettingsError> {
        let chosen = match keep {
            Keep::All => None,
            Keep::Largest => self.labels.largest(),
            Keep::Component(c) if (c as usize) < self.components.len() => Some(c),
            Keep::Component(wanted) => {
                return Err(SettingsError::Component { wanted, count: self.components.len() });
            }
        };
        Ok(match chosen {
            Some(c) if self.components.len() > 1 => mesh.filtered(|t| self.labels.of_triangle[t] == c),
            _ => mesh.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn the_largest_piece_is_kept_and_the_others_can_be() {
        let positions: Vec<Vec3> = (0..7).map(|i| Vec3::new(i as f32, (i * i) as f32, 0.0)).collect();
        let mesh = TriMesh { positions, triangles: vec![[4, 5, 6], [0, 1, 2], [1, 3, 2]] };
        let found = Connectivity::of(&mesh);
        assert_eq!(found.components.iter().map(|c| c.triangles).collect::<Vec<_>>(), [1, 2]);
        assert_eq!(found.kept(&mesh, Keep::Largest).unwrap().triangles, [[0, 1, 2], [1, 3, 2]]);
        let small = found.kept(&mesh, Keep::Component(0)).unwrap();
        assert_eq!((small.positions.len(), small.triangles), (3, vec![[0, 1, 2]]));
        assert_eq!(found.kept(&mesh, Keep::All).unwrap(), mesh);
        assert!(found.kept(&mesh, Keep::Component(2)).is_err());
        assert_eq!(
            Connectivity::of(&TriMesh::default()).kept(&TriMesh::default(), Keep::Largest).unwrap(),
            TriMesh::default()
        );
    }
}
