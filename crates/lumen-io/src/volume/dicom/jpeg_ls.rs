//! JPEG-LS pictures of one component, lossless and near-lossless (ITU-T T.87, 1998, whose sections and names stand here).
//!
//! No crate holds: `pure_jpegls` 2.0 panics on some damaged pictures, `charls` binds a library in C++. Here a picture that ends
//! early, or an error beyond what an encoder can write, gives `None`.
//!
//! Not read: restart intervals, several components, mapping tables and point transforms, none of which a grey picture in DICOM has.

/// What the headers of a picture say, with the standard's defaults where they say nothing.
#[derive(Clone, Debug)]
pub(super) struct Picture<'a> {
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Bits of a sample, 2 to 16.
    pub(super) bits: u8,
    /// `MAXVAL`, at least 1.
    largest: i64,
    /// `NEAR`: by so much a sample may differ.
    near: i64,
    /// `T1` to `T3`.
    thresholds: [i64; 3],
    /// `RESET`: after so many samples what a context has counted is halved.
    reset: i64,
    scan: &'a [u8],
}

impl<'a> Picture<'a> {
    /// Parses the headers (annex C).
    pub(super) fn parse(packed: &'a [u8]) -> Option<Self> {
        const FRAME: u8 = 0xF7;
        const PRESETS: u8 = 0xF8;
        const SCAN: u8 = 0xDA;
        /// Application data and comments.
        const SKIPPED: [std::ops::RangeInclusive<u8>; 2] = [0xE0..=0xEF, 0xFE..=0xFE];
        let mut rest = packed.strip_prefix(&[0xFF, 0xD8])?;
        let (mut frame, mut presets) = (None, [0; 5]);
        loop {
            let [0xFF, marker, ..] = *rest else { return None };
            if marker == 0xFF {
                rest = &rest[1..];
                continue;
            }
            let length = usize::from(u16::from_be_bytes(*rest.get(2..)?.first_chunk()?));
            let body = rest.get(4..2 + length)?;
            rest = rest.get(2 + length..)?;
            let word = |at: usize| Some(u16::from_be_bytes(*body.get(at..)?.first_chunk()?));
            match marker {
                FRAME if body.len() == 9 && body[5] == 1 && (2..=16).contains(&body[0]) && frame.is_none() => {
                    frame = Some((body[0], word(1)?, word(3)?));
                }
                PRESETS if body.len() == 11 && body[0] == 1 => {
                    for (preset, at) in presets.iter_mut().zip((1..).step_by(2)) {
                        *preset = i64::from(word(at)?);
                    }
                }
                SCAN => {
                    // One component without a table, NEAR, no interleaving, no point transform.
                    let [1, _, 0, near, 0, 0] = *body else { return None };
                    let (bits, rows, columns) = frame?;
                    return Self::new(bits, [columns, rows].map(usize::from), near.into(), presets, rest);
                }
                other if SKIPPED.iter().any(|skipped| skipped.contains(&other)) => {}
                _ => return None,
            }
        }
    }

    /// `presets` are `MAXVAL`, `T1` to `T3` and `RESET`, 0 for the default (C.2.4.1.1).
    fn new(bits: u8, [columns, rows]: [usize; 2], near: i64, presets: [i64; 5], scan: &'a [u8]) -> Option<Self> {
        const BASE: [i64; 3] = [3, 7, 21];
        let full = (1 << bits) - 1;
        let [largest, mut thresholds @ .., reset] = presets;
        let largest = if largest == 0 { full } else { largest };
        if largest > full || near > (largest / 2).min(255) {
            return None;
        }
        let reset = if reset == 0 { 64 } else { reset };
        let mut floor = near + 1;
        for (threshold, (base, n)) in thresholds.iter_mut().zip(BASE.into_iter().zip(0..)) {
            let (least, slack) = (2 + n, (3 + 2 * n) * near);
            let default = if largest >= 128 {
                (largest.min(4095) + 128) / 256 * (base - least) + least + slack
            } else {
                (base / (256 / (largest + 1)) + slack).max(least)
            };
            if *threshold == 0 {
                *threshold = if default > largest { floor } else { default.max(floor) };
            }
            if !(floor..=largest).contains(threshold) {
                return None;
            }
            floor = *threshold;
        }
        (reset >= 3).then_some(Self { columns, rows, bits, largest, near, thresholds, reset, scan })
    }

