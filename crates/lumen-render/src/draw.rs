//! What a picture is made of: things that implement [`Draw`], and the [`Phase`]s in which they draw.
//!
//! A kind of drawing is a file with a shader of the same name. The file holds the thing, which implements [`Draw`], and
//! its [`Pipelines`], which the [`Renderer`](super::Renderer) makes when they are first used. A new kind takes these two
//! files and a line for each in `lib.rs`. WebGL2 has no storage buffers, no compute, no wide lines and no polygon mode.

use std::any::Any;
use std::fmt::Debug;
use std::sync::OnceLock;

use super::Style;
use super::paint::Paint;
use super::scene::{SceneBindings, SceneLayout};

/// A part of a picture. Phases follow each other; within one, things are drawn in the order in which they are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Depth at half the size, from which ambient occlusion is computed.
    Depth,
    /// The background.
    Background,
    /// Before all surfaces: a wireframe leaves what is drawn here visible between its lines.
    Behind,
    /// Surfaces with depth. Ambient occlusion darkens them when all are drawn.
    Opaque,
    /// Lines with depth, over the opaque surfaces of all things.
    Lines,
    /// Translucent surfaces.
    Transparent,
    /// Marks over everything else.
    Overlay,
    /// Thickness along the X-rays of a fluoroscopy.
    Thickness,
    /// Attenuation of the X-rays of a fluoroscopy.
    Shadow,
}

impl Phase {
    /// The phases of the pass over a [`ViewTarget`](super::ViewTarget).
    pub(super) const OF_VIEW: [Self; 6] =
        [Self::Background, Self::Behind, Self::Opaque, Self::Lines, Self::Transparent, Self::Overlay];
}

/// A thing that can be drawn.
pub trait Draw: Debug {
    /// The phases in which it takes part.
    fn phases(&self) -> &'static [Phase];

    /// The colours that it is drawn in.
    fn paint(&self, style: &Style) -> Paint {
        Paint::of(style)
    }

    /// Draws what belongs to the phase of `context`. The scene and the paint are bound.
    fn draw(&self, context: &mut DrawContext<'_, '_>);
}

/// What a thing draws with in one phase.
#[derive(Debug)]
pub struct DrawContext<'a, 'pass> {
    pub(super) pass: &'a mut wgpu::RenderPass<'pass>,
    pub(super) phase: Phase,
    pub(super) style: &'a Style,
    pub(super) layout: &'a SceneLayout,
    pipelines: &'a PipelineList,
}

impl<'a> DrawContext<'a, '_> {
    /// The pipelines `P` of the renderer.
    pub(super) fn pipelines<P: Pipelines>(&self) -> &'a P {
        self.pipelines.get(self.layout)
    }
}

/// The pipelines of a kind of drawing, with what else it keeps on the device.
pub(super) trait Pipelines: Any + Debug + wgpu::WasmNotSendSync {
    /// Compiles the shader.
    fn new(layout: &SceneLayout) -> Self
    where
        Self: Sized;
}

/// All pipelines that were used so far: a list that grows at its end, so that it can be read while it grows.
#[derive(Debug, Default)]
pub(super) struct PipelineList(OnceLock<Box<Entry>>);

#[derive(Debug)]
struct Entry {
    pipelines: Box<dyn Pipelines>,
    rest: PipelineList,
}

impl PipelineList {
    /// The pipelines `P`, made now if they are not in the list.
    pub(super) fn get<P: Pipelines>(&self, layout: &SceneLayout) -> &P {
        let mut list = self;
        loop {
            let entry =
                list.0.get_or_init(|| Box::new(Entry { pipelines: Box::new(P::new(layout)), rest: Self::default() }));
            let pipelines: &dyn Any = &*entry.pipelines;
            if let Some(found) = pipelines.downcast_ref() {
                return found;
            }
            list = &entry.rest;
        }
    }
}

/// The things of one picture, with their uniforms.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    pub(super) things: &'a [&'a dyn Draw],
    pub(super) style: &'a Style,
    pub(super) layout: &'a SceneLayout,
    pub(super) pipelines: &'a PipelineList,
    pub(super) bindings: SceneBindings,
}

impl Frame<'_> {
    /// Whether a thing takes part in `phase`.
    pub(super) fn has(&self, phase: Phase) -> bool {
        self.things.iter().any(|thing| thing.phases().contains(&phase))
    }

    /// Draws `phase` of all things into `pass`.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, phase: Phase) {
        for (i, thing) in self.things.iter().enumerate() {
            if thing.phases().contains(&phase) {
                self.bindings.set(pass, i);
                let Self { style, layout, pipelines, .. } = *self;
                thing.draw(&mut DrawContext { pass, phase, style, layout, pipelines });
            }
        }
    }
}
