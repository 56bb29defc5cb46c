//! The views of a trial: the wire in the translucent vessel, the fluoroscopy, and what the tip sees.

use std::sync::Arc;
use std::time::Duration;

use egui::{Align2, Color32, PointerButton, Rect, Response, Role, Sense, TextureId, Ui, pos2, vec2};
use glam::{Mat3, Quat};

use super::action::Action;
use super::marks;
use super::plate::plate;
use super::readout::is_small;
use super::scene::TrialScene;
use super::state::{AWAITS, Session, Stage, Trial};
use super::tables::Tables;
use crate::app::assist::name;
use crate::app::document::Document;
use crate::app::overlay::{self, Legend, NOT_CLINICAL};
use crate::app::theme;
use crate::app::views::{NO_MEMORY, Views, in_view};
use crate::mesh::{Bounds, TriMesh, Vec3};
use crate::pipeline::settings::Keep;
use crate::render::{Camera, ColourMap, Exposure, Ray, pick};
use crate::trial::frame::Frame;

/// How fast the blood takes contrast along, in mm/s.
const FLOW: f32 = 150.0;
/// How far the tip sees, in mm.
const TIP_REACH: f32 = 80.0;
/// The tip's field of view, in radians.
const TIP_FIELD: f32 = 1.7;

/// The views: what of them stands in GPU memory.
pub(in crate::app) struct TrialView {
    device: Option<egui_wgpu::RenderState>,
    /// Made when the views are first shown.
    scene: Option<TrialScene>,
    failure: Option<String>,
    /// The surface that is shown, and the one that the device's memory had no room for: another is tried.
    shown: Option<Arc<TriMesh>>,
    refused: Option<Arc<TriMesh>>,
    /// Whether the tip's view is shown.
    shows_tip: bool,
    /// The number of the run that the forces on the wall are of.
    run: u64,
    /// How many of what the wall has felt they have in them.
    felt: usize,
    /// The picture of the wire that they have.
    picture: Option<(u64, u64)>,
    /// What the last fluoroscopy was taken from.
    held: Option<Held>,
}

/// A fluoroscopy: from where, how, and of which picture of the wire.
#[derive(Clone, Copy, PartialEq)]
struct Held {
    camera: Camera,
    exposure: Exposure,
    picture: (u64, u64),
}

impl TrialView {
    /// Views on the window's device; without one (in some tests) they say so.
    pub(in crate::app) fn new(device: Option<&egui_wgpu::RenderState>) -> Self {
        let device = device.cloned();
        Self {
            device,
            scene: None,
            failure: None,
            shown: None,
            refused: None,
            shows_tip: true,
            run: 0,
            felt: 0,
            picture: None,
            held: None,
        }
    }

    /// Gives back the memory of the device.
    pub(in crate::app) fn let_go(&mut self) {
        (self.scene, self.failure, self.refused) = (None, None, None);
        (self.felt, self.picture, self.held) = (0, None, None);
    }

