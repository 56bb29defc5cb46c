//! Letters and lines over pictures: each on a rim of black or white, whichever stands out more against it, so that it can
//! be read on any surface and any background.

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Stroke, vec2};

use crate::render::{Colour, contrast};

/// How far a halo reaches, in points.
const REACH: f32 = 1.0;

/// Where the letters stand that make up a halo, in its reach: all around, and between, where letters are thinner than that.
const AROUND: [[f32; 2]; 12] = [
    [-1.0, -1.0],
    [0.0, -1.0],
    [1.0, -1.0],
    [-1.0, 0.0],
    [1.0, 0.0],
    [-1.0, 1.0],
    [0.0, 1.0],
    [1.0, 1.0],
    [-0.5, 0.0],
    [0.5, 0.0],
    [0.0, -0.5],
    [0.0, 0.5],
];

/// The colour of the halo around a colour: one of black and white has a contrast of at least the root of 21 to any, which
/// is more than the 4.5 of WCAG 2.2.
fn around(colour: Color32) -> Color32 {
    let [r, g, b, _] = colour.to_srgba_unmultiplied();
    let stands_out = |ground| contrast(Colour([r, g, b]), Colour([ground; 3]));
    if stands_out(0) > stands_out(255) { Color32::BLACK } else { Color32::WHITE }
}

/// Writes text of one line, aligned to `at`; where it stands.
pub(super) fn text(painter: &Painter, at: Pos2, align: Align2, text: &str, font: FontId, colour: Color32) -> Rect {
    let laid_out = painter.layout_no_wrap(text.to_owned(), font, colour);
    let place = align.anchor_size(at, laid_out.size());
    galley(painter, place.min, laid_out, colour);
    place
}

/// Writes text that is laid out in one colour.
pub(super) fn galley(painter: &Painter, at: Pos2, galley: Arc<Galley>, colour: Color32) {
    let halo = around(colour);
    for [x, y] in AROUND {
        painter.galley_with_override_text_color(at + vec2(x, y) * REACH, galley.clone(), halo);
    }
    painter.galley(at, galley, colour);
}

/// Draws straight lines, none below the halo of another.
pub(super) fn lines(painter: &Painter, lines: &[[Pos2; 2]], stroke: Stroke) {
    let rim = Stroke::new(stroke.width + 2.0 * REACH, around(stroke.color));
    for &[from, to] in lines {
        let along = (to - from).normalized() * REACH;
        painter.line_segment([from - along, to + along], rim);
    }
    for &line in lines {
        painter.line_segment(line, stroke);
    }
}

#[cfg(test)]
mod tests {
    use egui::{Context, RawInput, Shape, Theme, Visuals, pos2};

    use super::*;
    use crate::app::theme;

    /// What is needed for text: WCAG 2.2, success criterion 1.4.3.
    const MIN_CONTRAST: f32 = 4.5;

    fn opaque(colour: Color32) -> Colour {
        let [r, g, b, a] = colour.to_array();
        assert_eq!(a, 255);
        Colour([r, g, b])
    }

    fn both() -> [Visuals; 2] {
        let ctx = Context::default();
        theme::apply(&ctx);
        [Theme::Light, Theme::Dark].map(|theme| ctx.style_of(theme).visuals.clone())
    }

    #[test]
    fn every_colour_that_is_written_in_stands_out_from_its_halo() {
        for visuals in both() {
            let style = theme::style(&visuals);
            let grounds = [style.background_top, style.background_bottom];
            for colour in [visuals.text_color(), visuals.weak_text_color()] {
                for ground in grounds {
                    let found = contrast(opaque(colour), ground);
                    assert!(found >= MIN_CONTRAST, "{colour:?} on the background {ground:?}: {found}");
                }
            }
            // Between letter and halo nothing of what is below is seen, be it bone, dark red or black.
            let marks =
                [visuals.hyperlink_color, visuals.error_fg_color, visuals.weak_text_color(), visuals.text_color()];
            for colour in marks {
                let found = contrast(opaque(colour), opaque(around(colour)));
                assert!(found >= MIN_CONTRAST, "{colour:?}: {found}");
            }
        }
        // Whatever is written in some day.
        for i in 0..18_u16.pow(3) {
            let [r, g, b] = [i % 18, i / 18 % 18, i / 324].map(|step| (step * 15) as u8);
            let colour = Color32::from_rgb(r, g, b);
            assert!(contrast(opaque(colour), opaque(around(colour))) >= MIN_CONTRAST, "{colour:?}");
        }
    }

    #[test]
    fn a_halo_lies_below_its_letters_on_every_side() {
        for visuals in both() {
            let colour = visuals.text_color();
            let ctx = Context::default();
            theme::apply(&ctx);
            let mut output = ctx.run_ui(RawInput::default(), |ui| {
                text(ui.painter(), pos2(50.0, 40.0), Align2::LEFT_TOP, "20 mm", FontId::proportional(12.0), colour);
            });
            // Nothing draws here, so the font's picture goes nowhere.
            output.textures_delta.clear();
            let written: Vec<_> = output
                .shapes
                .into_iter()
                .filter_map(|clipped| if let Shape::Text(text) = clipped.shape { Some(text) } else { None })
                .collect();
            let (letters, halo) = written.split_last().expect("letters");
            assert_eq!((letters.pos, letters.override_text_color), (pos2(50.0, 40.0), None));
            for x in [-1.0, 0.0, 1.0] {
                for y in [-1.0, 0.0, 1.0] {
                    let side = vec2(x, y);
                    let is_there = halo.iter().any(|shape| {
                        shape.pos == letters.pos + side && shape.override_text_color == Some(around(colour))
                    });
                    assert!(is_there || side == vec2(0.0, 0.0), "nothing at {side:?}");
                }
            }
            assert!(halo.iter().all(|shape| shape.galley.text() == "20 mm"));
        }
    }
}
