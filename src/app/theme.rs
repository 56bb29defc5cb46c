//! The look: two themes of one calm palette, an 8-point grid, one accent.

use std::ops::RangeInclusive;
use std::sync::Arc;

use egui::style::{KineticScrollStyle, NumberFormatter};
use egui::{Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Stroke, TextStyle, Theme, Visuals};
use epaint_default_fonts::EGUI_ICONS;

use crate::language::{Key, decimal};
use crate::render::{Colour, Style};

/// One step of the grid, in points.
pub(super) const GRID: f32 = 8.0;

/// Height of a control that a mouse hits, in points.
const POINTER: f32 = 28.0;

/// Height and width of a control that a finger hits, in points.
pub(super) const FINGER: f32 = 44.0;

struct Palette {
    text: u32,
    weak: u32,
    panel: u32,
    raised: u32,
    field: u32,
    line: u32,
    accent: u32,
    on_accent: u32,
    error: u32,
    /// Of what is neither right nor wrong as far as is known.
    caution: u32,
}

const LIGHT: Palette = Palette {
    text: 0x16_1D_24,
    weak: 0x55_60_6B,
    panel: 0xF7_F9_FB,
    raised: 0xE6_EB_F0,
    field: 0xFF_FF_FF,
    line: 0xC6_CE_D6,
    accent: 0x1F_66_A8,
    on_accent: 0xFF_FF_FF,
    error: 0xA8_1F_1F,
    caution: 0x7A_52_00,
};

const DARK: Palette = Palette {
    text: 0xE8_EC_F0,
    weak: 0xA3_AD_B8,
    panel: 0x1B_1F_24,
    raised: 0x2B_31_38,
    field: 0x12_15_19,
    line: 0x3C_44_4D,
    accent: 0x3E_8F_D6,
    on_accent: 0x08_0C_10,
    error: 0xFF_8A_80,
    caution: 0xE8_B4_4C,
};

fn colour(rgb: u32) -> Color32 {
    let Colour([r, g, b]) = Colour::hex(rgb);
    Color32::from_rgb(r, g, b)
}

/// Ubuntu Light without its instructions (`build.rs`).
const LETTERS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/letters.ttf"));

/// Those of egui's fonts that Lumen writes with: the one for code, which nothing is written in, would be a fifth of a MB of
/// the first visit.
fn fonts() -> FontDefinitions {
    let data = [("Ubuntu-Light", LETTERS), ("egui-icons", EGUI_ICONS)];
    let names: Vec<String> = data.iter().map(|(name, _)| (*name).to_owned()).collect();
    let families = [FontFamily::Proportional, FontFamily::Monospace];
    FontDefinitions {
        font_data: data
            .into_iter()
            .map(|(name, font)| (name.to_owned(), Arc::new(FontData::from_static(font))))
            .collect(),
        families: families.into_iter().map(|family| (family, names.clone())).collect(),
    }
}

/// Makes controls as large as a finger needs them, or as a mouse does; `moves` lets a panel that a finger has pushed go on
/// after it.
pub(super) fn suit(ctx: &egui::Context, has_finger: bool, moves: bool) {
    let size = if has_finger { FINGER } else { POINTER };
    ctx.all_styles_mut(|style| {
        let spacing = &mut style.spacing;
        spacing.interact_size = egui::vec2(size, size);
        // The shortest words on a button are 22 points wide.
        spacing.button_padding.x = if has_finger { (FINGER - 22.0) / 2.0 } else { GRID };
        spacing.scroll.kinetic.decay_time = if moves { KineticScrollStyle::default().decay_time } else { 0.0 };
    });
}

/// Below this width in points a window is that of a phone: the views stack, and the panel becomes a sheet at the bottom.
const NARROW: f32 = 720.0;

/// Whether the window is that of a phone.
pub(super) fn is_narrow(ctx: &egui::Context) -> bool {
    ctx.content_rect().width() < NARROW
}

/// Whether controls are as large as a finger needs them.
pub(super) fn suits_finger(ctx: &egui::Context) -> bool {
    ctx.global_style().spacing.interact_size.y >= FINGER
}

/// Of two messages the one that suits what points: a finger taps and has no keys.
pub(super) fn by_hand(ctx: &egui::Context, mouse: Key, finger: Key) -> Key {
    if suits_finger(ctx) { finger } else { mouse }
}

/// Height of a row that a mouse hits at `height`, in points: never lower than a finger needs it.
pub(super) fn row(ctx: &egui::Context, height: f32) -> f32 {
    if suits_finger(ctx) { FINGER } else { height }
}

/// Sets up both themes.
pub(super) fn apply(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    for (theme, palette) in [(Theme::Light, LIGHT), (Theme::Dark, DARK)] {
        ctx.style_mut_of(theme, |style| {
            style.visuals = visuals(theme, &palette);
            let spacing = &mut style.spacing;
            spacing.item_spacing = egui::vec2(GRID, GRID / 2.0);
            spacing.button_padding = egui::vec2(GRID, GRID / 2.0);
            spacing.interact_size = egui::vec2(POINTER, POINTER);
            spacing.slider_rail_height = 4.0;
            spacing.menu_margin = egui::Margin::same(GRID as i8 / 2);
            spacing.tooltip_width = 280.0;
            for (text_style, size) in [
                (TextStyle::Heading, 16.0),
                (TextStyle::Body, 14.0),
                (TextStyle::Button, 14.0),
                (TextStyle::Small, 12.0),
            ] {
                style.text_styles.insert(text_style, FontId::proportional(size));
            }
            style.interaction.selectable_labels = false;
            style.number_formatter = NumberFormatter::new(written);
        });
    }
}

