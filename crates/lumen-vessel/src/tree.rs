//! The vessel tree: branches between the places where vessels divide.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use super::TreeError;
use super::balls::fill;
use super::centreline::{Place, arcs, centreline};
use super::locating::{Located, Segments};
use super::paths::{Graph, Path, Skeleton};
use super::space::Space;
use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{Ball, SurfaceIndex, Topology, TriMesh, volume};
use lumen_message::messages;

/// A group of balls with less than this part of the largest group's volume is a speck, and has no branches.
const SPECK: f64 = 0.005;

/// What is at an end of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The surface is open there.
    Open,
    /// The vessel is closed there.
    Closed,
    /// It goes on in other branches.
    Joint,
}

messages! {
    /// What a branch is called.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum BranchName {
        /// By its number.
        "vessels-branch" Numbered {
            /// 1 for the first.
            number: u32,
        } => "branch {number}",
    }
}

impl BranchName {
    /// Of the branch at this place in [`Tree::branches`].
    pub fn of_place(place: u32) -> Self {
        Self::Numbered { number: place + 1 }
    }

    /// That of which this is the English name, as files keep it.
    pub fn read(english: &str) -> Option<Self> {
        let number = english.strip_prefix("branch ")?.parse().ok()?;
        Some(Self::Numbered { number })
    }
}

/// A vessel between two places where vessels divide or end.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Its place in [`Tree::branches`].
    pub id: u32,
    /// "branch 1" for the first.
    pub name: String,
    /// The branch that it comes out of; `None` for the first of each tree.
    pub parent: Option<u32>,
    /// Which of the surface's separate trees it belongs to.
    pub tree: u32,
    /// The centreline, away from the root. That of a side branch begins on its parent's centreline.
    pub points: Vec<Place>,
    /// Arc length at each point, in mm.
    pub arcs: Vec<f64>,
    /// The first point outside of the parent's lumen; 0 where the branch goes straight on.
    pub ostium: usize,
    /// What is at the first and at the last point.
    pub ends: [End; 2],
}

impl Branch {
    /// What it is called; `name` is the same in English.
    pub fn label(&self) -> BranchName {
        BranchName::of_place(self.id)
    }

    /// Whether it only goes on where its parent ends, past the ostium of a third.
    pub fn goes_straight_on(&self) -> bool {
        self.parent.is_some() && self.ostium == 0
    }

    /// Length of the centreline in mm.
    pub fn length_mm(&self) -> f64 {
        self.arcs.last().copied().unwrap_or(0.0)
    }
}

/// A group of linked balls on the way to a tree.
struct Group {
    number: u32,
    paths: Vec<Path>,
    bumps: usize,
    /// The centrelines of the first paths, and the place where each leaves its parent.
    lines: Vec<Vec<Place>>,
    joints: Vec<Option<usize>>,
    /// Where others leave each path.
    cuts: Vec<Vec<usize>>,
}

/// The vessel tree of a surface.
#[derive(Clone, Debug)]
pub struct Tree {
    /// The surface, and what is inside of it.
    pub space: Space,
    /// The balls, and which of them touch.
    pub graph: Graph,
    branches: Vec<Branch>,
    /// How many bumps, corners and stumps were too short to be a branch.
    pub bumps: usize,
    /// Balls of each tree's group.
    pub groups: Vec<u32>,
    segments: Segments,
}

impl Tree {
    /// Finds the tree of a surface.
    ///
    /// # Errors
    /// [`TreeError::NoTriangles`], [`TreeError::InsideOut`], [`TreeError::NoInside`], [`TreeError::Sheet`].
    pub fn new(mesh: &TriMesh) -> Result<Self, TreeError> {
        Self::with_index(mesh, Arc::new(SurfaceIndex::new(&mesh.positions, &mesh.triangles)))
    }

