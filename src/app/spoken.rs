//! What is told to those who do not see the window: what a view shows, and what goes on.

use egui::accesskit::{Live, Role};
use egui::{Rect, Sense, Ui, Vec2};

use super::document::Document;
use super::notices::Kind;
use super::state::State;
use super::verdict;
use crate::io::Axes;
use crate::language::{Key, decimal, tell};
use crate::pipeline::settings::Keep;
use crate::render::Camera;
use crate::say;
use crate::vessel::width::Narrowest;

/// From which side a view looks, as far as it is known which way the patient lies.
fn side(camera: &Camera, axes: Axes) -> String {
    // Of the axis that points most towards the eye, or away from it.
    let towards = camera.axes().map(|axis| axis.z);
    let nearest = (0..3).max_by(|&a, &b| towards[a].abs().total_cmp(&towards[b].abs())).unwrap_or(0);
    let away = usize::from(towards[nearest] < 0.0);
    let [left, right] = [Key("views-side-left"), Key("views-side-right")];
    let [front, back] = [Key("views-side-front"), Key("views-side-back")];
    let vertical = [Key("views-side-above"), Key("views-side-below")];
    let sides = match axes {
        Axes::Lps => [[left, right], [back, front], vertical],
        Axes::Ras => [[right, left], [front, back], vertical],
        Axes::Unknown => {
            let axis = [["+X", "-X"], ["+Y", "-Y"], ["+Z", "-Z"]][nearest][away];
            return say!("views-side-axis", axis = axis);
        }
    };
    sides[nearest][away].say()
}

/// What a view shows, in a sentence: the surface, from where it is seen, its triangles and its narrowest place.
pub(super) fn view(document: &Document, keep: Keep, camera: &Camera, shows_before: bool) -> String {
    let side = side(camera, document.import.axes);
    let name = &*document.title();
    if let Some(averaged) = document.averaged(keep).filter(|_| shows_before) {
        return say!("views-seen-laplacian", name = name, side = side, passes = averaged.passes);
    }
    if shows_before {
        return say!("views-seen-opened", name = name, side = side, count = document.opened.triangles.len());
    }
    let mut said = vec![say!("views-seen", name = name, side = side)];
    said.extend(document.shown.as_ref().map(|shown| say!("views-seen-triangles", count = shown.level.triangles.len())));
    let shape = document.measured.as_ref().and_then(|measured| measured.report.output_shape.as_ref());
    if let Some(Narrowest { diameter_mm, .. }) = shape.and_then(|shape| shape.smallest_lumen) {
        said.push(say!("views-seen-narrowest", diameter = decimal(diameter_mm, 1)));
    }
    said.join(", ")
}

/// What is to be heard of what goes on: no number that changes with every frame.
fn news(state: &State) -> (String, bool) {
    if let Some(notice) = state.notices.newest() {
        return (notice.said(), notice.kind == Kind::Wrong);
    }
    if let Some((work, _)) = state.work {
        return (work.label(), false);
    }
    let Some(document) = &state.document else { return (String::new(), false) };
    let verdict = verdict::verdict(state, document).in_short(tell);
    let count = document.shown.as_ref().map_or(0, |shown| shown.level.triangles.len());
    (say!("views-news", name = document.title(), count = count, verdict = verdict), false)
}

/// Tells assistive tools what goes on, at once where something went wrong: a node that is always there, and has no place.
pub(super) fn announce(ui: &Ui, state: &State) {
    let place = Rect::from_min_size(ui.max_rect().min, Vec2::splat(1.0));
    let response = ui.interact(place, ui.scope_id().with("announcement"), Sense::empty());
    ui.ctx().accesskit_node_builder(response.id, |node| {
        let (text, is_error) = news(state);
        node.set_role(Role::Status);
        node.set_live(if is_error { Live::Assertive } else { Live::Polite });
        node.set_value(text);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::sides::stand;
    use crate::render::StandardView;

    #[test]
    fn a_side_is_that_which_the_view_is_named_for() {
        let from = |view, axes| {
            let mut camera = Camera::default();
            stand(&mut camera, view, axes);
            side(&camera, axes)
        };
        for axes in [Axes::Lps, Axes::Ras] {
            let sides = StandardView::ALL.map(|view| from(view, axes));
            assert_eq!(sides, ["the front", "the back", "the left", "the right", "above", "below"]);
        }
        assert_eq!(from(StandardView::Superior, Axes::Unknown), "+Z");
    }
}
