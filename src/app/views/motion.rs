//! While the camera moves and frames come slowly, as without a graphics card, the views draw fewer triangles at half the
//! size, and still fewer at a third where that is slow too; once it rests, the level itself.

use crate::render::Camera;

/// A frame that takes longer than this is slow, in s.
const SLOW_S: f64 = 0.05;
/// And longer than so many times what the window expects.
const SLOW_FRAMES: f64 = 3.0;
/// The most triangles of a light picture and by what its size is divided; then those of the lightest.
const LIGHT: [(usize, u32); 2] = [(20_000, 2), (4_000, 3)];
/// So many slow frames in a row make a picture lighter.
const SLOW_IN_A_ROW: u32 = 2;
/// A camera that has stood still for so long rests, in s.
const REST_S: f64 = 0.25;

/// Whether the camera moves, and how slowly frames come while it does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<Of> {
    /// What is shown: of something else frames may take less.
    of: Option<Of>,
    camera: Camera,
    /// When the last frame was, and the last in which the camera had moved, in s.
    frame_s: f64,
    moved_s: f64,
    /// Slow frames in a row.
    slow: u32,
    /// How many of [`LIGHT`] were needed.
    steps: usize,
}

/// What a picture in motion is to be like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Light {
    /// The most triangles of a surface.
    pub(super) most: usize,
    /// By what width and height are divided.
    pub(super) part: u32,
    /// For how long, in s, if the camera does not move on.
    pub(super) left_s: f64,
}

impl<Of: PartialEq> Motion<Of> {
    /// Of a camera that rests.
    pub(super) fn new(camera: Camera) -> Self {
        Self { of: None, camera, frame_s: 0.0, moved_s: f64::NEG_INFINITY, slow: 0, steps: 0 }
    }

    /// Takes the camera of the frame at `now_s`, in s, the window expecting one every `expected_s`. Gives how light pictures
    /// should be; `None` where they should not.
    pub(super) fn follow(&mut self, of: Of, camera: Camera, now_s: f64, expected_s: f64) -> Option<Light> {
        if self.of.as_ref() != Some(&of) {
            (self.of, self.slow, self.steps) = (Some(of), 0, 0);
        }
        if camera != self.camera {
            let took_s = now_s - self.frame_s;
            let goes_on = self.moved_s == self.frame_s;
            if goes_on && self.steps < LIGHT.len() {
                let is_slow = took_s > SLOW_S.max(SLOW_FRAMES * expected_s);
                self.slow = if is_slow { self.slow + 1 } else { 0 };
                if self.slow == SLOW_IN_A_ROW {
                    (self.slow, self.steps) = (0, self.steps + 1);
                }
            }
            (self.camera, self.moved_s) = (camera, now_s);
        }
        self.frame_s = now_s;
        let left_s = self.moved_s + REST_S - now_s;
        let (most, part) = *LIGHT.get(self.steps.checked_sub(1)?)?;
        (left_s > 0.0).then_some(Light { most, part, left_s })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXPECTED_S: f64 = 1.0 / 60.0;

    /// Turns by a little.
    fn turned(camera: Camera) -> Camera {
        let mut turned = camera;
        turned.orbit(glam::Vec2::new(0.01, 0.0));
        turned
    }

    /// The most triangles, if pictures are light, after so many frames of a turn, each of them `took_s`.
    fn light_after(frames: usize, took_s: f64) -> (Motion<u32>, Camera, f64, Option<usize>) {
        let mut camera = Camera::default();
        let (mut motion, mut now_s, mut light) = (Motion::new(camera), 1.0, None);
        for _ in 0..frames {
            camera = turned(camera);
            light = motion.follow(0, camera, now_s, EXPECTED_S).map(|light| light.most);
            now_s += took_s;
        }
        (motion, camera, now_s, light)
    }

    #[test]
    fn slow_frames_of_a_turn_make_pictures_light_and_fast_ones_do_not() {
        for (frames, light) in
            [(2, None), (3, Some(LIGHT[0].0)), (4, Some(LIGHT[0].0)), (5, Some(LIGHT[1].0)), (50, Some(LIGHT[1].0))]
        {
            assert_eq!(light_after(frames, 0.2).3, light, "{frames}");
        }
        assert_eq!(light_after(100, 0.03).3, None);
        // The first step may do.
        let (mut motion, mut camera, mut now_s, _) = light_after(3, 0.2);
        for _ in 0..100 {
            (camera, now_s) = (turned(camera), now_s + 0.03);
            assert_eq!(motion.follow(0, camera, now_s, EXPECTED_S).map(|light| light.most), Some(LIGHT[0].0));
        }
    }

    #[test]
    fn a_camera_at_rest_has_the_whole_picture_again() {
        let (mut motion, camera, now_s, _) = light_after(5, 0.1);
        let left_s = motion.follow(0, camera, now_s, EXPECTED_S).unwrap().left_s;
        assert!((left_s - 0.15).abs() < 1e-9);
        assert_eq!(motion.follow(0, camera, now_s + left_s, EXPECTED_S), None);
        // It is known to be slow when it turns again.
        assert!(motion.follow(0, turned(camera), now_s + 5.0, EXPECTED_S).is_some());
    }

    #[test]
    fn a_pause_of_the_hand_is_no_slow_frame_and_another_level_is_tried_anew() {
        let mut camera = Camera::default();
        let mut motion = Motion::new(camera);
        for frame in 0..20 {
            camera = turned(camera);
            // Between two frames that move is one that does not.
            assert_eq!(motion.follow(0, camera, f64::from(frame), EXPECTED_S), None);
            assert_eq!(motion.follow(0, camera, f64::from(frame) + 0.5, EXPECTED_S), None);
        }
        let (mut motion, camera, now_s, light) = light_after(5, 0.1);
        assert!(light.is_some() && motion.follow(1, turned(camera), now_s, EXPECTED_S).is_none());
    }
}
