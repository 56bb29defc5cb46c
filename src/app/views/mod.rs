//! The two 3-D views: one camera, and what both show. What each of them draws and is written over it is in `picture`, how
//! the camera is moved in `steering`, and when they draw less in `motion`.

mod motion;
mod picture;
mod steering;

use std::sync::Arc;

use egui::{Rect, Ui};
use glam::Vec3;

use self::motion::{Light, Motion};
pub(super) use self::picture::legend;
use super::action::Action;
use super::collapses::Collapses;
use super::document::{Document, Revision};
use super::flight::Flight;
use super::measure::{self, Measuring};
use super::options::ViewOptions;
use super::reveal::{Divider, Reveal};
use super::scan::outline::Outlines;
use super::scan::slices::{KeptScan, SlicePicture};
use super::scene::Scene;
use super::sides::{first_view, stand};
use super::tabs;
use super::theme;
use crate::app::graphics_error::surface_error;
use crate::language::{Key, decimal};
use crate::pipeline::settings::Keep;
use crate::render::{Camera, Look, StandardView};
use crate::say;
use crate::sharing::measures::Measure;

/// From so many times as wide as high on, room that is narrow is split from left to right.
const WIDE: f32 = 1.5;

/// Said where the surface is not drawn because an allocation on the graphics device failed.
pub(super) const NO_MEMORY: Key = Key("views-no-memory");

/// A place that was gone to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spot {
    /// In mm.
    pub(super) at: Vec3,
    /// What there is to say of it.
    pub(super) label: String,
    /// The stretch that it lies in, where that is marked, in mm.
    pub(super) along: Vec<Vec3>,
    /// What that is measured by, in mm, and what there is to say of it.
    pub(super) beside: Vec<(Vec3, String)>,
}

impl Spot {
    /// A place by itself, in mm.
    pub(super) fn new(at_mm: [f32; 3], label: String) -> Self {
        Self { at: at_mm.into(), label, along: Vec::new(), beside: Vec::new() }
    }
}

/// What a click in a view asks for.
pub(super) enum Clicked {
    /// To keep this piece.
    Piece(u32),
    /// A vertex, by its node.
    Vertex(u32),
    /// To look at a place.
    Place(Action),
    /// Something of what is measured.
    Measure(measure::action::Action),
}

/// What the views show.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    /// What is open.
    pub(super) document: Option<&'a Document>,
    /// The pieces that are kept.
    pub(super) keep: Keep,
    /// What was measured.
    pub(super) measures: &'a [Measure],
}

/// What lies over the pictures.
pub(super) struct Over<'a> {
    /// Measures and clip plane.
    pub(super) measuring: &'a mut Measuring,
    /// Whether the hand may measure.
    pub(super) is_measuring: bool,
    /// The collapses, one by one.
    pub(super) collapses: &'a Collapses,
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
    /// The one that is large where there is room for one alone: 0 shaded, 1 wireframe.
    large: usize,
    /// Between the surface as it was opened and the level, where both are shown in one picture.
    pub(super) divider: Divider,
    /// The slices behind the surface, and the surface's outlines in them, where these are shown.
    slices: Vec<Arc<SlicePicture>>,
    outlines: Option<Outlines>,
    /// The place that a ring is drawn around.
    pub(super) spot: Option<Spot>,
    scene: Option<Scene>,
    /// Why there is nothing to see.
    failure: Option<String>,
    /// What the device had no memory for: it is not tried again.
    refused: Option<Revision>,
    device: Option<egui_wgpu::RenderState>,
    aspect: f32,
    /// Where the first view that is shown stands, in points.
    first: Rect,
    /// The camera as it was last fitted, while the user has not moved it.
    fitted: Option<Camera>,
    /// The way to a place that the camera is on.
    flight: Option<Flight>,
    /// Whether it flies there; otherwise it is there at once.
    flies: bool,
    /// Frames a second while something moves.
    frames_per_second: Option<f32>,
    motion: Motion<Revision>,
    /// What pictures are to be like, while they are light.
    light: Option<Light>,
}

impl Views {
    /// Views on the window's device; without one (in some tests) they stay empty and say so.
    pub fn new(render_state: Option<&egui_wgpu::RenderState>) -> Self {
        let mut views = Self {
            camera: Camera::default(),
            options: ViewOptions::default(),
            before_is_held: false,
            show_before: false,
            large: 0,
            divider: Divider::default(),
            slices: Vec::new(),
            outlines: None,
            spot: None,
            scene: None,
            failure: None,
            refused: None,
            device: None,
            aspect: 1.0,
            first: Rect::NOTHING,
            fitted: None,
            flight: None,
            flies: false,
            frames_per_second: None,
            motion: Motion::new(Camera::default()),
            light: None,
        };
        views.options.occlusion = render_state.is_some_and(draws_fast);
        views.set_device(render_state);
        views
    }

    /// Takes another device, on which nothing of the views stands yet.
    pub fn set_device(&mut self, render_state: Option<&egui_wgpu::RenderState>) {
        self.device = render_state.cloned();
        // Textures of the old one are let go before any of the new are made.
        self.scene = None;
        self.failure = self.device.is_none().then(|| say!("views-no-device"));
        self.prepare();
    }

