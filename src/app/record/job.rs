//! Pictures on their way: one is drawn and read back at a time, which in a browser takes some frames, and goes to the
//! engine, which makes the file.

use std::collections::VecDeque;
use std::f32::consts::TAU;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use glam::Quat;
use thiserror::Error;

use super::Sight;
use super::action::Chosen;
use crate::app::arrays;
use crate::app::deviating::Deviating;
use crate::app::document::Document;
use crate::app::graphics_error::{picture_error, surface_error};
use crate::app::options::Colours;
use crate::app::playback;
use crate::app::portrait::{
    Alone, Behind, Marks, Portrait, Pose, SIZE, Shown, camera, meaning, pixels, without_ground,
};
use crate::app::scene::{colour_map, coloured, scalars};
use crate::app::state::State;
use crate::app::views::legend;
use crate::engine::{Command, Frame, Link};
use crate::io::Axes;
use crate::mesh::TriMesh;
use crate::pipeline::settings::Keep;
use crate::render::{Camera, Look, Picture, PictureError, Style, SurfaceError};
use crate::report::{Heading, Pixels, ReportFormat};
use crate::say;

/// Pixels of the longer side of a picture, once.
pub(super) const PICTURE: u32 = 960;
/// Frames of a turntable, and the longer side of each.
const FRAMES: u32 = 48;
const TURNTABLE: u32 = 480;

/// Why nothing can be drawn.
#[derive(Debug, Error)]
pub(super) enum JobError {
    /// A surface does not fit.
    #[error("{}", surface_error(.0))]
    Surface(#[from] SurfaceError),
    /// The device draws no picture as large.
    #[error("{}", say!("record-error-too-large", limit = .0.to_string()))]
    TooLarge(u32),
}

/// A surface, with a number for each vertex if it is coloured.
type Seat = (Arc<TriMesh>, Option<Arc<[f32]>>);

/// Makes a surface once it is its turn: a film has as many as frames.
type MakeSeat = Box<dyn FnOnce() -> Seat>;

/// A picture to be drawn.
struct Shot {
    /// Of which surface; `None` for the one before.
    seat: Option<MakeSeat>,
    pose: Pose,
    caption: String,
}

/// What comes of the pictures.
enum What {
    Report {
        format: ReportFormat,
        heading: Heading,
        axes: Axes,
    },
    /// Of which the first of two is on white, the second on black.
    Picture {
        is_clear: bool,
    },
    /// Frames of a picture that moves.
    Frames {
        is_film: bool,
    },
    /// Frames of a video, which the platform makes.
    Video(Vec<Frame>),
}

/// Pictures on their way to a file.
pub(super) struct Job {
    portrait: Portrait,
    what: What,
    /// The file.
    name: String,
    shots: VecDeque<Shot>,
    count: usize,
    /// The one that was drawn and is read back, with its caption.
    reading: Option<(String, Receiver<Result<Picture, PictureError>>)>,
    taken: Vec<(String, Picture)>,
    /// Frames that the engine has.
    sent: u32,
}

impl Job {
    fn new(device: &egui_wgpu::RenderState, what: What, name: String, shots: Vec<Shot>) -> Result<Self, JobError> {
        let limit = device.device.limits().max_texture_dimension_2d;
        if shots.iter().any(|shot| shot.pose.size[0].max(shot.pose.size[1]) > limit) {
            return Err(JobError::TooLarge(limit));
        }
        let portrait = Portrait::new(&device.device, &device.queue)?;
        let (count, shots) = (shots.len(), shots.into());
        Ok(Self { portrait, what, name, shots, count, reading: None, taken: Vec::new(), sent: 0 })
    }