    /// Takes another device, on which nothing of the views stands yet.
    pub(in crate::app) fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        self.let_go();
        self.device = device.cloned();
    }

    /// Gives up what stands on the device, whose memory is full, until the views are shown anew or another surface is.
    pub(in crate::app) fn refuse(&mut self) {
        if self.scene.is_some() {
            self.let_go();
            self.failure = Some(NO_MEMORY.to_owned());
            self.refused = self.shown.take();
        }
    }

    /// Whether something stands in the memory of the device.
    pub(in crate::app) fn holds_memory(&self) -> bool {
        self.scene.is_some()
    }

    /// How many pictures were drawn since the views were shown.
    pub(in crate::app) fn draws(&self) -> u64 {
        self.scene.as_ref().map_or(0, TrialScene::draws)
    }

    fn prepare(&mut self) {
        if let (None, None, Some(device)) = (&self.scene, &self.failure, &self.device) {
            match TrialScene::new(device) {
                Ok(scene) => self.scene = Some(scene),
                Err(error) => self.failure = Some(format!("The trial cannot be drawn: {error}.")),
            }
        }
    }

    /// Times the drawing of the surfaces of the tables.
    pub(in crate::app) fn time_tables(&mut self, ui: &Ui, tables: &mut Tables) {
        if tables.needs_views() {
            self.prepare();
            let (scene, style) = (&self.scene, theme::style(ui.visuals()));
            let time = |mesh: &TriMesh| scene.as_ref()?.time_frame(mesh, &style).ok();
            tables.time(time);
        }
    }

    /// Shows the views in what is left of `ui`. Returns what is asked for by a click: to begin with the place under it.
    pub(in crate::app) fn show(
        &mut self,
        ui: &mut Ui,
        trial: &mut Trial,
        views: &mut Views,
        document: Option<&Document>,
        keep: Keep,
        is_narrow: bool,
    ) -> Option<Action> {
        let is_other = |refused: &Arc<TriMesh>| !trial.mesh().is_some_and(|mesh| Arc::ptr_eq(mesh, refused));
        if self.refused.as_ref().is_some_and(is_other) {
            (self.failure, self.refused) = (None, None);
        }
        self.prepare();
        self.follow(trial);
        let area = ui.available_rect_before_wrap();
        let (first, others) =
            if is_narrow { area.split_top_bottom_at_fraction(0.55) } else { area.split_left_right_at_fraction(0.58) };
        let (second, third) = match (self.shows_tip, is_narrow) {
            (false, _) => (others, None),
            (true, true) => split(others.split_left_right_at_fraction(0.5)),
            (true, false) => split(others.split_top_bottom_at_fraction(0.6)),
        };
        views.take_shape(first, 1, document, keep);
        views.measure_rate(ui, trial.is_moving());
        let picked = self.vessel(ui, first.shrink(0.5), trial, views, document, keep);
        self.fluoroscopy(ui, second.shrink(0.5), trial);
        match third {
            Some(third) => self.tip(ui, third.shrink(0.5), trial),
            None => self.tip_button(ui, second.shrink(0.5)),
        }
        Some(Action::Place(trial.pick?, picked?))
    }

    /// Brings what is in memory up to the trial.
    fn follow(&mut self, trial: &Trial) {
        self.shown = trial.mesh().cloned();
        let Some(scene) = &mut self.scene else { return };
        // What fails is tried again.
        self.failure = None;
        let Some(session) = trial.session() else { return };
        let run = &session.run;
        match scene.take(&session.subject.mesh, &session.ready.route) {
            Ok(true) => (self.felt, self.picture) = (0, None),
            Ok(false) => {}
            Err(error) => {
                self.failure = Some(format!("The trial cannot be drawn: {error}."));
                return;
            }
        }
        if std::mem::replace(&mut self.run, run.id) != run.id {
            (self.felt, self.picture, self.held) = (0, None, None);
            if let Some(peaks) = scene.peaks() {
                peaks.clear();
            }
        }
        if self.picture != Some(run.picture()) || self.felt < run.felt.len() {
            scene.feel(&run.felt[self.felt.min(run.felt.len())..]);
            self.felt = run.felt.len();
            // Without a frame there is no wire to be seen.
            let nodes = run.frame.as_ref().map_or(&[][..], |frame| &frame.nodes);
            match scene.set_wire(nodes, radius(session)) {
                Ok(()) => self.picture = Some(run.picture()),
                Err(error) => self.failure = Some(format!("The wire cannot be drawn: {error}.")),
            }
        }
    }

    fn vessel(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        trial: &Trial,
        views: &mut Views,
        document: Option<&Document>,
        keep: Keep,
    ) -> Option<Vec3> {
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        name(&response, Role::Image, "Trial view");
        views.steer(ui, &response, 1, document, keep);
        let mut style = theme::style(ui.visuals());
        let end = trial.peaks().wall_scale();
        style.map = Some(ColourMap { range: (0.0, end) });
        let camera = views.camera;
        let session = trial.session();
        let is_on = session.is_some();
        if let Some(scene) = self.scene.as_mut().filter(|_| is_on) {
            let texture = scene.vessel(&camera, pixels(ui, rect), &style);
            image(ui, rect, texture);
        } else {
            empty(ui, rect);
        }
        if let Some(session) = session {
            marks::show(ui, rect, &camera, session);
        }
        let legend = (is_on && rect.height() > 300.0).then(|| peak_legend(end));
        let title = if is_on { "Wire in the vessel" } else { "Trial" };
        let axes = document.map(|document| document.import.axes).unwrap_or_default();
        let writing = overlay::Writing { title, name: Some(&trial.name), camera: &camera, axes, legend, array: None };
        overlay::show(ui, rect, &writing);
        self.say(ui, rect, trial);
        let picks = trial.pick.is_some() && response.clicked();
        picks.then(|| lumen_at(response.interact_pointer_pos()?, rect, &camera, trial.mesh()?)).flatten()
    }

    /// What there is to say where there is nothing to see.
    fn say(&self, ui: &Ui, rect: Rect, trial: &Trial) {
        let text = match (&self.failure, &trial.stage) {
            (Some(failure), _) => failure.clone(),
            (None, _) if self.device.is_none() => "There is no graphics device to draw with.".to_owned(),
            (None, _) if trial.awaits.is_some() => AWAITS.to_owned(),
            (None, Stage::Preparing(preparing)) => format!("Finding the way: {:.0} %", preparing.fraction * 100.0),
            (None, Stage::Closed | Stage::Off) if trial.problem.is_some() => {
                "No trial is on: the panel says why.".to_owned()
            }
            (None, Stage::Closed | Stage::Off) => "No trial is on.".to_owned(),
            (None, Stage::On(_)) => return,
        };
        plate(ui, rect.center(), Align2::CENTER_CENTER, &text, true);
    }

    fn fluoroscopy(&mut self, ui: &mut Ui, rect: Rect, trial: &mut Trial) {
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        name(&response, Role::Image, "Fluoroscopy view");
        steer(ui, &response, trial);
        match self.expose(ui, rect, trial) {
            Some(texture) => image(ui, rect, texture),
            None => empty(ui, rect),
        }
        let inner = rect.shrink(8.0);
        let arm = &trial.carm;
        plate(ui, inner.left_top(), Align2::LEFT_TOP, "Fluoroscopy", true);
        plate(ui, inner.left_top() + vec2(0.0, 22.0), Align2::LEFT_TOP, &arm.words(), true);
        if rect.height() > 200.0 {
            let state = if arm.is_on {
                format!("{} pulses/s, {:.0} mm field", arm.rate, arm.field_mm)
            } else {
                "Last image hold (Space: on)".to_owned()
            };
            plate(ui, inner.left_top() + vec2(0.0, 44.0), Align2::LEFT_TOP, &state, false);
            plate(ui, inner.left_bottom() - vec2(0.0, 22.0), Align2::LEFT_BOTTOM, &trial.name, false);
            if trial.session().is_some() {
                scale_bar(ui, inner, rect, arm.field_mm);
            }
        }
        plate(ui, inner.right_bottom(), Align2::RIGHT_BOTTOM, NOT_CLINICAL, false);
    }

    /// Takes a fluoroscopy where a pulse is due and would show something else, and gives the texture that the last one
    /// is in.
    fn expose(&mut self, ui: &Ui, rect: Rect, trial: &mut Trial) -> Option<TextureId> {
        let now = ui.input(|input| input.time);
        let Trial { carm, stage, .. } = trial;
        let (scene, session) = (self.scene.as_mut()?, stage.session()?);
        let frame = session.run.frame.as_ref()?;
        let (bounds, radius) = (session.subject.mesh.bounds(), radius(session));
        carm.count(frame.time_s);
        let exposure = Exposure {
            pulse: carm.pulses,
            contrast_s: carm.contrast_s(now),
            flow: FLOW / (session.ready.route.length_mm as f32).max(1.0),
            roadmap: carm.roadmap,
        };
        let mut new = Held { camera: carm.camera(bounds), exposure, picture: session.run.picture() };
        let is_news = self.held != Some(new);
        let is_due = is_news && carm.pulses_at(now);
        let (texture, is_other_size) = scene.picture(pixels(ui, rect));
        let exposed = match self.held {
            Some(held) if !is_due && is_other_size => scene.expose(&held.camera, None, &held.exposure),
            Some(_) if !is_due => Ok(()),
            _ => {
                new.exposure.pulse = carm.pulses;
                let exposed = scene.expose(&new.camera, Some((&frame.nodes, radius)), &new.exposure);
                self.held = Some(new).filter(|_| exposed.is_ok());
                exposed
            }
        };
        if let Err(error) = exposed {
            self.failure = Some(format!("The fluoroscopy cannot be drawn: {error}."));
        }
        if carm.is_on && (exposure.contrast_s.is_some() || is_news && !is_due) {
            ui.ctx().request_repaint_after(Duration::from_secs_f64(carm.until_pulse(now)));
        }
        Some(texture)
    }

    fn tip(&mut self, ui: &mut Ui, rect: Rect, trial: &Trial) {
        let response = ui.allocate_rect(rect, Sense::hover());
        name(&response, Role::Image, "Tip view");
        match (&mut self.scene, trial.frame()) {
            (Some(scene), Some(frame)) if !frame.nodes.is_empty() => {
                let texture = scene.tip(&from_tip(frame), pixels(ui, rect), &theme::style(ui.visuals()));
                image(ui, rect, texture);
            }
            _ => empty(ui, rect),
        }
        let inner = rect.shrink(8.0);
        plate(ui, inner.left_top(), Align2::LEFT_TOP, "From the tip", true);
        plate(ui, inner.right_bottom(), Align2::RIGHT_BOTTOM, NOT_CLINICAL, false);
        if rect.height() > 200.0 {
            plate(ui, inner.left_bottom(), Align2::LEFT_BOTTOM, &trial.name, false);
        }
        self.tip_button(ui, rect);
    }

    /// Shows or hides the tip's view.
    fn tip_button(&mut self, ui: &mut Ui, rect: Rect) {
        let (label, help) = if self.shows_tip { ("Hide", "Hide the tip view") } else { ("Tip", "Show the tip view") };
        let at = Rect::from_min_size(pos2(rect.right() - 56.0, rect.top() + 6.0), vec2(50.0, 26.0));
        let response = ui.put(at, egui::Button::new(label)).on_hover_text(help);
        name(&response, Role::Button, help);
        if response.clicked() {
            self.shows_tip = !self.shows_tip;
        }
    }
}

