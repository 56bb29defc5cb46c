//! The two surfaces in one place, on two sides of a line that can be dragged: shaded, and coloured by how far each is from
//! the other.

use std::sync::Arc;

use egui::{Align2, Color32, Rect, Role, Sense, TextStyle, Ui, WidgetInfo, pos2};

use super::against::Found;
use crate::app::action::Action as Ask;
use crate::app::compare::{CompareScene, Shot};
use crate::app::graphics_error::surface_error;
use crate::app::halo;
use crate::app::overlay::{self, Legend, Writing};
use crate::app::places::pixels;
use crate::app::reveal::Divider;
use crate::app::sides::{first_view, stand};
use crate::app::state::State;
use crate::app::theme;
use crate::app::views::{NO_MEMORY, Views};
use crate::io::Axes;
use crate::mesh::{Bounds, TriMesh};
use crate::render::{Camera, ColourMap, Look, Style};
use crate::say;

/// Bounds that differ by more than this part of their size are of other places.
const ELSEWHERE: f32 = 0.01;

/// Where the camera was brought by itself.
#[derive(Clone, Copy)]
struct Fitted {
    bounds: Bounds,
    before: Camera,
}

/// The views: what of them stands in GPU memory.
#[derive(Default)]
pub(in crate::app) struct ReferenceView {
    device: Option<egui_wgpu::RenderState>,
    /// Made when the views are first shown.
    scene: Option<CompareScene>,
    /// Whether the device had no memory for it.
    is_refused: bool,
    divider: Divider,
    fitted: Option<Fitted>,
    /// How to look from the next frame on.
    wanted: Option<Ask>,
}

impl ReferenceView {
    /// Views on the window's device; without one (in some tests) they say so.
    pub(super) fn new(device: Option<&egui_wgpu::RenderState>) -> Self {
        Self { device: device.cloned(), ..Self::default() }
    }

    /// Lets go of GPU memory, for while the views are not shown; and of the camera, which looks from where it did before: the
    /// two surfaces need not lie where the document does.
    pub(super) fn leave(&mut self, views: &mut Views) {
        (self.scene, self.is_refused) = (None, false);
        if let Some(Fitted { before, .. }) = self.fitted.take() {
            views.stand_at(before);
        }
    }

    /// Gives up what stands on the device, whose memory is full, until the views are shown anew.
    pub(super) fn give_up(&mut self) {
        self.is_refused |= self.scene.take().is_some();
    }

    /// Looks at both surfaces as is asked for.
    pub(super) fn look(&mut self, wanted: Ask) {
        self.wanted = Some(wanted);
    }

    /// Shows both in what is left of `ui`: side by side, one above the other where that is narrow.
    pub(super) fn show_two(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) {
        let area = ui.available_rect_before_wrap();
        let Some(Ok(found)) = state.against.answer() else {
            ui.painter().rect_filled(area, 0.0, ui.visuals().faint_bg_color);
            if state.against.is_busy() {
                spinner(ui, area);
            }
            return;
        };
        let meshes = [&found.two.reference, &found.two.surface];
        if let (None, false, Some(device)) = (&self.scene, self.is_refused, &self.device) {
            self.scene = Some(CompareScene::new(device));
        }
        if let Some(scene) = &mut self.scene {
            scene.keep_only(&meshes.into_iter());
        }
        let (first, second) =
            if is_narrow { area.split_top_bottom_at_fraction(0.5) } else { area.split_left_right_at_fraction(0.5) };
        let axes = found.two.report.reference.axes;
        self.take_camera(views, meshes, axes, first);
        let shaded: &'static [Look] = if views.options.flat { &[Look::Flat] } else { &[Look::Shaded] };
        let most = (found.two.report.deviation_mm.p95 as f32).max(1e-6);
        let is_signed = !state.against.is_plain;
        let map = ColourMap { range: (if is_signed { -most } else { 0.0 }, most) };
        self.divider.advance(ui);
        for (row, rect) in [first, second].into_iter().enumerate() {
            let rect = rect.shrink(0.5);
            let is_coloured = row == 1;
            let title = if is_coloured { say!("reference-distance-title") } else { say!("views-shaded-title") };
            let picture = ui.interact(rect, ui.scope_id().with(("picture", row)), Sense::click_and_drag());
            picture.widget_info(|| WidgetInfo::labeled(Role::Image, true, &title));
            let style = Style {
                raking: views.options.raking,
                occlusion: views.options.occlusion && !is_coloured,
                map: is_coloured.then_some(map),
                diverging: is_coloured && is_signed,
                ..theme::style(ui.visuals())
            };
            let shot = Shot { camera: views.camera, size: pixels(ui, rect), looks: shaded, style };
            if let Err(why) = self.halves(ui, row, rect, found, &shot) {
                ui.painter().rect_filled(rect, 0.0, ui.visuals().faint_bg_color);
                let (font, colour) = (TextStyle::Small.resolve(ui.style()), ui.visuals().text_color());
                halo::text(&ui.painter_at(rect), rect.center(), Align2::CENTER_CENTER, &why, font, colour);
                continue;
            }
            let writing = Writing {
                title: &title,
                name: Some(&found.two.report.surface.file),
                camera: &views.camera,
                axes,
                legend: is_coloured.then(|| legend(map, is_signed)),
                array: None,
                is_alone: false,
            };
            overlay::show(ui, rect, &writing);
            let sides = [say!("reference-column-reference"), say!("reference-column-surface")];
            ui.push_id(row, |ui| self.divider.show(ui, rect, 0, Some(sides)));
            if let Some(spot) = &views.spot {
                overlay::ring(ui, rect, &views.camera, spot.at, &spot.label, ui.visuals().hyperlink_color);
            }
            // Twice pressed it is seen as a whole, which is here that of both.
            if picture.double_clicked() {
                self.wanted = Some(Ask::Fit);
                ui.ctx().request_repaint();
            }
            views.steer(ui, &picture, 1, None, state.settings.keep);
        }
        if state.against.is_busy() || state.against.stopped().is_some() {
            // It is of what was asked before.
            ui.painter().rect_filled(area, 0.0, ui.visuals().faint_bg_color.gamma_multiply(0.7));
        }
        if state.against.is_busy() {
            spinner(ui, area);
        }
    }

