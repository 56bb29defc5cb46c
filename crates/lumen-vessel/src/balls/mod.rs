//! Fills a lumen with overlapping balls, each as large as fits, and links those that a wire could pass between.
//!
//! From every place of the wall that no ball explains, a ball is begun in the middle behind it. From each ball new ones
//! are looked for in twelve directions near its surface, moved to the middle, and kept if none like it is there. So
//! wide vessels have few balls and thin ones many, none is missed for being thin, and two linked balls overlap: the way
//! between them is open, whatever the wall around looks like.

mod cells;

use glam::Vec3;

use self::cells::{Grid, Wall};
use super::space::Space;
use lumen_mesh::disjoint_sets::{root, union};
use lumen_mesh::task::Yielder;
use lumen_mesh::{Ball, Nearest, TriMesh, mean_edge};

/// Two balls closer than this part of the smaller radius are the same.
const SAME: f32 = 0.4;
/// How far out, as a part of the radius, the next ball is looked for.
const REACH: f32 = 0.9;
/// There the wall must be this part of the radius away.
const OPEN: f32 = 0.3;
/// A wall is explained by a ball that reaches it when it is this much larger.
const EXPLAINED: f32 = 1.3;
/// What has to fit through between two linked balls, as a part of the smaller radius.
const PASSAGE: f32 = 0.5;
/// The farthest apart that two of which so much fits through can be, in radii of the larger.
const FARTHEST: f32 = 1.9;
/// A ball found from others is not smaller than this part of the one that was begun with.
const SMALLER: f32 = 0.5;
/// Nor does one begin with a ball whose radius is below this part of a mean edge.
const MIN_RADIUS: f32 = 0.05;
/// Or below this part of the largest radius: a tenth of a millimetre or so in a tree with an aorta.
const THINNEST: f32 = 0.01;
/// Balls that are too many for any vessel tree.
const MAX_BALLS: usize = 200_000;
/// From this many on, a sheet is told from vessels by how many others a ball is linked with: in vessels three to five,
/// in a sheet nine or more.
const MANY: usize = 16_384;
const SHEET: usize = 7;
/// Places of the wall, about, behind which the largest radius is looked for.
const PROBES: usize = 256;
/// Balls looked around from between two looks at the clock.
const STEPS: usize = 16;
/// No ball.
const NONE: u32 = u32::MAX;

/// Balls and the links between them.
#[derive(Clone, Debug, Default)]
pub struct Balls {
    pub balls: Vec<Ball>,
    /// Whether a ball only stands on the way between two others, and is not in the middle.
    pub is_passing: Vec<bool>,
    /// Pairs of linked balls.
    pub links: Vec<[u32; 2]>,
    /// A ball of each group of linked balls, for each ball.
    pub group: Vec<u32>,
    /// Whether they fill a sheet, and it was left at that.
    pub is_sheet: bool,
    /// From this many balls on they are looked at again.
    next_count: usize,
}

impl Balls {
    /// Looks whether these are more than vessels have: in a sheet every ball has others all around it.
    fn count(&mut self) {
        let count = self.balls.len();
        if count < self.next_count {
            return;
        }
        self.next_count = 2 * count.max(MANY / 2);
        self.links.sort_unstable();
        self.links.dedup();
        self.is_sheet = count >= MAX_BALLS || (count >= MANY && self.links.len() * 2 > SHEET * count);
    }
}

/// A surface that is filled.
#[derive(Clone, Copy)]
struct Surface<'a> {
    space: &'a Space,
    positions: &'a [Vec3],
}

/// Balls while they are being found.
struct Filling {
    normals: Vec<Vec3>,
    grid: Grid,
    wall: Wall,
    found: Balls,
    projections: Vec<Nearest>,
    /// The first ball of each cell, and the next one in the same cell for each ball.
    first: Vec<u32>,
    next: Vec<u32>,
    /// Balls to look around from.
    pending: Vec<u32>,
    /// Smaller balls are not begun with.
    least: f32,
    /// Smaller balls are not gone on with: from a crevice it would go ever deeper. What is thinner is begun from its own
    /// wall.
    floor: f32,
}

fn vertex_normals(mesh: &TriMesh) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    for (t, corners) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = mesh.corners(t);
        let normal = (b - a).cross(c - a);
        for &v in corners {
            normals[v as usize] += normal;
        }
    }
    normals
}

