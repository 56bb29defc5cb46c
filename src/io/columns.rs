//! Arrays as a file's parts give them, put together over all parts, with what is said about those left out.
//!
//! A surface can come in parts, each with points and cells of its own: the pieces of VTK, the meshes of glTF. An array
//! is one of the surface where every part has it, with the same type and number of components. What is wrong with an
//! array never stops a surface from being read: the array is left out, and a sentence says so.

use super::text::quoted;
use crate::mesh::arrays::{Array, On, Values};

/// Sentences that are told one by one; beyond these, how many more there are.
const TOLD: usize = 8;

/// The arrays so far.
#[derive(Default)]
pub(super) struct Columns {
    /// Points and cells of the parts that have ended.
    points: usize,
    cells: usize,
    list: Vec<Column>,
    left_out: Vec<String>,
}

struct Column {
    name: String,
    on: On,
    components: usize,
    values: Values,
}

impl Columns {
    /// Adds what the part under way has of an array: whole tuples, for all its points or cells.
    pub(super) fn add(&mut self, on: On, name: &str, components: usize, values: Values) {
        if components == 0 || values.is_empty() || is_normal(name, components, &values) {
            return;
        }
        let before = components.saturating_mul(if on == On::Point { self.points } else { self.cells });
        match self.list.iter_mut().find(|column| column.on == on && column.name == name) {
            None if before == 0 => self.list.push(Column { name: name.to_owned(), on, components, values }),
            Some(column)
                if column.components == components
                    && column.values.scalar() == values.scalar()
                    && column.values.len() == before =>
            {
                column.values.push_from(&values, 0, values.len());
            }
            _ => self.leave_out(name, "its parts do not go together"),
        }
    }

    /// Notes that an array stays behind. `why` goes on after a colon.
    pub(super) fn leave_out(&mut self, name: &str, why: &str) {
        self.left_out.push(left_out(name, why));
    }

    /// How many arrays there are, those left out included.
    pub(super) fn len(&self) -> usize {
        self.list.len() + self.left_out.len()
    }

    /// Ends a part of so many points and cells.
    pub(super) fn end_part(&mut self, points: usize, cells: usize) {
        self.points = self.points.saturating_add(points);
        self.cells = self.cells.saturating_add(cells);
    }

    /// The arrays, with a tuple for each point or cell, and the sentences.
    pub(super) fn finish(self) -> (Vec<Array>, Vec<String>) {
        let Self { points, cells, list, mut left_out } = self;
        let mut arrays = Vec::with_capacity(list.len());
        for Column { name, on, components, values } in list {
            if values.len() == components.saturating_mul(if on == On::Point { points } else { cells }) {
                arrays.push(Array::new(name, on, components, values));
            } else {
                left_out.push(self::left_out(&name, "not every part of the file has it"));
            }
        }
        (arrays, shortened(left_out))
    }
}

/// That an array is left out.
pub(super) fn left_out(name: &str, why: &str) -> String {
    format!("The array {} is left out: {why}.", quoted(name.as_bytes()))
}

/// Not all of many sentences.
fn shortened(mut sentences: Vec<String>) -> Vec<String> {
    let more = sentences.len().saturating_sub(TOLD);
    if more > 1 {
        sentences.truncate(TOLD);
        sentences.push(format!("{more} more arrays are left out."));
    }
    sentences
}

/// Whether it holds normals, which are made anew.
fn is_normal(name: &str, components: usize, values: &Values) -> bool {
    let is_named = || name.get(..7).is_some_and(|start| start.eq_ignore_ascii_case("normals"));
    components == 3 && !values.scalar().is_whole() && (is_named() || name.eq_ignore_ascii_case("normal"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::arrays::Scalar;

    fn zeros(scalar: Scalar, count: usize) -> Values {
        Values::from_bytes(scalar, vec![0; count * scalar.size()])
    }

    #[test]
    fn an_array_is_one_where_every_part_has_it() {
        let mut columns = Columns::default();
        columns.add(On::Point, "all", 1, zeros(Scalar::F32, 2));
        columns.add(On::Point, "first", 2, zeros(Scalar::F32, 4));
        columns.add(On::Triangle, "all", 1, zeros(Scalar::I64, 1));
        columns.add(On::Point, "Normals_", 3, zeros(Scalar::F32, 6));
        columns.end_part(2, 1);
        columns.add(On::Point, "all", 1, zeros(Scalar::F32, 3));
        columns.add(On::Triangle, "all", 1, zeros(Scalar::I32, 4));
        columns.add(On::Point, "second", 1, zeros(Scalar::F32, 3));
        columns.leave_out("names", "it holds text");
        columns.end_part(3, 4);
        let (arrays, sentences) = columns.finish();
        assert_eq!(
            arrays.iter().map(|array| (&*array.name, array.on, array.len())).collect::<Vec<_>>(),
            [("all", On::Point, 5)]
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
        (0..100).for_each(|i| columns.leave_out(&format!("a{i}"), "it holds text"));
        let (_, sentences) = columns.finish();
        assert_eq!((sentences.len(), &*sentences[8]), (9, "92 more arrays are left out."));
    }
}
