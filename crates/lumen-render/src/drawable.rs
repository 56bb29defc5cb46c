//! A surface in the looks that a user chooses from.

use super::draw::{Draw, DrawContext, Phase};
use super::paint::Paint;
use super::shaded::Shaded;
use super::wireframe::Wireframe;
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

impl Draw for Drawable<'_> {
    fn phases(&self) -> &'static [Phase] {
        match self.look {
            Look::Shaded | Look::Flat => Shaded::PHASES,
            Look::Wireframe | Look::SeeThrough => Wireframe::PHASES,
        }
    }

    fn paint(&self, style: &Style) -> Paint {
        let paint = Paint::of(style).flat(self.look == Look::Flat);
        self.tint.map_or(paint, |tint| paint.tinted(tint))
    }

    fn draw(&self, context: &mut DrawContext<'_, '_>) {
        match self.look {
            Look::Shaded | Look::Flat => Shaded::draw(context, self.surface),
            Look::Wireframe => Wireframe::draw(context, self.surface, false),
            Look::SeeThrough => Wireframe::draw(context, self.surface, true),
        }
    }
}
