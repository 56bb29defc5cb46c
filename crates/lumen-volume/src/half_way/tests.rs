//! Blurred tubes of known radius: the threshold, what the surface at it has for a radius, and by how much another moves it.

use std::sync::Arc;

use super::*;
use crate::{Cut, Geometry, Region, Samples, Selection, VolumeError, shift_mm, surface, surface_in_slices};
use lumen_mesh::split_mix::SplitMix64;
use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{TriMesh, components};

/// A scan of an oblique tube of `radius` mm, of `vessel` in `background`, blurred over `blur` mm, with noise and, if there is to
/// be, bone 3 mm beside it.
struct Scan {
    radius: f64,
    spacing: DVec3,
    vessel: f64,
    background: f64,
    blur: f64,
    noise: f64,
    bone: Option<f64>,
}

const AXIS: DVec3 = DVec3::new(0.36, 0.48, 0.8);

impl Scan {
    fn grid(&self) -> Grid {
        let reach = DVec3::splat(24.0);
        let geometry = Geometry::around(-reach, reach, self.spacing);
        let [nx, ny, _] = geometry.size;
        let mut random = SplitMix64::new(7);
        let across = AXIS.cross(DVec3::X).normalize();
        let values = (0..geometry.points()).map(|n| {
            let p = geometry.at((n % nx) as f64, (n / nx % ny) as f64, (n / (nx * ny)) as f64);
            let wall = (p - AXIS * p.dot(AXIS)).length() - self.radius;
            let mut value = self.background + (self.vessel - self.background) * edge(-wall / self.blur);
            if let Some(bone) = self.bone {
                let wall = self.radius + 3.0 - p.dot(across);
                value += (bone - self.background) * edge(-wall / self.blur);
            }
            let normal = (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
            (value + self.noise * normal) as f32
        });
        let values = values.collect();
        Grid::new(geometry, Samples::F32(values), 1.0, 0.0).unwrap()
    }

    fn seed(&self, grid: &Grid, off: f64) -> [usize; 3] {
        grid.geometry().voxel_at(AXIS.cross(DVec3::Y).normalize() * off * self.radius).unwrap()
    }
}

/// A normal distribution's integral.
fn edge(x: f64) -> f64 {
    0.5 * (1.0 + libm::erf(x / std::f64::consts::SQRT_2))
}

/// Mean distance from the axis of the vertices that are no nearer to the ends than 6 mm.
fn radius(mesh: &TriMesh) -> f64 {
    let off = |p: &glam::Vec3| (p.as_dvec3() - AXIS * p.as_dvec3().dot(AXIS)).length();
    let of: Vec<f64> = mesh.positions.iter().filter(|p| p.as_dvec3().dot(AXIS).abs() < 14.0).map(off).collect();
    of.iter().sum::<f64>() / of.len() as f64
}

#[test]
fn the_threshold_is_half_way_and_the_radius_that_of_the_tube() {
    let mut faults = Vec::new();
    for spacing in [DVec3::splat(0.6), DVec3::new(0.5, 0.5, 1.5)] {
        for radius_mm in [1.5, 3.0, 6.0, 10.0] {
            for (vessel, background) in [(350.0, 40.0), (200.0, 60.0), (900.0, 150.0)] {
                for noise in [0.0, 0.08] {
                    for bone in [None, Some(1200.0)] {
                        for off in [0.0, 0.5] {
                            let blur = 0.6;
                            let noise = noise * (vessel - background);
                            let scan = Scan { radius: radius_mm, spacing, vessel, background, blur, noise, bone };
                            let grid = Arc::new(scan.grid());
                            let seed = scan.seed(&grid, off);
                            let what = format!(
                                "{radius_mm} mm, {vessel} in {background}, noise {noise}, {bone:?}, {off}, {spacing}"
                            );
                            let Some(found) = half_way(&grid, seed) else {
                                faults.push(format!("{what}: none"));
                                continue;
                            };
                            let part = (found.threshold - background) / (vessel - background);
                            let cut = Cut { seed: Some(seed), ..Cut::new(Selection::Threshold(found.threshold)) };
                            let mesh = at_once(surface_in_slices(&grid, cut, &Yielder::never()));
                            let own = mesh.as_ref().map_or(0.0, radius);
                            println!("{what}: {part:.3}, {own:.3} mm");
                            if (part - 0.5).abs() > 0.1 || (own - radius_mm).abs() > 0.15 && bone.is_none() {
                                faults.push(format!("{what}: {part:.3}, {own:.3} mm"));
                            }
                        }
                    }
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn another_threshold_moves_the_wall_as_the_blur_says() {
    let scan = Scan {
        radius: 6.0,
        spacing: DVec3::splat(0.5),
        vessel: 400.0,
        background: 0.0,
        blur: 1.0,
        noise: 0.0,
        bone: None,
    };
    let grid = Arc::new(scan.grid());
    let mesh = surface(&grid, Selection::Threshold(200.0), None).unwrap();
    // 0.45 and 0.55 of the way up a normal distribution's integral lie 0.12566 deviations beside its middle.
    for (other, exact) in [(180.0, 0.12566), (220.0, -0.12566)] {
        let shift = shift_mm(&grid, &mesh, 200.0, other).unwrap();
        assert!((shift - exact).abs() < 0.01, "{shift} mm");
        let moved = surface(&grid, Selection::Threshold(other), None).unwrap();
        assert!((radius(&moved) - radius(&mesh) - shift).abs() < 0.01);
    }
}

#[test]
fn bone_that_is_not_connected_stays_out() {
    let scan = Scan {
        radius: 4.0,
        spacing: DVec3::splat(0.8),
        vessel: 300.0,
        background: 0.0,
        blur: 0.6,
        noise: 0.0,
        bone: Some(900.0),
    };
    let grid = Arc::new(scan.grid());
    let seed = scan.seed(&grid, 0.0);
    let cut = Cut::new(Selection::Threshold(150.0));
    let made = |cut| at_once(surface_in_slices(&grid, cut, &Yielder::never()));
    let pieces = |mesh: &TriMesh| components(mesh.positions.len(), &mesh.triangles).count();
    let (all, own) = (made(cut).unwrap(), made(Cut { seed: Some(seed), ..cut }).unwrap());
    assert_eq!((pieces(&all), pieces(&own)), (2, 1));
    assert!((radius(&own) - 4.0).abs() < 0.1);
    assert!(own.triangles.len() < all.triangles.len());
    let nets = made(Cut { seed: Some(seed), method: crate::Method::SurfaceNets, ..cut }).unwrap();
    assert_eq!(pieces(&nets), 1);
    assert_eq!(made(Cut { seed: Some([0; 3]), ..cut }), Err(VolumeError::SeedOutside { value: grid.value([0; 3]) }));
    let region = Region { first: [0; 3], last: [9; 3] };
    assert_eq!(made(Cut { seed: Some(seed), region: Some(region), ..cut }), Err(VolumeError::SeedNowhere));
}
