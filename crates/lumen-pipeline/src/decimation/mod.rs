//! Decimation to a progressive mesh, by one of two methods ([`Method`](super::settings::Method)): `schroeder.rs` and
//! `quadric.rs`.
//!
//! A method judges each vertex: by what distance the surface would suffer without it, and where it could go. Vertices
//! go in rounds of a threshold that grows, as in Schroeder, Zarge and Lorensen, "Decimation of triangle meshes" (1992):
//! in each round those whose distance is below it, the smallest distances first while they are few, along a
//! space-filling curve while they are many. (The paper's text has the test the wrong way round; Schroeder's own deletes
//! when the distance is *less* than the threshold, and so does this.) Deleting a vertex and patching the hole is
//! expressed as a collapse onto one of its neighbours, so that the run is a progressive mesh (Hoppe 1996): one run to
//! the last vertex that can go has every reduction rate in it.
//!
//! Every collapse, by whichever method,
//!
//! - passes the link condition (Dey, Edelsbrunner, Guha and Nekhayev 1999): no topology changes, no open end falls
//!   below three edges (`rings.rs`);
//! - folds no triangle over and makes no sliver; for a vertex that does not meet the strict limits they are eased, step by
//!   step, at the price of waiting longer, down to "does not fold" (`one_ring.rs`);
//! - makes no triangle run into another (`guard/`).
//!
//! Borders between labels are held where that is asked for (`borders.rs`), rims of flat caps among them, with the caps' areas
//! (`cap_areas.rs`).
//!
//! Where thin vessels are spared, the distance of a vertex counts by the width of its vessel, for the order alone
//! (`weights.rs`).
//!
//! The error of a step is the method's measure, no bound of the true deviation: measure that (`super::deviation`).

mod borders;
mod cap_areas;
mod collapse;
mod fan;
mod guard;
mod method;
mod one_ring;
mod order;
mod quadric;
mod rings;
mod schedule;
mod schroeder;
mod task;
mod ways;
mod weights;

pub(super) use self::borders::labels_of;
pub use self::cap_areas::SPENT;
pub use self::task::{Decimated, Holds, decimate_in_slices};
pub use self::ways::{CollapseStatus, Ways};
use super::progressive::ProgressiveMesh;
use super::settings::Decimation;
use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{Topology, TriMesh};

