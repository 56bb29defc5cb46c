//! The rigid motion that brings one surface onto another, where the same vessel stands elsewhere.
//!
//! Points of the surface are paired with the nearest places of the other, and moved towards the planes there, again and
//! again (Chen and Medioni, "Object modelling by registration of multiple range images", 1992). Pairs much farther apart
//! than most are left out: what only one of the surfaces has pulls at nothing (Chetverikov, Svirko, Stepanov and Krsek,
//! "The trimmed iterative closest point algorithm", 2002). It begins where the surface stands, and with the middles
//! together, each also half a turn about the third axis, which lies between LPS and RAS; the best of these goes on.

use glam::{DQuat, DVec3, Vec3};

use super::sampling::{Sampler, Side};
use lumen_mesh::task::Yielder;
use lumen_mesh::{Nearest, SurfaceIndex, TriMesh};

/// Points of the surface, when beginnings are tried and when the best of them goes on.
const POINTS: [usize; 2] = [500, 5_000];

/// Steps at most of a beginning, and of the best.
const STEPS: [usize; 2] = [25, 200];

/// The part of the pairs that the residual is of.
const PART: f64 = 0.8;

/// A pair that is farther apart than this many times their median counts for nothing.
const FAR: f64 = 3.0;

/// A beginning goes on in place of one before it where its residual is less than this part of that one's, and that one's
/// not less than this part of the size.
const CLEARLY: f64 = 0.9;
const NEGLIGIBLE: f64 = 1e-5;

/// A step that moves nothing farther than this part of the size is the last.
const STILL: f64 = 1e-7;

/// Of the trace of the equations: along and about a straight tube nothing holds a surface.
const DAMPING: f64 = 1e-9;

/// A rotation about the origin, then a shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// The rotation.
    pub rotation: DQuat,
    /// The shift in mm.
    pub shift_mm: DVec3,
}

/// What [`align`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aligned {
    /// What is to be done to the surface.
    pub motion: Rigid,
    /// Root of the mean square distance of the nearest four fifths of its points before, in mm.
    pub before_mm: f64,
    /// And after: the residual.
    pub residual_mm: f64,
}

impl Rigid {
    /// Half a turn about the third axis: from LPS to RAS, and back.
    pub const HALF_TURN: Self = Self { rotation: DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0), shift_mm: DVec3::ZERO };

    /// Nothing is moved.
    pub const STILL: Self = Self { rotation: DQuat::IDENTITY, shift_mm: DVec3::ZERO };

    /// A shift alone.
    pub fn shift(mm: DVec3) -> Self {
        Self { shift_mm: mm, ..Self::STILL }
    }

    /// Where `p` comes to.
    pub fn of(&self, p: Vec3) -> Vec3 {
        self.moved(p.as_dvec3()).as_vec3()
    }

    /// The angle of the rotation in degrees, 0 to 180.
    pub fn angle_deg(&self) -> f64 {
        2.0 * libm::atan2(self.rotation.xyz().length(), self.rotation.w.abs()).to_degrees()
    }

    /// [`of`](Self::of), in 64 bits.
    pub fn moved(&self, p: DVec3) -> DVec3 {
        self.rotation * p + self.shift_mm
    }

    /// About a place, to another.
    fn about(rotation: DQuat, from: DVec3, to: DVec3) -> Self {
        Self { rotation, shift_mm: to - rotation * from }
    }

    /// This motion, then another.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        Self { rotation: (next.rotation * self.rotation).normalize(), shift_mm: next.moved(self.shift_mm) }
    }
}

