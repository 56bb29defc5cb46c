//! Arrays of a surface: named columns of numbers, a tuple for each vertex or for each triangle.
//!
//! They stand beside the [`TriMesh`](super::TriMesh), which knows nothing of them, in the order of its vertices or
//! triangles. Their numbers are [`Values`]; what makes one value of several is [`Blend`](super::Blend).
//!
//! An array is a label (a piece of the anatomy, a face of a model, an identifier), of which no mean can be taken, where
//! it has one component of a whole-number type, and either no more than [`LABELS`] different values or a name that ends
//! in "id" or "ids". Everything else is continuous.

use serde::{Deserialize, Serialize};

pub use super::values::{Scalar, Values};

/// The most different values that make whole numbers labels.
pub const LABELS: usize = 256;

/// What an array has a tuple for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Association {
    /// Each vertex.
    Point,
    /// Each triangle.
    Triangle,
}

/// Whether a mean can be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename = "ArrayKind", rename_all = "lowercase")]
pub enum Kind {
    /// It can.
    Continuous,
    /// Only the one value or the other makes sense.
    Label,
}

/// A named column of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// As the file has it.
    pub name: String,
    /// What it has a tuple for.
    pub on: Association,
    /// Whether a mean can be taken.
    pub kind: Kind,
    /// Numbers of a tuple, at least 1.
    pub components: usize,
    /// The tuples one after another.
    pub values: Values,
}

impl Array {
    /// An array; its kind follows from the values and the name.
    pub fn new(name: impl Into<String>, on: Association, components: usize, values: Values) -> Self {
        let name = name.into();
        let kind = if components == 1 && is_label(&name, &values) { Kind::Label } else { Kind::Continuous };
        Self { name, on, kind, components: components.max(1), values }
    }

    /// How many tuples there are.
    pub fn len(&self) -> usize {
        self.values.len() / self.components
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Tuple `i` as one number: its only component, or its magnitude.
    ///
    /// # Panics
    /// When there is none.
    pub fn magnitude(&self, i: usize) -> f64 {
        let first = i * self.components;
        if self.components == 1 {
            return self.values.get(first);
        }
        let square = |at| {
            let value = self.values.get(at);
            value * value
        };
        (first..first + self.components).map(square).sum::<f64>().sqrt()
    }

    /// The least and the largest of [`Self::magnitude`]; `None` where none is a finite number.
    pub fn range(&self) -> Option<[f64; 2]> {
        let finite = (0..self.len()).map(|i| self.magnitude(i)).filter(|x| x.is_finite());
        finite.map(|x| [x, x]).reduce(|[least, most], [x, _]| [least.min(x), most.max(x)])
    }

    /// The tuples that `rows` names, in that order.
    ///
    /// # Panics
    /// When one is not there.
    #[must_use]
    pub fn gathered(&self, rows: &[u32]) -> Self {
        let mut values = Values::new(self.values.scalar());
        values.reserve(rows.len() * self.components);
        for &row in rows {
            values.push_from(&self.values, row as usize * self.components, self.components);
        }
        Self { name: self.name.clone(), values, ..*self }
    }

    /// What there is to say about it.
    pub fn info(&self) -> ArrayInfo {
        ArrayInfo {
            name: self.name.clone(),
            on: self.on,
            kind: self.kind,
            scalar: self.values.scalar(),
            components: self.components,
            range: self.range(),
            labels: if self.kind == Kind::Label { self.labels() } else { Vec::new() },
        }
    }

    /// The different values of labels, ascending; none where there are more than [`LABELS`].
    fn labels(&self) -> Vec<f64> {
        let words = few_words(&self.values).unwrap_or_default();
        let bytes = words.iter().flat_map(|word| word.to_le_bytes()[..self.values.scalar().size()].to_vec()).collect();
        let values = Values::from_bytes(self.values.scalar(), bytes);
        let mut labels: Vec<f64> = (0..values.len()).map(|i| values.get(i)).collect();
        labels.sort_unstable_by(f64::total_cmp);
        labels
    }
}

/// What is told of an array. The names of the fields are public and stay.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ArrayInfo {
    /// As the file has it.
    pub name: String,
    /// What it has a tuple for.
    pub on: Association,
    /// Whether a mean can be taken.
    pub kind: Kind,
    /// The type of its numbers.
    #[serde(rename = "type")]
    pub scalar: Scalar,
    /// Numbers of a tuple.
    pub components: usize,
    /// The least and the largest value, of several components the magnitude; null where none is a finite number.
    pub range: Option<[f64; 2]>,
    /// The different values of labels, ascending; none where there are more than [`LABELS`].
    #[serde(default)]
    pub labels: Vec<f64>,
}

