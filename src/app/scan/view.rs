//! The views of a scan: the surface at reduced resolution, and a slice.

use egui::{Align2, Color32, ColorImage, Rect, Role, Sense, TextureHandle, TextureOptions, Ui, pos2, vec2};

use super::state::{OpenScan, Picture};
use crate::app::assist::name;
use crate::app::compare::{CompareScene, Shot};
use crate::app::graphics_error::surface_error;
use crate::app::places::pixels;
use crate::app::sides::first_view;
use crate::app::views::{NO_MEMORY, Views};
use crate::app::{halo, overlay, theme};
use crate::io::Axes;
use crate::render::{Camera, Look};
use crate::say;
use crate::volume::Axis;

/// What the views of a scan hold on the device.
#[derive(Default)]
pub(super) struct ScanView {
    device: Option<egui_wgpu::RenderState>,
    scene: Option<CompareScene>,
    slice: Option<(Picture, TextureHandle)>,
    camera: Camera,
    /// The scan that the camera was last fitted to.
    fitted: Option<u64>,
    /// The device had no memory for it.
    is_refused: bool,
}

impl ScanView {
    /// Takes another device, on which nothing stands yet.
    pub(super) fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        *self = Self { device: device.cloned(), camera: self.camera, fitted: self.fitted, ..Self::default() };
    }

    /// Lets go of all that stands on the device.
    pub(super) fn release(&mut self) {
        (self.scene, self.slice, self.fitted, self.is_refused) = (None, None, None, false);
    }

    /// Gives up what a full device has no memory for.
    pub(super) fn refuse(&mut self) {
        (self.scene, self.is_refused) = (None, true);
    }

    /// Shows both views in what is left of `ui`.
    /// The voxel that was clicked at, if one was.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        scan: &OpenScan,
        views: &mut Views,
        is_narrow: bool,
    ) -> Option<[usize; 3]> {
        let area = ui.available_rect_before_wrap();
        let (first, second) =
            if is_narrow { area.split_top_bottom_at_fraction(0.5) } else { area.split_left_right_at_fraction(0.5) };
        self.preview(ui, first.shrink(0.5), scan, views);
        self.slice(ui, second.shrink(0.5), scan)
    }

    fn preview(&mut self, ui: &mut Ui, rect: Rect, scan: &OpenScan, views: &mut Views) {
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        name(&response, Role::Image, &say!("scan-preview-view"));
        ui.painter_at(rect).rect_filled(rect, 0.0, ui.visuals().panel_fill);
        let mut sentence = None;
        if let Some((mesh, _, bounds)) = &scan.preview {
            if self.fitted != Some(scan.opened.id) {
                self.camera.standard_view(first_view(bounds.size()));
                self.camera.fit(bounds, rect.width() / rect.height().max(1.0));
                self.fitted = Some(scan.opened.id);
            }
            // The views' own hand moves this camera too.
            std::mem::swap(&mut self.camera, &mut views.camera);
            views.steer(ui, &response, 1, None, crate::pipeline::settings::Keep::All);
            std::mem::swap(&mut self.camera, &mut views.camera);
            if let (None, false, Some(device)) = (&self.scene, self.is_refused, &self.device) {
                self.scene = Some(CompareScene::new(device));
            }
            let shot = Shot {
                camera: self.camera,
                size: pixels(ui, rect),
                looks: &[Look::Shaded],
                style: theme::style(ui.visuals()),
            };
            match self.scene.as_mut().map(|scene| {
                scene.keep_only(&std::iter::once(mesh));
                scene.draw(0, mesh, None, &shot)
            }) {
                Some(Ok(texture)) => {
                    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                    ui.painter_at(rect).image(texture, rect, whole, Color32::WHITE);
                }
                Some(Err(error)) => sentence = Some(say!("scan-preview-not-drawn", why = surface_error(&error))),
                None if self.is_refused => sentence = Some(NO_MEMORY.say()),
                None => sentence = Some(say!("scan-no-device")),
            }
        } else if scan.problem.is_none() {
            sentence = Some(say!("scan-preview-made"));
        }
        if let Some(sentence) = sentence {
            middle(ui, rect, &sentence);
        }
        let writing = overlay::Writing {
            title: &say!("scan-preview"),
            name: scan.preview.as_ref().map(|_| scan.name.as_str()),
            camera: &self.camera,
            axes: scan.opened.axes,
            legend: None,
            array: None,
            is_alone: false,
        };
        overlay::show(ui, rect, &writing);
    }

    fn slice(&mut self, ui: &mut Ui, rect: Rect, scan: &OpenScan) -> Option<[usize; 3]> {
        let response = ui.allocate_rect(rect, Sense::click());
        name(&response, Role::Image, &say!("scan-slice-view"));
        ui.painter_at(rect).rect_filled(rect, 0.0, Color32::BLACK);
        let picture = scan.picture.as_ref()?;
        let mut clicked = None;
        if self.slice.as_ref().is_none_or(|(shown, _)| shown != picture) {
            let most = ui.input(|input| input.max_texture_side);
            let (size, pixels) = thinned(picture, most);
            let image = ColorImage::from_gray(size, &pixels);
            let texture = ui.ctx().load_texture("slice of the scan", image, TextureOptions::LINEAR);
            self.slice = Some((picture.clone(), texture));
        }
        if let Some((_, texture)) = &self.slice {
            let height = rect.height().min(rect.width() / picture.aspect.max(1e-3));
            let place = Rect::from_center_size(rect.center(), vec2(height * picture.aspect, height));
            let [across, down] = match picture.slice.0 {
                Axis::I => [1, 2],
                Axis::J => [0, 2],
                Axis::K => [0, 1],
            };
            let ([mut right, mut bottom], directions) = ([1.0, 1.0], &scan.opened.directions);
            let (mut to_the_right, mut downwards) = (directions[across], directions[down]);
            if is_backwards(to_the_right, Side::Right) {
                (right, to_the_right) = (0.0, to_the_right.map(|x| -x));
            }
            if is_backwards(downwards, Side::Below) {
                (bottom, downwards) = (0.0, downwards.map(|x| -x));
            }
            let whole = Rect::from_min_max(pos2(1.0 - right, 1.0 - bottom), pos2(right, bottom));
            ui.painter_at(rect).image(texture.id(), place, whole, Color32::WHITE);
            let (axis, index) = picture.slice;
            // The part of the way over the picture, and the voxel there.
            let turned = |part: f32, end: f32| if end > 0.0 { part } else { 1.0 - part };
            if let Some(at) = response.interact_pointer_pos().filter(|&at| response.clicked() && place.contains(at)) {
                let parts = (at - place.min) / place.size();
                let mut voxel = [index; 3];
                for (axis, part, pixels) in [
                    (across, turned(parts.x, right), picture.size[0]),
                    (down, turned(parts.y, bottom), picture.size[1]),
                ] {
                    voxel[axis] = ((part * pixels as f32) as usize).min(pixels.saturating_sub(1));
                }
                clicked = Some(voxel);
            }
            if let Some(seed) = scan.seed.filter(|seed| seed[axis.index()] == index) {
                let part = |axis: usize, pixels: usize| (seed[axis] as f32 + 0.5) / pixels as f32;
                let [x, y] =
                    [turned(part(across, picture.size[0]), right), turned(part(down, picture.size[1]), bottom)];
                let stroke = egui::Stroke::new(1.5, ui.visuals().hyperlink_color);
                ui.painter_at(rect).circle_stroke(place.min + place.size() * vec2(x, y), 5.0, stroke);
            }
            let font = egui::FontId::proportional(13.0);
            for (at, align, towards) in [
                (rect.left_center(), Align2::LEFT_CENTER, to_the_right.map(|x| -x)),
                (rect.right_center(), Align2::RIGHT_CENTER, to_the_right),
                (rect.center_top(), Align2::CENTER_TOP, downwards.map(|x| -x)),
                (rect.center_bottom(), Align2::CENTER_BOTTOM, downwards),
            ] {
                let at = at + (rect.center() - at).normalized() * 10.0;
                halo::text(
                    &ui.painter_at(rect),
                    at,
                    align,
                    side(towards, scan.opened.axes),
                    font.clone(),
                    Color32::LIGHT_GRAY,
                );
            }
        }
        let corner = rect.shrink(12.0);
        let font = egui::FontId::proportional(12.0);
        let words = say!("scan-slice-number", number = picture.slice.1.to_string());
        halo::text(
            &ui.painter_at(rect),
            corner.left_top(),
            Align2::LEFT_TOP,
            &words,
            font.clone(),
            Color32::LIGHT_GRAY,
        );
        if theme::is_narrow(ui.ctx()) {
            let words = overlay::NOT_CLINICAL.say();
            let place = corner.right_bottom();
            halo::text(&ui.painter_at(rect), place, Align2::RIGHT_BOTTOM, &words, font, Color32::LIGHT_GRAY);
        }
        clicked
    }
}

