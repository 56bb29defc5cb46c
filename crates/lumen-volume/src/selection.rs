//! What of a volume is the vessel: all that reaches a threshold, one label of a mask, or all of a mask.

use std::ops::Range;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::connected::{Bits, connected};
use super::error::{Known, VolumeError};
use super::geometry::Region;
use super::grid::Grid;
use super::marching_cubes::Mask;
use super::samples::{Sample, with_samples};
use super::survey::Survey;
use lumen_mesh::task::Yielder;
use lumen_message::messages;

/// What lies inside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Selection {
    /// Values from this one on, in the volume's own unit (Hounsfield units for CT).
    Threshold(f64),
    /// This label of a mask.
    Label(i64),
    /// Every label of a mask but 0, as one body.
    AnyLabel,
    /// Every label of a mask but 0, with the borders between them where the surface is one of nets; else as one body.
    EachLabel,
}

messages! {
    /// What a threshold shows.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PresetName {
        /// Vessels that are hardly brighter than what is around them.
        "scan-preset-little" Little => "for vessels with little contrast",
        /// Arteries of the body.
        "scan-preset-arteries" Arteries => "for arteries",
        /// The aorta, and the arteries of the heart, without the veins.
        "scan-preset-aorta" Aorta => "for the aorta and the coronary arteries",
    }
}

/// A threshold with a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// What it shows.
    pub name: PresetName,
    /// Hounsfield units.
    pub value: f64,
}

/// Thresholds for contrast-filled vessels in CT. Blood with contrast has 200 to 500 HU in the arterial phase, muscle 50,
/// and half way between is where the wall is; spongy bone has 200 HU and more and comes along.
pub const PRESETS: [Preset; 3] = [
    Preset { name: PresetName::Little, value: 130.0 },
    Preset { name: PresetName::Arteries, value: 180.0 },
    Preset { name: PresetName::Aorta, value: 250.0 },
];

messages! {
    /// A threshold with its name, as it stands in a sentence.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum NamedThreshold {
        /// As [`Preset`].
        "scan-preset" Preset {
            /// Hounsfield units.
            value: f64,
            /// What it shows.
            name: PresetName,
        } => "{value} {name}",
    }
}

messages! {
    /// Thresholds of which one may be meant.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Presets {
        /// All [`PRESETS`].
        "scan-presets" All {
            /// The lowest.
            first: NamedThreshold,
            /// The next.
            second: NamedThreshold,
            /// The highest.
            third: NamedThreshold,
        } => "{first}, {second}, {third}",
    }
}

/// That a threshold is wanted of a scan with values from `low` to `high`.
fn nothing_chosen([low, high]: [f64; 2]) -> VolumeError {
    let [first, second, third] = PRESETS.map(|Preset { name, value }| NamedThreshold::Preset { value, name });
    VolumeError::NothingChosen { low, high, presets: Presets::All { first, second, third } }
}

impl Selection {
    /// What is meant by a threshold or a label, if either is given; with neither a mask is all that is not 0.
    ///
    /// # Errors
    /// [`VolumeError`]: neither is given for a scan, no value reaches the threshold or every one does, there is no such
    /// label.
    pub fn choose(survey: &Survey, threshold: Option<f64>, label: Option<i64>) -> Result<Self, VolumeError> {
        let selection = match (threshold, label) {
            (Some(threshold), _) => Self::Threshold(threshold),
            (None, Some(label)) => Self::Label(label),
            (None, None) if survey.is_mask() => Self::AnyLabel,
            (None, None) => return Err(nothing_chosen(survey.range)),
        };
        selection.check(survey)?;
        Ok(selection)
    }

    /// Whether there can be a surface of it.
    ///
    /// # Errors
    /// [`VolumeError::OutsideRange`] and [`VolumeError::NoSuchLabel`].
    pub fn check(self, survey: &Survey) -> Result<(), VolumeError> {
        let [low, high] = survey.range;
        match self {
            // What is no number is in no range.
            Self::Threshold(threshold) if !(low < threshold && threshold <= high) => {
                Err(VolumeError::OutsideRange { threshold, low, high })
            }
            // What has too many values to be told as a mask may be one of a whole body.
            Self::Label(label) if !survey.is_mask() && (low..=high).contains(&(label as f64)) => Ok(()),
            Self::Label(label) if !survey.labels.iter().any(|known| known.value == label) => {
                let labels: Vec<String> = survey.labels.iter().map(|label| label.value.to_string()).collect();
                let known = match labels.len() {
                    0 => Known::Range { low, high },
                    _ => Known::Labels { labels: labels.join(", ") },
                };
                Err(VolumeError::NoSuchLabel { label, known })
            }
            _ => Ok(()),
        }
    }
}

/// A selection of a part of a volume, as marching cubes ask for it.
pub(super) struct Selected {
    grid: Arc<Grid>,
    region: Region,
    test: Test,
    has_each_label: bool,
    /// Where only a part is: the voxels of it.
    connected: Option<Bits>,
    k: usize,
    /// Kept for the next row.
    runs: Vec<Range<usize>>,
}

/// A selection in terms of the stored numbers.
#[derive(Clone, Copy, Debug)]
enum Test {
    AtLeast(f64),
    AtMost(f64),
    Within([f64; 2]),
    Outside([f64; 2]),
}

