//! What goes wrong with a graphics device, heard at any time: it is lost (the driver was reset, a laptop changed its
//! card, the browser took the context back), its memory is full, or it was asked for what it cannot do.
//!
//! wgpu's own answer to the last two is a panic. Here they are noted, and whoever owns the device asks for them once a
//! frame. A lost device never comes back: everything on it has to be made again on another one.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use web_time::Instant;

/// What went wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// An allocation failed; the device goes on.
    #[error("the graphics memory is full")]
    OutOfMemory,
    /// A call was refused: an error in this program or in the driver.
    #[error("the graphics device refused a call: {0}")]
    Refused(String),
    /// The device is gone.
    #[error("the graphics device was lost: {0}")]
    Lost(String),
}

impl Fault {
    /// Whether only another device helps.
    pub fn ends_device(&self) -> bool {
        !matches!(self, Self::OutOfMemory)
    }
}

/// Calls that use what could not be allocated are refused as well; until then that is no fault of its own.
const AFTERMATH: Duration = Duration::from_secs(1);

/// What is known of one device; clones know the same.
#[derive(Clone, Debug, Default)]
pub struct DeviceHealth(Arc<Mutex<Known>>);

#[derive(Debug, Default)]
struct Known {
    /// The first fault that ends the device.
    end: Option<Fault>,
    is_full: bool,
    full_since: Option<Instant>,
}

impl DeviceHealth {
    /// Listens to `device` from now on, in place of whoever did; `wake` is called after each fault, from any thread.
    pub fn watch(device: &wgpu::Device, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let health = Self::default();
        let wake = Arc::new(wake);
        device.set_device_lost_callback({
            let (health, wake) = (health.clone(), Arc::clone(&wake));
            move |reason, message| {
                health.take(Fault::Lost(if message.is_empty() { format!("{reason:?}") } else { message }));
                wake();
            }
        });
        device.on_uncaptured_error(Arc::new({
            let health = health.clone();
            move |error| {
                health.take(match error {
                    wgpu::Error::OutOfMemory { .. } => Fault::OutOfMemory,
                    wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
                        Fault::Refused(description)
                    }
                });
                wake();
            }
        }));
        health
    }

    /// Notes a fault.
    pub fn take(&self, fault: Fault) {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match fault {
            Fault::OutOfMemory => {
                known.is_full = true;
                known.full_since = Some(Instant::now());
            }
            Fault::Refused(_) if known.full_since.is_some_and(|since| since.elapsed() < AFTERMATH) => {}
            end => {
                known.end.get_or_insert(end);
            }
        }
    }

    /// Why the device has to be replaced, if it has to be.
    pub fn end(&self) -> Option<Fault> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).end.clone()
    }

    /// Whether memory was full since this was last asked.
    pub fn take_full(&self) -> bool {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner).is_full)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_fault_that_ends_a_device_is_its_cause() {
        let health = DeviceHealth::default();
        assert_eq!((health.end(), health.take_full()), (None, false));
        health.take(Fault::Lost("reset".to_owned()));
        health.take(Fault::Refused("a buffer of a lost device".to_owned()));
        assert_eq!(health.end(), Some(Fault::Lost("reset".to_owned())));
    }

    #[test]
    fn full_memory_ends_no_device_and_is_told_once() {
        let health = DeviceHealth::default();
        health.take(Fault::OutOfMemory);
        health.take(Fault::Refused("the buffer is invalid".to_owned()));
        assert_eq!(health.end(), None);
        assert!(health.take_full());
        assert!(!health.take_full());
    }

    #[test]
    fn a_refused_call_ends_the_device() {
        let health = DeviceHealth::default();
        health.take(Fault::Refused("no such bind group".to_owned()));
        assert!(health.end().is_some_and(|end| end.ends_device()));
    }
}