    /// A report, with its four pictures on white.
    pub(super) fn report(
        device: &egui_wgpu::RenderState,
        document: &Document,
        keep: Keep,
        format: ReportFormat,
        heading: Heading,
        sight: &Sight<'_>,
    ) -> Result<Self, JobError> {
        let seen = camera(&document.bounds(keep), document.import.axes, SIZE[0] as f32 / SIZE[1] as f32);
        let colours = if document.change_by_node().is_some() {
            Colours::Calibre
        } else {
            Colours::Deviation(Deviating::default())
        };
        let map = colour_map(document, colours);
        let level = level(document);
        let shot = |shown: Shown| {
            let seat = match shown {
                Shown::Opened => (kept(document, keep), None),
                Shown::Reduced | Shown::Wireframe => (level.clone(), None),
                Shown::Colours => (level.clone(), scalars(document, colours).map(|scalars| scalars.as_ref().into())),
            };
            let pose = shown.pose(seen, map, document.import.axes, &sight.measures);
            let meaning = map.as_ref().map_or(String::new(), |map| meaning(map, colours == Colours::Calibre));
            Shot { seat: Some(Box::new(move || seat)), pose, caption: shown.caption(&meaning) }
        };
        let shots =
            Shown::ALL.into_iter().filter(|&shown| shown != Shown::Colours || map.is_some()).map(shot).collect();
        let what = What::Report { format, heading, axes: document.import.axes };
        Self::new(device, what, format!("{}-report.{}", document.stem(), format.extension()), shots)
    }

    /// What the first view shows, `scale` times as large.
    pub(super) fn picture(
        device: &egui_wgpu::RenderState,
        document: &Document,
        sight: &Sight<'_>,
        scale: u32,
        chosen: Chosen,
    ) -> Result<Self, JobError> {
        let (seat, pose) = as_seen(document, sight, size(sight.views.aspect(), PICTURE * scale), scale as f32);
        let grounds = if chosen.is_clear { &[Behind::White, Behind::Black][..] } else { &[Behind::Ground] };
        let mut seat: Option<MakeSeat> = Some(Box::new(move || seat));
        let shot = |&behind: &Behind| Shot {
            seat: seat.take(),
            pose: Pose { behind, ..pose.clone() },
            caption: String::new(),
        };
        let shots = grounds.iter().map(shot).collect();
        Self::new(device, What::Picture { is_clear: chosen.is_clear }, format!("{}.png", document.stem()), shots)
    }

    /// The surface, turning once about the patient's axis.
    pub(super) fn turntable(
        device: &egui_wgpu::RenderState,
        document: &Document,
        keep: Keep,
        sight: &Sight<'_>,
    ) -> Result<Self, JobError> {
        let size = size(sight.views.aspect(), TURNTABLE);
        let (seat, pose) = as_seen(document, sight, size, 1.0);
        let turned = |i: u32| {
            let turn = Quat::from_rotation_z(TAU * i as f32 / FRAMES as f32);
            let mut camera = Camera { rotation: (turn * pose.camera.rotation).normalize(), ..pose.camera };
            camera.fit(&document.bounds(keep), size[0] as f32 / size[1] as f32);
            camera
        };
        // From as far as shows all of it all around.
        let distance = (0..FRAMES).map(|i| turned(i).distance).fold(0.0, f32::max);
        let mut seat: Option<MakeSeat> = Some(Box::new(move || seat));
        let shot = |i: u32| {
            let pose = Pose { camera: Camera { distance, ..turned(i) }, ..pose.clone() };
            Shot { seat: seat.take(), pose, caption: String::new() }
        };
        let shots = (0..FRAMES).map(shot).collect();
        Self::new(device, What::Frames { is_film: false }, format!("{}-turntable.png", document.stem()), shots)
    }

    /// The same as a video.
    pub(super) fn video(
        device: &egui_wgpu::RenderState,
        document: &Document,
        keep: Keep,
        sight: &Sight<'_>,
    ) -> Result<Self, JobError> {
        let job = Self::turntable(device, document, keep, sight)?;
        let name = format!("{}-turntable.webm", document.stem());
        Ok(Self { what: What::Video(Vec::new()), name, ..job })
    }

    /// The name and the frames of a video, where that was drawn.
    pub(super) fn into_video(self) -> Option<(String, Vec<Frame>)> {
        if let What::Video(frames) = self.what { Some((self.name, frames)) } else { None }
    }

