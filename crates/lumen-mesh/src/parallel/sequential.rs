//! One after another: the browser's Worker has no threads to share its memory with.

/// Number of threads that share the work: one.
pub fn threads() -> usize {
    1
}

/// Runs `work`; there is one thread whatever `_number` says.
pub fn with_threads<R: Send>(_number: usize, work: impl FnOnce() -> R + Send) -> R {
    work()
}

/// What `work` makes of each item, in their order.
pub fn map<T: Send, R: Send>(items: Vec<T>, work: impl Fn(T) -> R + Sync + Send) -> Vec<R> {
    items.into_iter().map(work).collect()
}
