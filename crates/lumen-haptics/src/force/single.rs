//! A force that one report says by itself: it is sent when it changes, again where the device asks for that, and taken back
//! until the taking back has arrived.

use super::{ForceCommand, ForceDriver, ForceError, Reply, Request};

/// Failures in a row after which the device counts as gone.
const PATIENCE: u32 = 5;

/// A device whose force one report says.
pub trait SingleForce: Send {
    /// The report's id; 0 for none.
    const ID: u8;
    /// The force as this device is told it.
    type Force: Copy + Send;

    /// What it is to be told of what is wished.
    fn force(&self, command: &ForceCommand) -> Self::Force;

    /// The report that says so.
    fn report(&self, force: Self::Force) -> Vec<u8>;

    /// Hears that a report has arrived.
    fn arrived(&mut self, _report: &[u8]) {}
}

/// Drives one.
#[derive(Clone, Debug)]
pub struct SingleDriver<D: SingleForce> {
    device: D,
    line: SingleReport<D::Force>,
}

impl<D: SingleForce> SingleDriver<D> {
    /// With at least `least_ms` between two reports, told again after `keep_ms`, and ended by `stop`.
    pub(super) fn by(device: D, least_ms: f64, keep_ms: Option<f64>, stop: Vec<u8>) -> Self {
        Self { device, line: SingleReport::new(least_ms, keep_ms, stop) }
    }
}

impl<D: SingleForce> ForceDriver for SingleDriver<D> {
    fn command(&mut self, command: &ForceCommand) {
        self.line.command(self.device.force(command));
    }

    fn stop(&mut self) {
        self.line.stop();
    }

    fn next(&mut self, now_ms: f64) -> Option<Request> {
        let data = self.line.next(now_ms, |force| self.device.report(force))?;
        Some(Request::Send { id: D::ID, data })
    }

    fn reply(&mut self, _now_ms: f64, reply: Reply<'_>) {
        if let Some(report) = self.line.reply(reply) {
            self.device.arrived(report);
        }
    }

    fn farewell(&self) -> Vec<Request> {
        self.line.farewell().map(|data| Request::Send { id: D::ID, data }).into_iter().collect()
    }

    fn error(&self) -> Option<ForceError> {
        self.line.error()
    }

    fn has_coupling(&self) -> bool {
        false
    }
}

/// One report's way to the device.
#[derive(Clone, Debug)]
struct SingleReport<W> {
    /// The least between two reports, in ms.
    least_ms: f64,
    /// ms after which an unchanged force is told again; `None` where the device keeps it.
    keep_ms: Option<f64>,
    /// What ends the force.
    stop: Vec<u8>,
    wished: Option<W>,
    told: Option<(f64, Vec<u8>)>,
    /// Whether anything was ever told, arrived or not.
    has_told: bool,
    is_under_way: bool,
    must_stop: bool,
    failures: u32,
}

impl<W: Copy> SingleReport<W> {
    /// With at least `least_ms` between two, told again after `keep_ms`, and ended by `stop`.
    fn new(least_ms: f64, keep_ms: Option<f64>, stop: Vec<u8>) -> Self {
        Self {
            least_ms,
            keep_ms,
            stop,
            wished: None,
            told: None,
            has_told: false,
            is_under_way: false,
            must_stop: false,
            failures: 0,
        }
    }

    fn command(&mut self, force: W) {
        self.wished = Some(force);
        self.must_stop = false;
    }

    fn stop(&mut self) {
        self.must_stop = self.wished.take().is_some() || self.must_stop;
    }

    /// The bytes that go next at `now_ms`: what `saying` makes of the force that is wished, or what ends it.
    fn next(&mut self, now_ms: f64, saying: impl FnOnce(W) -> Vec<u8>) -> Option<Vec<u8>> {
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
            self.has_told = true;
            self.told = Some((now_ms, data.clone()));
            data
        })
    }

    /// Hears how the last went; what has arrived, if it has.
    fn reply(&mut self, reply: Reply<'_>) -> Option<&[u8]> {
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
    fn farewell(&self) -> Option<Vec<u8>> {
        self.has_told.then(|| self.stop.clone())
    }

    fn error(&self) -> Option<ForceError> {
        (self.failures >= PATIENCE).then_some(ForceError::Silent)
    }
}
