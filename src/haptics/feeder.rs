//! The open feeder: a device with two axes, one that is pushed and one that is turned, each with a motor. This descriptor is
//! what its firmware sends, what the virtual device speaks, and what the browser's tests mimic (`docs/haptics.md`).
//!
//! It is a joystick that is a physical interface device, so that other programs drive it too: X is the feed, from -50 to 50
//! mm, Rx the roll about it, from a turn left to a turn right; a spring, a damper and a constant force on each.

/// Report ids.
pub mod id {
    /// Input: buttons, feed, roll. Output: what an effect is.
    pub const STATE: u8 = 1;
    /// Input: what the device plays. Output: a condition.
    pub const PLAYING: u8 = 2;
    /// Output: what an effect is.
    pub const EFFECT: u8 = 1;
    /// Output: a spring's or damper's parameters along an axis.
    pub const CONDITION: u8 = 2;
    /// Output: a constant force.
    pub const CONSTANT: u8 = 3;
    /// Output: start, start alone, stop.
    pub const OPERATION: u8 = 4;
    /// Output: an effect is given back.
    pub const FREE: u8 = 5;
    /// Output: a command to the whole device, by its number.
    pub const CONTROL: u8 = 6;
    /// Output: the gain of all.
    pub const GAIN: u8 = 7;
    /// Feature: a new effect is asked for.
    pub const CREATE: u8 = 0x11;
    /// Feature: what became of it.
    pub const LOAD: u8 = 0x12;
    /// Feature: what room there is.
    pub const POOL: u8 = 0x13;
}

/// Half of the feed's way, in mm, and of the roll's, in radians: what the numbers 32767 stand for.
pub const HALF_WAY: [f64; 2] = [50.0, 2.0 * std::f64::consts::PI];

/// Effects that it plays at a time.
pub const EFFECTS: u8 = 4;

/// ms without an output report after which its motors are let go, whatever plays.
pub const WATCHDOG_MS: u32 = 100;

