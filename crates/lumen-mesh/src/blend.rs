//! Values of several rows made into one: the weighted mean where one can be taken, else the value with the most weight.
//!
//! One rule serves wherever rows of an [`Array`] come together: vertices that are welded (equal weights), points within a
//! triangle (barycentric weights), triangles that one takes the place of (areas). Of labels with the same weight the one
//! that comes first wins, so that two vertices welded keep the first one's, as in VTK's `vtkCleanPolyData`. A row of one
//! source keeps its bits. Sums are in f64, in the order of the sources.

use super::arrays::{Array, Association, Kind, Values};

/// For each row to be made, the rows that it is made of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blend {
    /// Where the sources of each row end.
    ends: Vec<u32>,
    /// Rows with their weights, above 0.
    sources: Vec<(u32, f32)>,
}

impl Blend {
    /// Room for `rows` rows of `sources` sources together.
    pub fn with_capacity(rows: usize, sources: usize) -> Self {
        Self { ends: Vec::with_capacity(rows), sources: Vec::with_capacity(sources) }
    }

    /// Sources in groups: `group_of` has for each source the row that it goes into, out of `rows`, or one beyond these
    /// where it goes into none; `weight` how much each counts. Sources keep their order within a row.
    pub fn of_groups(rows: usize, group_of: &[u32], weight: impl Fn(usize) -> f32) -> Self {
        let is_in = |group: u32| (group as usize) < rows;
        let mut ends = vec![0u32; rows + 1];
        group_of.iter().filter(|&&group| is_in(group)).for_each(|&group| ends[group as usize + 1] += 1);
        (1..ends.len()).for_each(|row| ends[row] += ends[row - 1]);
        let mut sources = vec![(0, 0.0); ends[rows] as usize];
        // Each start moves to its end while its sources are put in place.
        for (source, &group) in group_of.iter().enumerate().filter(|&(_, &group)| is_in(group)) {
            let place = &mut ends[group as usize];
            sources[*place as usize] = (source as u32, weight(source));
            *place += 1;
        }
        ends.pop();
        Self { ends, sources }
    }

    /// A row for each of `sources`, of that alone.
    pub fn of_rows(sources: impl Iterator<Item = u32>) -> Self {
        let sources: Vec<(u32, f32)> = sources.map(|source| (source, 1.0)).collect();
        Self { ends: (1..=sources.len() as u32).collect(), sources }
    }

    /// These rows, and then `rows`.
    #[must_use]
    pub fn followed_by(mut self, rows: &[Vec<(u32, f32)>]) -> Self {
        for row in rows {
            row.iter().for_each(|&(source, weight)| self.push(source, weight));
            self.finish_row();
        }
        self
    }

    /// Adds a source of the row that [`Self::finish_row`] ends. One without weight counts for nothing.
    pub fn push(&mut self, source: u32, weight: f32) {
        if weight > 0.0 {
            self.sources.push((source, weight));
        }
    }

    /// Ends a row.
    pub fn finish_row(&mut self) {
        self.ends.push(self.sources.len() as u32);
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The sources of a row.
    pub fn sources(&self, row: usize) -> &[(u32, f32)] {
        let start = row.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.sources[start as usize..self.ends[row] as usize]
    }

    /// The array of the rows; one without a source is 0. It is on vertices or triangles as `array` is.
    ///
    /// # Panics
    /// When a source is not there.
    pub fn of(&self, array: &Array) -> Array {
        let components = array.components;
        let mut values = Values::new(array.values.scalar());
        values.reserve(self.len() * components);
        let mut votes = MajorityVote::default();
        for row in 0..self.len() {
            match (self.sources(row), array.kind) {
                ([], _) => (0..components).for_each(|_| values.push(0.0)),
                (&[(source, _)], _) => values.push_from(&array.values, source as usize * components, components),
                (sources, Kind::Label) => {
                    let winner = votes.winner(sources, &array.values);
                    values.push_from(&array.values, winner as usize, 1);
                }
                (sources, Kind::Continuous) => {
                    let weight: f64 = sources.iter().map(|&(_, weight)| f64::from(weight)).sum();
                    for component in 0..components {
                        let term = |&(source, weight): &(u32, f32)| {
                            array.values.get(source as usize * components + component) * f64::from(weight)
                        };
                        values.push(sources.iter().map(term).sum::<f64>() / weight);
                    }
                }
            }
        }
        Array { name: array.name.clone(), values, ..*array }
    }
}

/// What the arrays become: those on vertices by `vertices`, those on triangles by `triangles`.
pub fn blended(arrays: &[Array], vertices: &Blend, triangles: &Blend) -> Vec<Array> {
    let of = |array: &Array| if array.on == Association::Point { vertices.of(array) } else { triangles.of(array) };
    arrays.iter().map(of).collect()
}

/// The counting of votes; keeps its list from row to row.
#[derive(Default)]
struct MajorityVote {
    /// A label, the place of the vote in the row, who gave it, and its weight.
    votes: Vec<(u64, u32, u32, f32)>,
}

impl MajorityVote {
    /// The first source with the label that has most weight.
    fn winner(&mut self, sources: &[(u32, f32)], labels: &Values) -> u32 {
        self.votes.clear();
        let votes = sources.iter().zip(0..);
        self.votes.extend(votes.map(|(&(source, weight), at)| (labels.word(source as usize), at, source, weight)));
        self.votes.sort_unstable_by_key(|&(label, at, ..)| (label, at));
        let sums = self.votes.chunk_by(|a, b| a.0 == b.0).map(|party| {
            let weight: f64 = party.iter().map(|&(.., weight)| f64::from(weight)).sum();
            (weight, party[0].1, party[0].2)
        });
        let better = |a: (f64, u32, u32), b: (f64, u32, u32)| {
            if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) { b } else { a }
        };
        sums.reduce(better).map_or(0, |(_, _, source)| source)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrays::Scalar;

