//! A setting as rows of the panel: a slider, a typed value with its unit and a way back to its default; and how far work
//! is.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use egui::{
    Align, ComboBox, Direction, DragValue, Key, Label, Layout, Modifiers, ProgressBar, RichText, Role, Slider,
    TextStyle, TextWrapMode, Ui, WidgetText, vec2,
};

use super::assist::{describe, name};
use super::explain::explain;
use super::icon::{self, Icon};
use super::row::row;
use super::swipe::Way;
use super::theme;
use super::tie::Tie;
use crate::language::{exact, grouped, inner, parse, text};
use crate::pipeline::settings::Settings;
use crate::pipeline::settings::table::{self, Kind, Value};
use crate::say;

/// Height of a slider where a mouse points, and that of the row above it, in points.
const ROW: f32 = 20.0;
const NAME_ROW: f32 = 24.0;

/// Height of the row above a slider where a finger points and there is next to no height, in points.
const FLAT_ROW: f32 = 16.0;

/// Width of a field beside its slider, in points.
const FIELD: f32 = 64.0;
/// By how much a small name stands nearer to its slider than rows stand to one another, in points.
const LOW_GAP: f32 = 3.0;

/// How the rows of a number stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Name and field in a row, and below them the slider in the whole of the width.
    Tall,
    /// The name in small letters, and below it slider and field in a row: lower where rows have the height of a finger.
    Low,
    /// Name and field in a row of small letters, and below them the slider: nothing else, where there is next to no height.
    /// A finger reads the field, which would be as high as the slider.
    Flat,
}

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
    /// Whether it is set by itself, where it can be: that is then its default.
    pub auto: Option<bool>,
    /// Digits after the point.
    pub decimals: usize,
    /// Whether the slider is logarithmic.
    pub logarithmic: bool,
}

/// What a user has done to a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    /// Nothing.
    None,
    /// Set a number, which then has as many digits as are shown.
    Number,
    /// Gone back to the default.
    Reset,
}

