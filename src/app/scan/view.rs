//! The views of a scan: the surface at reduced resolution, and a slice.

use egui::{Align2, Color32, ColorImage, Rect, Role, Sense, TextureHandle, TextureOptions, Ui, pos2, vec2};

use super::state::{OpenScan, Picture};
use crate::app::assist::name;
use crate::app::compare::{CompareScene, Shot};
use crate::app::views::{NO_MEMORY, Views, first_view};
use crate::app::{overlay, theme};
use crate::io::Axes;
use crate::mesh::Bounds;
use crate::render::{Camera, Look};
use crate::volume::Axis;

/// What the views of a scan hold on the device.
#[derive(Default)]
pub(in crate::app) struct ScanView {
    device: Option<egui_wgpu::RenderState>,
    scene: Option<CompareScene>,
    slice: Option<(Picture, TextureHandle)>,
    camera: Camera,
    /// What the camera was last fitted to.
    fitted: Option<Bounds>,
    /// The device had no memory for it.
    is_refused: bool,
}

impl ScanView {
    /// Takes another device, on which nothing stands yet.
    pub(in crate::app) fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        *self = Self { device: device.cloned(), camera: self.camera, fitted: self.fitted, ..Self::default() };
    }

    /// Lets go of all that stands on the device.
    pub(in crate::app) fn let_go(&mut self) {
        (self.scene, self.slice, self.fitted, self.is_refused) = (None, None, None, false);
    }

    /// Gives up what a full device has no memory for.
    pub(in crate::app) fn refuse(&mut self) {
        (self.scene, self.is_refused) = (None, true);
    }

    /// Shows both views in what is left of `ui`.
    pub(in crate::app) fn show(&mut self, ui: &mut Ui, scan: &OpenScan, views: &mut Views, is_narrow: bool) {
        let area = ui.available_rect_before_wrap();
        let (first, second) =
            if is_narrow { area.split_top_bottom_at_fraction(0.5) } else { area.split_left_right_at_fraction(0.5) };
        self.preview(ui, first.shrink(0.5), scan, views);
        self.slice(ui, second.shrink(0.5), scan);
    }

    fn preview(&mut self, ui: &mut Ui, rect: Rect, scan: &OpenScan, views: &mut Views) {
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        name(&response, Role::Image, "Preview of the surface");
        ui.painter_at(rect).rect_filled(rect, 0.0, ui.visuals().panel_fill);
        let mut sentence = None;
        if let Some((mesh, _, bounds)) = &scan.preview {
            if self.fitted.is_none() {
                self.camera.standard_view(first_view(bounds.size()));
                self.camera.fit(bounds, rect.width() / rect.height().max(1.0));
                self.fitted = Some(*bounds);
            }
            // The views' own hand moves this camera too.
            std::mem::swap(&mut self.camera, &mut views.camera);
            views.steer(ui, &response, 1, None, crate::pipeline::settings::Keep::All);
            std::mem::swap(&mut self.camera, &mut views.camera);
            if let (None, false, Some(device)) = (&self.scene, self.is_refused, &self.device) {
                self.scene = Some(CompareScene::new(device));
            }
            let pixels = rect.size() * ui.ctx().pixels_per_point();
            let size = [pixels.x.round().max(1.0) as u32, pixels.y.round().max(1.0) as u32];
            let shot = Shot { camera: self.camera, size, looks: &[Look::Shaded], style: theme::style(ui.visuals()) };
            match self.scene.as_mut().map(|scene| {
                scene.keep_only(&std::iter::once(mesh));
                scene.draw(0, mesh, &shot)
            }) {
                Some(Ok(texture)) => {
                    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                    ui.painter_at(rect).image(texture, rect, whole, Color32::WHITE);
                }
                Some(Err(error)) => sentence = Some(format!("The preview cannot be drawn: {error}.")),
                None if self.is_refused => sentence = Some(NO_MEMORY.to_owned()),
                None => sentence = Some("There is no graphics device to draw with.".to_owned()),
            }
        } else if scan.problem.is_none() {
            sentence = Some("The preview is being made".to_owned());
        }
        if let Some(sentence) = sentence {
            middle(ui, rect, &sentence);
        }
        let writing = overlay::Writing {
            title: "Preview",
            name: scan.preview.as_ref().map(|_| scan.name.as_str()),
            camera: &self.camera,
            axes: Axes::Lps,
            legend: None,
            array: None,
        };
        overlay::show(ui, rect, &writing);
    }

    fn slice(&mut self, ui: &mut Ui, rect: Rect, scan: &OpenScan) {
        let response = ui.allocate_rect(rect, Sense::hover());
        name(&response, Role::Image, "Slice of the scan");
        ui.painter_at(rect).rect_filled(rect, 0.0, Color32::BLACK);
        let Some(picture) = &scan.picture else { return };
        if self.slice.as_ref().is_none_or(|(shown, _)| shown != picture) {
            let image = ColorImage::from_gray(picture.size, &picture.pixels);
            let texture = ui.ctx().load_texture("slice of the scan", image, TextureOptions::LINEAR);
            self.slice = Some((picture.clone(), texture));
        }
        if let Some((_, texture)) = &self.slice {
            let height = rect.height().min(rect.width() / picture.aspect.max(1e-3));
            let place = Rect::from_center_size(rect.center(), vec2(height * picture.aspect, height));
            // The head above, where the second axis of the picture runs towards it.
            let second = if picture.slice.0 == Axis::K { Axis::J } else { Axis::K };
            let is_upward = scan.opened.directions[second.index()][2] > 0.5;
            let (top, bottom) = if is_upward { (1.0, 0.0) } else { (0.0, 1.0) };
            let whole = Rect::from_min_max(pos2(0.0, top), pos2(1.0, bottom));
            ui.painter_at(rect).image(texture.id(), place, whole, Color32::WHITE);
        }
        let corner = rect.shrink(12.0);
        let font = egui::FontId::proportional(12.0);
        let words = format!("Slice {}", picture.slice.1);
        ui.painter_at(rect).text(corner.left_top(), Align2::LEFT_TOP, words, font.clone(), Color32::LIGHT_GRAY);
        let place = corner.right_bottom();
        ui.painter_at(rect).text(place, Align2::RIGHT_BOTTOM, overlay::NOT_CLINICAL, font, Color32::LIGHT_GRAY);
    }
}

/// A sentence in the middle of a view.
fn middle(ui: &Ui, rect: Rect, sentence: &str) {
    let font = egui::TextStyle::Body.resolve(ui.style());
    ui.painter_at(rect).text(rect.center(), Align2::CENTER_CENTER, sentence, font, ui.visuals().text_color());
}
