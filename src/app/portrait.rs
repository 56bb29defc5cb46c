//! Pictures of a surface for files: drawn apart from what the views show, in the size that is asked for.

use std::sync::Arc;

use crate::mesh::{Bounds, TriMesh};
use crate::render::{
    Backdrop, Camera, Colour, ColourMap, Drawable, GpuSurface, Look, Picture, PictureError, Renderer, Style,
    SurfaceError, ViewTarget,
};

use super::lettering::Lettering;
use super::measure;
use super::overlay::{self, Writing};
use super::scene::upload;
use super::sides::{first_view, stand};
use crate::io::Axes;
use crate::language::{decimal, signed};
use crate::mesh::ArrayInfo;
use crate::report::Pixels;
use crate::say;
use crate::sharing::measures::Measure;

/// What is behind the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Behind {
    /// What is behind it in the views.
    Ground,
    /// White.
    White,
    /// Black.
    Black,
}

impl Behind {
    /// The style with this behind the surface.
    fn of(self, style: Style) -> Style {
        let colour = match self {
            Self::Ground => return style,
            Self::White => Colour([255; 3]),
            Self::Black => Colour([0; 3]),
        };
        Style { background_top: colour, background_bottom: colour, ..style }
    }
}

/// What is written over a picture.
#[derive(Clone, Debug)]
pub(super) struct Marks {
    /// Which way the patient lies, as far as that is known.
    pub(super) axes: Axes,
    /// Pixels to a point.
    pub(super) scale: f32,
    /// The theme whose letters they are.
    pub(super) theme: egui::Theme,
    /// Measures, drawn as in the views.
    pub(super) measures: Arc<Vec<Measure>>,
    /// What else stands in a picture of its own; in a report it stands beside it.
    pub(super) alone: Option<Alone>,
}

/// What is written over a picture that stands alone, beside scale and axes: what its colours mean, and that it is not for
/// clinical decisions. No name, which may be a patient's.
#[derive(Clone, Debug)]
pub(super) struct Alone {
    /// What it shows.
    pub(super) title: String,
    /// The colours of a map.
    pub(super) legend: Option<overlay::Legend>,
    /// The array that has the colours.
    pub(super) array: Option<ArrayInfo>,
}

impl Marks {
    fn write(&self, ui: &egui::Ui, rect: egui::Rect, camera: &Camera) {
        let axes = self.axes;
        measure::draw(ui, rect, camera, &self.measures);
        let Some(Alone { title, legend, array }) = &self.alone else {
            return overlay::scale_and_axes(ui, rect, camera, axes);
        };
        let writing = Writing {
            title,
            name: Some(""),
            camera,
            axes,
            legend: legend.clone(),
            array: array.as_ref(),
            is_alone: true,
        };
        overlay::show(ui, rect, &writing);
    }
}

/// How a surface is drawn.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub(super) camera: Camera,
    /// In pixels; brought within what the device allows.
    pub(super) size: [u32; 2],
    pub(super) look: Look,
    pub(super) style: Style,
    pub(super) behind: Behind,
    pub(super) marks: Marks,
}

/// A surface in GPU memory, and what draws it.
pub(super) struct Portrait {
    device: wgpu::Device,
    queue: wgpu::Queue,
    renderer: Renderer,
    surface: GpuSurface,
    lettering: Lettering,
}

impl Portrait {
    /// On a device.
    ///
    /// # Errors
    /// When it does not allow a buffer.
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self, SurfaceError> {
        let (device, queue) = (device.clone(), queue.clone());
        let (renderer, surface) = (Renderer::new(&device, &queue), GpuSurface::new(&device, &queue, &[])?);
        let lettering = Lettering::new(&device);
        Ok(Self { device, queue, renderer, surface, lettering })
    }

    /// Takes a surface in place of the one before, with a number for each vertex if there are colours to show.
    ///
    /// # Errors
    /// When it does not fit into the memory that the device allows.
    pub(super) fn seat(&mut self, mesh: &TriMesh, scalars: Option<&[f32]>) -> Result<(), SurfaceError> {
        upload(&self.device, &self.queue, &mut self.surface, mesh)?;
        self.surface.set_scalars(&self.device, &self.queue, scalars)
    }

