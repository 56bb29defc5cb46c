//! Work on all cores: natively by `rayon`, in the browser one after another.
//!
//! What is computed must not depend on how it is divided: chunks have a size that the caller fixes, each is worked on
//! by itself, and results come back in the order of the chunks. So the same input gives the same bytes with any number
//! of threads. That number is rayon's: all cores, or what the environment variable `RAYON_NUM_THREADS` says, or what
//! [`with_threads`] asks for.

#[cfg(not(target_arch = "wasm32"))]
mod native;
#[cfg(target_arch = "wasm32")]
mod sequential;

use std::ops::Range;

#[cfg(not(target_arch = "wasm32"))]
pub use native::{map, threads, with_threads};
#[cfg(target_arch = "wasm32")]
pub use sequential::{map, threads, with_threads};

/// Calls `work` with each chunk of `items` and the index of its first item. Chunks have `chunk` items, the last one
/// what is left.
///
/// # Panics
/// When `chunk` is 0.
pub fn for_each_chunk_mut<T: Send>(items: &mut [T], chunk: usize, work: impl Fn(usize, &mut [T]) + Sync + Send) {
    let chunks: Vec<(usize, &mut [T])> = items.chunks_mut(chunk).enumerate().map(|(i, c)| (i * chunk, c)).collect();
    map(chunks, |(first, items)| work(first, items));
}

/// What `work` makes of each range of `chunk` numbers in `0..count`, the last one shorter, in their order.
///
/// # Panics
/// When `chunk` is 0.
pub fn map_ranges<R: Send>(count: usize, chunk: usize, work: impl Fn(Range<usize>) -> R + Sync + Send) -> Vec<R> {
    let ranges: Vec<Range<usize>> = (0..count).step_by(chunk).map(|i| i..(i + chunk).min(count)).collect();
    map(ranges, work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_cover_everything_once_and_results_keep_their_order_with_any_number_of_threads() {
        for count in [0, 1, 6, 7, 8, 1000] {
            for number in [1, 2, 7] {
                let mut items = vec![0usize; count];
                let ranges = with_threads(number, || {
                    for_each_chunk_mut(&mut items, 7, |first, chunk| {
                        for (i, item) in chunk.iter_mut().enumerate() {
                            *item += first + i;
                        }
                    });
                    map_ranges(count, 7, |range| range)
                });
                assert!(items.iter().enumerate().all(|(i, &item)| item == i));
                assert!(ranges.iter().flat_map(Clone::clone).eq(0..count));
                assert!(ranges.iter().all(|range| range.len() == 7 || range.end == count));
            }
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    #[test]
    fn as_many_threads_work_as_were_asked_for() {
        for number in [1, 2, 7] {
            assert_eq!(with_threads(number, threads), number);
        }
    }
}
