//! What the smoothing filter does, as a sentence and as a picture: how much of a wave is left, by its length.

use std::sync::Arc;

use egui::{Align2, Id, Pos2, RichText, Role, Stroke, Ui, WidgetInfo};
use egui_plot::{
    AxisHints, GridMark, HoverPosition, LineStyle, Plot, PlotPoint, PlotPoints, PlotUi, Points, Text, VLine,
};

use super::assist::heading;
use super::control::Setting;
use super::plot_file::Drawn;
use super::row::{Part, remark, wrapped};
use super::still_plot::{self, still};
use super::tie::Tie;
use crate::language::{decimal, grouped};
use crate::pipeline::filter::Filter;
use crate::pipeline::laplacian::{RELAXATION, laplacian_response};
use crate::pipeline::response::{SmoothingResponse, ThreeDigits, eigenvalue, wavelength};
use crate::pipeline::settings::{Smoothing, Window};
use crate::say;

/// Height of the picture in the panel, in points.
const HEIGHT: f32 = 128.0;

/// Lines below the picture for whoever presents.
const LINES: f32 = 4.0;

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

/// What is tried on the curve; the window keeps it.
#[derive(Clone, Copy)]
struct Tried {
    /// The eigenvalue of a wave, as a power of ten.
    log_k: f64,
    /// Whether the other windows are drawn, too.
    windows: bool,
    /// The last term of the series that is drawn as a curve of its own; `None` for the last there is.
    last_term: Option<u32>,
    /// Whether Laplacian smoothing is drawn, too.
    laplacian: bool,
}

impl Tried {
    /// What the window keeps; at first the wave of which half is left.
    fn of(ui: &Ui, response: &SmoothingResponse) -> Self {
        let log_k = response.half_gain.map_or(-1.0, libm::log10);
        let first = Self { log_k, windows: false, last_term: None, laplacian: false };
        ui.data(|data| data.get_temp(Self::id())).unwrap_or(first)
    }

    fn keep(self, ui: &Ui) {
        ui.data_mut(|data| data.insert_temp(Self::id(), self));
    }

    fn id() -> Id {
        Id::unique("tried wave")
    }
}

/// What is drawn.
struct Curves<'a> {
    filter: &'a Filter,
    /// Those of the other windows.
    others: &'a [Arc<Filter>],
    /// The sum of the series up to this term.
    last_term: Option<u32>,
    /// So many passes of Laplacian smoothing.
    passes: Option<u32>,
}

/// Shows what `settings` let through on a surface of that scale; `averaged` is whether Laplacian smoothing is shown in the
/// views, too.
pub(super) fn show(ui: &mut Ui, settings: &Smoothing, scale: Scale, averaged: &mut bool) {
    if settings.iterations == 0 {
        return;
    }
    let filter = filter(ui, settings);
    let response = SmoothingResponse::new(&filter, settings.pass_band, scale.edge_length.unwrap_or(0.0));
    let text = sentence(&response, settings.adapt);
    remark(ui, &text);
    let head = Part::Response.show(ui, say!("panel-response"), |ui| {
        let mut tried = Tried::of(ui, &response);
        let others = if tried.windows { others(ui, settings) } else { Vec::new() };
        let curves = Curves {
            filter: &filter,
            others: &others,
            last_term: tried.last_term.filter(|&last| last < settings.iterations),
            passes: tried.laplacian.then_some(settings.iterations),
        };
        picture(ui, &curves, (&response, &text), scale, &mut tried, HEIGHT);
        wave(ui, &filter, &response, scale, settings.adapt, &mut tried);
        laplacian(ui, &filter, settings, scale, &mut tried, averaged);
        terms(ui, &filter, settings.iterations, &mut tried.last_term);
        tried.keep(ui);
    });
    head.on_hover_text(say!("panel-response-help"));
}

