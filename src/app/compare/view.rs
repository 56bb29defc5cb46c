//! The compare view in the window: the grid of cells under one camera, and what of it stands in GPU memory. What
//! stands around the grid is in `bar`.

use egui::{Frame, Margin, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui};
use egui::{UiBuilder, Vec2, WidgetInfo, vec2};

use super::action::Action as OfComparison;
use super::bar::{bar, footer, legend, slow};
use super::cell::{self, Manner};
use super::comparison::{Cell, Comparison, Made, Outcome};
use super::scene::CompareScene;
use super::words;
use crate::app::action::Action;
use crate::app::assist::heading;
use crate::app::document::Document;
use crate::app::graphics_error::surface_error;
use crate::app::halo;
use crate::app::icon::{self, Icon};
use crate::app::state::State;
use crate::app::theme;
use crate::app::views::{NO_MEMORY, Views};
use crate::pipeline::settings::Settings;
use crate::render::{Camera, ColourMap, Style};
use crate::say;

/// A picture is at least this high, in points; a grid that does not fit scrolls.
const MIN_PICTURE: f32 = 132.0;
/// The view: what of it stands in GPU memory.
#[derive(Default)]
pub(in crate::app) struct CompareView {
    device: Option<egui_wgpu::RenderState>,
    /// Made when the view is first shown.
    scene: Option<CompareScene>,
    /// Whether the device had no memory for it.
    is_refused: bool,
    /// Whether the pointer was over a picture, where the wheel zooms; elsewhere it scrolls.
    over_picture: bool,
    /// Whether every cell shows the result of the first: the eye sees what moves where one takes the other's place.
    shows_first: bool,
    /// The camera, as long as the view is shown.
    look: Look,
}

/// Where the view looks: it opens on where the surfaces differ most, unless the user looks somewhere else meanwhile.
#[derive(Default)]
struct Look {
    /// From where it looked at the end of the last frame.
    last: Option<Camera>,
    was_moved: bool,
    has_gone: bool,
    /// From where it looked before it went there by itself, and from where then.
    went: Option<[Camera; 2]>,
}

impl Look {
    /// Goes once, when all differences are known; not on a phone, whose small pictures would show a patch of wall.
    fn follow(&mut self, comparison: &Comparison, camera: &mut Camera, is_narrow: bool) {
        if let Some(largest) = comparison.largest_difference().filter(|_| !self.has_gone) {
            self.has_gone = true;
            if let Some((at, height_mm)) = largest.patch().filter(|_| !self.was_moved && !is_narrow) {
                let before = *camera;
                camera.focus(at, height_mm);
                self.went = Some([before, *camera]);
            }
        }
        self.last = Some(*camera);
    }
}

impl CompareView {
    /// A view on the window's device; without one (in some tests) it says so.
    pub(super) fn new(device: Option<&egui_wgpu::RenderState>) -> Self {
        let look = Look::default();
        Self { device: device.cloned(), scene: None, is_refused: false, over_picture: false, shows_first: false, look }
    }

    /// Lets go of GPU memory, for while the view is not shown; and of the camera, which looks from where it did before it
    /// went somewhere by itself.
    pub(super) fn leave(&mut self, views: &mut Views) {
        (self.scene, self.is_refused) = (None, false);
        if let Some([before, at]) = std::mem::take(&mut self.look).went
            && views.camera == at
        {
            views.camera = before;
        }
    }

    /// Gives up what stands on the device, whose memory is full, until the view is shown anew.
    pub(super) fn give_up(&mut self) {
        self.is_refused |= self.scene.take().is_some();
    }

