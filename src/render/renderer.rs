//! One view, drawn: the background, then surfaces, by every kind of drawing that there is for them.

use super::backdrop::Backdrop;
use super::kind::{DrawKind, Drawable, Look, Turn};
use super::paint::Paint;
use super::scene::SceneLayout;
use super::shaded::Shaded;
use super::wireframe::Wireframe;
use super::{Camera, Style, ViewTarget};

/// The pipelines; one serves all views of a device.
#[derive(Debug)]
pub struct Renderer {
    layout: SceneLayout,
    backdrop: Backdrop,
    /// Every kind of drawing for surfaces.
    kinds: Vec<Box<dyn DrawKind>>,
}

impl Renderer {
    /// Compiles the shaders. All targets are of [`ViewTarget::FORMAT`], whatever the window's own format is.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let layout = SceneLayout::new(device, queue);
        Self {
            backdrop: Backdrop::new(device, &layout),
            kinds: vec![Box::new(Shaded::new(device, &layout)), Box::new(Wireframe::new(device, &layout))],
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
        let paints: Vec<Paint> = drawables.iter().map(|drawable| paint(drawable, style)).collect();
        let bindings = self.layout.bind(device, target.size(), camera, style, &paints);
        let mut pass = target.begin(encoder);
        bindings.set(&mut pass, 0);
        self.backdrop.draw(&mut pass);
        for turn in [Turn::Solid, Turn::Lines] {
            for (i, drawable) in drawables.iter().enumerate() {
                bindings.set(&mut pass, i);
                for kind in &self.kinds {
                    kind.draw(&mut pass, drawable, turn, style);
                }
            }
        }
    }
}

/// What a drawable is drawn in.
fn paint(drawable: &Drawable<'_>, style: &Style) -> Paint {
    let paint = Paint::of(style).flat(drawable.look == Look::Flat);
    drawable.tint.map_or(paint, |tint| paint.tinted(tint))
}