/// Shows the curve as large as there is room, for whoever presents.
pub(super) fn present(ui: &mut Ui, settings: &Smoothing, scale: Scale) {
    let filter = filter(ui, settings);
    let response = SmoothingResponse::new(&filter, settings.pass_band, scale.edge_length.unwrap_or(0.0));
    let text = sentence(&response, settings.adapt);
    heading(ui, &say!("panel-response"));
    let mut tried = Tried::of(ui, &response);
    let curves = Curves { filter: &filter, others: &[], last_term: None, passes: None };
    let height = ui.available_height() - LINES * ui.text_style_height(&egui::TextStyle::Body);
    picture(ui, &curves, (&response, &text), scale, &mut tried, height.max(HEIGHT));
    tried.keep(ui);
    wrapped(ui, &text, |text| text);
}

/// The wave that is tried: its length, what is left of it, and of the one around the thinnest vessel.
fn wave(ui: &mut Ui, filter: &Filter, response: &SmoothingResponse, scale: Scale, adapts: bool, tried: &mut Tried) {
    let left = |k: f64| 100.0 * filter.response(k);
    let k = libm::exp10(tried.log_k);
    if let Some(edge) = scale.edge_length {
        let longest = wavelength(libm::exp10(RANGE.0), edge).unwrap_or(1000.0);
        let half = response.wavelength_mm_at_half_gain.unwrap_or(2.0 * edge);
        let mut length = wavelength(k, edge).unwrap_or(2.0 * edge);
        let setting = Setting {
            name: &say!("panel-wave"),
            help: &say!("panel-wave-help"),
            unit: " mm",
            range: 2.0 * edge..=longest,
            default: (10.0 * half).round() / 10.0,
            auto: None,
            decimals: 1,
            logarithmic: true,
        };
        if setting.show(ui, &mut length) {
            tried.log_k = libm::log10(eigenvalue(length, edge)).clamp(RANGE.0, RANGE.1);
        }
    }
    let length = scale.edge_length.and_then(|edge| wavelength(k, edge));
    let of = length.map_or_else(|| format!("k = {}", decimal(k, 4)), in_mm);
    let mut said = say!("panel-wave-left", wave = of, percent = decimal(left(k), 1));
    if let Some((k, around)) = scale.around_thinnest() {
        let (length, percent) = (in_mm(around), decimal(left(k), 1));
        said += " ";
        said += &if adapts {
            say!("panel-wave-left-thinnest-adapted", length = length, percent = percent)
        } else {
            say!("panel-wave-left-thinnest", length = length, percent = percent)
        };
    }
    remark(ui, &said);
    let all = ui.checkbox(&mut tried.windows, say!("panel-windows"));
    all.on_hover_text(say!("panel-windows-help"));
    if tried.windows {
        remark(ui, &say!("panel-windows-drawn"));
    }
}

/// What as many passes of Laplacian smoothing leave of the wave that is tried and of the thinnest vessel, beside what the
/// filter leaves.
fn laplacian(ui: &mut Ui, filter: &Filter, settings: &Smoothing, scale: Scale, tried: &mut Tried, averaged: &mut bool) {
    let chosen = ui.checkbox(&mut tried.laplacian, say!("panel-laplacian"));
    chosen.on_hover_text(say!("panel-laplacian-help"));
    if !tried.laplacian {
        // What is no longer asked about is no longer shown.
        *averaged = false;
        return;
    }
    let seen = ui.checkbox(averaged, say!("panel-laplacian-seen"));
    seen.on_hover_text(say!("panel-laplacian-seen-help"));
    let passes = settings.iterations;
    let left = 100.0 * laplacian_response(libm::exp10(tried.log_k), passes);
    let mut said = say!("panel-laplacian-left", passes = passes, factor = RELAXATION, percent = decimal(left, 1));
    if let Some((diameter, (k, _))) = scale.thinnest.zip(scale.around_thinnest()) {
        // A vessel is drawn in as the wave around it is damped.
        let kept = |gain: f64| format!("{} mm", decimal(diameter * gain.max(0.0), 2));
        let (whole, laplacian, sinc) = (kept(1.0), kept(laplacian_response(k, passes)), kept(filter.response(k)));
        said += " ";
        said += &if settings.adapt {
            say!("panel-laplacian-thinnest-adapted", whole = whole, laplacian = laplacian, sinc = sinc)
        } else {
            say!("panel-laplacian-thinnest", whole = whole, laplacian = laplacian, sinc = sinc)
        };
    }
    remark(ui, &said);
}