/// A number as egui rounds it, with the decimal mark of the language that is spoken.
fn written(number: f64, decimals: RangeInclusive<usize>) -> String {
    let text = egui::emath::format_with_decimals_in_range(number, decimals);
    let places = text.split_once('.').map_or(0, |(_, behind)| behind.len());
    decimal(number, places)
}

fn visuals(theme: Theme, palette: &Palette) -> Visuals {
    let mut v = theme.default_visuals();
    let (text, weak, accent) = (colour(palette.text), colour(palette.weak), colour(palette.accent));
    let (panel, raised, line) = (colour(palette.panel), colour(palette.raised), colour(palette.line));
    v.panel_fill = panel;
    v.window_fill = panel;
    v.window_stroke = Stroke::new(1.0, line);
    v.extreme_bg_color = colour(palette.field);
    v.faint_bg_color = raised;
    v.weak_text_color = Some(weak);
    v.hyperlink_color = accent;
    v.error_fg_color = colour(palette.error);
    v.warn_fg_color = colour(palette.caution);
    v.selection.bg_fill = accent;
    v.selection.stroke = Stroke::new(1.0, colour(palette.on_accent));
    v.slider_trailing_fill = true;
    v.window_corner_radius = CornerRadius::same(8);
    v.menu_corner_radius = CornerRadius::same(6);
    let widgets = &mut v.widgets;
    for widget in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        widget.corner_radius = CornerRadius::same(4);
        widget.fg_stroke.color = text;
        widget.bg_fill = raised;
        widget.weak_bg_fill = raised;
        widget.expansion = 0.0;
    }
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, line);
    widgets.inactive.bg_fill = line;
    widgets.inactive.bg_stroke = Stroke::NONE;
    widgets.hovered.bg_stroke = Stroke::new(1.0, weak);
    widgets.hovered.bg_fill = line;
    widgets.hovered.weak_bg_fill = line;
    widgets.active.bg_stroke = Stroke::new(1.0, accent);
    widgets.active.bg_fill = line;
    v
}

/// The colours of the 3-D views.
pub(super) fn style(visuals: &Visuals) -> Style {
    if visuals.dark_mode { Style::DARK } else { Style::LIGHT }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::contrast;

    #[test]
    fn letters_are_those_of_the_font_they_were_made_from() {
        use skrifa::instance::{LocationRef, Size};
        use skrifa::outline::pen::PathElement;
        use skrifa::outline::{DrawSettings, pen::OutlinePen};
        use skrifa::{FontRef, GlyphId, MetadataProvider};

        #[derive(Default, PartialEq, Debug)]
        struct Path(Vec<PathElement>);
        impl OutlinePen for Path {
            fn move_to(&mut self, x: f32, y: f32) {
                self.0.push(PathElement::MoveTo { x, y });
            }
            fn line_to(&mut self, x: f32, y: f32) {
                self.0.push(PathElement::LineTo { x, y });
            }
            fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
                self.0.push(PathElement::QuadTo { cx0, cy0, x, y });
            }
            fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
                self.0.push(PathElement::CurveTo { cx0, cy0, cx1, cy1, x, y });
            }
            fn close(&mut self) {
                self.0.push(PathElement::Close);
            }
        }
        let original = epaint_default_fonts::UBUNTU_LIGHT;
        assert!(2 * LETTERS.len() < original.len(), "{} bytes", LETTERS.len());
        let fonts = [original, LETTERS].map(|bytes| FontRef::new(bytes).unwrap());
        let paths = fonts.clone().map(|font| {
            let outlines = font.outline_glyphs();
            let widths = font.glyph_metrics(Size::unscaled(), LocationRef::default());
            let count = widths.glyph_count();
            (0..count)
                .map(|i| {
                    let mut path = Path::default();
                    let glyph = outlines.get(GlyphId::new(i)).unwrap();
                    glyph.draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut path).unwrap();
                    (path, widths.advance_width(GlyphId::new(i)))
                })
                .collect::<Vec<_>>()
        });
        assert!(paths[0].len() > 1000 && paths[0] == paths[1]);
        let letters = fonts.map(|font| font.charmap().mappings().collect::<Vec<_>>());
        assert_eq!(letters[0], letters[1]);
    }

    #[test]
    fn text_has_a_contrast_of_four_and_a_half() {
        for palette in [LIGHT, DARK] {
            for text in [palette.text, palette.weak, palette.error, palette.caution] {
                for ground in [palette.panel, palette.raised, palette.field] {
                    let found = contrast(Colour::hex(text), Colour::hex(ground));
                    assert!(found >= 4.5, "{text:06x} on {ground:06x}: {found}");
                }
            }
            assert!(contrast(Colour::hex(palette.on_accent), Colour::hex(palette.accent)) >= 4.5);
        }
    }
}
