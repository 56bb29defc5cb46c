//! Pictures as PNG, one or many in a row (PNG, third edition, W3C 2025: APNG is part of it).

use std::borrow::Cow;
use std::io::Write;
use std::sync::{Arc, Mutex, PoisonError};

use thiserror::Error;

use crate::pipeline::report::DISCLAIMER;
use crate::say;

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum PictureError {
    /// The pixels are not as many as the size says.
    #[error("{}", say!("report-error-size", width = .width.to_string(), height = .height.to_string(),
        bytes = .bytes.to_string()))]
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Of the pixels: four each are needed.
        bytes: usize,
    },
    /// It cannot be written.
    #[error("{}", say!("report-error-png", why = .0.to_string()))]
    Png(#[from] png::EncodingError),
}

/// Pixels: red, green, blue and alpha, from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixels {
    /// Width.
    pub width: u32,
    /// Height.
    pub height: u32,
    /// `4 * width * height` bytes.
    pub rgba: Vec<u8>,
}

/// A picture of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// What it shows.
    pub caption: String,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// As PNG: RGB of eight bits, not interlaced.
    pub png: Vec<u8>,
}

impl Picture {
    /// Of these pixels, whose alpha is left out.
    ///
    /// # Errors
    /// When there are too many pixels or too few.
    pub fn new(caption: &str, pixels: &Pixels) -> Result<Self, PictureError> {
        let mut strip = Strip::begin([pixels.width, pixels.height], 1, 0, false)?;
        strip.add(pixels)?;
        let png = strip.finish()?;
        Ok(Self { caption: caption.to_owned(), width: pixels.width, height: pixels.height, png })
    }

    /// Its compressed rows, each with its filter's number before it: what a PDF calls Flate with the predictors of PNG.
    pub(super) fn rows(&self) -> Vec<u8> {
        let mut rows = Vec::with_capacity(self.png.len());
        let mut rest = self.png.get(8..).unwrap_or_default();
        while let Some((head, behind)) = rest.split_first_chunk::<8>() {
            let [a, b, c, d, kind @ ..] = *head;
            let length = u32::from_be_bytes([a, b, c, d]) as usize;
            let Some(data) = behind.get(..length) else { break };
            if &kind == b"IDAT" {
                rows.extend_from_slice(data);
            }
            rest = behind.get(length + 4..).unwrap_or_default();
        }
        rows
    }
}

/// Frames of one size on their way to a file, which is opaque where all are.
pub struct Strip {
    size: [u32; 2],
    has_alpha: bool,
    writer: png::Writer<Sink>,
    sink: Sink,
}

impl Strip {
    /// As PNG; of more than one frame as APNG that goes round for ever, each `pause_ms` long.
    ///
    /// # Errors
    /// When there are no pixels or no frames.
    pub fn begin([width, height]: [u32; 2], frames: u32, pause_ms: u16, has_alpha: bool) -> Result<Self, PictureError> {
        let sink = Sink::default();
        let mut encoder = png::Encoder::new(sink.clone(), width, height);
        encoder.set_color(if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        for (keyword, text) in [("Software", concat!("Lumen ", env!("CARGO_PKG_VERSION"))), ("Disclaimer", DISCLAIMER)]
        {
            encoder.add_text_chunk(keyword.to_owned(), text.to_owned())?;
        }
        if frames != 1 {
            encoder.set_animated(frames, 0)?;
            encoder.set_frame_delay(pause_ms, 1000)?;
        }
        Ok(Self { size: [width, height], has_alpha, writer: encoder.write_header()?, sink })
    }

    /// Adds the next frame.
    ///
    /// # Errors
    /// When it is of another size, or one too many.
    pub fn add(&mut self, frame: &Pixels) -> Result<(), PictureError> {
        let is_whole = frame.rgba.len() as u64 == 4 * u64::from(frame.width) * u64::from(frame.height);
        if !is_whole || [frame.width, frame.height] != self.size {
            return Err(PictureError::Size { width: frame.width, height: frame.height, bytes: frame.rgba.len() });
        }
        let pixels: Cow<'_, [u8]> = if self.has_alpha {
            Cow::Borrowed(&frame.rgba)
        } else {
            frame.rgba.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect::<Vec<u8>>().into()
        };
        Ok(self.writer.write_image_data(&pixels)?)
    }

    /// The file.
    ///
    /// # Errors
    /// When frames are missing.
    pub fn finish(self) -> Result<Vec<u8>, PictureError> {
        self.writer.finish()?;
        Ok(std::mem::take(&mut *self.sink.0.lock().unwrap_or_else(PoisonError::into_inner)))
    }
}

/// Bytes that can be taken back from a writer that keeps what it writes to.
#[derive(Clone, Debug, Default)]
struct Sink(Arc<Mutex<Vec<u8>>>);

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(value: u8) -> Pixels {
        let rgba = (0..6 * 4).map(|i| if i % 4 == 3 { value } else { value.wrapping_add(7 * i) }).collect();
        Pixels { width: 3, height: 2, rgba }
    }

    #[test]
    fn a_strip_is_read_back_frame_by_frame() {
        let mut strip = Strip::begin([3, 2], 3, 80, true).unwrap();
        (1..=3).for_each(|value| strip.add(&pixels(value)).unwrap());
        let bytes = strip.finish().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let control = *reader.info().animation_control().unwrap();
        assert_eq!((control.num_frames, control.num_plays), (3, 0));
        for value in 1..=3 {
            let mut frame = vec![0; 24];
            reader.next_frame(&mut frame).unwrap();
            assert_eq!(frame, pixels(value).rgba);
        }
    }

    #[test]
    fn a_frame_of_another_size_and_a_missing_one_are_refused() {
        let mut strip = Strip::begin([3, 3], 2, 80, false).unwrap();
        assert!(matches!(strip.add(&pixels(1)), Err(PictureError::Size { width: 3, height: 2, bytes: 24 })));
        assert!(Strip::begin([0, 3], 1, 0, false).is_err());
    }

    #[test]
    fn the_rows_of_a_picture_unpack_to_its_pixels() {
        let picture = Picture::new("a", &pixels(9)).unwrap();
        let rows = miniz_oxide::inflate::decompress_to_vec_zlib(&picture.rows()).unwrap();
        // A number of a filter before each row of three pixels.
        assert_eq!(rows.len(), 2 * (1 + 9));
    }
}
