//! A force that one report says by itself: it is sent when it changes, again where the device asks for that, and taken back
//! until the taking back has arrived.

use super::{ForceError, Reply};

/// Failures in a row after which the device counts as gone.
const PATIENCE: u32 = 5;

/// One report's way to the device.
#[derive(Clone, Debug)]
pub(super) struct SingleReport {
    /// The least between two reports, in ms.
    least_ms: f64,
    /// ms after which an unchanged force is told again; `None` where the device keeps it.
    keep_ms: Option<f64>,
    /// What ends the force.
    stop: Vec<u8>,
    wished: Option<f64>,
    told: Option<(f64, Vec<u8>)>,
    is_under_way: bool,
    must_stop: bool,
    failures: u32,
}

impl SingleReport {
    /// With at least `least_ms` between two, told again after `keep_ms`, and ended by `stop`.
    pub(super) fn new(least_ms: f64, keep_ms: Option<f64>, stop: Vec<u8>) -> Self {
        Self { least_ms, keep_ms, stop, wished: None, told: None, is_under_way: false, must_stop: false, failures: 0 }
    }

    pub(super) fn wish(&mut self, force: f64) {
        self.wished = Some(force);
        self.must_stop = false;
    }

    pub(super) fn stop(&mut self) {
        self.must_stop = self.wished.take().is_some() || self.must_stop;
    }

    /// The bytes that go next at `now_ms`: what `saying` makes of the force that is wished, or what ends it.
    pub(super) fn next(&mut self, now_ms: f64, saying: impl FnOnce(f64) -> Vec<u8>) -> Option<Vec<u8>> {
        if self.is_under_way || self.error().is_some() {
            return None;
        }
        let data = if self.must_stop { self.stop.clone() } else { saying(self.wished?) };
        let is_due = self.told.as_ref().is_none_or(|(told, before)| {
            let passed = now_ms - told;
            self.must_stop
                || self.keep_ms.is_some_and(|keep| passed >= keep)
                || *before != data && passed >= self.least_ms
        });
        is_due.then(|| {
            self.is_under_way = true;
            self.told = Some((now_ms, data.clone()));
            data
        })
    }

    /// Hears how the last went; what has arrived, if it has.
    pub(super) fn reply(&mut self, reply: Reply<'_>) -> Option<&[u8]> {
        self.is_under_way = false;
        if reply == Reply::Failed {
            self.failures += 1;
            self.told = None;
            return None;
        }
        self.failures = 0;
        let (_, data) = self.told.as_ref()?;
        self.must_stop &= *data != self.stop;
        Some(data)
    }

    /// What leaves the device without force: nothing, where nothing was ever told.
    pub(super) fn farewell(&self) -> Option<Vec<u8>> {
        self.told.as_ref().map(|_| self.stop.clone())
    }

    pub(super) fn error(&self) -> Option<ForceError> {
        (self.failures >= PATIENCE).then_some(ForceError::Silent)
    }
}