    /// Draws the surface, and writes over it.
    pub(super) fn draw(&mut self, pose: &Pose) -> ViewTarget {
        let target = ViewTarget::new(&self.device, pose.size[0], pose.size[1]);
        let subject = Drawable { surface: &self.surface, look: pose.look, tint: None };
        let style = pose.behind.of(pose.style);
        let mut encoder =
            self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("portrait") });
        self.renderer.draw(&mut encoder, &target, &pose.camera, &[&Backdrop, &subject], &style);
        self.queue.submit([encoder.finish()]);
        let Marks { scale, theme, .. } = pose.marks;
        let write = |ui: &egui::Ui, rect| pose.marks.write(ui, rect, &pose.camera);
        self.lettering.write(&self.device, &self.queue, &target, scale, theme, write);
        target
    }

    /// Draws the surface and hands the picture to `then`, in a later frame.
    pub(super) fn take(
        &mut self,
        pose: &Pose,
        then: impl FnOnce(Result<Picture, PictureError>) + wgpu::WasmNotSend + 'static,
    ) {
        let target = self.draw(pose);
        Picture::read(&target, &self.device, &self.queue, then);
    }

    /// Lets the device hand over what it has drawn; a browser does that by itself.
    pub(super) fn poll(&self) -> Result<(), String> {
        let polled = self.device.poll(wgpu::PollType::Poll);
        polled.map(drop).map_err(|error| say!("views-not-drawn", error = error.to_string()))
    }
}

/// A camera that sees all of a surface from the front, in pictures of this form (width over height).
pub(super) fn camera(bounds: &Bounds, axes: Axes, aspect: f32) -> Camera {
    let mut camera = Camera::default();
    stand(&mut camera, first_view(bounds.size()), axes);
    camera.fit(bounds, aspect);
    camera
}

/// Size of a report's pictures in pixels.
pub(super) const SIZE: [u32; 2] = [640, 720];

/// What is written over the pictures of a report, four of which stand in a row: letters of twice the size can be read there.
fn report_marks(axes: Axes, measures: Arc<Vec<Measure>>) -> Marks {
    Marks { axes, scale: 2.0, theme: egui::Theme::Light, measures, alone: None }
}

/// The four pictures of a report: what each shows, and which surface, look and colours that takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shown {
    /// As opened.
    Opened,
    /// As reduced.
    Reduced,
    /// Its triangles.
    Wireframe,
    /// Its colours.
    Colours,
}

impl Shown {
    /// In their order.
    pub(super) const ALL: [Self; 4] = [Self::Opened, Self::Reduced, Self::Wireframe, Self::Colours];

    /// How it is drawn on white, seen by `camera`; `map` is what the colours mean, `axes` which way the patient lies. The
    /// measures are drawn on the plain surfaces, where they hide neither triangles nor colours.
    pub(super) fn pose(self, camera: Camera, map: Option<ColourMap>, axes: Axes, measures: &Arc<Vec<Measure>>) -> Pose {
        let look = if self == Self::Wireframe { Look::Wireframe } else { Look::Shaded };
        let map = map.filter(|_| self == Self::Colours);
        // It would darken colours that the legend explains, and lines have nothing to be darkened by.
        let is_plain = matches!(self, Self::Opened | Self::Reduced);
        let style = Style { map, unknown: Some(Style::UNKNOWN), occlusion: is_plain, ..Style::LIGHT };
        let marks = report_marks(axes, if is_plain { measures.clone() } else { Arc::default() });
        Pose { camera, size: SIZE, look, style, behind: Behind::White, marks }
    }

    /// What it shows; `colours` is what the colours mean.
    pub(super) fn caption(self, colours: &str) -> String {
        match self {
            Self::Opened => say!("views-as-opened"),
            Self::Reduced => say!("views-reduced"),
            Self::Wireframe => say!("views-triangles"),
            Self::Colours => colours.to_owned(),
        }
    }
}

