//! What is drawn of a surface, and what a kind of drawing is.
//!
//! A kind is a file with a shader of the same name: it makes its pipelines, and knows what it draws of which [`Look`] in
//! which turn. A new one is such a file, and a line in the list of its [`Renderer`](super::Renderer).

use super::{Colour, GpuSurface, Style};

/// How a surface is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Look {
    /// Shaded, with the normals of the vertices.
    #[default]
    Shaded,
    /// Shaded, each triangle with its own normal: what the triangles really are.
    Flat,
    /// Lines along the edges, hidden ones left out.
    Wireframe,
    /// Lines along the edges, hidden ones faint.
    SeeThrough,
}

/// A surface and how it is shown. To lay a wireframe over a shaded surface, draw it twice.
#[derive(Clone, Copy, Debug)]
pub struct Drawable<'a> {
    /// The surface.
    pub surface: &'a GpuSurface,
    /// How it is shown.
    pub look: Look,
    /// A colour in place of the style's: of the wall's outside, or of the lines.
    pub tint: Option<Colour>,
}

/// When something is drawn: all that hides before all lines, so that one surface hides the lines of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// What hides.
    Solid,
    /// What lies over it.
    Lines,
}

/// A kind of drawing.
pub(super) trait DrawKind: std::fmt::Debug + wgpu::WasmNotSendSync {
    /// Draws what there is to draw of `drawable` in this turn. The scene and its paint are bound.
    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, drawable: &Drawable<'_>, turn: Turn, style: &Style);
}
