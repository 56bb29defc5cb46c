//! What is written over a view: its title, the surface's name, a scale bar, which way is up, a legend, a ring around a
//! pinched vessel, and that it is not for clinical decisions.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, Ui, pos2, vec2};

use super::places::seen;
use super::{arrays, halo, labels, theme};
use crate::io::Axes;
use crate::language::{Key, decimal, grouped};
use crate::mesh::{ArrayInfo, Vec3};
use crate::render::{Camera, Colour, ColourMap, diverging, viridis};
use crate::say;

/// What to write.
pub(super) struct Writing<'a> {
    /// What the view shows.
    pub title: &'a str,
    /// The surface's name.
    pub name: Option<&'a str>,
    /// From where the view looks.
    pub camera: &'a Camera,
    /// Which way the patient lies, as far as that is known.
    pub axes: Axes,
    /// The colours in use.
    pub legend: Option<Legend>,
    /// The array that has the colours.
    pub array: Option<&'a ArrayInfo>,
    /// Whether it is a picture of its own, with no bar below it.
    pub is_alone: bool,
}

/// What colours mean.
#[derive(Clone, Debug)]
pub(super) struct Legend {
    /// The colour map; its range is in `unit`.
    pub map: ColourMap,
    /// What has these colours.
    pub title: String,
    /// The unit.
    pub unit: &'static str,
    /// Digits after the point.
    pub decimals: usize,
    /// Whether the last colour is that of larger values too.
    pub is_open: bool,
    /// Whether the first colour is that of smaller values too.
    pub is_open_below: bool,
    /// What is said below the colours.
    pub note: String,
    /// The colour of what the note says, a patch below the colours; `None` where it says something else.
    pub patch: Option<Colour>,
    /// Whether they go both ways from white.
    pub is_diverging: bool,
    /// Whether a histogram stands where the numbers at the ends do otherwise: they are above and below the colours.
    pub has_histogram: bool,
}

const MARGIN: f32 = 12.0;

/// Below these heights what a view says does not fit one below the other, without colours and with them, in points.
const LOW: f32 = 120.0;
const LOW_COLOURED: f32 = 280.0;

/// Below this height there is room for a title alone, and that it is not for clinical decisions, in points.
const LOWEST: f32 = 72.0;

/// Colours, and labels, are told where a bar would be at least this high, in points.
const LEAST_BAR: f32 = 32.0;

/// Says that it is not for clinical decisions, once in a window: in the bar below, or over a view where that has no room.
pub(super) const NOT_CLINICAL: Key = Key("about-not-clinical");

/// Writes over the view in `rect`.
pub(super) fn show(ui: &Ui, rect: Rect, writing: &Writing<'_>) {
    let painter = ui.painter_at(rect);
    let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    let inner = rect.shrink(MARGIN);
    let title =
        halo::text(&painter, inner.left_top(), Align2::LEFT_TOP, writing.title, FontId::proportional(14.0), text);
    labels::stands(ui.ctx(), title);
    let small = FontId::proportional(12.0);
    let is_coloured = writing.legend.is_some() || writing.array.is_some();
    let tells_colours = is_coloured && bar_in(inner).height() >= LEAST_BAR;
    if let Some(name) = writing.name.filter(|_| inner.height() >= LOWEST) {
        let galley = painter.layout(name.to_owned(), small.clone(), weak, inner.width() * 0.6);
        labels::stands(ui.ctx(), Rect::from_min_size(inner.left_top() + vec2(0.0, 20.0), galley.size()));
        halo::galley(&painter, inner.left_top() + vec2(0.0, 20.0), galley, weak);
        scale_bar(&painter, inner, rect.height(), writing.camera, text);
        // Legends stand at the right, and in a low view there is room for one of the two.
        if has_axes(inner, tells_colours) {
            orientation(&painter, inner, writing.camera, writing.axes, text);
        }
    }
    if writing.is_alone || theme::is_narrow(ui.ctx()) {
        let (place, align) = if inner.height() >= LOW {
            (inner.right_bottom(), Align2::RIGHT_BOTTOM)
        } else if inner.height() >= LOWEST {
            (inner.left_bottom() - vec2(0.0, 24.0), Align2::LEFT_BOTTOM)
        } else {
            (inner.left_top() + vec2(0.0, 20.0), Align2::LEFT_TOP)
        };
        let place = halo::text(&painter, place, align, &NOT_CLINICAL.say(), small, weak);
        labels::stands(ui.ctx(), place);
    }
    if !tells_colours {
        return;
    }
    if let Some(colours) = &writing.legend {
        legend(&painter, inner, colours, text);
    }
    match writing.array {
        Some(array) if array.labels.is_empty() => {
            let bar = colour_bar(&painter, inner, false);
            ends(&painter, bar, arrays::ends(array), &array.name, text, false);
        }
        Some(array) => arrays::label_legend(&painter, inner, array, text),
        None => {}
    }
}

