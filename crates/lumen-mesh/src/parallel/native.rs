//! All cores, by `rayon`.

use rayon::prelude::*;

/// Number of threads that share the work.
pub fn threads() -> usize {
    rayon::current_num_threads()
}

/// Runs `work` with `number` threads (0: all cores) for what it does in parallel.
///
/// # Panics
/// When the system refuses that many threads.
pub fn with_threads<R: Send>(number: usize, work: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(number).build().expect("the system has threads to give");
    pool.install(work)
}

/// What `work` makes of each item, in their order.
pub fn map<T: Send, R: Send>(items: Vec<T>, work: impl Fn(T) -> R + Sync + Send) -> Vec<R> {
    if items.len() < 2 || threads() < 2 {
        return items.into_iter().map(work).collect();
    }
    items.into_par_iter().with_max_len(1).map(work).collect()
}