    /// The samples, row by row; room for them is taken as they come.
    pub(super) fn decode(&self) -> Option<Vec<u16>> {
        let mut decoder = Decoder::new(self);
        let mut samples = Vec::new();
        // The row and the one above it, each with the sample before its first and the one behind its last (A.2.1).
        let [mut above, mut row] = [(); 2].map(|()| vec![0; self.columns + 2]);
        for _ in 0..self.rows {
            above[self.columns + 1] = above[self.columns];
            row[0] = above[1];
            decoder.row(&above, &mut row)?;
            samples.extend(row[1..=self.columns].iter().map(|&sample| sample as u16));
            std::mem::swap(&mut above, &mut row);
        }
        Some(samples)
    }
}

/// What was counted of samples with alike neighbours (A.2.1).
#[derive(Clone, Copy, Debug)]
struct Context {
    /// `A`: the sum of errors without their signs.
    size: i64,
    /// `B`: the sum of errors, as far as not corrected; where a run ends, `Nn`: how many are negative.
    bias: i64,
    /// `C`: the correction.
    correction: i64,
    /// `N`.
    count: i64,
}

impl Context {
    /// `k`: bits of an error that are written as they are, for errors of `size` altogether (A.5.1).
    fn low_bits(&self, size: i64) -> u32 {
        let mut bits = 0;
        while self.count << bits < size {
            bits += 1;
        }
        bits
    }

    /// Counts an error (A.6).
    fn learn(&mut self, error: i64, step: i64, reset: i64) {
        const CORRECTIONS: (i64, i64) = (-128, 127);
        self.bias += error * step;
        self.size += error.abs();
        if self.count == reset {
            self.halve();
        }
        self.count += 1;
        if self.bias <= -self.count {
            self.correction = (self.correction - 1).max(CORRECTIONS.0);
            self.bias = (self.bias + self.count).max(1 - self.count);
        } else if self.bias > 0 {
            self.correction = (self.correction + 1).min(CORRECTIONS.1);
            self.bias = (self.bias - self.count).min(0);
        }
    }

    fn halve(&mut self) {
        self.size >>= 1;
        self.bias >>= 1;
        self.count >>= 1;
    }
}

/// The decoder of a scan (annex A).
struct Decoder<'a> {
    picture: &'a Picture<'a>,
    bits: Bits<'a>,
    /// `2 NEAR + 1`.
    step: i64,
    /// `RANGE`: how many values an error has.
    range: i64,
    /// `qbpp`: bits of an error.
    error_bits: u32,
    /// `LIMIT`: the longest code.
    limit: u32,
    contexts: Vec<Context>,
    /// Where a run ends: of a sample unlike the one above that, and alike.
    ends: [Context; 2],
    /// `RUNindex`.
    run: usize,
}

impl<'a> Decoder<'a> {
    fn new(picture: &'a Picture<'a>) -> Self {
        /// Of three differences in nine classes, those of one sign.
        const CONTEXTS: usize = 365;
        let bits_for = |values: i64| (values - 1).checked_ilog2().map_or(0, |last| last + 1);
        let step = 2 * picture.near + 1;
        let range = (picture.largest + 2 * picture.near) / step + 1;
        let sample_bits = bits_for(picture.largest + 1).max(2);
        let context = Context { size: ((range + 32) / 64).max(2), bias: 0, correction: 0, count: 1 };
        Self {
            picture,
            bits: Bits { bytes: picture.scan.iter(), held: 0, count: 0, was_full: false },
            step,
            range,
            error_bits: bits_for(range),
            limit: 2 * (sample_bits + sample_bits.max(8)),
            contexts: vec![context; CONTEXTS],
            ends: [context; 2],
            run: 0,
        }
    }

    fn row(&mut self, above: &[i64], row: &mut [i64]) -> Option<()> {
        let near = self.picture.near;
        let columns = self.picture.columns;
        let mut at = 1;
        while at <= columns {
            let [left, up, up_left, up_right] = [row[at - 1], above[at], above[at - 1], above[at + 1]];
            let differences = [up_right - up, up - up_left, up_left - left];
            if differences.iter().all(|difference| difference.abs() <= near) {
                at += self.run(left, &mut row[at..=columns])?;
                if at <= columns {
                    row[at] = self.end_of_run(row[at - 1], above[at])?;
                    at += 1;
                }
            } else {
                let predicted = if up_left >= left.max(up) {
                    left.min(up)
                } else if up_left <= left.min(up) {
                    left.max(up)
                } else {
                    left + up - up_left
                };
                row[at] = self.sample(differences, predicted)?;
                at += 1;
            }
        }
        Some(())
    }

