//! Error against triangles, as a plot below the reduction: the whole curve of the surface that is open, with the level that
//! is shown, what was measured of it and how far is safe. A click goes to a rate.

use std::sync::Arc;

use egui::{Align2, Color32, Id, RichText, Role, Stroke, Ui, WidgetInfo};
use egui_plot::{AxisHints, GridMark, HoverPosition, LineStyle, Plot, PlotPoint, PlotPoints, Points, Text, VLine};

use super::plot_file::Drawn;
use super::row::{Part, remark};
use super::state::State;
use super::still_plot::{curve, still, tick};
use crate::language::decimal;
use crate::pipeline::error_curve::CurvePoint;
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::{Decimation, Method, Settings, Target, reduction_percent};
use crate::say;

/// Height of the picture, in points.
const HEIGHT: f32 = 150.0;
/// Levels on a curve.
const POINTS: usize = 200;
/// The curve is shown up to what this rate costs, or the level that is shown, if that costs more.
const SHOWN_PERCENT: f64 = 98.0;
/// Over more powers of ten than this there is no room for labels between them.
const DECADES: f64 = 2.5;

/// A curve that was shown, with the method and the rest that it is of.
#[derive(Clone)]
struct Kept {
    levels: u64,
    method: Method,
    surface: (u64, u64, Settings),
    curve: Arc<Vec<CurvePoint>>,
}

/// Shows the section, folded at first; a click sets `target`.
pub(super) fn section(ui: &mut Ui, state: &State, target: &mut Target) {
    let head = Part::Error.show(ui, say!("panel-error"), |ui| {
        if let Some(wanted) = plot(ui, state) {
            *target = wanted;
        }
    });
    head.on_hover_text(say!("panel-error-help"));
}

/// What a method's error is.
fn measure(method: Method) -> String {
    match method {
        Method::Schroeder => say!("panel-error-schroeder"),
        Method::Quadric => say!("panel-error-quadric"),
    }
}

fn plot(ui: &mut Ui, state: &State) -> Option<Target> {
    let document = state.document.as_ref()?;
    let (levels, shown) = (&document.levels.as_ref()?.1, document.shown.as_ref()?);
    let curves = curves(ui, state)?;
    let (own, others) = curves.split_first()?;
    let (entering, now) = (levels.triangles.len(), shown.level.triangles.len());
    let now_mm = f64::from(levels.error_after(shown.level.steps));
    let measured = document.measured.as_ref().filter(|_| state.has_level()).and_then(|it| it.report.deviation_mm);
    let visuals = ui.visuals();
    let (accent, weak, ink) = (visuals.hyperlink_color, visuals.weak_text_color(), visuals.text_color());
    let small = |text: &str| RichText::new(text).small();
    let font = egui::TextStyle::Small.resolve(ui.style());
    let x_axis = AxisHints::new_x()
        .label(small(&say!("panel-triangles")))
        .formatter(|mark, _| short(libm::exp10(mark.value)))
        .label_spacing(egui::Rangef::new(20.0, 32.0))
        .tick_label_color(weak)
        .tick_label_font(font.clone());
    let y_axis = AxisHints::new_y()
        .label(small(&say!("panel-error-mm")))
        .formatter(tick)
        .label_spacing(egui::Rangef::new(16.0, 32.0))
        .tick_label_color(weak)
        .tick_label_font(font)
        .min_thickness(36.0);
    let log = |triangles: usize| libm::log10(triangles.max(1) as f64);
    let at_shown = own.curve.iter().rev().find(|point| reduction_percent(entering, point.triangles) <= SHOWN_PERCENT);
    let highest = [at_shown.map_or(0.0, |point| f64::from(point.error_mm)), now_mm, measured.map_or(0.0, |it| it.max)];
    let highest = 1.15 * highest.into_iter().fold(1e-3, f64::max);
    let coarsest = own.curve.last().map_or(0, |point| point.triangles);
    let picture = still(Plot::new("error against triangles"))
        .height(HEIGHT)
        .x_grid_spacer(|input| marks(input.bounds))
        .custom_x_axes(vec![x_axis])
        .custom_y_axes(vec![y_axis])
        .label_formatter(hover_text);
    let shown = ui.scope(|ui| {
        picture.show(ui, |plot| {
            plot.set_plot_bounds_x(log(coarsest)..=log(entering) + 0.02);
            plot.set_plot_bounds_y(0.0..=highest);
            for (kept, is_own) in std::iter::once((own, true)).chain(others.iter().map(|kept| (kept, false))) {
                let points = kept.curve.iter().map(|point| [log(point.triangles), f64::from(point.error_mm)]);
                let stroke = Stroke::new(2.0, if is_own { accent } else { weak });
                plot.line(curve(kept.method.name(), points.collect::<PlotPoints<'_>>()).stroke(stroke));
            }
            let (safe, is_covered) =
                (state.safe().and_then(|safe| safe.triangles), state.safe().is_some_and(Safe::is_covered));
            let safe_name = if is_covered { say!("panel-error-safe") } else { say!("panel-error-kept") };
            for (triangles, name, style, height) in [
                (Some(now), say!("panel-error-now"), LineStyle::dashed_dense(), 0.98),
                (safe, safe_name, LineStyle::dotted_loose(), 0.86),
            ] {
                let Some(at) = triangles.map(log) else { continue };
                plot.vline(VLine::new("", at).color(ink).style(style).allow_hover(false));
                let label = Text::new("", PlotPoint::new(at + 0.03, height * highest), small(&name).color(ink));
                plot.text(label.anchor(Align2::LEFT_TOP).allow_hover(false));
            }
            if let Some(found) = measured {
                for (name, mm) in [(say!("panel-deviation-mean"), found.mean), (say!("panel-deviation-max"), found.max)]
                {
                    plot.points(Points::new(name, [log(now), mm]).radius(4.0).color(ink));
                }
            }
            plot.pointer_coordinate().filter(|_| plot.response().clicked())
        })
    });
    let (picture, whole) = (shown.inner, shown.response.rect);
    let colours = std::iter::once(accent).chain(std::iter::repeat(weak));
    let legend: Vec<(&str, Color32)> = curves.iter().map(|kept| kept.method.name()).zip(colours).collect();
    let title = say!("panel-error");
    Drawn { stem: "error", title: &title, legend: &legend, whole, frame: picture.response.rect }.offer(ui);
    let text = say!("panel-error-is", error = decimal(now_mm, 3), count = now);
    picture.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &text));
    remark(ui, &format!("{text}. {}", measure(own.method)));
    let other = Method::ALL.into_iter().find(|method| *method != own.method)?;
    remark(
        ui,
        &match others.first() {
            Some(kept) => say!("panel-error-other", method = kept.method.name()),
            None => say!("panel-error-other-none", method = other.name()),
        },
    );
    // A rate: the same place on another surface.
    let wanted = libm::exp10(picture.inner?.x);
    let per_mille = (1000.0 * (1.0 - wanted / entering.max(1) as f64)).round().max(0.0) as u32;
    Some(Target::Reduction(per_mille.min(Target::MAX_PER_MILLE)))
}