/// Brings `mesh` onto `other`, of which `index` is; `None` where one of them has no area.
pub async fn align(mesh: &TriMesh, other: &TriMesh, index: &SurfaceIndex, yielder: &Yielder) -> Option<Aligned> {
    let [of_mesh, of_other] = [Side::new(mesh, None, yielder).await, Side::new(other, None, yielder).await];
    if !(of_mesh.has_area() && of_other.has_area()) {
        return None;
    }
    let points = |side: &Side<'_>, count: usize| -> Vec<DVec3> {
        Sampler { side, count, stream: 0 }.samples(0, count).map(|sample| sample.point.as_dvec3()).collect()
    };
    let [few, many] = POINTS.map(|count| points(&of_mesh, count));
    let middle = |of: &[DVec3]| of.iter().sum::<DVec3>() / of.len() as f64;
    let (from, to) = (middle(&many), middle(&points(&of_other, POINTS[1])));
    let onto = Onto { mesh: other, index };
    let (stay, turned) = (Rigid::STILL, Rigid::HALF_TURN);
    let centred = |motion: Rigid| Rigid::about(motion.rotation, from, to);
    let beginnings = [stay, centred(stay), turned, centred(turned)];

    let before_mm = onto.pairs(&many, stay)?.residual();
    let negligible = NEGLIGIBLE * many.iter().map(|p| p.distance(from)).fold(0.0, f64::max);
    let mut best: Option<(f64, Rigid)> = None;
    for (i, beginning) in beginnings.into_iter().enumerate() {
        let part = yielder.part(0.1 * i as f32..0.1 * (i + 1) as f32);
        let found = onto.descended(&few, beginning, STEPS[0], &part).await?;
        // Of those that fit about as well the first: it moves what has more than one way to fit the least.
        if best.is_none_or(|(least, _)| found.0 < CLEARLY * least && least > negligible) {
            best = Some(found);
        }
    }
    let (residual_mm, motion) = onto.descended(&many, best?.1, STEPS[1], &yielder.part(0.4..1.0)).await?;
    // Where nothing is gained, nothing is moved.
    let (residual_mm, motion) = if residual_mm < before_mm { (residual_mm, motion) } else { (before_mm, stay) };
    Some(Aligned { motion, before_mm, residual_mm })
}

/// What points are brought onto.
#[derive(Clone, Copy)]
struct Onto<'a> {
    mesh: &'a TriMesh,
    index: &'a SurfaceIndex,
}

impl<'a> Onto<'a> {
    /// The residual and the motion after `steps` at most from `begun`.
    async fn descended(self, points: &[DVec3], begun: Rigid, steps: usize, yielder: &Yielder) -> Option<(f64, Rigid)> {
        let mut pairs = self.pairs(points, begun)?;
        let mut best = (pairs.residual(), begun);
        let mut motion = begun;
        for step in 0..steps {
            let (change, moved) = pairs.step()?;
            motion = motion.then(change);
            pairs = self.pairs(points, motion)?;
            let residual = pairs.residual();
            if residual < best.0 {
                best = (residual, motion);
            }
            yielder.rest(step as f32 / steps as f32).await;
            if moved <= STILL {
                break;
            }
        }
        Some(best)
    }

    /// `None` where there is nothing to be near to.
    fn pairs(self, points: &[DVec3], motion: Rigid) -> Option<Pairs<'a>> {
        let pair = |&p: &DVec3| {
            let p = motion.moved(p);
            Some((p, self.index.nearest(p.as_vec3())?))
        };
        Some(Pairs { onto: self.mesh, pairs: points.iter().map(pair).collect::<Option<_>>()? })
    }
}

/// Points of a surface where a motion brings them, and the place of the other that is nearest to each.
struct Pairs<'a> {
    onto: &'a TriMesh,
    pairs: Vec<(DVec3, Nearest)>,
}

