//! The C-arm: from where the fluoroscopy is taken, when it pulses, and the contrast that is given.
//!
//! Angles are those of the detector: LAO to the patient's left, RAO to the right, CRAN to the head, CAUD to the feet.
//! The tube is opposite, 765 mm from the isocentre, as in common systems; the picture is looked at from the detector's
//! side. Where it is not known which way the patient lies, they are angles about the surface's own axes, and are called so.

use egui::{Pos2, Rect, vec2};
use glam::{Mat3, Quat};

use super::action::Arm;
use crate::io::Axes;
use crate::language::{Key, decimal};
use crate::mesh::{Bounds, Vec3};
use crate::render::Camera;
use crate::say;

/// From the tube to the isocentre, in mm.
const SOURCE: f32 = 765.0;
/// What can be seen at the isocentre, in mm.
const FIELD: [f32; 2] = [40.0, 480.0];
/// Seconds after which nothing is left of the contrast anywhere.
const GONE: f64 = 12.0;

/// The presets: name, name where the patient's sides are not known, LAO, CRAN, in degrees.
pub(super) const PRESETS: [(Key, &str, f32, f32); 4] = [
    (Key("trial-arm-ap"), "0°", 0.0, 0.0),
    (Key("trial-arm-lao-45"), "45°", 45.0, 0.0),
    (Key("trial-arm-lat"), "90°", 90.0, 0.0),
    (Key("trial-arm-rao-30"), "-30°", -30.0, 0.0),
];

/// The rates in pulses a second.
pub(super) const RATES: [f32; 2] = [7.5, 15.0];

/// A C-arm.
#[derive(Clone, Debug, PartialEq)]
pub struct CArm {
    /// Which way the patient lies in it.
    pub axes: Axes,
    /// To the patient's left, in degrees; negative is RAO.
    pub lao: f32,
    /// To the head, in degrees; negative is CAUD.
    pub cran: f32,
    /// Height of what is seen at the isocentre, in mm.
    pub field_mm: f32,
    /// The isocentre, in mm.
    pub isocentre: Vec3,
    /// Whether the pedal is down.
    pub is_on: bool,
    /// Pulses a second.
    pub rate: f32,
    /// Whether the lumen is shown over the picture.
    pub roadmap: bool,
    /// Whether its picture is the large one.
    pub is_large: bool,
    /// Seconds that the beam was on.
    pub seconds: f64,
    /// Pulses so far.
    pub pulses: u32,
    /// When contrast was given, by the window's clock.
    given: Option<f64>,
    /// When the last pulse was, by the same.
    last: f64,
    /// Until when beam was counted, in simulated seconds.
    counted: f64,
}

impl Default for CArm {
    fn default() -> Self {
        Self {
            axes: Axes::Unknown,
            lao: 0.0,
            cran: 0.0,
            field_mm: 200.0,
            isocentre: Vec3::ZERO,
            is_on: true,
            rate: RATES[1],
            roadmap: false,
            is_large: false,
            seconds: 0.0,
            pulses: 0,
            given: None,
            last: f64::NEG_INFINITY,
            counted: 0.0,
        }
    }
}

impl CArm {
    /// Looks at what lies between the ends of a way.
    pub(super) fn centre(&mut self, way: &Bounds) {
        if !way.is_empty() {
            self.isocentre = way.centre();
            self.field_mm = (way.diagonal() * 1.1).clamp(FIELD[0], FIELD[1]);
        }
    }

    /// Begins anew: no time, no contrast, the angles stay.
    pub(super) fn reset(&mut self) {
        (self.seconds, self.given, self.last, self.counted) = (0.0, None, f64::NEG_INFINITY, 0.0);
    }

    /// Does what is asked of it.
    pub(super) fn act(&mut self, what: Arm) {
        match what {
            Arm::Pedal => self.is_on = !self.is_on,
            Arm::Contrast(now) => self.give_contrast(now),
            Arm::Roadmap(on) => self.roadmap = on,
            Arm::Look(lao, cran) => (self.lao, self.cran) = (lao, cran),
            Arm::Rate(rate) => self.rate = rate,
            Arm::Enlarge => self.is_large = !self.is_large,
        }
    }

