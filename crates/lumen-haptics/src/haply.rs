//! Haply's Inverse3, an arm that is held like a pen: its maker's service has it, on the same computer, and speaks JSON over a
//! WebSocket. Here that service is a device like others: what it tells becomes input reports, and reports of forces become
//! what it is told. Names and units are those of the services 3.1 to 3.5, as the crate `haply` (0.8 and 1.3) and IsaacLab's
//! client write and read them. (The crate itself brings an asynchronous runtime and an HTTP client for these few lines.)
//!
//! The service tells once after each time that it is told something, so it is told the force each time that it has told. What
//! is not told anew for [`WATCHDOG_MS`] is no force any more; without any word the arm goes idle by itself (Haply's
//! documentation of service 3.5).

use std::f64::consts::{PI, TAU};

use glam::DQuat;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::port::InputReport;
use super::usage::Usage;

/// Where the service listens: on this computer alone.
pub const ADDRESS: &str = "127.0.0.1:10001";

/// Reports: what the hand does, and the force, three numbers of 16 bits.
pub mod id {
    /// Input: buttons, X, Y, Z, Rx, Ry, Rz.
    pub const STATE: u8 = 1;
    /// Output: the force along X, Y and Z.
    pub const FORCE: u8 = 2;
}

/// Half of the way of X, Y and Z, in mm, and of Rx, Ry and Rz, in radians: what the numbers 32767 stand for.
pub const HALF_WAY: [f64; 2] = [200.0, PI];

/// What a force of 32767 is, in N, of which no more than the cap ([`safety`](super::safety)) is asked for.
pub const MAX_N: f64 = 5.0;

/// ms after which a force that was not told again is none.
pub const WATCHDOG_MS: f64 = 100.0;

/// What the force report is in.
pub const FORCES: Usage = Usage::new(0xFF4C, 1);

/// The greatest number of a report.
const FULL: f64 = 32767.0;

/// What its reports would be if it were plugged in.
#[rustfmt::skip]
pub const DESCRIPTOR: &[u8] = &[
    0x05, 0x01,                    // Usage page: generic desktop
    0x09, 0x04,                    // Usage: joystick
    0xA1, 0x01,                    // Collection: application
    0x85, id::STATE,               //   Report 1: 13 bytes in
    0x05, 0x09,                    //   Usage page: button
    0x19, 0x01, 0x29, 0x03,        //   Buttons 1 (clutch) to 3: those of the grip
    0x15, 0x00, 0x25, 0x01,        //   0 to 1
    0x75, 0x01, 0x95, 0x03,        //   3 x 1 bit
    0x81, 0x02,                    //   Input: variable
    0x75, 0x05, 0x95, 0x01,        //   5 bits
    0x81, 0x03,                    //   Input: padding
    0x05, 0x01,                    //   Usage page: generic desktop
    0x19, 0x30, 0x29, 0x35,        //   X, Y, Z, Rx, Ry, Rz
    0x16, 0x01, 0x80, 0x26, 0xFF, 0x7F, // -32767 to 32767
    0x75, 0x10, 0x95, 0x06,        //   6 x 16 bits
    0x81, 0x02,                    //   Input: variable
    0x06, 0x4C, 0xFF,              //   Usage page: Lumen's own
    0x09, 0x01,                    //   Usage: forces
    0xA1, 0x02,                    //   Collection: logical
    0x85, id::FORCE,               //     Report 2: 6 bytes out
    0x19, 0x02, 0x29, 0x04,        //     Along X, Y and Z
    0x75, 0x10, 0x95, 0x03,        //     3 x 16 bits
    0x91, 0x02,                    //     Output: variable
    0xC0,
    0xC0,
];

/// Bytes of the force report.
pub const FORCE_BYTES: usize = 6;

/// Three lengths or forces along the arm's own axes, in m and N.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Vector {
    x: f64,
    y: f64,
    z: f64,
}

/// A turn, by its parts' names.
#[derive(Clone, Copy, Debug, Deserialize)]
struct Quaternion {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

/// The buttons of a grip without a cable.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
struct Buttons {
    a: bool,
    b: bool,
    c: bool,
}

/// What stands at a place of a message, where it is of that kind.
fn part<T: DeserializeOwned>(value: &Value, path: [&str; 2]) -> Option<T> {
    T::deserialize(value.get(path[0])?.get(path[1])?).ok()
}

/// What the service is told.
#[derive(Debug, Serialize)]
struct Telling<'a> {
    inverse3: [Command<'a>; 1],
}

#[derive(Debug, Serialize)]
struct Command<'a> {
    device_id: &'a str,
    commands: Commands,
}

#[derive(Debug, Serialize)]
struct Commands {
    set_cursor_force: Force,
}

/// The force by the name that it has in services 3.5, and by that before.
#[derive(Debug, Serialize)]
struct Force {
    vector: Vector,
    values: Vector,
}

