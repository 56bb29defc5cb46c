//! The triangles around a vertex, four at a time: where they pull it, and whether it may go there.
//!
//! Lanes are added in one order, so that the sums are the same on every platform.

use glam::{Vec3, Vec4};

use super::net::Net;
use super::triangle::MOST_TURN;

/// Triangles that there is room for.
const MOST: usize = 16;

/// The triangles around a vertex, seen from it.
#[derive(Default)]
pub(super) struct Ring {
    /// The two other corners of each triangle, by axis.
    b: [[f32; MOST]; 3],
    c: [[f32; MOST]; 3],
    /// The sum of the wanted lengths at a triangle's corners.
    size: [f32; MOST],
    count: usize,
}

/// Three coordinates of four vectors.
type Four = [Vec4; 3];

#[inline]
fn cross(a: Four, b: Four) -> Four {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline]
fn dot(a: Four, b: Four) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn sub(a: Four, b: Four) -> Four {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
fn sum(a: Vec4) -> f32 {
    let [x, y, z, w] = a.to_array();
    (x + y) + (z + w)
}

impl Ring {
    /// Takes the triangles around `v`; `false` where there are more than there is room for.
    pub(super) fn gather(&mut self, net: &Net, v: u32) -> bool {
        let (p, own) = (net.at[v as usize], net.size[v as usize]);
        let beside = |n: u32| (net.at[n as usize] - p, net.size[n as usize]);
        self.count = 0;
        let mut neighbours = net.neighbours(v).map(|(n, _)| n);
        let Some(first) = neighbours.next().map(beside) else { return false };
        let mut last = first;
        for next in neighbours.map(beside) {
            if self.count + 1 >= MOST {
                return false;
            }
            self.put(last, next, own);
            last = next;
        }
        if !net.is_rim(v) {
            self.put(last, first, own);
        }
        // What is beyond is a triangle that is there, without weight.
        for i in self.count..self.count.next_multiple_of(4) {
            for axis in 0..3 {
                self.b[axis][i] = self.b[axis][0];
                self.c[axis][i] = self.c[axis][0];
            }
            self.size[i] = f32::INFINITY;
        }
        true
    }

    #[inline]
    fn put(&mut self, (b, size_b): (Vec3, f32), (c, size_c): (Vec3, f32), own: f32) {
        let i = self.count;
        for axis in 0..3 {
            self.b[axis][i] = b[axis];
            self.c[axis][i] = c[axis];
        }
        self.size[i] = own + size_b + size_c;
        self.count += 1;
    }

    #[inline]
    fn four(&self, first: usize) -> [Four; 2] {
        let lanes = |of: &[f32; MOST]| Vec4::from_slice(&of[first..first + 4]);
        [[0, 1, 2].map(|axis| lanes(&self.b[axis])), [0, 1, 2].map(|axis| lanes(&self.c[axis]))]
    }

    /// The way along the surface to the middle of the triangles, each weighted by its area in wanted lengths, and the
    /// normal, as long as twice their area.
    pub(super) fn pull(&self) -> (Vec3, Vec3) {
        let (mut to, mut weights, mut normal) = ([Vec4::ZERO; 3], Vec4::ZERO, [Vec4::ZERO; 3]);
        for first in (0..self.count).step_by(4) {
            let [b, c] = self.four(first);
            let size = Vec4::from_slice(&self.size[first..first + 4]);
            let area = cross(b, c);
            let squared = dot(area, area);
            let length = Vec4::from_array(squared.to_array().map(f32::sqrt));
            let weight = length / (size * size);
            let is_there = Vec4::select(size.cmplt(Vec4::INFINITY), Vec4::ONE, Vec4::ZERO);
            weights += weight;
            for axis in 0..3 {
                to[axis] += (b[axis] + c[axis]) * weight;
                normal[axis] += area[axis] * is_there;
            }
        }
        let (to, normal) = (Vec3::from(to.map(sum)), Vec3::from(normal.map(sum)));
        let step = to / (3.0 * sum(weights));
        (step - normal * (step.dot(normal) / normal.length_squared().max(f32::MIN_POSITIVE)), normal)
    }

    /// Whether the vertex can go that way with all faces still facing where they do, and none a sliver before or after;
    /// where this says no, `may_become` has the last word.
    pub(super) fn surely_allows(&self, way: Vec3) -> bool {
        let way: Four = way.to_array().map(Vec4::splat);
        (0..self.count).step_by(4).all(|first| {
            let [b, c] = self.four(first);
            let (new_b, new_c) = (sub(b, way), sub(c, way));
            let (before, after) = (cross(b, c), cross(new_b, new_c));
            let (square_before, square_after) = (dot(before, before), dot(after, after));
            let opposite = sub(b, c);
            let opposite = dot(opposite, opposite);
            let sides_before = dot(b, b) + dot(c, c) + opposite;
            let sides_after = dot(new_b, new_b) + dot(new_c, new_c) + opposite;
            let turn = dot(before, after);
            // A quality of 0.1 is 0.01 squared, and 12 times the squared doubled area over that of the sides.
            let is_kept = turn.cmpgt(Vec4::ZERO)
                & (turn * turn).cmpgt(square_before * square_after * (1.01 * MOST_TURN * MOST_TURN))
                & (square_before * 12.0).cmpgt(sides_before * sides_before * 0.01)
                & (square_after * 12.0).cmpgt(sides_after * sides_after * 0.011);
            is_kept.all()
        })
    }
}

#[cfg(test)]
mod tests {
    use lumen_mesh::shapes::{icosphere, tube};

    use super::super::net::NONE;
    use super::super::triangle::{doubled, may_become};
    use super::*;

    fn nets() -> [Net; 2] {
        [icosphere(2, 3.0, Vec3::ONE), tube(9, 6, 4.0, |_| 1.0)].map(|mesh| {
            let mut net = Net::new(&mesh.positions, &mesh.triangles, vec![0; mesh.triangles.len()]).unwrap();
            net.size = (0..net.at.len()).map(|v| 1.0 + (v % 5) as f32 * 0.1).collect();
            net
        })
    }

    #[test]
    fn a_vertex_is_pulled_to_the_weighted_middle_of_its_triangles() {
        for net in nets() {
            let mut ring = Ring::default();
            for v in (0..net.at.len() as u32).filter(|&v| net.out[v as usize] != NONE) {
                assert!(ring.gather(&net, v));
                let (mut middle, mut weights, mut normal) = (Vec3::ZERO, 0.0, Vec3::ZERO);
                for h in net.around(v) {
                    let corners = net.corners(h / 3);
                    let size: f32 = (0..3).map(|i| net.size[net.origin(h / 3 * 3 + i) as usize]).sum();
                    let weight = doubled(corners).length() / (size * size);
                    middle += corners.iter().sum::<Vec3>() / 3.0 * weight;
                    weights += weight;
                    normal += doubled(corners);
                }
                let to = middle / weights - net.at[v as usize];
                let (pull, facing) = ring.pull();
                assert!(pull.distance(to - to.project_onto(normal)) < 1e-5);
                assert!(facing.distance(normal) < 1e-5);
            }
        }
    }

    #[test]
    fn what_surely_may_be_may_be() {
        for net in nets() {
            let mut ring = Ring::default();
            let mut allowed = [0, 0];
            for v in 0..net.at.len() as u32 {
                assert!(ring.gather(&net, v));
                let p = net.at[v as usize];
                for step in 0..20 {
                    let way = Vec3::new(
                        step as f32 * 0.1 - 1.0,
                        (step % 7) as f32 * 0.2 - 0.6,
                        (step % 3) as f32 * 0.4 - 0.4,
                    );
                    let surely = ring.surely_allows(way);
                    let may = net.around(v).all(|h| {
                        let [b, c] = [net.end(h), net.apex(h)].map(|n| net.at[n as usize]);
                        may_become([p, b, c], [p + way, b, c], || Vec3::ZERO)
                    });
                    assert!(may || !surely, "{v} by {way}");
                    allowed[usize::from(may)] += usize::from(surely == may);
                }
            }
            assert!(allowed.iter().all(|&count| count > 20), "{allowed:?}");
        }
    }
}