    fn prepare(&mut self) {
        if let (None, None, Some(device)) = (&self.scene, self.refused, &self.device) {
            match Scene::new(device) {
                Ok(scene) => self.scene = Some(scene),
                Err(error) => self.failure = Some(say!("views-failed", error = surface_error(&error))),
            }
        }
    }

    /// Gives up what stands on the device, whose memory is full, until another surface or another level is shown.
    pub(super) fn refuse(&mut self, shown: Option<Revision>) {
        self.scene = None;
        self.refused = shown;
        self.failure = Some(NO_MEMORY.say());
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
            self.flight = None;
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
        if changes && self.is_fitted() {
            self.fit(document, keep);
        }
    }

    /// Whether the kept pieces are in view as they were brought there: the user looks at no place of their own.
    pub(super) fn is_fitted(&self) -> bool {
        self.fitted == Some(self.camera) && self.flight.is_none()
    }

    /// Looks from elsewhere at once, and marks nothing.
    pub(super) fn stand_at(&mut self, camera: Camera) {
        (self.camera, self.flight, self.spot) = (camera, None, None);
    }

    /// Goes to a place, and near enough that `height_mm` are seen there.
    pub(super) fn go_to(&mut self, spot: Spot, height_mm: f32) {
        self.fly(spot.at, height_mm);
        self.spot = Some(spot);
    }

    /// Looks at a place from as near as `height_mm` fill the height of the view there: the camera flies there, or is there
    /// at once where less motion is asked for.
    pub(super) fn fly(&mut self, at: Vec3, height_mm: f32) {
        let mut to = self.camera;
        to.focus(at, height_mm);
        self.fly_to(to);
    }

    fn fly_to(&mut self, to: Camera) {
        self.flight = self.flies.then(|| Flight::new(self.camera, to));
        if !self.flies {
            self.camera = to;
        }
    }

    /// Whether the camera is on its way.
    pub(super) fn is_flying(&self) -> bool {
        self.flight.is_some()
    }

    /// Moves the camera on along its way; `flies` says whether it is to fly from now on.
    pub(super) fn follow_flight(&mut self, ctx: &egui::Context, flies: bool) {
        self.flies = flies;
        let dt_s = ctx.input(|input| input.stable_dt);
        let camera = &mut self.camera;
        self.flight.take_if(|flight| !flight.advance(camera, dt_s));
        if self.flight.is_some() {
            ctx.request_repaint();
        }
    }

    /// Looks at a new surface.
    pub fn look_first(&mut self, document: Option<&Document>, keep: Keep) {
        (self.spot, self.options.fault) = (None, None);
        let size = document.map_or(glam::Vec3::ZERO, |document| document.bounds(keep).size());
        self.look_from(first_view(size), document, keep);
    }

    /// Looks from a side.
    pub fn look_from(&mut self, view: StandardView, document: Option<&Document>, keep: Keep) {
        stand(&mut self.camera, view, document.map(|document| document.import.axes).unwrap_or_default());
        self.fit(document, keep);
    }

    /// Where the first view that is shown stands, in points.
    pub(super) fn first(&self) -> Rect {
        self.first
    }

    /// Width of the first view over its height.
    pub(super) fn aspect(&self) -> f32 {
        self.aspect
    }

    /// Frames a second, for the status bar.
    pub fn rate(&self) -> String {
        self.frames_per_second.map_or_else(|| say!("views-idle"), |rate| say!("views-rate", rate = decimal(rate, 0)))
    }

    /// Shows both in one picture.
    pub(super) fn reveal(&mut self) {
        self.options.reveal = Reveal::Association;
    }

    /// Whether the surface is shown as it was opened beside the level.
    pub fn reveals(&self, document: &Document) -> bool {
        self.options.reveal.holds(document) && document.shown.is_some() && !self.show_before
    }

    /// Whether view `index` is split so.
    fn splits(&self, index: usize, document: Option<&Document>) -> bool {
        (index == 0 || self.options.reveal_lines) && document.is_some_and(|document| self.reveals(document))
    }

    /// Shows both in one picture, or no longer.
    pub(super) fn toggle_reveal(&mut self, document: Option<&Document>) {
        let is_on = document.is_some_and(|document| self.options.reveal.holds(document));
        self.options.reveal = if is_on { Reveal::Off } else { Reveal::Association };
    }

    /// Lets something else say where the camera goes: it flies there.
    pub(super) fn led_by<T>(&mut self, lead: impl FnOnce(&mut Camera) -> T) -> T {
        // Not from the middle of a turn, where one is under way.
        let from = self.flight.map_or(self.camera, |flight| flight.to());
        let mut to = from;
        let told = lead(&mut to);
        if to != from {
            self.fly_to(to);
        }
        told
    }

    /// Takes how fast frames come, while something moves.
    pub(super) fn measure_rate(&mut self, ui: &Ui, moves: bool) {
        self.frames_per_second = moves.then(|| 1.0 / ui.input(|input| input.stable_dt).max(1e-3));
    }