    /// Brings both into view where they are first shown, or elsewhere than before, or where that is asked for.
    fn take_camera(&mut self, views: &mut Views, meshes: [&Arc<TriMesh>; 2], axes: Axes, rect: Rect) {
        let bounds = meshes[0].bounds().joined(&meshes[1].bounds());
        let wanted = self.wanted.take();
        let is_there = |fitted: &Fitted| {
            let off =
                (fitted.bounds.centre() - bounds.centre()).length() + (fitted.bounds.size() - bounds.size()).length();
            off <= ELSEWHERE * bounds.diagonal()
        };
        if self.fitted.as_ref().is_some_and(is_there) && wanted.is_none() {
            return;
        }
        let before = self.fitted.map_or(views.camera, |fitted| fitted.before);
        // A ring of the document's would be at another place of these.
        if self.fitted.is_none() {
            views.stand_at(before);
        }
        match wanted {
            Some(Ask::View(view)) => stand(&mut views.camera, view, axes),
            Some(_) => {}
            None => stand(&mut views.camera, first_view(bounds.size()), axes),
        }
        views.camera.fit(&bounds, rect.width() / rect.height().max(1.0));
        self.fitted = Some(Fitted { bounds, before });
    }

    /// Draws the reference left of the line and the surface right of it.
    fn halves(&mut self, ui: &Ui, row: usize, rect: Rect, found: &Found, shot: &Shot) -> Result<(), String> {
        let Some(scene) = &mut self.scene else {
            return Err(if self.is_refused { NO_MEMORY.say() } else { say!("compare-no-device") });
        };
        let (left, right) = rect.split_left_right_at_fraction(self.divider.at());
        let sides = [(&found.two.reference, left), (&found.two.surface, right)];
        for (side, (mesh, half)) in sides.into_iter().enumerate() {
            let over = shot.style.map.and(Some(&found.over[side][usize::from(shot.style.diverging)]));
            let texture = scene.draw(2 * row + side, mesh, over, shot);
            let texture = texture.map_err(|error| say!("compare-not-drawn", why = surface_error(&error)))?;
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter_at(half).image(texture, rect, whole, Color32::WHITE);
        }
        Ok(())
    }
}

/// Something is on its way.
fn spinner(ui: &mut Ui, area: Rect) {
    ui.place(Rect::from_center_size(area.center(), egui::vec2(24.0, 24.0)), egui::Spinner::new());
}

/// What the colours say.
fn legend(map: ColourMap, is_signed: bool) -> Legend {
    Legend {
        map,
        title: say!("reference-legend"),
        unit: "mm",
        decimals: 3,
        is_open: true,
        is_open_below: is_signed,
        note: if is_signed { say!("reference-legend-sides") } else { String::new() },
        patch: None,
        is_diverging: is_signed,
        has_histogram: false,
    }
}
