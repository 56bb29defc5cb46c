//! The two 3-D views: one camera, moved by mouse, trackpad, touch or keys, and what is written over the pictures.

use egui::{Color32, PointerButton, Pos2, Rect, Role, Sense, Ui, pos2, vec2};
use glam::{Vec2, Vec3};

use super::arrays;
use super::assist::name;
use super::document::{Document, Revision};
use super::overlay;
use super::reveal::{Divider, Reveal};
use super::scene::{Picture, Scene, colour_map};
use super::theme;
use crate::pipeline::settings::Keep;
use crate::render::{Camera, ColourMap, Look, StandardView, pick};

/// The target of the surface as it was opened, behind the first view.
const REVEALED: usize = 2;

/// Said where the surface is not drawn because an allocation on the graphics device failed.
pub(super) const NO_MEMORY: &str = "The graphics memory is full, so this surface cannot be drawn; it is still open and can be reduced further or saved.";

/// What the views show, as the user chooses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ViewOptions {
    /// The pieces that are left out, faintly; a click keeps one of them.
    pub left_out: bool,
    /// Each triangle with its own normal.
    pub flat: bool,
    /// The hidden lines of the wireframe.
    pub see_through: bool,
    /// What the colours of the shaded view mean.
    pub colours: Colours,
    /// The surface as it was opened, where nothing can be held.
    pub before: bool,
    /// Both in one picture.
    pub reveal: Reveal,
}

/// What the colours of the shaded view mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colours {
    /// Nothing: the surface has one.
    #[default]
    None,
    /// The mean deviation from the smoothed surface around each vertex, in mm.
    Deviation,
    /// The change of calibre of the vessel beside each vertex from the opened surface, in percent.
    Calibre,
    /// What the file says of its vertices or triangles: the array of this number.
    Array(u16),
}

impl Colours {
    /// These, or none where they are shown already.
    #[must_use]
    pub fn toggled(self, other: Self) -> Self {
        if self == other { Self::None } else { other }
    }
}

/// A place that was gone to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spot {
    /// In mm.
    pub(super) at: Vec3,
    /// What there is to say of it.
    pub(super) label: String,
}

/// The views and how they are looked at.
pub struct Views {
    /// From where both look.
    pub camera: Camera,
    /// What they show.
    pub options: ViewOptions,
    /// The "before" button is held.
    pub before_is_held: bool,
    /// The surface is shown as it was opened, in this frame.
    pub show_before: bool,
    /// Between the surface as it was opened and the level, where both are shown in one picture.
    pub(super) divider: Divider,
    /// The place that a ring is drawn around.
    pub(super) spot: Option<Spot>,
    scene: Option<Scene>,
    /// Why there is nothing to see.
    failure: Option<String>,
    /// What the device had no memory for: it is not tried again.
    refused: Option<Revision>,
    device: Option<egui_wgpu::RenderState>,
    aspect: f32,
    /// The camera as it was last fitted, while the user has not moved it.
    fitted: Option<Camera>,
    /// Frames a second while something moves.
    frames_per_second: Option<f32>,
}

impl Views {
    /// Views on the window's device; without one (in some tests) they stay empty and say so.
    pub fn new(render_state: Option<&egui_wgpu::RenderState>) -> Self {
        let mut views = Self {
            camera: Camera::default(),
            options: ViewOptions::default(),
            before_is_held: false,
            show_before: false,
            divider: Divider::default(),
            spot: None,
            scene: None,
            failure: None,
            refused: None,
            device: None,
            aspect: 1.0,
            fitted: None,
            frames_per_second: None,
        };
        views.set_device(render_state);
        views
    }

    /// Takes another device, on which nothing of the views stands yet.
    pub fn set_device(&mut self, render_state: Option<&egui_wgpu::RenderState>) {
        self.device = render_state.cloned();
        // Textures of the old one are let go before any of the new are made.
        self.scene = None;
        self.failure = self.device.is_none().then(|| "There is no graphics device to draw with.".to_owned());
        self.prepare();
    }

    fn prepare(&mut self) {
        if let (None, None, Some(device)) = (&self.scene, self.refused, &self.device) {
            match Scene::new(device) {
                Ok(scene) => self.scene = Some(scene),
                Err(error) => self.failure = Some(format!("The views cannot be drawn: {error}.")),
            }
        }
    }

    /// Gives up what stands on the device, whose memory is full, until another surface or another level is shown.
    pub(super) fn refuse(&mut self, shown: Option<Revision>) {
        self.scene = None;
        self.refused = shown;
        self.failure = Some(NO_MEMORY.to_owned());
    }

