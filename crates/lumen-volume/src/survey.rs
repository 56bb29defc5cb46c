//! What is in a volume: its range, its labels where it is a mask, and how often which value occurs.

use serde::{Deserialize, Serialize};

use super::grid::{Grid, LABEL_REACH};
use super::samples::{Sample, with_samples};
use lumen_mesh::task::{Yielder, at_once, blocks};

/// Bars of a histogram.
pub const BINS: usize = 256;
/// The most labels that a mask has beside 0; what has more values is a scan, as one of 8 bits is.
const MAX_LABELS: usize = 64;
/// By so much a label may lie beside its whole number, and by this part of it.
const BESIDE: f64 = 0.02;
/// Numbers that are looked at between two looks at the clock.
const STRETCH: usize = 1 << 18;

/// What is in a volume.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Survey {
    /// The smallest and the largest value that are numbers; both 0 where there is none.
    pub range: [f64; 2],
    /// How many values lie in each of [`BINS`] equal parts of the range.
    pub histogram: Vec<u64>,
    /// The whole numbers from 0 to 65,535 that a mask is made of, or lies next to, ascending, 0 left out; none where it is a scan.
    pub labels: Vec<Label>,
}

/// A label of a mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Label {
    /// Its number.
    pub value: i64,
    /// How many points have it.
    pub points: u64,
}

impl Survey {
    /// Whether it is a mask: few whole numbers.
    pub fn is_mask(&self) -> bool {
        !self.labels.is_empty()
    }

    /// Whether values reach down to where only the air of a CT is, which has -1000 HU: most files do not say that they are
    /// of CT.
    pub fn has_air(&self) -> bool {
        const AIR_HU: f64 = -500.0;
        self.range[0] <= AIR_HU
    }
}

/// What is in `grid`.
pub fn survey(grid: &Grid) -> Survey {
    at_once(survey_in_slices(grid, &Yielder::never()))
}

/// As [`survey`], resting every millisecond or so: a pass for range and labels, and one for the histogram.
pub async fn survey_in_slices(grid: &Grid, yielder: &Yielder) -> Survey {
    let all = grid.samples().len();
    let mut stored = [f64::INFINITY, f64::NEG_INFINITY];
    // Every stored number so far and how often; `None` once there are too many.
    let mut values = Some(Vec::new());
    for block in blocks(all, STRETCH) {
        let end = block.end;
        with_samples!(grid.samples(), samples => collect(&samples[block], &mut stored, &mut values));
        yielder.rest(0.5 * end as f32 / all as f32).await;
    }
    let ends = stored.map(|stored| grid.value_of(stored));
    let is_empty = stored[0] > stored[1];
    let range = if is_empty { [0.0; 2] } else { [ends[0].min(ends[1]), ends[0].max(ends[1])] };
    let mut histogram = vec![0; BINS];
    for block in blocks(all, STRETCH) {
        let end = block.end;
        with_samples!(grid.samples(), samples => count(&samples[block], grid, range, &mut histogram));
        yielder.rest(0.5 + 0.5 * end as f32 / all as f32).await;
    }
    Survey { range, histogram, labels: labels(grid, &values.unwrap_or_default()) }
}

/// The labels of a mask in which each of these stored numbers is so often; none where they are those of a scan. A slope that was
/// rounded leaves labels beside their whole numbers: by half of it, where it was made to fit them into few numbers.
fn labels(grid: &Grid, values: &[(f64, u64)]) -> Vec<Label> {
    let slope = (grid.value_of(1.0) - grid.value_of(0.0)).abs();
    let beside = if slope < 0.5 { BESIDE.max(0.5 * slope) } else { BESIDE };
    let mut values: Vec<(f64, u64)> = values.iter().map(|&(stored, points)| (grid.value_of(stored), points)).collect();
    values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let whole = |value: f64| libm::round(value);
    let is_label = |value: f64| {
        let beside = beside.max(BESIDE * value).min(LABEL_REACH);
        (0.0..=65_535.0).contains(&whole(value)) && (value - whole(value)).abs() <= beside
    };
    let is_one = |a: f64, b: f64| whole(a) != whole(b) || b - a <= BESIDE;
    // Without anything around it there is no mask.
    let has_both = matches!(&values[..], [(low, _), .., (high, _)] if whole(*low) == 0.0 && whole(*high) > 0.0);
    let is_mask = has_both
        && values.iter().all(|&(value, _)| is_label(value))
        && values.windows(2).all(|two| is_one(two[0].0, two[1].0));
    let label = |group: &[(f64, u64)]| Label {
        value: whole(group[0].0) as i64,
        points: group.iter().map(|(_, points)| points).sum(),
    };
    let groups = values.chunk_by(|a, b| whole(a.0) == whole(b.0)).filter(|_| is_mask);
    groups.map(label).filter(|label| label.value != 0).collect()
}

/// Widens the range by some stored numbers, and counts them while they are few.
fn collect<S: Sample>(stored: &[S], [low, high]: &mut [f64; 2], values: &mut Option<Vec<(f64, u64)>>) {
    let mut last = usize::MAX;
    for value in stored.iter().map(|value| value.to_f64()).filter(|value| value.is_finite()) {
        *low = low.min(value);
        *high = high.max(value);
        if let Some(known) = values {
            // Neighbours are mostly alike.
            if known.get(last).is_none_or(|&(known, _)| known != value) {
                last = known.iter().position(|&(known, _)| known == value).unwrap_or_else(|| {
                    known.push((value, 0));
                    known.len() - 1
                });
            }
            known[last].1 += 1;
            if known.len() > MAX_LABELS + 1 {
                *values = None;
            }
        }
    }
}

/// Counts some stored numbers in equal parts of the range.
fn count<S: Sample>(stored: &[S], grid: &Grid, [low, high]: [f64; 2], bins: &mut [u64]) {
    let width = (high - low).max(f64::MIN_POSITIVE);
    let scale = bins.len() as f64 / width;
    let last = bins.len() - 1;
    for value in stored.iter().map(|value| value.to_f64()).filter(|value| value.is_finite()) {
        bins[(((grid.value_of(value) - low) * scale) as usize).min(last)] += 1;
    }
}
