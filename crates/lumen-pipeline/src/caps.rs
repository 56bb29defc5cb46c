//! The flat caps of a closed surface, held through smoothing and decimation: for flow, the area of an inlet is the boundary
//! condition.
//!
//! Smoothing sees the surface without its caps: each rim is an open end then, which is smoothed along itself in its plane.
//! After it each cap is laid into its plane again and brought to the area that it had, about its middle; what is inside of
//! the rim goes along with it. Decimation takes rims as borders between labels, and gives up no more of a cap's area than
//! [`SPENT`](crate::decimation::SPENT).

use std::sync::{Arc, OnceLock};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::results::Surface;
use crate::settings::Smoothing;
use lumen_mesh::cut::area_and_middle;
use lumen_mesh::task::Yielder;
use lumen_mesh::{
    FlatCap, Measures, Topology, TriMesh, Vec3, flat_caps_in_slices, oriented_loops, volume_within, without_caps,
};

/// Passes in which what is inside of a rim takes the mean of its neighbours' ways.
const PASSES: usize = 200;

/// The flat caps of a surface, and what is left without them.
#[derive(Debug)]
pub struct Capped {
    /// The caps.
    pub caps: Vec<FlatCap>,
    /// The surface without their triangles: the same vertices, and a rim around each.
    pub walls: Arc<Surface>,
}

impl Capped {
    /// Of a surface; `None` where it has no caps.
    async fn of(surface: &Surface, yielder: &Yielder) -> Option<Box<Self>> {
        let Surface { mesh, topology, measures, .. } = surface;
        let caps = flat_caps_in_slices(mesh, topology, yielder).await;
        if caps.is_empty() {
            return None;
        }
        let walls = TriMesh { positions: mesh.positions.clone(), triangles: without_caps(&mesh.triangles, &caps) };
        let topology = Topology::new(walls.positions.len(), &walls.triangles);
        let loops = oriented_loops(&topology);
        let volume_mm3 = loops.as_deref().map(|loops| volume_within(&walls, loops));
        let measures = Measures { volume_mm3, ..*measures };
        let walls =
            Surface { mesh: Arc::new(walls), topology: Arc::new(topology), loops, measures, caps: OnceLock::new() };
        Some(Box::new(Self { caps, walls: Arc::new(walls) }))
    }
}

impl Surface {
    /// Its flat caps. The first call looks for them, which takes several times as long as all other connectivity.
    pub(crate) async fn capped(&self, yielder: &Yielder) -> Option<&Capped> {
        if self.caps.get().is_none() {
            let found = Capped::of(self, yielder).await;
            self.caps.get_or_init(|| found);
        }
        self.caps.get()?.as_deref()
    }

    /// Its caps, where these settings hold them: smoothing by them has looked.
    fn held(&self, settings: &Smoothing) -> Option<&Capped> {
        let caps = settings.hold_caps.then(|| self.caps.get())?;
        debug_assert!(caps.is_some(), "nobody has looked for caps");
        caps?.as_deref()
    }

    /// What smoothing by these settings sees of the surface: without its caps where they are held.
    pub(crate) fn smoothed_as(self: &Arc<Self>, settings: &Smoothing) -> Arc<Self> {
        self.held(settings).map_or(self, |capped| &capped.walls).clone()
    }

    /// Its caps, where these settings hold them.
    pub(crate) fn held_caps(&self, settings: &Smoothing) -> &[FlatCap] {
        self.held(settings).map_or(&[], |capped| &capped.caps)
    }
}

