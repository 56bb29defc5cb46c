//! Long work as `async` functions that rest between blocks, so that whoever runs it can draw, or hear a cancel.
//!
//! ```
//! use std::time::Duration;
//!
//! use lumen_mesh::task::{Budget, Progress, Running, Yielder, at_once};
//!
//! /// The sum of the squares below `n`.
//! async fn sum(n: u64, yielder: &Yielder) -> u64 {
//!     let mut sum = 0;
//!     for i in 0..n {
//!         sum += i * i;
//!         yielder.rest(i as f32 / n as f32).await;
//!     }
//!     sum
//! }
//!
//! // In one go, and in slices of no time: one block each.
//! assert_eq!(at_once(sum(10, &Yielder::never())), 285);
//! let mut running = Running::new(|yielder| async move { sum(10, &yielder).await });
//! assert_eq!(running.advance(Budget::new(Duration::ZERO)), Progress::Working(0.0));
//! assert_eq!(running.advance(Budget::new(Duration::ZERO)), Progress::Working(0.1));
//! assert_eq!(running.finish(), 285);
//! ```
//!
//! Nothing is waited for: [`Yielder::rest`] goes on at once while the slice has time left. What stands between two slices
//! is kept by the compiler, and to drop the work is to cancel it. Inner loops are plain functions; a function that
//! works on several threads stops them all by [`Yielder::budget`].

use std::future::poll_fn;
use std::mem;
use std::ops::Range;
use std::pin::{Pin, pin};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};
use std::time::Duration;

use web_time::Instant;

/// A length of time that a slice may take, from its making on.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    end: Option<Instant>,
}

impl Budget {
    /// A slice of `duration`, from now on.
    pub fn new(duration: Duration) -> Self {
        Self { end: Some(Instant::now() + duration) }
    }

    /// No limit: the work runs to its end.
    pub const UNLIMITED: Self = Self { end: None };

    /// Whether the time is used up. Reads the clock: ask every few thousand operations.
    pub fn is_spent(&self) -> bool {
        self.end.is_some_and(|end| Instant::now() >= end)
    }
}

/// How far long work is.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress<T> {
    /// Not done: the fraction that is, 0 to 1.
    Working(f32),
    /// Done, with this result. The work must not be advanced again.
    Done(T),
}

/// What a work and whoever runs it share.
#[derive(Debug)]
struct Shared {
    /// Of the present slice.
    budget: Mutex<Budget>,
    /// The bits of the fraction that is done.
    fraction: AtomicU32,
}

/// Where long work rests and says how far it is: all of a work, or a part of it.
#[derive(Clone, Debug)]
pub struct Yielder {
    shared: Arc<Shared>,
    /// Where the part begins, and its share of all.
    start: f32,
    share: f32,
}

impl Yielder {
    /// For work that is done in one go.
    pub fn never() -> Self {
        let shared = Shared { budget: Mutex::new(Budget::UNLIMITED), fraction: AtomicU32::new(0) };
        Self { shared: Arc::new(shared), start: 0.0, share: 1.0 }
    }

    /// For a part of the work, whose own 0 to 1 is this `range` of the fraction here.
    pub fn part(&self, range: Range<f32>) -> Self {
        let (start, share) = (self.start + range.start * self.share, (range.end - range.start) * self.share);
        Self { shared: self.shared.clone(), start, share }
    }

    /// Ends a block of work: `fraction` is done. Goes on in the next slice if the present one is spent, which is to be asked
    /// every millisecond or less.
    pub async fn rest(&self, fraction: f32) {
        self.tell(fraction);
        if self.budget().is_spent() {
            pause().await;
        }
    }

    /// Ends a block of work that had the clock looked at and its slice spent.
    pub async fn pause(&self, fraction: f32) {
        self.tell(fraction);
        pause().await;
    }

