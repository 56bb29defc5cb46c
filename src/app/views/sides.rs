//! On which side of the patient the camera stands.

use std::f32::consts::PI;

use glam::{Quat, Vec3};

use crate::io::Axes;
use crate::render::{Camera, StandardView};

/// From where a surface of this size is first seen: from the front, unless it lies on its back, as some scans are stored.
pub(in crate::app) fn first_view(size: Vec3) -> StandardView {
    if size.y > size.z && size.y > size.x { StandardView::Superior } else { StandardView::Anterior }
}

/// Stands on a side: RAS is LPS, whose sides the views are named for, after half a turn about the axis to the head.
pub(in crate::app) fn stand(camera: &mut Camera, view: StandardView, axes: Axes) {
    camera.standard_view(view);
    if axes == Axes::Ras {
        camera.rotation = (Quat::from_rotation_z(PI) * camera.rotation).normalize();
    }
}