    /// A sample that is no part of a run (A.4 and A.5).
    fn sample(&mut self, differences: [i64; 3], predicted: i64) -> Option<i64> {
        let classes = differences.map(|difference| self.class(difference));
        let place = classes.into_iter().fold(0, |place, class| 9 * place + class);
        let sign = place.signum();
        let context = &mut self.contexts[place.unsigned_abs() as usize];
        let predicted = (predicted + sign * context.correction).clamp(0, self.picture.largest);
        let low_bits = context.low_bits(context.size);
        let code = self.bits.golomb(low_bits, self.limit, self.error_bits)?;
        let error = if code % 2 == 0 { code / 2 } else { -(code / 2) - 1 };
        let is_turned = self.picture.near == 0 && low_bits == 0 && 2 * context.bias <= -context.count;
        let error = if is_turned { -1 - error } else { error };
        if error.abs() > self.range {
            return None;
        }
        context.learn(error, self.step, self.picture.reset);
        Some(self.within(predicted + sign * error * self.step))
    }

    /// The class of a difference, -4 to 4 (A.3.3).
    fn class(&self, difference: i64) -> i64 {
        if difference.abs() <= self.picture.near {
            return 0;
        }
        let beyond = self.picture.thresholds.iter().filter(|&&threshold| difference.abs() >= threshold).count();
        difference.signum() * (1 + beyond as i64)
    }

    /// The value that a sum stands for, which is known but for whole ranges (A.4.5).
    fn within(&self, value: i64) -> i64 {
        let Picture { near, largest, .. } = *self.picture;
        let whole = self.range * self.step;
        let value = if value < -near {
            value + whole
        } else if value > largest + near {
            value - whole
        } else {
            value
        };
        value.clamp(0, largest)
    }

    /// `J` of a run (A.2.1): its length is counted in pieces of 2^J samples.
    fn piece(&self) -> u32 {
        const PIECES: [u32; 32] =
            [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        PIECES[self.run]
    }

    /// Fills the beginning of the rest of a row with the sample on its left, and says how far (A.7.1).
    fn run(&mut self, left: i64, rest: &mut [i64]) -> Option<usize> {
        let mut length = 0;
        while length < rest.len() {
            if self.bits.take(1)? == 0 {
                length += self.bits.take(self.piece())? as usize;
                break;
            }
            let piece = 1 << self.piece();
            if length + piece <= rest.len() {
                self.run = (self.run + 1).min(31);
            }
            length = (length + piece).min(rest.len());
        }
        rest.get_mut(..length)?.fill(left);
        Some(length)
    }

    /// The sample that ends a run (A.7.2).
    fn end_of_run(&mut self, left: i64, up: i64) -> Option<i64> {
        let is_alike = (left - up).abs() <= self.picture.near;
        let alike = i64::from(is_alike);
        let limit = self.limit - self.piece() - 1;
        let context = &mut self.ends[usize::from(is_alike)];
        let low_bits = context.low_bits(context.size + alike * (context.count >> 1));
        let code = self.bits.golomb(low_bits, limit, self.error_bits)?;
        let both = code + alike;
        let is_likely_negative = low_bits != 0 || 2 * context.bias >= context.count;
        let is_negative = is_likely_negative == (both % 2 == 1);
        let size = (both + 1) / 2;
        if size > self.range {
            return None;
        }
        let error = if is_negative { -size } else { size };
        context.bias += i64::from(error < 0);
        context.size += (code + 1 - alike) >> 1;
        if context.count == self.picture.reset {
            context.halve();
        }
        context.count += 1;
        self.run = self.run.saturating_sub(1);
        let error = error * self.step;
        Some(self.within(if is_alike { left + error } else { up + (up - left).signum() * error }))
    }
}

/// The bits of a scan. Behind a byte of ones comes a bit of zero that is none of them; where it is a one, a marker begins.
struct Bits<'a> {
    bytes: std::slice::Iter<'a, u8>,
    held: u64,
    count: u32,
    was_full: bool,
}

impl Bits<'_> {
    /// The next bits, 17 at most.
    fn take(&mut self, bits: u32) -> Option<i64> {
        while self.count < bits {
            let byte = *self.bytes.next()?;
            if self.was_full && byte >= 0x80 {
                return None;
            }
            let new = if self.was_full { 7 } else { 8 };
            self.was_full = byte == 0xFF;
            self.held = self.held << new | u64::from(byte);
            self.count += new;
        }
        self.count -= bits;
        let taken = self.held >> self.count & ((1 << bits) - 1);
        Some(taken as i64)
    }

    /// A number by its Golomb code of at most `limit` bits (A.5.3).
    fn golomb(&mut self, low_bits: u32, limit: u32, error_bits: u32) -> Option<i64> {
        let longest = limit.checked_sub(error_bits + 1)?;
        let mut zeros = 0;
        while self.take(1)? == 0 {
            zeros += 1;
            if zeros > longest {
                return None;
            }
        }
        if zeros < longest {
            Some(i64::from(zeros) << low_bits | self.take(low_bits)?)
        } else {
            Some(self.take(error_bits)? + 1)
        }
    }
}