/// Fills the inside of `mesh`, which bounds `space`, with balls.
pub(super) async fn fill(mesh: &TriMesh, space: &Space, yielder: &Yielder) -> Balls {
    let mut filling = Filling::new(mesh);
    yielder.rest(0.0).await;
    let on = Surface { space, positions: &mesh.positions };
    let count = filling.normals.len();
    for v in (0..count).step_by((count / PROBES).max(1)) {
        filling.probe(on, v);
        yielder.rest(0.0).await;
    }
    let mut vertex = 0;
    for step in 1.. {
        if let Some(from) = filling.pending.pop() {
            filling.look_around(on, from);
            filling.found.count();
        } else {
            let Some((v, normal)) = filling.next_start(vertex) else { break };
            vertex = v + 1;
            filling.begin(on, on.positions[v], normal);
        }
        if filling.found.is_sheet {
            break;
        }
        if step % STEPS == 0 {
            yielder.rest(vertex as f32 / count as f32).await;
        }
    }
    yielder.rest(1.0).await;
    filling.finished()
}

impl Filling {
    /// Nothing yet of the inside of `mesh`.
    fn new(mesh: &TriMesh) -> Self {
        let normals = vertex_normals(mesh);
        let grid = Grid::new(&mesh.bounds());
        let wall = Wall::new(&grid, &mesh.positions);
        let first = vec![NONE; grid.len()];
        let least = MIN_RADIUS * mean_edge(mesh);
        let (projections, next, pending) = (Vec::new(), Vec::new(), Vec::new());
        let found = Balls::default();
        Self { normals, grid, wall, found, projections, first, next, pending, least, floor: 0.0 }
    }

    /// The next vertex to begin at, and its normal, from `first` on.
    fn next_start(&self, first: usize) -> Option<(usize, Vec3)> {
        let is_new = |v: &usize| !self.wall.is_explained[*v];
        let normal = |v: usize| Some((v, self.normals[v].try_normalize()?));
        (first..self.normals.len()).filter(is_new).find_map(normal)
    }

    /// Looks for the largest radius behind one of a few hundred places of the wall.
    fn probe(&mut self, on: Surface<'_>, v: usize) {
        let normal = self.normals[v].try_normalize();
        if let Some((ball, _)) = normal.and_then(|normal| on.space.behind_wall(on.positions[v], normal)) {
            self.least = self.least.max(THINNEST * ball.radius);
        }
    }

    /// Begins in the middle behind a point of the wall, and goes on from there as far as it goes.
    fn begin(&mut self, on: Surface<'_>, p: Vec3, normal: Vec3) {
        let Some((start, start_projection)) = on.space.behind_wall(p, normal) else { return };
        // Not again from the places around, whatever came of this one.
        self.wall.explain(&self.grid, on.positions, p, 0.3 * start.radius);
        if start.radius < self.least {
            return;
        }
        let mut on_the_way = vec![start];
        let (ball, projection) = on.space.ascend(start, start_projection, |next| on_the_way.push(next));
        let number = match self.like(&ball) {
            Some(number) => number,
            None if on.space.is_inside(ball.centre) => {
                self.floor = (SMALLER * ball.radius).max(self.least);
                self.add(on, ball, projection, false)
            }
            None => return,
        };
        self.join_at_waist(on, &on_the_way, start_projection, number);
    }

    /// Where a vessel is narrow only for a short way, the middle goes off to where it is wider, on either side of the
    /// waist: what lies between is kept as a way from one to the other.
    fn join_at_waist(&mut self, on: Surface<'_>, on_the_way: &[Ball], projection: Nearest, to: u32) {
        let start = on_the_way[0];
        let end = self.found.balls[to as usize];
        if start.centre.distance(end.centre) <= SAME * start.radius || self.like(&start).is_some() {
            return;
        }
        let own = self.found.balls.len() as u32;
        let mut last = None;
        for &ball in on_the_way {
            let number = self.add(on, ball, projection, true);
            if let Some(last) = last {
                self.link(last, number);
            }
            last = Some(number);
            if ball.passage(&end) >= PASSAGE * ball.radius.min(end.radius) {
                break;
            }
        }
        if let Some(last) = last {
            self.link(last, to);
        }
        let mut near = Vec::new();
        for cell in self.grid.around(start.centre, 1.5 * start.radius) {
            let mut at = self.first[cell];
            while at != NONE {
                if self.found.balls[at as usize].passage(&start) >= PASSAGE * start.radius {
                    near.push(at);
                }
                at = self.next[at as usize];
            }
        }
        near.sort_unstable();
        for other in near {
            if other != own {
                self.link(own, other);
            }
        }
    }

