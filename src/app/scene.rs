//! What is in GPU memory, kept in step with the document: the level, the surface as it was opened, the pieces that
//! are left out, slices of the scan behind them, and the two views' targets.

use std::borrow::Cow;
use std::sync::Arc;

use egui::TextureId;

use super::document::{Document, Revision};
use super::options::Colours;
use super::scan::slices::SlicePicture;
use super::window_texture::WindowTarget;
use super::{arrays, classes};
use crate::mesh::{TriMesh, Vec3, clustered};
use crate::pipeline::normals::{Weighting, vertex_normals, vertex_normals_into};
use crate::pipeline::settings::{Keep, Target};
use crate::render::{
    Backdrop, Camera, Colour, ColourMap, Draw, Drawable, GpuSlice, GpuSurface, Look, Renderer, Style, SurfaceError,
    unique_edges,
};

/// The two views, side by side, and what is revealed behind each.
pub(super) const VIEWS: usize = 4;

/// What one view shows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Picture {
    /// From where.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The most triangles of a surface, where it is to be drawn quickly.
    pub light: Option<usize>,
    /// How the surface is shown.
    pub look: Look,
    /// The theme's colours.
    pub style: Style,
    /// The surface as it was opened, in place of the level.
    pub before: bool,
    /// The pieces that are left out as well, faintly.
    pub left_out: bool,
    /// The numbers of the slices behind it.
    pub slices: Vec<u64>,
}

/// What is shown beside the level or in its place.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Before {
    /// All of a document, which has no levels yet: the number of that and where its surface lies. Its pieces are no reason to
    /// upload it again.
    Whole(u64, usize),
    /// The pieces that are kept: the revisions that they are of.
    Kept(u64, u64, u64, Keep),
}

/// GPU memory and what stands in it.
pub(super) struct Scene {
    device: wgpu::Device,
    queue: wgpu::Queue,
    renderer: Renderer,
    level: GpuSurface,
    /// Fewer triangles of a large level, and of which it was made.
    light: GpuSurface,
    light_of: Option<(Revision, Colours, usize)>,
    /// Fewer of a large surface as it was opened.
    light_before: GpuSurface,
    light_before_of: Option<(Before, usize)>,
    before: GpuSurface,
    left_out: GpuSurface,
    slices: Vec<(u64, GpuSlice)>,
    /// What the surfaces were made from.
    revision: Revision,
    /// What the scalars of the level mean, and whether it has any.
    scalars_of: Colours,
    has_scalars: bool,
    before_of: Option<Before>,
    /// How many bytes of a surface without levels are in memory, while more follow in the next frame.
    uploaded: Option<usize>,
    left_out_of: Option<(u64, u64, Keep)>,
    normals: Vec<Vec3>,
    views: [WindowTarget<(Picture, Revision, Keep, bool)>; VIEWS],
}

impl Scene {
    /// A scene on the window's device.
    ///
    /// # Errors
    /// When the device does not allow a buffer.
    pub(super) fn new(state: &egui_wgpu::RenderState) -> Result<Self, SurfaceError> {
        let (device, queue) = (state.device.clone(), state.queue.clone());
        let surface = || GpuSurface::new(&device, &queue, &[]);
        let view = || WindowTarget::new(&device, &state.renderer);
        Ok(Self {
            renderer: Renderer::new(&device, &queue),
            level: surface()?,
            light: surface()?,
            light_of: None,
            light_before: surface()?,
            light_before_of: None,
            before: surface()?,
            left_out: surface()?,
            slices: Vec::new(),
            revision: Revision::default(),
            scalars_of: Colours::None,
            has_scalars: false,
            before_of: None,
            uploaded: None,
            left_out_of: None,
            normals: Vec::new(),
            views: [view(), view(), view(), view()],
            device,
            queue,
        })
    }

    /// Brings what is in memory up to the document.
    ///
    /// # Errors
    /// When the surface does not fit into the memory that the device allows.
    pub(super) fn follow(&mut self, document: &Document, colours: Colours) -> Result<(), SurfaceError> {
        let (old, new) = (self.revision, document.revision);
        let is_other = old.document != new.document;
        let Some((_, levels)) = &document.levels else {
            if is_other {
                self.level.set_positions(&self.device, &self.queue, &[])?;
            }
            self.revision = new;
            return self.follow_whole(document);
        };
        let Some(shown) = &document.shown else { return Ok(()) };
        let levels_changed = is_other || old.levels != new.levels;
        if levels_changed || old.shown != new.shown {
            let triangles = &shown.level.triangles;
            // The nodes of a level come before all others.
            let used = triangles.as_flattened().iter().max().map_or(0, |&last| last as usize + 1);
            if levels_changed || used > self.level.node_count() {
                // With those of finer levels, which follow as the slider moves.
                let first = (used + used / 2).min(levels.positions.len());
                self.level.set_positions(&self.device, &self.queue, &levels.positions[..first])?;
            }
            let positions = &levels.positions[..self.level.node_count()];
            vertex_normals_into(&mut self.normals, positions, triangles, Weighting::Area);
            let edges = unique_edges(triangles, positions.len());
            self.level.set_level(&self.device, &self.queue, triangles, &edges, &self.normals)?;
            self.has_scalars = false;
            self.level.set_scalars(&self.device, &self.queue, None)?;
        }
        let is_other_map = self.scalars_of != colours || old.measured != new.measured;
        if colours != Colours::None && (!self.has_scalars || is_other_map) {
            let scalars = scalars(document, colours);
            self.scalars_of = colours;
            self.has_scalars = scalars.is_some();
            let of_nodes = scalars.as_deref().map(|all| all.get(..self.level.node_count()).unwrap_or(all));
            self.level.set_scalars(&self.device, &self.queue, of_nodes)?;
        }
        self.revision = new;
        Ok(())
    }

