//! What a benchmark found, beside what it should have: checked at its end, and written down for `cargo xtask
//! validation` where `LUMEN_VALIDATION` names a folder.

use std::fmt::Write as _;
use std::path::PathBuf;

/// What is still right.
#[derive(Clone, Copy)]
pub(crate) enum Tolerance {
    /// The part of the answer by which it may differ.
    Part(f64),
    /// By how much it may differ, in its unit.
    Within(f64),
    /// From where to where it may lie, in its unit; for answers that are published as a band.
    Band(f64, f64),
    /// A band that is known to be missed, and where what was found lies instead: better or worse than that, the miss is
    /// to be told anew.
    Missed {
        /// From where on it would be right.
        least: f64,
        /// Up to where.
        most: f64,
        /// From where to where it is.
        found: [f64; 2],
    },
}

use Tolerance::{Band, Missed, Part, Within};

/// One benchmark.
pub(crate) struct Benchmark {
    name: &'static str,
    rows: String,
    points: String,
    wrong: Vec<String>,
}

impl Benchmark {
    pub(crate) fn new(name: &'static str) -> Self {
        Self {
            name,
            rows: "what,analytic,ours,tolerance,elements\n".into(),
            points: "series,kind,x,y\n".into(),
            wrong: Vec::new(),
        }
    }

    /// Compares one answer; `elements` is 0 where their number says nothing.
    pub(crate) fn compare(&mut self, what: &str, analytic: f64, ours: f64, tolerance: Tolerance, elements: usize) {
        assert!(!what.contains(','), "{what}: a comma parts columns");
        let (is_right, told) = match tolerance {
            Part(part) => ((ours - analytic).abs() <= part * analytic.abs(), format!("{} %", 100.0 * part)),
            Within(most) => ((ours - analytic).abs() <= most, format!("{most:e}")),
            Band(least, most) => ((least..=most).contains(&ours), format!("{least} to {most}")),
            Missed { least, most, found: [from, to] } => {
                let is_missed = !(least..=most).contains(&ours);
                (is_missed && (from..=to).contains(&ours), format!("{least} to {most}: **missed**"))
            }
        };
        let _ = writeln!(self.rows, "{what},{analytic},{ours},{told},{elements}");
        println!("{}: {what}: {ours} for {analytic} ({told}), {:+.4} %", self.name, 100.0 * (ours / analytic - 1.0));
        if !is_right {
            self.wrong.push(format!("{what}: {ours} for {analytic}, tolerance {told}"));
        }
    }

    /// The order with which errors fall from each number of elements to its double, and what it should be at least.
    pub(crate) fn order(&mut self, errors: &[(usize, f64)], least: f64) {
        for &(elements, error) in errors {
            self.point("error", elements as f64, error.abs());
        }
        for pair in errors.windows(2) {
            let order = (pair[0].1 / pair[1].1).abs().log2();
            let what = format!("order of convergence from {} to {} elements", pair[0].0, pair[1].0);
            self.compare(&what, 2.0, order, Band(least, 4.0), pair[1].0);
        }
    }

    /// A point of what was found, for the plot.
    pub(crate) fn point(&mut self, series: &str, x: f64, y: f64) {
        let _ = writeln!(self.points, "{series},points,{x},{y}");
    }

    /// A point of the analytic answer's curve.
    pub(crate) fn curve(&mut self, series: &str, x: f64, y: f64) {
        let _ = writeln!(self.points, "{series},line,{x},{y}");
    }

    /// A single point of the analytic answer.
    pub(crate) fn mark(&mut self, series: &str, x: f64, y: f64) {
        let _ = writeln!(self.points, "{series},mark,{x},{y}");
    }

    /// Writes down what was found, then fails if any of it is wrong.
    pub(crate) fn finish(self) {
        if let Some(folder) = std::env::var_os("LUMEN_VALIDATION").map(PathBuf::from) {
            std::fs::create_dir_all(&folder).unwrap();
            std::fs::write(folder.join(format!("{}.rows.csv", self.name)), &self.rows).unwrap();
            std::fs::write(folder.join(format!("{}.points.csv", self.name)), &self.points).unwrap();
        }
        assert!(self.wrong.is_empty(), "{}: {}", self.name, self.wrong.join("; "));
    }
}