    /// Tries again what the device had no memory for, once there is something else to show.
    fn retry(&mut self, document: Option<&Document>) {
        let of = |revision: Revision| (revision.document, revision.opened, revision.levels, revision.shown);
        let shown = document.map(|document| of(document.revision));
        self.refused.take_if(|refused| shown != Some(of(*refused)));
        self.prepare();
    }

    /// Brings the whole of the kept pieces into view.
    pub fn fit(&mut self, document: Option<&Document>, keep: Keep) {
        if let Some(document) = document {
            self.camera.fit(&document.bounds(keep), self.aspect);
            self.fitted = Some(self.camera);
        }
    }

    /// Takes the shape of a picture, `rows` of which stand in `rect`, for the next fit; fits anew where the picture is
    /// of another shape and the user has not moved the camera since it was fitted.
    pub(super) fn take_shape(&mut self, rect: Rect, rows: usize, document: Option<&Document>, keep: Keep) {
        let aspect = rect.width() * rows as f32 / rect.height().max(1.0);
        let changes = (aspect / self.aspect - 1.0).abs() > 1e-3;
        self.aspect = aspect;
        if changes && self.fitted == Some(self.camera) {
            self.fit(document, keep);
        }
    }

    /// Goes to a place, and near enough that `height_mm` are seen there.
    pub(super) fn go_to(&mut self, spot: Spot, height_mm: f32) {
        self.camera.focus(spot.at, height_mm);
        self.spot = Some(spot);
    }

    /// Looks at a new surface.
    pub fn look_first(&mut self, document: Option<&Document>, keep: Keep) {
        self.spot = None;
        let size = document.map_or(glam::Vec3::ZERO, |document| document.bounds(keep).size());
        self.look_from(first_view(size), document, keep);
    }

    /// Looks from a side.
    pub fn look_from(&mut self, view: StandardView, document: Option<&Document>, keep: Keep) {
        self.camera.standard_view(view);
        self.fit(document, keep);
    }

    /// Frames a second, for the status bar.
    pub fn rate(&self) -> String {
        self.frames_per_second.map_or("idle".to_owned(), |rate| format!("{rate:.0} fps"))
    }

    /// Whether the surface is shown as it was opened beside the level.
    pub fn reveals(&self, document: &Document) -> bool {
        self.options.reveal.holds(document) && document.shown.is_some() && !self.show_before
    }

    /// Shows both in one picture, or no longer.
    pub(super) fn toggle_reveal(&mut self, document: Option<&Document>) {
        let is_on = document.is_some_and(|document| self.options.reveal.holds(document));
        self.options.reveal = if is_on { Reveal::Off } else { Reveal::On };
    }

    /// Takes how fast frames come, while something moves.
    pub(super) fn measure_rate(&mut self, ui: &Ui, moves: bool) {
        self.frames_per_second = moves.then(|| 1.0 / ui.input(|input| input.stable_dt).max(1e-3));
    }

    /// Shows both views in what is left of `ui`. Returns the piece that was clicked.
    pub fn show(&mut self, ui: &mut Ui, document: Option<&Document>, keep: Keep, is_narrow: bool) -> Option<u32> {
        let moves = ui.input(|input| input.pointer.any_down() || input.smooth_scroll_delta() != egui::Vec2::ZERO);
        self.measure_rate(ui, moves);
        self.retry(document);
        if self.scene.is_some() {
            // What fails is tried again.
            self.failure = None;
        }
        if let (Some(scene), Some(document)) = (&mut self.scene, document)
            && let Err(error) = scene.follow(document, self.options.colours)
        {
            self.failure = Some(format!("The surface cannot be drawn: {error}."));
        }
        let area = ui.available_rect_before_wrap();
        let (first, second) =
            if is_narrow { area.split_top_bottom_at_fraction(0.5) } else { area.split_left_right_at_fraction(0.5) };
        self.take_shape(first, 1, document, keep);
        let shaded = if self.options.flat { Look::Flat } else { Look::Shaded };
        let lines = if self.options.see_through { Look::SeeThrough } else { Look::Wireframe };
        let mut clicked = None;
        for (index, (rect, look)) in [(first, shaded), (second, lines)].into_iter().enumerate() {
            let title = if index == 0 { "Shaded view" } else { "Wireframe view" };
            let hit = self.view(ui, index, rect.shrink(0.5), look, title, document, keep);
            clicked = clicked.or(hit);
        }
        clicked
    }

