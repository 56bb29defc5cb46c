//! The views of a trial: the wire in the translucent vessel, the [`fluoroscopy`], and what the [`tip`] sees.

mod arrangement;
mod fluoroscopy;
mod painting;
mod tip;

use std::sync::Arc;

use egui::{Align2, Rect, Role, Sense, Ui, vec2};
use glam::Quat;

use self::arrangement::{buttons, large_button, places, tip_button, words_width};
use self::fluoroscopy::Fluoroscopy;
use self::painting::{empty, image, radius};
use super::action::Action;
use super::marks::{self, WRITTEN_OVER};
use super::plate::{plate, sentence};
use super::readout::is_small;
use super::scene::TrialScene;
use super::state::{AWAITS, Stage, Trial};
use super::tables::Tables;
use crate::app::assist::name;
use crate::app::document::Document;
use crate::app::graphics_error::surface_error;
use crate::app::overlay::{self, Legend};
use crate::app::places::{in_view, pixels};
use crate::app::theme;
use crate::app::views::{NO_MEMORY, Views};
use crate::engine::trial::RouteShown;
use crate::language::decimal;
use crate::mesh::{TriMesh, Vec3};
use crate::pipeline::settings::Keep;
use crate::render::{Camera, ColourMap, Ray, pick};
use crate::say;

/// So much of the vessel is seen around a place that is gone to, in mm.
const AROUND: f32 = 40.0;

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
    fluoroscopy: Fluoroscopy,
    /// Whether the whole vessel was brought into view, as a trial begins.
    has_fitted: bool,
    /// From where the user looked before, where that was another place.
    looked: Option<Looked>,
}

/// From where the user looked before a trial.
#[derive(Clone, Copy)]
struct Looked {
    /// The number of the surface.
    document: u64,
    camera: Camera,
    /// How the camera was turned as the trial began.
    rotation: Quat,
}

