//! A surface and a setup made into a trial. It is one piece of work: wall, vessel tree and route.

use std::sync::Arc;

use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::trial::course::{Course, TrialError};
use crate::trial::session::Trial;
use crate::trial::setup::Setup;

/// A trial on a surface. What the setup leaves open is proposed; with `exchanges`, wires that follow one that fails, too.
///
/// # Errors
/// When the surface has no way for the wire, or the setup makes no trial.
pub(super) fn start(
    mesh: &Arc<TriMesh>,
    sample: Option<Sample>,
    mut setup: Setup,
    exchanges: bool,
) -> Result<Trial, TrialError> {
    let course = Arc::new(Course::new(mesh, sample, &mut setup)?);
    if !exchanges {
        setup.next_wires.clear();
    }
    Trial::new(course, setup)
}