    #[expect(clippy::too_many_arguments, reason = "one call, and a struct would only name the same things again")]
    fn view(
        &mut self,
        ui: &mut Ui,
        index: usize,
        rect: Rect,
        look: Look,
        title: &str,
        document: Option<&Document>,
        keep: Keep,
    ) -> Option<u32> {
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        name(&response, Role::Image, title);
        self.steer(ui, &response, 1, document, keep);
        let pixels = rect.size() * ui.ctx().pixels_per_point();
        let mut style = theme::style(ui.visuals());
        let colours = if index == 0 && !self.show_before { self.options.colours } else { Colours::None };
        style.map = document.and_then(|document| colour_map(document, colours));
        let array = document.and_then(|document| arrays::chosen(document, colours));
        style.labels = array.is_some_and(|info| !info.labels.is_empty());
        let picture = Picture {
            camera: self.camera,
            size: [pixels.x.round().max(1.0) as u32, pixels.y.round().max(1.0) as u32],
            look,
            style,
            before: self.show_before,
            left_out: self.options.left_out,
        };
        let reveals = index == 0 && document.is_some_and(|document| self.reveals(document));
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let at = self.divider.at();
        let (opened, now) = (rect.split_left_right_at_fraction(at), whole.split_left_right_at_fraction(at));
        let before = reveals.then(|| Picture { before: true, ..picture.clone() });
        let parts = match &before {
            Some(before) => vec![(index, &picture, opened.1, now.1), (REVEALED, before, opened.0, now.0)],
            None => vec![(index, &picture, rect, whole)],
        };
        for (index, picture, rect, part) in parts {
            match self.scene.as_mut().map(|scene| scene.draw(index, picture, document, keep)) {
                Some(Ok(texture)) => {
                    ui.painter_at(rect).image(texture, rect, part, Color32::WHITE);
                }
                Some(Err(error)) => self.failure = Some(format!("The surface cannot be drawn: {error}.")),
                None => {}
            }
        }
        if let Some(failure) = &self.failure {
            let font = egui::TextStyle::Body.resolve(ui.style());
            ui.painter_at(rect).text(
                rect.center(),
                egui::Align2::CENTER_CENTER,
                failure,
                font,
                ui.visuals().text_color(),
            );
        }
        let has_scalars = self.scene.as_ref().is_some_and(Scene::has_scalars);
        let legend = style.map.filter(|_| has_scalars && array.is_none()).map(|map| legend(map, colours));
        overlay::show(
            ui,
            rect,
            &overlay::Writing {
                title: if self.show_before { "As opened" } else { title.trim_end_matches(" view") },
                name: document.map(|document| document.name.as_str()),
                camera: &self.camera,
                axes: document.map(|document| document.import.axes).unwrap_or_default(),
                legend,
                array: array.filter(|_| has_scalars),
            },
        );
        if let Some(pinch) = document.and_then(Document::pinch).filter(|_| !self.show_before) {
            let fate = if pinch.diameter_after_mm > 0.0 { "Pinched" } else { "Lost" };
            let label = format!("{fate}: {:.1} mm before", pinch.diameter_before_mm);
            overlay::ring(ui, rect, &self.camera, pinch.at_mm.into(), &label, ui.visuals().error_fg_color);
        }
        if let Some(spot) = &self.spot {
            overlay::ring(ui, rect, &self.camera, spot.at, &spot.label, ui.visuals().hyperlink_color);
        }
        if reveals {
            self.divider.show(ui, rect);
        }
        let is_click = response.clicked() && self.options.left_out;
        is_click.then(|| self.piece_at(response.interact_pointer_pos()?, rect, document?)).flatten()
    }

    /// The piece under a point of the view.
    fn piece_at(&self, at: Pos2, rect: Rect, document: &Document) -> Option<u32> {
        let ray = self.camera.ray(in_view(at, rect), rect.width() / rect.height());
        let hit = pick(&ray, &document.opened.positions, &document.opened.triangles)?;
        document.pieces.labels.get(hit.triangle).copied()
    }