impl Setting<'_> {
    /// Shows the rows; says whether the user changed the value.
    pub(super) fn show(&self, ui: &mut Ui, value: &mut f64) -> bool {
        self.show_docked(ui, value, Form::Tall, None) != Change::None
    }

    /// The same in the form of the dock, with a mark under the slider at a value of the linear scale.
    pub(super) fn show_docked(&self, ui: &mut Ui, value: &mut f64, form: Form, mark: Option<f64>) -> Change {
        // The controls work on what is shown: one that is left alone changes no digit that is not.
        let before = self.rounded(*value);
        let mut shown = before;
        // An identity of its own: rows that come and go above must not take the focus away.
        if ui.push_id(self.name, |ui| self.rows(ui, &mut shown, form, mark)).inner {
            *value = self.default;
            return Change::Reset;
        }
        if self.rounded(shown).to_bits() == before.to_bits() {
            return Change::None;
        }
        *value = self.rounded(shown);
        Change::Number
    }

    /// Says whether the user goes back to the default.
    fn rows(&self, ui: &mut Ui, value: &mut f64, form: Form, mark: Option<f64>) -> bool {
        let way = Way::of(ui);
        let mut is_reset = false;
        match form {
            Form::Tall => {
                // As high as the field: name, field and button stand on one line.
                ui.spacing_mut().interact_size.y = theme::row(ui.ctx(), NAME_ROW);
                ui.horizontal(|ui| {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        is_reset = self.reset(ui, *value);
                        self.typed(ui, value, way);
                        self.named(ui, |text| text);
                    });
                });
                ui.spacing_mut().interact_size.y = theme::row(ui.ctx(), ROW);
                self.slider(ui, value, way, mark);
            }
            Form::Low => {
                explain(ui.add(Label::new(RichText::new(self.title()).small())), self.help);
                // Closer to its own slider than to the one above.
                ui.add_space(-LOW_GAP);
                ui.horizontal(|ui| {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        is_reset = self.reset(ui, *value);
                        // Of one width: sliders below one another end below one another.
                        let size = vec2(FIELD, ui.spacing().interact_size.y);
                        let field = Layout::centered_and_justified(Direction::TopDown);
                        ui.allocate_ui_with_layout(size, field, |ui| self.typed(ui, value, way));
                        self.slider(ui, value, way, mark);
                    });
                });
            }
            Form::Flat => {
                let has_finger = theme::suits_finger(ui.ctx());
                ui.spacing_mut().interact_size.y = if has_finger { FLAT_ROW } else { NAME_ROW };
                ui.horizontal(|ui| {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        if has_finger {
                            let shown = format!("{}{}", exact(self.rounded(*value)), self.unit);
                            // Rather the whole name than a part of it beside the number, which the slider tells roughly.
                            let needed =
                                [self.name, shown.as_str()].map(|text| small_width(ui, text)).iter().sum::<f32>();
                            if needed + ui.spacing().item_spacing.x <= ui.available_width() {
                                ui.label(RichText::new(shown).small().strong());
                            }
                        } else {
                            self.typed(ui, value, way);
                        }
                        self.named(ui, RichText::small);
                    });
                });
                ui.spacing_mut().interact_size.y = theme::row(ui.ctx(), ROW);
                self.slider(ui, value, way, mark);
            }
        }
        is_reset
    }

    /// The name in what is left of a row that is filled from the right: without what stands in brackets behind it where that
    /// has no room.
    fn named(&self, ui: &mut Ui, look: impl Fn(RichText) -> RichText) {
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let words = |text: &str| WidgetText::from(look(RichText::new(text)));
            let title = words(&self.title());
            let galley = title.clone().into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Body);
            let fits = galley.size().x <= ui.available_width();
            let label = ui.add(Label::new(if fits { title } else { words(self.name) }).truncate());
            explain(label, self.help);
        });
    }

    /// What stands above the slider: the name, and whether it is set by itself.
    fn title(&self) -> Cow<'_, str> {
        match self.auto {
            Some(true) => format!("{} ({})", self.name, say!("panel-auto-short")).into(),
            _ => self.name.into(),
        }
    }

    /// The slider, as wide as there is room.
    fn slider(&self, ui: &mut Ui, value: &mut f64, way: Way, mark: Option<f64>) {
        ui.spacing_mut().slider_width = ui.available_width();
        let step = if self.logarithmic { 0.0 } else { libm::pow(10.0, -(self.decimals as f64)) };
        let slider = Slider::from_get_set(self.range.clone(), |set| way.take(value, set))
            .show_value(false)
            .logarithmic(self.logarithmic)
            .smart_aim(false)
            .step_by(step);
        let response = ui.add(slider).on_hover_text(self.help.to_owned());
        way.scroll(ui, &response);
        if response.has_focus() {
            self.take_keys(ui, value);
        }
        describe(&response, Role::Slider, self.name, self.rounded(*value));
        if let Some(mark) = mark {
            self.draw_mark(ui, response.rect, mark);
        }
    }

    /// Page up and Page down go a tenth of the slider's way, Home and End to its ends.
    fn take_keys(&self, ui: &Ui, value: &mut f64) {
        let (low, high) = (*self.range.start(), *self.range.end());
        let goes = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)) as f64;
        let tenths = goes(Key::PageUp) - goes(Key::PageDown);
        if tenths != 0.0 {
            *value = if self.logarithmic && low > 0.0 {
                *value * libm::pow(high / low, tenths / 10.0)
            } else {
                *value + tenths / 10.0 * (high - low)
            };
        }
        for (key, end) in [(Key::Home, low), (Key::End, high)] {
            if goes(key) > 0.0 {
                *value = end;
            }
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

    fn typed(&self, ui: &mut Ui, value: &mut f64, way: Way) {
        let before = *value;
        let field = reads_comma(DragValue::new(value), self.decimals == 0)
            .range(self.range.clone())
            .speed((self.range.end() - self.range.start()) / 1000.0)
            .max_decimals(self.decimals)
            .suffix(self.unit)
            .update_while_editing(false);
        let response = ui.add(field).on_hover_text(say!("panel-type"));
        if way.scroll(ui, &response) {
            *value = before;
        }
        describe(&response, Role::SpinButton, &say!("panel-value", name = self.name), self.rounded(*value));
    }

    fn reset(&self, ui: &mut Ui, value: f64) -> bool {
        let is_default = self.auto.unwrap_or((value - self.default).abs() < 1e-9);
        let help = match self.auto {
            Some(_) => say!("panel-back-to-auto"),
            None => say!("panel-back-to", value = self.default, unit = self.unit),
        };
        let label = say!("panel-reset", name = inner(self.name));
        icon::button(ui, Icon::Reset, !is_default, &label, &help).clicked()
    }

    fn rounded(&self, value: f64) -> f64 {
        let scale = libm::pow(10.0, self.decimals as f64);
        ((value * scale).round() / scale).clamp(*self.range.start(), *self.range.end())
    }
}

