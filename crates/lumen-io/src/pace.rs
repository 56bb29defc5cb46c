//! The pace of a reader that is written in one piece and worked in slices.
//!
//! STL, PLY and OBJ are rows, and what stands between two slices is a place and some lists. In the files of VTK and glTF
//! arrays lie in a structure, are decoded, unfolded and put together. Their readers are `async` functions that rest after each
//! block of work: the compiler keeps what stands between two slices, and to drop the reader is to cancel it. Nothing is
//! waited for: whoever wants the next block polls.

use std::cell::Cell;
use std::future::poll_fn;
use std::mem;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

use super::error::ReadError;
use super::raw::RawSurface;
use lumen_mesh::task::{Budget, Progress};

/// Numbers, and bytes that are only copied, decoded or searched, between two rests: a millisecond or two at most.
pub(super) const NUMBERS: usize = 1 << 14;
pub(super) const BYTES: usize = 1 << 16;

/// How far a reader is: bytes of its file. Clones tell of the same reader.
#[derive(Clone, Default)]
pub(super) struct Pace(Rc<Cell<f64>>);

impl Pace {
    /// Ends a block of work, which did so many bytes of the file; parts of bytes where each is worked on several times.
    pub(super) async fn rest(&self, bytes: f64) {
        self.0.set(self.0.get() + bytes);
        let mut is_rested = false;
        poll_fn(|_| if mem::replace(&mut is_rested, true) { Poll::Ready(()) } else { Poll::Pending }).await;
    }
}

/// A reader at its pace.
pub(super) struct Paced<'a> {
    reader: Pin<Box<dyn Future<Output = Result<RawSurface, ReadError>> + 'a>>,
    pace: Pace,
    /// Bytes of the file.
    file: usize,
}

impl<'a> Paced<'a> {
    /// What `reader` makes of a file of so many bytes.
    pub(super) fn new<R>(file: usize, reader: impl FnOnce(Pace) -> R) -> Self
    where
        R: Future<Output = Result<RawSurface, ReadError>> + 'a,
    {
        let pace = Pace::default();
        Self { reader: Box::pin(reader(pace.clone())), pace, file }
    }

    /// Reads on, for a block at least.
    pub(super) fn advance(&mut self, budget: Budget) -> Progress<Result<RawSurface, ReadError>> {
        let mut context = Context::from_waker(Waker::noop());
        loop {
            match self.reader.as_mut().poll(&mut context) {
                Poll::Ready(read) => return Progress::Done(read),
                Poll::Pending if budget.is_spent() => {
                    // What a file uses twice, as glTF may a mesh, is told twice.
                    return Progress::Working((self.pace.0.get() / self.file.max(1) as f64).min(1.0) as f32);
                }
                Poll::Pending => {}
            }
        }
    }
}

/// What comes of a reader that is not interrupted.
#[cfg(any(test, feature = "scans"))]
pub(super) fn at_once<T>(reader: impl Future<Output = T>) -> T {
    let mut reader = std::pin::pin!(reader);
    let mut context = Context::from_waker(Waker::noop());
    loop {
        if let Poll::Ready(read) = reader.as_mut().poll(&mut context) {
            return read;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_reader_rests_after_each_block_and_ends_where_it_is_dropped() {
        let done = Rc::new(Cell::new(0));
        let counter = Rc::clone(&done);
        let mut paced = Paced::new(8, move |pace| async move {
            for _ in 0..4 {
                counter.set(counter.get() + 1);
                pace.rest(2.0).await;
            }
            Err(ReadError::Empty)
        });
        for (blocks, fraction) in [(1, 0.25), (2, 0.5), (3, 0.75)] {
            assert!(matches!(paced.advance(Budget::new(Duration::ZERO)), Progress::Working(told) if told == fraction));
            assert_eq!(done.get(), blocks);
        }
        drop(paced);
        assert_eq!((done.get(), Rc::strong_count(&done)), (3, 1));
        let seven = async {
            Pace::default().rest(1.0).await;
            7
        };
        assert_eq!(at_once(seven), 7);
    }
}