/// Lays the caps of `before` into their planes, each with the area that it had.
pub(crate) fn settle(before: &Surface, caps: &[FlatCap], positions: &mut [Vec3]) {
    for cap in caps {
        let flat = |p: Vec3| {
            let p = p.as_dvec3();
            p - cap.normal * (p - cap.centre).dot(cap.normal)
        };
        let mut rim: Vec<DVec3> = cap.rim.iter().map(|&v| flat(positions[v as usize])).collect();
        let old: Vec<DVec3> = cap.rim.iter().map(|&v| before.mesh.positions[v as usize].as_dvec3()).collect();
        let [area_before, area] = [&old, &rim].map(|points| area_and_middle(points, cap.centre, cap.normal).0);
        if area > 0.0 && area_before > 0.0 {
            let scale = libm::sqrt(area_before / area);
            let middle = rim.iter().sum::<DVec3>() / rim.len() as f64;
            rim.iter_mut().for_each(|p| *p = middle + (*p - middle) * scale);
        }
        for (&v, p) in cap.rim.iter().zip(&rim) {
            positions[v as usize] = p.as_vec3();
        }
        follow(before, cap, positions);
    }
}

/// Moves the vertices inside of a cap's rim by the mean of what their neighbours move by.
fn follow(before: &Surface, cap: &FlatCap, positions: &mut [Vec3]) {
    let mut vertices: Vec<u32> = cap.triangles.iter().flat_map(|&t| before.mesh.triangles[t as usize]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let place = |v: u32| vertices.binary_search(&v).ok();
    let way = |v: u32| positions[v as usize].as_dvec3() - before.mesh.positions[v as usize].as_dvec3();
    let mut is_rim = vec![false; vertices.len()];
    let mut ways = vec![DVec3::ZERO; vertices.len()];
    for (i, &v) in cap.rim.iter().filter_map(|v| Some((place(*v)?, v))) {
        (is_rim[i], ways[i]) = (true, way(v));
    }
    let mean_of_rim = ways.iter().sum::<DVec3>() / cap.rim.len().max(1) as f64;
    let inner: Vec<(usize, Vec<usize>)> = (0..vertices.len())
        .filter(|&i| !is_rim[i])
        .map(|i| (i, before.topology.neighbours(vertices[i]).iter().filter_map(|&n| place(n)).collect()))
        .collect();
    inner.iter().for_each(|(i, _)| ways[*i] = mean_of_rim);
    for _ in 0..PASSES {
        for (i, around) in &inner {
            ways[*i] = around.iter().map(|&n| ways[n]).sum::<DVec3>() / around.len().max(1) as f64;
        }
    }
    for (i, _) in &inner {
        let p = before.mesh.positions[vertices[*i] as usize].as_dvec3() + ways[*i];
        positions[vertices[*i] as usize] = (p - cap.normal * (p - cap.centre).dot(cap.normal)).as_vec3();
    }
}

/// A number for each triangle, another on each side of a rim and wherever `labels` has another.
pub(crate) fn with_caps(labels: Option<Vec<u32>>, caps: &[FlatCap], triangles: usize) -> Option<Vec<u32>> {
    if caps.is_empty() {
        return labels;
    }
    let count = caps.len() as u32 + 1;
    let mut numbers: Vec<u32> = match labels {
        Some(labels) => labels.into_iter().map(|label| label * count).collect(),
        None => vec![0; triangles],
    };
    for (i, cap) in caps.iter().enumerate() {
        cap.triangles.iter().for_each(|&t| numbers[t as usize] += i as u32 + 1);
    }
    Some(numbers)
}

/// The area of a cap before smoothing and on a level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CapArea {
    /// As it was opened, in mm2.
    pub before_mm2: f64,
    /// Of the level, in mm2: that of the triangles in the cap's plane.
    pub after_mm2: f64,
    /// The middle of the cap, in mm.
    pub centre: [f32; 3],
}

impl CapArea {
    /// Whether most of it still lies in its plane.
    pub fn is_flat(&self) -> bool {
        self.after_mm2 > FLAT * self.before_mm2
    }

    /// The diameter of a circle of the area before, in mm.
    pub fn diameter_mm(&self) -> f64 {
        2.0 * libm::sqrt(self.before_mm2 / std::f64::consts::PI)
    }

    /// The change, in percent of the area before.
    pub fn change_percent(&self) -> f64 {
        100.0 * (self.after_mm2 / self.before_mm2 - 1.0)
    }
}

/// The least and the largest change of the areas of some caps, in percent; `None` without caps.
pub fn changes_percent(caps: &[CapArea]) -> Option<[f64; 2]> {
    let changes = || caps.iter().map(CapArea::change_percent);
    Some([changes().reduce(f64::min)?, changes().reduce(f64::max)?])
}

