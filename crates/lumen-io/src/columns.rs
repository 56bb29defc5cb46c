//! Arrays as a file's parts give them, put together over all parts, with what is said about those left out.
//!
//! A surface can come in parts, each with points and cells of its own: the pieces of VTK, the meshes of glTF. An array
//! is one of the surface where every part has it, with the same type and number of components. What is wrong with an
//! array never stops a surface from being read: the array is left out, and a sentence says so.

use std::collections::HashMap;

use super::text::quoted;
use super::warnings::{ArrayProblem, Warning};
use lumen_mesh::arrays::{Array, Association, Values};

/// Sentences that are told one by one; beyond these, how many more there are.
const TOLD: usize = 8;
/// Arrays of a file that are taken: more than these no list can show, and no vessel has.
const MAX_ARRAYS: usize = 1000;
/// What an array without a name is called: without one, PLY and VTK could not hold it.
const UNNAMED: &str = "array";

/// The arrays so far.
#[derive(Default)]
pub(super) struct Columns {
    /// Points and cells of the parts that have ended.
    points: usize,
    cells: usize,
    list: Vec<Column>,
    /// Where each name stands in the list.
    places: HashMap<(Association, String), usize>,
    /// What is said of the first that are left out.
    left_out: Vec<Warning>,
    /// How many more are.
    more: usize,
}

struct Column {
    name: String,
    on: Association,
    components: usize,
    values: Values,
}

impl Columns {
    /// Adds what the part under way has of an array: whole tuples, for all its points or cells.
    pub(super) fn add(&mut self, on: Association, name: &str, components: usize, values: Values) {
        if components == 0 || values.is_empty() || is_normal(name, components, &values) {
            return;
        }
        let name = if name.trim().is_empty() { UNNAMED } else { name };
        let before = components.saturating_mul(if on == Association::Point { self.points } else { self.cells });
        let key = (on, name.to_owned());
        let is_full = self.list.len() == MAX_ARRAYS;
        match self.places.get(&key).map(|&place| &mut self.list[place]) {
            // A file may have a million of them: what is not told is not put into words.
            None if is_full && self.left_out.len() == TOLD => self.more += 1,
            None if is_full => {
                self.leave_out(name, ArrayProblem::Beyond { most: MAX_ARRAYS });
            }
            None if before == 0 => {
                self.list.push(Column { name: name.to_owned(), on, components, values });
                self.places.insert(key, self.list.len() - 1);
            }
            Some(column)
                if column.components == components
                    && column.values.scalar() == values.scalar()
                    && column.values.len() == before =>
            {
                column.values.push_from(&values, 0, values.len());
            }
            _ => self.leave_out(name, ArrayProblem::Parts),
        }
    }

    /// Notes that an array stays behind. `why` goes on after a colon.
    pub(super) fn leave_out(&mut self, name: &str, why: ArrayProblem) {
        if self.left_out.len() < TOLD {
            self.left_out.push(left_out(name, why));
        } else {
            self.more += 1;
        }
    }

    /// How many arrays there are, those left out included.
    pub(super) fn len(&self) -> usize {
        self.list.len() + self.left_out.len() + self.more
    }

    /// Ends a part of so many points and cells.
    pub(super) fn end_part(&mut self, points: usize, cells: usize) {
        self.points = self.points.saturating_add(points);
        self.cells = self.cells.saturating_add(cells);
    }

    /// The arrays, with a tuple for each point or cell, and the sentences.
    pub(super) fn finish(mut self) -> (Vec<Array>, Vec<Warning>) {
        let (points, cells, list) = (self.points, self.cells, std::mem::take(&mut self.list));
        let mut arrays = Vec::with_capacity(list.len());
        for Column { name, on, components, values } in list {
            if values.len() == components.saturating_mul(if on == Association::Point { points } else { cells }) {
                arrays.push(Array::new(name, on, components, values));
            } else {
                self.leave_out(&name, ArrayProblem::NotEverywhere);
            }
        }
        if self.more > 0 {
            self.left_out.push(Warning::MoreArrays { count: self.more });
        }
        (arrays, self.left_out)
    }
}

/// That an array is left out.
pub(super) fn left_out(name: &str, why: ArrayProblem) -> Warning {
    Warning::ArrayLeftOut { name: quoted(name.as_bytes()), why }
}

/// Whether it holds normals, which are made anew.
fn is_normal(name: &str, components: usize, values: &Values) -> bool {
    let is_named = || name.get(..7).is_some_and(|start| start.eq_ignore_ascii_case("normals"));
    components == 3 && !values.scalar().is_whole() && (is_named() || name.eq_ignore_ascii_case("normal"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::in_english;
    use lumen_mesh::arrays::Scalar;

    fn zeros(scalar: Scalar, count: usize) -> Values {
        Values::from_bytes(scalar, vec![0; count * scalar.size()])
    }

    #[test]
    fn an_array_is_one_where_every_part_has_it() {
        let mut columns = Columns::default();
        columns.add(Association::Point, "all", 1, zeros(Scalar::F32, 2));
        columns.add(Association::Point, "first", 2, zeros(Scalar::F32, 4));
        columns.add(Association::Triangle, "all", 1, zeros(Scalar::I64, 1));
        columns.add(Association::Point, "Normals_", 3, zeros(Scalar::F32, 6));
        columns.end_part(2, 1);
        columns.add(Association::Point, "all", 1, zeros(Scalar::F32, 3));
        columns.add(Association::Triangle, "all", 1, zeros(Scalar::I32, 4));
        columns.add(Association::Point, "second", 1, zeros(Scalar::F32, 3));
        columns.leave_out("names", ArrayProblem::Text);
        columns.end_part(3, 4);
        let (arrays, warnings) = columns.finish();
        let sentences = in_english(&warnings);
        assert_eq!(
            arrays.iter().map(|array| (&*array.name, array.on, array.len())).collect::<Vec<_>>(),
            [("all", Association::Point, 5)]
        );
        assert_eq!(
            sentences,
            [
                "The array \"all\" is left out: its parts do not go together.",
                "The array \"second\" is left out: its parts do not go together.",
                "The array \"names\" is left out: it holds text.",
                "The array \"first\" is left out: not every part of the file has it.",
                "The array \"all\" is left out: not every part of the file has it.",
            ]
        );
    }

    #[test]
    fn many_sentences_become_a_few() {
        let mut columns = Columns::default();
        (0..100).for_each(|i| columns.leave_out(&format!("a{i}"), ArrayProblem::Text));
        let (_, warnings) = columns.finish();
        let sentences = in_english(&warnings);
        assert_eq!((sentences.len(), &*sentences[8]), (9, "92 more arrays are left out."));
    }

    #[test]
    fn no_more_are_taken_than_can_be_shown() {
        let mut columns = Columns::default();
        (0..100_000).for_each(|i| columns.add(Association::Point, &format!("a{i}"), 1, zeros(Scalar::U8, 1)));
        columns.end_part(1, 0);
        columns.add(Association::Point, "a7", 1, zeros(Scalar::U8, 1));
        columns.end_part(1, 0);
        let (arrays, warnings) = columns.finish();
        let sentences = in_english(&warnings);
        assert_eq!((arrays.len(), &*arrays[0].name), (1, "a7"), "the rest is not everywhere");
        assert_eq!(sentences[0], "The array \"a1000\" is left out: only the first 1,000 arrays of a file are read.");
        assert_eq!(sentences.len(), 9);
    }
}
