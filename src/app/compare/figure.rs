//! A comparison as a picture for print, drawn apart from any window: the cells of the compare view under a title.

use egui::{Align, CentralPanel, Color32, Frame, Layout, Pos2, RawInput, Rect, RichText, Ui, UiBuilder, vec2};
use egui_wgpu::{Renderer, RendererOptions};

use super::arrangement::Arrangement;
use super::cell::{self, Manner};
use super::comparison::{Made, Outcome};
use super::scene::CompareScene;
use super::words;
use crate::app::graphics_error::{picture_error, surface_error};
use crate::app::theme;
use crate::io::Axes;
use crate::pipeline::deviation::REPORT_SAMPLES;
use crate::render::{Camera, Picture, PictureError, Style, SurfaceError, ViewTarget};
use crate::say;

/// Width of a figure in points: what it has room for does not depend on its width in pixels.
const WIDTH: f32 = 960.0;
const MARGIN: f32 = 24.0;
const GAP: f32 = 8.0;
const HEAD: f32 = 56.0;
const FOOT: f32 = 44.0;
const COLUMNS: usize = 3;

/// A figure: what it shows and from where.
pub struct Figure<'a> {
    /// Its title.
    pub title: &'a str,
    /// The surface's name.
    pub name: &'a str,
    /// Which way the patient lies, as far as that is known.
    pub axes: Axes,
    /// The settings and what was made at each, row by row in three columns; at least one.
    pub cells: &'a [Made],
    /// How their pictures are arranged.
    pub arrangement: Arrangement,
}

/// Why there is no figure.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// Nothing to draw with.
    #[error("{}", say!("compare-error-device"))]
    Device(#[from] egui_wgpu::WgpuError),
    /// The picture is larger than the device allows.
    #[error("{}", say!("compare-error-too-large", width = .width.to_string(), height = .height.to_string(),
        limit = .limit.to_string()))]
    TooLarge {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Pixels.
        limit: u32,
    },
    /// A surface does not fit into GPU memory.
    #[error("{}", surface_error(.0))]
    Surface(#[from] SurfaceError),
    /// The picture does not come back.
    #[error("{}", picture_error(.0))]
    Picture(#[from] PictureError),
}

/// A graphics device without a window.
pub struct Studio {
    state: egui_wgpu::RenderState,
}

impl Studio {
    /// On the window's device, with textures of its own.
    pub(in crate::app) fn beside(window: &egui_wgpu::RenderState) -> Self {
        let target_format = ViewTarget::FORMAT;
        let renderer = Renderer::new(&window.device, target_format, RendererOptions::PREDICTABLE);
        #[cfg_attr(
            target_arch = "wasm32",
            expect(
                clippy::arc_with_non_send_sync,
                reason = "as the window's renderer is, on the one thread of a page"
            )
        )]
        let renderer = std::sync::Arc::new(egui::mutex::RwLock::new(renderer));
        Self { state: egui_wgpu::RenderState { target_format, renderer, ..window.clone() } }
    }

    /// Finds a device.
    ///
    /// # Errors
    /// When there is none.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn open() -> Result<Self, FigureError> {
        let setup = egui_wgpu::WgpuSetup::CreateNew(egui_wgpu::WgpuSetupCreateNew::without_display_handle());
        let instance = pollster::block_on(setup.new_instance());
        let configuration = egui_wgpu::WgpuConfiguration { wgpu_setup: setup, ..Default::default() };
        let options = RendererOptions::PREDICTABLE;
        let state = egui_wgpu::RenderState::create(&configuration, &instance, None, options);
        Ok(Self { state: pollster::block_on(state)? })
    }

    /// The device, and what is submitted to it.
    #[cfg(not(target_arch = "wasm32"))]
    pub(in crate::app) fn device(&self) -> (&wgpu::Device, &wgpu::Queue) {
        (&self.state.device, &self.state.queue)
    }

    /// Draws a figure `width` pixels wide; its height follows from the surface's form. Where the device allows, it is
    /// drawn twice as large and averaged, so that thin vessels and dense edges come out as shades.
    ///
    /// # Errors
    /// When the device does not allow a picture or a surface of that size.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn draw(&self, figure: &Figure<'_>, width: u32) -> Result<Picture, FigureError> {
        let (texture, is_double) = self.drawn(figure, width)?;
        let picture = Picture::read_texture_now(&texture, &self.state.device, &self.state.queue)?;
        Ok(if is_double { halved(&picture) } else { picture })
    }

    /// As [`Self::draw`], and hands the picture to `then` in a later frame.
    ///
    /// # Errors
    /// When the device does not allow a picture or a surface of that size.
    pub(in crate::app) fn take(
        &self,
        figure: &Figure<'_>,
        width: u32,
        then: impl FnOnce(Result<Picture, PictureError>) + wgpu::WasmNotSend + 'static,
    ) -> Result<(), FigureError> {
        let (texture, is_double) = self.drawn(figure, width)?;
        let then = move |picture: Result<Picture, PictureError>| {
            then(picture.map(|picture| if is_double { halved(&picture) } else { picture }));
        };
        Picture::read_texture(&texture, &self.state.device, &self.state.queue, then);
        Ok(())
    }

    /// The figure `width` pixels wide, or twice as wide and high where the device allows.
    fn drawn(&self, figure: &Figure<'_>, width: u32) -> Result<(wgpu::Texture, bool), FigureError> {
        let plan = Plan::new(figure);
        let height = (plan.height * width as f32 / WIDTH).round() as u32;
        let limit = self.state.device.limits().max_texture_dimension_2d;
        if width.max(height) > limit {
            return Err(FigureError::TooLarge { width, height, limit });
        }
        let is_double = 2 * width.max(height) <= limit;
        let times = if is_double { 2 } else { 1 };
        Ok((self.draw_once(figure, &plan, [times * width, times * height])?, is_double))
    }

    fn draw_once(&self, figure: &Figure<'_>, plan: &Plan, size: [u32; 2]) -> Result<wgpu::Texture, FigureError> {
        let limit = self.state.device.limits().max_texture_dimension_2d;
        let scale = size[0] as f32 / WIDTH;
        let ctx = egui::Context::default();
        theme::apply(&ctx);
        ctx.set_theme(egui::Theme::Light);
        let mut scene = CompareScene::new(&self.state);
        let mut drawn = Ok(());
        let mut shapes = Vec::new();
        // What is measured in the first pass is in its place in the second.
        for _ in 0..2 {
            let output = ctx.run_ui(input(plan.height, scale, limit), |ui| {
                drawn = show(ui, &mut scene, figure, plan);
            });
            self.take_textures(output.textures_delta);
            shapes = output.shapes;
        }
        drawn?;
        let jobs = ctx.tessellate(shapes, scale);
        Ok(self.paint(&jobs, &egui_wgpu::ScreenDescriptor { size_in_pixels: size, pixels_per_point: scale }))
    }

    /// Uploads what the window library wrote to its textures: letters.
    fn take_textures(&self, mut delta: egui::TexturesDelta) {
        let mut renderer = self.state.renderer.write();
        let mut changed: Vec<_> = delta.set.drain().collect();
        changed.sort_by_key(|(id, _)| *id);
        for (id, parts) in changed {
            for part in parts {
                renderer.update_texture(&self.state.device, &self.state.queue, id, &part);
            }
        }
        // Nothing is let go before the picture is painted; all of it is with the renderer.
        delta.free.clear();
    }

    fn paint(&self, jobs: &[egui::ClippedPrimitive], screen: &egui_wgpu::ScreenDescriptor) -> wgpu::Texture {
        let (device, queue) = (&self.state.device, &self.state.queue);
        let [width, height] = screen.size_in_pixels;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("figure"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.state.target_format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("figure") });
        let mut renderer = self.state.renderer.write();
        let uploads = renderer.update_buffers(device, queue, &mut encoder, jobs, screen);
        let mut pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("figure"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            })
            .forget_lifetime();
        renderer.render(&mut pass, jobs, screen);
        drop(pass);
        queue.submit(uploads.into_iter().chain([encoder.finish()]));
        texture
    }
}

