//! The radius along a branch: as opened, smoothed and reduced.

use egui::{Align2, Color32, RichText, Role, Stroke, Ui, Visuals, WidgetInfo};
use egui_plot::{AxisHints, HoverPosition, LineStyle, Plot, PlotPoint, PlotPoints, Text, VLine};

use crate::app::plot_file::Drawn;
use crate::app::still_plot::{curve, marks, still, tick};
use crate::language::{decimal, tell};
use crate::say;
use crate::vessel::certificate::{BranchCalibre, OnSurface, StationStatus};

/// How the radius on each surface is drawn.
struct Strokes {
    opened: Stroke,
    smoothed: Stroke,
    reduced: Stroke,
    allowed: Stroke,
}

impl Strokes {
    fn of(visuals: &Visuals) -> Self {
        let (accent, weak, ink) = (visuals.hyperlink_color, visuals.weak_text_color(), visuals.text_color());
        Self {
            opened: Stroke::new(2.0, weak),
            smoothed: Stroke::new(1.5, ink),
            reduced: Stroke::new(2.0, accent),
            allowed: Stroke::new(1.0, weak),
        }
    }
}

/// Marks of the radius are at least so far apart, in points.
const APART: f32 = 28.0;

/// What the pointer asks for in the plot.
pub(super) enum Asked {
    /// To go to the station of this number.
    Station(usize),
    /// To have the reference at this arc length, in mm.
    Reference(f64),
}

/// Shows the radii of `branch`, beside what is allowed, and a line at the reference, which can be dragged; down to `bottom`
/// where that is not too low.
pub(super) fn show(
    ui: &mut Ui,
    branch: &BranchCalibre,
    tolerance_percent: f64,
    (reference_mm, bottom): (Option<f64>, f32),
) -> Option<Asked> {
    let strokes = Strokes::of(ui.visuals());
    let names = [say!("vessels-as-opened"), say!("vessels-smoothed"), say!("vessels-reduced")];
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        ui.label(RichText::new(say!("vessels-radius-head", name = tell(&branch.label()))).small().strong());
        for (name, stroke) in names.iter().zip([strokes.opened, strokes.smoothed, strokes.reduced]) {
            ui.label(RichText::new(name).small().color(stroke.color));
        }
        ui.label(RichText::new(say!("vessels-dotted", percent = tolerance_percent)).small().weak());
    });
    let Some((low, high)) = range(branch) else {
        ui.label(RichText::new(say!("vessels-no-section")).weak());
        return None;
    };
    let weak = ui.visuals().weak_text_color();
    let font = egui::TextStyle::Small.resolve(ui.style());
    let x_axis = AxisHints::new_x()
        .label(RichText::new(say!("vessels-along")).small())
        .label_spacing(egui::Rangef::new(24.0, 48.0))
        .formatter(tick)
        .tick_label_color(weak)
        .tick_label_font(font.clone());
    let y_axis = AxisHints::new_y()
        .label(RichText::new(say!("vessels-radius")).small())
        .label_spacing(egui::Rangef::new(8.0, 14.0))
        .formatter(tick)
        .tick_label_color(weak)
        .tick_label_font(font)
        .min_thickness(40.0);
    let height = (bottom - ui.cursor().top()).max(100.0);
    let plot = still(Plot::new(("radius", branch.number)))
        .height(height)
        .custom_x_axes(vec![x_axis])
        .custom_y_axes(vec![y_axis])
        .y_grid_spacer(move |_| marks((low, high), (height / APART) as usize))
        .label_formatter(hover_text);
    let shown = ui.scope(|ui| {
        plot.show(ui, |plot| {
            plot.set_plot_bounds_x(0.0..=branch.length_mm.max(1e-3));
            plot.set_plot_bounds_y(low..=high);
            for side in [-1.0, 1.0] {
                for piece in pieces(branch, &branch.opened, 1.0 + side * tolerance_percent / 100.0) {
                    let line = curve("allowed", piece).stroke(strokes.allowed);
                    plot.line(line.style(LineStyle::dotted_dense()).allow_hover(false));
                }
            }
            let surfaces = [
                (&branch.opened, strokes.opened),
                (&branch.smoothed, strokes.smoothed),
                (&branch.reduced, strokes.reduced),
            ];
            for (name, (of, stroke)) in names.iter().zip(surfaces) {
                for piece in pieces(branch, of, 1.0) {
                    plot.line(curve(name, piece).stroke(stroke));
                }
            }
            if let Some(change) = branch.reduced.largest_change {
                let line = VLine::new("", change.abscissa_mm).color(strokes.reduced.color);
                plot.vline(line.style(LineStyle::dashed_dense()).allow_hover(false));
            }
            if let Some(at_mm) = reference_mm {
                plot.vline(VLine::new("", at_mm).color(strokes.smoothed.color).width(1.5).allow_hover(false));
                let (side, gap) =
                    if at_mm > branch.length_mm / 2.0 { (Align2::RIGHT_TOP, -0.01) } else { (Align2::LEFT_TOP, 0.01) };
                let label = RichText::new(say!("vessels-reference-line")).small().color(strokes.smoothed.color);
                let place = PlotPoint::new(at_mm + gap * branch.length_mm, high);
                plot.text(Text::new("", place, label).anchor(side).allow_hover(false));
            }
            let (is_clicked, is_dragged) = (plot.response().clicked(), plot.response().dragged());
            let at_mm = plot.pointer_coordinate()?.x.clamp(0.0, branch.length_mm);
            match reference_mm {
                Some(_) if is_dragged => Some(Asked::Reference(at_mm)),
                _ if is_clicked => nearest(branch, at_mm).map(Asked::Station),
                _ => None,
            }
        })
    });
    let (shown, whole) = (shown.inner, shown.response.rect);
    let text = say!("vessels-radius-along", name = tell(&branch.label()));
    let colours = [strokes.opened, strokes.smoothed, strokes.reduced].map(|stroke| stroke.color);
    let legend: Vec<(&str, Color32)> = names.iter().map(String::as_str).zip(colours).collect();
    Drawn { stem: "radius", title: &text, legend: &legend, whole, frame: shown.response.rect }.offer(ui);
    shown.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &text));
    shown.inner
}

