//! Files on their way to a volume, in slices of work: their beginnings are looked at, the numbers come in pieces where the
//! format allows it, and are counted.
//!
//! A header with its data is never in memory as files; text, VTI and a series of DICOM are taken in whole, and understood in
//! one piece.

use std::sync::Arc;

use super::message::{Contents, NamedFile, OpenedScan, ScanWork};
use super::shelf::{Shelf, length, piece};
use crate::io::volume::{self, HEAD, Head, Part, Scan, Stream};
use crate::language::{decimal, tell};
use crate::say;
use crate::task::{Budget, Progress, Running};
use crate::volume::{Grid, Survey, survey_in_slices};

/// Files of which more are a series, each of which is read whole.
const MAX_HEADS: usize = 4;
/// Bytes that are read at a time.
const PIECE: usize = 1 << 20;
/// Bytes that are unpacked between two looks at the clock.
const STEP: usize = 1 << 16;

/// Files that are being opened.
pub(super) struct Opening {
    /// The command's.
    pub(super) id: u64,
    files: Vec<NamedFile>,
    /// Which of their volumes.
    volume: Option<usize>,
    stage: Stage,
}

/// A volume that was opened.
pub(super) struct Found {
    pub(super) grid: Arc<Grid>,
    pub(super) opened: Box<OpenedScan>,
}

/// What is done with them now.
enum Stage {
    Beginning,
    /// The file with the numbers is at this byte, of which so many are in the piece.
    Streaming {
        stream: Box<Stream>,
        next: u64,
        piece: Vec<u8>,
        used: usize,
    },
    /// So many files are whole, and what there is of the next.
    Gathering {
        whole: Vec<Arc<Vec<u8>>>,
        current: Vec<u8>,
    },
    Surveying {
        survey: Running<'static, Survey>,
        grid: Arc<Grid>,
        opened: Box<OpenedScan>,
    },
}

impl Opening {
    /// Before the first byte.
    pub(super) fn new(id: u64, files: Vec<NamedFile>, volume: Option<usize>) -> Self {
        Self { id, files, volume, stage: Stage::Beginning }
    }

    /// The smallest number of a file that is on the shelf.
    pub(super) fn first_number(&self) -> Option<u32> {
        let number = |file: &NamedFile| match file.contents {
            Contents::Bytes(_) => None,
            Contents::Shelved { number, .. } => Some(number),
        };
        self.files.iter().filter_map(number).min()
    }

    /// What is done now.
    pub(super) fn work(&self) -> ScanWork {
        if matches!(self.stage, Stage::Surveying { .. }) { ScanWork::Surveying } else { ScanWork::Reading }
    }

    /// Goes on; the volume and what is to be said of it, once it is there.
    ///
    /// # Errors
    /// One plain sentence: a file cannot be read, or is none that can be opened.
    pub(super) fn advance(&mut self, shelf: &mut dyn Shelf, budget: Budget) -> Result<Progress<Found>, String> {
        loop {
            if let Stage::Surveying { survey, grid, opened } = &mut self.stage {
                return Ok(match survey.advance(budget) {
                    Progress::Working(fraction) => Progress::Working(fraction),
                    Progress::Done(survey) => {
                        opened.survey = survey;
                        Progress::Done(Found { grid: Arc::clone(grid), opened: opened.clone() })
                    }
                });
            }
            self.read(shelf)?;
            if budget.is_spent() {
                return Ok(Progress::Working(self.fraction()));
            }
        }
    }

    /// The part of what is done now that is done.
    fn fraction(&self) -> f32 {
        let (done, all) = match &self.stage {
            Stage::Beginning | Stage::Surveying { .. } => (0, 1),
            Stage::Streaming { stream, next, piece, used } => (next - (piece.len() - used) as u64, stream.length()),
            Stage::Gathering { whole, current } => {
                let done: u64 = whole.iter().map(|bytes| bytes.len() as u64).sum();
                (done + current.len() as u64, self.files.iter().map(length).sum())
            }
        };
        (done as f64 / all.max(1) as f64) as f32
    }