/// Whether a view has room for the axes.
fn has_axes(inner: Rect, is_coloured: bool) -> bool {
    inner.height() >= if is_coloured { LOW_COLOURED } else { LOW }
}

/// Draws a scale bar and the axes over a picture, and nothing else.
pub(super) fn scale_and_axes(ui: &Ui, rect: Rect, camera: &Camera, axes: Axes) {
    let (painter, inner, text) = (ui.painter_at(rect), rect.shrink(MARGIN), ui.visuals().text_color());
    scale_bar(&painter, inner, rect.height(), camera, text);
    orientation(&painter, inner, camera, axes, text);
}

/// A ring around a place, and what there is to say of it.
pub(super) fn ring(ui: &Ui, rect: Rect, camera: &Camera, at: Vec3, label: &str, colour: Color32) {
    if let Some(at) = seen(at, camera, rect) {
        ring_at(ui, rect, at, label, colour);
    }
}

/// A line through places.
pub(super) fn path(ui: &Ui, rect: Rect, camera: &Camera, places: &[Vec3], colour: Color32) {
    let seen: Vec<Pos2> = places.iter().filter_map(|at| seen(*at, camera, rect)).collect();
    let lines: Vec<[Pos2; 2]> = seen.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    halo::lines(&ui.painter_at(rect), &lines, Stroke::new(2.0, colour));
}

/// The same around a point of the window; none where it is not in `rect`.
pub(super) fn ring_at(ui: &Ui, rect: Rect, middle: Pos2, label: &str, colour: Color32) {
    const RADIUS: f32 = 14.0;
    if !rect.contains(middle) {
        return;
    }
    let painter = ui.painter_at(rect);
    painter.circle_stroke(middle, RADIUS, Stroke::new(2.0, colour));
    // On a plate: below it the surface may have any colour.
    let text = painter.layout_no_wrap(label.to_owned(), FontId::proportional(12.0), colour);
    let places = labels::around(middle, text.size(), RADIUS + 8.0, rect);
    let place = labels::free(ui, rect, places).unwrap_or_else(|| {
        // Above or below the ring, on whatever stands there; what is too wide is read from its beginning.
        let inside = rect.shrink2(vec2(8.0, 5.0));
        let down = if middle.y < rect.center().y { 1.0 } else { -1.0 };
        let place = Align2::CENTER_CENTER.anchor_size(middle + vec2(0.0, down * (RADIUS + 14.0)), text.size());
        Rect::from_min_size((inside.max - place.size()).min(place.min).max(inside.min), place.size())
    });
    painter.rect_filled(place.expand2(vec2(6.0, 3.0)), 4.0, ui.visuals().window_fill.gamma_multiply(0.9));
    halo::galley(&painter, place.min, text, colour);
}

/// A bar of a round number of millimetres, about a fifth of the view long.
fn scale_bar(painter: &Painter, inner: Rect, height: f32, camera: &Camera, colour: Color32) {
    let mm_per_point = camera.mm_per_pixel(height.max(1.0));
    let mm = round_length(mm_per_point * inner.width() / 5.0);
    let length = mm / mm_per_point;
    let (left, y) = (inner.left(), inner.bottom() - 4.0);
    let stroke = Stroke::new(1.5, colour);
    let ends = [left, left + length];
    let [first, last] = ends.map(|x| [pos2(x, y - 4.0), pos2(x, y + 4.0)]);
    halo::lines(painter, &[ends.map(|x| pos2(x, y)), first, last], stroke);
    labels::stands(painter.ctx(), Rect::from_min_max(pos2(left, y - 22.0), pos2(left + length.max(40.0), y + 4.0)));
    let label = format!("{} mm", grouped(mm));
    // A label that is longer than its bar begins where the bar does.
    let text = painter.layout_no_wrap(label, FontId::proportional(12.0), colour);
    let at = pos2(left + ((length - text.size().x) / 2.0).max(0.0), y - 6.0 - text.size().y);
    halo::galley(painter, at, text, colour);
}

