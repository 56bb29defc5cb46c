//! The deviation as it is shown: from which surface, signed or not, up to how much; the samples that it rests on as a
//! histogram beside its legend, and a pin where it is largest.

use std::borrow::Cow;

use egui::{Align2, Color32, FontId, Rect, Role, Sense, Ui, Vec2, pos2, vec2};

use super::action::Action;
use super::assist::name;
use super::deviating::{Deviating, UpTo};
use super::document::Document;
use super::explain::explain;
use super::halo;
use super::overlay::{self, Legend};
use super::places::seen;
use super::theme;
use crate::language::decimal;
use crate::mesh::{Vec3, used_vertices};
use crate::pipeline::deviation::Deviation;
use crate::pipeline::histogram::Histogram;
use crate::render::{Camera, ColourMap};
use crate::say;

impl Document {
    /// The numbers of the deviation that is shown.
    fn deviation_of(&self, shown: Deviating) -> Option<Deviation> {
        let report = &self.measured.as_ref()?.report;
        if shown.from_opened { report.deviation_from_original_mm } else { report.deviation_mm }
    }

    /// For each node of the level that is shown, its deviation in mm, if it is known.
    pub(super) fn deviation_scalars(&self, shown: Deviating) -> Option<Cow<'_, [f32]>> {
        let kind = match shown {
            Deviating { from_opened: false, is_signed: false, .. } => {
                return self.deviation_by_node().map(Cow::Borrowed);
            }
            Deviating { from_opened: false, is_signed: true, .. } => 0,
            Deviating { from_opened: true, is_signed: false, .. } => 1,
            Deviating { from_opened: true, is_signed: true, .. } => 2,
        };
        let (levels, level) = (&self.levels.as_ref()?.1, self.shown.as_ref()?);
        let deviated = self.deviated_shown().filter(|deviated| deviated.values.len() == 3 * level.vertices)?;
        let values = deviated.values.chunks_exact(level.vertices.max(1)).nth(kind)?;
        let mut by_node = vec![0.0; levels.positions.len()];
        for (node, &value) in used_vertices(levels.positions.len(), &level.level.triangles).into_iter().zip(values) {
            by_node[node as usize] = value;
        }
        Some(Cow::Owned(by_node))
    }

    /// The colours of the deviation that is shown.
    pub(super) fn deviation_map(&self, shown: Deviating) -> Option<ColourMap> {
        let most = shown.up_to.mm(&self.deviation_of(shown)?);
        Some(ColourMap { range: (if shown.is_signed { -most } else { 0.0 }, most) })
    }

    /// How the samples of the deviation that is shown are spread.
    fn deviation_histogram(&self, shown: Deviating) -> Option<&Histogram> {
        Some(&self.deviated_shown()?.histograms[usize::from(shown.from_opened)])
    }
}

/// What there is to choose.
pub(super) fn choices(ui: &mut Ui, shown: &mut Deviating) {
    ui.indent("deviation", |ui| {
        let from_opened = ui.checkbox(&mut shown.from_opened, say!("panel-from-opened"));
        from_opened.on_hover_text(say!("panel-from-opened-help"));
        let signed = ui.checkbox(&mut shown.is_signed, say!("panel-signed"));
        signed.on_hover_text(say!("panel-signed-help"));
        ui.horizontal(|ui| {
            explain(ui.label(say!("panel-up-to")), &say!("panel-up-to-help"));
            for up_to in UpTo::ALL {
                let value = up_to.label();
                let label = ui.selectable_value(&mut shown.up_to, up_to, &value);
                let label = label.on_hover_text(say!("panel-up-to-percentile"));
                name(&label, Role::RadioButton, &say!("panel-up-to-value", value = value));
            }
        });
    });
}

