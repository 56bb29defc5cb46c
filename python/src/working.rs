//! Long work in slices: Python's other threads run meanwhile, and between two slices Ctrl-C and the progress are seen to.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use lumen::pipeline::run::{Advance, Pipeline};
use lumen::task::{Budget, Progress, Running, Yielder};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::error::refused;

/// How long Python waits to be heard.
const SLICE: Duration = Duration::from_millis(50);
/// Stages that there are at most: the parts of the progress.
const STAGES: f32 = lumen::pipeline::stage::Stage::ALL.len() as f32;

/// Whether this process, or one that it was forked from, has worked: then there are threads that a fork does not copy.
static HAS_WORKED: AtomicBool = AtomicBool::new(false);
/// Whether this process was forked from one that had worked. Whoever waits here for one of those threads waits forever.
static LACKS_THREADS: AtomicBool = AtomicBool::new(false);

/// Called by Python in a process that was forked from this one.
#[pyfunction]
pub(crate) fn _forked() {
    LACKS_THREADS.store(HAS_WORKED.load(Ordering::Relaxed), Ordering::Relaxed);
}

/// Work while Python's other threads run. All work goes through here.
pub(crate) fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    if LACKS_THREADS.load(Ordering::Relaxed) {
        return Err(PyRuntimeError::new_err(
            "this process was forked from one in which Lumen has worked, and its threads are not here: start processes by \
             multiprocessing's 'spawn'",
        ));
    }
    HAS_WORKED.store(true, Ordering::Relaxed);
    Ok(py.detach(work))
}

/// A slice, from now on.
pub(crate) fn slice() -> Budget {
    Budget::new(SLICE)
}

/// Work to its end, or until Python has had a signal.
pub(crate) fn worked<T: Send, F: Future<Output = T> + Send>(
    py: Python<'_>,
    work: impl FnOnce(Yielder) -> F,
) -> PyResult<T> {
    let mut running = Running::new(work);
    loop {
        if let Progress::Done(done) = detached(py, || running.advance(slice()))? {
            return Ok(done);
        }
        py.check_signals()?;
    }
}

/// How far work is, told to a callable of Python; never less than before.
pub(crate) struct Teller<'a, 'py> {
    callable: Option<&'a Bound<'py, PyAny>>,
    finished: f32,
    told: f32,
}

impl<'a, 'py> Teller<'a, 'py> {
    pub(crate) fn new(callable: Option<&'a Bound<'py, PyAny>>) -> Self {
        Self { callable, finished: 0.0, told: 0.0 }
    }

    /// Tells what is under way, and the part of all that is done. An exception of the callable ends the work.
    pub(crate) fn tell(&mut self, what: &str, part: f32) -> PyResult<()> {
        self.told = part.clamp(self.told, 1.0);
        self.callable.map_or(Ok(()), |callable| callable.call1((what, self.told)).map(drop))
    }

    /// Runs a pipeline to its end. A stage is a part of all, however long it takes.
    pub(crate) fn run(&mut self, py: Python<'py>, pipeline: &mut Pipeline) -> PyResult<()> {
        loop {
            match detached(py, || pipeline.advance(slice()))?.map_err(|error| refused(py, &error))? {
                Advance::Working(stage, part) => self.tell(&stage.to_string(), (self.finished + part) / STAGES)?,
                Advance::Finished(stage) => {
                    self.finished += 1.0;
                    self.tell(&stage.to_string(), self.finished / STAGES)?;
                }
                Advance::Idle => return Ok(()),
            }
            py.check_signals()?;
        }
    }
}
