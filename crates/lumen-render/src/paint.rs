//! The colours that one thing is drawn in.

use bytemuck::{Pod, Zeroable};

use super::{Colour, Style};

/// What something is drawn in. A shader takes of it what it needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    surface: Colour,
    inside: Colour,
    rim: Colour,
    unknown: Colour,
    line: Colour,
    line_facing: Colour,
    is_flat: bool,
}

/// A [`Paint`] as shaders have it; `Paint` in `scene.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct PaintUniforms {
    /// Linear.
    surface: [f32; 4],
    /// Linear.
    inside: [f32; 4],
    /// Linear.
    rim: [f32; 4],
    /// Linear.
    unknown: [f32; 4],
    /// Gamma-encoded.
    line: [f32; 4],
    /// Gamma-encoded.
    line_facing: [f32; 4],
    /// 1 for flat shading.
    flat: f32,
    unused: [f32; 3],
}

impl Paint {
    /// The colours of a style.
    pub(super) fn of(style: &Style) -> Self {
        let Style { surface, inside, rim, unknown, line, line_facing, .. } = *style;
        Self { surface, inside, rim, unknown: unknown.unwrap_or(surface), line, line_facing, is_flat: false }
    }

    /// The same with another colour of the wall's outside, or of the lines.
    #[must_use]
    pub(super) fn tinted(self, tint: Colour) -> Self {
        Self { surface: tint, unknown: tint, line: tint, line_facing: tint, ..self }
    }

    /// The same, each triangle with its own normal or not.
    #[must_use]
    pub(super) fn flat(self, is_flat: bool) -> Self {
        Self { is_flat, ..self }
    }

    pub(super) fn uniforms(&self) -> PaintUniforms {
        PaintUniforms {
            surface: linear(self.surface),
            inside: linear(self.inside),
            rim: linear(self.rim),
            unknown: linear(self.unknown),
            line: encoded(self.line),
            line_facing: encoded(self.line_facing),
            flat: f32::from(u8::from(self.is_flat)),
            unused: [0.0; 3],
        }
    }
}

/// Gamma-encoded and opaque.
pub(super) fn encoded(colour: Colour) -> [f32; 4] {
    let [r, g, b] = colour.0.map(|byte| f32::from(byte) / 255.0);
    [r, g, b, 1.0]
}

fn linear(colour: Colour) -> [f32; 4] {
    let [r, g, b] = colour.linear();
    [r, g, b, 1.0]
}
