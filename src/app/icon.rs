//! Small icons, drawn as strokes so that they need no font of symbols.

use std::f32::consts::{PI, TAU};

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, pos2, vec2};

use super::theme;

/// An icon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Icon {
    /// An arrow that turns back.
    Undo,
    /// An arrow that turns forth.
    Redo,
    /// A round arrow.
    Reset,
    /// Half light, half dark.
    Theme,
    /// Three lines.
    Menu,
    /// A cross.
    Close,
    /// A picture in two halves.
    Split,
    /// A clock.
    Before,
    /// An eye.
    View,
    /// A question mark.
    Help,
    /// The letter i.
    About,
    /// A triangle that points down.
    Down,
    /// An arrow down, onto a line.
    Save,
}

/// A button that is an icon. `label` is its name for assistive tools and stands over its `help`, which says what it does.
pub(super) fn button(ui: &mut Ui, icon: Icon, enabled: bool, label: &str, help: &str) -> Response {
    let response = sensed(ui, icon, enabled, Sense::click(), label, help);
    response.widget_info(|| egui::WidgetInfo::labeled(Role::Button, enabled && ui.is_enabled(), label));
    response
}

/// The same for one that is on or off.
pub(super) fn toggle(ui: &mut Ui, icon: Icon, enabled: bool, is_on: bool, label: &str, help: &str) -> Response {
    held(ui, icon, enabled, is_on, Sense::click(), label, help)
}

/// The same for one that is on for as long as it is held.
pub(super) fn hold(ui: &mut Ui, icon: Icon, enabled: bool, is_on: bool, label: &str, help: &str) -> Response {
    held(ui, icon, enabled, is_on, Sense::click_and_drag(), label, help)
}

fn held(ui: &mut Ui, icon: Icon, enabled: bool, is_on: bool, sense: Sense, label: &str, help: &str) -> Response {
    let is_filled = is_on && enabled && ui.is_enabled();
    let under = ui.painter().add(Shape::Noop);
    let response = ui
        .scope(|ui| {
            if is_filled {
                ui.visuals_mut().widgets.inactive.fg_stroke.color = ui.visuals().selection.stroke.color;
            }
            sensed(ui, icon, enabled, sense, label, help)
        })
        .inner;
    if is_filled && !(response.hovered() || response.has_focus()) {
        ui.painter().set(under, Shape::rect_filled(response.rect, 4.0, ui.visuals().selection.bg_fill));
    }
    response.widget_info(|| egui::WidgetInfo::selected(Role::Button, enabled && ui.is_enabled(), is_on, label));
    response
}

fn sensed(ui: &mut Ui, icon: Icon, enabled: bool, sense: Sense, label: &str, help: &str) -> Response {
    let enabled = enabled && ui.is_enabled();
    let size = match icon {
        Icon::Reset | Icon::Close | Icon::Save => vec2(1.0, 1.0) * theme::row(ui.ctx(), 20.0),
        Icon::Down => vec2(theme::row(ui.ctx(), 20.0), ui.spacing().interact_size.y),
        _ => vec2(1.0, 1.0) * ui.spacing().interact_size.y,
    };
    let sense = if enabled { sense } else { Sense::hover() };
    let (rect, response) = ui.allocate_exact_size(size, sense);
    let visuals = ui.style().interact(&response);
    if enabled && (response.hovered() || response.has_focus()) {
        ui.painter().rect(rect, 4.0, visuals.weak_bg_fill, visuals.bg_stroke, egui::StrokeKind::Inside);
    }
    let colour = if enabled { visuals.fg_stroke.color } else { ui.visuals().weak_text_color().gamma_multiply(0.5) };
    draw(ui.painter(), rect, icon, colour);
    response.on_hover_ui(|ui| {
        // Such as "Undo (Ctrl+Z)".
        if !help.starts_with(label) {
            ui.strong(label);
        }
        ui.label(help);
    })
}

