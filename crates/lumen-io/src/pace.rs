//! The pace of a reader: it rests after each block of work, and says how many bytes of the file are done.

use std::sync::{Mutex, PoisonError};

use lumen_mesh::task::Yielder;

/// Numbers, and bytes that are only copied, decoded or searched, between two rests: a millisecond or two at most.
pub(super) const NUMBERS: usize = 1 << 14;
pub(super) const BYTES: usize = 1 << 16;

/// How far a reader is.
pub(super) struct Pace {
    yielder: Yielder,
    /// Bytes of the file.
    file: usize,
    place: Mutex<Place>,
}

#[derive(Clone, Copy, Default)]
struct Place {
    /// Bytes that are done.
    done: f64,
    /// The largest fraction so far: what is read again is not undone.
    told: f32,
}

impl Pace {
    /// At the beginning of a file of so many bytes.
    pub(super) fn new(yielder: &Yielder, file: usize) -> Self {
        Self { yielder: yielder.clone(), file, place: Mutex::default() }
    }

    /// Of a reader that is not interrupted.
    #[cfg(any(test, feature = "scans"))]
    pub(super) fn never() -> Self {
        Self::new(&Yielder::never(), 0)
    }

    /// Back to the beginning: the file is read once more.
    pub(super) fn begin_again(&self) {
        self.place.lock().unwrap_or_else(PoisonError::into_inner).done = 0.0;
    }

    /// Ends a block of work, which did so many bytes of the file; parts of bytes where each is worked on several times.
    pub(super) async fn rest(&self, bytes: f64) {
        let told = {
            let mut place = self.place.lock().unwrap_or_else(PoisonError::into_inner);
            place.done += bytes;
            // What a file uses twice, as glTF may a mesh, is told twice.
            place.told = place.told.max((place.done / self.file.max(1) as f64).min(1.0) as f32);
            place.told
        };
        self.yielder.rest(told).await;
    }
}
