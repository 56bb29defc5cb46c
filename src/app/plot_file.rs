//! A plot as a file: what stands in the window, under its title, as SVG or as PNG. A menu in the plot's corner asks for it,
//! and the window takes what was asked for once in a frame ([`PlotFile::take`]), so that no panel has to hand it on.

use std::sync::Arc;

use egui::epaint::TextShape;
use egui::layers::PaintList;
use egui::{Color32, Context, FontId, Id, LayerId, Painter, Pos2, Rect, Shape, Ui, UiBuilder, Vec2, pos2, vec2};

use super::icon::Icon;
use super::menus::icon_menu;
use super::{svg, theme};
use crate::say;

/// Around the plot, and between the names of its curves, in points.
const MARGIN: f32 = 10.0;
/// Letters of the title, and of the rest.
const TITLE: f32 = 14.0;
const SMALL: f32 = 10.0;
/// Pixels across a plot as PNG: as many as a projector has.
const PIXELS: f32 = 1920.0;

/// How a plot is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlotFormat {
    /// Lines and letters.
    Svg,
    /// Pixels.
    Png,
}

/// A plot to be saved: what it is drawn of, from the upper left corner of a picture.
#[derive(Clone, Debug)]
pub(super) struct PlotFile {
    /// What its file is called, without what the surface is called and without extension.
    pub(super) stem: &'static str,
    pub(super) format: PlotFormat,
    /// In points.
    size: Vec2,
    ground: Color32,
    /// Each with what it is clipped to, what lies below first.
    shapes: Vec<(Rect, Shape)>,
}

impl PlotFile {
    fn id() -> Id {
        Id::unique("plot to be saved")
    }

    /// What was asked for since this was last called.
    pub(super) fn take(ctx: &Context) -> Option<Arc<Self>> {
        ctx.data_mut(|data| data.remove_temp::<Option<Arc<Self>>>(Self::id()).flatten())
    }

    /// It as SVG.
    pub(super) fn svg(&self) -> String {
        svg::written(self.size, self.ground, &self.shapes)
    }

    /// Pixels of it as PNG, at most `limit` in each direction, and how many of them a point has.
    pub(super) fn pixels(&self, limit: u32) -> ([u32; 2], f32) {
        let scale = (PIXELS / self.size.x).min(limit as f32 / self.size.max_elem());
        ([self.size.x, self.size.y].map(|points| (points * scale) as u32), scale)
    }

    /// Draws it, letters laid out anew: they have other pixels here.
    pub(super) fn paint(&self, painter: &Painter) {
        painter.rect_filled(Rect::EVERYTHING, 0.0, self.ground);
        for (clip, shape) in &self.shapes {
            let shape = match shape {
                Shape::Text(text) => {
                    let galley = painter.layout_job((*text.galley.job).clone());
                    Shape::Text(TextShape { galley, ..text.clone() })
                }
                other => other.clone(),
            };
            painter.with_clip_rect(*clip).add(shape);
        }
    }
}

/// A plot that has just been drawn.
pub(super) struct Drawn<'a> {
    /// What its file is called, without what the surface is called and without extension.
    pub(super) stem: &'static str,
    /// What it shows.
    pub(super) title: &'a str,
    /// The curves that have no name within it, and their colours.
    pub(super) legend: &'a [(&'a str, Color32)],
    /// All that it takes, marks of its axes included.
    pub(super) whole: Rect,
    /// What is within its axes.
    pub(super) frame: Rect,
}

impl Drawn<'_> {
    /// Puts the menu into the lower right corner, below the marks of the axis.
    pub(super) fn offer(&self, ui: &mut Ui) {
        let layer = ui.layer_id();
        let count = ui.ctx().graphics(|layers| layers.get(layer).map_or(0, |list| list.all_entries().len()));
        let size = Vec2::splat(theme::row(ui.ctx(), 20.0));
        let mut corner = ui.new_child(UiBuilder::new().max_rect(Rect::from_min_size(self.whole.max - size, size)));
        icon_menu(
            &mut corner,
            Icon::Save,
            &say!("record-plot", title = self.title),
            &say!("record-plot-help"),
            &mut |ui| {
                for (format, text, help) in [
                    (PlotFormat::Svg, say!("record-plot-svg"), say!("record-plot-svg-help")),
                    (PlotFormat::Png, say!("record-plot-png"), say!("record-plot-png-help")),
                ] {
                    if ui.button(text).on_hover_text(help).clicked() {
                        let file = self.file(ui, format, entries(ui.ctx(), layer, count));
                        ui.data_mut(|data| data.insert_temp(PlotFile::id(), Some(Arc::new(file))));
                    }
                }
            },
        );
    }

    /// The plot under title and names of curves, above the disclaimer; `below` is what its layer has of this frame.
    fn file(&self, ui: &Ui, format: PlotFormat, below: Vec<(Rect, Shape)>) -> PlotFile {
        let visuals = ui.visuals();
        let (ink, weak) = (visuals.text_color(), visuals.weak_text_color());
        let width = self.whole.width();
        let mut shapes = Vec::new();
        let text = |at: Pos2, text: &str, size: f32, colour: Color32| {
            let galley = ui.painter().layout(text.to_owned(), FontId::proportional(size), colour, width);
            let rect = Rect::from_min_size(at, galley.size());
            ((Rect::EVERYTHING, Shape::galley(at, galley, colour)), rect)
        };
        let (title, at) = text(Pos2::ZERO + Vec2::splat(MARGIN), self.title, TITLE, ink);
        shapes.push(title);
        let mut next = pos2(MARGIN, at.bottom() + 2.0);
        let mut bottom = at.bottom();
        for &(name, colour) in self.legend {
            let mut placed = text(next, name, SMALL, colour);
            if placed.1.right() > MARGIN + width && next.x > MARGIN {
                placed = text(pos2(MARGIN, bottom), name, SMALL, colour);
            }
            bottom = placed.1.bottom();
            next = placed.1.right_top() + vec2(MARGIN, 0.0);
            shapes.push(placed.0);
        }
        let move_by = pos2(MARGIN, bottom + 6.0) - self.whole.min;
        let picture = self.whole.translate(move_by);
        for (clip, mut shape) in below {
            // Of the layer, what is of the plot, whatever of it was scrolled out of sight.
            let within = if self.frame.expand(1.0).contains_rect(clip) { self.frame } else { self.whole };
            // A line may leave the axes, where it is clipped.
            let bounds = shape.visual_bounding_rect();
            let seen = if within == self.frame { bounds.intersect(within) } else { bounds };
            if !self.whole.expand(2.0).contains_rect(seen) {
                continue;
            }
            shape.translate(move_by);
            shapes.push((within.translate(move_by), shape));
        }
        let (foot, at) = text(pos2(MARGIN, picture.bottom() + 6.0), &say!("about-not-clinical"), SMALL, weak);
        shapes.push(foot);
        let size = vec2(width + 2.0 * MARGIN, at.bottom() + MARGIN);
        PlotFile { stem: self.stem, format, size, ground: visuals.panel_fill.to_opaque(), shapes }
    }
}

/// The first `count` shapes that a layer has of this frame.
fn entries(ctx: &Context, layer: LayerId, count: usize) -> Vec<(Rect, Shape)> {
    ctx.graphics(|layers| {
        let list = layers.get(layer).into_iter().flat_map(PaintList::all_entries);
        list.take(count).map(|entry| (entry.clip_rect, entry.shape.clone())).collect()
    })
}
