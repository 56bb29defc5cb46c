//! The host's end of a feeder's serial line: requests as frames, and what the device's frames say to them. It knows neither
//! port nor clock.

use super::force::{Reply, Request};
use super::framing::{FRAME, Frame, Kind, PAYLOAD, encode};

fn packed(kind: Kind, id: u8, data: &[u8]) -> Option<Vec<u8>> {
    let mut out = [0; FRAME];
    let length = encode(&Frame { kind, id, data }, &mut out)?;
    Some(out[..length].to_vec())
}

/// A request's bytes; `None` for a report that is longer than a frame.
pub fn framed(request: &Request) -> Option<Vec<u8>> {
    match request {
        Request::Send { id, data } => packed(Kind::Output, *id, data),
        Request::SetFeature { id, data } => packed(Kind::SetFeature, *id, data),
        Request::GetFeature { id, .. } => packed(Kind::GetFeature, *id, &[]),
    }
}

/// What a frame answers to a request; `None` where it is about something else. Output reports are not answered: they are done
/// when they are written.
pub fn answer<'a>(request: &Request, frame: &Frame<'a>) -> Option<Reply<'a>> {
    match (request, frame.kind) {
        (Request::SetFeature { id, .. } | Request::GetFeature { id, .. }, _) if *id != frame.id => None,
        (Request::SetFeature { .. }, Kind::SetFeature) => Some(Reply::Done),
        (Request::GetFeature { .. }, Kind::GetFeature) => Some(Reply::Feature(frame.data)),
        (Request::SetFeature { .. } | Request::GetFeature { .. }, Kind::Refused) => Some(Reply::Failed),
        _ => None,
    }
}

/// Puts a device's descriptor together out of its pieces, each of which is asked for.
#[derive(Clone, Debug, Default)]
pub struct Hello {
    descriptor: Vec<u8>,
    piece: u8,
    is_whole: bool,
}

impl Hello {
    /// The bytes that ask for the piece that is missing, also once more. A zero stands before them: what was on the line ends
    /// there.
    pub fn ask(&self) -> Vec<u8> {
        let frame = packed(Kind::Descriptor, self.piece, &[]).unwrap_or_default();
        [&[0][..], &frame[..]].concat()
    }

    /// Takes a frame; returns whether it was the piece that was asked for. Others may come between.
    pub fn take(&mut self, frame: &Frame<'_>) -> bool {
        let is_it = !self.is_whole && frame.kind == Kind::Descriptor && frame.id == self.piece;
        if is_it {
            self.descriptor.extend_from_slice(frame.data);
            let next = self.piece.checked_add(1);
            // There are no more numbers, and no descriptor is as long.
            self.is_whole = frame.data.len() < PAYLOAD || next.is_none();
            self.piece = next.unwrap_or_default();
        }
        is_it
    }

    /// The descriptor, once it is whole.
    pub fn whole(&self) -> Option<&[u8]> {
        self.is_whole.then_some(&self.descriptor)
    }
}

#[cfg(test)]
mod tests {
    use lumen_feeder::device::{Device, Seen};
    use lumen_feeder::serial::Line;

    use super::*;
    use crate::device::{HapticDevice, Resistance};
    use crate::feeder::{DESCRIPTOR, HALF_WAY, id};
    use crate::framing::Decoder;
    use crate::identity::Identity;

    const WELL: Seen = Seen {
        steps: [lumen_feeder::quadrature::Steps { counts: 0, missed: 0 }; 2],
        is_clutched: false,
        is_centred: false,
        has_power: true,
        is_faulty: false,
    };

    /// The firmware at the other end of a line.
    #[derive(Default)]
    struct Firmware {
        device: Device,
        line: Line,
        decoder: Decoder,
    }

    impl Firmware {
        /// Writes bytes to it; returns what it answers: kind, id, data.
        fn write(&mut self, bytes: &[u8]) -> Vec<(Kind, u8, Vec<u8>)> {
            let mut out = Vec::new();
            for &byte in bytes {
                let mut answer = [0; FRAME];
                let length = self.line.take(byte, &mut self.device, &mut answer);
                out.extend_from_slice(&answer[..length]);
            }
            self.read(&out)
        }

        fn read(&mut self, bytes: &[u8]) -> Vec<(Kind, u8, Vec<u8>)> {
            let take = |&byte: &u8| self.decoder.take(byte).map(|frame| (frame.kind, frame.id, frame.data.to_vec()));
            bytes.iter().filter_map(take).collect()
        }

        /// Carries out what the device of the host asks for.
        fn serve(&mut self, host: &mut HapticDevice, now_ms: f64) {
            while let Some(request) = host.next(now_ms) {
                let answers = self.write(&framed(&request).unwrap());
                if matches!(request, Request::Send { .. }) {
                    assert!(answers.is_empty(), "output reports are not answered");
                    host.reply(now_ms, Reply::Done);
                    continue;
                }
                let [(kind, id, data)] = &answers[..] else { panic!("{request:?}: {answers:?}") };
                let frame = Frame { kind: *kind, id: *id, data };
                host.reply(now_ms, answer(&request, &frame).expect("it is its answer"));
            }
        }
    }