/// The curve of the levels that are shown, and that of the other method, if it was shown for the same surface.
fn curves(ui: &Ui, state: &State) -> Option<Vec<Kept>> {
    let id = Id::unique("error curves");
    let document = state.document.as_ref()?;
    let levels = &document.levels.as_ref()?.1;
    let mut kept = ui.data(|data| data.get_temp::<Vec<Kept>>(id)).unwrap_or_default();
    let revision = document.revision;
    // All that makes the surface which is reduced, and nothing of how.
    let settings = document.measured.as_ref().map(|measured| &measured.report.settings).filter(|_| state.has_level());
    let settings = settings.cloned().unwrap_or_else(|| state.settings.clone());
    let Settings { decimation, .. } = settings;
    let surface = Settings {
        decimation: Decimation { method: Method::default(), ..decimation },
        target: Target::default(),
        tolerance_percent: 0.0,
        ..settings
    };
    let surface = (revision.document, revision.opened, surface);
    let is_known = kept.iter().any(|kept| kept.levels == revision.levels && kept.surface.0 == revision.document);
    if !is_known {
        if !state.has_level() {
            // Whose they are is not known yet.
            return None;
        }
        let curve = Arc::new(levels.error_curve(POINTS));
        kept.retain(|kept| kept.surface == surface && kept.method != decimation.method);
        kept.insert(0, Kept { levels: revision.levels, method: decimation.method, surface, curve });
        ui.data_mut(|data| data.insert_temp(id, kept.clone()));
    }
    Some(kept)
}

/// Where the axis of triangles has its labels: powers of ten, and where these are few 2 and 5 times them.
fn marks((low, high): (f64, f64)) -> Vec<GridMark> {
    let (leads, step_size): (&[f64], _) = if high - low > DECADES { (&[1.0], 1.0) } else { (&[1.0, 2.0, 5.0], 0.3) };
    let powers = (0..8).flat_map(|power| leads.iter().map(move |&lead| libm::log10(lead) + f64::from(power)));
    let shown = powers.filter(|value| (low..=high).contains(value));
    shown.map(|value| GridMark { value, step_size }).collect()
}

/// A round number in few letters: 20k.
fn short(number: f64) -> String {
    let number = number.round();
    if number >= 1e6 {
        format!("{}M", number / 1e6)
    } else if number >= 1e3 {
        format!("{}k", number / 1e3)
    } else {
        format!("{number}")
    }
}

/// What stands beside the pointer.
fn hover_text(hover: &HoverPosition<'_>) -> Option<String> {
    let HoverPosition::NearDataPoint { plot_name, position: PlotPoint { x, y }, .. } = hover else { return None };
    let (error, count) = (decimal(*y, 3), libm::exp10(*x).round());
    Some(say!("panel-error-at", curve = *plot_name, error = error, count = count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_names_round_numbers_of_triangles() {
        let names: Vec<String> = marks((2.2, 4.4)).iter().map(|mark| short(libm::exp10(mark.value))).collect();
        assert_eq!(names, ["200", "500", "1k", "2k", "5k", "10k", "20k"]);
        let names: Vec<String> = marks((1.7, 5.6)).iter().map(|mark| short(libm::exp10(mark.value))).collect();
        assert_eq!(names, ["100", "1k", "10k", "100k"]);
        assert_eq!(short(5e6), "5M");
    }
}