    /// Shows the comparison in what is left of `ui`.
    pub(super) fn show_cells(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) -> Vec<Action> {
        let State { comparison, settings, document, .. } = state;
        let document = document.as_ref();
        let mut asked = Vec::new();
        // Who has chosen a place looks there, whatever else is to be seen.
        self.look.was_moved |= self.look.last.map_or(!views.is_fitted(), |last| last != views.camera);
        if let (None, false, Some(device)) = (&self.scene, self.is_refused, &self.device) {
            self.scene = Some(CompareScene::new(device));
        }
        let made = comparison.cells().iter().filter_map(|cell| match &cell.outcome {
            Outcome::Done(made) => Some(&made.mesh),
            Outcome::Waiting | Outcome::Failed(_) => None,
        });
        if let Some(scene) = &mut self.scene {
            scene.keep_only(&made);
        }
        let fill = ui.visuals().panel_fill;
        ui.spacing_mut().item_spacing.y = 1.0;
        let all: Vec<_> = comparison.cells().iter().map(|cell| &cell.settings).collect();
        Frame::new().fill(fill).inner_margin(Margin::symmetric(8, 6)).show(ui, |ui| {
            ui.set_min_width(ui.available_width());
            let (title, figure) = words::heading(&all);
            heading(ui, &title);
            if !figure.is_empty() && !is_narrow {
                ui.label(RichText::new(figure).small().weak());
            }
            let is_held = bar(ui, state, is_narrow, self.shows_first, &mut asked);
            let by_key = ui.input(|input| input.key_down(egui::Key::X)) && !ui.ctx().text_edit_focused();
            self.shows_first = is_held || by_key;
            if comparison.shows_difference && comparison.cells().len() > 1 {
                legend(ui, comparison);
            }
        });
        let (shared, titles) = words::titles(&all);
        let foot = if is_narrow { 44.0 } else { 28.0 };
        let area = ui.available_rect_before_wrap();
        let (grid, foot) = area.split_top_bottom_at_y(area.bottom() - foot);
        ui.painter().rect_filled(foot, 0.0, fill);
        let name = document.map_or_else(Default::default, Document::title);
        ui.scope_builder(UiBuilder::new().max_rect(foot.shrink2(vec2(12.0, 4.0))), |ui| {
            footer(ui, &name, &shared, &slow(comparison), is_narrow);
        });
        ui.scope_builder(UiBuilder::new().max_rect(grid), |ui| {
            asked.extend(self.grid(ui, comparison, &titles, views, settings, document, is_narrow));
        });
        let before = views.camera;
        self.look.follow(comparison, &mut views.camera, is_narrow);
        if views.camera != before {
            ui.ctx().request_repaint();
        }
        asked
    }