    fn hello(firmware: &mut Firmware) -> Hello {
        let mut hello = Hello::default();
        for _ in 0..DESCRIPTOR.len() {
            if hello.whole().is_some() {
                break;
            }
            for (kind, id, data) in firmware.write(&hello.ask()) {
                assert!(hello.take(&Frame { kind, id, data: &data }));
            }
        }
        hello
    }

    #[test]
    fn the_firmware_says_its_descriptor_in_pieces_whatever_was_on_the_line() {
        let mut firmware = Firmware::default();
        assert!(firmware.write(b"AT+GCAP\r\n").is_empty(), "as a modem would be asked");
        assert_eq!(hello(&mut firmware).whole(), Some(DESCRIPTOR));
        // A piece that is not asked for is none, and beyond the end there is nothing.
        let mut begun = Hello::default();
        assert!(!begun.take(&Frame { kind: Kind::Descriptor, id: 1, data: &[1] }));
        assert!(!begun.take(&Frame { kind: Kind::Input, id: 0, data: &[1] }));
        let ask = packed(Kind::Descriptor, 255, &[]).unwrap();
        assert_eq!(firmware.write(&ask), [(Kind::Descriptor, 255, vec![])]);
    }

    #[test]
    fn a_device_that_answers_full_pieces_for_ever_ends() {
        let mut hello = Hello::default();
        for id in 0..=255 {
            assert!(hello.whole().is_none());
            assert!(hello.take(&Frame { kind: Kind::Descriptor, id, data: &[1; PAYLOAD] }));
        }
        assert_eq!(hello.whole().map(<[u8]>::len), Some(256 * PAYLOAD));
        assert!(!hello.take(&Frame { kind: Kind::Descriptor, id: 0, data: &[1] }));
    }

    #[test]
    fn by_serial_a_wall_is_felt_and_gone_150_ms_after_the_host_falls_silent() {
        let mut firmware = Firmware::default();
        let hello = hello(&mut firmware);
        let mut host = HapticDevice::from_descriptor(Identity::default(), hello.whole().unwrap()).unwrap();
        assert!(host.has_force());
        host.arm();
        let mut pushed = 0.0_f32;
        for ms in 0..400 {
            let now = f64::from(ms);
            // A hand at 10 mm, against a wall that pushes it back.
            let steps = lumen_feeder::quadrature::Steps { counts: if ms == 0 { 637 } else { 0 }, missed: 0 };
            let forces = firmware.device.advance(&Seen { steps: [steps, WELL.steps[1]], ..WELL });
            pushed = forces[0];
            let [id, data @ ..] = firmware.device.state();
            let bytes = packed(Kind::Input, id, &data).unwrap();
            for (kind, id, data) in firmware.read(&bytes) {
                assert_eq!(kind, Kind::Input);
                host.input(now, id, &data);
            }
            host.advance(0.001);
            host.resist(now, &Resistance { part: [0.3, 0.0], slope: [0.5 / HALF_WAY[0], 0.0] });
            firmware.serve(&mut host, now);
        }
        assert!(pushed < -0.05, "{pushed}: it pushes back");
        for ms in 0..=150 {
            pushed = firmware.device.advance(&WELL)[0];
            assert!(ms < 150 || pushed == 0.0, "{pushed} after {ms} ms");
        }
    }

    #[test]
    fn what_is_refused_is_said_and_what_answers_another_is_none() {
        let mut firmware = Firmware::default();
        let create = Request::SetFeature { id: id::CREATE, data: vec![9, 0, 0] };
        let answers = firmware.write(&framed(&create).unwrap());
        assert_eq!(answers.len(), 1);
        let get = Request::GetFeature { id: 0x42, bytes: 4 };
        assert_eq!(firmware.write(&framed(&get).unwrap()), [(Kind::Refused, 0x42, vec![])]);
        let of = |kind, id| Frame { kind, id, data: &[7] };
        assert_eq!(answer(&get, &of(Kind::Refused, 0x42)), Some(Reply::Failed));
        assert_eq!(answer(&get, &of(Kind::GetFeature, 0x42)), Some(Reply::Feature(&[7])));
        assert_eq!(answer(&get, &of(Kind::GetFeature, 0x41)), None);
        assert_eq!(answer(&get, &of(Kind::Input, 0x42)), None);
        assert_eq!(answer(&create, &of(Kind::GetFeature, id::CREATE)), None);
        let send = Request::Send { id: 1, data: vec![0; 9] };
        assert_eq!(answer(&send, &of(Kind::Refused, 1)), None);
        assert_eq!(framed(&Request::Send { id: 1, data: vec![0; 57] }), None);
    }
}