    /// Makes a coarser level of one that has more than `most` triangles; whether there is one.
    fn follow_light(&mut self, document: &Document, most: usize) -> Result<bool, SurfaceError> {
        let (Some((_, levels)), Some(shown)) = (&document.levels, &document.shown) else { return Ok(false) };
        if shown.level.triangles.len() <= most {
            return Ok(false);
        }
        let of = (self.revision, self.scalars_of, most);
        if self.light_of != Some(of) {
            self.light_of = None;
            let coarse = levels.level(Target::Triangles(most as u32));
            let used = coarse.triangles.as_flattened().iter().max().map_or(0, |&last| last as usize + 1);
            let mesh = TriMesh { positions: levels.positions[..used].to_vec(), triangles: coarse.triangles };
            upload(&self.device, &self.queue, &mut self.light, &mesh)?;
            let scalars = self.has_scalars.then(|| scalars(document, self.scalars_of)).flatten();
            self.light.set_scalars(&self.device, &self.queue, scalars.as_deref().and_then(|all| all.get(..used)))?;
            self.light_of = Some(of);
        }
        Ok(true)
    }

    /// Makes a coarser copy of the kept pieces as they were opened, where they have more than `most` triangles; whether there is
    /// one.
    fn follow_light_before(&mut self, document: &Document, keep: Keep, most: usize) -> Result<bool, SurfaceError> {
        let Some(of @ Before::Kept(..)) = self.before_of else { return Ok(false) };
        if self.before.triangle_count() as usize <= most {
            return Ok(false);
        }
        let of = (of, most);
        if self.light_before_of != Some(of) {
            self.light_before_of = None;
            upload(&self.device, &self.queue, &mut self.light_before, &clustered(&document.before(keep), most))?;
            self.light_before_of = Some(of);
        }
        Ok(true)
    }

    /// Brings the slices in memory up to those that are shown.
    ///
    /// # Errors
    /// When the device does not allow a buffer.
    pub(super) fn follow_slices(&mut self, shown: &[Arc<SlicePicture>]) -> Result<(), SurfaceError> {
        self.slices.retain(|(serial, _)| shown.iter().any(|slice| slice.serial == *serial));
        for slice in shown {
            if !self.slices.iter().any(|(serial, _)| *serial == slice.serial) {
                let made = GpuSlice::new(&self.device, &self.queue, slice.size, &slice.pixels, slice.corners)?;
                self.slices.push((slice.serial, made));
            }
        }
        Ok(())
    }

    /// Uploads the surface as it was opened, or what is shown in its place: the pieces that are kept.
    fn follow_before(&mut self, document: &Document, keep: Keep) -> Result<(), SurfaceError> {
        let Revision { document: open, opened, averaged, .. } = document.revision;
        let of = Before::Kept(open, opened, averaged, keep);
        if document.levels.is_some() && self.before_of != Some(of) && !document.pieces.labels.is_empty() {
            upload(&self.device, &self.queue, &mut self.before, &document.before(keep))?;
            self.before_of = Some(of);
        }
        Ok(())
    }

    /// Uploads a surface that has no levels yet, a part in each frame, so that none waits long however large it is.
    fn follow_whole(&mut self, document: &Document) -> Result<(), SurfaceError> {
        let of = Before::Whole(document.revision.document, Arc::as_ptr(&document.opened).addr());
        if self.before_of != Some(of) {
            // Its first part goes with the frame in which its bytes arrived, which takes long anyway.
            (self.before_of, self.uploaded) = (Some(of), Some(0));
        }
        if let Some(from) = self.uploaded {
            self.uploaded = self.before.upload_part(&self.device, &self.queue, &document.opened, from)?;
        }
        Ok(())
    }

    /// Uploads the pieces that are not kept.
    fn follow_left_out(&mut self, document: &Document, keep: Keep) -> Result<(), SurfaceError> {
        let of = (document.revision.document, document.revision.opened, keep);
        if self.left_out_of != Some(of) && !document.pieces.labels.is_empty() {
            let left_out = document.opened.filtered(|t| !document.pieces.keeps(keep, t));
            upload(&self.device, &self.queue, &mut self.left_out, &left_out)?;
            self.left_out_of = Some(of);
        }
        Ok(())
    }

