//! Where the camera stands: on which side of the patient, or where a link or the last session has it.

use std::f32::consts::PI;

use glam::{Quat, Vec3};

use crate::io::Axes;
use crate::language::Key;
use crate::render::{Camera, StandardView};
use crate::sharing::Eye;

/// From where a surface of this size is first seen: from the front, unless it lies on its back, as some scans are stored.
pub(super) fn first_view(size: Vec3) -> StandardView {
    if size.y > size.z && size.y > size.x { StandardView::Superior } else { StandardView::Anterior }
}

/// Stands on a side: RAS is LPS, whose sides the views are named for, after half a turn about the axis to the head.
pub(super) fn stand(camera: &mut Camera, view: StandardView, axes: Axes) {
    camera.standard_view(view);
    if axes == Axes::Ras {
        camera.rotation = (Quat::from_rotation_z(PI) * camera.rotation).normalize();
    }
}

/// From where a camera looks.
pub(super) fn eye_of(camera: &Camera) -> Eye {
    let Camera { target, rotation, distance, .. } = camera;
    Eye { target_mm: target.to_array(), rotation: rotation.to_array(), distance_mm: *distance }
}

/// Moves a camera there, unless that is nowhere.
pub(super) fn look_from(eye: Eye, camera: &mut Camera) {
    if eye.is_somewhere() {
        let rotation = Quat::from_array(eye.rotation).normalize();
        *camera = Camera { target: eye.target_mm.into(), rotation, distance: eye.distance_mm, ..*camera };
    }
}

/// What a side is called: for the patient's side, or where that is not known for the side of the surface as it stands.
pub(super) fn side_label(view: StandardView, is_patient_known: bool) -> String {
    let [of_patient, of_surface] = match view {
        StandardView::Anterior => [Key("views-anterior"), Key("views-front")],
        StandardView::Posterior => [Key("views-posterior"), Key("views-rear")],
        StandardView::Left => [Key("views-left"), Key("views-right-side")],
        StandardView::Right => [Key("views-right"), Key("views-left-side")],
        StandardView::Superior => [Key("views-superior"), Key("views-top")],
        StandardView::Inferior => [Key("views-inferior"), Key("views-bottom")],
    };
    if is_patient_known { of_patient.say() } else { of_surface.say() }
}
