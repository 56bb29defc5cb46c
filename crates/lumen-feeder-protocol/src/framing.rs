//! HID reports over a stream of bytes, as the open feeder speaks by serial (`docs/haptic-device.md`): frames that a zero ends,
//! stuffed so that no other zero is in them (consistent overhead byte stuffing: Cheshire and Baker, IEEE/ACM Transactions on
//! Networking 7(2), 1999), with the CRC-16 of CCITT behind them.
//!
//! ```text
//! frame = COBS(kind, id, up to 56 bytes, CRC low, CRC high), 0
//! ```
//!
//! After garbage, or with bytes lost, the next zero begins anew.

/// Bytes of a report in a frame at most, without its id.
pub const PAYLOAD: usize = 56;

/// Bytes of a frame at most, its zero with them: less than a full-speed USB packet of 64, so that each frame ends a transfer.
pub const FRAME: usize = PAYLOAD + 6;

/// What a frame carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// From the device: an input report.
    Input = 1,
    /// From the host: an output report. Nothing answers it.
    Output = 2,
    /// From the host: a feature report to be set. From the device, empty: it was.
    SetFeature = 3,
    /// From the host, empty: a feature report is asked for. From the device: that report.
    GetFeature = 4,
    /// From the host, empty: a piece of the report descriptor is asked for, by its number. From the device: those of its bytes
    /// that begin at [`PAYLOAD`] times the number. The first piece that is not full is the last.
    Descriptor = 5,
    /// From the device, empty: the feature report of this id was not set, or is none.
    Refused = 6,
}

impl Kind {
    fn of(number: u8) -> Option<Self> {
        [Self::Input, Self::Output, Self::SetFeature, Self::GetFeature, Self::Descriptor, Self::Refused]
            .into_iter()
            .find(|kind| *kind as u8 == number)
    }
}

/// A frame, unpacked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// What it carries.
    pub kind: Kind,
    /// The report's id, or the descriptor's piece.
    pub id: u8,
    /// The report's bytes, without its id; up to [`PAYLOAD`].
    pub data: &'a [u8],
}

/// CRC-16/IBM-3740 (also CCITT-FALSE): x^16 + x^12 + x^5 + 1, from 0xFFFF, high bits first.
pub fn crc(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0xFFFF, |crc, &byte| {
        (0..8)
            .fold(crc ^ (u16::from(byte) << 8), |crc, _| if crc & 0x8000 == 0 { crc << 1 } else { (crc << 1) ^ 0x1021 })
    })
}

/// Stuffs `data` into `out`, with a zero behind it. Returns how many bytes that is; `None` where `out` is too short.
pub fn stuff(data: &[u8], out: &mut [u8]) -> Option<usize> {
    // Each block begins with the way to the next.
    let (mut block, mut at) = (0, 1);
    for (i, &byte) in data.iter().enumerate() {
        if byte != 0 {
            *out.get_mut(at)? = byte;
            at += 1;
        }
        if byte == 0 || at - block == 0xFF && i + 1 < data.len() {
            *out.get_mut(block)? = (at - block) as u8;
            (block, at) = (at, at + 1);
        }
    }
    *out.get_mut(block)? = (at - block) as u8;
    *out.get_mut(at)? = 0;
    Some(at + 1)
}

/// Puts back in place what was stuffed, given without the zero behind it. Returns how many bytes there are; `None` where it
/// was not stuffed.
pub fn unstuff(bytes: &mut [u8]) -> Option<usize> {
    let (mut from, mut to) = (0, 0);
    while let Some(&way) = bytes.get(from) {
        let next = from + usize::from(way);
        if way == 0 || next > bytes.len() {
            return None;
        }
        bytes.copy_within(from + 1..next, to);
        to += usize::from(way) - 1;
        from = next;
        if way < 0xFF && from < bytes.len() {
            bytes[to] = 0;
            to += 1;
        }
    }
    Some(to)
}

/// Packs a frame. Returns how many bytes of `out` it is; `None` where its data are longer than [`PAYLOAD`].
pub fn encode(frame: &Frame<'_>, out: &mut [u8; FRAME]) -> Option<usize> {
    let mut body = [0; PAYLOAD + 4];
    let end = 2 + frame.data.len();
    [body[0], body[1]] = [frame.kind as u8, frame.id];
    body.get_mut(2..end)?.copy_from_slice(frame.data);
    let sum = crc(&body[..end]).to_le_bytes();
    body.get_mut(end..end + 2)?.copy_from_slice(&sum);
    stuff(&body[..end + 2], out)
}

/// Finds frames in a stream.
#[derive(Clone, Debug)]
pub struct Decoder {
    bytes: [u8; FRAME],
    /// Bytes since the last zero, also of those that were too many.
    length: usize,
}

impl Default for Decoder {
    fn default() -> Self {
        Self::new()
    }
}

impl Decoder {
    /// Before the first byte.
    pub const fn new() -> Self {
        Self { bytes: [0; FRAME], length: 0 }
    }

    /// Takes a byte; returns the frame that it ends, if it ends a good one.
    pub fn take(&mut self, byte: u8) -> Option<Frame<'_>> {
        if byte != 0 {
            if let Some(place) = self.bytes.get_mut(self.length) {
                *place = byte;
            }
            self.length = self.length.saturating_add(1);
            return None;
        }
        let length = core::mem::take(&mut self.length);
        // One byte of the longest is the zero.
        if length >= FRAME {
            return None;
        }
        unpacked(&mut self.bytes[..length])
    }
}

fn unpacked(bytes: &mut [u8]) -> Option<Frame<'_>> {
    let length = unstuff(bytes)?;
    let (body, sum) = bytes.get(..length)?.split_last_chunk::<2>()?;
    let [kind, id, data @ ..] = body else { return None };
    if crc(body) != u16::from_le_bytes(*sum) {
        return None;
    }
    Some(Frame { kind: Kind::of(*kind)?, id: *id, data })
}