/// Up to which term the series is drawn, and how far that is from the whole.
fn terms(ui: &mut Ui, filter: &Filter, iterations: u32, last_term: &mut Option<u32>) {
    let setting = Setting {
        name: &say!("panel-terms"),
        help: &say!("panel-terms-help"),
        unit: "",
        range: 0.0..=f64::from(iterations),
        default: f64::from(iterations),
        auto: None,
        decimals: 0,
        logarithmic: false,
    };
    let last = last_term.unwrap_or(iterations).min(iterations);
    let mut shown = f64::from(last);
    if setting.show(ui, &mut shown) {
        let last = shown as u32;
        *last_term = (last < iterations).then_some(last);
    }
    if last < iterations {
        let off = 100.0 * filter.left_after(last as usize);
        let off = decimal(off, 1);
        remark(ui, &say!("panel-terms-drawn", last = last, iterations = iterations, percent = off));
    }
}

/// The filters of the other windows at the same settings, made once.
fn others(ui: &Ui, settings: &Smoothing) -> Vec<Arc<Filter>> {
    type Made = (Smoothing, Vec<Arc<Filter>>);
    let id = Id::unique("responses of other windows");
    if let Some((_, filters)) = ui.data(|data| data.get_temp::<Made>(id)).filter(|(of, _)| of == settings) {
        return filters;
    }
    let others = Window::ALL.into_iter().filter(|window| *window != settings.window);
    let filters: Vec<Arc<Filter>> =
        others.map(|window| Arc::new(Filter::new(&Smoothing { window, ..*settings }))).collect();
    ui.data_mut(|data| data.insert_temp(id, (*settings, filters.clone())));
    filters
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

/// A positive number to about three significant digits.
fn short(x: f64) -> String {
    decimal(x, ThreeDigits(x).places().into())
}

/// A length as [`short`] writes it, with its unit.
fn in_mm(length: f64) -> String {
    format!("{} mm", short(length))
}

fn sentence(response: &SmoothingResponse, adapts: bool) -> String {
    match (response.half_gain.map(short), response.wavelength_mm_at_half_gain.map(in_mm)) {
        (Some(k), Some(length)) if adapts => say!("panel-half-gain-adapted", k = k, length = length),
        (Some(k), Some(length)) => say!("panel-half-gain", k = k, length = length),
        (Some(k), None) => say!("panel-half-gain-bare", k = k),
        (None, _) => say!("panel-half-gain-none"),
    }
}

/// Draws the curve so high, with its sentence for assistive tools, and follows the wave that is dragged.
fn picture(
    ui: &mut Ui,
    curves: &Curves<'_>,
    (response, sentence): (&SmoothingResponse, &str),
    scale: Scale,
    tried: &mut Tried,
    height: f32,
) {
    let log_k = tried.log_k;
    let Curves { filter, others, last_term, passes } = *curves;
    let edge_length = scale.edge_length;
    let visuals = ui.visuals();
    let (accent, weak) = (visuals.hyperlink_color, visuals.weak_text_color());
    let (ink, red) = (visuals.text_color(), visuals.error_fg_color);
    let lit = Tie::lit(ui.ctx());
    // What is lit is twice as wide.
    let width = |tie: Tie, width: f32| if lit == Some(tie) { 2.0 * width } else { width };
    let steps = 240;
    let at = |step: i32| RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(step) / f64::from(steps);
    let points = |left: &dyn Fn(f64) -> f64| -> PlotPoints<'static> {
        (0..=steps).map(|step| [at(step), left(libm::exp10(at(step)))]).collect()
    };
    let curve = still_plot::curve("response", points(&|k| filter.response(k)))
        .stroke(Stroke::new(width(Tie::Response, 2.0), accent));
    let band = libm::log10(response.pass_band);
    let half = response.half_gain.map(libm::log10);
    let marks = marks(edge_length);
    let name = move |mark: GridMark| axis_label(libm::exp10(mark.value), edge_length);
    let unit = if edge_length.is_some() { say!("panel-response-length") } else { say!("panel-response-eigenvalue") };
    let small = |text: String| RichText::new(text).small();
    let font = egui::TextStyle::Small.resolve(ui.style());
    let x_axis = AxisHints::new_x()
        .label(small(unit))
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
    let plot = still(Plot::new("response"))
        .height(height)
        .show_grid([false, true])
        .x_grid_spacer(move |_| marks.clone())
        .y_grid_spacer(|_| [0.0, 0.5, 1.0].map(|value| GridMark { value, step_size: 0.5 }).to_vec())
        .custom_x_axes(vec![x_axis])
        .custom_y_axes(vec![y_axis])
        .label_formatter(move |hover| hover_text(hover, edge_length));
    let shown = ui.scope(|ui| {
        plot.show(ui, |plot| {
            plot.set_plot_bounds_x(RANGE.0..=RANGE.1);
            // Above the curve there is room for the name of a line.
            plot.set_plot_bounds_y(if last_term.is_some() { -0.3..=1.42 } else { -0.12..=1.42 });
            plot.vline(
                VLine::new("", band)
                    .color(weak)
                    .width(width(Tie::PassBand, 1.0))
                    .style(LineStyle::dashed_dense())
                    .allow_hover(false),
            );
            if let Some((k, around)) = scale.around_thinnest() {
                let at = libm::log10(k);
                plot.vline(VLine::new("", at).color(ink).style(LineStyle::dotted_loose()).allow_hover(false));
                let (side, gap) = if at > -1.6 { (Align2::RIGHT_TOP, -0.05) } else { (Align2::LEFT_TOP, 0.05) };
                let label = small(say!("panel-response-thinnest", length = in_mm(around))).color(ink);
                plot.text(Text::new("", PlotPoint::new(at + gap, 1.4), label).anchor(side).allow_hover(false));
            }
            let styles = [LineStyle::dashed_dense(), LineStyle::dotted_dense(), LineStyle::dashed_loose()];
            for (other, style) in others.iter().zip(styles) {
                let points = points(&|k| other.response(k));
                plot.line(still_plot::curve("", points).stroke(Stroke::new(1.0, ink)).style(style).allow_hover(false));
            }
            if let Some(passes) = passes {
                let points = points(&|k| laplacian_response(k, passes));
                plot.line(still_plot::curve("", points).stroke(Stroke::new(2.0, red)).allow_hover(false));
            }
            if let Some(last) = last_term {
                let points = points(&|k| filter.partial_response(last as usize, k));
                plot.line(still_plot::curve("", points).stroke(Stroke::new(1.0, ink)).allow_hover(false));
            }
            plot.line(curve);
            plot.vline(VLine::new("", log_k).color(accent).width(width(Tie::Wave, 1.0)).allow_hover(false));
            let here = [log_k, filter.response(libm::exp10(log_k))];
            plot.points(Points::new("", here).radius(5.0).filled(false).color(accent).allow_hover(false));
            let (side, gap) = if band > -2.2 { (Align2::RIGHT_BOTTOM, -0.05) } else { (Align2::LEFT_BOTTOM, 0.05) };
            let label = small(say!("panel-response-pass-band")).color(weak);
            plot.text(Text::new("", PlotPoint::new(band + gap, 0.02), label).anchor(side).allow_hover(false));
            if let Some(half) = half {
                plot.points(Points::new("", [half, 0.5]).radius(4.0).color(accent).allow_hover(false));
                let label = response.wavelength_mm_at_half_gain.map_or_else(|| say!("panel-response-half"), in_mm);
                // To the right of the fall, above the grid's line.
                let (side, gap) = if half < -0.55 { (Align2::LEFT_BOTTOM, 0.1) } else { (Align2::RIGHT_BOTTOM, -0.1) };
                let label = small(label).color(ink);
                plot.text(Text::new("", PlotPoint::new(half + gap, 0.54), label).anchor(side).allow_hover(false));
            }
            let moves = plot.response().dragged() || plot.response().clicked();
            if let Some(at) = plot.response().hover_pos()
                && let Some(tie) = pointed(plot, at, (band, log_k), filter)
            {
                tie.light(&plot.response().ctx);
            }
            plot.pointer_coordinate().filter(|_| moves).map(|place| place.x.clamp(RANGE.0, RANGE.1))
        })
    });
    let (shown, whole) = (shown.inner, shown.response.rect);
    let title = say!("panel-response");
    Drawn { stem: "response", title: &title, legend: &[], whole, frame: shown.response.rect }.offer(ui);
    shown.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, sentence));
    tried.log_k = shown.inner.unwrap_or(log_k);
}