/// What the colours say.
pub(super) fn legend(map: ColourMap, shown: Deviating) -> Legend {
    let title = if shown.from_opened { say!("panel-legend-opened") } else { say!("panel-legend-smoothed") };
    let note = if shown.is_signed { say!("panel-legend-sides") } else { String::new() };
    let (is_signed, has_histogram) = (shown.is_signed, true);
    Legend {
        map,
        title,
        unit: "mm",
        decimals: 3,
        is_open: true,
        is_open_below: is_signed,
        note,
        patch: None,
        is_diverging: is_signed,
        has_histogram,
    }
}

/// Draws the histogram to the left of the legend's bar, as high as it, and writes what part lies beyond it.
pub(super) fn histogram(ui: &Ui, rect: Rect, document: &Document, shown: Deviating, map: ColourMap) {
    const BINS: usize = 32;
    const WIDTH: f32 = 44.0;
    let Some(histogram) = document.deviation_histogram(shown) else { return };
    let bar = overlay::colour_bar_in(rect);
    let (low, high) = (f64::from(map.range.0), f64::from(map.range.1));
    let at = |i: usize| low + (high - low) * i as f64 / BINS as f64;
    let part = |i: usize| {
        let (from, to) = (at(i), at(i + 1));
        let other = if shown.is_signed { 0.0 } else { histogram.part_between(-to, -from) };
        histogram.part_between(from, to) + other
    };
    let parts: Vec<f64> = (0..BINS).map(part).collect();
    let most = parts.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let (painter, colour) = (ui.painter_at(rect), ui.visuals().text_color());
    let right = bar.left() - 4.0;
    for (i, part) in parts.iter().enumerate() {
        let height = bar.height() / BINS as f32;
        let bottom = bar.bottom() - height * i as f32;
        let width = WIDTH * (part / most) as f32;
        let row = Rect::from_min_max(pos2(right - width, bottom - height), pos2(right, bottom - 0.5));
        painter.rect_filled(row, 0.0, colour.gamma_multiply(0.55));
    }
    let over = histogram.percent_over(high);
    let text = say!("panel-beyond", percent = decimal(over, 1), deviation = decimal(high, 3));
    let below = if shown.is_signed { 30.0 } else { 16.0 };
    halo::text(
        &painter,
        bar.right_bottom() + vec2(0.0, below),
        Align2::RIGHT_TOP,
        &text,
        FontId::proportional(12.0),
        colour,
    );
}

/// Shows a pin where the deviation is largest; a click goes there.
pub(super) fn pin(ui: &Ui, rect: Rect, camera: &Camera, document: &Document, shown: Deviating) -> Option<Action> {
    let deviation = document.deviation_of(shown).filter(|deviation| deviation.max > 0.0)?;
    // The point of the level.
    let place: Vec3 = deviation.max_at_mm[1].into();
    let foot = seen(place, camera, rect)?;
    if !rect.shrink(4.0).contains(foot) {
        return None;
    }
    let head = foot - vec2(0.0, 22.0);
    let response = ui.interact(
        Rect::from_center_size(head, Vec2::splat(theme::row(ui.ctx(), 32.0))),
        ui.scope_id().with("largest deviation"),
        Sense::click(),
    );
    let label = say!("panel-largest-deviation", deviation = decimal(deviation.max, 3));
    name(&response, Role::Button, &label);
    let response = response.on_hover_text(say!("panel-largest-deviation-go", place = &label));
    let (painter, accent) = (ui.painter_at(rect), ui.visuals().hyperlink_color);
    let ring = egui::Stroke::new(if response.hovered() || response.has_focus() { 3.0 } else { 2.0 }, accent);
    painter.line_segment([foot, head], ring);
    painter.circle(head, 8.0, Color32::from_black_alpha(0), ring);
    painter.circle_filled(head, 5.0, accent);
    let height_mm = (200.0 * deviation.max as f32).clamp(8.0, 40.0);
    response.clicked().then(|| Action::GoTo { at_mm: place.into(), height_mm, label })
}