    /// Reads the next piece.
    fn read(&mut self, shelf: &mut dyn Shelf) -> Result<(), String> {
        self.stage = match std::mem::replace(&mut self.stage, Stage::Beginning) {
            Stage::Beginning => self.begin(shelf)?,
            Stage::Streaming { mut stream, next, piece: bytes, used } => {
                if used < bytes.len() && !stream.is_full() {
                    let end = bytes.len().min(used + STEP);
                    stream.push(&bytes[used..end]).map_err(|error| tell(&error))?;
                    Stage::Streaming { stream, next, piece: bytes, used: end }
                } else if next < stream.length() && !stream.is_full() {
                    let bytes = piece(shelf, &self.files[stream.file()], next, PIECE)?;
                    Stage::Streaming { stream, next: next + bytes.len() as u64, piece: bytes, used: 0 }
                } else {
                    self.survey(stream.finish().map_err(|error| tell(&error))?)
                }
            }
            Stage::Gathering { whole, current } => self.gather(shelf, whole, current)?,
            surveying @ Stage::Surveying { .. } => surveying,
        };
        Ok(())
    }

    /// Looks at the beginnings of the files.
    fn begin(&self, shelf: &mut dyn Shelf) -> Result<Stage, String> {
        let gathering = Stage::Gathering { whole: Vec::new(), current: Vec::new() };
        if self.files.len() > MAX_HEADS {
            return Ok(gathering);
        }
        let beginnings: Result<Vec<_>, _> = self.files.iter().map(|file| piece(shelf, file, 0, HEAD)).collect();
        let beginnings = beginnings?;
        let heads: Vec<Head> = self
            .files
            .iter()
            .zip(&beginnings)
            .map(|(file, bytes)| Head { name: &file.name, bytes, length: length(file) })
            .collect();
        Ok(match volume::begin(&heads).map_err(|error| tell(&error))? {
            Some(mut stream) => {
                stream.choose(self.volume);
                Stage::Streaming { next: stream.start(), stream: Box::new(stream), piece: Vec::new(), used: 0 }
            }
            None => gathering,
        })
    }

    /// Takes in the next piece of files that are read whole.
    fn gather(
        &self,
        shelf: &mut dyn Shelf,
        mut whole: Vec<Arc<Vec<u8>>>,
        mut current: Vec<u8>,
    ) -> Result<Stage, String> {
        let Some(file) = self.files.get(whole.len()) else {
            let parts: Vec<Part> =
                self.files.iter().zip(&whole).map(|(file, bytes)| Part { name: &file.name, bytes }).collect();
            return Ok(self.survey(volume::read_volume(&parts, self.volume).map_err(|error| tell(&error))?));
        };
        match &file.contents {
            Contents::Bytes(bytes) => whole.push(Arc::clone(bytes)),
            Contents::Shelved { bytes: length, .. } => {
                let full = || say!("scan-no-memory", mb = decimal(*length as f64 / 1e6, 0));
                let room = usize::try_from(*length).map_err(|_| full())?.saturating_sub(current.len());
                current.try_reserve_exact(room).map_err(|_| full())?;
                current.extend(piece(shelf, file, current.len() as u64, PIECE)?);
                if current.len() as u64 == *length {
                    whole.push(Arc::new(std::mem::take(&mut current)));
                }
            }
        }
        Ok(Stage::Gathering { whole, current })
    }

    fn survey(&self, scan: Scan) -> Stage {
        let geometry = *scan.grid.geometry();
        let grid = Arc::new(scan.grid);
        let opened = Box::new(OpenedScan {
            id: self.id,
            format: scan.format.to_owned(),
            dimensions: geometry.size,
            spacing_mm: geometry.spacing.to_array(),
            origin_mm: geometry.origin.to_array(),
            directions: geometry.direction.to_cols_array_2d(),
            axes: scan.axes,
            bytes: (grid.samples().len() * grid.samples().sample_type().size()) as u64,
            is_ct: scan.is_ct,
            survey: Survey { range: [0.0; 2], histogram: Vec::new(), labels: Vec::new() },
            proposed: None,
            warnings: scan.warnings,
            offers: scan.offers,
            taken: scan.taken,
            names: scan.names,
        });
        let surveyed = Arc::clone(&grid);
        let survey = Running::new(|yielder| async move { survey_in_slices(&surveyed, &yielder).await });
        Stage::Surveying { survey, grid, opened }
    }
}
