//! The device's end of the serial line: what a host's frames do, and what answers them (`docs/haptic-device.md`).

use crate::device::Device;
use crate::feeder::DESCRIPTOR;
use crate::framing::{Decoder, FRAME, Frame, Kind, PAYLOAD, encode};
use crate::turn;

/// What has come so far.
#[derive(Clone, Debug, Default)]
pub struct Line {
    decoder: Decoder,
}

impl Line {
    /// Before the first byte.
    pub const fn new() -> Self {
        Self { decoder: Decoder::new() }
    }

    /// Takes a byte that came. Returns how many bytes of `answer` are to be sent; most bytes ask for none.
    pub fn take(&mut self, byte: u8, device: &mut Device, answer: &mut [u8; FRAME]) -> usize {
        let Some(Frame { kind, id, data }) = self.decoder.take(byte) else { return 0 };
        let refused = Frame { kind: Kind::Refused, id, data: &[] };
        match kind {
            Kind::Output => {
                if device.hears(turn::Line::Serial) {
                    // One that makes no sense is let be, as on the other line.
                    let _ = device.take(id, data);
                }
                0
            }
            Kind::SetFeature => {
                let is_set = device.hears(turn::Line::Serial) && device.take_feature(id, data).is_ok();
                let done = Frame { kind, id, data: &[] };
                packed(if is_set { &done } else { &refused }, answer)
            }
            Kind::GetFeature => match device.feature(id) {
                Some([_, data @ ..]) if device.hears(turn::Line::Serial) => {
                    packed(&Frame { kind, id, data: &data }, answer)
                }
                _ => packed(&refused, answer),
            },
            Kind::Descriptor => {
                let begun = DESCRIPTOR.get(usize::from(id) * PAYLOAD..).unwrap_or_default();
                packed(&Frame { kind, id, data: &begun[..begun.len().min(PAYLOAD)] }, answer)
            }
            // These are the device's own to say.
            Kind::Input | Kind::Refused => 0,
        }
    }
}

/// An input report with its id before it, as a frame: how many bytes of `frame` it is.
pub fn input(report: &[u8], frame: &mut [u8; FRAME]) -> usize {
    let Some((&id, data)) = report.split_first() else { return 0 };
    packed(&Frame { kind: Kind::Input, id, data }, frame)
}

/// All that the device says is short enough.
fn packed(frame: &Frame<'_>, out: &mut [u8; FRAME]) -> usize {
    encode(frame, out).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feeder::id;

    /// What a device answers to a frame: its length and its bytes.
    fn asked(device: &mut Device, kind: Kind, id: u8, data: &[u8]) -> (usize, [u8; FRAME]) {
        let (mut line, mut frame, mut answer) = (Line::new(), [0; FRAME], [0; FRAME]);
        let length = encode(&Frame { kind, id, data }, &mut frame).unwrap();
        let mut answered = 0;
        for (i, &byte) in frame[..length].iter().enumerate() {
            answered = line.take(byte, device, &mut answer);
            assert!(answered == 0 || i + 1 == length);
        }
        (answered, answer)
    }

    fn kind_of((length, mut bytes): (usize, [u8; FRAME])) -> Option<u8> {
        let length = crate::framing::unstuff(&mut bytes[..length.checked_sub(1)?])?;
        bytes[..length].first().copied()
    }

    #[test]
    fn features_are_answered_and_reports_are_not() {
        let mut device = Device::new();
        assert_eq!(asked(&mut device, Kind::Output, id::CONTROL, &[1]).0, 0);
        assert_eq!(device.playing()[1] & 2, 2, "the motors are on");
        assert_eq!(kind_of(asked(&mut device, Kind::SetFeature, id::CREATE, &[1, 0, 0])), Some(3));
        assert_eq!(kind_of(asked(&mut device, Kind::GetFeature, id::LOAD, &[])), Some(4));
        assert_eq!(kind_of(asked(&mut device, Kind::SetFeature, id::LOAD, &[1, 0, 0])), Some(6));
        assert_eq!(kind_of(asked(&mut device, Kind::GetFeature, 0x42, &[])), Some(6));
        assert_eq!(asked(&mut device, Kind::Input, 1, &[0; 5]).0, 0);
    }

    #[test]
    fn the_other_host_s_device_is_left_alone() {
        let mut device = Device::new();
        assert!(device.hears(turn::Line::Hid));
        assert_eq!(asked(&mut device, Kind::Output, id::CONTROL, &[1]).0, 0);
        assert_eq!(device.playing()[1] & 2, 0, "the motors stay off");
        assert_eq!(kind_of(asked(&mut device, Kind::SetFeature, id::CREATE, &[1, 0, 0])), Some(6));
        assert_eq!(kind_of(asked(&mut device, Kind::GetFeature, id::LOAD, &[])), Some(6));
        // What it is may be asked by anybody.
        assert_eq!(kind_of(asked(&mut device, Kind::Descriptor, 0, &[])), Some(5));
    }

    #[test]
    fn an_input_report_is_a_frame_of_eleven_bytes() {
        let mut frame = [0; FRAME];
        let length = input(&[1, 0, 0xFF, 0x7F, 1, 0x80], &mut frame);
        assert_eq!((length, frame[length - 1]), (11, 0));
        assert_eq!(frame[..3], [3, 1, 1], "kind 1, id 1, then a nought");
        assert_eq!(input(&[], &mut frame), 0);
    }
}
