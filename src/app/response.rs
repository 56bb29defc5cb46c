//! What the smoothing filter does, as a sentence and as a picture: how much of a wave is left, by its length.

use std::sync::Arc;

use egui::{Align2, CollapsingHeader, Id, Label, RichText, Role, Stroke, Ui, Vec2, WidgetInfo};
use egui_plot::{
    AxisHints, GridMark, HoverPosition, Line, LineStyle, Plot, PlotPoint, PlotPoints, Points, Text, VLine,
};

use crate::pipeline::filter::Filter;
use crate::pipeline::response::{SmoothingResponse, eigenvalue, in_mm, wavelength};
use crate::pipeline::settings::Smoothing;

/// Height of the picture, in points.
const HEIGHT: f32 = 128.0;

/// What is shown of the axis of eigenvalues, as powers of ten: from half of the narrowest pass band to the roughest.
const RANGE: (f64, f64) = (-3.3, 0.301);

/// Lengths of waves that the axis names, in mm.
const LENGTHS: [f64; 12] = [1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];

/// What is known of the surface that is open.
#[derive(Clone, Copy, Default)]
pub(super) struct Scale {
    /// Root mean square of the edge lengths in mm.
    pub(super) edge_length: Option<f64>,
    /// Diameter of the thinnest vessel in mm.
    pub(super) thinnest: Option<f64>,
}

impl Scale {
    /// The eigenvalue of the wave around the thinnest vessel, and its length in mm.
    fn around_thinnest(self) -> Option<(f64, f64)> {
        let around = std::f64::consts::PI * self.thinnest?;
        Some((eigenvalue(around, self.edge_length?), around)).filter(|&(k, _)| k > 0.0)
    }
}

/// Shows what `settings` let through on a surface of that scale.
pub(super) fn show(ui: &mut Ui, settings: &Smoothing, scale: Scale) {
    if settings.iterations == 0 {
        return;
    }
    let filter = filter(ui, settings);
    let response = SmoothingResponse::new(&filter, settings.pass_band, scale.edge_length.unwrap_or(0.0));
    let text = sentence(&response, settings.adapt);
    ui.add(Label::new(RichText::new(&text).small()).wrap());
    let head = CollapsingHeader::new("Response").show_unindented(ui, |ui| {
        let plot = picture(ui, &filter, &response, scale);
        plot.widget_info(|| WidgetInfo::labeled(Role::Image, true, &text));
    });
    head.header_response.on_hover_text("How much of a wave on the surface is left, by its length");
}

/// The filter for `settings`, made once.
fn filter(ui: &Ui, settings: &Smoothing) -> Arc<Filter> {
    type Made = (Smoothing, Arc<Filter>);
    let id = Id::unique("smoothing response");
    if let Some((_, filter)) = ui.data(|data| data.get_temp::<Made>(id)).filter(|(of, _)| of == settings) {
        return filter;
    }
    let filter = Arc::new(Filter::new(settings));
    ui.data_mut(|data| data.insert_temp(id, (*settings, filter.clone())));
    filter
}

fn sentence(response: &SmoothingResponse, adapts: bool) -> String {
    match (response.half_gain_text(), response.wavelength_mm_at_half_gain) {
        (Some(text), Some(_)) if adapts => {
            format!("Half gain at {text}; shorter ones go, in thin vessels less.")
        }
        (Some(text), Some(_)) => format!("Half gain at {text}; shorter ones are smoothed away."),
        (Some(text), None) => format!("Half gain at {text}."),
        (None, _) => "Nothing is smoothed away: everything passes.".to_owned(),
    }
}

