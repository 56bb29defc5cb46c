//! A haptic device's hand on the wire, beside keys, pads and gamepad: how far it moves comes in, what it feels goes out.
//!
//! The device is served by whoever has it, at its own pace: a thread on the desktop, the Worker's events in the browser. Both
//! meet in an [`HapticChannel`]. What is not renewed on either side for [`STALE`] counts as nothing.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use web_time::Instant;

use crate::trial::STEP;
use crate::trial::session::{ROW_STEPS, Trial};
use crate::trial::setup::Input;
use crate::trial::virtual_coupling::VirtualCoupling;

/// For how long what a side has said holds.
pub const STALE: Duration = Duration::from_millis(100);

/// What a hand feels of the trial.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandFeels {
    /// The force along the wire in N, and the torque about it in N mm: positive against positive feed and roll.
    pub felt: [f64; 2],
    /// By how much these grow with each mm and each radian that the hand goes on.
    pub stiffness: [f64; 2],
}

/// Where a device and the trial meet; clones are the same.
#[derive(Clone, Debug, Default)]
pub struct HapticChannel(Arc<Mutex<Shared>>);

#[derive(Debug, Default)]
struct Shared {
    /// How far the hand has moved and the trial has not taken, in mm and radians, and when that was last told.
    moved: [f64; 2],
    told: Option<Instant>,
    feels: Option<(HandFeels, Instant)>,
}

fn is_fresh(since: Instant) -> bool {
    since.elapsed() <= STALE
}

impl HapticChannel {
    fn lock(&self) -> MutexGuard<'_, Shared> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The hand has moved so far since this was said last, in mm and radians. To be said again and again, if only that it
    /// has not moved.
    pub fn moves(&self, by: [f64; 2]) {
        let mut shared = self.lock();
        (0..2).for_each(|i| shared.moved[i] += if by[i].is_finite() { by[i] } else { 0.0 });
        shared.told = Some(Instant::now());
    }

    /// What the hand feels; `None` where no trial is on, or where it has stopped.
    pub fn feels(&self) -> Option<HandFeels> {
        self.lock().feels.filter(|(_, since)| is_fresh(*since)).map(|(feels, _)| feels)
    }

    /// How far the hand has moved since this was asked last; `None` where no device is served. A motion that the device has
    /// not stood by since counts for nothing.
    fn take(&self) -> Option<[f64; 2]> {
        let mut shared = self.lock();
        let moved = std::mem::take(&mut shared.moved);
        shared.told.is_some_and(is_fresh).then_some(moved)
    }

    fn tell(&self, feels: Option<HandFeels>) {
        self.lock().feels = feels.map(|feels| (feels, Instant::now()));
    }
}

/// A device's hand on the wire of one trial.
#[derive(Default)]
pub(super) struct Grasp {
    /// Where it meets a device, which may take hold at any time; `None` where there can be none.
    exchange: Option<HapticChannel>,
    hold: VirtualCoupling,
    /// Whether a device is served.
    is_held: bool,
    /// What keys, pads and gamepad do: the hand holds the wire for them too.
    pub(super) beside: Input,
}

impl Grasp {
    /// Of whoever is at the other side, if there may be somebody.
    pub(super) fn new(exchange: Option<HapticChannel>) -> Self {
        Self { exchange, ..Self::default() }
    }

    /// Where it meets the device.
    pub(super) fn exchange(&self) -> Option<HapticChannel> {
        self.exchange.clone()
    }

    /// Whether a device may take hold at any time: it does so without a command.
    pub(super) fn is_awaited(&self) -> bool {
        self.exchange.is_some()
    }

    /// How far the device has moved since this was asked last; `None` where none is served.
    fn moved(&self) -> Option<[f64; 2]> {
        self.exchange.as_ref()?.take()
    }

    fn tell(&self, feels: Option<HandFeels>) {
        if let Some(exchange) = &self.exchange {
            exchange.tell(feels);
        }
    }

    /// Nothing moves: the hand feels nothing, and what it does meanwhile is not made up for. Says whether it moves.
    pub(super) fn rest(&mut self) -> bool {
        self.hold = VirtualCoupling::default();
        self.tell(None);
        self.moved().is_some_and(|moved| moved != [0.0; 2])
    }

    /// A step of the trial, by the hand and by what is beside it. An autopilot, or a log, takes none of it.
    pub(super) fn step(&mut self, trial: &mut Trial, is_by_hand: bool) {
        let moved = self.moved();
        if !is_by_hand || moved.is_none() {
            // A device that is no longer served lets go of the wire.
            if std::mem::take(&mut self.is_held) {
                trial.drive(self.beside);
                self.tell(None);
                self.hold = VirtualCoupling::default();
            }
            trial.step();
            return;
        }
        self.is_held = true;
        if trial.simulation().steps().is_multiple_of(ROW_STEPS) {
            trial.drive(self.hold.input());
        }
        let ([feed, roll], steps) = (moved.unwrap_or_default(), trial.simulation().steps());
        let beside = [self.beside.feed, self.beside.roll].map(|speed| f64::from(speed) * STEP);
        self.hold.moves([feed + beside[0], roll + beside[1]]);
        trial.step();
        // Nothing steps once a trial is over.
        if trial.simulation().steps() > steps {
            self.hold.stepped(&trial.simulation().report());
        }
        self.tell(Some(HandFeels { felt: self.hold.felt(), stiffness: self.hold.stiffness() }));
    }
}