/// An edge of a picture.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Right,
    Below,
}

/// Whether what runs in `direction` (LPS) is to be turned over, so that slices lie as radiologists look at them: the
/// patient's left at the right, or the back where the slice is seen from the side, and below what is farthest from the head,
/// or the back.
fn is_backwards([left, back, head]: [f64; 3], side: Side) -> bool {
    match side {
        Side::Right => left < -0.5 || back < -0.5,
        Side::Below => head > 0.5 || back < -0.5 && head.abs() <= 0.5,
    }
}

/// The letter of the side of the patient that a direction (LPS) runs to mostly; of the axis, where nothing is known of sides.
fn side(direction: [f64; 3], axes: Axes) -> &'static str {
    let letters = match axes {
        Axes::Unknown => [["-X", "X"], ["-Y", "Y"], ["-Z", "Z"]],
        Axes::Lps | Axes::Ras => [["R", "L"], ["A", "P"], ["F", "H"]],
    };
    let most = (0..3).max_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs())).unwrap_or(0);
    letters[most][usize::from(direction[most] > 0.0)]
}

/// Every so many pixels of a slice that no side has more than `most`.
fn thinned(picture: &Picture, most: usize) -> ([usize; 2], std::borrow::Cow<'_, [u8]>) {
    let [width, height] = picture.size;
    let step = width.max(height).div_ceil(most.max(1)).max(1);
    if step == 1 {
        return (picture.size, (&picture.pixels[..]).into());
    }
    let rows = (0..height).step_by(step);
    let pixels: Vec<u8> = rows
        .flat_map(|y| (0..width).step_by(step).map(move |x| (x, y)))
        .map(|(x, y)| picture.pixels[y * width + x])
        .collect();
    ([width.div_ceil(step), height.div_ceil(step)], pixels.into())
}