    #[expect(clippy::too_many_arguments, reason = "one call, and a struct would only name the same things again")]
    fn grid(
        &mut self,
        ui: &mut Ui,
        comparison: &Comparison,
        titles: &[String],
        views: &mut Views,
        settings: &Settings,
        document: Option<&Document>,
        is_narrow: bool,
    ) -> Option<Action> {
        let area = ui.available_rect_before_wrap();
        let count = comparison.cells().len();
        if count == 0 {
            ui.painter().rect_filled(area, 0.0, ui.visuals().panel_fill);
            ui.scope_builder(UiBuilder::new().max_rect(area.shrink(24.0)), |ui| {
                ui.label(say!("compare-nothing"));
            });
            return None;
        }
        let first = comparison.cells().first().filter(|_| self.shows_first).and_then(|cell| match &cell.outcome {
            Outcome::Done(made) => Some(&**made),
            Outcome::Waiting | Outcome::Failed(_) => None,
        });
        let columns = columns(count, is_narrow);
        let rows = count.div_ceil(columns);
        let width = area.width() / columns as f32;
        let least = cell::caption_height(width) + MIN_PICTURE * comparison.arrangement.rows() as f32;
        let height = (area.height() / rows as f32).floor().max(least);
        let source =
            egui::containers::scroll_area::ScrollSource { mouse_wheel: !self.over_picture, ..Default::default() };
        let mut asked = None;
        let mut over_picture = false;
        ScrollArea::vertical().auto_shrink(false).scroll_source(source).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            let (whole, _) = ui.allocate_exact_size(vec2(area.width(), height * rows as f32), Sense::hover());
            ui.painter().rect_filled(whole, 0.0, ui.visuals().panel_fill);
            for (i, (cell, title)) in comparison.cells().iter().zip(titles).enumerate() {
                let corner = whole.min + vec2(width * (i % columns) as f32, height * (i / columns) as f32);
                let rect = Rect::from_min_size(corner, vec2(width, height)).shrink(0.5);
                let camera = views.camera;
                let is_coloured = comparison.shows_difference && first.is_none();
                let difference = comparison.difference(cell).filter(|_| is_coloured && i > 0);
                let scalars = difference.map(|found| &found.by_vertex).filter(|values| !values.is_empty());
                let most = scalars.and(comparison.colours_up_to_mm());
                let map = most.map(|most| ColourMap { range: (0.0, most) });
                // The first is told to be the reference, coloured or not. While its settings are shown everywhere, no cell is.
                let note = if i == 0 && count > 1 && first.is_none() {
                    say!("compare-reference")
                } else {
                    difference.map_or(String::new(), words::difference)
                };
                let manner = Manner {
                    arrangement: comparison.arrangement,
                    camera: &camera,
                    flat: views.options.flat,
                    style: Style {
                        raking: views.options.raking,
                        occlusion: views.options.occlusion,
                        map,
                        ..theme::style(ui.visuals())
                    },
                    scalars,
                    axes: document.map(|document| document.import.axes).unwrap_or_default(),
                };
                let shown =
                    ui.push_id(cell.id, |ui| self.cell(ui, i, rect, cell, title, &manner, settings, first)).inner;
                if !note.is_empty() {
                    cell::note(ui, shown.picture.rect, &note);
                }
                let rows = comparison.arrangement.rows();
                views.steer(ui, &shown.picture, rows, document, settings.keep);
                self.look.was_moved |= views.camera != camera;
                views.take_shape(shown.picture.rect, rows, document, settings.keep);
                over_picture |= shown.picture.contains_pointer();
                asked = asked.take().or(shown.asked);
            }
        });
        self.over_picture = over_picture;
        asked
    }

    #[expect(clippy::too_many_arguments, reason = "one call, and a struct would only name the same things again")]
    fn cell(
        &mut self,
        ui: &mut Ui,
        index: usize,
        rect: Rect,
        cell: &Cell,
        title: &str,
        manner: &Manner<'_>,
        settings: &Settings,
        first: Option<&Made>,
    ) -> Shown {
        let side = theme::row(ui.ctx(), 20.0);
        let is_current = cell.settings == *settings;
        let (above, below) = rect.split_top_bottom_at_y(rect.bottom() - cell::caption_height(rect.width()));
        let picture = ui.interact(above, ui.scope_id().with("picture"), Sense::click_and_drag());
        picture.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, is_current, title));
        let words = ui.interact(below, ui.scope_id().with("words"), Sense::CLICK);
        let (mut asked, mut failure) = (None, None);
        match (&cell.outcome, &mut self.scene) {
            (Outcome::Done(made), Some(scene)) => {
                let made = first.unwrap_or(made);
                if let Err(error) = cell::pictures(ui, scene, index, above, made, manner) {
                    failure = Some(say!("compare-not-drawn", why = surface_error(&error)));
                }
            }
            (Outcome::Done(_), None) if self.is_refused => failure = Some(NO_MEMORY.say()),
            (Outcome::Done(_), None) => failure = Some(say!("compare-no-device")),
            (Outcome::Waiting | Outcome::Failed(_), _) => {
                ui.painter().rect_filled(above, 0.0, ui.visuals().faint_bg_color);
            }
        }
        if first.is_some() {
            let (font, colour) = (egui::TextStyle::Small.resolve(ui.style()), ui.visuals().text_color());
            let at = above.left_top() + vec2(10.0, 8.0);
            halo::text(
                &ui.painter_at(above),
                at,
                egui::Align2::LEFT_TOP,
                &say!("compare-first-settings"),
                font,
                colour,
            );
        }
        if matches!(cell.outcome, Outcome::Waiting) {
            ui.place(Rect::from_center_size(above.center(), vec2(24.0, 24.0)), egui::Spinner::new());
        }
        if matches!(cell.outcome, Outcome::Failed(_)) {
            let button = egui::Button::new(say!("compare-try-again"));
            if ui
                .place(Rect::from_center_size(above.center(), vec2(96.0, theme::row(ui.ctx(), 28.0))), button)
                .clicked()
            {
                asked = Some(Action::Comparison(OfComparison::Retry(cell.id)));
            }
        }
        if let Some(failure) = failure {
            let font = egui::TextStyle::Small.resolve(ui.style());
            let colour = ui.visuals().text_color();
            let middle = above.center();
            halo::text(&ui.painter_at(above), middle, egui::Align2::CENTER_CENTER, &failure, font, colour);
        }
        cell::caption(ui, below, title, &cell.outcome, side + 8.0);
        // Beside the lines of the cell, where a small one has room for that.
        let corner = below.right_top() + vec2(-1.0, 1.0) * (side / 2.0).max(16.0);
        let corner = Rect::from_center_size(corner, Vec2::splat(side));
        let close = ui.scope_builder(UiBuilder::new().max_rect(corner), |ui| {
            icon::button(ui, Icon::Close, true, &say!("compare-remove", title = title), &say!("compare-remove-help"))
        });
        frame(ui, rect, &picture, words.hovered(), is_current);
        if close.inner.clicked() {
            asked = Some(Action::Comparison(OfComparison::Remove(cell.id)));
        } else if picture.clicked() || words.clicked() {
            let choice = || Action::Set(Box::new(Settings { keep: settings.keep, ..cell.settings.clone() }));
            asked = asked.or_else(|| Some(choice()));
        }
        Shown { picture, asked }
    }
}

/// A cell that was shown.
struct Shown {
    picture: Response,
    asked: Option<Action>,
}

/// The lines around a cell: the current one's in the accent, the focused one's and the hovered one's as of a button.
fn frame(ui: &Ui, rect: Rect, picture: &Response, is_hovered: bool, is_current: bool) {
    let visuals = ui.visuals();
    let stroke = if picture.has_focus() {
        Stroke::new(3.0, visuals.hyperlink_color)
    } else if is_current {
        Stroke::new(2.0, visuals.hyperlink_color)
    } else if picture.hovered() || is_hovered {
        Stroke::new(1.0, visuals.weak_text_color())
    } else {
        Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color)
    };
    ui.painter().rect_stroke(rect, 0.0, stroke, StrokeKind::Inside);
}

/// How many cells stand side by side.
fn columns(count: usize, is_narrow: bool) -> usize {
    match count {
        _ if is_narrow => count.min(2),
        4 => 2,
        _ => count.min(3),
    }
}
