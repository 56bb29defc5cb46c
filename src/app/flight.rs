//! The way of the camera to a place: eased, along a straight line of the eye, and over as soon as anything else moves the
//! camera.
//!
//! Where it looks along another direction in the end, it turns there on the way, by the shortest arc.
//!
//! The distance changes by the same factor in equal parts of the way, and the target keeps step with it: all that is seen
//! grows about one fixed point, so that the place never leaves the view on the way. (The zooming path of van Wijk and Nuij,
//! "Smooth and efficient zooming and panning", 2003, draws back first instead: better across a map, longer here.)

use crate::render::Camera;

/// Seconds that a flight takes.
const LASTS_S: f32 = 0.6;
/// Of a frame that took longer no more is made up for.
const LONGEST_S: f32 = 0.1;

/// A way of the camera to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flight {
    from: Camera,
    to: Camera,
    /// The camera as it was left: where it is another, something else has moved it.
    left: Camera,
    passed_s: f32,
}

impl Flight {
    /// From a camera to another.
    pub(super) fn new(from: Camera, to: Camera) -> Self {
        Self { from, to, left: from, passed_s: 0.0 }
    }

    /// Where it ends.
    pub(super) fn to(&self) -> Camera {
        self.to
    }

    /// Moves `camera` on, by as far as it comes in `dt_s` seconds. Whether there is more of the way; it ends, too, where the
    /// camera is not where it was left.
    pub(super) fn advance(&mut self, camera: &mut Camera, dt_s: f32) -> bool {
        if *camera != self.left {
            return false;
        }
        self.passed_s += dt_s.clamp(0.0, LONGEST_S);
        let part = (self.passed_s / LASTS_S).min(1.0);
        *camera = self.at(part);
        self.left = *camera;
        part < 1.0
    }

    /// The camera at a part of the time, 0 to 1.
    fn at(&self, part: f32) -> Camera {
        if part >= 1.0 {
            return self.to;
        }
        // Slow at both ends.
        let part = part * part * (3.0 - 2.0 * part);
        // The logarithm of how many times nearer it comes.
        let nearer = libm::logf(self.from.distance / self.to.distance);
        let gone = if nearer.abs() < 1e-4 { part } else { libm::expm1f(-nearer * part) / libm::expm1f(-nearer) };
        let (from, to) = (self.from.rotation, self.to.rotation);
        Camera {
            rotation: if from == to { from } else { from.slerp(to, part) },
            target: self.from.target.lerp(self.to.target, gone),
            distance: self.from.distance * libm::expf(-nearer * part),
            ..self.from
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use super::*;
    use crate::mesh::Bounds;

    fn whole() -> Camera {
        let mut camera = Camera::default();
        camera.fit(&Bounds { min: [-80.0, -40.0, -200.0], max: [80.0, 40.0, 200.0] }, 1.0);
        camera.orbit(Vec2::new(0.2, 0.1));
        camera
    }

    fn near(at: Vec3, height_mm: f32) -> Camera {
        let mut camera = whole();
        camera.focus(at, height_mm);
        camera
    }

    #[test]
    fn it_begins_where_the_camera_was_and_ends_at_the_place_after_six_tenths_of_a_second() {
        let to = near(Vec3::new(30.0, -10.0, 150.0), 20.0);
        let mut camera = whole();
        let mut flight = Flight::new(camera, to);
        assert!(flight.advance(&mut camera, 0.0));
        assert_eq!(camera, whole());
        for _ in 0..35 {
            assert!(flight.advance(&mut camera, 1.0 / 60.0));
        }
        assert_ne!(camera, to);
        flight.advance(&mut camera, 1.0 / 60.0);
        assert!(!flight.advance(&mut camera, 1.0 / 60.0));
        assert_eq!(camera, to);
    }

    #[test]
    fn to_another_side_it_turns_steadily_and_by_the_shortest_arc() {
        let mut to = near(Vec3::new(30.0, -10.0, 150.0), 20.0);
        to.face(Vec3::new(1.0, 0.2, 0.0));
        let flight = Flight::new(whole(), to);
        let turned: Vec<f32> =
            (0..=100).map(|i| flight.at(i as f32 / 100.0).rotation.angle_between(whole().rotation)).collect();
        assert!(turned.windows(2).all(|pair| pair[1] >= pair[0] - 1e-3), "{turned:?}");
        assert!(turned[0] < 0.01 && flight.at(1.0) == to);
        // Half of the way at half of the time; never more than half a turn.
        assert!((turned[50] - turned[100] / 2.0).abs() < 0.01 && turned[100] <= std::f32::consts::PI + 1e-3);
    }

    #[test]
    fn there_and_back_it_comes_steadily_nearer_and_the_place_never_goes_farther_from_the_middle() {
        let (out, place) = (whole(), Vec3::new(30.0, -10.0, 150.0));
        // Straight at it, from far and from beside.
        for height_mm in [20.0, 400.0, 5.0] {
            let to = near(place, height_mm);
            for (from, to, sign) in [(out, to, 1.0), (to, out, -1.0)] {
                let flight = Flight::new(from, to);
                let way: Vec<Camera> = (0..=100).map(|i| flight.at(i as f32 / 100.0)).collect();
                let off = |camera: &Camera| camera.project(place, 1.0).expect("in front of the eye").length();
                let nearer = (from.distance - to.distance).signum();
                for (i, pair) in way.windows(2).enumerate() {
                    assert!(nearer * (pair[0].distance - pair[1].distance) >= -1e-3, "distance at {i}");
                    assert!(sign * (off(&pair[0]) - off(&pair[1])) >= -1e-3, "place at {i}, {height_mm} mm");
                    assert_eq!(pair[0].rotation, from.rotation, "the side that is looked at");
                }
                // All about one fixed point: the eye goes along a straight line.
                let line = to.eye() - from.eye();
                for camera in &way {
                    let aside = (camera.eye() - from.eye()).cross(line).length() / line.length();
                    assert!(aside < 1e-3 * line.length(), "{aside} of {}", line.length());
                }
            }
        }
    }

    #[test]
    fn it_is_slow_at_both_ends() {
        let flight = Flight::new(whole(), near(Vec3::new(30.0, -10.0, 150.0), 20.0));
        let ratio = |a: f32, b: f32| libm::logf(flight.at(a).distance / flight.at(b).distance);
        assert!(ratio(0.0, 0.1) < 0.3 * ratio(0.45, 0.55) && ratio(0.9, 1.0) < 0.3 * ratio(0.45, 0.55));
    }

    #[test]
    fn a_hand_on_the_camera_ends_it_at_once() {
        let mut camera = whole();
        let mut flight = Flight::new(camera, near(Vec3::new(30.0, -10.0, 150.0), 20.0));
        assert!(flight.advance(&mut camera, 0.1) && flight.advance(&mut camera, 0.1));
        camera.orbit(Vec2::new(0.01, 0.0));
        let held = camera;
        assert!(!flight.advance(&mut camera, 0.1));
        assert_eq!(camera, held, "where the hand has it");
    }

    #[test]
    fn a_long_frame_is_not_made_up_for() {
        let mut camera = whole();
        let mut flight = Flight::new(camera, near(Vec3::ZERO, 20.0));
        for _ in 0..5 {
            assert!(flight.advance(&mut camera, 3.0));
        }
    }
}
