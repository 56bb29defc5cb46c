//! A setting as rows of the panel: a slider, a typed value with its unit and a way back to its default; and how far work
//! is.

use std::ops::RangeInclusive;

use egui::{DragValue, ProgressBar, Role, Slider, Ui};

use super::assist::{describe, name};
use super::icon::{self, Icon};

/// Height of a row, in points.
const ROW: f32 = 20.0;

/// A number that can be set.
pub(super) struct Setting<'a> {
    /// Its name, also for assistive tools.
    pub name: &'a str,
    /// What it does, in a sentence or two.
    pub help: &'a str,
    /// Its unit, with a leading space; empty where it has none.
    pub unit: &'a str,
    /// What can be set.
    pub range: RangeInclusive<f64>,
    /// What it is by default.
    pub default: f64,
    /// Digits after the point.
    pub decimals: usize,
    /// Whether the slider is logarithmic.
    pub logarithmic: bool,
}

impl Setting<'_> {
    /// Shows the rows; says whether the user changed the value, which then has as many digits as are shown.
    pub(super) fn show(&self, ui: &mut Ui, value: &mut f64) -> bool {
        self.show_with_mark(ui, value, None)
    }

    /// The same, with a mark under the slider at a value of the linear scale.
    pub(super) fn show_with_mark(&self, ui: &mut Ui, value: &mut f64, mark: Option<f64>) -> bool {
        // The controls work on what is shown: one that is left alone changes no digit that is not.
        let before = self.rounded(*value);
        let mut shown = before;
        // An identity of its own: rows that come and go above must not take the focus away.
        ui.push_id(self.name, |ui| self.rows(ui, &mut shown, mark));
        let changed = self.rounded(shown).to_bits() != before.to_bits();
        if changed {
            *value = self.rounded(shown);
        }
        changed
    }

    fn rows(&self, ui: &mut Ui, value: &mut f64, mark: Option<f64>) {
        ui.spacing_mut().interact_size.y = ROW;
        ui.horizontal(|ui| {
            ui.label(self.name).on_hover_text(self.help);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                self.reset(ui, value);
                self.typed(ui, value);
            });
        });
        ui.spacing_mut().slider_width = ui.available_width();
        let step = if self.logarithmic { 0.0 } else { libm::pow(10.0, -(self.decimals as f64)) };
        let slider = Slider::new(value, self.range.clone())
            .show_value(false)
            .logarithmic(self.logarithmic)
            .smart_aim(false)
            .step_by(step);
        let response = ui.add(slider).on_hover_text(self.help);
        describe(&response, Role::Slider, self.name, *value);
        if let Some(mark) = mark {
            self.draw_mark(ui, response.rect, mark);
        }
    }

    /// A small triangle that points at `mark` from below.
    fn draw_mark(&self, ui: &Ui, slider: egui::Rect, mark: f64) {
        // Where the middle of the handle can be, as egui has it.
        let aspect = match ui.visuals().handle_shape {
            egui::style::HandleShape::Circle => 1.0,
            egui::style::HandleShape::Rect { aspect_ratio } => aspect_ratio,
        };
        let ways = slider.x_range().shrink(slider.height() / 2.5 * aspect);
        let part = (mark - self.range.start()) / (self.range.end() - self.range.start());
        let tip = egui::pos2(egui::lerp(ways.min..=ways.max, part as f32), slider.center().y + 5.0);
        let corners = vec![tip, tip + egui::vec2(4.5, 7.0), tip + egui::vec2(-4.5, 7.0)];
        ui.painter().add(egui::Shape::convex_polygon(corners, ui.visuals().text_color(), egui::Stroke::NONE));
    }

    fn typed(&self, ui: &mut Ui, value: &mut f64) {
        let field = DragValue::new(value)
            .range(self.range.clone())
            .speed((self.range.end() - self.range.start()) / 1000.0)
            .max_decimals(self.decimals)
            .suffix(self.unit)
            .update_while_editing(false);
        let response = ui.add(field).on_hover_text("Drag, or click to type");
        describe(&response, Role::SpinButton, &format!("{} value", self.name), *value);
    }

    fn reset(&self, ui: &mut Ui, value: &mut f64) {
        let is_default = (*value - self.default).abs() < 1e-9;
        let help = format!("Back to {}{}", self.default, self.unit);
        let label = format!("Reset {}", self.name.to_lowercase());
        if icon::button(ui, Icon::Reset, !is_default, &label, &help).clicked() {
            *value = self.default;
        }
    }

    fn rounded(&self, value: f64) -> f64 {
        let scale = libm::pow(10.0, self.decimals as f64);
        ((value * scale).round() / scale).clamp(*self.range.start(), *self.range.end())
    }
}

/// How far work is: a bar of this width, on a rail that is seen on a panel.
pub(super) fn progress(ui: &mut Ui, fraction: f32, width: f32, what: &str) {
    let bar = ui.scope(|ui| {
        ui.visuals_mut().extreme_bg_color = ui.visuals().widgets.inactive.bg_fill;
        ui.add(ProgressBar::new(fraction).desired_width(width).desired_height(8.0))
    });
    name(&bar.inner, Role::ProgressIndicator, what);
}