/// What is to be said about each array.
pub fn infos(arrays: &[Array]) -> Vec<ArrayInfo> {
    arrays.iter().map(Array::info).collect()
}

/// The arrays of a part of a surface: that of the vertices and triangles with these numbers.
///
/// # Panics
/// When one is not there.
pub fn gathered(arrays: &[Array], vertices: &[u32], triangles: &[u32]) -> Vec<Array> {
    let rows = |array: &Array| match array.on {
        Association::Point => array.gathered(vertices),
        Association::Triangle => array.gathered(triangles),
    };
    arrays.iter().map(rows).collect()
}

/// Whether an array of one component holds labels.
fn is_label(name: &str, values: &Values) -> bool {
    if !values.scalar().is_whole() {
        return false;
    }
    let name = name.to_ascii_lowercase();
    name.ends_with("id") || name.ends_with("ids") || few_words(values).is_some()
}

/// The bits of all different values, where these are at most [`LABELS`].
fn few_words(values: &Values) -> Option<Vec<u64>> {
    let mut found: Vec<u64> = Vec::with_capacity(LABELS);
    let mut last = None;
    for i in 0..values.len() {
        let word = values.word(i);
        // Neighbours mostly have the same.
        if last.replace(word) == Some(word) {
            continue;
        }
        if let Err(place) = found.binary_search(&word) {
            if found.len() == LABELS {
                return None;
            }
            found.insert(place, word);
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_whole_numbers_and_identifiers_are_labels() {
        let kind = |name, components, numbers| Array::new(name, Association::Point, components, numbers).kind;
        let many = || Values::of(Scalar::I32, (0..300).map(f64::from));
        assert_eq!(kind("Part", 1, Values::of(Scalar::U8, (0..256).map(f64::from))), Kind::Label);
        assert_eq!(kind("Intensity", 1, many()), Kind::Continuous);
        assert_eq!(kind("GlobalNodeID", 1, many()), Kind::Label);
        assert_eq!(kind("Part", 1, Values::of(Scalar::F32, [1.0, 2.0])), Kind::Continuous);
        let signs = Array::new("Side", Association::Point, 1, Values::of(Scalar::I16, [2.0, -1.0, 2.0, 0.0]));
        assert_eq!((signs.info().labels, signs.info().range), (vec![-1.0, 0.0, 2.0], Some([-1.0, 2.0])));
        assert_eq!(kind("RGB", 3, Values::of(Scalar::U8, [1.0, 2.0, 3.0])), Kind::Continuous);
    }

    #[test]
    fn tuples_are_gathered_whole_and_ranges_are_of_magnitudes() {
        let vectors =
            Array::new("Speed", Association::Point, 2, Values::of(Scalar::F64, [3.0, 4.0, 0.0, 1.0, f64::NAN, 0.0]));
        assert_eq!((vectors.len(), vectors.range()), (3, Some([1.0, 5.0])));
        let gathered = vectors.gathered(&[1, 0, 1]);
        assert_eq!((gathered.len(), gathered.magnitude(1), gathered.values.get(5)), (3, 5.0, 1.0));
        assert_eq!(Array::new("None", Association::Triangle, 1, Values::of(Scalar::F32, [f64::NAN])).range(), None);
    }
}
