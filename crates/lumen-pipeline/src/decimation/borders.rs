//! Borders between labels, held as feature edges where that is asked for.
//!
//! An edge between two triangles of different labels is a border. A vertex with two of them goes along them alone, and its
//! distance from the line between its neighbours there counts, as along a feature edge of Schroeder's; but a border is never
//! given up. Where borders meet or end, and where three edges are left of a border that is closed, a vertex stays. What comes
//! to a border from beside it comes to where the border is.

use std::collections::BTreeMap;

use super::rings::{BORDER, Rings, neighbour};
use lumen_mesh::arrays::Association;
use lumen_mesh::{Array, Topology, TriMesh};

/// What borders leave a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Border {
    /// It lies on none.
    None,
    /// It may go to these neighbours, by their place in the ring.
    Along([usize; 2]),
    /// It has to stay.
    Stays,
}

/// What they leave `v`.
pub(super) fn border_of(rings: &Rings, v: u32) -> Border {
    let ring = rings.around(v);
    let mut ends = (0..ring.len()).filter(|&i| ring[i] & BORDER != 0);
    match [ends.next(), ends.next(), ends.next()] {
        [None, ..] => Border::None,
        [Some(a), Some(b), None] if !rings.is_open(v) => {
            let end = neighbour(ring[b]);
            let closes = |&entry: &u32| entry & BORDER != 0 && neighbour(entry) == end;
            if rings.around(neighbour(ring[a])).iter().any(closes) { Border::Stays } else { Border::Along([a, b]) }
        }
        _ => Border::Stays,
    }
}

/// Marks the borders around `v`, which no vertex has left yet, on this side; `labels` has a number for each triangle.
pub(super) fn mark(rings: &mut Rings, v: u32, mesh: &TriMesh, topology: &Topology, labels: &[u32]) {
    for i in 0..rings.around(v).len() {
        let other = rings.nodes[neighbour(rings.around(v)[i]) as usize];
        let mut beside = topology.triangles_on(&mesh.triangles, rings.nodes[v as usize], other);
        if let [Some(a), Some(b), None] = [beside.next(), beside.next(), beside.next()]
            && labels[a as usize] != labels[b as usize]
        {
            rings.set_border(v, i);
        }
    }
}

