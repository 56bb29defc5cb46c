//! Shapes of the window as SVG 1.1. No crate writes egui's shapes so: what there is reads SVG, or draws pixels.

use std::fmt::{Display, Write};

use egui::epaint::{CircleShape, ColorMode, PathShape, RectShape, TextShape};
use egui::{Color32, Pos2, Rect, Shape, Stroke, Vec2};

use crate::report::escaped;

/// Shapes before a ground, in a picture of this size, whose letters are text. Meshes, bands and Bezier curves are
/// left out: no plot of Lumen has them.
pub(super) fn written(size: Vec2, ground: Color32, shapes: &[(Rect, Shape)]) -> String {
    let (width, height) = (number(size.x), number(size.y));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"Ubuntu, 'Noto Sans', Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\"{}/>\n",
        paint("fill", ground)
    );
    let mut clips: Vec<Rect> = Vec::new();
    for (clip_rect, shape) in shapes {
        let drawn = drawn(shape);
        if drawn.is_empty() {
            continue;
        }
        if clip_rect.contains_rect(shape.visual_bounding_rect()) {
            svg += &drawn;
            continue;
        }
        let known = clips.iter().position(|clip| clip == clip_rect);
        let i = known.unwrap_or_else(|| {
            clips.push(*clip_rect);
            let (at, size) = (corner(clip_rect), extent(clip_rect.size()));
            let _ = writeln!(svg, "<clipPath id=\"c{}\"><rect {at} {size}/></clipPath>", clips.len() - 1);
            clips.len() - 1
        });
        let _ = writeln!(svg, "<g clip-path=\"url(#c{i})\">{drawn}</g>");
    }
    svg + "</svg>\n"
}

fn drawn(shape: &Shape) -> String {
    match shape {
        Shape::Vec(shapes) => shapes.iter().map(drawn).collect(),
        Shape::LineSegment { points, stroke } => path(points, false, Color32::TRANSPARENT, *stroke),
        Shape::Path(PathShape { points, closed, fill, stroke }) => {
            let ColorMode::Solid(colour) = stroke.color else { return String::new() };
            path(points, *closed, *fill, Stroke::new(stroke.width, colour))
        }
        Shape::Circle(CircleShape { center, radius, fill, stroke }) => {
            let (x, y, r) = (number(center.x), number(center.y), number(*radius));
            format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{}{}/>\n", paint("fill", *fill), outline(*stroke))
        }
        Shape::Rect(RectShape { rect, fill, stroke, .. }) => {
            let (at, size) = (corner(rect), extent(rect.size()));
            format!("<rect {at} {size}{}{}/>\n", paint("fill", *fill), outline(*stroke))
        }
        Shape::Text(shape) => text(shape),
        _ => String::new(),
    }
}

fn path(points: &[Pos2], is_closed: bool, fill: Color32, stroke: Stroke) -> String {
    if stroke.is_empty() && fill == Color32::TRANSPARENT || points.iter().any(|point| !point.is_finite()) {
        return String::new();
    }
    let places: Vec<String> = points.iter().map(|point| format!("{},{}", number(point.x), number(point.y))).collect();
    let element = if is_closed { "polygon" } else { "polyline" };
    let join = if points.len() > 2 { " stroke-linejoin=\"round\"" } else { "" };
    format!("<{element} points=\"{}\"{}{}{join}/>\n", places.join(" "), paint("fill", fill), outline(stroke))
}

/// Each row as long as it is in the window, whichever letters the reader has.
fn text(shape: &TextShape) -> String {
    let mut lines = String::new();
    let Some(format) = shape.galley.job.sections.first().map(|section| &section.format) else { return lines };
    let own = if format.color == Color32::PLACEHOLDER { shape.fallback_color } else { format.color };
    let fill = paint("fill", shape.override_text_color.unwrap_or(own).gamma_multiply(shape.opacity_factor));
    let turn = if shape.angle == 0.0 {
        String::new()
    } else {
        let (x, y) = (number(shape.pos.x), number(shape.pos.y));
        format!(" transform=\"rotate({} {x} {y})\"", number(shape.angle.to_degrees()))
    };
    for row in &shape.galley.rows {
        let (Some(first), Some(last)) = (row.glyphs.first(), row.glyphs.last()) else { continue };
        let letters: String = row.glyphs.iter().map(|glyph| glyph.chr).collect();
        let at = shape.pos + row.pos.to_vec2() + first.pos.to_vec2();
        let length = last.pos.x + last.advance_width - first.pos.x;
        let _ = writeln!(
            lines,
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\" \
             xml:space=\"preserve\"{fill}{turn}>{}</text>",
            number(at.x),
            number(at.y),
            number(format.font_id.size),
            number(length),
            escaped(&letters)
        );
    }
    lines
}

/// An attribute of that colour.
fn paint(attribute: &str, colour: Color32) -> String {
    let [r, g, b, a] = colour.to_srgba_unmultiplied();
    match a {
        0 => format!(" {attribute}=\"none\""),
        255 => format!(" {attribute}=\"#{r:02x}{g:02x}{b:02x}\""),
        _ => {
            format!(" {attribute}=\"#{r:02x}{g:02x}{b:02x}\" {attribute}-opacity=\"{}\"", number(f32::from(a) / 255.0))
        }
    }
}

fn outline(stroke: Stroke) -> String {
    if stroke.is_empty() {
        return String::new();
    }
    format!("{} stroke-width=\"{}\"", paint("stroke", stroke.color), number(stroke.width))
}

fn corner(rect: &Rect) -> impl Display {
    format!("x=\"{}\" y=\"{}\"", number(rect.left()), number(rect.top()))
}

fn extent(size: Vec2) -> impl Display {
    format!("width=\"{}\" height=\"{}\"", number(size.x), number(size.y))
}

/// To a hundredth of a point.
fn number(x: f32) -> f32 {
    (x * 100.0).round() / 100.0
}