/// A sentence in the middle of a view.
fn middle(ui: &Ui, rect: Rect, sentence: &str) {
    let font = egui::TextStyle::Body.resolve(ui.style());
    ui.painter_at(rect).text(rect.center(), Align2::CENTER_CENTER, sentence, font, ui.visuals().text_color());
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEFT: [f64; 3] = [1.0, 0.0, 0.0];
    const BACK: [f64; 3] = [0.0, 1.0, 0.0];
    const HEAD: [f64; 3] = [0.0, 0.0, 1.0];

    fn opposite(direction: [f64; 3]) -> [f64; 3] {
        direction.map(|x| -x)
    }

    #[test]
    fn slices_lie_as_radiologists_look_at_them() {
        // DICOM's own axial slice: columns to the left, rows to the back. A RAS file runs the other way along both.
        assert!(!is_backwards(LEFT, Side::Right) && !is_backwards(BACK, Side::Below));
        assert!(is_backwards(opposite(LEFT), Side::Right) && is_backwards(opposite(BACK), Side::Below));
        // Coronal and sagittal slices have the head above; the face looks to the left of a sagittal one.
        assert!(is_backwards(HEAD, Side::Below) && !is_backwards(opposite(HEAD), Side::Below));
        assert!(!is_backwards(BACK, Side::Right) && is_backwards(opposite(BACK), Side::Right));
        let letters = [LEFT, opposite(LEFT), BACK, opposite(BACK), HEAD, opposite(HEAD)].map(|d| side(d, Axes::Lps));
        assert_eq!(letters, ["L", "R", "P", "A", "H", "F"]);
        assert_eq!((side(LEFT, Axes::Unknown), side(opposite(HEAD), Axes::Unknown)), ("X", "-Z"));
    }

    #[test]
    fn a_slice_that_is_larger_than_a_texture_is_thinned() {
        let picture =
            Picture { slice: (Axis::K, 0), window: [0.0, 1.0], size: [5, 2], pixels: (0..10).collect(), aspect: 2.5 };
        assert_eq!(thinned(&picture, 5), ([5, 2], (0..10).collect::<Vec<u8>>().into()));
        assert_eq!(thinned(&picture, 4), ([3, 1], vec![0, 2, 4].into()));
        assert_eq!(thinned(&picture, 1), ([1, 1], vec![0].into()));
    }
}