    /// What is left of the present slice.
    pub fn budget(&self) -> Budget {
        *self.shared.budget.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tell(&self, fraction: f32) {
        let all = self.start + fraction.clamp(0.0, 1.0) * self.share;
        self.shared.fraction.store(all.to_bits(), Ordering::Relaxed);
    }
}

/// Leaves the work where it is until it is polled again.
async fn pause() {
    let mut is_rested = false;
    poll_fn(|_| if mem::replace(&mut is_rested, true) { Poll::Ready(()) } else { Poll::Pending }).await;
}

/// Long work under way.
pub struct Running<'a, T> {
    work: Pin<Box<dyn Future<Output = T> + Send + 'a>>,
    shared: Arc<Shared>,
}

impl<'a, T> Running<'a, T> {
    /// Begins, with what is the yielder's; nothing is done yet.
    pub fn new<W: Future<Output = T> + Send + 'a>(work: impl FnOnce(Yielder) -> W) -> Self {
        let yielder = Yielder::never();
        let shared = yielder.shared.clone();
        Self { work: Box::pin(work(yielder)), shared }
    }

    /// Works until `budget` is spent or the work is done. Each call makes progress, however small the budget.
    ///
    /// # Panics
    /// When the work is done already.
    pub fn advance(&mut self, budget: Budget) -> Progress<T> {
        *self.shared.budget.lock().unwrap_or_else(PoisonError::into_inner) = budget;
        match self.work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(output) => Progress::Done(output),
            Poll::Pending => Progress::Working(f32::from_bits(self.shared.fraction.load(Ordering::Relaxed))),
        }
    }

    /// Works to the end.
    ///
    /// # Panics
    /// When the work is done already.
    pub fn finish(mut self) -> T {
        loop {
            if let Progress::Done(output) = self.advance(Budget::UNLIMITED) {
                return output;
            }
        }
    }
}

impl<T> std::fmt::Debug for Running<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Running").field("shared", &self.shared).finish_non_exhaustive()
    }
}

/// The blocks of `size` that make up `0..count`, the last one shorter.
///
/// # Panics
/// When `size` is 0.
pub fn blocks(count: usize, size: usize) -> impl Iterator<Item = Range<usize>> + Clone {
    (0..count).step_by(size).map(move |start| start..count.min(start + size))
}

/// What comes of work that is done in one go: with [`Yielder::never`], it does not rest.
pub fn at_once<T>(work: impl Future<Output = T>) -> T {
    let mut work = pin!(work);
    loop {
        if let Poll::Ready(output) = work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return output;
        }
    }
}

/// Milliseconds since `start`.
pub fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    async fn count(blocks: u32, counter: &AtomicU32, yielder: &Yielder) -> u32 {
        for block in 1..=blocks {
            counter.fetch_add(1, Ordering::Relaxed);
            yielder.rest(block as f32 / blocks as f32).await;
        }
        blocks
    }

    #[test]
    fn work_rests_only_where_its_slice_is_spent_and_ends_where_it_is_dropped() {
        let counter = AtomicU32::new(0);
        let counter = &counter;
        let begin = || Running::new(|yielder| async move { count(4, counter, &yielder).await });
        let mut running = begin();
        for fraction in [0.25, 0.5, 0.75] {
            assert_eq!(running.advance(Budget::new(Duration::ZERO)), Progress::Working(fraction));
        }
        drop(running);
        assert_eq!(counter.swap(0, Ordering::Relaxed), 3);
        assert_eq!(begin().advance(Budget::new(Duration::from_secs(100))), Progress::Done(4));
        assert_eq!(at_once(count(4, counter, &Yielder::never())), 4);
    }

    #[test]
    fn fraction_of_a_part_counts_for_its_share() {
        let mut running = Running::new(|yielder| async move {
            yielder.part(0.0..0.5).rest(0.5).await;
            let second = yielder.part(0.5..1.0);
            second.rest(0.5).await;
            second.part(0.6..1.0).rest(0.5).await;
        });
        for expected in [0.25, 0.75, 0.9] {
            let Progress::Working(fraction) = running.advance(Budget::new(Duration::ZERO)) else { panic!("done") };
            assert!((fraction - expected).abs() < 1e-6, "{fraction}, not {expected}");
        }
        assert_eq!(running.advance(Budget::new(Duration::ZERO)), Progress::Done(()));
    }
}
