//! What was made ready for a solver, or what is cut off before: shaded, each end in a colour and with its name, and as edges.

use std::sync::Arc;

use egui::{Align2, Color32, Rect, Role, Sense, TextStyle, Ui, WidgetInfo, pos2, vec2};

use super::action::Action;
use super::cuts;
use super::preparation::{Preparation, Shown};
use crate::app::compare::{CompareScene, Shot};
use crate::app::graphics_error::surface_error;
use crate::app::places::{pixels, seen};
use crate::app::state::State;
use crate::app::views::{NO_MEMORY, Views};
use crate::app::{arrays, halo, overlay, theme};
use crate::mesh::{TriMesh, Vec3};
use crate::render::{Camera, Look, Style, label_colour};
use crate::say;

/// Ends whose names stand in the picture.
const NAMED: usize = 40;
/// Points between a name and another, or the border.
const NAMES_APART: f32 = 2.0;

/// The views: what of them stands in GPU memory.
#[derive(Default)]
pub(in crate::app) struct SolverView {
    device: Option<egui_wgpu::RenderState>,
    /// Made when the views are first shown.
    scene: Option<CompareScene>,
    /// Whether the device had no memory for it.
    is_refused: bool,
    /// The camera: what it was fitted to, from where it looked before that, and from where since.
    fitted: Option<(u64, Camera, Camera)>,
}

impl SolverView {
    /// Views on the window's device; without one (in some tests) they say so.
    pub(super) fn new(device: Option<&egui_wgpu::RenderState>) -> Self {
        Self { device: device.cloned(), ..Self::default() }
    }

    /// Lets go of GPU memory, for while the views are not shown; and of the camera, which looks from where it did before,
    /// unless it was moved.
    pub(super) fn leave(&mut self, views: &mut Views) {
        (self.scene, self.is_refused) = (None, false);
        if let Some((_, before, since)) = self.fitted.take()
            && views.camera == since
        {
            views.camera = before;
        }
    }

    /// Gives up what stands on the device, whose memory is full, until the views are shown anew.
    pub(super) fn give_up(&mut self) {
        self.is_refused |= self.scene.take().is_some();
    }

    /// Shows what was made, or the cuts, in what is left of `ui`: side by side, one above the other where that is narrow.
    /// What the hand asks for there.
    pub(super) fn show_shown(
        &mut self,
        ui: &mut Ui,
        state: &State,
        views: &mut Views,
        is_narrow: bool,
    ) -> Option<Action> {
        let preparation = &state.preparation;
        let shown = match preparation.shown? {
            Shown::Made => {
                preparation.made.as_ref().map(|made| (&made.mesh, &made.ends, made.ready.mesh.triangles.len()))
            }
            Shown::Cuts => {
                let planned = preparation.planned.as_ref();
                planned.map(|planned| (&planned.mesh, &planned.ends, planned.found.mesh.triangles.len()))
            }
        };
        let Some((mesh, ends, triangles)) = shown else {
            // The engine looks for the cuts.
            write(ui, ui.max_rect(), ui.max_rect().center(), Align2::CENTER_CENTER, &say!("solver-work"));
            return None;
        };
        // Extensions reach beyond what the views showed.
        let fitted_to = preparation.made.as_ref().filter(|_| preparation.shown == Some(Shown::Made));
        if let (None, false, Some(device)) = (&self.scene, self.is_refused, &self.device) {
            self.scene = Some(CompareScene::new(device));
        }
        if let Some(scene) = &mut self.scene {
            scene.keep_only(&std::iter::once(mesh));
        }
        let area = ui.available_rect_before_wrap();
        let (first, second) =
            if is_narrow { area.split_top_bottom_at_fraction(0.5) } else { area.split_left_right_at_fraction(0.5) };
        if let Some(made) = fitted_to.filter(|made| self.fitted.is_none_or(|(id, ..)| id != made.id)) {
            let before = self.fitted.map_or(views.camera, |(_, before, _)| before);
            views.camera.fit(&made.mesh.bounds(), first.width() / first.height().max(1.0));
            self.fitted = Some((made.id, before, views.camera));
        }
        let (document, keep) = (state.document.as_ref(), state.settings.keep);
        let shaded: &'static [Look] = if views.options.flat { &[Look::Flat] } else { &[Look::Shaded] };
        let titles = [say!("views-shaded-title"), say!("views-wireframe-title")];
        let count = say!("solver-triangles", count = triangles);
        let mut asked = None;
        let below = format!("{}: {count}", say!("solver-title"));
        for (i, (rect, looks)) in [(first, shaded), (second, &[Look::Wireframe][..])].into_iter().enumerate() {
            let rect = rect.shrink(0.5);
            let picture = ui.interact(rect, ui.scope_id().with(("picture", i)), Sense::click_and_drag());
            let label = format!("{}: {}", titles[i], say!("solver-title"));
            picture.widget_info(|| WidgetInfo::labeled(Role::Image, true, &label));
            self.picture(ui, i, rect, (mesh, ends), looks, views);
            let title = write(ui, rect, rect.min + vec2(12.0, 12.0), Align2::LEFT_TOP, &titles[i]);
            let heading = title.union(write(ui, rect, rect.min + vec2(12.0, 30.0), Align2::LEFT_TOP, &below));
            let axes = document.map(|document| document.import.axes).unwrap_or_default();
            overlay::scale_and_axes(ui, rect, &views.camera, axes);
            match (preparation.shown, &preparation.planned) {
                (Some(Shown::Cuts), Some(planned)) => {
                    asked = asked.or(cuts::rings(ui, i, rect, &views.camera, preparation, planned));
                }
                _ if i == 0 => names(ui, rect, heading, preparation, views),
                _ => {}
            }
            views.steer(ui, &picture, 1, document, keep);
            views.take_shape(rect, 1, document, keep);
        }
        asked
    }

