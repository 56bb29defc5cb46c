//! One setting drawn: its picture or pictures, and below them what it is and what came of it. The same in the window
//! and in a figure.

use egui::{Align, Color32, Layout, Rect, RichText, Role, Ui, UiBuilder, pos2, vec2};

use super::arrangement::Arrangement;
use super::comparison::{Made, Outcome};
use super::scene::{CompareScene, Scalars, Shot};
use super::words::{self, Number};
use crate::app::assist::name;
use crate::app::halo;
use crate::app::overlay;
use crate::app::places::pixels;
use crate::io::Axes;
use crate::language::Key;
use crate::render::{Camera, Style, SurfaceError};
use crate::say;

/// How all cells of a grid are drawn.
#[derive(Clone, Copy)]
pub(super) struct Manner<'a> {
    pub(super) arrangement: Arrangement,
    pub(super) camera: &'a Camera,
    /// Each triangle with its own normal.
    pub(super) flat: bool,
    pub(super) style: Style,
    /// What the style's colour map shows.
    pub(super) scalars: Option<&'a Scalars>,
    /// Which way the patient lies, as far as that is known.
    pub(super) axes: Axes,
}

/// The most pictures that a cell has: the pictures of cell `i` are numbered from `i` times this.
const PICTURES: usize = 2;
/// Above this width of a cell, in points, its numbers stand in two columns.
const WIDE: f32 = 308.0;
/// Below this width its title may take two lines.
const NARROW: f32 = 240.0;
/// Height of a line of numbers, in points.
const LINE: f32 = 17.0;
const MARGIN: f32 = 8.0;

/// The height that the words below a picture take in a cell of this width.
pub(super) fn caption_height(width: f32) -> f32 {
    let lines = if width >= WIDE { 3 } else { 6 };
    2.0 * MARGIN + title_height(width) + LINE * lines as f32
}

/// The height of a title: of two lines where a cell is narrow.
fn title_height(width: f32) -> f32 {
    if width >= NARROW { 22.0 } else { 36.0 }
}

/// The pictures of cell `index` into `rect`; an even background until there is a result.
///
/// # Errors
/// When the surface does not fit into the memory that the device allows.
pub(super) fn pictures(
    ui: &Ui,
    scene: &mut CompareScene,
    index: usize,
    rect: Rect,
    made: &Made,
    manner: &Manner<'_>,
) -> Result<(), SurfaceError> {
    let looks = manner.arrangement.pictures(manner.flat);
    let height = rect.height() / looks.len() as f32;
    for (k, looks) in looks.iter().enumerate() {
        let top = rect.top() + height * k as f32;
        let rect = Rect::from_min_size(pos2(rect.left(), top), vec2(rect.width(), height));
        let shot = Shot { camera: *manner.camera, size: pixels(ui, rect), looks, style: manner.style };
        let texture = scene.draw(index * PICTURES + k, &made.mesh, manner.scalars, &shot)?;
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter_at(rect).image(texture, rect, whole, Color32::WHITE);
        overlay::scale_and_axes(ui, rect, manner.camera, manner.axes);
    }
    Ok(())
}

/// Words over the pictures in `rect`, in their upper left corner.
pub(super) fn note(ui: &mut Ui, rect: Rect, text: &str) {
    /// What the letters of the axes take.
    const AXES: f32 = 88.0;
    let is_small = rect.width() < NARROW;
    // Lines below one another beside the axes, where one would be cut.
    let size = vec2((rect.width() - AXES).max(AXES), if is_small { 3.0 * LINE } else { LINE });
    let rect = Rect::from_min_size(rect.min + vec2(MARGIN, MARGIN), size);
    let words = egui::Label::new(RichText::new(text).small()).selectable(false);
    let words = if is_small { words.wrap() } else { words.truncate() };
    place(ui, rect, Layout::top_down(Align::LEFT), |ui| {
        let (at, galley, response) = words.layout_in_ui(ui);
        halo::galley(ui.painter(), at, galley, ui.visuals().text_color());
        name(&response, Role::Label, text);
    });
}

/// The words below the pictures: a title and the numbers, or why there are none. `room` is kept free at the right of the
/// title, in points.
pub(super) fn caption(ui: &mut Ui, rect: Rect, title: &str, outcome: &Outcome, room: f32) {
    let inner = rect.shrink(MARGIN);
    let line = |top: f32, left: f32, width: f32| Rect::from_min_size(pos2(left, top), vec2(width, LINE));
    let top = inner.top() + title_height(rect.width());
    let above = Rect::from_min_max(inner.min, pos2(inner.right() - room, top));
    let text = egui::Label::new(RichText::new(title).strong());
    let text = if rect.width() >= NARROW { text.truncate() } else { text.wrap() };
    place(ui, above, Layout::top_down(Align::LEFT), |ui| ui.add(text)).on_hover_text(title.to_owned());
    let report = match outcome {
        Outcome::Done(made) => &made.report,
        Outcome::Waiting | Outcome::Failed(_) => {
            let text = if let Outcome::Failed(reason) = outcome { reason.clone() } else { say!("compare-waiting") };
            let rest = Rect::from_min_max(pos2(inner.left(), top), inner.max);
            let text = egui::Label::new(RichText::new(text).small().weak()).wrap();
            place(ui, rest, Layout::top_down(Align::LEFT), |ui| ui.add(text));
            return;
        }
    };
    let numbers = words::numbers(report);
    let (counts, deviations) = numbers.split_at(3);
    let head = Number { what: Key("compare-deviation"), how_much: say!("compare-deviation-unit"), help: None };
    let column = |ui: &mut Ui, left: f32, width: f32, top: f32, numbers: &mut dyn Iterator<Item = &Number>| {
        for (i, number) in numbers.enumerate() {
            row(ui, line(top + LINE * i as f32, left, width), number);
        }
    };
    let deviations = || std::iter::once(&head).chain(deviations);
    if rect.width() >= WIDE {
        let left = inner.width() * 0.38 - MARGIN;
        column(ui, inner.left(), left, top, &mut counts.iter());
        column(ui, inner.left() + left + 2.0 * MARGIN, inner.width() - left - 2.0 * MARGIN, top, &mut deviations());
    } else {
        column(ui, inner.left(), inner.width(), top, &mut counts.iter().chain(deviations()));
    }
}

/// What a number is on the left, how much on the right.
fn row(ui: &mut Ui, rect: Rect, number: &Number) {
    let response = place(ui, rect, Layout::left_to_right(Align::Center), |ui| {
        ui.label(RichText::new(number.what.say()).small().weak());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add(egui::Label::new(RichText::new(&number.how_much).small()).truncate())
        })
        .inner
    });
    if let Some(help) = number.help {
        response.on_hover_text(help.say());
    }
}

/// Shows something in `rect` that does not change what stands around it.
fn place<R>(ui: &mut Ui, rect: Rect, layout: Layout, show: impl FnOnce(&mut Ui) -> R) -> R {
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).layout(layout));
    child.spacing_mut().interact_size.y = LINE;
    child.spacing_mut().item_spacing = vec2(MARGIN, 0.0);
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    show(&mut child)
}
