//! Which slices of a series are one volume: phases of a heart, times of a perfusion, echoes or acquisitions share a series.
//!
//! Slices are one volume where no two lie at the same place and their distances are even. Where they are not, the field is
//! looked for that takes them apart into volumes: temporal position, trigger time, echo, acquisition and so on, as dcm2niix
//! and 3D Slicer's loaders of DICOM compare them. A field that differs from slice to slice of one volume, as times do, takes
//! nothing apart by its values, but its order may: the slices run over the places once for each volume, or each place has
//! one of each. Of several fields the one that makes the fewest volumes is taken. Where none does, slices that are there twice
//! are left out; what then still shares a place is not mixed, but refused.

use std::cmp::Ordering;
use std::rc::Rc;

use dicom_core::Tag;

use super::super::super::offer::VolumeField;
use super::{SAME, Slice, UNEVEN, same_pixels, tags};

/// Fields whose values tell volumes apart, the plainest first.
const BY_VALUE: [(Tag, VolumeField); 21] = [
    (tags::TEMPORAL, VolumeField::Time),
    (tags::TEMPORAL_INDEX, VolumeField::Time),
    (tags::HEART_PHASE, VolumeField::HeartPhase),
    (tags::TRIGGER, VolumeField::Trigger),
    (tags::TRIGGER_DELAY, VolumeField::Trigger),
    (tags::TEMPORAL_OFFSET, VolumeField::Time),
    (tags::ECHO, VolumeField::Echo),
    (tags::ECHO_TIME, VolumeField::Echo),
    (tags::FRAME_ECHO_TIME, VolumeField::Echo),
    (tags::B_VALUE, VolumeField::BValue),
    (tags::IMAGE_TYPE, VolumeField::ImageType),
    (tags::FRAME_TYPE, VolumeField::ImageType),
    (tags::STACK, VolumeField::Stack),
    (tags::ACQUISITION, VolumeField::Acquisition),
    (tags::FRAME_ACQUISITION, VolumeField::Acquisition),
    (tags::THICKNESS, VolumeField::Thickness),
    (tags::KERNEL, VolumeField::Kernel),
    (tags::VOLTAGE, VolumeField::Voltage),
    (tags::REFERENCE_FRAME, VolumeField::ReferenceFrame),
    (tags::ACQUISITION_TIME, VolumeField::Moment),
    (tags::CONTENT_TIME, VolumeField::Moment),
];

/// Fields whose order does.
const BY_ORDER: [(Tag, VolumeField); 7] = [
    (tags::TRIGGER, VolumeField::Trigger),
    (tags::TRIGGER_DELAY, VolumeField::Trigger),
    (tags::ACQUISITION_MOMENT, VolumeField::Moment),
    (tags::FRAME_MOMENT, VolumeField::Moment),
    (tags::ACQUISITION_TIME, VolumeField::Moment),
    (tags::CONTENT_TIME, VolumeField::Moment),
    (tags::INSTANCE, VolumeField::Order),
];

/// Fields in fields: echoes of phases.
const DEEPEST: usize = 3;

/// The slices of one volume, from below.
pub(super) struct Volume<'f, 'a> {
    /// Segments that overlap share the slices of all of them.
    pub(super) slices: Rc<[Slice<'f, 'a>]>,
    /// How many places they have.
    pub(super) places: usize,
    /// What tells it from the others of its series, and what it has there.
    pub(super) by: Option<(VolumeField, String)>,
    /// The segment that it is of, where the slices are of several.
    pub(super) segment: Option<u16>,
    /// Slices that are there twice and were left out.
    pub(super) twice: usize,
    /// Places at which slices lie that differ, and that nothing tells apart.
    pub(super) mixed: usize,
}

impl<'f, 'a> Volume<'f, 'a> {
    fn new(slices: Vec<Slice<'f, 'a>>, by: Option<(VolumeField, String)>, twice: usize, mixed: usize) -> Self {
        let places = places(&slices).count();
        Self { slices: slices.into(), places, by, segment: None, twice, mixed }
    }

    /// The slices that share a place with others.
    pub(super) fn shared(&self) -> impl Iterator<Item = &Slice<'f, 'a>> {
        places(&self.slices).filter(|place| place.len() > 1).flatten()
    }
}