impl Pairs<'_> {
    fn sorted(&self) -> Vec<f64> {
        let mut distances: Vec<f64> = self.pairs.iter().map(|(_, found)| f64::from(found.distance)).collect();
        distances.sort_unstable_by(f64::total_cmp);
        distances
    }

    /// Root of the mean square of the nearest [`PART`] of the distances, in mm.
    fn residual(&self) -> f64 {
        let distances = self.sorted();
        let count = ((distances.len() as f64 * PART) as usize).max(1);
        (distances.iter().take(count).map(|distance| distance * distance).sum::<f64>() / count as f64).sqrt()
    }

    /// The motion that brings the points nearest to the planes of their triangles, and how far it moves any, as a part of
    /// the size of the surface.
    fn step(&self) -> Option<(Rigid, f64)> {
        let distances = self.sorted();
        let far = FAR * distances[distances.len() / 2];
        let middle = self.pairs.iter().map(|(p, _)| *p).sum::<DVec3>() / self.pairs.len() as f64;
        let squared = self.pairs.iter().map(|(p, _)| p.distance_squared(middle)).sum::<f64>();
        let size = (squared / self.pairs.len() as f64).sqrt().max(f64::MIN_POSITIVE);
        let (mut matrix, mut right) = ([[0.0; 6]; 6], [0.0; 6]);
        for (p, found) in self.pairs.iter().filter(|(_, found)| f64::from(found.distance) <= far) {
            let [a, b, c] = self.onto.corners(found.triangle as usize).map(Vec3::as_dvec3);
            let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
            let lever = (*p - middle).cross(normal) / size;
            let row = [lever.x, lever.y, lever.z, normal.x, normal.y, normal.z];
            let gap = normal.dot(*p - found.point.as_dvec3());
            for i in 0..6 {
                right[i] -= row[i] * gap;
                for j in 0..6 {
                    matrix[i][j] += row[i] * row[j];
                }
            }
        }
        let trace: f64 = (0..6).map(|i| matrix[i][i]).sum();
        (0..6).for_each(|i| matrix[i][i] += DAMPING * trace);
        let [u, v, w, x, y, z] = solved(matrix, right)?;
        let (turn, shift) = (DVec3::new(u, v, w) / size, DVec3::new(x, y, z));
        // The rotation by Cayley's formula: that of the step to its second order, without sine and cosine.
        let rotation = DQuat::from_xyzw(turn.x / 2.0, turn.y / 2.0, turn.z / 2.0, 1.0).normalize();
        Some((Rigid::about(rotation, middle, middle + shift), turn.length() + shift.length() / size))
    }
}