    fn add(&mut self, on: Surface<'_>, ball: Ball, projection: Nearest, is_passing: bool) -> u32 {
        let number = self.found.balls.len() as u32;
        let cell = self.grid.cell(self.grid.place(ball.centre));
        self.found.balls.push(ball);
        self.found.is_passing.push(is_passing);
        self.found.group.push(number);
        self.projections.push(projection);
        self.next.push(self.first[cell]);
        self.first[cell] = number;
        if !is_passing {
            self.wall.explain(&self.grid, on.positions, ball.centre, EXPLAINED * ball.radius);
            self.pending.push(number);
        }
        number
    }

    /// The nearest ball within `reach` for which `is_it`.
    fn nearest(&self, p: Vec3, reach: f32, is_it: impl Fn(&Ball, f32) -> bool) -> Option<u32> {
        let mut best = (f32::INFINITY, NONE);
        for cell in self.grid.around(p, reach) {
            let mut at = self.first[cell];
            while at != NONE {
                let ball = &self.found.balls[at as usize];
                let distance = ball.centre.distance(p);
                if (distance, at) < best && distance <= reach && is_it(ball, distance) {
                    best = (distance, at);
                }
                at = self.next[at as usize];
            }
        }
        (best.1 != NONE).then_some(best.1)
    }

    /// A ball that is as good as this one.
    fn like(&self, ball: &Ball) -> Option<u32> {
        self.nearest(ball.centre, SAME * ball.radius, |other, distance| {
            distance <= SAME * other.radius && other.radius >= 0.5 * ball.radius
        })
    }

    fn look_around(&mut self, on: Surface<'_>, from: u32) {
        let ball = self.found.balls[from as usize];
        let mut on_the_way = Vec::new();
        for direction in directions() {
            let p = ball.centre + direction * (REACH * ball.radius);
            if on.space.leaves(ball.centre, p) {
                continue;
            }
            let near = |other: &Ball, distance: f32| {
                distance <= 0.3 * other.radius && other.radius >= 0.5 * ball.radius && other.centre != ball.centre
            };
            if let Some(other) = self.nearest(p, 0.6 * ball.radius, near)
                && self.found.balls[other as usize].passage(&ball) >= PASSAGE * ball.radius
            {
                self.link(from, other);
                continue;
            }
            let Some((start, projection)) = on.space.ball(p, Some(&self.projections[from as usize])) else { continue };
            if start.radius < OPEN * ball.radius {
                continue;
            }
            on_the_way.clear();
            on_the_way.push(start);
            let (found, projection) = on.space.ascend(start, projection, |next| on_the_way.push(next));
            if found.radius < self.floor {
                continue;
            }
            match self.like(&found) {
                Some(other) if other == from => {}
                Some(other) => self.link_by(on, from, other, &on_the_way, projection),
                None => {
                    let number = self.add(on, found, projection, false);
                    self.link_by(on, from, number, &on_the_way, projection);
                }
            }
        }
    }

    /// Links two balls, by those on the way between them if they do not overlap enough.
    fn link_by(&mut self, on: Surface<'_>, from: u32, to: u32, on_the_way: &[Ball], projection: Nearest) {
        let [a, b] = [from, to].map(|ball| self.found.balls[ball as usize]);
        if a.passage(&b) >= PASSAGE * a.radius.min(b.radius) {
            self.link(from, to);
        } else if root(&mut self.found.group, from) != root(&mut self.found.group, to) {
            let mut last = from;
            for &ball in on_the_way {
                let passing = self.add(on, ball, projection, true);
                self.link(last, passing);
                last = passing;
            }
            self.link(last, to);
        }
    }

    fn link(&mut self, a: u32, b: u32) {
        self.found.links.push([a.min(b), a.max(b)]);
        union(&mut self.found.group, a, b);
    }

