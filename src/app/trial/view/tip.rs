//! What the tip of the wire sees.

use egui::{Align2, Rect, Role, Sense, Ui};
use glam::{Mat3, Quat};

use super::TrialView;
use super::painting::{empty, image, radius};
use crate::app::assist::name;
use crate::app::places::pixels;
use crate::app::theme;
use crate::app::trial::plate::plate;
use crate::app::trial::state::Trial;
use crate::mesh::{Bounds, Vec3};
use crate::render::Camera;
use crate::say;
use crate::trial::frame::Frame;

/// How far the tip sees, in mm.
const TIP_REACH: f32 = 80.0;
/// The tip's field of view, in radians.
const TIP_FIELD: f32 = 1.7;

impl TrialView {
    pub(super) fn tip(&mut self, ui: &mut Ui, rect: Rect, trial: &Trial) {
        // It takes the pointer from what it lies over.
        let sense = if trial.is_large() { Sense::CLICK | Sense::DRAG } else { Sense::hover() };
        let response = ui.allocate_rect(rect, sense);
        name(&response, Role::Image, &say!("trial-tip-view"));
        match (&mut self.scene, trial.session(), trial.frame()) {
            (Some(scene), Some(session), Some(frame)) if !frame.nodes.is_empty() => {
                let camera = from_tip(frame, radius(session), rect.width() / rect.height().max(1.0));
                let texture = scene.tip(&camera, pixels(ui, rect), &theme::style(ui.visuals()));
                image(ui, rect, texture);
            }
            _ => empty(ui, rect),
        }
        let inner = rect.shrink(8.0);
        plate(ui, inner.left_top(), Align2::LEFT_TOP, &say!("trial-tip-title"), true);
        if rect.height() > 200.0 {
            plate(ui, inner.left_bottom(), Align2::LEFT_BOTTOM, &trial.title, false);
        }
    }
}

/// The camera in the tip of a wire of this radius, for a view `aspect` times as wide as high: forwards, the side to which
/// the tip is bent above. No wall is nearer to the middle of the tip than the wire's radius; so near the near plane's
/// corners are.
fn from_tip(frame: &Frame, radius: f32, aspect: f32) -> Camera {
    let tip = Vec3::from(frame.nodes[0]);
    let back = -Vec3::from(frame.tip_direction).normalize_or(Vec3::Z);
    let up = Vec3::from(frame.tip_side).reject_from_normalized(back);
    let up = up.try_normalize().unwrap_or(back.any_orthonormal_vector());
    const AHEAD: f32 = 5.0;
    /// What contact lets a wall come nearer.
    const ROOM: f32 = 0.9;
    let half = libm::tanf(TIP_FIELD / 2.0);
    let to_corner = libm::sqrtf(1.0 + half * half * (1.0 + aspect * aspect));
    Camera {
        target: tip - back * AHEAD,
        rotation: Quat::from_mat3(&Mat3::from_cols(up.cross(back), up, back)),
        distance: AHEAD,
        fov_y: TIP_FIELD,
        bounds: Bounds::of(&[tip - Vec3::splat(TIP_REACH), tip + Vec3::splat(TIP_REACH)]),
        nearest_mm: ROOM * radius / to_corner,
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;

    #[test]
    fn the_tip_looks_along_itself_and_its_near_plane_cuts_no_wall_that_it_touches() {
        let along = Vec3::new(0.6, 0.0, 0.8);
        let nodes: Vec<[f32; 3]> = vec![[1.0, 2.0, 3.0], [0.4, 2.0, 2.2]];
        let tip = Vec3::from(nodes[0]);
        let frame = Frame { nodes, tip_direction: along.to_array(), tip_side: [0.0, 1.0, 0.0], ..Frame::default() };
        // Radii of wires of 0.014 and 0.035 in.
        for (radius, aspect) in [(0.178, 1.0), (0.178, 3.0), (0.444, 1.5)] {
            let camera = from_tip(&frame, radius, aspect);
            assert!(camera.eye().distance(tip) < 1e-4);
            let [ahead, above] =
                [Vec3::ZERO, Vec3::Y].map(|up| camera.project(tip + along * 10.0 + up, aspect).unwrap());
            assert!(ahead.length() < 1e-4 && above.x.abs() < 1e-4 && above.y > 0.05, "{ahead} {above}");
            let matrix = camera.view_projection(aspect);
            // Depth is 1 at the near plane, and 0 at the far one.
            let is_seen = |at: Vec3| (0.0..1.0).contains(&matrix.project_point3(at).z);
            for corner in [(-1.0_f32, -1.0_f32), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (0.0, 0.0)] {
                let way = camera.ray(Vec2::from(corner), aspect).direction;
                assert!(is_seen(tip + way * radius), "the wall beside a tip of {radius} mm, {corner:?}");
            }
            assert!(is_seen(tip + along * TIP_REACH));
        }
    }
}