/// A cap with less than this part of its area in its plane is rounded.
const FLAT: f64 = 0.75;
/// A triangle of a level lies in a cap where its corners are at most this part of the cap's radius off its plane, or twice as
/// far as the cap's own are.
const IN_PLANE: f64 = 1e-3;
/// And at most so many times as far from its middle as its rim was.
const AROUND: f64 = 3.0;

/// The areas of `caps` of `opened` on `level`, a surface made from it. A cap that is no longer flat has less of it.
pub fn cap_areas(caps: &[FlatCap], opened: &TriMesh, level: &TriMesh) -> Vec<CapArea> {
    let places = |cap: &FlatCap, measure: &dyn Fn(DVec3) -> f64| {
        cap.rim.iter().map(|&v| measure(opened.positions[v as usize].as_dvec3() - cap.centre)).fold(0.0, f64::max)
    };
    let reach: Vec<[f64; 2]> = caps
        .iter()
        .map(|cap| {
            let off = places(cap, &|p| p.dot(cap.normal).abs());
            [(IN_PLANE * cap.radius_mm()).max(2.0 * off), places(cap, &DVec3::length)]
        })
        .collect();
    let projected = |mesh: &TriMesh, t: usize, normal: DVec3| {
        let [a, b, c] = mesh.corners(t).map(Vec3::as_dvec3);
        (b - a).cross(c - a).dot(normal) / 2.0
    };
    let before = |cap: &FlatCap| cap.triangles.iter().map(|&t| projected(opened, t as usize, cap.normal)).sum();
    let mut areas: Vec<CapArea> = caps
        .iter()
        .map(|cap| CapArea { before_mm2: before(cap), after_mm2: 0.0, centre: cap.centre.as_vec3().to_array() })
        .collect();
    for t in 0..level.triangles.len() {
        let corners = level.corners(t).map(Vec3::as_dvec3);
        // Ends that were cut off by one plane lie in it side by side: a triangle is of the cap that it is well within.
        let mut nearest: Option<(f64, usize)> = None;
        for (i, (cap, [off, around])) in caps.iter().zip(&reach).enumerate() {
            let is_in_plane = |p: DVec3| (p - cap.centre).dot(cap.normal).abs() < *off;
            if !corners.into_iter().all(is_in_plane) {
                continue;
            }
            let away = corners.into_iter().map(|p| p.distance(cap.centre) / around).fold(0.0, f64::max);
            if away < AROUND && nearest.is_none_or(|(least, _)| away < least) {
                nearest = Some((away, i));
            }
        }
        if let Some((_, i)) = nearest {
            areas[i].after_mm2 += projected(level, t, caps[i].normal);
        }
    }
    areas
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Pipeline;
    use crate::settings::{Decimation, Method, Settings, Target};
    use lumen_mesh::flat_caps;
    use lumen_mesh::self_intersections;
    use lumen_mesh::shapes::capped;

    /// The area of a regular polygon in a circle of 2 mm.
    fn polygon(sides: u32) -> f64 {
        f64::from(sides) * 2.0 * libm::sin(std::f64::consts::TAU / f64::from(sides))
    }

    fn areas(mesh: &Arc<TriMesh>, settings: Settings) -> (Vec<CapArea>, Arc<TriMesh>) {
        let mut pipeline = Pipeline::new(mesh.clone(), settings).without_measures();
        pipeline.finish().unwrap();
        let level = pipeline.reduced().unwrap().mesh.clone();
        let caps = flat_caps(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
        (cap_areas(&caps, mesh, &level), level)
    }

    #[test]
    fn caps_keep_their_plane_and_area_at_every_rate_by_both_methods() {
        let mesh = Arc::new(capped(96, 120, 30.0, 2.0));
        for method in Method::ALL {
            for rate in [0, 500, 900, 970] {
                let decimation = Decimation { method, ..Decimation::default() };
                let settings = Settings { target: Target::Reduction(rate), decimation, ..Settings::default() };
                let (areas, level) = areas(&mesh, settings);
                assert_eq!(areas.len(), 2);
                for area in areas {
                    assert!((area.before_mm2 / polygon(96) - 1.0).abs() < 1e-4);
                    assert!(area.change_percent().abs() < 0.5, "{method:?} at {rate}: {area:?}");
                }
                assert_eq!(self_intersections(&level).len(), 0);
            }
        }
    }

    #[test]
    fn caps_side_by_side_in_one_plane_are_not_counted_into_each_other() {
        let wide = capped(48, 60, 30.0, 4.0);
        let mut thin = capped(24, 60, 30.0, 1.0);
        thin.positions.iter_mut().for_each(|p| p.x += 5.5);
        let mesh = lumen_mesh::shapes::joined(&[wide, thin]);
        let caps = flat_caps(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
        let areas = cap_areas(&caps, &mesh, &mesh);
        assert_eq!(areas.len(), 4);
        assert!(areas.iter().all(|area| area.change_percent().abs() < 1e-9), "{areas:?}");
    }

    #[test]
    fn as_any_wall_a_cap_is_rounded() {
        let mesh = Arc::new(capped(96, 120, 30.0, 2.0));
        let smoothing = Smoothing { hold_caps: false, ..Smoothing::AUTO };
        let target = Target::Reduction(0);
        let (areas, _) = areas(&mesh, Settings { smoothing, target, ..Settings::default() });
        assert!(areas.iter().all(|area| !area.is_flat()), "{areas:?}");
    }

    #[test]
    fn caps_that_are_held_later_are_as_if_they_were_held_at_once() {
        let mesh = Arc::new(capped(96, 120, 30.0, 2.0));
        let of = |hold_caps| {
            let smoothing = Smoothing { hold_caps, ..Smoothing::AUTO };
            Settings { smoothing, target: Target::Reduction(900), ..Settings::default() }
        };
        let mut pipeline = Pipeline::new(mesh.clone(), of(false));
        pipeline.finish().unwrap();
        assert_eq!(pipeline.level_measures().unwrap().caps.len(), 2, "found, though they are not held");
        pipeline.set(of(true)).unwrap();
        pipeline.finish().unwrap();
        let mut at_once = Pipeline::new(mesh, of(true));
        at_once.finish().unwrap();
        let level = |pipeline: &Pipeline| pipeline.reduced().unwrap().mesh.clone();
        assert_eq!(level(&pipeline), level(&at_once));
        assert_eq!(pipeline.level_measures().unwrap().caps, at_once.level_measures().unwrap().caps);
    }

    #[test]
    fn caps_at_a_slant_in_the_paper_s_strong_filter_keep_their_areas_too() {
        let mut slanted = capped(64, 100, 40.0, 2.0);
        slanted.positions.iter_mut().for_each(|p| p.z += 0.7 * p.x);
        let smoothing = Smoothing { hold_caps: true, preserve_volume: true, ..Smoothing::PAPER };
        let target = Target::Reduction(900);
        let (areas, _) = areas(&Arc::new(slanted), Settings { smoothing, target, ..Settings::default() });
        for area in areas {
            assert!((area.before_mm2 / (polygon(64) * libm::sqrt(1.49)) - 1.0).abs() < 1e-4, "{area:?}");
            assert!(area.change_percent().abs() < 0.5, "{area:?}");
        }
    }

    #[test]
    fn rims_are_borders_beside_those_of_labels() {
        let mesh = capped(24, 20, 20.0, 2.0);
        let caps = flat_caps(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
        let labels: Vec<u32> = (0..mesh.triangles.len() as u32).map(|t| t % 2).collect();
        let numbers = with_caps(Some(labels.clone()), &caps, mesh.triangles.len()).unwrap();
        let of: std::collections::BTreeSet<u32> = numbers.iter().copied().collect();
        assert_eq!(of.len(), 6, "two labels on the wall and on each of two caps");
        assert_eq!(with_caps(Some(labels.clone()), &[], 0), Some(labels));
        assert_eq!(with_caps(None, &[], 5), None);
    }
}