    fn array(scalar: Scalar, components: usize, numbers: &[f64]) -> Array {
        Array::new("a", Association::Point, components, Values::of(scalar, numbers.iter().copied()))
    }

    fn numbers(array: &Array) -> Vec<f64> {
        (0..array.values.len()).map(|i| array.values.get(i)).collect()
    }

    #[test]
    fn scalars_take_the_mean_and_labels_the_majority() {
        // Rows 0, 3 and 4 go together, 1 alone, 2 nowhere.
        let blend = Blend::of_groups(2, &[0, 1, 9, 0, 0], |_| 1.0);
        assert_eq!(
            (blend.len(), blend.sources(0), blend.sources(1)),
            (2, &[(0, 1.0), (3, 1.0), (4, 1.0)][..], &[(1, 1.0)][..])
        );
        assert_eq!(numbers(&blend.of(&array(Scalar::F32, 1, &[1.0, 7.0, 100.0, 2.0, 6.0]))), [3.0, 7.0]);
        assert_eq!(numbers(&blend.of(&array(Scalar::I32, 1, &[5.0, 7.0, 9.0, 4.0, 4.0]))), [4.0, 7.0]);
        let vectors = array(Scalar::F64, 2, &[0.0, 3.0, 1.0, 2.0, 9.0, 9.0, 3.0, 3.0, 6.0, 0.0]);
        assert_eq!(numbers(&blend.of(&vectors)), [3.0, 2.0, 1.0, 2.0]);
    }

    #[test]
    fn weights_decide_and_the_first_of_equal_labels_wins() {
        let mut blend = Blend::with_capacity(3, 7);
        for row in [&[(0, 0.5), (1, 0.25), (2, 0.25)][..], &[(2, 0.5), (1, 0.5), (0, 0.0)], &[]] {
            row.iter().for_each(|&(source, weight)| blend.push(source, weight));
            blend.finish_row();
        }
        assert_eq!(numbers(&blend.of(&array(Scalar::F64, 1, &[8.0, 4.0, 0.0]))), [5.0, 2.0, 0.0]);
        // Two votes of a quarter are as good as one of a half, which came first.
        assert_eq!(numbers(&blend.of(&array(Scalar::U8, 1, &[9.0, 3.0, 3.0]))), [9.0, 3.0, 0.0]);
        assert_eq!(numbers(&blend.of(&array(Scalar::U8, 1, &[0.0, 1.0, 2.0]))), [0.0, 2.0, 0.0]);
    }

    #[test]
    fn labels_beyond_what_a_double_holds_keep_their_bits() {
        let words = [(1u64 << 60) + 1, (1 << 60) + 3, (1 << 60) + 3];
        let values = Values::from_bytes(Scalar::U64, words.iter().flat_map(|word| word.to_le_bytes()).collect());
        let label = Array::new("Id", Association::Triangle, 1, values);
        let blend = Blend::of_groups(1, &[0, 0, 0], |_| 1.0);
        assert_eq!(blend.of(&label).values.bytes(), words[1].to_le_bytes());
    }
}
