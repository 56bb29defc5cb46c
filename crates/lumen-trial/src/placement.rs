//! How a wire is turned where it is put, and what keeps it from being put there.

use glam::{DQuat, DVec3};
use thiserror::Error;

use super::wire::WireError;
use lumen_language::say;
use lumen_language::{decimal, grouped};

/// The largest load in N/mm; a setup has loads in f32.
const MOST_LOAD: f32 = 0.1;

/// Why a wire cannot be put where it should be.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlacementError {
    /// The wire cannot be.
    #[error(transparent)]
    Wire(#[from] WireError),
    /// A wall is too near.
    #[error("{}", say!("trial-tight", distance = decimal(*distance_mm, 2), radius = decimal(*radius_mm, 2)))]
    Tight {
        /// Distance of the entry from the wall.
        distance_mm: f64,
        /// Radius of the wire.
        radius_mm: f64,
    },
    /// The direction of the entry is no direction.
    #[error("{}", say!("trial-no-direction"))]
    Direction,
    /// The load is no load, or more than a wire can bear.
    #[error("{}", say!("trial-load", load = grouped(.0), most = grouped(MOST_LOAD)))]
    Load(f32),
    /// It is not in the vessel.
    #[error("{}", say!("trial-not-inside"))]
    Outside,
}

/// Refuses a load of so many N on each mm that is more than a wire can bear, less than none, or no number.
pub(super) fn check_load(n_per_mm: f64) -> Result<(), PlacementError> {
    let is_possible = (0.0..=f64::from(MOST_LOAD)).contains(&n_per_mm);
    if is_possible { Ok(()) } else { Err(PlacementError::Load(n_per_mm as f32)) }
}

/// The rotation by `angle` radians about `axis`, of length 1. glam's own goes through the platform's sine.
pub(super) fn rotation(axis: DVec3, angle: f64) -> DQuat {
    let (sine, cosine) = libm::sincos(0.5 * angle);
    DQuat::from_vec4((axis * sine).extend(cosine))
}