/// A picture of half the width and height: each pixel the mean of four, as they are encoded (see `render` on colours).
fn halved(picture: &Picture) -> Picture {
    let (width, height) = (picture.width / 2, picture.height / 2);
    let row = 4 * picture.width as usize;
    let mut rgba = Vec::with_capacity(4 * width as usize * height as usize);
    for rows in picture.rgba.chunks_exact(2 * row) {
        let (above, below) = rows.split_at(row);
        for (above, below) in above.chunks_exact(8).zip(below.chunks_exact(8)) {
            let sum = |k: usize| [above[k], above[k + 4], below[k], below[k + 4]].map(u16::from).iter().sum::<u16>();
            rgba.extend((0..4).map(|k| ((sum(k) + 2) / 4) as u8));
        }
    }
    Picture { width, height, rgba }
}

fn input(height: f32, scale: f32, limit: u32) -> RawInput {
    let mut input = RawInput {
        screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(WIDTH, height))),
        max_texture_side: Some(limit as usize),
        ..Default::default()
    };
    if let Some(viewport) = input.viewports.get_mut(&egui::ViewportId::ROOT) {
        viewport.native_pixels_per_point = Some(scale);
    }
    input
}

/// Where everything goes, in points, and from where the surface is seen.
struct Plan {
    height: f32,
    cell: egui::Vec2,
    picture: f32,
    camera: Camera,
}

