//! The arrays of a PLY file: the numbers of its vertices and faces that are neither coordinates nor normals.
//!
//! A property has one number, so that tuples stand in several: `red green blue` and `alpha` are one array, called `RGB` or
//! `RGBA` as in VTK, and so are `name_0 name_1 ...` one behind the other with one type. Written again, tuples are taken
//! apart in the same way. PLY has no whole numbers of 64 bits: they are written in 32 where all of them fit, and as
//! doubles elsewhere. Lists are no arrays.

use super::super::columns::Columns;
use super::super::memory_budget::MemoryBudget;
use super::super::numbers::Scalar;
use super::super::warnings::ArrayProblem;
use super::header::Property;
use lumen_mesh::Array;
use lumen_mesh::arrays::{Association, Values};

const COLOURS: [&str; 4] = ["red", "green", "blue", "alpha"];

/// The numbers of an element that are kept, while its rows are read.
#[derive(Debug, Default)]
pub(super) struct Extras {
    /// For each property its numbers, if they are kept.
    values: Vec<Option<Values>>,
    /// Those that are not, because one of them is no number.
    spoilt: Vec<usize>,
}

impl Extras {
    /// Whether there are any among the properties of vertices or faces.
    pub(super) fn are_in(properties: &[Property], on: Association) -> bool {
        properties.iter().any(|property| is_extra(property, on))
    }

    /// What is to be kept of an element of `rows` rows at most, if it is one of vertices or faces; what there is no room
    /// for is noted.
    pub(super) fn new(
        properties: &[Property],
        on: Option<Association>,
        rows: u64,
        room: MemoryBudget,
        columns: &mut Columns,
    ) -> Self {
        let Some(on) = on.filter(|&on| Self::are_in(properties, on)) else { return Self::default() };
        let mut bytes = 0u64;
        let mut keep = |property: &Property| {
            if !is_extra(property, on) {
                return None;
            }
            let more = bytes.saturating_add(rows.saturating_mul(property.kind.size() as u64));
            if !room.holds_arrays(0, 0, more) {
                columns.leave_out(&property.name, ArrayProblem::Memory);
                return None;
            }
            bytes = more;
            Some(Values::new(property.kind))
        };
        Self { values: properties.iter().map(&mut keep).collect(), spoilt: Vec::new() }
    }

    /// Where the numbers of a property go, if they are kept.
    pub(super) fn at(&mut self, place: usize) -> Option<&mut Values> {
        self.values.get_mut(place)?.as_mut()
    }

    /// Gives the numbers of a property up: one of them is none.
    pub(super) fn spoil(&mut self, place: usize) {
        self.values[place] = None;
        self.spoilt.push(place);
    }

    /// Hands over the arrays.
    pub(super) fn add_to(mut self, columns: &mut Columns, on: Association, properties: &[Property]) {
        self.spoilt.iter().for_each(|&place| columns.leave_out(&properties[place].name, ArrayProblem::NoNumber));
        let mut at = 0;
        while at < self.values.len() {
            let (name, width) = self.tuple(properties, at);
            let parts: Vec<Values> = self.values[at..at + width].iter_mut().filter_map(Option::take).collect();
            if let [first, ..] = &parts[..] {
                let mut values = Values::new(first.scalar());
                for row in 0..first.len() {
                    parts.iter().for_each(|part| values.push_from(part, row, 1));
                }
                columns.add(on, &name, width, values);
            }
            at += width;
        }
    }

    /// The name and the number of properties of the array that begins with a property.
    fn tuple(&self, properties: &[Property], at: usize) -> (String, usize) {
        let name = &properties[at].name;
        let goes_on = |width: usize, wanted: &str| {
            let next = properties.get(at + width);
            let is_kept = self.values.get(at + width).is_some_and(Option::is_some);
            is_kept && next.is_some_and(|next| next.name == wanted && next.kind == properties[at].kind)
        };
        let width = COLOURS.iter().enumerate().take_while(|&(i, colour)| goes_on(i, colour)).count();
        if width >= 3 {
            return (if width == 3 { "RGB" } else { "RGBA" }.to_owned(), width);
        }
        let Some(stem) = name.strip_suffix("_0").filter(|stem| !stem.is_empty()) else { return (name.clone(), 1) };
        let width = (0..).take_while(|i| goes_on(*i, &format!("{stem}_{i}"))).count();
        if width > 1 { (stem.to_owned(), width) } else { (name.clone(), 1) }
    }
}

/// Whether a property is one that nothing else reads.
fn is_extra(property: &Property, on: Association) -> bool {
    property.length.is_none() && !taken(on).contains(&property.name.as_str())
}

/// The names that coordinates and normals have.
fn taken(on: Association) -> &'static [&'static str] {
    if on == Association::Point { &["x", "y", "z", "nx", "ny", "nz"] } else { &["nx", "ny", "nz"] }
}

/// An array as it is written.
pub(super) struct Written<'a> {
    array: &'a Array,
    scalar: Scalar,
}

impl<'a> Written<'a> {
    /// The arrays on vertices or on triangles.
    pub(super) fn on(on: Association, arrays: &'a [Array]) -> Vec<Self> {
        let written = |array: &'a Array| Self { array, scalar: written_as(&array.values) };
        arrays.iter().filter(|array| array.on == on).map(written).collect()
    }

    /// The lines of the header.
    pub(super) fn header(&self) -> String {
        let kind = match self.scalar {
            Scalar::I8 => "char",
            Scalar::U8 => "uchar",
            Scalar::I16 => "short",
            Scalar::U16 => "ushort",
            Scalar::I32 | Scalar::I64 => "int",
            Scalar::U32 | Scalar::U64 => "uint",
            Scalar::F32 => "float",
            Scalar::F64 => "double",
        };
        let Array { name, components, on, .. } = self.array;
        // Words of a header are separated by white space.
        let mut name: String =
            name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
        if taken(*on).contains(&name.as_str()) {
            name.push('_');
        }
        let is_colour = matches!((name.as_str(), components), ("RGB", 3) | ("RGBA", 4));
        let property = |component: usize| match (is_colour, components) {
            (true, _) => format!("property {kind} {}\n", COLOURS[component]),
            (false, 1) => format!("property {kind} {name}\n"),
            _ => format!("property {kind} {name}_{component}\n"),
        };
        (0..*components).map(property).collect()
    }

    /// Adds a tuple to `out`, little-endian.
    pub(super) fn push(&self, row: usize, out: &mut Vec<u8>) {
        let Array { values, components, .. } = self.array;
        let numbers = row * components..(row + 1) * components;
        if self.scalar == values.scalar() {
            let size = self.scalar.size();
            out.extend_from_slice(&values.bytes()[numbers.start * size..numbers.end * size]);
            return;
        }
        out.extend_from_slice(Values::of(self.scalar, numbers.map(|i| values.get(i))).bytes());
    }
}

/// The type that PLY has for an array.
fn written_as(values: &Values) -> Scalar {
    let fit = |least: f64, most: f64| (0..values.len()).all(|i| (least..=most).contains(&values.get(i)));
    match values.scalar() {
        Scalar::I64 | Scalar::U64 if fit(f64::from(i32::MIN), f64::from(i32::MAX)) => Scalar::I32,
        Scalar::I64 | Scalar::U64 if fit(0.0, f64::from(u32::MAX)) => Scalar::U32,
        Scalar::I64 | Scalar::U64 => Scalar::F64,
        scalar => scalar,
    }
}