    /// Finds out whether pictures are to be light, and asks for the whole ones once the camera rests.
    fn follow_motion(&mut self, ui: &Ui, document: Option<&Document>) {
        let (now_s, expected_s) = ui.input(|input| (input.time, f64::from(input.predicted_dt)));
        // Numbers of the level change nothing that is drawn.
        let of = Revision { measured: 0, ..document.map(|document| document.revision).unwrap_or_default() };
        self.light = self.motion.follow(of, self.camera, now_s, expected_s);
        if let Some(light) = self.light {
            ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(light.left_s));
        }
    }

    /// Takes the slices that are to be shown behind the surface.
    pub(super) fn take_slices(&mut self, scan: Option<&KeptScan>) {
        self.slices = scan.map(KeptScan::shown).unwrap_or_default();
        let has_outline = !self.slices.is_empty() && scan.is_some_and(|scan| scan.options.has_outline);
        self.outlines = has_outline.then(|| self.outlines.take().unwrap_or_default());
    }

    /// Shows both views in what is left of `ui`, in a window that is that of a phone or a low part of another page. Returns
    /// what was clicked, if that asks for something.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        subject: Subject<'_>,
        over: &mut Over<'_>,
        (is_narrow, is_low): (bool, bool),
    ) -> Option<Clicked> {
        let Subject { document, keep, .. } = subject;
        let moves = ui.input(|input| input.pointer.any_down() || input.smooth_scroll_delta() != egui::Vec2::ZERO);
        self.measure_rate(ui, moves);
        self.follow_motion(ui, document);
        self.retry(document);
        if self.scene.is_some() {
            // What fails is tried again.
            self.failure = None;
        }
        if let (Some(scene), Some(document)) = (&mut self.scene, document)
            && let Err(error) = scene.follow(document, self.options.colours)
        {
            self.failure = Some(say!("views-surface-failed", error = surface_error(&error)));
        }
        if let Some(scene) = &mut self.scene
            && let Err(error) = scene.follow_slices(&self.slices)
        {
            self.failure = Some(say!("views-slices-failed", error = surface_error(&error)));
        }
        if let (Some(outlines), Some(document)) = (&mut self.outlines, document) {
            outlines.keep_only(&self.slices, document.revision);
        }
        let mut area = ui.available_rect_before_wrap();
        // A finger covers much of two small pictures. A low part of a page has no height for tabs where it has the width for
        // both.
        let is_wide = area.width() > WIDE * area.height();
        let is_alone = if is_low { !is_wide } else { is_narrow && theme::suits_finger(ui.ctx()) };
        if is_alone && area.height() > 2.0 * tabs::HEIGHT {
            let (strip, below) = area.split_top_bottom_at_y(area.top() + tabs::HEIGHT);
            tabs::show(ui, strip, &mut self.large);
            area = below;
        }
        let (first, second) = if is_alone {
            (area, area)
        } else if is_narrow && !is_wide || area.width() < area.height() / 2.0 {
            area.split_top_bottom_at_fraction(0.5)
        } else {
            area.split_left_right_at_fraction(0.5)
        };
        self.first = first;
        self.take_shape(first, 1, document, keep);
        let shaded = if self.options.flat { Look::Flat } else { Look::Shaded };
        let lines = if self.options.see_through { Look::SeeThrough } else { Look::Wireframe };
        let is_shown = |index: usize| !is_alone || index == self.large;
        if (0..2).any(|index| is_shown(index) && self.splits(index, document)) {
            self.divider.advance(ui);
        }
        let mut clicked = None;
        for (index, (rect, look)) in [(first, shaded), (second, lines)].into_iter().enumerate() {
            if is_alone && index != self.large {
                continue;
            }
            rim(ui, rect);
            let hit = self.view(ui, index, rect.shrink(0.5), look, subject, over);
            clicked = clicked.or(hit);
        }
        clicked
    }
}

/// A line of half a point within `rect`, around the picture that covers the rest: to fill all of it would take longer where
/// there is no graphics card.
fn rim(ui: &Ui, rect: Rect) {
    /// As wide as no edge of the line is seen.
    const WIDE: f32 = 2.0;
    let rect = rect.expand(0.5);
    let sides = [
        rect.with_max_x(rect.left() + WIDE),
        rect.with_min_x(rect.right() - WIDE),
        rect.with_max_y(rect.top() + WIDE),
        rect.with_min_y(rect.bottom() - WIDE),
    ];
    for side in sides {
        ui.painter().rect_filled(side, 0.0, ui.visuals().widgets.noninteractive.bg_stroke.color);
    }
}

/// Whether the device is known to be a graphics processor. A browser does not say, and by OpenGL it is guessed.
fn draws_fast(state: &egui_wgpu::RenderState) -> bool {
    use wgpu::DeviceType::{DiscreteGpu, IntegratedGpu};
    let info = state.adapter.get_info();
    info.backend != wgpu::Backend::Gl && matches!(info.device_type, DiscreteGpu | IntegratedGpu)
}
