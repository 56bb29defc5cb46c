//! Arrays as attributes of a glTF mesh.
//!
//! By the specification (3.7.2.1) an attribute that an application has named for itself begins with an underscore, has
//! up to four components, of floats or whole numbers of 8 or 16 bits, and each vertex begins at a multiple of four
//! bytes. So whole numbers of more bits are written in 16 where all of them fit, else as floats where these hold them
//! exactly or where they are no labels; doubles as floats. What fits in neither way, and arrays of triangles, have no place
//! in glTF.

use ::gltf::json::accessor::ComponentType;

use lumen_mesh::Array;
use lumen_mesh::arrays::{Association, Kind, Scalar, Values};

/// The most bits of a whole number that a float holds exactly, as its largest value.
const EXACT: f64 = 16_777_216.0;

/// Whether an array can be an attribute.
pub(super) fn has_place(array: &Array) -> bool {
    Attribute::of(array).is_some()
}

/// An array as an attribute.
pub(super) struct Attribute<'a> {
    array: &'a Array,
    scalar: Scalar,
}

impl<'a> Attribute<'a> {
    /// The attribute that an array is written as, if it has a place.
    pub(super) fn of(array: &'a Array) -> Option<Self> {
        let has_shape = array.on == Association::Point && array.components <= 4;
        let scalar = if has_shape { written_as(array) } else { None }?;
        Some(Self { array, scalar })
    }

    /// The name, in quotes: with an underscore, which reading takes off again.
    pub(super) fn name(&self) -> String {
        let name = &self.array.name;
        serde_json::Value::from(if self.is_colour() { name.clone() } else { format!("_{name}") }).to_string()
    }

    /// Whether it is a colour as the specification has it.
    fn is_colour(&self) -> bool {
        let is_unit = matches!(self.scalar, Scalar::U8 | Scalar::U16 | Scalar::F32);
        self.array.name.starts_with("COLOR_") && matches!(self.array.components, 3 | 4) && is_unit
    }

    /// The accessor of `view`.
    pub(super) fn accessor(&self, view: usize) -> String {
        let component = match self.scalar {
            Scalar::I8 => ComponentType::I8,
            Scalar::U8 => ComponentType::U8,
            Scalar::I16 => ComponentType::I16,
            Scalar::U16 => ComponentType::U16,
            _ => ComponentType::F32,
        };
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][self.array.components - 1];
        let normalized = if self.is_colour() && self.scalar.is_whole() { ",\"normalized\":true" } else { "" };
        format!(
            "{{\"bufferView\":{view},\"componentType\":{},\"count\":{},\"type\":\"{shape}\"{normalized}}}",
            component.as_gl_enum(),
            self.array.len()
        )
    }

    /// Bytes from one vertex to the next.
    pub(super) fn stride(&self) -> usize {
        (self.array.components * self.scalar.size()).next_multiple_of(4)
    }

    /// Bytes of all vertices.
    pub(super) fn bytes(&self) -> u64 {
        (self.stride() * self.array.len()) as u64
    }

    /// Adds the numbers to `out`.
    pub(super) fn write(&self, out: &mut Vec<u8>) {
        let components = self.array.components;
        for row in 0..self.array.len() {
            let numbers = (row * components..(row + 1) * components).map(|i| self.array.values.get(i));
            out.extend_from_slice(Values::of(self.scalar, numbers).bytes());
            out.resize(out.len().next_multiple_of(4), 0);
        }
    }
}

/// The type that glTF has for an array.
fn written_as(array: &Array) -> Option<Scalar> {
    let values = &array.values;
    let fit = |least: f64, most: f64| (0..values.len()).all(|i| (least..=most).contains(&values.get(i)));
    Some(match values.scalar() {
        Scalar::F32 | Scalar::F64 => Scalar::F32,
        scalar if scalar.size() < 4 => scalar,
        _ if fit(0.0, f64::from(u16::MAX)) => Scalar::U16,
        _ if fit(f64::from(i16::MIN), f64::from(i16::MAX)) => Scalar::I16,
        _ if array.kind == Kind::Continuous || fit(-EXACT, EXACT) => Scalar::F32,
        _ => return None,
    })
}

/// What the array of an attribute is called, if that is one to keep: one that an application has named for itself, or a
/// colour.
pub(super) fn array_name(attribute: &str) -> Option<&str> {
    attribute.strip_prefix('_').or(attribute.starts_with("COLOR_").then_some(attribute))
}
