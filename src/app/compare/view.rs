//! The compare view in the window: a bar with what can be done, the grid, and a line on what all cells share.

use egui::{ComboBox, Frame, Margin, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui};
use egui::{UiBuilder, WidgetInfo, pos2, vec2};

use super::action::Action as OfComparison;
use super::arrangement::Arrangement;
use super::cell::{self, Manner};
use super::comparison::{Cell, Comparison, MOST, Outcome};
use super::scene::CompareScene;
use super::words;
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::document::Document;
use crate::app::icon::{self, Icon};
use crate::app::overlay::NOT_CLINICAL;
use crate::app::theme;
use crate::app::views::{NO_MEMORY, Views};
use crate::pipeline::settings::Settings;

/// A picture is at least this high, in points; a grid that does not fit scrolls.
const LEAST_PICTURE: f32 = 132.0;
/// Cells of more triangles may turn jerkily.
const MANY: usize = 300_000;

/// The view: what of it stands in GPU memory.
pub(in crate::app) struct CompareView {
    device: Option<egui_wgpu::RenderState>,
    /// Made when the view is first shown.
    scene: Option<CompareScene>,
    /// Whether the device had no memory for it.
    is_refused: bool,
    /// Whether the pointer was over a picture, where the wheel zooms; elsewhere it scrolls.
    over_picture: bool,
}

impl CompareView {
    /// A view on the window's device; without one (in some tests) it says so.
    pub(in crate::app) fn new(device: Option<&egui_wgpu::RenderState>) -> Self {
        Self { device: device.cloned(), scene: None, is_refused: false, over_picture: false }
    }

    /// Lets go of GPU memory, for while the view is not shown.
    pub(in crate::app) fn let_go(&mut self) {
        (self.scene, self.is_refused) = (None, false);
    }

    /// Gives up what stands on the device, whose memory is full, until the view is shown anew.
    pub(in crate::app) fn refuse(&mut self) {
        self.is_refused |= self.scene.take().is_some();
    }