/// What the colours of a map mean, with their range.
pub(super) fn meaning(map: &ColourMap, is_calibre: bool) -> String {
    let (from, to) = map.range;
    if is_calibre {
        say!("views-calibre-meaning", from = signed(from, 1), to = signed(to, 1))
    } else {
        say!("views-deviation-meaning", from = decimal(from, 2), to = decimal(to, 2))
    }
}

/// A picture as a report or a file takes it.
pub(super) fn pixels(picture: Picture) -> Pixels {
    let Picture { width, height, rgba } = picture;
    Pixels { width, height, rgba }
}

/// What is before any ground, from the same on white and on black: what is a part `a` of a colour `c` is `a c` on black and
/// `a c + 1 - a` on white, in each channel.
pub(super) fn without_ground(white: &Picture, black: &Picture) -> Pixels {
    let one = |(white, black): (&[u8], &[u8])| {
        let difference = (0..3).map(|i| u32::from(white[i].saturating_sub(black[i]))).sum::<u32>();
        let alpha = 255 - ((difference + 1) / 3).min(255);
        let colour = |i: usize| (u32::from(black[i]) * 255 + alpha / 2).checked_div(alpha).unwrap_or(0).min(255) as u8;
        [colour(0), colour(1), colour(2), alpha as u8]
    };
    let rgba = white.rgba.chunks_exact(4).zip(black.rgba.chunks_exact(4)).flat_map(one).collect();
    Pixels { width: white.width, height: white.height, rgba }
}

#[cfg(not(target_arch = "wasm32"))]
pub use native::report_pictures;

/// What needs to wait for the device.
#[cfg(not(target_arch = "wasm32"))]
mod native {
    use std::sync::Arc;

    use super::{Portrait, SIZE, Shown, camera, meaning, pixels};
    use crate::app::compare::figure::{FigureError, Studio};
    use crate::io::Axes;
    use crate::mesh::TriMesh;
    use crate::render::{ColourMap, Picture};
    use crate::report::Pixels;

    /// The four pictures of a report, with their captions, drawn without a window: of the surface as opened, and of the
    /// reduced one with its deviation in mm at each vertex (none where that is not known); `axes` say which way the patient
    /// lies, as far as that is known.
    ///
    /// # Errors
    /// When there is no device, or it does not allow surfaces of that size.
    pub fn report_pictures(
        opened: &TriMesh,
        reduced: &TriMesh,
        deviation: Option<(&[f32], f32)>,
        axes: Axes,
    ) -> Result<Vec<(String, Pixels)>, FigureError> {
        let studio = Studio::open()?;
        let (device, queue) = studio.device();
        let mut portrait = Portrait::new(device, queue)?;
        let map = deviation.map(|(_, most)| ColourMap { range: (0.0, most.max(1e-6)) });
        let seen = camera(&reduced.bounds(), axes, SIZE[0] as f32 / SIZE[1] as f32);
        let mut pictures = Vec::new();
        for shown in Shown::ALL {
            if shown == Shown::Colours && map.is_none() {
                continue;
            }
            let scalars = deviation.map(|(scalars, _)| scalars).filter(|_| shown == Shown::Colours);
            portrait.seat(if shown == Shown::Opened { opened } else { reduced }, scalars)?;
            let picture =
                Picture::read_now(&portrait.draw(&shown.pose(seen, map, axes, &Arc::default())), device, queue)?;
            let colours = map.as_ref().map_or(String::new(), |map| meaning(map, false));
            pictures.push((shown.caption(&colours), pixels(picture)));
        }
        Ok(pictures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_before_white_and_black_is_told_from_them() {
        let picture = |pixel: [u8; 4]| Picture { width: 1, height: 1, rgba: pixel.to_vec() };
        let found = |white, black| without_ground(&picture(white), &picture(black)).rgba;
        assert_eq!(found([200, 100, 50, 255], [200, 100, 50, 255]), [200, 100, 50, 255]);
        assert_eq!(found([255, 255, 255, 255], [0, 0, 0, 255])[3], 0);
        // Half of (200, 100, 50).
        let half = found([228, 178, 153, 255], [100, 50, 25, 255]);
        assert!((i32::from(half[3]) - 128).abs() <= 1 && (i32::from(half[0]) - 200).abs() <= 2, "{half:?}");
    }
}