    /// As [`Self::new`], with an index of this surface that is there already.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_index(mesh: &TriMesh, index: Arc<SurfaceIndex>) -> Result<Self, TreeError> {
        let is_whole = |[a, b, c]: [u32; 3]| a != b && b != c && c != a;
        if mesh.triangles.iter().all(|&triangle| !is_whole(triangle)) {
            return Err(TreeError::NoTriangles);
        }
        let topology = if mesh.triangles.iter().all(|&triangle| is_whole(triangle)) {
            Topology::new(mesh.positions.len(), &mesh.triangles)
        } else {
            let whole: Vec<[u32; 3]> = mesh.triangles.iter().copied().filter(|&triangle| is_whole(triangle)).collect();
            Topology::new(mesh.positions.len(), &whole)
        };
        Self::with_topology(mesh, &topology, index)
    }

    /// As [`Self::with_index`], with the adjacency of its triangles, none of which repeats a vertex.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_topology(mesh: &TriMesh, topology: &Topology, index: Arc<SurfaceIndex>) -> Result<Self, TreeError> {
        at_once(Self::with_topology_in_slices(mesh, topology, index, &Yielder::never()))
    }

    /// As [`Self::with_topology`], resting after some balls, and after the centreline of a vessel.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub async fn with_topology_in_slices(
        mesh: &TriMesh,
        topology: &Topology,
        index: Arc<SurfaceIndex>,
        yielder: &Yielder,
    ) -> Result<Self, TreeError> {
        if mesh.triangles.is_empty() {
            return Err(TreeError::NoTriangles);
        }
        let space = Space::new(mesh, topology, index);
        yielder.rest(0.0).await;
        let found = fill(mesh, &space, &yielder.part(0.0..0.7)).await;
        if found.is_sheet {
            return Err(TreeError::Sheet { balls: found.balls.len() });
        }
        let graph = Graph::new(found);
        if graph.balls.is_empty() {
            let (is_turned, triangles) = (volume(mesh, topology) < 0.0, mesh.triangles.len());
            return Err(if is_turned { TreeError::InsideOut } else { TreeError::NoInside { triangles } });
        }
        let (branches, groups, segments) = (Vec::new(), Vec::new(), Segments::default());
        let mut tree = Self { space, graph, branches, bumps: 0, groups, segments };
        for number in tree.largest_groups() {
            yielder.rest(0.7).await;
            let Some(mut group) = tree.group(number) else { continue };
            while !tree.add_line(&mut group) {
                yielder.rest(0.7 + 0.3 * group.lines.len() as f32 / group.paths.len() as f32).await;
            }
            tree.add_branches(group);
        }
        for Branch { id, ostium, points, arcs, .. } in &tree.branches {
            tree.segments.add(*id, &points[*ostium..], &arcs[*ostium..]);
        }
        Ok(tree)
    }

    /// The branches, those of the largest tree first; a parent comes before its branches.
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// How many open ends no branch leads to.
    pub fn openings_without_branch(&self) -> usize {
        let ends = |branch: &Branch| {
            let places = [branch.points.first().copied(), branch.points.last().copied()];
            places.into_iter().zip(branch.ends).filter(|(_, end)| *end == End::Open).filter_map(|(place, _)| place)
        };
        let mut is_reached = vec![false; self.space.openings.len()];
        for opening in self.branches.iter().flat_map(ends).filter_map(|place| self.opening_at(place)) {
            is_reached[opening] = true;
        }
        is_reached.iter().filter(|&&is_reached| !is_reached).count()
    }

    /// Groups of linked balls, by what they measure along, longest first.
    fn largest_groups(&self) -> Vec<u32> {
        let mut sizes: Vec<(f64, u32)> = (0..self.graph.balls.len() as u32).map(|ball| (0.0, ball)).collect();
        for (ball, &group) in self.graph.balls.iter().zip(&self.graph.group) {
            // Their distance is about their radius, so the sum grows as the volume does.
            let radius = f64::from(ball.radius);
            sizes[group as usize].0 += radius * radius * radius;
        }
        let most = sizes.iter().map(|size| size.0).fold(0.0, f64::max);
        sizes.retain(|size| size.0 > SPECK * most);
        sizes.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        sizes.into_iter().map(|size| size.1).collect()
    }

    /// The paths of a group of balls, none of whose centrelines is there yet.
    fn group(&self, group: u32) -> Option<Group> {
        let root = self.root(group)?;
        let mut skeleton = self.graph.tree(root, |ball| self.is_open(ball));
        let wide_root = self.graph.wide_root(&skeleton, |ball| self.is_open(ball))?;
        if wide_root != root {
            skeleton = self.graph.tree(wide_root, |ball| self.is_open(ball));
        }
        let Skeleton { paths, bumps } = skeleton;
        let cuts = vec![Vec::new(); paths.len()];
        Some(Group { number: group, paths, bumps, lines: Vec::new(), cuts, joints: Vec::new() })
    }

    /// Adds the centreline of the group's next path, and where it leaves another; whether that was the last.
    fn add_line(&self, group: &mut Group) -> bool {
        let Some(path) = group.paths.get(group.lines.len()) else { return true };
        let (line, joint) = self.line(path, &group.lines, &group.paths);
        if let Some(joint) = joint {
            group.cuts[path.parent].push(joint);
        }
        group.joints.push(joint);
        group.lines.push(line);
        group.lines.len() == group.paths.len()
    }

    fn add_branches(&mut self, group: Group) {
        let tree = self.groups.len() as u32;
        self.groups.push(group.number);
        self.bumps += group.bumps;
        let Group { paths, lines, mut cuts, joints, .. } = group;
        // The branch of each path that ends at a cut or after it.
        let mut pieces: Vec<Vec<(usize, u32)>> = Vec::new();
        for (i, (path, line)) in paths.iter().zip(&lines).enumerate() {
            let last = line.len() - 1;
            cuts[i].retain(|&cut| cut > 0 && cut < last);
            cuts[i].push(last);
            cuts[i].sort_unstable();
            cuts[i].dedup();
            let mut parent = joints[i].and_then(|joint| {
                let piece = pieces[path.parent].iter().find(|piece| piece.0 >= joint);
                piece.map(|piece| piece.1)
            });
            let mut start = 0;
            let mut own = Vec::new();
            for &cut in &cuts[i] {
                let id = self.branches.len() as u32;
                let points = line[start..=cut].to_vec();
                let ostium = match parent {
                    Some(_) if start == 0 => ostium(&points, &lines[path.parent]),
                    _ => 0,
                };
                let end_at = |place: Place| if self.opening_at(place).is_some() { End::Open } else { End::Closed };
                let first = if start > 0 || parent.is_some() { End::Joint } else { end_at(points[0]) };
                let end = if cut < last { End::Joint } else { end_at(line[last]) };
                let name = format!("branch {}", id + 1);
                let arcs = arcs(&points);
                self.branches.push(Branch { id, name, parent, tree, points, arcs, ostium, ends: [first, end] });
                own.push((cut, id));
                parent = Some(id);
                start = cut;
            }
            pieces.push(own);
        }
    }

    /// The end to begin from: that of the widest vessel.
    fn root(&self, group: u32) -> Option<u32> {
        let members = (0..self.graph.balls.len() as u32).filter(|&ball| self.graph.group[ball as usize] == group);
        let radius = |ball: u32| self.graph.balls[ball as usize].radius;
        let largest = members.filter(|&ball| !self.graph.is_passing[ball as usize]);
        let largest = largest.reduce(|best, ball| if radius(ball) > radius(best) { ball } else { best })?;
        let Skeleton { paths, .. } = self.graph.tree(largest, |ball| self.is_open(ball));
        let ends = paths.iter().filter_map(|path| path.balls.last().copied());
        ends.reduce(|best, end| if radius(end) > radius(best) { end } else { best })
    }

    /// The centreline of a path, and the place on its parent's where it begins.
    fn line(&self, path: &Path, lines: &[Vec<Place>], paths: &[Path]) -> (Vec<Place>, Option<usize>) {
        let ball = |&number: &u32| self.graph.balls[number as usize];
        let mut balls: Vec<Ball> = path.balls.iter().map(ball).collect();
        let Some(parent) = lines.get(path.parent) else {
            self.extend(&mut balls, true);
            self.extend(&mut balls, false);
            return (centreline(&self.space, &balls, 0.0), None);
        };
        let at = self.graph.balls[paths[path.parent].balls[path.joint] as usize].centre.as_dvec3();
        let joint = nearest_place(parent, at);
        let trunk = parent[joint];
        balls.insert(0, Ball { centre: trunk.at.as_vec3(), radius: trunk.radius as f32 });
        self.extend(&mut balls, false);
        let mut line = centreline(&self.space, &balls, trunk.radius);
        line[0] = trunk;
        (line, Some(joint))
    }

    /// The open end at an end of a centreline.
    pub(crate) fn opening_at(&self, place: Place) -> Option<usize> {
        let p = place.at.as_vec3();
        let reach = |i: &usize| {
            let opening = &self.space.openings[*i];
            let to = p - opening.centre;
            let across = to - opening.outward * to.dot(opening.outward);
            let fits = opening.radius > 0.5 * place.radius as f32;
            fits && across.length() <= opening.radius && to.dot(opening.outward).abs() <= 1.2 * opening.radius
        };
        let distance = |i: usize| self.space.openings[i].centre.distance(p);
        let near = (0..self.space.openings.len()).filter(reach);
        near.reduce(|least, next| if distance(next) < distance(least) { next } else { least })
    }

    /// Whether a ball lies in an open end.
    fn is_open(&self, ball: &Ball) -> bool {
        self.opening_at(Place { at: ball.centre.as_dvec3(), radius: f64::from(ball.radius) }).is_some()
    }

    /// Leads a chain of balls out to the middle of the open end that it comes to.
    pub fn extend(&self, balls: &mut Vec<Ball>, at_start: bool) {
        let Some(&tip) = (if at_start { balls.first() } else { balls.last() }) else { return };
        let place = Place { at: tip.centre.as_dvec3(), radius: f64::from(tip.radius) };
        let Some(opening) = self.opening_at(place).map(|i| self.space.openings[i]) else { return };
        // Balls whose middle lies in the end's own plane or past it make the line double back.
        let is_past = |ball: &Ball| (ball.centre - opening.centre).dot(opening.outward) > -0.1 * opening.radius;
        let radius = tip.radius.min(opening.radius);
        let end = Ball { centre: opening.centre, radius };
        if at_start {
            while balls.len() > 1 && is_past(&balls[0]) {
                balls.remove(0);
            }
            balls.insert(0, end);
        } else {
            while balls.len() > 1 && balls.last().is_some_and(is_past) {
                balls.pop();
            }
            balls.push(end);
        }
    }

    /// Where `p` is: the branch whose lumen holds it deepest, or is nearest to it. `last` is the answer for a point near
    /// by, if there is one; it makes this faster and changes nothing.
    pub fn locate(&self, p: DVec3, last: Option<&Located>) -> Option<Located> {
        self.segments.locate(p, last)
    }

    /// Whether a point lies in the lumen.
    pub fn is_inside(&self, p: Vec3) -> bool {
        self.space.is_inside(p)
    }
}

/// The place of a line that is nearest to a point.
pub(crate) fn nearest_place(line: &[Place], p: DVec3) -> usize {
    let places = line.iter().map(|place| place.at.distance_squared(p)).enumerate();
    places.reduce(|least, next| if next.1 < least.1 { next } else { least }).map_or(0, |(place, _)| place)
}

/// The first of `points` out of the lumen of the line that they leave.
fn ostium(points: &[Place], parent: &[Place]) -> usize {
    let is_out = |point: &Place| {
        let nearest = parent[nearest_place(parent, point.at)];
        nearest.at.distance(point.at) >= nearest.radius
    };
    points.iter().position(is_out).unwrap_or(points.len().saturating_sub(2))
}