/// Decimates `mesh` as far as it goes.
pub fn decimate(mesh: &TriMesh, topology: &Topology, settings: &Decimation) -> ProgressiveMesh {
    at_once(decimate_in_slices(mesh, topology, settings, Holds::default(), &Yielder::never())).progressive
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::{Method, Target};
    use glam::Vec3;
    use lumen_mesh::self_intersections;
    use lumen_mesh::shapes::{icosphere, joined, tube};
    use lumen_mesh::split_mix::SplitMix64;

    fn levels_of(mesh: &TriMesh, method: Method) -> ProgressiveMesh {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let levels = decimate(mesh, &topology, &Decimation { method, ..Decimation::default() });
        levels.assert_well_formed();
        levels
    }

    #[test]
    fn the_two_faces_of_a_thin_wall_never_cross() {
        let outer = icosphere(5, 10.0, Vec3::ZERO);
        let mut inner = icosphere(5, 9.8, Vec3::ZERO);
        inner.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        let wall = joined(&[outer.clone(), inner.clone()]);
        for method in Method::ALL {
            let together = levels_of(&wall, method);
            let alone = [&outer, &inner].map(|mesh| levels_of(mesh, method));
            for rate in [500, 900, 950, 980, 995] {
                let target = Target::Reduction(rate);
                let level = together.extract(&together.level(target).triangles);
                assert!(self_intersections(&level).is_empty(), "{method:?} at {rate}");
            }
            // Reduced apart they do: chords of the outer sphere lie farther inside than the wall is thick.
            let apart = alone.map(|levels| levels.extract(&levels.level(Target::Reduction(995)).triangles));
            assert!(!self_intersections(&joined(&apart)).is_empty(), "{method:?} has nothing to keep apart");
        }
    }

    #[test]
    fn a_sphere_of_quadrics_keeps_its_volume_and_that_of_vertices_shrinks() {
        let sphere = icosphere(5, 10.0, Vec3::ZERO);
        let volume = |mesh: &TriMesh| lumen_mesh::volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
        let [schroeder, quadric] = Method::ALL.map(|method| {
            let levels = levels_of(&sphere, method);
            let level = levels.extract(&levels.level(Target::Reduction(900)).triangles);
            volume(&level) / volume(&sphere) - 1.0
        });
        // Points of a sphere make a polyhedron inside of it.
        assert!(schroeder < -1e-3, "{schroeder}");
        assert!(quadric.abs() < 1e-4, "{quadric}");
    }

    /// `mesh` with vessels of these widths.
    fn spared(mesh: &TriMesh, method: Method, widths: &[f32]) -> ProgressiveMesh {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let settings = Decimation { method, ..Decimation::default() };
        let holds = Holds { widths: Some(widths), ..Holds::default() };
        let levels = at_once(decimate_in_slices(mesh, &topology, &settings, holds, &Yielder::never())).progressive;
        levels.assert_well_formed();
        levels
    }

    #[test]
    fn thin_vessels_are_spared_by_the_root_of_the_ratio_for_each_length() {
        // Errors on a sphere of radius r with edges h grow with h^2 / r, and priorities of quadrics with h^3 / r. So of
        // two spheres at one threshold the number of triangles is as r for Schroeder and as r^(4/3) for quadrics; spared,
        // as r^(1/2) and r^(2/3).
        let radii = [8.0f32, 1.0];
        let spheres = radii.map(|radius| icosphere(6, radius, Vec3::X * 3.0 * radius));
        let (mesh, half) = (joined(&spheres), spheres[0].positions.len());
        let widths: Vec<f32> = (0..mesh.positions.len()).map(|v| radii[usize::from(v >= half)]).collect();
        for (method, plain, root) in [(Method::Schroeder, 1.0, 0.5), (Method::Quadric, 4.0 / 3.0, 2.0 / 3.0)] {
            let exponent = |levels: &ProgressiveMesh| {
                let level = levels.extract(&levels.level(Target::Triangles(4000)).triangles);
                assert!((3999..=4000).contains(&level.triangles.len()), "{method:?}");
                let thick = level.triangles.iter().filter(|t| level.positions[t[0] as usize].x > 10.0).count();
                (thick as f64 / (level.triangles.len() - thick) as f64).ln() / 8f64.ln()
            };
            let found = [exponent(&levels_of(&mesh, method)), exponent(&spared(&mesh, method, &widths))];
            assert!((found[0] - plain).abs() < 0.08 && (found[1] - root).abs() < 0.08, "{method:?}: {found:?}");
        }
    }

    #[test]
    fn where_all_vessels_are_equally_wide_or_none_is_the_order_is_the_plain_one() {
        let mesh = joined(&[icosphere(4, 3.0, Vec3::ZERO), tube(24, 60, 40.0, |z| 2.0 + 0.1 * libm::sinf(z))]);
        for method in Method::ALL {
            let plain = levels_of(&mesh, method);
            for width in [0.7, f32::INFINITY, f32::NAN, 0.0] {
                assert!(spared(&mesh, method, &vec![width; mesh.positions.len()]) == plain, "{method:?}, {width}");
            }
        }
    }

    #[test]
    fn what_is_spared_does_not_depend_on_the_scale() {
        let mesh = joined(&[icosphere(4, 3.0, Vec3::ZERO), tube(24, 60, 40.0, |z| 1.0 + 0.05 * z)]);
        let widths: Vec<f32> = mesh.positions.iter().map(|p| 1.0 + 0.05 * p.z.max(0.0)).collect();
        for method in Method::ALL {
            let here = spared(&mesh, method, &widths);
            for scale in [1024.0, 1.0 / 1024.0] {
                let mut scaled = mesh.clone();
                scaled.positions.iter_mut().for_each(|p| *p *= scale);
                let wider: Vec<f32> = widths.iter().map(|width| width * scale).collect();
                let there = spared(&scaled, method, &wider);
                assert!(there.triangles == here.triangles && there.parents == here.parents, "{method:?} at {scale}");
                let errors: Vec<f32> = here.errors.iter().map(|error| error * scale).collect();
                assert!(there.errors == errors, "what is told is in mm");
            }
        }
    }

    #[test]
    fn a_stray_leaves_the_rest_as_it_would_be_without_it() {
        let sphere = icosphere(4, 10.0, Vec3::new(3.0, 2.0, 1.0));
        let stray = |far: f32| {
            let positions = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * far + Vec3::splat(far)).to_vec();
            joined(&[sphere.clone(), TriMesh { positions, triangles: vec![[0, 1, 2]] }])
        };
        let spike = |far: f32| {
            let mut mesh = sphere.clone();
            mesh.positions[77] *= far;
            mesh
        };
        // The root mean square distance of the vertices of the sphere from it, and how many there are.
        let off = |mesh: &TriMesh, method: Method| {
            let levels = levels_of(mesh, method);
            let level = levels.extract(&levels.level(Target::Triangles(500)).triangles);
            let radii = level.positions.iter().map(|p| (p.as_dvec3() - glam::DVec3::new(3.0, 2.0, 1.0)).length());
            let near: Vec<f64> =
                radii.filter(|radius| *radius < 12.0).map(|radius| (radius - 10.0) * (radius - 10.0)).collect();
            ((near.iter().sum::<f64>() / near.len() as f64).sqrt(), near.len())
        };
        for method in Method::ALL {
            let (alone, _) = off(&sphere, method);
            for far in [1e6, 1e8] {
                for (name, mesh) in [("stray", stray(far)), ("spike", spike(far))] {
                    let (rest, count) = off(&mesh, method);
                    assert!(
                        rest < 1.5 * alone + 1e-4,
                        "{method:?}, {name} at {far}: {rest} mm off, {alone} without it"
                    );
                    assert!((235..=253).contains(&count), "{method:?}, {name} at {far}: {count} vertices");
                }
            }
        }
    }

    #[test]
    fn the_order_of_the_file_does_not_matter() {
        let sphere = icosphere(4, 10.0, Vec3::new(3.0, 2.0, 1.0));
        let mut turned = sphere.clone();
        turned.triangles.reverse();
        turned.triangles.iter_mut().step_by(3).for_each(|t| t.rotate_left(1));
        for method in Method::ALL {
            let [a, b] = [&sphere, &turned].map(|mesh| levels_of(mesh, method));
            assert_eq!(a.triangles_after(2000), b.triangles_after(2000));
            let [worst_a, worst_b] = [a, b].map(|levels| levels.errors[2000]);
            assert!((worst_a / worst_b - 1.0).abs() < 0.05, "{method:?}: {worst_a} {worst_b}");
        }
    }

    /// A cylinder of `n` sides, each end a fan around its middle.
    fn cylinder(n: u32) -> TriMesh {
        let at = |i: u32, z: f32| {
            let angle = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
            Vec3::new(50.0 * libm::cos(angle) as f32, 50.0 * libm::sin(angle) as f32, z)
        };
        let mut positions: Vec<Vec3> = [0.0, 100.0].iter().flat_map(|&z| (0..n).map(move |i| at(i, z))).collect();
        positions.extend([Vec3::ZERO, Vec3::Z * 100.0]);
        let around = |i: u32| {
            let j = (i + 1) % n;
            [[i, j, n + j], [i, n + j, n + i], [2 * n, j, i], [2 * n + 1, n + i, n + j]]
        };
        TriMesh { positions, triangles: (0..n).flat_map(around).collect() }
    }

    #[test]
    fn beside_a_hundred_thousand_triangles_around_one_vertex_everything_stays_and_it_says_so() {
        let mesh = cylinder(100_000);
        let levels = levels_of(&mesh, Method::Schroeder);
        assert!(levels.errors.is_empty());
        assert_eq!(levels.limit.geometry as usize, mesh.positions.len());
    }

    /// From its ends on one vertex after another becomes free: hundreds of rounds, each with a higher threshold.
    #[test]
    fn a_strip_of_random_triangles_ends() {
        let mut random = SplitMix64::new(1);
        let mut point = || Vec3::from_array(std::array::from_fn(|_| 100.0 * random.unit() as f32));
        let positions: Vec<Vec3> = (0..3002).map(|_| point()).collect();
        let triangles: Vec<[u32; 3]> =
            (0..3000).map(|i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] }).collect();
        let mesh = TriMesh { positions, triangles };
        let levels = levels_of(&mesh, Method::Schroeder);
        assert!(levels.triangles_after(levels.errors.len() as u32) < 100);
    }

    #[test]
    fn caps_with_thousands_of_triangles_around_one_vertex_go_as_far_as_any() {
        let mesh = cylinder(3000);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        for method in Method::ALL {
            let settings = Decimation { method, ..Decimation::default() };
            let levels = decimate(&mesh, &topology, &settings);
            levels.assert_well_formed();
            assert_eq!(levels.triangles_after(levels.errors.len() as u32), 4, "{method:?}");
        }
    }
}