/// The width of a text in small letters, in points.
fn small_width(ui: &Ui, text: &str) -> f32 {
    let galley = WidgetText::from(RichText::new(text).small().strong());
    galley.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Small).size().x
}

/// Shows a setting of the table: a slider, a box to tick or a list. What has no control of this kind (a limit, pieces, a
/// target) shows nothing, nor does a setting without a name in the panel.
pub(super) fn setting(ui: &mut Ui, setting: &table::Setting, settings: &mut Settings) {
    self::docked(ui, setting, settings, Form::Tall);
}

/// The same, a number in this form.
pub(super) fn docked(ui: &mut Ui, setting: &table::Setting, settings: &mut Settings, form: Form) {
    if setting.messages.label.is_empty() {
        return;
    }
    let Some(tie) = Tie::of(setting.key) else { return control(ui, setting, settings, form) };
    tie.around(ui, |ui| control(ui, setting, settings, form));
}

fn control(ui: &mut Ui, setting: &table::Setting, settings: &mut Settings, form: Form) {
    let (words, help) = (text(setting.messages.label), text(setting.messages.help));
    match setting.kind {
        Kind::Switch { at } => {
            ui.checkbox(at(settings), words).on_hover_text(help);
        }
        Kind::Number { at, ref range } => {
            number(setting, range, &words, &help).show_docked(ui, at(settings), form, None);
        }
        Kind::Count { at, ref range } => {
            let mut count = f64::from(*at(settings));
            if number(setting, range, &words, &help).show_docked(ui, &mut count, form, None) != Change::None {
                *at(settings) = count as u32;
            }
        }
        Kind::Choice { names, index, choose } => row(ui, &words, &help, |ui| {
            let before = index(settings);
            let mut chosen = before;
            let list = ComboBox::from_id_salt(setting.key).selected_text(names[before]);
            let response = list.show_ui(ui, |ui| {
                for (i, choice) in names.iter().enumerate() {
                    ui.selectable_value(&mut chosen, i, *choice);
                }
            });
            name(&response.response, Role::ComboBox, &words);
            if chosen != before {
                choose(settings, chosen);
            }
        }),
        Kind::Limit { .. } | Kind::Pieces { .. } | Kind::Target { .. } => {}
    }
}

/// The rows of a number of the table.
pub(super) fn number<'a>(setting: &table::Setting, range: &table::Range, name: &'a str, help: &'a str) -> Setting<'a> {
    let default = match setting.default() {
        Some(Value::Number(number)) => number,
        _ => *range.bounds.start(),
    };
    Setting {
        name,
        help,
        unit: suffix(range),
        range: range.bounds.clone(),
        default,
        auto: None,
        decimals: range.decimals,
        logarithmic: range.logarithmic,
    }
}

/// The unit of a number as it stands behind it.
pub(super) fn suffix(range: &table::Range) -> &'static str {
    match range.unit {
        "mm" => " mm",
        "%" => " %",
        unit => unit,
    }
}

/// Lets a field read what is typed with a decimal comma as with a point; `is_whole` where it holds a whole number.
pub(super) fn reads_comma(field: DragValue<'_>, is_whole: bool) -> DragValue<'_> {
    field.custom_parser(move |text| parse(text, is_whole))
}

/// The same for a count, which is written in groups.
pub(super) fn counts(field: DragValue<'_>) -> DragValue<'_> {
    reads_comma(field, true).custom_formatter(|count, _| grouped(count.round()))
}

/// How far work is: a bar of this width, on a rail that is seen on a panel.
pub(super) fn progress(ui: &mut Ui, fraction: f32, width: f32, what: &str) {
    let bar = ui.scope(|ui| {
        ui.visuals_mut().extreme_bg_color = ui.visuals().widgets.inactive.bg_fill;
        ui.add(ProgressBar::new(fraction).desired_width(width).desired_height(8.0))
    });
    name(&bar.inner, Role::ProgressIndicator, what);
}