    /// Links all balls that overlap: what lies in both is in one lumen. In a wide straight vessel every ball that is looked
    /// for may move back to the one it was looked for from, and two chains come to stand side by side, linked at one end
    /// or nowhere: the way from one end of the vessel to the other would lead to and fro.
    fn link_overlapping(&mut self) {
        let count = self.found.balls.len();
        let mut pairs = Vec::new();
        for (number, ball) in self.found.balls.iter().enumerate() {
            // From the larger of two.
            let mut look_at = |other: usize| {
                let smaller = &self.found.balls[other];
                let is_larger = (ball.radius, number) > (smaller.radius, other);
                if is_larger && ball.passage(smaller) >= PASSAGE * smaller.radius {
                    pairs.push((number as u32, other as u32));
                }
            };
            let reach = FARTHEST * ball.radius;
            if self.grid.count_around(ball.centre, reach) > count {
                (0..count).for_each(look_at);
                continue;
            }
            for cell in self.grid.around(ball.centre, reach) {
                let mut at = self.first[cell];
                while at != NONE {
                    look_at(at as usize);
                    at = self.next[at as usize];
                }
            }
        }
        pairs.into_iter().for_each(|(a, b)| self.link(a, b));
    }

    fn finished(mut self) -> Balls {
        if !self.found.is_sheet {
            self.link_overlapping();
        }
        for ball in 0..self.found.balls.len() as u32 {
            self.found.group[ball as usize] = root(&mut self.found.group, ball);
        }
        self.found.links.sort_unstable();
        self.found.links.dedup();
        self.found
    }
}

/// The corners of an icosahedron, turned so that none lies along an axis.
fn directions() -> [Vec3; 12] {
    const GOLDEN: f32 = 1.618_034;
    // Columns of a rotation.
    let [x, y, z] = [
        Vec3::new(0.804_738, 0.505_879, -0.310_617),
        Vec3::new(-0.310_617, 0.804_738, 0.505_879),
        Vec3::new(0.505_879, -0.310_617, 0.804_738),
    ];
    let corners = [[0.0, 1.0, GOLDEN], [0.0, -1.0, GOLDEN], [0.0, 1.0, -GOLDEN], [0.0, -1.0, -GOLDEN]];
    let mut all = [Vec3::ZERO; 12];
    for (slot, [a, b, c]) in all.iter_mut().zip(corners.iter().flat_map(|&[a, b, c]| [[a, b, c], [b, c, a], [c, a, b]]))
    {
        *slot = (x * a + y * b + z * c).normalize();
    }
    all
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::paths::Graph;
    use lumen_mesh::shapes::tube;
    use lumen_mesh::{SurfaceIndex, Topology};

    #[test]
    fn balls_that_overlap_are_in_one_group_and_others_are_not() {
        let mesh = tube(48, 120, 60.0, |_| 5.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = Arc::new(SurfaceIndex::new(&mesh.positions, &mesh.triangles));
        let space = Space::new(&mesh, &topology, index);
        let on = Surface { space: &space, positions: &mesh.positions };
        let mut filling = Filling::new(&mesh);
        // 3 mm apart what fits through is 4.8 mm wide; 9.5 mm apart it is 1.6 mm, less than half a radius; then nothing.
        for z in [15.0, 18.0, 27.5, 40.0] {
            let (ball, projection) = space.ball(Vec3::Z * z, None).unwrap();
            filling.add(on, ball, projection, false);
        }
        let found = filling.finished();
        assert_eq!(found.links, [[0, 1]]);
        assert!(
            found.group[0] == found.group[1] && found.group[1] != found.group[2] && found.group[2] != found.group[3]
        );
    }

    #[test]
    fn a_chain_beside_another_is_no_vessel_of_its_own() {
        // Two chains in a vessel of 5 mm, half a place apart, that are linked at one end only.
        let along = |chain: u32| (0..12u32).map(move |i| (chain, i));
        let ball = |(chain, i): (u32, u32)| Ball {
            centre: Vec3::new(2.0 * i as f32 + chain as f32, 0.1 * chain as f32, 0.0),
            radius: 5.0,
        };
        let balls: Vec<Ball> = along(0).chain(along(1)).map(ball).collect();
        let steps = |first: u32| (first..first + 11).map(|i| [i, i + 1]);
        let links: Vec<[u32; 2]> = steps(0).chain(steps(12)).chain([[0, 12]]).collect();
        let (is_passing, group) = (vec![false; balls.len()], vec![0; balls.len()]);
        let graph = Graph::new(Balls { balls, is_passing, links, group, ..Balls::default() });
        let paths = graph.tree(0, |_| false).paths;
        assert_eq!(paths.len(), 1, "{paths:?}");
    }
}