/// Volumes that a field makes, each with what it has there.
type Split<'f, 'a> = (VolumeField, Vec<(String, Vec<Slice<'f, 'a>>)>);

/// Takes a series apart into its volumes.
pub(super) fn split<'f, 'a>(mut slices: Vec<Slice<'f, 'a>>) -> Vec<Volume<'f, 'a>> {
    by_height(&mut slices);
    let all = slices.len();
    slices.dedup_by(|a, b| is_same_file(a, b));
    // Without those that are there twice under another name; where that is all, nothing is to be taken apart for them.
    let mut single = slices.clone();
    single.dedup_by(|next, kept| has_same_fields(next, kept) && is_twin(next, kept));
    let only_twins = deepest_place(&single) == 1;
    let mut found = if only_twins { None } else { best(&slices, DEEPEST) };
    if found.is_none() {
        slices = single;
        found = best(&slices, DEEPEST);
    }
    if let Some((field, parts)) = found {
        let twice = all - slices.len();
        return parts.into_iter().map(|(value, part)| Volume::new(part, Some((field, value)), twice, 0)).collect();
    }
    slices.dedup_by(|next, kept| is_twin(next, kept));
    let (twice, mixed) = (all - slices.len(), places(&slices).filter(|place| place.len() > 1).count());
    vec![Volume::new(slices, None, twice, mixed)]
}

/// Whether two slices share a place and all of their pixels.
pub(super) fn is_twin(a: &Slice, b: &Slice) -> bool {
    (a.height - b.height).abs() < SAME && a.position.distance(b.position) < SAME && same_pixels(a, b)
}

fn has_same_fields(a: &Slice, b: &Slice) -> bool {
    BY_VALUE.iter().all(|&(tag, field)| field == VolumeField::Moment || Held::of(a, tag) == Held::of(b, tag))
}

fn by_height(slices: &mut [Slice]) {
    // Files of one name beside each other, to be found; else in the order of the series.
    let instance = |slice: &Slice| slice.file.number(slice.frame, tags::INSTANCE).unwrap_or_default();
    slices.sort_by(|a, b| {
        a.height
            .total_cmp(&b.height)
            .then_with(|| instance(a).total_cmp(&instance(b)))
            .then_with(|| a.file.text(tags::SOP_INSTANCE).cmp(&b.file.text(tags::SOP_INSTANCE)))
    });
}

/// Whether two slices are one, opened twice.
fn is_same_file(a: &Slice, b: &Slice) -> bool {
    let name = a.file.text(tags::SOP_INSTANCE);
    !name.is_empty() && name == b.file.text(tags::SOP_INSTANCE) && a.frame == b.frame
}

/// The way to take slices apart, which are in order of height, that makes the fewest volumes; `None` where they are one, or
/// nothing tells them apart.
fn best<'f, 'a>(slices: &[Slice<'f, 'a>], depth: usize) -> Option<Split<'f, 'a>> {
    let is_shared = deepest_place(slices) > 1;
    let by_value = BY_VALUE.into_iter().filter_map(|(tag, field)| Some((field, values(slices, tag, field)?)));
    let by_order = BY_ORDER.into_iter().flat_map(|(tag, field)| {
        [runs(slices, tag), ranks(slices, tag)].into_iter().flatten().map(move |parts| (field, parts))
    });
    let by_place = alternate(slices).map(|parts| (VolumeField::Place, parts));
    let is_apart = |(field, parts): &Split| {
        if is_shared { unshared(slices, *field, parts) } else { interleaved(slices, *field, parts) }
    };
    let found = by_value.chain(by_order).chain(by_place).filter(is_apart).min_by_key(|(_, parts)| parts.len());
    if found.is_some() || !is_shared || depth == 0 {
        return found;
    }
    let fields = BY_VALUE.into_iter().filter(|&(_, field)| field != VolumeField::Moment);
    fields.filter_map(|(tag, field)| nested(slices, values(slices, tag, field)?, depth)).next()
}

/// Volumes by a field and, within it, by another.
fn nested<'f, 'a>(
    slices: &[Slice<'f, 'a>],
    parts: Vec<(String, Vec<Slice<'f, 'a>>)>,
    depth: usize,
) -> Option<Split<'f, 'a>> {
    let mut all = Vec::new();
    if parts.iter().any(|(_, part)| deepest_place(part) == deepest_place(slices)) {
        return None;
    }
    for (outer, part) in parts {
        if deepest_place(&part) == 1 {
            all.push((outer, part));
        } else {
            let (_, inner) = best(&part, depth - 1)?;
            all.extend(inner.into_iter().map(|(inner, part)| (format!("{outer}, {inner}"), part)));
        }
    }
    Some((VolumeField::Several, all))
}

