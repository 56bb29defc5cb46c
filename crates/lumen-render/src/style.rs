//! What a theme gives the renderer: colours, and whether scalars are shown.

use glam::Vec3;

use super::{Colour, ColourMap};

/// Colours of a view. The presets are calm: a neutral graded background, a matte vessel of warm clay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Background at the top of the view.
    pub background_top: Colour,
    /// Background at the bottom of the view.
    pub background_bottom: Colour,
    /// The outside of the wall.
    pub surface: Colour,
    /// The inside of the wall, as seen through an open end.
    pub inside: Colour,
    /// What the outside turns to where it turns away from the eye.
    pub rim: Colour,
    /// Lines of a wireframe where the surface turns away from the eye: the theme's text colour.
    pub line: Colour,
    /// Lines of a wireframe where the surface faces the eye: softer, so that a dense wireframe still shows its form.
    pub line_facing: Colour,
    /// Shows scalars as colours, on the surfaces that have them.
    pub map: Option<ColourMap>,
    /// What has no number under a map, where that has a colour of its own; else it has the surface's.
    pub unknown: Option<Colour>,
    /// Whether these scalars are numbers of labels, from 0: each triangle has one of the palette's colours.
    pub labels: bool,
    /// Whether the light comes from the side, nearly along the surface that faces the eye: what stands out of it casts its
    /// own shade, stair-steps and dents among it. Colours of a map stay evenly lit.
    pub raking: bool,
    /// Whether shaded surfaces are darker where they stand close together, as in folds and forks; not under a map.
    pub occlusion: bool,
    /// Whether scalars go both ways from white: below the middle of their range, and above.
    pub diverging: bool,
    /// Whether these labels are the vertices' own: each has its colour, blended between them.
    pub by_vertex: bool,
    /// Leaves out what lies before a plane.
    pub clip: Option<ClipPlane>,
}

/// A plane; what lies before it is not drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipPlane {
    /// What it is square to, of length 1: towards what is left out.
    pub normal: Vec3,
    /// Where the plane is along that, in mm.
    pub offset: f32,
}

impl ClipPlane {
    /// How far a point lies before the plane, in mm; below zero behind it.
    pub fn height(&self, point: Vec3) -> f32 {
        self.normal.dot(point) - self.offset
    }
}

impl Style {
    /// For [`unknown`](Self::unknown): a grey, which no map has.
    pub const UNKNOWN: Colour = Colour::hex(0xA0_A0_A0);

    /// Dark on light.
    pub const LIGHT: Self = Self {
        background_top: Colour::hex(0xF7_F9_FB),
        background_bottom: Colour::hex(0xDD_E3_E9),
        surface: Colour::hex(0xCC_88_75),
        inside: Colour::hex(0x8A_38_34),
        rim: Colour::hex(0x7A_35_30),
        line: Colour::hex(0x16_1D_24),
        line_facing: Colour::hex(0x56_61_6C),
        map: None,
        unknown: None,
        labels: false,
        raking: false,
        occlusion: false,
        diverging: false,
        clip: None,
        by_vertex: false,
    };

    /// Light on dark.
    pub const DARK: Self = Self {
        background_top: Colour::hex(0x2A_30_37),
        background_bottom: Colour::hex(0x12_15_19),
        surface: Colour::hex(0xC8_86_74),
        inside: Colour::hex(0x74_2E_2C),
        rim: Colour::hex(0xF6_D2_C2),
        line: Colour::hex(0xF4_F6_F8),
        line_facing: Colour::hex(0x93_9D_A8),
        ..Self::LIGHT
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contrast;

    #[test]
    fn every_line_stands_out_against_the_whole_background() {
        for style in [Style::LIGHT, Style::DARK] {
            for line in [style.line, style.line_facing] {
                for background in [style.background_top, style.background_bottom] {
                    let found = contrast(line, background);
                    assert!(found >= 4.5, "{line:?} on {background:?}: {found}");
                }
            }
        }
    }

    #[test]
    fn the_inside_is_darker_than_the_outside() {
        for style in [Style::LIGHT, Style::DARK] {
            assert!(contrast(style.surface, style.inside) > 2.0);
            assert!(style.surface.luminance() > style.inside.luminance());
        }
    }
}
