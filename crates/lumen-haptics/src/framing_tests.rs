//! Frames on a serial line, by what others have published of their parts.

use proptest::prelude::*;

use super::framing::{Decoder, FRAME, Frame, Kind, PAYLOAD, crc, encode, stuff, unstuff};

/// The catalogue of parametrised CRC algorithms (Cook): CRC-16/IBM-3740, check.
#[test]
fn the_crc_of_the_catalogue_s_nine_digits() {
    assert_eq!(crc(b"123456789"), 0x29B1);
    assert_eq!(crc(b""), 0xFFFF);
}

/// The examples that go with the method wherever it is described, Wikipedia's eleven.
#[test]
fn stuffing_s_published_examples() {
    let run = |from: u8, to: u8| (from..=to).collect::<Vec<u8>>();
    let examples: [(Vec<u8>, Vec<u8>); 11] = [
        (vec![0], vec![1, 1, 0]),
        (vec![0, 0], vec![1, 1, 1, 0]),
        (vec![0, 0x11, 0], vec![1, 2, 0x11, 1, 0]),
        (vec![0x11, 0x22, 0, 0x33], vec![3, 0x11, 0x22, 2, 0x33, 0]),
        (vec![0x11, 0x22, 0x33, 0x44], vec![5, 0x11, 0x22, 0x33, 0x44, 0]),
        (vec![0x11, 0, 0, 0], vec![2, 0x11, 1, 1, 1, 0]),
        (run(1, 0xFE), [vec![0xFF], run(1, 0xFE), vec![0]].concat()),
        (run(0, 0xFE), [vec![1, 0xFF], run(1, 0xFE), vec![0]].concat()),
        (run(1, 0xFF), [vec![0xFF], run(1, 0xFE), vec![2, 0xFF, 0]].concat()),
        ([run(2, 0xFF), vec![0]].concat(), [vec![0xFF], run(2, 0xFF), vec![1, 1, 0]].concat()),
        ([run(3, 0xFF), vec![0, 1]].concat(), [vec![0xFE], run(3, 0xFF), vec![2, 1, 0]].concat()),
    ];
    for (data, stuffed) in examples {
        let mut out = [0xAA; 300];
        let length = stuff(&data, &mut out).unwrap();
        assert_eq!(out[..length], stuffed, "{data:?}");
        let length = unstuff(&mut out[..length - 1]).unwrap();
        assert_eq!(out[..length], data);
        assert_eq!(stuff(&data, &mut vec![0; stuffed.len() - 1]), None, "no room");
    }
}

fn packed(frame: &Frame<'_>) -> Vec<u8> {
    let mut out = [0; FRAME];
    let length = encode(frame, &mut out).unwrap();
    out[..length].to_vec()
}

/// The frames that the stream has: kind, id, data.
fn heard(decoder: &mut Decoder, stream: &[u8]) -> Vec<(Kind, u8, Vec<u8>)> {
    let take = |&byte: &u8| decoder.take(byte).map(|frame| (frame.kind, frame.id, frame.data.to_vec()));
    stream.iter().filter_map(take).collect()
}

#[test]
fn a_frame_byte_for_byte() {
    // The examples of docs/haptic-device.md; their sums are those of Python's binascii.crc_hqx, from 0xFFFF.
    let on = packed(&Frame { kind: Kind::Output, id: 6, data: &[1] });
    assert_eq!(on, [6, 2, 6, 1, 0x7B, 0x18, 0]);
    let state = packed(&Frame { kind: Kind::Input, id: 1, data: &[0, 0xFF, 0x7F, 1, 0x80] });
    assert_eq!(state, [3, 1, 1, 7, 0xFF, 0x7F, 1, 0x80, 0x2C, 0x11, 0]);
    // The longest is still less than a packet.
    let full = [0xA5; PAYLOAD];
    assert_eq!(packed(&Frame { kind: Kind::Descriptor, id: 7, data: &full }).len(), FRAME);
    const { assert!(FRAME < 64) };
    let long = Frame { kind: Kind::Input, id: 1, data: &[0; PAYLOAD + 1] };
    assert_eq!(encode(&long, &mut [0; FRAME]), None);
    assert_eq!(encode(&Frame { data: &[0; 300], ..long }, &mut [0; FRAME]), None);
}

#[test]
fn a_frame_that_is_too_long_or_of_no_kind_is_none_and_the_next_is_heard() {
    let good = packed(&Frame { kind: Kind::Input, id: 1, data: &[1, 2, 3] });
    let mut unknown = [0; 16];
    let body = [9, 1];
    let sum = crc(&body).to_le_bytes();
    let length = stuff(&[body, sum].concat(), &mut unknown).unwrap();
    for bad in [&unknown[..length], &[7; 1000][..], &[0xFF; FRAME], &[3, 1, 1], &[]] {
        let stream = [bad, &[0], &good[..]].concat();
        assert_eq!(heard(&mut Decoder::new(), &stream), [(Kind::Input, 1, vec![1, 2, 3])], "{bad:?}");
    }
}

fn kind() -> impl Strategy<Value = Kind> {
    prop::sample::select(vec![
        Kind::Input,
        Kind::Output,
        Kind::SetFeature,
        Kind::GetFeature,
        Kind::Descriptor,
        Kind::Refused,
    ])
}

proptest! {
    #[test]
    fn what_is_sent_is_heard_behind_any_garbage(
        garbage in prop::collection::vec(any::<u8>(), 0..200),
        frames in prop::collection::vec((kind(), any::<u8>(), prop::collection::vec(any::<u8>(), 0..=PAYLOAD)), 1..8),
    ) {
        let mut decoder = Decoder::new();
        heard(&mut decoder, &garbage);
        // What the garbage began ends here.
        heard(&mut decoder, &[0]);
        let stream: Vec<u8> =
            frames.iter().flat_map(|(kind, id, data)| packed(&Frame { kind: *kind, id: *id, data })).collect();
        prop_assert_eq!(heard(&mut decoder, &stream), frames);
    }

    /// A CRC of 16 bits finds every burst of up to 16 bits.
    #[test]
    fn a_byte_that_was_changed_is_found(
        data in prop::collection::vec(any::<u8>(), 0..=PAYLOAD), at in any::<prop::sample::Index>(), by in 1..=255_u8,
    ) {
        let mut frame = packed(&Frame { kind: Kind::Input, id: 1, data: &data });
        let last = frame.len() - 1;
        let length = unstuff(&mut frame[..last]).unwrap();
        let mut body = frame[..length].to_vec();
        body[at.index(length)] ^= by;
        let mut out = [0; FRAME];
        let length = stuff(&body, &mut out).unwrap();
        prop_assert!(heard(&mut Decoder::new(), &out[..length]).is_empty());
    }

    #[test]
    fn no_stream_makes_it_panic(stream in prop::collection::vec(any::<u8>(), 0..2000)) {
        for (_, _, data) in heard(&mut Decoder::new(), &stream) {
            prop_assert!(data.len() <= PAYLOAD);
        }
    }

    #[test]
    fn no_bytes_that_are_unstuffed_make_it_panic(mut bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        let before = bytes.len();
        if let Some(length) = unstuff(&mut bytes) {
            prop_assert!(length <= before);
        }
    }
}