/// Both ways between messages and reports, of one arm and its grip.
#[derive(Debug, Default)]
pub struct Translator {
    arm: Option<String>,
    force: Vector,
    told_ms: f64,
    /// How the grip stood when it was first heard, and how far it has turned about X, Y and Z since, in radians.
    turned: Option<(DQuat, [f64; 3])>,
}

impl Translator {
    /// The report that a message comes down to; `None` where it says nothing of an arm. The first arm is taken, and stays.
    pub fn hear(&mut self, message: &str) -> Option<InputReport> {
        let told: Value = serde_json::from_str(message).ok()?;
        let listed = |key: &str| told.get(key).and_then(Value::as_array).into_iter().flatten();
        let (id, at) = listed("inverse3").find_map(|arm| {
            let id = arm.get("device_id")?.as_str()?;
            let at: Vector = part(arm, ["state", "cursor_position"])?;
            let is_ours = self.arm.as_ref().is_none_or(|taken| taken == id);
            (is_ours && [at.x, at.y, at.z].iter().all(|metres| metres.is_finite())).then_some((id, at))
        })?;
        self.arm.get_or_insert_with(|| id.to_owned());
        let mut grips = listed("verse_grip").chain(listed("wireless_verse_grip"));
        let mut pressed = 0;
        if let Some((grip, orientation)) =
            grips.find_map(|grip| Some((grip, part::<Quaternion>(grip, ["state", "orientation"])?)))
        {
            self.turn(orientation);
            let Buttons { a, b, c } = part(grip, ["state", "buttons"]).unwrap_or_default();
            // One with a cable has a single one.
            let only = part(grip, ["state", "button"]).unwrap_or(false);
            pressed = u8::from(a || only) | u8::from(b) << 1 | u8::from(c) << 2;
        }
        let places = [at.x, at.y, at.z].map(|metres| metres * 1000.0 / HALF_WAY[0]);
        let turns = self.turned.map_or([0.0; 3], |(_, since)| since.map(|angle| angle / HALF_WAY[1]));
        let numbers = places.into_iter().chain(turns).flat_map(|part| number(part).to_le_bytes());
        Some(InputReport { id: id::STATE, data: std::iter::once(pressed).chain(numbers).collect() })
    }

    /// The angle about each axis from where the grip stood first, by the nearer way from where it was.
    fn turn(&mut self, Quaternion { w, x, y, z }: Quaternion) {
        let orientation = DQuat::from_xyzw(x, y, z, w);
        let (first, since) = self.turned.get_or_insert((orientation, [0.0; 3]));
        let DQuat { x, y, z, w } = orientation * first.conjugate();
        for (since, along) in since.iter_mut().zip([x, y, z]) {
            let angle = 2.0 * libm::atan2(along, w);
            if angle.is_finite() {
                *since += (angle - *since + PI).rem_euclid(TAU) - PI;
            }
        }
    }

    /// Takes a force report at `now_ms`; whether it was one.
    pub fn feel(&mut self, now_ms: f64, id: u8, data: &[u8]) -> bool {
        let (id::FORCE, &[x0, x1, y0, y1, z0, z1]) = (id, data) else { return false };
        let newtons = |bytes| f64::from(i16::from_le_bytes(bytes)) / FULL * MAX_N;
        self.force = Vector { x: newtons([x0, x1]), y: newtons([y0, y1]), z: newtons([z0, z1]) };
        self.told_ms = now_ms;
        true
    }

    /// What the service is told at `now_ms`; `None` before an arm is known.
    pub fn say(&self, now_ms: f64) -> Option<String> {
        let is_fresh = now_ms - self.told_ms < WATCHDOG_MS;
        self.told(if is_fresh { self.force } else { Vector::default() })
    }

    /// The last that it is told.
    pub fn farewell(&self) -> Option<String> {
        self.told(Vector::default())
    }

    fn told(&self, force: Vector) -> Option<String> {
        let commands = Commands { set_cursor_force: Force { vector: force, values: force } };
        let telling = Telling { inverse3: [Command { device_id: self.arm.as_ref()?, commands }] };
        serde_json::to_string(&telling).ok()
    }
}