/// Solves six equations by Cholesky's method; `None` where the matrix is not positive definite. For these alone a crate
/// of linear algebra would be compiled.
fn solved(mut matrix: [[f64; 6]; 6], mut x: [f64; 6]) -> Option<[f64; 6]> {
    for i in 0..6 {
        for j in 0..=i {
            let rest = matrix[i][j] - (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum::<f64>();
            matrix[i][j] = match i == j {
                true if rest > 0.0 => rest.sqrt(),
                true => return None,
                false => rest / matrix[j][j],
            };
        }
    }
    for i in 0..6 {
        x[i] = (x[i] - (0..i).map(|k| matrix[i][k] * x[k]).sum::<f64>()) / matrix[i][i];
    }
    for i in (0..6).rev() {
        x[i] = (x[i] - (i + 1..6).map(|k| matrix[k][i] * x[k]).sum::<f64>()) / matrix[i][i];
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::shapes::{icosphere, square};
    use lumen_mesh::task::at_once;

    fn aligned(mesh: &TriMesh, other: &TriMesh) -> Option<Aligned> {
        let index = SurfaceIndex::new(&other.positions, &other.triangles);
        at_once(align(mesh, other, &index, &Yielder::never()))
    }

    /// An ellipsoid of 30, 20 and 10 mm about a place, with a bump that tells its sides apart.
    fn lopsided(subdivisions: u32) -> TriMesh {
        let mut mesh = icosphere(subdivisions, 1.0, Vec3::ZERO);
        for p in &mut mesh.positions {
            let bump = 1.0 + 0.3 * (p.dot(Vec3::new(1.0, 2.0, 3.0).normalize()) - 0.7).max(0.0);
            *p = *p * bump * Vec3::new(30.0, 20.0, 10.0) + Vec3::new(5.0, -40.0, 200.0);
        }
        mesh
    }

    fn moved(mesh: &TriMesh, by: impl Fn(Vec3) -> Vec3) -> TriMesh {
        TriMesh { positions: mesh.positions.iter().map(|&p| by(p)).collect(), triangles: mesh.triangles.clone() }
    }

    #[test]
    fn a_known_motion_is_undone() {
        let here = lopsided(4);
        let rotation = glam::Quat::from_rotation_z(0.3) * glam::Quat::from_rotation_x(-0.2);
        for shift in [Vec3::new(2.0, -3.0, 4.0), Vec3::new(500.0, 80.0, -900.0)] {
            let there = moved(&here, |p| rotation * p + shift);
            let Aligned { motion, before_mm, residual_mm } = aligned(&there, &here).unwrap();
            assert!(residual_mm < 1e-3 && before_mm > 1.0, "{residual_mm} of {before_mm}");
            let off = here.positions.iter().zip(&there.positions).map(|(here, there)| here.distance(motion.of(*there)));
            assert!(off.fold(0.0, f32::max) < 5e-3);
            // The angle of the product of turns by 0.3 and 0.2 about axes at right angles.
            let angle = 2.0 * ((0.15f64.cos() * 0.1f64.cos()).acos()).to_degrees();
            assert!((motion.angle_deg() - angle).abs() < 0.01, "{}", motion.angle_deg());
        }
    }

    #[test]
    fn a_surface_in_the_axes_of_another_program_is_turned_back() {
        let lps = lopsided(4);
        let ras = moved(&lps, |p| Vec3::new(-p.x, -p.y, p.z));
        let Aligned { motion, residual_mm, .. } = aligned(&ras, &lps).unwrap();
        assert!(residual_mm < 1e-3 && (motion.angle_deg() - 180.0).abs() < 0.01, "{motion:?}");
    }

    #[test]
    fn of_two_ways_to_fit_the_shorter_is_taken() {
        // An ellipsoid in two triangulations fits itself turned by half a turn as well, but for what its facets make of it.
        let [coarse, fine] =
            [3, 4].map(|level| moved(&icosphere(level, 1.0, Vec3::ZERO), |p| p * Vec3::new(30.0, 20.0, 10.0)));
        for i in 0..8 {
            let turn = glam::Quat::from_rotation_z(0.05 * i as f32) * glam::Quat::from_rotation_x(0.03 * i as f32);
            let Aligned { motion, .. } = aligned(&moved(&coarse, |p| turn * p), &fine).unwrap();
            assert!(motion.angle_deg() < 45.0, "{i}: {}", motion.angle_deg());
        }
    }

    #[test]
    fn what_only_one_has_pulls_at_nothing() {
        // A fifth of the points are of a plate that the other surface does not have, 60 mm away.
        let here = lopsided(4);
        let mut there = moved(&here, |p| p + Vec3::new(1.0, 0.5, -0.5));
        let plate = square(4, 25.0, 0.0);
        let first = there.positions.len() as u32;
        there.positions.extend(plate.positions.iter().map(|&p| p + Vec3::new(60.0, -40.0, 200.0)));
        there.triangles.extend(plate.triangles.iter().map(|t| t.map(|v| v + first)));
        let Aligned { motion, .. } = aligned(&there, &here).unwrap();
        let off = motion.of(there.positions[0]).distance(here.positions[0]);
        assert!(off < 0.01, "{off}");
    }

    #[test]
    fn what_stands_where_it_should_stays_and_what_has_no_area_is_not_aligned() {
        let here = lopsided(3);
        let Aligned { motion, residual_mm, .. } = aligned(&here, &here).unwrap();
        assert!(motion.of(here.positions[7]).distance(here.positions[7]) < 1e-4 && residual_mm < 1e-4);
        assert_eq!(aligned(&here, &TriMesh { positions: vec![Vec3::ZERO; 3], triangles: vec![[0, 1, 2]] }), None);
    }
}
