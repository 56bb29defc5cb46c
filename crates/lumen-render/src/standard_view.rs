//! The views that radiology looks from.

use glam::{Mat3, Quat, Vec3};

/// The six views along the patient's axes, named for the side the eye is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StandardView {
    /// From the front, head up: the patient's left is on the right of the view.
    Anterior,
    /// From the back, head up.
    Posterior,
    /// From the patient's left, head up.
    Left,
    /// From the patient's right, head up.
    Right,
    /// From the head, front up: the patient's left is on the left of the view.
    Superior,
    /// From the feet, front up, as axial slices are read: the patient's left is on the right of the view.
    Inferior,
}

impl StandardView {
    /// All six, in the order of a menu.
    pub const ALL: [Self; 6] =
        [Self::Anterior, Self::Posterior, Self::Left, Self::Right, Self::Superior, Self::Inferior];

    /// Camera-to-world rotation: its columns are the view's right and up, and the way from the target to the eye.
    pub(super) fn rotation(self) -> Quat {
        let (up, back) = match self {
            Self::Anterior => (Vec3::Z, Vec3::NEG_Y),
            Self::Posterior => (Vec3::Z, Vec3::Y),
            Self::Left => (Vec3::Z, Vec3::X),
            Self::Right => (Vec3::Z, Vec3::NEG_X),
            Self::Superior => (Vec3::NEG_Y, Vec3::Z),
            Self::Inferior => (Vec3::NEG_Y, Vec3::NEG_Z),
        };
        Quat::from_mat3(&Mat3::from_cols(up.cross(back), up, back))
    }
}