    /// Draws view `index`, if it would look other than it does, and gives the texture that it is in.
    ///
    /// # Errors
    /// When the surface does not fit into the memory that the device allows.
    pub(super) fn draw(
        &mut self,
        index: usize,
        picture: &Picture,
        document: Option<&Document>,
        keep: Keep,
    ) -> Result<TextureId, SurfaceError> {
        if let Some(document) = document {
            if picture.before {
                self.follow_before(document, keep)?;
            }
            if picture.left_out {
                self.follow_left_out(document, keep)?;
            }
        }
        let is_light = match document.zip(picture.light) {
            Some((document, most)) if picture.before => self.follow_light_before(document, keep, most)?,
            Some((document, most)) => self.follow_light(document, most)?,
            None => false,
        };
        let is_whole = picture.before && matches!(self.before_of, Some(Before::Whole(..)));
        let view = &mut self.views[index];
        let Some(target) = view.stale(
            &self.device,
            picture.size,
            (picture.clone(), self.revision, keep, is_whole && self.uploaded.is_none()),
        ) else {
            return Ok(view.id());
        };
        let main = match (picture.before, is_light) {
            (false, false) => &self.level,
            (false, true) => &self.light,
            (true, false) => &self.before,
            (true, true) => &self.light_before,
        };
        // Lines follow with the level: of a surface as it comes from a scan they are one white area.
        let look = if is_whole { Look::Shaded } else { picture.look };
        let main = Drawable { surface: main, look, tint: None };
        let left_out = Drawable { surface: &self.left_out, look, tint: Some(faint(&picture.style)) };
        let mut things: Vec<&dyn Draw> = vec![&Backdrop, &main];
        if picture.left_out {
            things.push(&left_out);
        }
        things.extend(self.slices.iter().map(|(_, slice)| slice as &dyn Draw));
        let style = Style { map: picture.style.map.filter(|_| self.has_scalars && !picture.before), ..picture.style };
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("view") });
        self.renderer.draw(&mut encoder, target, &picture.camera, &things, &style);
        self.queue.submit([encoder.finish()]);
        Ok(view.id())
    }

    /// The normals of the level's vertices, by node.
    pub(super) fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Whether the level has scalars for a colour map.
    pub(super) fn has_scalars(&self) -> bool {
        self.has_scalars
    }
}

/// A number for each node of the level that is shown, for these colours; `None` until they are known.
pub(super) fn scalars(document: &Document, colours: Colours) -> Option<Cow<'_, [f32]>> {
    match colours {
        Colours::Calibre => document.change_by_node().map(Cow::Borrowed),
        Colours::None => None,
        Colours::Deviation(shown) => document.deviation_scalars(shown),
        Colours::Classes => classes::labels(document).map(Cow::Owned),
        Colours::Array(index) => document.array_by_node(index).map(Cow::Owned),
    }
}

/// The style in which these colours are drawn.
pub(super) fn coloured(style: Style, document: Option<&Document>, colours: Colours) -> Style {
    let map = document.and_then(|document| colour_map(document, colours));
    let array = document.and_then(|document| arrays::chosen(document, colours));
    let by_vertex = colours == Colours::Classes;
    Style {
        map,
        unknown: (colours == Colours::Calibre).then_some(Style::UNKNOWN),
        by_vertex,
        labels: by_vertex || array.is_some_and(|info| !info.labels.is_empty()),
        diverging: colours.are_diverging(),
        ..style
    }
}

/// The map of these colours: deviations up to what is chosen, changes of calibre to twice what is allowed,
/// both ways.
pub(super) fn colour_map(document: &Document, colours: Colours) -> Option<ColourMap> {
    let range = match colours {
        Colours::None => return None,
        Colours::Classes => (0.0, 1.0),
        Colours::Array(_) => return arrays::chosen(document, colours).map(|_| arrays::colour_map()),
        Colours::Deviation(shown) => return document.deviation_map(shown),
        Colours::Calibre => {
            let found = document.calibre.as_ref()?.found.as_ref().ok()?;
            let most = (2.0 * found.tolerance_percent as f32).max(0.2);
            (-most, most)
        }
    };
    Some(ColourMap { range })
}

/// Between the background and the text.
fn faint(style: &Style) -> Colour {
    let (a, b) = (style.background_bottom.0, style.line.0);
    Colour(std::array::from_fn(|i| ((u16::from(a[i]) * 5 + u16::from(b[i]) * 3) / 8) as u8))
}

/// Uploads a surface with all of its triangles.
pub(super) fn upload(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    surface: &mut GpuSurface,
    mesh: &TriMesh,
) -> Result<(), SurfaceError> {
    surface.set_positions(device, queue, &mesh.positions)?;
    let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
    let edges = unique_edges(&mesh.triangles, mesh.positions.len());
    surface.set_level(device, queue, &mesh.triangles, &edges, &normals)
}