    /// Shows the comparison in what is left of `ui`; `settings` are those in force.
    pub(in crate::app) fn show(
        &mut self,
        ui: &mut Ui,
        comparison: &Comparison,
        views: &mut Views,
        settings: &Settings,
        document: Option<&Document>,
        is_narrow: bool,
    ) -> Vec<Action> {
        let mut asked = Vec::new();
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
        Frame::new().fill(fill).inner_margin(Margin::symmetric(8, 6)).show(ui, |ui| {
            ui.set_min_width(ui.available_width());
            bar(ui, comparison, settings, is_narrow, &mut asked);
        });
        let all: Vec<_> = comparison.cells().iter().map(|cell| &cell.settings).collect();
        let (shared, titles) = words::titles(&all);
        let foot = if is_narrow { 44.0 } else { 28.0 };
        let area = ui.available_rect_before_wrap();
        let (grid, foot) = area.split_top_bottom_at_y(area.bottom() - foot);
        ui.painter().rect_filled(foot, 0.0, fill);
        let name = document.map_or("", |document| document.name.as_str());
        ui.scope_builder(UiBuilder::new().max_rect(foot.shrink2(vec2(12.0, 4.0))), |ui| {
            footer(ui, name, &shared, slow(comparison), is_narrow);
        });
        ui.scope_builder(UiBuilder::new().max_rect(grid), |ui| {
            asked.extend(self.grid(ui, comparison, &titles, views, settings, document, is_narrow));
        });
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
                ui.label("Nothing is compared yet: add the current settings, or take those of a figure of the paper.");
            });
            return None;
        }
        let columns = columns(count, is_narrow);
        let rows = count.div_ceil(columns);
        let width = area.width() / columns as f32;
        let least = cell::caption_height(width) + LEAST_PICTURE * comparison.arrangement.rows() as f32;
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
                let manner = Manner {
                    arrangement: comparison.arrangement,
                    camera: &camera,
                    flat: views.options.flat,
                    style: theme::style(ui.visuals()),
                    axes: document.map(|document| document.import.axes).unwrap_or_default(),
                };
                let shown = ui.push_id(cell.id, |ui| self.cell(ui, i, rect, cell, title, &manner, settings)).inner;
                let rows = comparison.arrangement.rows();
                views.steer(ui, &shown.picture, rows, document, settings.keep);
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
    ) -> Shown {
        const ROOM: f32 = 28.0;
        let is_current = cell.settings == *settings;
        let (above, below) = rect.split_top_bottom_at_y(rect.bottom() - cell::caption_height(rect.width()));
        let picture = ui.interact(above, ui.scope_id().with("picture"), Sense::click_and_drag());
        picture.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, is_current, title));
        let words = ui.interact(below, ui.scope_id().with("words"), Sense::CLICK);
        let (mut asked, mut failure) = (None, None);
        match (&cell.outcome, &mut self.scene) {
            (Outcome::Done(made), Some(scene)) => {
                if let Err(error) = cell::pictures(ui, scene, index, above, made, manner) {
                    failure = Some(format!("The surface cannot be drawn: {error}."));
                }
            }
            (Outcome::Done(_), None) if self.is_refused => failure = Some(NO_MEMORY.to_owned()),
            (Outcome::Done(_), None) => failure = Some("There is no graphics device to draw with.".to_owned()),
            (Outcome::Waiting | Outcome::Failed(_), _) => {
                ui.painter().rect_filled(above, 0.0, ui.visuals().faint_bg_color);
            }
        }
        if matches!(cell.outcome, Outcome::Waiting) {
            ui.place(Rect::from_center_size(above.center(), vec2(24.0, 24.0)), egui::Spinner::new());
        }
        if matches!(cell.outcome, Outcome::Failed(_)) {
            let button = egui::Button::new("Try again");
            if ui.place(Rect::from_center_size(above.center(), vec2(96.0, 28.0)), button).clicked() {
                asked = Some(Action::Comparison(OfComparison::Retry(cell.id)));
            }
        }
        if let Some(failure) = failure {
            let font = egui::TextStyle::Small.resolve(ui.style());
            let colour = ui.visuals().text_color();
            ui.painter_at(above).text(above.center(), egui::Align2::CENTER_CENTER, failure, font, colour);
        }
        cell::caption(ui, below, title, &cell.outcome, ROOM);
        let corner = Rect::from_min_size(pos2(below.right() - 26.0, below.top() + 6.0), vec2(20.0, 20.0));
        let close = ui.scope_builder(UiBuilder::new().max_rect(corner), |ui| {
            icon::button(ui, Icon::Close, true, &format!("Remove {title}"), "Compare this no more")
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

/// What can be done.
fn bar(ui: &mut Ui, comparison: &Comparison, settings: &Settings, is_narrow: bool, asked: &mut Vec<Action>) {
    let mut ask = |what| asked.push(Action::Comparison(what));
    ui.horizontal_wrapped(|ui| {
        let can_add = comparison.can_add(settings);
        let add = ui.add_enabled(can_add, egui::Button::new(if is_narrow { "Add" } else { "Add current" }));
        name(&add, Role::Button, "Add current settings");
        let why_not = if comparison.cells().len() >= MOST {
            "Six are compared at most: remove one first"
        } else {
            "The current settings are compared already"
        };
        if add.on_hover_text("Compare the current settings too").on_disabled_hover_text(why_not).clicked() {
            ask(OfComparison::Add);
        }
        if ui.button("Figure 6").on_hover_text("The six smoothing settings of the paper's Figure 6").clicked() {
            ask(OfComparison::Figure6);
        }
        if ui.button("Figure 7").on_hover_text("The three reduction rates of the paper's Figure 7").clicked() {
            ask(OfComparison::Figure7);
        }
        let mut chosen = comparison.arrangement;
        let list = ComboBox::from_id_salt("arrangement").width(96.0).selected_text(comparison.arrangement.label());
        let response = list.show_ui(ui, |ui| {
            for choice in Arrangement::ALL {
                ui.selectable_value(&mut chosen, choice, choice.label()).on_hover_text(choice.help());
            }
        });
        name(&response.response, Role::ComboBox, "Show as");
        if chosen != comparison.arrangement {
            ask(OfComparison::Arrange(chosen));
        }
        if ui.button("Done").on_hover_text("Back to the two views (C)").clicked() {
            ask(OfComparison::Close);
        }
    });
}

/// A word on cells that are slow to draw, if there are any.
fn slow(comparison: &Comparison) -> &'static str {
    let is_large = |cell: &Cell| matches!(&cell.outcome, Outcome::Done(made) if made.mesh.triangles.len() > MANY);
    if comparison.cells().iter().any(is_large) { "more than 300,000 triangles a cell: turning may be slow" } else { "" }
}

/// What all cells share, and what stands in every picture.
fn footer(ui: &mut Ui, document: &str, shared: &str, slow: &str, is_narrow: bool) {
    let text = [document, shared, slow].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("  ·  ");
    let layout = if is_narrow {
        egui::Layout::top_down(egui::Align::LEFT)
    } else {
        egui::Layout::right_to_left(egui::Align::Center)
    };
    ui.with_layout(layout, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        if is_narrow {
            ui.add(egui::Label::new(RichText::new(&text).small().weak()).truncate()).on_hover_text(&text);
            ui.label(RichText::new(NOT_CLINICAL).small().weak());
        } else {
            ui.label(RichText::new(NOT_CLINICAL).small().weak());
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                ui.add(egui::Label::new(RichText::new(&text).small().weak()).truncate()).on_hover_text(&text);
            });
        }
    });
}