impl Selected {
    /// The part within `region`, which must be within the grid.
    pub(super) fn new(grid: Arc<Grid>, selection: Selection, region: Region) -> Self {
        let test = match selection {
            Selection::Threshold(value) if grid.is_inverted() => Test::AtMost(grid.stored_for(value)),
            Selection::Threshold(value) => Test::AtLeast(grid.stored_for(value)),
            Selection::Label(label) => Test::Within(grid.stored_for_label(label as f64)),
            Selection::AnyLabel | Selection::EachLabel => Test::Outside(grid.stored_for_label(0.0)),
        };
        Self {
            grid,
            region,
            test,
            has_each_label: selection == Selection::EachLabel,
            connected: None,
            k: 0,
            runs: Vec::new(),
        }
    }

    /// Only what is connected to a voxel of the region, from 0.
    ///
    /// # Errors
    /// [`VolumeError::SeedOutside`].
    pub(super) async fn connected_to(mut self, seed: [usize; 3], yielder: &Yielder) -> Result<Self, VolumeError> {
        self.connected = Some(connected(&self, seed, yielder).await?);
        Ok(self)
    }

    /// Voxels along the axes.
    pub(super) fn size(&self) -> [usize; 3] {
        self.region.size()
    }

    /// The value of a voxel of the region.
    pub(super) fn value(&self, point: [usize; 3]) -> f64 {
        self.grid.value_of(self.grid.samples().stored(self.index(point)))
    }

    /// Whether a voxel of the region is of the selection, connected or not.
    pub(super) fn is_inside(&self, point: [usize; 3]) -> bool {
        let value = self.grid.samples().stored(self.index(point));
        match self.test {
            Test::AtLeast(bound) => value >= bound,
            Test::AtMost(bound) => value <= bound,
            Test::Within([low, high]) => low <= value && value <= high,
            Test::Outside([low, high]) => value < low || high < value,
        }
    }

    /// The labels of slice `k`, i running fastest: what is outside has 0, what is inside its own if each is asked for, else 1.
    pub(super) fn labels(&mut self, k: usize, labels: &mut [u16]) {
        self.begin_slice(k);
        labels.fill(0);
        let mut runs = std::mem::take(&mut self.runs);
        for (j, row) in labels.chunks_exact_mut(self.region.size()[0]).enumerate() {
            runs.clear();
            self.row(j, &mut runs);
            for run in &runs {
                row[run.clone()].fill(1);
                if self.has_each_label {
                    let start = self.index([0, j, k]);
                    for i in run.clone() {
                        row[i] = libm::round(self.grid.value_of(self.grid.samples().stored(start + i))) as u16;
                    }
                }
            }
        }
        self.runs = runs;
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        let [first_i, first_j, first_k] = self.region.first;
        self.grid.index([first_i + i, first_j + j, first_k + k])
    }
}

/// How near to a voxel the surface comes, as a part of the way to the next: where a value is the threshold itself, as whole
/// numbers often are, all vertices around that voxel would be one, and thin vessels fall together.
const MIN_FRACTION: f64 = 2e-4;

impl Mask for Selected {
    const CLOSED: bool = false;

    fn begin_slice(&mut self, k: usize) {
        self.k = k;
    }

    fn row(&mut self, j: usize, runs: &mut Vec<Range<usize>>) {
        let first = self.index([0, j, self.k]);
        let known = runs.len();
        let row = first..first + self.region.size()[0];
        with_samples!(self.grid.samples(), values => {
            let values = &values[row];
            match self.test {
                Test::AtLeast(bound) => runs_where(values, runs, |value| value >= bound),
                Test::AtMost(bound) => runs_where(values, runs, |value| value <= bound),
                Test::Within([low, high]) => runs_where(values, runs, |value| low <= value && value <= high),
                Test::Outside([low, high]) => runs_where(values, runs, |value| value < low || high < value),
            }
        });
        if let Some(connected) = &self.connected {
            // A run is connected in itself.
            let [nx, ny, _] = self.region.size();
            let row = (self.k * ny + j) * nx;
            let mut kept = known;
            for n in known..runs.len() {
                if connected.has(row + runs[n].start) {
                    runs.swap(kept, n);
                    kept += 1;
                }
            }
            runs.truncate(kept);
        }
    }

    fn crossing(&self, point: [usize; 3], axis: usize) -> f64 {
        let (Test::AtLeast(bound) | Test::AtMost(bound)) = self.test else { return 0.5 };
        let mut next = point;
        next[axis] += 1;
        let samples = self.grid.samples();
        let (here, there) = (samples.stored(self.index(point)), samples.stored(self.index(next)));
        let along = (bound - here) / (there - here);
        // Beside a number that is none there is nothing to interpolate.
        if (0.0..=1.0).contains(&along) { along.clamp(MIN_FRACTION, 1.0 - MIN_FRACTION) } else { 0.5 }
    }
}

/// Appends the runs of values that are inside.
fn runs_where<S: Sample>(values: &[S], runs: &mut Vec<Range<usize>>, is_inside: impl Fn(f64) -> bool) {
    let mut start = None;
    for (i, value) in values.iter().enumerate() {
        match (is_inside(value.to_f64()), start) {
            (true, None) => start = Some(i),
            (false, Some(from)) => {
                runs.push(from..i);
                start = None;
            }
            _ => {}
        }
    }
    runs.extend(start.map(|from| from..values.len()));
}
