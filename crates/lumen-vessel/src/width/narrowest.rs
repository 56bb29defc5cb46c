//! Where a vessel is narrowest: the smallest ball in the middle of it.
//!
//! Of the inner balls ([`InnerRadii`]) those are taken that are smallest as the median over a vertex and its
//! neighbours: a single vertex with a bad normal or a dent does not make the smallest lumen. Each is then moved to the
//! middle of the vessel, away from the nearest wall by half of what the opposite one is farther, as long as it grows.
//! What counts is the distance of that middle from the nearest wall, whichever it is.
//!
//! In a round vessel that is its diameter. In a flat one the walls already face each other beside the middle, where they
//! are nearer: the smallest lumen of an ellipse 2.5 times as wide as high comes out up to a quarter less than its height.

use serde::{Deserialize, Serialize};

use super::{CLEAR, is_inside, ring_median};
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{Ball, InnerRadii, SurfaceIndex, Topology, TriMesh, Vec3};

/// Balls that are moved to the middle of the vessel, at most.
const CANDIDATES: usize = 256;
/// Balls that are looked at, and that are moved, in one piece of work.
const LOOKED: usize = 4096;
const MOVED: usize = 4;
/// Moves of a ball. Each halves what is left of the way in a round vessel.
const MOVES: usize = 6;

/// The narrowest place of a vessel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Narrowest {
    /// Diameter of the lumen there, in mm: twice the distance of its middle from the wall.
    pub diameter_mm: f64,
    /// The middle of the lumen there, in mm.
    pub at_mm: [f32; 3],
}

/// The narrowest place of `mesh`, whose inner balls are `balls`; `None` where no wall faces another. `index` is of this
/// surface, in whatever numbering.
pub async fn narrowest(
    mesh: &TriMesh,
    topology: &Topology,
    balls: &InnerRadii,
    index: &SurfaceIndex,
    yielder: &Yielder,
) -> Option<Narrowest> {
    let smallest = smallest(topology, balls, &yielder.part(0.0..0.5)).await;
    let mut least: Option<Ball> = None;
    for block in blocks(smallest.len(), MOVED) {
        let end = block.end;
        for &(radius, v) in &smallest[block] {
            let Some(found) = balls.ball(mesh, topology, v).and_then(|ball| centred(ball.centre, index)) else {
                continue;
            };
            let is_less = least.is_none_or(|least| found.radius < least.radius);
            if is_less && found.radius >= CLEAR * radius && is_inside(found.centre, index) {
                least = Some(found);
            }
        }
        yielder.rest(0.5 + 0.5 * end as f32 / smallest.len() as f32).await;
    }
    let Ball { centre, radius } = least?;
    Some(Narrowest { diameter_mm: 2.0 * f64::from(radius), at_mm: centre.to_array() })
}

/// The smallest balls as medians of their rings, with their vertices: up to [`CANDIDATES`], ascending.
async fn smallest(topology: &Topology, balls: &InnerRadii, yielder: &Yielder) -> Vec<(f32, u32)> {
    let (mut smallest, mut ring) = (Vec::new(), Vec::new());
    for block in blocks(balls.own.len(), LOOKED) {
        let end = block.end;
        let median = |&v: &u32| (ring_median(topology, &balls.radii, v, &mut ring), v);
        smallest.extend(balls.own[block].iter().map(median).filter(|(radius, _)| radius.is_finite()));
        if smallest.len() > CANDIDATES {
            smallest.select_nth_unstable_by(CANDIDATES, by_radius);
            smallest.truncate(CANDIDATES);
        }
        yielder.rest(end as f32 / balls.own.len() as f32).await;
    }
    smallest.sort_unstable_by(by_radius);
    smallest
}

fn by_radius(a: &(f32, u32), b: &(f32, u32)) -> std::cmp::Ordering {
    a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
}

/// The ball in the middle between the nearest wall and the one behind it: a point is moved there while its clearance grows.
fn centred(mut at: Vec3, index: &SurfaceIndex) -> Option<Ball> {
    let mut nearest = index.nearest(at)?;
    for _ in 0..MOVES {
        let Some(away) = (at - nearest.point).try_normalize() else { break };
        let Some(behind) = index.depth(at, away) else { break };
        let moved = at + away * ((behind - nearest.distance) / 2.0);
        let Some(next) = index.nearest(moved).filter(|next| next.distance > nearest.distance) else { break };
        (at, nearest) = (moved, next);
    }
    Some(Ball { centre: at, radius: nearest.distance })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::inner_radii;
    use lumen_mesh::shapes::{icosphere, tube};
    use lumen_mesh::task::at_once;

    fn of(mesh: &TriMesh) -> Option<Narrowest> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        let balls = inner_radii(mesh, &topology, &index);
        at_once(narrowest(mesh, &topology, &balls, &index, &Yielder::never()))
    }

    #[test]
    fn of_a_flat_vessel_the_short_axis_counts() {
        let mut mesh = tube(64, 200, 40.0, |_| 3.0);
        mesh.positions.iter_mut().for_each(|p| p.y *= 0.4);
        let found = of(&mesh).unwrap();
        // Walls that face each other to within 30 degrees are down to 2.06 mm apart beside the middle, and the
        // tolerance of what is in the middle takes its part.
        assert!((1.75..2.42).contains(&found.diameter_mm), "{found:?}");
    }

    #[test]
    fn a_ball_grows_until_it_is_in_the_middle() {
        let mesh = tube(64, 80, 20.0, |_| 2.0);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        for off in [Vec3::X * 1.5, Vec3::new(-0.7, 0.9, 0.0), Vec3::ZERO] {
            let ball = centred(Vec3::Z * 10.0 + off, &index).unwrap();
            assert!(ball.centre.truncate().length() < 0.1 && (ball.radius - 2.0).abs() < 0.1, "{off}: {ball:?}");
        }
    }

    #[test]
    fn turned_inside_out_a_vessel_has_no_lumen() {
        let mut sphere = icosphere(3, 5.0, Vec3::ZERO);
        assert!((of(&sphere).unwrap().diameter_mm - 10.0).abs() < 0.2);
        sphere.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        assert_eq!(of(&sphere), None);
    }
}
