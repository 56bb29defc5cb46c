//! One view, drawn: background, shaded surfaces, depth of the wireframes, lines.

use super::backdrop::Backdrop;
use super::scene::SceneLayout;
use super::shaded::Shaded;
use super::wireframe::Wireframe;
use super::{Camera, Colour, GpuSurface, Style, ViewTarget};

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

impl Look {
    fn is_lines(self) -> bool {
        matches!(self, Self::Wireframe | Self::SeeThrough)
    }
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

/// The pipelines; one serves all views of a device.
#[derive(Debug)]
pub struct Renderer {
    layout: SceneLayout,
    backdrop: Backdrop,
    shaded: Shaded,
    wireframe: Wireframe,
}

impl Renderer {
    /// Compiles the shaders. All targets are of [`ViewTarget::FORMAT`], whatever the window's own format is.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let layout = SceneLayout::new(device, queue);
        Self {
            backdrop: Backdrop::new(device, &layout),
            shaded: Shaded::new(device, &layout),
            wireframe: Wireframe::new(device, &layout),
            layout,
        }
    }

    /// Records into `encoder` the drawing of `drawables`, seen by `camera`, into `target`. Whatever was in the target
    /// goes. Several views can be recorded into one encoder.
    pub fn draw(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &ViewTarget,
        camera: &Camera,
        drawables: &[Drawable<'_>],
        style: &Style,
    ) {
        let bindings = self.layout.bind(device, target.size(), camera, drawables, style);
        let mut pass = target.begin(encoder);
        bindings.set(&mut pass, 0);
        self.backdrop.draw(&mut pass);
        // All that hides before all lines, so that one surface hides the lines of another.
        for (i, drawable) in drawables.iter().enumerate() {
            bindings.set(&mut pass, i);
            if drawable.look.is_lines() {
                self.wireframe.draw_depth(&mut pass, drawable.surface);
            } else {
                self.shaded.draw(&mut pass, drawable.surface, style.map.is_some());
            }
        }
        for (i, drawable) in drawables.iter().enumerate().filter(|(_, drawable)| drawable.look.is_lines()) {
            bindings.set(&mut pass, i);
            if drawable.look == Look::SeeThrough {
                self.wireframe.draw_hidden(&mut pass, drawable.surface);
            }
            self.wireframe.draw_visible(&mut pass, drawable.surface);
        }
    }
}
