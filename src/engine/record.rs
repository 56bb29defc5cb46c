//! Files for the record: a report on the surface that is open, and pictures that arrive frame by frame.

use super::message::{Event, Frame};
use crate::io::{Axes, ImportReport};
use crate::pipeline::report::Report;
use crate::pipeline::run::Pipeline;
use crate::pipeline::verdict::Verdict;
use crate::prepare::Patch;
use crate::report::{Carried, Document, Heading, Picture, PictureError, Pixels, ReportFormat, Strip, Subject};
use crate::say;
use crate::sharing::Digest;
use crate::sharing::measures::Measure;

/// What is known of the surface that is open beside what the pipeline knows.
#[derive(Clone, Debug)]
pub(super) struct Origin {
    /// The hash of its file; none of a sample.
    pub(super) digest: Option<Digest>,
    /// What was found and mended.
    pub(super) import: ImportReport,
    /// Whether it can be read in another unit.
    pub(super) has_units: bool,
}

/// What a report is asked to be.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Asked {
    pub(super) format: ReportFormat,
    pub(super) heading: Heading,
    pub(super) axes: Axes,
    pub(super) measures: Vec<Measure>,
    pub(super) patches: Vec<Patch>,
    pub(super) pictures: Vec<Frame>,
}

/// A report on what `pipeline` has made, or one plain sentence on why there is none.
pub(super) fn report(name: &str, pipeline: &Pipeline, origin: &Origin, asked: Asked) -> Result<Vec<u8>, String> {
    let mut report = Report::new(name, pipeline).ok_or_else(|| say!("errors-no-result"))?;
    if report.calibre.is_none() {
        return Err(say!("errors-not-measured"));
    }
    report.axes = asked.axes;
    let verdict = Verdict::of_run(pipeline, &report, &origin.import, origin.has_units);
    let picture = |frame: Frame| {
        let Frame { caption, width, height, rgba } = frame;
        Picture::new(&caption, &Pixels { width, height, rgba }).map_err(|error| error.to_string())
    };
    let pictures = asked.pictures.into_iter().map(picture).collect::<Result<Vec<_>, _>>()?;
    let subject = Subject {
        heading: &asked.heading,
        digest: origin.digest,
        import: &origin.import,
        report: &report,
        verdict: &verdict,
        measures: &asked.measures,
        patches: &asked.patches,
    };
    let mut document = Document::new(&subject, pictures);
    if asked.format == ReportFormat::HtmlWithSurface {
        document.surface = Carried::of(pipeline, asked.axes);
    }
    Ok(asked.format.write(&document))
}

/// How long a frame of several is seen, in ms.
pub const PAUSE_MS: u16 = 80;

/// A picture on its way, frame by frame.
#[derive(Default)]
pub(super) struct Animation(Option<Strip>);

impl Animation {
    /// Takes the next of `count` frames, of which the last completes the file: the event that says so, or that it failed.
    pub(super) fn take(
        &mut self,
        name: String,
        [index, count]: [u32; 2],
        has_alpha: bool,
        frame: Frame,
    ) -> Option<Event> {
        let Frame { width, height, rgba, .. } = frame;
        let pixels = Pixels { width, height, rgba };
        let mut add = || -> Result<Option<Vec<u8>>, PictureError> {
            if index == 0 {
                self.0 = Some(Strip::begin([width, height], count, PAUSE_MS, has_alpha)?);
            }
            let Some(strip) = &mut self.0 else { return Ok(None) };
            strip.add(&pixels)?;
            if index + 1 < count { Ok(None) } else { self.0.take().map(Strip::finish).transpose() }
        };
        match add() {
            Ok(bytes) => bytes.map(|bytes| Event::Written { name, bytes, left_out: None }),
            Err(error) => {
                self.0 = None;
                Some(Event::NotWritten { name, message: error.to_string() })
            }
        }
    }
}
