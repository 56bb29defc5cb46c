//! What is drawn over the view of the vessel: the way and its stations, the target, the fork that was missed, where two
//! trials differ.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};

use super::plate::plate;
use super::state::Session;
use crate::app::places::seen;
use crate::app::{halo, overlay};
use crate::engine::trial::RouteShown;
use crate::language::decimal;
use crate::mesh::Vec3;
use crate::render::Camera;
use crate::say;

/// Rings with numbers stand so far apart, in points.
const APART: f32 = 30.0;
/// In points: a narrower picture of the vessel has the wire and the way in it, and nothing else.
pub(super) const WRITTEN_OVER: f32 = 240.0;

/// The colours of two paths, this level's and the unreduced surface's: blue and orange (Okabe and Ito 2008).
pub(super) fn colours(dark: bool) -> [Color32; 2] {
    if dark {
        [Color32::from_rgb(0x56, 0xB4, 0xE9), Color32::from_rgb(0xE6, 0x9F, 0x00)]
    } else {
        [Color32::from_rgb(0x00, 0x5F, 0x9E), Color32::from_rgb(0xB8, 0x4A, 0x00)]
    }
}

/// Draws all of it over the view in `rect`.
pub(super) fn show(ui: &Ui, rect: Rect, camera: &Camera, session: &Session) {
    let Session { ready, run, .. } = session;
    let painter = ui.painter_at(rect);
    let at = |p: Vec3| seen(p, camera, rect);
    let visuals = ui.visuals();
    let accent = visuals.hyperlink_color;
    let way: Vec<Pos2> = ahead(session).iter().filter_map(|&p| at(p.into())).collect();
    painter.extend(Shape::dashed_line(&way, Stroke::new(1.0, accent.gamma_multiply(0.8)), 5.0, 5.0));
    let [here, other] = colours(visuals.dark_mode);
    if let Some(comparison) = &run.comparison {
        for (path, colour) in [(&comparison.other_tip, other), (&comparison.tip, here)] {
            let line: Vec<Pos2> = path.iter().filter_map(|&p| at(p.into())).collect();
            painter.add(Shape::line(line, Stroke::new(2.0, colour)));
        }
    }
    for (i, &station) in ready.route.stations.iter().enumerate() {
        if let Some(at) = at(station.into()) {
            dot(&painter, at, accent, visuals.panel_fill);
            if rect.width() < WRITTEN_OVER {
                continue;
            }
            plate(ui, at + vec2(7.0, 0.0), Align2::LEFT_CENTER, &(i + 1).to_string(), true);
        }
    }
    target(ui, &painter, rect, camera, &ready.route);
    let missed = run.summary.as_ref().and_then(|summary| summary.missed_fork_at);
    if let Some(fork) = missed.filter(|_| rect.width() >= WRITTEN_OVER) {
        overlay::ring(ui, rect, camera, fork.into(), &say!("trial-missed-fork-ring"), visuals.error_fg_color);
    }
    if let Some(comparison) = &run.comparison {
        let colour = visuals.error_fg_color;
        // The largest come first; one beside another would hide its number.
        let mut ringed: Vec<Pos2> = Vec::new();
        for &(place, force) in &comparison.force_differences {
            let Some(middle) = at(place.into()).filter(|at| ringed.iter().all(|ring| ring.distance(*at) > APART))
            else {
                continue;
            };
            ringed.push(middle);
            let sign = if force.is_sign_negative() { "" } else { "+" };
            let label = format!("{sign}{} N", decimal(force, 3));
            overlay::ring(ui, rect, camera, place.into(), &label, colour);
        }
        for &place in &comparison.pinched {
            overlay::ring(ui, rect, camera, place.into(), &say!("trial-pinched"), colour);
        }
        let entries = [(say!("trial-tip-here"), here), (say!("trial-tip-unreduced"), other)];
        legend(&painter, rect, visuals, &entries);
    }
}

/// The part of the way that the tip has yet to go.
fn ahead(session: &Session) -> &[[f32; 3]] {
    let way = &session.ready.route.points;
    let gone = session.run.frame.as_ref().map_or(0.0, |frame| frame.arc_mm as f32);
    let mut along = 0.0;
    let passed = way.windows(2).take_while(|pair| {
        along += Vec3::from(pair[0]).distance(pair[1].into());
        along <= gone
    });
    &way[passed.count()..]
}

fn dot(painter: &Painter, at: Pos2, colour: Color32, ground: Color32) {
    painter.circle(at, 4.0, ground, Stroke::new(2.0, colour));
}

/// A ring as wide as the lumen, across the way at its end.
fn target(ui: &Ui, painter: &Painter, rect: Rect, camera: &Camera, route: &RouteShown) {
    const SIDES: usize = 40;
    let (points, radii) = (&route.points, &route.radii);
    let (Some(&end), Some(&radius)) = (points.last(), radii.last()) else { return };
    let end = Vec3::from(end);
    let before = points.iter().rev().map(|&p| Vec3::from(p)).find(|p| p.distance(end) > 2.0).unwrap_or(end - Vec3::Z);
    let along = (end - before).normalize_or(Vec3::Z);
    let (u, v) = along.any_orthonormal_pair();
    let circle: Vec<Pos2> = (0..=SIDES)
        .filter_map(|i| {
            let angle = std::f32::consts::TAU * i as f32 / SIDES as f32;
            let out = u * libm::cosf(angle) + v * libm::sinf(angle);
            seen(end + out * radius.max(1.0) * 1.15, camera, rect)
        })
        .collect();
    let colour = ui.visuals().hyperlink_color;
    let right = circle.iter().map(|at| at.x).fold(f32::NEG_INFINITY, f32::max);
    painter.add(Shape::line(circle, Stroke::new(2.5, colour)));
    if let Some(at) = seen(end, camera, rect) {
        painter.circle_stroke(at, 9.0, Stroke::new(1.5, colour));
        if rect.width() < WRITTEN_OVER {
            return;
        }
        // Beside the ring, where it hides neither the ring nor the wire.
        plate(ui, pos2(right.max(at.x + 9.0) + 6.0, at.y), Align2::LEFT_CENTER, &say!("trial-target"), true);
    }
}

fn legend(painter: &Painter, rect: Rect, visuals: &egui::Visuals, entries: &[(String, Color32); 2]) {
    for (i, (label, colour)) in entries.iter().enumerate() {
        let at = rect.left_top() + vec2(12.0, 58.0 + 18.0 * i as f32);
        halo::lines(painter, &[[at, at + vec2(20.0, 0.0)]], Stroke::new(3.0, *colour));
        let font = FontId::proportional(12.0);
        halo::text(painter, at + vec2(26.0, 0.0), Align2::LEFT_CENTER, label, font, visuals.text_color());
    }
}
