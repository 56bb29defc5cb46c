//! The report of `benches/peers/run.py`.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result, ensure};
use serde::Deserialize;

/// All of it.
#[derive(Debug, Deserialize)]
pub(crate) struct Report {
    pub(crate) machine: Machine,
    pub(crate) versions: BTreeMap<String, String>,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) memory: Vec<Memory>,
}

/// Where it was measured.
#[derive(Debug, Deserialize)]
pub(crate) struct Machine {
    pub(crate) cpu: String,
    pub(crate) cores: usize,
    pub(crate) system: String,
}

/// One surface of the bench.
#[derive(Debug, Deserialize)]
pub(crate) struct Surface {
    pub(crate) name: String,
    /// How often each contender ran.
    pub(crate) runs: usize,
    /// Triangles that enter decimation.
    pub(crate) triangles: usize,
    /// Milliseconds of each run, by what was timed.
    pub(crate) ms: BTreeMap<String, Vec<f64>>,
    /// What Lumen was run with and came to, by method.
    pub(crate) lumen: BTreeMap<String, Made>,
    /// The level's fingerprint in the browser, by method; none where the browser was left out.
    #[serde(default)]
    pub(crate) wasm_fingerprints: BTreeMap<String, String>,
    pub(crate) quality: Vec<Quality>,
}

/// A level at 90 %.
#[derive(Debug, Deserialize)]
pub(crate) struct Made {
    pub(crate) settings: serde_json::Value,
    pub(crate) fingerprint: String,
}

/// What reduction costs after one setting of the filter.
#[derive(Debug, Deserialize)]
pub(crate) struct Quality {
    pub(crate) pass_band: f64,
    pub(crate) iterations: u32,
    pub(crate) rows: Vec<Reduced>,
}

/// One method at one rate, measured by others than Lumen; distances in mm.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Reduced {
    pub(crate) rate: u32,
    pub(crate) method: String,
    pub(crate) triangles: usize,
    pub(crate) mean: f64,
    pub(crate) rms: f64,
    pub(crate) max: f64,
    pub(crate) volume_percent: f64,
    pub(crate) slivers_percent: f64,
    pub(crate) self_intersecting: usize,
    pub(crate) pieces: usize,
    pub(crate) non_manifold: usize,
    pub(crate) euler: i64,
}

/// Bytes that one file took.
#[derive(Debug, Deserialize)]
pub(crate) struct Memory {
    pub(crate) file: String,
    pub(crate) triangles: usize,
    /// Peak of `lumen optimise`, the whole process.
    pub(crate) native: u64,
    /// Of the page's and the Worker's WebAssembly memory; none where the browser was left out.
    pub(crate) page: Option<u64>,
    pub(crate) worker: Option<u64>,
    /// From the file dialog to the last number.
    pub(crate) seconds: Option<f64>,
}

impl Report {
    /// Reads a report and checks that it can be summed up.
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let report: Self = serde_json::from_str(text).context("this is no report of the peers")?;
        for surface in &report.surfaces {
            for (what, ms) in &surface.ms {
                ensure!(ms.len() == surface.runs, "{}: {what} has {} of {} runs", surface.name, ms.len(), surface.runs);
                ensure!(ms.iter().all(|ms| ms.is_finite() && *ms >= 0.0), "{}: {what} is no time", surface.name);
            }
        }
        Ok(report)
    }
}

impl Surface {
    /// Median and minimum of the sum of some times, run by run; `None` where one of them was not taken.
    pub(crate) fn sum(&self, what: &[(f64, &str)]) -> Option<Time> {
        let parts: Vec<(f64, &Vec<f64>)> =
            what.iter().map(|(times, key)| Some((*times, self.ms.get(*key)?))).collect::<Option<_>>()?;
        let runs = parts.iter().map(|(_, ms)| ms.len()).min()?;
        let mut sums: Vec<f64> = (0..runs).map(|run| parts.iter().map(|(times, ms)| times * ms[run]).sum()).collect();
        sums.sort_by(f64::total_cmp);
        let middle = sums.len() / 2;
        let median = if sums.len() % 2 == 1 { sums[middle] } else { (sums[middle - 1] + sums[middle]) / 2.0 };
        Some(Time { median, min: sums[0] })
    }
}

/// Milliseconds of some runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Time {
    pub(crate) median: f64,
    pub(crate) min: f64,
}