/// The largest of 1, 2, 5, 10, 20, ... that is not above `mm`.
fn round_length(mm: f32) -> f32 {
    if !(mm.is_finite() && mm > 0.0) {
        return 1.0;
    }
    let power = mm.log10().floor() as i32;
    let lead = mm / 10f32.powi(power);
    let step = if lead >= 5.0 {
        5.0
    } else if lead >= 2.0 {
        2.0
    } else {
        1.0
    };
    // 5 / 100 is written as 0.05, and 5 * 0.01 as 0.049999997.
    if power < 0 { step / 10f32.powi(-power) } else { step * 10f32.powi(power) }
}

/// The axes, turned as the view is: the patient's sides where they are known, else X, Y and Z.
fn orientation(painter: &Painter, inner: Rect, camera: &Camera, axes: Axes, colour: Color32) {
    const SIZE: f32 = 24.0;
    let middle = pos2(inner.right() - SIZE - 8.0, inner.top() + SIZE + 8.0);
    let is_unknown = axes == Axes::Unknown;
    labels::stands(painter.ctx(), Rect::from_center_size(middle, vec2(2.0, 2.0) * (SIZE + 12.0)));
    let mut axes: Vec<_> = camera.axes().into_iter().zip(axes.letters()).collect();
    axes.sort_by(|(a, _), (b, _)| a.z.total_cmp(&b.z));
    for (axis, letter) in axes {
        let end = middle + vec2(axis.x, -axis.y) * SIZE;
        let strength = 0.55 + 0.45 * (axis.z + 1.0) / 2.0;
        halo::lines(painter, &[[middle, end]], Stroke::new(1.5, colour.gamma_multiply(strength)));
        if axis.truncate().length() < 0.35 {
            continue;
        }
        let at: Pos2 = middle + vec2(axis.x, -axis.y) * (SIZE + 8.0);
        halo::text(painter, at, Align2::CENTER_CENTER, letter, FontId::proportional(11.0), colour);
    }
    if is_unknown {
        let below = middle + vec2(SIZE + 8.0, SIZE + 20.0);
        halo::text(
            painter,
            below,
            Align2::RIGHT_CENTER,
            &say!("views-axes-unknown"),
            FontId::proportional(11.0),
            colour,
        );
    }
}

/// Where the colours stand in the view in `rect`.
pub(super) fn colour_bar_in(rect: Rect) -> Rect {
    bar_in(rect.shrink(MARGIN))
}

/// In the middle, as far as the axes above and what is written below leave room; in a low view without axes, between the
/// words of the bar itself.
fn bar_in(inner: Rect) -> Rect {
    let above = if has_axes(inner, true) { 126.0 } else { 42.0 };
    let [first, last] = [inner.top() + above, inner.bottom() - 62.0];
    let height = (last - first).clamp(0.0, 160.0);
    let top = (inner.center().y - height / 2.0).min(last - height).max(first);
    Rect::from_min_size(pos2(inner.right() - 12.0, top), vec2(12.0, height))
}

/// Draws the map's colours, the first below.
fn colour_bar(painter: &Painter, inner: Rect, is_diverging: bool) -> Rect {
    const STEPS: usize = 64;
    let bar = bar_in(inner);
    // Its numbers stand at the left of its ends, its title above, its note below.
    labels::stands(painter.ctx(), Rect::from_min_max(bar.min - vec2(60.0, 30.0), bar.max + vec2(0.0, 30.0)));
    for i in 0..STEPS {
        let t = i as f32 / STEPS as f32;
        let [r, g, b] = if is_diverging { diverging(t) } else { viridis(t) }.0;
        let top = bar.bottom() - bar.height() * (t + 1.0 / STEPS as f32);
        let piece = Rect::from_min_size(pos2(bar.left(), top), vec2(bar.width(), bar.height() / STEPS as f32 + 0.5));
        painter.rect_filled(piece, 0.0, Color32::from_rgb(r, g, b));
    }
    bar
}

