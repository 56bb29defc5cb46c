//! How a wire is turned where it is put, and what keeps it from being put there.

use glam::{DQuat, DVec3};

use super::wire::WireError;
use lumen_message::{grouped, messages};

/// The largest load in N/mm; a setup has loads in f32.
const MAX_LOAD: f32 = 0.1;

messages! {
    /// Why a wire cannot be put where it should be.
    #[derive(Clone, Debug, PartialEq)]
    pub enum PlacementError {
        /// A wall is too near.
        "trial-tight" Tight {
            /// Distance of the entry from the wall.
            distance_mm: f64 [2],
            /// Radius of the wire.
            radius_mm: f64 [2],
        } => "the wire does not fit where it enters: \
              the wall is {distance_mm:.2} mm away, the wire's radius is {radius_mm:.2} mm",
        /// The direction of the entry is no direction.
        "trial-no-direction" Direction => "the entry has no direction",
        /// The load is no load, or more than a wire can bear.
        "trial-load" Load {
            /// The load in N on each mm.
            load: f32,
            /// The largest.
            most: f32,
        } => {
            let load = grouped(load);
            format!("a load of {load} N on each mm of the wire is not possible: it can be from 0 to {most} N")
        },
        /// It is not in the vessel.
        "trial-not-inside" Outside => "the entry is not inside the vessel",
    } or {
        /// The wire cannot be.
        Wire(WireError),
    }
}

/// Refuses a load of so many N on each mm that is more than a wire can bear, less than none, or no number.
pub(super) fn check_load(n_per_mm: f64) -> Result<(), PlacementError> {
    let is_possible = (0.0..=f64::from(MAX_LOAD)).contains(&n_per_mm);
    if is_possible { Ok(()) } else { Err(PlacementError::Load { load: n_per_mm as f32, most: MAX_LOAD }) }
}

/// The rotation by `angle` radians about `axis`, of length 1. glam's own goes through the platform's sine.
pub(super) fn rotation(axis: DVec3, angle: f64) -> DQuat {
    let (sine, cosine) = libm::sincos(0.5 * angle);
    DQuat::from_vec4((axis * sine).extend(cosine))
}
