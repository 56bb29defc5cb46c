//! "The middle of a vessel", "inside" and "how wide is it here": every meaning that Lumen has of them, side by side.
//!
//! They are not one number, because they answer different questions on different surfaces: a wall of noise, a level of fifty
//! triangles, a pinch, a fork. Lengths are in mm, radii unless a diameter is named.
//!
//! | middle | what it is | who uses it | why it is its own |
//! |---|---|---|---|
//! | [`InnerRadii::ball`](lumen_mesh::InnerRadii::ball) | of the largest ball that touches the wall at a vertex, of walls that face each other within 15 degrees of the normal (`lumen-mesh`, `inner_ball.rs`) | [`widths`], [`narrowest()`], [`samples`], the measuring tool | of a place of the wall, whatever the vessel does elsewhere |
//! | `Space::behind_wall` | half way between a place of the wall and the wall behind, then across while the ball grows | `balls` begins there | the same question with rays alone, for any ball that is inside will do to begin with |
//! | `Space::ascend` | away from the nearest wall and out of crevices, in overlapping balls, at most 16 moves | `balls` | the way itself must lie inside, so no move is longer than the ball |
//! | `Space::largest` | as `ascend` without crevices, at most 0.35 of the first radius away | radii of centrelines, inscribed radii | belongs to a station: it must not wander along the vessel |
//! | `centred` in `narrowest.rs` | half way between the nearest wall and the one behind, at most 6 moves of any length while the clearance grows | [`narrowest()`] | begins near the middle, from an inner ball; it needs no open ends and no way |
//! | `towards_middle` in `centreline.rs` | centroid of what eight rays across the vessel enclose, none longer than 1.4 of the nearest wall | centrelines, `caps` | averages over bumps of the wall |
//! | `recentring` | centroid of the closed cross-section, evened out along the vessel | [`Stations`](super::Stations) of exported centrelines | exact where one vessel is cut; there is none at forks and ends |
//! | `Audit::widest` in `lumen-trial` | eight ways across, by its own distance | checks that a route is open | shares no code with what it checks |
//!
//! | inside | what it is | who uses it | why it is its own |
//! |---|---|---|---|
//! | [`is_inside`] | three of six [`RAYS`] wind about the point | [`narrowest()`], [`samples`] | needs no caps: near an open end half of the rays may leave by it |
//! | `Space::is_inside` | two of three [`RAYS`], with caps over the open ends | `balls`, sections, routes | the caps are there, and it is asked thousands of times |
//! | `Space::is_before` | before the triangle of the nearest place | moves of a ball | a sign for a point that was inside a moment ago |
//! | [`Sides`](lumen_mesh::Sides) | by the pseudonormal of the nearest place | [`clearances`] | exact on closed levels of few triangles; says where it cannot tell |
//! | `Audit::winding` in `lumen-trial` | generalised winding number, ends capped | audit | shares no code with what it checks |
//!
//! | width | what it is | unit | who uses it | why it is its own |
//! |---|---|---|---|---|
//! | inner radius | of the inner ball at a vertex | radius | all of the next three | jumps at bad normals |
//! | [`widths`] | inner radii, four medians over rings, never growing faster than the way along the wall | radius at each vertex | pass bands (`smoothing`), weights (`decimation`), what is put back | one smooth number at every vertex, a narrow place counting for its neighbours |
//! | [`Narrowest`] | twice the clearance of the most narrow middle | diameter of the surface | shape of a surface, report | the least, not a typical one; a ball that a single dent makes is left out |
//! | [`clearances`], [`Narrowing`] | distance of fixed middles from the wall of a level; below [`PINCHED`] of what it was a vessel is pinched | radius of a sample, diameters in the report | `pinch`, verdict, comparison of trials | the same places on all levels, so a change is the level's |
//! | `Calibre::inscribed_mm` | ball of `Space::largest` at a station | radius | certificate, centreline files | steps of the wall make it smaller by a part of a voxel |
//! | calibre: [`circle`] | of the circle of the area of the cross-section | radius | certificate, centreline files | steps in and out of the wall cancel |
//! | `certificate/stretch.rs` | the same of the mean area over a stretch as long as the vessel is wide | radius | verdicts on vessels | a single cut of a stair-stepped wall jumps by rows of voxels |
//! | `variation` | twice the last, against what the vessel has on either side | diameter, percent | narrower and wider stretches | relative to the vessel itself |
//! | `Place::radius` | ball of `Space::largest` on a centreline | radius | trees, routes, forks | there before any cross-section is cut |
//! | `Opening::radius` | mean distance of a rim from its middle | radius | ends of trees, zones | an open end has no inside |
//! | mean calibre (`lumen-io`, `size.rs`) | four times volume over area | diameter of the whole surface | warning about the unit | the order of magnitude, before anything is known |
//!
//! What they share is here: directions of rays, the clearance that a middle has ([`CLEAR`]), medians over rings. What a ball is
//! ([`Ball`](lumen_mesh::Ball)) and the length of an edge ([`mean_edge`](lumen_mesh::mean_edge), or
//! [`rms_edge`](lumen_mesh::rms_edge) where waves are meant) is said in `lumen-mesh`.

mod at_vertices;
mod clearance;
mod narrowest;

use glam::Vec3;

use lumen_mesh::{SurfaceIndex, Topology};

pub use at_vertices::widths;
pub use clearance::{Narrowing, PINCHED, SHUT, clearances, narrowing, samples, samples_in_slices, worst};
pub use narrowest::{Narrowest, narrowest};

/// Directions without relation to any axis or to each other.
pub const RAYS: [Vec3; 3] = [
    Vec3::new(0.534_522, 0.267_261, 0.801_784),
    Vec3::new(-0.742_781, 0.557_086, 0.371_391),
    Vec3::new(0.196_116, -0.784_465, -0.588_348),
];

/// A ball's middle is at least this part of the radius away from the wall, or it is no lumen.
pub const CLEAR: f32 = 0.85;

/// Whether a point lies inside, as three of six rays have it: near an open end, half of them may leave by that.
pub fn is_inside(at: Vec3, index: &SurfaceIndex) -> bool {
    let rays = RAYS.iter().flat_map(|&ray| [ray, -ray]);
    rays.filter(|&ray| index.winding(at, ray) > 0).count() >= 3
}

/// The radius of the circle of an area in mm2, in mm.
pub fn circle(area: f64) -> f64 {
    (area / std::f64::consts::PI).sqrt()
}

/// Median of the radii at `v` and its neighbours; `ring` is room for them.
fn ring_median(topology: &Topology, radii: &[f32], v: u32, ring: &mut Vec<f32>) -> f32 {
    ring.clear();
    ring.push(radii[v as usize]);
    ring.extend(topology.neighbours(v).iter().map(|&n| radii[n as usize]));
    let middle = ring.len() / 2;
    *ring.select_nth_unstable_by(middle, f32::total_cmp).1
}