    /// Turns by a drag of so many degrees.
    pub(super) fn turn(&mut self, lao: f32, cran: f32) {
        self.lao = (self.lao + lao).clamp(-120.0, 120.0);
        self.cran = (self.cran + cran).clamp(-50.0, 50.0);
    }

    /// Magnifies.
    pub(super) fn zoom(&mut self, factor: f32) {
        self.field_mm = (self.field_mm / factor).clamp(FIELD[0], FIELD[1]);
    }

    /// Gives contrast now, and sees it: the pedal goes down.
    fn give_contrast(&mut self, now: f64) {
        self.given = Some(now);
        self.is_on = true;
    }

    /// Seconds since contrast was given, while there is any.
    pub(super) fn contrast_s(&self, now: f64) -> Option<f32> {
        let passed = now - self.given?;
        (passed < GONE).then_some(passed as f32)
    }

    /// Counts what has passed of the simulated time as beam, while the pedal is down.
    pub(super) fn count(&mut self, time_s: f64) {
        let passed = time_s - std::mem::replace(&mut self.counted, time_s);
        if self.is_on {
            // A step back gives no beam back.
            self.seconds += passed.max(0.0);
        }
    }

    /// Says whether a pulse is due at `now` by the window's clock, and counts it.
    pub(super) fn pulses_at(&mut self, now: f64) -> bool {
        let is_due = self.is_on && self.until_pulse(now) <= 0.02 / f64::from(self.rate);
        if is_due {
            self.last = now;
            self.pulses = self.pulses.wrapping_add(1);
        }
        is_due
    }

    /// The window's clock begins anew: a pulse is due, and contrast given by the old one is gone.
    pub(super) fn restart_clock(&mut self) {
        (self.given, self.last) = (None, f64::NEG_INFINITY);
    }

    /// Seconds until the next pulse.
    pub(super) fn until_pulse(&self, now: f64) -> f64 {
        (self.last + 1.0 / f64::from(self.rate) - now).max(0.0)
    }

    /// Where the detector is, from the isocentre.
    fn detector(&self) -> Vec3 {
        let (lao, cran) = (self.lao.to_radians(), self.cran.to_radians());
        let (across, up) = (libm::cosf(cran), libm::sinf(cran));
        // RAS is LPS after half a turn about the axis to the head.
        let across = if self.axes == Axes::Ras { -across } else { across };
        Vec3::new(libm::sinf(lao) * across, -libm::cosf(lao) * across, up)
    }

    /// The camera in the tube; its picture is mirrored when it is shown.
    pub(super) fn camera(&self, bounds: Bounds) -> Camera {
        let back = -self.detector();
        let up = Vec3::Z.reject_from_normalized(back).normalize();
        Camera {
            target: self.isocentre,
            rotation: Quat::from_mat3(&Mat3::from_cols(up.cross(back), up, back)),
            distance: SOURCE,
            fov_y: 2.0 * libm::atanf(self.field_mm / (2.0 * SOURCE)),
            bounds,
            ..Camera::default()
        }
    }

    /// The angles as they are read.
    pub(super) fn words(&self) -> String {
        if self.axes == Axes::Unknown {
            return say!("trial-arm-turned", turned = decimal(self.lao, 0), tilted = decimal(self.cran, 0));
        }
        let side = if self.lao < -0.5 { say!("trial-arm-rao") } else { say!("trial-arm-lao") };
        let tilt = if self.cran < -0.5 { say!("trial-arm-caud") } else { say!("trial-arm-cran") };
        let [turned, tilted] = [self.lao, self.cran].map(|angle| decimal(angle.abs(), 0));
        say!("trial-arm-angles", side = side, turned = turned, tilt = tilt, tilted = tilted)
    }
}