    /// The surface as it is reduced to one triangle in a thousand and comes back, as the first view looks at it, each triangle
    /// with its own normal.
    pub(super) fn film(
        device: &egui_wgpu::RenderState,
        document: &Document,
        sight: &Sight<'_>,
    ) -> Result<Self, JobError> {
        let (_, pose) = as_seen(document, sight, size(sight.views.aspect(), TURNTABLE), 1.0);
        let levels = document.levels.as_ref().map(|(_, levels)| levels.clone()).unwrap_or_default();
        let style = Style { map: None, labels: false, ..pose.style };
        let shot = |i: u32| {
            let steps = levels.steps_to(playback::count(&levels, f64::from(i) / f64::from(FRAMES)));
            let title = playback::told(&levels, levels.triangles_after(steps));
            let marks = Marks { alone: Some(Alone { title, legend: None, array: None }), ..pose.marks.clone() };
            let levels = levels.clone();
            let seat = move || {
                let mesh = TriMesh { positions: levels.positions.clone(), triangles: levels.triangles_at(steps) };
                (Arc::new(mesh), None)
            };
            let pose = Pose { look: Look::Flat, style, marks, ..pose.clone() };
            Shot { seat: Some(Box::new(seat)), pose, caption: String::new() }
        };
        let shots = (0..FRAMES).map(shot).collect();
        Self::new(device, What::Frames { is_film: true }, format!("{}-reduction.png", document.stem()), shots)
    }

    /// What is being drawn, and the part of it that is done.
    pub(super) fn progress(&self) -> (String, f32) {
        let what = match self.what {
            What::Report { .. } => say!("record-drawing-report"),
            What::Picture { .. } => say!("record-drawing-picture"),
            What::Frames { is_film: false } | What::Video(_) => say!("record-drawing-turntable"),
            What::Frames { is_film: true } => say!("record-drawing-film"),
        };
        (what, (self.count - self.shots.len()) as f32 / self.count.max(1) as f32)
    }

    /// The file, if the engine was asked for it.
    pub(super) fn asked_for(&self) -> Option<&str> {
        (self.sent > 0).then_some(&*self.name)
    }

    /// Takes what was drawn and draws the next; whether all is with the engine.
    ///
    /// # Errors
    /// One sentence where it does not come back.
    pub(super) fn advance(&mut self, state: &mut State, link: &mut dyn Link) -> Result<bool, String> {
        self.portrait.poll()?;
        if let Some((caption, receiver)) = &self.reading {
            match receiver.try_recv() {
                Ok(picture) => {
                    let picture = picture.map_err(|error| say!("record-not-drawn", why = picture_error(&error)))?;
                    let caption = caption.clone();
                    self.reading = None;
                    self.take(caption, picture, state, link);
                }
                Err(TryRecvError::Empty) => return Ok(false),
                Err(TryRecvError::Disconnected) => return Err(say!("record-device-gone")),
            }
        }
        let Some(Shot { seat, pose, caption }) = self.shots.pop_front() else { return Ok(true) };
        if let Some((mesh, scalars)) = seat.map(|make| make()) {
            let seated = self.portrait.seat(&mesh, scalars.as_deref());
            seated.map_err(|error| say!("record-cannot-draw", why = surface_error(&error)))?;
        }
        let (sender, receiver) = channel();
        // Whoever has cancelled meanwhile takes nothing.
        self.portrait.take(&pose, move |picture| drop(sender.send(picture)));
        self.reading = Some((caption, receiver));
        Ok(false)
    }

    /// A picture has come back.
    fn take(&mut self, caption: String, picture: Picture, state: &mut State, link: &mut dyn Link) {
        match &mut self.what {
            What::Video(frames) => frames.push(frame(String::new(), pixels(picture))),
            What::Frames { .. } => {
                let frame = frame(String::new(), pixels(picture));
                self.send(frame, FRAMES, false, state, link);
            }
            What::Picture { .. } | What::Report { .. } => {
                self.taken.push((caption, picture));
                if self.shots.is_empty() {
                    self.complete(state, link);
                }
            }
        }
    }