    /// Moves the camera by what the hand does to the pictures in `response`, `rows` of which stand one above the other.
    pub(super) fn steer(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        rows: usize,
        document: Option<&Document>,
        keep: Keep,
    ) {
        let rect = response.rect;
        let height = (rect.height() / rows as f32).max(1.0);
        let fraction = |v: egui::Vec2| Vec2::new(v.x / height, v.y / height);
        let aspect = rect.width() / height;
        if let Some(touch) = ui.input(egui::InputState::multi_touch).filter(|touch| rect.contains(touch.center_pos)) {
            self.camera.pan(fraction(touch.translation_delta));
            self.camera.zoom(touch.zoom_delta, in_row(touch.center_pos, rect, rows), aspect);
            return;
        }
        let shift = ui.input(|input| input.modifiers.shift);
        if response.dragged_by(PointerButton::Primary) && !shift {
            self.camera.orbit(fraction(response.drag_delta()));
        } else if response.dragged() {
            self.camera.pan(fraction(response.drag_delta()));
        }
        if response.double_clicked() {
            self.fit(document, keep);
        }
        let Some(pointer) = response.hover_pos() else { return };
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        let factor = pinch * (scroll.y / 240.0).exp();
        if (factor - 1.0).abs() > 1e-4 {
            self.camera.zoom(factor, in_row(pointer, rect, rows), aspect);
        }
    }

    /// Moves the camera by keys: arrows turn, plus and minus zoom, as far in a second however many frames it has.
    pub fn steer_by_keys(&mut self, ui: &Ui) {
        use egui::Key;
        /// A drag over so many heights of the view, a second.
        const TURN: f32 = 1.2;
        /// The logarithm of what comes nearer, a second.
        const ZOOM: f32 = 1.8;
        /// Of a frame that took longer no more is made up for.
        const LONGEST: f32 = 0.1;
        let (mut turn, mut zoom) = (Vec2::ZERO, 0.0);
        let seconds = ui.input(|input| input.stable_dt).min(LONGEST);
        ui.input(|input| {
            let held = |key| f32::from(u8::from(input.key_down(key)));
            turn.x = held(Key::ArrowRight) - held(Key::ArrowLeft);
            turn.y = held(Key::ArrowDown) - held(Key::ArrowUp);
            zoom = (held(Key::Plus).max(held(Key::Equals)) - held(Key::Minus)) * ZOOM * seconds;
        });
        if turn != Vec2::ZERO {
            self.camera.orbit(turn * TURN * seconds);
            ui.ctx().request_repaint();
        }
        if zoom != 0.0 {
            self.camera.zoom(zoom.exp(), Vec2::ZERO, self.aspect);
            ui.ctx().request_repaint();
        }
    }
}

/// What the colours of a map say.
fn legend(map: ColourMap, colours: Colours) -> overlay::Legend {
    let (title, unit, decimals, note) = match colours {
        Colours::Calibre => ("Change of calibre", "%", 1, "No colour: not measured"),
        Colours::None | Colours::Deviation | Colours::Array(_) => ("Deviation, mean around", "mm", 3, ""),
    };
    overlay::Legend { map, title, unit, decimals, is_open: true, is_open_below: colours == Colours::Calibre, note }
}

/// From where a surface of this size is first seen: from the front, unless it lies on its back, as some scans are stored.
pub(super) fn first_view(size: glam::Vec3) -> StandardView {
    if size.y > size.z && size.y > size.x { StandardView::Superior } else { StandardView::Anterior }
}

/// A point of the window in normalised device coordinates of a view: -1 to 1, y up.
pub(super) fn in_view(at: Pos2, rect: Rect) -> Vec2 {
    let v = (at - rect.center()) / (rect.size() / 2.0).max(vec2(1.0, 1.0));
    Vec2::new(v.x, -v.y)
}

/// The same in that of `rows` pictures, one above the other in `rect`, in which the point is.
fn in_row(at: Pos2, rect: Rect, rows: usize) -> Vec2 {
    let height = rect.height() / rows as f32;
    let row = ((at.y - rect.top()) / height).floor().clamp(0.0, rows as f32 - 1.0);
    in_view(at, Rect::from_min_size(pos2(rect.left(), rect.top() + row * height), vec2(rect.width(), height)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_each_picture_is_its_middle() {
        let rect = Rect::from_min_size(pos2(100.0, 50.0), vec2(200.0, 400.0));
        assert_eq!(in_row(rect.center(), rect, 1), Vec2::ZERO);
        for middle in [pos2(200.0, 150.0), pos2(200.0, 350.0)] {
            assert_eq!(in_row(middle, rect, 2), Vec2::ZERO);
        }
        assert_eq!(in_row(rect.min, rect, 2), Vec2::new(-1.0, 1.0));
        assert_eq!(in_row(rect.max, rect, 2), Vec2::new(1.0, -1.0));
    }
}