impl Plan {
    fn new(figure: &Figure<'_>) -> Self {
        let mut bounds = crate::mesh::Bounds::EMPTY;
        for made in figure.cells {
            bounds = bounds.joined(&made.mesh.bounds());
        }
        let mut camera = Camera::default();
        crate::app::sides::stand(&mut camera, crate::app::sides::first_view(bounds.size()), figure.axes);
        let width = (WIDTH - 2.0 * MARGIN - GAP * (COLUMNS - 1) as f32) / COLUMNS as f32;
        // As high as the surface is beside its width, within what a page has room for.
        let axes = camera.axes();
        let size = bounds.size();
        let along = |k: usize| size.x * axes[0][k].abs() + size.y * axes[1][k].abs() + size.z * axes[2][k].abs();
        let form = along(1) / along(0).max(f32::MIN_POSITIVE);
        let picture = width * if form.is_finite() { form.clamp(0.6, 1.4) } else { 1.0 };
        camera.fit(&bounds, width / picture);
        let cell = vec2(width, picture * figure.arrangement.rows() as f32 + cell::caption_height(width));
        let rows = figure.cells.len().div_ceil(COLUMNS).max(1) as f32;
        Self { height: HEAD + FOOT + 2.0 * MARGIN + cell.y * rows + GAP * (rows - 1.0), cell, picture, camera }
    }
}

fn show(ui: &mut Ui, scene: &mut CompareScene, figure: &Figure<'_>, plan: &Plan) -> Result<(), SurfaceError> {
    let mut drawn = Ok(());
    CentralPanel::default().frame(Frame::new().fill(Color32::WHITE)).show(ui, |ui| {
        let page = Rect::from_min_size(Pos2::ZERO, vec2(WIDTH, plan.height)).shrink(MARGIN);
        let all: Vec<_> = figure.cells.iter().map(|made| &made.report.settings).collect();
        let (shared, titles) = words::titles(&all);
        part(ui, page.split_top_bottom_at_y(page.top() + HEAD).0, |ui| {
            ui.label(RichText::new(figure.title).size(20.0).strong());
            let below = [figure.name, &shared].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>();
            ui.label(RichText::new(below.join("  ·  ")).weak());
        });
        part(ui, page.split_top_bottom_at_y(page.bottom() - FOOT + GAP).1, |ui| {
            ui.label(RichText::new(say!("compare-figure-legend", samples = REPORT_SAMPLES)).small().weak());
            ui.with_layout(Layout::left_to_right(Align::Min), |ui| {
                ui.label(RichText::new(say!("report-not-clinical")).small().strong());
                ui.label(RichText::new(format!("Lumen {}", env!("CARGO_PKG_VERSION"))).small().weak());
            });
        });
        for (i, (made, title)) in figure.cells.iter().zip(titles).enumerate() {
            let step = plan.cell + vec2(GAP, GAP);
            let at = vec2(step.x * (i % COLUMNS) as f32, step.y * (i / COLUMNS) as f32);
            let rect = Rect::from_min_size(page.min + vec2(0.0, HEAD) + at, plan.cell);
            let shown = panel(ui, scene, i, rect, made, &title, figure, plan);
            drawn = drawn.clone().and(shown);
        }
    });
    drawn
}

#[expect(clippy::too_many_arguments, reason = "one call, and a struct would only name the same things again")]
fn panel(
    ui: &mut Ui,
    scene: &mut CompareScene,
    index: usize,
    rect: Rect,
    made: &Made,
    title: &str,
    figure: &Figure<'_>,
    plan: &Plan,
) -> Result<(), SurfaceError> {
    let (above, below) = rect.split_top_bottom_at_y(rect.bottom() - cell::caption_height(rect.width()));
    let manner = Manner {
        arrangement: figure.arrangement,
        camera: &plan.camera,
        flat: false,
        style: Style { occlusion: true, ..Style::LIGHT },
        scalars: None,
        axes: figure.axes,
    };
    cell::pictures(ui, scene, index, above, made, &manner)?;
    let letter = char::from(b'a' + (index % 26) as u8);
    let line = ui.visuals().widgets.noninteractive.bg_stroke;
    if above.height() > 1.5 * plan.picture {
        ui.painter().hline(above.x_range(), above.center().y, line);
    }
    ui.painter().rect_stroke(rect, 0.0, line, egui::StrokeKind::Inside);
    let outcome = Outcome::Done(Box::new(made.clone()));
    cell::caption(ui, below, &format!("({letter}) {title}"), &outcome, 0.0);
    Ok(())
}

/// Shows something in a part of the page.
fn part(ui: &mut Ui, rect: Rect, show: impl FnOnce(&mut Ui)) {
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::LEFT)));
    child.spacing_mut().item_spacing = vec2(GAP, 2.0);
    show(&mut child);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_pixels_become_their_mean() {
        let grey = |v: u8| [v, v, v, 255];
        let rgba = [0, 255, 10, 20, 255, 0, 30, 40].map(grey).concat();
        let found = halved(&Picture { width: 4, height: 2, rgba });
        assert_eq!((found.width, found.height), (2, 1));
        assert_eq!(found.rgba, [grey(128), grey(25)].concat());
    }
}
