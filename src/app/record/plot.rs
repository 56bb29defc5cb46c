//! A plot, or what is compared, on its way to a PNG: drawn at once, read back in a later frame.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::app::compare::comparison::Made;
use crate::app::compare::figure::{Figure, Studio};
use crate::app::graphics_error::picture_error;
use crate::app::lettering::Lettering;
use crate::app::plot_file::PlotFile;
use crate::app::portrait::pixels;
use crate::app::state::State;
use crate::engine::{Command, Frame, Link};
use crate::render::{Picture, PictureError, ViewTarget};
use crate::report::Pixels;
use crate::say;

/// Pixels across what is compared.
const FIGURE: u32 = 2400;

/// A picture that was drawn and is read back.
pub(super) struct PlotJob {
    device: wgpu::Device,
    name: String,
    picture: Receiver<Result<Picture, PictureError>>,
}

impl PlotJob {
    /// Draws it.
    pub(super) fn begin(state: &egui_wgpu::RenderState, file: &PlotFile, name: String, theme: egui::Theme) -> Self {
        let (device, queue) = (&state.device, &state.queue);
        let (size, scale) = file.pixels(device.limits().max_texture_dimension_2d);
        let target = ViewTarget::new(device, size[0], size[1]);
        let mut lettering = Lettering::new(device);
        lettering.write(device, queue, &target, scale, theme, |ui, _| file.paint(ui.painter()));
        let (sender, picture) = channel();
        // Whoever has cancelled meanwhile takes nothing.
        Picture::read(&target, device, queue, move |picture| drop(sender.send(picture)));
        Self { device: device.clone(), name, picture }
    }

    /// Draws what is compared, once all of it is there.
    ///
    /// # Errors
    /// One sentence where it cannot be drawn.
    pub(super) fn figure(window: &egui_wgpu::RenderState, state: &State) -> Result<Self, String> {
        let document = state.document.as_ref().ok_or_else(|| say!("record-nothing"))?;
        let made = state.comparison.made().ok_or_else(|| say!("record-nothing"))?;
        let cells: Vec<Made> = made.into_iter().cloned().collect();
        // No name, which may be a patient's.
        let (title, axes) = (say!("record-figure-title"), document.import.axes);
        let figure = Figure { title: &title, name: "", axes, cells: &cells, arrangement: state.comparison.arrangement };
        let (sender, picture) = channel();
        let drawn = Studio::beside(window).take(&figure, FIGURE, move |picture| drop(sender.send(picture)));
        drawn.map_err(|error| say!("record-cannot-draw", why = error.to_string()))?;
        Ok(Self { device: window.device.clone(), name: format!("{}-compared.png", document.stem()), picture })
    }

    /// Hands the picture to the engine, which makes the file; whether it is with it.
    ///
    /// # Errors
    /// One sentence where it does not come back.
    pub(super) fn advance(&self, state: &mut State, link: &mut dyn Link) -> Result<bool, String> {
        let polled = self.device.poll(wgpu::PollType::Poll);
        polled.map_err(|error| say!("views-not-drawn", error = error.to_string()))?;
        let picture = match self.picture.try_recv() {
            Ok(picture) => picture.map_err(|error| say!("record-not-drawn", why = picture_error(&error)))?,
            Err(TryRecvError::Empty) => return Ok(false),
            Err(TryRecvError::Disconnected) => return Err(say!("record-device-gone")),
        };
        let Pixels { width, height, rgba } = pixels(picture);
        let frame = Frame { caption: String::new(), width, height, rgba };
        let command = Command::WriteFrame { name: self.name.clone(), index: 0, count: 1, has_alpha: false, frame };
        state.ask_for_file(&self.name, command, link);
        Ok(true)
    }
}
