//! The radius of a stretch of a vessel as long as the vessel is wide, from the areas of its cross-sections.

use super::StationStatus;
use crate::calibre::Calibre;
use crate::stations::Station;
use crate::width::circle;

/// Least half length of the stretch that a radius is of, in mean edges.
const WINDOW_EDGES: f64 = 4.0;
/// The least part of the mean over its stretch that an area can be.
const MIN_OF_MEAN: f64 = 0.25;

/// What a vessel has over a stretch around a station.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    /// Radius of the circle of the area at the station, by the line of least squares, in mm.
    pub(super) radius: f64,
    /// Of the circle of the mean area, in mm.
    pub(super) mean: f64,
}

/// What a branch has around each station on one of the surfaces, over stations of one vessel, where all surfaces have an
/// area: so all are judged over the same. At the station alone where it is not one vessel.
pub(super) fn stretches(
    stations: &[Station],
    of: &[Calibre],
    opened: &[Calibre],
    standings: &[StationStatus],
    edge_mm: f64,
) -> Vec<Option<Stretch>> {
    let is_vessel = |i: usize| matches!(standings[i], StationStatus::Counts | StationStatus::Thin);
    let one = |i: usize| {
        let own = of[i].area_mm2?;
        if !is_vessel(i) {
            return Some(Stretch { radius: circle(own), mean: circle(own) });
        }
        let reach = circle(opened[i].area_mm2?).max(WINDOW_EDGES * edge_mm);
        let (mut line, mut as_opened) = (Line::default(), Line::default());
        let mut add = |k: usize| {
            let from = stations[k].abscissa_mm - stations[i].abscissa_mm;
            let weight = 1.0 - from.abs() / reach.max(f64::MIN_POSITIVE);
            let Some(area) = of[k].area_mm2.filter(|_| weight > 0.0) else { return false };
            line.add(from, area, weight);
            as_opened.add(from, opened[k].area_mm2.unwrap_or(area), weight);
            true
        };
        // As far on either side as it is one vessel.
        let before = (0..i).rev().take_while(|&k| is_vessel(k));
        let after = (i..stations.len()).take_while(|&k| is_vessel(k));
        for k in before {
            if !add(k) {
                break;
            }
        }
        for k in after {
            if !add(k) {
                break;
            }
        }
        // A line that comes down to nothing says nothing: then the mean does, on all surfaces alike.
        let is_line = as_opened.at_origin() >= MIN_OF_MEAN * as_opened.mean();
        let area = if is_line { line.at_origin().max(0.0) } else { line.mean() };
        Some(Stretch { radius: circle(area), mean: circle(line.mean()) })
    };
    (0..stations.len()).map(one).collect()
}

/// The line through weighted points that is nearest to them (local linear regression).
#[derive(Default)]
struct Line {
    weights: f64,
    first: f64,
    second: f64,
    sum: f64,
    moment: f64,
}

impl Line {
    fn add(&mut self, x: f64, y: f64, weight: f64) {
        self.weights += weight;
        self.first += weight * x;
        self.second += weight * x * x;
        self.sum += weight * y;
        self.moment += weight * x * y;
    }

    /// The weighted mean of the heights.
    fn mean(&self) -> f64 {
        self.sum / self.weights
    }

    /// Its height at x = 0.
    fn at_origin(&self) -> f64 {
        let determinant = self.weights * self.second - self.first * self.first;
        if determinant > 1e-9 * self.weights * self.second {
            (self.second * self.sum - self.first * self.moment) / determinant
        } else {
            self.mean()
        }
    }
}
