//! A volume out of the pieces of its file, one after another: no more of the file is in memory than a piece, and whoever reads
//! can tell how far it is, and stop.
//!
//! The beginning of the files says where the numbers stand ([`begin`]); from there on they are pushed. Text, VTI and DICOM are
//! read whole.

use std::io::{self, Write};

use flate2::write::{MultiGzDecoder, ZlibDecoder};

use super::error::ScanError;
use super::headers::{Way, content};
use super::numbers::{Layout, Packing};
use super::outline::{Outline, Scan};
use super::parts::{Head, Part};
use lumen_volume::Samples;

/// A volume whose numbers are on their way.
pub struct Stream {
    outline: Outline,
    source: Source,
    /// The length of the file that the numbers stand in.
    length: u64,
}

/// What the pieces go through.
enum Source {
    Plain(Sink),
    Gzip(MultiGzDecoder<Sink>),
    Zlib(ZlibDecoder<Sink>),
}

/// Where the unpacked bytes end.
struct Sink {
    layout: Layout,
    samples: Samples,
    skip: u64,
    /// The beginning of a number whose end is to come.
    rest: Vec<u8>,
    failure: Option<ScanError>,
}

/// Begins with the volume in files whose beginnings are known; `None` where they have to be read whole.
///
/// # Errors
/// [`ScanError`]: a header is broken, or what it says does not fit with the length of its file.
pub fn begin(heads: &[Head]) -> Result<Option<Stream>, ScanError> {
    let found = heads.iter().enumerate().find_map(|(at, head)| content(head.bytes).map(|content| (at, content)));
    let Some((header, content)) = found else { return Ok(None) };
    let Way::Pieces(outline) = Way::of(content, header, heads)? else { return Ok(None) };
    let head = heads[outline.file];
    // The header may go on beyond what is known of it.
    let is_whole = |head: &Head| head.length == head.bytes.len() as u64;
    let is_known = heads.iter().all(|head| is_whole(head) || outline.start < head.bytes.len() as u64);
    if outline.packing == Packing::Text || !is_known {
        return Ok(None);
    }
    Stream::new(*outline, head.length).map(Some)
}

/// Reads the volume of `outline` out of whole files.
pub(super) fn read_whole(outline: Outline, parts: &[Part]) -> Result<Scan, ScanError> {
    let bytes = parts[outline.file].bytes;
    let start = usize::try_from(outline.start).unwrap_or(usize::MAX).min(bytes.len());
    if outline.packing == Packing::Text {
        let samples = outline.layout.take_text(&bytes[start..])?;
        return outline.finish(samples);
    }
    let mut stream = Stream::new(outline, bytes.len() as u64)?;
    stream.push(&bytes[start..])?;
    stream.finish()
}

impl Stream {
    fn new(outline: Outline, length: u64) -> Result<Self, ScanError> {
        let (layout, packing) = (outline.layout, outline.packing);
        layout.check_packed(packing, length.saturating_sub(outline.start), outline.skipped)?;
        let mut sink = Sink::new(layout, outline.skipped);
        let source = match packing {
            Packing::Gzip => Source::Gzip(MultiGzDecoder::new(sink)),
            Packing::Zlib => Source::Zlib(ZlibDecoder::new(sink)),
            Packing::Plain | Packing::Text => {
                let there = length.saturating_sub(outline.start).saturating_sub(outline.skipped);
                if there < layout.bytes() {
                    return Err(layout.cut_short(there));
                }
                layout.make_room(&mut sink.samples, layout.points)?;
                Source::Plain(sink)
            }
        };
        Ok(Self { outline, source, length })
    }

    /// Takes volume number `choice` of a file that holds several, from 0.
    pub fn choose(&mut self, choice: Option<usize>) {
        self.outline.layers.choice = choice;
    }

    /// Which of the files is to be pushed.
    pub fn file(&self) -> usize {
        self.outline.file
    }

