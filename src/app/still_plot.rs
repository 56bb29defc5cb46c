//! A plot that stands still: it shows all that it has, and leaves drag, scroll and zoom to what it is in; and the marks of its axes.

use std::ops::RangeInclusive;

use egui::Vec2;
use egui_plot::{GridMark, Line, Plot, PlotPoints};

use crate::language::decimal;

/// The plot, without what moves it and without margins.
pub(super) fn still(plot: Plot<'_>) -> Plot<'_> {
    plot.allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .set_margin_fraction(Vec2::ZERO)
}

/// A curve, through each of its points at any size.
pub(super) fn curve<'a>(name: impl Into<String>, points: impl Into<PlotPoints<'a>>) -> Line<'a> {
    Line::new(name, points).allow_band(false)
}

/// A mark of an axis, with as many decimals as the step to the next has.
pub(super) fn tick(mark: GridMark, _: &RangeInclusive<f64>) -> String {
    decimal(mark.value, -mark.step_size.log10().round() as usize)
}