    fn picture(
        &mut self,
        ui: &Ui,
        index: usize,
        rect: Rect,
        (mesh, ends): (&Arc<TriMesh>, &Arc<Vec<f32>>),
        looks: &'static [Look],
        views: &Views,
    ) {
        let style = Style {
            raking: views.options.raking,
            occlusion: views.options.occlusion,
            map: Some(arrays::colour_map()),
            labels: true,
            ..theme::style(ui.visuals())
        };
        let shot = Shot { camera: views.camera, size: pixels(ui, rect), looks, style };
        let failure = match &mut self.scene {
            Some(scene) => match scene.draw(index, mesh, Some(ends), &shot) {
                Ok(texture) => {
                    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                    ui.painter_at(rect).image(texture, rect, whole, Color32::WHITE);
                    return;
                }
                Err(error) => say!("compare-not-drawn", why = surface_error(&error)),
            },
            None if self.is_refused => NO_MEMORY.say(),
            None => say!("compare-no-device"),
        };
        ui.painter().rect_filled(rect, 0.0, ui.visuals().faint_bg_color);
        write(ui, rect, rect.center(), Align2::CENTER_CENTER, &failure);
    }
}

/// The names of the ends, where these are, or just below what is written there already.
fn names(ui: &Ui, rect: Rect, heading: Rect, preparation: &Preparation, views: &Views) {
    let patches = preparation.made.iter().flat_map(|made| &made.ready.patches);
    let mut written = vec![heading.expand(NAMES_APART)];
    for patch in patches.skip(1).take(NAMED) {
        let centre = Vec3::from_array(patch.centre.map(|x| x as f32));
        let Some(at) = seen(centre, &views.camera, rect).filter(|at| rect.contains(*at)) else { continue };
        let font = TextStyle::Small.resolve(ui.style());
        let size = ui.painter().layout_no_wrap(patch.name.clone(), font, Color32::PLACEHOLDER).size();
        // The name of an end at the border stays within it.
        let inside = rect.shrink(NAMES_APART).shrink2(size / 2.0);
        if inside.is_negative() {
            continue;
        }
        let mut place = Rect::from_center_size(inside.clamp(at), size);
        // Each step down passes one of them for good.
        while let Some(above) = written.iter().find(|above| above.intersects(place)) {
            place = place.translate(vec2(0.0, above.bottom() - place.top() + NAMES_APART));
        }
        if rect.contains_rect(place) {
            written.push(write(ui, rect, place.min, Align2::LEFT_TOP, &patch.name));
        }
    }
}

/// Writes a line; where it stands.
fn write(ui: &Ui, rect: Rect, at: egui::Pos2, align: Align2, text: &str) -> Rect {
    let (font, colour) = (TextStyle::Small.resolve(ui.style()), ui.visuals().text_color());
    halo::text(&ui.painter_at(rect), at, align, text, font, colour)
}

/// The colour of an end in the pictures.
pub(super) fn end_colour(place: usize) -> Color32 {
    let [r, g, b] = label_colour(place).0;
    Color32::from_rgb(r, g, b)
}