/// Where a point is on the screen in `rect`, where a picture of the tube's camera is shown; `None` behind the tube.
pub(super) fn place(camera: &Camera, rect: Rect, point: Vec3) -> Option<Pos2> {
    let at = camera.project(point, rect.width() / rect.height().max(1.0))?;
    // Whoever looks stands on the detector's side.
    Some(rect.center() - vec2(at.x * rect.width() / 2.0, at.y * rect.height() / 2.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where a point is in the picture as it is shown: to the right and up.
    fn shown(arm: &CArm, point: Vec3) -> (f32, f32) {
        let camera = arm.camera(Bounds::of(&[Vec3::splat(-100.0), Vec3::splat(100.0)]));
        let at = place(&camera, Rect::from_center_size(Pos2::ZERO, vec2(2.0, 2.0)), point).unwrap();
        (at.x, -at.y)
    }

    #[test]
    fn the_patient_s_left_is_on_the_right_of_the_picture_and_the_head_above() {
        for (axes, left) in [(Axes::Lps, 50.0), (Axes::Ras, -50.0)] {
            let arm = CArm { axes, ..CArm::default() };
            let (x, y) = shown(&arm, Vec3::new(left, 0.0, 20.0));
            assert!(x > 0.4 && y > 0.1, "{x} {y}");
            assert_eq!(arm.words(), "LAO 0°  CRAN 0°");
            // From the left, for whom the front is on the left.
            let arm = CArm { lao: 90.0, ..arm };
            assert!(shown(&arm, Vec3::new(0.0, -left, 0.0)).0 < -0.4);
        }
        assert_eq!(CArm::default().words(), "Turned 0°  tilted 0°", "no side is asserted that is not known");
    }

    #[test]
    fn from_the_left_side_the_front_is_on_the_left() {
        // LAT, LAO 90: the detector is at the patient's left; the front is to the left of whoever looks from there.
        let arm = CArm { lao: 90.0, ..CArm::default() };
        let (x, _) = shown(&arm, Vec3::new(0.0, -50.0, 0.0));
        assert!(x < -0.4, "{x}");
    }

    #[test]
    fn what_is_near_the_tube_is_larger() {
        let arm = CArm::default();
        let (near, far) = (shown(&arm, Vec3::new(50.0, 100.0, 0.0)).0, shown(&arm, Vec3::new(50.0, -100.0, 0.0)).0);
        let expected = (SOURCE + 100.0) / (SOURCE - 100.0);
        assert!((near / far - expected).abs() < 1e-3, "{near} {far}");
    }

    #[test]
    fn pulses_go_on_where_the_clock_begins_anew() {
        let mut arm = CArm::default();
        assert!(arm.pulses_at(500.0));
        arm.give_contrast(500.0);
        arm.restart_clock();
        assert!(arm.pulses_at(0.1) && arm.contrast_s(0.1).is_none());
    }

    #[test]
    fn pulses_come_at_their_rate_and_only_while_the_pedal_is_down() {
        let mut arm = CArm { rate: 7.5, ..CArm::default() };
        let count = (0..120).filter(|i| arm.pulses_at(f64::from(*i) / 60.0)).count();
        assert!((15..=16).contains(&count), "{count} in two seconds");
        let wait = arm.until_pulse(1.95);
        assert!(wait > 0.0 && !arm.pulses_at(1.95) && arm.pulses_at(1.95 + wait));
        arm.is_on = false;
        assert!(!arm.pulses_at(10.0));
    }

    #[test]
    fn beam_is_simulated_time_with_the_pedal_down() {
        let mut arm = CArm::default();
        arm.count(2.0);
        arm.is_on = false;
        arm.count(10.0);
        arm.is_on = true;
        arm.count(9.0);
        assert_eq!(arm.seconds, 2.0, "a step back");
        arm.count(10.0);
        assert_eq!(arm.seconds, 3.0);
    }
}