fn split((a, b): (Rect, Rect)) -> (Rect, Option<Rect>) {
    (a, Some(b))
}

/// The wire's radius in mm.
fn radius(session: &Session) -> f32 {
    session.ready.setup.wire.radius() as f32
}

/// The size of a view in pixels.
fn pixels(ui: &Ui, rect: Rect) -> [u32; 2] {
    let size = rect.size() * ui.ctx().pixels_per_point();
    [size.x.round().max(1.0) as u32, size.y.round().max(1.0) as u32]
}

fn image(ui: &Ui, rect: Rect, texture: TextureId) {
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter_at(rect).image(texture, rect, whole, Color32::WHITE);
}

fn empty(ui: &Ui, rect: Rect) {
    ui.painter().rect_filled(rect, 0.0, ui.visuals().faint_bg_color);
}

/// Turns the C-arm by dragging, magnifies by the wheel.
fn steer(ui: &Ui, response: &Response, trial: &mut Trial) {
    const DEGREES_PER_HEIGHT: f32 = 120.0;
    if response.dragged_by(PointerButton::Primary) {
        let by = response.drag_delta() * (DEGREES_PER_HEIGHT / response.rect.height().max(1.0));
        trial.carm.turn(-by.x, by.y);
    }
    if response.hovered() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        trial.carm.zoom(pinch * (scroll.y / 240.0).exp());
    }
}

