//! JPEG pictures of one channel, written for tests: lossless (ITU T.81, annex H), and baseline of one flat grey.

/// Bits, with a zero byte after each byte of ones.
#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    held: u32,
    count: u32,
}

impl Bits {
    fn put(&mut self, value: u32, bits: u32) {
        for bit in (0..bits).rev() {
            self.held = self.held << 1 | (value >> bit & 1);
            self.count += 1;
            if self.count == 8 {
                self.bytes.push(self.held as u8);
                if self.held == 0xFF {
                    self.bytes.push(0);
                }
                (self.held, self.count) = (0, 0);
            }
        }
    }

    fn finish(mut self) -> Vec<u8> {
        self.put(0x7F, (8 - self.count) % 8);
        self.bytes
    }
}

fn segment(marker: u8, body: &[u8]) -> Vec<u8> {
    [&[0xFF, marker][..], &(body.len() as u16 + 2).to_be_bytes(), body].concat()
}

fn frame(marker: u8, precision: u8, width: u16, height: u16) -> Vec<u8> {
    let [w, h] = [width, height].map(u16::to_be_bytes);
    segment(marker, &[precision, h[0], h[1], w[0], w[1], 1, 1, 0x11, 0])
}

/// A lossless picture of 16-bit pixels, each predicted by the one to its left.
pub(crate) fn lossless(pixels: &[u16], width: usize) -> Vec<u8> {
    let height = pixels.len() / width;
    // Seventeen codes of five bits: the number of bits of a difference.
    let table = [&[0, 0, 0, 0, 0, 17][1..], &[0; 11], &(0..17).collect::<Vec<u8>>()].concat();
    let mut bits = Bits::default();
    for (at, &pixel) in pixels.iter().enumerate() {
        let predicted = match (at % width, at / width) {
            (0, 0) => 1 << 15,
            (0, _) => pixels[at - width],
            _ => pixels[at - 1],
        };
        let difference = i32::from(pixel.wrapping_sub(predicted) as i16);
        let size = 32 - difference.unsigned_abs().leading_zeros();
        bits.put(size, 5);
        if size < 16 {
            let code = if difference < 0 { difference - 1 } else { difference };
            bits.put(code as u32 & ((1 << size) - 1), size);
        }
    }
    [
        vec![0xFF, 0xD8],
        frame(0xC3, 16, width as u16, height as u16),
        segment(0xC4, &[&[0x00][..], &table].concat()),
        segment(0xDA, &[1, 1, 0, 1, 0, 0]),
        bits.finish(),
        vec![0xFF, 0xD9],
    ]
    .concat()
}

/// A baseline picture of a single grey in blocks of 8 x 8.
pub(crate) fn flat(grey: u8, width: u16, height: u16) -> Vec<u8> {
    let blocks = width.div_ceil(8) * height.div_ceil(8);
    let mut bits = Bits::default();
    for block in 0..blocks {
        // The first block has all of the grey, eight times its distance from the middle; the others no difference.
        let level = if block == 0 { 8 * (i32::from(grey) - 128) } else { 0 };
        let size = 32 - level.unsigned_abs().leading_zeros();
        bits.put(size, 4);
        let code = if level < 0 { level - 1 } else { level };
        bits.put(code as u32 & ((1 << size) - 1), size);
        // The end of the block.
        bits.put(0, 1);
    }
    [
        vec![0xFF, 0xD8],
        segment(0xDB, &[&[0][..], &[1; 64]].concat()),
        frame(0xC0, 8, width, height),
        segment(0xC4, &[&[0x00, 0, 0, 0, 12][..], &[0; 12], &(0..12).collect::<Vec<u8>>()].concat()),
        segment(0xC4, &[&[0x10, 1][..], &[0; 15], &[0]].concat()),
        segment(0xDA, &[1, 1, 0, 0, 63, 0]),
        bits.finish(),
        vec![0xFF, 0xD9],
    ]
    .concat()
}
