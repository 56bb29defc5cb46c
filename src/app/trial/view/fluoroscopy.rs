//! The fluoroscopy: its picture, taken where a pulse is due, and the C-arm under the hand.

use std::time::Duration;

use egui::{Align2, Color32, PointerButton, Rect, Response, Role, Sense, TextureId, Ui, pos2, vec2};

use super::painting::{empty, image, radius};
use crate::app::assist::name;
use crate::app::graphics_error::surface_error;
use crate::app::halo;
use crate::app::overlay;
use crate::app::places::pixels;
use crate::app::trial::carm::{self, CArm};
use crate::app::trial::marks::WRITTEN_OVER;
use crate::app::trial::plate::plate;
use crate::app::trial::scene::TrialScene;
use crate::app::trial::state::{Open, Trial};
use crate::language::{decimal, grouped};
use crate::render::{Camera, Exposure};
use crate::say;

/// How fast the blood takes contrast along, in mm/s.
const FLOW: f32 = 150.0;

/// A fluoroscopy: from where, how, and of which picture of the wire.
#[derive(Clone, Copy, PartialEq)]
struct Held {
    camera: Camera,
    exposure: Exposure,
    picture: (u64, u64),
}

/// The fluoroscopy that is shown.
#[derive(Default)]
pub(super) struct Fluoroscopy {
    /// What the last one was taken from.
    held: Option<Held>,
}

impl Fluoroscopy {
    /// The last one is gone: the next is taken anew.
    pub(super) fn forget(&mut self) {
        self.held = None;
    }

    /// Shows it in `rect`, where there is a scene to take it of. Where it could not be taken the last one is shown, and
    /// `failure` says why.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        trial: &mut Trial,
        scene: Option<&mut TrialScene>,
        failure: &mut Option<String>,
    ) {
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        name(&response, Role::Image, &say!("trial-fluoroscopy-view"));
        if let Some(open) = &mut trial.open {
            steer(ui, &response, &mut open.carm);
        }
        match scene.and_then(|scene| self.expose(ui, rect, trial, scene, failure)) {
            Some(texture) => image(ui, rect, texture),
            None => empty(ui, rect),
        }
        let inner = rect.shrink(8.0);
        let Some(Open { carm: arm, .. }) = trial.open() else { return };
        plate(ui, inner.left_top(), Align2::LEFT_TOP, &say!("trial-fluoroscopy"), true);
        plate(ui, inner.left_top() + vec2(0.0, 22.0), Align2::LEFT_TOP, &arm.words(), true);
        if rect.height() > 200.0 {
            let state = if arm.is_on {
                say!("trial-beam-on", rate = grouped(arm.rate), field = decimal(arm.field_mm, 0))
            } else {
                say!("trial-beam-off")
            };
            plate(ui, inner.left_top() + vec2(0.0, 44.0), Align2::LEFT_TOP, &state, false);
            plate(ui, inner.left_bottom() - vec2(0.0, 22.0), Align2::LEFT_BOTTOM, &trial.title, false);
            if trial.session().is_some() {
                scale_bar(ui, inner, rect, arm.field_mm);
            }
        }
        let session = trial.session().filter(|_| rect.width() >= WRITTEN_OVER);
        let missed = session.and_then(|session| session.run.summary.as_ref()?.missed_fork_at);
        // In the picture that is shown, which may be older than the arm's angles.
        if let Some((fork, held)) = missed.zip(self.held)
            && let Some(at) = carm::place(&held.camera, rect, fork.into())
        {
            overlay::ring_at(ui, rect, at, &say!("trial-missed-fork-ring"), ui.visuals().error_fg_color);
        }
    }

    /// Takes a fluoroscopy where a pulse is due and would show something else, and gives the texture that the last one
    /// is in; where it could not be taken, `failure` says why.
    fn expose(
        &mut self,
        ui: &Ui,
        rect: Rect,
        trial: &mut Trial,
        scene: &mut TrialScene,
        failure: &mut Option<String>,
    ) -> Option<TextureId> {
        let now = ui.input(|input| input.time);
        let Open { carm, stage, .. } = trial.open.as_deref_mut()?;
        let session = stage.session()?;
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
            *failure = Some(say!("trial-fluoroscopy-not-drawn", why = surface_error(&error)));
        }
        if carm.is_on && (exposure.contrast_s.is_some() || is_news && !is_due) {
            ui.ctx().request_repaint_after(Duration::from_secs_f64(carm.until_pulse(now)));
        }
        Some(texture)
    }
}

/// Turns the C-arm by dragging, magnifies by the wheel.
fn steer(ui: &Ui, response: &Response, carm: &mut CArm) {
    const DEGREES_PER_HEIGHT: f32 = 120.0;
    if response.dragged_by(PointerButton::Primary) {
        let by = response.drag_delta() * (DEGREES_PER_HEIGHT / response.rect.height().max(1.0));
        carm.turn(-by.x, by.y);
    }
    if response.hovered() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        carm.zoom(pinch * (scroll.y / 240.0).exp());
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
    let [first, last] = [left, right].map(|x| [pos2(x, y - 4.0), pos2(x, y + 4.0)]);
    halo::lines(ui.painter(), &[[pos2(left, y), pos2(right, y)], first, last], stroke);
    plate(ui, pos2(right + 6.0, y), Align2::LEFT_CENTER, &format!("{mm:.0} mm"), true);
}
