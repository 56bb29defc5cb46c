//! The pipeline to its end, with or without a word on how far it is.

use std::io::IsTerminal;
use std::time::Duration;

use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};

use super::interrupt;
use crate::pipeline::run::{Advance, Pipeline};
use crate::pipeline::safe::NoSafeRate;
use crate::pipeline::settings::Settings;
use crate::pipeline::stage::Stage;
use crate::pipeline::task::{Budget, Progress, Running, Yielder};
use crate::pipeline::verdict::rate;

/// Lets `advance` run the pipeline to its end; with `wants_safe` once more, to the rate that it has found to be safe.
pub(super) fn run_through(
    pipeline: &mut Pipeline,
    wants_safe: bool,
    advance: fn(&mut Pipeline) -> Result<()>,
) -> Result<()> {
    advance(pipeline)?;
    if !wants_safe {
        return Ok(());
    }
    let safe = pipeline.safe().context("the search for the safe rate ended without a result")?;
    let why = safe.refused.as_ref().map_or(String::new(), NoSafeRate::to_string);
    let percent = safe.percent.with_context(|| format!("no reduction can be called safe: {why}"))?;
    pipeline.set(Settings { target: rate(percent), ..pipeline.settings().clone() })?;
    advance(pipeline)
}

/// A bar of a thousand on standard error, where that is a terminal.
pub(super) fn progress_bar(what: &'static str) -> Result<ProgressBar> {
    let is_terminal = std::io::stderr().is_terminal();
    let bar = if is_terminal { ProgressBar::new(1000) } else { ProgressBar::hidden() };
    bar.set_style(ProgressStyle::with_template("{msg:<24} {wide_bar} {percent:>3} %")?);
    bar.set_message(what);
    Ok(bar)
}

/// Does work in slices, and shows how far it is.
pub(super) fn worked<T: 'static, F: Future<Output = T> + Send + 'static>(
    what: &'static str,
    work: impl FnOnce(Yielder) -> F,
) -> Result<T> {
    let mut running = Running::new(work);
    let bar = progress_bar(what)?;
    loop {
        interrupt::check()?;
        match running.advance(Budget::new(Duration::from_millis(50))) {
            Progress::Working(fraction) => bar.set_position((fraction * 1000.0) as u64),
            Progress::Done(found) => break Ok(found),
        }
    }
}

/// Runs all stages and shows how far they are, on standard error.
pub(super) fn advance(pipeline: &mut Pipeline) -> Result<()> {
    let is_terminal = std::io::stderr().is_terminal();
    let bar = progress_bar("")?;
    loop {
        interrupt::check()?;
        match pipeline.advance(Budget::new(Duration::from_millis(50)))? {
            Advance::Working(stage, fraction) => {
                bar.set_message(stage.to_string());
                bar.set_position((fraction * 1000.0) as u64);
            }
            // The measures are two stages of one name: the last says that they are done.
            Advance::Finished(stage) if !is_terminal && stage != Stage::SmoothedMeasures => {
                eprintln!("{stage}: done");
            }
            Advance::Finished(_) => {}
            Advance::Idle => break,
        }
    }
    bar.finish_and_clear();
    Ok(())
}

/// Runs all stages and says nothing.
pub(super) fn advance_quietly(pipeline: &mut Pipeline) -> Result<()> {
    while pipeline.advance(Budget::new(Duration::from_millis(50)))? != Advance::Idle {
        interrupt::check()?;
    }
    Ok(())
}
