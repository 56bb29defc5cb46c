//! How often which value occurs, and where the threshold is.

use egui::{Rect, Role, Sense, Stroke, Ui, pos2, vec2};

use crate::app::assist::describe;
use crate::say;
use crate::volume::Survey;

/// Height of the picture in points.
const HEIGHT: f32 = 56.0;

/// Shows the histogram, its bars by the logarithm of how many values there are: air would hide the vessels otherwise.
pub(super) fn show(ui: &mut Ui, survey: &Survey, threshold: f64) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    describe(&response, Role::Image, &say!("scan-histogram"), threshold);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
    let most = survey.histogram.iter().max().map_or(1.0, |&most| libm::log1p(most as f64)).max(1e-9);
    let width = rect.width() / survey.histogram.len().max(1) as f32;
    let [low, high] = survey.range;
    let at = |value: f64| rect.left() + ((value - low) / (high - low).max(f64::MIN_POSITIVE)) as f32 * rect.width();
    let (inside, outside) = (ui.visuals().hyperlink_color, ui.visuals().weak_text_color());
    for (bin, &count) in survey.histogram.iter().enumerate() {
        let height = (libm::log1p(count as f64) / most) as f32 * (rect.height() - 2.0);
        let left = rect.left() + bin as f32 * width;
        let bar = Rect::from_min_max(pos2(left, rect.bottom() - height), pos2(left + width, rect.bottom()));
        painter.rect_filled(bar, 0.0, if left >= at(threshold) { inside } else { outside });
    }
    painter.vline(at(threshold), rect.y_range(), Stroke::new(1.0, ui.visuals().text_color()));
}