/// A bar of 10, 20 or 50 mm at the isocentre.
fn scale_bar(ui: &Ui, inner: Rect, rect: Rect, field_mm: f32) {
    let per_mm = rect.height() / field_mm;
    let mm = [50.0, 20.0, 10.0].into_iter().find(|mm| mm * per_mm < inner.width() / 4.0).unwrap_or(5.0);
    let (left, y) = (inner.left() + 4.0, inner.bottom() - 6.0);
    let colour = Color32::BLACK;
    let right = left + mm * per_mm;
    let stroke = egui::Stroke::new(1.5, colour);
    ui.painter().line_segment([pos2(left, y), pos2(right, y)], stroke);
    for x in [left, right] {
        ui.painter().line_segment([pos2(x, y - 4.0), pos2(x, y + 4.0)], stroke);
    }
    plate(ui, pos2(right + 6.0, y), Align2::LEFT_CENTER, &format!("{mm:.0} mm"), true);
}

/// The camera in the tip: forwards, the side to which the tip is bent above.
fn from_tip(frame: &Frame) -> Camera {
    let tip = Vec3::from(frame.nodes[0]);
    let back = -Vec3::from(frame.tip_direction).normalize_or(Vec3::Z);
    let up = Vec3::from(frame.tip_side).reject_from_normalized(back);
    let up = up.try_normalize().unwrap_or(back.any_orthonormal_vector());
    const AHEAD: f32 = 5.0;
    Camera {
        target: tip - back * AHEAD,
        rotation: Quat::from_mat3(&Mat3::from_cols(up.cross(back), up, back)),
        distance: AHEAD,
        fov_y: TIP_FIELD,
        bounds: Bounds::of(&[tip - Vec3::splat(TIP_REACH), tip + Vec3::splat(TIP_REACH)]),
    }
}

/// The middle of the lumen under a point of the view: between the wall that is hit first and the one behind it.
fn lumen_at(at: egui::Pos2, rect: Rect, camera: &Camera, mesh: &TriMesh) -> Option<Vec3> {
    let ray = camera.ray(in_view(at, rect), rect.width() / rect.height());
    let first = pick(&ray, &mesh.positions, &mesh.triangles)?;
    let near = ray.origin + ray.direction * first.distance;
    let inside = Ray { origin: near + ray.direction * 0.05, ..ray };
    let far = pick(&inside, &mesh.positions, &mesh.triangles)?;
    Some(near + ray.direction * (far.distance / 2.0))
}

/// What the colours of the wall are up to a force in N; in the unit in which the panel tells such forces.
fn peak_legend(most: f32) -> Legend {
    let (most, unit, decimals) = if is_small(most) { (most * 1e3, "mN", 0) } else { (most, "N", 2) };
    Legend {
        map: ColourMap { range: (0.0, most) },
        title: "Peak force",
        unit,
        decimals,
        is_open: false,
        is_open_below: false,
        note: "",
    }
}