/// A number for each triangle of `mesh`, another wherever one of the label arrays has another label; `None` where there is no
/// border. The label of a triangle whose vertices have labels is that of two of them, or the least. Arrays of more labels
/// than are listed number things, and have none.
pub(crate) fn labels_of(mesh: &TriMesh, arrays: &[Array]) -> Option<Vec<u32>> {
    let mut labels: Option<Vec<u32>> = None;
    for array in arrays.iter().filter(|array| array.info().labels.len() > 1) {
        let of_triangle = |t: usize| match array.on {
            Association::Triangle => array.values.get(t),
            Association::Point => {
                let [a, b, c] = mesh.triangles[t].map(|v| array.values.get(v as usize));
                if b == c {
                    b
                } else if a == b || a == c {
                    a
                } else {
                    a.min(b).min(c)
                }
            }
        };
        let before = labels.take().unwrap_or_else(|| vec![0; mesh.triangles.len()]);
        let mut known = BTreeMap::new();
        let number = |(t, before): (usize, u32)| {
            let next = known.len() as u32;
            *known.entry((before, of_triangle(t).to_bits())).or_insert(next)
        };
        labels = Some(before.into_iter().enumerate().map(number).collect());
    }
    labels
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::{Holds, decimate_in_slices};
    use super::*;
    use crate::progressive::ProgressiveMesh;
    use crate::settings::{Decimation, Method, Target};
    use crate::task::{Yielder, at_once};
    use lumen_mesh::arrays::{Scalar, Values};
    use lumen_mesh::shapes::{square, tube};

    fn decimated(mesh: &TriMesh, method: Method, labels: Option<&[u32]>) -> ProgressiveMesh {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let settings = Decimation { method, ..Decimation::default() };
        let holds = Holds { labels, ..Holds::default() };
        let levels = at_once(decimate_in_slices(mesh, &topology, &settings, holds, &Yielder::never())).progressive;
        levels.assert_well_formed();
        levels
    }

    fn labels(array: Array, mesh: &TriMesh) -> Vec<u32> {
        labels_of(mesh, &[array]).unwrap()
    }

    fn of_triangles(values: Vec<f32>) -> Array {
        let mut numbers = Values::new(Scalar::I32);
        values.into_iter().for_each(|value| numbers.push(f64::from(value)));
        Array::new("RegionId", Association::Triangle, 1, numbers)
    }

    /// Whether the triangles of a level lie on one side each, by `side` of a point: negative, positive, or 0 on the border.
    fn are_apart(level: &TriMesh, side: impl Fn(Vec3) -> f32) -> bool {
        level.triangles.iter().all(|corners| {
            let sides = corners.map(|v| side(level.positions[v as usize]));
            let near = |x: f32| x.abs() < 1e-4;
            sides.iter().all(|&x| x > 0.0 || near(x)) || sides.iter().all(|&x| x < 0.0 || near(x))
        })
    }

    fn at_90(levels: &ProgressiveMesh) -> TriMesh {
        levels.extract(&levels.level(Target::Reduction(900)).triangles)
    }

    #[test]
    fn a_straight_border_in_a_plane_stays_where_it_is() {
        let mesh = square(40, 40.0, 0.0);
        let middle = |t: &[u32; 3]| t.iter().map(|&v| mesh.positions[v as usize].x).sum::<f32>() / 3.0;
        let found = labels(of_triangles(mesh.triangles.iter().map(|t| f32::from(middle(t) > 17.0)).collect()), &mesh);
        for method in Method::ALL {
            let held = at_90(&decimated(&mesh, method, Some(&found)));
            assert!((318..=320).contains(&held.triangles.len()), "{method:?}: {}", held.triangles.len());
            assert!(are_apart(&held, |p| p.x - 17.0), "{method:?}");
            // Without labels there is nothing in a plane that a vertex would keep to.
            assert!(!are_apart(&at_90(&decimated(&mesh, method, None)), |p| p.x - 17.0), "{method:?}");
        }
    }

    #[test]
    fn a_border_around_a_tube_stays_a_circle_whether_triangles_or_vertices_are_labelled() {
        let mesh = tube(48, 120, 60.0, |_| 4.0);
        let middle = |t: &[u32; 3]| t.iter().map(|&v| mesh.positions[v as usize].z).sum::<f32>() / 3.0;
        let heights: Vec<f32> = mesh.positions.iter().map(|p| p.z).collect();
        let border = *heights.iter().min_by(|a, b| (*a - 25.0).abs().total_cmp(&(*b - 25.0).abs())).unwrap();
        let of_cells = of_triangles(mesh.triangles.iter().map(|t| f32::from(middle(t) > border)).collect());
        let mut values = Values::new(Scalar::U8);
        heights.iter().for_each(|&z| values.push(f64::from(u8::from(z > border + 0.1))));
        let of_vertices = Array::new("part", Association::Point, 1, values);
        for (what, array, is_circle) in [("triangles", of_cells, true), ("vertices", of_vertices, false)] {
            let found = labels(array, &mesh);
            for method in Method::ALL {
                let levels = decimated(&mesh, method, Some(&found));
                let held = at_90(&levels);
                assert!(held.triangles.len() <= mesh.triangles.len() / 10, "{what}, {method:?}");
                if is_circle {
                    assert!(are_apart(&held, |p| p.z - border), "{what}, {method:?}");
                    let on: Vec<&Vec3> = held.positions.iter().filter(|p| (p.z - border).abs() < 1e-4).collect();
                    assert!(
                        on.len() >= 3 && on.iter().all(|p| (p.truncate().length() - 4.0).abs() < 1e-4),
                        "{method:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn where_three_labels_meet_the_vertex_stays_and_none_is_lost() {
        let mesh = square(30, 30.0, 0.0);
        let part = |t: &[u32; 3]| {
            let [x, y] = [0, 1].map(|axis| t.iter().map(|&v| mesh.positions[v as usize][axis]).sum::<f32>() / 3.0);
            if x > 12.0 { 2.0 } else { f32::from(y > 9.0) }
        };
        let found = labels(of_triangles(mesh.triangles.iter().map(part).collect()), &mesh);
        for method in Method::ALL {
            let levels = decimated(&mesh, method, Some(&found));
            let coarsest = levels.extract(&levels.level(Target::Triangles(1)).triangles);
            assert!(coarsest.positions.contains(&Vec3::new(12.0, 9.0, 0.0)), "{method:?}");
            assert!(are_apart(&coarsest, |p| p.x - 12.0), "{method:?}");
        }
    }

    #[test]
    fn what_is_no_label_and_one_label_alone_make_no_border() {
        let mesh = square(2, 2.0, 0.0);
        let numbers = Array::new(
            "Area",
            Association::Triangle,
            1,
            Values::from_floats(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]),
        );
        assert_eq!(labels_of(&mesh, &[numbers]), None);
        assert_eq!(labels_of(&mesh, &[of_triangles(vec![3.0; 8])]), None);
        let one = decimated(&mesh, Method::Schroeder, Some(&[7; 8]));
        assert!(one == decimated(&mesh, Method::Schroeder, None));
    }
}