/// Whether parts of slices that share places are volumes: no two of a part share one, and they are not single slices.
fn unshared(slices: &[Slice], field: VolumeField, parts: &[(String, Vec<Slice>)]) -> bool {
    let most = deepest_place(slices);
    let is_by_time = matches!(field, VolumeField::Moment | VolumeField::Order);
    parts.len() > 1
        && !(is_by_time && parts.len() > most)
        && parts.iter().any(|(_, part)| part.len() > 1)
        && parts.iter().all(|(_, part)| deepest_place(part) == 1)
}

/// Whether parts of slices at places of their own are volumes: each is evenly spaced and runs through the others, and together
/// they are not, or a field says outright that they are others.
fn interleaved(slices: &[Slice], field: VolumeField, parts: &[(String, Vec<Slice>)]) -> bool {
    let is_plain = matches!(
        field,
        VolumeField::Time
            | VolumeField::HeartPhase
            | VolumeField::Echo
            | VolumeField::Acquisition
            | VolumeField::BValue
    );
    // Places alone have to be plain.
    let tolerance = if field == VolumeField::Place { 0.1 * UNEVEN } else { UNEVEN };
    let ends = |part: &[Slice]| Some((part.first()?.height, part.last()?.height));
    let all = ends(slices);
    let runs_through = |part: &[Slice]| {
        // Most of the way.
        matches!((ends(part), all), (Some((low, high)), Some((first, last))) if high - low > 0.5 * (last - first))
    };
    parts.len() > 1
        && (is_plain || !is_even(slices, UNEVEN))
        && parts.iter().all(|(_, part)| part.len() > 2 && is_even(part, tolerance) && runs_through(part))
}

/// The most slices that share a place, of slices in order of height.
fn deepest_place(slices: &[Slice]) -> usize {
    places(slices).map(<[Slice]>::len).max().unwrap_or(0)
}

/// The slices of each place.
pub(super) fn places<'s, 'f, 'a>(slices: &'s [Slice<'f, 'a>]) -> impl Iterator<Item = &'s [Slice<'f, 'a>]> {
    slices.chunk_by(|a, b| b.height - a.height < SAME)
}

/// Whether no distance is more than this part of their mean away from it.
fn is_even(slices: &[Slice], tolerance: f64) -> bool {
    let [first, .., last] = slices else { return true };
    let mean = (last.height - first.height) / (slices.len() - 1) as f64;
    slices.windows(2).all(|two| (two[1].height - two[0].height - mean).abs() <= tolerance * mean)
}

/// What a slice has in a field: a number, or words.
#[derive(Clone, PartialEq)]
enum Held {
    Nothing,
    Number(f64),
    Words(String),
}

impl Held {
    fn of(slice: &Slice, tag: Tag) -> Self {
        match slice.file.value(slice.frame, tag) {
            None => Self::Nothing,
            Some(value) => match value.text() {
                // Times of day and lists are words whose order is theirs; a date with them has too many digits for a number.
                words if words.len() > 15 || words.contains('\\') => Self::Words(words),
                words => words.parse().map_or(Self::Words(words), Self::Number),
            },
        }
    }

    fn compare(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.total_cmp(b),
            (Self::Words(a), Self::Words(b)) => a.cmp(b),
            _ => self.rank().cmp(&other.rank()),
        }
    }

    fn rank(&self) -> u8 {
        match self {
            Self::Nothing => 0,
            Self::Number(_) => 1,
            Self::Words(_) => 2,
        }
    }
}

/// Slices with what they have in a field, in the order of that.
fn held<'f, 'a>(slices: &[Slice<'f, 'a>], tag: Tag) -> Vec<(Held, Slice<'f, 'a>)> {
    let mut held: Vec<_> = slices.iter().map(|slice| (Held::of(slice, tag), *slice)).collect();
    held.sort_by(|(a, _), (b, _)| a.compare(b));
    held
}

