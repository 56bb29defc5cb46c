//! One view, drawn: the background, slices of a scan, then surfaces, by every kind of drawing that there is for them,
//! darker where they are closed in (`occlusion`) before lines are drawn over them.

use super::backdrop::Backdrop;
use super::kind::{DrawKind, Drawable, Look, Turn};
use super::occlusion::Occlusion;
use super::paint::Paint;
use super::scene::SceneLayout;
use super::shaded::Shaded;
use super::slice::{GpuSlice, Slices};
use super::wireframe::Wireframe;
use super::{Camera, Style, ViewTarget};

/// The pipelines; one serves all views of a device.
#[derive(Debug)]
pub struct Renderer {
    layout: SceneLayout,
    backdrop: Backdrop,
    slices: Slices,
    occlusion: Occlusion,
    /// Every kind of drawing for surfaces.
    kinds: Vec<Box<dyn DrawKind>>,
}

impl Renderer {
    /// Compiles the shaders. All targets are of [`ViewTarget::FORMAT`], whatever the window's own format is.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let layout = SceneLayout::new(device, queue);
        Self {
            backdrop: Backdrop::new(device, &layout),
            slices: Slices::default(),
            occlusion: Occlusion::default(),
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
        self.draw_among(device, encoder, target, camera, (drawables, &[]), style);
    }

    /// The same among slices of a scan. They are drawn first: what is seen through a wireframe is the slice within.
    pub fn draw_among(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &ViewTarget,
        camera: &Camera,
        (drawables, slices): (&[Drawable<'_>], &[&GpuSlice]),
        style: &Style,
    ) {
        let paints: Vec<Paint> = drawables.iter().map(|drawable| paint(drawable, style)).collect();
        let bindings = self.layout.bind(device, target.size(), camera, style, &paints);
        // What stands before or behind a slice is no neighbour of it.
        let is_occluded = slices.is_empty() && Occlusion::is_wanted(style, drawables);
        let gathered =
            is_occluded.then(|| self.occlusion.gather(device, &self.layout, encoder, target, &bindings, drawables));
        let mut pass = target.begin(encoder);
        bindings.set(&mut pass, 0);
        self.backdrop.draw(&mut pass);
        self.slices.draw(device, &self.layout, &mut pass, slices);
        for turn in [Turn::Solid, Turn::Lines] {
            for (i, drawable) in drawables.iter().enumerate() {
                bindings.set(&mut pass, i);
                for kind in &self.kinds {
                    kind.draw(&mut pass, drawable, turn, style);
                }
            }
            if let (Turn::Solid, Some(gathered)) = (turn, &gathered) {
                self.occlusion.shade(&mut pass, gathered);
            }
        }
    }
}

/// What a drawable is drawn in.
fn paint(drawable: &Drawable<'_>, style: &Style) -> Paint {
    let paint = Paint::of(style).flat(drawable.look == Look::Flat);
    drawable.tint.map_or(paint, |tint| paint.tinted(tint))
}
