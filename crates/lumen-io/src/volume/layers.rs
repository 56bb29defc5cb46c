//! The layers of a segmentation: maps of labels that lie in each other, as segments that overlap need.
//!
//! Where none overlap they become one map. Where they do no map can hold them, and each layer is a volume of its own.

use super::super::offer::{Offer, VolumeField};
use super::error::ScanError;
use super::outline::Offers;
use lumen_volume::{SampleType, Samples};

/// A segment: a label of a layer.
pub(super) struct Segment {
    pub(super) layer: usize,
    pub(super) label: i64,
    pub(super) name: String,
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
    pub(super) names: Vec<(i64, String)>,
    pub(super) offers: Offers,
    pub(super) taken: usize,
}

impl Layers {
    /// Makes one map out of the numbers, whose grid has so many slices.
    pub(super) fn unfold(self, samples: Samples, slices: usize) -> Result<Unfolded, ScanError> {
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
            let names = self.segments.into_iter().map(|segment| (segment.label, segment.name)).collect();
            return Ok(Unfolded { samples, names, offers: Offers::default(), taken });
        }
        if overlaps {
            let map = map(samples.sample_type(), points, |point| at(point, taken))?;
            let offers = Offers { list: (0..count).map(|layer| self.offer(layer, slices)).collect() };
            let of_layer = self.segments.into_iter().filter(|segment| segment.layer == taken);
            let names = of_layer.map(|segment| (segment.label, segment.name)).collect();
            return Ok(Unfolded { samples: map, names, offers, taken });
        }
        // A label may be there in several layers, for another segment in each: then they are counted.
        let labels: Vec<i64> = self.segments.iter().map(|segment| segment.label).collect();
        let is_clear = (1..labels.len()).all(|at| !labels[..at].contains(&labels[at]));
        let number = |at: usize| if is_clear { labels[at] } else { at as i64 + 1 };
        let label = |layer: usize, stored: f64| {
            let is_it = |segment: &Segment| segment.layer == layer && segment.label as f64 == stored;
            self.segments.iter().position(is_it).map_or(stored, |at| number(at) as f64)
        };
        let map = map(SampleType::U16, points, |point| {
            (0..count).map(|layer| label(layer, at(point, layer))).find(|&label| label != 0.0).unwrap_or(0.0)
        })?;
        let names = self.segments.iter().enumerate().map(|(at, segment)| (number(at), segment.name.clone())).collect();
        Ok(Unfolded { samples: map, names, offers: Offers::default(), taken })
    }

    /// What a layer is told by: its number and its segments.
    fn offer(&self, layer: usize, slices: usize) -> Offer {
        let names = self.segments.iter().filter(|segment| segment.layer == layer).map(|segment| segment.name.as_str());
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
