//! The pictures of a report, drawn without a window.

use anyhow::{Context, Result};

use crate::app::report_pictures;
use crate::io::Axes;
use crate::pipeline::run::Pipeline;
use crate::report::Pixels;

/// Those of a run that is over, with what each shows; `axes` say which way the patient lies.
pub(super) fn of(pipeline: &Pipeline, axes: Axes) -> Result<Vec<(String, Pixels)>> {
    let kept = pipeline.kept().context("nothing was kept")?;
    let reduced = pipeline.reduced().context("nothing was reduced")?;
    let compared = pipeline.deviations().and_then(|found| found.from_smoothed.as_ref());
    let deviation = compared.map(|found| (&*found.map, found.deviation.p95 as f32));
    Ok(report_pictures(&kept.mesh, &reduced.mesh, deviation, axes)?)
}