/// Slices by the value of a field; `None` where all have the same.
fn values<'f, 'a>(slices: &[Slice<'f, 'a>], tag: Tag, field: VolumeField) -> Option<Vec<(String, Vec<Slice<'f, 'a>>)>> {
    let held = held(slices, tag);
    // Moments may say when a patient was where, and names of a frame of reference say nothing.
    let is_counted = matches!(field, VolumeField::Moment | VolumeField::ReferenceFrame);
    let parts = held.chunk_by(|(a, _), (b, _)| a == b).enumerate().map(|(number, part)| {
        let value = match &part[0].0 {
            _ if is_counted => (number + 1).to_string(),
            Held::Nothing => "-".to_owned(),
            Held::Number(value) => value.to_string(),
            Held::Words(words) => words.clone(),
        };
        (value, part.iter().map(|(_, slice)| *slice).collect())
    });
    let parts: Vec<_> = parts.collect();
    (parts.len() > 1).then_some(parts)
}

fn numbered<'f, 'a>(parts: Vec<Vec<Slice<'f, 'a>>>) -> Vec<(String, Vec<Slice<'f, 'a>>)> {
    let number = |(at, mut part): (usize, Vec<Slice<'f, 'a>>)| {
        by_height(&mut part);
        ((at + 1).to_string(), part)
    };
    parts.into_iter().enumerate().map(number).collect()
}

/// Slices by the runs over the places that they make in the order of a field.
fn runs<'f, 'a>(slices: &[Slice<'f, 'a>], tag: Tag) -> Option<Vec<(String, Vec<Slice<'f, 'a>>)>> {
    let held = held(slices, tag);
    if held.iter().any(|(held, _)| *held == Held::Nothing) {
        return None;
    }
    let ordered: Vec<Slice> = held.into_iter().map(|(_, slice)| slice).collect();
    let way = |two: &[Slice]| (two[1].height - two[0].height).signum();
    // Up or down, as most go.
    let up = ordered.windows(2).map(way).sum::<f64>() >= 0.0;
    let goes_on = |a: &Slice, b: &Slice| if up { b.height - a.height >= SAME } else { a.height - b.height >= SAME };
    Some(numbered(ordered.chunk_by(goes_on).map(<[Slice]>::to_vec).collect()))
}

/// Slices by their rank in a field among those of their place, where each place has one of each.
fn ranks<'f, 'a>(slices: &[Slice<'f, 'a>], tag: Tag) -> Option<Vec<(String, Vec<Slice<'f, 'a>>)>> {
    let most = deepest_place(slices);
    let mut parts = vec![Vec::new(); most];
    let mut keys = vec![Vec::new(); most];
    for place in places(slices) {
        let held = held(place, tag);
        let is_told =
            held.windows(2).all(|two| two[0].0 != two[1].0) && held.iter().all(|(held, _)| *held != Held::Nothing);
        if held.len() != most || !is_told {
            return None;
        }
        for (rank, (key, slice)) in held.into_iter().enumerate() {
            parts[rank].push(slice);
            keys[rank].push(key);
        }
    }
    // Trigger times say what comes first; numbers and moments only where they are all of one rank, or go up with the places.
    let is_sorted = |keys: &[Held]| {
        let goes = |way| keys.windows(2).all(|two| two[0].compare(&two[1]) == way);
        goes(Ordering::Less) || goes(Ordering::Greater)
    };
    let most_of = |keys: &[Held]| keys.iter().max_by(|a, b| a.compare(b)).cloned();
    let least_of = |keys: &[Held]| keys.iter().min_by(|a, b| a.compare(b)).cloned();
    let are_apart = keys.windows(2).all(|two| match (most_of(&two[0]), least_of(&two[1])) {
        (Some(most), Some(least)) => most.compare(&least) == Ordering::Less,
        _ => false,
    });
    let is_trigger = matches!(tag, tags::TRIGGER | tags::TRIGGER_DELAY);
    let holds = is_trigger || are_apart || keys.iter().all(|keys| is_sorted(keys));
    holds.then(|| numbered(parts))
}

/// Every other slice, where no two share a place.
fn alternate<'f, 'a>(slices: &[Slice<'f, 'a>]) -> Option<Vec<(String, Vec<Slice<'f, 'a>>)>> {
    let every_other = |first| slices.iter().skip(first).step_by(2).copied().collect();
    (deepest_place(slices) == 1).then(|| numbered(vec![every_other(0), every_other(1)]))
}