impl TrialView {
    /// Views on the window's device; without one (in some tests) they say so.
    pub(in crate::app::trial) fn new(device: Option<&egui_wgpu::RenderState>) -> Self {
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
            fluoroscopy: Fluoroscopy::default(),
            has_fitted: false,
            looked: None,
        }
    }

    /// Lets go of the camera. It looks from where it did before the trial, unless the user has turned or moved it meanwhile or
    /// another surface is open.
    pub(in crate::app::trial) fn leave(&mut self, views: &mut Views, document: Option<&Document>) {
        self.has_fitted = false;
        let document = document.map(|document| document.revision.document);
        let stands = |looked: &Looked| {
            document == Some(looked.document) && views.is_fitted() && views.camera.rotation == looked.rotation
        };
        if let Some(looked) = self.looked.take().filter(stands) {
            views.camera = looked.camera;
        }
    }

    /// Gives back the memory of the device.
    pub(in crate::app::trial) fn release(&mut self) {
        (self.scene, self.failure, self.refused) = (None, None, None);
        (self.felt, self.picture) = (0, None);
        self.fluoroscopy.forget();
    }

    /// Takes another device, on which nothing of the views stands yet.
    pub(in crate::app::trial) fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        self.release();
        self.device = device.cloned();
    }

    /// Gives up what stands on the device, whose memory is full, until the views are shown anew or another surface is.
    pub(in crate::app::trial) fn refuse(&mut self) {
        if self.scene.is_some() {
            self.release();
            self.failure = Some(NO_MEMORY.say());
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
                Err(error) => self.failure = Some(say!("trial-not-drawn", why = surface_error(&error))),
            }
        }
    }

    /// Times the drawing of the surfaces of the tables.
    pub(in crate::app::trial) fn time_tables(&mut self, ui: &Ui, tables: &mut Tables) {
        if tables.needs_views() {
            self.prepare();
            let (scene, style) = (&self.scene, theme::style(ui.visuals()));
            let time = |mesh: &TriMesh| scene.as_ref()?.time_frame(mesh, &style).ok();
            tables.time(time);
        }
    }

    /// Shows the views in what is left of `ui`. Returns what is asked for by a click: to begin with the place under it.
    pub(in crate::app::trial) fn show(
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
        if let Some(open) = &mut trial.open {
            open.carm.axes = document.map(|document| document.import.axes).unwrap_or_default();
        }
        let area = ui.available_rect_before_wrap();
        let is_large = trial.is_large();
        let [first, second, third] = places(area, is_large, self.shows_tip, is_narrow);
        let looked = (!views.is_fitted()).then_some(views.camera);
        views.take_shape(first, 1, document, keep);
        if !std::mem::replace(&mut self.has_fitted, true) {
            // A wire that goes in elsewhere than where the user has looked last would not be seen.
            views.fit(document, keep);
            let rotation = views.camera.rotation;
            let of = looked.zip(document.map(|document| document.revision.document));
            self.looked = of.map(|(camera, document)| Looked { document, camera, rotation });
        }
        if let Some(at) = trial.open.as_mut().and_then(|open| open.flight.take()) {
            views.fly(at, AROUND);
            ui.ctx().request_repaint();
        }
        views.measure_rate(ui, trial.is_moving());
        // What lies over another comes after it.
        if is_large {
            self.fluoroscopy.show(ui, second.shrink(0.5), trial, self.scene.as_mut(), &mut self.failure);
            ui.painter().rect_filled(first.union(third), 0.0, ui.visuals().widgets.noninteractive.bg_stroke.color);
        }
        let picked = self.vessel(ui, first.shrink(0.5), trial, views, document, keep);
        if !is_large {
            self.fluoroscopy.show(ui, second.shrink(0.5), trial, self.scene.as_mut(), &mut self.failure);
        }
        if self.shows_tip {
            self.tip(ui, third.shrink(0.5), trial);
        }
        let size = vec2(words_width(ui) + 2.0 * ui.spacing().button_padding.x, theme::row(ui.ctx(), 26.0));
        let [tip, large] = buttons(second, third, self.shows_tip, size);
        tip_button(ui, tip, &mut self.shows_tip);
        let asked = large_button(ui, large, is_large);
        asked.or_else(|| Some(Action::Place(trial.open()?.pick?, picked?)))
    }

    /// Brings what is in memory up to the trial.
    fn follow(&mut self, trial: &Trial) {
        self.shown = trial.mesh().cloned();
        let Some(scene) = &mut self.scene else { return };
        // What fails is tried again.
        self.failure = None;
        let Some(session) = trial.session() else {
            let taken = trial.mesh().map_or(Ok(false), |mesh| scene.take(mesh, &RouteShown::default()));
            // No wire is in it.
            if let Err(error) = taken.and_then(|is_other| if is_other { scene.set_wire(&[], 1.0) } else { Ok(()) }) {
                self.failure = Some(say!("trial-surface-not-drawn", why = surface_error(&error)));
            }
            return;
        };
        let run = &session.run;
        match scene.take(&session.subject.mesh, &session.ready.route) {
            Ok(true) => (self.felt, self.picture) = (0, None),
            Ok(false) => {}
            Err(error) => {
                self.failure = Some(say!("trial-not-drawn", why = surface_error(&error)));
                return;
            }
        }
        if std::mem::replace(&mut self.run, run.id) != run.id {
            (self.felt, self.picture) = (0, None);
            self.fluoroscopy.forget();
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
                Err(error) => self.failure = Some(say!("trial-wire-not-drawn", why = surface_error(&error))),
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
        name(&response, Role::Image, &say!("trial-view"));
        views.steer(ui, &response, 1, document, keep);
        let mut style = theme::style(ui.visuals());
        let end = trial.peaks().wall_scale();
        style.map = Some(ColourMap { range: (0.0, end) });
        let camera = views.camera;
        let session = trial.session();
        let is_on = session.is_some();
        if let Some(scene) = self.scene.as_mut().filter(|_| trial.mesh().is_some()) {
            let texture = scene.vessel(&camera, pixels(ui, rect), &style);
            image(ui, rect, texture);
        } else {
            empty(ui, rect);
        }
        if let Some(session) = session {
            marks::show(ui, rect, &camera, session);
        }
        let legend = (is_on && rect.height() > 300.0).then(|| peak_legend(end));
        let title = if is_on { say!("trial-view-title") } else { say!("trial-title") };
        let axes = document.map(|document| document.import.axes).unwrap_or_default();
        let name = (rect.width() >= WRITTEN_OVER).then_some(trial.title.as_str());
        let writing =
            overlay::Writing { title: &title, name, camera: &camera, axes, legend, array: None, is_alone: false };
        overlay::show(ui, rect, &writing);
        self.say(ui, rect, trial);
        if let Some(problem) = trial.problem.as_ref().filter(|_| trial.mesh().is_some()) {
            if let Some(at) = problem.at {
                let label = if problem.is_too_thin { say!("trial-too-thin-ring") } else { say!("trial-no-way-ring") };
                overlay::ring(ui, rect, &camera, at, &label, ui.visuals().error_fg_color);
            }
            if problem.at.is_some() || !is_on {
                sentence(ui, rect, &problem.text);
            }
        }
        let picks = trial.open().is_some_and(|open| open.pick.is_some()) && response.clicked();
        picks.then(|| lumen_at(response.interact_pointer_pos()?, rect, &camera, trial.mesh()?)).flatten()
    }

    /// What there is to say where there is nothing to see.
    fn say(&self, ui: &Ui, rect: Rect, trial: &Trial) {
        let Some(open) = trial.open() else { return };
        let text = match (&self.failure, &open.stage) {
            (Some(failure), _) => failure.clone(),
            (None, _) if self.device.is_none() => say!("trial-no-device"),
            (None, _) if open.awaits.is_some() => AWAITS.say(),
            (None, Stage::Preparing(preparing)) => {
                say!("trial-finding-way", percent = decimal(preparing.fraction * 100.0, 0))
            }
            (None, Stage::Off(Some(_))) => return,
            (None, Stage::Off(_)) if trial.problem.is_some() => say!("trial-none-on-problem"),
            (None, Stage::Off(_)) => say!("trial-none-on"),
            (None, Stage::Association(_)) => return,
        };
        plate(ui, rect.center(), Align2::CENTER_CENTER, &text, true);
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
        title: say!("views-peak-force"),
        unit,
        decimals,
        is_open: false,
        is_open_below: false,
        note: String::new(),
        patch: None,
        is_diverging: false,
        has_histogram: false,
    }
}