    /// From which byte on.
    pub fn start(&self) -> u64 {
        self.outline.start
    }

    /// The length of that file in bytes.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Whether all numbers are there; what follows them does not matter.
    pub fn is_full(&self) -> bool {
        self.source.sink().is_full()
    }

    /// Takes the next bytes of the file.
    ///
    /// # Errors
    /// [`ScanError`]: they are damaged, or there is no memory for the numbers in them.
    pub fn push(&mut self, piece: &[u8]) -> Result<(), ScanError> {
        let written = match &mut self.source {
            Source::Plain(sink) => sink.write_all(piece),
            // What stands before the damage counts, wherever pieces end.
            Source::Gzip(decoder) => decoder.write_all(piece).inspect_err(|_| drop(decoder.try_finish())),
            Source::Zlib(decoder) => decoder.write_all(piece).inspect_err(|_| drop(decoder.try_finish())),
        };
        let sink = self.source.sink_mut();
        match (sink.failure.take(), written) {
            (Some(failure), _) => Err(failure),
            (None, Err(_)) if !sink.is_full() => Err(self.outline.layout.damaged()),
            (None, _) => Ok(()),
        }
    }

    /// The volume, once all bytes of the file were pushed or it is full.
    ///
    /// # Errors
    /// [`ScanError`]: numbers are missing, or make no volume with what the header says.
    pub fn finish(mut self) -> Result<Scan, ScanError> {
        let ended = match &mut self.source {
            Source::Plain(_) => Ok(()),
            Source::Gzip(decoder) => decoder.try_finish(),
            Source::Zlib(decoder) => decoder.try_finish().map(|_| ()),
        };
        let layout = self.outline.layout;
        let sink = self.source.sink_mut();
        if let Some(failure) = sink.failure.take() {
            return Err(failure);
        }
        if !sink.is_full() {
            let found = (sink.samples.len() * layout.scalar.size() + sink.rest.len()) as u64;
            return Err(if ended.is_err() { layout.damaged() } else { layout.cut_short(found) });
        }
        let samples = std::mem::replace(&mut sink.samples, layout.begin());
        self.outline.finish(samples)
    }
}

impl Source {
    fn sink(&self) -> &Sink {
        match self {
            Self::Plain(sink) => sink,
            Self::Gzip(decoder) => decoder.get_ref(),
            Self::Zlib(decoder) => decoder.get_ref(),
        }
    }

    fn sink_mut(&mut self) -> &mut Sink {
        match self {
            Self::Plain(sink) => sink,
            Self::Gzip(decoder) => decoder.get_mut(),
            Self::Zlib(decoder) => decoder.get_mut(),
        }
    }
}

impl Sink {
    fn new(layout: Layout, skip: u64) -> Self {
        Self { layout, samples: layout.begin(), skip, rest: Vec::new(), failure: None }
    }

    fn is_full(&self) -> bool {
        self.samples.len() == self.layout.points
    }

    fn take(&mut self, mut bytes: &[u8]) -> Result<(), ScanError> {
        let skipped = self.skip.min(bytes.len() as u64);
        self.skip -= skipped;
        bytes = &bytes[skipped as usize..];
        let size = self.layout.scalar.size();
        if !self.rest.is_empty() {
            let more = (size - self.rest.len()).min(bytes.len());
            self.rest.extend_from_slice(&bytes[..more]);
            bytes = &bytes[more..];
            if self.rest.len() == size {
                self.layout.add(&mut self.samples, &self.rest)?;
                self.rest.clear();
            }
        }
        let (words, rest) = bytes.split_at(bytes.len() - bytes.len() % size);
        self.layout.add(&mut self.samples, words)?;
        self.rest.extend_from_slice(rest);
        Ok(())
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.take(bytes) {
            Ok(()) => Ok(bytes.len()),
            Err(failure) => {
                self.failure = Some(failure);
                Err(io::ErrorKind::OutOfMemory.into())
            }
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
