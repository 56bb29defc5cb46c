//! What leaves the app for the record: reports, pictures and turntables. What they show is drawn here, a picture a frame of
//! the window; the files are made by the engine, so that no frame waits for them.

pub(super) mod action;
mod job;
mod menu;
mod plot;

use std::sync::Arc;

use egui::Ui;

use super::document::Document;
use super::platform::Files;
use super::plot_file::{PlotFile, PlotFormat};
use super::state::State;
use super::views::Views;
use crate::engine::{Frame, Link};
use crate::render::Style;
use crate::report::Heading;
use crate::say;
use crate::sharing::measures::Measure;

pub use action::Action;
pub(super) use action::Chosen;
use job::Job;
pub(super) use menu::{pictures, report};
use plot::PlotJob;

/// What is being drawn, and what a user has chosen for it.
#[derive(Default)]
pub(super) struct Record {
    device: Option<egui_wgpu::RenderState>,
    job: Option<Job>,
    /// Pictures that were drawn at once and are read back.
    plots: Vec<PlotJob>,
    chosen: Chosen,
    said: Said,
}

/// What a user says of the surface that is open, for its reports. It stands in the sheet until another surface is opened, so
/// that a second report need not be written again, and is kept nowhere else: it may name a patient.
#[derive(Default)]
struct Said {
    /// Which surface it is of, counted from the first.
    surface: u64,
    case: String,
    comment: String,
}

/// What can be seen, and when.
pub(super) struct Sight<'a> {
    pub(super) views: &'a Views,
    pub(super) style: Style,
    /// The measures that are drawn in the views.
    pub(super) measures: Arc<Vec<Measure>>,
    /// Today, as ISO 8601 writes it.
    pub(super) today: String,
}

impl Record {
    /// Takes another device; what was being drawn on the old one is given up.
    pub(super) fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        self.device = device.cloned();
        self.job = None;
        self.plots.clear();
    }

    /// What a user has chosen.
    pub(super) fn chosen(&self) -> Chosen {
        self.chosen
    }

    /// What is being drawn, and the part of it that is done; `None` for nothing.
    pub(super) fn progress(&self) -> Option<(String, f32)> {
        let of_plots = (!self.plots.is_empty()).then(|| (say!("record-drawing-picture"), 0.5));
        self.job.as_ref().map(Job::progress).or(of_plots)
    }

    /// Another surface was opened: what was said of the one before is forgotten.
    pub(super) fn leave_surface(&mut self) {
        self.said = Said { surface: self.said.surface + 1, ..Said::default() };
    }

    /// Shows the sheet of the report. Returns what was clicked.
    pub(super) fn sheet(&mut self, ui: &mut Ui) -> Option<Action> {
        menu::sheet(ui, &mut self.said, self.chosen)
    }

    /// Does what is asked for.
    pub(super) fn act(&mut self, action: Action, state: &mut State, sight: &Sight<'_>) {
        match action {
            // The window has the sheet.
            Action::Describe => {}
            Action::NameFile(names_file) => self.chosen.names_file = names_file,
            Action::Clear(is_clear) => self.chosen.is_clear = is_clear,
            Action::Cancel => self.cancel(state),
            Action::Figure => {
                let device = self.device.as_ref().ok_or_else(|| say!("compare-no-device"));
                match device.and_then(|device| PlotJob::figure(device, state)) {
                    Ok(figure) => self.plots.push(figure),
                    Err(sentence) => state.warn(&sentence),
                }
            }
            Action::Report(_) | Action::Picture(_) | Action::Turntable | Action::Video | Action::Film => {
                self.cancel(state);
                let Some(document) = state.document.as_ref().filter(|document| document.shown.is_some()) else {
                    state.tell(&say!("record-nothing"));
                    return;
                };
                let begun = self.begin(action, state, document, sight);
                match begun {
                    Ok(job) => self.job = Some(job),
                    Err(sentence) => state.warn(&sentence),
                }
            }
        }
    }

    /// Saves a plot.
    pub(super) fn save_plot(&mut self, file: &PlotFile, state: &mut State, files: &mut dyn Files, ctx: &egui::Context) {
        let stem = state.document.as_ref().map_or("lumen".to_owned(), Document::stem);
        let name = |extension: &str| format!("{stem}-{}.{extension}", file.stem);
        match (file.format, &self.device) {
            (PlotFormat::Svg, _) => files.offer_file(&name("svg"), file.svg().into_bytes(), ctx),
            (PlotFormat::Png, Some(device)) => {
                self.plots.push(PlotJob::begin(device, file, name("png"), ctx.theme()));
            }
            (PlotFormat::Png, None) => state.warn(&say!("compare-no-device")),
        }
    }

    fn begin(&self, action: Action, state: &State, document: &Document, sight: &Sight<'_>) -> Result<Job, String> {
        let device = self.device.as_ref().ok_or_else(|| say!("compare-no-device"))?;
        let begun = match action {
            Action::Report(format) => {
                let heading = Heading {
                    title: self.chosen.names_file.then(|| document.title().into_owned()),
                    date: sight.today.clone(),
                    case: self.said.case.clone(),
                    comment: self.said.comment.clone(),
                };
                Job::report(device, document, state.settings.keep, format, heading, sight)
            }
            Action::Picture(scale) => Job::picture(device, document, sight, scale, self.chosen),
            Action::Film => Job::film(device, document, sight),
            Action::Video => Job::video(device, document, state.settings.keep, sight),
            _ => Job::turntable(device, document, state.settings.keep, sight),
        };
        begun.map_err(|error| say!("record-cannot-draw", why = error.to_string()))
    }

    /// Gives up what is being drawn.
    pub(super) fn cancel(&mut self, state: &mut State) {
        let plots = std::mem::take(&mut self.plots);
        let job = self.job.take();
        if let Some(name) = job.as_ref().and_then(Job::asked_for) {
            state.forget_file(name);
        }
        if job.is_some() || !plots.is_empty() {
            state.tell(&say!("record-cancelled"));
        }
    }

    /// To be called each frame: takes what was drawn and draws what comes next. Returns the name and the frames of a video that
    /// is to be made.
    pub(super) fn follow(&mut self, state: &mut State, link: &mut dyn Link) -> Option<(String, Vec<Frame>)> {
        self.plots.retain(|plot| match plot.advance(state, link) {
            Ok(is_done) => !is_done,
            Err(sentence) => {
                state.warn(&sentence);
                false
            }
        });
        match self.job.as_mut()?.advance(state, link) {
            Ok(true) => return self.job.take()?.into_video(),
            Ok(false) => {}
            Err(sentence) => {
                self.cancel(state);
                state.warn(&sentence);
            }
        }
        None
    }
}