/// Writes beside a bar, or above and below it, what its first and its last colour mean, and its title above.
fn ends(painter: &Painter, bar: Rect, [low, high]: [String; 2], title: &str, colour: Color32, are_apart: bool) {
    let font = FontId::proportional(12.0);
    let (title_at, low_at, high_at) = if are_apart {
        let (below, above) = (bar.right_bottom() + vec2(0.0, 2.0), bar.right_top() - vec2(0.0, 2.0));
        (26.0, (below, Align2::RIGHT_TOP), (above, Align2::RIGHT_BOTTOM))
    } else {
        let beside = |y: f32| (pos2(bar.left() - 6.0, y), Align2::RIGHT_CENTER);
        (12.0, beside(bar.bottom()), beside(bar.top()))
    };
    for ((at, align), text) in [(low_at, low), (high_at, high)] {
        halo::text(painter, at, align, &text, font.clone(), colour);
    }
    halo::text(painter, bar.center_top() - vec2(-6.0, title_at), Align2::RIGHT_BOTTOM, title, font, colour);
}

fn legend(painter: &Painter, inner: Rect, legend: &Legend, colour: Color32) {
    let bar = colour_bar(painter, inner, legend.is_diverging);
    let (low, high) = legend.map.range;
    let [low, high] = [low, high].map(|value| format!("{} {}", decimal(value, legend.decimals), legend.unit));
    let low = if legend.is_open_below { say!("views-legend-less", value = low) } else { low };
    let high = if legend.is_open { say!("views-legend-more", value = high) } else { high };
    ends(painter, bar, [low, high], &legend.title, colour, legend.has_histogram);
    let font = FontId::proportional(12.0);
    let below = if legend.has_histogram { 16.0 } else { 14.0 };
    let foot = bar.right_bottom() + vec2(0.0, below);
    let Some(Colour([r, g, b])) = legend.patch else {
        halo::text(painter, foot, Align2::RIGHT_TOP, &legend.note, font, colour);
        return;
    };
    let patch = Rect::from_min_size(pos2(bar.left(), foot.y), vec2(bar.width(), bar.width()));
    painter.rect_filled(patch, 0.0, Color32::from_rgb(r, g, b));
    halo::text(painter, patch.left_center() - vec2(6.0, 0.0), Align2::RIGHT_CENTER, &legend.note, font, colour);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_stand_between_the_axes_and_what_is_said_below() {
        for height in [60.0_f32, 100.0, 160.0, 240.0, 290.0, 320.0, 420.0, 700.0] {
            let inner = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, height));
            let bar = bar_in(inner);
            if bar.height() < LEAST_BAR {
                assert!(height < 200.0, "no colours in {height}");
                continue;
            }
            // The title over a histogram, and the axes with the words below them.
            let [title, axes] = [bar.top() - 40.0, if has_axes(inner, true) { 86.0 } else { 0.0 }];
            assert!(title >= axes && bar.bottom() + 46.0 <= height, "{bar} in {height}");
        }
        let roomy = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 700.0));
        assert_eq!((bar_in(roomy).height(), bar_in(roomy).center().y), (160.0, 350.0));
    }

    #[test]
    fn scale_bars_have_round_lengths() {
        assert_eq!([0.7, 1.0, 1.9, 2.1, 7.0, 49.0, 51.0].map(round_length), [0.5, 1.0, 1.0, 2.0, 5.0, 20.0, 50.0]);
        assert_eq!(round_length(f32::NAN), 1.0);
        let as_written =
            ["0.00001", "0.00002", "0.0001", "0.001", "0.005", "0.01", "0.02", "0.05", "0.1", "0.2", "0.5"];
        for length in as_written {
            let mm: f32 = length.parse().unwrap();
            assert_eq!(round_length(1.5 * mm).to_string(), length);
        }
    }
}
