//! How much of a run is left, by what its parts took the last time.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

use crate::step::target;

/// The parts of a run, in seconds.
type Parts = BTreeMap<String, f64>;

/// The clock of a run.
pub(crate) struct Estimate {
    file: PathBuf,
    last: Parts,
    now: Parts,
    /// The part under way.
    part: Option<(String, Instant)>,
}

impl Estimate {
    /// Of the run called `name`, whose last times are in the target directory.
    pub(crate) fn new(name: &str) -> Self {
        let file = target().join(format!("{name}-times.json"));
        let last = std::fs::read(&file).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
        Self { file, last, now: Parts::new(), part: None }
    }

    /// The part called `name` begins; another that was under way is over.
    pub(crate) fn begin(&mut self, name: &str) {
        self.end();
        self.part = Some((name.to_owned(), Instant::now()));
    }

    /// What is under way is over.
    pub(crate) fn end(&mut self) {
        if let Some((name, begun)) = self.part.take() {
            self.now.insert(name, begun.elapsed().as_secs_f64());
        }
    }

    /// What is left, for people; `None` where no run has been before.
    pub(crate) fn left(&self) -> Option<String> {
        let is_open = |name: &&String| !self.now.contains_key(*name);
        let under_way = self.part.as_ref().map_or(0.0, |(name, begun)| {
            self.last.get(name).copied().unwrap_or(0.0).min(begun.elapsed().as_secs_f64())
        });
        let seconds = self.last.keys().filter(is_open).map(|name| self.last[name]).sum::<f64>() - under_way;
        (!self.last.is_empty()).then(|| match seconds {
            seconds if seconds < 1.0 => "nearly done".to_owned(),
            seconds if seconds < 90.0 => format!("about {} s left", (seconds / 5.0).ceil() * 5.0),
            seconds => format!("about {:.0} min left", seconds / 60.0),
        })
    }

    /// Keeps the times for the next run.
    pub(crate) fn keep(mut self) {
        self.end();
        // Without them the next run has no estimate, which is no harm.
        let _ = serde_json::to_vec(&self.now).map(|bytes| std::fs::write(&self.file, bytes));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_what_was_not_done_yet() {
        let parts =
            |of: &[(&str, f64)]| of.iter().map(|&(name, seconds)| (name.to_owned(), seconds)).collect::<Parts>();
        let file = PathBuf::new();
        let mut run =
            Estimate { file, last: parts(&[("a", 100.0), ("b", 200.0), ("c", 20.0)]), now: Parts::new(), part: None };
        assert_eq!(run.left().as_deref(), Some("about 5 min left"));
        run.begin("a");
        run.begin("b");
        assert_eq!(run.left().as_deref(), Some("about 4 min left"));
        run.begin("something new");
        assert_eq!(run.left().as_deref(), Some("about 20 s left"));
        run.begin("c");
        run.end();
        assert_eq!(run.left().as_deref(), Some("nearly done"));
        run.last.clear();
        assert_eq!(run.left(), None, "no run has been before");
    }
}
