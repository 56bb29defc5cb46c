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
    decimal(mark.value, (-mark.step_size.log10() - 1e-9).ceil().max(0.0) as usize)
}

/// Marks between two values, 1, 2 or 5 of a power of ten apart, so that at most `most` of their distances fit in. Egui's are
/// a power of ten apart: often one is seen.
pub(super) fn marks((low, high): (f64, f64), most: usize) -> Vec<GridMark> {
    let least = (high - low) / most as f64;
    let power = 10.0_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0].map(|lead| lead * power).into_iter().find(|step| *step >= least).unwrap_or(10.0 * power);
    if !(step.is_finite() && step > 0.0) {
        return Vec::new();
    }
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    let values = (0..=most).map(|i| first + i as f64).take_while(|value| *value <= last);
    values.map(|value| GridMark { value: value * step, step_size: step }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_has_as_many_marks_as_it_has_room_for_with_the_decimals_that_they_need() {
        let told =
            |range, most| marks(range, most).into_iter().map(|mark| tick(mark, &(0.0..=1.0))).collect::<Vec<_>>();
        assert_eq!(told((3.7, 5.6), 4), ["4.0", "4.5", "5.0", "5.5"]);
        assert_eq!(told((3.7, 5.6), 3), ["4", "5"]);
        assert_eq!(told((0.0, 30.0), 5), ["0", "10", "20", "30"]);
        assert_eq!(told((0.0, 30.0), 3), ["0", "10", "20", "30"]);
        assert_eq!(told((0.1, 0.3), 2), ["0.1", "0.2", "0.3"]);
        assert_eq!(told((0.91, 0.98), 4), ["0.92", "0.94", "0.96", "0.98"]);
        for width in (1..400).map(|i| 1.07_f64.powi(i - 200)) {
            let count = marks((0.3 * width, 1.3 * width), 6).len();
            assert!((2..=6).contains(&count), "{count} marks in {width}");
        }
        assert!(marks((1.0, 1.0), 5).is_empty() && marks((f64::NAN, 1.0), 5).is_empty());
    }
}