fn picture(ui: &mut Ui, filter: &Arc<Filter>, response: &SmoothingResponse, scale: Scale) -> egui::Response {
    let edge_length = scale.edge_length;
    let visuals = ui.visuals();
    let (accent, weak) = (visuals.hyperlink_color, visuals.weak_text_color());
    let ink = visuals.text_color();
    let steps = 240;
    let at = |step: i32| RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(step) / f64::from(steps);
    let curve = (0..=steps).map(|step| [at(step), filter.response(libm::exp10(at(step)))]);
    let curve = Line::new("response", curve.collect::<PlotPoints<'_>>()).stroke(Stroke::new(2.0, accent));
    let band = libm::log10(response.pass_band);
    let half = response.half_gain.map(libm::log10);
    let marks = marks(edge_length);
    let name = move |mark: GridMark| axis_label(libm::exp10(mark.value), edge_length);
    let unit = if edge_length.is_some() { "Length of a wave, mm" } else { "Eigenvalue k" };
    let small = |text: String| RichText::new(text).small();
    let font = egui::TextStyle::Small.resolve(ui.style());
    let x_axis = AxisHints::new_x()
        .label(small(unit.to_owned()))
        .formatter(move |mark, _| name(mark))
        .label_spacing(egui::Rangef::new(8.0, 12.0))
        .tick_label_color(weak)
        .tick_label_font(font.clone());
    let y_axis = AxisHints::new_y()
        .formatter(|mark, _| format!("{:.0} %", mark.value * 100.0))
        .label_spacing(egui::Rangef::new(8.0, 12.0))
        .tick_label_color(weak)
        .tick_label_font(font)
        .min_thickness(36.0);
    let plot = Plot::new("response")
        .height(HEIGHT)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .set_margin_fraction(Vec2::ZERO)
        .show_grid([false, true])
        .x_grid_spacer(move |_| marks.clone())
        .y_grid_spacer(|_| [0.0, 0.5, 1.0].map(|value| GridMark { value, step_size: 0.5 }).to_vec())
        .custom_x_axes(vec![x_axis])
        .custom_y_axes(vec![y_axis])
        .label_formatter(move |hover| hover_text(hover, edge_length));
    let shown = plot.show(ui, |plot| {
        plot.set_plot_bounds_x(RANGE.0..=RANGE.1);
        // Above the curve there is room for the name of a line.
        plot.set_plot_bounds_y(-0.12..=1.42);
        plot.vline(VLine::new("", band).color(weak).style(LineStyle::dashed_dense()).allow_hover(false));
        if let Some((k, around)) = scale.around_thinnest() {
            let at = libm::log10(k);
            plot.vline(VLine::new("", at).color(ink).style(LineStyle::dotted_loose()).allow_hover(false));
            let (side, gap) = if at > -1.6 { (Align2::RIGHT_TOP, -0.05) } else { (Align2::LEFT_TOP, 0.05) };
            let label = small(format!("thinnest: {}", in_mm(around))).color(ink);
            plot.text(Text::new("", PlotPoint::new(at + gap, 1.4), label).anchor(side).allow_hover(false));
        }
        plot.line(curve);
        let (side, gap) = if band > -2.2 { (Align2::RIGHT_BOTTOM, -0.05) } else { (Align2::LEFT_BOTTOM, 0.05) };
        let label = small("pass band".to_owned()).color(weak);
        plot.text(Text::new("", PlotPoint::new(band + gap, 0.02), label).anchor(side).allow_hover(false));
        if let Some(half) = half {
            plot.points(Points::new("", [half, 0.5]).radius(4.0).color(accent).allow_hover(false));
            let label = response.wavelength_mm_at_half_gain.map_or("half".to_owned(), in_mm);
            // To the right of the fall, above the grid's line.
            let (side, gap) = if half < -0.55 { (Align2::LEFT_BOTTOM, 0.1) } else { (Align2::RIGHT_BOTTOM, -0.1) };
            let label = small(label).color(ink);
            plot.text(Text::new("", PlotPoint::new(half + gap, 0.54), label).anchor(side).allow_hover(false));
        }
    });
    shown.response
}

/// Where the axis has its labels: at round lengths, or at powers of ten where lengths are not known.
fn marks(edge_length: Option<f64>) -> Vec<GridMark> {
    let values: Vec<f64> = match edge_length {
        Some(edge) => {
            let carried = LENGTHS.iter().filter(|&&length| length >= 2.0 * edge);
            carried.map(|&length| libm::log10(eigenvalue(length, edge))).collect()
        }
        None => vec![-3.0, -2.0, -1.0, 0.0],
    };
    let shown = values.into_iter().filter(|value| (RANGE.0..=RANGE.1).contains(value));
    shown.map(|value| GridMark { value, step_size: 0.4 }).collect()
}

fn axis_label(k: f64, edge_length: Option<f64>) -> String {
    let Some(edge) = edge_length else { return format!("{k}") };
    wavelength(k, edge).map_or(String::new(), |length| format!("{length:.0}"))
}

/// What stands beside the pointer.
fn hover_text(hover: &HoverPosition<'_>, edge_length: Option<f64>) -> Option<String> {
    let HoverPosition::NearDataPoint { position, .. } = hover else { return None };
    let k = libm::exp10(position.x);
    let waves = edge_length.and_then(|edge| wavelength(k, edge)).map_or(String::new(), |mm| format!("{}: ", in_mm(mm)));
    Some(format!("{waves}{:.0} % is left\nk = {k:.4}", position.y * 100.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_names_round_lengths_that_the_mesh_can_carry() {
        let names: Vec<String> =
            marks(Some(0.967)).iter().map(|mark| axis_label(libm::exp10(mark.value), Some(0.967))).collect();
        assert_eq!(names, ["2", "3", "5", "10", "20", "50", "100"]);
        let bare: Vec<String> = marks(None).iter().map(|mark| axis_label(libm::exp10(mark.value), None)).collect();
        assert_eq!(bare, ["0.001", "0.01", "0.1", "1"]);
    }

    #[test]
    fn the_sentence_says_what_is_smoothed_away() {
        let of = |smoothing: Smoothing, edge| {
            sentence(&SmoothingResponse::new(&Filter::new(&smoothing), smoothing.pass_band, edge), smoothing.adapt)
        };
        let text = of(Smoothing::default(), 0.967);
        assert!(text.starts_with("Half gain at k = 0.025") && text.contains("waves of 19."), "{text}");
        assert!(!of(Smoothing::default(), 0.0).contains("mm"));
        assert!(of(Smoothing { pass_band: 2.0, ..Smoothing::default() }, 1.0).contains("everything passes"));
    }
}
