//! The layers of a segmentation: maps of labels that lie in each other, as segments that overlap need.
//!
//! Where none overlap they become one map. Where they do no map can hold them, and each layer is a volume of its own.

use std::collections::BTreeMap;

use super::super::offer::{LabelName, Offer, VolumeField};
use super::super::problem::ScanProblem;
use super::error::ScanError;
use super::outline::Offers;
use lumen_volume::{SampleType, Samples};

/// A segment: a label of a layer.
pub(super) struct Segment {
    pub(super) layer: usize,
    pub(super) named: LabelName,
}

/// What a header says of the layers in its numbers, of which one of each follows the other.
pub(super) struct Layers {
    pub(super) count: usize,
    pub(super) segments: Vec<Segment>,
    /// The layer that is asked for.
    pub(super) choice: Option<usize>,
}

impl Default for Layers {
    fn default() -> Self {
        Self { count: 1, segments: Vec::new(), choice: None }
    }
}

/// The numbers of one map.
pub(super) struct Unfolded {
    pub(super) samples: Samples,
    pub(super) names: Vec<LabelName>,
    pub(super) offers: Offers,
    pub(super) taken: usize,
}

impl Layers {
    /// Makes one map out of the numbers of a file of this format, whose grid has so many slices.
    pub(super) fn unfold(self, samples: Samples, slices: usize, format: &'static str) -> Result<Unfolded, ScanError> {
        let (count, choice) = (self.count, self.choice);
        let points = samples.len() / count.max(1);
        let at = |point: usize, layer: usize| samples.stored(point * count + layer);
        let overlaps =
            count > 1 && (0..points).any(|point| (0..count).filter(|&layer| at(point, layer) != 0.0).count() > 1);
        let volumes = if overlaps { count } else { 1 };
        let taken = choice.unwrap_or(0);
        if taken >= volumes {
            return Err(ScanError::NoSuchVolume { number: taken + 1, count: volumes });
        }
        if count <= 1 {
            let names = self.segments.into_iter().map(|segment| segment.named).collect();
            return Ok(Unfolded { samples, names, offers: Offers::default(), taken });
        }
        if overlaps {
            let map = map(samples.sample_type(), points, |point| at(point, taken))?;
            let offers = Offers { list: (0..count).map(|layer| self.offer(layer, slices)).collect() };
            let of_layer = self.segments.into_iter().filter(|segment| segment.layer == taken);
            let names = of_layer.map(|segment| segment.named).collect();
            return Ok(Unfolded { samples: map, names, offers, taken });
        }
        let numbers = self.numbers(&samples, format)?;
        let map = map(SampleType::U16, points, |point| {
            let mut inside = (0..count).map(|layer| (layer, at(point, layer)));
            let found = inside.find(|&(_, stored)| stored != 0.0);
            found.map_or(0.0, |(layer, stored)| numbers[layer].get(&stored.to_bits()).map_or(0.0, |&n| n.into()))
        })?;
        let number = |segment: &Segment| numbers[segment.layer].get(&(segment.named.value as f64).to_bits()).copied();
        let names = self.segments.iter().filter(|segment| segment.layer < count);
        let names =
            names.filter_map(|segment| Some(LabelName { value: number(segment)?.into(), ..segment.named.clone() }));
        let names = names.collect();
        Ok(Unfolded { samples: map, names, offers: Offers::default(), taken })
    }

    /// The number that each label of each layer has in one map: the label itself where no two layers have the same one and all are
    /// whole numbers of 16 bits, else its place among them, first those of segments and then others.
    fn numbers(&self, samples: &Samples, format: &'static str) -> Result<Vec<BTreeMap<u64, u16>>, ScanError> {
        let too_many = || ScanError::malformed(format, ScanProblem::ManyLabels { most: u16::MAX.into() });
        let mut numbers = vec![BTreeMap::new(); self.count];
        let mut labels: Vec<(usize, f64)> = Vec::new();
        let stored = (0..samples.len()).map(|at| (at % self.count, samples.stored(at)));
        let of_segments = self.segments.iter().map(|segment| (segment.layer, segment.named.value as f64));
        for (layer, label) in of_segments.filter(|&(layer, _)| layer < self.count).chain(stored) {
            if label != 0.0 && !numbers[layer].contains_key(&label.to_bits()) {
                labels.push((layer, label));
                let number = u16::try_from(labels.len()).map_err(|_| too_many())?;
                numbers[layer].insert(label.to_bits(), number);
            }
        }
        let mut sorted: Vec<f64> = labels.iter().map(|&(_, label)| label).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let is_number = |label: f64| (1.0..=f64::from(u16::MAX)).contains(&label) && label.fract() == 0.0;
        let is_clear = sorted.iter().all(|&label| is_number(label)) && sorted.windows(2).all(|two| two[0] != two[1]);
        if is_clear {
            for (layer, label) in labels {
                numbers[layer].insert(label.to_bits(), label as u16);
            }
        }
        Ok(numbers)
    }

    /// What a layer is told by: its number and its segments.
    fn offer(&self, layer: usize, slices: usize) -> Offer {
        let names =
            self.segments.iter().filter(|segment| segment.layer == layer).map(|segment| segment.named.name.as_str());
        let value = std::iter::once((layer + 1).to_string()).chain(names.map(str::to_owned));
        Offer { series: 0, slices, by: Some(VolumeField::Layer), value: value.collect::<Vec<_>>().join(" ") }
    }
}

fn map(kind: SampleType, points: usize, of: impl Fn(usize) -> f64) -> Result<Samples, ScanError> {
    let mut samples = Samples::new(kind);
    let bytes = (points * kind.size()) as u64;
    samples.try_reserve(points).map_err(|_| ScanError::Memory { bytes })?;
    (0..points).for_each(|point| samples.push(of(point)));
    Ok(samples)
}
