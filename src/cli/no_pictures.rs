//! What stands in for [`pictures`](super::pictures) in a build without the window.

use anyhow::{Result, bail};

use crate::io::Axes;
use crate::pipeline::run::Pipeline;
use crate::report::Pixels;

/// None.
pub(super) fn of(_: &Pipeline, _: Axes) -> Result<Vec<(String, Pixels)>> {
    bail!("this build has nothing to draw with (feature gui)")
}