fn draw(painter: &Painter, rect: Rect, icon: Icon, colour: Color32) {
    let (middle, radius) = (rect.center(), 6.0);
    let stroke = Stroke::new(1.5, colour);
    let on_circle = |angle: f32| middle + vec2(angle.cos(), angle.sin()) * radius;
    match icon {
        Icon::Undo => arrow(painter, middle, -1.0, stroke),
        Icon::Redo => arrow(painter, middle, 1.0, stroke),
        Icon::Reset => {
            let points: Vec<Pos2> = (0..=20).map(|i| on_circle(-0.4 * PI + 0.83 * TAU * i as f32 / 20.0)).collect();
            let tip = points[0];
            painter.add(Shape::line(points, stroke));
            head(painter, tip + vec2(-1.0, 0.0), vec2(-1.0, -0.15), stroke);
        }
        Icon::Theme => {
            painter.circle_stroke(middle, radius, stroke);
            let half: Vec<Pos2> = (0..=16).map(|i| on_circle(-PI / 2.0 + PI * i as f32 / 16.0)).collect();
            painter.add(Shape::convex_polygon(half, colour, Stroke::NONE));
        }
        Icon::Close => {
            for side in [-1.0, 1.0] {
                painter.line_segment([middle + vec2(-4.5, -4.5 * side), middle + vec2(4.5, 4.5 * side)], stroke);
            }
        }
        Icon::Split => {
            let frame = Rect::from_center_size(middle, vec2(15.0, 12.0));
            painter.rect_stroke(frame, 2.0, stroke, egui::StrokeKind::Inside);
            painter.rect_filled(Rect::from_min_max(frame.min, pos2(middle.x, frame.max.y)), 2.0, colour);
        }
        Icon::Before => {
            painter.circle_stroke(middle, radius + 0.5, stroke);
            painter.add(Shape::line(vec![middle + vec2(0.0, -4.0), middle, middle + vec2(3.0, 2.0)], stroke));
        }
        Icon::View => {
            for side in [-1.0, 1.0] {
                let lid = (0..=12).map(|i| {
                    let x = -1.0 + i as f32 / 6.0;
                    middle + vec2(8.0 * x, side * 5.0 * (1.0 - x * x))
                });
                painter.add(Shape::line(lid.collect(), stroke));
            }
            painter.circle_filled(middle, 2.2, colour);
        }
        Icon::Help | Icon::About => {
            painter.circle_stroke(middle, radius + 1.0, stroke);
            let letter = if icon == Icon::Help { "?" } else { "i" };
            painter.text(middle, Align2::CENTER_CENTER, letter, FontId::proportional(12.0), colour);
        }
        Icon::Down => down(painter, middle, colour),
        Icon::Save => {
            let tip = middle + vec2(0.0, 2.5);
            painter.line_segment([middle - vec2(0.0, 6.0), tip], stroke);
            head(painter, tip, vec2(0.0, 1.0), stroke);
            painter.line_segment([middle + vec2(-6.0, 6.0), middle + vec2(6.0, 6.0)], stroke);
        }
        Icon::Menu => {
            for y in [-5.0, 0.0, 5.0] {
                painter.line_segment([middle + vec2(-7.0, y), middle + vec2(7.0, y)], stroke);
            }
        }
    }
}

/// A small triangle that points down: there is more below.
pub(super) fn down(painter: &Painter, middle: Pos2, colour: Color32) {
    let corners = [vec2(-4.0, -2.0), vec2(4.0, -2.0), vec2(0.0, 3.0)].map(|p| middle + p);
    painter.add(Shape::convex_polygon(corners.to_vec(), colour, Stroke::NONE));
}

/// An arrow that comes from below, bends over and points to `side` (-1 left, 1 right).
fn arrow(painter: &Painter, middle: Pos2, side: f32, stroke: Stroke) {
    let at = |x: f32, y: f32| pos2(middle.x + side * x, middle.y + y);
    let bend = (0..=12).map(|i| {
        let angle = -PI / 2.0 - PI * i as f32 / 12.0;
        at(angle.cos() * 4.5, 1.0 + angle.sin() * 4.5)
    });
    let mut points = vec![at(6.5, -3.5)];
    points.extend(bend);
    points.push(at(3.0, 5.5));
    painter.add(Shape::line(points, stroke));
    head(painter, at(6.5, -3.5), vec2(side, 0.0), stroke);
}

/// The head of an arrow with its tip at `tip`, pointing along `way`.
fn head(painter: &Painter, tip: Pos2, way: egui::Vec2, stroke: Stroke) {
    let across = way.rot90();
    for side in [-1.0, 1.0] {
        painter.line_segment([tip, tip - way * 4.0 + across * (4.0 * side)], stroke);
    }
}