/// The report descriptor.
#[rustfmt::skip]
pub const DESCRIPTOR: &[u8] = &[
    0x05, 0x01,                    // Usage page: generic desktop
    0x09, 0x04,                    // Usage: joystick
    0xA1, 0x01,                    // Collection: application
    0x85, 0x01,                    //   Report 1: 5 bytes in
    0x05, 0x09,                    //   Usage page: button
    0x19, 0x01, 0x29, 0x02,        //   Buttons 1 (clutch) and 2
    0x15, 0x00, 0x25, 0x01,        //   0 to 1
    0x75, 0x01, 0x95, 0x02,        //   2 x 1 bit
    0x81, 0x02,                    //   Input: variable
    0x75, 0x06, 0x95, 0x01,        //   6 bits
    0x81, 0x03,                    //   Input: padding
    0x05, 0x01,                    //   Usage page: generic desktop
    0x09, 0x30,                    //   Usage: X, the feed
    0x16, 0x01, 0x80, 0x26, 0xFF, 0x7F, // -32767 to 32767
    0x35, 0xCE, 0x45, 0x32,        //   means -50 to 50
    0x65, 0x11, 0x55, 0x0F,        //   of 10^-1 cm
    0x75, 0x10, 0x95, 0x01,        //   16 bits
    0x81, 0x02,                    //   Input: variable
    0x09, 0x33,                    //   Usage: Rx, the roll
    0x36, 0x8C, 0xFD, 0x46, 0x74, 0x02, // means -628 to 628
    0x65, 0x12, 0x55, 0x0E,        //   of 10^-2 radians
    0x81, 0x02,                    //   Input: variable
    0x65, 0x00, 0x55, 0x00,        //   No unit
    0x35, 0x00, 0x45, 0x00,        //   Physical as logical

    0x05, 0x0F,                    //   Usage page: physical interface
    0x09, 0x92,                    //   Usage: state report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x02,                    //     Report 2: 1 byte in
    0x09, 0x9F, 0x09, 0xA0, 0x09, 0xA4, 0x09, 0xA6, 0x09, 0x94, // Paused, actuators on, safety switch, power, playing
    0x15, 0x00, 0x25, 0x01,        //     0 to 1
    0x75, 0x01, 0x95, 0x05,        //     5 x 1 bit
    0x81, 0x02,                    //     Input: variable
    0x75, 0x03, 0x95, 0x01, 0x81, 0x03, // Padding
    0xC0,

    0x09, 0x21,                    //   Usage: set effect report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x01,                    //     Report 1: 9 bytes out
    0x09, 0x22,                    //     Usage: effect block index
    0x15, 0x01, 0x25, 0x04,        //     1 to 4
    0x75, 0x08, 0x95, 0x01,        //     8 bits
    0x91, 0x02,                    //     Output: variable
    0x09, 0x25,                    //     Usage: effect type
    0xA1, 0x02,                    //     Collection: logical
    0x09, 0x26, 0x09, 0x40, 0x09, 0x41, //  Constant force 1, spring 2, damper 3
    0x15, 0x01, 0x25, 0x03,        //       1 to 3
    0x91, 0x00,                    //       Output: array
    0xC0,
    0x09, 0x50,                    //     Usage: duration
    0x15, 0x00, 0x27, 0xFF, 0xFF, 0x00, 0x00, // 0 to 65535
    0x66, 0x01, 0x10, 0x55, 0x0D,  //     of 10^-3 s
    0x75, 0x10,                    //     16 bits
    0x91, 0x02,                    //     Output: variable
    0x65, 0x00, 0x55, 0x00,        //     No unit
    0x09, 0x52,                    //     Usage: gain
    0x15, 0x00, 0x26, 0xFF, 0x00,  //     0 to 255
    0x75, 0x08,                    //     8 bits
    0x91, 0x02,                    //     Output: variable
    0x09, 0x53,                    //     Usage: trigger button
    0x15, 0x01, 0x25, 0x02,        //     1 to 2
    0x91, 0x42,                    //     Output: variable, with null
    0x09, 0x55,                    //     Usage: axes enable
    0xA1, 0x02,                    //     Collection: logical
    0x05, 0x01, 0x09, 0x30, 0x09, 0x33, //  X, Rx
    0x15, 0x00, 0x25, 0x01,        //       0 to 1
    0x75, 0x01, 0x95, 0x02,        //       2 x 1 bit
    0x91, 0x02,                    //       Output: variable
    0xC0,
    0x05, 0x0F, 0x09, 0x56,        //     Usage: direction enable
    0x95, 0x01, 0x91, 0x02,        //     1 bit
    0x75, 0x05, 0x91, 0x03,        //     Padding
    0x09, 0x57,                    //     Usage: direction
    0xA1, 0x02,                    //     Collection: logical
    0x0B, 0x01, 0x00, 0x0A, 0x00,  //       Ordinal 1
    0x0B, 0x02, 0x00, 0x0A, 0x00,  //       Ordinal 2
    0x15, 0x00, 0x26, 0xFF, 0x00,  //       0 to 255
    0x46, 0x68, 0x01, 0x65, 0x14,  //       means 0 to 360 degrees
    0x75, 0x08, 0x95, 0x02,        //       2 x 8 bits
    0x91, 0x02,                    //       Output: variable
    0x45, 0x00, 0x65, 0x00,        //       No unit
    0xC0,
    0xC0,

    0x05, 0x0F, 0x09, 0x5F,        //   Usage: set condition report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x02,                    //     Report 2: 14 bytes out
    0x09, 0x22, 0x15, 0x01, 0x25, 0x04, // Effect block index, 1 to 4
    0x75, 0x08, 0x95, 0x01, 0x91, 0x02, // 8 bits
    0x09, 0x23, 0x15, 0x00, 0x25, 0x01, // Parameter block offset, 0 (feed) to 1 (roll)
    0x75, 0x04, 0x91, 0x02,        //     4 bits
    0x91, 0x03,                    //     Padding
    0x09, 0x60,                    //     Usage: CP offset
    0x09, 0x61, 0x09, 0x62,        //     Positive, negative coefficient
    0x16, 0x01, 0x80, 0x26, 0xFF, 0x7F, // -32767 to 32767
    0x75, 0x10, 0x95, 0x03, 0x91, 0x02, // 3 x 16 bits
    0x09, 0x63, 0x09, 0x64, 0x09, 0x65, // Positive, negative saturation, dead band
    0x15, 0x00, 0x26, 0xFF, 0x7F,  //     0 to 32767
    0x91, 0x02,                    //     3 x 16 bits
    0xC0,

    0x09, 0x73,                    //   Usage: set constant force report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x03,                    //     Report 3: 3 bytes out
    0x09, 0x22, 0x15, 0x01, 0x25, 0x04, // Effect block index, 1 to 4
    0x75, 0x08, 0x95, 0x01, 0x91, 0x02, // 8 bits
    0x09, 0x70, 0x16, 0x01, 0x80, 0x26, 0xFF, 0x7F, // Magnitude, -32767 to 32767
    0x75, 0x10, 0x91, 0x02,        //     16 bits
    0xC0,

    0x09, 0x77,                    //   Usage: effect operation report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x04,                    //     Report 4: 3 bytes out
    0x09, 0x22, 0x15, 0x01, 0x25, 0x04, // Effect block index, 1 to 4
    0x75, 0x08, 0x91, 0x02,        //     8 bits
    0x09, 0x78,                    //     Usage: effect operation
    0xA1, 0x02,                    //     Collection: logical
    0x09, 0x79, 0x09, 0x7A, 0x09, 0x7B, //  Start 1, start alone 2, stop 3
    0x15, 0x01, 0x25, 0x03, 0x91, 0x00, //  8 bits, array
    0xC0,
    0x09, 0x7C, 0x15, 0x00, 0x26, 0xFF, 0x00, // Loop count, 0 to 255
    0x91, 0x02,                    //     8 bits
    0xC0,

    0x09, 0x90,                    //   Usage: block free report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x05,                    //     Report 5: 1 byte out
    0x09, 0x22, 0x15, 0x01, 0x25, 0x04, 0x91, 0x02, // Effect block index, 1 to 4
    0xC0,

    0x09, 0x96,                    //   Usage: device control
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x06,                    //     Report 6: 1 byte out
    0x09, 0x97, 0x09, 0x98, 0x09, 0x99, 0x09, 0x9A, 0x09, 0x9B, 0x09, 0x9C, // On 1, off 2, stop 3, reset 4, pause 5, go on 6
    0x15, 0x01, 0x25, 0x06, 0x91, 0x00, // 8 bits, array
    0xC0,

    0x09, 0x7D,                    //   Usage: device gain report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x07,                    //     Report 7: 1 byte out
    0x09, 0x7E, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x91, 0x02, // Device gain, 0 to 255
    0xC0,

    0x09, 0xAB,                    //   Usage: create new effect report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x11,                    //     Report 0x11: feature, 3 bytes
    0x09, 0x25,                    //     Usage: effect type
    0xA1, 0x02,                    //     Collection: logical
    0x09, 0x26, 0x09, 0x40, 0x09, 0x41, //  Constant force 1, spring 2, damper 3
    0x15, 0x01, 0x25, 0x03, 0xB1, 0x00, //  8 bits, array
    0xC0,
    0x05, 0x01, 0x09, 0x3B, 0x15, 0x00, 0x26, 0xFF, 0x01, // Byte count, 0 to 511
    0x75, 0x10, 0xB1, 0x02,        //     16 bits
    0xC0,

    0x05, 0x0F, 0x09, 0x89,        //   Usage: block load report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x12,                    //     Report 0x12: feature, 4 bytes
    0x09, 0x22, 0x15, 0x00, 0x25, 0x04, // Effect block index, 0 for none
    0x75, 0x08, 0xB1, 0x02,        //     8 bits
    0x09, 0x8B,                    //     Usage: block load status
    0xA1, 0x02,                    //     Collection: logical
    0x09, 0x8C, 0x09, 0x8D, 0x09, 0x8E, //  Success 1, full 2, error 3
    0x15, 0x01, 0x25, 0x03, 0xB1, 0x00, //  8 bits, array
    0xC0,
    0x09, 0xAC, 0x15, 0x00, 0x27, 0xFF, 0xFF, 0x00, 0x00, // RAM pool available, 0 to 65535
    0x75, 0x10, 0xB1, 0x02,        //     16 bits
    0xC0,

    0x09, 0x7F,                    //   Usage: pool report
    0xA1, 0x02,                    //   Collection: logical
    0x85, 0x13,                    //     Report 0x13: feature, 4 bytes
    0x09, 0x80, 0x15, 0x00, 0x27, 0xFF, 0xFF, 0x00, 0x00, // RAM pool size, 0 to 65535
    0x75, 0x10, 0xB1, 0x02,        //     16 bits
    0x09, 0x83, 0x26, 0xFF, 0x00,  //     Simultaneous effects, 0 to 255
    0x75, 0x08, 0xB1, 0x02,        //     8 bits
    0x09, 0xA9, 0x09, 0xAA, 0x25, 0x01, // Device managed pool, shared parameter blocks
    0x75, 0x01, 0x95, 0x02, 0xB1, 0x02, // 2 x 1 bit
    0x75, 0x06, 0x95, 0x01, 0xB1, 0x03, // Padding
    0xC0,
    0xC0,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haptics::descriptor::parse;
    use crate::haptics::fixtures::{chromium, peer};
    use crate::haptics::model::{Kind, Report};
    use crate::haptics::usage::desktop;
    use crate::haptics::webhid;

    #[test]
    fn it_says_what_the_firmware_sends_and_takes() {
        let model = parse(DESCRIPTOR).unwrap();
        let bytes = |kind, id| model.report(kind, id).map_or(0, Report::bytes);
        assert_eq!([1, 2].map(|id| bytes(Kind::Input, id)), [5, 1]);
        assert_eq!([1, 2, 3, 4, 5, 6, 7].map(|id| bytes(Kind::Output, id)), [9, 14, 3, 3, 1, 1, 1]);
        assert_eq!([0x11, 0x12, 0x13].map(|id| bytes(Kind::Feature, id)), [3, 4, 4]);
        let state = model.report(Kind::Input, id::STATE).unwrap();
        let feed = state.find(desktop::X).unwrap().field;
        assert_eq!((feed.to_physical(32767), feed.unit_exponent), (50.0, -1));
        let roll = state.find(desktop::RX).unwrap().field;
        assert!((roll.to_physical(32767) * 1e-2 - HALF_WAY[1]).abs() < 0.01);
    }

    #[test]
    fn others_read_it_the_same() {
        let model = parse(DESCRIPTOR).unwrap();
        assert_eq!(webhid::model(&chromium(DESCRIPTOR)).unwrap(), model);
        assert_eq!(peer(DESCRIPTOR), crate::haptics::fixtures::elements(&model));
    }

    /// The device that the browser's tests put into the page (tests/browser/fake-hid.js) has this file.
    #[test]
    fn the_browser_s_tests_have_what_chromium_tells_of_it() {
        let file: serde_json::Value =
            serde_json::from_str(include_str!("../../tests/haptics/feeder-collections.json")).unwrap();
        let told = serde_json::to_value(chromium(DESCRIPTOR)).unwrap();
        assert!(file == told, "it should be:\n{told}");
    }
}