/// What of the plot the pointer is at: one of the two lines, or the curve.
fn pointed(plot: &PlotUi<'_>, at: Pos2, (band, log_k): (f64, f64), filter: &Filter) -> Option<Tie> {
    const NEAR: f32 = 6.0;
    let place = |x: f64, y: f64| plot.screen_from_plot(PlotPoint::new(x, y));
    let [band, tried] = [band, log_k].map(|x| (place(x, 0.0).x - at.x).abs());
    let k = libm::exp10(plot.plot_from_screen(at).x);
    let curve = (place(libm::log10(k), filter.response(k)).y - at.y).abs();
    let nearest = [(Tie::PassBand, band), (Tie::Wave, tried), (Tie::Response, curve)];
    let nearest = nearest.into_iter().filter(|(_, away)| *away < NEAR);
    nearest.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(tie, _)| tie)
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
    let Some(edge) = edge_length else { return grouped(k) };
    wavelength(k, edge).map_or(String::new(), |length| format!("{length:.0}"))
}

/// What stands beside the pointer.
fn hover_text(hover: &HoverPosition<'_>, edge_length: Option<f64>) -> Option<String> {
    let HoverPosition::NearDataPoint { position, .. } = hover else { return None };
    let k = libm::exp10(position.x);
    let (percent, eigenvalue) = (decimal(position.y * 100.0, 0), decimal(k, 4));
    Some(match edge_length.and_then(|edge| wavelength(k, edge)) {
        Some(mm) => say!("panel-response-at", length = in_mm(mm), percent = percent, k = eigenvalue),
        None => say!("panel-response-at-bare", percent = percent, k = eigenvalue),
    })
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
    fn what_is_left_of_a_wave_is_the_chebyshev_sum() {
        // f(k) = sum c_n T_n(1 - k/2), with T_n(cos t) = cos(n t).
        for window in Window::ALL {
            let filter = Filter::new(&Smoothing { window, ..Smoothing::PAPER });
            for wave in [3.0, 12.0, 30.0, 200.0] {
                let k = eigenvalue(wave, 0.967);
                let angle = (1.0 - k / 2.0).acos();
                let sum: f64 = (0..).zip(&filter.coefficients).map(|(n, c)| c * (f64::from(n) * angle).cos()).sum();
                assert!((filter.response(k) - sum).abs() < 1e-9, "{window:?}, {wave} mm: {sum}");
            }
            // What is long beside the pass band stays, what is short goes.
            assert!((filter.response(eigenvalue(200.0, 0.967)) - 1.0).abs() < 0.01);
            assert!(filter.response(eigenvalue(3.0, 0.967)).abs() < 0.01);
        }
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