/// What is shown of the radii, in mm: all of them, and a tenth of the widest to spare.
fn range(branch: &BranchCalibre) -> Option<(f64, f64)> {
    let surfaces = [&branch.opened, &branch.smoothed, &branch.reduced];
    let all = || (0..branch.standings.len()).filter(|&i| is_vessel(branch, i));
    let radii = || surfaces.into_iter().flat_map(|of| all().filter_map(|i| of.radii_mm[i])).map(f64::from);
    let (low, high) = (radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max));
    let spare = (0.1 * high).max(1e-3);
    low.is_finite().then_some(((low - spare).max(0.0), high + spare))
}

/// Whether a branch is one vessel at station `i`.
fn is_vessel(branch: &BranchCalibre, i: usize) -> bool {
    matches!(branch.standings[i], StationStatus::Counts | StationStatus::Thin)
}

/// The radii of one surface, times `factor`: a piece for each stretch that is measured.
fn pieces(branch: &BranchCalibre, of: &OnSurface, factor: f64) -> Vec<PlotPoints<'static>> {
    let is_measured = |i: &usize| {
        matches!(branch.standings[*i], StationStatus::Counts | StationStatus::Thin) && of.radii_mm[*i].is_some()
    };
    let stations: Vec<usize> = (0..branch.abscissas_mm.len()).collect();
    let runs = stations.chunk_by(|a, b| is_measured(a) == is_measured(b)).filter(|run| is_measured(&run[0]));
    runs.map(|run| {
        let point = |&i: &usize| Some([f64::from(branch.abscissas_mm[i]), f64::from(of.radii_mm[i]?) * factor]);
        run.iter().filter_map(point).collect()
    })
    .collect()
}

/// The station nearest to a place along the branch.
pub(super) fn nearest(branch: &BranchCalibre, abscissa_mm: f64) -> Option<usize> {
    let away = |&i: &usize| (f64::from(branch.abscissas_mm[i]) - abscissa_mm).abs();
    (0..branch.abscissas_mm.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// What stands beside the pointer.
fn hover_text(hover: &HoverPosition<'_>) -> Option<String> {
    let HoverPosition::NearDataPoint { plot_name, position: PlotPoint { x, y }, .. } = hover else { return None };
    Some(say!("vessels-hover", surface = *plot_name, radius = decimal(*y, 2), at = decimal(*x, 1)))
}