    /// All pictures are there.
    fn complete(&mut self, state: &mut State, link: &mut dyn Link) {
        let taken = std::mem::take(&mut self.taken);
        match &self.what {
            What::Report { format, heading, axes } => {
                let pictures = taken.into_iter().map(|(caption, picture)| frame(caption, pixels(picture))).collect();
                let (name, heading) = (self.name.clone(), heading.clone());
                let measures = state.measures.to_vec();
                let patches = state.patches_for_solver();
                let (format, axes) = (*format, *axes);
                let command = Command::WriteReport { name, format, heading, axes, measures, patches, pictures };
                state.ask_for_file(&self.name, command, link);
            }
            What::Picture { is_clear } => {
                let is_clear = *is_clear;
                let pixels = match &taken[..] {
                    [(_, white), (_, black)] => Some(without_ground(white, black)),
                    _ => taken.into_iter().next().map(|(_, picture)| pixels(picture)),
                };
                if let Some(pixels) = pixels {
                    self.send(frame(String::new(), pixels), 1, is_clear, state, link);
                }
            }
            What::Frames { .. } | What::Video(_) => {}
        }
    }

    fn send(&mut self, frame: Frame, count: u32, has_alpha: bool, state: &mut State, link: &mut dyn Link) {
        let command = Command::WriteFrame { name: self.name.clone(), index: self.sent, count, has_alpha, frame };
        if self.sent == 0 {
            state.ask_for_file(&self.name, command, link);
        } else {
            link.send(command);
        }
        self.sent += 1;
    }
}

fn frame(caption: String, Pixels { width, height, rgba }: Pixels) -> Frame {
    Frame { caption, width, height, rgba }
}

/// Width and height of a picture of this form whose longer side is so many pixels.
fn size(aspect: f32, longer: u32) -> [u32; 2] {
    let of = |part: f32| ((longer as f32 * part).round() as u32).max(1);
    if aspect >= 1.0 { [longer, of(1.0 / aspect)] } else { [of(aspect), longer] }
}

/// The level as the first view shows it, with `scale` pixels to a point.
fn as_seen(document: &Document, sight: &Sight<'_>, size: [u32; 2], scale: f32) -> (Seat, Pose) {
    let (views, style) = (sight.views, sight.style);
    let colours = views.options.colours;
    let scalars: Option<Arc<[f32]>> = match colours {
        Colours::None => None,
        _ => scalars(document, colours).map(|scalars| scalars.as_ref().into()),
    };
    let theme = if style == Style::DARK { egui::Theme::Dark } else { egui::Theme::Light };
    let style = coloured(style, scalars.is_some().then_some(document), colours);
    let look = if views.options.flat { Look::Flat } else { Look::Shaded };
    let array = arrays::chosen(document, colours).filter(|_| scalars.is_some());
    let map = style.map.filter(|_| array.is_none() && !style.labels);
    let alone = Alone { title: String::new(), legend: map.map(|map| legend(map, colours)), array: array.cloned() };
    let measures = sight.measures.clone();
    let marks = Marks { axes: document.import.axes, scale, theme, measures, alone: Some(alone) };
    let style = Style { raking: views.options.raking, occlusion: views.options.occlusion, ..style };
    let pose = Pose { camera: views.camera, size, look, style, behind: Behind::Ground, marks };
    ((level(document), scalars), pose)
}

/// The level that is shown, over the nodes of all levels.
fn level(document: &Document) -> Arc<TriMesh> {
    let of = document.levels.as_ref().zip(document.shown.as_ref());
    Arc::new(of.map_or_else(TriMesh::default, |((_, levels), shown)| TriMesh {
        positions: levels.positions.clone(),
        triangles: shown.level.triangles.clone(),
    }))
}

/// The pieces that are kept, as opened.
fn kept(document: &Document, keep: Keep) -> Arc<TriMesh> {
    if keep == Keep::All || document.pieces.labels.is_empty() {
        return document.opened.clone();
    }
    Arc::new(document.opened.filtered(|t| document.pieces.keeps(keep, t)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_the_form_of_the_view() {
        assert_eq!((size(2.0, 960), size(0.5, 960), size(1.0, 480)), ([960, 480], [480, 960], [480, 480]));
    }
}