/// -1 to 1 as a number of a report.
pub(super) fn number(part: f64) -> i16 {
    if part.is_nan() { 0 } else { (part.clamp(-1.0, 1.0) * FULL).round() as i16 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::HapticDevice;
    use crate::identity::Identity;

    fn told(x: f64, angle: f64, a: bool) -> String {
        let (w, along) = ((0.5 * angle).cos(), (0.5 * angle).sin());
        format!(
            r#"{{"session_id": 3, "inverse3": [{{"device_id": "049D", "config": {{"handedness": "right"}},
                "state": {{"cursor_position": {{"x": {x}, "y": -0.1, "z": 0.2}}, "mode": "idle"}}}}],
               "wireless_verse_grip": [{{"device_id": "61548", "state": {{"battery_level": 0.9,
                "orientation": {{"w": {w}, "x": 0, "y": 0, "z": {along}}},
                "buttons": {{"a": {a}, "b": false, "c": true}}}}}}]}}"#
        )
    }

    #[test]
    fn an_arm_s_place_is_fed_and_its_grip_s_turn_rolled_one_to_one() {
        let mut device = HapticDevice::from_descriptor(Identity::default(), DESCRIPTOR).unwrap();
        assert!(device.has_force());
        let mut mapping = *device.mapping();
        // About Z.
        mapping.roll.as_mut().unwrap().axis = 5;
        device.set_mapping(mapping);
        let mut translator = Translator::default();
        let mut feed = |now: f64, x: f64, angle: f64, a: bool| {
            let report = translator.hear(&told(x, angle, a)).unwrap();
            device.input(now, report.id, &report.data);
            device.advance(0.001)
        };
        assert_eq!(feed(0.0, 0.0, 3.0, false), [0.0; 2], "from where it is");
        // 30 mm, and past the half turn, where the quaternion begins anew.
        let [fed, rolled] = feed(1.0, 0.030, -3.0, false);
        assert!((fed - 30.0).abs() < 0.02, "{fed}");
        assert!((rolled - (TAU - 6.0)).abs() < 1e-3, "{rolled}");
        assert_eq!(feed(2.0, 0.0, -3.0, true)[0], 0.0, "the hand goes back");
        assert!((feed(3.0, 0.010, -3.0, false)[0] - 10.0).abs() < 0.02);
    }

    #[test]
    fn a_force_is_told_in_newtons_to_the_arm_that_was_heard_and_not_for_long() {
        let mut translator = Translator::default();
        assert_eq!(translator.say(0.0), None, "there is no arm yet");
        translator.hear(&told(0.0, 0.0, false)).unwrap();
        let data: Vec<u8> = [0, -32767, 13107_i16].into_iter().flat_map(i16::to_le_bytes).collect();
        assert!(translator.feel(10.0, id::FORCE, &data) && !translator.feel(10.0, id::STATE, &data));
        let force = |text: String| {
            let told: serde_json::Value = serde_json::from_str(&text).unwrap();
            let arm = &told["inverse3"][0];
            assert_eq!(arm["device_id"], "049D");
            let force = &arm["commands"]["set_cursor_force"];
            assert_eq!(force["vector"], force["values"]);
            ["x", "y", "z"].map(|axis| force["vector"][axis].as_f64().unwrap())
        };
        let [x, y, z] = force(translator.say(50.0).unwrap());
        assert_eq!([x, y], [0.0, -MAX_N]);
        assert!((z - 0.4 * MAX_N).abs() < 1e-3);
        assert_eq!(force(translator.say(110.0).unwrap()), [0.0; 3], "it was not told again");
        assert_eq!(force(translator.farewell().unwrap()), [0.0; 3]);
    }

    #[test]
    fn what_is_no_arm_moves_nothing() {
        let mut translator = Translator::default();
        for message in ["{}", r#"{"inverse3": []}"#, r#"{"inverse3": [{"device_id": "1"}], "other": 3}"#] {
            assert_eq!(translator.hear(message), None, "{message}");
        }
        assert_eq!(translator.hear("no JSON"), None);
        assert_eq!(translator.hear(r#"{"inverse3": [{"device_id": "049D", "state": null}]}"#), None);
        translator.hear(&told(0.0, 0.0, false)).unwrap();
        let another = told(0.1, 0.0, false).replace("049D", "0B0B");
        assert_eq!(translator.hear(&another), None, "the first arm stays");
        // A grip that says nothing does not take the arm away.
        let silent = told(0.1, 0.0, false).replace("\"orientation\"", "\"other\"").replace("\"buttons\"", "\"rest\"");
        assert!(translator.hear(&silent).is_some());
    }

    #[test]
    fn a_grip_with_a_cable_has_one_button_and_turns_from_wherever_it_stood() {
        let told = |w: f64, x: f64, y: f64, z: f64, button: bool| {
            format!(
                r#"{{"inverse3": [{{"device_id": "1", "state": {{"cursor_position": {{"x": 0, "y": 0, "z": 0}}}}}}],
                   "verse_grip": [{{"device_id": "2", "state": {{"button": {button}, "hall": 3,
                    "orientation": {{"w": {w}, "x": {x}, "y": {y}, "z": {z}}}}}}}]}}"#
            )
        };
        let mut translator = Translator::default();
        // Half a turn about X, where the angle about Z of the whole is anything.
        let first = translator.hear(&told(0.0, 1.0, 0.0, 0.0, false)).unwrap();
        assert_eq!(first.data, [0; 13]);
        // A quarter turn about Z more: (cos 45, 0, 0, sin 45) times that.
        let half = 0.5_f64.sqrt();
        let turned = translator.hear(&told(0.0, half, half, 0.0, true)).unwrap();
        let numbers: Vec<i16> = turned.data[1..].chunks(2).map(|two| i16::from_le_bytes([two[0], two[1]])).collect();
        assert_eq!((turned.data[0], &numbers[3..5]), (1, &[0, 0][..]));
        assert!((numbers[5] - 16383).abs() <= 1, "{numbers:?}");
    }
}
