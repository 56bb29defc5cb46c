//! Centrelines and calibres of straight tubes as segmentations have them: binary masks, cut by marching cubes, with flat
//! caps or without.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DMat3, DVec3};
use lumen::mesh::TriMesh;
use lumen::vessel::{Centrelines, Subject, Zone};
use lumen::volume::{Geometry, Grid, Samples, Selection, surface};

/// The surface of the mask of what is inside, on a grid of this spacing in mm.
fn masked(low: DVec3, high: DVec3, voxel: f64, inside: impl Fn(DVec3) -> bool) -> TriMesh {
    // The grid begins somewhere in a voxel, and the outermost points lie outside.
    let origin = low - (DVec3::new(0.17, 0.59, 0.41) + 1.0) * voxel;
    let size = ((high - origin) / voxel).to_array().map(|along| along.ceil() as usize + 2);
    let geometry = Geometry { size, spacing: DVec3::splat(voxel), origin, direction: DMat3::IDENTITY };
    let at = |n: usize| {
        let (i, j, k) = (n % size[0], n / size[0] % size[1], n / (size[0] * size[1]));
        origin + DVec3::new(i as f64, j as f64, k as f64) * voxel
    };
    let samples = (0..size.iter().product()).map(|n| u8::from(inside(at(n)))).collect();
    let grid = Grid::new(geometry, Samples::U8(samples), 1.0, 0.0).unwrap();
    surface(&Arc::new(grid), Selection::Threshold(0.5), None).unwrap()
}

/// A tube from the origin along `axis`, its ends flat and closed, or open.
struct Tube {
    axis: DVec3,
    radius: f64,
    length: f64,
    is_capped: bool,
}

impl Tube {
    fn surface(&self, voxel: f64) -> TriMesh {
        let along = |p: DVec3| p.dot(self.axis);
        let inside = |p: DVec3| {
            (0.0..self.length).contains(&along(p)) && (p - self.axis * along(p)).length_squared() < self.radius.powi(2)
        };
        let end = self.axis * self.length;
        let mesh = masked(end.min(DVec3::ZERO) - self.radius, end.max(DVec3::ZERO) + self.radius, voxel, inside);
        let is_wall = |t: usize| {
            let middle = mesh.corners(t).iter().map(|p| p.as_dvec3()).sum::<DVec3>() / 3.0;
            (1.5 * voxel..self.length - 1.5 * voxel).contains(&along(middle))
        };
        if self.is_capped { mesh } else { mesh.filtered(is_wall) }
    }

    /// What is wrong with the centreline and the calibre that are found.
    fn faults(&self, voxel: f64) -> Vec<String> {
        let found = Centrelines::new(&Subject::new(&Arc::new(self.surface(voxel)))).unwrap();
        let mut faults = Vec::new();
        if found.branches.len() != 1 {
            faults.push(format!("{} branches", found.branches.len()));
        }
        let Self { axis, radius, length, .. } = *self;
        let stations = &found.stations.all;
        let along: Vec<f64> = stations.iter().map(|station| station.at.dot(axis)).collect();
        let sign = (along[along.len() - 1] - along[0]).signum();
        if along.windows(2).any(|pair| (pair[1] - pair[0]) * sign <= 0.0) {
            faults.push("it folds back".to_owned());
        }
        // Between the last radius before each end, both ways.
        let between = radius..length - radius;
        let off = |i: usize| stations[i].at.distance(axis * along[i]);
        let farthest = (0..stations.len()).filter(|&i| between.contains(&along[i])).map(off).fold(0.0, f64::max);
        let reached = along.iter().fold([f64::INFINITY, 0.0], |[low, high], &at| [low.min(at), high.max(at)]);
        let short = (reached[0] - between.start).max(between.end - reached[1]);
        if farthest.max(short) > 0.3 {
            faults.push(format!("{farthest:.2} mm beside the axis, {short:.2} mm short"));
        }
        let is_measured = |&i: &usize| found.zones[i] == Zone::Vessel;
        let measured: Vec<usize> = (0..stations.len()).filter(is_measured).collect();
        let ends = [measured.first(), measured.last()].map(|i| i.map_or(0.0, |&i| along[i]));
        // All of it that is two radii from the caps.
        let spare = if self.is_capped { 2.0 * radius } else { radius } + 1.0 + 2.0 * voxel;
        if (ends[1] - ends[0]).abs() < length - 2.0 * spare {
            faults.push(format!("measured from {:.1} to {:.1} of {length:.1} mm", ends[0], ends[1]));
        }
        let radii: Vec<f64> =
            measured.iter().map(|&i| (found.calibres[i].area_mm2.unwrap_or(0.0) / PI).sqrt()).collect();
        let mean = radii.iter().sum::<f64>() / radii.len().max(1) as f64;
        // A mask of fewer voxels is itself thinner than what it is of.
        let allowed = if 2.0 * radius >= 4.0 * voxel { 0.03 } else { 0.05 };
        if (mean / radius - 1.0).abs() > allowed {
            faults.push(format!("a radius of {mean:.3} mm, not {radius:.3}"));
        }
        let is_off = |&(_, own): &(&usize, &f64)| 2.0 * radius >= 8.0 * voxel && (own / radius - 1.0).abs() > 0.05;
        for (&i, own) in measured.iter().zip(&radii).filter(is_off) {
            let station = stations[i];
            let across = station.direction.dot(axis);
            faults.push(format!("a radius of {own:.3} mm at {:.2} mm, {across:.3} across", along[i]));
        }
        faults
    }
}

#[test]
fn a_tube_of_any_width_has_one_centreline_along_its_axis_to_its_caps() {
    let mut faults = Vec::new();
    for diameter in [1.0, 2.0, 3.0, 5.0, 8.0, 10.0, 12.0, 15.0, 20.0, 30.0] {
        // Wider ones on finer grids take long and are no harder.
        for voxel in [0.3, 0.5, 0.7].into_iter().filter(|voxel| (3.0 * voxel..45.0 * voxel).contains(&diameter)) {
            for is_capped in [true, false] {
                let axis = DVec3::new(0.36, 0.21, 0.91).normalize();
                let tube = Tube { axis, radius: diameter / 2.0, length: 3.0 * diameter + 6.0, is_capped };
                let ends = if is_capped { "capped" } else { "open" };
                let all = tube.faults(voxel);
                if !all.is_empty() {
                    faults.push(format!("{diameter} mm, voxels of {voxel}, {ends}: {}", all.join(", ")));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} tubes:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn a_tube_along_the_grid_has_it_too() {
    for (diameter, voxel) in [(8.0, 0.5), (15.0, 0.7), (20.0, 0.5)] {
        let tube = Tube { axis: DVec3::Z, radius: diameter / 2.0, length: 3.0 * diameter, is_capped: true };
        assert_eq!(tube.faults(voxel), Vec::<String>::new(), "{diameter} mm, voxels of {voxel}");
    }
}
