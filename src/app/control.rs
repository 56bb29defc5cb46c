//! The rows of the panel: a setting as a slider, a typed value with its unit and a way back to its default.

use std::ops::RangeInclusive;

use egui::{DragValue, Response, RichText, Role, Slider, Ui, WidgetInfo};

/// A number that can be set.
pub struct Setting<'a> {
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
    /// Shows the rows; says whether the value was changed.
    pub fn show(&self, ui: &mut Ui, value: &mut f64) -> bool {
        let before = *value;
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
        *value = self.rounded(*value);
        before.to_bits() != value.to_bits()
    }

    fn typed(&self, ui: &mut Ui, value: &mut f64) {
        let digits = self.decimals;
        let field = DragValue::new(value)
            .range(self.range.clone())
            .speed((self.range.end() - self.range.start()) / 1000.0)
            .max_decimals(digits)
            .suffix(self.unit)
            .update_while_editing(false);
        let response = ui.add(field).on_hover_text("Drag, or click to type");
        describe(&response, Role::SpinButton, &format!("{} value", self.name), *value);
    }

    fn reset(&self, ui: &mut Ui, value: &mut f64) {
        let is_default = (*value - self.default).abs() < 1e-9;
        let button = egui::Button::new(RichText::new("⟲")).frame(false);
        let response =
            ui.add_enabled(!is_default, button).on_hover_text(format!("Back to {}{}", self.default, self.unit));
        name(&response, Role::Button, &format!("Reset {}", self.name.to_lowercase()));
        if response.clicked() {
            *value = self.default;
        }
    }

    /// The value with as many digits as are shown, so that what is shown is what is computed with.
    fn rounded(&self, value: f64) -> f64 {
        let scale = libm::pow(10.0, self.decimals as f64);
        ((value * scale).round() / scale).clamp(*self.range.start(), *self.range.end())
    }
}

/// Tells assistive tools what a control is called and where it stands.
fn describe(response: &Response, kind: Role, label: &str, value: f64) {
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(kind, response.enabled(), label);
        info.value = Some(value);
        info
    });
}

/// Tells assistive tools what a control is called.
pub fn name(response: &Response, kind: Role, label: &str) {
    response.widget_info(|| WidgetInfo::labeled(kind, response.enabled(), label));
}

/// A whole number in groups of three: 74,307.
pub fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    #[test]
    fn numbers_are_grouped_in_threes() {
        assert_eq!(
            [0, 12, 743, 7_430, 74_307, 1_000_000].map(super::grouped),
            ["0", "12", "743", "7,430", "74,307", "1,000,000"]
        );
    }
}
